#!/usr/bin/env python3
"""Measures the published rows in many short runs and keeps medians and spreads.

usage: bench/measure.py [options] BENCH OUT.json

BENCH is simdbezier_bench. Every run takes the rows that are compared with each other (one grid, one
destination) and their limits, several times each in random order: fifteen short times in cache,
where a neighbour that comes and goes would otherwise make one of two rows half as fast, three times
to memory. All runs are repeated ROUNDS times, so that a row's repetitions lie minutes apart and its
spread shows what the machine does meanwhile. Shares of limits are formed run by run, since memory
is shared with whatever else runs. One-thread rows are pinned to a core. OUT.json is small enough to
keep in a repository; ratios.py and plots.py read it.

  --core N        the core of one-thread rows; default: the last this process may use
  --rounds N      default 3
  --filter REGEX  only these of the published rows
  --all           every row that the program knows, not only the published ones
  --evaluator FILE.so
                  rows of another evaluator, too (may be given several times)
  --sweep         grid sizes 2 to 65 in cache instead, for the plots of speed against size
  --lock FILE     hold an exclusive lock on FILE during each run, for machines where others measure
"""

import argparse
import contextlib
import fcntl
import itertools
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # results.py is imported from the source tree
from results import limit_of, natural_order, repetitions  # noqa: E402

SECONDS_A_RUN = 12.0

# f32 is measured in full, f64 on the instruction sets that matter, and to memory whole and broken
# lines.
PUBLISHED = re.compile(
    r"^limit/"
    r"|^grid/.*/cache/"
    r"|^grid/[a-z_]+/f32/[a-z0-9_]+/(8x8|9x9|16x16|17x17|32x32|33x33)/memory/"
    r"|^grid/[a-z_]+/f64/(avx2|avx512|neon64|de_casteljau|autovectorised)/"
    r"(16x16|17x17|32x32)/memory/"
    r"|^(tiles|scattered_sorted|scattered_random|pack)/")
NARROW_TO_MEMORY = re.compile(r"^grid/[a-z_]+/f32/(scalar|sse2)/.*/memory/")
SWEEP = re.compile(r"^grid/[a-z_]+/f32/(avx2|avx512|neon64|de_casteljau|autovectorised)/"
                   r"(\d+)x\2/cache/threads:1$|^limit/(horner|fma)")
SWEPT_EVALUATOR = re.compile(r"/f32/[^/]+/(\d+)x\1/cache/")


def arguments():
    text = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=text,
                                     usage=argparse.SUPPRESS)
    parser.add_argument("bench")
    parser.add_argument("out")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)))
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--filter", type=re.compile, default=re.compile(""))
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--evaluator", action="append", default=[])
    parser.add_argument("--sweep", action="store_true")
    parser.add_argument("--lock")
    return parser.parse_args()


def flags(options):
    return [f"--evaluator={file}" for file in options.evaluator]


def listed(bench, *more):
    run = subprocess.run([bench, "--benchmark_list_tests", *more], check=False, text=True,
                         capture_output=True)
    if run.returncode != 0:
        sys.exit(f"measure.py: {run.stderr.strip()}")
    return run.stdout.split()


def names(options):
    own = listed(options.bench)
    others = set(listed(options.bench, *flags(options))) - set(own) if options.evaluator else set()
    if options.sweep:
        chosen = [*filter(SWEEP.search, own), *filter(SWEPT_EVALUATOR.search, others)]
    elif options.all:
        chosen = [*own, *others]
    else:
        chosen = [*others, *(name for name in own
                             if PUBLISHED.search(name) and not NARROW_TO_MEMORY.search(name))]
    return sorted(filter(options.filter.search, chosen), key=natural_order)


def threads(name):
    found = re.search(r"threads:(\d+)", name)
    return int(found[1]) if found else 1


def group(name):
    """Rows of one group share a run, because data of a memory row takes seconds to make."""
    parts = name.split("/")
    pinned = threads(name) == 1
    if parts[0] == "limit":
        return ("limit", parts[1].startswith(("fill", "random")), pinned)
    size = "" if "cache" in name and parts[0] == "grid" else parts[4]
    patches = re.search(r"patches:\d+", name)
    return (parts[0], parts[1], parts[2], size, parts[5], patches and patches[0], pinned)


def seconds(name):
    """Roughly what one repetition of a row takes, with its share of the preparation."""
    if "memory" in name or name.startswith("limit/fill"):
        return 0.6 if "de_casteljau" in name or "f64" in name else 0.3
    return 0.3 if name.startswith(("scattered", "tiles", "limit/random")) else 0.02


def repetitions_of(rows):
    return 15 if all(seconds(row) < 0.1 for row in rows) else 3


def size(name):
    return natural_order(name.split("/")[4] if name.count("/") > 5 else name)


def runs(chosen):
    """Lists of rows that are measured together, each short."""
    ordered = sorted(chosen, key=lambda name: (str(group(name)), size(name)))
    for _, members in itertools.groupby(ordered, key=group):
        part, cost = [], 0.0
        for _, same in itertools.groupby(members, key=size):  # these are compared
            same = list(same)
            more = repetitions_of(same) * sum(map(seconds, same))
            if part and cost + more > SECONDS_A_RUN:
                yield part
                part, cost = [], 0.0
            part, cost = part + same, cost + more
        if part:
            yield part


@contextlib.contextmanager
def locked(path):
    if path is None:
        yield
        return
    with open(path, "a", encoding="utf-8") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def measure(options, rows):
    """The report of one run; None where the program ended before it wrote one."""
    environment = {**os.environ, "SIMDBEZIER_BENCH_SWEEP": "1" if options.sweep else "0"}
    pinned = all(threads(row) == 1 for row in rows)
    limits = {limit_of(row)[0] for row in rows if limit_of(row)}
    pattern = "|".join(map(re.escape, sorted({*rows, *limits})))
    with tempfile.NamedTemporaryFile(suffix=".json") as report, locked(options.lock):
        result = subprocess.run(
            [options.bench, *flags(options), f"--benchmark_filter=^({pattern})$",
             f"--benchmark_repetitions={repetitions_of(rows)}", "--benchmark_min_time=0.01",
             "--benchmark_enable_random_interleaving=true", f"--benchmark_out={report.name}"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False, env=environment,
            preexec_fn=(lambda: os.sched_setaffinity(0, {options.core})) if pinned else None)
        if result.returncode != 0:
            print(f"measure.py: the run of {rows[0]} … failed", file=sys.stderr)
        try:
            found = json.load(report)
        except ValueError:
            return None
    for row in found["benchmarks"]:
        if row.get("error_occurred"):
            print(f"measure.py: {row['name']}: {row['error_message']}", file=sys.stderr)
    return found


def shares(rates):
    """Row name -> share of its limit in the same run."""
    median = {name: statistics.median(values) for name, values in rates.items()}
    found = {}
    for name, limit in ((name, limit_of(name)) for name in median):
        if limit is not None and limit[0] in median:
            found[name] = median[name] / (median[limit[0]] * limit[1])
    return found


def write(path, context, values, of_limit):
    """Writes one row a line, in families that share the first three parts of their names."""
    families = {}
    for name in sorted(values, key=natural_order):
        parts = name.split("/")
        split = min(3, len(parts) - 1)
        numbers = summary(values[name])
        if name in of_limit:
            numbers.append(round(statistics.median(of_limit[name]), 3))
        families.setdefault("/".join(parts[:split]), {})["/".join(parts[split:])] = numbers
    with open(path, "w", encoding="utf-8") as file:
        file.write('{"about": "rate in 10^6/s, spread (max - min) / median in %, repetitions, '
                   'share of the limit in the same runs",\n')
        file.write(f'"context": {json.dumps(context, indent=1)},\n"rows": {{\n')
        file.write(",\n".join(
            f'"{family}": {{\n' + ",\n".join(
                f'"{rest}": {json.dumps(members[rest], separators=(",", ":"))}'
                for rest in members) + "}"
            for family, members in families.items()))
        file.write("}}\n")


def summary(values):
    median = statistics.median(values)
    spread = round(100 * (max(values) - min(values)) / median, 1)
    return [float(f"{median / 1e6:.4g}"), spread, len(values)]


def main():
    options = arguments()
    if options.sweep:
        os.environ["SIMDBEZIER_BENCH_SWEEP"] = "1"
    chosen = names(options)
    plan = list(runs(chosen))
    if not plan:
        print(f"measure.py: --filter: no {'' if options.all else 'published '}row's name matches "
              f"'{options.filter.pattern}'", file=sys.stderr)
        return 1
    if options.rounds < 1:
        sys.exit(f"measure.py: --rounds: expected 1 or more, found {options.rounds}")
    if options.core not in os.sched_getaffinity(0):
        sys.exit(f"measure.py: --core: this process may not use core {options.core}")
    folder = os.path.dirname(os.path.abspath(options.out))
    if not os.access(folder, os.W_OK):  # now, and not after a quarter of an hour
        sys.exit(f"measure.py: {folder}: expected a folder that can be written to")
    context, values, of_limit = {}, {}, {}
    for number, rows in enumerate(itertools.chain.from_iterable([plan] * options.rounds), 1):
        print(f"{number}/{len(plan) * options.rounds}: {rows[0]} and {len(rows) - 1} more",
              file=sys.stderr)
        report = measure(options, rows)
        if report is None:
            continue
        context = {**report["context"], "cores": str(len(os.sched_getaffinity(0)))}
        rates = repetitions(report)
        for name, more in rates.items():
            values.setdefault(name, []).extend(more)
        for name, share in shares(rates).items():
            of_limit.setdefault(name, []).append(share)
    missing = [name for name in chosen if name not in values]
    for name in missing:
        print(f"measure.py: no result: {name}", file=sys.stderr)
    if not values:  # what a file has from before is better than nothing
        return 1
    kept = ("date", "cpu", "cores", "caches", "compiler", "flags", "baseline_flags",
            "isas", "isa", "evaluators")
    write(options.out, {key: context[key] for key in kept if key in context},
          values, of_limit)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
