// simdbezier tessellate: patches in, triangles out.
#include <tools/commands/commands.hpp>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <tools/commands/meshes/bezier_cells.hpp>
#include <tools/commands/meshes/grid_mesh.hpp>
#include <tools/commands/meshes/part_work.hpp>
#include <tools/commands/meshes/welded_mesh.hpp>
#include <tools/mesh_files/mesh_formats.hpp>
#include <tools/parts/part_file.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

// Data in a pipe mostly end up on the terminal that would show the bar.
template <typename Writer>
bool may_show_bar(const Arguments& arguments, const Writer& writer) {
  return arguments.out != "-" && !writer.is_terminal();
}

// JSON is data, text is for people.
void print(const MeshStats& stats, StatsForm form) {
  if (form == StatsForm::json) {
    OutputFile out("-");
    out.text(stats_as_json(stats));
    out.commit();
  } else if (form == StatsForm::text) {
    std::fputs(stats_as_text(stats).c_str(), stderr);
  }
}

// Lets write(progress) write the whole mesh, and says what has to be said.
template <typename Writer, typename Write>
void write_file(Writer& writer, const Write& write, const Arguments& arguments, MeshStats& stats) {
  {
    Progress progress("tessellating", "patches", stats.patches, may_show_bar(arguments, writer));
    write(progress);
  }
  {
    const Stopwatch watch(stats.seconds.write);
    writer.complete();
  }
  print(stats, arguments.mesh.stats); // where this fails, there is no mesh either
  writer.finish();
  if (stats.origin && arguments.mesh.stats == StatsForm::none &&
      !mesh_abilities(arguments.mesh.format).moved) {
    std::fputs(
        ("simdbezier: positions count from the origin " + spaced(*stats.origin) + "\n").c_str(),
        stderr);
  }
}

PartHeader of_part(PartHeader header, MeshContents contents) {
  header.contents = std::move(contents);
  return header;
}

// header: of a part; without it, the mesh is a whole one.
template <typename T>
void write_mesh(MeshSource<T>& mesh, const Arguments& arguments,
                const std::optional<PartHeader>& header, MeshStats& stats) {
  std::unique_ptr<MeshWriter<T>> writer;
  {
    const Stopwatch watch(stats.seconds.write);
    writer =
        header ? make_part_writer<T>(arguments.out, of_part(*header, mesh.contents()), mesh.links())
               : make_mesh_writer<T>(arguments.out, arguments.mesh.format, mesh.contents());
  }
  const auto write = [&](Progress& progress) { mesh.write(*writer, stats.seconds, progress); };
  write_file(*writer, write, arguments, stats);
}

// Stored: the type of what is stored.
template <typename Stored>
void write_bezier_cells(const PatchFile& patches, const Arguments& arguments, MeshStats& stats) {
  BezierCells<Stored> cells(patches, arguments, stats);
  const auto write = [&](Progress& progress) {
    const Stopwatch watch(stats.seconds.write);
    cells.write(progress);
  };
  write_file(cells, write, arguments, stats);
}

template <typename T>
void tessellate(const Arguments& arguments, ModelPart part, const std::optional<PartHeader>& header,
                MeshStats& stats) {
  if (arguments.mesh.weld) {
    WeldedMesh<T> mesh(std::move(part), arguments, stats);
    return write_mesh(mesh, arguments, header, stats);
  }
  const std::size_t values =
      3 + (arguments.mesh.normals ? 3 : 0) + (arguments.mesh.parameters ? 2 : 0);
  const std::uint64_t vertices =
      checked_sample_count(part.patches, arguments.grid, values * sizeof(T));
  if (vertices > kMostMeshVertices) {
    bad_usage("--grid: expected at most " + std::to_string(kMostMeshVertices) +
              " vertices, found " + std::to_string(vertices));
  }
  GridMesh<T> mesh(part, arguments, stats);
  write_mesh(mesh, arguments, header, stats);
}

// Tells of a part that is there what its file says.
template <typename T>
void print_kept(const MeshContents& mesh, const Arguments& arguments, MeshStats& stats) {
  stats.was_there = true;
  stats.vertices = mesh.vertices;
  stats.triangles = 2 * mesh.faces - (mesh.corners == 3 ? mesh.faces : mesh.among_quads);
  stats.deviation = mesh.deviation ? stated_deviation<T>(arguments.mesh.format, mesh) : HUGE_VAL;
  print(stats, arguments.mesh.stats);
}

// Makes one part of the mesh, unless it is there already.
template <typename T>
void tessellate_shard(Arguments& arguments, const PatchSource& source, MeshStats& stats) {
  const Shard& shard = *arguments.shard;
  expect_shards(source, shard.all, "--shard");
  expect_exact_storage<T>(source, arguments, "--shard");
  const SetRange own = shard_range(source.patches(), shard.number, shard.all);
  PartHeader header;
  header.fingerprint = part_fingerprint(source, arguments);
  header.shard = shard.number;
  header.shards = shard.all;
  header.doubles = sizeof(T) > sizeof(float);
  header.format = arguments.mesh.format;
  arguments.out = part_path(arguments.out, shard.number, shard.all);
  const auto done = PartReader::header_of(arguments.out);
  if (done && done->fingerprint == header.fingerprint && done->format == header.format &&
      done->shard == header.shard && done->shards == header.shards) {
    std::fputs(("simdbezier: " + arguments.out + " is there already\n").c_str(), stderr);
    stats.patches = own.count;
    return print_kept<T>(done->contents, arguments, stats);
  }
  ModelPart part;
  {
    const Stopwatch watch(stats.seconds.read);
    part = find_part<T>(source, arguments, own);
  }
  tessellate<T>(arguments, std::move(part), header, stats);
}

} // namespace

void run_tessellate(const Arguments& asked) {
  Arguments arguments = asked;
  chosen_isa();
  if (arguments.shard_patches) {
    bad_usage("--shard-patches: expected with simdbezier-mpi, found with simdbezier");
  }
  const std::vector<std::string> inputs = inputs_of(arguments);
  refuse_input_as_output(arguments.out, inputs);
  if (arguments.mesh.stats == StatsForm::json) {
    refuse_input_as_output("-", inputs);
  }
  MeshStats stats;
  const bool f32 = arguments.precision == Precision::f32;
  if (arguments.shard) {
    const auto source = open_moved_source(arguments, stats);
    return f32 ? tessellate_shard<float>(arguments, *source, stats)
               : tessellate_shard<double>(arguments, *source, stats);
  }
  PatchFile patches;
  {
    const Stopwatch watch(stats.seconds.read);
    patches = read_input(arguments);
    stats.ignored_trims = patches.ignored_trims;
    stats.merged_splines = patches.merged_splines;
    move_to_origin(patches, arguments.mesh, stats);
  }
  if (arguments.mesh.bezier_cells) {
    return f32 || arguments.mesh.floats ? write_bezier_cells<float>(patches, arguments, stats)
                                        : write_bezier_cells<double>(patches, arguments, stats);
  }
  ModelPart whole = whole_model(std::move(patches));
  f32 ? tessellate<float>(arguments, std::move(whole), std::nullopt, stats)
      : tessellate<double>(arguments, std::move(whole), std::nullopt, stats);
}

} // namespace simdbezier::tools
