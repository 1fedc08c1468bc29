// Every call shape for patches: equal bits on the instruction sets of a class, for any layout,
// number of threads and call; positions and derivatives within the certificate of the reference.
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/checked_outputs.hpp"
#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/inputs/made_grids.hpp"
#include "tests/reliability/fuzz/inputs/scene.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::fuzz {
namespace {

template <typename T>
class CallCase {
public:
  explicit CallCase(ByteSource& bytes)
      : bytes_(bytes), scene_(bytes, 20), grid_(bytes, 24),
        options_(
            any_options(bytes, std::max<std::size_t>(scene_.set().size(), 1), scene_.components())),
        wanted_(bytes, scene_.components(), options_.first_component), call_(bytes.below(4)) {}

  void run() {
    if (!scene_.packed()) {
      return;
    }
    limit_patches();
    for (const std::vector<Isa>& isas : isa_classes()) {
      const Results<T> expected = on_grid(with(options_, isas.front(), 1));
      judge(expected, isas.front());
      for (const Isa isa : isas) {
        on_grid(with(options_, isa, 1 + (isa == isas.back() ? 1 : 0)))
            .require_same(expected, named("evaluate, grid", isa));
        other_call(expected, with(options_, isa, options_.threads));
      }
    }
  }

private:
  /// Limits the size of a call: time should go into many inputs, not into large ones.
  void limit_patches() {
    constexpr std::size_t kMostSamples = 1200;
    options_.patch_count =
        std::min(patches_of(options_, scene_.set().size()), kMostSamples / grid_.samples() + 1);
    samples_ = options_.patch_count * grid_.samples();
  }

  [[nodiscard]] std::size_t patch_of(std::size_t sample) const {
    return options_.first_patch + sample / grid_.samples();
  }

  Results<T> on_grid(const tests::CallOptions& options) {
    OutputMemory<T> memory(wanted_, samples_, bytes_);
    require_status(evaluate(scene_.set(), grid_.view(), memory.out(), options), {Status::ok},
                   "evaluate, grid");
    require(samples_ == 0 || take_executed_isa() == options.isa, "another instruction set ran");
    return memory.collect();
  }

  void other_call(const Results<T>& expected, const tests::CallOptions& options) {
    switch (call_) {
    case 0:
      return scattered(expected, options);
    case 1:
      return tiles(expected, options);
    case 2:
      return patch_grids(options);
    default:
      return;
    }
  }

  void scattered(const Results<T>& expected, const tests::CallOptions& options) {
    std::vector<std::size_t> order(samples_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::uint8_t seed = bytes_.byte();
    SplitMix random(seed);
    for (std::size_t k = 0; seed != 0 && k < samples_; ++k) {
      std::swap(order[k], order[k + random.below(std::min<std::size_t>(samples_ - k, seed))]);
    }
    const Placement place = placement(bytes_);
    const Block<std::uint32_t> patch(samples_, place);
    const Block<T> x(samples_, place);
    const Block<T> y(samples_, place);
    for (std::size_t k = 0; k < samples_; ++k) {
      patch.data()[k] = static_cast<std::uint32_t>(patch_of(order[k]));
      x.data()[k] = grid_.x(order[k]);
      y.data()[k] = grid_.y(order[k]);
    }
    OutputMemory<T> memory(wanted_, samples_, bytes_);
    const Samples<T> list{
        {patch.data(), samples_}, {x.data(), samples_}, {y.data(), samples_}, Parameters::centred};
    require_status(evaluate(scene_.set(), list, memory.out(), options), {Status::ok},
                   "evaluate, samples");
    const Results<T> results = memory.collect();
    for (std::size_t k = 0; k < samples_; ++k) {
      results.require_same(k, expected, order[k], named("evaluate, samples", options.isa));
    }
  }

  [[nodiscard]] TileFormat tile_format() {
    TileFormat format;
    format.outputs = {};
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      if (wanted_.group(g)) {
        format.outputs.add(static_cast<Output>(g));
      }
    }
    if (wanted_.status) {
      format.outputs.add(Output::status);
    }
    if (wanted_.curvatures != 0) {
      format.outputs.add(Output::curvature);
    }
    format.layout = static_cast<TileLayout>(bytes_.below(3));
    format.samples = bytes_.rarely(128) ? 1 + bytes_.below(4000) : 0;
    return format;
  }

  void tiles(const Results<T>& expected, const tests::CallOptions& options) {
    Results<T> results;
    results.reserve(samples_);
    std::vector<std::uint8_t> times(samples_); // threads write places of their own
    const auto collect = [&](const Tile<T>& tile) {
      const std::size_t first =
          (tile.first_patch - options_.first_patch) * grid_.samples() + tile.first_row * tile.nu;
      Outputs<T> out = tile.out;
      for (std::size_t c = 0; c < kCurvatures; ++c) {
        if (!wanted_.curvature(c)) {
          *curvatures_of(out)[c] = nullptr;
        }
      }
      for (std::size_t k = 0; k < tile.samples; ++k) {
        require(first + k < samples_, "a tile lies outside of the call");
        results.take(out, k, first + k);
        ++times[first + k];
      }
    };
    require_status(evaluate_tiles(scene_.set(), grid_.view(), tile_format(), collect, options),
                   {Status::ok}, "evaluate_tiles");
    require(std::ranges::count(times, 1) == static_cast<std::ptrdiff_t>(samples_),
            "tiles bring a sample never or twice");
    results.require_same(expected, named("evaluate_tiles", options.isa));
  }

  /// Grids of their own, with gaps in between or without, against the same call on each patch.
  void patch_grids(const tests::CallOptions& options) {
    const std::size_t count = options.patch_count;
    const Placement place = placement(bytes_);
    const Block<std::uint32_t> nu(count, place);
    const Block<std::uint32_t> nv(count, place);
    const Block<std::size_t> offset(count, place);
    const std::size_t gap = bytes_.below(4);
    std::vector<bool> written;
    for (std::size_t k = 0; k < count; ++k) {
      nu.data()[k] = static_cast<std::uint32_t>(2 + bytes_.below(16));
      nv.data()[k] = static_cast<std::uint32_t>(2 + bytes_.below(9));
      offset.data()[k] = written.size();
      written.resize(written.size() + std::size_t{nu.data()[k]} * nv.data()[k], true);
      written.resize(written.size() + (k + 1 < count ? gap : 0), false);
    }
    OutputMemory<T> memory(wanted_, written.size(), bytes_);
    const PatchGrids grids{
        {nu.data(), count}, {nv.data(), count}, {offset.data(), gap == 0 ? 0 : count}};
    require_status(evaluate(scene_.set(), grids, memory.out(), options), {Status::ok},
                   "evaluate, patch grids");
    const Results<T> results = memory.collect(written);
    for (std::size_t k = 0; k < count; ++k) {
      tests::CallOptions alone = with(options, options.isa, 1);
      alone.first_patch = options.first_patch + k;
      alone.patch_count = 1;
      const Grid<T> grid = Grid<T>::uniform(nu.data()[k], nv.data()[k]);
      OutputMemory<T> of_patch(wanted_, grid.nu * grid.nv, bytes_);
      require_status(evaluate(scene_.set(), grid, of_patch.out(), alone), {Status::ok},
                     "evaluate, grid");
      const Results<T> expected = of_patch.collect();
      for (std::size_t s = 0; s < grid.nu * grid.nv; ++s) {
        results.require_same(offset.data()[k] + s, expected, s,
                             named("evaluate, patch grids", options.isa));
      }
    }
  }

  void judge(const Results<T>& results, Isa isa) {
    const std::size_t step = samples_ / 200 + 1;
    for (std::size_t patch = 0; patch < options_.patch_count; ++patch) {
      const Judge<T> judge(scene_, options_.first_patch + patch, isa);
      for (std::size_t s = 0; s < grid_.samples(); s += step) {
        const std::size_t k = patch * grid_.samples() + s;
        judge_sample(results, k, judge);
      }
    }
  }

  void judge_sample(const Results<T>& results, std::size_t k, const Judge<T>& judge) {
    const T x = grid_.x(k);
    const T y = grid_.y(k);
    if (!std::isfinite(x) || !std::isfinite(y)) {
      return judge_non_finite(results, k);
    }
    judge_normal(results, k);
    if (std::fabs(x) > 1 || std::fabs(y) > 1) {
      return;
    }
    const RealSample exact = scene_.patch(patch_of(k))
                                 .evaluate(RealParameter::centred(static_cast<Real>(x)),
                                           RealParameter::centred(static_cast<Real>(y)));
    for (int c = 0; c < wanted_.dimension; ++c) {
      const auto plane = static_cast<std::size_t>(c);
      const int component = options_.first_component + c;
      if (wanted_.group(0)) {
        judge.position(exact, component, results.vector[0][plane][k]);
        judge_corner(results.vector[0][plane][k], patch_of(k), x, y, component);
      }
      if (wanted_.group(1)) {
        judge.derivative(exact, true, component, results.vector[1][plane][k]);
      }
      if (wanted_.group(2)) {
        judge.derivative(exact, false, component, results.vector[2][plane][k]);
      }
    }
  }

  /// Corners are control points, rounded once (and less relative_to, or divided: twice).
  void judge_corner(T value, std::size_t patch, T x, T y, int c) {
    if (!options_.watertight || std::fabs(x) != 1 || std::fabs(y) != 1) {
      return;
    }
    const ReferencePatch& reference = scene_.patch(patch);
    const Real exact =
        reference.point(y > 0 ? reference.degree_v() : 0, x > 0 ? reference.degree_u() : 0, c);
    const T lower = std::nextafter(static_cast<T>(exact), -std::numeric_limits<T>::infinity());
    const T upper = std::nextafter(static_cast<T>(exact), std::numeric_limits<T>::infinity());
    require(value >= lower && value <= upper, "a corner is not the control point");
  }

  void judge_non_finite(const Results<T>& results, std::size_t k) {
    require(!wanted_.status || results.status[k] == SampleStatus::non_finite,
            "a parameter that is not finite has another status");
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      for (std::size_t c = 0; wanted_.group(g) && c < static_cast<std::size_t>(wanted_.dimension);
           ++c) {
        require(std::isnan(results.vector[g][c][k]),
                "a parameter that is not finite gives a number");
      }
    }
  }

  void judge_normal(const Results<T>& results, std::size_t k) {
    require(!wanted_.status || results.status[k] <= SampleStatus::degenerate,
            "a sample with finite parameters has an unknown or non-finite status");
    if (!wanted_.group(kNormalGroup)) {
      return;
    }
    Real square = 0;
    for (const auto& plane : results.vector[kNormalGroup]) {
      square += static_cast<Real>(plane[k]) * static_cast<Real>(plane[k]);
    }
    const bool zero = square == 0;
    require(zero || std::fabs(std::sqrt(square) - 1) <= 8 * std::numeric_limits<T>::epsilon(),
            "a normal has neither length 1 nor 0");
    require(!wanted_.status || zero == (results.status[k] == SampleStatus::degenerate),
            "a normal is zero without the status degenerate, or the reverse");
  }

  ByteSource& bytes_;
  Scene<T> scene_;
  AnyGrid<T> grid_;
  tests::CallOptions options_;
  Wanted wanted_;
  std::size_t call_;
  std::size_t samples_ = 0;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_case<simdbezier::fuzz::CallCase>(data, size);
}
