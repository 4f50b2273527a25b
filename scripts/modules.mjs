// WebAssembly modules as binaryen has them.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { ROOT } from './process.mjs';

/**
 * @param {string} path of a module
 * @returns {Promise<import('binaryen').default.Module>} to be disposed of
 */
export async function opened(path) {
  const { default: binaryen } = await import('binaryen');
  return withFeatures(binaryen, binaryen.readBinary(readFileSync(join(ROOT, path))));
}

/**
 * @param {string} text of a module
 * @returns {Promise<import('binaryen').default.Module>} to be disposed of
 */
export async function parsed(text) {
  const { default: binaryen } = await import('binaryen');
  return withFeatures(binaryen, binaryen.parseText(text));
}

/**
 * @param {typeof import('binaryen').default} binaryen
 * @param {import('binaryen').default.Module} module
 */
function withFeatures({ Features }, module) {
  const { BulkMemory, Multivalue, MutableGlobals, NontrappingFPToInt, ReferenceTypes, SignExt, SIMD128 } = Features;
  module.setFeatures(BulkMemory | Multivalue | MutableGlobals | NontrappingFPToInt | ReferenceTypes | SignExt | SIMD128);
  return module;
}
