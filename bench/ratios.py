#!/usr/bin/env python3
"""Ratios of the library's rows to the baselines of the same run.

usage: ratios.py RUN.json [REGEX]

Reads what `simdbezier_bench --benchmark_out=RUN.json` wrote and prints, for each row of the
library whose name matches REGEX (default: all): median samples/s, spread over the repetitions
((max - min) / median), and the ratios of medians to its de_casteljau and autovectorised rows.
Rows of several threads are compared with the baselines' one thread, and rows with further
segments (watertight:off) with the baselines' plain row. Baselines and limits are listed below.
"""

import json
import re
import statistics
import sys

BASELINES = ("de_casteljau", "autovectorised")


def read_samples(path):
    """Row name -> samples/s of its repetitions (or, failing those, of its median)."""
    with open(path, encoding="utf-8") as file:
        entries = json.load(file)["benchmarks"]
    repetitions, medians = {}, {}
    for entry in entries:
        if entry.get("error_occurred") or "items_per_second" not in entry:
            continue
        name = entry.get("run_name", entry["name"])
        if entry.get("run_type") != "aggregate":
            repetitions.setdefault(name, []).append(entry["items_per_second"])
        elif entry.get("aggregate_name") == "median":
            medians[name] = [entry["items_per_second"]]
    return {**medians, **repetitions}


def baseline_name(row, baseline):
    """grid/position/f32/avx512/16x16/cache/threads:2/… -> the baseline's row, one thread."""
    call, outputs, value_type, _, size, destination = row.split("/")[:6]
    return "/".join((call, outputs, value_type, baseline, size, destination, "threads:1"))


def natural_order(name):
    """Sorts 8x8 before 16x16."""
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


def rate(value):
    for unit, size in (("G", 1e9), ("M", 1e6), ("k", 1e3)):
        if value >= size:
            return f"{value / size:.3f} {unit}/s"
    return f"{value:.3f} /s"


def table(rows):
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        cells = [cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]
        print("  ".join([row[0].ljust(widths[0])] + cells).rstrip())


def spread(values):
    if len(values) < 2:
        return "-"
    return f"{(max(values) - min(values)) / statistics.median(values):.1%}"


def main(arguments):
    if len(arguments) not in (1, 2) or arguments[0] in ("-h", "--help"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    try:
        samples = read_samples(arguments[0])
        wanted = re.compile(arguments[1] if len(arguments) == 2 else "")
    except (OSError, ValueError, KeyError, TypeError, re.error) as error:
        print(f"ratios.py: {arguments[0]}: {error!r}", file=sys.stderr)
        return 1

    median = {name: statistics.median(values) for name, values in samples.items()}
    library, others = [], []
    for name in sorted(samples, key=natural_order):
        values = samples[name]
        if not wanted.search(name):
            continue
        cells = [name, rate(median[name]), spread(values)]
        if not name.startswith("grid/") or name.split("/")[3] in BASELINES:
            others.append(cells)
            continue
        for baseline in BASELINES:
            reference = median.get(baseline_name(name, baseline))
            cells.append(f"{median[name] / reference:.2f}x" if reference else "-")
        library.append(cells)

    if not library and not others:
        print("ratios.py: no rows", file=sys.stderr)
        return 1
    if library:
        table([["row", "samples", "spread", *BASELINES], *library])
    if library and others:
        print()
    if others:
        table([["baselines and limits", "samples", "spread"], *others])
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
