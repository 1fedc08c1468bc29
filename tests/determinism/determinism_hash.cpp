// Prints one hash per class of instruction sets, type and call, so that builds by different
// compilers and for different machines can be compared line by line:
//
//     fma f32 grid 36747169f86be505
//
// Every instruction set of a class must give the class's hash; exit 1 where one does not.
// With --isa the lines of single instruction sets are printed as well.
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "tests/determinism/workload.hpp"

namespace simdbezier::tests {
namespace {

constexpr std::size_t kPatches = 64;

template <typename T>
[[nodiscard]] std::uint64_t grid_hash(const PatchSet<T>& set, Isa isa) {
  Fnv1a hash;
  for (const auto& [nu, nv] : kWorkGrids) {
    Planes<T> planes(kPatches * nu * nv);
    const Status status =
        evaluate_grid(set, Grid<T>::uniform(nu, nv), planes.outputs(), {.threads = 2, .isa = isa});
    hash.add(static_cast<int>(status));
    hash.add(planes.hash());
  }
  return hash.value();
}

template <typename T>
[[nodiscard]] std::uint64_t scattered_hash(const PatchSet<T>& set, Isa isa) {
  const SampleArrays<T> samples = random_samples<T>(kPatches, 20'000);
  Planes<T> planes(samples.patch.size());
  const Status status = evaluate_scattered(set, samples.view(Parameters::centred), planes.outputs(),
                                           {.threads = 2, .isa = isa});
  return status == Status::ok ? planes.hash() : 0;
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
  for (const Isa isa : available_isas()) {
    report.add(isa, std::string(type) + " grid", grid_hash(set, isa));
    report.add(isa, std::string(type) + " scattered", scattered_hash(set, isa));
    report.add(isa, std::string(type) + " grid_local_origin", grid_hash(local, isa));
    report.add(isa, std::string(type) + " scattered_local_origin", scattered_hash(local, isa));
  }
}

} // namespace
} // namespace simdbezier::tests

int main(int argc, char** argv) {
  using namespace simdbezier::tests;
  Report report(argc > 1 && std::strcmp(argv[1], "--isa") == 0);
  run<float>("f32", report);
  run<double>("f64", report);
  return report.finish();
}
