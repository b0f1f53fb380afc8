// measure_seams.mjs SOURCE.glb ASSET.glb MAP.png [--views N] [--most-seam RATIO] [--most-mean DIFFERENCE] [--true]: draws both
// with three.js in Chromium, smooth where they have no normals. MAP.png is one of the asset's baked maps, which says how its atlas is laid out. Prints as JSON
//
//   seam   how much more neighbouring pixels differ across borders of patches than beside them, each in proportion to the
//          source's own differences there: 1 where borders aren't to be seen
//   means  the mean difference of a channel to the source, of 255, at 1, 3 and 10 times the distance, where mips are drawn
//   errors with --true: how far the source's picture, and the asset's, are from one with 64 looks at the source a pixel, which
//          no mip decides: mips of the source's own texture are wrong from afar, too
//
// Exit code 0, 1 where something is more than asked for, 77 where Chromium or a package is missing (`npm ci` in this folder installs it).
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import path from 'node:path';

const here = path.dirname(new URL(import.meta.url).pathname);
const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';

function skip(reason) {
  console.log(`SKIPPED: ${reason}; run "npm ci" in ${here}, and install Debian's chromium`);
  process.exit(77);
}

async function loadPuppeteer() {
  if (!existsSync(chromium)) skip('there is no Chromium');
  if (!existsSync(path.join(here, 'node_modules/three'))) skip('three.js is not installed');
  try {
    return (await import('puppeteer-core')).default;
  } catch {
    return skip('puppeteer-core is not installed');
  }
}

/** What the description in a baked map says of its tiles. */
async function layoutIn(map) {
  const bytes = await readFile(map);
  const text = /lozenge \S+ columns=[^\0]*?tiles0=[^\0]*/.exec(bytes.toString('latin1'))[0];
  const field = (name) => Number(new RegExp(` ${name}=(\\d+)`).exec(text)?.[1] ?? 0);
  const tiles = [];
  for (let k = 0; new RegExp(` tiles${k}=`).test(text); ++k) tiles.push(field(`tiles${k}`));
  return { width: bytes.readUInt32BE(16) * field('shrink'), tile: field('tile'), columns: field('columns'), tiles };
}

function serve(files) {
  const kinds = { '.html': 'text/html', '.js': 'text/javascript' };
  const server = createServer(async (request, response) => {
    const place = decodeURIComponent(new URL(request.url, 'http://x').pathname);
    const asset = /^\/asset(\d)\/$/.exec(place);
    const file = asset ? files[asset[1]] : path.join(here, path.normalize(place));
    try {
      const bytes = await readFile(file);
      response.writeHead(200, { 'content-type': kinds[path.extname(file)] ?? 'application/octet-stream' });
      response.end(bytes);
    } catch {
      response.writeHead(404);
      response.end();
    }
  });
  return new Promise((done) => server.listen(0, '127.0.0.1', () => done(server)));
}

const files = [];
const asked = { views: 12, 'most-seam': Infinity, 'most-mean': Infinity, true: false };
for (let words = process.argv.slice(2); words.length > 0;) {
  const word = words.shift();
  if (word === '--true') asked.true = true;
  else if (word.startsWith('--') && word.slice(2) in asked) asked[word.slice(2)] = Number(words.shift());
  else files.push(path.resolve(word));
}
if (files.length !== 3) {
  console.error('usage: measure_seams.mjs SOURCE.glb ASSET.glb MAP.png [--views N] [--most-seam RATIO] [--most-mean DIFFERENCE] [--true]');
  process.exit(2);
}
const puppeteer = await loadPuppeteer();
const server = await serve(files);
const browser = await puppeteer.launch({
  executablePath: chromium, headless: true, protocolTimeout: 600000,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });
try {
  const page = await browser.newPage();
  page.on('pageerror', (error) => console.error(error.message));
  await page.goto(`http://127.0.0.1:${server.address().port}/seams.html`);
  await page.waitForFunction(() => document.title === 'ready', { timeout: 120000 });
  const found = await page.evaluate((what) => window.measure(what), {
    distances: [1, 3, 10], views: asked.views, layout: await layoutIn(files[2]), finely: asked.true });
  const { border, inside, means, errors } = found;
  const seam = border.asset / border.source / (inside.asset / inside.source);
  console.log(JSON.stringify({
    seam: +seam.toFixed(4),
    across: [border.source, border.asset].map((sum) => +(sum / border.count).toFixed(3)),
    beside: [inside.source, inside.asset].map((sum) => +(sum / inside.count).toFixed(3)),
    pairs: [border.count, inside.count],
    means: Object.fromEntries(Object.entries(means).map(([distance, mean]) => [distance, +mean.toFixed(3)])),
    ...(asked.true && { errors: Object.fromEntries(Object.entries(errors).map(([distance, of]) =>
      [distance, { source: +of[0].toFixed(3), asset: +of[1].toFixed(3) }])) }) }));
  const worst = Math.max(...Object.values(means));
  if (!(seam <= asked['most-seam']) || !(worst <= asked['most-mean']) || !(border.count > 0)) process.exitCode = 1;
} finally {
  await browser.close();
  server.close();
}
