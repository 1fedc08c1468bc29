// Speed in Node: the package, what others evaluate one sample at a time, and a loop by hand. It is copied into a
// project where all of them are installed (`./run web --bench`). Rounds interleave all rows; medians are printed, in
// millions of samples a second, or milliseconds a mesh, of CPU time.
import { existsSync, readFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { createRequire } from 'node:module';
import { gunzipSync } from 'node:zlib';
import { load } from 'simdbezier';
import { Vector4 } from 'three';
import { NURBSSurface } from 'three/addons/curves/NURBSSurface.js';
import { Horner } from './horner.mjs';

const require = createRequire(import.meta.url);
const data = process.env.SIMDBEZIER_SHARED_DATA ?? '../shared/data';
const bezier = await load();
const KNOTS = [0, 0, 0, 0, 1, 1, 1, 1];

function bezFile(name) {
  let bytes = readFileSync(`${data}/${name}`);
  if (name.endsWith('.gz')) bytes = gunzipSync(bytes);
  return Float64Array.from(bytes.toString('latin1').trim().split(/\s+/).slice(1), Number);
}

function cpuOf(work) {
  const begin = process.cpuUsage();
  work();
  const { user, system } = process.cpuUsage(begin);
  return (user + system) / 1e3; // ms
}

// Rows: name, unit, how much of it a run is, and run().
const rows = [];
const point = (points, p, i, j) => Array.from(points.subarray(48 * p + 12 * j + 3 * i, 48 * p + 12 * j + 3 * i + 3));
const grid4 = (make) => [0, 1, 2, 3].map((i) => [0, 1, 2, 3].map((j) => make(i, j)));
function sampleAll(surfaces, n, at) {
  for (const surface of surfaces) {
    for (let iv = 0; iv < n; iv++) for (let iu = 0; iu < n; iu++) at(surface, iu / (n - 1), iv / (n - 1));
  }
}

function addModel(name, points) {
  const set = bezier.patches(points), hand = new Horner(points), count = set.size, n = 16;
  const out = new Float32Array(3 * count * n * n);
  const samples = count * n * n / 1e3; // by milliseconds: millions a second
  const row = (what, size, run) => rows.push({ name: `web/${name}/${what}`, unit: 'M/s', size, run, times: [] });
  row('position/triples/simdbezier', samples, () => set.grid(n));
  row('position/planes/simdbezier', samples, () => set.grid(n, n, { layout: 'planes' }));
  row('position_normal/simdbezier', samples, () => set.grid(n, n, { outputs: ['position', 'normal'], layout: 'interleaved' }));
  row('position/triples/horner', samples, () => hand.positions(n, n, out, false));
  row('position/planes/horner', samples, () => hand.positions(n, n, out, true));
  const few = Math.min(count, 64), fewSamples = few * n * n / 1e3;
  const patches = [...Array(few).keys()];
  const target = new Vector4();
  const threes = patches.map((p) => new NURBSSurface(3, 3, KNOTS, KNOTS, grid4((i, j) => new Vector4(...point(points, p, i, j), 1))));
  row('position/three.js', fewSamples, () => sampleAll(threes, n, (surface, u, v) => surface.getPoint(u, v, target)));
  const verb = optional('verb-nurbs-web');
  if (verb) {
    const verbs = patches.map((p) => verb.geom.NurbsSurface.byKnotsControlPointsWeights(3, 3, KNOTS, KNOTS, grid4((i, j) => point(points, p, i, j))));
    row('position/verb', fewSamples, () => sampleAll(verbs, n, (surface, u, v) => surface.point(u, v)));
  }
  if (rhino) {
    const rhinos = patches.map((p) => {
      const surface = rhino.NurbsSurface.create(3, false, 4, 4, 4, 4);
      for (const knots of [surface.knotsU(), surface.knotsV()]) [0, 0, 0, 1, 1, 1].forEach((knot, k) => knots.set(k, knot));
      for (let i = 0; i < 4; i++) for (let j = 0; j < 4; j++) surface.points().set(i, j, [...point(points, p, i, j), 1]);
      return surface;
    });
    row('position/rhino3dm', fewSamples, () => sampleAll(rhinos, n, (surface, u, v) => surface.pointAt(u, v)));
  }
  for (const relative of [1e-2, 1e-3, 1e-4]) {
    rows.push({ name: `web/${name}/mesh/${relative.toExponential(0)}/simdbezier`, unit: 'ms', run: () => set.tessellate({ relative }), times: [] });
  }
}

function optional(name) {
  try {
    return require(name);
  } catch {
    return undefined;
  }
}
const rhino = await optional('rhino3dm')?.();

for (const name of ['gumbo.bez', 'bigguy.bez.gz']) {
  if (existsSync(`${data}/${name}`)) addModel(name.split('.')[0], bezFile(name));
}
if (rows.length === 0) throw new Error(`${data}: expected gumbo.bez and bigguy.bez.gz, found neither`);
for (let round = 0; round < 13; round++) {
  for (const row of rows) {
    const time = cpuOf(row.run);
    if (time < 2) { // many runs, since the clock counts microseconds
      const runs = Math.ceil(4 / Math.max(time, 0.05));
      row.times.push(cpuOf(() => { for (let k = 0; k < runs; k++) row.run(); }) / runs);
    } else {
      row.times.push(time);
    }
  }
}
console.log(`${cpus()[0].model}, Node ${process.versions.node}`);
for (const { name, unit, size, times } of rows) {
  const sorted = times.slice(2).sort((a, b) => a - b); // the first ones compile
  const low = sorted[0], median = sorted[sorted.length >> 1];
  const value = (time) => (unit === 'ms' ? time : size / time).toPrecision(3);
  console.log(`${name.padEnd(52)} ${value(median).padStart(8)} ${unit}, best ${value(low)}`);
}
