// Documents: their links and lengths, numbers in them (limits of the pages, presets, true parameters of the example log), and names of files
// and commands.

import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { filesOf } from '../../scripts/bundle.mjs';
import { LEG_LIMIT, TRUE_MODEL } from '../../scripts/example-log.mjs';
import { ROOT } from '../../scripts/process.mjs';
import { presets } from '../../www/settings.js';

const textOf = (/** @type {string} */ path) => readFileSync(new URL(`../../${path}`, import.meta.url), 'utf8');

/** Files and names of constants, with the sentence of the document that contains the value. @type {[string, string, RegExp][]} */
const DOCUMENTED_LIMITS = [
  ['www/widgets/banana-machine/pictures.ts', 'MAX_DOTS', /Up to (\S+) robots are drawn as dots/],
  ['www/widgets/map-squeeze/view-model.ts', 'MAX_DOTS', /more than (\S+) motions are drawn as cells/],
  ['www/widgets/banana-machine/words.ts', 'VISIBLE_SKEW', /exact skew is below (\S+) \| both sides are nearly alike/],
  ['www/widgets/banana-machine/words.ts', 'VISIBLE_AREA_RATIO', /if the ellipse has more than (\S+) times the area/],
  ['www/widgets/banana-machine/words.ts', 'MIN_GAIN', /or if the gain is more than (\S+) nats a robot/],
];

test('doc/model.md and doc/statistics.md have the limits of the pages', () => {
  const documents = `${textOf('doc/model.md')}${textOf('doc/statistics.md')}`.replace(/\s+/g, ' ');
  for (const [file, name, sentence] of DOCUMENTED_LIMITS) {
    const [, limit] = textOf(file).match(new RegExp(`const ${name} = ([\\d._]+);`)) ?? [];
    assert.ok(limit, `${name} of ${file}`);
    assert.equal(documents.match(sentence)?.[1], limit, `${name} of ${file}`);
  }
});

test('README.md has the presets of each figure', () => {
  const readme = textOf('README.md').replace(/\s+/g, ' ');
  for (const [tag, all] of Object.entries(presets)) {
    if (all.length > 0) assert.ok(readme.includes(`\`${tag}\` ${all.map(({ name }) => name).join(', ')}`), tag);
  }
});

test('README of the example log has its true parameters', () => {
  const readme = textOf('examples/calibration/README.md');
  const { alphas, mountYaw, clockOffset, distanceScale } = TRUE_MODEL;
  for (const statement of [`| ${alphas.join(', ')} |`, `| ${mountYaw} rad |`, `| ${clockOffset} s later |`, `| ${distanceScale} |`, `${LEG_LIMIT.distance} m`, `${LEG_LIMIT.angle} rad`]) {
    assert.ok(readme.includes(statement), statement);
  }
});

test('doc/reliability.md names files and commands that are there', () => {
  const document = textOf('doc/reliability.md');
  const { scripts } = JSON.parse(textOf('package.json'));
  const commands = [...document.matchAll(/`npm run ([\w:]+)/g)].map(([, name]) => name);
  assert.ok(commands.length >= 4, commands.join(', '));
  for (const name of commands) assert.ok(Object.hasOwn(scripts, name), name);
  const files = [...document.matchAll(/`((?:tests|src|scripts|fuzz|www)\/[\w./-]*)`/g)].map(([, path]) => path);
  assert.ok(files.length > 15, files.join(', '));
  for (const path of files) assert.ok(existsSync(new URL(`../../${path}`, import.meta.url)), path);
});

/** Text of each document without its listings. */
const DOCUMENTS = new Map(['README.md', ...filesOf('doc').filter((path) => path.endsWith('.md'))]
  .map((path) => [path, textOf(path).replaceAll(/^```.*?^```/gms, '')]));

/** Returns the anchors of headings, as GitHub makes them. */
const anchorsOf = (/** @type {string} */ text, level = '#+') =>
  [...text.matchAll(new RegExp(`^${level} (.*)$`, 'gm'))].map(([, heading]) => heading.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-'));

/** Returns the relative links of a text, as path and anchor. */
const linksOf = (/** @type {string} */ text) =>
  [...text.matchAll(/\]\((?!https?:)([^)#\s]*)#?([^)\s]*)\)/g)].map(([, path, anchor]) => ({ path, anchor }));

test('links of the documents lead to files and headings that exist', () => {
  for (const [document, text] of DOCUMENTS) {
    for (const { path, anchor } of linksOf(text)) {
      const target = path === '' ? document : join(dirname(document), path);
      assert.ok(existsSync(join(ROOT, target)), `${document}: ${path}`);
      if (anchor !== '') assert.ok(anchorsOf(DOCUMENTS.get(target) ?? '').includes(anchor), `${document}: ${path}#${anchor}`);
    }
  }
});

test('documents are short, and long ones have a table of contents', () => {
  const linkedDocuments = linksOf(DOCUMENTS.get('doc/README.md') ?? '').map(({ path }) => join('doc', path));
  for (const [document, text] of DOCUMENTS) {
    const lines = textOf(document).trimEnd().split('\n').length;
    assert.ok(lines <= (document === 'README.md' ? 150 : 350), `${document} has ${lines} lines`);
    if (document.startsWith('doc/') && document !== 'doc/README.md') assert.ok(linkedDocuments.includes(document), `${document} is not in doc/README.md`);
    const headings = anchorsOf(text, '##');
    const linked = linksOf(text).filter(({ path }) => path === '').map(({ anchor }) => anchor);
    if (headings.length > 6) assert.deepEqual(headings.filter((heading) => !linked.includes(heading)), [], `contents of ${document}`);
  }
});
