// What doc/embedding.md says of each engine is what its example has, which `npm run test:embeddings` opens.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { filesOf } from '../../scripts/bundle.mjs';
import { ROOT } from '../../scripts/process.mjs';
import { engine, engines } from '../embeddings/project.mjs';

const document = readFileSync(join(ROOT, 'doc/embedding.md'), 'utf8');

/** @param {string} heading */
function sectionOf(heading) {
  const found = document.split(/^## /m).filter((section) => section.startsWith(`${heading}\n`));
  assert.equal(found.length, 1, `doc/embedding.md has ${found.length} sections "## ${heading}"`);
  return found[0];
}

const lines = (/** @type {string} */ text) => text.split('\n').map((line) => line.trim()).filter((line) => line !== '');

/**
 * @param {string} section
 * @returns {string[][]} lines to write into a file; those for a terminal are none
 */
function blocksOf(section) {
  const blocks = [...section.matchAll(/^```(\w*)\n(.*?)^```$/gms)];
  return blocks.flatMap(([, language, block]) => (language === 'sh' ? [] : [lines(block)]));
}

/**
 * @param {string} name
 * @returns {string[][]} the lines of each text in the example
 */
function textsOf(name) {
  const paths = filesOf(join('examples', name)).filter((path) => !/\/(?:node_modules|\.venv)\//.test(path));
  return paths.flatMap((path) => {
    const text = readFileSync(join(ROOT, path), 'utf8');
    return path.endsWith('.ipynb') ? JSON.parse(text).cells.map((/** @type {{ source: string[] }} */ { source }) => lines(source.join(''))) : [lines(text)];
  });
}

/**
 * @param {string[]} text
 * @param {string[]} block
 */
const has = (text, block) => text.some((_, at) => block.every((line, i) => text[at + i] === line));

for (const name of engines()) {
  const { heading, versions } = await engine(name);

  test(`${heading}: the lines of the document are those of the example`, () => {
    const blocks = blocksOf(sectionOf(heading));
    assert.ok(blocks.length > 0, `The section "${heading}" has no lines to write.`);
    const texts = textsOf(name);
    for (const block of blocks) {
      assert.ok(texts.some((text) => has(text, block)), `examples/${name} has nowhere:\n${block.join('\n')}`);
    }
    const printed = new Set(blocks.flat());
    const ours = texts.flat().filter((line) => /motion-widgets|motion_widgets|isCustomElement|optimizeDeps/.test(line));
    const untold = ours.filter((line) => !printed.has(line));
    assert.deepEqual(untold, [], `The section "${heading}" does not tell lines of examples/${name}.`);
  });

  test(`${heading}: the document says which versions were tried`, () => {
    const row = sectionOf('What was tried').split('\n').find((line) => line.startsWith(`| ${heading} |`));
    assert.ok(row, `The table of what was tried has no row "${heading}".`);
    assert.ok(row.includes(` ${versions()} `), `The row "${heading}" has to say ${versions()}.`);
  });
}

test('every engine that is tried has an example', () => {
  const examples = readdirSync(join(ROOT, 'examples'), { withFileTypes: true }).filter((entry) => entry.isDirectory());
  const names = new Set(examples.map(({ name }) => name));
  assert.ok(engines().length > 0);
  assert.deepEqual(engines().filter((name) => !names.has(name)), []);
});
