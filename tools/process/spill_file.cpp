#include <tools/process/spill_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

#include <tools/process/failure.hpp>
#include <tools/process/interruption.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

std::string folder_for(const std::string& output) {
  if (is_written_directly(output)) {
    std::error_code none;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(none);
    return none ? "/tmp" : folder.string();
  }
  return folder_of(output);
}

// Calls f(place, rest) until nothing is left: the system may take or give a part.
template <typename F>
bool in_parts(std::size_t size, F&& f) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t part = f(done, size - done);
    if (part == 0) {
      errno = ENOSPC;
    }
    if (part == 0 || (part < 0 && errno != EINTR)) {
      return false;
    }
    done += part > 0 ? static_cast<std::size_t>(part) : 0;
  }
  return true;
}

} // namespace

SpillFile::SpillFile(const std::string& output)
    : folder_(folder_for(output)), pages_(kPagesInMemory) {}

void SpillFile::fail(const std::string& what, int error) const {
  bad_input(folder_ + ": expected " + what + ", found " + in_quotes(std::strerror(error)));
}

template <typename Copy>
void SpillFile::for_pages(std::uint64_t at, std::size_t size, Copy&& copy) {
  for (std::size_t done = 0; done < size;) {
    const auto offset = static_cast<std::size_t>((at + done) % kPageSize);
    const std::size_t part = std::min(size - done, kPageSize - offset);
    copy(page((at + done) / kPageSize), offset, done, part);
    done += part;
  }
}

void SpillFile::append(const void* data, std::size_t size) {
  for_pages(size_, size, [&](Page& to, std::size_t offset, std::size_t done, std::size_t part) {
    std::memcpy(to.bytes.get() + offset, static_cast<const char*>(data) + done, part);
    to.changed = true;
  });
  size_ += size;
}

void SpillFile::read(std::uint64_t at, void* data, std::size_t size) {
  for_pages(at, size,
            [&](const Page& from, std::size_t offset, std::size_t done, std::size_t part) {
              std::memcpy(static_cast<char*>(data) + done, from.bytes.get() + offset, part);
            });
}

SpillFile::Page& SpillFile::page(std::uint64_t number) {
  Page& page = pages_[number % kPagesInMemory];
  if (page.bytes && page.number == number) {
    return page;
  }
  if (page.bytes) {
    store(page);
  } else {
    page.bytes = std::make_unique<char[]>(kPageSize);
  }
  page.number = number;
  if (number < pages_made_) {
    load(page);
  }
  pages_made_ = std::max(pages_made_, number + 1);
  return page;
}

void SpillFile::store(Page& page) {
  if (!page.changed) {
    return;
  }
  open();
  const bool stored = in_parts(kPageSize, [&](std::size_t done, std::size_t rest) {
    return pwrite(file_.number(), page.bytes.get() + done, rest,
                  static_cast<off_t>(page.number * kPageSize + done));
  });
  if (!stored) {
    fail("room for a temporary file", errno);
  }
  page.changed = false;
}

void SpillFile::load(Page& page) {
  const bool loaded = in_parts(kPageSize, [&](std::size_t done, std::size_t rest) {
    return pread(file_.number(), page.bytes.get() + done, rest,
                 static_cast<off_t>(page.number * kPageSize + done));
  });
  if (!loaded) {
    fail("to read a temporary file", errno);
  }
}

void SpillFile::open() {
  if (file_.is_open()) {
    return;
  }
  file_ = Descriptor(::open(folder_.c_str(), O_TMPFILE | O_RDWR | O_EXCL | O_CLOEXEC, 0600));
  if (!file_.is_open()) { // not every file system can do without a name
    std::string name = folder_ + "/.simdbezier-XXXXXX";
    begin_creation(); // which a signal waits for, until the name is gone
    file_ = Descriptor(mkostemp(name.data(), O_CLOEXEC));
    const int error = errno;
    if (file_.is_open()) {
      unlink(name.c_str());
    }
    end_creation();
    if (!file_.is_open()) {
      fail("a folder for a temporary file", error);
    }
  }
}

} // namespace simdbezier::tools
