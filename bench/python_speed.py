#!/usr/bin/env python3
"""How fast the Python module is beside the C function that it calls, in one process and in turns.

    PYTHONPATH=build/python bench/python_speed.py [LIBRARY]

Both write to the same array ("given"), or to a new one in every call ("new"). LIBRARY is the one
that the module is linked to, libsimdbezier.so of its version where nothing is said.
"""
import ctypes
import statistics
import sys
import time

import numpy as np

import simdbezier

F32 = 1
SAMPLES = 16  # a curve, and a side of a patch
TURNS = 15


def struct(name, *fields):
    return type(name, (ctypes.Structure,), {'_fields_': list(fields)})


SIZE, POINTER, INT = ctypes.c_size_t, ctypes.c_void_p, ctypes.c_int32
VECTORS = struct('Vectors', *((axis, POINTER) for axis in 'xyz'), ('stride', SIZE),
                 ('capacity', SIZE), ('scalar', INT))
VALUES = struct('Values', ('first', POINTER), ('length', SIZE), ('scalar', INT))
STRIDES = ('net_stride', 'row_stride', 'point_stride', 'component_stride')
END = (('components', INT), ('weights', INT), ('scalar', INT))
START = (('struct_size', SIZE), ('points', POINTER), ('length', SIZE), ('first', SIZE),
         ('count', SIZE))
NETS = struct('Nets', *START, *((name, SIZE) for name in STRIDES), ('degree_u', INT),
              ('degree_v', INT), *END)
CURVES = struct('Curves', *START, *((name, SIZE) for name in ('net_stride', *STRIDES[2:])),
                ('degree', INT), *END)
GRID = struct('Grid', *((name, SIZE) for name in ('struct_size', 'nu', 'nv')), ('u', POINTER),
              ('u_length', SIZE), ('v', POINTER), ('v_length', SIZE), ('scalar', INT),
              ('parameters', INT), ('first_patch', SIZE), ('patch_count', SIZE))
CURVE_GRID = struct('CurveGrid', ('struct_size', SIZE), ('n', SIZE), ('t', POINTER),
                    ('t_length', SIZE), ('scalar', INT), ('parameters', INT),
                    ('first_curve', SIZE), ('curve_count', SIZE))
LAST = (('status', POINTER), ('status_length', SIZE), ('first_component', INT))
OUTPUTS = struct('Outputs', ('struct_size', SIZE),
                 *((name, VECTORS) for name in 'position du dv duu duv dvv normal'.split()),
                 *((name, VALUES) for name in 'gaussian mean minimum maximum'.split()), *LAST)
CURVE_OUTPUTS = struct('CurveOutputs', ('struct_size', SIZE),
                       *((name, VECTORS) for name in 'position d1 d2 tangent'.split()),
                       ('curvature', VALUES), *LAST)
OPTIONS = struct('Options', ('struct_size', SIZE),
                 *((name, INT) for name in ('threads', 'not_watertight', 'isa', 'destination')))


def sized(kind, **members):
    return kind(struct_size=ctypes.sizeof(kind), **members)


class Call:
    """One call by both ways; `shape` is that of its output."""

    def __init__(self, library, name, points):
        self.library, self.name = library, name
        patches = name == 'grid'
        shared = {'points': points.ctypes.data, 'length': points.size, 'count': len(points),
                  'net_stride': points[0].size, 'point_stride': 3, 'component_stride': 1,
                  'components': 3, 'scalar': F32}
        view = (sized(NETS, row_stride=12, degree_u=3, degree_v=3, **shared) if patches
                else sized(CURVES, degree=3, **shared))
        self.set = ctypes.c_void_p()
        if patches:
            self.check(library.simdbezier_pack(ctypes.byref(view), SIZE(1), F32, None,
                                               ctypes.byref(self.set)))
        else:
            self.check(library.simdbezier_pack_curves(ctypes.byref(view), F32, None,
                                                      ctypes.byref(self.set)))
        self.run = (library.simdbezier_evaluate_grid if patches
                    else library.simdbezier_evaluate_curve_grid)
        self.where = (sized(GRID, nu=SAMPLES, nv=SAMPLES) if patches
                      else sized(CURVE_GRID, n=SAMPLES))
        self.outputs = OUTPUTS if patches else CURVE_OUTPUTS
        self.module = (simdbezier.PatchSet if patches else simdbezier.CurveSet)(points)
        self.counts = (SAMPLES, SAMPLES) if patches else (SAMPLES,)
        self.shape = (len(points), *self.counts, 3)

    def check(self, status):
        if status != 0:
            self.library.simdbezier_last_message.restype = ctypes.c_char_p
            sys.exit(self.library.simdbezier_last_message().decode())

    def by_c(self, array, threads):
        array = np.empty(self.shape, np.float32) if array is None else array
        first = array.ctypes.data
        out = sized(self.outputs, position=VECTORS(first, first + 4, first + 8, 3,
                                                   array.size // 3, F32))
        options = sized(OPTIONS, threads=threads)
        self.check(self.run(self.set, ctypes.byref(self.where), ctypes.byref(out),
                            ctypes.byref(options)))
        return array

    def by_python(self, array, threads):
        out = None if array is None else {'position': array}
        return self.module.evaluate_grid(*self.counts, out=out, threads=threads)['position']


def milliseconds(call, array, threads):
    begin = time.perf_counter()
    call(array, threads)
    return 1e3 * (time.perf_counter() - begin)


def main(path=None):
    path = path or 'libsimdbezier.so.' + '.'.join(simdbezier.__version__.split('.')[:2])
    library = ctypes.CDLL(path)
    random = np.random.default_rng(1)
    print('call    samples   threads  memory      C ms  Python ms  share')
    for name, shape in (('grid', (4000, 4, 4, 3)), ('curves', (1000000, 4, 3))):
        call = Call(library, name, random.random(shape, np.float32))
        given = call.by_c(None, 1)
        if not np.array_equal(given, call.by_python(None, 1)):
            sys.exit(f'{name}: not the same bits')
        for threads in (1, 2):
            for memory, array in (('given', given), ('new', None)):
                turns = [(milliseconds(call.by_c, array, threads),
                          milliseconds(call.by_python, array, threads)) for _ in range(TURNS)]
                c, python = map(statistics.median, zip(*turns))
                print(f'{name:7} {given.size // 3:9} {threads:7}  {memory:6} {c:9.2f} '
                      f'{python:10.2f} {100 * c / python:5.0f} %')


if __name__ == '__main__':
    main(*sys.argv[1:])
