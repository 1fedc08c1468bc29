// Every public call that may allocate, with inputs that make it do so.
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <ostream>
#include <vector>

#include <simdbezier/simdbezier.hpp>

namespace simdbezier::tests {

/// What calls write, filled with what they never write.
struct Results {
  Results();

  [[nodiscard]] float* at(std::size_t k) { return values.data() + k * kRoom; }
  [[nodiscard]] MutableNets<float> nets(const ControlNets<float>& like, std::size_t k = 0) {
    return MutableNets<float>::packed(at(k), like.count, like.degree_u, like.degree_v,
                                      like.components, like.weights);
  }
  [[nodiscard]] Outputs<float> planes() {
    Outputs<float> out;
    out.position = Vectors<float>::planes(at(0), at(1), at(2));
    return out;
  }
  [[nodiscard]] Outputs<float> vertices() {
    Outputs<float> out;
    out.position = Vectors<float>::xyz(at(0), 6);
    out.duv = Vectors<float>::xyz(at(0) + 3, 6);
    return out;
  }
  [[nodiscard]] CurveOutputs<float> curve_vertices() {
    CurveOutputs<float> out;
    out.position = Vectors<float>::xyz(at(0), 6);
    out.d1 = Vectors<float>::xyz(at(0) + 3, 6);
    return out;
  }
  [[nodiscard]] bool same_values(const Results& other) const {
    return std::memcmp(values.data(), other.values.data(), values.size() * sizeof(float)) == 0 &&
           doubles == other.doubles && links == other.links && tiles == other.tiles;
  }
  [[nodiscard]] bool same_sets(const Results& other) const {
    return set.storage() == other.set.storage() && wide.storage() == other.wide.storage() &&
           curves.storage() == other.curves.storage();
  }

  static constexpr std::size_t kRoom = 1 << 18;
  std::vector<float> values = std::vector<float>(4 * kRoom, -777);
  std::vector<double> doubles = std::vector<double>(kRoom, -777);
  std::vector<EdgeLink> links = std::vector<EdgeLink>(100);
  std::size_t tiles = 0;
  PatchSet<float> set; ///< packed before, as are the curves
  PatchSet<double> wide;
  CurveSet<float> curves;
};

struct Call {
  const char* name;
  bool allocates;
  std::function<Status(Results&, const Options&)> run;
};
inline void PrintTo(const Call& call, std::ostream* out) { *out << call.name; }

[[nodiscard]] std::vector<Call> all_calls();

} // namespace simdbezier::tests
