// Curves: packed from any strides, evaluated by all three calls, against each other and against the
// reference; descriptions that make no sense are refused.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/curve_memory.hpp"
#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/inputs/hostile.hpp"
#include "tests/reliability/fuzz/inputs/made_grids.hpp"
#include "tests/reliability/fuzz/inputs/scene.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::fuzz {
namespace {

/// Curves as nets of degree_v 1 with two equal rows, so that the tools for patches can be used.
template <typename S>
[[nodiscard]] Nets<S> doubled(const Nets<S>& curves) {
  Nets<S> nets = curves;
  nets.degree_v = 1;
  nets.values.clear();
  const auto each = static_cast<std::ptrdiff_t>(curves.values_per_patch());
  for (auto k = curves.values.begin(); k != curves.values.end(); k += each) {
    nets.values.insert(nets.values.end(), k, k + each);
    nets.values.insert(nets.values.end(), k, k + each);
  }
  return nets;
}

template <typename T, typename S>
class CurveCase {
public:
  explicit CurveCase(ByteSource& bytes)
      : bytes_(bytes), pack_options_(pack_options(bytes)), curves_(any_curves(bytes)),
        form_(bytes.flag() ? Parameters::centred : Parameters::unit), grid_(bytes, 60, form_),
        options_(any_options(bytes, curves_.count, curves_.components)) {
    const int left = curves_.components - options_.first_component;
    dimension_ = static_cast<std::size_t>(std::min(left, 3));
    const bool plane_or_space =
        options_.first_component == 0 && (curves_.components == 2 || curves_.components == 3);
    groups_ = static_cast<std::uint8_t>(bytes.byte() & (plane_or_space ? 15 : 7));
    curvature_ = plane_or_space && bytes.flag();
    groups_ |= groups_ == 0 && !curvature_ ? 1 : 0;
    const std::size_t most = kMostSamples / grid_.count() + 1;
    options_.patch_count = std::min<std::size_t>(patches_of(options_, curves_.count), most);
    samples_ = options_.patch_count * grid_.count();
  }

  void run() {
    CurveSet<T> set;
    hostile(set);
    const Report report = pack(view(), set, pack_options_);
    require_packed(report, curves_.moderate);
    if (!report) {
      return;
    }
    strided(set);
    for (const std::vector<Isa>& isas : isa_classes()) {
      const CurveMemory<T> expected = on_grid(set, with(options_, isas.front(), 1));
      judge(set, expected, isas.front());
      for (const Isa isa : isas) {
        const tests::CallOptions options = with(options_, isa, options_.threads);
        const CurveMemory<T> again = on_grid(set, options);
        for (std::size_t k = 0; k < samples_; ++k) {
          again.require_same(k, expected, k, named("evaluate, curves", isa));
        }
        scattered(set, expected, options);
        counted(set, expected, options);
      }
    }
  }

private:
  /// An exact decision about a tangent may take milliseconds, thirty times as long with sanitizers,
  /// and every sample is evaluated by some ten calls.
  static constexpr std::size_t kMostSamples = 40;

  static Nets<S> any_curves(ByteSource& bytes) {
    const int n = degree(bytes);
    const int with_components = components(bytes);
    const Weights form = weights(bytes);
    return nets_of<S>(bytes, n, 0, with_components, form, 1 + bytes.below(40));
  }

  [[nodiscard]] ControlCurves<S> view() const {
    return ControlCurves<S>::packed(curves_.values.data(), curves_.count, curves_.degree_u,
                                    curves_.components, curves_.weights);
  }

  CurveMemory<T> memory(std::size_t samples) {
    const Placement place = placement(bytes_);
    return {groups_, curvature_, dimension_, samples, place, bytes_.flag()};
  }

  CurveMemory<T> on_grid(const CurveSet<T>& set, const tests::CallOptions& options) {
    CurveMemory<T> to = memory(samples_);
    const CurveGrid<T> grid{grid_.count(), grid_.data(), form_};
    require_status(evaluate(set, grid, to.out(), options), {Status::ok}, "evaluate, curves");
    to.check_surroundings();
    return to;
  }

  void scattered(const CurveSet<T>& set, const CurveMemory<T>& expected,
                 const tests::CallOptions& options) {
    const Placement place = placement(bytes_);
    const Block<std::uint32_t> curve(samples_, place);
    const Block<T> t(samples_, place);
    const bool backwards = bytes_.flag();
    const auto of = [&](std::size_t k) { return backwards ? samples_ - 1 - k : k; };
    for (std::size_t k = 0; k < samples_; ++k) {
      curve.data()[k] = static_cast<std::uint32_t>(options.first_patch + of(k) / grid_.count());
      t.data()[k] = grid_.centred(of(k) % grid_.count());
    }
    CurveMemory<T> to = memory(samples_);
    const CurveSamples<T> list{{curve.data(), samples_}, {t.data(), samples_}, Parameters::centred};
    require_status(evaluate(set, list, to.out(), options), {Status::ok},
                   "evaluate (curve samples)");
    to.check_surroundings();
    for (std::size_t k = 0; k < samples_; ++k) {
      to.require_same(k, expected, of(k), named("evaluate (curve samples)", options.isa));
    }
  }

  /// All curves with the grid's number of samples, where that is uniform.
  void counted(const CurveSet<T>& set, const CurveMemory<T>& expected,
               const tests::CallOptions& options) {
    if (!grid_.uniform()) {
      return;
    }
    const Block<std::uint32_t> n(options.patch_count, placement(bytes_),
                                 static_cast<std::uint32_t>(grid_.count()));
    CurveMemory<T> to = memory(samples_);
    require_status(evaluate(set, CurveGrids{{n.data(), options.patch_count}}, to.out(), options),
                   {Status::ok}, "evaluate (curve counts)");
    to.check_surroundings();
    for (std::size_t k = 0; k < samples_; ++k) {
      to.require_same(k, expected, k, named("evaluate (curve counts)", options.isa));
    }
  }

  /// Any strides give the same set: seen by one call.
  void strided(const CurveSet<T>& set) {
    const Arrangement arrangement(bytes_);
    StridedNets<S> memory(curves_, arrangement, placement(bytes_));
    memory.fill(curves_.values);
    const ControlCurves<S> view = as_curves<S>(memory.view());
    const std::uint8_t threads = bytes_.byte();
    for (const Isa isa : available_isas()) {
      PackOptions options = pack_options_;
      options.isa = isa;
      options.threads = 1 + (threads & 1);
      CurveSet<T> again;
      require(pack(view, again, options).status == Status::ok,
              "pack (curves) refuses other strides");
      const CurveMemory<T> a = on_grid(set, with(options_, isa, 1));
      const CurveMemory<T> b = on_grid(again, with(options_, isa, 1));
      for (std::size_t k = 0; k < samples_; ++k) {
        b.require_same(k, a, k, named("pack (curves)", isa));
      }
    }
  }

  void judge(const CurveSet<T>& set, const CurveMemory<T>& results, Isa isa) {
    const Nets<S> nets = doubled(curves_);
    for (std::size_t k = 0; k < samples_; ++k) {
      const std::size_t curve = options_.first_patch + k / grid_.count();
      const T x = grid_.centred(k % grid_.count());
      require((results.status(k) == SampleStatus::non_finite) == !std::isfinite(x),
              "a status does not tell whether the parameter is finite");
      if (std::isfinite(x) && std::fabs(x) <= 1) {
        judge_sample(results, k, ReferencePatch(nets, curve, pack_options_.relative_to),
                     error_bounds(set, curve, isa), static_cast<Real>(x));
      }
    }
  }

  void judge_sample(const CurveMemory<T>& results, std::size_t k, const ReferencePatch& reference,
                    const CurveErrorBounds& bounds, Real x) {
    const RealSample exact = reference.evaluate(RealParameter::centred(x), RealParameter::unit(0));
    for (std::size_t c = 0; c < dimension_; ++c) {
      const int component = options_.first_component + static_cast<int>(c);
      const auto at = static_cast<std::size_t>(component);
      const Real more = slack<T>(reference, component, pack_options_);
      const Real steep = 8 * curves_.degree_u * reference.weight_ratio();
      if (results.wanted(0)) {
        judge_value("position", results.value(0, c, k), exact.position[at], bounds.position[at],
                    more);
      }
      if (results.wanted(1)) {
        judge_value("d1", results.value(1, c, k), exact.du[at], bounds.d1[at], steep * more);
      }
    }
    Real square = 0;
    for (std::size_t c = 0; c < dimension_ && results.wanted(3); ++c) {
      const auto value = static_cast<Real>(results.value(3, c, k));
      square += value * value;
    }
    const bool unit = std::fabs(std::sqrt(square) - 1) <= 8 * std::numeric_limits<T>::epsilon();
    require(!results.wanted(3) ||
                (results.status(k) == SampleStatus::degenerate ? square == 0 : unit),
            "a tangent's length and its status do not belong together");
  }

  void judge_value(const char* what, T computed, Real exact, double bound, Real more) {
    if (!std::isfinite(bound) || std::fabs(exact) > std::numeric_limits<T>::max() / 2) {
      return;
    }
    const Real error = std::fabs(static_cast<Real>(computed) - exact);
    require(error <= static_cast<Real>(bound) + more, [&] {
      return std::string(what) + " of a curve: computed " + std::to_string(computed) + ", exact " +
             std::to_string(exact) + ", error / bound " +
             std::to_string(error / static_cast<Real>(bound));
    });
  }

  void hostile(const CurveSet<T>& before) {
    const Block<S> block(curves_.values.size(), placement(bytes_));
    std::ranges::copy(curves_.values, block.data());
    ControlCurves<S> curves = view();
    curves.points = block.data();
    curves.memory = block.span();
    ControlNets<S> nets = as_nets(curves);
    spoil(bytes_, nets);
    curves = as_curves(nets); // what was done to rows is lost
    const Verdict verdict = verdict_on(as_nets(curves), true);
    CurveSet<T> set = before;
    const Report report = pack(curves, set, pack_options_);
    require(verdict != Verdict::refused || !report, "pack (curves) takes what makes no sense");
    require(verdict != Verdict::overflow || report.status == Status::size_overflow,
            "pack (curves) takes strides that overflow");
    require(report || set.storage() == before.storage(), "a failed pack has changed the set");
  }

  ByteSource& bytes_;
  PackOptions pack_options_;
  Nets<S> curves_;
  Parameters form_;
  Direction<T> grid_;
  tests::CallOptions options_;
  std::size_t dimension_ = 3;
  std::uint8_t groups_ = 1;
  bool curvature_ = false;
  std::size_t samples_ = 0;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_mixed_case<simdbezier::fuzz::CurveCase>(data, size);
}
