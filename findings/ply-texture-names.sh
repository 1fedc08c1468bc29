#!/usr/bin/env bash
# Readers of PLY on the web differ in the names that they take for texture coordinates: loaders.gl
# knows s t only.
. "$(dirname "$0")/install.sh"
npm_packages three@0.187.0 @loaders.gl/core@4.4.5 @loaders.gl/ply@4.4.5 @kitware/vtk.js@37.4.3
cat <<'TEXT'
input: one triangle as PLY whose vertices have two more properties, under the names that writers use
expected: all of these are read as texture coordinates
TEXT
cat >program.mjs <<'JS'
import {parseSync} from '@loaders.gl/core';
import {PLYLoader} from '@loaders.gl/ply';
import {PLYLoader as ThreeLoader} from 'three/examples/jsm/loaders/PLYLoader.js';
import vtkPLYReader from '@kitware/vtk.js/IO/Geometry/PLYReader.js';

const ply = (names) => `ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
${names.map((name) => `property float ${name}\n`).join('')}element face 1
property list uchar int vertex_indices
end_header
${['0 0 0', '1 0 0', '0 1 0'].map((point) => point + ' .25'.repeat(names.length) + '\n').join('')}3 0 1 2
`;
const readers = {
  'three.js': (text) => new ThreeLoader().parse(text).hasAttribute('uv'),
  'loaders.gl': (text) => 'TEXCOORD_0' in parseSync(new TextEncoder().encode(text).buffer, PLYLoader).attributes,
  'vtk.js': (text) => {
    const reader = vtkPLYReader.newInstance();
    reader.parseAsText(text);
    return reader.getOutputData().getPointData().getTCoords() != null;
  },
};
for (const names of ['u v', 's t', 'texture_u texture_v', 'u v s t']) {
  const by = Object.keys(readers).filter((reader) => readers[reader](ply(names.split(' '))));
  console.log(by.join(', ') || 'none');
}
JS
mapfile -t said < <(node program.mjs)
expect 'u v is read by' "${said[0]:-}" 'three.js, vtk.js'
expect 's t is read by' "${said[1]:-}" 'three.js, loaders.gl, vtk.js'
expect 'texture_u texture_v is read by' "${said[2]:-}" 'three.js, vtk.js'
expect 'u v and s t are read by' "${said[3]:-}" 'three.js, loaders.gl, vtk.js'
