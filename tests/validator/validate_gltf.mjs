// validate_gltf.mjs [--ignore=CODE...] FILE_OR_FOLDER...: runs Khronos' validator over glTF files (of folders, every .glb
// and .gltf in them), and leaves out messages of those codes.
//
// Exit code 0 where none has an error or a warning, 1 where one has, 77 where the validator isn't installed
// (`npm ci` in this folder installs it). Infos and hints are counted, not forbidden: the validator gives one for every
// extension that it doesn't know, such as MSFT_lod.
import { readFile, readdir, stat } from 'node:fs/promises';
import path from 'node:path';

const SEVERITIES = ['error', 'warning'];
const MOST_MESSAGES = 10;

async function loadValidator() {
  try {
    return (await import('gltf-validator')).default;
  } catch {
    const folder = path.dirname(new URL(import.meta.url).pathname);
    console.log(`SKIPPED: Khronos' glTF validator is not installed; run "npm ci" in ${folder}`);
    process.exit(77);
  }
}

async function filesAt(place) {
  if (!(await stat(place)).isDirectory()) return [place];
  return (await readdir(place))
    .filter((name) => /\.(glb|gltf)$/.test(name))
    .sort()
    .map((name) => path.join(place, name));
}

/** Prints what the validator says about one file; true where it is clean. */
async function validate(validator, file, ignoredIssues) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: path.basename(file),
    maxIssues: 0,
    ignoredIssues,
    externalResourceFunction: async (uri) =>
      new Uint8Array(await readFile(path.resolve(path.dirname(file), decodeURIComponent(uri)))),
  });
  const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints`);
  const grave = messages.filter(({ severity }) => severity <= 1);
  for (const message of grave.slice(0, MOST_MESSAGES)) {
    console.log(`  ${SEVERITIES[message.severity]} ${message.code} at ${message.pointer ?? message.offset}: ${message.message}`);
  }
  return numErrors === 0 && numWarnings === 0;
}

const words = process.argv.slice(2);
const ignored = words.filter((word) => word.startsWith('--ignore=')).map((word) => word.slice('--ignore='.length));
const places = words.filter((word) => !word.startsWith('--ignore='));
if (places.length === 0) {
  console.error('usage: node validate_gltf.mjs FILE_OR_FOLDER...');
  process.exit(2);
}
const validator = await loadValidator();
const files = (await Promise.all(places.map(filesAt))).flat();
if (files.length === 0) {
  console.error(`no .glb or .gltf in ${places.join(', ')}`);
  process.exit(1);
}
let clean = true;
for (const file of files) clean = (await validate(validator, file, ignored)) && clean;
process.exit(clean ? 0 : 1);
