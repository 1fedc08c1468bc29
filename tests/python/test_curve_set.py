"""CurveSet against the definition."""
import numpy as np
import pytest

import exact
import reference
import simdbezier

SHAPES = [(np.float32, 4, 3), (np.float64, 4, 2), (np.float64, 9, 1), (np.float32, 2, 5)]


@pytest.mark.parametrize('dtype, count, components', SHAPES)
def test_curves_are_those_of_the_definition(dtype, count, components):
    points = np.random.default_rng(2).random((6, count, components)).astype(dtype)
    curves = simdbezier.CurveSet(points)
    got = curves.evaluate_grid(16, outputs=('position', 'd1', 'd2'))
    close = 1e-3 if dtype == np.float32 else 1e-10
    for order, name in enumerate(('position', 'd1', 'd2')):
        if order < count:
            expected = reference.curve(points, np.linspace(0, 1, 16), order)
            np.testing.assert_allclose(got[name], expected, atol=close)
    t = np.random.default_rng(3).random(9).astype(dtype)
    which = np.arange(9) % 6
    single = curves.evaluate(which, t)['position']
    np.testing.assert_allclose(single, reference.curve(points, t)[which, np.arange(9)], atol=close)
    worst = np.abs(curves.evaluate_grid(17)['position'][2] -
                   reference.curve(points, np.linspace(0, 1, 17))[2]).max(axis=0)
    assert (worst <= curves.error_bounds(2)['position'] + 1e-14).all()


def test_a_rational_quarter_circle_is_round():
    points = np.array([[[1, 0], [1, 1], [0, 1]]], float)
    curves = simdbezier.CurveSet(points, weights=[[1, np.sqrt(0.5), 1]])
    got = curves.evaluate_grid(33, ('position', 'tangent', 'curvature', 'status'))
    np.testing.assert_allclose(np.linalg.norm(got['position'], axis=-1), 1, atol=1e-14)
    np.testing.assert_allclose(got['curvature'], 1, atol=1e-12)
    np.testing.assert_allclose((got['position'] * got['tangent']).sum(axis=-1), 0, atol=1e-14)
    assert curves.rational and curves.degree == 2


def test_results_go_where_they_are_asked_to_go():
    points = np.random.default_rng(4).random((6, 4, 3)).astype(np.float32)
    curves = simdbezier.CurveSet(points)
    planes = np.empty((3, 6, 5), np.float32)
    out = {'position': np.moveaxis(planes, 0, -1)}
    assert curves.evaluate_grid(5, out=out)['position'] is out['position']
    assert np.array_equal(planes.transpose(1, 2, 0), curves.evaluate_grid(5)['position'])


def test_it_says_what_it_is():
    curves = simdbezier.CurveSet(np.zeros((3, 4, 2)), dtype='float32')
    assert repr(curves) == '<simdbezier.CurveSet: 3 curves of degree 3, 2 components, float32>'
    assert len(curves) == 3 and curves.components == 2 and curves.dtype == np.float32


def test_names_come_from_a_generator():
    curves = simdbezier.CurveSet(np.ones((2, 4, 3), np.float32))
    got = curves.evaluate_grid(5, (name for name in ('position', 'd1')))
    assert list(got) == ['position', 'd1']


@pytest.mark.parametrize('rational', [False, True])
@pytest.mark.parametrize('dtype, count, components', SHAPES)
def test_bounds_of_all_curves_are_those_of_each(dtype, count, components, rational):
    random = np.random.default_rng(2)
    points = random.random((6, count, components)).astype(dtype)
    weights = (0.5 + random.random((6, count))).astype(dtype) if rational else None
    curves = simdbezier.CurveSet(points, weights)
    got = curves.error_bounds()
    assert list(got) == ['position', 'd1', 'd2']
    at = curves.evaluate([5, 0, 3], [0.6875, 0.25, 1], tuple(got))
    for order, (name, rows) in enumerate(got.items()):
        assert rows.shape == (6, components) and rows.dtype == np.float64
        assert np.array_equal(rows, [curves.error_bounds(k)[name] for k in range(6)])
        for k, (curve, t) in enumerate(((5, 0.6875), (0, 0.25), (3, 1))):
            of = exact.curve_derivatives(points[curve], None if weights is None else weights[curve], t, 2)
            for c, expected in enumerate(of[order]):
                apart = abs(exact.Fraction(float(at[name][k, c])) - expected)
                assert apart <= rows[curve, c], (name, k, c)


def test_bounds_belong_to_their_outputs():
    # Second derivatives vanish, but for what packing may lose.
    curves = simdbezier.CurveSet(np.arange(4.0)[None, :, None])
    for bounds in (curves.error_bounds(), curves.error_bounds(0)):
        assert [bounds[name].max() > 1e-20 for name in ('position', 'd1', 'd2')] == [True, True, False]


def test_bounds_of_no_curves():
    empty = simdbezier.CurveSet(np.zeros((0, 4, 2))).error_bounds()
    assert all(rows.shape == (0, 2) and rows.dtype == np.float64 for rows in empty.values())
    raw = simdbezier.CurveSet.__new__(simdbezier.CurveSet)
    assert raw.error_bounds()['d2'].shape == (0, 3)
