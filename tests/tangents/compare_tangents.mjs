// compare_tangents.mjs CORNERS.json: whether tangents at corners of triangles are those of MikkTSpace: one degree apart in the
// mean at most, with the same handedness.
//
// Exit code 0 where they are, 1 where they aren't, 77 where the npm package `mikktspace` isn't installed (`npm ci` in this
// folder installs it).
import { readFile } from 'node:fs/promises';
import path from 'node:path';

const MOST_DEGREES = 1;

async function loadMikktspace() {
  try {
    return (await import('mikktspace')).default;
  } catch {
    const folder = path.dirname(new URL(import.meta.url).pathname);
    console.log(`SKIPPED: mikktspace is not installed; run "npm ci" in ${folder}`);
    process.exit(77);
  }
}

const mikktspace = await loadMikktspace();
const { positions, normals, texcoords, tangents } = JSON.parse(await readFile(process.argv[2], 'utf8'));
const theirs = mikktspace.generateTangents(new Float32Array(positions), new Float32Array(normals), new Float32Array(texcoords));
let sum = 0;
let most = 0;
let turned = 0;
const corners = theirs.length / 4;
for (let i = 0; i < theirs.length; i += 4) {
  const dot = theirs[i] * tangents[i] + theirs[i + 1] * tangents[i + 1] + theirs[i + 2] * tangents[i + 2];
  const degrees = (Math.acos(Math.min(1, Math.max(-1, dot))) * 180) / Math.PI;
  sum += degrees;
  most = Math.max(most, degrees);
  // Its v runs up, glTF's down.
  if (-theirs[i + 3] !== tangents[i + 3]) ++turned;
}
console.log(`${corners} corners: ${(sum / corners).toFixed(4)} degrees in the mean, ${most.toFixed(2)} at most, ${turned} of the other hand`);
process.exit(corners > 0 && sum / corners <= MOST_DEGREES && turned === 0 ? 0 : 1);
