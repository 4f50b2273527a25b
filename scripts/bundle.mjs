// Bundles www/ to dist/: variants for a page, a bundler, an iframe, a local file and Node. doc/embedding.md describes them.

import { createHash } from 'node:crypto';
import { appendFileSync, chmodSync, copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, relative } from 'node:path';
import { build, transformSync } from 'esbuild';
import * as declared from '../build/settings.js';
import { importTypeScript } from './declarations.mjs';
import { readLicenceTexts, listBundledPackages } from './licences.mjs';
import { createManifest } from './manifest.mjs';
import { MAIN_PAGES, writePages } from './pages.mjs';
import { REPOSITORY_ROOT, UserError, absolutePathOf, filesOf, printStep } from './process.mjs';
import { writePython } from './python.mjs';
import { writeComponents } from './react.mjs';
import { writeTypes } from './types.mjs';

export const WIDGET_TAGS = Object.keys(declared.settings);

/** Name of the module with the bytes of the whole core. The module exports a function that returns the bytes. */
const BYTES_MODULE_NAME = 'motion.bytes';

/**
 * Placeholder for the name of the chunk that contains `MODULE_SOURCES.external`. The placeholder has the same length as the name, so that
 * source maps stay valid. If the address of the chunk lacks that name, a bundler has moved the chunk.
 */
const CHUNK_PLACEHOLDER = 'chunk-________.js';

/** Tags of the figures whose logs a worker reads. */
const LOG_FIGURE_TAGS = ['alpha-calibrator'];

/** Path of the worker's script in dist/. */
const LOG_WORKER_PATH = 'chunks/log-worker.js';

/**
 * Returns the source of the function `startWorker`. Within dist/ `startWorker` finds the worker's script by a relative path. A page of
 * another origin starts the worker by a script of its own that imports the worker's script.
 *
 * @param {string} distPath path of dist/, relative to the bundle
 * @param {string} [fallbackStatement] statement for a bundle that is part of another bundle
 */
const startWorkerSource = (distPath, fallbackStatement = '') =>
  'export function startWorker() {' +
  '  const here = import.meta.url;' +
  `  if (here?.includes('${CHUNK_PLACEHOLDER}')) {` +
  `    const url = new URL('${distPath}${LOG_WORKER_PATH}', here);` +
  '    const script = () => URL.createObjectURL(new Blob([`import ${JSON.stringify(url)}`], { type: "text/javascript" }));' +
  '    return new Worker(url.origin === location.origin ? url : script(), { type: "module" });' +
  '  }' +
  `  ${fallbackStatement} ` +
  '}';

/** Sources of the modules that replace a bundle's import of the WebAssembly module. These modules export the cores with their glue. */
const MODULE_SOURCES = {
  /**
   * Module whose text contains one character for each byte. The character's code, modulo 256, is the byte. Brotli and gzip compress this
   * text almost as well as the WebAssembly module (7 % more bytes are transferred). Base64 or compressed bytes would be larger.
   *
   * @param {Uint8Array} bytes
   * @param {RegExp} shiftedCharacters characters to whose code 256 is added
   */
  bytes: (bytes, shiftedCharacters) => {
    const byteText = Buffer.from(bytes).toString('latin1').replaceAll(shiftedCharacters, (textCharacter) => String.fromCharCode(textCharacter.charCodeAt(0) + 256));
    return (
      `const text = ${JSON.stringify(byteText)};` +
      // `Uint8Array.from` would take ten times as long, because it uses the string's iterator.
      'export default () => { const bytes = new Uint8Array(text.length);' +
      'for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i); return bytes; };'
    );
  },
  /**
   * JavaScript glue for the worker that reads logs, without WebAssembly modules. The page sends a compiled module to the worker.
   *
   * @param {string[]} widgetTags tags of the figures with logs that have a module of their own
   */
  worker: (widgetTags) => {
    const glueLines = ['motion', ...widgetTags].map((widgetTag, i) => [`import * as glue${i} from './${widgetTag}.js';`, `'${widgetTag}': { glue: async () => glue${i} }`]);
    return `${glueLines.map(([importLine]) => importLine).join('')} export default { ${glueLines.map(([, exportEntry]) => exportEntry).join(', ')} }; export function startWorker() {}`;
  },
  /** The core without elements. Its bytes are in a separate script, which external.js uses too. */
  core: () => `import * as motion from './motion.js'; export default { motion: { glue: async () => motion, source: async () => (await import('${BYTES_MODULE_NAME}')).default() } }; export function startWorker() {}`,
  /** The core and its bytes in one script. @param {boolean} isClassic */
  inlined: (isClassic) => `import source from '${BYTES_MODULE_NAME}'; import * as motion from './motion.js'; export default { motion: { glue: async () => motion, source } };${isClassic ? 'export function startWorker() {}' : startWorkerSource('./')}`,
  /**
   * Bundlers such as Vite and webpack copy the file of `new URL(…, import.meta.url)`, and replace its address. Bundlers such as
   * esbuild and Rollup change nothing, so that the address in the bundled script is wrong. A classic script has no
   * `import.meta.url`. For these cases `embedded` loads a script with the bytes. external.js and the widgets share this chunk.
   *
   * @param {string[]} widgetTags tags of the figures that have a separate module
   */
  external: (widgetTags) => {
    const modulePaths = [['motion', '../motion.wasm'], ...widgetTags.map((widgetTag) => [widgetTag, `./${basename(moduleFileOf(widgetTag).path)}`])];
    const coreEntries = modulePaths.map(([coreName, modulePath]) => (
      `'${coreName}': { glue: () => import('./${coreName}.js'), source: () => bundledSource('${modulePath}', () => new URL('${modulePath}', import.meta.url)) }`
    ));
    return (
      'const here = import.meta.url;' +
      'const bundledSource = (path, written) => {' +
      '  const url = here && written();' +
      `  return url && (here.includes('${CHUNK_PLACEHOLDER}') || url.href !== new URL(path, here).href) ? url : undefined;` +
      '};' +
      `const embedded = { glue: () => import('./motion.js'), source: async () => (await import('${BYTES_MODULE_NAME}')).default() };` +
      `const all = { embedded, ${coreEntries} }; export default all;` +
      startWorkerSource('../', `if (all.motion.source()) return new Worker(new URL('./${basename(LOG_WORKER_PATH)}', import.meta.url), { type: 'module' });`)
    );
  },
};

/** Returns the module that a widget needs, without the simulations of other widgets. @param {string} widgetTag */
const moduleFileOf = (widgetTag) => hashedFileOf(widgetTag, '.wasm', readFileSync(absolutePathOf(`build/${widgetTag}.wasm`)));

/**
 * Returns a file of dist/chunks/ with a hash of its contents in the name.
 *
 * @param {string} baseName
 * @param {string} fileExtension
 * @param {string | Uint8Array} fileContents
 */
function hashedFileOf(baseName, fileExtension, fileContents) {
  const contentHash = createHash('sha256').update(fileContents).digest('hex').slice(0, 8);
  return { path: `dist/chunks/${baseName}-${contentHash}${fileExtension}`, contents: fileContents };
}

/** Characters of an inlined module to whose codes 256 is added, because bundlers or minifiers of a page might damage these characters. */
const SHIFTED_CHARACTERS = {
  /** Characters that some minifiers escape with a backslash. 256 is added to their codes in scripts in UTF-8. */
  utf8: /[^ -~\x80-\xff]|["$'\\`]/g,
  /** Digits after a zero byte. If a minifier writes this byte as `\0`, the digit would continue the octal escape. */
  ascii: /(?<=\0)\d/g,
};

/** Modules that replace www/address.ts in classic scripts and in chunks. */
const ADDRESS_MODULES = {
  /** Address of a classic script, which is known only while the script is evaluated. */
  classic: "export const address = globalThis.document?.currentScript?.src ?? ''; export const isClassic = true;",
  /** Address of the script to which a chunk belongs. */
  chunk: "export const address = (import.meta.url ?? '').replace(/chunks\\/[^/]*$/, 'external.js'); export const isClassic = false;",
};

/** TypeScript declarations of the exports of those scripts that define custom elements. */
const ELEMENT_DECLARATIONS = `export * from './core.js';
/** Sets messages of the elements in a language (a BCP 47 tag). The messages are those of messages/en.ts, or some of them. */
export declare function setMessages(lang: string, messages: object): void;
/** Returns true for the tag of a figure. Template compilers call this function to recognize custom elements. */
export declare function isFigureTag(tag: string): boolean;
`;

/**
 * Writes all bundles to dist/.
 *
 * @param {object} [options]
 * @param {string[]} [options.tags] the figures that have a module of their own; the others share the whole core
 */
export async function bundlePages({ tags: widgetTags = WIDGET_TAGS } = {}) {
  printStep('Bundling the pages');
  await writeTypes();
  await writeComponents();
  writeFileSync(absolutePathOf('build/widgets.js'), composeWidgetLoaders());
  const moduleBytes = readFileSync(absolutePathOf('build/motion.wasm'));
  const bytesScript = hashedFileOf('motion-bytes', '.js', MODULE_SOURCES.bytes(moduleBytes, SHIFTED_CHARACTERS.utf8));
  /**
   * Bundles scripts of www/ for dist/.
   *
   * @param {Record<string, string>} entryPoints paths from www/, by the name of the script in dist/
   * @param {'core' | 'external' | 'inlined' | 'worker'} bundleForm
   * @param {import('esbuild').BuildOptions} buildOptions
   */
  const bundleScripts = (entryPoints, bundleForm, buildOptions) =>
    build({
      entryPoints: Object.entries(entryPoints).map(([outputName, filePath]) => ({ in: join('www', filePath), out: outputName })),
      absWorkingDir: REPOSITORY_ROOT,
      outdir: absolutePathOf('dist'),
      bundle: true,
      minify: true,
      // Only a local build has source maps. In such a build no figure has a module of its own.
      sourcemap: widgetTags.length === 0,
      format: 'esm',
      target: 'es2022',
      charset: 'utf8',
      inject: [absolutePathOf('www/without-dom.ts')],
      // Modules are always strict. A classic script needs the directive "use strict".
      tsconfigRaw: { compilerOptions: { alwaysStrict: buildOptions.format === 'iife' } },
      plugins: [
        {
          name: 'wasm',
          setup({ onLoad, onResolve }) {
            const moduleSources = {
              core: MODULE_SOURCES.core,
              external: () => MODULE_SOURCES.external(widgetTags),
              worker: () => MODULE_SOURCES.worker(widgetTags.filter((widgetTag) => LOG_FIGURE_TAGS.includes(widgetTag))),
              inlined: () => MODULE_SOURCES.inlined(buildOptions.format === 'iife'),
            };
            onLoad({ filter: /\.wasm$/ }, () => ({ contents: moduleSources[bundleForm](), loader: 'js' }));
            if (buildOptions.platform === 'node') onResolve({ filter: /^\.\/core\.ts$/ }, () => ({ path: './core.js', external: true }));
            // Scripts of the form `core` or `external` import the bytes of the core from a shared chunk.
            const bytesPath = { core: `./chunks/${basename(bytesScript.path)}`, external: `./${basename(bytesScript.path)}`, inlined: undefined, worker: undefined }[bundleForm];
            onResolve({ filter: new RegExp(`^${BYTES_MODULE_NAME}$`) }, ({ path: filePath }) => (bytesPath ? { path: bytesPath, external: true } : { path: filePath, namespace: 'core' }));
            onLoad({ filter: /./, namespace: 'core' }, () => ({ contents: MODULE_SOURCES.bytes(moduleBytes, SHIFTED_CHARACTERS[buildOptions.charset === 'ascii' ? 'ascii' : 'utf8']) }));
            // A page that cannot start a worker imports the worker's script instead, which exports the session.
            if (bundleForm === 'external') onResolve({ filter: /\/logs\/session\.ts$/ }, () => ({ path: `./${basename(LOG_WORKER_PATH)}`, external: true }));
            onLoad({ filter: /[/\\]build[/\\]settings\.js$/ }, () => ({ contents: composeMinimalDeclarations(), loader: 'js' }));
            onLoad({ filter: /[/\\]www[/\\]address\.ts$/ }, ({ path: filePath }) => ({
              contents: buildOptions.format === 'iife' ? ADDRESS_MODULES.classic : buildOptions.splitting ? ADDRESS_MODULES.chunk : readFileSync(filePath, 'utf8'),
              loader: 'js',
            }));
            onLoad({ filter: /[/\\](?:js-yaml|d3-array)\.mjs$/ }, ({ path: filePath }) => ({
              contents: markConstantsPure(readFileSync(filePath, 'utf8')),
              loader: 'js',
            }));
            onLoad({ filter: /[/\\](?:zstddec-stream\.mjs|lit-html\.js)$/ }, ({ path: filePath }) => ({
              contents: replacePassages(readFileSync(filePath, 'utf8'), /** @type {keyof typeof REPLACED_PASSAGES} */ (basename(filePath))),
              loader: 'js',
            }));
            onLoad({ filter: /[/\\]www[/\\].+\.[jt]s$/ }, ({ path: filePath }) => ({
              contents: removeIndentation(minifyStyles(readFileSync(filePath, 'utf8'))),
              loader: filePath.endsWith('.ts') ? 'ts' : 'js',
            }));
          },
        },
      ],
      ...buildOptions,
      metafile: true,
      write: false,
    });
  const bundleResults = await Promise.all([
    bundleScripts({ core: 'core.ts' }, 'core', { inject: [] }),
    bundleScripts({ 'motion-widgets': 'motion-widgets.ts' }, 'inlined', {}),
    // The module for notebooks has no source map, because Jupyter sends only the text of the module.
    bundleScripts({ anywidget: 'anywidget.ts' }, 'inlined', { sourcemap: false }),
    bundleScripts({ external: 'external.ts' }, 'external', { splitting: true, chunkNames: 'chunks/[name]-[hash]' }),
    bundleScripts({ [LOG_WORKER_PATH.replace('.js', '')]: 'log-worker.ts' }, 'worker', { inject: [] }),
    bundleScripts({ 'motion-widgets.iife': 'motion-widgets.ts' }, 'inlined', { format: 'iife', charset: 'ascii', sourcemap: false }),
    bundleScripts({ react: '../build/react.js' }, 'inlined', { external: ['react', 'motion-widgets'], inject: [] }),
    bundleScripts({ de: 'de.ts', page: 'page.ts', 'server-component': 'server-component.ts' }, 'inlined', { inject: [] }),
    // The script of the command line loads the core from core.js in its directory.
    bundleScripts({ cli: 'cli.ts' }, 'inlined', { platform: 'node', sourcemap: false, inject: [] }),
    bundleScripts({ embed: 'embed.ts' }, 'inlined', { format: 'iife', sourcemap: false, inject: [] }),
  ]).catch(() => []);
  if (!bundleResults.length || bundleResults.some(({ warnings: bundleWarnings }) => bundleWarnings.length)) {
    throw new UserError('The pages do not bundle: see the messages above.');
  }

  rmSync(absolutePathOf('dist'), { recursive: true, force: true });
  const writeOutput = (/** @type {string} */ filePath, /** @type {string | Uint8Array} */ fileContents) => {
    mkdirSync(dirname(filePath), { recursive: true });
    writeFileSync(filePath, fileContents);
  };
  for (const { path: filePath, contents: fileContents, text } of bundleResults.flatMap(({ outputFiles }) => outputFiles)) {
    const outputContents = text.includes(CHUNK_PLACEHOLDER) ? text.replaceAll(CHUNK_PLACEHOLDER, basename(filePath, '.map')) : fileContents;
    writeOutput(filePath, filePath.endsWith('.iife.js') ? escapeNonAscii(text) : outputContents);
  }
  writeOutput(absolutePathOf('dist/custom-elements.json'), `${JSON.stringify(await createManifest(), null, 1)}\n`);
  for (const filePath of filesOf('www').filter((filePath) => /\.(html|css)$/.test(filePath))) copyFileSync(absolutePathOf(filePath), absolutePathOf(join('dist', relative('www', filePath))));
  await writePages('dist', MAIN_PAGES);
  const { createPreUpgradeCss } = await importTypeScript('www/ui/reserved-height.ts');
  // Figures need scripts. If scripts are disabled, no height is reserved for figures.
  const reservedHeightCss = `@media (scripting:enabled){\n${createPreUpgradeCss()}\n}`;
  // Slides have a large font, which is too large for figures. `:where` has no specificity, so that any rule of a page takes precedence.
  const slideCss = `:where(.reveal) :where(${WIDGET_TAGS}){font-size:.27em;text-align:start}`;
  appendFileSync(absolutePathOf('dist/motion-widgets.css'), `\n:where(${WIDGET_TAGS}){margin-block:1em}\n${slideCss}\n${reservedHeightCss}\n`);
  writeOutput(absolutePathOf('dist/motion.wasm'), moduleBytes);
  for (const { path: filePath, contents: fileContents } of [bytesScript, ...widgetTags.map(moduleFileOf)]) writeOutput(absolutePathOf(filePath), fileContents);
  const declarationPaths = { core: 'www/types.d.ts', simulations: 'build/simulations.d.ts', elements: 'build/elements.d.ts', react: 'build/react.d.ts', solid: 'build/solid.d.ts', svelte: 'build/svelte.d.ts' };
  for (const [name, filePath] of Object.entries(declarationPaths)) writeOutput(absolutePathOf(`dist/${name}.d.ts`), flattenImports(readFileSync(absolutePathOf(filePath), 'utf8')));
  writeOutput(absolutePathOf('dist/external.d.ts'), ELEMENT_DECLARATIONS);
  for (const name of ['de', 'motion-widgets.css']) writeOutput(absolutePathOf(`dist/${name}.d.ts`), 'export {};\n');
  chmodSync(absolutePathOf('dist/cli.js'), 0o755);
  writeOutput(absolutePathOf('dist/classroom.html'), composeInlinedPage('index.html'));
  // Sizes of the bundles, which tests/package/sizes.nightly.test.js reads.
  const bundleOutputs = Object.assign({}, ...bundleResults.map(({ metafile }) => metafile.outputs));
  writeOutput(absolutePathOf('build/outputs.json'), JSON.stringify(bundleOutputs));
  const linkedCrates = JSON.parse(readFileSync(absolutePathOf('build/crates.json'), 'utf8'));
  writeOutput(absolutePathOf('dist/LICENSE-third-party.txt'), readLicenceTexts([...listBundledPackages(bundleOutputs), ...linkedCrates]));
  await writePython();
}

/** Pattern of an expression in a template string. The expression may contain template strings, but no braces outside of them. */
const EXPRESSION_SOURCE = String.raw`\$\{(?:[^{}\x60]|\x60[^\x60]*\x60)*\}`;
const EXPRESSIONS_RE = new RegExp(EXPRESSION_SOURCE, 'g');
const STYLES_RE = new RegExp(String.raw`(?<=\b(?:css|unsafeCSS\()\x60)(?:[^\x60$]|${EXPRESSION_SOURCE})*(?=\x60)`, 'g');

/**
 * Minifies the styles in a script. Bundlers do not minify them, because the styles are template strings. An expression at the beginning of
 * a line stands for rules or declarations, and is given to the minifier as an at-rule. Any other expression is given as a name.
 *
 * @param {string} scriptSource
 */
function minifyStyles(scriptSource) {
  return scriptSource.replace(STYLES_RE, (styleText) => {
    /** @type {string[]} */
    const templateExpressions = [];
    const plainStyle = styleText.replace(EXPRESSIONS_RE, (templateExpression, expressionPosition) => {
      const expressionPlaceholder = `expression${templateExpressions.push(templateExpression)}`;
      return /(^|\n) *$/.test(styleText.slice(0, expressionPosition)) ? `@${expressionPlaceholder};` : expressionPlaceholder;
    });
    const { code: minifiedStyle, warnings: bundleWarnings } = transformSync(plainStyle, { loader: 'css', minify: true });
    if (bundleWarnings.length > 0) throw new UserError(`Style that cannot be read: ${bundleWarnings[0].text} in ${plainStyle}`);
    return minifiedStyle.trim().replace(/@expression(\d+);|expression(\d+)/g, (_, statementNumber, valueNumber) => templateExpressions[Number(statementNumber ?? valueNumber) - 1]);
  });
}

/** Removes the indentation of lines in HTML templates. Browsers show a line break with or without spaces in the same way. */
const removeIndentation = (/** @type {string} */ script) => script.replaceAll(/^ +(?=[<$@.?])/gm, '');

/**
 * Escapes non-ASCII characters in a script, because a classic script is read in the encoding of its page. The bundler leaves such
 * characters in tagged templates and regular expressions.
 *
 * @param {string} script
 */
function escapeNonAscii(script) {
  return script.replaceAll(/[^\0-\x7f]/g, (codeUnit) => `\\u${codeUnit.charCodeAt(0).toString(16).padStart(4, '0')}`);
}

/** Returns a module with the loaders of the widgets for external.js. */
const composeWidgetLoaders = () =>
  `/** @type {Record<string, () => Promise<unknown>>} by their tags */\nexport const widgets = {\n${WIDGET_TAGS.map((widgetTag) => `  '${widgetTag}': () => import('../www/widgets/${widgetTag}/${widgetTag}.ts'),\n`).join('')}};\n`;

/**
 * Returns the declarations of settings without documentation, and without defaults that the default of the group contains. No page uses
 * these parts.
 */
function composeMinimalDeclarations() {
  const toJson = (/** @type {unknown} */ declarationValue) => JSON.stringify(declarationValue, function (memberKey, memberValue) {
    return ['sentence', 'nullable'].includes(memberKey) || (memberKey === 'default' && 'in' in this) ? undefined : memberValue;
  });
  return Object.entries(declared).map(([constantName, constantValue]) => `export const ${constantName} = ${toJson(constantValue)};\n`).join('');
}

/**
 * Marks the constants of a library as pure, so that the bundler drops unused ones, such as those for writing YAML. The bundler cannot know
 * that computing the constants has no side effects.
 *
 * @param {string} librarySource source in which each constant starts a line
 */
function markConstantsPure(librarySource) {
  return librarySource
    .replaceAll(/^((?:var|const) \w+ = )((?:new |`|\w+[.(]).*);$/gm, '$1/* @__PURE__ */ (() => $2)();')
    .replaceAll(/^(var \w+ = )(?=\w+\(|new \w)/gm, '$1/* @__PURE__ */ ');
}

/** Replaced passages of libraries, by the file name of the library. */
const REPLACED_PASSAGES = {
  // This library fetches its WebAssembly module from a data URL, which strict content security policies forbid. The text of the URL is decoded instead.
  'zstddec-stream.mjs': [
    ['typeof fetch !== "undefined"', 'false'],
    ['Buffer.from(wasm, "base64")', 'Uint8Array.from(atob(wasm), (character) => character.charCodeAt(0))'],
  ],
  'lit-html.js': [
    // Lit's Trusted Types policy gets another name, because another copy of Lit on the page may use the name "lit-html". If the other name is
    // refused, "lit-html" is tried. If that name is refused too, loading continues, and only rendering fails.
    [
      's.createPolicy("lit-html",{createHTML:t=>t})',
      '((...names)=>{for(const name of names)try{return s.createPolicy(name,{createHTML:t=>t})}catch{}})("motion-widgets","lit-html")',
    ],
    // Page translators replace text nodes. Therefore no part of a template may end at a text node, and a missing text node is created
    // again.
    ['r=`<${n}>`', 'r=`<${n}><!---->`'],
    ['a(this._$AH)?', 'a(this._$AH)&&3===this._$AA.nextSibling?.nodeType?'],
  ],
};

/** Returns a library with its `REPLACED_PASSAGES` replaced. @param {string} librarySource @param {keyof typeof REPLACED_PASSAGES} libraryFileName */
function replacePassages(librarySource, libraryFileName) {
  return REPLACED_PASSAGES[libraryFileName].reduce((text, [originalPassage, replacementPassage]) => {
    if (text.split(originalPassage).length !== 2) throw new Error(`${libraryFileName} does not have ${originalPassage} once, but scripts/bundle.mjs replaces it.`);
    return text.replace(originalPassage, () => replacementPassage);
  }, librarySource);
}

/** Adapts import paths in types to the published directory, in which all types are side by side. @param {string} typesSource */
function flattenImports(typesSource) {
  return typesSource.replaceAll(/'\.\.\/build\/(\w+)\.d\.ts'/g, "'./$1.js'").replaceAll("'../www/types.d.ts'", "'./core.js'");
}

/**
 * Inlines styles and scripts into a page of dist/. Browsers refuse external scripts of type "module" in a page that is opened from a disk.
 * They accept inline ones.
 *
 * @param {string} name
 */
function composeInlinedPage(name) {
  const readDistFile = (/** @type {string} */ filePath) => readFileSync(absolutePathOf(join('dist', filePath)), 'utf8').replace(/\n?\/\/# sourceMappingURL=\S+\s*$/, '');
  const styleLink = /<link rel="stylesheet" href="([\w.-]+)">/g;
  const scriptTag = /<script type="module" src="([\w.-]+)"><\/script>/g;
  const pageHtml = readDistFile(name);
  const inlineScript = (/** @type {string} */ filePath) =>
    `<script type="module">${readDistFile(filePath).replaceAll(/<(?=\/script|!--)/gi, '\\x3C')}</script>`;
  // Links to other pages are replaced by their text, because a copied file does not have the other pages next to it.
  return pageHtml
    .replaceAll(/<a href="(?!#)[^"]*">([^<]*)<\/a>/g, '$1')
    .replace(styleLink, (_, filePath) => `<style>\n${readDistFile(filePath)}</style>`)
    .replace(scriptTag, (_, filePath) => inlineScript(filePath === 'external.js' ? 'motion-widgets.iife.js' : filePath));
}
