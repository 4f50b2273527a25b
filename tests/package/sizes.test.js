// What a page with both widgets loads before anyone touches them.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { compressed, libraries, loadedWith } from '../../scripts/sizes.mjs';

/**
 * @param {string} name
 * @param {string[]} paths
 * @param {number} budget bytes by brotli
 */
function within(name, paths, budget) {
  const bytes = paths.reduce((sum, path) => sum + compressed(path), 0);
  console.log(`${name}: ${bytes} of ${budget} bytes`);
  assert.ok(bytes <= budget, `${name}: ${paths.join(' + ')} are ${bytes} bytes by brotli; allowed are ${budget}`);
}

test('the WebAssembly module is within its budget', () => {
  within('module', ['dist/motion.wasm'], 60_000);
});

test('scripts and styles are within theirs', () => {
  within('scripts', loadedWith('dist/external.js'), 50_000);
});

test('the bundle with everything inside is within its own, in each of its forms', () => {
  within('bundle', ['dist/motion-widgets.js'], 130_000);
  within('classic script', ['dist/motion-widgets.iife.js'], 130_000);
});

test('doc/implementation-notes.md says what each library costs, to a kilobyte', () => {
  const notes = readFileSync(new URL('../../doc/implementation-notes.md', import.meta.url), 'utf8');
  const said = [...notes.matchAll(/^\| (\S+) \| .* \| (\d+) kB \|$/gm)].map(([, name, size]) => [name, Number(size)]);
  const measured = Object.entries(libraries()).map(([name, bytes]) => [name, Math.round(bytes / 1000)]);
  assert.deepEqual(said.sort(), measured.sort());
});
