// simdbezier tessellate: patches in, triangles out.
#include <tools/commands.hpp>

#include <vector>

#include <tools/failure.hpp>
#include <tools/library_status.hpp>
#include <tools/mesh_writer.hpp>
#include <tools/progress.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
void tessellate(const Arguments& arguments, const PatchFile& patches, const Mesh& mesh) {
  GridEvaluator<T> evaluator(patches, mesh.grid, arguments.threads);
  OutputFile file(arguments.out);
  const auto writer = extension_of(arguments.out) == "ply" ? make_ply_writer<T>(file, mesh)
                                                           : make_obj_writer<T>(file, mesh);
  const auto stride = static_cast<std::ptrdiff_t>(mesh.stride());
  Progress progress("evaluating", "samples", mesh.vertices(), !file.is_terminal());
  std::vector<T> values;
  for_each_block(mesh.patches, mesh.grid, [&](const GridBlock& block) {
    values.resize(block.samples(mesh.grid) * mesh.stride());
    Outputs<T> out;
    out.position = Vectors<T>::xyz(values.data(), stride);
    if (mesh.normals) {
      out.normal = Vectors<T>::xyz(values.data() + 3, stride);
    }
    evaluator.evaluate(block, out);
    writer->vertices(values);
    if (block.first_row + block.row_count == mesh.grid.nv) {
      writer->patches_done(block.first_patch, block.patch_count);
    }
    progress.advance(block.samples(mesh.grid));
  });
  file.commit();
}

} // namespace

void run_tessellate(const Arguments& arguments) {
  chosen_isa();
  refuse_input_as_output(arguments.out, inputs_of(arguments));
  const PatchFile patches = read_patches(arguments.in, arguments.format);
  const Mesh mesh{patches.count, arguments.grid, arguments.normals};
  const bool single = arguments.precision == Precision::f32;
  const std::uint64_t vertices = checked_sample_count(
      mesh.patches, mesh.grid, mesh.stride() * (single ? sizeof(float) : sizeof(double)));
  if (extension_of(arguments.out) == "ply" && vertices > kMostPlyVertices) {
    bad_usage("--grid: expected at most " + std::to_string(kMostPlyVertices) +
              " vertices in a PLY file, found " + std::to_string(vertices));
  }
  single ? tessellate<float>(arguments, patches, mesh)
         : tessellate<double>(arguments, patches, mesh);
}

} // namespace simdbezier::tools
