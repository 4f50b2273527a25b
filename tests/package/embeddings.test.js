// Documents on embedding. They must quote the examples that `npm run test:embeddings` opens, and name the versions of the packages.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { REPOSITORY_ROOT, filesOf } from '../../scripts/process.mjs';
import { loadPlatform, findPlatformNames } from '../embeddings/project.mjs';

const embeddingDocuments = filesOf('doc').filter((filePath) => /embedding.*\.md$/.test(filePath)).map((filePath) => readFileSync(join(REPOSITORY_ROOT, filePath), 'utf8')).join('\n');
const linesOf = (/** @type {string} */ sourceText) => sourceText.split('\n').map((textLine) => textLine.trim()).filter((textLine) => textLine !== '');

/** Returns the lines of a file, or the lines of a notebook's cells. @param {string} filePath @returns {string[]} */
function fileLinesOf(filePath) {
  const fileText = readFileSync(join(REPOSITORY_ROOT, filePath), 'utf8');
  return linesOf(filePath.endsWith('.ipynb') ? JSON.parse(fileText).cells.map((/** @type {any} */ { source }) => source.join('')).join('\n') : fileText);
}

for (const platformName of await findPlatformNames()) {
  const { heading, readVersions } = await loadPlatform(platformName);

  test(`${heading}: the document quotes the example, and states the tested versions`, () => {
    const tableRow = embeddingDocuments.split('\n').find((textLine) => textLine.startsWith(`| ${heading} |`));
    assert.ok(tableRow?.includes(` ${readVersions()} `), `The row "${heading}" of what was tried has to say ${readVersions()}.`);
    const documentSection = embeddingDocuments.split(/^## /m).find((text) => text.startsWith(`${heading}\n`)) ?? '';
    // Shell commands are left out, because the files of the example contain none.
    const codeBlocks = [...documentSection.matchAll(/^```(\w*)\n(.*?)^```$/gms)].filter(([, codeLanguage]) => codeLanguage !== 'sh');
    const exampleLines = new Set(filesOf(join('examples', platformName)).flatMap(fileLinesOf));
    const missingLines = codeBlocks.flatMap(([, , codeBlock]) => linesOf(codeBlock)).filter((textLine) => !exampleLines.has(textLine));
    assert.deepEqual(missingLines, [], `examples/${platformName} does not have these lines of the document.`);
  });
}
