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

// The budget of a page with one widget. What else a page may load is held where it is, rounded up to a kilobyte: see "The
// size of the module" in doc/implementation-notes.md.
test('what a page loads does not grow', () => {
  const loaded = loadedByWidgets();
  for (const [tag, paths] of Object.entries(loaded)) within(tag, paths, 110_000);
  const all = [...new Set(Object.values(loaded).flat())];
  within('scripts of all widgets', all.filter((path) => path.endsWith('.js')), 61_000);
  for (const path of all.filter((path) => path.endsWith('.wasm'))) within('module of a widget', [path], 54_000);
  within('module', ['dist/motion.wasm'], 76_000);
  within('bundle', ['dist/motion-widgets.js'], 150_000);
  within('classic script', ['dist/motion-widgets.iife.js'], 151_000);
});

test('doc/implementation-notes.md says what each library costs, to a kilobyte', () => {
  const notes = readFileSync(new URL('../../doc/implementation-notes.md', import.meta.url), 'utf8');
  const said = [...notes.matchAll(/^\| (\S+) \| .* \| (\d+) kB \|$/gm)].map(([, name, size]) => [name, Number(size)]);
  const measured = Object.entries(libraries()).map(([name, bytes]) => [name, Math.round(bytes / 1000)]);
  assert.deepEqual(said.sort(), measured.sort());
});
