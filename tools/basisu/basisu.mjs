// basisu.mjs NAME.glb: makes NAME.basisu.glb of an asset that `lozenge build --ktx2` wrote; `build --texture-format basisu` calls it.
// Textures of which NAME.PART.ktx2 lies beside it become UASTC (KHR_texture_basisu), each of the file's levels encoded alone, so that mips stay
// those that were filtered on the surface; other textures stay as they are. `basisu.mjs --check` says whether all that it needs is there.
//
// Exit code 0, 1 where something is wrong with the files, 77 where the npm packages aren't installed: in this folder (`npm ci`), in one of
// NODE_PATH, or for all (`npm install --global`).
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import zlib from 'node:zlib';

const SRGB_FORMAT = 43; // VK_FORMAT_R8G8B8A8_SRGB
const UASTC = 166; // KHR_DF_MODEL_UASTC
const ZSTANDARD = 2;

/** What a package's "exports" are for those who import it on node. */
function entryOf(exported) {
  if (typeof exported === 'string' || !exported) return exported;
  const condition = ['.', 'node', 'import', 'default'].find((each) => each in exported);
  return condition && entryOf(exported[condition]);
}

/** Imports a package, wherever it is installed. Node itself looks for modules of this kind above the importing file alone. */
async function load(name) {
  const folders = [
    path.join(path.dirname(fileURLToPath(import.meta.url)), 'node_modules'),
    ...(process.env.NODE_PATH ?? '').split(path.delimiter).filter(Boolean),
    path.join(path.dirname(process.execPath), '../lib/node_modules'),
    '/usr/local/lib/node_modules',
  ];
  const folder = folders.map((each) => path.join(each, name)).find((each) => existsSync(path.join(each, 'package.json')));
  if (!folder) throw Object.assign(new Error(`${name} is in none of ${folders.join(', ')}`), { code: 'missing' });
  const description = JSON.parse(readFileSync(path.join(folder, 'package.json'), 'utf8'));
  return import(pathToFileURL(path.join(folder, entryOf(description.exports) ?? description.main)).href);
}

async function loadPackages() {
  try {
    const [{ encodeToKTX2 }, { read, write }] = await Promise.all([load('ktx2-encoder'), load('ktx-parse')]);
    if (!zlib.zstdDecompressSync) execFileSync('zstd', ['--version']);
    return { encodeToKTX2, read, write };
  } catch (error) {
    const what = error.code === 'ENOENT' ? 'this node and no command zstd can read Zstandard' : error.message;
    console.error(`SKIPPED: ktx2-encoder and ktx-parse of npm can't be used: ${what}`);
    process.exit(77);
  }
}

/** Node has Zstandard from 22.15 on; older ones ask the command. */
function unzstd(bytes) {
  if (zlib.zstdDecompressSync) return new Uint8Array(zlib.zstdDecompressSync(bytes));
  return new Uint8Array(execFileSync('zstd', ['-dc'], { input: bytes, maxBuffer: 1 << 30 }));
}

/** Four channels of 8 bits of a level, whatever the file has. */
function rgba(texture, level) {
  const raw = unzstd(texture.levels[level].levelData);
  const [channels, size] = { 9: [1, 1], 37: [4, 1], 43: [4, 1], 91: [4, 2] }[texture.vkFormat];
  const out = new Uint8Array((raw.length / channels / size) * 4);
  for (let texel = 0; 4 * texel < out.length; ++texel) {
    for (let c = 0; c < 4; ++c) {
      // The high byte of 16 bits; one channel stands for three.
      const from = (texel * channels + (channels === 1 ? 0 : c)) * size + size - 1;
      out[4 * texel + c] = channels === 1 && c === 3 ? 255 : raw[from];
    }
  }
  return out;
}

async function encoded({ encodeToKTX2, read, write }, bytes) {
  const texture = read(new Uint8Array(bytes));
  const srgb = texture.vkFormat === SRGB_FORMAT;
  const levels = [];
  let made = null;
  for (let level = 0; level < texture.levels.length; ++level) {
    const side = (of) => Math.max(of >> level, 1);
    const picture = { data: rgba(texture, level), width: side(texture.pixelWidth), height: side(texture.pixelHeight) };
    const alone = read(await encodeToKTX2(new Uint8Array([0]), {
      isUASTC: true, uastcLDRQualityLevel: 2, generateMipmap: false, needSupercompression: false, isPerceptual: srgb,
      isSetKTX2SRGBTransferFunc: srgb, imageDecoder: async () => picture }));
    if (alone.levels.length !== 1 || alone.dataFormatDescriptor[0].colorModel !== UASTC) throw new Error('the encoder gave no UASTC');
    made ??= alone;
    levels.push(alone.levels[0]);
  }
  if (made.supercompressionScheme === ZSTANDARD && levels.some((level) => level.levelData.length === 0)) throw new Error('empty level');
  made.levels = levels;
  made.levelCount = levels.length;
  // glTF wants no primaries where there are no colours.
  made.dataFormatDescriptor[0].colorPrimaries = srgb ? 1 : 0;
  made.keyValue = { KTXorientation: 'rd', KTXwriter: 'lozenge' };
  return write(made);
}

function parseGlb(bytes) {
  if (bytes.toString('latin1', 0, 4) !== 'glTF') throw new Error('it is no GLB');
  const length = bytes.readUInt32LE(12);
  return { document: JSON.parse(bytes.toString('utf8', 20, 20 + length)), binary: bytes.subarray(20 + length + 8) };
}

/** Lays out all views anew, some with other bytes. */
function withBytes(document, binary, replaced) {
  const parts = [];
  let size = 0;
  const append = (bytes) => {
    const at = size;
    const padding = (8 - (bytes.length % 8)) % 8;
    parts.push(bytes, Buffer.alloc(padding));
    size += bytes.length + padding;
    return at;
  };
  for (const [number, view] of document.bufferViews.entries()) {
    // What a compressed view decompresses to has no bytes; the compressed ones are its extension's.
    const slice = view.extensions?.EXT_meshopt_compression ?? view;
    if (slice.buffer !== 0) continue;
    const from = slice.byteOffset ?? 0;
    const bytes = replaced.get(number) ?? binary.subarray(from, from + slice.byteLength);
    slice.byteOffset = append(Buffer.from(bytes));
    slice.byteLength = bytes.length;
  }
  document.buffers[0].byteLength = size;
  return Buffer.concat(parts);
}

function glbOf(document, binary) {
  const text = Buffer.from(JSON.stringify(document));
  const json = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, ' ')]);
  const head = Buffer.alloc(20);
  head.write('glTF', 0, 'latin1');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(28 + json.length + binary.length, 8);
  head.writeUInt32LE(json.length, 12);
  head.write('JSON', 16, 'latin1');
  const behind = Buffer.alloc(8);
  behind.writeUInt32LE(binary.length, 0);
  behind.write('BIN\0', 4, 'latin1');
  return Buffer.concat([head, json, behind, binary]);
}

const [asset] = process.argv.slice(2);
if (asset !== '--check' && !asset?.endsWith('.glb')) {
  console.error('usage: basisu.mjs NAME.glb | --check');
  process.exit(2);
}
const packages = await loadPackages();
if (asset === '--check') process.exit(0);
console.log = () => {}; // the encoder tells of each block
const { document, binary } = parseGlb(readFileSync(asset));
const stem = asset.slice(0, -'.glb'.length);
const replaced = new Map();
let count = 0;
for (const texture of document.textures ?? []) {
  const file = `${stem}.${texture.name}.ktx2`;
  const image = document.images[texture.source];
  if (!texture.name || !existsSync(file) || image?.bufferView === undefined) continue;
  if (!replaced.has(image.bufferView)) replaced.set(image.bufferView, await encoded(packages, readFileSync(file)));
  image.mimeType = 'image/ktx2';
  texture.extensions = { ...texture.extensions, KHR_texture_basisu: { source: texture.source } };
  delete texture.source;
  ++count;
}
if (count === 0) {
  console.error(`${asset}: no texture's .ktx2 lies beside it; build it with --ktx2`);
  process.exit(1);
}
for (const key of ['extensionsUsed', 'extensionsRequired']) {
  document[key] = [...new Set([...(document[key] ?? []), 'KHR_texture_basisu'])].sort();
}
const made = glbOf(document, withBytes(document, binary, replaced));
writeFileSync(`${stem}.basisu.glb.part`, made);
renameSync(`${stem}.basisu.glb.part`, `${stem}.basisu.glb`);
process.stdout.write(`${stem}.basisu.glb: ${count} textures, ${made.length} bytes\n`);
