/**
 * How many operations the core executes for a sample, by their kinds: counted, in a copy of the module in which each of them
 * also counts itself. In Node alone: the module is the same everywhere.
 *
 * @module
 */

import { readFileSync } from 'node:fs';
import { opened, parsed } from '../scripts/modules.mjs';
import { watchInstance } from './instance.js';
import { inText, nodesOf } from './text.js';

/**
 * @typedef {(typeof OPERATIONS)[number]} Operation
 * @typedef {Record<Operation, number>} Operations two lanes are one operation, and so is a single number, which takes as long
 *
 * @typedef {{ classes: import('../www/types.d.ts').Motion, counted: () => Operations }} Counting
 */

/**
 * Sums, differences and products; quotients and roots; comparisons, choices, conversions and all that moves lanes; loads and
 * stores; all of whole numbers; branches that may be taken or not.
 */
export const OPERATIONS = /** @type {const} */ (['arithmetic', 'divisions', 'choices', 'memory', 'whole', 'branches']);

const isBranch = (/** @type {string} */ name) => ['if', 'br_if', 'br_table'].includes(name);

/**
 * @param {string} name of an instruction
 * @returns {Operation | undefined}
 */
function operationOf(name) {
  if (isBranch(name)) return 'branches';
  if (name === 'select') return 'choices';
  const [type, what] = name.split('.');
  if (!/^([if]\d+|v128)/.test(type) || what === 'const') return undefined;
  if (/^(load|store)/.test(what)) return 'memory';
  if (/^i\d/.test(type) && what !== 'shuffle' && !/lane|splat/.test(what)) return 'whole';
  if (/^(add|sub|mul)$/.test(what)) return 'arithmetic';
  return /^(div|sqrt)$/.test(what) ? 'divisions' : 'choices';
}

/**
 * @param {string} name of an instruction
 * @returns {string | undefined} the type of what it gives
 */
function resultOf(name) {
  const [type, what] = name.split('.');
  const lanes = /x\d+$/.test(type);
  if (/^store/.test(what)) return undefined;
  if (/^(any_true|all_true|bitmask)$/.test(what)) return 'i32';
  if (/^extract_lane/.test(what)) return /^[if]64/.test(type) ? type.slice(0, 3) : type.startsWith('f') ? 'f32' : 'i32';
  if (lanes) return 'v128';
  return /^(eq|eqz|ne|[lg][te](_[su])?)$/.test(what) ? 'i32' : type;
}

/**
 * @param {Operation} operation
 * @param {string | undefined} type
 * @param {import('./text.js').Node} expression
 * @returns {import('./text.js').Node} the expression, which counts itself before
 */
function counting(operation, type, expression) {
  const global = `$counted.${operation}`;
  const count = ['global.set', global, ['f64.add', ['global.get', global], ['f64.const', '1']]];
  return ['block', ...(type ? [['result', type]] : []), count, expression];
}

/**
 * @param {import('./text.js').Node} node
 * @returns {import('./text.js').Node}
 */
function counted(node) {
  if (typeof node === 'string') return node;
  const [name] = node;
  const children = node.map(counted);
  const operation = typeof name === 'string' ? operationOf(name) : undefined;
  if (typeof name !== 'string' || operation === undefined) return children;
  if (name !== 'select' && !isBranch(name)) return counting(operation, resultOf(name), children);
  // What these give is of any type, but they decide by a number.
  const first = children.findIndex((child, i) => i > 0 && typeof child !== 'string' && child[0] !== 'result');
  const at = name === 'if' ? first : children.length - 1;
  return children.with(at, counting(operation, 'i32', children[at]));
}

/**
 * @param {string} text of a module
 * @returns {Promise<Uint8Array>} the module that counts what it executes
 */
async function countingModule(text) {
  const globals = OPERATIONS.map((name) => `(global $counted.${name} (export "counted.${name}") (mut f64) (f64.const 0))`);
  return binaryOf(await parsed(inText(counted(nodesOf(text))).replace(/\)\s*$/, `${globals.join('\n')})`)));
}

/** @param {Awaited<ReturnType<typeof parsed>>} module */
function binaryOf(module) {
  const bytes = module.emitBinary();
  module.dispose();
  return bytes;
}

const countsIn = (/** @type {WebAssembly.Exports} */ exports) =>
  eachOperation((name) => /** @type {WebAssembly.Global} */ (exports[`counted.${name}`]).value);

/** @returns {Promise<Counting>} the core, and what it has executed so far */
export async function countingCore() {
  const module = await opened('build/motion.wasm');
  const text = module.emitText();
  module.dispose();
  const bytes = await countingModule(text);
  const { default: glue } = await import(new URL('../build/motion.js', import.meta.url).href);
  const { result, exports } = await watchInstance(() => glue(new WebAssembly.Module(/** @type {BufferSource} */ (bytes))));
  return { classes: result, counted: () => countsIn(exports) };
}

const textOfKernels = () => readFileSync(new URL('roofline.wat', import.meta.url), 'utf8');

/** @returns {Promise<Uint8Array>} the module of roofline.wat */
export async function kernels() {
  return binaryOf(await parsed(textOfKernels()));
}

/**
 * @param {string} kernel of roofline.wat
 * @returns {Promise<Operations>} of one turn
 */
export async function operationsOfTurn(kernel) {
  const bytes = /** @type {BufferSource} */ (await countingModule(textOfKernels()));
  const { exports } = new WebAssembly.Instance(new WebAssembly.Module(bytes));
  const run = /** @type {(turns: number) => void} */ (exports[kernel]);
  run(1);
  const one = countsIn(exports);
  run(2);
  const three = countsIn(exports);
  return eachOperation((name) => three[name] - 2 * one[name]);
}

/**
 * @param {(name: Operation) => number} countOf
 * @returns {Operations}
 */
function eachOperation(countOf) {
  return /** @type {Operations} */ (Object.fromEntries(OPERATIONS.map((name) => [name, countOf(name)])));
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
    return eachOperation((name) => after[name] - before[name]);
  });
  return eachOperation((name) => (many[name] - few[name]) / samples);
}
