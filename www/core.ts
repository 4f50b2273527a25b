/**
 * Loads the WebAssembly core; a page or process compiles a module once. The only file that touches generated glue.
 * Importing it runs nothing: no DOM, no network, no compilation before `load()`.
 */

import carried from '../build/motion.wasm';
import type { Motion } from './types.d.ts';

export { startWorker } from '../build/motion.wasm';

/** Module as bytes, as an address, or compiled. */
export type Source = BufferSource | URL | string | WebAssembly.Module;

/** Source that the first caller named. */
let wanted: Source | undefined;
/** Carrier of a module and its glue. */
type Carrier = typeof carried.motion;

/** Modules, by what carries them. */
const compiling: Map<Carrier, Promise<WebAssembly.Module>> = new Map();
/** Tags of widgets that the page has met: external.js adds them. */
export const expected: Set<string> = new Set();
let loading: Promise<Motion> | undefined;

/**
 * Returns the core, ready to use. Later calls get the same core, and a call after a failed one tries again.
 *
 * `source` is the module as bytes, an address, or compiled. Without it the module is the one in the bundle. For external.js that is the
 * file `motion.wasm` beside it, or where that cannot be fetched, the copy embedded in a script. The first caller to name a source decides
 * for the page. A script that imports the elements and names a source at once is early enough.
 */
export function load(source?: Source): Promise<Motion> {
  wanted ??= source;
  loading ??= instantiate().catch((error) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

/**
 * Returns a further core from the same compiled module, with its own memory. A trap in it harms no other, and its memory is freed with
 * the last reference to it.
 */
export function instantiate(source?: Source): Promise<Motion> {
  wanted ??= source;
  return instantiateFor('motion');
}

/** As `instantiate`, for the widget of a tag. In external.js its module has no other's machine, as long as the page has met no other. */
export async function instantiateFor(name: string): Promise<Motion> {
  if (typeof WebAssembly === 'undefined') {
    throw new Error('WebAssembly is not available here, and motion-widgets needs it.');
  }
  let motion;
  try {
    // Elements ask while they are being defined, before the script that imports them has had its say.
    await null;
    const [module, { default: makeCore }] = await found(name);
    motion = await makeCore(module);
  } catch (error) {
    if (!forbidden()) throw error;
    throw new Error(
      "This page's Content-Security-Policy forbids WebAssembly: its script-src directive lacks 'wasm-unsafe-eval'.",
      { cause: error },
    );
  }
  for (const [name, { prototype }] of Object.entries<any>(motion)) if (prototype?.free) makeDisposable(name, prototype);
  return motion;
}

/** Compiled module of a widget, and the name of its glue: a worker makes a core of them. */
export interface SharedCore {
  module: WebAssembly.Module;
  glue: string;
}

/** Returns what another thread needs for the core of a widget, by its tag. */
export async function sharedCore(name: string): Promise<SharedCore> {
  const [module] = await found(name);
  const carrier = carrierOf(name);
  return { module, glue: Object.keys(carried).find((key) => carried[key] === carrier) ?? 'motion' };
}

/** Makes a core of what another thread has compiled. */
export async function instantiateShared({ module, glue }: SharedCore): Promise<Motion> {
  const { default: makeCore } = await (carried[glue] ?? carried.motion).glue();
  return makeCore(module);
}

/** Forgets a machine of a core that has trapped. Its memory is damaged: even to free the machine, when its handle is collected, is not safe. */
export function abandon(machine: { free(): void }) {
  (machine as unknown as { __destroy_into_raw(): number }).__destroy_into_raw();
}

/** True once the file of a module was asked for in vain. */
let unreachable = false;

/** Returns the module and glue of a widget, or of the whole core; the embedded ones where there is no file, or it cannot be had. */
async function found(name: string): Promise<[WebAssembly.Module, Awaited<ReturnType<Carrier['glue']>>]> {
  const named = wanted;
  const carrier = carrierOf(name);
  try {
    return await Promise.all([compiled(carrier), carrier.glue()]);
  } catch (error) {
    if (named !== undefined || !carried.embedded || carrier === carried.embedded || forbidden()) throw error;
    unreachable = true;
    const embedded = await found(name).catch(() => {
      unreachable = false;
      throw error;
    });
    console.warn(`motion-widgets: the module embedded in a script is used. ${(error as Error).message}`);
    return embedded;
  }
}

/** Returns the carrier of a widget's module, or of the whole core: one for all widgets of a page is less than one for each. */
function carrierOf(name: string) {
  const own = carried[name];
  const carrier = own && (compiling.has(own) || (wanted === undefined && expected.size < 2)) ? own : carried.motion;
  return carried.embedded && wanted === undefined && (unreachable || !carrier.source()) ? carried.embedded : carrier;
}

function compiled(carrier: Carrier): Promise<WebAssembly.Module> {
  let module = compiling.get(carrier);
  if (!module) {
    module = compile(wanted ?? carrier.source()).catch((error) => {
      wanted = undefined;
      compiling.delete(carrier);
      throw error;
    });
    compiling.set(carrier, module);
  }
  return module;
}

/** Advice to an author whose site has no module. */
const CURE =
  "Copy motion.wasm from the package's dist/ into the site and give its address to load(), or leave the address out.";

/** Characters of an address that are quoted: one with data in it has millions. */
const LONGEST = 200;

async function compile(given: Source | Promise<BufferSource> | undefined) {
  const source = await given;
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source);
  if (source instanceof URL || typeof source === 'string') {
    const file = fileAt(source);
    return file ? WebAssembly.compile(await file) : streamed(source);
  }
  throw new TypeError(
    `load: source is of the type ${typeof source}; allowed are the module's bytes, a URL or string, and a WebAssembly.Module.`,
  );
}

/** Checks whether not even an empty module may run here: WebKit forbids that alone, others to compile it. */
function forbidden() {
  try {
    return !new WebAssembly.Instance(new WebAssembly.Module(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0)));
  } catch {
    return true;
  }
}

/** Compiles a module while it is still arriving, or afterwards where the server calls it something else than application/wasm. */
async function streamed(source: URL | string) {
  const response = await fetch(source).catch((error) => {
    throw new Error(
      `load: ${String(source).slice(0, LONGEST)} cannot be fetched (${error.message}); a Content-Security-Policy has to allow it by connect-src. ${CURE}`,
      { cause: error },
    );
  });
  const url = response.url.slice(0, LONGEST);
  if (!response.ok) throw new Error(`load: ${url} answers ${response.status}. ${CURE}`);
  const type = response.headers.get('content-type') ?? 'something without a type';
  try {
    if (/^application\/wasm\s*$/i.test(type)) return await WebAssembly.compileStreaming(response);
    return await WebAssembly.compile(await response.arrayBuffer());
  } catch (error) {
    const reason = (error as Error).message;
    throw new Error(`load: ${url} answers with ${type}, which is no WebAssembly module: ${reason}. ${CURE}`, { cause: error });
  }
}

/** Reads a file in Node, whose `fetch` refuses file: addresses and paths. Undefined where `fetch` works. */
function fileAt(source: URL | string): Promise<BufferSource> | undefined {
  if (/^(https?|data|blob):/.test(String(source))) return undefined;
  // No import: bundlers for browsers would stumble over it.
  const files = globalThis.process?.getBuiltinModule?.('node:fs/promises');
  return files?.readFile(String(source).startsWith('file:') ? new URL(source) : source);
}

/**
 * Makes a class of the generated glue disposable: `free()` may be called again, which does nothing, and so may
 * `[Symbol.dispose]()`, in engines without that symbol too. Any other use after that throws a TypeError.
 */
function makeDisposable(name: string, prototype: any) {
  if (!Symbol.dispose) Object.defineProperty(Symbol, 'dispose', { value: Symbol('Symbol.dispose') });
  const { free } = prototype;
  prototype.free = prototype[Symbol.dispose] = function () {
    if (!Object.getOwnPropertyDescriptor(this, '__wbg_ptr')?.value) return;
    free.call(this);
    const refuse = () => {
      throw new TypeError(`this ${name} was freed; create a new one.`);
    };
    Object.defineProperty(this, '__wbg_ptr', { get: refuse });
  };
}
