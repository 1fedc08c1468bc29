// simdbezier tessellate: patches in, triangles out.
#include <tools/commands.hpp>

#include <vector>

#include <tools/failure.hpp>
#include <tools/grid_mesh.hpp>
#include <tools/library_status.hpp>
#include <tools/mesh_file.hpp>
#include <tools/progress.hpp>

namespace simdbezier::tools {

namespace {

// Faces of these patches, a bounded number at a time.
template <typename T>
void write_faces(MeshWriter<T>& writer, const GridMesh& mesh, std::size_t first,
                 std::size_t count) {
  constexpr std::size_t kBlockCorners = std::size_t{3} << 14;
  std::vector<std::uint32_t> corners;
  for (std::size_t p = first; p < first + count; ++p) {
    mesh.for_each_triangle(p, [&](const std::array<std::uint32_t, 3>& triangle) {
      corners.insert(corners.end(), triangle.begin(), triangle.end());
      if (corners.size() == kBlockCorners) {
        writer.faces(corners);
        corners.clear();
      }
    });
  }
  writer.faces(corners);
}

template <typename T>
void tessellate(const Arguments& arguments, const PatchFile& patches, const GridMesh& mesh) {
  GridEvaluator<T> evaluator(patches, mesh.grid, arguments.threads);
  const MeshContents contents = mesh.contents();
  const auto writer = make_mesh_writer<T>(arguments.out, *mesh_format_of(arguments.out), contents);
  const auto stride = static_cast<std::ptrdiff_t>(contents.stride());
  Progress progress("evaluating", "samples", mesh.vertices(), !writer->is_terminal());
  std::vector<T> values;
  for_each_block(mesh.patches, mesh.grid, [&](const GridBlock& block) {
    values.resize(block.samples(mesh.grid) * contents.stride());
    Outputs<T> out;
    out.position = Vectors<T>::xyz(values.data(), stride);
    if (mesh.normals) {
      out.normal = Vectors<T>::xyz(values.data() + 3, stride);
    }
    evaluator.evaluate(block, out);
    writer->vertices({values});
    if (writer->takes_faces_early() && block.first_row + block.row_count == mesh.grid.nv) {
      write_faces(*writer, mesh, block.first_patch, block.patch_count);
    }
    progress.advance(block.samples(mesh.grid));
  });
  if (!writer->takes_faces_early()) {
    write_faces(*writer, mesh, 0, mesh.patches);
  }
  writer->finish();
}

} // namespace

void run_tessellate(const Arguments& arguments) {
  chosen_isa();
  refuse_input_as_output(arguments.out, inputs_of(arguments));
  const PatchFile patches = read_patches(arguments.in, arguments.format);
  const GridMesh mesh{patches.count, arguments.grid, arguments.normals};
  const bool single = arguments.precision == Precision::f32;
  const std::uint64_t vertices =
      checked_sample_count(mesh.patches, mesh.grid,
                           mesh.contents().stride() * (single ? sizeof(float) : sizeof(double)));
  if (vertices > kMostMeshVertices) {
    bad_usage("--grid: expected at most " + std::to_string(kMostMeshVertices) +
              " vertices, found " + std::to_string(vertices));
  }
  single ? tessellate<float>(arguments, patches, mesh)
         : tessellate<double>(arguments, patches, mesh);
}

} // namespace simdbezier::tools
