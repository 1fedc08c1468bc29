// Where a mesh goes: pipes, and disks and devices that do not take it.
#include <gtest/gtest.h>

#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include <fcntl.h>

#include "tests/program/mesh_files/readers/mesh_readers.hpp"
#include "tests/program/mesh_files/sample_mesh.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::mesh_destinations_test {
namespace {

using tools::MeshFormat;

TEST(MeshOutput, MayBeAPipe) {
  const SampleMesh mesh = make_sample({.vertices = 3000, .faces = 5000, .normals = false}, true);
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::ply, MeshFormat::stl,
                                  MeshFormat::glb, MeshFormat::vtu, MeshFormat::raw}) {
    const TemporaryFolder folder;
    const std::string pipe = folder.path("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = read_file(pipe); });
    write_sample<float>(mesh, *tools::make_mesh_writer<float>(pipe, format, mesh.contents), 999);
    reader.join();
    EXPECT_TRUE(received == written<float>(mesh, format)) << received.size();
    EXPECT_EQ(folder.names(), std::vector<std::string>{"pipe"});
  }
}

const char* const kExtensions[] = {"obj", "ply", "stl", "glb", "vtu", "raw"};

TEST(MeshOutput, FailsOnAFullDevice) {
  for (const std::string extension : kExtensions) {
    const TemporaryFolder folder;
    const std::string out = folder.path("full." + extension);
    std::filesystem::create_symlink("/dev/full", out);
    expect_failure(run({"tessellate", "builtin:teapot", "-o", out}), 1,
                   "expected room to write, found 'No space left on device'");
  }
}

TEST(MeshOutput, FailsAtTheLargestFile) {
  for (const std::string extension : kExtensions) {
    for (const long limit : {1000L, 100000L, 200000L}) {
      const TemporaryFolder folder;
      const std::string out = folder.write("mesh." + extension, "before");
      expect_failure(run({"tessellate", "builtin:teapot", "-o", out}, {.file_size_limit = limit}),
                     1, out + ": expected room to write, found 'File too large'");
      EXPECT_EQ(read_file(out), "before");
      EXPECT_EQ(folder.names(), std::vector<std::string>{"mesh." + extension});
    }
  }
}

TEST(MeshOutput, FailsWhenThePipeIsClosed) {
  for (const std::string extension : kExtensions) {
    const TemporaryFolder folder;
    const std::string pipe = folder.path("pipe." + extension);
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::thread reader([&] {
      const int file = open(pipe.c_str(), O_RDONLY | O_CLOEXEC);
      char byte = 0;
      EXPECT_EQ(read(file, &byte, 1), 1);
      close(file);
    });
    const Outcome outcome = run({"tessellate", "builtin:teapot", "--grid", "32", "-o", pipe},
                                {.ignored_signals = {SIGPIPE}});
    reader.join();
    expect_failure(outcome, 1, pipe + ": expected room to write, found 'Broken pipe'");
  }
}

TEST(MeshOutput, IsNoInput) {
  const TemporaryFolder folder;
  const std::string net = read_file(std::string(SIMDBEZIER_TEST_DATA) + "/sample.bpt");
  for (const std::string extension : kExtensions) {
    const std::string in = folder.write("in." + extension, net);
    expect_failure(run({"tessellate", in, "--format", "bpt", "-o", in}), 1,
                   in + ": expected an output that is no input, found the file that " + in);
    EXPECT_EQ(read_file(in), net);
  }
}

// A file system of 256 KiB, if this user may make one.
class SmallDisk {
public:
  SmallDisk() { mounted_ = mount("tmpfs", folder_.path("").c_str(), "tmpfs", 0, "size=256k") == 0; }
  ~SmallDisk() {
    if (mounted_) {
      umount2(folder_.path("").c_str(), MNT_DETACH);
    }
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  [[nodiscard]] bool is_there() const { return mounted_; }
  [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

private:
  TemporaryFolder folder_;
  bool mounted_ = false;
};

TEST(MeshOutput, FailsOnASmallDisk) {
  const SmallDisk disk;
  if (!disk.is_there()) {
    GTEST_SKIP() << "this user may not mount a file system";
  }
  const TemporaryFolder& folder = disk.folder();
  struct Attempt {
    const char* extension;
    const char* grid;
    const char* expected;
  };
  // 12x12 is 560 KB of text that could be 210 KB, so that OBJ finds out while it writes.
  const Attempt attempts[] = {{"obj", "12", "room to write, found 'No space left on device'"},
                              {"obj", "24", "room for "},
                              {"ply", "24", "room for "},
                              {"stl", "24", "room for "},
                              {"glb", "24", "room for "},
                              {"vtu", "24", "room for "},
                              {"raw", "24", "room for "}};
  for (const Attempt& attempt : attempts) {
    const std::string name = std::string("mesh.") + attempt.extension;
    const std::string out = folder.write(name, "before");
    expect_failure(
        run({"tessellate", "builtin:teapot", "--no-weld", "--grid", attempt.grid, "-o", out}), 1,
        out + ": expected " + attempt.expected);
    EXPECT_EQ(read_file(out), "before");
    EXPECT_EQ(folder.names(), std::vector<std::string>{name});
    std::filesystem::remove(out);
  }
}

} // namespace
} // namespace simdbezier::tests::mesh_destinations_test
