"""Bezier patches and curves by their definition, in numpy: what the module is judged by.

Sums of Bernstein polynomials in double, and derivatives by differences of control points. Nothing is
shared with the library.
"""
from math import comb

import numpy as np


def bernstein(degree, t):
    """Values of all Bernstein polynomials: (parameters, degree + 1)."""
    t = np.asarray(t, np.float64)[:, None]
    i = np.arange(degree + 1)
    binomials = np.array([comb(degree, k) for k in i], np.float64)
    return binomials * t**i * (1 - t) ** (degree - i)


def differentiated(points, axis):
    """Control points of the derivative along an axis."""
    degree = points.shape[axis] - 1
    return degree * np.diff(points, axis=axis)


def polynomial(points, u, v, order_u=0, order_v=0):
    """Derivatives of patches (patches, rows, columns, values) at pairs: (patches, pairs, values)."""
    points = np.asarray(points, np.float64)
    for _ in range(order_u):
        points = differentiated(points, 2)
    for _ in range(order_v):
        points = differentiated(points, 1)
    in_u = bernstein(points.shape[2] - 1, u)
    in_v = bernstein(points.shape[1] - 1, v)
    return np.einsum('ki,kj,pjic->pkc', in_u, in_v, points)


def surface(points, weights, u, v):
    """Position, du and dv at pairs of parameters, by the quotient rule where there are weights."""
    points = np.asarray(points, np.float64)
    if weights is None:
        return tuple(polynomial(points, u, v, a, b) for a, b in ((0, 0), (1, 0), (0, 1)))
    weights = np.asarray(weights, np.float64)[..., None]
    homogeneous = np.concatenate([points * weights, weights], axis=-1)
    h, h_u, h_v = (polynomial(homogeneous, u, v, a, b) for a, b in ((0, 0), (1, 0), (0, 1)))
    position = h[..., :-1] / h[..., -1:]
    du = (h_u[..., :-1] - h_u[..., -1:] * position) / h[..., -1:]
    dv = (h_v[..., :-1] - h_v[..., -1:] * position) / h[..., -1:]
    return position, du, dv


def curve(points, t, order=0):
    """Derivatives of curves (curves, points, values): (curves, parameters, values)."""
    points = np.asarray(points, np.float64)
    for _ in range(order):
        points = differentiated(points, 1)
    return np.einsum('ki,pic->pkc', bernstein(points.shape[1] - 1, t), points)


def grid(nu, nv):
    """Pairs of uniform parameters, u fastest."""
    u = np.linspace(0, 1, nu)
    v = np.linspace(0, 1, nv)
    return np.tile(u, nv), np.repeat(v, nu)
