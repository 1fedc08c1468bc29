// What the results of a batch and of the related batch may differ by.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "tests/properties/metamorphic/meta_set.hpp"

namespace simdbezier::tests {

/// A batch, packed, and what is needed to judge its results.
struct MetaBatch {
  std::vector<MetaNet> nets;
  Placement placement;
  std::unique_ptr<MetaSet> set;
  std::vector<MetaBounds> bounds;
  std::vector<std::vector<SizeTable>> sizes; ///< [net][component]
  std::vector<std::vector<double>> largest;  ///< of the points as given, without relative_to

  MetaBatch(std::vector<MetaNet> from, const Placement& where, bool is_double, Isa isa);
};

/// What all cells of one comparison have in common.
struct Comparison {
  Relation relation;
  Call call;
  std::size_t shape; ///< column of the table: kMixedShape for mixed batches
  Origin origin;
  bool is_double;
  bool fma;
};

/// The call on the related nets that gives what `call` gives on the nets themselves.
[[nodiscard]] Call related(Call call, Relation relation);

/// Component c of the first net is this one of the related net.
[[nodiscard]] std::size_t related_component(Relation relation, int components, std::size_t c);
/// What the derivative of orders (a, b) is multiplied with.
[[nodiscard]] double sign_and_scale(Relation relation, std::size_t a, std::size_t b);

/// The errors that both batches may have together, in the measure of the first: [a][b][component].
struct AllowedErrors {
  double of[kOrders][kOrders][kMostComponents] = {};
};
[[nodiscard]] AllowedErrors allowed_errors(const Comparison& what, std::size_t net,
                                           const MetaBatch& batch, const MetaBatch& other);

} // namespace simdbezier::tests
