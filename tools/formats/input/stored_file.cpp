// Files and standard input as stored bytes.
#include <tools/formats/input/byte_source.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <sys/mman.h>
#include <sys/stat.h>

#include <tools/process/failure.hpp>

namespace simdbezier::tools {

namespace {

struct Close {
  void operator()(std::FILE* file) const noexcept {
    if (file != stdin) {
      std::fclose(file);
    }
  }
};

class StoredFile final : public StoredBytes {
public:
  explicit StoredFile(std::FILE* file) : file_(file) {}

  [[nodiscard]] std::size_t read(char* data, std::size_t size) override {
    const std::size_t read = std::fread(data, 1, size, file_.get());
    if (read == 0 && std::ferror(file_.get()) != 0) {
      throw DamagedInput{"readable text", in_quotes(std::strerror(errno))};
    }
    return read;
  }
  // The whole file is mapped, which takes address space only. Changes stay in memory.
  [[nodiscard]] std::shared_ptr<std::byte[]> map(std::size_t size) override {
    const std::size_t all = this->size();
    const off_t at = all > 0 ? ftello(file_.get()) : -1;
    if (at < 0 || all < size || static_cast<std::size_t>(at) > all - size) {
      return nullptr;
    }
    if (map_ == nullptr) {
      void* const map = mmap(nullptr, all, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE,
                             fileno(file_.get()), 0);
      if (map == MAP_FAILED) {
        return nullptr;
      }
      map_.reset(static_cast<std::byte*>(map), [all](std::byte* m) { munmap(m, all); });
    }
    if (fseeko(file_.get(), static_cast<off_t>(size), SEEK_CUR) != 0) {
      return nullptr;
    }
    return {map_, map_.get() + at};
  }
  [[nodiscard]] std::uint64_t size() const override {
    struct stat status = {};
    const bool known = fstat(fileno(file_.get()), &status) == 0 && S_ISREG(status.st_mode);
    return known ? static_cast<std::uint64_t>(status.st_size) : 0;
  }

private:
  std::unique_ptr<std::FILE, Close> file_;
  std::shared_ptr<std::byte[]> map_;
};

} // namespace

std::unique_ptr<StoredBytes> open_file(const std::string& path) {
  if (path == "-") {
    return std::make_unique<StoredFile>(stdin);
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    bad_input(path + ": expected a file, found a directory");
  }
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) {
    bad_input(path + ": expected a readable file, found " + in_quotes(std::strerror(errno)));
  }
  return std::make_unique<StoredFile>(file);
}

} // namespace simdbezier::tools
