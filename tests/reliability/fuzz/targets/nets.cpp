// Operations on nets: equal bits on all instruction sets, for any strides and threads; what they
// promise about reversal; and surfaces that are still the same.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/require.hpp"
#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/checks/surface_reference.hpp"
#include "tests/reliability/fuzz/inputs/made_grids.hpp"
#include "tests/reliability/fuzz/inputs/made_nets.hpp"

namespace simdbezier::fuzz {
namespace {

enum class Operation : std::uint8_t {
  split_u,
  split_v,
  split,
  segment,
  elevate,
  hodograph_u,
  hodograph_v,
  reverse_u,
  reverse_v,
  transpose,
  to_bezier,
  from_bezier
};
constexpr std::size_t kOperations = 12;

template <typename T>
class NetCase {
public:
  explicit NetCase(ByteSource& bytes)
      : bytes_(bytes), operation_(static_cast<Operation>(bytes.below(kOperations))),
        basis_(static_cast<Basis>(bytes.below(5))),
        nets_(any_nets<T>(bytes, 20, components(bytes))) {
    for (T* const one : {&u0_, &u1_, &v0_, &v1_}) {
      *one = fuzz::parameter<T>(bytes, Parameters::unit);
    }
    higher_u_ = bytes.between(nets_.degree_u, kMostDegree);
    higher_v_ = bytes.between(nets_.degree_v, kMostDegree);
  }

  void run() {
    const Piece whole{u0_, u1_, v0_, v1_};
    std::vector<Nets<T>> expected = results();
    const Report report = apply_packed(nets_.view(), expected, whole);
    require_documented(report);
    other_strides(expected, report, whole);
    if (report) {
      reversed(expected);
      judge(expected);
    }
  }

private:
  using Parameter = UnitParameter<T>;
  using Piece = SubPatch<T>;

  [[nodiscard]] bool inside() const {
    const auto in = [](T t) { return t >= 0 && t <= 1; };
    return in(u0_) && in(u1_) && in(v0_) && in(v1_);
  }

  void require_documented(const Report& report) const {
    require_status(report.status,
                   {Status::ok, Status::bad_degree, Status::bad_weight, Status::non_finite_input},
                   "an operation on nets");
    const bool shapes = operation_ >= Operation::hodograph_u;
    require(report || !nets_.moderate || !inside() || (shapes && nets_.rational()) ||
                operation_ >= Operation::to_bezier,
            "an operation refuses moderate nets");
  }

  /// Empty nets of the shapes that the operation gives.
  [[nodiscard]] std::vector<Nets<T>> results() const {
    Nets<T> like = nets_;
    std::size_t count = 1;
    switch (operation_) {
    case Operation::split_u:
    case Operation::split_v:
      count = 2;
      break;
    case Operation::split:
      count = 4;
      break;
    case Operation::elevate:
      like.degree_u = higher_u_;
      like.degree_v = higher_v_;
      break;
    case Operation::hodograph_u:
      like.degree_u = std::max(nets_.degree_u - 1, 1);
      break;
    case Operation::hodograph_v:
      like.degree_v = std::max(nets_.degree_v - 1, 1);
      break;
    case Operation::transpose:
      std::swap(like.degree_u, like.degree_v);
      break;
    default:
      break;
    }
    like.values.assign(like.count * like.values_per_patch(), T(0));
    return std::vector<Nets<T>>(count, like);
  }

  Report apply(const ControlNets<T>& nets, std::span<const MutableNets<T>> out, const Piece& piece,
               const Options& options) const {
    switch (operation_) {
    case Operation::split_u:
      return split_u(nets, piece.u0, out[0], out[1], options);
    case Operation::split_v:
      return split_v(nets, piece.v0, out[0], out[1], options);
    case Operation::split:
      return split(nets, piece.u0, piece.v0, {out[0], out[1], out[2], out[3]}, options);
    case Operation::segment:
      return segment(nets, piece, out[0], options);
    case Operation::elevate:
      return elevate(nets, out[0], options);
    case Operation::hodograph_u:
      return hodograph_u(nets, out[0], options);
    case Operation::hodograph_v:
      return hodograph_v(nets, out[0], options);
    case Operation::reverse_u:
      return reverse_u(nets, out[0], options);
    case Operation::reverse_v:
      return reverse_v(nets, out[0], options);
    case Operation::transpose:
      return transpose(nets, out[0], options);
    case Operation::to_bezier:
      return to_bezier(basis_, nets, out[0], options);
    default:
      return from_bezier(basis_, nets, out[0], options);
    }
  }

  Report apply_packed(const ControlNets<T>& nets, std::vector<Nets<T>>& to,
                      const Piece& piece) const {
    std::vector<MutableNets<T>> out;
    for (Nets<T>& one : to) {
      out.push_back(MutableNets<T>::packed(one.values.data(), one.count, one.degree_u, one.degree_v,
                                           one.components, one.weights));
    }
    return apply(nets, out, piece, with({}, available_isas().front(), 1));
  }

  void other_strides(const std::vector<Nets<T>>& expected, const Report& report,
                     const Piece& piece) {
    const Arrangement in_order(bytes_);
    const Arrangement out_order(bytes_);
    StridedNets<T> input(nets_, in_order, placement(bytes_));
    input.fill(nets_.values);
    const Placement place = placement(bytes_);
    for (const Isa isa : available_isas()) {
      std::vector<StridedNets<T>> memory;
      std::vector<MutableNets<T>> out;
      for (const Nets<T>& one : expected) {
        memory.emplace_back(one, out_order, place);
        out.push_back(memory.back().view());
      }
      const Report again = apply(input.view(), out, piece, with({}, isa, 2));
      require(again.status == report.status && again.item == report.item &&
                  again.point == report.point && again.component == report.component,
              named("an operation reports something else", isa));
      for (std::size_t k = 0; k < memory.size(); ++k) {
        memory[k].check_surroundings();
        const std::vector<T> values = memory[k].values();
        if (report) {
          require_equal(values, expected[k].values, named("an operation gives other bits", isa));
        } else {
          require(std::ranges::all_of(values, [](T v) { return std::isnan(v); }),
                  named("a failed operation has written", isa));
        }
      }
    }
  }

  /// The reversed net and mirrored parameters give the reversed result, bit for bit.
  void reversed(const std::vector<Nets<T>>& expected) {
    const Parameter u0(u0_);
    const Parameter u1(u1_);
    Piece mirrored{u0.mirrored(), u1.mirrored(), v0_, v1_};
    if (operation_ == Operation::segment) {
      std::swap(mirrored.u0, mirrored.u1);
    } else if (operation_ != Operation::split_u && operation_ != Operation::elevate) {
      return;
    }
    std::vector<Nets<T>> again = results();
    const Report report = apply_packed(reversed_u(nets_.view()), again, mirrored);
    require(report.status == Status::ok, "an operation refuses the reversed net");
    std::ranges::reverse(again); // low and high
    for (std::size_t k = 0; k < again.size(); ++k) {
      const Nets<T>& one = expected[k];
      for (std::size_t p = 0; p < one.count; ++p) {
        for (int j = 0; j <= one.degree_v; ++j) {
          for (int i = 0; i <= one.degree_u; ++i) {
            for (std::size_t c = 0; c < one.channels(); ++c) {
              const T a = one.point(p, j, i)[c];
              const T b = again[k].point(p, j, one.degree_u - i)[c];
              // What overflows may be infinite or nan.
              require(same_bits(a, b) || !(std::isfinite(a) || std::isfinite(b)),
                      "the reversed net gives something else");
            }
          }
        }
      }
    }
  }

  /// Where a sample of result `k` lies on the patch.
  struct Place {
    Real u;
    Real v;
  };
  [[nodiscard]] Place place_of(std::size_t k, Real s, Real t) const {
    const auto u0 = static_cast<Real>(u0_);
    const auto v0 = static_cast<Real>(v0_);
    const auto half = [](bool high, Real at, Real local) {
      return high ? at + (1 - at) * local : at * local;
    };
    switch (operation_) {
    case Operation::split_u:
      return {half(k == 1, u0, s), t};
    case Operation::split_v:
      return {s, half(k == 1, v0, t)};
    case Operation::split:
      return {half(k % 2 == 1, u0, s), half(k / 2 == 1, v0, t)};
    case Operation::segment:
      return {u0 + (static_cast<Real>(u1_) - u0) * s, v0 + (static_cast<Real>(v1_) - v0) * t};
    case Operation::reverse_u:
      return {1 - s, t};
    case Operation::reverse_v:
      return {s, 1 - t};
    case Operation::transpose:
      return {t, s};
    default:
      return {s, t};
    }
  }

  void judge(const std::vector<Nets<T>>& results) const {
    const bool same_surface =
        operation_ <= Operation::elevate ||
        (operation_ >= Operation::reverse_u && operation_ <= Operation::transpose);
    if (!nets_.moderate || !inside() || !same_surface) {
      return;
    }
    for (std::size_t k = 0; k < results.size(); ++k) {
      for (std::size_t p = 0; p < results[k].count; ++p) {
        judge_patch(results[k], p, k);
      }
    }
  }

  void judge_patch(const Nets<T>& result, std::size_t p, std::size_t k) const {
    const ReferencePatch given(nets_, p);
    const ReferencePatch made(result, p);
    const Real degrees = result.degree_u + result.degree_v + 2;
    const Real unit = std::numeric_limits<T>::epsilon() / 2;
    for (const Place at : {Place{0.25L, 0.75L}, Place{1, 0.5L}, Place{0.625L, 0}}) {
      const Place on = place_of(k, at.u, at.v);
      const RealSample a = made.evaluate(RealParameter::unit(at.u), RealParameter::unit(at.v));
      const RealSample b = given.evaluate(RealParameter::unit(on.u), RealParameter::unit(on.v));
      for (int c = 0; c < given.components(); ++c) {
        const auto plane = static_cast<std::size_t>(c);
        const Real most = 8 * degrees * unit * given.weight_ratio() * given.size(c) +
                          16 * std::numeric_limits<T>::min();
        require(std::fabs(a.position[plane] - b.position[plane]) <= most,
                "an operation has moved the surface");
      }
    }
  }

  ByteSource& bytes_;
  Operation operation_;
  Basis basis_;
  Nets<T> nets_;
  T u0_ = 0;
  T u1_ = 1;
  T v0_ = 0;
  T v1_ = 1;
  int higher_u_ = 3;
  int higher_v_ = 3;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_case<simdbezier::fuzz::NetCase>(data, size);
}
