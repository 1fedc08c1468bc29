// One file that all ranks write, by MPI-IO.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <mpi.h>

#include <tools/mpi/ranks.hpp>
#include <tools/process/temporary_file.hpp>

namespace simdbezier::tools {

/// The file has its name when all ranks have written all of it, and it is on the disk. Until then
/// it is `.NAME.simdbezier-mpi.tmp` in the same folder. What is left there by a run that was killed
/// is removed by the next one for the same file.
class RankFile {
public:
  /// Collective, as finish(). Throws Failure on all ranks where one of them cannot open it.
  RankFile(const Ranks& ranks, MPI_Comm communicator, std::string path, std::uint64_t bytes);
  ~RankFile();
  RankFile(const RankFile&) = delete;
  RankFile& operator=(const RankFile&) = delete;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// Where the file is until it has its name.
  [[nodiscard]] std::string temporary_path() const { return folder_name_ + "/" + temporary_; }
  /// Writes bytes of this rank. Throws Failure.
  void write(std::uint64_t at, std::span<const std::byte> bytes);
  [[nodiscard]] std::uint64_t written() const noexcept { return written_; }
  /// Brings everything to the disk, closes it, and gives it its name.
  void finish();

private:
  void expect(int code, const char* what) const;
  void close();
  void remove();

  const Ranks& ranks_;
  std::string path_;
  std::string folder_name_;
  std::string temporary_;
  Descriptor folder_; // on the first rank
  MPI_File file_ = MPI_FILE_NULL;
  std::uint64_t written_ = 0;
};

} // namespace simdbezier::tools
