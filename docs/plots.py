#!/usr/bin/env python3
"""Draws the plots of docs/accuracy.md. It needs Python's standard library only.

    docs/plots.py build/accuracy.json     # written by ./run accuracy

error_by_offset.svg  the library's own errors, from the suite's report
error_by_degree.svg  bases at other degrees, on curves by Horner's rule: computed here in double
                     arithmetic (no FMA) against exact rationals, from a fixed seed
"""
import json
import math
import random
import sys
from fractions import Fraction
from pathlib import Path

UNIT = Fraction(1, 2**53)
WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 640, 400, 64, 48, 36, 190
COLOURS = ("#1b6ca8", "#c0392b", "#2e8b57", "#8e44ad", "#b8860b")


def chart(path, title, x_label, y_label, x_names, series):
    """One SVG line chart with a logarithmic y axis; series: {name: [y or None, …]}."""
    values = [y for ys in series.values() for y in ys if y]
    low = math.floor(math.log10(min(values)))
    high = math.ceil(math.log10(max(values)))
    plot_width, plot_height = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM

    def px(i):
        return LEFT + plot_width * i / max(1, len(x_names) - 1)

    def py(y):
        return TOP + plot_height * (high - math.log10(y)) / (high - low)

    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
           'font-family="sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{LEFT}" y="20" font-size="14">{title}</text>']
    for k in range(low, high + 1):
        y = py(10.0**k)
        svg.append(f'<path d="M{LEFT} {y:.1f}H{LEFT + plot_width}" stroke="#ddd"/>'
                   f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{10.0**k:g}</text>')
    for i, name in enumerate(x_names):
        svg.append(f'<text x="{px(i):.1f}" y="{HEIGHT - BOTTOM + 18}" '
                   f'text-anchor="middle">{name}</text>')
    svg.append(f'<text x="{LEFT + plot_width / 2}" y="{HEIGHT - 8}" '
               f'text-anchor="middle">{x_label}</text>')
    svg.append(f'<text x="14" y="{TOP + plot_height / 2}" text-anchor="middle" '
               f'transform="rotate(-90 14 {TOP + plot_height / 2})">{y_label}</text>')
    for k, (name, ys) in enumerate(series.items()):
        colour = COLOURS[k % len(COLOURS)]
        points = [(px(i), py(y)) for i, y in enumerate(ys) if y]
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        svg.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
        svg += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in points]
        svg.append(f'<text x="{WIDTH - RIGHT + 12}" y="{TOP + 14 + 18 * k}" '
                   f'fill="{colour}">{name}</text>')
    svg.append("</svg>")
    Path(path).write_text("\n".join(svg) + "\n")


def bernstein_exact(points, u):
    n = len(points) - 1
    return sum(math.comb(n, i) * u**i * (1 - u)**(n - i) * Fraction(p)
               for i, p in enumerate(points))


def power_coefficients(points, at):
    """Coefficients of powers of (u - at) / scale, formed exactly and rounded once. In the centre,
    scale is 1/2."""
    n = len(points) - 1
    scale = Fraction(1, 2) if at else Fraction(1)
    exact = [Fraction(0)] * (n + 1)
    for i, p in enumerate(points):
        term = [Fraction(math.comb(n, i)) * Fraction(p)]
        for root, slope in [(at, 1)] * i + [(1 - at, -1)] * (n - i):
            term = [(term[k] if k < len(term) else 0) * root
                    + (term[k - 1] * slope * scale if k > 0 else 0) for k in range(len(term) + 1)]
        exact = [a + b for a, b in zip(exact, term)]
    return [float(c) for c in exact]


def horner(coefficients, x):
    value = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        value = value * x + c
    return value


def de_casteljau(points, u):
    level = list(points)
    while len(level) > 1:
        level = [(1 - u) * a + u * b for a, b in zip(level, level[1:])]
    return level[0]


def errors_by_degree(degrees, curves=40, samples=25):
    """Largest |error| / (u max|b|) over random control points, for each scheme."""
    schemes = {"centred powers (ours)": [], "Horner in powers of u": [], "de Casteljau": []}
    generator = random.Random(7)
    for n in degrees:
        worst = dict.fromkeys(schemes, 0.0)
        for _ in range(curves):
            points = [generator.uniform(-1, 1) for _ in range(n + 1)]
            size = max(abs(p) for p in points)
            centred = power_coefficients(points, Fraction(1, 2))
            corner = power_coefficients(points, Fraction(0))
            for _ in range(samples):
                u = generator.randrange(2**30 + 1) / 2**30
                exact = bernstein_exact(points, Fraction(u))
                computed = (horner(centred, 2 * u - 1), horner(corner, u), de_casteljau(points, u))
                for name, value in zip(schemes, computed):
                    error = abs(Fraction(value) - exact) / UNIT / Fraction(size)
                    worst[name] = max(worst[name], float(error))
        for name in schemes:
            schemes[name].append(worst[name])
    return schemes


def offset_series(report):
    rows = {(r["family"], r["isa"]): r["rms_u"] for r in report["rows"]
            if r["type"] == "f32" and r["qty"] == "P"}
    widest = next(isa for isa in ("avx512", "avx2", "neon64", "sse2", "scalar")
                  if ("wave", isa) in rows)
    families = ("wave", "off1e3", "off1e6")
    peers = {"simdbezier": ("", widest), "with local origin": ("+origin", widest),
             "de Casteljau": ("", "de_casteljau"), "Horner in powers of u": ("", "horner_corner")}
    return {name: [rows.get((family + suffix, isa)) for family in families]
            for name, (suffix, isa) in peers.items()}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(__file__).resolve().parent / "pictures"
    report = json.loads(Path(sys.argv[1]).read_text())
    chart(folder / "error_by_offset.svg", "Positions, float: RMS error far from the origin",
          "offset / size of the patch", "error / (u max|P|)", ("0", "1e3", "1e6"),
          offset_series(report))
    degrees = list(range(1, 16))
    chart(folder / "error_by_degree.svg", "Curves, double: largest error by degree", "degree",
          "error / (u max|b|)", [str(n) for n in degrees], errors_by_degree(degrees))


if __name__ == "__main__":
    main()
