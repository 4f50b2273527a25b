// What a page loads before anyone touches the widgets on it.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { brotliCompressSync } from 'node:zlib';
import { ROOT } from '../../scripts/process.mjs';
import { compressed, libraries, loadedByAll, loadedByWidgets } from '../../scripts/sizes.mjs';

/**
 * @param {string} name
 * @param {string[]} paths
 * @param {number} limit bytes by brotli
 */
function within(name, paths, limit) {
  const bytes = paths.reduce((sum, path) => sum + compressed(path), 0);
  console.log(`${name}: ${bytes} of ${limit} bytes`);
  assert.ok(bytes <= limit, `${name}: ${paths.join(' + ')} are ${bytes} bytes by brotli; allowed are ${limit}`);
}

/**
 * Kilobytes: the budget of a page with one widget, and what else is loaded, held where it is and rounded up. See "The size of
 * the module" in doc/implementation-notes.md.
 */
const LIMITS = {
  page: 113, moduleOfWidget: 56, pageOfCalibrator: 147, moduleOfCalibrator: 86, module: 212, bundle: 388, classicScript: 396, notebook: 399,
};

/** What it carries that the others do not is all of motion::calibrate. */
const CALIBRATOR = 'alpha-calibrator';

test('what a page loads does not grow', () => {
  const loaded = loadedByWidgets();
  for (const [tag, paths] of Object.entries(loaded)) {
    const [page, module] = tag === CALIBRATOR ? [LIMITS.pageOfCalibrator, LIMITS.moduleOfCalibrator] : [LIMITS.page, LIMITS.moduleOfWidget];
    within(tag, paths, 1000 * page);
    within(`module of ${tag}`, paths.filter((path) => path.endsWith('.wasm')), 1000 * module);
  }
  within('scripts of all widgets', loadedByAll().filter((path) => path.endsWith('.js')), 117_000);
  within('module', ['dist/motion.wasm'], 1000 * LIMITS.module);
  within('bundle', ['dist/motion-widgets.js'], 1000 * LIMITS.bundle);
  within('module for notebooks', ['dist/anywidget.js'], 1000 * LIMITS.notebook);
  within('classic script', ['dist/motion-widgets.iife.js'], 1000 * LIMITS.classicScript);
});

test('inlined, the module is a few hundredths longer, where base64 would be three tenths longer: so says doc/embedding.md', () => {
  const module = compressed('dist/motion.wasm');
  const [text] = readFileSync(join(ROOT, 'dist/motion-widgets.js'), 'utf8').match(/(?<=")[^"]{100000,}(?=")/) ?? [''];
  const base64 = readFileSync(join(ROOT, 'dist/motion.wasm')).toString('base64');
  const [inlined, coded] = [text, base64].map((each) => brotliCompressSync(each).length / module);
  assert.ok(inlined > 1.02 && inlined < 1.1, `${inlined}`);
  assert.ok(coded > 1.25 && coded < 1.35, `${coded}`);
});

test('doc/embedding.md says these limits', () => {
  const document = readFileSync(new URL('../../doc/embedding.md', import.meta.url), 'utf8');
  const said = document.slice(document.indexOf('## What it weighs')).match(/(?<=^\|.*)\d+(?= kB)/gm);
  assert.deepEqual(said?.map(Number), Object.values(LIMITS));
});

test('doc/implementation-notes.md says what each library costs, to a kilobyte', () => {
  const notes = readFileSync(new URL('../../doc/implementation-notes.md', import.meta.url), 'utf8');
  const said = [...notes.matchAll(/^\| (\S+) \| .* \| (\d+) kB \|$/gm)].map(([, name, size]) => [name, Number(size)]);
  const measured = Object.entries(libraries()).map(([name, bytes]) => [name, Math.round(bytes / 1000)]);
  assert.deepEqual(said.sort(), measured.sort());
});
