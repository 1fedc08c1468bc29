// Nets of one row of the table, packed, and evaluated by any call into one form of results.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "tests/properties/metamorphic/meta_net.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::tests {

/// The results of one call at nu x nv uniform samples of every net, as doubles, in the grid's
/// order; groups that the call or the shape does not have are empty.
struct Sheet {
  std::size_t nu = 0;
  std::size_t nv = 0;
  int components = 0;
  /// [a][b][(net * nv + iv) * nu + iu) * components + c]
  std::array<std::array<std::vector<double>, kOrders>, kOrders> derivatives;
  std::vector<double> direction; ///< 3 a sample: normals, or tangents
  std::vector<double> curvature; ///< 4 a sample: K, H, k1, k2, or a curve's and zeros
  std::vector<SampleStatus> status;
};

/// Bounds of a patch's positions and first derivatives, or of a curve's.
struct MetaBounds {
  double order[2][2][kMostComponents] = {}; ///< [a][b][component], a + b at most 1
};

class MetaSet {
public:
  virtual ~MetaSet() = default;
  /// `sheet` is written; `options` is passed on except for its first component and threads.
  [[nodiscard]] virtual Status evaluate(Call call, std::size_t nu, std::size_t nv,
                                        const CallOptions& options, Sheet& sheet) const = 0;
  [[nodiscard]] virtual MetaBounds bounds(std::size_t net, Isa isa) const = 0;
};

/// Nets with the same number of components; curves of one shape only.
[[nodiscard]] std::unique_ptr<MetaSet> packed_patches(const std::vector<MetaNet>& nets,
                                                      const PackOptions& options, bool is_double);
[[nodiscard]] std::unique_ptr<MetaSet> packed_curves(const std::vector<MetaNet>& nets,
                                                     const PackOptions& options, bool is_double);
/// Either, as the nets are.
[[nodiscard]] std::unique_ptr<MetaSet>
packed_set(const std::vector<MetaNet>& nets, const Placement& placement, bool is_double, Isa isa);

} // namespace simdbezier::tests
