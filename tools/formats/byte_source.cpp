#include <tools/formats/byte_source.hpp>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include <sys/stat.h>

#include <tools/formats/gunzip.hpp>
#include <tools/formats/text_input.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/progress.hpp>

namespace simdbezier::tools {

void ByteSource::Close::operator()(std::FILE* file) const noexcept {
  if (file != stdin) {
    std::fclose(file);
  }
}

ByteSource::ByteSource(const std::string& path) {
  if (path == "-") {
    file_.reset(stdin);
    return;
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    bad_input(path + ": expected a file, found a directory");
  }
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) {
    bad_input(path + ": expected a readable file, found " + in_quotes(std::strerror(errno)));
  }
}

ByteSource::~ByteSource() = default;

std::uint64_t ByteSource::stored_size() const {
  struct stat status = {};
  const bool known = fstat(fileno(file_.get()), &status) == 0 && S_ISREG(status.st_mode);
  return known ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::size_t ByteSource::read_stored(char* data, std::size_t size) {
  const std::size_t read = std::fread(data, 1, size, file_.get());
  if (read == 0 && std::ferror(file_.get()) != 0) {
    throw DamagedInput{"readable text", in_quotes(std::strerror(errno))};
  }
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

} // namespace simdbezier::tools
