#!/usr/bin/env bash
# Lines and branches of the library (include/, kernels/, src/) and of the readers and writers (tools/)
# that the test suite runs: a table of folders, and every line in build/coverage/html/index.html.
#
#     coverage.sh [--report]     --report: of the last run, without running anything
#
# The kernels are compiled once per instruction set; a line counts as run where one of them ran it,
# and a branch likewise. Branches that only an exception takes are not counted: g++ adds one to
# every call. Exit 0: at least 95 % of the lines and 85 % of the branches.
set -euo pipefail
cd "$(dirname "$0")/../../.."
build=build/coverage

if [[ ${1-} != --report ]]; then
  mkdir -p build
  cmake --preset coverage >build/coverage.log 2>&1 || { cat build/coverage.log >&2; exit 1; }
  cmake --build "$build"
  find "$build" -name '*.gcda' -delete
  # A program that may not write, or is ended by a signal, spoils the counts that it was to add to.
  export GCOV_ERROR_FILE=/dev/null OMP_WAIT_POLICY=passive
  ctest --test-dir "$build" --output-on-failure --no-tests=error --timeout 1800 -j "$(nproc)" \
    -LE 'consumers|format' -E '^(same_bits_|symbols_|mutation|faults\.(Jobs|Signals)|cli\.(OutputFile|MeshOutput|Faults|Signals))|EndingSignal' ||
    echo "coverage: some tests failed" >&2
  "$build/tests/program/test_cli" --gtest_brief=1 \
    --gtest_filter='OutputFile.*:MeshOutput.*-*FullDisk*:*Terminated*:*LargestFile' || true
fi

mkdir -p "$build/html"
gcovr --root . --object-directory "$build" --filter 'include/' --filter 'kernels/' --filter 'src/' \
  --filter 'tools/' --exclude-throw-branches --exclude-unreachable-branches \
  --json "$build/coverage.json" "$build"
gcovr --root . --add-tracefile "$build/coverage.json" --exclude-throw-branches \
  --html-details "$build/html/index.html"
python3 tests/reliability/coverage/folders.py "$build/coverage.json" 95 85
