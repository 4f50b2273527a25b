// `npm run build`: compiles src/ to build/ (WebAssembly modules and their JavaScript glue), then bundles www/ to dist/. Files that are up
// to date are not built again.

import { createHash } from 'node:crypto';
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';
import { ensureBindProgram } from './bindgen.mjs';
import { EXAMPLE_LOG_PATHS, writeExampleLog } from './example-log.mjs';
import { listCrates } from './licences.mjs';
import { absolutePathOf, filesOf, runOrThrow, printStep, runProgram, runAsScript, settleAll } from './process.mjs';
import { ensureNativeRust, ensurePackages, ensureRustForWasm } from './toolchain.mjs';

const PAGE_SCRIPTS = ['bundle', 'declarations', 'manifest', 'pages', 'python', 'react', 'tables', 'types'].map((scriptName) => `scripts/${scriptName}.mjs`);

/** Type declarations of the module by which scripts/bundle.mjs replaces `motion.wasm`. */
const BUNDLED_CORE_TYPES = `type Bytes = Uint8Array<ArrayBuffer>;
type BundledCore = { glue(): Promise<typeof import('./motion.js')>; source(): Bytes | URL | Promise<Bytes> | undefined };
declare const cores: { motion: BundledCore; [tag: string]: BundledCore | undefined };
export default cores;
/** Starts the worker that reads logs. Returns undefined if the bundle does not know the worker's script. */
export function startWorker(): Worker | undefined;
`;

/** Files on which the compiled cores depend. */
const CORE_SOURCES = [
  'src', '.cargo', 'Cargo.toml', 'Cargo.lock', 'scripts/package.json',
  ...['build', 'bindgen', 'licences'].map((scriptName) => `scripts/${scriptName}.mjs`), 'scripts/bind', 'scripts/declarations.rs',
];

/**
 * Brings dist/ up to date with the sources.
 *
 * @param {object} [options]
 * @param {boolean} [options.isLocal] true for a server on this machine. All figures then share the whole core, compiled with the profile
 *   `web` and not shrunk, unless the modules for publication exist already.
 */
export async function buildProject({ isLocal = false } = {}) {
  const coreHash = hashOfFiles(CORE_SOURCES);
  const coreProducts = ['build/motion.js', 'build/motion.wasm', 'build/core.d.ts', 'build/crates.json', 'build/settings.js'];
  const isPublishedCoreUpToDate = isUpToDate('build/core.sha256', coreHash, coreProducts);
  const compiledHash = isLocal && !isPublishedCoreUpToDate ? `${coreHash} local` : coreHash;
  // Packages are installed before anything is compiled. Without a network the installation fails at once, whereas compiling takes minutes.
  await ensurePackages();
  await buildIfStale('build/core.sha256', compiledHash, coreProducts, () => buildCores(['motion'], isLocal));
  // bundle.mjs imports npm packages and build/settings.js. A static import of bundle.mjs would fail in a bare clone.
  const { WIDGET_TAGS, bundlePages } = await import('./bundle.mjs');
  const figureProducts = WIDGET_TAGS.flatMap((widgetTag) => [`build/${widgetTag}.js`, `build/${widgetTag}.wasm`]);
  if (!isLocal) await buildIfStale('build/figures.sha256', coreHash, figureProducts, () => buildCores(WIDGET_TAGS, false));
  const tagsWithCore = compiledHash === coreHash && isUpToDate('build/figures.sha256', coreHash, figureProducts) ? WIDGET_TAGS : [];
  const pagesHash = hashOfFiles(['www', 'doc/embedding/figures.md', 'package.json', 'package-lock.json', ...PAGE_SCRIPTS], compiledHash + tagsWithCore);
  await buildIfStale('build/pages.sha256', pagesHash, ['dist/core.js', 'dist/classroom.html', 'python/src/motion_widgets/_elements.py'], () => bundlePages({ tags: tagsWithCore }));
  await buildIfStale('build/example-log.sha256', hashOfFiles(['scripts/example-log.mjs'], coreHash), Object.values(EXAMPLE_LOG_PATHS), writeExampleLog);
}

/** Returns a hash of the names and contents of files. @param {string[]} hashedPaths paths of files and directories @param {string} [hashSeed] */
function hashOfFiles(hashedPaths, hashSeed = '') {
  const fileHash = createHash('sha256').update(hashSeed);
  for (const hashedPath of hashedPaths.flatMap(filesOf)) fileHash.update(`\0${hashedPath}\0`).update(readFileSync(absolutePathOf(hashedPath)));
  return fileHash.digest('hex');
}

/**
 * Calls `buildProducts` if the products are missing, or were built from other sources.
 *
 * @param {string} stampName path of the file with the hash of the sources of the last build
 * @param {string} sourceHash
 * @param {string[]} productPaths
 * @param {() => Promise<void>} buildProducts
 */
async function buildIfStale(stampName, sourceHash, productPaths, buildProducts) {
  if (isUpToDate(stampName, sourceHash, productPaths)) return;
  mkdirSync(absolutePathOf('build'), { recursive: true });
  rmSync(absolutePathOf(stampName), { force: true });
  await buildProducts();
  writeFileSync(absolutePathOf(stampName), sourceHash);
}

/**
 * Returns true if the products were built from sources with this hash.
 * @param {string} stampPath @param {string} sourceHash @param {string[]} productPaths
 */
function isUpToDate(stampPath, sourceHash, productPaths) {
  return [stampPath, ...productPaths].every((filePath) => existsSync(absolutePathOf(filePath))) && readFileSync(absolutePathOf(stampPath), 'utf8') === sourceHash;
}

/**
 * Builds cores. Each core is a WebAssembly module and its JavaScript glue.
 *
 * @param {string[]} coreNames "motion" for the whole core, or tags of figures. The core of a figure contains only its own simulation.
 * @param {boolean} isLocal
 */
async function buildCores(coreNames, isLocal) {
  // If Rust is missing, the build ends here with a message. Tasks that start later cannot hide this message by another failure.
  const rustTools = await ensureRustForWasm();
  const [bindProgramPromise, packagesPromise] = [ensureBindProgram(), ensurePackages(isLocal ? undefined : 'scripts')];
  printStep(`Compiling the core to WebAssembly (${rustTools.description}): ${coreNames.join(', ')}`);
  const completionPromises = [];
  for (const coreName of coreNames) {
    // Cargo writes all cores to one path. The JavaScript glue of a core is therefore generated before the next core is compiled.
    const [modulePath, bindProgramPath] = await settleAll([compileCore(rustTools, coreName, isLocal), bindProgramPromise, packagesPromise]);
    await runOrThrow('wasm-bindgen failed: see above.', bindProgramPath, [modulePath, absolutePathOf(`build/bound/${coreName}`)]);
    completionPromises.push(completeCore(coreName, isLocal));
  }
  await settleAll(completionPromises);
  if (!coreNames.includes('motion')) return;
  await writeSettings();
  copyFileSync(absolutePathOf('build/bound/motion/motion.d.ts'), absolutePathOf('build/core.d.ts'));
  writeFileSync(absolutePathOf('build/motion.wasm.d.ts'), BUNDLED_CORE_TYPES);
}

/**
 * Compiles a core.
 *
 * @param {Awaited<ReturnType<typeof ensureRustForWasm>>} rustTools
 * @param {string} coreName as in `buildCores`
 * @param {boolean} isLocal
 * @returns {Promise<string>} path of the module that rustc has written
 */
async function compileCore(rustTools, coreName, isLocal) {
  const cargoPath = join(rustTools.cargoDirectory, 'cargo');
  // `cargo build` also makes a Rust library, and then cannot optimize across crates. `cargo rustc` makes only the module. Panic locations
  // contain paths. In a published module the paths of this machine are removed.
  const registrySources = join(process.env.CARGO_HOME ?? join(homedir(), '.cargo'), 'registry/src');
  const { stdout: sysroot } = await runProgram(join(rustTools.cargoDirectory, 'rustc'), ['--print', 'sysroot'], { env: rustTools.env, isQuiet: true });
  const pathRemovalFlags = [registrySources, join(sysroot.trim(), 'lib/rustlib/src/rust')].map((filePath) => `"--remap-path-prefix=${filePath}="`);
  const pathRemovalOption = `target.wasm32-unknown-unknown.rustflags=[${pathRemovalFlags}]`;
  const cargoProfile = isLocal ? 'web' : 'release';
  const cargoOptions = ['--quiet', '--locked', '--profile', cargoProfile, '--lib', '--crate-type', 'cdylib', ...(isLocal ? [] : ['--config', pathRemovalOption])];
  const widgetOptions = coreName === 'motion' ? [] : ['--', '--cfg', 'widget', '--cfg', `widget="${coreName}"`];
  await runOrThrow('The core does not compile: see the errors above.', cargoPath, ['rustc', ...cargoOptions, ...rustTools.target, ...widgetOptions], { env: rustTools.env });
  const readCargoOutput = async (/** @type {string[]} */ ...cargoArguments) => (await runProgram(cargoPath, [...cargoArguments, '--locked'], { env: rustTools.env, isQuiet: true })).stdout;
  const cargoMetadata = JSON.parse(await readCargoOutput('metadata', '--format-version', '1'));
  if (coreName === 'motion') {
    const crateTree = await readCargoOutput('tree', '--target', 'wasm32-unknown-unknown', '--edges', 'normal,no-proc-macro', '--prefix', 'none');
    writeFileSync(absolutePathOf('build/crates.json'), JSON.stringify(listCrates(crateTree, cargoMetadata)));
  }
  return join(cargoMetadata.target_directory, `wasm32-unknown-unknown/${cargoProfile}/motion.wasm`);
}

/** Writes build/settings.js, with constants of the core for pages that have not loaded it and for scripts that generate types. */
async function writeSettings() {
  const { cargoDirectory, env } = await ensureNativeRust();
  const cargoArguments = ['run', '--quiet', '--locked', '--example', 'declarations'];
  const { stdout } = await runOrThrow('The settings could not be listed: see above.', join(cargoDirectory, 'cargo'), cargoArguments, { env, isQuiet: true });
  const [widgetDeclarations, otherConstants] = JSON.parse(stdout);
  const settings = Object.fromEntries(widgetDeclarations.map((/** @type {any[]} */ [widgetTag, settingsOfWidget]) => [widgetTag, declarationsOf(settingsOfWidget)]));
  const presetsByTag = Object.fromEntries(widgetDeclarations.map((/** @type {any[]} */ [widgetTag, , presetsOfWidget]) => [widgetTag, presetsOfWidget.map((/** @type {any[]} */ [presetName, settings]) => ({ name: presetName, settings }))]));
  const typeLines = "/** @typedef {import('../www/types.d.ts').Declaration} Declaration */\n\n/** @type {Record<string, Declaration[]>} */\n";
  const constantLines = Object.entries({ settings, presets: presetsByTag, ...otherConstants }).map(([constantName, constantValue]) => `export const ${constantName} = ${JSON.stringify(constantValue, null, 1)};\n`);
  writeFileSync(absolutePathOf('build/settings.js'), typeLines + constantLines.join('\n'));
}

/**
 * Returns the declarations of a widget's settings, including those of each number in a group or list.
 *
 * @param {any[]} settingsOfWidget as scripts/declarations.rs prints them
 * @returns {import('../www/types.d.ts').Declaration[]}
 */
function declarationsOf(settingsOfWidget) {
  const fieldKeys = settingsOfWidget.flatMap(([, { fields = [] }]) => fields.map((/** @type {any[]} */ [{ key: settingKey }]) => settingKey));
  // If several groups have a field of the same name, as two poses have, the group is part of the field's name.
  const isInSeveralGroups = (/** @type {string} */ fieldKey) => fieldKeys.indexOf(fieldKey) < fieldKeys.lastIndexOf(fieldKey);
  return settingsOfWidget.flatMap(([{ key: settingKey, of, unit: unitText, sentence: docSentence, each }, { type, allowed: allowedText, nullable, weights, words, fields, minLength }, defaultValue]) => {
    const rangeLimits = { min: allowedText?.start, max: allowedText?.end };
    const listItems = type === 'numbers' && each ? defaultValue : [];
    return [
      { key: settingKey, of: of ?? undefined, weights, type, words, fields: fields?.map((/** @type {any[]} */ [groupField]) => groupField.key), unit: unitText || undefined, nullable, ...rangeLimits, default: defaultValue, sentence: docSentence },
      ...listItems.map((/** @type {number} */ listItem, /** @type {number} */ itemIndex) => (
        { key: `alpha${itemIndex + 1}`, in: settingKey, index: itemIndex, type: 'number', nullable: itemIndex >= minLength || undefined, ...rangeLimits, default: listItem, sentence: each }
      )),
      ...(fields ?? []).map((/** @type {any[]} */ [field, { start: minValue, end: maxValue }]) => ({
        key: isInSeveralGroups(field.key) ? `${settingKey}${field.key[0].toUpperCase()}${field.key.slice(1)}` : field.key, in: settingKey, field: isInSeveralGroups(field.key) ? field.key : undefined,
        type: 'number', unit: field.unit, min: minValue, max: maxValue, default: defaultValue[field.key], sentence: each ? `${field.sentence} ${each}.` : field.sentence,
      })),
    ];
  });
}

/** Writes the module of a core and its JavaScript glue, from the files that wasm-bindgen wrote. @param {string} moduleName @param {boolean} isLocal */
async function completeCore(moduleName, isLocal) {
  copyFileSync(absolutePathOf(`build/bound/${moduleName}/motion_bg.wasm`), absolutePathOf(`build/${moduleName}.wasm`));
  if (!isLocal) {
    await replacePanicsByTraps(`build/${moduleName}.wasm`);
    await optimizeModule(`build/${moduleName}.wasm`);
  }
  await writeGlue(moduleName, isLocal ? readGlueNames(moduleName) : await shortenNames(moduleName));
}

/**
 * Replaces every panic by a bare trap. Browsers do not show the message, and the code that formats it takes 2 kB on the wire.
 *
 * @param {string} filePath path of a module that contains the names of its functions
 */
async function replacePanicsByTraps(filePath) {
  // The package name is a variable, because only full builds install the package. The type checker would require a package with a constant name.
  const packageName = 'binaryen';
  const { default: binaryen } = await import(packageName);
  const binaryenModule = binaryen.readBinary(readFileSync(absolutePathOf(filePath)));
  const { BulkMemory, Multivalue, MutableGlobals, NontrappingFPToInt, ReferenceTypes, SignExt, SIMD128 } = binaryen.Features;
  binaryenModule.setFeatures(BulkMemory | Multivalue | MutableGlobals | NontrappingFPToInt | ReferenceTypes | SignExt | SIMD128);
  const { Function: functionWrapper } = binaryen;
  const panicNamePattern = /(^|::)(panicking::\w*(panic|assert)\w*|panic_\w+|rust_panic\w*|\w+_failed|slice_\w*fail\w*|handle_(alloc_)?error|capacity_overflow)(::|$)/;
  for (let i = 0; i < binaryenModule.getNumFunctions(); i++) {
    const panicFunction = binaryenModule.getFunctionByIndex(i);
    const { name: functionName, base: importBase } = binaryen.getFunctionInfo(panicFunction);
    if (importBase === '' && /^<?(core|alloc|std|__rustc)(\[|::)/.test(functionName) && panicNamePattern.test(functionName)) {
      functionWrapper.setBody(panicFunction, binaryenModule.unreachable());
    }
  }
  writeFileSync(absolutePathOf(filePath), binaryenModule.emitBinary());
  binaryenModule.dispose();
}

/** Passes of the optimizer. The usual passes are followed by a second merge of variables with equal values. */
const OPTIMIZER_PASSES = ['-O3', '--converge', '--rse', '--vacuum', '--coalesce-locals', '--reorder-locals'];

/** Optimizes a module in its file, and returns the output of the optimizer. @param {string} filePath @param {string[]} optimizerPasses */
async function optimizeModule(filePath, optimizerPasses = OPTIMIZER_PASSES) {
  // Features that rustc enables by default for WebAssembly, and SIMD from .cargo/config.toml.
  const wasmFeatures = ['bulk-memory', 'multivalue', 'mutable-globals', 'nontrapping-float-to-int', 'reference-types', 'sign-ext', 'simd'];
  const { stdout } = await runOrThrow('wasm-opt failed: see above.', process.execPath, [
    absolutePathOf('node_modules/binaryen/bin/wasm-opt'), ...optimizerPasses, ...wasmFeatures.map((featureName) => `--enable-${featureName}`), absolutePathOf(filePath),
    '-o', absolutePathOf(filePath)], { isQuiet: true });
  return stdout;
}

/**
 * Names by which a module and its glue call each other.
 *
 * @typedef {object} Names
 * @property {[module: string, name: string, short: string][]} imports
 * @property {[name: string, short: string][]} exports
 */

/** Returns the names that wasm-bindgen has given to imports and exports. @param {string} moduleName @returns {Names} */
function readGlueNames(moduleName) {
  const wasmModule = new WebAssembly.Module(readFileSync(absolutePathOf(`build/${moduleName}.wasm`)));
  return {
    imports: WebAssembly.Module.imports(wasmModule).map((importEntry) => [importEntry.module, importEntry.name, importEntry.name]),
    exports: WebAssembly.Module.exports(wasmModule).map((exportEntry) => [exportEntry.name, exportEntry.name]),
  };
}

/** Shortens the names of imports and exports, which saves some 2 kB of transfer. @param {string} moduleName @returns {Promise<Names>} */
async function shortenNames(moduleName) {
  const { imports: wasmImports, exports: wasmExports } = JSON.parse(await optimizeModule(`build/${moduleName}.wasm`, ['--minify-imports-and-exports-and-modules']));
  return { exports: wasmExports, imports: wasmImports.map((/** @type {string[]} */ [, importName, shortName]) => ['a', importName, shortName]) };
}

/**
 * Converts wasm-bindgen's glue to a module that exports a function, which creates a new instance of the core. The original glue has exactly
 * one instance. Exports that nobody imports are left out.
 *
 * @param {string} moduleName
 * @param {Names} glueNames names by which the module and its glue call each other
 */
async function writeGlue(moduleName, glueNames) {
  const glueChanges = /** @type {[RegExp, string][]} */ ([
    // Errors that wasm-bindgen itself throws get the class of traps, because they make a core unusable too.
    [/throw new Error\((?=getStringFromWasm)/g, 'throw new WebAssembly.RuntimeError('],
    // The lines for freeing objects are removed, because www/core.ts frees the objects of all classes.
    [/^if \(Symbol\.dispose\) .*$/gm, ''],
    [/new FinalizationRegistry\(/g, '/* @__PURE__ */ $&'],
    // wasm-bindgen adds the members of a namespace one by one, which bundlers take for side effects. A single pure expression lets them drop unused namespaces.
    [/^export const (\w+) = \{\};\n((?:\1\.\w+ = \w+;\n)+)/gm, 'export const $1 = /* @__PURE__ */ (($1) => {\n$2return $1;\n})({});\n'],
  ]);
  const bindgenGlue = readFileSync(absolutePathOf(`build/bound/${moduleName}/motion_bg.js`), 'utf8');
  // Only the core of all widgets must match every pattern. The core of one widget has no namespaces, which the last pattern finds.
  const missingChange = moduleName === 'motion' && glueChanges.find(([gluePattern]) => !bindgenGlue.match(gluePattern));
  if (missingChange) throw new Error(`wasm-bindgen's glue has no ${missingChange[0]}, which scripts/build.mjs replaces.`);
  const changedGlue = glueChanges.reduce((glueText, [gluePattern, glueReplacement]) => glueText.replace(gluePattern, glueReplacement), bindgenGlue);
  const exportNames = [...bindgenGlue.matchAll(/^export (?:class|function|const|let) (?!__)(\w+)/gm)].map(([, exportName]) => exportName);
  const { build: bundleScript } = await import('esbuild');
  const gluePlugin = { name: 'glue', setup: (/** @type {import('esbuild').PluginBuild} */ { onLoad }) => onLoad({ filter: /motion_bg\.js$/ }, () => ({ contents: changedGlue })) };
  const { outputFiles } = await bundleScript({
    stdin: { contents: `export { ${[...exportNames, ...glueNames.imports.map(([, importName]) => importName), '__wbg_set_wasm']} } from './motion_bg.js';`, resolveDir: absolutePathOf(`build/bound/${moduleName}`) },
    bundle: true,
    format: 'esm',
    write: false,
    charset: 'utf8',
    plugins: [gluePlugin],
  });
  const shortNameByExport = new Map(glueNames.exports);
  const shortNameOf = (/** @type {string} */ exportName) => shortNameByExport.get(exportName) ?? (() => { throw new Error(`The core of ${moduleName} does not export ${exportName}.`); })();
  const glueBody = outputFiles[0].text.replace(/^export \{[^}]*\};\s*$/m, '').replaceAll(/\bwasm\.(\w+)/g, (_, exportName) => `wasm.${shortNameOf(exportName)}`);
  const moduleLines = [
    'export default async (module) => {',
    glueBody,
    `const { exports } = await WebAssembly.instantiate(module, { '${glueNames.imports[0][0]}': { ${glueNames.imports.map(([, importName, exportName]) => `${exportName}: ${importName}`)} } });`,
    '__wbg_set_wasm(exports);',
    `exports.${shortNameOf('__wbindgen_start')}();`,
    `return { ${exportNames} };`,
    '};',
  ];
  writeFileSync(absolutePathOf(`build/${moduleName}.js`), `${moduleLines.join('\n')}\n`);
  const declarationLine = 'declare const instantiate: (module: WebAssembly.Module) => Promise<typeof import("./simulations.d.ts")>;\n';
  writeFileSync(absolutePathOf(`build/${moduleName}.d.ts`), `${declarationLine}export default instantiate;\n`);
}

await runAsScript(import.meta.url, async () => {
  await buildProject({ isLocal: process.argv.includes('--local') });
  console.log('\ndist/ is up to date.');
});
