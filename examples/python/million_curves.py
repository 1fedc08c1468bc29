#!/usr/bin/env python3
"""A million short curves in one call, and what they look like.

    million_curves.py [PICTURE.png] [CURVES]

Every particle of a swirling flow leaves a cubic Bezier curve, given by where it is and how fast it
moves at both ends of a step (Hermite's form). All of them are evaluated at 16 parameters at once,
into memory that is there already, and drawn as a density: how many samples fall into each pixel.
"""
import sys
import time

import numpy as np

import simdbezier

SAMPLES = 16


def velocity(points):
    """A flow around three vortices."""
    total = np.zeros_like(points)
    for centre, strength in (((-0.5, 0), 1), ((0.6, 0.3), -0.8), ((0.1, -0.6), 0.6)):
        away = points - np.array(centre, np.float32)
        distance = (away**2).sum(axis=-1, keepdims=True) + 0.05
        total += strength * np.stack([-away[..., 1], away[..., 0]], axis=-1) / distance
    return total


def control_points(count, step=0.15):
    """Curves (count, 4, 2) of one step each."""
    begin = np.random.default_rng(1).uniform(-1, 1, (count, 2)).astype(np.float32)
    end = begin + step * velocity(begin + step / 2 * velocity(begin))
    third = np.float32(step / 3)
    inner = begin + third * velocity(begin), end - third * velocity(end)
    return np.stack([begin, *inner, end], axis=1)


def draw(samples, path):
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt

    density, _, _ = np.histogram2d(*samples.reshape(-1, 2).T, bins=700, range=[[-1.1, 1.1]] * 2)
    plt.imsave(path, np.log1p(density).T, cmap='magma', origin='lower')


def main(path='million_curves.png', count='1000000'):
    points = control_points(int(count))
    begin = time.perf_counter()
    curves = simdbezier.CurveSet(points)
    packed = time.perf_counter()
    # Memory that was written to before: numpy.zeros() only promises pages, 4 KiB by 4 KiB.
    out = {'position': np.full((len(curves), SAMPLES, 2), np.nan, np.float32)}
    ready = time.perf_counter()
    curves.evaluate_grid(SAMPLES, out=out)
    done = time.perf_counter()
    print(curves)
    print(f'packed in {1e3 * (packed - begin):.1f} ms, '
          f'{len(curves) * SAMPLES} samples in {1e3 * (done - ready):.1f} ms')
    draw(out['position'], path)
    print(path)


if __name__ == '__main__':
    main(*sys.argv[1:])
