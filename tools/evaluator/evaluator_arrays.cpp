#include <tools/evaluator/evaluator_arrays.hpp>

#include <algorithm>
#include <cstring>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {
namespace {

constexpr std::size_t kFence = 1024; // the least there is; half of it belongs to either neighbour
constexpr std::size_t kAligned = 64;
constexpr unsigned char kFenceByte = 0xA5;
constexpr unsigned char kUnwritten = 0xFF; // all bytes of a nan, of float and of double

} // namespace

EvaluatorArrays::EvaluatorArrays(std::span<unsigned char> memory, std::size_t used)
    : memory_(memory), used_(used) {}

std::size_t EvaluatorArrays::add(Array array) {
  if (array.bytes == 0) {
    return 0;
  }
  array.begin = (used_ + kFence + kAligned - 1) / kAligned * kAligned;
  if (memory_.size() < array.begin + kFence ||
      array.bytes > memory_.size() - array.begin - kFence) {
    bad_usage("an evaluator was given more samples than there is memory for");
  }
  unsigned char* const place = &memory_[array.begin];
  if (array.source != nullptr) {
    std::memcpy(place, array.source, array.bytes);
  } else {
    std::memset(place, kUnwritten, array.bytes);
  }
  std::fill(&memory_[used_], place, kFenceByte);
  std::fill_n(place + array.bytes, kFence, kFenceByte);
  used_ = end(array);
  arrays_.push_back(array);
  return array.begin;
}

std::string EvaluatorArrays::fault() const {
  const Array* before = nullptr;
  for (const Array& array : arrays_) {
    const std::size_t fence = before == nullptr ? array.begin - kFence : end(*before);
    const std::size_t changed = first_changed(fence, array.begin);
    if (changed != array.begin) {
      const bool behind = before != nullptr && changed - fence < kFence / 2;
      return behind ? std::string("wrote behind ") + before->name
                    : std::string("wrote before ") + array.name;
    }
    if (array.source != nullptr &&
        std::memcmp(&memory_[array.begin], array.source, array.bytes) != 0) {
      return std::string("changed ") + array.name;
    }
    before = &array;
  }
  const bool whole = before == nullptr ||
                     first_changed(end(*before), end(*before) + kFence) == end(*before) + kFence;
  return whole ? std::string() : std::string("wrote behind ") + before->name;
}

std::size_t EvaluatorArrays::first_changed(std::size_t begin, std::size_t end) const {
  const auto found = std::find_if(&memory_[begin], &memory_[end],
                                  [](unsigned char byte) { return byte != kFenceByte; });
  return begin + static_cast<std::size_t>(found - &memory_[begin]);
}

void EvaluatorArrays::copy_out() const {
  for (const Array& array : arrays_) {
    if (array.target != nullptr) {
      std::memcpy(array.target, &memory_[array.begin], array.bytes);
    }
  }
}

} // namespace simdbezier::tools
