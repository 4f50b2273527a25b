// The file that has everything inside, shortened once more by what a site's own build uses.

import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { rspack } from '@rspack/core';
import { minify as terser } from 'terser';
import { ROOT } from '../../scripts/process.mjs';

const path = join(ROOT, 'dist/motion-widgets.js');
const script = readFileSync(path, 'utf8');

/** @type {string} */
let directory;
before(() => void (directory = mkdtempSync(join(tmpdir(), 'motion-widgets-'))));
after(() => rmSync(directory, { recursive: true, force: true }));

/** @param {string} address of a script that has the core inside */
async function firstPoses(address) {
  const { load } = await import(address);
  const { BananaMachine } = await load();
  return new BananaMachine({ samples: 100, seed: 1 }).poses;
}

/** @type {Record<string, (options: { output: string }) => Promise<string | undefined>>} */
const MINIMIZERS = {
  terser: async () => (await terser(script, { module: true })).code,
  // It minifies by SWC, and rewrites what the script imports and names.
  async Rspack({ output }) {
    const entry = { mode: 'production', context: ROOT, entry: path, devtool: false, target: ['web', 'es2020'] };
    const library = { library: { type: 'module' }, path: output, filename: 'bundle.js' };
    const stats = await new Promise((resolve, reject) => {
      const done = (/** @type {unknown} */ error, /** @type {unknown} */ result) => (error ? reject(error) : resolve(result));
      rspack(/** @type {any} */ ({ ...entry, output: { module: true, ...library }, experiments: { outputModule: true } }), /** @type {any} */ (done));
    });
    assert.deepEqual(stats.toJson({ all: false, errors: true }).errors, []);
    return readFileSync(join(output, 'bundle.js'), 'utf8');
  },
};

for (const [name, minimize] of Object.entries(MINIMIZERS)) {
  test(`${name} leaves the module as it is`, async () => {
    const short = await minimize({ output: directory });
    assert.ok(short);
    const copy = join(directory, `${name}.mjs`);
    writeFileSync(copy, short);
    assert.deepEqual(await firstPoses(pathToFileURL(copy).href), await firstPoses(pathToFileURL(path).href));
  });
}

test('the classic script is ASCII: it means the same, whatever encoding its page has', () => {
  const bytes = readFileSync(join(ROOT, 'dist/motion-widgets.iife.js'));
  assert.equal(bytes.find((byte) => byte > 127), undefined);
});
