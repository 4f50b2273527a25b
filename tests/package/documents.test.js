// The package has the files that its package.json names, the options that its documents describe, and one version.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ROOT } from '../../scripts/process.mjs';
import { installPackage } from './support.js';

/** @type {ReturnType<typeof installPackage>} */
let installedProject;
/** @type {string} */
let packageRoot;

before(() => {
  installedProject = installPackage();
  packageRoot = join(installedProject.directory, 'node_modules/motion-widgets');
});

after(() => installedProject?.remove());

const readPackaged = (/** @type {string} */ document) => readFileSync(join(packageRoot, document), 'utf8');
const isMissing = (/** @type {string} */ path) => !existsSync(join(packageRoot, path));

test('package.json names no file that the package leaves out', () => {
  const { bin, exports, main, types, unpkg, jsdelivr, customElements } = JSON.parse(readPackaged('package.json'));
  /** @type {(value: any) => string[]} */
  const pathsIn = (value) => (typeof value === 'string' ? [value] : Object.values(value).flatMap(pathsIn));
  const allPaths = [...pathsIn(bin), ...pathsIn(exports), main, types, unpkg, jsdelivr, customElements];
  assert.ok(allPaths.length > 10, allPaths.join(' '));
  assert.deepEqual(allPaths.filter(isMissing), []);
});

test('doc/calibration.md describes every option of the command that the package installs', () => {
  const { status, stdout } = spawnSync(process.execPath, [join(packageRoot, 'dist/cli.js'), '--help'], { encoding: 'utf8' });
  assert.equal(status, 0);
  const commandOptions = new Set(stdout.match(/--[a-z-]+/g));
  assert.ok(commandOptions.size > 15, [...commandOptions].join(' '));
  const calibrationDocument = readFileSync(join(ROOT, 'doc/calibration.md'), 'utf8');
  assert.deepEqual([...commandOptions].filter((option) => option !== '--help' && !calibrationDocument.includes(`\`${option}`) && !calibrationDocument.includes(` ${option}`)), []);
});

test('all that is released has one version', () => {
  const { version } = JSON.parse(readPackaged('package.json'));
  for (const path of ['Cargo.toml', 'python/pyproject.toml']) {
    assert.equal(readFileSync(join(ROOT, path), 'utf8').match(/^version = "(.+)"$/m)?.[1], version, path);
  }
});
