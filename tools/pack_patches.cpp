// From a file's control points to a packed set, and back to the file where that fails.
#include <algorithm>
#include <type_traits>

#include <tools/failure.hpp>
#include <tools/output_file.hpp>
#include <tools/patch_file.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
[[noreturn]] void refuse(const PatchFile& file, const PackReport& report) {
  const auto point = static_cast<std::size_t>(report.point);
  const std::string type = sizeof(T) == sizeof(float) ? "f32" : "f64";
  const auto found = [&] {
    return shortest(file.point(report.patch, point)[static_cast<std::size_t>(report.component)]);
  };
  switch (report.status) {
  case Status::non_finite_input:
    bad_input(file.place(report.patch, point) + ": expected coordinates within the range of " +
              type + ", found " + found());
  case Status::bad_weight:
    bad_input(file.place(report.patch, point) + ": expected a weight within the range of " + type +
              ", found " + found());
  case Status::coefficient_overflow:
    bad_input(file.place(report.patch, 0) + ": expected a patch whose coefficients fit " + type +
              ", found coordinates too large for that");
  case Status::out_of_memory:
    bad_input("not enough memory");
  default:
    bad_input(file.name + ": " + std::string(to_string(report.status)));
  }
}

template <typename T>
PatchSet<T> pack_values(const PatchFile& file, std::span<const T> values) {
  PatchSet<T> set;
  const std::vector<ControlNets<T>> nets = file.nets(values);
  if (const PackReport report = pack(std::span(nets), set); !report) {
    refuse<T>(file, report);
  }
  return set;
}

} // namespace

template <typename T>
PatchSet<T> pack_patches(const PatchFile& file) {
  if constexpr (std::is_same_v<T, double>) {
    return pack_values<double>(file, file.points);
  } else {
    std::vector<T> rounded(file.points.size());
    std::ranges::transform(file.points, rounded.begin(),
                           [](double x) { return static_cast<T>(x); });
    return pack_values<T>(file, rounded);
  }
}

template PatchSet<float> pack_patches<float>(const PatchFile& file);
template PatchSet<double> pack_patches<double>(const PatchFile& file);

} // namespace simdbezier::tools
