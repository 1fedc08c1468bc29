// Bytes that are kept aside: more than memory should hold, and disks that do not take them.
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <random>
#include <vector>

#include <tools/process/failure.hpp>
#include <tools/process/spill_file.hpp>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests::spill_file_test {
namespace {

using tools::SpillFile;

constexpr std::uint64_t kBlock = 100003; // no multiple of a page
constexpr std::uint64_t kBlocks = 900;   // 86 MiB: a quarter of it is on the disk

char byte_at(std::uint64_t place) { return static_cast<char>(place * 0x9e3779b97f4a7c15U >> 56); }

void fill(SpillFile& file) {
  std::vector<char> block(kBlock);
  for (std::uint64_t k = 0; k < kBlocks; ++k) {
    for (std::uint64_t i = 0; i < kBlock; ++i) {
      block[i] = byte_at(k * kBlock + i);
    }
    file.append(block.data(), block.size());
  }
}

std::string failure_of(SpillFile& file) {
  try {
    fill(file);
  } catch (const tools::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), 1);
    return failure.what();
  }
  ADD_FAILURE() << "nothing failed";
  return "";
}

TEST(SpillFile, GivesBackWhatItGot) {
  const TemporaryFolder folder;
  SpillFile file(folder.path("out"));
  fill(file);
  ASSERT_EQ(file.size(), kBlock * kBlocks);
  std::mt19937_64 random(1);
  std::vector<char> bytes(70000); // more than a page
  for (int k = 0; k < 3000; ++k) {
    const std::size_t size = k % 100 == 0 ? bytes.size() : random() % 50;
    const std::uint64_t at = random() % (file.size() - size + 1);
    file.read(at, bytes.data(), size);
    for (std::size_t i = 0; i < size; ++i) {
      ASSERT_EQ(bytes[i], byte_at(at + i)) << "byte " << at + i;
    }
  }
  // What is appended after reading goes behind the rest.
  file.append("end", 3);
  file.read(file.size() - 4, bytes.data(), 4);
  EXPECT_EQ(std::string(bytes.data(), 4), byte_at(kBlock * kBlocks - 1) + std::string("end"));
  EXPECT_TRUE(folder.names().empty()) << "it has a name: " << folder.names().front();
}

TEST(SpillFile, NeedsAFolderOnlyWhenItSpills) {
  SpillFile file("/nonexistent/out");
  file.append("few", 3);
  EXPECT_EQ(failure_of(file),
            "/nonexistent: expected a folder for a temporary file, found 'No such file or "
            "directory'");
}

// It belongs where the output's temporary file is, which follows links.
TEST(SpillFile, LiesBesideTheFileThatALinkLeadsTo) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/nonexistent/out", folder.path("link"));
  SpillFile file(folder.path("link"));
  EXPECT_TRUE(failure_of(file).starts_with("/nonexistent: expected a folder"));
}

TEST(SpillFile, FailsWhereThereIsNoRoom) {
  const TemporaryFolder folder;
  rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit few = {1000000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &few);
  SpillFile file(folder.path("out"));
  const std::string found = failure_of(file);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(found.find(": expected room for a temporary file, found 'File too large'"),
            std::string::npos)
      << found;
}

} // namespace
} // namespace simdbezier::tests::spill_file_test
