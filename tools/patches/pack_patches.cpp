// Packs the control points of a file. Where that fails, the message names the place in the file.
#include <tools/patches/pack_patches.hpp>

#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
[[noreturn]] void refuse(const PatchFile& file, std::size_t patch, const Report& report) {
  const auto point = static_cast<std::size_t>(report.point);
  const std::string type = sizeof(T) == sizeof(float) ? "f32" : "f64";
  const auto found = [&] {
    return shortest(file.point(patch, point)[static_cast<std::size_t>(report.component)]);
  };
  switch (report.status.code()) {
  case Status::non_finite_input:
    if (file.has_origin) {
      bad_input("--origin: expected an origin whose distance from all points " + type +
                " can hold, found " + found() + " from " + file.place(patch, point));
    }
    bad_input(file.place(patch, point) + ": expected coordinates within the range of " + type +
              ", found " + found());
  case Status::bad_weight:
    bad_input(file.place(patch, point) + ": expected a weight within the range of " + type +
              ", found " + found());
  case Status::coefficient_overflow:
    bad_input(file.place(patch, 0) + ": expected a patch whose coefficients fit " + type +
              ", found coordinates too large for that");
  case Status::out_of_memory:
    bad_input("not enough memory");
  default:
    bad_input(file.name + ": " + std::string(to_string(report.status)));
  }
}

/// patch_of(k) is the number of the k-th of these patches in the file.
template <typename T, typename F>
PatchSet<T> pack_nets(const PatchFile& file, const PatchNets<T>& in, F&& patch_of) {
  PatchSet<T> set;
  if (const Report report = pack(std::span(in.nets), set); !report) {
    refuse<T>(file, patch_of(report.item), report);
  }
  return set;
}

} // namespace

template <typename T>
PatchSet<T> pack_patches(const PatchFile& file, std::size_t first, std::size_t patches) {
  return pack_nets<T>(file, file.nets<T>(first, patches), [&](std::size_t k) { return first + k; });
}

template <typename T>
PatchSet<T> pack_patches(const PatchFile& file, std::span<const std::uint32_t> patches) {
  return pack_nets<T>(file, file.nets<T>(patches), [&](std::size_t k) { return patches[k]; });
}

template PatchSet<float> pack_patches<float>(const PatchFile&, std::size_t, std::size_t);
template PatchSet<double> pack_patches<double>(const PatchFile&, std::size_t, std::size_t);
template PatchSet<float> pack_patches<float>(const PatchFile&, std::span<const std::uint32_t>);
template PatchSet<double> pack_patches<double>(const PatchFile&, std::span<const std::uint32_t>);

} // namespace simdbezier::tools
