// Prints one hash per class of instruction sets, type and call, so that builds by different
// compilers and for different machines can be compared line by line:
//
//     fma f32 grid 36747169f86be505
//
// Every instruction set of a class must give the class's hash; exit 1 where one does not.
// With --isa the lines of single instruction sets are printed as well. --widest prints the name of
// the widest instruction set, and no hash.
#include <cstdio>
#include <iterator>
#include <map>
#include <string>
#include <string_view>

#include "tests/properties/bits/further_hashes.hpp"
#include "tests/support/isas.hpp"

namespace simdbezier::tests {
namespace {

constexpr std::size_t kPatches = 64;

template <typename T>
[[nodiscard]] std::uint64_t grid_hash(const PatchSet<T>& set, Isa isa, bool second = false) {
  Fnv1a hash;
  for (const auto& [nu, nv] : kWorkGrids) {
    Planes<T> planes(kPatches * nu * nv, {.second = second});
    const Status status =
        evaluate(set, Grid<T>::uniform(nu, nv), planes.outputs(), {.threads = 2, .isa = isa});
    hash.add(static_cast<int>(status.code()));
    hash.add(planes.hash());
  }
  return hash.value();
}

template <typename T>
[[nodiscard]] std::uint64_t scattered_hash(const PatchSet<T>& set, Isa isa, bool second = false) {
  const SampleArrays<T> samples = random_samples<T>(kPatches, 20'000);
  Planes<T> planes(samples.patch.size(), {.second = second});
  const Status status = evaluate(set, samples.view(Parameters::centred), planes.outputs(),
                                 {.threads = 2, .isa = isa});
  return status == Status::ok ? planes.hash() : 0;
}

/// Everything that a call can give.
template <typename T>
[[nodiscard]] std::uint64_t curvature_hash(const PatchSet<T>& set, Isa isa) {
  Planes<T> planes(kPatches * 17 * 9, kAllOutputs);
  const Status status =
      evaluate(set, Grid<T>::uniform(17, 9), planes.outputs(), {.threads = 2, .isa = isa});
  return status == Status::ok ? planes.hash() : 0;
}

/// All members of a vertex, streamed.
template <typename T>
[[nodiscard]] std::uint64_t vertices_hash(const PatchSet<T>& set, Isa isa) {
  constexpr std::size_t n = 17;
  std::vector<T> vertices(21 * kPatches * n * n);
  Outputs<T> out;
  for (std::size_t g = 0; g < kVectorOutputs; ++g) {
    out[static_cast<Output>(g)] = Vectors<T>::xyz(vertices.data() + 3 * g, 21);
  }
  Fnv1a hash;
  const Options options{.threads = 2, .isa = isa, .destination = Destination::memory};
  hash.add(static_cast<int>(evaluate(set, Grid<T>::uniform(n, n), out, options).code()));
  hash.add_all(std::span<const T>(vertices));
  return hash.value();
}

template <typename T>
[[nodiscard]] std::uint64_t patch_grids_hash(const PatchSet<T>& set, Isa isa) {
  std::vector<std::uint32_t> nu;
  std::vector<std::uint32_t> nv;
  std::size_t samples = 0;
  for (std::uint32_t k = 0; k < kPatches; ++k) {
    nu.push_back(2 + k % 33);
    nv.push_back(2 + k % 7);
    samples += std::size_t{nu.back()} * nv.back();
  }
  Planes<T> planes(samples, {.second = true});
  const Status status =
      evaluate(set, PatchGrids{nu, nv}, planes.outputs(), {.threads = 2, .isa = isa});
  return status == Status::ok ? planes.hash() : 0;
}

/// On one thread tiles come in order.
template <typename T>
[[nodiscard]] std::uint64_t tiles_hash(const PatchSet<T>& set, Isa isa) {
  Fnv1a hash;
  const auto add = [&](const Tile<T>& tile) {
    for (const Vectors<T>* const group : {&tile.out.position, &tile.out.duv, &tile.out.normal}) {
      for (std::size_t k = 0; k < tile.samples; ++k) {
        const auto at = static_cast<std::ptrdiff_t>(k) * group->stride;
        hash.add(group->x[at]), hash.add(group->y[at]), hash.add(group->z[at]);
      }
    }
  };
  TileFormat format;
  format.outputs = {Output::position, Output::duv, Output::normal};
  format.layout = TileLayout::interleaved;
  format.samples = 1000;
  hash.add(static_cast<int>(
      evaluate_tiles(set, Grid<T>::uniform(17, 9), format, add, {.threads = 1, .isa = isa})
          .code()));
  return hash.value();
}

/// Keeps the first hash of a key; false where a later one differs.
class Report {
public:
  explicit Report(bool every_isa) : every_isa_(every_isa) {}

  void add(Isa isa, const std::string& row, std::uint64_t hash) {
    const std::string key = (fuses_multiply_add(isa) ? "fma " : "nofma ") + row;
    if (every_isa_) {
      print(std::string(to_string(isa)) + " " + row, hash);
    }
    const auto [known, added] = classes_.emplace(key, hash);
    if (known->second != hash) {
      std::fprintf(stderr, "%s differs on %s\n", key.c_str(), to_string(isa).data());
      failed_ = true;
    }
  }

  [[nodiscard]] int finish() const {
    for (const auto& [key, hash] : classes_) {
      print(key, hash);
    }
    return failed_ ? 1 : 0;
  }

private:
  static void print(const std::string& key, std::uint64_t hash) {
    std::printf("%s %016llx\n", key.c_str(), static_cast<unsigned long long>(hash));
  }

  bool every_isa_;
  bool failed_ = false;
  std::map<std::string, std::uint64_t> classes_;
};

template <typename T>
void run(const char* type, Report& report) {
  const std::vector<Net> nets = mixed_nets(kPatches);
  const PatchSet<T> set = packed<T>(nets);
  const PatchSet<T> local = packed<T>(nets, {.local_origin = true});
  const PatchSet<T> shapes = packed_mixed<T>(mixed_shape_nets(kPatches));
  const PatchSet<T> local_shapes =
      packed_mixed<T>(mixed_shape_nets(kPatches), {.local_origin = true});
  for (const Isa isa : available_isas()) {
    report.add(isa, std::string(type) + " grid", grid_hash(set, isa));
    report.add(isa, std::string(type) + " scattered", scattered_hash(set, isa));
    report.add(isa, std::string(type) + " grid_second", grid_hash(set, isa, true));
    report.add(isa, std::string(type) + " scattered_second", scattered_hash(set, isa, true));
    report.add(isa, std::string(type) + " vertices", vertices_hash(set, isa));
    report.add(isa, std::string(type) + " patch_grids", patch_grids_hash(set, isa));
    report.add(isa, std::string(type) + " tiles", tiles_hash(set, isa));
    report.add(isa, std::string(type) + " grid_local_origin", grid_hash(local, isa));
    report.add(isa, std::string(type) + " scattered_local_origin", scattered_hash(local, isa));
    report.add(isa, std::string(type) + " shapes_all", curvature_hash(shapes, isa));
    report.add(isa, std::string(type) + " shapes_grid", grid_hash(shapes, isa, true));
    report.add(isa, std::string(type) + " shapes_scattered", scattered_hash(shapes, isa, true));
    report.add(isa, std::string(type) + " shapes_patch_grids", patch_grids_hash(shapes, isa));
    report.add(isa, std::string(type) + " shapes_local_origin", grid_hash(local_shapes, isa));
    report.add(isa, std::string(type) + " derivatives", derivatives_hash(set, isa));
    report.add(isa, std::string(type) + " shapes_derivatives", derivatives_hash(shapes, isa));
    report.add(isa, std::string(type) + " curves", curves_hash<T>(isa));
    report.add(isa, std::string(type) + " nets", nets_hash<T>(isa));
  }
}

} // namespace
} // namespace simdbezier::tests

int main(int argc, char** argv) {
  using namespace simdbezier::tests;
  const std::string_view option = argc > 1 ? argv[1] : "";
  if (option == "--widest") {
    std::printf("%s", simdbezier::to_string(widest_of_each_class().back()).data());
    return 0;
  }
  Report report(option == "--isa");
  run<float>("f32", report);
  run<double>("f64", report);
  return report.finish();
}
