// The limits of the pages in doc/model.md: where a picture or a sentence becomes another one; and the tests that
// doc/reliability.md names.

import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { test } from 'node:test';

const read = (/** @type {string} */ path) => readFileSync(new URL(`../../${path}`, import.meta.url), 'utf8');

/** Where a constant stands, its name, and what is said of it. @type {[string, string, RegExp][]} */
const LIMITS = [
  ['www/widgets/banana-machine/pictures.ts', 'MAX_DOTS', /Up to (\S+) robots are drawn as dots/],
  ['www/widgets/map-squeeze/reading.ts', 'MAX_DOTS', /more than (\S+) motions are drawn as cells/],
  ['www/widgets/banana-machine/words.ts', 'HARDLY', /leans to neither side, below (\S+) hardly/],
  ['www/widgets/banana-machine/words.ts', 'TOO_LARGE', /where the ellipse has more than (\S+) times the area/],
  ['www/widgets/banana-machine/words.ts', 'BENT', /or else the gain is more than (\S+) nats a robot/],
];

test('doc/model.md has the limits of the pages', () => {
  const told = read('doc/model.md').replace(/\s+/g, ' ');
  for (const [file, name, sentence] of LIMITS) {
    const [, set] = read(file).match(new RegExp(`const ${name} = ([\\d._]+);`)) ?? [];
    assert.ok(set, `${name} of ${file}`);
    assert.equal(told.match(sentence)?.[1], set, `${name} of ${file}`);
  }
});

test('doc/reliability.md names files and commands that are there', () => {
  const told = read('doc/reliability.md');
  const { scripts } = JSON.parse(read('package.json'));
  const commands = [...told.matchAll(/`npm run ([\w:]+)/g)].map(([, name]) => name);
  assert.ok(commands.length >= 4, commands.join(', '));
  for (const name of commands) assert.ok(Object.hasOwn(scripts, name), name);
  const files = [...told.matchAll(/`((?:tests|src|scripts|fuzz|www)\/[\w./-]*)`/g)].map(([, path]) => path);
  assert.ok(files.length > 15, files.join(', '));
  for (const path of files) assert.ok(existsSync(new URL(`../../${path}`, import.meta.url)), path);
});
