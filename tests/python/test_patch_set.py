"""PatchSet against the definition, and where its results go."""
import numpy as np
import pytest

import exact
import reference
import simdbezier

# dtype, rows, columns, components, weights
SHAPES = [
    (np.float32, 4, 4, 3, False),
    (np.float64, 4, 4, 3, False),
    (np.float32, 3, 6, 3, True),
    (np.float64, 2, 9, 2, False),
    (np.float32, 4, 3, 1, False),
    (np.float64, 4, 4, 5, True),
    (np.float64, 16, 2, 16, False),
]


@pytest.fixture(params=SHAPES, ids=str)
def net(request):
    dtype, rows, columns, components, rational = request.param
    random = np.random.default_rng(7)
    points = random.random((5, rows, columns, components)).astype(dtype)
    weights = (0.5 + random.random((5, rows, columns))).astype(dtype) if rational else None
    return points, weights


def tolerance(points):
    """Far above what rounding does, far below any mistake."""
    return 1e-4 if points.dtype == np.float32 else 1e-11


def test_grids_are_those_of_the_definition(net):
    points, weights = net
    patches = simdbezier.PatchSet(points, weights)
    got = patches.evaluate_grid(7, 4, outputs=('position', 'du', 'dv'))
    expected = reference.surface(points, weights, *reference.grid(7, 4))
    for name, values in zip(('position', 'du', 'dv'), expected):
        assert got[name].shape == (5, 4, 7, points.shape[3])
        assert got[name].dtype == points.dtype
        np.testing.assert_allclose(got[name].reshape(values.shape), values,
                                   atol=tolerance(points), rtol=tolerance(points))


# Gauss points, and what else may be handed over as parameters.
U = (np.polynomial.legendre.leggauss(5)[0] + 1) / 2
V = np.array([1, 0.25, 0, 0.75])


@pytest.mark.parametrize('u, v', [(U, V), (U.tolist(), V), (U, 4), (6, V), (U[:1], tuple(V)),
                                  (np.repeat(U, 2)[::2], V[::-1]), (np.array([0, 1]), V),
                                  (np.arange(70) / 69, V), (U.astype('>f8'), V.astype('>f4'))],
                         ids=str)
def test_grids_take_parameters(net, u, v):
    points, weights = net
    patches = simdbezier.PatchSet(points, weights)
    in_u, in_v = (np.linspace(0, 1, side) if isinstance(side, int) else np.asarray(side, points.dtype)
                  for side in (u, v))
    got = patches.evaluate_grid(u, v, outputs=('position', 'du', 'dv'))
    pairs = np.tile(in_u, len(in_v)), np.repeat(in_v, len(in_u))
    for name, values in zip(('position', 'du', 'dv'), reference.surface(points, weights, *pairs)):
        assert got[name].shape == (5, len(in_v), len(in_u), points.shape[3])
        np.testing.assert_allclose(got[name].reshape(values.shape), values,
                                   atol=tolerance(points), rtol=tolerance(points))


def test_uniform_parameters_are_those_of_a_number():
    points = np.random.default_rng(4).random((3, 4, 4, 3)).astype(np.float32)
    patches = simdbezier.PatchSet(points)
    side = np.arange(9, dtype=np.float32) / 8
    assert np.array_equal(patches.evaluate_grid(side, side)['position'],
                          patches.evaluate_grid(9, 9)['position'])


@pytest.mark.parametrize('several', [False, True])
def test_homogeneous_points_are_points_with_weights(net, several):
    points, weights = net
    if weights is None or points.shape[3] == 16:
        weights = np.ones(points.shape[:3], points.dtype)
        points = points[..., :3]
    homogeneous = np.concatenate([points * weights[..., None], weights[..., None]], axis=-1)
    patches = simdbezier.PatchSet([homogeneous[:2], homogeneous[2:]] if several else homogeneous,
                                  homogeneous=True)
    assert patches.components == points.shape[3] and patches.is_rational(4)
    got = patches.evaluate_grid(7, 4, outputs=('position', 'du', 'dv'))
    expected = reference.surface(points, weights, *reference.grid(7, 4))
    for name, values in zip(('position', 'du', 'dv'), expected):
        np.testing.assert_allclose(got[name].reshape(values.shape), values,
                                   atol=tolerance(points), rtol=tolerance(points))


def test_positions_keep_their_bound(net):
    points, weights = net
    patches = simdbezier.PatchSet(points, weights)
    got = patches.evaluate_grid(9, 5)['position']
    expected, _, _ = reference.surface(points, weights, *reference.grid(9, 5))
    # Parameters are exact here; the reference has errors of its own.
    slack = 1e-14
    for k in range(len(patches)):
        worst = np.abs(got[k].reshape(-1, points.shape[3]) - expected[k]).max(axis=0)
        assert (worst <= patches.error_bounds(k)['position'] + slack).all()


def test_bounds_of_all_patches_are_those_of_each(net):
    points, weights = net
    patches = simdbezier.PatchSet(points, weights)
    got = patches.error_bounds()
    assert list(got) == ['position', 'du', 'dv']
    for name, rows in got.items():
        assert rows.shape == (5, points.shape[3]) and rows.dtype == np.float64
        assert rows.flags.c_contiguous and rows.flags.writeable
        for k, row in enumerate(rows):
            assert np.array_equal(row, patches.error_bounds(k)[name]), (name, k)
            assert np.array_equal(row, patches.error_bounds(patch=np.uint8(k))[name])
    assert all(np.array_equal(rows, patches.error_bounds(None)[name]) for name, rows in got.items())


def test_bounds_of_all_patches_hold_in_fractions(net):
    points, weights = net
    patches = simdbezier.PatchSet(points, weights)
    bounds = patches.error_bounds()
    patch, u, v = np.array([4, 0, 2]), np.array([0.25, 0.6875, 1]), np.array([0.8125, 0.5, 0.125])
    got = patches.evaluate(patch, u, v, tuple(bounds))
    for k, p in enumerate(patch):
        of = exact.derivatives(points[p], None if weights is None else weights[p], u[k], v[k], 1, 1)
        for name, orders in (('position', (0, 0)), ('du', (1, 0)), ('dv', (0, 1))):
            for c, expected in enumerate(of[orders]):
                apart = abs(exact.Fraction(float(got[name][k, c])) - expected)
                assert apart <= bounds[name][p, c] < 1e-3, (k, name, c)


def test_bounds_belong_to_their_outputs():
    points = np.zeros((2, 3, 4, 3))
    points[0, ..., 0] = [0, 1, 5, 2]  # the first patch changes with u alone, the second with v
    points[1, ..., 1] = np.array([[0], [3], [1]])
    patches = simdbezier.PatchSet(points)
    # Where nothing changes, bounds are what packing may lose.
    got = {name: (rows > 1e-20).tolist() for name, rows in patches.error_bounds().items()}
    assert got['position'] == [[True, False, False], [False, True, False]]
    assert got['du'] == [[True, False, False], [False] * 3]
    assert got['dv'] == [[False] * 3, [False, True, False]]
    assert patches.error_bounds(0)['du'][0] > 1e-20 > patches.error_bounds(0)['dv'].max()


def test_bounds_of_all_patches_of_several_degrees():
    random = np.random.default_rng(1)
    patches = simdbezier.PatchSet([random.random((2, 4, 4, 2)), random.random((3, 3, 6, 2))])
    got = patches.error_bounds()
    for name, rows in got.items():
        singles = [patches.error_bounds(k)[name] for k in range(5)]
        assert np.array_equal(rows, singles) and len(set(rows[:, 0])) == 5
    empty = simdbezier.PatchSet(np.zeros((0, 4, 4, 3), np.float32)).error_bounds()
    assert all(rows.shape == (0, 3) and rows.dtype == np.float64 for rows in empty.values())
    raw = simdbezier.PatchSet.__new__(simdbezier.PatchSet)
    assert raw.error_bounds()['dv'].shape == (0, 3)


def test_single_samples_are_those_of_the_definition(net):
    points, weights = net
    random = np.random.default_rng(3)
    patch = random.integers(0, 5, 40)
    u, v = random.random((2, 40)).astype(points.dtype)
    got = simdbezier.PatchSet(points, weights).evaluate(patch, u, v, ('position', 'dv'))
    position, _, dv = reference.surface(points, weights, u, v)
    rows = np.arange(40)
    for name, values in (('position', position), ('dv', dv)):
        np.testing.assert_allclose(got[name], values[patch, rows], atol=tolerance(points),
                                   rtol=tolerance(points))


def test_normals_are_unit_and_upright():
    points = np.random.default_rng(5).random((3, 4, 4, 3))
    got = simdbezier.PatchSet(points).evaluate_grid(6, 6, ('du', 'dv', 'normal', 'status'))
    expected = np.cross(got['du'], got['dv'])
    expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
    np.testing.assert_allclose(got['normal'], expected, atol=1e-12)
    assert got['status'].dtype == np.uint8
    assert not got['status'].any()


def test_second_derivatives_and_curvatures():
    # The graph of x y: duu and dvv vanish, K = -1 and H = 0 in the middle of the saddle.
    points = np.zeros((1, 2, 2, 3))
    points[0, :, :, 0] = [[-1, 1], [-1, 1]]
    points[0, :, :, 1] = [[-1, -1], [1, 1]]
    points[0, :, :, 2] = [[1, -1], [-1, 1]]
    names = ('duu', 'duv', 'dvv', 'gaussian', 'mean', 'minimum', 'maximum')
    got = simdbezier.PatchSet(points).evaluate(0, [0.5], [0.5], names)
    assert got['duv'].tolist() == [[0, 0, 4]]
    assert not got['duu'].any() and not got['dvv'].any()
    assert [got[name][0] for name in names[3:]] == pytest.approx([-1, 0, -1, 1])


def test_patches_of_several_degrees_are_one_set():
    random = np.random.default_rng(1)
    nets = [random.random((2, 4, 4, 3)), random.random((3, 3, 6, 3))]
    patches = simdbezier.PatchSet(nets)
    assert [patches.degrees(k) for k in range(5)] == [(3, 3)] * 2 + [(5, 2)] * 3
    got = patches.evaluate_grid(4, 3)['position']
    for part, points in ((got[:2], nets[0]), (got[2:], nets[1])):
        expected, _, _ = reference.surface(points, None, *reference.grid(4, 3))
        np.testing.assert_allclose(part.reshape(expected.shape), expected, atol=1e-12)
    assert 'several shapes' in repr(patches)


def test_dtype_is_that_of_the_points_or_as_asked_for():
    points = np.random.default_rng(2).random((1, 4, 4, 3))
    assert simdbezier.PatchSet(points).dtype == np.float64
    assert simdbezier.PatchSet(points.astype(np.float32)).dtype == np.float32
    assert simdbezier.PatchSet(points, dtype='float32').dtype == np.float32
    single = simdbezier.PatchSet(points, dtype=np.float32).evaluate_grid(3, 3)['position']
    assert single.dtype == np.float32
    assert simdbezier.PatchSet(points.tolist()).dtype == np.float64
    assert simdbezier.PatchSet(points.astype(np.float16)).dtype == np.float64
    assert simdbezier.PatchSet(np.zeros((1, 2, 2, 3), int)).dtype == np.float64


@pytest.mark.parametrize('threads', [1, 2])
def test_bits_depend_on_nothing(threads):
    points = np.random.default_rng(4).random((300, 4, 4, 3)).astype(np.float32)
    expected = simdbezier.PatchSet(points).evaluate_grid(17, 9, ('position', 'normal'))
    got = simdbezier.PatchSet(points, threads=threads).evaluate_grid(
        17, 9, ('position', 'normal'), threads=threads)
    for name in expected:
        assert np.array_equal(got[name], expected[name])


def test_an_empty_set_has_empty_results():
    patches = simdbezier.PatchSet(np.zeros((0, 4, 4, 3)))
    assert len(patches) == 0
    assert patches.evaluate_grid(3, 3)['position'].shape == (0, 3, 3, 3)


def test_it_says_what_it_is():
    points = np.ones((2, 3, 4, 3), np.float32)
    text = '<simdbezier.PatchSet: 2 patches of degree 3 x 2, 3 components, float32>'
    assert repr(simdbezier.PatchSet(points)) == text
    rational = simdbezier.PatchSet(points[:1], np.ones((1, 3, 4)))
    assert repr(rational) == ('<simdbezier.PatchSet: 1 patch of degree 3 x 2, rational, '
                              '3 components, float32>')
    assert rational.is_rational(0) and not simdbezier.PatchSet(points).is_rational(1)


# Names that can be run through only once, and what is asked for beside them.
NAMES = [((lambda: (name for name in ('position', 'du'))), (), ['position', 'du']),
         ((lambda: iter(['normal'])), (), ['normal']),
         ((lambda: map(str, ['du'])), ('position',), ['du', 'position']),
         ((lambda: dict.fromkeys(['position']).keys()), (), ['position'])]


@pytest.mark.parametrize('names, given, expected', NAMES)
def test_names_come_from_any_iterable(names, given, expected):
    patches = simdbezier.PatchSet(np.ones((2, 4, 4, 3), np.float32))
    out = {name: np.empty((2, 3, 5, 3), np.float32) for name in given}
    assert list(patches.evaluate_grid(5, 3, names(), out)) == expected


@pytest.mark.parametrize('dtype', [np.float32, np.float64])
def test_bytes_in_another_order_are_the_same_numbers(dtype):
    points = np.random.default_rng(3).random((2, 4, 4, 3)).astype(dtype)
    swapped = simdbezier.PatchSet(points.astype(np.dtype(dtype).newbyteorder()))
    assert swapped.dtype == dtype
    assert np.array_equal(swapped.evaluate_grid(5, 3)['position'],
                          simdbezier.PatchSet(points).evaluate_grid(5, 3)['position'])
