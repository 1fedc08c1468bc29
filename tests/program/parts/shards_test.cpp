// Meshes made in parts have the bytes of those that are made at once.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include <tools/formats/patch_file.hpp>

#include "tests/program/parts/part_models.hpp"
#include "tests/program/process/program.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::shards_test {
namespace {

using Options = std::vector<std::string>;

Options operator+(Options a, const Options& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string text_of(const Options& options) {
  std::string text;
  for (const std::string& option : options) {
    text += " " + option;
  }
  return text;
}

struct OptionsCase {
  const char* extension;
  Options options;
};
const std::vector<OptionsCase>& option_cases() {
  static const std::vector<OptionsCase> cases = {
      {"ply", {"--grid", "2"}},
      {"ply", {"--grid", "5x3", "--flip"}},
      {"ply", {"--relative", "1e-2"}},
      {"stl", {"--relative", "1e-3"}},
      {"ply", {"--relative", "1e-3", "--thorough"}},
      {"ply", {"--tolerance", "0.05", "--precision", "f64", "--no-normals"}},
      {"stl", {"--grid", "3", "--precision", "f64"}},
      {"ply", {"--relative", "1e-2", "--crease", "20", "--parameters"}},
      {"ply", {"--grid", "4", "--quads"}},
      {"ply", {"--grid", "3x4", "--no-weld", "--quads"}},
      {"stl", {"--no-weld", "--grid", "3"}},
      {"ply", {"--angle", "20", "--crease", "0"}},
      {"ply", {"--grid", "3", "--origin", "auto"}},
      {"raw", {"--grid", "3", "--parameters"}},
      {"raw", {"--quads", "--relative", "1e-2"}},
      {"vtu", {"--grid", "3", "--parameters", "--curvature"}},
      {"vtu", {"--no-weld", "--grid", "3", "--parameters"}},
      {"glb", {"--relative", "1e-2"}},
      {"glb", {"--grid", "3", "--quantise", "16"}}};
  return cases;
}

// Runs the program, which may say that positions count from an origin.
void expect_success(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

void make_in_parts(const PartModel& model, const OptionsCase& item, std::size_t shards,
                   const std::string& out) {
  for (std::size_t shard = 1; shard <= shards; ++shard) {
    expect_success(run(Options{"tessellate", model.path, "-o", out, "--shard",
                               std::to_string(shard) + "/" + std::to_string(shards)} +
                       item.options));
  }
  expect_success(run({"join", "-o", out, "--shards", std::to_string(shards), "--remove-parts"}));
}

TEST(Shards, joined_are_the_mesh_that_is_made_at_once) {
  const TemporaryFolder folder;
  std::size_t number = 0;
  for (const PartModel& model : part_models(folder)) {
    for (const OptionsCase& item : option_cases()) {
      SCOPED_TRACE(model.name + text_of(item.options) + " " + item.extension);
      const std::string whole = folder.path(std::string("whole.") + item.extension);
      expect_success(run(Options{"tessellate", model.path, "-o", whole} + item.options));
      const std::size_t most = tools::read_patches(model.path, tools::PatchFormat::by_name).count;
      for (const std::size_t shards : {1, 2, 3, 5, 8, 13}) {
        if (shards > most || !in_form(number++, 7)) {
          continue;
        }
        SCOPED_TRACE(std::to_string(shards) + " shards");
        const std::string out = folder.path(std::string("parts.") + item.extension);
        make_in_parts(model, item, shards, out);
        EXPECT_TRUE(read_file(whole) == read_file(out));
      }
    }
  }
  for (const std::string& name : folder.names()) {
    EXPECT_EQ(name.find("shard-"), std::string::npos) << name;
    EXPECT_EQ(name.find(".tmp"), std::string::npos) << name;
  }
}

// The last weight is too small for a bound on rounding.
TEST(Shards, may_have_no_bound_on_their_deviation) {
  const TemporaryFolder folder;
  std::string text;
  for (const char* const light : {"1", "1e-9"}) {
    text += std::string("8\n1 1\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 0 ") + light + "\n";
  }
  const std::string in = folder.write("light.bv", text);
  for (const char* const extension : {"ply", "stl", "raw", "vtu", "glb"}) {
    SCOPED_TRACE(extension);
    const std::string whole = folder.path(std::string("whole.") + extension);
    expect_success(run({"tessellate", in, "-o", whole, "--grid", "3"}));
    const std::string out = folder.path(std::string("parts.") + extension);
    make_in_parts({"light", in}, {extension, {"--grid", "3"}}, 2, out);
    EXPECT_TRUE(read_file(whole) == read_file(out));
  }
}

// Every part but the first one repeats a patch of the first.
TEST(Shards, may_own_no_vertex) {
  const TemporaryFolder folder;
  const PartModel model{"squares", folder.write("squares.bpt", repeated_squares(3))};
  for (const OptionsCase& item : option_cases()) {
    SCOPED_TRACE(text_of(item.options) + " " + item.extension);
    const std::string whole = folder.path(std::string("whole.") + item.extension);
    expect_success(run(Options{"tessellate", model.path, "-o", whole} + item.options));
    const std::string out = folder.path(std::string("parts.") + item.extension);
    make_in_parts(model, item, 3, out);
    EXPECT_TRUE(read_file(whole) == read_file(out));
  }
}

TEST(Shards, of_one_point_are_joined) {
  const TemporaryFolder folder;
  const std::string point = "1 1\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n";
  const PartModel model{"point", folder.write("point.bpt", "2\n" + point + point)};
  for (const char* const extension : {"glb", "stl", "ply"}) {
    const Options options = {"--grid", "3", "--precision", "f64"};
    const std::string whole = folder.path(std::string("whole.") + extension);
    expect_success(run(Options{"tessellate", model.path, "-o", whole} + options));
    const std::string out = folder.path(std::string("parts.") + extension);
    make_in_parts(model, {extension, options}, 2, out);
    EXPECT_TRUE(read_file(whole) == read_file(out));
  }
}

TEST(Shards, of_binary_patches_are_those_of_text) {
  const TemporaryFolder folder;
  for (const PartModel& model : part_models(folder)) {
    SCOPED_TRACE(model.name);
    const std::string binary = folder.path("model.sbp");
    expect_silent_success(run({"convert", model.path, "-o", binary}));
    const std::string whole = folder.path("whole.ply");
    expect_success(run({"tessellate", model.path, "-o", whole, "--relative", "1e-2"}));
    const std::string out = folder.path("parts.ply");
    make_in_parts({model.name, binary}, {"ply", {"--relative", "1e-2"}}, 3, out);
    EXPECT_TRUE(read_file(whole) == read_file(out));
  }
}

// The commands that are planned are run by a shell.
TEST(Shards, planned_commands_make_the_mesh) {
  const TemporaryFolder folder;
  const std::string in = folder.write("it's a model.bez", gluings_as_bez(5, 6));
  const std::string whole = folder.path("whole.ply");
  expect_success(run({"tessellate", in, "-o", whole, "--grid=4", "--crease", "30"}));
  const std::string out = folder.path("by $plan.ply");
  const Outcome plan = run({"plan", in, "-o", out, "--grid=4", "--crease", "30", "--shards", "4"});
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_EQ(std::count(plan.out.begin(), plan.out.end(), '\n'), 5);
  std::string script = plan.out;
  const std::string folder_of_program =
      std::filesystem::path(SIMDBEZIER_PROGRAM).parent_path().string();
  script = "export PATH=" + folder_of_program + ":\"$PATH\"\nset -e\n" + script;
  ASSERT_EQ(std::system(("bash " + folder.write("plan.sh", script)).c_str()), 0);
  EXPECT_TRUE(read_file(whole) == read_file(out));
  // What tessellate takes is planned.
  EXPECT_EQ(run({"plan", in, "-o", out, "--grid=5000", "--no-weld", "--shards", "2"}).exit_code, 0);
}

TEST(Shards, that_are_there_are_not_made_again) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out.ply");
  const std::string part = out + ".shard-2-of-3";
  const Options shard = {"tessellate", "builtin:teapot", "-o", out, "--shard", "2/3"};
  expect_silent_success(run(shard));
  const std::string bytes = read_file(part);
  const auto written = std::filesystem::last_write_time(part);
  const Outcome again = run(shard);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find("is there already"), std::string::npos) << again.err;
  EXPECT_EQ(std::filesystem::last_write_time(part), written);
  // Whatever has been changed or cut is made again, and so is what other options made.
  for (const std::size_t at : {std::size_t{3}, bytes.size() / 2, bytes.size() - 1}) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    std::ofstream(part, std::ios::binary) << damaged;
    expect_silent_success(run(shard));
    EXPECT_TRUE(read_file(part) == bytes);
  }
  std::ofstream(part, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  expect_silent_success(run(shard));
  EXPECT_TRUE(read_file(part) == bytes);
  expect_silent_success(run(shard + Options{"--grid", "5"}));
  EXPECT_FALSE(read_file(part) == bytes);
}

// Statistics of a part that is there are what its file knows of those that it was made with.
TEST(Shards, that_are_there_have_statistics) {
  const TemporaryFolder folder;
  for (const Options& more : {Options{"--grid", "3"},
                              {"--grid", "3", "--quads"},
                              {"--relative", "1e-2", "--quads"},
                              {"--grid", "3", "--quantise", "16"}}) {
    SCOPED_TRACE(text_of(more));
    const std::string out = folder.path(more.back() == "16" ? "out.glb" : "out.ply");
    const Options shard = {"tessellate", "builtin:teapot", "--shard", "2/3", "-o", out};
    const Outcome made = run(shard + more + Options{"--stats=json"});
    const Outcome again = run(shard + more + Options{"--stats=json"});
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_NE(again.err.find("is there already"), std::string::npos) << again.err;
    const auto all = nlohmann::ordered_json::parse(made.out, nullptr, false);
    nlohmann::ordered_json known = nlohmann::ordered_json::object();
    for (const char* const name : {"patches", "vertices", "triangles", "deviation"}) {
      known[name] = all.value(name, -1.0);
    }
    EXPECT_EQ(nlohmann::ordered_json::parse(again.out, nullptr, false), known);
    const std::string text = run(shard + more + Options{"--stats"}).err;
    EXPECT_NE(text.find("\ntriangles          " + all["triangles"].dump() + "\n"),
              std::string::npos)
        << text;
  }
  const Options loose = {
      "tessellate", "builtin:teapot",         "--shard",     "1/2", "--no-weld", "--grid", "3",
      "-o",         folder.path("loose.ply"), "--stats=json"};
  static_cast<void>(run(loose));
  const auto found = nlohmann::ordered_json::parse(run(loose).out, nullptr, false);
  EXPECT_TRUE(found.contains("deviation") && found["deviation"].is_null()) << found;
}

TEST(Shards, number_comes_from_slurm) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out.ply");
  Circumstances task;
  task.environment = {{"SLURM_ARRAY_TASK_ID", "2"}};
  expect_silent_success(
      run({"tessellate", "builtin:teapot", "-o", out, "--shard", "slurm/2"}, task));
  EXPECT_TRUE(std::filesystem::exists(out + ".shard-2-of-2"));
  expect_failure(run({"tessellate", "builtin:teapot", "-o", out, "--shard", "slurm/2"}), 2,
                 "SLURM_ARRAY_TASK_ID");
  task.environment[0].second = "3";
  expect_failure(run({"tessellate", "builtin:teapot", "-o", out, "--shard", "slurm/2"}, task), 2,
                 "--shard: expected I/N");
}

struct Refusal {
  Options words;
  int exit_code;
  const char* message;
};

TEST(Shards, are_refused_where_they_cannot_be) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out.ply");
  const std::string obj = folder.path("out.obj");
  const std::string glb = folder.path("out.glb");
  const Options shard = {"tessellate", "builtin:teapot", "--shard", "1/2", "-o"};
  const Options plan = {"plan", "builtin:teapot", "--shards", "2", "-o"};
  const Refusal refusals[] = {
      {shard + Options{out, "--orient"}, 2, "--orient: expected without parts of the mesh"},
      {shard + Options{out, "--snap", "1"}, 2, "--snap: expected without parts"},
      {shard + Options{out, "--drop-repeated"}, 2, "--drop-repeated: expected without parts"},
      {shard + Options{obj}, 2, "-o: expected a mesh in ply, stl, glb, vtu or raw for parts"},
      {shard + Options{"-", "--to", "ply"}, 2, "-o: expected a file for parts of a mesh"},
      {{"tessellate", "builtin:teapot", "-o", out, "--shard", "0/2"}, 2, "--shard: expected I/N"},
      {{"tessellate", "builtin:teapot", "-o", out, "--shard", "1"}, 2, "--shard: expected I/N"},
      {{"tessellate", "builtin:teapot", "-o", out, "--shard", "1/33"},
       1,
       "--shard: expected at most as many as there are patches, 32, found 33"},
      {{"tessellate", "builtin:teapot", "-o", out, "--shard-patches", "8"},
       2,
       "--shard-patches: expected with simdbezier-mpi"},
      {{"tessellate", "builtin:teapot", "-o", glb, "--shard", "1/2", "--quantise", "8",
        "--relative", "1e-2"},
       2,
       "--shard: expected --grid, or vertices that are stored as they are computed"},
      {plan + Options{glb, "--quantise", "8", "--relative", "1e-2"}, 2,
       "--shards: expected --grid, or vertices that are stored as they are computed"},
      {plan + Options{folder.path("out.stl"), "--precision", "f64", "--relative", "1e-2"}, 2,
       "--shards: expected --grid, or vertices that are stored as they are computed"},
      {plan + Options{out, "--grid", "5000"}, 2,
       "--grid: expected at most 4097 samples a direction without --no-weld, found 5000x5000"},
      {plan + Options{folder.path("two\nlines.ply")}, 2,
       "plan: expected names of one line, since each command is printed as one"},
      {{"plan", "builtin:teapot", "-o", out}, 2, "--shards: expected"},
      {{"plan", "builtin:teapot", "-o", out, "--shards", "40"}, 1, "--shards: expected at most"},
      {{"join", "-o", out, "--shards", "2"}, 1, "out.ply.shard-1-of-2: expected a part of a mesh"}};
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(text_of(refusal.words));
    expect_failure(run(refusal.words), refusal.exit_code, refusal.message);
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(Shards, of_different_meshes_are_not_joined) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out.ply");
  const auto make = [&](const char* shard, const char* grid) {
    expect_silent_success(
        run({"tessellate", "builtin:teapot", "-o", out, "--shard", shard, "--grid", grid}));
  };
  make("1/2", "3");
  make("2/2", "4");
  expect_failure(run({"join", "-o", out, "--shards", "2"}), 1,
                 "expected a part of the same mesh as");
  EXPECT_FALSE(std::filesystem::exists(out));
  make("2/2", "3");
  const std::string part = out + ".shard-2-of-2";
  std::string bytes = read_file(part);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  std::ofstream(part, std::ios::binary) << bytes;
  expect_failure(run({"join", "-o", out, "--shards", "2"}), 1,
                 "expected a part of a mesh as it was written");
  EXPECT_FALSE(std::filesystem::exists(out));
}

} // namespace
} // namespace simdbezier::tests::shards_test
