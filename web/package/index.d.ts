/// <reference lib="esnext.disposable" />

/** Weights of control points: none (x y z), Cartesian (x y z w) or homogeneous (wx wy wz w). */
export type Weights = 'none' | 'cartesian' | 'homogeneous';
export type Precision = 'f32' | 'f64';
export type FileFormat = 'glb' | 'ply';
export type Output = 'position' | 'du' | 'dv' | 'duu' | 'duv' | 'dvv' | 'normal' | 'curvature' | 'status';

export interface ReadOptions {
  /** In which samples and meshes are computed, 'f32' by default. Control points of files are doubles. */
  precision?: Precision;
  /** Reads surfaces as a whole of which the file shows a part; they are counted in `ignoredTrims`. */
  ignoreTrims?: boolean;
}

export interface PatchOptions {
  /** 3 by default, 1 to 15. */
  degreeU?: number;
  degreeV?: number;
  weights?: Weights;
  precision?: Precision;
}

/** How fine a mesh is: a grid, or one or more of `tolerance`, `relative` and `angle`. */
export interface MeshOptions {
  /** The largest distance between surface and mesh. */
  tolerance?: number;
  /** The same as a share of the diagonal of the box of all control points. The smaller one counts. */
  relative?: number;
  /** The largest angle between normals of neighbouring vertices, in degrees. */
  angle?: number;
  /** So many samples a patch in each direction, or [in u, in v]: 2 to 4097. */
  grid?: number | [number, number];
  /** false: patches share no vertices. true by default. */
  weld?: boolean;
  /** Edges whose patches meet at this angle or a larger one, in degrees, keep two normals. 0: patches share no vertices.
   * By default all normals are merged. Not beside `weld: false` or `normals: false`. */
  crease?: number;
  /** The distance within which open sides become one edge. */
  snap?: number;
  /** true by default. */
  normals?: boolean;
  /** u and v of every vertex. Patches share no vertices then. */
  parameters?: boolean;
  /** Turns patches so that neighbours agree. */
  orient?: boolean;
  /** Then turns all of them. */
  flip?: boolean;
  /** Fewer triangles within `tolerance` or `relative`, one of which it needs, in more time: for models that stay. */
  thorough?: boolean;
}

export interface FileOptions extends MeshOptions {
  /** Of GLB: 16-bit positions, and normals of so many bits a component (KHR_mesh_quantization). */
  bits?: 8 | 16;
}

export interface SampleOptions {
  /** ['position'] by default. 'status' needs another one beside it. */
  outputs?: readonly Output[];
  /** Vectors as x y z after each other, all x before all y, or all outputs of a sample in one record. */
  layout?: 'triples' | 'planes' | 'interleaved';
  /** false: edges come from the interior's formula, which is faster, and may leave gaps. */
  watertight?: boolean;
  /** true: arrays of their own, as copy() returns. */
  copy?: boolean;
}

export type Values = Float32Array | Float64Array;

/** Arrays that are their own: nothing that is called later changes them. */
export interface MeshCopy {
  readonly vertexCount: number;
  readonly triangleCount: number;
  /** The largest distance between surface and mesh that is certified, with all roundings. */
  readonly deviation: number;
  /** How many values a vertex has. */
  readonly stride: number;
  /** x y z, nx ny nz, u v of every vertex, as far as they were asked for. */
  readonly vertices: Values;
  /** Three for each triangle; 16 bits where there are at most 65535 vertices. */
  readonly indices: Uint16Array | Uint32Array;
  /** The certified distance of every patch. */
  readonly deviations: Float64Array;
  /** The first triangle of every patch, and the number of all. */
  readonly firstTriangles: Uint32Array;
  copy(): MeshCopy;
}
/**
 * A mesh in the memory of the instance. Each of its arrays is a view that is made when it is asked for. The mesh stays
 * until the next tessellate() or free() of its set; asking for an array later throws. A view that somebody has
 * kept is detached (its length is 0) once any call has made the memory grow: ask for it again, or copy(). A set is not
 * released by the garbage collector as long as somebody has such a view. That counts for the array itself, and not for
 * its subarray(), iterators, or other views of its buffer: keep the array or the set beside those.
 */
export type Mesh = MeshCopy;

/** Samples, with an array for each output, or `records`. They live as a Mesh does. */
export interface SampleArrays {
  readonly count: number;
  readonly position?: Values;
  readonly du?: Values;
  readonly dv?: Values;
  readonly duu?: Values;
  readonly duv?: Values;
  readonly dvv?: Values;
  readonly normal?: Values;
  readonly records?: Values;
  readonly gaussian?: Values;
  readonly mean?: Values;
  readonly minimum?: Values;
  readonly maximum?: Values;
  /** 0: regular; 1: the normal is a limit; 2: there is none; 3: a parameter was not finite. */
  readonly status?: Uint8Array;
  copy(): SampleArrays;
}

export interface PatchSet {
  /** How many patches there are. */
  readonly size: number;
  readonly precision: Precision;
  readonly diagonal: number;
  readonly box: { low: [number, number, number]; high: [number, number, number] };
  /** As the last mesh has them; before the first one, without `snap`. */
  readonly edges: number;
  readonly openEdges: number;
  readonly nonManifoldEdges: number;
  readonly ignoredTrims: number;

  tessellate(options: MeshOptions & { /** true: arrays of their own. */ copy?: boolean }): Mesh;
  /** The bytes of the file that the program `simdbezier tessellate` writes for these options. */
  file(format: FileFormat, options: FileOptions): Uint8Array<ArrayBuffer>;
  /** Every patch on nu x nv samples, u fastest, patch after patch. */
  grid(nu: number, nv?: number, options?: SampleOptions): SampleArrays;
  /** Sample k lies on patch patches[k] at (u[k], v[k]). A Uint32Array of patches is passed on without a check. */
  samples(patches: ArrayLike<number>, u: ArrayLike<number>, v: ArrayLike<number>, options?: SampleOptions): SampleArrays;
  /** Frees the set and its results. */
  free(): void;
  [Symbol.dispose](): void;
}

export type Source = Blob | Response | ReadableStream<Uint8Array> | ArrayBufferLike | ArrayBufferView;

/**
 * One instance. A call that fails throws, and the instance goes on. Only if its code has trapped, which is a fault of
 * the package, every later call fails and says so: load another instance.
 */
export interface Simdbezier {
  /** The compiled code, to be sent to workers: instantiate(module) compiles nothing there. */
  readonly module: WebAssembly.Module;
  /** The memory of the instance, which grows and never shrinks. */
  readonly memoryBytes: number;
  /** Reads a file's bytes; its name's extension says the format. 'builtin:teapot' needs no bytes.
   *  Errors have the place: "model.bez:3: expected a finite number, found 'z'". */
  read(name: string, bytes?: ArrayBufferLike | ArrayBufferView, options?: ReadOptions): PatchSet;
  /** The same for files, answers of fetch() and streams, which are unpacked where their bytes are those of gzip. */
  open(name: string, source: Source | Promise<Source>, options?: ReadOptions): Promise<PatchSet>;
  /** The control points of all patches, u fastest, patch after patch. */
  patches(points: ArrayLike<number>, options?: PatchOptions): PatchSet;
}

/** Loads simdbezier.wasm from beside the package, or from a URL; in Node also from a path. */
export function load(url?: string | URL): Promise<Simdbezier>;
/** For those who have the bytes, a compiled module or an answer already. */
export function instantiate(source: BufferSource | WebAssembly.Module | Response | Promise<Response>): Promise<Simdbezier>;
