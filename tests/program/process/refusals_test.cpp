// What the system refuses: threads, the disk, owners, whole writes.
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests::refusals_test {
namespace {

using Names = std::vector<std::string>;
const Circumstances kThreadRefused = {.environment = {{"OMP_NUM_THREADS", "2"}},
                                      .fault = "thread_refused"};

TEST(Faults, RefusedThreadLeavesNothing) {
  const TemporaryFolder folder;
  const std::string old = folder.write("old.ply", "before");
  for (const std::string& out : {old, folder.path("new.ply"), folder.path("new.obj")}) {
    const Outcome outcome =
        run({"tessellate", "builtin:teapot", "--grid", "64", "-o", out}, kThreadRefused);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err, "") << "no thread was refused";
  }
  EXPECT_EQ(read_file(old), "before");
  EXPECT_EQ(folder.names(), Names{"old.ply"});
}

TEST(Faults, OneThreadStartsNone) {
  const TemporaryFolder folder;
  const std::string samples = folder.write("samples.csv", "patch,u,v\n0,0.5,0.5\n31,0,1\n");
  const std::vector<std::vector<std::string>> commands = {
      {"tessellate", "builtin:teapot", "--grid", "64", "-o", folder.path("out.ply")},
      {"evaluate", "builtin:teapot", "--grid", "64", "-o", folder.path("out.csv")},
      {"evaluate", "builtin:teapot", "--samples", samples, "-o", folder.path("out.csv")}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.end(), {"--threads", "1"});
    expect_silent_success(run(command, kThreadRefused));
  }
}

// Every call of the library; the program says which one it was at.
TEST(Faults, NoCallStartsAThreadForOne) {
  const std::string preload = std::string("LD_PRELOAD=") + SIMDBEZIER_FAULT_LIBRARY +
                              " ASAN_OPTIONS=verify_asan_link_order=0 OMP_NUM_THREADS=2"
                              " SIMDBEZIER_TEST_FAULT=thread_refused ";
  const std::string program = SIMDBEZIER_THREADS_ONE;
  EXPECT_EQ(std::system((preload + program + " 1").c_str()), 0);
  // And the refusal is real: the same calls on two threads end the process.
  EXPECT_NE(std::system((preload + program + " 2 2>/dev/null").c_str()), 0);
}

TEST(Faults, SyncThatFailsIsAFailedWrite) {
  const TemporaryFolder folder;
  const std::string old = folder.write("old.csv", "before");
  expect_failure(run({"evaluate", "builtin:teapot", "-o", old}, {.fault = "sync_fails"}), 1,
                 old + ": expected room to write, found 'Input/output error'");
  EXPECT_EQ(read_file(old), "before");
  EXPECT_EQ(folder.names(), Names{"old.csv"});
}

// A folder whose sticky bit lets nobody replace the files of others refuses like this.
TEST(Faults, RefusedRenamingIsNoLackOfRoom) {
  const TemporaryFolder folder;
  const std::string old = folder.write("old.csv", "before");
  for (const std::string& out : {old, folder.path("new.csv")}) {
    expect_failure(run({"evaluate", "builtin:teapot", "-o", out}, {.fault = "rename_refused"}), 1,
                   out + ": expected a place that the finished file can be moved to, found "
                         "'Operation not permitted'");
  }
  EXPECT_EQ(read_file(old), "before");
  EXPECT_EQ(folder.names(), Names{"old.csv"});
}

TEST(Faults, FileSystemsWithoutSyncWillDo) {
  const TemporaryFolder folder;
  expect_silent_success(run({"evaluate", "builtin:teapot", "-o", folder.path("out.csv")},
                            {.fault = "sync_unsupported"}));
  EXPECT_EQ(folder.names(), Names{"out.csv"});
}

TEST(Faults, ShortWritesAreGoneOnWith) {
  const TemporaryFolder folder;
  for (const std::string out : {"out.ply", "out.obj"}) {
    expect_silent_success(
        run({"tessellate", "builtin:teapot", "-o", folder.path(out)}, {.fault = "short_writes"}));
    expect_silent_success(run({"tessellate", "builtin:teapot", "-o", folder.path("right-" + out)}));
    EXPECT_TRUE(read_file(folder.path(out)) == read_file(folder.path("right-" + out)));
  }
}

// A file that cannot be given to its group must not let another one in.
TEST(Faults, RefusedOwnerKeepsOtherGroupsOut) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.csv", "before");
  ASSERT_EQ(chmod(out.c_str(), 0664), 0);
  expect_silent_success(run({"evaluate", "builtin:teapot", "-o", out}, {.fault = "owner_refused"}));
  struct stat after = {};
  ASSERT_EQ(stat(out.c_str(), &after), 0);
  EXPECT_EQ(after.st_mode & 07777, 0644U);
}

// A file that may be written, in a folder that takes no other file: it is the folder that is named.
TEST(Refusals, OfAFolderAreNotThoseOfTheFile) {
  const TemporaryFolder folder;
  const std::string old = folder.write("out.csv", "before");
  expect_failure(run({"evaluate", "builtin:teapot", "-o", old}, {.fault = "folder_refuses"}), 1,
                 old + ": expected a folder where a temporary file can stand beside it, found "
                       "'Permission denied'");
  EXPECT_EQ(read_file(old), "before");
  const std::string absent = folder.path("absent.csv");
  expect_failure(run({"evaluate", "builtin:teapot", "-o", absent}, {.fault = "folder_refuses"}), 1,
                 absent + ": expected a writable file, found 'Permission denied'");
}

} // namespace
} // namespace simdbezier::tests::refusals_test
