/**
 * Loader of the WebAssembly core, which a page or process compiles once. This is the only file that uses the JavaScript that wasm-bindgen generates.
 * Importing this file has no effects: it needs no DOM, and fetches and compiles nothing before `load()`.
 */

import bundledCores from '../build/motion.wasm';
import type { Motion } from './types.d.ts';

export { startWorker } from '../build/motion.wasm';

/** WebAssembly module as bytes, as an address, or compiled. */
export type ModuleSource = BufferSource | URL | string | WebAssembly.Module;

/** Source of the module that the first caller passed to `load` or `instantiate`. */
let requestedSource: ModuleSource | undefined;
/** Functions that load a WebAssembly module of the bundle, and its glue code: the JavaScript that wasm-bindgen generated for the module. */
type BundledCore = typeof bundledCores.motion;

/** Promises of compiled modules. The key is the module's source, or for a bundled core the core itself. */
const modulesBySource: Map<ModuleSource | BundledCore, Promise<WebAssembly.Module>> = new Map();
/** Tags of the widgets that external.js has found in the page. */
export const foundTags: Set<string> = new Set();
let corePromise: Promise<Motion> | undefined;

/**
 * Returns the core, ready to use. Later calls get the same core, and a call after a failed one tries again.
 *
 * `moduleSource` is the module as bytes, an address, or compiled. By default it is the module of the bundle. For external.js that is the file
 * `motion.wasm` next to it, or if the file cannot be fetched, the copy embedded in a script. The first caller with a source determines the
 * source for the page. A script may import the elements before it calls `load(moduleSource)`, but must not await anything in between.
 */
export function load(moduleSource?: ModuleSource): Promise<Motion> {
  requestedSource ??= moduleSource;
  corePromise ??= instantiate().catch((error) => {
    corePromise = undefined;
    throw error;
  });
  return corePromise;
}

/**
 * Returns another core from the same compiled module, with its own memory. A trap in the new core does not affect other cores. The memory is freed when
 * nothing refers to the new core any more.
 */
export function instantiate(moduleSource?: ModuleSource): Promise<Motion> {
  requestedSource ??= moduleSource;
  return instantiateFor('motion');
}

/** Returns a new core for a widget's tag, or for all widgets if the tag is "motion". external.js has smaller cores that serve one kind of widget each. */
export async function instantiateFor(widgetTag: string): Promise<Motion> {
  if (typeof WebAssembly === 'undefined') {
    throw new Error('WebAssembly is not available here, and motion-widgets needs it.');
  }
  let motionCore;
  try {
    // Waits, because the script that imports the elements can call `load(moduleSource)` only after they are defined.
    await null;
    const [wasmModule, { default: createCore }] = await loadModuleAndGlue(widgetTag);
    motionCore = await createCore(wasmModule);
  } catch (error) {
    if (!isWasmForbidden()) throw error;
    throw new Error(
      "This page's Content-Security-Policy forbids WebAssembly: its script-src directive lacks 'wasm-unsafe-eval'.",
      { cause: error },
    );
  }
  for (const [className, { prototype }] of Object.entries<any>(motionCore)) if (prototype?.free) makeDisposable(className, prototype);
  return motionCore;
}

/** Compiled WebAssembly module of a widget, and the key of its wasm-bindgen JavaScript in `bundledCores`. A worker instantiates the core from these. */
export interface SharedCore {
  module: WebAssembly.Module;
  glueKey: string;
}

/** Returns what a worker needs to instantiate a widget's core. */
export async function moduleForWorker(widgetTag: string): Promise<SharedCore> {
  const [wasmModule] = await loadModuleAndGlue(widgetTag);
  const bundledCore = bundledCoreOf(widgetTag);
  return { module: wasmModule, glueKey: Object.keys(bundledCores).find((glueKey) => bundledCores[glueKey] === bundledCore) ?? 'motion' };
}

/** Returns a core from a module that another thread has compiled. */
export async function instantiateShared({ module: wasmModule, glueKey }: SharedCore): Promise<Motion> {
  const { default: createCore } = await (bundledCores[glueKey] ?? bundledCores.motion).glue();
  return createCore(wasmModule);
}

/** Prevents the garbage collector from freeing a simulation after a trap in its core, because the core's memory may be damaged. */
export function abandonSimulation(simulation: { free(): void }) {
  (simulation as unknown as { __destroy_into_raw(): number }).__destroy_into_raw();
}

/** True after the module's file could not be fetched. The embedded module is used from then on. */
let isModuleUnreachable = false;

/** Returns the compiled module of a widget and its wasm-bindgen JavaScript. If the module cannot be fetched, returns the embedded module. */
async function loadModuleAndGlue(widgetTag: string): Promise<[WebAssembly.Module, Awaited<ReturnType<BundledCore['glue']>>]> {
  const sourceAtStart = requestedSource;
  const bundledCore = bundledCoreOf(widgetTag);
  try {
    return await Promise.all([compileOnce(bundledCore), bundledCore.glue()]);
  } catch (error) {
    if (sourceAtStart !== undefined || !bundledCores.embedded || bundledCore === bundledCores.embedded || isWasmForbidden()) throw error;
    isModuleUnreachable = true;
    const embeddedModuleAndGlue = await loadModuleAndGlue(widgetTag).catch(() => {
      isModuleUnreachable = false;
      throw error;
    });
    console.warn(`motion-widgets: the module embedded in a script is used. ${(error as Error).message}`);
    return embeddedModuleAndGlue;
  }
}

/** Returns the bundled core of a widget. Pages with several kinds of widgets use the common core, which is smaller than several cores. */
function bundledCoreOf(widgetTag: string) {
  const ownCore = bundledCores[widgetTag];
  const bundledCore = ownCore && requestedSource === undefined && (modulesBySource.has(ownCore) || foundTags.size < 2) ? ownCore : bundledCores.motion;
  return bundledCores.embedded && requestedSource === undefined && (isModuleUnreachable || !bundledCore.source()) ? bundledCores.embedded : bundledCore;
}

function compileOnce(bundledCore: BundledCore): Promise<WebAssembly.Module> {
  const cacheKey = requestedSource ?? bundledCore;
  let wasmModule = modulesBySource.get(cacheKey);
  if (!wasmModule) {
    wasmModule = compileSource(requestedSource ?? bundledCore.source()).catch((error) => {
      requestedSource = undefined;
      modulesBySource.delete(cacheKey);
      throw error;
    });
    modulesBySource.set(cacheKey, wasmModule);
  }
  return wasmModule;
}

/** Compiles the module that is embedded in the bundle, if any, in the background while this thread evaluates scripts. */
export function precompileModule() {
  // A bundle with an embedded module also has modules in files. Nothing is compiled then: figures use the embedded module only if a file cannot be fetched.
  if (!bundledCores.embedded && requestedSource === undefined) compileOnce(bundledCores.motion).catch(() => {});
}

/** Advice in the error message for a site that lacks the module's file. */
const MISSING_MODULE_ADVICE =
  "Copy motion.wasm from the package's dist/ into the site and give its address to load(), or leave the address out.";

/** Maximum number of characters of an address in a message. A data URL may have millions. */
const MAX_ADDRESS_LENGTH = 200;

async function compileSource(sourceOrPromise: ModuleSource | Promise<BufferSource> | undefined) {
  // There is no `await` for a source of bytes, so that its compilation starts at once and not in a later task.
  const moduleSource = (sourceOrPromise instanceof Promise ? await sourceOrPromise : sourceOrPromise) as ModuleSource;
  if (moduleSource instanceof WebAssembly.Module) return moduleSource;
  if (moduleSource instanceof ArrayBuffer || ArrayBuffer.isView(moduleSource)) return WebAssembly.compile(moduleSource);
  if (moduleSource instanceof URL || typeof moduleSource === 'string') {
    const fileContents = readNodeFile(moduleSource);
    return fileContents ? WebAssembly.compile(await fileContents) : compileStreamed(moduleSource);
  }
  throw new TypeError(
    `load: source is of the type ${typeof moduleSource}; allowed are the module's bytes, a URL or string, and a WebAssembly.Module.`,
  );
}

/** Returns true if a Content-Security-Policy forbids WebAssembly. An empty module shows this: WebKit then refuses to instantiate it, and other browsers to compile it. */
function isWasmForbidden() {
  try {
    return !new WebAssembly.Instance(new WebAssembly.Module(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0)));
  } catch {
    return true;
  }
}

/** Compiles a module during its download, or after the download if its MIME type is not application/wasm. */
async function compileStreamed(moduleSource: URL | string) {
  const moduleResponse = await fetch(moduleSource).catch((error) => {
    throw new Error(
      `load: ${String(moduleSource).slice(0, MAX_ADDRESS_LENGTH)} cannot be fetched (${error.message}); a Content-Security-Policy has to allow it by connect-src. ${MISSING_MODULE_ADVICE}`,
      { cause: error },
    );
  });
  const url = moduleResponse.url.slice(0, MAX_ADDRESS_LENGTH);
  if (!moduleResponse.ok) throw new Error(`load: ${url} answers ${moduleResponse.status}. ${MISSING_MODULE_ADVICE}`);
  const contentType = moduleResponse.headers.get('content-type') ?? 'something without a type';
  try {
    if (/^application\/wasm\s*$/i.test(contentType)) return await WebAssembly.compileStreaming(moduleResponse);
    return await WebAssembly.compile(await moduleResponse.arrayBuffer());
  } catch (error) {
    const failureReason = (error as Error).message;
    throw new Error(`load: ${url} answers with ${contentType}, which is no WebAssembly module: ${failureReason}. ${MISSING_MODULE_ADVICE}`, { cause: error });
  }
}

/** Reads a file in Node, whose `fetch` refuses file: addresses and paths. Returns undefined for addresses that `fetch` can read. */
function readNodeFile(moduleSource: URL | string): Promise<BufferSource> | undefined {
  if (/^(https?|data|blob):/.test(String(moduleSource))) return undefined;
  // A static import of node:fs would fail in bundlers for browsers.
  const nodeFileSystem = globalThis.process?.getBuiltinModule?.('node:fs/promises');
  return nodeFileSystem?.readFile(String(moduleSource).startsWith('file:') ? new URL(moduleSource) : moduleSource);
}

/**
 * Makes a class that wasm-bindgen has generated disposable. `free()` and `[Symbol.dispose]()` can be called several times, also in engines without that
 * symbol. Any other call after them throws a TypeError.
 */
function makeDisposable(className: string, prototype: any) {
  if (!Symbol.dispose) Object.defineProperty(Symbol, 'dispose', { value: Symbol('Symbol.dispose') });
  const { free: freeObject } = prototype;
  prototype.free = prototype[Symbol.dispose] = function () {
    if (!Object.getOwnPropertyDescriptor(this, '__wbg_ptr')?.value) return;
    freeObject.call(this);
    const throwFreed = () => {
      throw new TypeError(`this ${className} was freed; create a new one.`);
    };
    Object.defineProperty(this, '__wbg_ptr', { get: throwFreed });
  };
}
