// Open CASCADE, BRepMesh_IncrementalMesh: double, one thread. Faces are sewn outside of the clock.
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <TopoDS_Face.hxx>

#include <limits>
#include <sstream>
#include <string>

#include "bench/peers/opencascade_surface.hpp"
#include "bench/peers/peers.hpp"

namespace simdbezier_bench {
namespace {

/// Control points of common edges are equal, so that any distance joins them.
constexpr double kSewingTolerance = 1e-7;

class OpenCascadeMesher : public PeerMesher {
public:
  explicit OpenCascadeMesher(std::span<const double> nets) {
    BRepBuilderAPI_Sewing sewing(kSewingTolerance);
    for (std::size_t at = 0; at < nets.size(); at += 48) {
      const opencascade::handle<Geom_Surface> surface = opencascade_surface(&nets[at]);
      sewing.Add(BRepBuilderAPI_MakeFace(surface, kSewingTolerance).Face());
    }
    sewing.Perform();
    shape_ = sewing.SewedShape();
  }

  void run(double tolerance) override {
    BRepTools::Clean(shape_); // a shape keeps its triangles and would not make them again
    IMeshTools_Parameters parameters;
    parameters.Deflection = tolerance;
    parameters.Angle = std::numeric_limits<double>::max(); // nobody asks for angles
    parameters.InParallel = false;
    BRepMesh_IncrementalMesh(shape_, parameters);
  }

  /// Counts in the shape's text, because Debian 12 lacks a header that those of triangulations
  /// include. Vertices of common edges count in each of their faces.
  [[nodiscard]] MeshCounts counts() const override {
    std::stringstream text;
    BRepTools::Write(shape_, text);
    std::string word;
    while (text >> word && word != "Triangulations") {
    }
    std::size_t faces = 0;
    MeshCounts all;
    for (text >> faces; faces > 0; --faces) {
      std::size_t vertices = 0;
      std::size_t triangles = 0;
      bool has_parameters = false;
      bool has_normals = false;
      double deflection = 0;
      text >> vertices >> triangles >> has_parameters >> has_normals >> deflection;
      all.vertices += vertices;
      all.triangles += triangles;
      const std::size_t numbers = 3U + (has_parameters ? 2U : 0U) + (has_normals ? 3U : 0U);
      for (std::size_t k = 0; k < vertices * numbers + 3 * triangles; ++k) {
        text >> word;
      }
    }
    return all;
  }

private:
  TopoDS_Shape shape_;
};

} // namespace

std::unique_ptr<PeerMesher> make_opencascade_mesher(std::span<const double> nets) {
  return std::make_unique<OpenCascadeMesher>(nets);
}

} // namespace simdbezier_bench
