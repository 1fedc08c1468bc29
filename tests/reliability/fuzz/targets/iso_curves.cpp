// Curves on patches: boundary curves have the bits of the patches' edges, iso-parametric curves lie
// on the patches, and control points computed from any strides are the same.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/inputs/hostile.hpp"
#include "tests/reliability/fuzz/inputs/made_grids.hpp"
#include "tests/reliability/fuzz/inputs/scene.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::fuzz {
namespace {

constexpr std::size_t kSamples = 9;

template <typename T>
std::vector<T> positions(const CurveSet<T>& curves, int first_component, Isa isa) {
  std::vector<T> values(curves.size() * kSamples);
  CurveOutputs<T> out;
  out.position = Vectors<T>::plane(values.data());
  std::vector<T> rest(2 * values.size());
  const int left = curves.components() - first_component;
  out.position.y = left > 1 ? rest.data() : nullptr;
  out.position.z = left > 2 ? rest.data() + values.size() : nullptr;
  tests::CallOptions options;
  options.first_component = first_component;
  require_status(evaluate(curves, CurveGrid<T>::uniform(kSamples), out, with(options, isa, 1)),
                 {Status::ok}, "evaluate, curves");
  return values;
}

/// Samples on one side of every patch, as many as a curve has.
template <typename T>
std::vector<T> edge_positions(const PatchSet<T>& set, PatchEdge edge, int first_component,
                              Isa isa) {
  const bool along_u = edge == PatchEdge::v0 || edge == PatchEdge::v1;
  const T side = edge == PatchEdge::v1 || edge == PatchEdge::u1 ? T(1) : T(-1);
  const Grid<T> grid{along_u ? kSamples : 1, along_u ? 1 : kSamples, along_u ? nullptr : &side,
                     along_u ? &side : nullptr, Parameters::centred};
  std::vector<T> values(set.size() * kSamples);
  std::vector<T> rest(2 * values.size());
  const int left = set.components() - first_component;
  Outputs<T> out;
  out.position = {values.data(), left > 1 ? rest.data() : nullptr,
                  left > 2 ? rest.data() + values.size() : nullptr, 1};
  tests::CallOptions options;
  options.first_component = first_component;
  require_status(evaluate(set, grid, out, with(options, isa, 1)), {Status::ok}, "evaluate, grid");
  return values;
}

template <typename T, typename S>
class IsoCase {
public:
  explicit IsoCase(ByteSource& bytes)
      : bytes_(bytes), options_(pack_options(bytes)),
        nets_(any_nets<S>(bytes, 8, components(bytes))),
        component_(static_cast<int>(bytes.below(static_cast<std::size_t>(nets_.components)))) {}

  void run() {
    PatchSet<T> set;
    const Report report = pack(nets_.view(), set, options_);
    require_packed(report, nets_.moderate);
    const double parameter = fuzz::parameter<double>(bytes_, Parameters::unit);
    points(parameter);
    if (report) {
      boundaries(set);
      lies_on_patch(set, parameter);
    }
  }

private:
  void boundaries(const PatchSet<T>& set) {
    for (const PatchEdge edge : {PatchEdge::v0, PatchEdge::v1, PatchEdge::u0, PatchEdge::u1}) {
      CurveSet<T> curves;
      require(pack(boundary_curves(nets_.view(), edge), curves, options_).status == Status::ok,
              "a boundary curve of a sound patch is refused");
      for (const Isa isa : available_isas()) {
        require_equal(positions(curves, component_, isa),
                      edge_positions(set, edge, component_, isa),
                      named("a boundary curve has other bits than the edge", isa));
      }
    }
  }

  /// iso_u() and iso_v() into points: from any strides, on any number of threads.
  void points(double parameter) {
    const Arrangement arrangement(bytes_);
    StridedNets<S> strided(nets_, arrangement, placement(bytes_));
    strided.fill(nets_.values);
    const ControlNets<S> view = strided.view();
    const Placement place = placement(bytes_);
    for (const bool of_u : {true, false}) {
      const int degree = of_u ? nets_.degree_v : nets_.degree_u;
      const std::size_t size =
          nets_.count * static_cast<std::size_t>(degree + 1) * nets_.channels();
      const Block<double> a(size, place);
      const Block<double> b(size, place);
      const auto call = [&](const ControlNets<S>& from, double* to, int threads) {
        const Options options{.threads = threads};
        return (of_u ? iso_u(from, parameter, to, options) : iso_v(from, parameter, to, options))
            .status;
      };
      const Status first = call(nets_.view(), a.data(), 1);
      const Status second = call(view, b.data(), 2);
      require_status(first, {Status::ok, Status::non_finite_input, Status::bad_weight}, "iso_u");
      require(first == second, "iso_u has another status from other strides");
      a.check_surroundings();
      b.check_surroundings();
      require_equal(a.span(), b.span(), "iso_u has other bits from other strides");
    }
  }

  void lies_on_patch(const PatchSet<T>& set, double parameter) {
    if (!std::isfinite(parameter) || parameter < 0 || parameter > 1) {
      return;
    }
    for (const bool of_u : {true, false}) {
      CurveSet<T> curves;
      const Report report = of_u ? iso_u(nets_.view(), parameter, curves, options_)
                                 : iso_v(nets_.view(), parameter, curves, options_);
      require_packed(report, nets_.moderate);
      if (!report) {
        continue;
      }
      const std::vector<T> values = positions(curves, component_, available_isas().back());
      for (std::size_t k = 0; k < values.size(); ++k) {
        judge(set, curves, values[k], k, parameter, of_u);
      }
    }
  }

  void judge(const PatchSet<T>&, const CurveSet<T>& curves, T value, std::size_t k,
             double parameter, bool of_u) {
    const ReferencePatch reference(nets_, k / kSamples, options_.relative_to);
    const auto last = static_cast<int>(kSamples) - 1;
    const T x = static_cast<T>(2 * static_cast<int>(k % kSamples) - last) / static_cast<T>(last);
    const RealParameter along = RealParameter::centred(static_cast<Real>(x));
    const RealParameter across = RealParameter::unit(static_cast<Real>(parameter));
    const RealSample exact =
        of_u ? reference.evaluate(across, along) : reference.evaluate(along, across);
    const auto c = static_cast<std::size_t>(component_);
    const double bound = error_bounds(curves, k / kSamples, available_isas().back()).position[c];
    // iso_u() errs by 2 (n + 1) 2^-53 of the control points as given, weights included.
    const Real shift = c < 3 ? std::fabs(static_cast<Real>(options_.relative_to[c])) : 0;
    const Real of_points = 2 * (kMostDegree + 1) * 0x1p-53L * 4 *
                           (reference.rational() ? reference.weight_ratio() : 1) *
                           (reference.size(component_) + shift);
    require(!std::isfinite(bound) || std::fabs(static_cast<Real>(value) - exact.position[c]) <=
                                         static_cast<Real>(bound) + of_points +
                                             slack<T>(reference, component_, options_),
            "an iso-parametric curve leaves its patch");
  }

  ByteSource& bytes_;
  PackOptions options_;
  Nets<S> nets_;
  int component_;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_mixed_case<simdbezier::fuzz::IsoCase>(data, size);
}
