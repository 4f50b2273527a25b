/**
 * How many operations of floating point the core executes for a sample: counted, in a copy of the module in which each of
 * them also counts itself. In Node alone: the module is the same everywhere.
 *
 * @module
 */

import { readFileSync } from 'node:fs';
import { opened, parsed } from '../scripts/modules.mjs';
import { watchInstance } from './instance.js';

/**
 * @typedef {{ arithmetic: number, divisions: number }} Operations sums, differences and products; quotients and roots. Two
 *   lanes are one operation, and so is a single number, which takes as long
 */

const KINDS = { arithmetic: ['add', 'sub', 'mul'], divisions: ['div', 'sqrt'] };

/** @typedef {{ classes: import('../www/types.d.ts').Motion, counted: () => Operations }} Counting */

/** @returns {Promise<Counting>} the core, and what it has executed so far */
export async function countingCore() {
  const module = await opened('build/motion.wasm');
  const text = module.emitText();
  module.dispose();
  /** @type {string[]} */
  const counters = [];
  let changed = text;
  for (const [kind, names] of Object.entries(KINDS)) {
    counters.push(`(global $${kind} (export "${kind}") (mut f64) (f64.const 0))`);
    for (const [type, value] of [['f64', 'f64'], ['f64x2', 'v128']]) {
      for (const name of names) {
        const operation = `${type}.${name}`;
        const places = name === 'sqrt' ? [0] : [0, 1];
        changed = changed.replaceAll(`(${operation}\n`, `(call $counted.${operation}\n`);
        counters.push(
          `(func $counted.${operation} ${places.map(() => `(param ${value})`).join(' ')} (result ${value})
            (global.set $${kind} (f64.add (global.get $${kind}) (f64.const 1)))
            (${operation} ${places.map((place) => `(local.get ${place})`).join(' ')}))`,
        );
      }
    }
  }
  const counting = await parsed(changed.replace(/\)\s*$/, `${counters.join('\n')})`));
  const bytes = counting.emitBinary();
  counting.dispose();
  const { default: glue } = await import(new URL('../build/motion.js', import.meta.url).href);
  const { result, exports } = await watchInstance(() => glue(new WebAssembly.Module(/** @type {BufferSource} */ (bytes))));
  const valueOf = (/** @type {string} */ kind) => /** @type {WebAssembly.Global} */ (exports[kind]).value;
  return { classes: result, counted: () => ({ arithmetic: valueOf('arithmetic'), divisions: valueOf('divisions') }) };
}

/** @returns {Promise<Uint8Array>} the module of roofline.wat */
export async function kernels() {
  const module = await parsed(readFileSync(new URL('roofline.wat', import.meta.url), 'utf8'));
  const bytes = module.emitBinary();
  module.dispose();
  return bytes;
}

/**
 * Of one sample: what twice as many cost more, so that what is done once a cloud does not count.
 *
 * @param {Counting} core
 * @param {(typeof import('./roofline.js').KINDS)[number]} kind
 * @param {number} samples
 * @returns {Operations}
 */
export function operationsOf({ classes, counted }, { make, event }, samples) {
  const [few, many] = [samples, 2 * samples].map((count) => {
    const machine = make(classes, count);
    const before = counted();
    event(machine, 1);
    const after = counted();
    machine.free();
    return { arithmetic: after.arithmetic - before.arithmetic, divisions: after.divisions - before.divisions };
  });
  return { arithmetic: (many.arithmetic - few.arithmetic) / samples, divisions: (many.divisions - few.divisions) / samples };
}
