// Meshes by many processes have the bytes of the program's, whichever ranks made what.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <sys/wait.h>

#include "tests/program/parts/part_models.hpp"
#include "tests/program/process/program.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::mpi_test {
namespace {

class Mpi : public ::testing::Test {
protected:
  void SetUp() override {
#ifndef SIMDBEZIER_MPI_PROGRAM
    GTEST_SKIP() << "simdbezier-mpi is not built";
#endif
  }

  struct Answer {
    int exit_code;
    std::string out;
    std::string err;
  };
  // Runs so many ranks, which may be more than there are cores.
  Answer run_ranks(int ranks, const std::string& words, int threads = 1) const {
    std::string command;
#ifdef SIMDBEZIER_MPI_PROGRAM
    command = "OMP_NUM_THREADS=" + std::to_string(threads) +
              " OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"
              " OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none"
              " OMPI_MCA_btl_vader_single_copy_mechanism=none TMPDIR=/tmp " SIMDBEZIER_MPIEXEC
              " -n " +
              std::to_string(ranks) + " " SIMDBEZIER_MPI_PROGRAM " " + words + " > '" +
              folder_.path("out") + "' 2> '" + folder_.path("err") + "' < /dev/null";
#else
    static_cast<void>(ranks);
    static_cast<void>(words);
    static_cast<void>(threads);
#endif
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder_.path("out")),
            read_file(folder_.path("err"))};
  }
  [[nodiscard]] bool has_leftovers() const {
    for (const std::string& name : folder_.names()) {
      if (name.find(".tmp") != std::string::npos) {
        return true;
      }
    }
    return false;
  }

  TemporaryFolder folder_;
};

struct Case {
  const char* extension;
  const char* options;
};
constexpr Case kCases[] = {{"ply", "--relative 1e-2"},
                           {"stl", "--grid 3"},
                           {"ply", "--tolerance 0.05 --precision f64 --crease 30"},
                           {"ply", "--grid 4x3 --quads --parameters"},
                           {"stl", "--no-weld --grid 3"},
                           {"ply", "--no-weld --grid 3 --flip"},
                           {"stl", "--grid 2 --precision f64"}};

TEST_F(Mpi, any_number_of_ranks_makes_the_same_bytes) {
  constexpr int kRanks[] = {1, 2, 3, 5, 7};
  constexpr int kPatches[] = {65536, 9, 2};
  std::size_t number = 0;
  for (const PartModel& model : part_models(folder_)) {
    for (const Case& item : kCases) {
      const std::string options = item.options;
      const std::string whole = folder_.path(std::string("whole.") + item.extension);
      const std::string program = std::string(SIMDBEZIER_PROGRAM) + " tessellate '" + model.path +
                                  "' -o '" + whole + "' " + options;
      ASSERT_EQ(std::system(program.c_str()), 0) << program;
      for (const int ranks : kRanks) {
        for (const int patches : kPatches) {
          if (!in_form(number++, 31)) {
            continue;
          }
          SCOPED_TRACE(model.name + " " + options + ", " + std::to_string(ranks) + " ranks, " +
                       std::to_string(patches) + " patches at a time");
          const std::string out = folder_.path(std::string("ranks.") + item.extension);
          const Answer answer =
              run_ranks(ranks,
                        "tessellate '" + model.path + "' -o '" + out + "' " + options +
                            " --shard-patches " + std::to_string(patches),
                        1 + static_cast<int>(number % 2));
          EXPECT_EQ(answer.exit_code, 0) << answer.err;
          EXPECT_EQ(answer.out, "");
          EXPECT_TRUE(read_file(whole) == read_file(out));
          EXPECT_FALSE(has_leftovers());
          std::filesystem::remove(out);
        }
      }
    }
  }
}

TEST_F(Mpi, binary_patches_are_read_by_ranges) {
  const std::string in = folder_.write("in.bez", gluings_as_bez(7, 200));
  expect_silent_success(run({"convert", in, "-o", folder_.path("in.sbp")}));
  expect_silent_success(run({"tessellate", in, "-o", folder_.path("whole.ply"), "--grid", "3"}));
  const Answer answer =
      run_ranks(3, "tessellate " + folder_.path("in.sbp") + " -o " + folder_.path("ranks.ply") +
                       " --grid 3 --stats=json --shard-patches 100");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_TRUE(read_file(folder_.path("whole.ply")) == read_file(folder_.path("ranks.ply")));
  const Outcome stats =
      run({"tessellate", in, "-o", folder_.path("whole.ply"), "--grid", "3", "--stats=json"});
  // What is counted is the same, line by line.
  for (const char* const name :
       {"\"patches\"", "\"vertices\"", "\"triangles\"", "\"deviation\"", "\"open_edges\"",
        "\"non_manifold_edges\"", "\"turned_edges\"", "\"repeated_patches\"", "\"samples\":"}) {
    const auto line_of = [&](const std::string& text) {
      const std::size_t begin = text.find(name);
      EXPECT_NE(begin, std::string::npos) << name;
      return text.substr(begin, text.find_first_of(",\n", begin) - begin);
    };
    EXPECT_EQ(line_of(answer.out), line_of(stats.out));
  }
}

TEST_F(Mpi, faults_have_an_exit_code_a_message_and_leave_nothing) {
  struct Fault {
    std::string words;
    int exit_code;
    const char* message;
  };
  std::string cut = read_file([&] {
    expect_silent_success(run({"convert", "builtin:teapot", "-o", folder_.path("cut.sbp")}));
    return folder_.path("cut.sbp");
  }());
  cut[cut.size() - 5] = static_cast<char>(cut[cut.size() - 5] ^ 1); // of the last rank's patches
  std::ofstream(folder_.path("cut.sbp"), std::ios::binary) << cut;
  const std::string out = " -o " + folder_.path("fault.ply");
  const Fault faults[] = {
      {"tessellate builtin:teapot" + out + " --grid 1", 2, "--grid: expected"},
      {"tessellate " + folder_.path("none.bez") + out, 1, "expected a readable file"},
      {"tessellate " + folder_.path("cut.sbp") + out, 1, "expected block 0"},
      {"tessellate builtin:teapot -o " + folder_.path("no/folder.ply"), 1,
       "no/folder.ply: expected"},
      {"tessellate builtin:teapot -o " + folder_.path("a.glb"), 2, "expected a mesh in ply or stl"},
      {"tessellate builtin:teapot" + out + " --tolerance 1e-9", 1, "expected a distance above"},
      {"info builtin:teapot", 2, "expected tessellate"}};
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fault.words);
    const Answer answer = run_ranks(3, fault.words);
    EXPECT_EQ(answer.exit_code, fault.exit_code);
    EXPECT_NE(answer.err.find(fault.message), std::string::npos) << answer.err;
    EXPECT_EQ(answer.err.find("simdbezier: "), answer.err.rfind("simdbezier: ")) << answer.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("fault.ply")));
    EXPECT_FALSE(has_leftovers());
  }
}

// What a run that was killed has left is removed by the next one.
TEST_F(Mpi, leftovers_go_with_the_next_run) {
  const std::string left = folder_.write(".out.ply.simdbezier-mpi.tmp", std::string(1 << 20, 'x'));
  const Answer answer =
      run_ranks(2, "tessellate builtin:teapot --grid 2 -o " + folder_.path("out.ply"));
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_FALSE(std::filesystem::exists(left));
  expect_silent_success(
      run({"tessellate", "builtin:teapot", "--grid", "2", "-o", folder_.path("whole.ply")}));
  EXPECT_TRUE(read_file(folder_.path("out.ply")) == read_file(folder_.path("whole.ply")));
}

} // namespace
} // namespace simdbezier::tests::mpi_test
