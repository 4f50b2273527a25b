/**
 * Loads the WebAssembly core, once a page or process. The only file that touches generated glue.
 * Importing it runs nothing: no DOM, no network, no compilation before `load()`.
 *
 * @module
 */

import initialize, { BananaMachine, MapSqueeze, commandReaching, randomSeed } from '../build/motion.js';
import inlined from '../build/motion_bg.wasm';

/** @type {Promise<import('./types.d.ts').Motion> | undefined} */
let loading;

/**
 * The core, ready to use. The first call that succeeds decides where the module comes from; later
 * calls get the same module, and a call after a failed one tries again.
 *
 * `source` is the module as bytes, an address, or compiled; the bytes that this file carries when it
 * is left out.
 *
 * @type {typeof import('./types.d.ts').load}
 */
export function load(source) {
  loading ??= start(source).catch((error) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

/**
 * @param {BufferSource | URL | string | WebAssembly.Module} [source]
 * @returns {Promise<import('./types.d.ts').Motion>}
 */
async function start(source) {
  if (typeof WebAssembly === 'undefined') {
    throw new Error('WebAssembly is not available here, and motion-widgets needs it.');
  }
  await initialize({ module_or_path: await moduleFrom(source) });
  for (const handle of [BananaMachine, MapSqueeze]) makeDisposable(handle);
  return /** @type {import('./types.d.ts').Motion} */ (
    /** @type {unknown} */ ({ BananaMachine, MapSqueeze, commandReaching, randomSeed })
  );
}

/**
 * @param {unknown} source
 * @returns {Promise<BufferSource | URL | string | WebAssembly.Module>}
 */
async function moduleFrom(source) {
  if (source === undefined) return inlined;
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer) return source;
  if (ArrayBuffer.isView(source)) return /** @type {BufferSource} */ (source);
  if (source instanceof URL || typeof source === 'string') {
    return fileAt(source) ?? source;
  }
  throw new TypeError(
    `load: source is ${String(source)}, and must be the module's bytes, a URL or string, ` +
      'or a WebAssembly.Module.',
  );
}

/**
 * Node's `fetch` refuses file: addresses and paths, so there the file is read.
 *
 * @param {URL | string} source
 * @returns {Promise<BufferSource> | undefined} undefined where `fetch` is the way
 */
function fileAt(source) {
  const inNode = typeof process !== 'undefined' && process.versions?.node !== undefined;
  if (!inNode || /^(https?|data|blob):/.test(String(source))) return undefined;
  const path = String(source).startsWith('file:') ? new URL(source) : source;
  return import('node:fs/promises').then(({ readFile }) => readFile(path));
}

/**
 * Lets `m.free()` and `m[Symbol.dispose]()` be called again, which does nothing, and gives engines
 * without `Symbol.dispose` one.
 *
 * @param {{ prototype: { free(): void } }} handle a class of the generated glue
 */
function makeDisposable({ prototype }) {
  if (!Symbol.dispose) {
    Object.defineProperty(Symbol, 'dispose', { value: Symbol('Symbol.dispose') });
  }
  const { free } = prototype;
  /** @this {{ __wbg_ptr: number }} the address in the module's memory, 0 once it is freed */
  function freeOnce() {
    if (this.__wbg_ptr !== 0) free.call(this);
  }
  for (const name of ['free', Symbol.dispose]) {
    Object.defineProperty(prototype, name, { value: freeOnce, configurable: true, writable: true });
  }
}
