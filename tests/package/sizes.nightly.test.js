// Sizes of the files that a page loads before a user uses its widgets.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { brotliCompressSync, constants } from 'node:zlib';
import { ROOT } from '../../scripts/process.mjs';
import { settings } from '../../build/settings.js';

const pathOf = (/** @type {string} */ path) => join(ROOT, path);

/** Report of esbuild on each file that it has written, by the file's path from the root. @type {Record<string, { entryPoint?: string, imports: { path: string, kind: string }[] }>} */
const esbuildOutputs = JSON.parse(readFileSync(pathOf('build/outputs.json'), 'utf8'));

/** Returns a module with its static imports, which a browser loads with it, and without dynamic imports. @param {string} path */
function filesLoadedWith(path) {
  const loadedPaths = new Set([path]);
  for (const loadedPath of loadedPaths) {
    for (const { path: imported, kind } of esbuildOutputs[loadedPath].imports) if (kind === 'import-statement') loadedPaths.add(imported);
  }
  return [...loadedPaths];
}

/** Returns the chunk of external.js whose entry point is a source file, and what a browser loads with it. @param {string} source */
function filesOfChunk(source) {
  const chunkEntry = Object.entries(esbuildOutputs).find(([product, { entryPoint }]) => entryPoint === source && product.startsWith('dist/chunks/'));
  assert.ok(chunkEntry, `external.js has no chunk of ${source}.`);
  return filesLoadedWith(chunkEntry[0]);
}

/** Returns the scripts that a page with some widgets loads before a user uses them. @param {string[]} widgetTags @param {string} core */
const scriptsOf = (widgetTags, core) =>
  [...new Set([...filesLoadedWith('dist/external.js'), ...widgetTags.flatMap((tag) => filesOfChunk(`www/widgets/${tag}/${tag}.ts`)), ...filesOfChunk(`build/${core}.js`)])];

/** Returns the path of the WebAssembly module of a widget. @param {string} tag */
function modulePathOf(tag) {
  const fileName = readdirSync(pathOf('dist/chunks')).find((name) => name.startsWith(`${tag}-`) && name.endsWith('.wasm'));
  assert.ok(fileName, `dist/chunks has no module for ${tag}.`);
  return `dist/chunks/${fileName}`;
}

/** Asserts that files compressed by brotli are within a limit. @param {string} name @param {string[]} paths @param {number} limit bytes */
function assertSize(name, paths, limit) {
  const brotliOptions = { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } };
  const compressedBytes = paths.reduce((sum, path) => sum + brotliCompressSync(readFileSync(pathOf(path)), brotliOptions).length, 0);
  console.log(`${name}: ${compressedBytes} of ${limit} bytes`);
  assert.ok(compressedBytes <= limit, `${name}: ${paths.join(' + ')} are ${compressedBytes} bytes by brotli; allowed are ${limit}`);
}

/**
 * Limits in kilobytes: the budget of a page with one widget, and the present sizes of other files, rounded up. See "The size of
 * the module" in doc/implementation-notes.md.
 */
const LIMITS_KB = {
  page: 118, moduleOfWidget: 56, pageOfCalibrator: 159, moduleOfCalibrator: 93, module: 225, classicScript: 438, notebook: 441,
};

/** Widget whose module also has all of motion::calibrate. */
const CALIBRATOR_TAG = 'alpha-calibrator';

test('what a page loads does not grow', () => {
  const widgetTags = Object.keys(settings);
  for (const tag of widgetTags) {
    const [pageLimit, moduleLimit] = tag === CALIBRATOR_TAG ? [LIMITS_KB.pageOfCalibrator, LIMITS_KB.moduleOfCalibrator] : [LIMITS_KB.page, LIMITS_KB.moduleOfWidget];
    assertSize(tag, [...scriptsOf([tag], tag), modulePathOf(tag)], 1000 * pageLimit);
    assertSize(`module of ${tag}`, [modulePathOf(tag)], 1000 * moduleLimit);
  }
  assertSize('scripts of all widgets', scriptsOf(widgetTags, 'motion'), 125_000);
  assertSize('module', ['dist/motion.wasm'], 1000 * LIMITS_KB.module);
  assertSize('module for notebooks', ['dist/anywidget.js'], 1000 * LIMITS_KB.notebook);
  assertSize('classic script', ['dist/motion-widgets.iife.js'], 1000 * LIMITS_KB.classicScript);
});

test('doc/embedding.md says these limits', () => {
  const embeddingDocument = readFileSync(new URL('../../doc/embedding.md', import.meta.url), 'utf8');
  const statedLimits = embeddingDocument.slice(embeddingDocument.indexOf('## Sizes')).match(/(?<=^\|.*)\d+(?= kB)/gm);
  assert.deepEqual(statedLimits?.map(Number), Object.values(LIMITS_KB));
});
