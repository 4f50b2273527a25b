// The workflows, as far as can be seen without running them.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { load } from 'js-yaml';
import { ROOT } from '../../scripts/process.mjs';

const DIRECTORY = '.github/workflows';

const read = (/** @type {string} */ path) => readFileSync(join(ROOT, path), 'utf8');
const { version, scripts } = JSON.parse(read('package.json'));

/** @type {{ name: string, permissions: unknown, jobs: Record<string, { steps: { run?: string, uses?: string }[] }> }[]} */
const workflows = readdirSync(join(ROOT, DIRECTORY)).map((name) => /** @type {any} */ (load(read(join(DIRECTORY, name)))));
const steps = workflows.flatMap(({ jobs }) => Object.values(jobs).flatMap((job) => job.steps));
const run = steps.map((step) => step.run ?? '').join('\n');

test('every test that package.json names is run by a workflow, and what they run is there', () => {
  const called = [...run.matchAll(/npm (?:run )?((?:test|build|start|bench)[\w:]*)/g)].map(([, name]) => name);
  for (const name of called) assert.ok(Object.hasOwn(scripts, name), `npm run ${name}`);
  const tests = Object.keys(scripts).filter((name) => name.startsWith('test'));
  assert.ok(tests.length >= 2);
  for (const name of tests) assert.ok(called.includes(name), `no workflow runs ${name}`);
});

test('a workflow may read unless a job of its own says otherwise, and installs what is locked', () => {
  for (const { name, permissions } of workflows) assert.deepEqual(permissions, { contents: 'read' }, name);
  assert.doesNotMatch(run, /npm (install|i|update)\b|cargo install (?!--locked)/);
  for (const { uses } of steps) if (uses !== undefined) assert.match(uses, /@(v\d|release\/v1$)/);
});

test('all that is released has one version', () => {
  const of = (/** @type {string} */ path, /** @type {RegExp} */ pattern) => read(path).match(pattern)?.[1];
  assert.equal(of('Cargo.toml', /^version = "(.+)"$/m), version);
  assert.equal(of('python/pyproject.toml', /^version = "(.+)"$/m), version);
  assert.equal(JSON.parse(read('package-lock.json')).version, version);
});

test('every dependency is locked with its digest', () => {
  const { packages } = JSON.parse(read('package-lock.json'));
  for (const [path, { integrity, link, inBundle }] of Object.entries(/** @type {Record<string, any>} */ (packages))) {
    if (path !== '' && !link && !inBundle) assert.match(integrity ?? '', /^sha512-/, path);
  }
  for (const lock of ['Cargo.lock', 'fuzz/Cargo.lock', 'scripts/bind/Cargo.lock']) {
    for (const entry of read(lock).split('\n[[package]]\n').slice(1)) {
      if (entry.includes('\nsource = ')) assert.match(entry, /\nchecksum = "[0-9a-f]{64}"/, entry);
    }
  }
});
