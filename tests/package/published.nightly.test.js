// Package as npm would publish it: its size, its types and its licences.

import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { publint } from 'publint';
import { formatMessage } from 'publint/utils';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { packNpmPackageInto } from '../embeddings/project.mjs';

const packageManifest = JSON.parse(readFileSync(join(REPOSITORY_ROOT, 'package.json'), 'utf8'));

/** @type {string} */
let temporaryDirectory;
/** @type {string} */
let tarballPath;

before(() => {
  temporaryDirectory = mkdtempSync(join(tmpdir(), 'motion-widgets-'));
  tarballPath = packNpmPackageInto(temporaryDirectory);
});

after(() => rmSync(temporaryDirectory, { recursive: true, force: true }));

test('the package has at most 1.5 MB', () => {
  const { size: byteCount } = statSync(tarballPath);
  assert.ok(byteCount <= 1_500_000, `${byteCount} bytes`);
});

test('publint reports no problem', async () => {
  const { buffer: fileBuffer } = readFileSync(tarballPath);
  const { messages: publintMessages } = await publint({ pack: { tarball: /** @type {ArrayBuffer} */ (fileBuffer) }, strict: true });
  assert.deepEqual(publintMessages.map((publintMessage) => formatMessage(publintMessage, packageManifest)), []);
});

test('the tool "Are the types wrong?" reports no problem', () => {
  // Only the entry points of scripts have types.
  const entriesWithoutTypes = Object.keys(packageManifest.exports).filter((entryName) => /\.(css|wasm|json)$/.test(entryName));
  const attwPath = join(REPOSITORY_ROOT, 'node_modules/@arethetypeswrong/cli/dist/index.js');
  // The profile skips checks of `require` and of resolution without `exports`, which the package does not support: all scripts are modules.
  const attwArguments = [attwPath, tarballPath, '--profile', 'esm-only', '--exclude-entrypoints', ...entriesWithoutTypes];
  const { status: exitStatus, stdout } = spawnSync(process.execPath, attwArguments, { encoding: 'utf8' });
  assert.equal(exitStatus, 0, stdout);
  assert.match(stdout, /"motion-widgets\/core"/);
});

test('the licence file names every library in the bundles, with its licence', () => {
  const licenceText = readFileSync(join(REPOSITORY_ROOT, 'dist/LICENSE-third-party.txt'), 'utf8');
  const esbuildOutputs = JSON.parse(readFileSync(join(REPOSITORY_ROOT, 'build/outputs.json'), 'utf8'));
  const bundledPaths = Object.values(esbuildOutputs).flatMap(({ inputs: bundleInputs }) => Object.keys(bundleInputs).filter((filePath) => bundleInputs[filePath].bytesInOutput > 0));
  const packageNames = bundledPaths.flatMap((filePath) => filePath.match(/(?<=node_modules\/)(?:@[^/]+\/)?[^/]+/) ?? []);
  const [, crateList] = readFileSync(join(REPOSITORY_ROOT, 'Cargo.toml'), 'utf8').match(/\n\[dependencies\]\n(.*?)\n\n/s) ?? [];
  const dependencyNames = [...new Set(packageNames), ...[...(crateList ?? '').matchAll(/^[\w-]+/gm)].map(String)];
  assert.ok(dependencyNames.includes('lit-html') && dependencyNames.includes('nalgebra'), dependencyNames.join(' '));
  for (const dependencyName of dependencyNames) assert.match(licenceText, new RegExp(`^${dependencyName} \\d\\S* \\(.+\\)$`, 'm'));
  const packedFiles = execFileSync('tar', ['-tf', tarballPath], { encoding: 'utf8' }).split('\n');
  assert.ok(packedFiles.includes('package/dist/LICENSE-third-party.txt'));
});
