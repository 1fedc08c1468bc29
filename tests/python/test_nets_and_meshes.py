"""Operations on nets, and meshes with their files."""
import html
import json
import math
import os
import pathlib
import re
import struct

import numpy as np
import pytest

import reference
import simdbezier


@pytest.fixture(name='points', params=[np.float32, np.float64])
def fixture_points(request):
    return np.random.default_rng(6).random((5, 4, 3, 3)).astype(request.param)


# The operation, and the parameters that it maps (u, v) of the result to.
OPERATIONS = [
    ('elevate', lambda p: simdbezier.elevate(p, 5, 4), lambda u, v: (u, v)),
    ('reverse_u', simdbezier.reverse_u, lambda u, v: (1 - u, v)),
    ('reverse_v', simdbezier.reverse_v, lambda u, v: (u, 1 - v)),
    ('transpose', simdbezier.transpose, lambda u, v: (v, u)),
    ('split_u low', lambda p: simdbezier.split_u(p, 0.25)[0], lambda u, v: (u / 4, v)),
    ('split_v high', lambda p: simdbezier.split_v(p)[1], lambda u, v: (u, (1 + v) / 2)),
    ('split', lambda p: simdbezier.split(p, 0.5, 0.25)[1], lambda u, v: ((1 + u) / 2, v / 4)),
    ('segment', lambda p: simdbezier.segment(p, 0.25, 0.75, 0, 0.5),
     lambda u, v: (0.25 + u / 2, v / 2)),
]


@pytest.mark.parametrize('call, where', [row[1:] for row in OPERATIONS],
                         ids=[row[0] for row in OPERATIONS])
def test_operations_describe_the_same_surface(points, call, where):
    u, v = reference.grid(5, 6)
    got = call(points)
    assert got.dtype == points.dtype
    np.testing.assert_allclose(reference.polynomial(got, u, v),
                               reference.polynomial(points, *where(u, v)), atol=1e-5)


def test_hodographs_are_derivatives(points):
    u, v = reference.grid(5, 6)
    for call, orders in ((simdbezier.hodograph_u, (1, 0)), (simdbezier.hodograph_v, (0, 1))):
        np.testing.assert_allclose(reference.polynomial(call(points), u, v),
                                   reference.polynomial(points, u, v, *orders), atol=1e-4)


def test_weights_come_back_with_the_points(points):
    weights = 0.5 + np.random.default_rng(1).random((5, 4, 3)).astype(points.dtype)
    new_points, new_weights = simdbezier.elevate(points, 3, 4, weights)
    assert new_points.shape == (5, 5, 4, 3) and new_weights.shape == (5, 5, 4)
    u, v = reference.grid(5, 6)
    for got, expected in zip(reference.surface(new_points, new_weights, u, v),
                             reference.surface(points, weights, u, v)):
        np.testing.assert_allclose(got, expected, atol=1e-4)
    halves = simdbezier.split_u(points, 0.5, weights)
    assert [part.shape for half in halves for part in half] == [(5, 4, 3, 3), (5, 4, 3)] * 2


def test_homogeneous_points_come_back_homogeneous(points):
    weights = 0.5 + np.random.default_rng(1).random((5, 4, 3)).astype(points.dtype)
    homogeneous = np.concatenate([points * weights[..., None], weights[..., None]], axis=-1)
    u, v = reference.grid(5, 6)
    for call, where in (
            (lambda p, **of: simdbezier.split_u(p, 0.25, **of)[0], lambda u, v: (u / 4, v)),
            (lambda p, **of: simdbezier.elevate(p, 5, 4, **of), lambda u, v: (u, v)),
            (simdbezier.transpose, lambda u, v: (v, u))):
        got = call(homogeneous, homogeneous=True)
        assert got.shape[-1] == 4 and got.dtype == points.dtype
        position, _, _ = reference.surface(got[..., :3] / got[..., 3:], got[..., 3], u, v)
        expected, _, _ = reference.surface(points, weights, *where(u, v))
        np.testing.assert_allclose(position, expected, atol=1e-5)
    apart = simdbezier.tight_boxes(points, 2, weights)
    inside = simdbezier.tight_boxes(homogeneous, 2, homogeneous=True)
    np.testing.assert_allclose(inside, apart, atol=1e-5)
    mesh = simdbezier.tessellate(homogeneous, grid=4, homogeneous=True)
    same = simdbezier.tessellate(points, grid=4, weights=weights)
    np.testing.assert_allclose(mesh.positions, same.positions, atol=1e-6)
    curves = simdbezier.CurveSet(homogeneous[:, 0], homogeneous=True)
    assert curves.rational and curves.components == 3
    np.testing.assert_allclose(
        curves.evaluate_grid(5)['position'],
        simdbezier.CurveSet(points[:, 0], weights[:, 0]).evaluate_grid(5)['position'], atol=1e-6)


def test_boxes_and_flatness_hold(points):
    u, v = reference.grid(9, 9)
    surface = reference.polynomial(points, u, v)
    for low, high in (simdbezier.control_boxes(points), simdbezier.tight_boxes(points, 3)):
        assert (surface.min(axis=1) >= low - 1e-6).all()
        assert (surface.max(axis=1) <= high + 1e-6).all()
    corners = points[:, ::3, ::2].astype(float)
    distance = np.linalg.norm(surface - reference.polynomial(corners, u, v), axis=-1)
    assert (distance.max(axis=1) <= simdbezier.flatness(points) + 1e-6).all()


def hill(dtype):
    """Two by two patches of one bicubic hill."""
    x = np.arange(7) / 6
    whole = np.zeros((7, 7, 3), dtype)
    whole[..., 0], whole[..., 1] = np.meshgrid(x, x)
    whole[..., 2] = np.sin(math.pi * whole[..., 0]) * np.sin(math.pi * whole[..., 1])
    return np.stack([whole[j:j + 4, i:i + 4] for j in (0, 3) for i in (0, 3)])


@pytest.mark.parametrize('dtype', [np.float32, np.float64])
def test_a_mesh_is_within_its_deviation(dtype):
    points = hill(dtype)
    mesh = simdbezier.tessellate(points, tolerance=1e-3, parameters=True)
    assert 0 < mesh.deviation <= 1e-3
    assert mesh.deviations.shape == (4,) and mesh.deviations.max() == mesh.deviation
    assert mesh.positions.dtype == dtype and mesh.triangles.dtype == np.uint32
    assert mesh.positions.shape == mesh.normals.shape
    # Every vertex lies on the surface at its parameters.
    for patch in range(4):
        own = mesh.patches == patch
        u, v = mesh.parameters[own].T
        expected = reference.polynomial(points[patch:patch + 1], u, v)[0]
        np.testing.assert_allclose(mesh.positions[own], expected, atol=1e-6)
    # It is closed inside, and its triangles face upwards.
    a, b, c = (mesh.positions[mesh.triangles[:, k]].astype(float) for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()
    edges = np.sort(mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    assert set(counts) <= {1, 2}


def test_options_of_a_mesh():
    points = hill(np.float64)
    few = simdbezier.tessellate(points, grid=5)
    assert len(few.positions) == 81 and len(few.triangles) == 128
    assert few.parameters is None and few.patches is None
    assert len(simdbezier.tessellate(points, grid=(5, 3)).positions) == 45
    assert simdbezier.tessellate(points, grid=5, normals=False).normals is None
    assert len(simdbezier.tessellate(points, grid=5, crease=0).positions) == 100
    assert simdbezier.tessellate(points, relative=1e-3).deviation <= 1e-3 * math.sqrt(3)
    flipped = simdbezier.tessellate(points, grid=5, flip=True)
    np.testing.assert_array_equal(flipped.normals, -few.normals)
    assert simdbezier.tessellate(points, longest_edge=0.5).triangles.size > 0
    uneven = points * [1, 1, 0.2]
    uneven[..., 0] **= 3
    fewer = simdbezier.tessellate(uneven, tolerance=1e-3, thorough=True)
    assert len(fewer.triangles) < len(simdbezier.tessellate(uneven, tolerance=1e-3).triangles)
    assert fewer.deviation <= 1e-3
    several = simdbezier.tessellate(points, tolerance=[1e-2, 1e-2, 1e-2, 1e-4])
    assert several.deviations[3] <= 1e-4 < several.deviations[0]
    assert repr(few).startswith('<simdbezier.Mesh: 81 vertices, 128 triangles, within ')


def squares(turns, dtype):
    """Flat patches in a row, x from 0 to 1, from 1 to 2 …, each turned by its row of `turns`."""
    corners = np.array([[(0, 0, 0), (1, 0, 0)], [(0, 1, 0), (1, 1, 0)]], dtype)
    return np.stack([turn(corners + np.array([k, 0, 0], dtype)) for k, turn in enumerate(turns)])


# A patch as it is, and as its neighbours may have it.
TURNS = [lambda p: p, lambda p: p[::-1], lambda p: p[:, ::-1], lambda p: p.swapaxes(0, 1),
         lambda p: p[::-1, ::-1].swapaxes(0, 1)]


@pytest.mark.parametrize('options', [{}, {'crease': 0}, {'crease': 30}, {'orient': True}])
@pytest.mark.parametrize('dtype', [np.float32, np.float64])
def test_parameters_are_each_patchs_own(dtype, options):
    points = squares(TURNS, dtype)
    whole = simdbezier.tessellate(points, grid=3, **options)
    mesh = simdbezier.tessellate(points, grid=3, parameters=True, **options)
    assert len(mesh.positions) == 9 * len(points)
    np.testing.assert_array_equal(mesh.positions[mesh.triangles], whole.positions[whole.triangles])
    np.testing.assert_array_equal(mesh.normals[mesh.triangles], whole.normals[whole.triangles])
    patch_of_triangle = np.floor(whole.positions[whole.triangles][:, :, 0].mean(axis=1)).astype(int)
    np.testing.assert_array_equal(mesh.patches[mesh.triangles],
                                  np.repeat(patch_of_triangle[:, None], 3, axis=1))
    for patch in range(len(points)):
        u, v = mesh.parameters[mesh.patches == patch].T
        expected = reference.polynomial(points[patch:patch + 1], u, v)[0]
        np.testing.assert_allclose(mesh.positions[mesh.patches == patch], expected, atol=1e-6)


def test_split_edges_are_counted():
    # A square of 2 x 2 beside two of 1 x 1, which touch it or are a little away.
    def square(x, y, size):
        return [[[x + i * size, y + j * size, 0] for i in (0, 1)] for j in (0, 1)]

    def halves(gap, **options):
        points = np.array([square(0, 0, 2), square(-1 - gap, 0, 1), square(-1 - gap, 1, 1)], float)
        return simdbezier.tessellate(points, grid=2, **options)

    mesh = halves(0)
    assert (mesh.split_edges, mesh.unjoined_edges, mesh.largest_gap, len(mesh.positions)) == (0, 0, 0, 10)
    mesh = halves(0, split_edges=True)
    assert (mesh.split_edges, mesh.unjoined_edges, mesh.largest_gap, len(mesh.positions)) == (2, 0, 0, 9)
    mesh = halves(0.015625, split_edges=True)
    assert (mesh.split_edges, mesh.unjoined_edges, len(mesh.positions)) == (0, 2, 10)
    assert abs(mesh.largest_gap - 0.015625) < 1e-15
    mesh = halves(0.015625, split_edges=True, snap=0.04)
    assert (mesh.split_edges, mesh.unjoined_edges, len(mesh.positions)) == (2, 0, 9)


def test_parameters_of_a_tube_do_not_run_back():
    angle = 2 * math.pi * np.arange(9) / 8
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1)
    ring[-1] = ring[0]
    mesh = simdbezier.tessellate(np.stack([ring, ring + [0, 0, 1]])[None], grid=9, parameters=True)
    assert np.ptp(mesh.parameters[mesh.triangles], axis=1).max() == 1 / 8
    assert len(mesh.positions) == 81 and len(mesh.triangles) == 128


def vtu_arrays(data):
    """The arrays of a .vtu file by their names, with their components."""
    text, _, values = data.partition(b'<AppendedData encoding="raw">\n_')
    arrays = {}
    for kind, size, name, rest in re.findall(
            rb'<DataArray type="([A-Z]+)[a-z]+([0-9]+)" Name="(.*?)"(.*?) format="appended"', text):
        offset = int(re.search(rb'Name="' + re.escape(name) + rb'".*?offset="(\d+)"', text)[1])
        bytes_ = struct.unpack_from('<Q', values, offset)[0]
        dtype = {b'F': '<f', b'I': '<i', b'UI': '<u'}[kind] + str(int(size) // 8)
        array = np.frombuffer(values, dtype, bytes_ // (int(size) // 8), offset + 8)
        components = re.search(rb'NumberOfComponents="(\d+)"', rest)
        name = html.unescape(name.decode())
        arrays[name] = array.reshape(-1, int(components[1])) if components else array
    return arrays


@pytest.mark.parametrize('dtype', ['f4', 'f8', '>f4', '>f8', 'i1', 'u1', '>i2', 'u2', 'i4', '>u4', 'i8',
                                   '>u8'])
def test_vtu_files_take_arrays_of_any_numbers(tmp_path, dtype):
    mesh = simdbezier.tessellate(hill(np.float32), grid=70)  # several blocks of vertices
    count = len(mesh.positions)
    values = np.random.default_rng(1).integers(0, 100, (count, 3)).astype(dtype)
    given = {'one': values[:, 1], 'three & <more> "\xe4"': values, 'list': values[:, 0].tolist(),
             'sparse': np.asfortranarray(values)[:, ::2]}
    path = tmp_path / 'hill.vtu'
    mesh.save(path, given)
    found = vtu_arrays(path.read_bytes())
    assert set(found) - set(given) == {'Points', 'Normals', 'connectivity', 'offsets', 'types'}
    for name, array in given.items():
        np.testing.assert_array_equal(found[name], array)
        if name != 'list':
            assert found[name].dtype == np.dtype(dtype).newbyteorder('<')
    mesh.save(path, point_data={})
    plain = path.read_bytes()
    mesh.save(path)
    assert path.read_bytes() == plain


def test_vtu_files_take_nan(tmp_path):
    mesh = simdbezier.tessellate(hill(np.float64), grid=3)
    mesh.save(tmp_path / 'hill.vtu', point_data={'nan': np.full(len(mesh.positions), np.nan)})
    assert np.isnan(vtu_arrays((tmp_path / 'hill.vtu').read_bytes())['nan']).all()


@pytest.mark.parametrize('parameters', [False, True])
@pytest.mark.parametrize('ending', ['obj', 'ply', 'stl', 'glb', 'vtu', 'raw'])
@pytest.mark.parametrize('dtype', [np.float32, np.float64])
def test_meshes_become_files(tmp_path, ending, dtype, parameters):
    mesh = simdbezier.tessellate(hill(dtype), tolerance=1e-2, parameters=parameters)
    path = tmp_path / f'hill.{ending}'
    mesh.save(path)
    data = path.read_bytes()
    triangles = len(mesh.triangles)
    if ending == 'obj':
        lines = data.decode().splitlines()
        vertices = [line.split()[1:4] for line in lines if line.startswith('v ')]
        np.testing.assert_array_equal(np.array(vertices, dtype), mesh.positions)
        assert sum(line.startswith('f ') for line in lines) == triangles
    elif ending == 'ply':
        assert f'element face {triangles}'.encode() in data
    elif ending == 'stl':
        assert struct.unpack_from('<I', data, 80)[0] == triangles
    elif ending == 'vtu':
        arrays = vtu_arrays(data)
        np.testing.assert_array_equal(arrays['Points'].reshape(-1, 3), mesh.positions)
        np.testing.assert_array_equal(arrays['connectivity'].reshape(-1, 3), mesh.triangles)
        assert ('patch' in arrays) == ('TCoords' in arrays) == parameters
    elif ending == 'raw':
        begin = 8 + int.from_bytes(data[:8], 'little')
        head = json.loads(data[8:begin])
        vertices = np.frombuffer(data, np.dtype(head['vertex']), head['vertices'], begin)
        np.testing.assert_array_equal(vertices['position'], mesh.positions)
        np.testing.assert_array_equal(vertices['normal'], mesh.normals)
        corners = np.frombuffer(data, '<u4', offset=begin + vertices.nbytes)
        np.testing.assert_array_equal(corners.reshape(head['faces'], 3), mesh.triangles)
    else:
        assert data[:4] == b'glTF' and struct.unpack_from('<I', data, 8)[0] == len(data)
    mesh.save(str(path))
    assert path.read_bytes() == data
    assert [entry.name for entry in pathlib.Path(tmp_path).iterdir()] == [path.name]


def test_a_tolerance_is_one_number_as_an_array_too(points):
    expected = simdbezier.tessellate(points, tolerance=1e-2)
    for tolerance in (np.array(1e-2), np.float64(1e-2), np.full(5, 1e-2)):
        got = simdbezier.tessellate(points, tolerance=tolerance)
        assert np.array_equal(got.positions, expected.positions)


@pytest.mark.parametrize('name', [b'plain.obj', b'\xff.obj', b'\xc3\xa9.ply', b'\xed\xa0\x80.stl'])
def test_files_have_any_name(points, name, tmp_path):
    mesh = simdbezier.tessellate(points, grid=3)
    path = os.path.join(os.fsencode(tmp_path), name)
    for given in (path, os.fsdecode(path), pathlib.Path(os.fsdecode(path))):
        mesh.save(given)
        assert os.listdir(os.fsencode(tmp_path)) == [name]
        os.remove(path)
