#include <tools/formats/input/gunzip.hpp>

#include <algorithm>
#include <limits>
#include <new>
#include <string>

#include <zlib.h>

#include <tools/formats/input/byte_source.hpp>

namespace simdbezier::tools {

namespace {

// zlib's number for the largest window, and for gzip's header and check sum only.
constexpr int kGzipOnly = 15 + 16;

void expect_memory(int answer) {
  if (answer == Z_MEM_ERROR) {
    throw std::bad_alloc();
  }
}

} // namespace

Gunzip::Gunzip(std::string_view first)
    : packed_(std::max(first.size(), kRoom)), stream_(std::make_unique<z_stream>()) {
  std::ranges::copy(first, packed_.begin());
  expect_memory(inflateInit2(stream_.get(), kGzipOnly));
  fed(first.size());
}

Gunzip::~Gunzip() { inflateEnd(stream_.get()); }

void Gunzip::fed(std::size_t size) noexcept {
  stream_->next_in = reinterpret_cast<Bytef*>(packed_.data());
  stream_->avail_in = static_cast<uInt>(size);
}

std::size_t Gunzip::unpack(char* data, std::size_t size) {
  const auto room =
      static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
  stream_->next_out = reinterpret_cast<Bytef*>(data);
  stream_->avail_out = room;
  while (stream_->avail_out == room && (stream_->avail_in > 0 || has_more_)) {
    step();
  }
  return room - stream_->avail_out;
}

// Tapes and block devices fill their blocks so.
void Gunzip::pass_over_zeros() {
  for (; stream_->avail_in > 0 && *stream_->next_in == 0; ++stream_->next_in, --stream_->avail_in) {
    is_padded_ = true;
  }
  if (is_padded_ && stream_->avail_in > 0) {
    throw DamagedInput{"zeros up to the end behind compressed data", "something else"};
  }
}

void Gunzip::step() {
  if (is_complete_) {
    pass_over_zeros();
  }
  if (stream_->avail_in == 0 && is_padded_) {
    return;
  }
  if (is_complete_) { // another file follows
    expect_memory(inflateReset(stream_.get()));
    is_complete_ = false;
  }
  const uInt in = stream_->avail_in;
  const uInt out = stream_->avail_out;
  const int answer = inflate(stream_.get(), Z_NO_FLUSH);
  bytes_in_ += in - stream_->avail_in;
  bytes_out_ += out - stream_->avail_out;
  expect_memory(answer);
  if (answer != Z_OK && answer != Z_STREAM_END && answer != Z_BUF_ERROR) {
    const char* const what = stream_->msg == nullptr ? "something else" : stream_->msg;
    throw DamagedInput{"data that gzip has compressed", "'" + std::string(what) + "'"};
  }
  is_complete_ = answer == Z_STREAM_END;
  has_more_ = !is_complete_ && stream_->avail_out == 0;
  check_limit();
}

void Gunzip::check_limit() const {
  if (bytes_out_ > kAlwaysUnpacked + kMostTimes * bytes_in_) {
    throw DamagedInput{"compressed data that unpack to at most " + std::to_string(kMostTimes) +
                           " times their size and " + std::to_string(kAlwaysUnpacked) + " bytes",
                       std::to_string(bytes_out_) + " bytes from the first " +
                           std::to_string(bytes_in_)};
  }
}

void Gunzip::expect_end() const {
  if (!is_complete_) {
    throw DamagedInput{"the rest of the compressed data", "the end of the file"};
  }
}

} // namespace simdbezier::tools
