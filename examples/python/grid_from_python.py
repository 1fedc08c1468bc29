#!/usr/bin/env python3
"""The library from Python: two bicubic patches on a grid, positions and normals in one vertex."""
import numpy as np

import simdbezier

# Patches, rows, columns, x y z: a row of two hills.
patch, row, column = np.indices((2, 4, 4), np.float32)
points = np.stack([column + 3 * patch, row, (column == 1) | (column == 2)], axis=-1)
patches = simdbezier.PatchSet(points, dtype='float32')

vertices = np.empty((2, 17, 17, 6), np.float32)  # x y z nx ny nz
patches.evaluate_grid(17, 17, outputs=(),
                      out={'position': vertices[..., :3], 'normal': vertices[..., 3:]})
x, y, z, nx, ny, nz = vertices[0, 8, 8]
print(f'middle of patch 0: {x:g} {y:g} {z:g}, normal {nx:g} {ny:g} {nz:g}')
