#!/usr/bin/env python3
"""Writes the tables of README.md and docs/performance.md from the committed results.

usage: bench/tables.py [--check]

A page says where tables belong, and of which files below bench/results/ they are:

    <!-- tables: KIND RESULTS… -->
    …
    <!-- end of tables -->

What stands between the two lines is replaced. With --check nothing is written, and the exit code is
1 where a page is not what the results say. KIND is one of

  summary  16 x 16 grids, and how they compare with both baselines; of the second file, a sweep of
           sizes, how they all do
  limits   what machines can do at the most, one column each
  machine  grids in cache, one table a measure, and to memory; tiles, scattered samples and
           packing
"""

import re
import statistics
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # results.py is imported from the source tree
from results import VALUES, read  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
PAGES = ("README.md", "docs/performance.md")
BLOCK = re.compile(r"(<!-- tables: (\w+) ([\w -]+) -->\n).*?(<!-- end of tables -->)", re.DOTALL)

OUTPUTS = {"position": "positions", "position_derivatives": "+ du, dv",
           "position_normal": "+ normals"}
SIZES = (5, 8, 9, 16, 17, 32, 33)
TYPES = {"f32": "float", "f64": "double"}
LAYOUTS = {"": "planes", "/layout:aos": "x y z", "/layout:interleaved": "vertices"}
MISSING = "–"


class Results:
    def __init__(self, name):
        self.name = name
        context, self.rows = read(ROOT / "bench" / "results" / f"{name}.json")
        isas = context["isas"].split()  # one in a build for one machine alone
        self.next_isa, self.isa = isas[-2:] if len(isas) > 1 else isas * 2
        self.kinds = tuple(dict.fromkeys((("f32", self.isa), ("f32", self.next_isa), ("f64", self.isa))))

    def rate(self, name):
        """Items a second; None where that was not measured."""
        row = self.rows.get(name)
        return row and row.median

    def share(self, name):
        """Of the limit, in the same runs."""
        row = self.rows.get(name)
        return row and row.share

    def limit_in_cache(self, outputs, kind, isa):
        """Samples a second, by the arithmetic of rows in pairs or by stores to the cache, whichever
        allows less; every vector of a sample counts as a position."""
        pairs, fill = self.rate(f"limit/pairs_store/{kind}/{isa}"), self.rate("limit/fill_cache")
        if not pairs or not fill:
            return None
        positions = min(pairs, fill if kind == "f32" else fill / 2)
        return positions / (VALUES[outputs] / VALUES["position"])

    def ratio(self, name, reference):
        own, other = self.rate(name), self.rate(reference)
        return own / other if own and other else None


def cell(value, form):
    return MISSING if value is None else format(value, form)


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def grid(outputs, kind, who, n, place="cache", more=""):
    return f"grid/{outputs}/{kind}/{who}/{n}x{n}/{place}/threads:1{more}"


def summary(results, sweep):
    """The second file is one of measure.py --sweep."""
    rows = []
    for outputs, title in OUTPUTS.items():
        own, scalar, loops = (grid(outputs, "f32", who, 16)
                              for who in (results.isa, "de_casteljau", "autovectorised"))
        ratios = [ratio for ratio in (sweep.ratio(grid(outputs, "f32", results.isa, n),
                                                  grid(outputs, "f32", "autovectorised", n))
                                      for n in range(2, 66)) if ratio]
        rows.append([title, f"{results.rate(own) / 1e9:.1f} · 10⁹ samples/s",
                     f"{results.ratio(own, scalar):.0f} ×", f"{results.ratio(own, loops):.1f} ×",
                     f"{statistics.median(ratios):.1f} × ({min(ratios):.1f} to {max(ratios):.1f})"])
    return table(["", "16 × 16 samples a patch", "to scalar de Casteljau",
                  "to auto-vectorised loops", "the same from 2 × 2 to 65 × 65: median (range)"], rows)


# Rows of the limits' table: what the limit is, its name, its unit, and the size of an item in it.
GIGABYTES = 12 / 1e9  # an item of a limit of stores stands for 12 bytes
LIMITS = (
    ("multiply-adds, widest instruction set", "fma/f32/{isa}", "10⁹ lanes/s", 1e-9, ".0f"),
    ("multiply-adds, the next one", "fma/f32/{next_isa}", "10⁹ lanes/s", 1e-9, ".0f"),
    ("cubics from registers to a cache, widest instruction set", "horner_store/f32/{isa}",
     "10⁹ positions/s", 1e-9, ".1f"),
    ("cubics from registers to a cache, the next one", "horner_store/f32/{next_isa}",
     "10⁹ positions/s", 1e-9, ".1f"),
    ("streaming stores to memory, 1 thread", "fill_stream/threads:1", "GB/s", GIGABYTES, ".1f"),
    ("streaming stores to memory, 2 threads", "fill_stream/threads:2", "GB/s", GIGABYTES, ".1f"),
    ("plain stores to memory, 1 thread", "fill_plain/threads:1", "GB/s", GIGABYTES, ".1f"),
    ("plain stores to memory, 2 threads", "fill_plain/threads:2", "GB/s", GIGABYTES, ".1f"),
    ("stores to the first-level cache", "fill_l1", "GB/s", GIGABYTES, ".0f"),
    ("stores to the second-level cache", "fill_cache", "GB/s", GIGABYTES, ".0f"),
    ("stores to it across lines", "fill_cache/align:8", "GB/s", GIGABYTES, ".0f"),
    ("instructions that do nothing", "issue", "10⁹/s", 1e-9, ".1f"),
    ("samples of random patches in memory", "random_lines", "10⁶/s", 1e-6, ".0f"),
)


def limits(*machines):
    rows = []
    for title, name, unit, scale, form in LIMITS:
        row = [f"{title} (`limit/{name.split('/')[0]}`)", unit]
        for results in machines:
            rate = results.rate("limit/" + name.format(**vars(results)))
            row.append(cell(rate and rate * scale, form))
        rows.append(row)
    return table(["", "unit", *(results.name for results in machines)], rows)


def cache(results):
    """One table for each measure of the same rows."""
    def rate(own, _):
        items = results.rate(own)
        return items and items / 1e9

    def ratio_to(who):
        return lambda own, place: results.ratio(own, grid(place[0], place[1], who, place[3]))

    def share(own, place):
        items = results.rate(own)
        limit = results.limit_in_cache(*place[:3])
        return items / limit if items and limit else None

    measures = (("10⁹ samples/s", rate, ".2f"),
                ("ratio to scalar de Casteljau", ratio_to("de_casteljau"), ".0f"),
                ("ratio to auto-vectorised loops", ratio_to("autovectorised"), ".2f"),
                ("share of the machine's limit", share, ".2f"))
    tables = []
    for measure, value, form in measures:
        rows = []
        for kind, isa in results.kinds:
            for outputs, title in OUTPUTS.items():
                places = [(outputs, kind, isa, n) for n in SIZES]
                rows.append([f"{TYPES[kind]}, {isa}: {title}",
                             *(cell(value(grid(*place), place), form) for place in places)])
        tables.append(table([f"in cache: {measure}", *(f"{n}×{n}" for n in SIZES)], rows))
    return "\n".join(tables)


def memory(results):
    sizes = [n for n in SIZES if n > 8]
    rows = []
    for kind, isa in results.kinds:
        if kind == "f64":  # much like float, in bytes
            continue
        for outputs, title in OUTPUTS.items():
            for layout, layout_title in LAYOUTS.items():
                line = [f"{TYPES[kind]}, {isa}: {title}, {layout_title}"]
                for n in sizes:
                    share = results.share(grid(outputs, kind, isa, n, "memory", layout))
                    line.append(cell(share, ".2f"))
                if set(line[1:]) != {MISSING}:
                    rows.append(line)
    title = "to memory: share of `limit/fill_stream`"
    return table([title, *(f"{n}×{n}" for n in sizes)], rows)


def calls(results):
    tail = f"f32/{results.isa}"
    lines = (("tiles, 16×16, 4 GiB of output", "ratio to the grid in cache",
              f"tiles/{{}}/{tail}/16x16/cache/threads:1",
              f"grid/{{}}/{tail}/16x16/cache/threads:1"),
             ("scattered, 64 a patch in order, 2048 patches", "ratio to de Casteljau",
              f"scattered_sorted/{{}}/{tail}/1x1/cache/threads:1/patches:2048",
              "scattered_sorted/{}/f32/de_casteljau/1x1/cache/threads:1/patches:2048"),
             ("scattered at random, 2048 patches", "ratio to de Casteljau",
              f"scattered_random/{{}}/{tail}/1x1/cache/threads:1/patches:2048",
              "scattered_random/{}/f32/de_casteljau/1x1/cache/threads:1/patches:2048"),
             ("scattered at random, 10⁶ patches", "share of `limit/random_lines`",
              f"scattered_random/{{}}/{tail}/1x1/memory/threads:1/patches:1000000",
              "limit/random_lines"))
    rows = []
    for title, measure, name, reference in lines:
        rates, ratios = [f"{title}: 10⁶ samples/s"], [f"… {measure}"]
        for outputs in OUTPUTS:
            own, other = name.format(outputs), reference.format(outputs)
            ratio = results.share(own) if other.startswith("limit") else results.ratio(own, other)
            rate = results.rate(own)
            rates.append(cell(rate and rate / 1e6, ".0f"))
            ratios.append(cell(ratio, ".1f" if "Casteljau" in measure else ".2f"))
        rows += [rates, ratios]
    packed = []
    for kind, title in TYPES.items():
        rate = results.rate(f"pack/position/{kind}/{results.isa}/4x4/cache/threads:1")
        packed.append([f"{title}, {results.isa}", cell(rate and rate / 1e6, ".1f")])
    return "\n".join((table([f"float, {results.isa}", *OUTPUTS.values()], rows),
                      table(["packing, sets in L2", "10⁶ patches/s"], packed)))


def machine(results):
    return "\n".join((cache(results), memory(results), calls(results)))


def with_tables(text):
    makers = {maker.__name__: maker for maker in (summary, limits, machine)}
    return BLOCK.sub(lambda m: f"{m[1]}{makers[m[2]](*map(Results, m[3].split()))}\n{m[4]}", text)


def main(arguments):
    if arguments not in ([], ["--check"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    old = {page: (ROOT / page).read_text(encoding="utf-8") for page in PAGES}
    stale = [page for page in PAGES if with_tables(old[page]) != old[page]]
    for page in stale:
        if arguments:
            print(f"tables.py: {page} is not what bench/results/ says; run bench/tables.py",
                  file=sys.stderr)
        else:
            (ROOT / page).write_text(with_tables(old[page]), encoding="utf-8")
    return 1 if arguments and stale else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
