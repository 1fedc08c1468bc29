// Open CASCADE on B-spline surfaces: GeomAdaptor_Surface, sample by sample, and
// GeomConvert_BSplineSurfaceToBezierSurface with all of its patches.
#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert_BSplineSurfaceToBezierSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Vec.hxx>

#include "bench/peers/peers.hpp"

namespace simdbezier_bench {
namespace {

opencascade::handle<Geom_BSplineSurface> surface_of(const SplineJob& job) {
  const int columns = static_cast<int>(job.points);
  TColgp_Array2OfPnt poles(1, columns, 1, columns);
  TColStd_Array2OfReal weights(1, columns, 1, columns);
  const double* p = job.net;
  for (int j = 1; j <= columns; ++j) {
    for (int i = 1; i <= columns; ++i, p += 4) {
      poles.SetValue(i, j, gp_Pnt(p[0] / p[3], p[1] / p[3], p[2] / p[3]));
      weights.SetValue(i, j, p[3]);
    }
  }
  const int spans = columns - 3;
  TColStd_Array1OfReal knots(1, spans + 1);
  TColStd_Array1OfInteger times(1, spans + 1);
  for (int k = 0; k <= spans; ++k) {
    knots.SetValue(k + 1, job.knots[k + 3]);
    times.SetValue(k + 1, k == 0 || k == spans ? 4 : 1);
  }
  return new Geom_BSplineSurface(poles, weights, knots, knots, times, times, 3, 3);
}

} // namespace

std::function<void()> prepare_opencascade_spline(const SplineJob& job) {
  const GeomAdaptor_Surface surface(surface_of(job));
  return [job, surface] {
    double* const* const out = job.out.component;
    std::size_t k = 0;
    for (std::size_t j = 0; j < job.samples; ++j) {
      for (std::size_t i = 0; i < job.samples; ++i, ++k) {
        gp_Pnt point;
        if (job.out.groups == OutputGroups::position) {
          surface.D0(job.at[i], job.at[j], point);
        } else {
          gp_Vec du;
          gp_Vec dv;
          surface.D1(job.at[i], job.at[j], point, du, dv);
          if (job.out.groups == OutputGroups::position_normal) {
            const gp_Vec normal = du.Crossed(dv).Normalized();
            normal.Coord(out[3][k], out[4][k], out[5][k]);
          } else {
            du.Coord(out[3][k], out[4][k], out[5][k]);
            dv.Coord(out[6][k], out[7][k], out[8][k]);
          }
        }
        point.Coord(out[0][k], out[1][k], out[2][k]);
      }
    }
  };
}

std::function<void()> prepare_opencascade_patches(const SplineJob& job) {
  return [surface = surface_of(job)] {
    GeomConvert_BSplineSurfaceToBezierSurface patches(surface);
    for (int v = 1; v <= patches.NbVPatches(); ++v) {
      for (int u = 1; u <= patches.NbUPatches(); ++u) {
        static_cast<void>(patches.Patch(u, v));
      }
    }
  };
}

} // namespace simdbezier_bench
