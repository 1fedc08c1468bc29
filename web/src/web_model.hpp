// A model of patches in the module's memory, its meshes and its samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <simdbezier/simdbezier.hpp>
#include <tools/formats/patch_file.hpp>
#include <tools/mesh_files/mesh_file.hpp>

namespace simdbezier::web {

/// What a mesh is to be like, as library.js fills it in: nan stands for what is not said, 0 and 1
/// for false and true. Angles are degrees.
struct MeshWish {
  double tolerance;
  double relative;
  double angle;
  double crease;
  double snap;
  double nu; ///< samples of a grid
  double nv;
  double normals;
  double parameters;
  double orient;
  double flip;
  double thorough;
  double bits; ///< of a quantised component: 8 or 16
};

/// How samples are asked for. Bit k of `outputs` stands for Output(k).
struct SampleWish {
  enum Layout : unsigned { triples, planes, interleaved };
  unsigned outputs;
  unsigned layout;
  unsigned watertight;

  [[nodiscard]] bool wants(Output output) const noexcept {
    return (outputs >> static_cast<unsigned>(output) & 1U) != 0;
  }
};

/// Numbers and places of results, as library.js reads them. Places are those in the module's
/// memory.
struct Results {
  double patches;
  double diagonal;
  double low[3];
  double high[3];
  double edges;
  double open_edges;
  double non_manifold_edges;
  double ignored_trims;
  double vertices;
  double triangles;
  double deviation;
  double stride; ///< values of a vertex
  double index_bytes;
  double vertex_data;
  double index_data;
  double deviation_data;      ///< a double for each patch
  double first_triangle_data; ///< a uint32 for each patch, and the number of all triangles
  double samples;
  double sample_data;
  double sample_step; ///< values from one output to the next
  double status_data; ///< a byte for each sample
  double file_data;
  double file_bytes;
};

class Model {
public:
  Model() = default;
  virtual ~Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// All of these throw what the program throws, or std::bad_alloc. Their results stay until the
  /// next call of the same kind.
  virtual void tessellate(const MeshWish& wish) = 0;
  virtual void grid(std::size_t nu, std::size_t nv, const SampleWish& wish) = 0;
  /// u and v: in the model's precision.
  virtual void samples(std::span<const std::uint32_t> patches, const void* u, const void* v,
                       const SampleWish& wish) = 0;
  /// Makes the file that the program would write.
  virtual void write_file(tools::MeshFormat format, const MeshWish& wish) = 0;

  [[nodiscard]] const Results& results() const noexcept { return results_; }

protected:
  Results results_ = {};
};

[[nodiscard]] std::unique_ptr<Model> make_model(tools::PatchFile file, bool doubles);

} // namespace simdbezier::web
