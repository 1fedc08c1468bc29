#!/usr/bin/env bash
# Seeds faults into copies of the library, one at a time, and requires the named test to fail:
# a check that cannot fail is worth nothing. Run by hand after changing kernels or checks.
#
#     tests/accuracy/seed_faults.sh [--dry-run | FAULT]
#
# --dry-run only looks for the places in the sources.
# Exit 0: every fault was caught; 1: one was not, or its place in the sources was not found.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
data=${SIMDBEZIER_SHARED_DATA:-$root/../shared/data}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# fault | file | substitution | test program | tests that must fail
faults=(
  "contraction|kernels/isa/arch.hpp|s/return a \* b + c;/if constexpr (kIsScalar<V>) { return scalar_fma(a, b, c); } else { return a * b + c; }/|watertight/test_watertight|*ClassTest*sse2"
  "no_corner_store|kernels/bicubic.hpp|s/return column.edges.replace(value, c.corner.*/return value;/|watertight/test_watertight|*SharedEdges*"
  "reciprocal_step|kernels/grid/plan.cpp|s/numerator \/ static_cast<T>(intervals)/numerator * (T(1) \/ static_cast<T>(intervals))/|watertight/test_watertight|*SharedEdges*"
  "coefficients_in_double|kernels/pack/kernel.hpp|s/Wide, DoubleDouble>;/Wide, Wide>;/|library/test_library|PackKernel.coefficients*"
  "quotient_rule|kernels/shape/formulas.hpp|s/madd(s_x, minus_w_y,/madd(s_y, minus_w_y,/|accuracy/test_accuracy|*ShapesTest.EveryFamily*"
  "uncut_seam|kernels/shape/cell.hpp|s/at \* shape.cell_edges()/(at - index % 2) * shape.cell_edges()/|watertight/test_watertight|*ShapedEdgesTest.Seams*"
  "curve_moved_in_a_plane|kernels/curve/pack_kernel.hpp|s/Wide origin(component < 3/Wide origin(component < 2/|curves/test_curves|*CurveAccuracy*"
)

# Puts a fault into the copy of the sources.
seed() { # fault file substitution
  sed "$3" "$root/$2" >"$work/faulty"
  if cmp -s "$root/$2" "$work/faulty"; then
    echo "$1: nothing to substitute in $2" >&2
    return 1
  fi
  cp "$work/faulty" "$work/source/$2"
}

# Builds one test program of the copy.
build_copy() { # program
  # All at -O1, which compiles in a third of the time and has the same bits.
  cmake -S "$work/source" -B "$work/build" -DCMAKE_BUILD_TYPE=Debug \
        -DCMAKE_CXX_FLAGS_DEBUG="-O1 -DNDEBUG" -DSIMDBEZIER_BUILD_TESTS=ON \
        -DSIMDBEZIER_BUILD_BENCH=OFF -DSIMDBEZIER_SHARED_DATA="$data" >"$work/log" 2>&1 &&
    cmake --build "$work/build" -j"$(nproc)" --target "${1##*/}" >>"$work/log" 2>&1 ||
    { tail -20 "$work/log" >&2; return 1; }
}

mkdir "$work/source"
(cd "$root" && tar cf - --exclude=./build* --exclude=./.git .) | tar xf - -C "$work/source"
status=0
tried=0
for row in "${faults[@]}"; do
  IFS='|' read -r fault file substitution program filter <<<"$row"
  [[ $# -eq 0 || $1 == --dry-run || $1 == "$fault" ]] || continue
  tried=1
  seed "$fault" "$file" "$substitution" || { status=1; continue; }
  [[ ${1-} != --dry-run ]] || { echo "$fault: found in $file"; continue; }
  built=1
  build_copy "$program" || built=0
  # With the time of now, so that the next build compiles it anew: the fault would stay otherwise.
  cp "$root/$file" "$work/source/$file"
  (( built )) || { echo "$fault: does not compile" >&2; status=1; continue; }
  "$work/build/tests/$program" --gtest_filter="$filter" >"$work/log" 2>&1 || true
  # A program that could not run, or crashed, has found nothing.
  if caught=$(grep -m1 -oE 'FAILED  \] [A-Za-z/.0-9_]+' "$work/log"); then
    echo "$fault: caught by ${caught#*] }"
  else
    echo "$fault: NOT caught by $program --gtest_filter='$filter'"
    status=1
  fi
done
(( tried )) || { echo "$1: no such fault" >&2; status=1; }
exit $status
