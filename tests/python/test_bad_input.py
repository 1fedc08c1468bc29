"""Bad input: a TypeError or ValueError whose text begins with the argument, and nothing written."""
import numpy as np
import pytest
from numpy.lib.stride_tricks import as_strided

import simdbezier

POINTS = np.random.default_rng(1).random((2, 4, 4, 3)).astype(np.float32)
PATCHES = simdbezier.PatchSet(POINTS)
CURVES = simdbezier.CurveSet(POINTS[:, 0])
POLYGONS = POINTS[:, 0]
DOUBLES = simdbezier.CurveSet(POINTS[:, 0], dtype=np.float64)
SIX = simdbezier.PatchSet(np.tile(POINTS, 2))
SHAPE = (2, 3, 5, 3)
FOUR = np.concatenate([POINTS, np.ones((2, 4, 4, 1), np.float32)], axis=-1)
NEAR = POINTS.copy()  # whose patches have a side in common, but for a hundredth
NEAR[1, :, 0] = NEAR[0, :, 3] + np.float32(0.01)


def fresh(shape=SHAPE, dtype=np.float32):
    return np.full(shape, 7, dtype)


def read_only():
    array = fresh()
    array.flags.writeable = False
    return array


def grid(**out):
    return PATCHES.evaluate_grid(5, 3, outputs=(), out=out)


def derivatives(patch=0, u=(0.5,), v=(0.5,), orders=((1, 0),), **rest):
    return PATCHES.evaluate_derivatives(patch, u, v, orders, **rest)


def grid_derivatives(nu=5, nv=3, orders=((1, 0),), **rest):
    return PATCHES.evaluate_grid_derivatives(nu, nv, orders, **rest)


def misaligned(shape, dtype=np.float32):
    """An array that begins two bytes behind where its type may begin."""
    size = int(np.prod(shape)) * np.dtype(dtype).itemsize
    return np.full(size + 64, 7, np.uint8)[2:][:size].view(dtype).reshape(shape)


def strided(shape, strides, dtype=np.float32):
    """An array of memory that ends with its last value."""
    values = sum((count - 1) * stride for count, stride in zip(shape, strides)) + 4
    return as_strided(np.full(values, 7, np.uint8).view(dtype), shape, strides)


def two_in_one(second):
    whole = fresh((2, 3, 5, 8))
    return grid(position=whole[..., :3], normal=whole[..., second:second + 3])


VERTICES = len(simdbezier.tessellate(POINTS, grid=3).positions)


def save(point_data, ending='vtu'):
    simdbezier.tessellate(POINTS, grid=3).save(f'/nowhere/mesh.{ending}', point_data)


def with_nan():
    points = POINTS.copy()
    points[1, 2, 3, 0] = np.nan
    return points


# The error, the argument that its text begins with, and the call.
CASES = [
    # Control points.
    (ValueError, 'points', lambda: simdbezier.PatchSet([[1, 2, 3], [1, 2]])),
    (ValueError, 'points', lambda: simdbezier.PatchSet(POINTS[0])),
    (ValueError, 'points', lambda: simdbezier.PatchSet(POINTS[:, :1])),
    (ValueError, 'points', lambda: simdbezier.PatchSet(np.zeros((1, 17, 4, 3)))),
    (ValueError, 'points', lambda: simdbezier.PatchSet(np.zeros((1, 4, 4, 17)))),
    (ValueError, 'points', lambda: simdbezier.PatchSet(np.zeros((1, 4, 4, 0)))),
    (ValueError, 'points', lambda: simdbezier.PatchSet(with_nan())),
    (TypeError, 'points', lambda: simdbezier.PatchSet(POINTS.astype(complex))),
    (TypeError, 'points', lambda: simdbezier.PatchSet('teapot')),
    (TypeError, 'points', lambda: simdbezier.PatchSet(None)),
    (ValueError, 'points', lambda: simdbezier.CurveSet(POINTS)),
    (ValueError, 'points', lambda: simdbezier.elevate([POINTS, POINTS], 4, 4)),
    (ValueError, 'points[1]',
     lambda: simdbezier.PatchSet([POINTS, np.zeros((1, 1, 4, 3), np.float32)])),
    (ValueError, 'weights', lambda: simdbezier.PatchSet(POINTS, POINTS[:1, ..., 0])),
    (ValueError, 'weights', lambda: simdbezier.PatchSet(POINTS, [1, 2, 3])),
    (ValueError, 'weights', lambda: simdbezier.PatchSet(POINTS, np.zeros((2, 4, 4)))),
    (ValueError, 'weights', lambda: simdbezier.PatchSet([POINTS, POINTS], [POINTS[..., 0]])),
    (TypeError, 'dtype', lambda: simdbezier.PatchSet(POINTS, dtype=np.int32)),
    (TypeError, 'dtype', lambda: simdbezier.PatchSet(POINTS, dtype='nonsense')),
    (ValueError, 'relative_to', lambda: simdbezier.PatchSet(POINTS, relative_to=[0] * 4)),
    (ValueError, 'relative_to', lambda: simdbezier.PatchSet(POINTS, relative_to=[np.nan, 0, 0])),
    (ValueError, 'relative_to', lambda: simdbezier.CurveSet(POINTS[0], relative_to=[np.nan])),
    (TypeError, 'local_origin', lambda: simdbezier.PatchSet(POINTS, local_origin='middle')),
    (TypeError, 'threads', lambda: simdbezier.CurveSet(POINTS[0], threads=None)),
    # Which samples.
    (ValueError, 'nu', lambda: PATCHES.evaluate_grid(1, 3)),
    (ValueError, 'nv', lambda: PATCHES.evaluate_grid(5, -3)),
    (TypeError, 'nu', lambda: PATCHES.evaluate_grid(5.0, 3)),
    (TypeError, 'nv', lambda: PATCHES.evaluate_grid(5, '3')),
    (TypeError, 'nu', lambda: PATCHES.evaluate_grid(np.array([3j]), 3)),
    (TypeError, 'nu', lambda: PATCHES.evaluate_grid([True], 3)),
    (TypeError, 'nv', lambda: PATCHES.evaluate_grid(3, ['a'])),
    (TypeError, 'nu', lambda: PATCHES.evaluate_grid(np.array(0.5), 3)),
    (ValueError, 'nu', lambda: PATCHES.evaluate_grid([], 3)),
    (ValueError, 'nv', lambda: PATCHES.evaluate_grid(3, [[0.5]])),
    (ValueError, 'nv', lambda: PATCHES.evaluate_grid(3, [[0.5], [0.5, 1]])),
    (ValueError, 'nu: expected finite', lambda: PATCHES.evaluate_grid([0.5, np.nan], 3)),
    (ValueError, 'nv: expected finite', lambda: PATCHES.evaluate_grid([0.5], [0, -np.inf])),
    (TypeError, 'threads', lambda: PATCHES.evaluate_grid(5, 3, threads='x')),
    (ValueError, 'threads', lambda: PATCHES.evaluate_grid(5, 3, threads=2**31)),
    (TypeError, 'threads', lambda: CURVES.evaluate_grid(5, threads=2.0)),
    (ValueError, 'nu or nv', lambda: PATCHES.evaluate_grid(2**62, 2**62)),
    (ValueError, 'n: the samples', lambda: CURVES.evaluate_grid(2**70)),
    (ValueError, 'v', lambda: PATCHES.evaluate([0, 1], [0.5, 0.5], [0.5])),
    (ValueError, 'patch', lambda: PATCHES.evaluate([0, 1, 1], [0.5, 0.5], [0.5, 0.5])),
    (ValueError, 'patch', lambda: PATCHES.evaluate([0, 2], [0.5, 0.5], [0.5, 0.5])),
    (IndexError, 'patch', lambda: PATCHES.evaluate([0, -1], [0.5, 0.5], [0.5, 0.5])),
    (IndexError, 'patch', lambda: PATCHES.evaluate(2**70, [0.5], [0.5])),
    (IndexError, 'patch', lambda: PATCHES.evaluate([0, -2**70], [0.5, 0.5], [0.5, 0.5])),
    (TypeError, 'patch', lambda: PATCHES.evaluate([0, None], [0.5, 0.5], [0.5, 0.5])),
    (TypeError, 'patch', lambda: PATCHES.evaluate([0.5], [0.5], [0.5])),
    (TypeError, 'patch', lambda: PATCHES.evaluate(np.zeros(0, 'i4,i4'), [], [])),
    (TypeError, 'u', lambda: PATCHES.evaluate([0], ['a'], [0.5])),
    (ValueError, 'u', lambda: PATCHES.evaluate([0], [[0.5]], [0.5])),
    (ValueError, 'curve', lambda: CURVES.evaluate([2], [0.5])),
    (ValueError, 'n', lambda: CURVES.evaluate_grid(0)),
    (IndexError, 'patch', lambda: PATCHES.error_bounds(2)),
    (IndexError, 'patch', lambda: PATCHES.error_bounds(-1)),
    (IndexError, 'patch', lambda: PATCHES.degrees(-1)),
    (IndexError, 'patch', lambda: PATCHES.is_rational(2**70)),
    (IndexError, 'curve', lambda: CURVES.error_bounds(2)),
    (IndexError, 'curve', lambda: CURVES.error_bounds(-1)),
    (TypeError, 'patch', lambda: PATCHES.error_bounds('all')),
    (TypeError, 'patch', lambda: PATCHES.error_bounds([0, 1])),
    (TypeError, 'patch', lambda: PATCHES.error_bounds(False)),
    (TypeError, 'curve', lambda: CURVES.error_bounds(0.0)),
    # Derivatives of any order.
    (ValueError, 'v: expected 2 values', lambda: derivatives([0, 1], [0.5, 0.5], [0.5])),
    (ValueError, 'patch: expected 2 values', lambda: derivatives([0, 1, 1], [0.5, 0.5], [0.5, 0.5])),
    (IndexError, 'patch', lambda: derivatives([0, 2], [0.5, 0.5], [0.5, 0.5])),
    (IndexError, 'patch', lambda: derivatives(-1)),
    (TypeError, 'patch', lambda: derivatives(0.5)),
    (TypeError, 'u', lambda: derivatives(0, ['a'])),
    (ValueError, 'u', lambda: derivatives(0, [[0.5]])),
    (TypeError, 'v', lambda: derivatives(0, [0.5], [0.5j])),
    (TypeError, 'derivatives: expected pairs', lambda: derivatives(orders=3)),
    (TypeError, 'derivatives: expected pairs', lambda: derivatives(orders='du')),
    (ValueError, 'derivatives: expected pairs', lambda: derivatives(orders=(2, 1))),
    (ValueError, 'derivatives: expected pairs', lambda: derivatives(orders=['du'])),
    (ValueError, 'derivatives: expected pairs', lambda: derivatives(orders=[(1, 2, 3)])),
    (TypeError, 'derivatives: expected an integer', lambda: derivatives(orders=[(1, 0.5)])),
    (TypeError, 'derivatives: expected an integer', lambda: derivatives(orders=[(True, 0)])),
    (TypeError, 'derivatives: expected an integer', lambda: derivatives(orders=[('d', 'u')])),
    (ValueError, 'derivatives: expected 0 or more, found -1', lambda: derivatives(orders=[(0, -1)])),
    (ValueError, 'derivatives: expected orders of at most 15, found 16',
     lambda: derivatives(orders=[(16, 0)])),
    (ValueError, 'derivatives: expected orders of at most 15', lambda: derivatives(orders=[(0, 2**70)])),
    (ValueError, 'derivatives: expected at least one', lambda: derivatives(orders=())),
    (ValueError, 'derivatives: expected at least one', lambda: derivatives(orders=None)),
    (ValueError, 'derivatives: expected at least one', lambda: derivatives(orders=(), out={})),
    (TypeError, 'threads', lambda: derivatives(threads='x')),
    (TypeError, 'out: expected a dict', lambda: derivatives(out=fresh((1, 3)))),
    (ValueError, "out: expected pairs of orders as keys, such as (2, 1), found 'du'",
     lambda: derivatives(out={'du': fresh((1, 3))})),
    (ValueError, 'out: expected pairs', lambda: derivatives(out={(1, 2, 3): fresh((1, 3))})),
    (ValueError, 'out: expected pairs', lambda: derivatives(out={range(2): fresh((1, 3))})),
    (ValueError, 'out: expected orders of at most', lambda: derivatives(out={(1, 99): fresh((1, 3))})),
    (TypeError, 'out: expected an integer', lambda: derivatives(out={(1.0, 1): fresh((1, 3))})),
    (TypeError, 'out[(2, 1)]: expected a numpy', lambda: derivatives(out={(2, 1): [[1, 2, 3]]})),
    (TypeError, 'out[(2, 1)]: expected float32',
     lambda: derivatives(out={(2, 1): fresh((1, 3), np.float64)})),
    (ValueError, 'out[(2, 1)]: expected shape', lambda: derivatives(out={(2, 1): fresh((1, 2))})),
    (ValueError, 'out[(2, 1)]: is read-only',
     lambda: derivatives(out={(2, 1): np.broadcast_to(np.float32(0), (1, 3))})),
    (ValueError, 'out[(2, 1)]: is not aligned', lambda: derivatives(out={(2, 1): misaligned((1, 3))})),
    (ValueError, 'out[(2, 1)]: its strides',
     lambda: derivatives(0, *np.ones((2, 9), 'f4'), out={(2, 1): strided((9, 3), (0, 4))})),
    (ValueError, 'out[(2, 1)]: its samples have to be evenly spaced',
     lambda: grid_derivatives(out={(2, 1): fresh((2, 3, 9, 3))[:, :, :5]})),
    (ValueError, 'out[(2, 1)]: expected shape', lambda: grid_derivatives(out={(2, 1): fresh((2, 5, 3, 3))})),
    (ValueError, 'nu', lambda: grid_derivatives(1)),
    (TypeError, 'nv', lambda: grid_derivatives(5, 2.5)),
    (ValueError, 'nv: expected finite', lambda: grid_derivatives(5, [np.inf])),
    (ValueError, 'nu or nv', lambda: grid_derivatives(2**62, 2**62)),
    (ValueError, 'derivatives: expected at least one', lambda: grid_derivatives(orders=[])),
    # Polylines.
    (ValueError, 'points', lambda: simdbezier.flatten(POINTS, 0.1)),
    (ValueError, 'points', lambda: simdbezier.flatten(POLYGONS[:, :1], 0.1)),
    (ValueError, 'points', lambda: simdbezier.flatten(with_nan()[:, 2], 0.1)),
    (TypeError, 'points', lambda: simdbezier.flatten(POLYGONS.astype(complex), 0.1)),
    (TypeError, 'points', lambda: simdbezier.flatten(CURVES, 0.1)),
    (TypeError, 'points: expected control points, found a SplineCurve',
     lambda: simdbezier.flatten(simdbezier.SplineCurve(POLYGONS[0]), 0.1)),
    (ValueError, 'weights', lambda: simdbezier.flatten(POLYGONS, 0.1, [1, 2])),
    (ValueError, 'weights', lambda: simdbezier.flatten(POLYGONS, 0.1, -POLYGONS[..., 0] - 1)),
    (ValueError, 'weights: expected none beside',
     lambda: simdbezier.flatten(POLYGONS, 0.1, POLYGONS[..., 0], homogeneous=True)),
    (ValueError, 'points: a weight is not positive',
     lambda: simdbezier.flatten(-FOUR[0], 0.1, homogeneous=True)),
    (TypeError, 'homogeneous', lambda: simdbezier.flatten(POLYGONS, 0.1, homogeneous='w')),
    (TypeError, 'tolerance: expected a number, or one for each', lambda: simdbezier.flatten(POLYGONS, None)),
    (TypeError, 'tolerance', lambda: simdbezier.flatten(POLYGONS, 'fine')),
    (TypeError, 'tolerance', lambda: simdbezier.flatten(POLYGONS, ['a', 'b'])),
    (ValueError, 'tolerance', lambda: simdbezier.flatten(POLYGONS, 0)),
    (ValueError, 'tolerance', lambda: simdbezier.flatten(POLYGONS, -0.1)),
    (ValueError, 'tolerance', lambda: simdbezier.flatten(POLYGONS, np.nan)),
    (ValueError, 'tolerance', lambda: simdbezier.flatten(POLYGONS, np.inf)),
    (ValueError, 'tolerance: expected a number, or one for each of 2 curves, found 3',
     lambda: simdbezier.flatten(POLYGONS, [0.1] * 3)),
    (ValueError, 'tolerance: expected a number, or one for each of 2 curves, found 0',
     lambda: simdbezier.flatten(POLYGONS, [])),
    (ValueError, 'tolerance', lambda: simdbezier.flatten(POLYGONS, [[0.1, 0.1]])),
    (ValueError, 'tolerance: a tolerance is not above zero, or smaller than rounding allows (curve 1)',
     lambda: simdbezier.flatten(POLYGONS, [0.1, 0])),
    (ValueError, 'tolerance: a tolerance is not above zero, or smaller than rounding allows (curve 1)',
     lambda: simdbezier.flatten(POLYGONS, [0.1, np.nan])),
    (ValueError, 'tolerance: a tolerance is not above zero, or smaller than rounding allows (curve 0)',
     lambda: simdbezier.flatten(POLYGONS, 1e-9)),
    (TypeError, 'dtype', lambda: simdbezier.flatten(POLYGONS, 0.1, dtype=np.int32)),
    (TypeError, 'threads', lambda: simdbezier.flatten(POLYGONS, 0.1, threads=1.5)),
    # Which outputs.
    (ValueError, 'outputs', lambda: PATCHES.evaluate_grid(5, 3, ('position', 'colour'))),
    (ValueError, 'outputs', lambda: PATCHES.evaluate_grid(5, 3, ())),
    (ValueError, 'outputs', lambda: PATCHES.evaluate_grid(5, 3, 'status')),
    (TypeError, 'outputs', lambda: PATCHES.evaluate_grid(5, 3, 3)),
    (TypeError, 'outputs', lambda: PATCHES.evaluate_grid(5, 3, [3])),
    (ValueError, 'outputs', lambda: PATCHES.evaluate_grid(5, 3, ('\udcff',))),
    (ValueError, 'out', lambda: grid(**{'\udcff': fresh()})),
    (ValueError, 'outputs',
     lambda: simdbezier.PatchSet(POINTS[..., :2]).evaluate_grid(3, 3, 'normal')),
    (ValueError, 'outputs',
     lambda: simdbezier.CurveSet(POINTS[:, 0, :, :1]).evaluate_grid(3, 'tangent')),
    # Where they go.
    (TypeError, 'out', lambda: PATCHES.evaluate_grid(5, 3, out=fresh())),
    (ValueError, 'out', lambda: grid(colour=fresh())),
    (TypeError, "out['position']", lambda: grid(position=fresh().tolist())),
    (TypeError, "out['position']", lambda: grid(position=fresh(dtype=np.float64))),
    (TypeError, "out['position']", lambda: grid(position=fresh().astype('>f4'))),
    (TypeError, "out['status']", lambda: grid(position=fresh(), status=fresh())),
    (ValueError, "out['position']", lambda: grid(position=fresh((2, 5, 3, 3)))),
    (ValueError, "out['position']", lambda: grid(position=fresh((2, 3, 5, 2)))),
    (ValueError, "out['position']", lambda: grid(position=read_only())),
    (ValueError, "out['position']", lambda: grid(position=fresh((2, 3, 9, 3))[:, :, :5])),
    (ValueError, "out['mean']", lambda: grid(mean=fresh((2, 3, 10))[..., ::2])),
    (ValueError, "out['normal']", lambda: two_in_one(2)),
    (ValueError, "out['position']: is not aligned", lambda: grid(position=misaligned(SHAPE))),
    (ValueError, "out['mean']: is not aligned", lambda: grid(mean=misaligned(SHAPE[:3]))),
    (ValueError, "out['position']: is not aligned", lambda: PATCHES.evaluate(
        0, *np.ones((2, 9), 'f4'), (), {'position': misaligned((9, 3))})),
    (ValueError, "out['d2']: is not aligned",
     lambda: DOUBLES.evaluate_grid(9, (), {'d2': misaligned((2, 9, 3), np.float64)})),
    # Memory in which two values share one place.
    (ValueError, "out['position']",
     lambda: PATCHES.evaluate_grid(500, 3, (), {'position': strided((2, 3, 500, 3), (36, 12, 0, 4))})),
    (ValueError, "out['position']", lambda: grid(position=strided(SHAPE, (0, 0, 0, 4)))),
    (ValueError, "out['position']", lambda: grid(position=strided(SHAPE, (180, 60, 12, 0)))),
    (ValueError, "out['position']", lambda: grid(position=strided(SHAPE, (0, 60, 12, 4)))),
    (ValueError, "out['position']", lambda: grid(position=strided(SHAPE, (120, 40, 8, 4)))),
    (ValueError, "out['mean']", lambda: grid(mean=strided(SHAPE[:3], (0, 0, 0)))),
    (ValueError, "out['status']",
     lambda: grid(position=fresh(), status=strided(SHAPE[:3], (0, 0, 0), np.uint8))),
    (ValueError, "out['position']", lambda: PATCHES.evaluate(
        0, *np.ones((2, 9), 'f4'), (), {'position': strided((9, 3), (0, 4))})),
    (ValueError, "out['position']",
     lambda: CURVES.evaluate_grid(9, (), {'position': strided((2, 9, 3), (0, 0, 4))})),
    (ValueError, "out['position']",
     lambda: SIX.evaluate_grid(5, 3, (), {'position': strided((2, 3, 5, 6), (180, 60, 12, 4))})),
    (ValueError, "out['position']", lambda: simdbezier.CurveSet(np.ones((2, 4, 6), 'f4')).
     evaluate_grid(9, (), {'position': strided((2, 9, 6), (108, 12, 4))})),
    # Meshes and nets.
    (TypeError, 'tolerance', lambda: simdbezier.tessellate(POINTS)),
    (ValueError, 'tolerance', lambda: simdbezier.tessellate(POINTS, tolerance=0)),
    (TypeError, 'tolerance', lambda: simdbezier.tessellate(POINTS, tolerance='fine')),
    (ValueError, 'tolerance', lambda: simdbezier.tessellate(POINTS, tolerance=[1e-3] * 3)),
    (ValueError, 'tolerance: expected a number, or one for each of 2 patches, found 0',
     lambda: simdbezier.tessellate(POINTS, tolerance=[])),
    (ValueError, 'relative', lambda: simdbezier.tessellate(POINTS, relative=-1)),
    (ValueError, 'relative', lambda: simdbezier.tessellate(POINTS, 0.1, relative=np.nan)),
    (ValueError, 'tolerance', lambda: simdbezier.tessellate(POINTS, -1.0, relative=0.1)),
    (ValueError, 'grid: expected without', lambda: simdbezier.tessellate(POINTS, 0.1, grid=4)),
    (ValueError, 'grid: expected without',
     lambda: simdbezier.tessellate(POINTS, grid=4, longest_edge=1)),
    (ValueError, 'tolerance or relative', lambda: simdbezier.tessellate(POINTS, 1e-9, relative=0.1)),
    (ValueError, 'crease', lambda: simdbezier.tessellate(POINTS, 0.1, crease=np.nan)),
    (ValueError, 'crease', lambda: simdbezier.tessellate(POINTS, grid=4, crease=-5)),
    (ValueError, 'crease', lambda: simdbezier.tessellate(POINTS, grid=4, crease=181)),
    (ValueError, 'tolerance', lambda: simdbezier.tessellate(POINTS, tolerance=np.inf)),
    (ValueError, 'relative', lambda: simdbezier.tessellate(POINTS, relative=np.inf)),
    (ValueError, 'grid', lambda: simdbezier.tessellate(POINTS, grid=5000)),
    (ValueError, 'snap', lambda: simdbezier.tessellate(POINTS, 0.1, snap=np.nan)),
    (ValueError, 'snap', lambda: simdbezier.tessellate(POINTS, grid=4, snap=-1)),
    (TypeError, 'snap', lambda: simdbezier.tessellate(POINTS, 0.1, snap=None)),
    (ValueError, 'point_size', lambda: simdbezier.tessellate(POINTS, 0.1, point_size=-1)),
    (ValueError, 'longest_edge', lambda: simdbezier.tessellate(POINTS, 0.1, longest_edge=0)),
    (ValueError, 'longest_edge', lambda: simdbezier.tessellate(POINTS, grid=4, longest_edge=np.nan)),
    (ValueError, 'longest_edge', lambda: simdbezier.tessellate(POINTS, longest_edge=1e-9)),
    (TypeError, 'normals', lambda: simdbezier.tessellate(POINTS, 0.1, normals='smooth')),
    (TypeError, 'thorough', lambda: simdbezier.tessellate(POINTS, 0.1, thorough='very')),
    (ValueError, 'thorough: expected with tolerance or relative',
     lambda: simdbezier.tessellate(POINTS, grid=4, thorough=True)),
    (ValueError, 'thorough: expected with tolerance or relative',
     lambda: simdbezier.tessellate(POINTS, longest_edge=1, thorough=True)),
    (TypeError, 'threads', lambda: simdbezier.tessellate(POINTS, 0.1, threads='all')),
    (ValueError, 'grid', lambda: simdbezier.tessellate(POINTS, grid=1)),
    (ValueError, 'grid', lambda: simdbezier.tessellate(POINTS, grid=(3, 3, 3))),
    (TypeError, 'grid', lambda: simdbezier.tessellate(POINTS, grid=3.5)),
    (ValueError, 'points', lambda: simdbezier.tessellate(POINTS[..., :2], tolerance=1)),
    (ValueError, 'path', lambda: simdbezier.tessellate(POINTS, grid=3).save('mesh.png')),
    (ValueError, 'point_data: expected a file in vtu, found ply', lambda: save({}, 'ply')),
    (TypeError, 'point_data', lambda: save([np.zeros(VERTICES)])),
    (TypeError, 'point_data', lambda: save({3: np.zeros(VERTICES)})),
    (ValueError, "point_data['']", lambda: save({'': np.zeros(VERTICES)})),
    (ValueError, "point_data['a\\n']", lambda: save({'a\n': np.zeros(VERTICES)})),
    (ValueError, "point_data['\\ud800']", lambda: save({'\ud800': np.zeros(VERTICES)})),
    (ValueError, "point_data['Normals']", lambda: save({'Normals': np.zeros((VERTICES, 3))})),
    (ValueError, "point_data['patch']", lambda: save({'patch': np.zeros(VERTICES)})),
    (ValueError, "point_data['x']", lambda: save({'x': np.zeros(VERTICES + 1)})),
    (ValueError, "point_data['x']", lambda: save({'x': np.zeros((3, VERTICES))})),
    (ValueError, "point_data['x']", lambda: save({'x': np.zeros((VERTICES, 0))})),
    (ValueError, "point_data['x']", lambda: save({'x': np.zeros((VERTICES, 1, 1))})),
    (ValueError, "point_data['x']", lambda: save({'x': 1.0})),
    (ValueError, "point_data['x']", lambda: save({'x': [[1], [1, 2]]})),
    (TypeError, "point_data['x']", lambda: save({'x': np.zeros(VERTICES, bool)})),
    (TypeError, "point_data['x']", lambda: save({'x': np.zeros(VERTICES, complex)})),
    (TypeError, "point_data['x']", lambda: save({'x': np.zeros(VERTICES, np.float16)})),
    (TypeError, "point_data['x']", lambda: save({'x': np.zeros(VERTICES, np.longdouble)})),
    (TypeError, "point_data['x']", lambda: save({'x': ['a'] * VERTICES})),
    (ValueError, 'path', lambda: simdbezier.tessellate(POINTS, grid=3).save(b'\xff.png')),
    (ValueError, 'path: has a null', lambda: simdbezier.tessellate(POINTS, grid=3).save('a\0b.obj')),
    (TypeError, 'path', lambda: simdbezier.tessellate(POINTS, grid=3).save(3)),
    (TypeError, 'path', lambda: simdbezier.tessellate(POINTS, grid=3).save(None)),
    (ValueError, 'snap: snapping moves', lambda: simdbezier.tessellate(NEAR, 1e-3, snap=0.1)),
    # Points with weights in them.
    (ValueError, 'weights: expected none beside',
     lambda: simdbezier.PatchSet(FOUR, FOUR[..., 0], homogeneous=True)),
    (ValueError, 'points: expected 1 to 16 components, found 0',
     lambda: simdbezier.CurveSet(POINTS[0, :, :, :1], homogeneous=True)),
    (ValueError, 'points: a weight is not positive',
     lambda: simdbezier.PatchSet(-FOUR, homogeneous=True)),
    (ValueError, 'points: a weight is not positive',
     lambda: simdbezier.tessellate(-FOUR, 0.1, homogeneous=True)),
    (ValueError, 'points: a weight is not positive',
     lambda: simdbezier.transpose(-FOUR, homogeneous=True)),
    (TypeError, 'homogeneous', lambda: simdbezier.flatness(FOUR, homogeneous='w')),
    (OSError, '/nowhere/', lambda: simdbezier.tessellate(POINTS, grid=3).save(b'/nowhere/\xff.obj')),
    (TypeError, 'tolerance', lambda: simdbezier.tessellate(POINTS, tolerance=np.array('fine'))),
    (ValueError, 'tolerance', lambda: simdbezier.tessellate(POINTS, tolerance=np.array(-1.0))),
    (OSError, '/nowhere/', lambda: simdbezier.tessellate(POINTS, grid=3).save('/nowhere/x.ply')),
    (ValueError, 'degree_u', lambda: simdbezier.elevate(POINTS, 2, 3)),
    (ValueError, 'degree_v', lambda: simdbezier.elevate(POINTS, 3, 16)),
    (ValueError, 'degree_u: expected 3 to 15, found 1000', lambda: simdbezier.elevate(POINTS, 10**30, 4)),
    (ValueError, 'u:', lambda: simdbezier.split_u(POINTS, np.nan)),
    (ValueError, 'u:', lambda: simdbezier.split_u(POINTS, 1e39)),
    (TypeError, 'u:', lambda: simdbezier.split_u(POINTS, 'half')),
    (ValueError, 'v:', lambda: simdbezier.split(POINTS, 0.5, np.inf)),
    (ValueError, 'u1:', lambda: simdbezier.segment(POINTS, 0, np.nan, 0, 1)),
    (TypeError, 'v0:', lambda: simdbezier.segment(POINTS, 0, 1, None, 1)),
    (ValueError, 'levels', lambda: simdbezier.tight_boxes(POINTS, 7)),
]


@pytest.mark.parametrize('error, argument, call', CASES, ids=[str(k) for k in range(len(CASES))])
def test_it_is_refused_by_name(error, argument, call):
    with pytest.raises(error) as caught:
        call()
    assert str(caught.value).startswith(argument)


# Calls that do not fit, and the one line that they are told: never the arrays of the call.
MISUSES = [
    (lambda: simdbezier.tessellate(POINTS, toleranse=1),
     "tessellate(): no argument is called 'toleranse', expected points, tolerance, weights, "),
    (lambda: simdbezier.tessellate(tolerance=1), "tessellate(): 'points' is missing, expected points, "),
    (lambda: simdbezier.tessellate(POINTS, 1, None, 3),
     'tessellate(): expected at most 3 arguments without a name, found 4'),
    (lambda: simdbezier.tessellate(POINTS, 1, tolerance=1), "tessellate(): 'tolerance' is given twice"),
    (lambda: simdbezier.PatchSet(POINTS, weight=POINTS),
     "PatchSet(): no argument is called 'weight', expected points, weights, dtype, "),
    (lambda: simdbezier.CurveSet(), "CurveSet(): 'points' is missing, expected points, "),
    (lambda: PATCHES.evaluate_grid(5, 5, output='normal'),
     "PatchSet.evaluate_grid(): no argument is called 'output', expected nu, nv, outputs, out, threads"),
    (lambda: PATCHES.evaluate_grid(5), "PatchSet.evaluate_grid(): 'nv' is missing, expected nu, nv, "),
    (lambda: simdbezier.PatchSet.evaluate_grid(CURVES, 5, 5),
     'PatchSet.evaluate_grid(): called with another object as self'),
    (lambda: CURVES.evaluate(0, 1, 'position', None, 0, 7),
     'CurveSet.evaluate(): expected at most 5 arguments without a name, found 6'),
    (lambda: PATCHES.evaluate_derivatives(0, [0.5], [0.5]),
     "PatchSet.evaluate_derivatives(): 'derivatives' is missing, expected patch, u, v, derivatives, "),
    (lambda: PATCHES.evaluate_grid_derivatives(5, 5, orders=[(1, 0)]),
     "PatchSet.evaluate_grid_derivatives(): no argument is called 'orders', expected nu, nv, derivatives, "),
    (lambda: PATCHES.error_bounds(0, 1),
     'PatchSet.error_bounds(): expected at most 1 arguments without a name, found 2'),
    (lambda: simdbezier.flatten(POLYGONS), "flatten(): 'tolerance' is missing, expected points, tolerance, "),
    (lambda: simdbezier.split_u(POINTS, v=0.5),
     "split_u(): no argument is called 'v', expected points, u, weights, homogeneous"),
    (lambda: simdbezier.tessellate(POINTS, grid=3).save(), "Mesh.save(): 'path' is missing, expected path, point_data"),
]


@pytest.mark.parametrize('call, text', MISUSES, ids=[str(k) for k in range(len(MISUSES))])
def test_calls_that_do_not_fit_are_told_so_in_one_line(call, text):
    with pytest.raises(TypeError) as caught:
        call()
    assert str(caught.value).startswith(text) and '\n' not in str(caught.value)


def test_every_function_tells_an_unknown_argument():
    owners = [simdbezier, PATCHES, CURVES, simdbezier.tessellate(POINTS, grid=3)]
    tried = 0
    for owner in owners:
        for name in dir(owner):
            function = getattr(owner, name)
            if name.startswith('_') or not callable(function) or name in (
                    'Mesh', 'PatchIndexError', 'Polylines', 'available_isas'):
                continue
            with pytest.raises(TypeError, match=rf"{name}\(\): no argument is called 'colour', "):
                function(colour=POINTS)
            tried += 1
    assert tried >= 25


def test_four_components_are_told_of_homogeneous_points():
    four = simdbezier.PatchSet(FOUR)
    curves = simdbezier.CurveSet(FOUR[0])
    for call in (lambda: simdbezier.tessellate(FOUR, 0.1), lambda: four.evaluate_grid(3, 3, 'normal'),
                 lambda: curves.evaluate_grid(3, 'tangent')):
        with pytest.raises(ValueError, match='homogeneous=True'):
            call()
    with pytest.raises(ValueError) as caught:
        simdbezier.tessellate(POINTS[..., :2], 0.1)
    assert 'homogeneous' not in str(caught.value)


def test_gltf_is_told_of_glb(tmp_path):
    with pytest.raises(ValueError, match=r'^path: .*mesh\.gltf.*\.glb is glTF in one file'):
        simdbezier.tessellate(POINTS, grid=3).save(tmp_path / 'mesh.gltf')


@pytest.mark.parametrize('name', ['obj', 'ply', 'stl', 'glb'])
def test_a_mesh_with_vertices_that_are_not_there_is_not_saved(name, tmp_path):
    mesh = simdbezier.tessellate(POINTS, grid=3)
    mesh.triangles[-1, 1] = len(mesh.positions)
    with pytest.raises(ValueError, match='^triangles: '):
        mesh.save(tmp_path / f'mesh.{name}')
    assert not list(tmp_path.iterdir())


def test_a_status_alone_is_told_what_it_may_go_with():
    with pytest.raises(ValueError, match='^outputs: .* position, du, .* maximum$'):
        PATCHES.evaluate_grid(5, 3, 'status')


def test_objects_that_were_not_initialised_are_empty():
    patches = simdbezier.PatchSet.__new__(simdbezier.PatchSet)
    curves = simdbezier.CurveSet.__new__(simdbezier.CurveSet)
    mesh = simdbezier.Mesh.__new__(simdbezier.Mesh)
    for one in patches, curves, mesh:
        repr(one)
    assert len(patches) == len(curves) == len(mesh.positions) == len(mesh.triangles) == 0
    assert patches.evaluate_grid(3, 5)['position'].shape == (0, 5, 3, 3)
    assert curves.evaluate_grid(3)['position'].shape == (0, 3, 3)


def test_nothing_is_written_on_an_error():
    position = fresh()
    with pytest.raises(ValueError):
        grid(position=position, normal=read_only())
    with pytest.raises(ValueError):
        PATCHES.evaluate([0, 9], [0.5, 0.5], [0.5, 0.5], out={'position': position[0, 0, :2]})
    assert (position == 7).all()


def test_overlapping_arrays_are_both_named():
    with pytest.raises(ValueError, match=r"out\['normal'\]: overlaps out\['position'\]"):
        two_in_one(1)
    assert two_in_one(3)['normal'].shape == SHAPE


def test_errors_of_the_caller_stay_what_they_are():
    class Count:
        def __index__(self):
            raise KeyError('mine')

    with pytest.raises(KeyError, match='mine'):
        PATCHES.evaluate_grid(Count(), 3)


def test_not_finite_parameters_give_not_finite_samples():
    got = PATCHES.evaluate(0, [0.5, np.nan], [0.5, 0.5], ('position', 'status'))
    assert np.isfinite(got['position'][0]).all() and np.isnan(got['position'][1]).all()
    assert got['status'].tolist() == [0, 3]
