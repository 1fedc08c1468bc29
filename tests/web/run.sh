#!/usr/bin/env bash
# tests/web/run.sh [--if-built] BUILD [NATIVE]: judges the package and the page that web/pack.sh has made in BUILD. NATIVE: a build
# folder with the program and determinism_hash, whose bits and files have to be equal; without it, that is left out.
# --if-built: only where the package is there, and is newer than all that it is made of.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
if [[ $1 == --if-built ]]; then
  shift
  if [[ ! -f $1/simdbezier.tgz ]]; then
    echo "skipped: ./run web has not been run"
    exit
  fi
  newer=$(find include kernels src tools web examples/web tests/support tests/properties/bits -type f -newer "$1/simdbezier.tgz" -print -quit)
  if [[ -n $newer ]]; then
    echo "skipped: $newer is newer than the package that ./run web has made"
    exit
  fi
fi
source=$PWD build=$(realpath "$1") native=${2:+$(realpath "$2")}
export SIMDBEZIER_SOURCE=$source SIMDBEZIER_SHARED_DATA=${SIMDBEZIER_SHARED_DATA:-$source/../shared/data}
if [[ -n $native ]]; then
  export SIMDBEZIER_PROGRAM=$native/simdbezier
  node tests/web/bits_test.mjs "$build/web/web_bits.wasm" "$native/tests/properties/bits/determinism_hash"
fi
cd "$build/project"
npm install --no-save --no-audit --no-fund --no-package-lock --prefer-offline --loglevel=error "$build/simdbezier.tgz" >/dev/null
cp "$source"/tests/web/*.mjs .
node --test --test-reporter=spec package.test.mjs page.test.mjs
