// The documents on embedding quote the examples that `npm run test:embeddings` opens, and name the versions of their packages.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { filesOf } from '../../scripts/bundle.mjs';
import { ROOT } from '../../scripts/process.mjs';
import { engine, engines } from '../embeddings/project.mjs';

const document = filesOf('doc').filter((path) => /embedding.*\.md$/.test(path)).map((path) => readFileSync(join(ROOT, path), 'utf8')).join('\n');
const linesOf = (/** @type {string} */ text) => text.split('\n').map((line) => line.trim()).filter((line) => line !== '');

/** @param {string} path @returns {string[]} the lines of a file; of a notebook, those of its cells */
function fileLinesOf(path) {
  const text = readFileSync(join(ROOT, path), 'utf8');
  return linesOf(path.endsWith('.ipynb') ? JSON.parse(text).cells.map((/** @type {any} */ { source }) => source.join('')).join('\n') : text);
}

for (const name of await engines()) {
  const { heading, versions } = await engine(name);

  test(`${heading}: the document has lines of the example, and the versions that were tried`, () => {
    const tableRow = document.split('\n').find((line) => line.startsWith(`| ${heading} |`));
    assert.ok(tableRow?.includes(` ${versions()} `), `The row "${heading}" of what was tried has to say ${versions()}.`);
    const section = document.split(/^## /m).find((text) => text.startsWith(`${heading}\n`)) ?? '';
    // Shell commands are not in a file of the example.
    const blocks = [...section.matchAll(/^```(\w*)\n(.*?)^```$/gms)].filter(([, language]) => language !== 'sh');
    const lines = new Set(filesOf(join('examples', name)).flatMap(fileLinesOf));
    const missingLines = blocks.flatMap(([, , block]) => linesOf(block)).filter((line) => !lines.has(line));
    assert.deepEqual(missingLines, [], `examples/${name} does not have these lines of the document.`);
  });
}
