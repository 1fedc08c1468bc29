"""Benchmark results as ratios.py and plots.py read them: runs of simdbezier_bench, or what
measure.py made of many of them."""

import json
import re
import statistics

INSTRUCTION_SETS = ("scalar", "sse2", "avx2", "avx512", "neon64")
BASELINES = ("de_casteljau", "autovectorised")
VALUES = {"position": 3, "position_normal": 6, "position_derivatives": 9, "second_derivatives": 18,
          "curvature": 7}


class Row:
    """One benchmark: median samples/s (patches/s for pack), spread and number of repetitions."""

    share = None  # of the limit, where that was measured in the same runs

    def __init__(self, values):
        self.values = values
        self.median = statistics.median(values)

    @property
    def spread(self):
        if len(self.values) < 2:
            return None
        return (max(self.values) - min(self.values)) / self.median

    @property
    def count(self):
        return len(self.values)


class Summary(Row):
    """A row of measure.py's file: rate in 10^6/s, spread in per cent, repetitions, share."""

    def __init__(self, rate, spread, count, share=None):
        self.median, self._spread, self._count = rate * 1e6, spread / 100, count
        self.share = share

    spread = property(lambda self: self._spread if self._count > 1 else None)
    count = property(lambda self: self._count)


def repetitions(report):
    """Row name -> samples/s of every repetition (or, failing those, of the median)."""
    values, medians = {}, {}
    for entry in report["benchmarks"]:
        if entry.get("error_occurred") or "items_per_second" not in entry:
            continue
        name = entry.get("run_name", entry["name"])
        if entry.get("run_type") != "aggregate":
            values.setdefault(name, []).append(entry["items_per_second"])
        elif entry.get("aggregate_name") == "median":
            medians[name] = [entry["items_per_second"]]
    return {**medians, **values}


def read(path):
    """(context, {row name: Row}) of a run or of measure.py's summary."""
    with open(path, encoding="utf-8") as file:
        report = json.load(file)
    if "benchmarks" in report:
        rows = {name: Row(values) for name, values in repetitions(report).items()}
    else:
        rows = {f"{family}/{rest}": Summary(*numbers)
                for family, members in report["rows"].items()
                for rest, numbers in members.items()}
    return report.get("context", {}), rows


def evaluators(context):
    """The names of plug-ins that took part in a run."""
    return context.get("evaluators", "").split()


def natural_order(name):
    """Sorts 8x8 before 16x16."""
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


class Name:
    """<call>/<outputs>/<type>/<who>/<size>/<place>/threads:<t>[/<key>:<value>…]"""

    def __init__(self, text):
        parts = text.split("/")
        if len(parts) < 7:
            raise ValueError(f"{text}: expected a row of simdbezier_bench")
        self.call, self.outputs, self.type, self.who, self.size, self.place = parts[:6]
        self.keys = dict(part.split(":", 1) for part in parts[6:])
        self.threads = int(self.keys.pop("threads"))

    def text(self, **changes):
        """The name with some parts changed; keys=… replaces all further segments."""
        fields = {**vars(self), **changes}
        head = "/".join(str(fields[k]) for k in ("call", "outputs", "type", "who", "size", "place"))
        keys = "".join(f"/{key}:{value}" for key, value in fields["keys"].items())
        return f"{head}/threads:{fields['threads']}{keys}"

    @property
    def bicubic(self):
        """What the baselines and the limits are made for."""
        return "degree" not in self.keys and "weights" not in self.keys

    @property
    def bytes_per_sample(self):
        return VALUES[self.outputs] * (4 if self.type == "f32" else 8)


def limit_of(text):
    """(name of the limit of a grid or scattered row, samples/s that one of its items stands for);
    None where there is none."""
    if text.startswith("limit/"):
        return None
    row = Name(text)
    if row.call == "grid" and row.place == "memory":  # bytes against bytes; the limit counts 12
        return f"limit/fill_stream/threads:{row.threads}", 12 / row.bytes_per_sample
    if row.call == "grid" and row.outputs == "position" and row.bicubic:
        return f"limit/horner_store/{row.type}/{row.who}", 1
    if row.call == "scattered_random" and row.place == "memory" and row.type == "f32":
        return "limit/random_lines", 1
    return None
