// node check_glb.mjs NODE_MODULES FILE.glb|FILE.ply…
// One line of JSON a file: what Khronos' validator says of GLB, and what three.js's loader has loaded.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [modules, ...files] = process.argv.slice(2);
const validator = createRequire(join(modules, "x"))(join(modules, "gltf-validator"));
const loaderPath = join(modules, "three/examples/jsm/loaders/GLTFLoader.js");
const { GLTFLoader } = await import(pathToFileURL(loaderPath));
const { PLYLoader } = await import(pathToFileURL(loaderPath.replace(/GLTF(?=Loader)/, "PLY")));

// Positions as a viewer places them.
function corners(mesh) {
  mesh.updateMatrixWorld(true);
  const position = mesh.geometry.getAttribute("position");
  const point = mesh.position.clone();
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < position.count; k++) {
    point.fromBufferAttribute(position, k).applyMatrix4(mesh.matrixWorld);
    point.toArray().forEach((value, c) => {
      low[c] = Math.min(low[c], value);
      high[c] = Math.max(high[c], value);
    });
  }
  return { low, high };
}

function describe(gltf) {
  const result = { meshes: 0, deviation: gltf.asset.extras?.deviation ?? null };
  gltf.scene?.traverse((object) => {
    if (object.isMesh) {
      result.meshes += 1;
      result.vertices = object.geometry.getAttribute("position").count;
      result.triangles = object.geometry.index.count / 3;
      result.extras = object.userData;
      result.attributes = Object.keys(object.geometry.attributes).sort();
      Object.assign(result, corners(object));
    }
  });
  return result;
}

// The kind of numbers of each attribute.
function numberTypes(geometry) {
  const types = Object.entries(geometry.attributes).map(([k, v]) => [k, v.array.constructor.name]);
  return Object.fromEntries(types);
}

for (const file of files) {
  const bytes = readFileSync(file);
  const { buffer, byteOffset, byteLength } = bytes;
  const data = buffer.slice(byteOffset, byteOffset + byteLength);
  if (file.endsWith(".ply")) {
    console.log(JSON.stringify(numberTypes(new PLYLoader().parse(data))));
    continue;
  }
  const report = await validator.validateBytes(new Uint8Array(bytes), { maxIssues: 10 });
  const gltf = await new GLTFLoader().parseAsync(data, "");
  console.log(JSON.stringify({ issues: report.issues, three: describe(gltf) }));
}
