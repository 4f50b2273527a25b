// Bytes that a page loads before the widgets on it are used.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { brotliCompressSync, constants } from 'node:zlib';
import { ROOT } from '../../scripts/process.mjs';
import { settings } from '../../www/settings.js';

const at = (/** @type {string} */ path) => join(ROOT, path);

/** Output of esbuild on each product, by its path from the root. @type {Record<string, { entryPoint?: string, imports: { path: string, kind: string }[] }>} */
const outputs = JSON.parse(readFileSync(at('build/outputs.json'), 'utf8'));

/** Returns a module with its static imports, which a browser loads with it, and without dynamic imports. @param {string} path */
function loadedWith(path) {
  const found = new Set([path]);
  for (const each of found) {
    for (const { path: imported, kind } of outputs[each].imports) if (kind === 'import-statement') found.add(imported);
  }
  return [...found];
}

/** Returns the chunk of external.js that a source begins, and what a browser loads with it. @param {string} source */
function chunk(source) {
  const found = Object.entries(outputs).find(([product, { entryPoint }]) => entryPoint === source && product.startsWith('dist/chunks/'));
  assert.ok(found, `external.js has no chunk of ${source}.`);
  return loadedWith(found[0]);
}

/** Returns the scripts that a page with some widgets loads before anyone touches them. @param {string[]} tags @param {string} core */
const scriptsOf = (tags, core) =>
  [...new Set([...loadedWith('dist/external.js'), ...tags.flatMap((tag) => chunk(`www/widgets/${tag}/${tag}.ts`)), ...chunk(`build/${core}.js`)])];

/** Returns the module of a widget. @param {string} tag */
function moduleOf(tag) {
  const found = readdirSync(at('dist/chunks')).find((name) => name.startsWith(`${tag}-`) && name.endsWith('.wasm'));
  assert.ok(found, `dist/chunks has no module for ${tag}.`);
  return `dist/chunks/${found}`;
}

/** Tests that files are small, by brotli at its best. @param {string} name @param {string[]} paths @param {number} limit bytes */
function within(name, paths, limit) {
  const best = { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } };
  const bytes = paths.reduce((sum, path) => sum + brotliCompressSync(readFileSync(at(path)), best).length, 0);
  console.log(`${name}: ${bytes} of ${limit} bytes`);
  assert.ok(bytes <= limit, `${name}: ${paths.join(' + ')} are ${bytes} bytes by brotli; allowed are ${limit}`);
}

/**
 * Kilobytes: the budget of a page with one widget, and what else is loaded, held where it is and rounded up. See "The size of
 * the module" in doc/implementation-notes.md.
 */
const LIMITS = {
  page: 118, moduleOfWidget: 56, pageOfCalibrator: 158, moduleOfCalibrator: 90, module: 220, classicScript: 440, notebook: 444,
};

/** Widget whose module also has all of motion::calibrate. */
const CALIBRATOR = 'alpha-calibrator';

test('what a page loads does not grow', () => {
  const tags = Object.keys(settings);
  for (const tag of tags) {
    const [page, module] = tag === CALIBRATOR ? [LIMITS.pageOfCalibrator, LIMITS.moduleOfCalibrator] : [LIMITS.page, LIMITS.moduleOfWidget];
    within(tag, [...scriptsOf([tag], tag), moduleOf(tag)], 1000 * page);
    within(`module of ${tag}`, [moduleOf(tag)], 1000 * module);
  }
  within('scripts of all widgets', scriptsOf(tags, 'motion'), 125_000);
  within('module', ['dist/motion.wasm'], 1000 * LIMITS.module);
  within('module for notebooks', ['dist/anywidget.js'], 1000 * LIMITS.notebook);
  within('classic script', ['dist/motion-widgets.iife.js'], 1000 * LIMITS.classicScript);
});

test('doc/embedding.md says these limits', () => {
  const document = readFileSync(new URL('../../doc/embedding.md', import.meta.url), 'utf8');
  const said = document.slice(document.indexOf('## Sizes')).match(/(?<=^\|.*)\d+(?= kB)/gm);
  assert.deepEqual(said?.map(Number), Object.values(LIMITS));
});
