// Whatever the package's documents name, the package has.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { ROOT } from '../../scripts/process.mjs';
import { installed } from './support.js';

const DOCUMENTS = ['README.md', 'CHANGELOG.md', 'doc/embedding.md'];

/** It says what is where in a clone, and names what only that has. */
const OF_CLONES = /^## Where things are\n.*?(?=^## |(?![^]))/ms;

/** How names of files end. */
const FILE = /\.(?:css|d\.ts|html|js|json|md|mdx|mjs|png|py|rs|rst|toml|ts|tsx|vue|svelte|wasm|yml)$/;

/** @type {ReturnType<typeof installed>} */
let project;
/** @type {string} */
let root;

before(() => {
  project = installed();
  root = join(project.directory, 'node_modules/motion-widgets');
});

after(() => project?.remove());

const read = (/** @type {string} */ document) => readFileSync(join(root, document), 'utf8');
const packed = (/** @type {string} */ path) => existsSync(join(root, path));

/** @param {string} document without its blocks of code */
const prose = (document) => document.replaceAll(/^```.*?^```/gms, '');

/**
 * @param {string} document
 * @returns {string[]} what it names in the type of code, where that is a file, a directory or one of the package's entries
 */
function named(document) {
  // What has gone is named beside what took its place.
  const present = prose(document).replaceAll(/\b(?:instead|the place) of `[^`]+`/g, '');
  const names = [...present.matchAll(/`([^`\s]+)`/g)].map(([, name]) => name);
  const isPath = (/** @type {string} */ name) => (name.includes('/') || FILE.test(name)) && !/^(?:<|@|https?:|application\/|\/)/.test(name);
  return [...new Set(names.filter(isPath))];
}

/** Something of an author's own site has the name that it has in an example. */
const inAnExample = (/** @type {string} */ name) =>
  readdirSync(join(root, 'examples'), { recursive: true, encoding: 'utf8' }).some((path) => path.endsWith(`/${name}`));

/** @returns {Record<string, unknown>} */
const entries = () => JSON.parse(read('package.json')).exports;

/** @param {string} name */
function isThere(name) {
  if (name.startsWith('motion-widgets/')) return name.replace('motion-widgets', '.') in entries();
  return packed(name) || packed(join('dist', name)) || inAnExample(name);
}

for (const document of DOCUMENTS) {
  test(`${document} names no file that the package leaves out`, () => {
    const names = named(read(document).replace(OF_CLONES, ''));
    assert.ok(names.length > 3, names.join(' '));
    assert.deepEqual(names.filter((name) => !isThere(name)), []);
  });

  test(`${document} links to nothing that the package leaves out`, () => {
    const links = [...prose(read(document)).matchAll(/\]\(([^)#\s]+)[^)]*\)/g)].map(([, link]) => link);
    const own = links.filter((link) => !/^https?:/.test(link));
    assert.deepEqual(own.filter((link) => !packed(join(dirname(document), link))), []);
  });

  test(`${document} writes code with what the package has`, () => {
    const blocks = [...read(document).matchAll(/^```.*?^```/gms)].join('\n');
    const files = [...blocks.matchAll(/\bmotion-widgets(?:@[\d.]+)?\/(dist\/[\w./-]+)/g)].map(([, path]) => path);
    assert.deepEqual(files.filter((path) => !packed(path)), []);
    const imported = [...blocks.matchAll(/['"]motion-widgets(\/[\w.-]+)?['"]/g)].map(([, entry]) => `.${entry ?? ''}`);
    assert.deepEqual(imported.filter((entry) => !(entry in entries())), []);
  });
}

test("README.md's table of what is where is of things that there are, and the package has what of it is for its readers", () => {
  const table = read('README.md').match(OF_CLONES)?.[0] ?? '';
  const rows = [...table.matchAll(/^\| (`[^|]+) \|/gm)].map(([, cell]) => cell);
  const names = rows.flatMap((cell) => [...cell.matchAll(/`([^`]+)`/g)]).map(([, name]) => name);
  assert.ok(names.length > 8, names.join(' '));
  assert.deepEqual(names.filter((name) => !existsSync(join(ROOT, name))), []);
  assert.deepEqual(names.filter((name) => /^(?:doc|examples)\b/.test(name) && !packed(name)), []);
});

test('package.json names no file that the package leaves out', () => {
  const { bin, exports, main, types, unpkg, jsdelivr, customElements } = JSON.parse(read('package.json'));
  /** @type {(value: any) => string[]} */
  const paths = (value) => (typeof value === 'string' ? [value] : Object.values(value).flatMap(paths));
  const all = [...paths(bin), ...paths(exports), main, types, unpkg, jsdelivr, customElements];
  assert.ok(all.length > 10, all.join(' '));
  assert.deepEqual(all.filter((path) => !packed(path)), []);
});

test('doc/calibration.md tells every option of the command that the package installs', () => {
  const { status, stdout } = spawnSync(join(project.directory, 'node_modules/.bin/motion-widgets'), ['--help'], { encoding: 'utf8' });
  assert.equal(status, 0);
  const options = new Set(stdout.match(/--[a-z-]+/g));
  assert.ok(options.size > 15, [...options].join(' '));
  const document = read('doc/calibration.md');
  assert.deepEqual([...options].filter((option) => option !== '--help' && !document.includes(`\`${option}`) && !document.includes(` ${option}`)), []);
});

test('a picture of doc/embedding.md has at most 60 kB', () => {
  const sizes = readdirSync(join(root, 'doc/embedding')).map((name) => ({ name, bytes: statSync(join(root, 'doc/embedding', name)).size }));
  assert.ok(sizes.length > 0);
  assert.deepEqual(sizes.filter(({ bytes }) => bytes > 60_000), []);
});
