// Same seed, same bits, in Node. The list of configurations covers all settings of the machines.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { presets, settings } from '../../www/settings.js';
import { differences, digest, widgets } from '../digest/digest.js';
import { freshModule } from './support.js';

const read = (/** @type {string} */ path) => readFileSync(new URL(`../../${path}`, import.meta.url), 'utf8');

/** @type {import('../digest/digest.js').Configurations} */
const all = JSON.parse(read('tests/digest/configurations.json'));
const motion = await (await freshModule()).load();

/** Exports without a seed, or that draw as the models in Rust do, which tests/web and tests/native cover. */
const HOMEWORK = new Set(['VelocityModel', 'OdometryModel', 'invertArc', 'decompose', 'propagate', 'se2', 'calibrate']);

/** As core.js has them, by tags. @type {Map<string, any>} */
const classes = new Map(
  Object.entries(motion)
    .filter(([name, each]) => 'free' in (each.prototype ?? {}) && !HOMEWORK.has(name))
    .map(([name, each]) => [name.replace(/\B[A-Z]/g, '-$&').toLowerCase(), each]),
);

const golden = read('tests/digest/golden.txt');

test('a seed gives the bits that it gave', async () => {
  const computed = await digest(motion, all);
  if (process.env.UPDATE_DIGEST) writeFileSync(new URL('../digest/golden.txt', import.meta.url), computed);
  else assert.deepEqual(differences(golden, computed), []);
});

test('every widget and every class of the core has configurations, and every function is asked', () => {
  const listed = [...read('www/widgets/index.ts').matchAll(/^import '\.\/([\w-]+)\//gm)].map(([, tag]) => tag);
  assert.deepEqual(Object.keys(all.widgets).sort(), listed.sort(), 'www/widgets/index.ts');
  assert.deepEqual(Object.keys(all.widgets).sort(), [...classes.keys()].sort(), 'core.js');
  assert.deepEqual(Object.keys(widgets).sort(), listed, 'digest.js');
  const functions = Object.keys(motion).filter((name) => !('free' in (motion[name].prototype ?? {})) && !OTHERWISE.has(name) && !HOMEWORK.has(name));
  for (const name of functions) assert.match(read('tests/digest/digest.js'), new RegExp(`\\b${name}\\(`));
  const count = Object.values(all.widgets).reduce((sum, { configurations }) => sum + Object.keys(configurations).length, 0);
  // golden.txt has no lines of removed configurations.
  assert.equal(count, read('tests/digest/golden.txt').match(/^.+$/gm)?.length);
});

for (const [tag, { configurations }] of Object.entries(all.widgets)) {
  const values = (/** @type {string} */ key) => new Set(Object.values(configurations).map((each) => JSON.stringify(each.settings[key])));

  test(`configurations of ${tag} take every setting, every word and every preset`, () => {
    for (const { key, type, words, nullable, default: opening, in: group } of settings[tag]) {
      if (group) continue;
      const taken = values(key);
      const allowed = type === 'boolean' ? [true, false] : (words ?? []);
      for (const each of allowed) assert.ok(taken.has(JSON.stringify(each)) || each === opening, `${key}: ${each}`);
      const others = [...taken].filter((value) => value !== undefined && value !== JSON.stringify(opening));
      assert.ok(others.length > 0, `${key} is never set`);
      if (nullable && opening !== null && type !== 'number') assert.ok(taken.has('null'), `${key}: null`);
    }
    for (const { name } of presets[/** @type {keyof typeof presets} */ (tag)]) {
      assert.ok(Object.values(configurations).some(({ preset }) => preset === name), `preset ${name}`);
    }
  });

  test(`all that a machine of ${tag} tells is in its digest`, () => {
    const asked = widgets[tag].toString();
    const members = Object.getOwnPropertyNames(classes.get(tag).prototype);
    const missing = members.filter((name) => !OTHERWISE.has(name) && !new RegExp(`\\b${name}\\b`).test(asked));
    assert.deepEqual(missing, [], `ask for them in digest.js and in tests/digest/`);
  });
}

test('every map is used, and what differs is named', () => {
  const used = new Set(Object.values(all.widgets['map-squeeze'].configurations).map(({ map }) => map));
  for (const map of Object.keys(all.maps)) assert.ok(used.has(map), map);
  assert.deepEqual(differences('a/b poses:1 table:2\na/c poses:3\n', 'a/b poses:1 table:9\na/d poses:3\n'), [
    'a/b: table',
    'a/c is gone',
    'a/d is not in golden.txt',
  ]);
});

/** Members without results in the digest. Tests in tests/native/simulations cover them: banana, morph, squeeze and alpha_calibrator. */
const OTHERWISE = new Set([
  'constructor', 'free', '__destroy_into_raw', 'config', 'fittedConfig', 'isPending', 'save', 'read', 'firstPoses', 'configure', 'configureFirst', 'addSamples', 'block', 'alphasOfModels',
  'randomSeed', 'readMapImage', 'unbendGaussian', 'unbendLine', 'gaps',
]);
