// Sets of curves, and iso-curves of patches; see meta_set.hpp.
#include <algorithm>

#include "tests/properties/metamorphic/meta_memory.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/evaluation.hpp"

namespace simdbezier::tests {
namespace {

template <typename T>
class CurveMetaSet final : public MetaSet {
public:
  CurveMetaSet(const std::vector<MetaNet>& nets, const PackOptions& options)
      : components_(nets[0].components) {
    std::vector<T> points;
    for (const MetaNet& net : nets) {
      points.insert(points.end(), net.values.begin(), net.values.end());
    }
    expect_packed(pack(ControlCurves<T>::packed(points.data(), nets.size(), nets[0].degree_u,
                                                components_, nets[0].weights),
                       curves_, options));
  }

  [[nodiscard]] Status evaluate(Call call, std::size_t nu, std::size_t nv, const CallOptions& given,
                                Sheet& sheet) const override {
    sheet = {nu, nv, components_, {}, {}, {}, {}};
    return in_triples(components_, given, sheet, [&](const CallOptions& options, Sheet& to) {
      return by_curves(call, options, to);
    });
  }

  [[nodiscard]] MetaBounds bounds(std::size_t net, Isa isa) const override {
    MetaBounds result;
    const CurveErrorBounds curve = error_bounds(curves_, net, isa);
    for (std::size_t c = 0; c < kMostComponents; ++c) {
      result.order[0][0][c] = curve.position[c];
      result.order[1][0][c] = curve.d1[c];
    }
    return result;
  }

private:
  [[nodiscard]] int planes_from(int first) const { return std::min(components_ - first, 3); }

  [[nodiscard]] Status by_curves(Call call, const CallOptions& options, Sheet& sheet) const {
    const std::size_t samples = curves_.size() * sheet.nu;
    const int planes = planes_from(options.first_component);
    Memory<T> memory(samples);
    CurveOutputs<T> out;
    out.position = memory.vectors(planes);
    out.d1 = memory.vectors(planes);
    out.d2 = memory.vectors(planes);
    if (components_ == 2 || components_ == 3) {
      out.tangent = memory.vectors(planes);
      out.curvature = memory.block(1);
      sheet.status.assign(samples, static_cast<SampleStatus>(77));
      out.status = sheet.status.data();
    }
    const Status status = run_curves(call, sheet.nu, out, options);
    take(out.position, samples, components_, options.first_component, sheet.derivatives[0][0]);
    take(out.d1, samples, components_, options.first_component, sheet.derivatives[1][0]);
    take(out.d2, samples, components_, options.first_component, sheet.derivatives[2][0]);
    if (out.status.wanted()) {
      take(out.tangent, samples, 3, 0, sheet.direction);
      for (std::size_t k = 0; k < 4 * samples; ++k) {
        sheet.curvature.push_back(k % 4 == 0 ? static_cast<double>(out.curvature[k / 4]) : 0);
      }
    }
    return status;
  }

  [[nodiscard]] Status run_curves(Call call, std::size_t n, const CurveOutputs<T>& out,
                                  const CallOptions& options) const {
    using simdbezier::evaluate; // not the member
    if (call == Call::curve_rows) {
      return evaluate(curves_, CurveGrid<T>::uniform(n), out, options);
    }
    if (call == Call::counted_curves) {
      const std::vector<std::uint32_t> counts(curves_.size(), static_cast<std::uint32_t>(n));
      return evaluate(curves_, CurveGrids{counts}, out, options);
    }
    const std::vector<T> list = parameters<T>(n);
    std::vector<std::uint32_t> curve;
    std::vector<T> t;
    for (std::size_t k = 0; k < curves_.size() * n; ++k) {
      curve.push_back(static_cast<std::uint32_t>(k / n));
      t.push_back(list[k % n]);
    }
    return evaluate(curves_, CurveSamples<T>{curve, t, Parameters::centred}, out, options);
  }

  int components_;
  CurveSet<T> curves_;
};

/// Curve k of every patch to where its samples stand in the grid.
void place(const std::vector<double>& values, std::size_t k, bool in_u, int first,
           std::vector<double>& to, const Sheet& sheet) {
  const auto d = static_cast<std::size_t>(sheet.components);
  const std::size_t along = in_u ? sheet.nv : sheet.nu;
  to.resize(values.size() / along * sheet.nu * sheet.nv);
  for (std::size_t n = 0; n < values.size() / d; ++n) {
    const std::size_t p = n / along;
    const std::size_t iv = in_u ? n % along : k;
    const std::size_t iu = in_u ? k : n % along;
    const std::size_t at = ((p * sheet.nv + iv) * sheet.nu + iu) * d;
    for (int c = first; c < first + std::min(sheet.components - first, 3); ++c) {
      to[at + static_cast<std::size_t>(c)] = values[n * d + static_cast<std::size_t>(c)];
    }
  }
}

} // namespace

template <typename T>
Status evaluate_iso(const PatchSet<T>& patches, Call call, const CallOptions& options,
                    Sheet& sheet) {
  const bool in_u = call == Call::iso_u;
  const std::size_t curves = in_u ? sheet.nu : sheet.nv;
  const std::size_t along = in_u ? sheet.nv : sheet.nu;
  const std::size_t samples = patches.size() * along;
  const int first = options.first_component;
  const int planes = std::min(sheet.components - first, 3);
  Status status = Status::ok;
  for (std::size_t k = 0; k < curves && status == Status::ok; ++k) {
    const T centred = uniform_centred<T>(static_cast<int>(k), static_cast<int>(curves) - 1);
    const double at = (1 + static_cast<double>(centred)) / 2;
    CurveSet<T> set;
    const PackOptions packing{.local_origin = patches.has_local_origins(), .isa = options.isa};
    expect_packed(in_u ? iso_u(patches, at, set, packing) : iso_v(patches, at, set, packing));
    Memory<T> memory(samples);
    CurveOutputs<T> out;
    const std::array<Vectors<T>*, 3> groups{&out.position, &out.d1, &out.d2};
    for (Vectors<T>* const group : groups) {
      *group = memory.vectors(planes);
    }
    status = evaluate(set, CurveGrid<T>::uniform(along), out, options);
    for (std::size_t order = 0; order < 3; ++order) {
      std::vector<double> values;
      take(*groups[order], samples, sheet.components, first, values);
      place(values, k, in_u, first, sheet.derivatives[in_u ? 0 : order][in_u ? order : 0], sheet);
    }
  }
  return status;
}

template Status evaluate_iso(const PatchSet<float>&, Call, const CallOptions&, Sheet&);
template Status evaluate_iso(const PatchSet<double>&, Call, const CallOptions&, Sheet&);

std::unique_ptr<MetaSet> packed_curves(const std::vector<MetaNet>& nets, const PackOptions& options,
                                       bool is_double) {
  if (is_double) {
    return std::make_unique<CurveMetaSet<double>>(nets, options);
  }
  return std::make_unique<CurveMetaSet<float>>(nets, options);
}

std::unique_ptr<MetaSet> packed_set(const std::vector<MetaNet>& nets, const Placement& placement,
                                    bool is_double, Isa isa) {
  const PackOptions options = pack_options(placement, isa);
  return nets[0].degree_v == 0 ? packed_curves(nets, options, is_double)
                               : packed_patches(nets, options, is_double);
}

} // namespace simdbezier::tests
