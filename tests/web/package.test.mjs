// The package as somebody has it who installed it: this file runs in a project of its own (tests/web/run.sh), where
// `simdbezier` is what npm pack made. Native programs and data are named by the environment.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { Worker } from 'node:worker_threads';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import { instantiate, load } from 'simdbezier';
import { load as loadCore } from 'simdbezier/core';
import { load as loadDoubles } from 'simdbezier/f64';

const { SIMDBEZIER_PROGRAM: program, SIMDBEZIER_SOURCE: source, SIMDBEZIER_SHARED_DATA: data } = process.env;
const md5 = (bytes) => createHash('md5').update(bytes).digest('hex');
const bezier = await load();
const modules = { f32: bezier, f64: await loadDoubles() };
const teapot = (options) => modules[options?.precision ?? 'f32'].read('builtin:teapot', undefined, options);
const flat = [...Array(16).keys()].flatMap((k) => [k % 4, Math.floor(k / 4), 0]); // (3u, 3v, 0)
const bez = (patches) => [patches.length, ...patches.map((points) => points.join(' '))].join('\n');
const folderOfPackage = dirname(createRequire(import.meta.url).resolve('simdbezier/simdbezier.wasm'));

const MODULES = [['simdbezier.wasm', 400], ['simdbezier-f64.wasm', 450], ['simdbezier-core.wasm', 250]];
for (const [name, most] of MODULES) test(`${name} is small`, () => {
  const wasm = readFileSync(createRequire(import.meta.url).resolve(`simdbezier/${name}`));
  const bytes = brotliCompressSync(wasm, { params: { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: wasm.length } }).length;
  console.log(`${wasm.length} bytes, ${bytes} by brotli`);
  assert.ok(bytes < most * 1000, `expected less than ${most} KB by brotli, found ${bytes} bytes`);
});

test('a set has the right values', () => {
  for (const precision of ['f32', 'f64']) {
    using_(modules[precision].patches(flat, { precision }), (set) => {
      assert.equal(set.size, 1);
      assert.equal(set.precision, precision);
      assert.deepEqual(set.box, { low: [0, 0, 0], high: [3, 3, 0] });
      const grid = set.grid(3, 2, { outputs: ['position', 'du', 'normal', 'status'] });
      assert.equal(grid.count, 6);
      assert.deepEqual([...grid.position], [0, 0, 0, 1.5, 0, 0, 3, 0, 0, 0, 3, 0, 1.5, 3, 0, 3, 3, 0]);
      assert.deepEqual([...grid.du.slice(0, 3)], [3, 0, 0]);
      assert.deepEqual([...grid.normal.slice(3, 6)], [0, 0, 1]);
      assert.deepEqual([...grid.status], [0, 0, 0, 0, 0, 0]);
      const planes = set.grid(3, 2, { layout: 'planes' });
      assert.deepEqual([...planes.position], [0, 1.5, 3, 0, 1.5, 3, 0, 0, 0, 3, 3, 3, 0, 0, 0, 0, 0, 0]);
      const records = set.grid(2, 2, { layout: 'interleaved', outputs: ['normal', 'position', 'curvature'] });
      assert.deepEqual([...records.records.slice(0, 12)], [0, 0, 0, 0, 0, 1, 3, 0, 0, 0, 0, 1]);
      assert.deepEqual([...records.maximum].map(Math.abs), [0, 0, 0, 0]);
      const samples = set.samples([0, 0], [0.25, 1], [0.5, 0.5]);
      assert.deepEqual([...samples.position], [0.75, 1.5, 0, 3, 1.5, 0]);
      assert.deepEqual([...modules[precision].patches(flat, { precision }).samples([], [], []).position], []);
      const mesh = set.tessellate({ grid: [2, 3], parameters: true, normals: false });
      assert.equal(mesh.stride, 5);
      assert.deepEqual([mesh.vertexCount, mesh.triangleCount], [6, 4]);
    });
  }
});

test('samples are those of the grid', () => using_(teapot(), (set) => {
  const grid = set.grid(5, 5, { outputs: ['position', 'normal'], copy: true });
  const numbers = [...Array(32 * 25).keys()];
  const samples = set.samples(numbers.map((k) => Math.floor(k / 25)), numbers.map((k) => (k % 5) / 4),
    numbers.map((k) => Math.floor(k / 5) % 5 / 4), { outputs: ['position', 'normal'] });
  assert.deepEqual(samples.position, grid.position);
  assert.deepEqual(samples.normal, grid.normal);
}));

test('outputs are the same together and alone, in every layout', () => {
  const vectors = ['position', 'du', 'dv', 'duu', 'duv', 'dvv', 'normal'];
  const curvatures = ['gaussian', 'mean', 'minimum', 'maximum'];
  for (const precision of ['f32', 'f64']) {
    using_(teapot({ precision }), (set) => {
      const alone = (output) => set.grid(3, 4, { outputs: [output, 'status'], copy: true });
      const all = (layout) => set.grid(3, 4, { outputs: ['status', ...vectors, 'curvature'], layout, copy: true });
      const [together, planes, records] = [all('triples'), all('planes'), all('interleaved')];
      for (const results of [together, planes, records]) {
        for (const name of [...curvatures, 'status']) assert.deepEqual(results[name], alone('curvature')[name], name);
      }
      vectors.forEach((name, output) => {
        const expected = alone(name)[name];
        assert.deepEqual(together[name], expected);
        assert.deepEqual(planes[name], expected.map((_, k) => expected[k % 384 * 3 + Math.floor(k / 384)]), name);
        assert.deepEqual(expected.map((_, k) => records.records[Math.floor(k / 3) * 21 + 3 * output + k % 3]), expected, name);
      });
    });
  }
});

test('meshes are within the tolerance and without gaps', () => using_(teapot(), (set) => {
  const fine = set.tessellate({ relative: 1e-3, copy: true });
  assert.ok(fine.deviation > 0 && fine.deviation <= 1e-3 * set.diagonal);
  assert.equal(Math.max(...fine.deviations), fine.deviation);
  assert.equal(fine.firstTriangles.at(-1), fine.triangleCount);
  assert.equal(fine.indices.length, 3 * fine.triangleCount);
  assert.ok(fine.indices.every((k) => k < fine.vertexCount));
  const coarse = set.tessellate({ tolerance: 0.01 * set.diagonal, copy: true });
  assert.ok(coarse.triangleCount < fine.triangleCount);
  const apart = set.tessellate({ relative: 1e-3, weld: false, copy: true });
  assert.equal(apart.triangleCount, fine.triangleCount);
  assert.ok(apart.vertexCount > fine.vertexCount);
}));

test('edges are those of the last mesh', () => {
  const beside = flat.map((value, k) => k % 3 === 0 ? value + 3.001 : value);
  using_(bezier.patches([...flat, ...beside]), (set) => {
    for (const [snap, edges, openEdges] of [[0, 8, 8], [0.01, 7, 6], [0, 8, 8]]) {
      set.tessellate({ grid: 2, snap });
      assert.deepEqual([set.edges, set.openEdges], [edges, openEdges], `${snap}`);
    }
  });
});

test('creases keep two normals', () => {
  const wedge = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, /* and */ 1, 0, 0, 1, 0, 1, 1, 1, 0, 1, 1, 1];
  using_(bezier.patches(wedge, { degreeU: 1, degreeV: 1 }), (set) => {
    for (const [options, vertices] of [[{}, 6], [{ crease: 30 }, 8], [{ crease: 120 }, 6], [{ weld: false }, 8]]) {
      assert.equal(set.tessellate({ grid: 2, ...options }).vertexCount, vertices, JSON.stringify(options));
    }
  });
});


// A band of bilinear patches, turned once.
const MOEBIUS = Array.from({ length: 8 }, (_, i) => {
  const end = (k, sign) => {
    const around = 2 * Math.PI * (k % 8) / 8, way = k < 8 ? sign : -sign;
    const radius = 2 + way * 0.5 * Math.cos(around / 2);
    return [radius * Math.cos(around), radius * Math.sin(around), way * 0.5 * Math.sin(around / 2)].map(Math.fround);
  };
  return [...end(i, -1), ...end(i + 1, -1), ...end(i, 1), ...end(i + 1, 1)];
}).flat();

// Each set of options in both languages.
const OPTIONS = [
  [{ relative: 1e-2 }, ['--relative', '1e-2']],
  [{ relative: 1e-3 }, ['--relative', '1e-3']],
  [{ relative: 1e-4 }, ['--relative', '1e-4']],
];
const MORE_OPTIONS = [
  [{ tolerance: 0.01, relative: 2e-3 }, ['--tolerance', '0.01', '--relative', '2e-3']],
  [{ grid: [7, 5] }, ['--grid', '7x5']],
  [{ relative: 1e-3, thorough: true }, ['--relative', '1e-3', '--thorough']],
  [{ relative: 1e-3, crease: 30, parameters: true }, ['--relative', '1e-3', '--crease', '30', '--parameters']],
  [{ relative: 1e-3, normals: false, orient: true, flip: true, snap: 1e-3 },
    ['--relative', '1e-3', '--no-normals', '--orient', '--flip', '--snap', '1e-3']],
];
const QUANTISED = [8, 16].map((bits) => [{ relative: 1e-3, bits }, ['--relative', '1e-3', '--quantise', String(bits)]]);
const readable = ['bpt', 'bv', 'iges', 'itd', 'obj', 'rib'].map((format) => join(source ?? '', 'tests/data', `sample.${format}`));
const models = ['teapot.bpt', 'teapot28.bez', 'teacup.bez', 'teaspoon.bez', 'gumbo.bez', 'wavy_cube.bez', 'bigguy.bez.gz', 'pawn2.bez.gz', 'car4.bez.gz'].map((name) => join(data ?? '', name));
const cases = [['builtin:teapot', [...OPTIONS, ...MORE_OPTIONS], ['f32', 'f64']],
  ...readable.map((path) => [path, OPTIONS.slice(1, 2), ['f32', 'f64']]),
  ...models.map((path) => [path, OPTIONS, ['f32']])];
for (const [path, options, precisions] of cases) {
  const builtin = path.startsWith('builtin:');
  const absent = !program ? 'no program to compare with' : builtin || existsSync(path) ? false : `${path} is not there`;
  test(`files of ${builtin ? path : path.replace(/.*\//, '')} are the program's`, { skip: absent }, async () => {
    const folder = mkdtempSync(join(tmpdir(), 'simdbezier-web-'));
    for (const precision of precisions) {
      const set = builtin ? teapot({ precision }) : await modules[precision].open(path, readFileSync(path), { precision });
      for (const format of ['glb', 'ply']) {
        for (const [wish, words] of format === 'glb' ? [...options, ...QUANTISED] : options) {
          const out = join(folder, `mesh.${format}`);
          execFileSync(program, ['tessellate', path, ...words, '--precision', precision, '-o', out],
            { env: { ...process.env, SIMDBEZIER_ISA: 'sse2' } });
          assert.equal(md5(set.file(format, wish)), md5(readFileSync(out)), `${format} ${precision} ${words.join(' ')}`);
        }
      }
      set.free();
    }
    rmSync(folder, { recursive: true });
  });
}

// A patch that is there already has no vertices of its own, so that blocks of them can be empty.
const curvedAt = (x) => flat.map((value, k) => k % 3 === 0 ? value + x : k % 3 === 2 && [5, 6, 9, 10].includes((k - 2) / 3) ? 100 : value);
const REPEATED = [
  ['four patches', [flat, curvedAt(6), flat, curvedAt(12)], { tolerance: 0.0017 }, ['--tolerance', '0.0017']],
  ['4098 equal patches', Array(4098).fill(flat), { grid: 2 }, ['--grid', '2']],
];
for (const [name, patches, wish, words] of REPEATED) {
  test(`files of ${name}, some of which repeat others, are the program's`, () => {
    const folder = mkdtempSync(join(tmpdir(), 'simdbezier-web-'));
    const [model, out] = ['model.bez', 'mesh.glb'].map((file) => join(folder, file));
    writeFileSync(model, bez(patches));
    const file = using_(bezier.patches(patches.flat()), (set) => set.file('glb', wish));
    if (program) {
      execFileSync(program, ['tessellate', model, ...words, '-o', out], { env: { ...process.env, SIMDBEZIER_ISA: 'sse2' } });
      assert.equal(md5(file), md5(readFileSync(out)));
    }
    assert.equal(using_(teapot(), (set) => set.size), 32); // the instance goes on
    rmSync(folder, { recursive: true });
  });
}

// std::hypot() of three numbers has other bits in the C++ library of the program than in that of the module.
test('diagonals are those of the program', { skip: program ? false : 'no program to compare with' }, () => {
  const folder = mkdtempSync(join(tmpdir(), 'simdbezier-web-'));
  for (const size of [[4, 7, 5], [3, 30, 5], [9, 27, 28], [1e200, 2e200, 3e200], [1e-200, 7e-200, 3e-200]]) {
    const patch = [...Array(45).fill(0), ...size];
    writeFileSync(join(folder, 'model.bez'), bez([patch]));
    const stats = execFileSync(program, ['tessellate', join(folder, 'model.bez'), '--precision', 'f64', '--grid', '2', '--stats=json', '-o', join(folder, 'mesh.ply')]);
    using_(modules.f64.patches(patch, { precision: 'f64' }), (set) => assert.equal(set.diagonal, JSON.parse(stats).diagonal, size.join(' ')));
  }
  rmSync(folder, { recursive: true });
});

test('diagonals are roots of sums of squares', () => {
  let seed = 1;
  const random = () => (seed = seed * 48271 % 2147483647) / 2147483647;
  for (const scale of [1, 2 ** 100, 2 ** -100]) {
    for (let k = 0; k < 300; k++) {
      using_(bezier.patches(Array.from({ length: 48 }, () => scale * 10 * random())), (set) => {
        const { low, high } = set.box;
        const [x, y, z] = high.map((value, c) => (value - low[c]) / scale);
        assert.equal(set.diagonal, scale * Math.sqrt(x * x + y * y + z * z));
      });
    }
  }
});

test('the core has the meshes, and no files', async () => {
  const core = (await loadCore()).read('builtin:teapot');
  using_(teapot(), (set) => assert.deepEqual(core.tessellate({ relative: 1e-3 }).vertices, set.tessellate({ relative: 1e-3 }).vertices));
  assert.throws(() => core.file('glb', { relative: 1e-3 }), /expected no files/);
  assert.throws(() => modules.f32.read('a.bez', new Uint8Array()) && 0, /a\.bez:1/);
});

test('the mesh in memory is that of the file', () => using_(teapot(), (set) => {
  const mesh = set.tessellate({ relative: 1e-3, copy: true });
  const glb = set.file('glb', { relative: 1e-3 });
  const body = 20 + new DataView(glb.buffer).getUint32(12, true) + 8;
  assert.deepEqual(new Float32Array(glb.slice(body, body + mesh.vertices.byteLength).buffer), mesh.vertices);
}));

test('bytes come in any buffer', async () => {
  const text = ['1', ...Array.from({ length: 16 }, (_, k) => flat.slice(3 * k, 3 * k + 3).join(' '))].join('\n').padEnd(120);
  const bytes = new Uint8Array(new SharedArrayBuffer(128)).fill(46);
  bytes.set(new TextEncoder().encode(text), 8);
  const own = bytes.slice(8);
  const sources = {
    bytes: own, buffer: own.buffer, view: new DataView(bytes.buffer, 8), doubles: new Float64Array(own.buffer),
    integers: new BigInt64Array(bytes.buffer, 8), shared: bytes.subarray(8),
  };
  for (const [name, source] of Object.entries(sources)) {
    using_(bezier.read('m.bez', source), (set) => assert.equal(set.box.high[0], 3, name));
    using_(await bezier.open('m.bez', source), (set) => assert.equal(set.box.high[0], 3, name));
  }
  for (const source of [new Blob([own]), new Blob([own]).stream(), Promise.resolve(new Response(own))]) {
    (await bezier.open('m.bez', source)).free();
  }
  for (const [name, source, message] of [
    ['m.bez', new Response('<html>', { status: 404 }), /m\.bez: expected an answer, found status 404/],
    ['m.bez', new Response(null), /m\.bez:1: expected .* end of the file/],
    ['m.bez.gz', new Response(null), /m\.bez\.gz:1: expected .* end of the file/],
    ['m.bez.gz', gzipSync(own).subarray(0, -12), /^Error: m\.bez\.gz: expected data that can be read and unpacked, found ./],
    ['m.bez', new ReadableStream({ pull: (to) => to.error(new Error('no more')) }), /m\.bez: expected data .*, found no more/],
    ['m.bez', text, /m\.bez: expected bytes in a buffer, found .object String/],
    ['m.bez', 42, /expected bytes in a buffer/],
    ['m.bez', null, /expected bytes in a buffer/],
  ]) {
    await assert.rejects(bezier.open(name, source), message);
  }
});

test('data are unpacked where they are packed, whatever their name says', async (context) => {
  const plain = new TextEncoder().encode(bez([flat]));
  const encoded = await serve(context, { 'content-encoding': 'gzip' }, gzipSync(plain)); // as servers do that know .gz
  for (const source of [plain, gzipSync(plain), new Blob([gzipSync(plain)]), new Response(gzipSync(plain)),
    fetch(encoded)]) {
    for (const name of ['m.bez.gz', 'm.bez', 'm.BEZ.GZ'].slice(0, source instanceof Blob || ArrayBuffer.isView(source) ? 3 : 1)) {
      using_(await bezier.open(name, source), (set) => assert.equal(set.size, 1, name));
    }
  }
});

test('a module comes from a path or from the text of a URL', async (context) => {
  const path = join(folderOfPackage, 'simdbezier-core.wasm');
  const url = import.meta.resolve('simdbezier/simdbezier-core.wasm');
  const served = await serve(context, { 'content-type': 'application/wasm' }, readFileSync(path));
  for (const start of [load, loadCore, loadDoubles]) {
    for (const place of [path, url, new URL(url), served, new URL(served)]) {
      assert.equal((await start(place)).read('builtin:teapot').size, 32);
    }
  }
});

test('a module comes with any type', async () => {
  const wasm = readFileSync(join(folderOfPackage, 'simdbezier-core.wasm'));
  for (const type of ['application/wasm', 'Application/WASM', 'application/wasm; charset=utf-8', 'application/wasm;', 'application/wasmx', 'text/plain', '']) {
    assert.equal((await instantiate(new Response(wasm, { headers: { 'content-type': type } }))).read('builtin:teapot').size, 32, type);
  }
});

test('errors are those of the program', () => {
  const bytes = (text) => new TextEncoder().encode(text);
  const oneSided = () => bezier.patches(MOEBIUS, { degreeU: 1, degreeV: 1 });
  const ONE_SIDED = '--orient: expected patches that can be turned to agree with their neighbours, found a surface of one side in patches';
  const far = () => bezier.patches(flat.map((value) => value + 1e6));
  const point = () => bezier.patches(flat.map((value) => 1e6 + 1e-3 * value));
  for (const [act, message] of [
    [() => bezier.read('model.bez', bytes('1\n0 0 z')), "model.bez:2: expected a finite number, found 'z'"],
    [() => bezier.read('model.xyz', bytes('1')), /^model\.xyz: expected a name that ends in \.bez/],
    [() => bezier.read('m.rib', bytes('Patch "bicubic" "P" [0 0')), /^m\.rib:1: expected /],
    [() => bezier.read('m.bez', new Uint8Array([0x1f, 0x8b, 8, 0])), /^m\.bez:1: expected bytes that are unpacked/],
    [() => bezier.read('m.bez', '1'), /^simdbezier: m\.bez: expected bytes in a buffer, found .object String/],
    [() => bezier.read('m.bez', [49]), /expected bytes in a buffer/],
    [() => bezier.read('builtin:kettle'), /^builtin:kettle: expected a name/],
    [() => bezier.read('builtin:teapot', undefined, { precision: 'f64' }), /simdbezier\/f64/],
    [() => bezier.patches([1, 2, 3]), /expected a multiple of 48 values, found 3/],
    [() => bezier.patches(flat.map(() => NaN)), /./],
    [() => bezier.patches({ length: 48 * 2 ** 25 }), /not enough memory/],
    [() => bezier.patches(flat, { degreeU: 16 }), /degreeU: expected an integer, 1 or more and at most 15, found 16/],
    [() => bezier.patches(flat, { degree: 3 }), /among degreeU, .*found degree/],
    [() => teapot().tessellate({}), /expected either a grid or some of tolerance/],
    [() => teapot().tessellate({ relative: -1 }), /relative: expected a finite number/],
    [() => teapot().tessellate({ tolerance: Infinity }), /tolerance: expected a finite number, .*found Infinity/],
    [() => teapot().tessellate({ grid: 4098 }), 'simdbezier: grid: expected an integer, 2 or more and at most 4097, found 4098'],
    [() => teapot().tessellate({ grid: [2, 4098], weld: false }), /grid: .*at most 4097, found 4098/],
    [() => teapot().file('glb', { grid: 70000 }), /grid: .*at most 4097, found 70000/],
    [() => oneSided().tessellate({ grid: 2, orient: true }), ONE_SIDED],
    [() => oneSided().file('glb', { grid: 2, orient: true }), ONE_SIDED],
    [() => far().tessellate({ tolerance: 0.01 }), /^--tolerance: expected a distance above the error of rounding, [\d.]+, found 0\.01 /],
    [() => far().file('glb', { tolerance: 0.01 }), /^--tolerance: expected a distance above the error of rounding, [\d.]+, found 0\.01 /],
    [() => point().file('glb', { grid: 2 }), /expected a model that numbers of --precision do not make one point, found one of size [\d.e-]+$/],
    [() => teapot().tessellate({ grid: [2] }), /grid: expected an integer, .*found undefined/],
    [() => teapot().tessellate({ grid: null }), /grid: expected an integer, .*found null/],
    [() => teapot().tessellate({ relative: 1e-12 }), /--relative: expected /],
    [() => teapot().tessellate({ tolerence: 1 }), /among grid, weld, tolerance, .*found tolerence/],
    [() => teapot().tessellate({ nu: 3, nv: 3 }), /found nu/],
    [() => teapot().tessellate({ relative: 1e-2, bits: 8 }), /among grid, .*found bits/],
    [() => teapot().file('ply', { relative: 1e-2, bits: 8 }), /^mesh\.ply: expected floating-point vertices/],
    [() => teapot().file('glb', { relative: 1e-2, bits: 7 }), /bits: expected one of 8, 16, found 7/],
    [() => teapot().tessellate({ grid: 4, thorough: true }), /thorough: expected with tolerance or relative, found without/],
    [() => teapot().tessellate({ angle: 9, thorough: true }), /thorough: expected with tolerance or relative/],
    [() => teapot().tessellate({ angle: 181 }), /angle: expected a finite number, .*at most 180/],
    [() => teapot().tessellate({ grid: 4, crease: 181 }), /crease: expected a finite number, .*at most 180/],
    [() => teapot().tessellate({ grid: 4, crease: 30, weld: false }), /crease: expected neither with weld: false/],
    [() => teapot().tessellate({ grid: 4, crease: 30, normals: false }), /crease: .*nor with normals: false/],
    [() => teapot().tessellate(null), 'simdbezier: expected options in an object, found null'],
    [() => teapot().grid(3, 3, 'normal'), 'simdbezier: expected options in an object, found normal'],
    [() => teapot().grid(3, 3, { outputs: 7 }), /outputs: expected one of position, .*found 7/],
    [() => teapot().grid(3, 3, { outputs: ['status'] }), 'simdbezier: outputs: expected one besides status at least, found status alone'],
    [() => teapot().samples([0], [0], [0], { outputs: [] }), 'simdbezier: outputs: expected one besides status at least, found none'],
    [() => bezier.read('builtin:teapot', undefined, null), 'simdbezier: expected options in an object, found null'],
    [() => bezier.patches(flat, 3), 'simdbezier: expected options in an object, found 3'],
    [() => bezier.patches(undefined), /points: expected a multiple of 48 values, found undefined/],
    [() => bezier.patches([]), /points: expected a multiple of 48 values, found 0/],
    [() => teapot().grid(1), /nu: expected an integer, 2 or more/],
    [() => teapot().grid(100000, 100000), 'not enough memory'],
    [() => teapot().samples([0], [0.5], []), /1 patches, 1 u and 0 v/],
    [() => teapot().samples([32], [0.5], [0.5]), /patch/],
    ...[0.5, -1, NaN, 2 ** 32, '0', undefined].map((patch) =>
      [() => teapot().samples([0, patch], [0, 0], [0, 0]), `simdbezier: patches: expected numbers of patches, found ${patch}`]),
    [() => teapot().samples({}, {}, {}), /patches.length: expected an integer/],
    [() => teapot().samples(), /patches.length: expected an integer/],
    [() => teapot().samples([0]), /1 patches, undefined u and undefined v/],
    [() => teapot().file('stl', { relative: 1e-3 }), /format: expected one of glb, ply, found stl/],
  ]) {
    assert.throws(act, (error) => error instanceof Error
      && (typeof message === 'string' ? error.message === message : message.test(error.message) || assert.fail(error.message)));
  }
  using_(teapot(), (set) => assert.equal(set.size, 32)); // the instance goes on
});

test('only modules of the package are started', async () => {
  const foreign = new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, 1, 4, 1, 0x60, 0, 0, 3, 2, 1, 0, 7, 15, 1, 11,
    ...new TextEncoder().encode('_initialize'), 0, 0, 10, 4, 1, 2, 0, 11]); // which has this function and nothing else
  for (const source of [foreign.subarray(0, 8), foreign, new WebAssembly.Module(foreign), new Response(foreign), new Uint8Array(8), '<html>', undefined]) {
    await assert.rejects(instantiate(source), /^Error: simdbezier: expected a module of this package that can be started: ./);
  }
});

test('views are guarded', async () => {
  const own = await load();
  const set = own.read('builtin:teapot');
  const mesh = set.tessellate({ relative: 1e-2 });
  const kept = mesh.vertices;
  const first = kept[0];
  const pages = own.memoryBytes;
  assert.equal(set.grid(300, 300).count, 300 * 300 * set.size);
  assert.ok(own.memoryBytes > pages);
  assert.equal(kept.length, 0); // the memory has grown
  assert.equal(mesh.vertices[0], first);
  const copy = mesh.copy();
  set.tessellate({ relative: 1e-3 });
  assert.throws(() => mesh.vertices, /replaced by a later call/);
  assert.equal(copy.vertices[0], first);
  set.free();
  set.free();
  assert.throws(() => set.tessellate({ relative: 1e-3 }), /has been freed/);
  assert.throws(() => set.grid(2), /has been freed/);
  if (Symbol.dispose) set[Symbol.dispose]();
});

test('a view keeps its set', async () => {
  setFlagsFromString('--expose-gc');
  const collect = runInNewContext('gc');
  const own = await load();
  own.patches(flat).grid(1500); // room, so that nothing detaches views
  const results = () => own.read('builtin:teapot').grid(2, 2, { outputs: ['position', 'status'] });
  for (const name of ['position', 'status']) {
    const view = results()[name];
    const before = view.slice();
    for (let k = 0; k < 5; k++) {
      collect();
      await sleep(1);
    }
    const others = Array.from({ length: 50 }, results); // take all memory that has been given back
    for (const set of others) set.position.fill(7) && set.status.fill(7);
    assert.deepEqual(view, before);
  }
});

test('results can be what the next call takes', async () => {
  for (const use of [
    (own, set, values) => own.patches(values), // 60 000 of them, which are many for 32 bits
    (own, set, values) => set.samples(new Uint8Array(values.length), values, values, { copy: true }).position,
  ]) {
    const [first, expected] = [await load(), await load()].map((own, again) => {
      const set = own.read('builtin:teapot');
      const { position } = set.grid(300, 100);
      const pages = own.memoryBytes;
      const results = use(own, set, again ? position.slice() : position);
      assert.ok(own.memoryBytes > pages); // which detached the position
      return results.size ?? results;
    });
    assert.deepEqual(first, expected);
  }
});

test('values may make the memory grow while they are read', async () => {
  for (const use of [(own, set, values) => own.patches(values).box.high,
    (own, set, values) => [...set.samples(values.map(() => 0), values, values).position],
    (own, set, values) => [...set.samples(values, values, values).position]]) {
    const [first, expected] = [await load(), await load()].map((own, again) => {
      const set = own.patches([...flat, ...flat, ...flat, ...flat]);
      const values = flat.map((value) => value); // which are numbers of its patches, too
      if (!again) {
        Object.defineProperty(values, 40, { get: () => (own.patches(flat).grid(1500), flat[40]) });
      }
      const pages = own.memoryBytes;
      const results = use(own, set, values);
      assert.equal(own.memoryBytes > pages, !again);
      return results;
    });
    assert.deepEqual(first, expected);
  }
});

test('an instance that has trapped says so', async () => {
  const own = await load();
  const set = own.read('builtin:teapot');
  const other = own.read('builtin:teapot');
  new Uint8Array(set.grid(2).position.buffer).fill(255); // all of its memory
  const failed = { message: /^simdbezier: expected an instance that works, found one that has failed \(.+\): load another one$/ };
  for (const act of [() => set.grid(2), () => set.grid(2), () => other.tessellate({ grid: 2 }), () => other.file('glb', { grid: 2 }),
    () => own.read('builtin:teapot'), () => own.patches(flat)]) {
    assert.throws(act, (error) => failed.message.test(error.message) && error.cause instanceof WebAssembly.RuntimeError);
  }
  set.free(); // which hides no error
  other.free();
  using_((await load()).read('builtin:teapot'), (set) => assert.equal(set.size, 32));
});

test('arrays of the example in README.md stay', async () => {
  const [, code] = readFileSync(join(folderOfPackage, 'README.md'), 'utf8').match(/```js\n([^]*?)```/);
  writeFileSync('readme.mjs', code.replace(/await bezier\.open\(.*\);/, "bezier.read('builtin:teapot');")
    .replace('set.free();', 'export { vertices, indices, position, normal };'));
  const arrays = await import(join(process.cwd(), 'readme.mjs'));
  for (const [name, array] of Object.entries(arrays)) assert.ok(array.length > 0, name);
  rmSync('readme.mjs');
});

test('memory does not grow over many meshes', async () => {
  const own = await loadDoubles();
  const round = (k) => {
    const set = own.read('builtin:teapot', undefined, { precision: k % 2 ? 'f32' : 'f64' });
    set.tessellate({ relative: 10 ** (-1.5 - (k % 7) / 8), crease: k % 3 ? undefined : 40 });
    if (k % 10 === 0) set.file('glb', { relative: 1e-2 });
    try { own.read('m.bez', new Uint8Array([49])); } catch { /* is part of a round */ }
    set.free();
  };
  for (let k = 0; k < 210; k++) round(k);
  const bytes = own.memoryBytes;
  const rounds = process.env.SIMDBEZIER_LONG_TESTS ? 10000 : 1000;
  for (let k = 0; k < rounds; k++) round(k);
  assert.equal(own.memoryBytes, bytes);
});

test('a worker takes the compiled module', async () => {
  const worker = new Worker(`
    import('simdbezier/instantiate').then(({ instantiate }) => require('node:worker_threads').parentPort.once('message', async (module) => {
      const set = (await instantiate(module)).read('builtin:teapot');
      const { vertices } = set.tessellate({ relative: 1e-3, copy: true });
      require('node:worker_threads').parentPort.postMessage(vertices, [vertices.buffer]);
    }));`, { eval: true });
  worker.postMessage(bezier.module);
  const vertices = await new Promise((resolve, reject) => worker.once('message', resolve).once('error', reject));
  await worker.terminate();
  using_(teapot(), (set) => assert.deepEqual(vertices, set.tessellate({ relative: 1e-3 }).vertices));
});

test('tsc --strict accepts an example, and refuses a wrong one', () => {
  const check = (text, ...libraries) => {
    writeFileSync('example.ts', text);
    return execFileSync('node_modules/.bin/tsc', ['--noEmit', '--strict', '--module', 'nodenext', '--target', 'es2022', ...libraries, '--types', '', 'example.ts'], { encoding: 'utf8' });
  };
  const good = `import { load, type PatchSet } from 'simdbezier';
    const bezier = await load();
    using set: PatchSet = bezier.read('builtin:teapot');
    const { vertices, indices, deviation } = set.tessellate({ relative: 1e-3, crease: 30 });
    const numbers: number[] = [vertices.length, indices.length, deviation, set.box.low[0]];
    const file: Uint8Array<ArrayBuffer> = set.file('glb', { relative: 1e-3 });
    const samples = set.grid(16, 16, { outputs: ['position', 'normal'], layout: 'interleaved' });
    export { numbers, file, samples };`;
  check(good, '--lib', 'es2022,dom,esnext.disposable');
  check(good); // with the libraries of the target
  assert.throws(() => check(good.replace('relative:', 'relativ:')));
  rmSync('example.ts');
});

const ENTRY = `import { load } from 'simdbezier';
globalThis.vertices = load().then((bezier) => bezier.read('builtin:teapot').tessellate({ relative: 1e-3, copy: true }).vertexCount);`;

test('esbuild bundles it', async () => {
  writeFileSync('entry.js', ENTRY);
  execFileSync('node_modules/.bin/esbuild', ['entry.js', '--bundle', '--format=esm', '--platform=browser', '--outfile=bundle/entry.mjs']);
  const bundle = readFileSync('bundle/entry.mjs', 'utf8');
  assert.match(bundle, /simdbezier\.wasm/);
  assert.doesNotMatch(bundle, /node:/);
  execFileSync('node_modules/.bin/esbuild', ['entry.js', '--bundle', '--format=esm', '--platform=node', '--outfile=bundle/node.mjs']);
  writeFileSync('bundle/simdbezier.wasm', readFileSync(createRequire(import.meta.url).resolve('simdbezier/simdbezier.wasm')));
  await import(join(process.cwd(), 'bundle/node.mjs'));
  assert.ok(await globalThis.vertices > 0);
});

test('vite bundles it, with the module', () => {
  writeFileSync('entry.js', ENTRY);
  writeFileSync('index.html', '<script type="module" src="entry.js"></script>');
  execFileSync('node_modules/.bin/vite', ['build', '--outDir', 'bundle/vite', '--logLevel', 'error']);
  const files = execFileSync('find', ['bundle/vite', '-name', '*.wasm'], { encoding: 'utf8' }).trim().split('\n');
  assert.equal(files.length, 1);
  assert.equal(statSync(files[0]).size, statSync(createRequire(import.meta.url).resolve('simdbezier/simdbezier.wasm')).size);
});

/** Answers every request as long as the test runs. Returns the address. */
async function serve(context, headers, bytes) {
  const server = createServer((request, response) => response.writeHead(200, headers).end(bytes)).listen(0, '127.0.0.1');
  context.after(() => server.close());
  await new Promise((resolve) => server.once('listening', resolve));
  return `http://127.0.0.1:${server.address().port}/`;
}

function using_(set, use) {
  try {
    return use(set);
  } finally {
    set.free();
  }
}
