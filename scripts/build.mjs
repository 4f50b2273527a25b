// `npm run build`: src/ to build/ (WebAssembly and its glue), then www/ to dist/. What is up to date is left alone.

import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';
import { binder } from './bindgen.mjs';
import { bundle, filesOf } from './bundle.mjs';
import { cratesOf } from './licences.mjs';
import { ROOT, mustRun, progress, run, runAsScript, together } from './process.mjs';
import { ensurePackages, wasmRust } from './toolchain.mjs';

const at = (/** @type {string} */ path) => join(ROOT, path);

const PAGE_SCRIPTS = ['bundle', 'declarations', 'manifest', 'python', 'react', 'tables', 'types'].map((name) => `scripts/${name}.mjs`);

/** Brings dist/ up to date with the sources. */
export async function build() {
  const core = digest(['src', '.cargo', 'Cargo.toml', 'Cargo.lock', 'package-lock.json', 'scripts/build.mjs', 'scripts/bindgen.mjs', 'scripts/licences.mjs', 'scripts/bind']);
  const products = ['build/motion.js', 'build/motion_bg.wasm', 'build/core.d.ts', 'build/crates.json'];
  await together([ensurePackages(), whenStale('build/core.sha256', core, products, buildCore)]);
  const pages = digest(['www', 'package.json', 'package-lock.json', ...PAGE_SCRIPTS], core);
  await whenStale('build/pages.sha256', pages, ['dist/core.js', 'dist/classroom.html', 'python/src/motion_widgets/_elements.py'], bundle);
}

/**
 * @param {string[]} paths files and directories
 * @param {string} [seed]
 * @returns {string} a digest of their names and contents
 */
function digest(paths, seed = '') {
  const hash = createHash('sha256').update(seed);
  for (const path of paths.flatMap(filesOf)) hash.update(`\0${path}\0`).update(readFileSync(at(path)));
  return hash.digest('hex');
}

/**
 * @param {string} stamp the file that holds the digest of the sources last built from
 * @param {string} sources
 * @param {string[]} products
 * @param {() => Promise<void>} work
 */
async function whenStale(stamp, sources, products, work) {
  const current = [stamp, ...products].every((path) => existsSync(at(path)));
  if (current && readFileSync(at(stamp), 'utf8') === sources) return;
  mkdirSync(at('build'), { recursive: true });
  rmSync(at(stamp), { force: true });
  await work();
  writeFileSync(at(stamp), sources);
}

async function buildCore() {
  // All three at a time: one waits for the network while another computes.
  const [wasm, bind] = await together([compileCore(), binder(), ensurePackages()]);
  progress('Binding and optimizing it');
  await mustRun('wasm-bindgen failed: see above.', bind, [wasm, at('build')]);
  await silencePanics(at('build/motion_bg.wasm'));
  makeFactory('build/motion');
  // What scripts/bundle.mjs gives to who imports the file.
  const type = 'declare const modules: { motion: Carried; [tag: string]: Carried | undefined };\ntype Carried = () => Uint8Array<ArrayBuffer> | URL;\nexport default modules;\n';
  writeFileSync(at('build/motion_bg.wasm.d.ts'), type);
  // The features that rustc's default for this target has, and SIMD of .cargo/config.toml.
  const features = ['bulk-memory', 'multivalue', 'mutable-globals', 'nontrapping-float-to-int', 'reference-types', 'sign-ext', 'simd'];
  await mustRun('wasm-opt failed: see above.', process.execPath, [
    at('node_modules/binaryen/bin/wasm-opt'), '-O3', '--converge', ...features.map((name) => `--enable-${name}`),
    at('build/motion_bg.wasm'), '-o', at('build/motion_bg.wasm'),
  ]);
  await divide(at('build/motion_bg.wasm'));
}

/** @returns {Promise<string>} the path of the module as rustc leaves it */
async function compileCore() {
  const rust = await wasmRust();
  progress(`Compiling the core to WebAssembly (${rust.description})`);
  const cargo = join(rust.bin, 'cargo');
  // By `cargo build`, which makes the library for Rust as well, nothing would be optimized across crates.
  // The places of panics name files: not those of this machine.
  const sources = join(process.env.CARGO_HOME ?? join(homedir(), '.cargo'), 'registry/src');
  const remapped = `target.wasm32-unknown-unknown.rustflags=["--remap-path-prefix=${sources}="]`;
  const options = ['--locked', '--release', '--lib', '--crate-type', 'cdylib', '--config', remapped];
  await mustRun('The core does not compile: see the errors above.', cargo, ['rustc', ...options, ...rust.target], { env: rust.env });
  const ask = async (/** @type {string[]} */ ...question) => (await run(cargo, [...question, '--locked'], { env: rust.env, quiet: true })).stdout;
  const metadata = JSON.parse(await ask('metadata', '--format-version', '1'));
  const tree = await ask('tree', '--target', 'wasm32-unknown-unknown', '--edges', 'normal,no-proc-macro', '--prefix', 'none');
  writeFileSync(at('build/crates.json'), JSON.stringify(cratesOf(tree, metadata)));
  return join(metadata.target_directory, 'wasm32-unknown-unknown/release/motion.wasm');
}

/**
 * Makes every panic a bare trap. In a browser nobody sees the message, and what would compose it is 2 kB on the wire.
 *
 * @param {string} path of the module, with the names of its functions
 */
async function silencePanics(path) {
  const { binaryen, module } = await opened(path);
  // Its types leave this out.
  const { Function: functions } = /** @type {any} */ (binaryen);
  const panics = /(^|::)(panicking::\w*(panic|assert)\w*|panic_\w+|rust_panic\w*|\w+_failed|slice_\w*fail\w*|handle_(alloc_)?error|capacity_overflow)(::|$)/;
  for (let i = 0; i < module.getNumFunctions(); i++) {
    const panic = module.getFunctionByIndex(i);
    const { name, base } = binaryen.getFunctionInfo(panic);
    if (base === '' && /^<?(core|alloc|std|__rustc)(\[|::)/.test(name) && panics.test(name)) {
      functions.setBody(panic, module.unreachable());
    }
  }
  writeFileSync(path, module.emitBinary());
  module.dispose();
}

/**
 * Writes, for each class that the core exports, a module without the others. The whole one's glue fits it.
 *
 * @param {string} path of the whole module
 */
async function divide(path) {
  const { binaryen, module: whole } = await opened(path);
  const exported = Array.from({ length: whole.getNumExports() }, (_, i) => binaryen.getExportInfo(whole.getExportByIndex(i)).name);
  whole.dispose();
  const classes = exported.flatMap((name) => name.match(/^__wbg_(\w+)_free$/)?.slice(1) ?? []);
  for (const kept of classes) {
    const { module } = await opened(path);
    const others = classes.filter((name) => name !== kept);
    for (const name of exported) {
      if (others.some((other) => name.startsWith(`${other}_`) || name === `__wbg_${other}_free`)) module.removeExport(name);
    }
    module.runPasses(['remove-unused-module-elements']);
    writeFileSync(at(`build/${kept}_bg.wasm`), module.emitBinary());
    module.dispose();
  }
}

/** @param {string} path of a module */
async function opened(path) {
  // Not in a bare clone.
  const { default: binaryen } = await import('binaryen');
  const module = binaryen.readBinary(readFileSync(path));
  const { BulkMemory, Multivalue, MutableGlobals, NontrappingFPToInt, ReferenceTypes, SignExt, SIMD128 } = binaryen.Features;
  module.setFeatures(BulkMemory | Multivalue | MutableGlobals | NontrappingFPToInt | ReferenceTypes | SignExt | SIMD128);
  return { binaryen, module };
}

/**
 * Makes a module of wasm-bindgen's script: one that exports a function which instantiates the core once more. As a module
 * of its own the glue would be there once, and one instance with it. How it would find and load the WebAssembly module
 * by itself is left out: www/core.js does, and that would be 1 kB on the wire.
 *
 * @param {string} path of the script and of its types, without their extensions
 */
function makeFactory(path) {
  const script = readFileSync(at(`${path}.js`), 'utf8');
  const glue = script.match(/^let wasm_bindgen = \(function\(exports\) \{\n +let script_src;\n +if [^}]*\}\n(.*)\n +async function __wbg_load\(/s)?.[1];
  if (glue === undefined) throw new Error("wasm-bindgen's script is not what scripts/build.mjs takes it for.");
  // What it throws by itself is the end of a core, as a trap is; plain errors are the page's own, thrown where a core reads.
  const ends = glue.replaceAll('throw new Error(getStringFromWasm', 'throw new WebAssembly.RuntimeError(getStringFromWasm');
  if (ends === glue) throw new Error("wasm-bindgen's errors are not what scripts/build.mjs takes them for.");
  const instance = '__wbg_finalize_init(await WebAssembly.instantiate(module, __wbg_get_imports()), module);';
  writeFileSync(at(`${path}.js`), `export default async (module) => {\nconst exports = {};\n${ends}\n${instance}\nreturn exports;\n};\n`);
  const type = 'declare const instantiate: (module: WebAssembly.Module) => Promise<typeof import("./machines.d.ts")>;\n';
  writeFileSync(at(`${path}.d.ts`), `${type}export default instantiate;\n`);
}

await runAsScript(import.meta.url, async () => {
  await build();
  console.log('\ndist/ is up to date.');
});
