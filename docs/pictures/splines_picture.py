#!/usr/bin/env python3
"""Draws docs/pictures/splines.svg: a spline surface with its control points, and the patches that it becomes.

    PYTHONPATH=build/python docs/pictures/splines_picture.py
"""
from pathlib import Path

import numpy as np
import simdbezier

WIDTH, HEIGHT, SIDE = 890, 260, 16  # SIDE: pieces of an edge
HEIGHTS = [[0, 0.2, 0.9, 1.6, 0.3, 0], [0.1, 1.2, 0.4, 2.2, 1.2, 0.2], [0.2, 0.6, 1.6, 0.5, 1.4, 0.6],
           [0.9, 0.1, 0.8, 0.3, 0.2, 0.9]]
KNOTS = [0, 0, 0, 0, 1, 1.6, 3, 3, 3, 3], [0, 0, 0, 0.45, 1, 1, 1]
FILLS = '#9cc3e6', '#f2c48d'  # neighbours differ


def project(points, left):
    """From above, at a slant; `left` is where the panel begins."""
    x, y, z = np.moveaxis(np.asarray(points), -1, 0)
    return np.stack([left + 62 * x + 27 * y, 212 - 34 * y - 46 * z], axis=-1)


def path(points, style, close=False):
    steps = ' L'.join(f'{x:.1f} {y:.1f}' for x, y in points)
    return f'<path d="M{steps}{" Z" if close else ""}" {style}/>'


def patch(spline, number, nets, left, gap):
    """One patch with its edges and, where patches are apart, its own control points."""
    u0, u1, v0, v1 = spline.intervals[number]
    column, row = number % spline.spans[0], number // spline.spans[0]
    grid = spline.evaluate_grid(np.linspace(u0, u1, SIDE + 1), np.linspace(v0, v1, SIDE + 1))
    apart = np.array([gap * column, gap * row, 0])
    at = project(grid['position'] + apart, left)
    outline = np.concatenate([at[0], at[1:, -1], at[-1, -2::-1], at[-2:0:-1, 0]])
    yield path(outline, f'fill="{FILLS[(column + row) % 2]}" stroke="#1f4e79" stroke-width="1.3"', close=True)
    if gap > 0:
        yield from net(project(nets[number] + apart, left), '#c0392b', 1.6)


def net(points, colour, radius):
    style = f'fill="none" stroke="{colour}" stroke-width="0.7" stroke-opacity="0.7"'
    for line in [*points, *np.swapaxes(points, 0, 1)]:
        yield path(line, style)
    for x, y in points.reshape(-1, 2):
        yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{colour}"/>'


def main():
    y, x = np.mgrid[0:4, 0:6] * 1.0
    points = np.stack([x, y * 1.2, np.array(HEIGHTS)], axis=-1)
    spline = simdbezier.SplineSurface(points, (3, 2), KNOTS)
    nets = spline.to_bezier()
    order = sorted(range(len(spline)), key=lambda k: -(k // spline.spans[0]))
    parts = []
    for left, gap in ((8, 0), (432, 0.35)):
        for number in order:
            parts += patch(spline, number, nets, left, gap)
        if gap == 0:
            parts += net(project(points, left), '#444444', 2.4)
    for left, text in ((20, '6 × 4 control points, degree 3 × 2'), (460, f'{len(spline)} Bézier patches')):
        parts.append(f'<text x="{left}" y="248" font-family="sans-serif" font-size="14">{text}</text>')
    out = Path(__file__).resolve().parent / 'splines.svg'
    out.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
                   f'viewBox="0 0 {WIDTH} {HEIGHT}">\n<rect width="100%" height="100%" fill="white"/>\n'
                   + '\n'.join(parts) + '\n</svg>\n')


if __name__ == '__main__':
    main()
