// What the products weigh over the wire, and which library how much of it: `node scripts/sizes.mjs` prints both.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, constants } from 'node:zlib';
import { ROOT, runAsScript } from './process.mjs';

const at = (/** @type {string} */ path) => join(ROOT, path);

/** @typedef {{ imports: { path: string, kind: string }[], inputs: Record<string, { bytesInOutput: number }> }} Output */

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
export function loadedWith(path) {
  const all = outputs();
  const found = new Set([path]);
  for (const each of found) {
    for (const { path: imported, kind } of all[each].imports) if (kind === 'import-statement') found.add(imported);
  }
  return [...found];
}

/** @returns {Record<string, number>} minified bytes of each library in external.js and its chunks */
export function libraries() {
  /** @type {Record<string, number>} */
  const bytes = {};
  for (const [product, { inputs }] of Object.entries(outputs())) {
    if (!/^dist\/(external|chunks\/.+)\.js$/.test(product)) continue;
    for (const [path, { bytesInOutput }] of Object.entries(inputs)) {
      const name = path.match(/node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1];
      // Lit comes in four packages.
      const library = name && /^(lit|@lit\/)/.test(name) ? 'lit' : name;
      if (library) bytes[library] = (bytes[library] ?? 0) + bytesInOutput;
    }
  }
  return bytes;
}

await runAsScript(import.meta.url, async () => {
  const scripts = loadedWith('dist/external.js');
  const rows = ['dist/motion.wasm', ...scripts, 'dist/motion-widgets.js', 'dist/motion-widgets.iife.js', 'dist/core.js'];
  for (const path of rows) console.log(`${path.padEnd(30)} ${(compressed(path) / 1000).toFixed(1).padStart(6)} kB`);
  for (const [name, bytes] of Object.entries(libraries())) {
    console.log(`${name.padEnd(30)} ${(bytes / 1000).toFixed(1).padStart(6)} kB minified`);
  }
});
