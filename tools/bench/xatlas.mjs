// xatlas.mjs IN.glb OUT.glb: unwraps a GLB of one primitive (as mesh_to_glb writes) with xatlas, by the npm package `xatlas-web`, and
// prints the seconds that charting, parameterization and packing took. The package must be found from the folder where this is run
// (`npm install xatlas-web` in a scratch folder); it has xatlas's default options, and indices of 16 bits.
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';

const [input, output] = process.argv.slice(2);
if (!output) {
  console.error('usage: node xatlas.mjs IN.glb OUT.glb');
  process.exit(2);
}

async function loadXatlas() {
  const require = createRequire(path.join(process.cwd(), 'x.js'));
  const file = require.resolve('xatlas-web');
  // Built for browsers: what it asks of one is a window, and a document that it then doesn't look at.
  globalThis.window = globalThis;
  globalThis.document = { currentScript: null };
  const wasmBinary = await readFile(path.join(path.dirname(file), 'xatlas-web.wasm'));
  return new Promise((resolve) => {
    const module = require(file)({ wasmBinary, print: () => {}, onRuntimeInitialized: () => resolve({ module }) });
  });
}

/** Positions and indices of the only primitive. */
async function readGlb(file) {
  const bytes = await readFile(file);
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + length).toString());
  const binary = bytes.subarray(28 + length);
  const primitive = json.meshes[0].primitives[0];
  const view = (accessor) => {
    const { bufferView, byteOffset = 0 } = json.accessors[accessor];
    return binary.subarray((json.bufferViews[bufferView].byteOffset ?? 0) + byteOffset);
  };
  const positions = new Float32Array(json.accessors[primitive.attributes.POSITION].count * 3);
  const vertices = view(primitive.attributes.POSITION);
  for (let i = 0; i < positions.length; ++i) positions[i] = vertices.readFloatLE(4 * i);
  const { count, componentType } = json.accessors[primitive.indices];
  const corners = view(primitive.indices);
  const indices = new Uint32Array(count);
  for (let i = 0; i < count; ++i) indices[i] = componentType === 5123 ? corners.readUInt16LE(2 * i) : corners.readUInt32LE(4 * i);
  return { positions, indices };
}

/** One vertex for each position: xatlas charts what hangs together by indices. */
function welded({ positions, indices }) {
  const known = new Map();
  const kept = [];
  const number = [];
  for (let v = 0; v < positions.length / 3; ++v) {
    const key = `${positions[3 * v]} ${positions[3 * v + 1]} ${positions[3 * v + 2]}`;
    if (!known.has(key)) {
      known.set(key, kept.length / 3);
      kept.push(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
    }
    number.push(known.get(key));
  }
  return { positions: new Float32Array(kept), indices: indices.map((i) => number[i]) };
}

function glb(positions, uvs, indices) {
  const parts = [positions, uvs, indices].map((array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength));
  const binary = Buffer.concat(parts);
  let offset = 0;
  const bufferViews = parts.map((part) => ({ buffer: 0, byteOffset: (offset += part.length) - part.length, byteLength: part.length }));
  const low = [0, 1, 2].map((c) => positions.reduce((least, x, i) => (i % 3 === c ? Math.min(least, x) : least), Infinity));
  const high = [0, 1, 2].map((c) => positions.reduce((most, x, i) => (i % 3 === c ? Math.max(most, x) : most), -Infinity));
  const document = {
    asset: { version: '2.0', generator: 'xatlas' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: positions.length / 3, type: 'VEC3', min: low, max: high },
      { bufferView: 1, componentType: 5126, count: uvs.length / 2, type: 'VEC2' },
      { bufferView: 2, componentType: 5125, count: indices.length, type: 'SCALAR' },
    ],
    bufferViews,
    buffers: [{ byteLength: binary.length }],
  };
  let text = JSON.stringify(document);
  text += ' '.repeat((4 - (text.length % 4)) % 4);
  const head = Buffer.alloc(20);
  [0x46546c67, 2, 28 + text.length + binary.length, text.length, 0x4e4f534a].forEach((word, i) => head.writeUInt32LE(word, 4 * i));
  const middle = Buffer.alloc(8);
  middle.writeUInt32LE(binary.length, 0);
  middle.writeUInt32LE(0x004e4942, 4);
  return Buffer.concat([head, Buffer.from(text), middle, binary]);
}

const { module } = await loadXatlas();
const mesh = welded(await readGlb(input));
if (mesh.positions.length / 3 > 65535) {
  console.error(`${input}: has more vertices than this build of xatlas has numbers for`);
  process.exit(3);
}
module.createAtlas();
const info = module.createMesh(mesh.positions.length / 3, mesh.indices.length, false, false);
module.HEAPU16.set(mesh.indices, info.indexOffset / 2);
module.HEAPF32.set(mesh.positions, info.positionOffset / 4);
const start = performance.now();
module.addMesh();
module.generateAtlas();
const seconds = (performance.now() - start) / 1000;
const data = module.getMeshData(info.meshId);
const original = new Uint32Array(module.HEAPU32.buffer, data.originalIndexOffset, data.newVertexCount).slice();
const uvs = new Float32Array(module.HEAPF32.buffer, data.uvOffset, 2 * data.newVertexCount).slice();
const indices = new Uint32Array(module.HEAPU32.buffer, data.indexOffset, data.newIndexCount).slice();
const positions = new Float32Array(3 * data.newVertexCount);
original.forEach((from, to) => positions.set(mesh.positions.subarray(3 * from, 3 * from + 3), 3 * to));
await writeFile(output, glb(positions, uvs, indices));
console.log(JSON.stringify({ seconds }));
