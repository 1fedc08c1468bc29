"""Many Bezier patches and curves at many parameters in one call.

>>> import numpy, simdbezier
>>> points = numpy.zeros((2, 4, 4, 3), numpy.float32)      # patches, rows, columns, x y z
>>> points[..., 0] = numpy.arange(4)                       # x grows along a row, with u
>>> points[..., 1] = numpy.arange(4)[:, None]              # y grows across rows, with v
>>> points[1, ..., 0] += 3
>>> patches = simdbezier.PatchSet(points)
>>> patches
<simdbezier.PatchSet: 2 patches of degree 3 x 3, 3 components, float32>
>>> samples = patches.evaluate_grid(5, 3, outputs=('position', 'normal'))
>>> samples['position'].shape                              # patches, nv, nu, components
(2, 3, 5, 3)
>>> samples['position'][1, 1, 2], samples['normal'][0, 0, 0]
(array([4.5, 1.5, 0. ], dtype=float32), array([0., 0., 1.], dtype=float32))

Results go into memory that is there already where `out` names arrays, whatever their strides:

>>> vertices = numpy.empty((2, 3, 5, 6), numpy.float32)    # x y z nx ny nz
>>> out = {'position': vertices[..., :3], 'normal': vertices[..., 3:]}
>>> patches.evaluate_grid(5, 3, out=out)['normal'] is out['normal']
True

A mesh stays within a tolerance of the surface, and says how far it is at most:

>>> mesh = simdbezier.tessellate(points, tolerance=1e-3)
>>> mesh.positions.shape, mesh.triangles.shape, mesh.deviation < 1e-3
((6, 3), (4, 3), True)

Polylines stay within a tolerance of curves:

>>> lines = simdbezier.flatten(points[0], tolerance=1e-3)     # curves, points, x y z
>>> lines.points.shape, lines.first, lines[3].shape
((8, 3), array([0, 2, 4, 6, 8]), (2, 3))

B-splines and NURBS with knots are evaluated in their own parameters, U along a row of the points:

>>> spline = simdbezier.SplineSurface(numpy.arange(60.0).reshape(5, 4, 3), degrees=(3, 2))
>>> spline
<simdbezier.SplineSurface: 1 x 3 patches of degree 3 x 2, 3 components, float64>
>>> spline.evaluate_grid([0, 0.5, 1], [0, 3])['position'].shape    # V, U, components
(2, 3, 3)

Results, accuracy and threads are those of the C++ library. While it computes, other Python threads
run.
"""

from ._core import (
    CurveSet,
    Mesh,
    PatchIndexError,
    PatchSet,
    Polylines,
    SplineCurve,
    SplineSurface,
    __version__,
    available_isas,
    control_boxes,
    elevate,
    flatness,
    flatten,
    hodograph_u,
    hodograph_v,
    reverse_u,
    reverse_v,
    segment,
    spline_to_bezier,
    split,
    split_u,
    split_v,
    tessellate,
    tight_boxes,
    transpose,
)

__all__ = [
    'CurveSet',
    'Mesh',
    'PatchIndexError',
    'PatchSet',
    'Polylines',
    'SplineCurve',
    'SplineSurface',
    'available_isas',
    'control_boxes',
    'elevate',
    'flatness',
    'flatten',
    'hodograph_u',
    'hodograph_v',
    'reverse_u',
    'reverse_v',
    'segment',
    'spline_to_bezier',
    'split',
    'split_u',
    'split_v',
    'tessellate',
    'tight_boxes',
    'transpose',
]
