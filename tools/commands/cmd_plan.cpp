// simdbezier plan: the commands that make a mesh in parts, one a line.
#include <tools/commands/commands.hpp>

#include <string>

#include <tools/commands/meshes/mesh_plan.hpp>
#include <tools/commands/meshes/part_work.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

void run_plan(const Arguments& arguments) {
  if (arguments.in == "-") {
    bad_usage("IN: expected a file that every part can read, found standard input");
  }
  refuse_input_as_output(arguments.out, inputs_of(arguments));
  const auto source = open_source(arguments);
  expect_shards(*source, arguments.shards, "--shards");
  expect_grid_of_mesh(arguments);
  arguments.precision == Precision::f32
      ? expect_exact_storage<float>(*source, arguments, "--shards")
      : expect_exact_storage<double>(*source, arguments, "--shards");
  const std::string path = (arguments.in.starts_with("-") ? "./" : "") + arguments.in;
  const std::string to = (arguments.out.starts_with("-") ? "./" : "") + arguments.out;
  const std::string command =
      "simdbezier tessellate " + for_shell(path) + " -o " + for_shell(to) + arguments.words +
      (arguments.threads == 0 ? "" : " --threads=" + std::to_string(arguments.threads)) +
      " --shard=";
  if (command.find('\n') != std::string::npos) {
    bad_usage(
        "plan: expected names of one line, since each command is printed as one, found others");
  }
  const std::string all = std::to_string(arguments.shards);
  OutputFile out("-");
  for (std::size_t shard = 1; shard <= arguments.shards; ++shard) {
    out.text(command + std::to_string(shard) + "/" + all + "\n");
  }
  out.text("simdbezier join -o " + for_shell(to) +
           " --to=" + mesh_format_name(arguments.mesh.format) + " --shards=" + all + "\n");
  out.commit();
}

} // namespace simdbezier::tools
