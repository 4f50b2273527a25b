// Sizes of the files that a page loads before a user uses its widgets.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { brotliCompressSync, constants } from 'node:zlib';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { settings } from '../../build/settings.js';

const pathOf = (/** @type {string} */ repositoryPath) => join(REPOSITORY_ROOT, repositoryPath);

/** Report of esbuild on each written file, by the path from the root. @type {Record<string, { entryPoint?: string, imports: { path: string, kind: string }[] }>} */
const esbuildOutputs = JSON.parse(readFileSync(pathOf('build/outputs.json'), 'utf8'));

/** Returns the paths of a module and of its static imports, which a browser loads together. Dynamic imports are left out. @param {string} filePath */
function loadedFilesOf(filePath) {
  const loadedPaths = new Set([filePath]);
  for (const loadedPath of loadedPaths) {
    for (const { path: importedPath, kind: importKind } of esbuildOutputs[loadedPath].imports) if (importKind === 'import-statement') loadedPaths.add(importedPath);
  }
  return [...loadedPaths];
}

/** Returns the files that a browser loads with a chunk of external.js. The entry point of the chunk is a source file. @param {string} sourcePath */
function chunkFilesOf(sourcePath) {
  const chunkEntry = Object.entries(esbuildOutputs).find(([outputPath, { entryPoint }]) => entryPoint === sourcePath && outputPath.startsWith('dist/chunks/'));
  assert.ok(chunkEntry, `external.js has no chunk of ${sourcePath}.`);
  return loadedFilesOf(chunkEntry[0]);
}

/** Returns the scripts that a page with some widgets loads before a user uses them. @param {string[]} widgetTags @param {string} coreEntry */
const scriptsOf = (widgetTags, coreEntry) =>
  [...new Set([...loadedFilesOf('dist/external.js'), ...widgetTags.flatMap((widgetTag) => chunkFilesOf(`www/widgets/${widgetTag}/${widgetTag}.ts`)), ...chunkFilesOf(`build/${coreEntry}.js`)])];

/** Returns the path of the WebAssembly module of a widget. @param {string} widgetTag */
function modulePathOf(widgetTag) {
  const fileName = readdirSync(pathOf('dist/chunks')).find((wasmName) => wasmName.startsWith(`${widgetTag}-`) && wasmName.endsWith('.wasm'));
  assert.ok(fileName, `dist/chunks has no module for ${widgetTag}.`);
  return `dist/chunks/${fileName}`;
}

/** Asserts that files compressed by brotli are within a limit. @param {string} pageLoadName @param {string[]} filePaths @param {number} maxBytes */
function assertSize(pageLoadName, filePaths, maxBytes) {
  const brotliOptions = { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } };
  const compressedBytes = filePaths.reduce((byteSum, filePath) => byteSum + brotliCompressSync(readFileSync(pathOf(filePath)), brotliOptions).length, 0);
  console.log(`${pageLoadName}: ${compressedBytes} of ${maxBytes} bytes`);
  assert.ok(compressedBytes <= maxBytes, `${pageLoadName}: ${filePaths.join(' + ')} are ${compressedBytes} bytes by brotli; allowed are ${maxBytes}`);
}

/**
 * Limits in kilobytes. The budget of a page with one widget is fixed. The other limits are the present sizes, rounded up. See "The size of
 * the module" in doc/implementation-notes.md.
 */
const LIMITS_KB = {
  page: 118, moduleOfWidget: 56, pageOfCalibrator: 154, moduleOfCalibrator: 92, module: 223, classicScript: 434, notebook: 437,
};

/** Widget whose module also contains all of motion::calibrate. */
const CALIBRATOR_TAG = 'alpha-calibrator';

test('the files that a page loads stay within their size limits', () => {
  const widgetTags = Object.keys(settings);
  for (const widgetTag of widgetTags) {
    const [pageLimit, moduleLimit] = widgetTag === CALIBRATOR_TAG ? [LIMITS_KB.pageOfCalibrator, LIMITS_KB.moduleOfCalibrator] : [LIMITS_KB.page, LIMITS_KB.moduleOfWidget];
    assertSize(widgetTag, [...scriptsOf([widgetTag], widgetTag), modulePathOf(widgetTag)], 1000 * pageLimit);
    assertSize(`module of ${widgetTag}`, [modulePathOf(widgetTag)], 1000 * moduleLimit);
  }
  assertSize('scripts of all widgets', scriptsOf(widgetTags, 'motion'), 125_000);
  assertSize('module', ['dist/motion.wasm'], 1000 * LIMITS_KB.module);
  assertSize('module for notebooks', ['dist/anywidget.js'], 1000 * LIMITS_KB.notebook);
  assertSize('classic script', ['dist/motion-widgets.iife.js'], 1000 * LIMITS_KB.classicScript);
});

test('doc/embedding.md states the size limits', () => {
  const embeddingDocument = readFileSync(new URL('../../doc/embedding.md', import.meta.url), 'utf8');
  const statedLimits = embeddingDocument.slice(embeddingDocument.indexOf('## Sizes')).match(/(?<=^\|.*)\d+(?= kB)/gm);
  assert.deepEqual(statedLimits?.map(Number), Object.values(LIMITS_KB));
});
