// See meta_bounds.hpp.
#include "tests/properties/metamorphic/meta_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "tests/properties/accuracy/judge/shape_bounds.hpp"
#include "tests/support/nets/net.hpp"

namespace simdbezier::tests {
namespace {

/// The bounds of iso-curves, whose control points carry 2 (degree + 1) roundings of their own,
/// relative to the points as given, and one of T; their differences carry no less. The parameters
/// of mirrored ones are rounded as well.
[[nodiscard]] double iso_bound(const MetaNet& net, std::size_t order, double largest) {
  const int degree = std::max(net.degree_u, net.degree_v);
  return (2 * degree + 6) * std::pow(2.0 * degree, static_cast<double>(order)) * largest;
}

/// The bounds of one batch: the certificate where there is one, else the bound of positions per
/// unit of the derivative's control values, which is larger than the derivative's own.
[[nodiscard]] double bound_of(const Comparison& what, const MetaBatch& batch, std::size_t net,
                              std::size_t a, std::size_t b, std::size_t c) {
  if (a + b <= 1 && !is_iso_call(what.call)) {
    return batch.bounds[net].order[a][b][c];
  }
  const MetaNet& shape = batch.nets[net];
  const SizeTable& sizes = batch.sizes[net][c];
  const double k = general_bound(shape.degree_u, std::max(shape.degree_v, 1), 0, 0, what.fma);
  const double plain = k * sizes[a][b];
  const double roundings =
      is_iso_call(what.call) ? 2 * plain + iso_bound(shape, a + b, batch.largest[net][c]) : plain;
  // Numerator and denominators of quotients have errors of their own.
  return (shape.weights == Weights::none ? 1 : 4) * roundings *
         (what.is_double ? kUnitRoundoff<double> : kUnitRoundoff<float>);
}

} // namespace

MetaBatch::MetaBatch(std::vector<MetaNet> from, const Placement& where, bool is_double, Isa isa)
    : nets(std::move(from)), placement(where), set(packed_set(nets, placement, is_double, isa)) {
  for (std::size_t k = 0; k < nets.size(); ++k) {
    bounds.push_back(set->bounds(k, isa));
    auto& tables = sizes.emplace_back();
    auto& as_given = largest.emplace_back();
    for (int c = 0; c < nets[k].components; ++c) {
      tables.push_back(derivative_sizes(nets[k], c, placement));
      as_given.push_back(derivative_sizes(nets[k], c, {})[0][0]);
    }
  }
}

Call related(Call call, Relation relation) {
  if (relation != Relation::transposed || !is_iso_call(call)) {
    return call;
  }
  return call == Call::iso_u ? Call::iso_v : Call::iso_u;
}

std::size_t related_component(Relation relation, int components, std::size_t c) {
  const auto turned = static_cast<std::size_t>(std::min(components, 3));
  return relation == Relation::permuted && c < turned ? (c + turned - 1) % turned : c;
}

double sign_and_scale(Relation relation, std::size_t a, std::size_t b) {
  const bool odd = (relation == Relation::reversed_u && a % 2 == 1) ||
                   (relation == Relation::reversed_v && b % 2 == 1);
  return odd ? -1 : relation == Relation::scaled ? kScale : 1;
}

AllowedErrors allowed_errors(const Comparison& what, std::size_t net, const MetaBatch& batch,
                             const MetaBatch& other) {
  AllowedErrors allowed;
  const bool swapped = what.relation == Relation::transposed;
  const int components = batch.nets[net].components;
  for (std::size_t a = 0; a < kOrders; ++a) {
    for (std::size_t b = 0; b < kOrders; ++b) {
      for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
        const double there = bound_of(what, other, net, swapped ? b : a, swapped ? a : b,
                                      related_component(what.relation, components, c));
        allowed.of[a][b][c] = bound_of(what, batch, net, a, b, c) +
                              there / std::abs(sign_and_scale(what.relation, a, b));
      }
    }
  }
  return allowed;
}

} // namespace simdbezier::tests
