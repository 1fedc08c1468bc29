#include "src/output/delivery.hpp"

#include <algorithm>
#include <cstring>

namespace simdbezier::detail {
namespace {

/// Pieces that kernels write directly; bounds only how much one thread takes of a huge grid.
constexpr std::size_t kDirectSamples = 65536;

/// A step of room in front of each plane, and a line more than needed, so that planes of a round
/// number of samples do not compete for the same sets of the cache.
template <typename T>
constexpr std::size_t plane_step(std::size_t samples) noexcept {
  constexpr std::size_t kLine = 64 / sizeof(T);
  return (samples + kLine - 1) / kLine * kLine + kDrainStep<T> + kLine;
}

} // namespace

template <typename T>
std::size_t Delivery<T>::chunk_samples(const OutputPlan<T>& plan) noexcept {
  if (!plan.staged()) {
    return kDirectSamples;
  }
  return plan.chunk_bytes() / sizeof(T) / plan.staged_planes();
}

template <typename T>
std::size_t Delivery<T>::scratch_bytes(std::size_t staged_planes, bool streaming,
                                       std::size_t samples) noexcept {
  return staged_planes * plane_step<T>(samples) * sizeof(T) * (streaming ? 2 : 1);
}

template <typename T>
Delivery<T>::Delivery(const OutputPlan<T>& plan, const KernelTable<T>& table, std::size_t samples,
                      void* scratch) noexcept
    : plan_(plan), table_(table), plane_step_(plane_step<T>(samples)) {
  staging_[0] = static_cast<T*>(scratch);
  if (!plan.staged()) {
    return;
  }
  staging_[1] = plan.streaming() ? staging_[0] + plan.staged_planes() * plane_step_ : staging_[0];
  for (buffer_ = 2; buffer_-- > 0;) {
    for (std::size_t g = 0; g < kVectorOutputs; ++g) {
      if (plan.is_staged(g)) {
        for (std::size_t c = 0; c < dimension_of(*plan.out().vectors[g]); ++c) {
          planes_[buffer_][g].component[c] = plane(plan.first_plane(g) + c);
        }
      }
    }
  }
  buffer_ = 0;
}

template <typename T>
T* Delivery<T>::plane(std::size_t index) const noexcept {
  return staging_[buffer_] + index * plane_step_ + kDrainStep<T>;
}

template <typename T>
const Planes<T>* Delivery<T>::begin(std::size_t sample) noexcept {
  if (plan_.staged() && sample != expected_) {
    flush();
    restart(sample);
  }
  expected_ = sample;
  plan_.find_planes(sample, planes_[buffer_]);
  return planes_[buffer_];
}

template <typename T>
void Delivery<T>::restart(std::size_t sample) noexcept {
  for (std::size_t k = 0; k < plan_.streams(); ++k) {
    const StreamShape<T>& shape = plan_.stream(k);
    state_[k] = {sample, 0, shape.streaming ? shape.records_to_line(sample) : 0};
  }
}

/// Records from `from` on, counted from the start of the chunk, one value at a time.
template <typename T>
void Delivery<T>::put_single(std::size_t stream, std::ptrdiff_t from, std::size_t count) noexcept {
  const StreamShape<T>& shape = plan_.stream(stream);
  State& state = state_[stream];
  T* const to = shape.first + static_cast<std::ptrdiff_t>(state.next) * shape.stride;
  for (std::size_t m = 0; m < shape.members; ++m) {
    const T* const values = plane(shape.plane[m]) + from;
    for (std::size_t r = 0; r < count; ++r) {
      to[static_cast<std::ptrdiff_t>(r) * shape.stride + static_cast<std::ptrdiff_t>(m)] =
          values[r];
    }
  }
  state.next += count;
}

template <typename T>
void Delivery<T>::end(std::size_t count) noexcept {
  expected_ += count;
  if (!plan_.staged()) {
    return;
  }
  table_.drain(queue_); // the chunk before
  queue_.streams = plan_.streams();
  queue_.current = 0;
  for (std::size_t k = 0; k < plan_.streams(); ++k) {
    const StreamShape<T>& shape = plan_.stream(k);
    State& state = state_[k];
    auto from = -static_cast<std::ptrdiff_t>(state.pending);
    std::size_t records = count + state.pending;
    const std::size_t peeled = std::min(state.peel, records);
    if (peeled > 0) {
      put_single(k, from, peeled);
      state.peel -= peeled;
      from += static_cast<std::ptrdiff_t>(peeled);
      records -= peeled;
    }
    DrainStream<T>& stream = queue_.stream[k];
    stream.members = shape.members;
    stream.stride = shape.stride;
    stream.streaming = shape.streaming;
    stream.to = shape.first + static_cast<std::ptrdiff_t>(state.next) * shape.stride;
    stream.at = 0;
    stream.steps = records / kDrainStep<T>;
    for (std::size_t m = 0; m < shape.members; ++m) {
      stream.plane[m] = plane(shape.plane[m]) + from;
    }
    state.next += stream.steps * kDrainStep<T>;
    state.pending = records % kDrainStep<T>;
  }
  if (!plan_.streaming()) {
    table_.drain(queue_); // before the samples that wait are moved over those that are finished
  }
  T* const old = plane(0) + count;
  buffer_ = plan_.streaming() ? 1 - buffer_ : 0;
  for (std::size_t p = 0; p < plan_.staged_planes(); ++p) {
    constexpr std::size_t kStep = kDrainStep<T>;
    std::memmove(plane(p) - kStep, old + p * plane_step_ - kStep, kStep * sizeof(T));
  }
}

/// The samples that still wait.
template <typename T>
void Delivery<T>::flush() noexcept {
  if (expected_ == kNone) {
    return;
  }
  for (std::size_t k = 0; k < plan_.streams(); ++k) {
    put_single(k, -static_cast<std::ptrdiff_t>(state_[k].pending), state_[k].pending);
    state_[k].pending = 0;
  }
}

template <typename T>
void Delivery<T>::finish() noexcept {
  if (plan_.staged()) {
    table_.drain(queue_);
    flush();
  }
  if (plan_.streaming()) {
    table_.fence();
  }
}

template class Delivery<float>;
template class Delivery<double>;

} // namespace simdbezier::detail
