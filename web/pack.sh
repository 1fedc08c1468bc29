#!/usr/bin/env bash
# web/pack.sh BUILD: makes the npm package of the module in BUILD, as BUILD/simdbezier.tgz and unpacked in
# BUILD/package, and the page of examples/web with all that it loads, in BUILD/site.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$1
package=$build/package site=$build/site
rm -rf "$package" "$site" "$build"/simdbezier*.tgz
chmod -x "$build"/web/*.wasm
mkdir -p "$package" "$site/simdbezier" "$site/three"
cp web/package/* LICENSE "$build"/web/simdbezier*.wasm "$package"
version=$(sed -n 's/.*VERSION_\(MAJOR\|MINOR\|PATCH\) \([0-9]*\)/\2/p' include/simdbezier/version.hpp | paste -sd.)
if ! grep -q "\"version\": \"$version\"" "$package/package.json"; then
  echo "web/package/package.json: expected version $version, as in include/simdbezier/version.hpp" >&2
  exit 1
fi
(cd "$package" && npm pack --silent --pack-destination .. >/dev/null)
mv "$build/simdbezier-$version.tgz" "$build/simdbezier.tgz"
cp examples/web/*.{html,css,js} "$site"
cp "$package"/{browser.js,library.js,simdbezier.wasm} "$site/simdbezier"
three=$build/project/node_modules/three
if [[ -d $three ]]; then
  cp "$three"/build/three.{module,core}.js "$three/examples/jsm/controls/OrbitControls.js" "$site/three"
fi
