// The library in a thread of its own, so that the page never waits: answers { id, … } to messages { id, what, … }.
import { load } from './simdbezier/browser.js';

const library = load();
let set, wishes = 0;

// From dark blue, at half of the tolerance and below, to yellow, at the tolerance. Shaders take linear values.
const RAMP = [[38, 49, 120], [40, 110, 160], [45, 165, 140], [140, 200, 80], [250, 225, 60]];
function colour(share) {
  const at = Math.min(Math.max(2 * share - 1, 0), 1) * (RAMP.length - 1), k = Math.min(Math.floor(at), RAMP.length - 2);
  return RAMP[k].map((low, c) => 255 * ((low + (at - k) * (RAMP[k + 1][c] - low)) / 255) ** 2.2);
}

// Each vertex belongs to one patch.
function coloursOf({ indices, vertexCount, deviations, firstTriangles }, tolerance) {
  const colours = new Uint8Array(4 * vertexCount);
  for (let patch = 0; patch < deviations.length; patch++) {
    const ofPatch = [...colour(deviations[patch] / tolerance), 255];
    for (let k = 3 * firstTriangles[patch]; k < 3 * firstTriangles[patch + 1]; k++) colours.set(ofPatch, 4 * indices[k]);
  }
  return colours;
}

function edgesOf(indices) {
  const edges = new Uint32Array(2 * indices.length);
  for (let k = 0; k < indices.length; k += 3) {
    const [a, b, c] = [indices[k], indices[k + 1], indices[k + 2]];
    edges.set([a, b, b, c, c, a], 2 * k);
  }
  return edges;
}

const actions = {
  async open({ name, file }) {
    const wish = ++wishes;
    const opened = file ? await (await library).open(name, file, { ignoreTrims: true }) : (await library).read(name);
    if (wish !== wishes) { // one that was asked for later, and took less time, is there
      opened.free();
      return {};
    }
    set?.free();
    set = opened;
    const { size, box, openEdges, ignoredTrims } = set;
    return { size, box, openEdges, ignoredTrims };
  },
  mesh({ relative, edges, colours }) {
    const mesh = set.tessellate({ relative, weld: !colours, copy: true });
    const { vertices, indices, deviation, vertexCount, triangleCount } = mesh;
    return {
      vertices, indices, deviation, vertexCount, triangleCount, relative, tolerance: relative * set.diagonal,
      edges: edges ? edgesOf(indices) : undefined,
      colours: colours ? coloursOf(mesh, relative * set.diagonal) : undefined,
    };
  },
  file: ({ format, relative }) => ({ bytes: set.file(format, { relative }) }),
};

addEventListener('message', async ({ data: { id, what, ...rest } }) => {
  try {
    const answer = await actions[what](rest);
    const buffers = Object.values(answer).filter(ArrayBuffer.isView).map((array) => array.buffer);
    postMessage({ id, ...answer }, buffers);
  } catch (error) {
    postMessage({ id, error: error.message });
  }
});
