#!/usr/bin/env bash
# bench/demo.sh BUILD_DIR: the demo's figures. Times one grid call against scalar de Casteljau in one
# interleaved run and prints patches, samples, samples/s and the ratio.
set -euo pipefail
build=${1:?usage: bench/demo.sh BUILD_DIR}
isa=$("$build/simdbezier" info builtin:teapot --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["instruction_sets"]["chosen"])')
report=$(mktemp)
trap 'rm -f "$report" "$report.log"' EXIT
"$build/simdbezier_bench" --benchmark_filter="^grid/position(_normal)?/f32/($isa|de_casteljau)/16x16/cache/threads:1\$" \
  --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true --benchmark_min_time=0.1 \
  --benchmark_out="$report" --benchmark_out_format=json >"$report.log" 2>&1 || { cat "$report.log" >&2; exit 1; }
python3 - "$report" "$isa" <<'PYTHON'
import json, statistics, sys

rates = {}
for run in json.load(open(sys.argv[1]))["benchmarks"]:
    if run.get("run_type") == "iteration":
        rates.setdefault(run["run_name"], []).append(run["items_per_second"])
for outputs in ("position", "position_normal"):
    row = f"grid/{outputs}/f32/{{}}/16x16/cache/threads:1"
    ours, scalar = (statistics.median(rates[row.format(isa)]) for isa in (sys.argv[2], "de_casteljau"))
    print(f"{outputs}: {ours / 1e6:.0f} million samples/s on {sys.argv[2]}, "
          f"{ours / scalar:.1f} x scalar de Casteljau ({scalar / 1e6:.0f} million/s), one thread")
PYTHON
