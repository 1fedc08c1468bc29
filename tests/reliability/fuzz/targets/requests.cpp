// Evaluate calls with arguments that make no sense: what cannot be done is refused and nothing is
// written; what can be done is done, however strange, and nothing else is touched.
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/checked_outputs.hpp"
#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/inputs/hostile.hpp"
#include "tests/reliability/fuzz/inputs/layout_model.hpp"
#include "tests/reliability/fuzz/inputs/made_grids.hpp"
#include "tests/reliability/fuzz/inputs/scene.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::fuzz {
namespace {

template <typename T>
class RequestCase {
public:
  explicit RequestCase(ByteSource& bytes)
      : bytes_(bytes), scene_(bytes, 3), block_(kElements, placement(bytes), kUntouched),
        statuses_(kElements, placement(bytes), kNoStatus) {}

  void run() {
    if (!scene_.packed()) {
      return;
    }
    choose_options();
    choose_grid();
    choose_outputs();
    const Expectation expectation = expect();
    if (expectation == Expectation::untried) {
      return;
    }
    const Status status = call();
    require_status(status,
                   {Status::ok, Status::null_input, Status::null_output, Status::missing_y,
                    Status::missing_z, Status::extra_y, Status::extra_z, Status::bad_components,
                    Status::bad_stride, Status::overlapping_outputs, Status::bad_offsets,
                    Status::bad_grid, Status::bad_patch_range, Status::bad_patch_index,
                    Status::size_overflow, Status::unsupported_isa, Status::out_of_memory},
                   "a call");
    require(expectation != Expectation::failure || status != Status::ok,
            "a call takes arguments that make no sense");
    require(expectation != Expectation::success || status == Status::ok,
            [&] { return "a call refuses sound arguments: " + std::string(to_string(status)); });
    check_memory(status);
  }

private:
  static constexpr std::size_t kElements = 900;
  static constexpr T kUntouched = T(-7.7e7);
  static constexpr auto kAllPatches = static_cast<std::size_t>(-1);
  static constexpr auto kNoStatus = static_cast<SampleStatus>(77);
  enum class Call : std::uint8_t { grid, scattered, patch_grids };

  void choose_options() {
    call_ = static_cast<Call>(bytes_.below(3));
    patches_ = scene_.set().size();
    options_.threads = bytes_.rarely(16) ? hostile_integer(bytes_) : bytes_.between(1, 2);
    options_.threads = std::min(options_.threads, 64); // threads are not what is tried here
    options_.isa = bytes_.rarely(8) ? Isa::neon64 : Isa::automatic;
    options_.destination = static_cast<Destination>(bytes_.below(3));
    options_.watertight = !bytes_.flag();
    if (bytes_.rarely(32)) {
      options_.first_component = hostile_integer(bytes_);
    }
    if (bytes_.rarely(32)) {
      options_.first_patch = bytes_.flag() ? hostile_count(bytes_) : bytes_.below(8);
      options_.patch_count = bytes_.flag() ? hostile_count(bytes_) : bytes_.below(8);
    }
  }

  void choose_grid() {
    nu_ = bytes_.rarely(32) ? hostile_count(bytes_) : 2 + bytes_.below(6);
    nv_ = bytes_.rarely(32) ? hostile_count(bytes_) : 2 + bytes_.below(6);
    const bool null = bytes_.rarely(16);
    if (call_ == Call::scattered) {
      listed_ = bytes_.rarely(16) ? hostile_count(bytes_) : bytes_.below(30);
      const std::size_t length = listed_ < kLeastHostileCount ? listed_ : 1;
      const std::size_t wrong = bytes_.rarely(32) ? bytes_.below(length + 1) : length;
      for (std::size_t k = 0; k < length; ++k) {
        patch_.push_back(static_cast<std::uint32_t>(k == wrong ? patches_ + bytes_.byte()
                                                               : bytes_.below(patches_)));
        bad_index_ = bad_index_ || k == wrong;
        parameter_.push_back(static_cast<T>(bytes_.byte()) / 255);
      }
      null_input_ = null && listed_ > 0;
    } else if (call_ == Call::patch_grids) {
      const std::size_t length = std::min<std::size_t>(options_.patch_count, patches_);
      for (std::size_t k = 0; k < length; ++k) {
        patch_.push_back(bytes_.rarely(16) ? bytes_.raw<std::uint32_t>()
                                           : static_cast<std::uint32_t>(2 + bytes_.below(5)));
        offset_.push_back((k == 0 ? 0 : offset_.back()) + (bytes_.rarely(8) ? 3 : 36));
      }
      null_input_ = null && !patch_.empty();
    }
  }

  /// Samples from index 0 to the last one.
  [[nodiscard]] Wide samples() const {
    if (call_ == Call::scattered) {
      return static_cast<Wide>(listed_);
    }
    if (call_ == Call::grid) {
      return sample_product(sample_product(nu_, nv_), patch_count());
    }
    return call_samples_;
  }
  [[nodiscard]] Wide patch_count() const {
    if (call_ == Call::patch_grids) {
      return static_cast<Wide>(patch_.size());
    }
    const std::size_t rest = options_.first_patch > patches_ ? 0 : patches_ - options_.first_patch;
    return static_cast<Wide>(options_.patch_count == kAllPatches ? rest : options_.patch_count);
  }

  /// A third of the requests are sound; the others have strides, places and planes by chance.
  void choose_outputs() {
    const std::uint8_t groups = static_cast<std::uint8_t>(bytes_.byte() & 127);
    const bool wild = bytes_.below(3) != 0;
    std::ptrdiff_t next = static_cast<std::ptrdiff_t>(bytes_.below(8));
    const int components = std::min(scene_.components(), 3);
    for (std::size_t g = 0; g < kVectorGroups; ++g) {
      if ((groups >> g & 1) == 0) {
        continue;
      }
      Vectors<T>& group = *groups_of(out_)[g];
      group.stride = components;
      if (wild && bytes_.rarely(128)) {
        group.stride = bytes_.flag() ? hostile_stride(bytes_) : bytes_.between(-12, 12);
      }
      T** const component[3] = {&group.x, &group.y, &group.z};
      for (int c = 0; c < components; ++c) {
        *component[c] = block_.data() + next + c;
        if (wild && bytes_.rarely(32)) {
          *component[c] = bytes_.flag() ? nullptr : block_.data() + bytes_.below(kElements);
        }
      }
      next += wild ? bytes_.between(0, 200) : 128;
      next %= static_cast<std::ptrdiff_t>(kElements) - 3;
    }
    if (bytes_.flag()) {
      out_.status = statuses_.data() + bytes_.below(kStatusPlaces);
    }
    if (wild && bytes_.rarely(16)) {
      out_.curvature.mean = block_.data() + bytes_.below(kElements);
    }
  }

  [[nodiscard]] std::vector<Member> members() {
    std::vector<Member> all;
    for (const Vectors<T>* const group : groups_of(out_)) {
      for (const T* const component : {group->x, group->y, group->z}) {
        if (component != nullptr) {
          all.push_back({component - block_.data(), group->stride});
        }
      }
    }
    if (out_.curvature.mean.wanted()) {
      all.push_back({out_.curvature.mean.first - block_.data(), 1});
    }
    return all;
  }

  [[nodiscard]] bool planes_missing() {
    const std::int64_t left = std::int64_t{scene_.components()} - options_.first_component;
    for (const Vectors<T>* const group : groups_of(out_)) {
      if (group->wanted() && (group->x == nullptr || (group->y == nullptr) != (left < 2) ||
                              (group->z == nullptr) != (left < 3))) {
        return true;
      }
    }
    return members().empty();
  }

  [[nodiscard]] bool sound_patches() const {
    const bool counted = call_ == Call::patch_grids;
    const std::size_t count = counted ? patch_.size() : options_.patch_count;
    const bool all = !counted && count == kAllPatches;
    return options_.first_patch <= patches_ && (all || count <= patches_ - options_.first_patch);
  }

  Expectation expect() {
    const bool space = scene_.components() == 3 && options_.first_component == 0;
    bool failure = planes_missing() || options_.isa == Isa::neon64 ||
                   options_.first_component < 0 ||
                   options_.first_component >= scene_.components() ||
                   (!space && (out_.normal.wanted() || out_.curvature.wanted())) || null_input_ ||
                   bad_index_ || (call_ != Call::scattered && !sound_patches()) ||
                   (call_ == Call::grid && (nu_ < 2 || nv_ < 2));
    if (call_ == Call::patch_grids) {
      return failure ? Expectation::failure : of_patch_grids();
    }
    return failure ? Expectation::failure : of_layout();
  }

  Expectation of_patch_grids() {
    Wide last = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(patch_count()); ++k) {
      const Wide count = static_cast<Wide>(patch_[k]) * patch_[k];
      if (patch_[k] < 2) {
        return Expectation::failure;
      }
      if (k + 1 < static_cast<std::size_t>(patch_count()) &&
          offset_[k] + count > static_cast<Wide>(offset_[k + 1])) {
        return Expectation::failure;
      }
      last = static_cast<Wide>(offset_[k]) + count;
    }
    call_samples_ = last;
    return of_layout();
  }

  Expectation of_layout() {
    const Wide count = samples();
    const Expectation expectation =
        expect_of(members(), count, out_.status.wanted(), kElements, taken_);
    return expectation == Expectation::success && planes_apart() ? Expectation::anything
                                                                 : expectation;
  }

  /// Records of planes that lie between one another in another way than as members of a vertex.
  [[nodiscard]] bool planes_apart() {
    for (const Vectors<T>* const group : groups_of(out_)) {
      const std::ptrdiff_t stride = group->stride < 0 ? -group->stride : group->stride;
      if (group->wanted() && stride < 3) {
        return true;
      }
    }
    return out_.curvature.wanted();
  }

  Status call() {
    switch (call_) {
    case Call::grid:
      return evaluate(scene_.set(), Grid<T>::uniform(nu_, nv_), out_, options_);
    case Call::scattered: {
      const Samples<T> list{{null_input_ ? nullptr : patch_.data(), listed_},
                            {parameter_.data(), listed_},
                            {parameter_.data(), listed_}};
      return evaluate(scene_.set(), list, out_, options_);
    }
    default: {
      const PatchGrids grids{
          {null_input_ ? nullptr : patch_.data(), patch_.size()}, patch_, offset_};
      return evaluate(scene_.set(), grids, out_, options_);
    }
    }
  }

  void check_memory(Status status) {
    block_.check_surroundings();
    statuses_.check_surroundings();
    for (std::size_t k = 0; k < kElements; ++k) {
      const bool may = status == Status::ok && k < taken_.size() && taken_[k] != 0;
      require(may || same_bits(block_.data()[k], kUntouched),
              status == Status::ok ? "a call has written what is no output"
                                   : "a failed call has written");
      require(status == Status::ok || statuses_.data()[k] == kNoStatus,
              "a failed call has written a status");
    }
    // Samples in between grids of their own are not written.
    for (std::size_t k = 0; status == Status::ok && call_ != Call::patch_grids && k < taken_.size();
         ++k) {
      require(taken_[k] == 0 || !same_bits(block_.data()[k], kUntouched),
              "an output has not been written");
    }
  }

  ByteSource& bytes_;
  Scene<T> scene_;
  Block<T> block_;
  Block<SampleStatus> statuses_;
  Call call_ = Call::grid;
  tests::CallOptions options_;
  std::size_t patches_ = 0;
  std::size_t nu_ = 2;
  std::size_t nv_ = 2;
  std::size_t listed_ = 0;
  std::vector<std::uint32_t> patch_; // indices, or numbers of samples in both directions
  std::vector<T> parameter_;
  std::vector<std::size_t> offset_;
  bool null_input_ = false;
  bool bad_index_ = false;
  Wide call_samples_ = 0;
  std::vector<std::uint8_t> taken_;
  Outputs<T> out_;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_case<simdbezier::fuzz::RequestCase>(data, size);
}
