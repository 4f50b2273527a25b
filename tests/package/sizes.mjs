// Weight of the products over the wire, for tests/package/sizes.nightly.test.js.

import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, constants } from 'node:zlib';
import { settings } from '../../www/settings.js';
import { ROOT } from '../../scripts/process.mjs';

const at = (/** @type {string} */ path) => join(ROOT, path);

/** @typedef {{ entryPoint?: string, imports: { path: string, kind: string }[], inputs: Record<string, { bytesInOutput: number }> }} Output */

/** @returns {Record<string, Output>} what esbuild says of each product, by its path from the root */
const outputs = () => JSON.parse(readFileSync(at('build/outputs.json'), 'utf8'));

/**
 * @param {string} path from the root
 * @returns {number} bytes by brotli at its best, as content delivery networks keep files
 */
export function compressed(path) {
  return brotliCompressSync(readFileSync(at(path)), { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } }).length;
}

/**
 * @param {string} path of a product that is a module, from the root
 * @returns {string[]} it and what a browser loads with it; not what it imports when it is needed
 */
function loadedWith(path) {
  const all = outputs();
  const found = new Set([path]);
  for (const each of found) {
    for (const { path: imported, kind } of all[each].imports) if (kind === 'import-statement') found.add(imported);
  }
  return [...found];
}

/** @param {string} source @returns {string[]} the chunk of external.js that a source begins, and what a browser loads with it */
function chunk(source) {
  const found = Object.entries(outputs()).find(([product, { entryPoint }]) => entryPoint === source && product.startsWith('dist/chunks/'));
  if (!found) throw new Error(`external.js has no chunk of ${source}.`);
  return loadedWith(found[0]);
}

const element = (/** @type {string} */ tag) => chunk(`www/widgets/${tag}/${tag}.ts`);
const glue = (/** @type {string} */ name) => chunk(`build/${name}.js`);

/**
 * @returns {Record<string, string[]>} by the tag of each widget, what a page with that one loads by external.js before
 *   anyone touches it: scripts, and its module
 */
export function loadedByWidgets() {
  const module = (/** @type {string} */ tag) => {
    const found = readdirSync(at('dist/chunks')).find((name) => name.startsWith(`${tag}-`) && name.endsWith('.wasm'));
    if (!found) throw new Error(`dist/chunks has no module for ${tag}.`);
    return `dist/chunks/${found}`;
  };
  const paths = (/** @type {string} */ tag) => [...new Set([...loadedWith('dist/external.js'), ...element(tag), ...glue(tag), module(tag)])];
  return Object.fromEntries(Object.keys(settings).map((tag) => [tag, paths(tag)]));
}

/** @returns {string[]} what a page with all widgets loads: scripts, and the whole module */
export function loadedByAll() {
  return [...new Set([...loadedWith('dist/external.js'), ...Object.keys(settings).flatMap(element), ...glue('motion'), 'dist/motion.wasm'])];
}
