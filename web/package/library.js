// simdbezier for JavaScript: Bézier patches, samples and meshes of them, in the memory of one WebAssembly
// instance. This file knows neither Node nor a browser.

const RESULTS = ['patches', 'diagonal', 'lowX', 'lowY', 'lowZ', 'highX', 'highY', 'highZ', 'edges', 'openEdges',
  'nonManifoldEdges', 'ignoredTrims', 'vertices', 'triangles', 'deviation', 'stride', 'indexBytes', 'vertexData',
  'indexData', 'deviationData', 'firstTriangleData', 'samples', 'sampleData', 'sampleStep', 'statusData', 'fileData', 'fileBytes'];
const MESH_VALUES = ['tolerance', 'relative', 'angle', 'crease', 'snap', 'nu', 'nv', 'normals', 'parameters', 'orient',
  'flip', 'thorough', 'bits'];
const MESH_OPTIONS = ['grid', 'weld', ...MESH_VALUES.filter((name) => !['nu', 'nv', 'bits'].includes(name))];
const READ_OPTIONS = ['precision', 'ignoreTrims'];
const PATCH_OPTIONS = ['degreeU', 'degreeV', 'weights', 'precision'];
const SAMPLE_OPTIONS = ['outputs', 'layout', 'watertight', 'copy'];
const LINES = { least: 2, most: 2 ** 20, whole: true }; // of a grid
const CELLS = { least: 2, most: 4097, whole: true }; // of a mesh, whose patches have 4096 cells a direction at most
const OUTPUTS = ['position', 'du', 'dv', 'duu', 'duv', 'dvv', 'normal', 'curvature', 'status'];
const VECTORS = OUTPUTS.slice(0, OUTPUTS.indexOf('curvature'));
const STATUS = 1 << OUTPUTS.indexOf('status');
const WISHES = []; // by bits: names of outputs, and those of them that are vectors
const CURVATURES = ['gaussian', 'mean', 'minimum', 'maximum'];
const ARRAYS = [...VECTORS, 'records', ...CURVATURES, 'status'];
const WEIGHTS = ['none', 'cartesian', 'homogeneous'];
const LAYOUTS = ['triples', 'planes', 'interleaved'];
const FORMATS = ['glb', 'ply'];
const PRECISIONS = ['f32', 'f64'];

// What the C library of the module imports for standard output, which nothing writes to: the answer is ENOSYS.
const imports = { wasi_snapshot_preview1: new Proxy({}, { get: () => () => 52 }) };

function fail(text) {
  throw new Error(`simdbezier: ${text}`);
}

function choice(name, value, list) {
  const found = list.indexOf(value);
  if (found < 0) fail(`${name}: expected one of ${list.join(', ')}, found ${String(value)}`);
  return found;
}

function number(name, value, { least = 0, most = Infinity, whole = false } = {}) {
  if (!Number.isFinite(value) || value < least || value > most || (whole && !Number.isInteger(value))) {
    fail(`${name}: expected ${whole ? 'an integer' : 'a finite number'}, ${least} or more${most < Infinity ? ` and at most ${most}` : ''}, found ${String(value)}`);
  }
  return value;
}

function expectKnown(options, known) {
  if (Object(options) !== options) fail(`expected options in an object, found ${String(options)}`);
  for (const name in options) {
    if (!known.includes(name)) fail(`expected options among ${known.join(', ')}, found ${name}`);
  }
}

/** numbers: what became of values, which are such numbers. */
function expectEqual(numbers, values) {
  for (let k = 0; k < numbers.length; k++) {
    if (numbers[k] !== values[k]) fail(`patches: expected numbers of patches, found ${String(values[k])}`);
  }
}

/** The bytes of a buffer, or of a view of one, whatever its elements are. */
function bytesOf(name, source) {
  if (ArrayBuffer.isView(source)) return new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
  const type = Object.prototype.toString.call(source); // instanceof knows those of one window only
  if (!/^.object (Shared)?ArrayBuffer.$/.test(type)) fail(`${name}: expected bytes in a buffer, found ${type}`);
  return new Uint8Array(source);
}

/** What the last calls for a set left behind, as it was then. */
class Results {
  constructor(values) { this.values = values.slice(); }
}
RESULTS.forEach((name, k) => Object.defineProperty(Results.prototype, name, { get() { return this.values[k]; } }));

/** What the last grid or samples left behind. Copies of all results would take most of the time of a small call. */
const [SAMPLES, SAMPLE_DATA, SAMPLE_STEP, STATUS_DATA] = ['samples', 'sampleData', 'sampleStep', 'statusData'].map((name) => RESULTS.indexOf(name));
class SampleResults {
  constructor(values) {
    this.samples = values[SAMPLES];
    this.sampleData = values[SAMPLE_DATA];
    this.sampleStep = values[SAMPLE_STEP];
    this.statusData = values[STATUS_DATA];
  }
}

function wishOf(bits) {
  return WISHES[bits] ??= {
    outputs: OUTPUTS.filter((name, k) => bits & 1 << k), vectors: VECTORS.filter((name, k) => bits & 1 << k),
  };
}

/** Compiles and starts an instance. source: bytes, a WebAssembly.Module, or a Response, or a promise of one. */
export async function instantiate(source) {
  source = await source;
  let module = source;
  const response = typeof Response !== 'undefined' && source instanceof Response;
  if (response && !source.ok) fail(`${source.url}: expected an answer, found status ${source.status}`);
  try {
    if (!(module instanceof WebAssembly.Module)) {
      // compileStreaming() refuses every other type, and this one with parameters; Node also with other letters.
      const streams = response && source.headers.get('content-type') === 'application/wasm';
      module = streams ? await WebAssembly.compileStreaming(source)
        : await WebAssembly.compile(response ? await source.arrayBuffer() : source);
    }
    const wasm = (await WebAssembly.instantiate(module, imports)).exports;
    if (!wasm.read_model) throw new Error('found another one');
    wasm._initialize();
    return new Simdbezier(guarded(wasm), module);
  } catch (error) {
    throw new Error(`simdbezier: expected a module of this package that can be started: ${error.message}`, { cause: error });
  }
}

/**
 * Returns the exports with functions that do nothing more once one of them has thrown. That is a trap, which leaves
 * the memory as it was at some point in the middle of the call.
 */
function guarded(exports) {
  let trap;
  const guard = (name, call) => (...values) => {
    if (trap === undefined) {
      try {
        return call(...values);
      } catch (error) {
        trap = error;
      }
    }
    // These follow what has failed, whose error is the one to be seen.
    if (name === 'release' || name === 'free_model') return undefined;
    throw new Error(`simdbezier: expected an instance that works, found one that has failed (${trap.message}): load another one`, { cause: trap });
  };
  return Object.fromEntries(Object.entries(exports).map(([name, value]) => [name, typeof value === 'function' ? guard(name, value) : value]));
}

/** One instance: its memory, and what is made in it. */
class Simdbezier {
  #wasm;
  constructor(wasm, module) {
    this.#wasm = wasm;
    this.module = module;
  }

  get memoryBytes() { return this.#wasm.memory.buffer.byteLength; }

  read(name, bytes = new Uint8Array(), options = {}) {
    expectKnown(options, READ_OPTIONS);
    const { precision = 'f32', ignoreTrims = false } = options;
    const flags = choice('precision', precision, PRECISIONS) + (ignoreTrims ? 2 : 0);
    const text = new TextEncoder().encode(name);
    const data = lasting(this.#wasm, bytesOf(name, bytes), Uint8Array);
    return this.#made(text.length + data.length, flags, (at, heap) => {
      heap.set(data, at);
      heap.set(text, at + data.length);
      return this.#wasm.read_model(at + data.length, text.length, at, data.length, flags);
    });
  }

  async open(name, source, options) {
    source = await source;
    if (source instanceof Response && !source.ok) fail(`${name}: expected an answer, found status ${source.status}`);
    if (![Response, Blob, ReadableStream].some((type) => source instanceof type)) source = bytesOf(name, source).slice();
    const taken = async (answer) => new Uint8Array(await answer.arrayBuffer());
    let bytes;
    try {
      bytes = await taken(source instanceof Response ? source : new Response(source));
      // The name says nothing: fetch() has unpacked what a server sent as packed.
      if (bytes[0] === 0x1f && bytes[1] === 0x8b) {
        bytes = await taken(new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))));
      }
    } catch (error) {
      throw new Error(`${name}: expected data that can be read and unpacked, found ${error.message}`, { cause: error });
    }
    return this.read(name, bytes, options);
  }

  patches(points, options = {}) {
    expectKnown(options, PATCH_OPTIONS);
    const { degreeU = 3, degreeV = 3, weights = 'none', precision = 'f32' } = options;
    number('degreeU', degreeU, { least: 1, most: 15, whole: true });
    number('degreeV', degreeV, { least: 1, most: 15, whole: true });
    const form = choice('weights', weights, WEIGHTS);
    const flags = choice('precision', precision, PRECISIONS);
    const each = (degreeU + 1) * (degreeV + 1) * (form === 0 ? 3 : 4);
    if (!points?.length || points.length % each !== 0) {
      fail(`points: expected a multiple of ${each} values, found ${points?.length}`);
    }
    points = lasting(this.#wasm, points, Float64Array);
    return this.#made(8 * points.length, flags, (at) => {
      new Float64Array(this.#wasm.memory.buffer, at, points.length).set(points);
      return this.#wasm.make_model(at, points.length / each, degreeU, degreeV, form, flags);
    });
  }

  #made(bytes, flags, make) {
    const handle = withMemory(this.#wasm, bytes, make) >>> 0;
    if (handle === 0) throw new Error(message(this.#wasm));
    return new PatchSet(this.#wasm, handle, (flags & 1) !== 0);
  }
}

/**
 * Returns values that stay when the instance's memory grows, which would detach its own results. Reading others than
 * those of a view may run somebody's code, which makes the memory grow: they become Values, before memory is lent.
 */
function lasting(wasm, values, Values) {
  if (ArrayBuffer.isView(values)) return values.buffer === wasm.memory.buffer ? values.slice() : values;
  if (values.length >= 2 ** 32 / Values.BYTES_PER_ELEMENT) fail('not enough memory');
  const own = new Values(values.length);
  own.set(values);
  return own;
}

/** Lends memory of the instance to use(address, bytes of all of it). */
function withMemory(wasm, bytes, use) {
  // Larger numbers would be cut to 32 bits. Addresses above 2 GiB come as negative numbers.
  const at = bytes < 2 ** 32 - 8 ? wasm.allocate(bytes + 8) >>> 0 : 0;
  if (at === 0) fail('not enough memory');
  try {
    return use(at, new Uint8Array(wasm.memory.buffer));
  } finally {
    wasm.release(at);
  }
}

function message(wasm) {
  const at = wasm.message() >>> 0;
  return new TextDecoder().decode(new Uint8Array(wasm.memory.buffer, at, wasm.message_bytes() >>> 0).slice());
}

// A net for sets that nobody frees, and no promise.
const forgotten = typeof FinalizationRegistry === 'undefined' ? undefined
  : new FinalizationRegistry(({ wasm, handle }) => wasm.free_model(handle));

class PatchSet {
  #wasm; #handle; #doubles; #about; #values = []; #call = { mesh: 0, samples: 0 };

  constructor(wasm, handle, doubles) {
    this.#wasm = wasm;
    this.#handle = handle;
    this.#doubles = doubles;
    forgotten?.register(this, { wasm, handle }, this);
    this.#about = new Results(this.#results());
  }

  get size() { return this.#about.patches; }
  get diagonal() { return this.#about.diagonal; }
  get box() {
    const { lowX, lowY, lowZ, highX, highY, highZ } = this.#about;
    return { low: [lowX, lowY, lowZ], high: [highX, highY, highZ] };
  }
  get edges() { return this.#about.edges; }
  get openEdges() { return this.#about.openEdges; }
  get nonManifoldEdges() { return this.#about.nonManifoldEdges; }
  get ignoredTrims() { return this.#about.ignoredTrims; }
  get precision() { return PRECISIONS[this.#doubles ? 1 : 0]; }

  tessellate(options = {}) {
    this.#call.mesh++;
    this.#wish(options, [...MESH_OPTIONS, 'copy'], (at) => this.#wasm.tessellate(this.#use(), at));
    this.#about = new Results(this.#results());
    const mesh = new Mesh(this.#views('mesh'), this.#about);
    return options.copy ? mesh.copy() : mesh;
  }

  file(format, options = {}) {
    const number = choice('format', format, FORMATS);
    this.#wish(options, [...MESH_OPTIONS, 'bits'], (at) => this.#wasm.write_file(this.#use(), number, at));
    const { fileData, fileBytes } = new Results(this.#results());
    return new Uint8Array(this.#wasm.memory.buffer, fileData, fileBytes).slice();
  }

  grid(nu, nv = nu, options = {}) {
    number('nu', nu, LINES);
    number('nv', nv, LINES);
    return this.#evaluated(options, (bits, layout, watertight) =>
      this.#wasm.grid(this.#use(), nu, nv, bits, layout, watertight));
  }

  samples(patches, u, v, options = {}) {
    const count = number('patches.length', patches?.length, { whole: true });
    if (u?.length !== count || v?.length !== count) {
      fail(`expected as many u and v as patches, found ${count} patches, ${u?.length} u and ${v?.length} v`);
    }
    const Values = this.#doubles ? Float64Array : Float32Array;
    [u, v] = [u, v].map((values) => lasting(this.#wasm, values, Values));
    const whole = lasting(this.#wasm, patches, Uint32Array);
    if (!ArrayBuffer.isView(patches)) expectEqual(whole, patches);
    const each = Values.BYTES_PER_ELEMENT;
    return this.#evaluated(options, (...how) => withMemory(this.#wasm, (4 + 2 * each) * count, (at) => {
      const buffer = this.#wasm.memory.buffer;
      new Values(buffer, at, count).set(u);
      new Values(buffer, at + each * count, count).set(v);
      const numbers = new Uint32Array(buffer, at + 2 * each * count, count);
      numbers.set(whole);
      if (!(whole instanceof Uint32Array)) expectEqual(numbers, whole);
      return this.#wasm.samples(this.#use(), at + 2 * each * count, at, at + each * count, count, ...how);
    }));
  }

  free() {
    if (this.#handle !== 0) this.#wasm.free_model(this.#handle);
    forgotten?.unregister(this);
    this.#handle = 0;
  }
  [Symbol.dispose ?? Symbol('dispose')]() { this.free(); }

  #use() {
    if (this.#handle === 0) fail('the set has been freed');
    return this.#handle;
  }
  /** Returns the results in the instance's memory, which detaches them when it grows. */
  #results() {
    if (this.#values.length === 0) {
      this.#values = new Float64Array(this.#wasm.memory.buffer, this.#wasm.results(this.#use()) >>> 0, RESULTS.length);
    }
    return this.#values;
  }
  #expect(done) {
    if (!done) throw new Error(message(this.#wasm));
  }

  #wish(wanted, known, call) {
    expectKnown(wanted, known);
    const { grid, weld = true, crease, normals = true, ...options } = wanted;
    if (crease !== undefined && !(weld && normals)) fail('crease: expected neither with weld: false nor with normals: false');
    const wish = { ...options, normals, crease: weld ? crease : 0 };
    if (grid !== undefined) {
      [wish.nu, wish.nv] = grid?.[Symbol.iterator] ? grid : [grid, grid];
      for (const name of ['nu', 'nv']) number('grid', wish[name], CELLS);
    }
    for (const [name, least, most] of [['tolerance', Number.MIN_VALUE], ['relative', Number.MIN_VALUE],
      ['angle', Number.MIN_VALUE, 180], ['crease', 0, 180], ['snap', 0]]) {
      if (wish[name] !== undefined) number(name, wish[name], { least, most });
    }
    if (wish.bits !== undefined) choice('bits', wish.bits, [8, 16]);
    const adaptive = wish.tolerance ?? wish.relative ?? wish.angle;
    if ((adaptive === undefined) === (wish.nu === undefined)) {
      fail('expected either a grid or some of tolerance, relative and angle');
    }
    if (wish.thorough && (wish.tolerance ?? wish.relative) === undefined) {
      fail('thorough: expected with tolerance or relative, found without');
    }
    const flags = ['parameters', 'orient', 'flip', 'thorough', 'normals'];
    this.#expect(withMemory(this.#wasm, 8 * MESH_VALUES.length, (at) => {
      new Float64Array(this.#wasm.memory.buffer, at, MESH_VALUES.length)
        .set(MESH_VALUES.map((name) => flags.includes(name) ? (wish[name] ? 1 : 0) : wish[name] ?? NaN));
      return call(at);
    }));
  }

  #evaluated(options, call) {
    expectKnown(options, SAMPLE_OPTIONS);
    const { outputs = ['position'], layout = 'triples', watertight = true, copy = false } = options;
    let bits = 0;
    for (const name of outputs?.[Symbol.iterator] ? outputs : [outputs]) bits |= 1 << choice('outputs', name, OUTPUTS);
    if ((bits & ~STATUS) === 0) fail(`outputs: expected one besides status at least, found ${bits === 0 ? 'none' : 'status alone'}`);
    this.#call.samples++;
    this.#expect(call(bits, choice('layout', layout, LAYOUTS), watertight ? 1 : 0));
    const samples = new SampleArrays(this.#views('samples'), new SampleResults(this.#results()), wishOf(bits), layout);
    return copy ? samples.copy() : samples;
  }

  /** Returns what makes views of the last results of a kind, as long as they are the last ones. */
  #views(kind) {
    const call = this.#call[kind];
    const Values = this.#doubles ? Float64Array : Float32Array;
    return (address, count, Type = Values, skipped = 0) => {
      if (call !== this.#call[kind]) fail(`these results were replaced by a later call: keep them with copy()`);
      this.#use();
      const view = new Type(this.#wasm.memory.buffer, address + skipped * Type.BYTES_PER_ELEMENT, count);
      new Owned(view, this);
      return view;
    };
  }
}

/** Gives a view a private field with its set, which is not released then as long as somebody has the view. */
class Owned extends (class { constructor(view) { return view; } }) {
  #set;
  constructor(view, set) {
    super(view);
    this.#set = set;
  }
}

/** Arrays of the instance's memory, made anew each time that they are asked for; see index.d.ts. */
class Mesh {
  #view; #about;
  constructor(view, about) {
    this.#view = view;
    this.#about = about;
  }
  get vertexCount() { return this.#about.vertices; }
  get triangleCount() { return this.#about.triangles; }
  get deviation() { return this.#about.deviation; }
  get stride() { return this.#about.stride; }
  get vertices() { return this.#view(this.#about.vertexData, this.stride * this.vertexCount); }
  get indices() {
    return this.#view(this.#about.indexData, 3 * this.triangleCount, this.#about.indexBytes === 2 ? Uint16Array : Uint32Array);
  }
  get deviations() { return this.#view(this.#about.deviationData, this.#about.patches, Float64Array); }
  get firstTriangles() { return this.#view(this.#about.firstTriangleData, this.#about.patches + 1, Uint32Array); }
  copy() { return copied(this, ['vertices', 'indices', 'deviations', 'firstTriangles'], ['vertexCount', 'triangleCount', 'deviation', 'stride']); }
}

class SampleArrays {
  #view; #about; #wanted; #vectors; #records;
  constructor(view, about, { outputs, vectors }, layout) {
    this.#view = view;
    this.#about = about;
    this.#wanted = outputs;
    this.#vectors = vectors;
    this.#records = layout === 'interleaved';
  }
  get count() { return this.#about.samples; }
  get records() { return this.#records ? this.#part(0, 0, 3 * this.#vectors.length) : undefined; }
  get status() {
    return this.#wanted.includes('status') ? this.#view(this.#about.statusData, this.count, Uint8Array) : undefined;
  }
  /** Returns so many values a sample: the first ones, or those behind so many vectors and single values. */
  #part(vectors, singles, values) {
    return this.#view(this.#about.sampleData, values * this.count, undefined,
      vectors * this.#about.sampleStep + singles * this.count);
  }
  copy() { return copied(this, ARRAYS.filter((name) => this[name]), ['count']); }

  static { // for all results at once: properties of each would take most of the time of a call on a few samples
    const define = (name, find) => Object.defineProperty(this.prototype, name, { get() { return find(this); } });
    VECTORS.forEach((name) => define(name, (all) => {
      const k = all.#vectors.indexOf(name);
      return k < 0 || all.#records ? undefined : all.#part(k, 0, 3);
    }));
    CURVATURES.forEach((name, k) => define(name, (all) =>
      all.#wanted.includes('curvature') ? all.#part(all.#vectors.length, k, 1) : undefined));
  }
}

function copied(results, arrays, values) {
  const copy = Object.fromEntries(values.map((name) => [name, results[name]]));
  for (const name of arrays) copy[name] = results[name].slice();
  copy.copy = () => copy;
  return copy;
}
