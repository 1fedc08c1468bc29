#!/usr/bin/env python3
"""Draws the plots of docs/performance.md from what measure.py kept.

usage: bench/plots.py RESULTS.json SWEEP.json [FOLDER]

FOLDER (default: docs/pictures/) receives
  speed_by_size.svg  samples/s in cache against grid size (SWEEP.json: measure.py --sweep)
  roofline.svg       multiply-adds/s against multiply-adds per byte written, with the machine's
                     limits (RESULTS.json); multiply-adds as the library counts them
Plug-ins that were measured with them (measure.py --evaluator) are drawn, too, with broken lines
where they write x y z triples instead of planes. The same files give the same bytes with one
version of matplotlib, which this script needs (Debian: python3-matplotlib).
"""

import itertools
import math
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

sys.dont_write_bytecode = True  # results.py is imported from the source tree
from results import Name, evaluators, read  # noqa: E402

TITLES = {"position": "positions", "position_derivatives": "positions, du, dv",
          "position_normal": "positions, normals",
          "second_derivatives": "all up to second derivatives"}
COLOURS = {"avx512": "#1b6ca8", "avx2": "#2e8b57", "neon64": "#1b6ca8",
           "autovectorised": "#c0392b", "de_casteljau": "#8e44ad"}
EVALUATOR_COLOURS = ("#e67e22", "#16a085", "#7f8c8d", "#d81b60", "#6d4c41")
MARKERS = {"position": "o", "position_derivatives": "s", "position_normal": "^",
           "second_derivatives": "D"}


def multiply_adds(outputs, n):
    """Multiply-adds of one sample on an n x n grid. Products and sums that do not fuse count as one
    each, and the polynomials in v that a column's samples share are spread over them. Square roots
    and divisions do not count."""
    per_sample = {"position": 9, "position_derivatives": 24, "position_normal": 36,
                  "second_derivatives": 42}
    per_column = {"position": 36, "position_derivatives": 60, "position_normal": 60,
                  "second_derivatives": 84}
    return per_sample[outputs] + per_column[outputs] / n


def rounded(number):
    value = float(number[0])
    return f"{value:.2f}" if abs(value) < 10 else f"{value:.1f}"


def save(figure, path):
    figure.savefig(path, format="svg", metadata={"Date": None, "Creator": None})
    pyplot.close(figure)
    # matplotlib writes six digits and a line for every point. A tenth of a point is as fine as
    # anybody can see, and the files are read in reviews.
    text = re.sub(r"-?\d+\.\d{3,}", rounded, path.read_text(encoding="utf-8"))
    text = re.sub(r' ?\n(?=[LMCz"])', "", text)
    path.write_text(text, encoding="utf-8")


def colours(*contexts):
    """Name -> colour, of the library's instruction sets, baselines and plug-ins."""
    others = dict.fromkeys(name for context in contexts for name in evaluators(context))
    return {**dict(zip(others, itertools.cycle(EVALUATOR_COLOURS))), **COLOURS}


def grids(rows, drawn, kind="f32"):
    """Plain square grid rows of one thread: (Name, n, samples/s). Plug-ins may write triples."""
    for text, row in rows.items():
        if text.startswith("grid/"):
            name = Name(text)
            nu, nv = map(int, name.size.split("x"))
            plain = not name.keys or (name.keys == {"layout": "aos"} and name.who not in COLOURS)
            if name.type == kind and name.threads == 1 and plain and nu == nv and name.who in drawn:
                yield name, nu, row.median


def by_size(rows, drawn, path):
    lines = {}
    for name, n, rate in grids(rows, drawn):
        if name.place == "cache":
            key = name.who, "layout" in name.keys
            lines.setdefault(name.outputs, {}).setdefault(key, {})[n] = rate / 1e9
    shown = [outputs for outputs in TITLES if outputs in lines]
    height = (len(shown) + 1) // 2
    figure = pyplot.figure(figsize=(9, 3.1 * height))
    for place, outputs in enumerate(shown, 1):
        axis = figure.add_subplot(height, 2, place)
        for (who, colour), triples in itertools.product(drawn.items(), (False, True)):
            rates = lines[outputs].get((who, triples), {})
            if rates:
                axis.plot(*zip(*sorted(rates.items())), "--" if triples else "-", color=colour,
                          label=who, linewidth=1.2)
        axis.set_title(TITLES[outputs], fontsize=10)
        axis.set_xticks(range(0, 65, 8))
        axis.set_ylim(bottom=0)
        axis.grid(color="#e0e0e0", linewidth=0.6)
        axis.tick_params(labelsize=8)
        if place % 2 == 1:
            axis.set_ylabel("10⁹ samples/s", fontsize=9)
        if place > len(shown) - 2:
            axis.set_xlabel("n of n × n samples a patch, float, in cache", fontsize=9)
    figure.axes[0].legend(fontsize=8)
    figure.tight_layout()
    save(figure, path)


def roofline(rows, drawn, path):
    def limit(name, scale=1.0):
        return rows[name].median * scale / 1e9 if name in rows else None

    widest = next(isa for isa in ("avx512", "avx2", "neon64", "sse2", "scalar")
                  if f"limit/fma/f32/{isa}" in rows)
    peak = limit(f"limit/fma/f32/{widest}")
    figure, axis = pyplot.subplots(figsize=(9, 5))
    xs = [0.3, 3]
    axis.plot(xs, [peak, peak], color="black", linewidth=1)
    axis.annotate(f"limit/fma {widest}", (xs[0], peak), xytext=(2, 3), textcoords="offset points",
                  fontsize=8)
    for name, text in (("limit/fill_l1", "stores to L1"),
                       ("limit/fill_cache", "stores to L2"),
                       ("limit/fill_stream/threads:1", "streaming stores to memory")):
        bandwidth = limit(name, 12)
        if bandwidth is not None:
            ends = [xs[0], min(xs[1], peak / bandwidth)]
            axis.plot(ends, [x * bandwidth for x in ends], color="black", linewidth=1)
            axis.text(ends[0] * 1.02, ends[0] * bandwidth * 1.05, f"{text}: {bandwidth:.0f} GB/s",
                      rotation=math.degrees(math.atan(bandwidth)), rotation_mode="anchor",
                      transform_rotates_text=True, fontsize=8)
    shown = set()
    for name, n, rate in grids(rows, drawn):
        # Of curvatures, roots and divisions are most of the work.
        if n in (16, 32) and name.who != "de_casteljau" and name.outputs in MARKERS:
            shown |= {name.outputs, name.who}
            work = multiply_adds(name.outputs, n)
            filled = name.place == "cache"
            axis.plot(work / name.bytes_per_sample, rate * work / 1e9, MARKERS[name.outputs],
                      color=drawn[name.who], markersize=4 + n / 16, alpha=0.9,
                      markerfacecolor=drawn[name.who] if filled else "white")
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.minorticks_off()
    axis.set_xticks([0.3, 0.5, 1, 2, 3], ["0.3", "0.5", "1", "2", "3"])
    low, high = axis.get_ylim()
    ticks = [y for y in (5, 10, 20, 50, 100, 200, 500) if low < y < high]
    axis.set_yticks(ticks, map(str, ticks))
    axis.set_xlabel("multiply-adds per byte written (float, 16 × 16 small, 32 × 32 large)")
    axis.set_ylabel("10⁹ multiply-adds/s")
    axis.grid(color="#e0e0e0", linewidth=0.6)
    handles = [axis.plot([], [], MARKERS[o], color="grey", label=TITLES[o])[0]
               for o in TITLES if o in shown]
    handles += [axis.plot([], [], "o", color=c, label=w)[0]
                for w, c in drawn.items() if w in shown]
    handles.append(axis.plot([], [], "o", color="grey", markerfacecolor="white",
                             label="to memory")[0])
    axis.legend(handles=handles, fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1))
    figure.tight_layout()
    save(figure, path)


def main(arguments):
    if len(arguments) not in (2, 3):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder = Path(arguments[2]) if len(arguments) == 3 else Path(__file__).parent.parent / "docs" / "pictures"
    matplotlib.rcParams.update({"svg.hashsalt": "simdbezier", "svg.fonttype": "none",
                                "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"]})
    (context, results), (sweep_context, sweep) = map(read, arguments[:2])
    drawn = colours(context, sweep_context)
    by_size(sweep, drawn, folder / "speed_by_size.svg")
    roofline(results, drawn, folder / "roofline.svg")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
