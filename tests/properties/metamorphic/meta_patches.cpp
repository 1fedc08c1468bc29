// Sets of patches; see meta_set.hpp.
#include <algorithm>

#include "tests/properties/metamorphic/meta_memory.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/evaluation.hpp"

namespace simdbezier::tests {
namespace {

template <typename T>
class PatchMetaSet final : public MetaSet {
public:
  PatchMetaSet(const std::vector<MetaNet>& nets, const PackOptions& options)
      : components_(nets[0].components) {
    std::vector<std::vector<T>> points;
    std::vector<ControlNets<T>> entries;
    for (const MetaNet& net : nets) {
      points.emplace_back(net.values.begin(), net.values.end());
      entries.push_back(ControlNets<T>::packed(points.back().data(), 1, net.degree_u, net.degree_v,
                                               components_, net.weights));
    }
    expect_packed(pack(std::span<const ControlNets<T>>(entries), set_, options));
  }

  [[nodiscard]] Status evaluate(Call call, std::size_t nu, std::size_t nv, const CallOptions& given,
                                Sheet& sheet) const override {
    sheet = {nu, nv, components_, {}, {}, {}, {}};
    return in_triples(components_, given, sheet, [&](const CallOptions& options, Sheet& to) {
      return is_iso_call(call)          ? evaluate_iso(set_, call, options, to)
             : is_derivative_call(call) ? by_derivatives(call, options, to)
                                        : by_outputs(call, options, to);
    });
  }

  [[nodiscard]] MetaBounds bounds(std::size_t net, Isa isa) const override {
    MetaBounds result;
    const ErrorBounds patch = error_bounds(set_, net, isa);
    for (std::size_t c = 0; c < kMostComponents; ++c) {
      result.order[0][0][c] = patch.position[c];
      result.order[1][0][c] = patch.du[c];
      result.order[0][1][c] = patch.dv[c];
    }
    return result;
  }

private:
  [[nodiscard]] int planes_from(int first) const { return std::min(components_ - first, 3); }

  /// The samples of every patch's grid one by one.
  [[nodiscard]] SampleArrays<T> scattered(const Sheet& sheet) const {
    SampleArrays<T> arrays;
    const auto list = grid_parameters<T>(static_cast<int>(sheet.nu), static_cast<int>(sheet.nv));
    for (std::size_t p = 0; p < set_.size(); ++p) {
      for (const Parameters2<T>& at : list) {
        arrays.add(p, at.x, at.y);
      }
    }
    return arrays;
  }

  [[nodiscard]] Status by_outputs(Call call, const CallOptions& options, Sheet& sheet) const {
    const std::size_t samples = set_.size() * sheet.nu * sheet.nv;
    const int first = options.first_component;
    Memory<T> memory(samples);
    Outputs<T> out;
    const std::array<std::tuple<Vectors<T>*, int, int>, 6> groups{{{&out.position, 0, 0},
                                                                   {&out.du, 1, 0},
                                                                   {&out.dv, 0, 1},
                                                                   {&out.duu, 2, 0},
                                                                   {&out.duv, 1, 1},
                                                                   {&out.dvv, 0, 2}}};
    for (const auto& [group, a, b] : groups) {
      *group = memory.vectors(planes_from(first));
    }
    if (components_ == 3) {
      out.normal = memory.vectors(3);
      sheet.status.assign(samples, static_cast<SampleStatus>(77));
      out.status = sheet.status.data();
      T* const planes = memory.block(4);
      out.curvature = {planes, planes + samples, planes + 2 * samples, planes + 3 * samples};
    }
    const Status status = run(call, sheet, out, options);
    for (const auto& [group, a, b] : groups) {
      take(*group, samples, components_, first,
           sheet.derivatives[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]);
    }
    if (components_ == 3) {
      take(out.normal, samples, 3, 0, sheet.direction);
      const Values<T> planes[] = {out.curvature.gaussian, out.curvature.mean, out.curvature.minimum,
                                  out.curvature.maximum};
      for (std::size_t k = 0; k < 4 * samples; ++k) {
        sheet.curvature.push_back(static_cast<double>(planes[k % 4][k / 4]));
      }
    }
    return status;
  }

  [[nodiscard]] Status run(Call call, const Sheet& sheet, const Outputs<T>& out,
                           const CallOptions& options) const {
    using simdbezier::evaluate; // not the member
    switch (call) {
    case Call::grid:
      return evaluate(set_, Grid<T>::uniform(sheet.nu, sheet.nv), out, options);
    case Call::given_grid: {
      const std::vector<T> u = parameters<T>(sheet.nu);
      const std::vector<T> v = parameters<T>(sheet.nv);
      return evaluate(set_, Grid<T>::at(u, v, Parameters::centred), out, options);
    }
    case Call::patch_grids: {
      const std::vector<std::uint32_t> nu(set_.size(), static_cast<std::uint32_t>(sheet.nu));
      const std::vector<std::uint32_t> nv(set_.size(), static_cast<std::uint32_t>(sheet.nv));
      return evaluate(set_, PatchGrids{nu, nv}, out, options);
    }
    case Call::scattered:
      return evaluate(set_, scattered(sheet).view(Parameters::centred), out, options);
    default:
      return by_tiles(sheet, out, options);
    }
  }

  /// Tiles copied into `out`.
  [[nodiscard]] Status by_tiles(const Sheet& sheet, const Outputs<T>& out,
                                const CallOptions& options) const {
    TileFormat format;
    format.outputs = {simdbezier::Output::position, simdbezier::Output::du,
                      simdbezier::Output::dv,       simdbezier::Output::duu,
                      simdbezier::Output::duv,      simdbezier::Output::dvv};
    if (components_ == 3) {
      for (const simdbezier::Output output :
           {simdbezier::Output::normal, simdbezier::Output::status,
            simdbezier::Output::curvature}) {
        format.outputs.add(output);
      }
    }
    const auto copy = [&](const Tile<T>& tile) {
      const std::size_t first = (tile.first_patch * tile.nu * sheet.nv) + tile.first_row * tile.nu;
      const auto vectors = [&](const Vectors<T>& from, const Vectors<T>& to) {
        plane(from.x, to.x, first, tile.samples);
        plane(from.y, to.y, first, tile.samples);
        plane(from.z, to.z, first, tile.samples);
      };
      for (std::size_t k = 0; k < kVectorOutputs; ++k) {
        const auto output = static_cast<simdbezier::Output>(k);
        vectors(tile.out[output], out[output]);
      }
      plane(tile.out.status.first, out.status.first, first, tile.samples);
      const Curvatures<T>& from = tile.out.curvature;
      const Curvatures<T>& to = out.curvature;
      plane(from.gaussian.first, to.gaussian.first, first, tile.samples);
      plane(from.mean.first, to.mean.first, first, tile.samples);
      plane(from.minimum.first, to.minimum.first, first, tile.samples);
      plane(from.maximum.first, to.maximum.first, first, tile.samples);
    };
    return evaluate_tiles(set_, Grid<T>::uniform(sheet.nu, sheet.nv), format, copy, options);
  }
  template <typename Value>
  static void plane(const Value* from, Value* to, std::size_t first, std::size_t count) {
    if (to != nullptr && from != nullptr) {
      std::copy(from, from + count, to + first);
    }
  }

  [[nodiscard]] Status by_derivatives(Call call, const CallOptions& options, Sheet& sheet) const {
    const std::size_t samples = set_.size() * sheet.nu * sheet.nv;
    Memory<T> memory(samples);
    std::vector<PartialDerivative<T>> wanted;
    for (std::size_t k = 0; k < kOrders * kOrders; ++k) {
      wanted.push_back({static_cast<int>(k / kOrders), static_cast<int>(k % kOrders),
                        memory.vectors(planes_from(options.first_component))});
    }
    const std::span<const PartialDerivative<T>> list(wanted);
    const Status status =
        call == Call::derivative_grid
            ? evaluate_derivatives(set_, Grid<T>::uniform(sheet.nu, sheet.nv), list, options)
            : evaluate_derivatives(set_, scattered(sheet).view(Parameters::centred), list, options);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      take(wanted[k].out, samples, components_, options.first_component,
           sheet.derivatives[k / kOrders][k % kOrders]);
    }
    return status;
  }

  int components_;
  PatchSet<T> set_;
};

} // namespace

std::unique_ptr<MetaSet> packed_patches(const std::vector<MetaNet>& nets,
                                        const PackOptions& options, bool is_double) {
  if (is_double) {
    return std::make_unique<PatchMetaSet<double>>(nets, options);
  }
  return std::make_unique<PatchMetaSet<float>>(nets, options);
}

} // namespace simdbezier::tests
