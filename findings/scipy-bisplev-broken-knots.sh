#!/usr/bin/env bash
# SciPy's bisplev finds second derivatives wrongly behind a knot that occurs as often as the degree
# says. BSpline and splev find them rightly.
. "$(dirname "$0")/install.sh"
debian_packages 1.10.1 python3-scipy python3-numpy python3-decorator
cat <<'TEXT'
input: the function 0 for u < 1, (u - 1)^2 for u > 1 as a cubic spline with the knots 0 0 0 0 1 1 1 2 2 2 2, and as a
  surface that does not depend on v; and the same with the knot 1 only twice
expected: the second derivative by u is 0 at u = 0.5, and 2 at u = 1.25, 1.5 and 1.75
TEXT
cat >program.py <<'PYTHON'
import numpy as np
from scipy.interpolate import BSpline, bisplev, splev

u = np.array([0.5, 1.25, 1.5, 1.75])


def polar(a, b, c):  # the blossom of (u - 1)^2 as a cubic
    a, b, c = a - 1, b - 1, c - 1
    return (a * b + b * c + a * c) / 3


def show(values):
    print(' '.join(f'{value:g}' for value in values))


for times in (2, 3):
    knots = np.array([0.0] * 4 + [1.0] * times + [2.0] * 4)
    points = np.array([polar(*knots[i + 1:i + 4]) if knots[i + 3] > 1 else 0.0 for i in range(len(knots) - 4)])
    surface = (knots, np.array([0.0, 0.0, 1.0, 1.0]), np.repeat(points, 2), 3, 1)
    show(bisplev(u, [0.5], surface)[:, 0])
    show(bisplev(u, [0.5], surface, dx=2)[:, 0])
    show(BSpline(knots, points, 3)(u, 2))
    show(splev(u, (knots, np.append(points, [0] * 4), 3), der=2))
PYTHON
export PYTHONPATH=$folder/usr/lib/python3/dist-packages
LD_LIBRARY_PATH=$(find "$folder/usr/lib" -maxdepth 1 -name '*-linux-gnu')
export LD_LIBRARY_PATH=$LD_LIBRARY_PATH:$LD_LIBRARY_PATH/blas:$LD_LIBRARY_PATH/lapack
mapfile -t said < <(/usr/bin/python3 program.py)
expect 'values of bisplev, the knot twice' "${said[0]:-}" '0 0.0625 0.25 0.5625'
expect 'second derivatives of bisplev, the knot twice' "${said[1]:-}" '0 2 2 2'
expect 'values of bisplev, the knot three times' "${said[4]:-}" '0 0.0625 0.25 0.5625'
expect 'second derivatives of bisplev, the knot three times' "${said[5]:-}" '0 1.75 1.5 1.25'
expect 'second derivatives of BSpline, the knot three times' "${said[6]:-}" '0 2 2 2'
expect 'second derivatives of splev, the knot three times' "${said[7]:-}" '0 2 2 2'
