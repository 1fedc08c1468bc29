#include <tools/mpi/rank_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <tools/process/interruption.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

RankFile::RankFile(const Ranks& ranks, MPI_Comm communicator, std::string path, std::uint64_t bytes)
    : ranks_(ranks), path_(std::move(path)), folder_name_(folder_of(path_)) {
  const std::size_t slash = path_.find_last_of('/');
  const std::string name = slash == std::string::npos ? path_ : path_.substr(slash + 1);
  temporary_ = "." + name + ".simdbezier-mpi.tmp";
  ranks_.together([&] {
    if (!ranks_.is_first()) {
      return;
    }
    folder_ = Descriptor(open(folder_name_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    struct stat target = {};
    if (!folder_.is_open() || (stat(path_.c_str(), &target) == 0 && !S_ISREG(target.st_mode)) ||
        (target.st_mode != 0 && access(path_.c_str(), W_OK) != 0)) {
      bad_input(path_ + ": expected a writable file, found " +
                in_quotes(folder_.is_open() && S_ISDIR(target.st_mode) ? "Is a directory"
                                                                       : std::strerror(errno)));
    }
    static_cast<void>(
        unlinkat(folder_.number(), temporary_.c_str(), 0)); // of a run that was killed
    struct statvfs space = {};
    if (fstatvfs(folder_.number(), &space) == 0 &&
        bytes / std::max<std::uint64_t>(space.f_frsize, 1) >= space.f_bavail) {
      bad_input(path_ + ": expected room for " + std::to_string(bytes) + " bytes or more, found " +
                std::to_string(std::uint64_t{space.f_bavail} * space.f_frsize));
    }
    static_cast<void>(remember_temporary(folder_.number(), temporary_));
  });
  const int opened = MPI_File_open(communicator, temporary_path().c_str(),
                                   MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &file_);
  try {
    ranks_.together([&] { expect(opened, "a writable file"); });
    const int sized = MPI_File_set_size(file_, static_cast<MPI_Offset>(bytes));
    ranks_.together([&] { expect(sized, "room to write"); });
  } catch (...) {
    remove();
    throw;
  }
}

RankFile::~RankFile() {
  // All ranks come here together, since they fail together.
  if (!temporary_.empty()) {
    remove();
  }
}

void RankFile::expect(int code, const char* what) const {
  if (code == MPI_SUCCESS) {
    return;
  }
  std::array<char, MPI_MAX_ERROR_STRING> text;
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  bad_input(path_ + ": expected " + what + ", found " +
            in_quotes(std::string(text.data(), static_cast<std::size_t>(length))));
}

void RankFile::write(std::uint64_t at, std::span<const std::byte> bytes) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 28; // MPI counts in int
  while (!bytes.empty()) {
    const auto piece = bytes.first(std::min(kAtOnce, bytes.size()));
    MPI_Status status;
    expect(MPI_File_write_at(file_, static_cast<MPI_Offset>(at), piece.data(),
                             static_cast<int>(piece.size()), MPI_BYTE, &status),
           "room to write");
    int done = 0;
    MPI_Get_count(&status, MPI_BYTE, &done);
    if (done != static_cast<int>(piece.size())) {
      bad_input(path_ + ": expected room to write, found " + in_quotes(std::strerror(ENOSPC)));
    }
    written_ += piece.size();
    at += piece.size();
    bytes = bytes.subspan(piece.size());
  }
}

void RankFile::close() {
  if (file_ != MPI_FILE_NULL) {
    MPI_File_close(&file_);
  }
}

void RankFile::remove() {
  close();
  if (ranks_.is_first() && folder_.is_open()) {
    unlinkat(folder_.number(), temporary_.c_str(), 0);
    forget_temporary(temporary_);
  }
  temporary_.clear();
}

void RankFile::finish() {
  const int synced = MPI_File_sync(file_);
  const int closed = MPI_File_close(&file_);
  ranks_.together([&] {
    expect(synced, "room to write");
    expect(closed, "room to write");
  });
  ranks_.together([&] {
    if (!ranks_.is_first()) {
      return;
    }
    if (renameat(folder_.number(), temporary_.c_str(), AT_FDCWD, path_.c_str()) != 0) {
      bad_input(path_ + ": expected a place that the finished file can be moved to, found " +
                in_quotes(std::strerror(errno)));
    }
    forget_temporary(temporary_);
    static_cast<void>(fsync(folder_.number()));
  });
  temporary_.clear();
}

} // namespace simdbezier::tools
