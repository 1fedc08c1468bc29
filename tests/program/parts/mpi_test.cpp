// Meshes by many processes have the bytes of the program's, whichever ranks made what.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/program/parts/mpi_ranks.hpp"
#include "tests/program/parts/part_models.hpp"
#include "tests/program/process/program.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::mpi_test {
namespace {

using Mpi = MpiRanks;

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
                           {"raw", "--grid 4x3 --quads --parameters"},
                           {"raw", "--relative 1e-2 --precision f64"},
                           {"stl", "--grid 2 --precision f64"}};

TEST_P(Mpi, any_number_of_ranks_makes_the_same_bytes) {
  constexpr int kRanks[] = {1, 2, 3, 5, 7};
  constexpr int kPatches[] = {65536, 9, 2};
  std::size_t number = 13 * GetParam();
  for (const PartModel& model : part_models(folder_)) {
    for (const Case& item : kCases) {
      const std::string options = item.options;
      const std::string whole = folder_.path(std::string("whole.") + item.extension);
      const std::string program = std::string(SIMDBEZIER_PROGRAM) + " tessellate '" + model.path +
                                  "' -o '" + whole + "' " + options;
      ASSERT_EQ(std::system(program.c_str()), 0) << program;
      for (const int ranks : kRanks) {
        for (const int patches : kPatches) {
          if (!in_form(number++, 61)) {
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

TEST_P(Mpi, binary_patches_are_read_by_ranges) {
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

TEST_P(Mpi, faults_have_an_exit_code_a_message_and_leave_nothing) {
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
      {"tessellate builtin:teapot -o " + folder_.path("a.glb"), 2, "expected a mesh in ply, raw"},
      {"tessellate builtin:teapot" + out + " --tolerance 1e-9", 1, "expected a distance above"},
      {"evaluate builtin:teapot -o " + folder_.path("no/folder.csv"), 1, "no/folder.csv: expected"},
      {"evaluate builtin:teapot -o -", 2, "-o: expected a file that all ranks can write"},
      {"evaluate " + folder_.path("cut.sbp") + " -o " + folder_.path("a.csv"), 1,
       "expected block 0"},
      {"info " + folder_.path("none.bez"), 1, "none.bez: expected a readable file"},
      {"convert builtin:teapot -o " + folder_.path("a.stl"), 2, "-o: expected a name that ends in"},
      {"join -o " + folder_.path("a.ply") + " --shards 2", 1, "expected a part of a mesh"},
      {"join -o " + folder_.path("a.hdf") + " --shards 2", 2, "-o: expected a name that ends in"},
      {"plan builtin:teapot --shards 2 -o " + folder_.path("a.hdf"), 2, "-o: expected a name that"},
      {"draw builtin:teapot", 2, "expected tessellate, evaluate, info, convert, plan, join or"}};
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

// Each of them is the program's, once.
TEST_P(Mpi, the_first_rank_runs_other_commands) {
  const std::string sbp = folder_.path("teapot.sbp");
  const std::string out = folder_.path("out.ply");
  for (const std::string& words :
       {"convert builtin:teapot --sort -o " + sbp, "info " + sbp, "info " + sbp + " --json",
        "plan " + sbp + " --shards 2 --grid 3 -o " + out, std::string("--help"),
        std::string("join --help"), std::string("--version")}) {
    SCOPED_TRACE(words);
    const std::string said = folder_.path("said");
    const std::string program = std::string(SIMDBEZIER_PROGRAM) + " " + words + " > " + said;
    ASSERT_EQ(std::system(program.c_str()), 0);
    const std::string bytes = words.starts_with("convert") ? read_file(sbp) : "";
    const Answer answer = run_ranks(3, words);
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_EQ(answer.out, read_file(said));
    EXPECT_TRUE(bytes.empty() || read_file(sbp) == bytes);
  }
  for (const char* const shard : {"1/2", "2/2"}) {
    expect_silent_success(run({"tessellate", sbp, "--grid", "3", "-o", out, "--shard", shard}));
  }
  EXPECT_EQ(run_ranks(3, "join --remove-parts --shards 2 -o " + out).exit_code, 0);
  const std::string whole = folder_.path("whole.ply");
  expect_silent_success(run({"tessellate", sbp, "--grid", "3", "-o", whole}));
  EXPECT_TRUE(read_file(out) == read_file(whole));
}

// What a run that was killed has left is removed by the next one.
TEST_P(Mpi, leftovers_go_with_the_next_run) {
  const std::string left = folder_.write(".out.ply.simdbezier-mpi.tmp", std::string(1 << 20, 'x'));
  const Answer answer =
      run_ranks(2, "tessellate builtin:teapot --grid 2 -o " + folder_.path("out.ply"));
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_FALSE(std::filesystem::exists(left));
  expect_silent_success(
      run({"tessellate", "builtin:teapot", "--grid", "2", "-o", folder_.path("whole.ply")}));
  EXPECT_TRUE(read_file(folder_.path("out.ply")) == read_file(folder_.path("whole.ply")));
}

// More samples than a block has, in no order.
std::string many_samples(std::size_t patches) {
  std::string text = "patch,u,v\n";
  for (std::size_t k = 0; k < 50000; ++k) {
    text += std::to_string(k * 7919 % patches) + "," + std::to_string(k % 101) + "e-2," +
            std::to_string(static_cast<double>(k % 977) / 977) + "\n";
  }
  return text;
}

TEST_P(Mpi, ranks_evaluate_the_same_lines) {
  const std::string samples = " --samples " + folder_.write("samples.csv", many_samples(3));
  const std::string options[] = {" --grid 5", " --grid 600x500 --outputs normal",
                                 " --grid 3x2 --precision f64 --outputs position,duv,curvature",
                                 samples, samples + " --precision f64 --outputs du,curvature"};
  std::size_t number = GetParam();
  for (const PartModel& model : part_models(folder_)) {
    const std::string in = folder_.path("in.sbp");
    expect_silent_success(run({"convert", model.path, "-o", in}));
    for (const std::string& option : options) {
      const bool is_fine = option.find("600") != std::string::npos;
      if (is_fine ? model.name != "mixed shapes" : !in_form(++number, 3)) {
        continue; // fine grids are for few patches
      }
      const std::string from = number % 2 == 0 ? in : model.path;
      const int ranks = 2 + static_cast<int>(number % 2);
      SCOPED_TRACE(from + option + ", " + std::to_string(ranks) + " ranks");
      const std::string whole = folder_.path("whole.csv");
      const std::string words = "evaluate '" + from + "'" + option + " -o ";
      ASSERT_EQ(std::system((std::string(SIMDBEZIER_PROGRAM) + " " + words + whole).c_str()), 0);
      const std::string out = folder_.path("ranks.csv");
      const Answer answer = run_ranks(ranks, words + out);
      EXPECT_EQ(answer.exit_code, 0) << answer.err;
      EXPECT_EQ(answer.out, "");
      EXPECT_TRUE(read_file(whole) == read_file(out));
      EXPECT_FALSE(has_leftovers());
    }
  }
}

// Whichever rank meets it, the failure is the program's.
TEST_P(Mpi, ranks_refuse_what_the_program_refuses) {
  std::string far = gluings_as_bez(3, 40);
  far.replace(far.rfind(' ') + 1, std::string::npos, "1e300\n");
  const std::string in = folder_.write("far.bez", far);
  const std::string few = folder_.write("few.csv", "patch,u,v\n0,0.5,0.5\n");
  const std::string bad = folder_.write("bad.csv", many_samples(3) + "0,0.5,x\n");
  for (const std::string& words :
       {"evaluate " + in + " --grid 3", "evaluate " + in + " --samples " + few,
        "evaluate builtin:teapot --samples " + bad}) {
    SCOPED_TRACE(words);
    const std::string program = std::string(SIMDBEZIER_PROGRAM) + " " + words + " -o " +
                                folder_.path("a.csv") + " 2> " + folder_.path("program");
    const int status = std::system(program.c_str());
    const Answer answer = run_ranks(3, words + " -o " + folder_.path("a.csv"));
    EXPECT_EQ(answer.exit_code, WEXITSTATUS(status));
    EXPECT_NE(answer.err.find(read_file(folder_.path("program"))), std::string::npos) << answer.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("a.csv")));
    EXPECT_FALSE(has_leftovers());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Mpi, ::testing::Range(std::size_t{0}, std::size(kLaunchers)));

} // namespace
} // namespace simdbezier::tests::mpi_test
