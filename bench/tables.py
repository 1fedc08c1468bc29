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
  machine  grids in cache and to memory; tiles, scattered samples and packing
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
        self.next_isa, self.isa = context["isas"].split()[-2:]
        self.kinds = (("f32", self.isa), ("f32", self.next_isa), ("f64", self.isa))

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
        positions = min(pairs, fill if kind == "f32" else fill / 2)
        return positions / (VALUES[outputs] / VALUES["position"])

    def ratio(self, name, reference):
        own, other = self.rate(name), self.rate(reference)
        return own / other if own and other else None


def cells(*values):
    """Numbers with their formats, as one cell."""
    texts = [MISSING if value is None else format(value, form) for value, form in values]
    return " / ".join(texts) if set(texts) != {MISSING} else MISSING


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


# What a row of the limits' table says: its unit, and the limits in it with the size of an item.
GIGABYTES = 12 / 1e9  # an item of a limit of stores stands for 12 bytes
LIMITS = {
    "multiply-adds, widest instruction set / the next": (
        "· 10⁹ lanes/s", 1e-9, ".0f", ("fma/f32/{isa}", "fma/f32/{next_isa}")),
    "cubics from registers to a cache, likewise": (
        "· 10⁹ positions/s", 1e-9, ".1f",
        ("horner_store/f32/{isa}", "horner_store/f32/{next_isa}")),
    "stores to memory, streaming, 1 / 2 threads": (
        "GB/s", GIGABYTES, ".1f", ("fill_stream/threads:1", "fill_stream/threads:2")),
    "stores to memory, plain, 1 / 2 threads": (
        "GB/s", GIGABYTES, ".1f", ("fill_plain/threads:1", "fill_plain/threads:2")),
    "stores to the first-level cache / the second-level one / that across lines": (
        "GB/s", GIGABYTES, ".0f", ("fill_l1", "fill_cache", "fill_cache/align:8")),
    "instructions that do nothing": ("· 10⁹/s", 1e-9, ".1f", ("issue",)),
    "samples of random patches in memory": ("· 10⁶/s", 1e-6, ".0f", ("random_lines",)),
}


def limits(*machines):
    rows = []
    for title, (unit, scale, form, names) in LIMITS.items():
        families = dict.fromkeys(f"`limit/{name.split('/')[0]}`" for name in names)
        row = [f"{title} ({', '.join(families)})"]
        for results in machines:
            rates = [results.rate("limit/" + name.format(**vars(results))) for name in names]
            cell = cells(*((rate and rate * scale, form) for rate in rates))
            row.append(cell if cell == MISSING else f"{cell} {unit}")
        rows.append(row)
    return table(["", *(results.name for results in machines)], rows)


def cache(results):
    rows = []
    for kind, isa in results.kinds:
        for outputs, title in OUTPUTS.items():
            line = [f"{TYPES[kind]}, {isa}: {title}"]
            for n in SIZES:
                own = grid(outputs, kind, isa, n)
                rate = results.rate(own)
                line.append(cells(
                    (rate and rate / 1e9, ".2f"),
                    (results.ratio(own, grid(outputs, kind, "de_casteljau", n)), ".0f"),
                    (results.ratio(own, grid(outputs, kind, "autovectorised", n)), ".2f"),
                    (rate and rate / results.limit_in_cache(outputs, kind, isa), ".2f")))
            rows.append(line)
    title = "in cache: 10⁹/s / × de Casteljau / × auto-vectorised / share of limit"
    return table([title, *(f"{n}×{n}" for n in SIZES)], rows)


def memory(results):
    sizes = [n for n in SIZES if n > 8]
    rows = []
    for kind, isa in results.kinds:
        if kind == "f64":  # much like float, in bytes
            continue
        for outputs, title in OUTPUTS.items():
            layouts = [layout for layout in LAYOUTS
                       if layout != "/layout:interleaved" or outputs != "position"]
            line = [f"{TYPES[kind]}, {isa}: {title}, "
                    + " / ".join(LAYOUTS[layout] for layout in layouts)]
            for n in sizes:
                line.append(cells(*((results.share(grid(outputs, kind, isa, n, "memory", layout)),
                                     ".2f") for layout in layouts)))
            if set(line[1:]) != {MISSING}:
                rows.append(line)
    title = "to memory: share of `limit/fill_stream`"
    return table([title, *(f"{n}×{n}" for n in sizes)], rows)


def calls(results):
    tail = f"f32/{results.isa}"
    lines = (("tiles, 16×16, 4 GiB of output, to the grid in cache",
              f"tiles/{{}}/{tail}/16x16/cache/threads:1",
              f"grid/{{}}/{tail}/16x16/cache/threads:1"),
             ("scattered, 64 a patch in order, 2048 patches, to de Casteljau",
              f"scattered_sorted/{{}}/{tail}/1x1/cache/threads:1/patches:2048",
              "scattered_sorted/{}/f32/de_casteljau/1x1/cache/threads:1/patches:2048"),
             ("scattered at random, 2048 patches, to de Casteljau",
              f"scattered_random/{{}}/{tail}/1x1/cache/threads:1/patches:2048",
              "scattered_random/{}/f32/de_casteljau/1x1/cache/threads:1/patches:2048"),
             ("scattered at random, 10⁶ patches, to `limit/random_lines`",
              f"scattered_random/{{}}/{tail}/1x1/memory/threads:1/patches:1000000",
              "limit/random_lines"))
    rows = []
    for title, name, reference in lines:
        row = [title]
        for outputs in OUTPUTS:
            own, other = name.format(outputs), reference.format(outputs)
            ratio = results.share(own) if other.startswith("limit") else results.ratio(own, other)
            form = ".1f" if "Casteljau" in title else ".2f"
            rate = results.rate(own)
            row.append(cells((rate and rate / 1e6, ".0f"), (ratio, form)))
        rows.append(row)
    pack = [results.rate(f"pack/position/{kind}/{results.isa}/4x4/cache/threads:1") / 1e6
            for kind in ("f32", "f64")]
    rows.append(["pack, sets in L2, float / double", cells(*((rate, ".1f") for rate in pack)),
                 "", ""])
    return table([f"float, {results.isa}: 10⁶/s / ratio", *OUTPUTS.values()], rows)


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
