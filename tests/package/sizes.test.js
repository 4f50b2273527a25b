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

// Budgets by brotli are 110 000 bytes for a page with one widget, 50 000 for the scripts of all widgets, 60 000 for the
// module, and 130 000 for each bundle with everything inside. What is reached is held instead, rounded up to a kilobyte:
// see "The size of the module" in doc/implementation-notes.md.
test('what a page loads does not grow', () => {
  const loaded = loadedByWidgets();
  for (const [tag, paths] of Object.entries(loaded)) within(tag, paths, 123_000);
  const scripts = new Set(Object.values(loaded).flat().filter((path) => path.endsWith('.js')));
  within('scripts of all widgets', [...scripts], 60_000);
  within('module', ['dist/motion.wasm'], 77_000);
  within('bundle', ['dist/motion-widgets.js'], 148_000);
  within('classic script', ['dist/motion-widgets.iife.js'], 150_000);
});

test('doc/implementation-notes.md says what each library costs, to a kilobyte', () => {
  const notes = readFileSync(new URL('../../doc/implementation-notes.md', import.meta.url), 'utf8');
  const said = [...notes.matchAll(/^\| (\S+) \| .* \| (\d+) kB \|$/gm)].map(([, name, size]) => [name, Number(size)]);
  const measured = Object.entries(libraries()).map(([name, bytes]) => [name, Math.round(bytes / 1000)]);
  assert.deepEqual(said.sort(), measured.sort());
});
