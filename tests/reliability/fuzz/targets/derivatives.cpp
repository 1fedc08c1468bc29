// evaluate_derivatives(): equal bits on the instruction sets of a class, for any layout and number
// of threads, on grids and scattered; those of the other calls where the header says so.
#include <cmath>
#include <cstdint>
#include <limits>
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

/// Groups of Outputs as derivatives, in their order there.
struct Orders {
  int u;
  int v;
};
constexpr Orders kGroupOrders[] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};

template <typename T>
class DerivativeCase {
public:
  explicit DerivativeCase(ByteSource& bytes)
      : bytes_(bytes), scene_(bytes, 8), grid_(bytes, 12),
        options_(
            any_options(bytes, std::max<std::size_t>(scene_.set().size(), 1), scene_.components())),
        dimension_(std::min(scene_.components() - options_.first_component, 3)) {
    for (std::size_t left = 1 + bytes.below(4); left > 0; --left) {
      const int u = bytes.rarely(64) ? bytes.between(0, kMostDerivativeOrder) : bytes.between(0, 3);
      const int v = bytes.rarely(64) ? bytes.between(0, kMostDerivativeOrder) : bytes.between(0, 3);
      orders_.push_back({u, v});
    }
    const std::size_t patches = patches_of(options_, scene_.set().size());
    options_.patch_count = std::min<std::size_t>(patches, 600 / grid_.samples() + 1);
    samples_ = options_.patch_count * grid_.samples();
  }

  void run() {
    if (!scene_.packed()) {
      return;
    }
    for (const std::vector<Isa>& isas : isa_classes()) {
      const std::vector<T> expected = on_grid(with(options_, isas.front(), 1));
      compare_with_evaluation(expected, isas.front());
      for (const Isa isa : isas) {
        const tests::CallOptions options = with(options_, isa, options_.threads);
        require_equal(on_grid(options), expected, named("evaluate_derivatives", isa));
        require_equal(scattered(options), expected, named("scattered derivatives", isa));
      }
    }
  }

private:
  static constexpr T kUntouched = T(-7.7e7);

  /// Values as [derivative][component][sample], whatever the layout was.
  template <typename Call>
  std::vector<T> collect(Call&& call) {
    const bool records = bytes_.flag();
    const auto dimension = static_cast<std::size_t>(dimension_);
    const std::size_t members = orders_.size() * dimension;
    Block<T> block(samples_ * members, placement(bytes_), kUntouched);
    const std::size_t step = records ? 1 : samples_;
    const auto stride = static_cast<std::ptrdiff_t>(records ? members : 1);
    std::vector<PartialDerivative<T>> derivatives;
    for (std::size_t d = 0; d < orders_.size(); ++d) {
      T* const first = block.data() + d * dimension * step;
      derivatives.push_back({orders_[d].u,
                             orders_[d].v,
                             {first, dimension > 1 ? first + step : nullptr,
                              dimension > 2 ? first + 2 * step : nullptr, stride}});
    }
    require_status(call(std::span<const PartialDerivative<T>>(derivatives)), {Status::ok},
                   "evaluate_derivatives");
    block.check_surroundings();
    std::vector<T> values(block.size());
    for (std::size_t m = 0; m < members; ++m) {
      for (std::size_t k = 0; k < samples_; ++k) {
        values[m * samples_ + k] = block.data()[m * step + k * static_cast<std::size_t>(stride)];
      }
    }
    return values;
  }

  std::vector<T> on_grid(const tests::CallOptions& options) {
    return collect([&](auto derivatives) {
      return evaluate_derivatives(scene_.set(), grid_.view(), derivatives, options);
    });
  }

  std::vector<T> scattered(const tests::CallOptions& options) {
    const Placement place = placement(bytes_);
    const Block<std::uint32_t> patch(samples_, place);
    const Block<T> x(samples_, place);
    const Block<T> y(samples_, place);
    fill(patch, x, y);
    return collect([&](auto derivatives) {
      return evaluate_derivatives(scene_.set(),
                                  Samples<T>{{patch.data(), samples_},
                                             {x.data(), samples_},
                                             {y.data(), samples_},
                                             Parameters::centred},
                                  derivatives, options);
    });
  }

  void fill(const Block<std::uint32_t>& patch, const Block<T>& x, const Block<T>& y) {
    for (std::size_t k = 0; k < samples_; ++k) {
      patch.data()[k] = static_cast<std::uint32_t>(options_.first_patch + k / grid_.samples());
      x.data()[k] = grid_.x(k);
      y.data()[k] = grid_.y(k);
    }
  }

  void compare_with_evaluation(const std::vector<T>& values, Isa isa) {
    for (std::size_t d = 0; d < orders_.size(); ++d) {
      for (std::size_t g = 0; g < std::size(kGroupOrders); ++g) {
        if (kGroupOrders[g].u == orders_[d].u && kGroupOrders[g].v == orders_[d].v) {
          compare_group(values.data() + d * static_cast<std::size_t>(dimension_) * samples_, g,
                        isa);
        }
      }
    }
  }

  /// The exceptions are (2,0) and (0,2) of rational patches, and what is outside of the normal
  /// range, or came from sums that are.
  void compare_group(const T* values, std::size_t group, Isa isa) {
    std::vector<T> plane[3];
    for (std::vector<T>& one : plane) {
      one.resize(samples_ + 1); // data() is a pointer without samples, too
    }
    Outputs<T> out;
    Vectors<T>* const groups[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
    *groups[group] = {plane[0].data(), dimension_ > 1 ? plane[1].data() : nullptr,
                      dimension_ > 2 ? plane[2].data() : nullptr, 1};
    require_status(evaluate(scene_.set(), grid_.view(), out, with(options_, isa, 1)), {Status::ok},
                   "evaluate, grid");
    for (std::size_t k = 0; k < samples_; ++k) {
      const std::size_t patch = options_.first_patch + k / grid_.samples();
      const bool excepted = (group == 3 || group == 5) && scene_.patch(patch).rational();
      for (std::size_t c = 0; c < static_cast<std::size_t>(dimension_); ++c) {
        const T mine = values[c * samples_ + k];
        const T other = plane[c][k];
        require(excepted || !std::isnormal(mine) || !std::isfinite(other) || same_bits(mine, other),
                "a derivative has other bits than evaluate()");
      }
    }
  }

  ByteSource& bytes_;
  Scene<T> scene_;
  AnyGrid<T> grid_;
  tests::CallOptions options_;
  int dimension_;
  std::vector<Orders> orders_;
  std::size_t samples_ = 0;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_case<simdbezier::fuzz::DerivativeCase>(data, size);
}
