// WebAssembly modules of single figures, which external.js loads. Each has no simulation of another figure, and gives the same bits as the common
// module.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import { toPascalCase } from '../../scripts/declarations.mjs';
import { findDifferences, computeDigest, resultFunctions } from '../digest/digest.js';

const DIST_DIRECTORY = new URL('../../dist/', import.meta.url);
const DIGEST_DIRECTORY = new URL('../digest/', import.meta.url);

const configurations = JSON.parse(readFileSync(new URL('configurations.json', DIGEST_DIRECTORY), 'utf8'));
const goldenDigest = readFileSync(new URL('golden.txt', DIGEST_DIRECTORY), 'utf8');

for (const tag of Object.keys(resultFunctions)) {
  test(`the module of ${tag} has its simulation alone, with the same bits`, async () => {
    const moduleNames = readdirSync(new URL('chunks', DIST_DIRECTORY)).filter((name) => name.startsWith(`${tag}-`) && name.endsWith('.wasm'));
    assert.equal(moduleNames.length, 1, `one module for ${tag}`);
    const { default: instantiate } = await import(`../../build/${tag}.js`);
    const core = await instantiate(new WebAssembly.Module(readFileSync(new URL(`chunks/${moduleNames[0]}`, DIST_DIRECTORY))));
    const simulationNames = Object.keys(resultFunctions).map(toPascalCase).filter((name) => name in core);
    assert.deepEqual(simulationNames, [toPascalCase(tag)]);
    const goldenDigestOfTag = goldenDigest.split('\n').filter((line) => line.startsWith(`${tag}/`)).map((line) => `${line}\n`).join('');
    assert.deepEqual(findDifferences(goldenDigestOfTag, await computeDigest(core, configurations, [tag])), []);
  });
}
