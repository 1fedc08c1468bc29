"""Outputs that overlap inputs or each other are refused by name before anything is written."""
import numpy as np
import pytest
from numpy.lib.stride_tricks import as_strided

import simdbezier


def planes_with_inputs(planes, values, count=50):
    """Planes of single samples, and inputs that lie in some of them."""
    memory = np.full(planes * count, 7, np.float32)
    inputs = [memory[first * count:][:count] for first in values]
    for one in inputs:
        one[:] = np.linspace(0, 1, count)
    return memory, memory.reshape(planes, count).T, inputs


# Components, the planes that hold u and v, and the input that is named.
SHARED = [(3, (2, 0), 'u'), (6, (3, 5), 'u'), (6, (7, 5), 'v'), (6, (4, 7), 'u'), (16, (17, 15), 'v')]


@pytest.mark.parametrize('components, places, named', SHARED)
def test_outputs_in_inputs_are_refused_before_anything_is_written(components, places, named):
    patches = simdbezier.PatchSet(np.random.default_rng(2).random((1, 4, 4, components), 'f4'))
    memory, out, (u, v) = planes_with_inputs(components + 2, places)
    before = memory.copy()
    with pytest.raises(ValueError, match=rf"out\['position'\]: overlaps {named}$"):
        patches.evaluate(0, u, v, (), {'position': out[:, :components]})
    assert np.array_equal(memory, before)


def test_curves_in_their_parameters_are_refused_before_anything_is_written():
    memory, out, (t,) = planes_with_inputs(6, (4,))
    before = memory.copy()
    with pytest.raises(ValueError, match=r"out\['d1'\]: overlaps t$"):
        simdbezier.CurveSet(np.ones((1, 4, 6), 'f4')).evaluate(0, t, ('position',), {'d1': out})
    assert np.array_equal(memory, before)


def test_outputs_that_meet_in_later_components_are_refused_before_anything_is_written():
    patches = simdbezier.PatchSet(np.ones((1, 4, 4, 6), np.float32))
    memory = np.full(300, 7, np.float32)
    position = as_strided(memory, (9, 6), (8, 160))
    du = as_strided(memory[241:], (9, 6), (16, -160))  # between the values of components 3 to 5
    parameters = np.ones(9, np.float32)
    with pytest.raises(ValueError, match=r"out\['du'\]: overlaps out\['position'\]$"):
        patches.evaluate(0, parameters, parameters, (), {'position': position, 'du': du})
    assert (memory == 7).all()


@pytest.mark.parametrize('components, places, named', SHARED)
def test_derivatives_in_inputs_are_refused_before_anything_is_written(components, places, named):
    patches = simdbezier.PatchSet(np.random.default_rng(2).random((1, 4, 4, components), 'f4'))
    memory, out, (u, v) = planes_with_inputs(components + 2, places)
    before = memory.copy()
    with pytest.raises(ValueError, match=rf"out\[\(2, 1\)\]: overlaps {named}$"):
        patches.evaluate_derivatives(0, u, v, (), {(2, 1): out[:, :components]})
    assert np.array_equal(memory, before)


def test_derivatives_on_a_grid_in_its_parameters_are_refused():
    patches = simdbezier.PatchSet(np.ones((1, 4, 4, 3), 'f4'))
    memory = np.full((1, 2, 5, 3), 0.5, np.float32)
    with pytest.raises(ValueError, match=r"out\[\(1, 0\)\]: overlaps nu$"):
        patches.evaluate_grid_derivatives(memory.ravel()[:5], 2, (), {(1, 0): memory})
    with pytest.raises(ValueError, match=r"out\[\(1, 0\)\]: overlaps nv$"):
        patches.evaluate_grid_derivatives(5, memory.ravel()[:2], (), {(1, 0): memory})
    assert (memory == 0.5).all()


def test_derivatives_that_meet_are_refused_before_anything_is_written():
    patches = simdbezier.PatchSet(np.random.default_rng(2).random((1, 4, 4, 3), 'f4'))
    memory = np.full((9, 8), 7, np.float32)
    with pytest.raises(ValueError, match=r"out\[\(0, 1\)\]: overlaps out\[\(1, 0\)\]$"):
        patches.evaluate_derivatives(0, *np.ones((2, 9), 'f4'), (),
                                     {(1, 0): memory[:, :3], (0, 1): memory[:, 2:5]})
    assert (memory == 7).all()
