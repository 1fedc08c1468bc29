// Output appears complete or not at all, and nothing that was there before is harmed.
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::output_file_test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr const char* kOld = "what was there before";

// A file that fails only after the output has been begun.
std::string late_failure(const TemporaryFolder& folder) {
  std::string text = "patch,u,v\n";
  for (int k = 0; k < 200000; ++k) {
    text += "0,0.5,0.5\n";
  }
  return folder.write("samples.csv", text + "0,0.5,nan\n");
}

TEST(OutputFile, IsReplacedOnSuccessOnly) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.obj", kOld);
  fs::permissions(out, fs::perms::owner_read | fs::perms::owner_write);
  expect_failure(run({"tessellate", folder.path("absent.bez"), "-o", out}), 1, "absent.bez");
  EXPECT_EQ(read_file(out), kOld);
  expect_silent_success(run({"tessellate", "builtin:teapot", "-o", out}));
  EXPECT_NE(read_file(out), kOld);
  EXPECT_EQ(fs::status(out).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(folder.names(), Names{"out.obj"});
}

TEST(OutputFile, SurvivesAFailureHalfWay) {
  const TemporaryFolder folder;
  const std::string samples = late_failure(folder);
  const std::string old = folder.write("old.csv", kOld);
  for (const std::string& out : {old, folder.path("new.csv")}) {
    expect_failure(run({"evaluate", "builtin:teapot", "--samples", samples, "-o", out}), 1,
                   samples + ":200002: expected a finite number, found 'nan'");
  }
  EXPECT_EQ(read_file(old), kOld);
  EXPECT_EQ(folder.names(), (Names{"old.csv", "samples.csv"}));
}

TEST(OutputFile, SurvivesAFullDisk) {
  for (const std::string extension : {"obj", "ply"}) {
    const TemporaryFolder folder;
    const std::string old = folder.write("old." + extension, kOld);
    for (const std::string& out : {old, folder.path("new." + extension)}) {
      expect_failure(run({"tessellate", "builtin:teapot", "-o", out}, {.file_size_limit = 5000}), 1,
                     "simdbezier: " + out + ": expected room to write");
    }
    EXPECT_EQ(read_file(old), kOld);
    EXPECT_EQ(folder.names(), Names{"old." + extension});
  }
}

TEST(OutputFile, ThatCannotFitIsRefusedAtOnce) {
  const TemporaryFolder folder;
  const std::uintmax_t free = fs::space(folder.path("")).available;
  if (free >= 219009143328U) {
    GTEST_SKIP() << "too much free space to exceed with an allowed grid";
  }
  expect_failure(run({"tessellate", "builtin:teapot", "--no-weld", "--grid", "11585", "-o",
                      folder.path("out.obj")}),
                 1, "expected room for 219009143328 bytes or more");
  EXPECT_TRUE(folder.names().empty());
}

TEST(OutputFile, MustBeWritable) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("folder.obj"));
  folder.write("file", "");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {folder.path("absent/out.obj"), "found 'No such file or directory'"},
      {folder.path("file/out.obj"), "found 'Not a directory'"},
      {folder.path("folder.obj"), "expected a file, found a directory"}};
  for (const auto& [out, message] : cases) {
    expect_failure(run({"tessellate", "builtin:teapot", "-o", out}), 1, message);
    expect_failure(run({"tessellate", "builtin:teapot", "-o", out}), 1, "simdbezier: " + out + ":");
  }
  EXPECT_EQ(folder.names(), (Names{"file", "folder.obj"}));
}

TEST(OutputFile, KeepsReadOnlyFiles) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.obj", kOld);
  fs::permissions(out, fs::perms::owner_read);
  if (FILE* const file = std::fopen(out.c_str(), "ab"); file != nullptr) {
    std::fclose(file);
    GTEST_SKIP() << "this user may write read-only files";
  }
  expect_failure(run({"tessellate", "builtin:teapot", "-o", out}), 1, "found 'Permission denied'");
  EXPECT_EQ(read_file(out), kOld);
}

TEST(OutputFile, FollowsLinks) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("deep"));
  const std::string existing = folder.write("deep/existing.obj", kOld);
  fs::create_symlink("deep/existing.obj", folder.path("existing.obj"));
  fs::create_symlink("deep/absent.obj", folder.path("absent.obj"));
  for (const char* const name : {"existing.obj", "absent.obj"}) {
    expect_silent_success(run({"tessellate", "builtin:teapot", "-o", folder.path(name)}));
    EXPECT_TRUE(fs::is_symlink(folder.path(name)));
  }
  EXPECT_NE(read_file(existing), kOld);
  EXPECT_EQ(read_file(existing), read_file(folder.path("deep/absent.obj")));
}

TEST(OutputFile, RefusesLinksWithoutEnd) {
  const TemporaryFolder folder;
  fs::create_symlink("b.obj", folder.path("a.obj"));
  fs::create_symlink("a.obj", folder.path("b.obj"));
  fs::create_symlink("self.obj", folder.path("self.obj"));
  for (const std::string name : {"a.obj", "b.obj", "self.obj"}) {
    expect_failure(run({"tessellate", "builtin:teapot", "-o", folder.path(name)}), 1,
                   folder.path(name) +
                       ": expected a writable file, found 'Too many levels of symbolic links'");
    EXPECT_TRUE(fs::is_symlink(folder.path(name)));
  }
  EXPECT_EQ(folder.names(), (Names{"a.obj", "b.obj", "self.obj"}));
}

// The name gets the new file; other names of the old one keep the old one.
TEST(OutputFile, LeavesOtherHardLinksAlone) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.obj", kOld);
  fs::create_hard_link(out, folder.path("other.obj"));
  expect_silent_success(run({"tessellate", "builtin:teapot", "-o", out}));
  EXPECT_NE(read_file(out), kOld);
  EXPECT_EQ(read_file(folder.path("other.obj")), kOld);
}

TEST(OutputFile, KeepsModeButNotWhatRunsAsItsOwner) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.obj", kOld);
  for (const auto& [before, after] : std::vector<std::pair<mode_t, mode_t>>{{0600, 0600},
                                                                            {0640, 0640},
                                                                            {0666, 0666},
                                                                            {0755, 0755},
                                                                            {04755, 0755},
                                                                            {02775, 0775},
                                                                            {01777, 0777}}) {
    ASSERT_EQ(chmod(out.c_str(), before), 0);
    expect_silent_success(run({"tessellate", "builtin:teapot", "-o", out}));
    struct stat status = {};
    ASSERT_EQ(stat(out.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, after);
  }
}

TEST(OutputFile, KeepsOwnerAndGroup) {
  const TemporaryFolder folder;
  const std::string out = folder.write("out.obj", kOld);
  if (chown(out.c_str(), 12345, 23456) != 0) {
    GTEST_SKIP() << "this user may not give files away";
  }
  expect_silent_success(run({"tessellate", "builtin:teapot", "-o", out}));
  struct stat status = {};
  ASSERT_EQ(stat(out.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, 12345U);
  EXPECT_EQ(status.st_gid, 23456U);
}

// The same file under any of its names.
TEST(OutputFile, IsNoInput) {
  const TemporaryFolder folder;
  const std::string samples = folder.write("s.csv", "patch,u,v\n0,0.5,0.5\n");
  fs::create_symlink("s.csv", folder.path("link.csv"));
  fs::create_hard_link(samples, folder.path("hard.csv"));
  const std::string model = folder.write("m.obj", read_file(sample_path("obj")));
  fs::create_symlink("m.obj", folder.path("link.obj"));
  const std::string expected = ": expected an output that is no input, found the file that ";
  fs::create_directory(folder.path("deep"));
  for (const std::string out : {"s.csv", "link.csv", "hard.csv", "deep/../s.csv"}) {
    expect_failure(
        run({"evaluate", "builtin:teapot", "--samples", samples, "-o", folder.path(out)}), 1,
        folder.path(out) + expected + samples + " is read from");
    expect_failure(run({"evaluate", "builtin:teapot", "--samples", "-", "-o", folder.path(out)},
                       {.input_path = samples}),
                   1, folder.path(out) + expected + "standard input is read from");
  }
  for (const std::string out : {"m.obj", "link.obj"}) {
    expect_failure(run({"tessellate", model, "-o", folder.path(out)}), 1, expected + model);
  }
  expect_failure(run({"evaluate", "builtin:teapot", "--samples", samples, "-o", "-"},
                     {.append_path = samples}),
                 1, "standard output" + expected + samples);
  expect_failure(run({"info", model}, {.append_path = model}), 1,
                 "standard output" + expected + model);
  expect_failure(run({"tessellate", model, "--stats=json", "-o", folder.path("out.ply")},
                     {.append_path = model}),
                 1, "standard output" + expected + model);
  EXPECT_EQ(read_file(samples), "patch,u,v\n0,0.5,0.5\n");
  EXPECT_EQ(read_file(model), read_file(sample_path("obj")));
  // Devices may well be both.
  expect_failure(run({"info", "/dev/null", "--format", "bez"}, {.append_path = "/dev/null"}), 1,
                 "expected the number of patches");
}

TEST(OutputFile, MayBeADevice) {
  const TemporaryFolder folder;
  fs::create_symlink("/dev/full", folder.path("full.obj"));
  fs::create_symlink("/dev/null", folder.path("null.ply"));
  expect_failure(run({"tessellate", "builtin:teapot", "-o", folder.path("full.obj")}), 1,
                 "expected room to write, found 'No space left on device'");
  expect_failure(run({"evaluate", "builtin:teapot", "-o", "/dev/full"}), 1, "/dev/full: expected");
  expect_silent_success(run({"tessellate", "builtin:teapot", "-o", folder.path("null.ply")}));
  expect_silent_success(run({"evaluate", "builtin:teapot", "-o", "/dev/null"}));
  EXPECT_EQ(folder.names(), (Names{"full.obj", "null.ply"}));
  EXPECT_TRUE(fs::is_character_file("/dev/null")) << "the device itself was replaced";
}

TEST(OutputFile, DevStdoutIsStandardOutput) {
  const Outcome dash = run({"evaluate", "builtin:teapot", "-o", "-"});
  const Outcome device = run({"evaluate", "builtin:teapot", "-o", "/dev/stdout"});
  EXPECT_EQ(dash.exit_code, 0);
  EXPECT_EQ(device.exit_code, 0);
  EXPECT_GT(dash.out.size(), 100000U);
  EXPECT_EQ(dash.out, device.out);
  EXPECT_EQ(dash.err + device.err, "");
}

TEST(OutputFile, GoesAwayWhenTheProgramIsTerminated) {
  const TemporaryFolder folder;
  Program program({"evaluate", "builtin:teapot", "--samples", "-", "-o", folder.path("out.csv")});
  std::string samples = "patch,u,v\n";
  for (int k = 0; k < 10000; ++k) {
    samples += "0,0.5,0.5\n";
  }
  program.feed(samples); // standard input stays open, so the program waits for more
  for (int k = 0; k < 1000 && folder.names().empty(); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_EQ(folder.names().size(), 1U) << "the output was never begun";
  ASSERT_NE(folder.names().front(), "out.csv") << "not a temporary file";
  kill(program.id(), SIGTERM);
  EXPECT_EQ(program.finish().signal, SIGTERM);
  EXPECT_TRUE(folder.names().empty()) << folder.names().front() << " was left behind";
}

} // namespace
} // namespace simdbezier::tests::output_file_test
