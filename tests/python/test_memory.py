"""Nothing is copied: results go where they are asked to go, whatever the strides, and control points
are read where they are. While the library computes, other Python threads run."""
import sys
import threading
import time
import tracemalloc

import numpy as np
import pytest

import simdbezier

PATCHES, NV, NU = 5, 4, 7
SHAPE = (PATCHES, NV, NU, 3)


def address(array):
    return array.__array_interface__['data'][0]


@pytest.fixture(name='points')
def fixture_points():
    return np.random.default_rng(6).random((PATCHES, 4, 4, 3)).astype(np.float32)


def planes():
    return np.moveaxis(np.empty((3, PATCHES, NV, NU), np.float32), 0, -1)


def vertices():
    return np.empty(SHAPE[:3] + (8,), np.float32)[..., 2:5]


def reversed_components():
    return np.empty(SHAPE, np.float32)[..., ::-1]


def every_second():
    return np.empty((PATCHES, NV, NU, 6), np.float32)[..., ::2]


LAYOUTS = [lambda: np.empty(SHAPE, np.float32), planes, vertices, reversed_components,
           every_second, lambda: np.empty(SHAPE, np.float32)[::-1, ::-1, ::-1]]


@pytest.mark.parametrize('make', LAYOUTS)
def test_results_go_where_they_are_asked_to_go(points, make):
    patches = simdbezier.PatchSet(points)
    expected = patches.evaluate_grid(NU, NV)['position']
    out = make()
    before = address(out)
    got = patches.evaluate_grid(NU, NV, out={'position': out})
    assert got['position'] is out
    assert address(got['position']) == before
    assert np.array_equal(out, expected)


def test_what_lies_between_results_is_untouched(points):
    whole = np.full(SHAPE[:3] + (8,), 5, np.float32)
    simdbezier.PatchSet(points).evaluate_grid(NU, NV, out={'normal': whole[..., 2:5]},
                                              outputs=())
    assert (whole[..., [0, 1, 5, 6, 7]] == 5).all()
    assert (whole[..., 2:5] != 5).all()


def views(points):
    yield np.ascontiguousarray(points)
    yield np.asfortranarray(points)
    yield np.moveaxis(np.ascontiguousarray(np.moveaxis(points, -1, 0)), 0, -1)
    wide = np.zeros(points.shape[:3] + (7,), points.dtype)
    wide[..., 1:6:2] = points
    yield wide[..., 1:6:2]
    yield points[::-1, ::-1, ::-1, ::-1].copy()[::-1, ::-1, ::-1, ::-1]
    not_aligned = np.empty(points.nbytes + 2, np.uint8)[2:].view(points.dtype).reshape(points.shape)
    not_aligned[...] = points
    yield not_aligned


def test_control_points_have_any_strides(points):
    expected = simdbezier.PatchSet(points).evaluate_grid(NU, NV)['position']
    for view in views(points):
        got = simdbezier.PatchSet(view).evaluate_grid(NU, NV)['position']
        assert np.array_equal(got, expected), view.strides


def test_control_points_are_read_where_they_are():
    points = np.random.default_rng(8).random((2000, 8, 4, 3))[:, ::2]
    tracemalloc.start()
    simdbezier.PatchSet(points)
    simdbezier.PatchSet(points, dtype=np.float32)
    simdbezier.elevate(points[:1], 4, 4)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < points.nbytes / 20


def test_a_set_does_not_need_its_points(points):
    patches = simdbezier.PatchSet(points)
    expected = patches.evaluate_grid(NU, NV)['position']
    points[:] = np.nan
    assert np.array_equal(patches.evaluate_grid(NU, NV)['position'], expected)


def test_arrays_of_a_mesh_are_its_own_memory(points):
    mesh = simdbezier.tessellate(points, relative=1e-2)
    for name in ('positions', 'normals', 'triangles', 'deviations'):
        array = getattr(mesh, name)
        assert array.base is mesh
        assert address(array) == address(getattr(mesh, name))
    positions = mesh.positions
    copy = positions.copy()
    del mesh
    assert np.array_equal(positions, copy)


# What is prepared before, and what is called then.
CALLS = [
    ('pack', lambda points: points, lambda points: simdbezier.PatchSet(points, threads=1)),
    ('evaluate_grid', simdbezier.PatchSet,
     lambda patches: patches.evaluate_grid(33, 33, ('normal',), threads=1)),
    ('evaluate', lambda points: (simdbezier.PatchSet(points), *np.zeros((3, 10**6), np.float32)),
     lambda given: given[0].evaluate(given[1].view(np.uint32), *given[2:], threads=1)),
    ('evaluate_derivatives', simdbezier.PatchSet,
     lambda patches: patches.evaluate_grid_derivatives(9, 9, [(2, 1)], threads=1)),
    ('error_bounds', simdbezier.PatchSet, lambda patches: patches.error_bounds()),
    ('flatten', lambda points: points[:, 0], lambda points: simdbezier.flatten(points, 1e-5, threads=1)),
    ('curves', lambda points: simdbezier.CurveSet(points[:, 0]),
     lambda curves: curves.evaluate_grid(999, threads=1)),
    ('tessellate', lambda points: points[:2000],
     lambda points: simdbezier.tessellate(points, grid=17, threads=1)),
    ('elevate', lambda points: points, lambda points: simdbezier.elevate(points, 9, 9)),
]


@pytest.mark.parametrize('name, prepare, call', CALLS, ids=[row[0] for row in CALLS])
def test_other_threads_run_meanwhile(name, prepare, call):
    prepared = prepare(np.random.default_rng(9).random((20000, 4, 4, 3)).astype(np.float32))
    stop = threading.Event()
    turns = [0]

    def count():
        while not stop.is_set():
            turns[0] += 1
            time.sleep(0)  # the only place where this thread gives way

    interval = sys.getswitchinterval()
    worker = threading.Thread(target=count)
    try:
        sys.setswitchinterval(1000)
        worker.start()
        before = turns[0]
        for _ in range(20):  # the system may take a while to wake the other thread
            call(prepared)
            if turns[0] > before:
                break
        assert turns[0] > before, f'{name} kept the interpreter to itself'
    finally:
        stop.set()
        sys.setswitchinterval(interval)
        worker.join()
