// A bicubic patch as Open CASCADE has it.
#pragma once

#include <Geom_BezierSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Pnt.hxx>

namespace simdbezier_bench {

/// Makes the patch with the control points net[j][i][xyz].
inline opencascade::handle<Geom_BezierSurface> opencascade_surface(const double* net) {
  TColgp_Array2OfPnt poles(1, 4, 1, 4);
  for (int k = 0; k < 16; ++k) {
    poles.SetValue(k % 4 + 1, k / 4 + 1, gp_Pnt(net[3 * k], net[3 * k + 1], net[3 * k + 2]));
  }
  return new Geom_BezierSurface(poles);
}

} // namespace simdbezier_bench
