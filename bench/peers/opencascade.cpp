// Open CASCADE, Geom_BezierSurface::D0 and D1: double, sample by sample.
#include <gp_Vec.hxx>

#include <vector>

#include "bench/peers/opencascade_surface.hpp"
#include "bench/peers/peers.hpp"

namespace simdbezier_bench {
namespace {

struct Batch {
  std::vector<opencascade::handle<Geom_BezierSurface>> surfaces;
  std::vector<double> u, v;
  Results<double> out;

  Batch(const GridJob<double>& job, const double* nets)
      : u(job.u, job.u + job.nu), v(job.v, job.v + job.nv), out(job.out) {
    for (std::size_t patch = 0; patch < job.patches; ++patch, nets += 48) {
      surfaces.push_back(opencascade_surface(nets));
    }
  }

  void operator()() const {
    double* position = out.component[0];
    double* du = out.component[3];
    double* dv = out.component[6];
    for (const auto& surface : surfaces) {
      for (const double at_v : v) {
        for (const double at_u : u) {
          gp_Pnt point;
          if (out.groups == OutputGroups::position) {
            surface->D0(at_u, at_v, point);
          } else {
            gp_Vec along_u;
            gp_Vec along_v;
            surface->D1(at_u, at_v, point, along_u, along_v);
            along_u.Coord(du[0], du[1], du[2]);
            along_v.Coord(dv[0], dv[1], dv[2]);
            du += 3;
            dv += 3;
          }
          point.Coord(position[0], position[1], position[2]);
          position += 3;
        }
      }
    }
  }
};

} // namespace

std::function<void()> prepare_opencascade(const GridJob<double>& job, const double* nets) {
  return Batch(job, nets);
}

} // namespace simdbezier_bench
