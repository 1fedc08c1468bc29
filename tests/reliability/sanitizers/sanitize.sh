#!/usr/bin/env bash
# Builds and runs everything under the sanitizers; exit 0: nothing was found.
#
#     sanitize.sh [address | thread]     one of them; both where none is named
#
# address  addresses and undefined behaviour, library, kernels, program and the whole test suite,
#          except tests of other builds (same_bits_*, installed_tree), of symbols, and those that let
#          every system call of a program fail once: some symbols and calls are the sanitizers' own.
#          AVX-512 is built only where the machine runs it: it is a third of the time to compile.
#          In kernels null pointers, sizes of objects and alignment are left to the address
#          sanitizer and the processor: to test each of them takes twice as long to compile.
# thread   who touches what from which thread. By clang with LLVM's OpenMP runtime, whose tool
#          (archer) tells the sanitizer where threads wait for each other: libgomp does not, and
#          every region would be a false alarm. Stores of more than 16 bytes are not watched, so
#          the kernels are the scalar and the SSE2 ones.
set -euo pipefail
cd "$(dirname "$0")/../../.."

configure_and_build() { # preset instruction_sets target…: all sets where none is named
  local preset=$1 isas=$2
  shift 2
  cmake --preset "$preset" ${isas:+"-DSIMDBEZIER_ISAS=$isas"} >"build/$preset.log" 2>&1 ||
    { cat "build/$preset.log" >&2; exit 1; }
  cmake --build "build/$preset" --target "$@"
}

run_tests() { # preset argument…
  local preset=$1
  shift
  OMP_WAIT_POLICY=passive ctest --test-dir "build/$preset" --output-on-failure --no-tests=error \
    --timeout 3600 -j "$(nproc)" "$@"
}

address() {
  local isas=
  [[ $(uname -m) == x86_64 ]] && ! grep -qw avx512f /proc/cpuinfo && isas="scalar;sse2;avx2"
  configure_and_build asan-ubsan "$isas" all
  # libgomp keeps its threads' memory until the process ends.
  UBSAN_OPTIONS=print_stacktrace=1 run_tests asan-ubsan \
    -E '^same_bits_|^symbols_|^installed_tree$|^mutation|^faults\.Jobs/SystemCalls'
}

thread() {
  local archer
  archer=$(find /usr/lib/llvm-* /usr/lib/x86_64-linux-gnu -name libarcher.so 2>/dev/null | head -1)
  [[ -n $archer ]] || { echo "sanitize: no libarcher.so: install libomp-dev" >&2; exit 1; }
  configure_and_build tsan "" test_threads test_regions
  export OMP_TOOL_LIBRARIES=$archer
  export TSAN_OPTIONS="ignore_noninstrumented_modules=1 suppressions=$PWD/tests/reliability/sanitizers/thread.supp"
  # One instruction at a time (StreamingOrder) is no speed for an instrumented program.
  run_tests tsan -R '^(threads|regions)\.' -E 'StreamingOrder'
}

mkdir -p build
case "${1:-both}" in
  address) address ;;
  thread) thread ;;
  both) address && thread ;;
  *) echo "usage: $0 [address | thread]" >&2; exit 2 ;;
esac
