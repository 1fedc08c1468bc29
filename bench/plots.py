#!/usr/bin/env python3
"""Draws the plots of docs/performance.md from what measure.py kept. Needs matplotlib.

usage: bench/plots.py RESULTS.json SWEEP.json [FOLDER]

FOLDER (default: docs/) receives
  speed_by_size.svg     samples/s in cache against grid size (SWEEP.json: measure.py --sweep)
  speed_to_baseline.svg the same as a ratio to scalar de Casteljau
  roofline.svg          multiply-adds/s against multiply-adds per byte written, with the machine's
                        limits (RESULTS.json); multiply-adds as the library counts them
The same files give the same bytes with one version of matplotlib.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

sys.dont_write_bytecode = True  # results.py is imported from the source tree
from results import Name, read  # noqa: E402

TITLES = {"position": "positions", "position_derivatives": "positions, du, dv",
          "position_normal": "positions, normals",
          "second_derivatives": "all up to second derivatives"}
COLOURS = {"avx512": "#1b6ca8", "avx2": "#2e8b57", "neon64": "#1b6ca8",
           "autovectorised": "#c0392b", "de_casteljau": "#8e44ad"}
MARKERS = {"position": "o", "position_derivatives": "s", "position_normal": "^",
           "second_derivatives": "D"}


def multiply_adds(outputs, n):
    """Of one sample on an n x n grid, products and sums that do not fuse counted as one each; the
    polynomials in v that a column's samples share are spread over them. No square root, no
    division."""
    per_sample = {"position": 9, "position_derivatives": 24, "position_normal": 36,
                  "second_derivatives": 42}
    per_column = {"position": 36, "position_derivatives": 60, "position_normal": 60,
                  "second_derivatives": 84}
    return per_sample[outputs] + per_column[outputs] / n


def save(figure, path):
    figure.savefig(path, format="svg", metadata={"Date": None, "Creator": None})
    pyplot.close(figure)


def grids(rows, kind="f32"):
    """Plain square grid rows of one thread: (Name, n, samples/s)."""
    for text, row in rows.items():
        if text.startswith("grid/"):
            name = Name(text)
            nu, nv = map(int, name.size.split("x"))
            if name.type == kind and name.threads == 1 and not name.keys and nu == nv:
                yield name, nu, row.median


def by_size(rows, path, label, value):
    figure, axes = pyplot.subplots(2, 2, figsize=(9, 6.5), sharex=True)
    lines = {}
    for name, n, rate in grids(rows):
        if name.place == "cache" and name.who in COLOURS:
            lines.setdefault((name.outputs, name.who), {})[n] = rate
    for axis, outputs in zip(axes.flat, TITLES):
        for who in COLOURS:
            rates = lines.get((outputs, who), {})
            points = [(n, value(rates[n], lines.get((outputs, "de_casteljau"), {}).get(n)))
                      for n in sorted(rates)]
            points = [(n, y) for n, y in points if y is not None]
            if points:
                axis.plot(*zip(*points), color=COLOURS[who], label=who, linewidth=1.2)
        axis.set_title(TITLES[outputs], fontsize=10)
        axis.set_xticks(range(0, 65, 8))
        axis.set_ylim(bottom=0)
        axis.grid(color="#e0e0e0", linewidth=0.6)
    axes[0, 0].legend(fontsize=8)
    for axis in axes[:, 0]:
        axis.set_ylabel(label)
    for axis in axes[1]:
        axis.set_xlabel("n of n × n samples a patch, float, in cache")
    figure.tight_layout()
    save(figure, path)


def roofline(rows, path):
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
    for name, text in (("limit/fill_l1", "stores to the first-level cache"),
                       ("limit/fill_cache", "stores to the second-level cache"),
                       ("limit/fill_stream/threads:1", "stores to memory, streaming")):
        bandwidth = limit(name, 12)
        if bandwidth is not None:
            ends = [xs[0], min(xs[1], peak / bandwidth)]
            axis.plot(ends, [x * bandwidth for x in ends], color="black", linewidth=1)
            axis.annotate(f"{text}: {bandwidth:.0f} GB/s", (ends[0], ends[0] * bandwidth),
                          xytext=(2, -12), textcoords="offset points", fontsize=8)
    for name, n, rate in grids(rows):
        if n in (16, 32) and name.who in COLOURS and name.who != "de_casteljau":
            work = multiply_adds(name.outputs, n)
            filled = name.place == "cache"
            axis.plot(work / name.bytes_per_sample, rate * work / 1e9, MARKERS[name.outputs],
                      color=COLOURS[name.who], markersize=4 + n / 16, alpha=0.9,
                      markerfacecolor=COLOURS[name.who] if filled else "white")
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xticks([0.3, 0.5, 1, 2, 3], ["0.3", "0.5", "1", "2", "3"])
    axis.minorticks_off()
    axis.set_xlabel("multiply-adds per byte written (float, 16 × 16 small, 32 × 32 large)")
    axis.set_ylabel("10⁹ multiply-adds/s")
    axis.grid(color="#e0e0e0", linewidth=0.6)
    handles = [axis.plot([], [], MARKERS[o], color="grey", label=TITLES[o])[0] for o in TITLES]
    handles += [axis.plot([], [], "o", color=c, label=w)[0] for w, c in COLOURS.items()
                if w != "de_casteljau" and (w != "neon64" or widest == "neon64")]
    handles.append(axis.plot([], [], "o", color="grey", markerfacecolor="white",
                             label="to memory")[0])
    axis.legend(handles=handles, fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1))
    figure.tight_layout()
    save(figure, path)


def main(arguments):
    if len(arguments) not in (2, 3):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder = Path(arguments[2]) if len(arguments) == 3 else Path(__file__).parent.parent / "docs"
    matplotlib.rcParams.update({"svg.hashsalt": "simdbezier", "svg.fonttype": "none",
                                "font.family": "sans-serif", "path.simplify": False})
    _, results = read(arguments[0])
    _, sweep = read(arguments[1])
    by_size(sweep, folder / "speed_by_size.svg", "10⁹ samples/s", lambda rate, _: rate / 1e9)
    by_size(sweep, folder / "speed_to_baseline.svg", "× scalar de Casteljau",
            lambda rate, baseline: rate / baseline if baseline else None)
    roofline(results, folder / "roofline.svg")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
