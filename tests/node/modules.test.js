// The modules that external.js gives to a widget alone, and their glue: without the machines of others, and otherwise the
// whole one.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import { pascal } from '../../scripts/declarations.mjs';
import { settings } from '../../www/settings.js';

const DIST = new URL('../../dist/', import.meta.url);
const TAGS = Object.keys(settings);

/** @param {string} path of a module @param {string} glue @returns {Promise<any>} a core */
async function coreOf(path, glue) {
  const { default: instantiate } = await import(`../../build/${glue}.js`);
  return instantiate(new WebAssembly.Module(readFileSync(new URL(path, DIST))));
}

/** @param {string} tag */
function moduleOf(tag) {
  const paths = readdirSync(new URL('chunks', DIST)).filter((name) => name.startsWith(`${tag}-`) && name.endsWith('.wasm'));
  assert.equal(paths.length, 1, `one module for ${tag}`);
  return `chunks/${paths[0]}`;
}

const whole = await coreOf('motion.wasm', 'motion');

for (const tag of TAGS) {
  test(`${tag} says the same on a module of its own`, async () => {
    const core = await coreOf(moduleOf(tag), tag);
    const few = Object.entries({ samples: 1000, seed: 7 }).filter(([name]) => settings[/** @type {keyof typeof settings} */ (tag)].some(({ key }) => key === name));
    const [own, same] = [core, whole].map((each) => new each[pascal(tag)](Object.fromEntries(few)));
    assert.deepEqual(own.config, same.config);
    assert.deepEqual(own.stats, same.stats);
    assert.deepEqual(own.poses, same.poses);
    assert.deepEqual(Object.keys(core).sort(), [pascal(tag), 'commandReaching', 'randomSeed'].sort());
    assert.ok(core.randomSeed() >= 0);
    const near = { v: 1, omega: 0.5, dt: 1 };
    assert.deepEqual(core.commandReaching(1, 0.2, near), whole.commandReaching(1, 0.2, near));
  });
}
