#include <tools/formats/input/byte_source.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

#include <tools/formats/input/gunzip.hpp>
#include <tools/process/progress.hpp>

namespace simdbezier::tools {

namespace {

class BytesInMemory final : public StoredBytes {
public:
  explicit BytesInMemory(std::span<const char> bytes) : rest_(bytes), size_(bytes.size()) {}

  [[nodiscard]] std::size_t read(char* data, std::size_t size) override {
    const std::span<const char> next = rest_.first(std::min(size, rest_.size()));
    std::ranges::copy(next, data);
    rest_ = rest_.subspan(next.size());
    return next.size();
  }
  [[nodiscard]] std::uint64_t size() const override { return size_; }

private:
  std::span<const char> rest_;
  std::size_t size_;
};

} // namespace

ByteSource::ByteSource(const std::string& path) : stored_(open_file(path)) {}
ByteSource::ByteSource(std::span<const char> memory)
    : stored_(std::make_unique<BytesInMemory>(memory)) {}

ByteSource::~ByteSource() = default;

std::size_t ByteSource::read_stored(char* data, std::size_t size) {
  const std::size_t read = stored_->read(data, size);
  if (progress_ != nullptr) {
    progress_->advance(read);
  }
  return read;
}

std::size_t ByteSource::read(char* data, std::size_t size) {
  if (!gunzip_) {
    const std::size_t read = read_stored(data, size);
    if (!std::exchange(at_start_, false) ||
        !std::string_view(data, read).starts_with(Gunzip::kMagic)) {
      return read;
    }
    gunzip_ = std::make_unique<Gunzip>(std::string_view(data, read));
  }
  for (;;) {
    if (const std::size_t unpacked = gunzip_->unpack(data, size); unpacked > 0) {
      return unpacked;
    }
    const std::size_t read = read_stored(gunzip_->room(), Gunzip::kRoom);
    if (read == 0) {
      gunzip_->expect_end();
      return 0;
    }
    gunzip_->fed(read);
  }
}

std::shared_ptr<std::byte[]> ByteSource::take(std::size_t size) {
  std::shared_ptr<std::byte[]> bytes = gunzip_ ? nullptr : stored_->map(size);
  if (bytes != nullptr) {
    if (progress_ != nullptr) {
      progress_->advance(size);
    }
    return bytes;
  }
  bytes.reset(new std::byte[size]);
  for (std::size_t found = 0; found < size;) {
    const std::size_t more = read(reinterpret_cast<char*>(bytes.get()) + found, size - found);
    if (more == 0) {
      return nullptr;
    }
    found += more;
  }
  return bytes;
}

} // namespace simdbezier::tools
