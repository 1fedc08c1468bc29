#!/usr/bin/env bash
# Fuzzes every target for a number of seconds, or the ones that are named:
#
#     tests/reliability/fuzz/fuzz.sh SECONDS [--isas LIST] [TARGET…]
#
# LIST is what SIMDBEZIER_ISAS takes, "scalar;avx2" for example: fewer instruction sets build faster.
# Needs what the tests need and, on Debian and Ubuntu, clang and libclang-rt-14-dev; installs nothing.
# Builds with address and undefined-behaviour sanitizers in build/fuzz, which takes some 20 minutes of
# a core the first time. Ends with exit code 1 and the reproducer's path at the first finding.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."

build=build/fuzz
here=tests/reliability/fuzz

usage() {
  echo "usage: $here/fuzz.sh SECONDS [--isas LIST] [TARGET…]" >&2
  exit 2
}
[[ ${1:-} =~ ^[1-9][0-9]*$ ]] || usage
seconds=$1
shift
isas=
if [[ ${1:-} == --isas ]]; then
  isas=${2:?--isas needs a list}
  shift 2
fi

mkdir -p "$build"
cmake -S . -B "$build" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release \
  -DBUILD_SHARED_LIBS=OFF -DSIMDBEZIER_BUILD_BENCH=OFF -DSIMDBEZIER_BUILD_EXAMPLES=OFF \
  -DSIMDBEZIER_BUILD_TOOLS=ON -DSIMDBEZIER_BUILD_TESTS=ON -DSIMDBEZIER_ISAS="$isas" \
  -DSIMDBEZIER_SANITIZE=fuzzer-no-link,address,undefined \
  >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
mapfile -t known <"$build/$here/targets.txt"
targets=("$@")
(( ${#targets[@]} > 0 )) || targets=("${known[@]}")
for target in "${targets[@]}"; do
  [[ " ${known[*]} " == *" $target "* ]] || { echo "fuzz: no target $target; there are: ${known[*]}" >&2; exit 2; }
done
cmake --build "$build" --target "${targets[@]/#/fuzz_}" || exit 1

# A hang is a finding; a thousand exact decisions of a few milliseconds each, which take thirty times
# as long under sanitizers, are none.
most_seconds=120
# Waiting threads would take the core from the fuzzer; counts beyond all memory have to be refused by
# the allocator, not by the sanitizer.
export OMP_WAIT_POLICY=passive
export ASAN_OPTIONS=allocator_may_return_null=1:detect_stack_use_after_return=0
export UBSAN_OPTIONS=print_stacktrace=1
# LLVM's OpenMP runtime keeps its threads' memory until the process ends.
export LSAN_OPTIONS=suppressions=$PWD/$here/leaks.supp:print_suppressions=0

# field NAME: the last value behind NAME in the fuzzer's log.
field() { grep -oE "$1:? +[0-9]+" "$log" | tail -n 1 | grep -oE '[0-9]+$' || echo 0; }

printf '%-12s %12s %10s %8s\n' target executions coverage seconds
for target in "${targets[@]}"; do
  corpus=$build/corpus/$target
  found=$build/findings/$target
  mkdir -p "$corpus" "$found"
  log=$build/$target.log
  dictionary=$here/dictionaries/$target.dict
  options=(-max_total_time="$seconds" -timeout="$most_seconds" -rss_limit_mb=3072 -print_final_stats=1 -reload=0
           -artifact_prefix="$found/")
  [[ -f $dictionary ]] && options+=(-dict="$dictionary")
  inputs=("$corpus")
  for folder in "$here/seeds/$target" "$build/$here/seeds/$target" "$here/regressions/$target"; do
    [[ -d $folder ]] && inputs+=("$folder")
  done
  begin=$SECONDS
  if ! "$build/$here/fuzz_$target" "${options[@]}" "${inputs[@]}" >"$log" 2>&1; then
    grep -E '^finding:|ERROR: |runtime error|SUMMARY' "$log" >&2 || tail -n 20 "$log" >&2
    echo "fuzz: $target has found something; its log is $log, to repeat:" >&2
    reproducer=$(grep -oE 'Test unit written to .*' "$log" | tail -n 1 | sed 's/Test unit written to //')
    echo "$build/$here/fuzz_$target ${reproducer:-}" >&2
    exit 1
  fi
  printf '%-12s %12s %10s %8s\n' "$target" "$(field stat::number_of_executed_units)" "$(field cov)" \
    "$((SECONDS - begin))"
done
