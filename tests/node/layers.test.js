// Imports between the folders of www/. Only imports that doc/implementation-notes.md allows may exist. The linter finds import cycles.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { test } from 'node:test';
import { build } from 'esbuild';
import { settings } from '../../build/settings.js';

/** Folders of www/ as layers, from top to bottom. A file imports from its own layer and from lower layers. */
const LAYER_FOLDERS = ['www/widgets', 'www/figure', 'www/scene', 'www/ui', 'www/messages', 'www/data'];

const { metafile } = await build({
  entryPoints: ['www/motion-widgets.ts', 'www/external.ts', 'www/de.ts', 'www/embed.ts', 'www/anywidget.ts'],
  absWorkingDir: new URL('../..', import.meta.url).pathname,
  bundle: true,
  write: false,
  metafile: true,
  format: 'esm',
  outdir: 'nowhere',
  loader: { '.wasm': 'empty' },
});

/** @type {[string, string][]} importing and imported file of each import within www/ */
const importPairs = Object.entries(metafile.inputs).flatMap(([importerPath, { imports: importPairs }]) =>
  importPairs.filter(({ path }) => importerPath.startsWith('www/') && path.startsWith('www/')).map(({ path }) => /** @type {[string, string]} */ ([importerPath, path])),
);

test('this test checks all scripts of the page', () => {
  assert.ok(importPairs.length > 150, `${importPairs.length} imports`);
  for (const layerFolder of LAYER_FOLDERS) assert.ok(importPairs.some(([, importedPath]) => importedPath.startsWith(layerFolder)), layerFolder);
});

test('no file imports from a higher layer, and no widget imports from another widget', () => {
  const layerOf = (/** @type {string} */ path) => LAYER_FOLDERS.findIndex((layer) => path.startsWith(`${layer}/`));
  for (const [importerPath, importedPath] of importPairs) {
    const [importerLayer, importedLayer] = [layerOf(importerPath), layerOf(importedPath)];
    if (importerLayer >= 0 && importedLayer >= 0) assert.ok(importerLayer <= importedLayer, `${importerPath} imports ${importedPath}`);
    const [importerWidget, importedWidget] = [importerPath, importedPath].map((path) => path.match(/^www\/widgets\/([^/]+)\//)?.[1]);
    if (importerWidget && importedWidget) assert.ok(importerWidget === importedWidget || importedWidget === 'shared', `${importerPath} imports ${importedPath}`);
  }
});

test('readers of logs import neither page code, nor Node modules, nor the core', () => {
  const readerFiles = Object.entries(metafile.inputs).filter(([path]) => path.startsWith('www/logs/'));
  assert.ok(readerFiles.length > 5, `${readerFiles.length} files`);
  for (const [path, { imports }] of readerFiles) {
    for (const imported of imports) assert.match(imported.path, /^(www\/logs\/|node_modules\/)/, `${path} imports ${imported.path}`);
  }
});

test('only core.ts imports the generated glue', () => {
  const coreImporters = Object.entries(metafile.inputs).filter(([, { imports }]) => imports.some(({ path }) => /^build\/motion/.test(path)));
  assert.deepEqual(coreImporters.map(([path]) => [dirname(path), path]), [['www', 'www/core.ts']]);
});

test('the class of a widget directly extends the base class, which directly extends Lit’s class', () => {
  const sourceFiles = new Set(importPairs.flat());
  const classDeclarations = [...sourceFiles].flatMap((sourcePath) =>
    [...readFileSync(new URL(`../../${sourcePath}`, import.meta.url), 'utf8').matchAll(/\bclass (\w+)(?:<.+>)? extends (\w+)/g)].map(([, className, baseClassName]) => ({ file: sourcePath, name: className, base: baseClassName })),
  );
  const elementClasses = classDeclarations.filter(({ base }) => /Element$/.test(base));
  assert.deepEqual(
    elementClasses.filter(({ base }) => base !== 'FigureElement').map(({ file, name: className, base }) => [file, className, base]),
    [['www/figure/figure.ts', 'FigureElement', 'LitElement']],
  );
  for (const widgetTag of Object.keys(settings)) {
    assert.ok(elementClasses.some(({ file, base }) => file === `www/widgets/${widgetTag}/${widgetTag}.ts` && base === 'FigureElement'), widgetTag);
  }
});
