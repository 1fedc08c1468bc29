#!/usr/bin/env bash
# Simplifiers of glTF keep what asset.extras says about the mesh that they were given.
. "$(dirname "$0")/install.sh"
npm_packages gltfpack@1.3.0 @gltf-transform/core@4.5.1 @gltf-transform/functions@4.5.1 meshoptimizer@1.3.0
cat <<'TEXT'
input: a wavy sheet of 32 x 32 squares, whose asset.extras and mesh's extras both state {"deviation": 1e-6}
expected: a file of fewer triangles does not state the error of another mesh
TEXT
cat >program.mjs <<'JS'
import {execFileSync} from 'node:child_process';
import {Document, NodeIO} from '@gltf-transform/core';
import {simplify, weld} from '@gltf-transform/functions';
import {MeshoptSimplifier} from 'meshoptimizer';

const n = 33, positions = [], indices = [];
for (let j = 0; j < n; ++j)
  for (let i = 0; i < n; ++i) {
    positions.push(i / 32, j / 32, 0.1 * Math.sin(i / 5) * Math.cos(j / 7));
    if (i + 1 < n && j + 1 < n) {
      const k = j * n + i;
      indices.push(k, k + 1, k + n + 1, k, k + n + 1, k + n);
    }
  }
const io = new NodeIO(), made = new Document(), buffer = made.createBuffer();
const accessor = (type, array) => made.createAccessor().setType(type).setArray(array).setBuffer(buffer);
const primitive = made.createPrimitive().setAttribute('POSITION', accessor('VEC3', new Float32Array(positions)))
  .setIndices(accessor('SCALAR', new Uint32Array(indices)));
const mesh = made.createMesh().addPrimitive(primitive).setExtras({deviation: 1e-6});
made.createScene().addChild(made.createNode().setMesh(mesh));
made.getRoot().getAsset().extras = {deviation: 1e-6};
await io.write('in.glb', made);

const say = async (file) => {
  const root = (await io.read(file)).getRoot(), [only] = root.listMeshes();
  const fewer = only.listPrimitives()[0].getIndices().getCount() < indices.length;
  return `${fewer ? 'fewer' : 'all'} triangles, asset ${JSON.stringify(root.getAsset().extras)}, ` +
    `mesh ${JSON.stringify(only.getExtras())}`;
};
execFileSync('npx', ['gltfpack', '-i', 'in.glb', '-o', 'pack.glb', '-si', '0.1', '-ke', '-noq'], {stdio: 'ignore'});
const document = await io.read('in.glb');
await document.transform(weld(), simplify({simplifier: MeshoptSimplifier, ratio: 0.1, error: 0.01}));
await io.write('transform.glb', document);
console.log(await say('pack.glb'));
console.log(await say('transform.glb'));
JS
mapfile -t said < <(node program.mjs)
expect "gltfpack -si 0.1 -ke" "${said[0]:-}" 'fewer triangles, asset {"deviation":0.000001}, mesh {}'
expect "gltf-transform's simplify" "${said[1]:-}" 'fewer triangles, asset {"deviation":0.000001}, mesh {"deviation":0.000001}'
