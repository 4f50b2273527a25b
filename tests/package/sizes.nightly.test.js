// Bytes that a page loads before the widgets on it are used.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { compressed, loadedByAll, loadedByWidgets } from './sizes.mjs';

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
  page: 118, moduleOfWidget: 56, pageOfCalibrator: 160, moduleOfCalibrator: 92, module: 224, classicScript: 444, notebook: 448,
};

/** Widget whose module also has all of motion::calibrate. */
const CALIBRATOR = 'alpha-calibrator';

test('what a page loads does not grow', () => {
  const loaded = loadedByWidgets();
  for (const [tag, paths] of Object.entries(loaded)) {
    const [page, module] = tag === CALIBRATOR ? [LIMITS.pageOfCalibrator, LIMITS.moduleOfCalibrator] : [LIMITS.page, LIMITS.moduleOfWidget];
    within(tag, paths, 1000 * page);
    within(`module of ${tag}`, paths.filter((path) => path.endsWith('.wasm')), 1000 * module);
  }
  within('scripts of all widgets', loadedByAll().filter((path) => path.endsWith('.js')), 126_000);
  within('module', ['dist/motion.wasm'], 1000 * LIMITS.module);
  within('module for notebooks', ['dist/anywidget.js'], 1000 * LIMITS.notebook);
  within('classic script', ['dist/motion-widgets.iife.js'], 1000 * LIMITS.classicScript);
});

test('doc/embedding.md says these limits', () => {
  const document = readFileSync(new URL('../../doc/embedding.md', import.meta.url), 'utf8');
  const said = document.slice(document.indexOf('## Sizes')).match(/(?<=^\|.*)\d+(?= kB)/gm);
  assert.deepEqual(said?.map(Number), Object.values(LIMITS));
});
