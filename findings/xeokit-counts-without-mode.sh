#!/usr/bin/env bash
# xeokit-convert counts no triangles of a glTF primitive that leaves out its mode, which is then 4:
# triangles. The geometry is there all the same.
. "$(dirname "$0")/install.sh"
npm_packages @xeokit/xeokit-convert@1.3.2
cat <<'TEXT'
input: one triangle as glTF, once with "mode": 4 and once without
expected: the same numbers of both
TEXT
cat >make.mjs <<'JS'
import {writeFileSync} from 'node:fs';
const numbers = Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer);
const data = Buffer.concat([numbers, Buffer.from(new Uint32Array([0, 1, 2]).buffer)]);
for (const mode of [undefined, 4])
  writeFileSync(`mode${mode ?? 'less'}.gltf`, JSON.stringify({
    asset: {version: '2.0'}, scene: 0, scenes: [{nodes: [0]}], nodes: [{mesh: 0}],
    meshes: [{primitives: [{attributes: {POSITION: 0}, indices: 1, mode}]}],
    accessors: [
      {bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0]},
      {bufferView: 1, componentType: 5125, count: 3, type: 'SCALAR'}],
    bufferViews: [{buffer: 0, byteLength: 36}, {buffer: 0, byteOffset: 36, byteLength: 12}],
    buffers: [{byteLength: 48, uri: 'data:application/octet-stream;base64,' + data.toString('base64')}]}));
JS
node make.mjs
counts() {
  npx xeokit-convert -s "$1.gltf" -o "$1.xkt" -l 2>&1 | sed -n 's/.*Converted \(geometries\|triangles\|vertices\): //p' |
    tr '\n' ' '
}
expect 'geometries, triangles and vertices with "mode": 4' "$(counts mode4)" '1 1 3 '
expect 'without' "$(counts modeless)" '1 0 3 '
