// The page: three.js shows what the worker makes of the model, as fine as the slider says.
import * as THREE from 'three';
import { OrbitControls } from './three/OrbitControls.js';

const $ = (id) => document.getElementById(id);

// What the worker is asked, and its answers.
const worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
const waiting = new Map();
let asked = 0;
worker.addEventListener('message', ({ data: { id, error, ...answer } }) => {
  const { resolve, reject } = waiting.get(id);
  waiting.delete(id);
  error === undefined ? resolve(answer) : reject(new Error(error));
});
worker.addEventListener('error', ({ message }) => complain(new Error(message || 'The worker and the library could not be loaded.')));
const ask = (what, rest = {}) => new Promise((resolve, reject) => {
  waiting.set(++asked, { resolve, reject });
  worker.postMessage({ id: asked, what, ...rest });
});

// The scene.
const renderer = new THREE.WebGLRenderer({ canvas: $('view'), antialias: true });
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x20242b);
const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000);
const sun = new THREE.DirectionalLight(0xffffff, 2.2);
sun.position.set(-0.6, 0.8, 1);
camera.add(sun);
scene.add(camera, new THREE.HemisphereLight(0xffffff, 0x556070, 1.5));
const material = new THREE.MeshStandardMaterial({ color: 0xd8a25c, roughness: 0.5, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
const surface = new THREE.Mesh(new THREE.BufferGeometry(), material);
const lines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x101820, transparent: true, opacity: 0.55 }));
const turned = new THREE.Group();
turned.add(surface, lines);
scene.add(turned);
const controls = new OrbitControls(camera, renderer.domElement);
controls.addEventListener('change', draw);

let due = false;
function draw() {
  if (due) return;
  due = true;
  requestAnimationFrame(() => {
    due = false;
    renderer.render(scene, camera);
  });
}

function resize() {
  const { clientWidth, clientHeight } = $('view').parentElement;
  if (clientWidth === 0 || clientHeight === 0) return;
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(clientWidth, clientHeight, false);
  camera.aspect = clientWidth / clientHeight;
  camera.updateProjectionMatrix();
  draw();
}
new ResizeObserver(resize).observe($('view').parentElement);

let size = 1; // of the model
function lookAt(box) {
  const low = new THREE.Vector3(...box.low), high = new THREE.Vector3(...box.high);
  size = low.distanceTo(high) || 1;
  // The model is drawn in a box of size 1 around the origin.
  const middle = low.add(high).multiplyScalar(0.5);
  for (const part of [surface, lines]) {
    part.scale.setScalar(1 / size);
    part.position.copy(middle).multiplyScalar(-1 / size);
  }
  camera.position.set(0.42, 0.6, 1.35).multiplyScalar(Math.max(1, 1.1 / camera.aspect));
  controls.target.set(0, 0, 0);
  controls.update();
}

function show(mesh) {
  const geometry = new THREE.BufferGeometry();
  const buffer = new THREE.InterleavedBuffer(mesh.vertices, 6);
  geometry.setAttribute('position', new THREE.InterleavedBufferAttribute(buffer, 3, 0));
  geometry.setAttribute('normal', new THREE.InterleavedBufferAttribute(buffer, 3, 3));
  geometry.setIndex(new THREE.BufferAttribute(mesh.indices, 1));
  if (mesh.colours) geometry.setAttribute('color', new THREE.BufferAttribute(mesh.colours, 4, true));
  surface.geometry.dispose(); // or its buffers stay on the device
  surface.geometry = geometry;
  if (material.vertexColors !== Boolean(mesh.colours)) {
    material.vertexColors = Boolean(mesh.colours);
    material.color.set(mesh.colours ? 0xffffff : 0xd8a25c);
    material.needsUpdate = true;
  }
  lines.geometry.dispose();
  lines.geometry = new THREE.BufferGeometry();
  lines.visible = Boolean(mesh.edges);
  if (mesh.edges) {
    lines.geometry.setAttribute('position', geometry.attributes.position);
    lines.geometry.setIndex(new THREE.BufferAttribute(mesh.edges, 1));
  }
  draw();
}

function showNothing() {
  for (const part of [surface, lines]) {
    part.geometry.dispose();
    part.geometry = new THREE.BufferGeometry();
  }
  $('numbers').textContent = '';
  last = undefined;
  draw();
}

// Meshes. While one is made, only the last wish is kept.
let busy = false, wanted = false, last;
let opened = 0, meshed = 0; // the wishes whose model, and whose mesh, are there
const relative = () => 10 ** Number($('tolerance').value);
async function remesh() {
  $('shown').textContent = `1/${Math.round(1 / relative())} of the diagonal`;
  $('legend').hidden = !$('colours').checked;
  wanted = true;
  if (busy || !opened) return;
  busy = true;
  while (wanted) {
    wanted = false;
    const model = opened;
    const begin = performance.now();
    try {
      const mesh = await ask('mesh', { relative: relative(), edges: $('edges').checked, colours: $('colours').checked });
      show(mesh);
      meshed = model;
      last = { relative: mesh.relative, triangles: mesh.triangleCount, ms: performance.now() - begin };
      $('numbers').textContent = `${mesh.triangleCount} triangles, ${mesh.vertexCount} vertices\n`
        + `certified within ${mesh.deviation.toPrecision(3)}, asked for ${mesh.tolerance.toPrecision(3)}\n${last.ms.toFixed(0)} ms`;
      $('problem').hidden = true;
    } catch (error) {
      if (meshed !== opened) showNothing(); // what was shown is of the model before
      complain(error);
    }
  }
  busy = false;
}

function complain(error) {
  $('problem').textContent = error.message;
  $('problem').hidden = false;
  if (!opened) $('model').textContent = 'No model';
}

let wishes = 0; // for models: only the last one counts, whichever is read first
async function open(name, file) {
  const wish = ++wishes;
  try {
    const { size: patches, box, openEdges, ignoredTrims } = await ask('open', { name, file });
    if (wish !== wishes) return;
    $('model').textContent = `${name}: ${patches} patches, ${openEdges} open edges`
      + (ignoredTrims > 0 ? `; ${ignoredTrims} trimmed surfaces are shown as a whole` : '');
    $('problem').hidden = true;
    opened = wish;
    lookAt(box);
    await remesh();
  } catch (error) {
    if (wish === wishes) complain(error); // the model before stays
  }
}

for (const id of ['tolerance', 'edges', 'colours']) $(id).addEventListener('input', remesh);
$('up').addEventListener('input', () => {
  turned.rotation.x = $('up').checked ? -Math.PI / 2 : 0;
  draw();
});
turned.rotation.x = -Math.PI / 2;
$('panel').addEventListener('submit', (event) => event.preventDefault());
$('teapot').addEventListener('click', () => open('builtin:teapot'));
$('file').addEventListener('change', () => {
  const [file] = $('file').files;
  if (file) open(file.name, file);
  $('file').value = '';
});
$('save').addEventListener('click', async () => {
  try {
    const { bytes } = await ask('file', { format: 'glb', relative: relative() });
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([bytes], { type: 'model/gltf-binary' }));
    link.download = 'mesh.glb';
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  } catch (error) {
    complain(error);
  }
});

addEventListener('dragover', (event) => {
  event.preventDefault();
  document.body.classList.add('over');
});
addEventListener('dragleave', () => document.body.classList.remove('over'));
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('over');
  const [file] = event.dataTransfer.files;
  if (file) open(file.name, file);
});

// Keys turn the camera around the model.
const KEYS = { ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, -0.1, 1], ArrowDown: [0, 0.1, 1], '+': [0, 0, 0.9], '-': [0, 0, 1 / 0.9] };
$('view').addEventListener('keydown', (event) => {
  if (!(event.key in KEYS)) return;
  event.preventDefault();
  const [around, up, closer] = KEYS[event.key];
  const place = new THREE.Spherical().setFromVector3(camera.position.clone().sub(controls.target));
  place.theta += around;
  place.phi += up;
  place.radius *= closer;
  place.makeSafe();
  camera.position.setFromSpherical(place).add(controls.target);
  controls.update();
  draw();
});

globalThis.page = { get last() { return last; }, get idle() { return opened > 0 && !busy && waiting.size === 0; } }; // for tests
open('builtin:teapot');
