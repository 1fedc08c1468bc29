"""Polylines of curves, judged by fractions: points, numbers of points, and the certified distance."""
import numpy as np
import pytest

import exact
import simdbezier

# dtype, points, components, weights
SHAPES = [(np.float32, 4, 3, False), (np.float64, 4, 2, False), (np.float64, 3, 3, True),
          (np.float32, 6, 1, True), (np.float64, 5, 5, False), (np.float64, 2, 7, False)]
TOLERANCE = 1e-2


def curves_of(shape, count=4):
    random = np.random.default_rng(12)
    dtype, points, components, rational = shape
    nets = random.uniform(-1, 1, (count, points, components)).astype(dtype)
    return nets, random.uniform(0.5, 2, (count, points)).astype(dtype) if rational else None


def on_curve(net, weights, t):
    return exact.curve_derivatives(net, weights, t)[0].astype(np.float64)


@pytest.mark.parametrize('shape', SHAPES, ids=str)
def test_polylines_keep_their_certificate(shape):
    nets, weights = curves_of(shape)
    lines = simdbezier.flatten(nets, TOLERANCE, weights)
    bounds = simdbezier.CurveSet(nets, weights).error_bounds()['position']
    assert len(lines) == 4 and lines.points.dtype == shape[0]
    assert lines.points.shape == (lines.first[-1], shape[2])
    assert lines.deviations.shape == (4,) and lines.deviation == lines.deviations.max()
    assert (lines.deviations > 0).all() and lines.deviation <= TOLERANCE
    for k, line in enumerate(lines):
        own = None if weights is None else weights[k]
        segments = len(line) - 1
        parameter = 2.0**-24 if shape[0] == np.float32 else 2.0**-53
        speed = 64 * parameter  # a rounded parameter moves a point by as much
        for i in (0, segments // 3, segments):
            worst = np.abs(line[i] - on_curve(nets[k], own, i / segments))
            assert (worst <= bounds[k] + speed).all(), (k, i)
        # Between the points: the nearest point of the segment, and where there are no weights the one
        # at the same share of it.
        for i in range(0, segments, max(segments // 7, 1)):
            begin, end = line[i:i + 2].astype(np.float64)
            for share in (0.25, 0.5, 0.625):
                point = on_curve(nets[k], own, (i + share) / segments)
                along = end - begin
                nearest = np.clip((point - begin) @ along / max(along @ along, 1e-300), 0, 1)
                for at in (nearest, share) if own is None else (nearest,):
                    apart = np.linalg.norm(point - (1 - at) * begin - at * end)
                    assert apart <= lines.deviations[k] + 1e-15, (k, i, share)


@pytest.mark.parametrize('tolerance', [TOLERANCE, 4e-6])  # of which rounding to float takes a tenth
@pytest.mark.parametrize('shape', [shape for shape in SHAPES if not shape[3]], ids=str)
def test_polylines_have_the_fewest_points_that_the_bound_allows(shape, tolerance):
    nets, _ = curves_of(shape)
    lines = simdbezier.flatten(nets, tolerance)
    degree = shape[1] - 1
    bends = np.linalg.norm(np.diff(nets.astype(np.float64), 2, axis=1), axis=-1)
    second = degree * (degree - 1) * bends.max(axis=1, initial=0)
    errors = np.linalg.norm(simdbezier.CurveSet(nets).error_bounds()['position'], axis=1)
    segments = np.maximum(np.ceil(np.sqrt(second / (8 * (tolerance - errors)))), 1)
    more = np.diff(lines.first) - 1 - segments  # a thousandth of many points, for rounded parameters
    assert ((more >= 0) & (more <= np.round(segments / 1000))).all()
    segments += more
    np.testing.assert_allclose(lines.deviations, second / (8 * segments**2) + errors, rtol=1e-3)


def test_a_circle_stays_a_circle():
    points = np.array([[[1, 0], [1, 1], [0, 1]]], np.float64)
    weights = np.array([[1, np.sqrt(0.5), 1]])
    lines = simdbezier.flatten(points, 1e-4, weights)
    assert np.abs(np.linalg.norm(lines.points, axis=1) - 1).max() < 1e-15
    middles = (lines[0][1:] + lines[0][:-1]) / 2
    assert 1 - np.linalg.norm(middles, axis=1).min() <= lines.deviation <= 1e-4
    homogeneous = np.concatenate([points * weights[..., None], weights[..., None]], axis=-1)
    same = simdbezier.flatten(homogeneous, 1e-4, homogeneous=True)
    assert np.array_equal(same.first, lines.first)
    assert np.abs(same.points - lines.points).max() < 1e-15


def test_each_curve_may_have_a_tolerance():
    nets, _ = curves_of(SHAPES[0])
    tolerances = np.array([1e-2, 1e-3, np.inf, 1])
    lines = simdbezier.flatten(nets, tolerances)
    assert (lines.deviations <= tolerances).all()
    for k, tolerance in enumerate(tolerances):
        if np.isfinite(tolerance):
            alone = simdbezier.flatten(nets[k:k + 1], tolerance)
            assert np.array_equal(alone.points, lines[k])
            assert alone.deviation == lines.deviations[k]
    assert len(lines[2]) == 2 and np.array_equal(lines[2], nets[2, [0, -1]])
    for same in (tolerances.tolist(), tuple(tolerances), tolerances.astype('>f8'),
                 np.repeat(tolerances, 2)[::2]):
        assert np.array_equal(simdbezier.flatten(nets, same).points, lines.points)
    whole = simdbezier.flatten(nets, 1)
    for same in (np.array(1), np.float32(1), [1, 1, 1, 1]):
        assert np.array_equal(simdbezier.flatten(nets, same).points, whole.points)


def test_points_are_those_of_grids():
    for shape in SHAPES:
        nets, weights = curves_of(shape)
        lines = simdbezier.flatten(nets, TOLERANCE, weights)
        for k, line in enumerate(lines):
            curve = simdbezier.CurveSet(nets[k:k + 1], None if weights is None else weights[k:k + 1])
            assert np.array_equal(curve.evaluate_grid(len(line))['position'][0], line)
            if weights is None:
                assert np.array_equal(line[[0, -1]], nets[k, [0, -1]])


def views(points):
    yield np.asfortranarray(points)
    yield np.repeat(points, 2, axis=2)[..., ::2]
    yield points[::-1, ::-1, ::-1].copy()[::-1, ::-1, ::-1]
    yield points.astype(points.dtype.newbyteorder())
    frozen = points.copy()
    frozen.flags.writeable = False
    yield frozen
    yield np.frombuffer(b'..' + points.tobytes(), np.uint8)[2:].view(points.dtype).reshape(points.shape)


@pytest.mark.parametrize('shape', SHAPES[:2], ids=str)
def test_control_points_have_any_form(shape):
    nets, _ = curves_of(shape)
    expected = simdbezier.flatten(nets, TOLERANCE)
    for view in views(nets):
        got = simdbezier.flatten(view, TOLERANCE)
        assert np.array_equal(got.points, expected.points) and got.points.dtype == shape[0]
    got = simdbezier.flatten(nets.astype(np.float64).tolist(), TOLERANCE, dtype=shape[0])
    assert got.points.dtype == shape[0] and len(got) == 4
    wide = simdbezier.flatten(nets, TOLERANCE, dtype=np.float64)
    assert wide.points.dtype == np.float64
    assert np.abs(wide[0][0] - nets[0, 0]).max() == 0


def test_polylines_are_a_sequence_of_arrays():
    nets, _ = curves_of(SHAPES[1])
    lines = simdbezier.flatten(nets, TOLERANCE)
    assert lines.first.dtype == np.int64 and lines.first[0] == 0 and len(lines.first) == 5
    assert len(list(lines)) == len(lines) == 4
    for k, (line, part) in enumerate(zip(lines, np.split(lines.points, lines.first[1:-1]))):
        assert np.array_equal(line, part) and np.array_equal(line, lines[k - 4])
        assert np.shares_memory(line, lines.points) and line.base is lines
    assert np.array_equal(lines[np.int64(-1)], lines[3])
    for index in (4, -5, 2**70, -2**70):
        with pytest.raises(IndexError, match=r'^index: there are 4 polylines, found number '):
            lines[index]
    for index in ('a', 1.0, None, slice(0, 2)):
        with pytest.raises(TypeError, match=r'^index: expected an integer, found '):
            lines[index]
    assert repr(lines).startswith(f'<simdbezier.Polylines: 4 polylines of {len(lines.points)} points, '
                                  'within 0.00') and repr(lines).endswith(' of the curves, float64>')
    for name in ('points', 'first', 'deviations'):
        assert getattr(lines, name).base is lines
    line, copy = lines[1], lines[1].copy()
    del lines
    assert np.array_equal(line, copy)
    with pytest.raises(TypeError):
        simdbezier.Polylines()


@pytest.mark.parametrize('components', [1, 2, 3, 7])
def test_no_curves_have_no_polylines(components):
    for tolerance in (1e-3, [], np.zeros(0)):
        lines = simdbezier.flatten(np.zeros((0, 4, components), np.float32), tolerance)
        assert len(lines) == 0 and list(lines) == [] and lines.deviation == 0
        assert lines.points.shape == (0, components) and lines.points.dtype == np.float32
        assert lines.first.tolist() == [0] and lines.deviations.shape == (0,)
    raw = simdbezier.Polylines.__new__(simdbezier.Polylines)
    assert len(raw) == len(raw.points) == len(raw.first) == len(raw.deviations) == 0
    assert list(raw) == [] and raw.deviation == 0 and '0 polylines' in repr(raw)


def test_a_point_and_a_line_have_two_points():
    lines = simdbezier.flatten([[[1, 2]] * 4, [[0, 0], [1, 2], [2, 4], [3, 6]]], 1e-9)
    assert lines.first.tolist() == [0, 2, 4] and lines.points.dtype == np.float64
    assert lines.points.tolist() == [[1, 2], [1, 2], [0, 0], [3, 6]]


@pytest.mark.parametrize('threads', [0, 1, 2])
def test_bits_depend_on_no_thread(threads):
    nets = np.random.default_rng(5).random((3000, 4, 3)).astype(np.float32)
    got, expected = (simdbezier.flatten(nets, 1e-4, threads=n) for n in (threads, 1))
    assert np.array_equal(got.points, expected.points)
    assert np.array_equal(got.deviations, expected.deviations)
