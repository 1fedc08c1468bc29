"""B-splines and NURBS in their own parameters, judged by de Boor's recursion in numpy and by SciPy."""
import threading

import numpy as np
import pytest

import simdbezier

RANDOM = np.random.default_rng(58)
EPS = {np.float32: 2.0**-23, np.float64: 2.0**-52}


def basis(knots, degree, t, order=0):
    """All B-splines at parameters by the recursion, right sides at knots: (parameters, splines)."""
    knots = np.asarray(knots, np.float64)
    t = np.asarray(t, np.float64)
    if order > degree:
        return np.zeros((len(t), len(knots) - degree - 1))
    if order > 0:
        lower = basis(knots, degree - 1, t, order - 1)
        gap = knots[degree:] - knots[:-degree]
        scaled = lower * np.divide(degree, gap, out=np.zeros_like(gap), where=gap > 0)
        return scaled[:, :-1] - scaled[:, 1:]
    last = np.flatnonzero(knots[:-1] < knots[-1])[-1]
    span = np.clip(np.searchsorted(knots, t, 'right') - 1, 0, last)
    values = np.zeros((len(t), len(knots) - 1))
    values[np.arange(len(t)), span] = 1
    for p in range(1, degree + 1):
        gap = knots[p:] - knots[:-p]
        inverse = np.divide(1, gap, out=np.zeros_like(gap), where=gap > 0)
        rising = (t[:, None] - knots[None, :-p]) * inverse
        values = rising[:, :-1] * values[:, :-1] + (1 - rising[:, 1:]) * values[:, 1:]
    return values


def tensor(points, degrees, knots, u, v, a=0, b=0):
    """Derivatives at pairs of parameters; rows are v."""
    in_u = basis(knots[0], degrees[0], u, a)
    in_v = basis(knots[1], degrees[1], v, b)
    return np.einsum('kj,ki,jic->kc', in_v, in_u, np.asarray(points, np.float64))


def random_knots(points, degree, clamped=True):
    inner = np.sort(RANDOM.integers(1, 7, points - degree - 1 + (0 if clamped else 2 * degree)))
    inner = inner.astype(np.float64)
    for value in np.unique(inner):  # at most `degree` times
        here = np.flatnonzero(inner == value)
        inner[here[degree:]] += 0.5
    inner = np.sort(inner)
    if clamped:
        return np.concatenate([np.zeros(degree + 1), inner, np.full(degree + 1, 8.0)])
    return np.concatenate([[-1.0], inner, [9.0]])


def inside(knots, degree, count):
    begin, end = knots[degree], knots[len(knots) - degree - 1]
    return np.concatenate([[begin, end], begin + (end - begin) * RANDOM.random(count)])


SURFACES = [(p, q, clamped, dtype) for p, q in ((1, 1), (2, 3), (3, 3), (5, 2), (7, 4))
            for clamped in (True, False) for dtype in (np.float32, np.float64)]


@pytest.mark.parametrize('p, q, clamped, dtype', SURFACES)
def test_surfaces_are_those_of_de_boor(p, q, clamped, dtype):
    points = RANDOM.uniform(-2, 2, (q + 5, p + 4, 3)).astype(dtype)
    knots = random_knots(p + 4, p, clamped), random_knots(q + 5, q, clamped)
    spline = simdbezier.SplineSurface(points, (p, q), knots)
    u, v = inside(knots[0], p, 40), inside(knots[1], q, 40)
    orders = [(2, 1), (0, 3), (1, 1)]
    names = {'position': (0, 0), 'du': (1, 0), 'dv': (0, 1), 'duv': (1, 1)}
    got = spline.evaluate(u, v, outputs=tuple(names), derivatives=orders)
    assert got['position'].dtype == dtype and got['position'].shape == (42, 3)
    steps = np.diff(spline.intervals[:, :2], axis=1).min(), np.diff(spline.intervals[:, 2:]).min()
    assert np.array_equal(got['duv'], got[1, 1])
    for name, (a, b) in list(names.items()) + [(pair, pair) for pair in orders]:
        # At knots of full multiplicity a derivative has two sides; random parameters lie on none.
        expected = tensor(points, (p, q), knots, u[2:], v[2:], a, b)
        scale = (2 * p / steps[0])**a * (2 * q / steps[1])**b * 2
        worst = np.abs(got[name][2:] - expected).max()
        assert worst <= 24 * (1 + p + q) * EPS[dtype] * scale, (name, worst / EPS[dtype] / scale)
    grid = spline.evaluate_grid(u, v[:5], outputs=('position', 'normal', 'status'),
                                derivatives=[(1, 1)])
    assert grid['position'].shape == (5, 42, 3) and grid['status'].shape == (5, 42)
    pairs = spline.evaluate(np.tile(u, 5), np.repeat(v[:5], 42), outputs=('position', 'normal'),
                            derivatives=[(1, 1)])
    for name in ('position', 'normal', (1, 1)):
        assert np.array_equal(grid[name].reshape(-1, 3), pairs[name])


@pytest.mark.parametrize('dtype', [np.float32, np.float64])
def test_against_scipy(dtype):
    interpolate = pytest.importorskip('scipy.interpolate', reason='scipy is absent')
    for p, q in ((1, 2), (3, 3), (4, 5)):
        nu, nv = p + 6, q + 3
        points = RANDOM.uniform(-1, 1, (nv, nu, 3)).astype(dtype)
        knots = random_knots(nu, p), random_knots(nv, q)
        spline = simdbezier.SplineSurface(points, (p, q), knots)
        u, v = np.sort(inside(knots[0], p, 9)), np.sort(inside(knots[1], q, 8))
        got = spline.evaluate_grid(u, v, derivatives=[(1, 0), (1, 1)])
        for key, (a, b) in (('position', (0, 0)), ((1, 0), (1, 0)), ((1, 1), (1, 1))):
            rows = interpolate.BSpline(knots[0], points.astype(np.float64).swapaxes(0, 1), p)(u, a)
            both = interpolate.BSpline(knots[1], rows.swapaxes(0, 1), q)(v, b)
            scale = (2 * p / np.diff(spline.intervals[:, :2]).min())**a * \
                (2 * q / np.diff(spline.intervals[:, 2:]).min())**b
            assert np.abs(got[key] - both).max() <= 64 * EPS[dtype] * scale, (p, q, key)
        if dtype == np.float64:
            tck = (knots[0], knots[1], points[..., 2].T.ravel(), p, q)
            assert np.abs(interpolate.bisplev(u, v, tck).T - got['position'][..., 2]).max() < 1e-14
        curve = simdbezier.SplineCurve(points[0], p, knots[0])
        line = interpolate.BSpline(knots[0], points[0].astype(np.float64), p)
        at = curve.evaluate(u, outputs=('position', 'd1'), derivatives=(2,))
        for key, order in (('position', 0), ('d1', 1), (2, 2)):
            scale = (2 * p / np.diff(curve.intervals).min())**order
            assert np.abs(at[key] - line(u, order)).max() <= 64 * EPS[dtype] * scale, (p, key)


def circle():
    """A full circle of radius 2 around (5, 0), of degree 2 with 9 control points."""
    corners = np.array([[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]])
    weights = np.where(np.arange(9) % 2 == 1, np.sqrt(0.5), 1.0)
    knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]
    return 2.0 * corners + [5, 0], weights, knots


def test_a_circle_has_its_radius():
    points, weights, knots = circle()
    spline = simdbezier.SplineCurve(points, 2, knots, weights)
    assert spline.spans == len(spline) == 4
    t = np.linspace(0, 4, 401)
    got = spline.evaluate(t, outputs=('position', 'curvature', 'tangent', 'd1'), derivatives=(1,))
    assert np.abs(np.hypot(*(got['position'] - [5, 0]).T) - 2).max() < 2 * 7 * 2.0**-52
    assert np.abs(np.abs(got['curvature']) - 0.5).max() < 1e-13
    assert np.abs(got[1] - got['d1']).max() < 1e-13
    homogeneous = np.column_stack([points * weights[:, None], weights])
    same = simdbezier.SplineCurve(homogeneous, 2, knots, homogeneous=True)
    assert np.abs(same.evaluate(t)['position'] - got['position']).max() < 1e-14
    pieces, piece_weights = spline.to_bezier()
    assert pieces.shape == (4, 3, 2) and piece_weights.shape == (4, 3)
    assert np.array_equal(pieces[0], points[:3]) and np.array_equal(piece_weights[0], weights[:3])
    assert same.to_bezier().shape == (4, 3, 3)
    # Turned around the second axis it is a torus.
    rings = points[:, None, :]
    angle = points - [5, 0]
    torus = np.stack(np.broadcast_arrays(rings[..., 0] * angle[None, :, 0] / 2,
                                         rings[..., 0] * angle[None, :, 1] / 2,
                                         rings[..., 1]), axis=-1)
    surface = simdbezier.SplineSurface(torus, (2, 2), (knots, knots),
                                       weights[:, None] * weights[None, :])
    x, y, z = np.moveaxis(surface.evaluate_grid(t[::7], t[::9])['position'], -1, 0)
    assert np.abs(np.hypot(np.hypot(x, y) - 5, z) - 2).max() < 64 * 2.0**-52
    mesh = simdbezier.tessellate(surface, tolerance=1e-2)
    ring = np.hypot(np.hypot(mesh.positions[:, 0], mesh.positions[:, 1]) - 5, mesh.positions[:, 2])
    assert np.abs(ring - 2).max() < 1e-12 and mesh.deviation <= 1e-2 and len(mesh.deviations) == 16


def test_knots_have_a_right_side():
    knots = [0, 0, 1, 2, 2, 3, 3]
    points = np.array([[0.0], [1], [5], [7], [0]])
    curve = simdbezier.SplineCurve(points, 1, knots)
    assert curve.evaluate([0, 1, 2, 3])['position'].ravel().tolist() == [0, 1, 7, 0]
    assert curve.evaluate([0, 1, 2, 3], 'd1')['d1'].ravel().tolist() == [1, 4, -7, -7]
    assert curve.intervals.tolist() == [[0, 1], [1, 2], [2, 3]]
    found = curve.locate([1, 3, 0.25])
    assert found['curve'].tolist() == [1, 2, 0]
    assert found['t'].tolist() == [0, 1, 0.25] and found['length'].tolist() == [1, 1, 1]


def test_periodic_ones_are_closed():
    points = RANDOM.random((7, 5, 3))
    spline = simdbezier.SplineSurface(points, (3, 2), periodic=(True, True))
    assert spline.spans == (5, 7) and len(spline) == 35
    u, v = np.array([0.25, 1.5]), np.array([6.75, 0.0])
    got = spline.evaluate(u, v)['position']
    assert np.array_equal(spline.evaluate(u + 10, v - 7)['position'], got)
    wrapped = np.pad(points, ((0, 2), (0, 3), (0, 0)), 'wrap')
    expected = tensor(wrapped, (3, 2), (np.arange(-3.0, 9), np.arange(-2.0, 10)), u, v)
    assert np.abs(got - expected).max() < 1e-14
    mesh = simdbezier.tessellate(spline, tolerance=1e-2)
    edges = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()


def test_parts_of_a_domain():
    points = RANDOM.random((4, 6, 3))
    knots = ([0, 0, 0, 0, 1, 2, 3, 3, 3, 3], None)
    whole = simdbezier.SplineSurface(points, (3, 3), knots)
    part = simdbezier.SplineSurface(points, (3, 3), knots, ranges=((0.5, 2), None))
    assert part.intervals.tolist() == [[0.5, 1, 0, 1], [1, 2, 0, 1]]
    u = np.array([0.5, 1.25, 2])
    difference = whole.evaluate(u, [0.5] * 3)['position'] - part.evaluate(u, [0.5] * 3)['position']
    assert np.abs(difference).max() < 1e-15
    nearly = ([0, 0, 0, 0, 1, 1 + 1e-13, 3, 3, 3, 3], None)
    assert simdbezier.SplineSurface(points, (3, 3), nearly).spans == (3, 1)
    assert simdbezier.SplineSurface(points, (3, 3), nearly, knot_tolerance=1e-12).spans == (2, 1)


def test_patches_are_those_of_a_set():
    points = RANDOM.random((5, 6, 4)).astype(np.float32)
    spline = simdbezier.SplineSurface(points, (2, 3), dtype=np.float64)
    nets = spline.to_bezier()
    assert nets.shape == (8, 4, 3, 4) and nets.dtype == np.float32
    assert np.array_equal(nets, simdbezier.spline_to_bezier(points, (2, 3)))
    patches = spline.patch_set
    assert len(patches) == len(spline) == 8 and patches.degrees(7) == (2, 3)
    assert patches.dtype == spline.dtype == np.float64 and spline.components == 4
    u, v = np.array([0.5, 3.25]), np.array([1.5, 0.25])
    found = spline.locate(u, v)
    assert found['patch'].tolist() == [4, 3]
    on_patches = patches.evaluate(found['patch'], found['u'], found['v'])['position']
    assert np.abs(spline.evaluate(u, v)['position'] - on_patches).max() < 1e-15
    assert repr(spline) == ('<simdbezier.SplineSurface: 4 x 2 patches of degree 2 x 3, '
                            '4 components, float64>')
    out = np.full((2, 5), 7.0)
    spline.evaluate(u, v, outputs=(), out={'position': out[:, :4]})
    assert (out[:, 4] == 7).all() and np.array_equal(out[:, :4], spline.evaluate(u, v)['position'])


def test_points_and_knots_are_copied():
    points, knots = RANDOM.random((4, 3)), np.array([0.0, 0, 0, 0, 1, 1, 1, 1])
    spline = simdbezier.SplineCurve(points, knots=knots)
    expected = points.copy()
    points[:] = knots[:] = 9
    assert np.array_equal(spline.to_bezier()[0], expected)
    assert spline.evaluate([0, 1])['position'].tolist() == expected[[0, 3]].tolist()


def test_meshes_of_several():
    left = RANDOM.random((4, 4, 3))
    right = RANDOM.random((3, 5, 3)).astype(np.float32)
    one, other = simdbezier.SplineSurface(left), simdbezier.SplineSurface(right, (2, 1))
    mesh = simdbezier.tessellate([one, other], tolerance=1e-3)
    assert mesh.positions.dtype == np.float64 and len(mesh.deviations) == 1 + 3 * 2
    assert (mesh.deviations > 0).all() and mesh.deviation <= 1e-3
    # What the splines are rounded by is part of what is certified.
    far = (left + [1e6, 0, 0]).astype(np.float32)
    spline = simdbezier.SplineSurface(far, (1, 1), dtype=np.float64)
    of_spline = simdbezier.tessellate(spline, grid=2)
    of_nets = simdbezier.tessellate(spline.to_bezier(), grid=2, dtype=np.float64)
    assert of_spline.deviation - of_nets.deviation > 1e6 * 2.0**-24


def test_threads_share_one_spline():
    spline = simdbezier.SplineSurface(RANDOM.random((40, 40, 3)))
    results = []

    def run():
        results.append(spline.evaluate_grid([0.5, 20.25], [3.5])['position'])

    threads = [threading.Thread(target=run) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 4 and all(np.array_equal(one, results[0]) for one in results)


POINTS = np.arange(60.0).reshape(4, 5, 3)
KNOTS = [0, 0, 0, 0, 1, 2, 2, 2, 2]
SURFACE = simdbezier.SplineSurface(POINTS, knots=(KNOTS, None))
CURVE = simdbezier.SplineCurve(POINTS[0], knots=KNOTS)


def surface(**arguments):
    return simdbezier.SplineSurface(POINTS, **arguments)


def curve(**arguments):
    return simdbezier.SplineCurve(POINTS[0], **arguments)


def spoiled(at, value):
    points = POINTS.copy()
    points[at] = value
    return points


# The error, what its text begins with, something that it says, and the call.
CASES = [
    (ValueError, 'points', '3 dimensions', lambda: simdbezier.SplineSurface(POINTS[0])),
    (ValueError, 'points', '2 dimensions', lambda: simdbezier.SplineCurve(POINTS)),
    (TypeError, 'points', 'complex', lambda: simdbezier.SplineSurface(POINTS.astype(complex))),
    (ValueError, 'points', 'components', lambda: simdbezier.SplineSurface(np.zeros((4, 4, 17)))),
    (ValueError, 'points', '6 columns or more for degree 5, found 5', lambda: surface(degrees=(5, 3))),
    (ValueError, 'points', '5 rows or more for degree 4, found 4', lambda: surface(degrees=(3, 4))),
    (ValueError, 'points', '(row 2, column 3, component 1)',
     lambda: len(simdbezier.SplineSurface(spoiled((2, 3, 1), np.nan)).patch_set)),
    (ValueError, 'points', '(point 3, component 1)',
     lambda: simdbezier.SplineCurve(spoiled((0, 3, 1), np.inf)[0]).evaluate([0.5])),
    (ValueError, 'weights', '(row 1, column 0)',
     lambda: surface(weights=1.0 * (np.arange(20).reshape(4, 5) != 5)).to_bezier()),
    (ValueError, 'points', 'number type (row 2, column 3, component 1)',
     lambda: simdbezier.SplineSurface(spoiled((2, 3, 1), 1e200), weights=np.full((4, 5), 1e200)).patch_set),
    (ValueError, 'points', 'number type (point 3, component 1)',
     lambda: simdbezier.SplineCurve(spoiled((0, 3, 1), 1e200)[0], weights=np.full(5, 1e200)).curve_set),
    (ValueError, 'weights', 'shape', lambda: surface(weights=np.ones((5, 4)))),
    (ValueError, 'weights', 'homogeneous', lambda: surface(weights=np.ones((4, 5)), homogeneous=True)),
    (ValueError, 'degrees[0]', '1 to 15, found 16', lambda: surface(degrees=(16, 3))),
    (ValueError, 'degrees[1]', '1 or more', lambda: surface(degrees=(3, 0))),
    (TypeError, 'degrees[1]', 'integer', lambda: surface(degrees=(3, 2.5))),
    (ValueError, 'degrees', 'pair', lambda: surface(degrees=3)),
    (ValueError, 'degree', '1 to 15', lambda: curve(degree=99)),
    (ValueError, 'knots', 'pair', lambda: surface(knots=KNOTS)),
    (ValueError, 'knots[0]', '9 knots for 5 points of degree 3, found 8',
     lambda: surface(knots=(KNOTS[:-1], None))),
    (ValueError, 'knots[0]', 'openNURBS', lambda: surface(knots=(KNOTS[1:-1], None))),
    (ValueError, 'knots[1]', '8 knots for 4 points', lambda: surface(knots=(None, KNOTS))),
    (ValueError, 'knots[0]', 'number 5, 0.5, is below the one before it, 1.0',
     lambda: surface(knots=([0, 0, 0, 0, 1, 0.5, 2, 2, 2], None))),
    (ValueError, 'knots[0]', 'number 4, 0.0, occurs more than 4 times',
     lambda: surface(knots=([0, 0, 0, 0, 0, 2, 2, 2, 2], None))),
    (ValueError, 'knots[0]', 'more than 4 times, together with those within knot_tolerance',
     lambda: surface(knots=([0, 0, 0, 0, 0.1, 2, 2, 2, 2], None), knot_tolerance=0.2)),
    (ValueError, 'knots[0]', 'beyond 2^1000', lambda: surface(knots=(KNOTS[:-1] + [1e305], None))),
    (ValueError, 'knots[0]', 'number 4, nan', lambda: surface(knots=(KNOTS[:4] + [np.nan] + KNOTS[5:], None))),
    (ValueError, 'knots', 'number 8, inf', lambda: curve(knots=KNOTS[:8] + [np.inf])),
    (ValueError, 'knots[1]', 'the domain begins and ends at 0.0',
     lambda: surface(knots=(None, [-3, -2, -1, 0, 0, 1, 2, 3]))),
    (TypeError, 'knots', 'float64', lambda: curve(knots=['a'] * 9)),
    (ValueError, 'knots', 'None for uniform', lambda: curve(knots=[])),
    (ValueError, 'ranges[0]', 'a part of 0.0 to 2.0, found -1.0 to 1.0',
     lambda: surface(knots=(KNOTS, None), ranges=((-1, 1), None))),
    (ValueError, 'ranges[1]', 'ascending', lambda: surface(ranges=(None, (1, 1)))),
    (ValueError, 'range', 'a part of 0.0 to 2.0, found 1.0 to 3.0', lambda: curve(knots=KNOTS, range=(1, 3))),
    (ValueError, 'range', 'two numbers', lambda: curve(range=(1, 2, 3))),
    (TypeError, 'periodic[0]', 'True or False', lambda: surface(periodic=('no', False))),
    (ValueError, 'periodic', 'pair', lambda: surface(periodic=True)),
    (ValueError, 'knot_tolerance', '0 or more', lambda: surface(knot_tolerance=-1)),
    (TypeError, 'knot_tolerance', 'number', lambda: surface(knot_tolerance='1')),
    (TypeError, 'dtype', 'int', lambda: surface(dtype=np.int32)),
    (ValueError, 'U', 'number 1, 2.5, is outside of 0.0 to 2.0', lambda: SURFACE.evaluate([0, 2.5], [0, 1])),
    (ValueError, 'V', 'number 0, nan', lambda: SURFACE.evaluate_grid([0, 1], [np.nan])),
    (ValueError, 'V', 'number 2, -1.0', lambda: SURFACE.locate([0, 0, 0], [0, 1, -1])),
    (ValueError, 'V', 'expected 2 values', lambda: SURFACE.evaluate([0, 1], [0])),
    (ValueError, 'U', 'one dimension', lambda: SURFACE.evaluate([[0, 1]], [0])),
    (TypeError, 'U', 'float', lambda: SURFACE.evaluate('abc', [0])),
    (ValueError, 't', 'number 1, 3.0, is outside of 0.0 to 2.0', lambda: CURVE.evaluate([0, 3])),
    (ValueError, 't', 'nan', lambda: CURVE.locate([np.nan])),
    (ValueError, 'outputs', 'none of', lambda: SURFACE.evaluate([0], [0], 'd1')),
    (ValueError, 'outputs', 'at least one', lambda: SURFACE.evaluate([0], [0], ())),
    (ValueError, "out['position']", 'shape',
     lambda: SURFACE.evaluate_grid([0], [0, 1], out={'position': np.zeros((1, 2, 3))})),
    (ValueError, 'derivatives', 'pairs', lambda: SURFACE.evaluate([0], [0], derivatives=[1])),
    (ValueError, 'derivatives', 'or more', lambda: SURFACE.evaluate([0], [0], derivatives=[(0, -1)])),
    (ValueError, 'derivatives', 'at most', lambda: CURVE.evaluate([0], derivatives=[10**6])),
    (TypeError, 'derivatives', 'orders', lambda: CURVE.evaluate([0], derivatives=2)),
    (ValueError, 'weights', 'splines', lambda: simdbezier.tessellate(SURFACE, 0.1, np.ones((4, 5)))),
    (TypeError, 'points', 'alone', lambda: simdbezier.tessellate([SURFACE, POINTS], 0.1)),
    (TypeError, 'points', 'evaluate() samples', lambda: simdbezier.tessellate(CURVE, 0.1)),
    (ValueError, 'points[1]', '(row 2, column 3, component 1)',
     lambda: simdbezier.tessellate([SURFACE, simdbezier.SplineSurface(spoiled((2, 3, 1), np.nan))], 0.1)),
    (ValueError, 'points', 'three components',
     lambda: simdbezier.tessellate(simdbezier.SplineSurface(POINTS[..., :2]), 0.1)),
    (ValueError, 'tolerance', 'each of 2 patches', lambda: simdbezier.tessellate(SURFACE, [0.1] * 3)),
    (ValueError, 'tolerance', '', lambda: simdbezier.tessellate(SURFACE, 1e-18)),
    (ValueError, 'knots[0]', 'found 8', lambda: simdbezier.spline_to_bezier(POINTS, knots=(KNOTS[1:], None))),
    (TypeError, 'SplineSurface(): no argument is called', 'degree', lambda: surface(degree=(3, 3))),
]


@pytest.mark.parametrize('error, begins, says, call', CASES)
def test_errors_name_the_argument(error, begins, says, call):
    with pytest.raises(error) as caught:
        call()
    text = str(caught.value)
    assert text.startswith(begins) and says in text, text


def test_results_stay_untouched_where_a_parameter_is_outside():
    out = np.full((2, 3), 7.0)
    with pytest.raises(ValueError):
        SURFACE.evaluate([0, 9], [0, 0], out={'position': out})
    with pytest.raises(ValueError):
        CURVE.evaluate([0, 9], out={'position': out})
    assert (out == 7).all()


def test_objects_without_a_constructor_are_empty():
    for kind, arguments in ((simdbezier.SplineSurface, ([0.0], [0.0])), (simdbezier.SplineCurve, ([0.0],))):
        empty = kind.__new__(kind)
        assert len(empty) == 0
        repr(empty)
        with pytest.raises(ValueError):
            empty.evaluate(*arguments)
        with pytest.raises(ValueError):
            empty.to_bezier()
