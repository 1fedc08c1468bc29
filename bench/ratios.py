#!/usr/bin/env python3
"""Ratios of the library's rows to baselines and limits of the same run.

usage: ratios.py RUN.json [REGEX]

Reads what `simdbezier_bench --benchmark_out=RUN.json` or measure.py wrote and prints the rows whose
name matches REGEX (default: all), family by family: median samples/s, spread over the repetitions
((max - min) / median), and ratios of medians:

  de_casteljau    to the baseline on the same grid or the same samples, one thread, its own layout
  autovectorised  likewise
  limit           cache, positions: to limit/horner_store of the type and instruction set
                  memory: bytes written to those of limit/fill_stream with as many threads
                  random samples, patches in memory: to limit/random_lines (192 bytes a patch: f32)
  cache row       tiles: to the grid row in cache of the same size and layout
  threads:1       to the same row with one thread
  16x16 grid      pack: time a patch to that of its 256 positions (grid row in cache)
  library         other evaluators' grids: to the library's fastest row of the same layout, outputs
                  and type; their ratios to a baseline are given where it has their layout, too
                  (autovectorised: planes, de_casteljau: x y z triples)
"""

import re
import sys

sys.dont_write_bytecode = True  # results.py is imported from the source tree
from results import (BASELINES, INSTRUCTION_SETS, Name, evaluators, limit_of,  # noqa: E402
                     natural_order, read)


def rate(value):
    for unit, size in (("G", 1e9), ("M", 1e6), ("k", 1e3)):
        if value >= size:
            return f"{value / size:.3f} {unit}/s"
    return f"{value:.3f} /s"


def table(title, columns, rows):
    rows = [[title, "samples", "spread", *columns], *rows]
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        cells = [cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]
        print("  ".join([row[0].ljust(widths[0])] + cells).rstrip())
    print()


class Ratios:
    def __init__(self, rows):
        self.rows = rows

    def median(self, name):
        return self.rows[name].median if name in self.rows else None

    def to_baseline(self, row, baseline):
        if not row.bicubic:
            return None
        keys = {key: value for key, value in row.keys.items() if key == "patches"}
        return self.median(row.text(who=baseline, threads=1, keys=keys))

    def to_library(self, row):
        """The library's fastest row that differs from this one in nothing else."""
        rates = [self.median(row.text(who=who)) for who in INSTRUCTION_SETS]
        return max(filter(None, rates), default=None)

    def to_limit(self, row):
        share = self.rows[row.text()].share
        if share is not None:
            return self.median(row.text()) / share
        name, scale = limit_of(row.text()) or ("", 1)
        limit = self.median(name)
        return limit and limit * scale

    def to_one_thread(self, row):
        return self.median(row.text(threads=1)) if row.threads > 1 else None

    def to_cache_row(self, row):
        keys = {key: value for key, value in row.keys.items() if key == "layout"}
        return self.median(row.text(call="grid", threads=1, keys=keys))

    def to_grid(self, row):
        """The patches a second at which a patch takes as long as 256 positions."""
        grid = self.median(row.text(call="grid", size="16x16", place="cache", threads=1, keys={}))
        return grid and grid / 256

    def cells(self, row, columns):
        references = {"limit": self.to_limit, "threads:1": self.to_one_thread,
                      "cache row": self.to_cache_row, "16x16 grid": self.to_grid,
                      "library": self.to_library}
        cells = []
        own = self.median(row.text())
        for column in columns:
            reference = (self.to_baseline(row, column) if column in BASELINES
                         else references[column](row))
            if not reference:
                cells.append("-")
            elif column == "16x16 grid":
                cells.append(f"{reference / own:.2f}x")
            elif column in ("limit", "cache row"):
                cells.append(f"{own / reference:.3f}")
            else:
                cells.append(f"{own / reference:.2f}x")
        return cells


FAMILIES = {
    "grid, cache": (*BASELINES, "limit"),
    "grid, memory": (*BASELINES, "limit", "threads:1"),
    "tiles": ("cache row", "threads:1"),
    "scattered_sorted": ("de_casteljau", "threads:1"),
    "scattered_random": ("de_casteljau", "limit", "threads:1"),
    "pack": ("16x16 grid",),
    "other evaluators, planes": ("library", "autovectorised"),
    "other evaluators, x y z triples": ("library", "de_casteljau"),
}


def family_of(name, guests):
    """The family of a row of the library or of one of the guests; None for baselines, other
    libraries and limits."""
    if name.startswith("limit/"):
        return None
    row = Name(name)
    if row.who in guests:
        return "other evaluators, " + ("x y z triples" if "layout" in row.keys else "planes")
    if row.who not in INSTRUCTION_SETS:
        return None
    return f"grid, {row.place}" if row.call == "grid" else row.call


def main(arguments):
    if len(arguments) not in (1, 2) or arguments[0] in ("-h", "--help"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    try:
        context, rows = read(arguments[0])
        wanted = re.compile(arguments[1] if len(arguments) == 2 else "")
    except (OSError, ValueError, KeyError, TypeError, re.error) as error:
        print(f"ratios.py: {arguments[0]}: {error!r}", file=sys.stderr)
        return 1

    ratios = Ratios(rows)
    printed = {family: [] for family in (*FAMILIES, None)}
    for name in sorted(filter(wanted.search, rows), key=natural_order):
        family = family_of(name, evaluators(context))
        spread = rows[name].spread
        cells = [name, rate(rows[name].median), "-" if spread is None else f"{spread:.1%}"]
        if family is not None:
            cells += ratios.cells(Name(name), FAMILIES[family])
        printed[family].append(cells)
    if not any(printed.values()):
        print(f"ratios.py: {arguments[0]}: no row's name matches '{wanted.pattern}'",
              file=sys.stderr)
        return 1
    for family, lines in printed.items():
        if lines:
            table(family or "baselines, other libraries, limits", FAMILIES.get(family, ()), lines)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
