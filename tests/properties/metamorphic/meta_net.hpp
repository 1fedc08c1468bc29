// Control nets of patches and curves with any number of components, how relations change them, and
// what errors of their derivatives are relative to.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tests/properties/metamorphic/axes.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests {

/// Control values as packing takes them: components, then the weight, u fastest. All of them are
/// small integers times a power of two, so that nothing is rounded here, in float either.
struct MetaNet {
  int degree_u = 3;
  int degree_v = 3; ///< 0: a curve
  int components = 3;
  Weights weights = Weights::none;
  std::vector<double> values;

  [[nodiscard]] int channels() const { return components + (weights == Weights::none ? 0 : 1); }
  [[nodiscard]] double& at(int j, int i, int channel) { return values[index(j, i, channel)]; }
  [[nodiscard]] double at(int j, int i, int channel) const { return values[index(j, i, channel)]; }
  [[nodiscard]] double weight(int j, int i) const {
    return weights == Weights::none ? 1 : at(j, i, components);
  }

private:
  [[nodiscard]] std::size_t index(int j, int i, int channel) const {
    return static_cast<std::size_t>((j * (degree_u + 1) + i) * channels() + channel);
  }
};

/// Where a batch lies, and how it is packed.
struct Placement {
  bool local_origin = false;
  std::array<double, 3> relative_to{};
};
[[nodiscard]] Placement placement_of(Origin origin);

/// A net of one row of the table with one kind of degeneracy at a side (or the corner where the
/// side begins), away from the origin where origins are asked for.
[[nodiscard]] MetaNet meta_net(const ShapeRow& shape, Kind kind, std::size_t side, Origin origin,
                               Random& random);

/// What translated() adds, and scaled(), reweighted() multiply with.
inline constexpr std::array<double, 3> kTranslation{2, -3, 0.5};
inline constexpr double kScale = 32;
inline constexpr double kReweight = 8;

[[nodiscard]] MetaNet related(const MetaNet& net, Relation relation);
[[nodiscard]] Placement related(const Placement& placement, Relation relation, int components);

/// Orders up to here are compared.
inline constexpr std::size_t kOrders = 4; ///< 0 to 3 in each direction

/// [a][b]: the largest control value of the derivative's hodograph in one component; of rational
/// nets what the quotient rule makes of the largest values and the smallest weight.
using SizeTable = std::array<std::array<double, kOrders>, kOrders>;
[[nodiscard]] SizeTable derivative_sizes(const MetaNet& net, int component,
                                         const Placement& placement);

} // namespace simdbezier::tests
