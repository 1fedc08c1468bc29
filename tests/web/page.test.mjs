// The page of examples/web and the bits of the module, in Debian's Chromium. Skipped where that is not installed.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { cpSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { validateBytes } from 'gltf-validator';
import { Chromium, CHROMIUM } from './chromium.mjs';

const { SIMDBEZIER_SOURCE: source, SIMDBEZIER_PICTURES: pictures } = process.env;
const skip = CHROMIUM ? false : 'chromium is not installed';
const downloads = mkdtempSync(join(tmpdir(), 'simdbezier-downloads-'));
let server, address, browser;

async function serve(folder) {
  const server = spawn(process.execPath, [join(source, 'web/serve.mjs'), folder, '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  return [server, await new Promise((resolve) => server.stdout.once('data', (text) => resolve(String(text).trim())))];
}
before(async () => {
  if (skip) return;
  [server, address] = await serve('../site');
  browser = await Chromium.start();
});
after(async () => {
  await browser?.stop();
  server?.kill();
  rmSync(downloads, { recursive: true, force: true });
});

const text = (id) => browser.evaluate(`document.getElementById('${id}').textContent`);
const settled = () => browser.until('globalThis.page?.idle === true');
const drop = (name, bytes) => browser.evaluate(`(() => {
  const data = new DataTransfer();
  data.items.add(new File([${JSON.stringify(bytes)}], ${JSON.stringify(name)}));
  dispatchEvent(new DragEvent('drop', { cancelable: true, dataTransfer: data }));
})()`);
const slide = (value) => browser.evaluate(`(() => {
  const slider = document.getElementById('tolerance');
  slider.value = ${value};
  slider.dispatchEvent(new Event('input', { bubbles: true }));
})()`);
async function look(name, width = 1100, height = 700) {
  await browser.call('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: width < 500 });
  await new Promise((resolve) => setTimeout(resolve, 1000));
  if (pictures) writeFileSync(join(pictures, name), await browser.screenshot());
}

test('the page shows the teapot, and meshes follow the slider', { skip }, async () => {
  await browser.call('Emulation.setDeviceMetricsOverride', { width: 1100, height: 700, deviceScaleFactor: 1, mobile: false });
  await browser.call('Page.navigate', { url: address });
  await settled();
  assert.match(await text('model'), /^builtin:teapot: 32 patches/);
  let before = 0;
  for (let k = 0; k < 10; k++) {
    await slide(-1.5 - 0.3 * k);
    await settled();
    const { triangles } = await browser.evaluate('page.last');
    assert.ok(triangles > before, `${triangles} after ${before}`);
    assert.match(await text('numbers'), new RegExp(`^${triangles} triangles`));
    before = triangles;
  }
  await slide(-3);
  await settled();
  await look('teapot.png');
  await browser.evaluate(`document.getElementById('colours').click()`);
  await settled();
  await look('colours.png');
});

test('dropped files are shown, and broken ones are a message', { skip }, async () => {
  await drop('sample.rib', readFileSync(join(source, 'tests/data/sample.rib'), 'latin1'));
  await browser.until(`document.getElementById('model').textContent.startsWith('sample.rib')`);
  await settled();
  const model = await text('model');
  await drop('broken.rib', 'Patch "bicubic" "P" [0 0 0 1');
  await browser.until(`!document.getElementById('problem').hidden`);
  assert.match(await text('problem'), /^broken\.rib:1: expected /);
  assert.equal(await text('model'), model); // what was there stays
  await look('broken.png');
});

const bez = (x) => ['1', ...Array.from({ length: 16 }, (_, k) => `${x + k % 4} ${x + Math.floor(k / 4)} ${k % 3}`)].join('\n');

test('the file that was dropped last is shown, however long others take', { skip }, async () => {
  for (const slow of [bez(5), '1']) { // a model, and a broken one
    await browser.evaluate(`(() => {
      const drop = (name, ...parts) => {
        const data = new DataTransfer();
        data.items.add(new File(parts, name));
        dispatchEvent(new DragEvent('drop', { cancelable: true, dataTransfer: data }));
      };
      drop('slow.bez', ${JSON.stringify(slow)}, ' '.repeat(5e7));
      drop('last.bez', ${JSON.stringify(bez(0))});
    })()`);
    await settled();
    assert.match(await text('model'), /^last\.bez: 1 patches/);
    assert.equal(await browser.evaluate(`document.getElementById('problem').hidden`), true);
    assert.match(await text('numbers'), new RegExp(`^${await browser.evaluate('page.last.triangles')} triangles`));
  }
});

test('a model without a mesh does not show that of the model before', { skip }, async () => {
  await drop('far.bez', bez(1e9));
  await browser.until(`document.getElementById('model').textContent.startsWith('far')`);
  await settled();
  assert.match(await text('problem'), /^--relative: expected a distance above the error of rounding/);
  assert.equal(await text('numbers'), '');
  assert.equal(await browser.evaluate('page.last === undefined'), true);
  await drop('near.bez', bez(0));
  await browser.until(`document.getElementById('model').textContent.startsWith('near')`);
  await settled();
  assert.match(await text('numbers'), /^\d+ triangles/);
});

test('a downloaded GLB is valid', { skip }, async () => {
  await browser.call('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: downloads });
  await browser.evaluate(`document.getElementById('teapot').click()`);
  await browser.until(`document.getElementById('model').textContent.startsWith('builtin')`);
  await settled();
  await browser.evaluate(`document.getElementById('save').click()`);
  const end = Date.now() + 30000;
  while (!readdirSync(downloads).includes('mesh.glb') && Date.now() < end) await new Promise((resolve) => setTimeout(resolve, 100));
  const bytes = new Uint8Array(readFileSync(join(downloads, 'mesh.glb')));
  const { issues } = await validateBytes(bytes);
  assert.deepEqual([issues.numErrors, issues.numWarnings], [0, 0]);
});

test('keys reach everything, and the page fits a phone', { skip }, async () => {
  const reached = [];
  for (let k = 0; k < 9; k++) {
    for (const type of ['keyDown', 'keyUp']) await browser.call('Input.dispatchKeyEvent', { type, key: 'Tab', code: 'Tab', windowsVirtualKeyCode: 9 });
    reached.push(await browser.evaluate('document.activeElement.id'));
  }
  for (const id of ['view', 'file', 'teapot', 'save', 'tolerance', 'edges', 'colours', 'up']) assert.ok(reached.includes(id), `${id} in ${reached}`);
  await look('phone.png', 390, 800);
  assert.equal(await browser.evaluate('document.documentElement.scrollWidth <= innerWidth'), true);
  const { width, height } = await browser.evaluate(`(({ width, height }) => ({ width, height }))(document.getElementById('view').getBoundingClientRect())`);
  assert.ok(width === 390 && height > 300, `${width} x ${height}`);
});

test('bits in the browser are those of Node', { skip }, async () => {
  const { runCommand } = await import('./wasi_command.mjs');
  const bits = readFileSync('../web/web_bits.wasm');
  const here = await runCommand(await WebAssembly.compile(bits));
  const script = readFileSync('wasi_command.mjs', 'utf8').replace('export async', 'async');
  await browser.evaluate(`globalThis.bits = ''`);
  const encoded = bits.toString('base64');
  for (let k = 0; k < encoded.length; k += 1 << 20) await browser.evaluate(`void (bits += '${encoded.slice(k, k + (1 << 20))}')`);
  const there = await browser.evaluate(`(async () => {
    ${script}
    return runCommand(await WebAssembly.compile(Uint8Array.from(atob(bits), (c) => c.charCodeAt(0))));
  })()`);
  assert.equal(here.code, 0);
  assert.ok(here.text.length > 0);
  assert.deepEqual(there, here);
});

test('nothing was written to the console', { skip }, () => assert.deepEqual(browser.messages, []));

for (const missing of ['worker.js', 'simdbezier/library.js', 'simdbezier/simdbezier.wasm']) {
  test(`without ${missing}, the page says so`, { skip }, async () => {
    const folder = mkdtempSync(join(tmpdir(), 'simdbezier-site-'));
    cpSync('../site', folder, { recursive: true });
    rmSync(join(folder, missing));
    const [other, there] = await serve(folder);
    try {
      await browser.call('Page.navigate', { url: there });
      await browser.until(`document.getElementById('problem')?.hidden === false`, 10);
      assert.match(await text('problem'), /could not be loaded|expected an answer, found status 404/);
      assert.equal(await text('model'), 'No model');
    } finally {
      other.kill();
      rmSync(folder, { recursive: true });
    }
  });
}
