"""Derivatives of any order, judged by fractions: values, shapes, and where they go."""
from math import perm

import numpy as np
import pytest

import exact
import simdbezier

RANDOM = np.random.default_rng(77)
EPS = {np.float32: 2.0**-23, np.float64: 2.0**-52}

# dtype, rows, columns, components, weights
SHAPES = [
    (np.float32, 4, 4, 3, False),
    (np.float64, 4, 4, 3, False),
    (np.float64, 3, 6, 2, True),
    (np.float32, 4, 3, 1, True),
    (np.float64, 2, 9, 5, False),
    (np.float64, 3, 2, 16, False),
]
ORDERS = [(2, 1), (0, 0), (1, 0), (0, 1), (3, 3), (0, 4)]
# Parameters without a rounding, ends and the middle among them.
U = np.array([0, 1, 0.5, 0.25, 0.6875])
V = np.array([1, 0, 0.5, 0.8125, 0.125])


def net_of(shape):
    dtype, rows, columns, components, rational = shape
    points = RANDOM.uniform(-1, 1, (3, rows, columns, components)).astype(dtype)
    weights = RANDOM.uniform(0.5, 2, (3, rows, columns)).astype(dtype) if rational else None
    return points, weights


def scale(shape, a, b):
    """The size of a derivative of points up to 1."""
    _, rows, columns, _, rational = shape
    if rational:  # weights are 0.5 to 2: every order may gain four times the degree
        return (8.0 * columns)**a * (8.0 * rows)**b
    return 2.0**(a + b) * max(perm(columns - 1, a), 1) * max(perm(rows - 1, b), 1)


@pytest.mark.parametrize('shape', SHAPES, ids=str)
def test_samples_are_those_of_fractions(shape):
    points, weights = net_of(shape)
    patch = np.array([2, 0, 1, 1, 0])
    got = simdbezier.PatchSet(points, weights).evaluate_derivatives(patch, U, V, ORDERS)
    assert list(got) == ORDERS
    for a, b in ORDERS:
        assert got[a, b].shape == (5, shape[3]) and got[a, b].dtype == shape[0]
    for k, (p, u, v) in enumerate(zip(patch, U, V)):
        expected = exact.derivatives(points[p], None if weights is None else weights[p], u, v, 3, 4)
        for a, b in ORDERS:
            worst = np.abs(got[a, b][k] - expected[a, b].astype(np.float64)).max()
            assert worst <= 64 * EPS[shape[0]] * scale(shape, a, b), (k, a, b)


def test_derivatives_above_the_degree_vanish_without_weights_alone():
    points = RANDOM.random((1, 3, 4, 3))
    got = simdbezier.PatchSet(points).evaluate_derivatives(0, [0.25], [0.5], [(4, 0), (15, 15), (3, 2)])
    assert not got[4, 0].any() and not got[15, 15].any() and got[3, 2].all()
    weights = 1 + RANDOM.random((1, 3, 4))
    got = simdbezier.PatchSet(points, weights).evaluate_derivatives(0, [0.25], [0.5], [(4, 0)])
    expected = exact.derivatives(points[0], weights[0], 0.25, 0.5, 4)[4, 0].astype(np.float64)
    np.testing.assert_allclose(got[4, 0][0], expected, rtol=1e-10)


@pytest.mark.parametrize('dtype', [np.float32, np.float64])
def test_bits_are_those_of_the_outputs_with_names(dtype):
    points = RANDOM.random((4, 4, 5, 3)).astype(dtype)
    patches = simdbezier.PatchSet(points)
    patch = RANDOM.integers(0, 4, 50)
    u, v = RANDOM.random((2, 50)).astype(dtype)
    names = {'position': (0, 0), 'du': (1, 0), 'dv': (0, 1), 'duu': (2, 0), 'duv': (1, 1), 'dvv': (0, 2)}
    expected = patches.evaluate(patch, u, v, tuple(names))
    got = patches.evaluate_derivatives(patch, u, v, names.values())
    for name, orders in names.items():
        assert np.array_equal(got[orders], expected[name]), name
    assert np.array_equal(patches.evaluate_derivatives(3, u, v, [(2, 1)])[2, 1],
                          patches.evaluate_derivatives([3] * 50, u, v, [(2, 1)])[2, 1])


@pytest.mark.parametrize('nu, nv', [(5, 3), (U, 2), (4, V[::-1]), (U[:1], V.tolist())], ids=str)
@pytest.mark.parametrize('shape', SHAPES[:4], ids=str)
def test_grids_are_made_of_samples(shape, nu, nv):
    points, weights = net_of(shape)
    patches = simdbezier.PatchSet(points, weights)
    u, v = (np.linspace(0, 1, side, dtype=shape[0]) if isinstance(side, int) else np.asarray(side)
            for side in (nu, nv))
    got = patches.evaluate_grid_derivatives(nu, nv, ORDERS)
    pairs = np.tile(u, 3 * len(v)), np.tile(np.repeat(v, len(u)), 3)
    expected = patches.evaluate_derivatives(np.repeat(np.arange(3), len(u) * len(v)), *pairs, ORDERS)
    assert list(got) == ORDERS
    for a, b in ORDERS:
        assert got[a, b].shape == (3, len(v), len(u), shape[3]) and got[a, b].dtype == shape[0]
        values = got[a, b].reshape(-1, shape[3])
        close = 16 * EPS[shape[0]] * scale(shape, a, b)  # thirds have another rounding as numbers
        assert np.abs(values - expected[a, b]).max() <= close


def test_splines_have_the_same_keys_and_values():
    points = RANDOM.random((5, 6, 3))
    spline = simdbezier.SplineSurface(points, (3, 2), ([0, 0, 0, 0, 1, 3, 4, 4, 4, 4], None))
    u, v = 4 * RANDOM.random(40), 3 * RANDOM.random(40)
    orders = [(2, 1), (0, 2), (1, 0)]
    by_spline = spline.evaluate(u, v, outputs=(), derivatives=orders)
    at = spline.locate(u, v)
    by_patch = spline.patch_set.evaluate_derivatives(at['patch'], at['u'], at['v'], orders)
    assert list(by_spline) == list(by_patch) == orders
    for a, b in orders:
        divided = by_patch[a, b] / (at['length_u']**a * at['length_v']**b)[:, None]
        np.testing.assert_allclose(by_spline[a, b], divided, atol=1e-12)


# What asks for (2, 1) and (0, 1).
ASKING = [lambda: [(2, 1), (0, 1)], lambda: ((2, 1), (0, 1)), lambda: iter([(2, 1), (0, 1)]),
          lambda: (pair for pair in [[2, 1], [0, 1]]), lambda: np.array([[2, 1], [0, 1]]),
          lambda: [(2, 1), (0, 1), (2, 1)], lambda: {(2, 1): None, (0, 1): None},
          lambda: [(np.uint8(2), 1), (0, np.int64(1))]]


@pytest.mark.parametrize('ask', ASKING)
def test_orders_come_from_any_iterable(ask):
    patches = simdbezier.PatchSet(RANDOM.random((2, 4, 4, 3)))
    for got in (patches.evaluate_derivatives(1, [0.5], [0.25], ask()),
                patches.evaluate_grid_derivatives([0.5], [0.25], ask())):
        assert list(got) == [(2, 1), (0, 1)]
        assert all(type(order) is int for key in got for order in key)
    spline = simdbezier.SplineSurface(RANDOM.random((4, 4, 3)))
    assert list(spline.evaluate([0.5], [0.25], (), derivatives=ask())) == [(2, 1), (0, 1)]


def frozen(values, dtype):
    array = np.array(values, dtype)
    array.flags.writeable = False
    return array


# Parameters and patches as they may be handed over.
GIVEN = [
    lambda values, dtype: values.tolist(),
    lambda values, dtype: tuple(values),
    lambda values, dtype: np.repeat(values.astype(dtype), 3)[::3],
    lambda values, dtype: values.astype(dtype)[::-1].copy()[::-1],
    lambda values, dtype: values.astype(np.dtype(dtype).newbyteorder()),
    frozen,
]


@pytest.mark.parametrize('give', GIVEN)
def test_parameters_have_any_form(give):
    points = frozen(RANDOM.random((3, 4, 4, 3)), np.float64)[:, ::-1, ::2]
    patches = simdbezier.PatchSet(points)
    patch = np.array([2, 0, 1, 1, 0])
    expected = patches.evaluate_derivatives(patch, U, V, [(1, 1)])[1, 1]
    given = give(U, np.float64), give(V, np.float64)
    got = patches.evaluate_derivatives(give(patch, np.int32), *given, [(1, 1)])[1, 1]
    assert np.array_equal(got, expected)
    grid = patches.evaluate_grid_derivatives(*given, [(1, 1)])[1, 1]
    assert np.array_equal(grid, patches.evaluate_grid(U, V, 'duv')['duv'])


@pytest.mark.parametrize('components', [1, 3, 5])
def test_results_go_where_they_are_asked_to_go(components):
    patches = simdbezier.PatchSet(RANDOM.random((3, 4, 4, components)).astype(np.float32))
    u, v = RANDOM.random((2, 9)).astype(np.float32)
    expected = patches.evaluate_derivatives(1, u, v, [(1, 0), (2, 1)])
    vertices = np.full((9, 2 * components + 2), 7, np.float32)
    planes = np.full((components, 9), 7, np.float32)
    out = {(2, 1): vertices[:, 1:][:, :components], (1, 0): planes.T}
    got = patches.evaluate_derivatives(1, u, v, (), out)
    assert list(got) == list(out) and all(got[key] is out[key] for key in out)
    assert np.array_equal(planes.T, expected[1, 0])
    assert np.array_equal(vertices[:, 1:components + 1], expected[2, 1])
    assert (vertices[:, 0] == 7).all() and (vertices[:, components + 1:] == 7).all()
    # Members of one vertex, and a derivative that is not in `out`.
    out = {(2, 1): vertices[:, :components], (1, 0): vertices[:, components:][:, :components]}
    got = patches.evaluate_derivatives(1, u, v, derivatives=[(0, 2), (1, 0)], out=out)
    assert list(got) == [(0, 2), (1, 0), (2, 1)] and got[0, 2].base is None
    for key in out:
        assert got[key] is out[key] and np.array_equal(out[key], expected[key])
    grid = np.full((3, 4, 5, components), 7, np.float32)[::-1, ::-1, ::-1]
    got = patches.evaluate_grid_derivatives(5, 4, None, {(1, 1): grid}, threads=1)
    assert got[1, 1] is grid
    assert np.array_equal(grid, patches.evaluate_grid(5, 4, 'duv')['duv'])


def test_patches_of_several_degrees():
    nets = [RANDOM.random((2, 4, 4, 3)), RANDOM.random((1, 3, 6, 3))]
    patches = simdbezier.PatchSet(nets)
    got = patches.evaluate_derivatives([2, 1], [0.25, 0.5], [0.5, 0.75], [(4, 1)])[4, 1]
    expected = exact.derivatives(nets[1][0], None, 0.25, 0.5, 4, 1)[4, 1].astype(np.float64)
    np.testing.assert_allclose(got[0], expected, atol=1e-11)
    assert not got[1].any()


@pytest.mark.parametrize('dtype', [np.float32, np.float64])
def test_no_samples_have_empty_derivatives(dtype):
    patches = simdbezier.PatchSet(np.ones((2, 4, 4, 5), dtype))
    got = patches.evaluate_derivatives(0, [], [], [(1, 0)])[1, 0]
    assert got.shape == (0, 5) and got.dtype == dtype
    none = simdbezier.PatchSet(np.zeros((0, 4, 4, 3), dtype))
    got = none.evaluate_grid_derivatives(3, 4, [(1, 0), (3, 3)])
    assert got[3, 3].shape == (0, 4, 3, 3) and got[3, 3].dtype == dtype
    assert none.evaluate_derivatives([], [], [], [(2, 0)])[2, 0].shape == (0, 3)
    raw = simdbezier.PatchSet.__new__(simdbezier.PatchSet)
    assert raw.evaluate_grid_derivatives(3, 4, [(1, 0)])[1, 0].shape == (0, 4, 3, 3)


def test_parameters_that_are_not_finite_change_no_other_sample():
    patches = simdbezier.PatchSet(RANDOM.random((1, 4, 4, 3)))
    got = patches.evaluate_derivatives(0, [0.5, np.nan], [0.5, 0.5], [(1, 1)])[1, 1]
    assert np.isfinite(got[0]).all() and np.isnan(got[1]).all()


@pytest.mark.parametrize('threads', [0, 1, 2])
def test_bits_depend_on_no_thread(threads):
    patches = simdbezier.PatchSet(np.random.default_rng(4).random((300, 4, 4, 3)))
    got = patches.evaluate_grid_derivatives(17, 9, [(2, 1), (1, 3)], threads=threads)
    expected = patches.evaluate_grid_derivatives(17, 9, [(2, 1), (1, 3)], threads=1)
    assert all(np.array_equal(got[key], expected[key]) for key in expected)
