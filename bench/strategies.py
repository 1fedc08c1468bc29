#!/usr/bin/env python3
"""What each strategy for grids is worth on this machine.

usage: strategies.py BENCH [ROUNDS [REGEX]]

BENCH is simdbezier_bench. Runs its grid rows that match REGEX (default: floats on the widest
instruction set, planes, one thread) as they are and without each strategy, in turns, ROUNDS times
(default: 5), and prints a table: a line a row, a column a strategy. A cell is the best speed
without the strategy divided by the best one with all of them; it is empty if the row does not take
the strategy.
"""

import json
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # results.py is imported from the source tree
from results import natural_order, repetitions  # noqa: E402

def run(bench, regex, without):
    """Row name -> (samples/s, strategies that it took) of one run."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        command = [bench, f"--benchmark_filter={regex}", f"--benchmark_out={out.name}"]
        command += [f"--without={without}"] if without else []
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(out.name, encoding="utf-8") as file:
            report = json.load(file)
    labels = {row["run_name"]: row.get("label", "").split() for row in report["benchmarks"]}
    return {name: (max(values), labels[name]) for name, values in repetitions(report).items()}


def strategies(bench):
    """The names that --without knows, which its complaint about another one lists."""
    said = subprocess.run([bench, "--without=?"], stderr=subprocess.PIPE, text=True, check=False)
    return re.search(r"expected one of (.*), found", said.stderr).group(1).split()


def widest(bench):
    listed = subprocess.run([bench, "--benchmark_list_tests"], stdout=subprocess.PIPE, text=True,
                            check=True).stdout
    for name in ("avx512", "avx2", "neon64", "sse2"):
        if f"/f32/{name}/16x16/cache" in listed:
            return name
    return "scalar"


def main(bench, rounds="5", regex=None):
    regex = regex or f"^grid/[a-z_]*/f32/{widest(bench)}/[0-9x]*/(cache|memory)/threads:1$"
    ways = ["", *strategies(bench)]
    best = {way: {} for way in ways}
    taken = {}
    for _ in range(int(rounds)):
        for way in ways:
            for name, (rate, strategies_of_row) in run(bench, regex, way).items():
                best[way][name] = max(rate, best[way].get(name, 0))
                if not way:
                    taken[name] = strategies_of_row
    print("| row | " + " | ".join(ways[1:]) + " |")
    print("| --- |" + " --- |" * len(ways[1:]))
    for name in sorted(best[""], key=natural_order):
        cells = [f"{best[way][name] / best[''][name]:.2f}" if way in taken[name] else ""
                 for way in ways[1:]]
        if any(cells):
            print(f"| {name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 4 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    main(*sys.argv[1:])
