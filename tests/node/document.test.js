// Documents. The tests check links, lengths, names of files and commands, and numbers: limits of the pages, presets, and true parameters of
// the example log.

import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { AMCL_LEG_LENGTH, TRUE_PARAMETERS } from '../../scripts/example-log.mjs';
import { REPOSITORY_ROOT, filesOf } from '../../scripts/process.mjs';
import { presets } from '../../build/settings.js';

const readText = (/** @type {string} */ documentPath) => readFileSync(new URL(`../../${documentPath}`, import.meta.url), 'utf8');

/** Files and names of constants, with the sentence of the document that contains the value. @type {[string, string, RegExp][]} */
const DOCUMENTED_LIMITS = [
  ['www/widgets/banana-machine/pictures.ts', 'MAX_DOT_COUNT', /Up to (\S+) robots are drawn as dots/],
  ['www/widgets/map-squeeze/settings.ts', 'MAX_DOT_COUNT', /more than (\S+) motions are drawn as cells/],
  ['www/widgets/banana-machine/readouts.ts', 'VISIBLE_SKEW', /exact skew is below (\S+) \| both sides are nearly alike/],
  ['www/widgets/banana-machine/readouts.ts', 'VISIBLE_AREA_RATIO', /if the ellipse has more than (\S+) times the area/],
  ['www/widgets/banana-machine/readouts.ts', 'MIN_DISTINGUISHABLE_GAIN', /or if the gain is more than (\S+) nats a robot/],
];

test('doc/model.md and doc/statistics.md state the same limits as the source code', () => {
  const documentTexts = `${readText('doc/model.md')}${readText('doc/statistics.md')}`.replace(/\s+/g, ' ');
  for (const [sourcePath, constantName, sentencePattern] of DOCUMENTED_LIMITS) {
    const [, limitText] = readText(sourcePath).match(new RegExp(`const ${constantName} = ([\\d._]+);`)) ?? [];
    assert.ok(limitText, `${constantName} of ${sourcePath}`);
    assert.equal(documentTexts.match(sentencePattern)?.[1], limitText, `${constantName} of ${sourcePath}`);
  }
});

test('README.md lists the presets of each figure', () => {
  const readmeText = readText('README.md').replace(/\s+/g, ' ');
  for (const [widgetTag, presetsOfTag] of Object.entries(presets)) {
    if (presetsOfTag.length > 0) assert.ok(readmeText.includes(`\`${widgetTag}\` ${presetsOfTag.map(({ name: presetName }) => presetName).join(', ')}`), widgetTag);
  }
});

test('the README of the example log states the true parameters', () => {
  const readmeText = readText('examples/calibration/README.md');
  const { alphas, mountYaw, clockOffset, distanceScale } = TRUE_PARAMETERS;
  for (const expectedText of [`| ${alphas.join(', ')} |`, `| ${mountYaw} rad |`, `| ${clockOffset} s later |`, `| ${distanceScale} |`, `${AMCL_LEG_LENGTH.distance} m`, `${AMCL_LEG_LENGTH.angle} rad`]) {
    assert.ok(readmeText.includes(expectedText), expectedText);
  }
});

test('files and commands named in doc/reliability.md exist', () => {
  const reliabilityText = readText('doc/reliability.md');
  const { scripts } = JSON.parse(readText('package.json'));
  const commandNames = [...reliabilityText.matchAll(/`npm run ([\w:]+)/g)].map(([, commandName]) => commandName);
  assert.ok(commandNames.length >= 4, commandNames.join(', '));
  for (const commandName of commandNames) assert.ok(Object.hasOwn(scripts, commandName), commandName);
  const documentedPaths = [...reliabilityText.matchAll(/`((?:tests|src|scripts|fuzz|www)\/[\w./-]*)`/g)].map(([, namedPath]) => namedPath);
  assert.ok(documentedPaths.length > 15, documentedPaths.join(', '));
  for (const path of documentedPaths) assert.ok(existsSync(new URL(`../../${path}`, import.meta.url)), path);
});

/** Text of each document without its listings. */
const TEXT_BY_DOCUMENT = new Map(['README.md', ...filesOf('doc').filter((path) => path.endsWith('.md'))]
  .map((path) => [path, readText(path).replaceAll(/^```.*?^```/gms, '')]));

/** Returns the anchors of headings, in the form that GitHub gives them. */
const anchorsOf = (/** @type {string} */ markdownText, headingPattern = '#+') =>
  [...markdownText.matchAll(new RegExp(`^${headingPattern} (.*)$`, 'gm'))].map(([, headingText]) => headingText.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-'));

/** Returns the relative links of a text, as path and anchor. */
const linksOf = (/** @type {string} */ markdownText) =>
  [...markdownText.matchAll(/\]\((?!https?:)([^)#\s]*)#?([^)\s]*)\)/g)].map(([, path, anchor]) => ({ path, anchor }));

test('links of the documents lead to files and headings that exist', () => {
  for (const [documentPath, documentText] of TEXT_BY_DOCUMENT) {
    for (const { path, anchor } of linksOf(documentText)) {
      const targetPath = path === '' ? documentPath : join(dirname(documentPath), path);
      assert.ok(existsSync(join(REPOSITORY_ROOT, targetPath)), `${documentPath}: ${path}`);
      if (anchor !== '') assert.ok(anchorsOf(TEXT_BY_DOCUMENT.get(targetPath) ?? '').includes(anchor), `${documentPath}: ${path}#${anchor}`);
    }
  }
});

test('documents have a limited length, and long documents have a table of contents', () => {
  const linkedDocuments = linksOf(TEXT_BY_DOCUMENT.get('doc/README.md') ?? '').map(({ path }) => join('doc', path));
  for (const [documentPath, documentText] of TEXT_BY_DOCUMENT) {
    const lineCount = readText(documentPath).trimEnd().split('\n').length;
    assert.ok(lineCount <= (documentPath === 'README.md' ? 150 : 350), `${documentPath} has ${lineCount} lines`);
    if (documentPath.startsWith('doc/') && documentPath !== 'doc/README.md') assert.ok(linkedDocuments.includes(documentPath), `${documentPath} is not in doc/README.md`);
    const headingAnchors = anchorsOf(documentText, '##');
    const linkedAnchors = linksOf(documentText).filter(({ path }) => path === '').map(({ anchor }) => anchor);
    if (headingAnchors.length > 6) assert.deepEqual(headingAnchors.filter((heading) => !linkedAnchors.includes(heading)), [], `contents of ${documentPath}`);
  }
});
