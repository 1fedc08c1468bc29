#!/usr/bin/env python3
"""Draws docs/teapot.png from the program's own output. Needs numpy and Pillow.

    docs/teapot.py build/simdbezier      # Debian: python3-numpy python3-pil

The program evaluates positions and normals on a grid of every patch. This script fills the
triangles between the samples, interpolates the normals for the light, and draws each fourth line of
the grid.
"""
import io
import subprocess
import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageFilter

GRID = 33  # samples a side; lines are drawn through each fourth of them
LINE_STEP = 4
WIDTH, HEIGHT, SCALE = 960, 540, 3  # the picture is drawn SCALE times as large, then averaged

VIEW = np.array([0.42, -1.0, 0.52])  # from the teapot towards the eye
LIGHTS = ((np.array([-0.12, -0.56, 1.20]), 0.74), (np.array([0.95, -0.35, 0.20]), 0.26))
CENTRE, PIXELS_A_UNIT = np.array([0.42, 0.0, 1.36]), 124.0
CLAY, LINE, BORDER = (np.array(c) / 255 for c in ((122, 176, 214), (20, 58, 94), (10, 34, 60)))


def unit(vector):
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)


def samples(program):
    """Positions and normals, [patch][row][column][3]."""
    text = subprocess.run([program, "evaluate", "builtin:teapot", "--grid", str(GRID),
                           "--outputs", "position,normal", "-o", "-"],
                          check=True, capture_output=True, text=True).stdout
    table = np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1)
    table = table.reshape(-1, GRID, GRID, table.shape[1])
    return table[..., 3:6], table[..., 6:9]


def camera():
    """Rows: right, up, towards the eye."""
    eye = unit(VIEW)
    right = unit(np.cross([0.0, 0.0, 1.0], eye))
    return np.stack([right, np.cross(eye, right), eye])


def to_pixels(points):
    x, y, depth = np.moveaxis((points - CENTRE) @ camera().T, -1, 0)
    size = PIXELS_A_UNIT * SCALE
    return np.stack([x * size + WIDTH * SCALE / 2, HEIGHT * SCALE / 2 - y * size, depth], axis=-1)


def triangles(values):
    """Two triangles for each square of the grid, [triangle][corner][…]."""
    a, b = values[:, :-1, :-1], values[:, :-1, 1:]
    c, d = values[:, 1:, :-1], values[:, 1:, 1:]
    both = np.stack([np.stack([a, b, d], axis=3), np.stack([a, d, c], axis=3)], axis=3)
    return both.reshape(-1, 3, values.shape[-1])


def fill(corners, attributes):
    """Draws all triangles into a depth buffer. Returns the attributes of what is seen, and where."""
    shape = (HEIGHT * SCALE, WIDTH * SCALE)
    nearest = np.full(shape, -np.inf)
    seen = np.zeros((*shape, attributes.shape[-1]))
    for triangle, values in zip(corners, attributes):
        low = np.maximum(np.floor(triangle[:, :2].min(axis=0)).astype(int), 0)
        high = np.minimum(np.ceil(triangle[:, :2].max(axis=0)).astype(int) + 1, shape[::-1])
        (ax, ay), (bx, by), (cx, cy) = triangle[:, :2]
        area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        if abs(area) < 1e-9 or (high <= low).any():
            continue
        x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
        wb = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area
        wc = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area
        weights = np.stack([1 - wb - wc, wb, wc], axis=-1)
        depth = weights @ triangle[:, 2]
        window = np.s_[low[1]:high[1], low[0]:high[0]]
        front = (weights >= -1e-9).all(axis=-1) & (depth > nearest[window])
        nearest[window][front] = depth[front]
        seen[window][front] = (weights @ values)[front]
    return seen, np.isfinite(nearest)


def slopes(corners, parameters):
    """Length of each parameter's gradient in pixels, the same for all corners of a triangle."""
    edges = corners[:, 1:, :2] - corners[:, :1, :2]
    rises = parameters[:, 1:] - parameters[:, :1]
    area = edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 1, 0] * edges[:, 0, 1]
    area = np.where(np.abs(area) < 1e-9, 1e-9, area)[:, None]
    gx = (rises[:, 0] * edges[:, 1, 1, None] - rises[:, 1] * edges[:, 0, 1, None]) / area
    gy = (rises[:, 1] * edges[:, 0, 0, None] - rises[:, 0] * edges[:, 1, 0, None]) / area
    return np.repeat(np.hypot(gx, gy)[:, None], 3, axis=1)


def coverage(distance, half_width):
    """How much of a pixel a line covers whose middle is so many small pixels away."""
    return np.clip(half_width * SCALE + 0.5 - distance, 0, 1)


def line_coverage(parameters, gradients):
    gradients = np.maximum(gradients, 1e-9)
    to_line = np.abs(parameters - LINE_STEP * np.round(parameters / LINE_STEP)) / gradients
    last = GRID - 1
    to_border = np.minimum(parameters, last - parameters) / gradients
    # Where lines crowd towards a pole they would merge into a blot: they fade there.
    crowd = np.clip(LINE_STEP / gradients / (6 * SCALE), 0, 1)
    return ((coverage(to_line, 0.42) * crowd).max(axis=-1), coverage(to_border, 0.8).max(axis=-1))


def shade(normals):
    eye = unit(VIEW)
    normals = unit(normals + 1e-12)
    normals = np.where((normals @ eye)[..., None] < 0, -normals, normals)
    colour = np.full(normals.shape, 0.30) * CLAY * (1 + 0.35 * normals[..., 2:3])
    for direction, strength in LIGHTS:
        light = unit(direction)
        facing = np.clip(normals @ light, 0, None)[..., None]
        gloss = np.clip(normals @ unit(light + eye), 0, None)[..., None] ** 90
        colour = colour + strength * (facing * CLAY + 0.8 * gloss)
    rim = (1 - np.clip(normals @ eye, 0, 1)[..., None]) ** 3
    return colour + 0.16 * rim


def ground_shadow(positions):
    """Opacity of a soft shadow below, cast along the first light."""
    light = unit(LIGHTS[0][0])
    flat = positions - positions[..., 2:3] / light[2] * light
    _, covered = fill(triangles(to_pixels(flat)[:, ::4, ::4]), triangles(flat[:, ::4, ::4]))
    mask = Image.fromarray((covered * 255).astype(np.uint8))
    return np.asarray(mask.filter(ImageFilter.GaussianBlur(11 * SCALE))) / 255 * 0.26


def picture(positions, normals):
    corners = triangles(to_pixels(positions))
    steps = np.arange(GRID, dtype=float)
    grid = np.stack(np.broadcast_arrays(steps[None, None, :], steps[None, :, None]), axis=-1)
    parameters = triangles(np.broadcast_to(grid, (*positions.shape[:3], 2)))
    seen, covered = fill(corners, np.concatenate(
        [triangles(normals), parameters, slopes(corners, parameters)], axis=-1))
    line, border = line_coverage(seen[..., 3:5], seen[..., 5:7])
    colour = shade(seen[..., :3])
    for amount, ink in ((0.55 * line, LINE), (0.85 * border, BORDER)):
        colour += amount[..., None] * (ink - colour)
    shadow = ground_shadow(positions)
    alpha = np.where(covered, 1.0, shadow)
    colour = np.where(covered[..., None], colour, np.array([0.10, 0.14, 0.20]))
    layers = np.concatenate([np.clip(colour, 0, 1) * alpha[..., None], alpha[..., None]], axis=-1)
    layers = layers.reshape(HEIGHT, SCALE, WIDTH, SCALE, 4).mean(axis=(1, 3))
    return layers[..., :3] + (1 - layers[..., 3:])  # on white


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    # 86 levels a channel look the same as 256, and make the file a third smaller.
    levels = np.round(picture(*samples(sys.argv[1])) * 85).astype(np.uint8) * 3
    Image.fromarray(levels).save(Path(__file__).with_suffix(".png"), optimize=True)


if __name__ == "__main__":
    main()
