// WebAssembly modules of single figures, which external.js loads. Each module has no simulation of another figure, and gives the same bits
// as the common module.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import { toPascalCase } from '../../scripts/declarations.mjs';
import { findDifferences, computeDigest, resultFunctions } from '../digest/digest.js';

const DIST_DIRECTORY = new URL('../../dist/', import.meta.url);
const DIGEST_DIRECTORY = new URL('../digest/', import.meta.url);

const configurationFile = JSON.parse(readFileSync(new URL('configurations.json', DIGEST_DIRECTORY), 'utf8'));
const goldenDigest = readFileSync(new URL('golden.txt', DIGEST_DIRECTORY), 'utf8');

for (const widgetTag of Object.keys(resultFunctions)) {
  test(`the module of ${widgetTag} contains only its own simulation, with the same results`, async () => {
    const moduleNames = readdirSync(new URL('chunks', DIST_DIRECTORY)).filter((fileName) => fileName.startsWith(`${widgetTag}-`) && fileName.endsWith('.wasm'));
    assert.equal(moduleNames.length, 1, `one module for ${widgetTag}`);
    const { default: instantiateCore } = await import(`../../build/${widgetTag}.js`);
    const motionCore = await instantiateCore(new WebAssembly.Module(readFileSync(new URL(`chunks/${moduleNames[0]}`, DIST_DIRECTORY))));
    const simulationNames = Object.keys(resultFunctions).map(toPascalCase).filter((simulationName) => simulationName in motionCore);
    assert.deepEqual(simulationNames, [toPascalCase(widgetTag)]);
    const goldenDigestOfTag = goldenDigest.split('\n').filter((digestLine) => digestLine.startsWith(`${widgetTag}/`)).map((digestLine) => `${digestLine}\n`).join('');
    assert.deepEqual(findDifferences(goldenDigestOfTag, await computeDigest(motionCore, configurationFile, [widgetTag])), []);
  });
}
