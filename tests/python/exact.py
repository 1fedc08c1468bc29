"""Bezier patches and curves in fractions: de Casteljau's algorithm, without a rounding.

Values are Taylor series in the distance from a sample, so that derivatives of any order come out of the
same steps, and weights divide series. Nothing is shared with the library.
"""
from fractions import Fraction
from math import factorial

import numpy as np


def constant(value, order_u, order_v):
    """The series of a number: (order_u + 1, order_v + 1) coefficients."""
    series = np.full((order_u + 1, order_v + 1), Fraction(0), object)
    series[0, 0] = Fraction(float(value))
    return series


def times(series, t, axis):
    """A series times t + e, where e is the distance along u (axis 0) or v (axis 1)."""
    shifted = np.full(series.shape, Fraction(0), object)
    if axis == 0:
        shifted[1:] = series[:-1]
    else:
        shifted[:, 1:] = series[:, :-1]
    return Fraction(float(t)) * series + shifted


def de_casteljau(points, t, axis):
    while len(points) > 1:
        points = [a + times(b - a, t, axis) for a, b in zip(points, points[1:])]
    return points[0]


def quotient(numerator, denominator):
    """The series by which the denominator has to be multiplied."""
    found = np.full(numerator.shape, Fraction(0), object)
    for a, b in np.ndindex(*numerator.shape):
        rest = numerator[a, b]
        for i, j in np.ndindex(a + 1, b + 1):
            if (i, j) != (0, 0):
                rest -= denominator[i, j] * found[a - i, b - j]
        found[a, b] = rest / denominator[0, 0]
    return found


def derivatives(net, weights, u, v, order_u=0, order_v=0):
    """All derivatives up to these orders of one patch (rows, columns, components) at one sample:
    fractions (order_u + 1, order_v + 1, components)."""
    def value(numbers):
        rows = [[constant(number, order_u, order_v) for number in row] for row in numbers]
        return de_casteljau([de_casteljau(row, u, 0) for row in rows], v, 1)

    def weighted(component):
        """Products as fractions, since floats would round them."""
        rows = [[constant(w, order_u, order_v) * Fraction(float(x)) for x, w in zip(*row)]
                for row in zip(net[..., component], weights)]
        return de_casteljau([de_casteljau(row, u, 0) for row in rows], v, 1)

    components = range(net.shape[2])
    if weights is None:
        all_of = [value(net[..., c]) for c in components]
    else:
        divisor = value(weights)
        all_of = [quotient(weighted(c), divisor) for c in components]
    factorials = np.array([[factorial(a) * factorial(b) for b in range(order_v + 1)]
                           for a in range(order_u + 1)], object)
    return np.stack([series * factorials for series in all_of], axis=-1)


def curve_derivatives(points, weights, t, order=0):
    """The same of one curve (points, components): fractions (order + 1, components)."""
    rows = None if weights is None else weights[None]
    return derivatives(points[None], rows, t, 0, order)[:, 0]
