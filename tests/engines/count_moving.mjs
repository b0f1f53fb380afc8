// count_moving.mjs SOURCE.glb ASSET.glb: loads both into Babylon.js (its NullEngine draws nothing) and compares what moves them:
// bones of each skeleton by name, animations by name with their channels, skinned meshes by skeleton, morph targets by name.
//
// Exit code 0 where the asset has all that its source has, 1 where not, 77 where Babylon.js isn't installed
// (`npm ci` in this folder installs it).
import { readFile } from 'node:fs/promises';
import path from 'node:path';

async function loadBabylon() {
  try {
    // Loaders take pictures and timers from the browser; nothing is drawn here.
    globalThis.self ??= globalThis;
    const BABYLON = (await import('babylonjs')).default;
    globalThis.BABYLON = BABYLON;
    await import('babylonjs-loaders');
    return BABYLON;
  } catch (error) {
    const folder = path.dirname(new URL(import.meta.url).pathname);
    console.log(`SKIPPED: Babylon.js is not installed (${error.code ?? error.message}); run "npm ci" in ${folder}`);
    process.exit(77);
  }
}

/** The GLB without pictures, which this engine has no use for. */
function withoutPictures(bytes) {
  const length = bytes.readUInt32LE(12);
  const document = JSON.parse(bytes.subarray(20, 20 + length).toString());
  for (const key of ['images', 'textures', 'materials', 'samplers']) delete document[key];
  for (const mesh of document.meshes ?? []) for (const primitive of mesh.primitives) delete primitive.material;
  const unneeded = new Set(['EXT_texture_webp', 'KHR_texture_transform', 'KHR_materials_emissive_strength']);
  for (const key of ['extensionsUsed', 'extensionsRequired']) {
    if (document[key]) document[key] = document[key].filter((name) => !unneeded.has(name) && !/^KHR_materials/.test(name));
  }
  let text = JSON.stringify(document);
  text += ' '.repeat((4 - (Buffer.byteLength(text) % 4)) % 4);
  const json = Buffer.from(text);
  const rest = bytes.subarray(20 + length);
  const head = Buffer.from(bytes.subarray(0, 20));
  head.writeUInt32LE(20 + json.length + rest.length, 8);
  head.writeUInt32LE(json.length, 12);
  return Buffer.concat([head, json, rest]);
}

async function movingThingsOf(BABYLON, file) {
  const engine = new BABYLON.NullEngine();
  const scene = new BABYLON.Scene(engine);
  const data = withoutPictures(await readFile(file)).toString('base64');
  await BABYLON.SceneLoader.AppendAsync('', `data:model/gltf-binary;base64,${data}`, scene, undefined, '.glb');
  const targets = new Map();
  for (const mesh of scene.meshes) {
    const manager = mesh.morphTargetManager;
    for (let t = 0; manager && t < manager.numTargets; ++t) {
      const target = manager.getTarget(t);
      targets.set(`${mesh.parent?.name ?? ''} ${target.name}`, true);
    }
  }
  const found = {
    skins: scene.skeletons.length,
    bones: scene.skeletons.map((skeleton) => skeleton.bones.map((bone) => bone.name).sort()),
    animations: scene.animationGroups.map((group) => group.name),
    channels: scene.animationGroups.map(
      (group) => new Set(group.targetedAnimations.map(({ target, animation }) => `${target.name} ${animation.targetProperty}`)).size),
    skinned: new Set(scene.meshes.filter((mesh) => mesh.skeleton).map((mesh) => mesh.skeleton.name)).size,
    targets: targets.size,
  };
  engine.dispose();
  return found;
}

const [source, asset] = process.argv.slice(2);
if (!source || !asset) {
  console.error('usage: count_moving.mjs SOURCE.glb ASSET.glb');
  process.exit(2);
}
const BABYLON = await loadBabylon();
BABYLON.Logger.LogLevels = BABYLON.Logger.ErrorLogLevel;
const before = await movingThingsOf(BABYLON, source);
const after = await movingThingsOf(BABYLON, asset);
let same = true;
for (const key of Object.keys(before)) {
  const fits = JSON.stringify(before[key]) === JSON.stringify(after[key]);
  const shown = (value) => (Array.isArray(value) ? `${value.length}: ${JSON.stringify(value).slice(0, 100)}` : value);
  console.log(`${fits ? 'same     ' : 'DIFFERENT'} ${key}: ${shown(before[key])}${fits ? '' : ` and ${shown(after[key])}`}`);
  same &&= fits;
}
process.exit(same ? 0 : 1);
