// dist/core.js, the module that people import, in Node.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import test from 'node:test';

const CORE = new URL('../../dist/core.js', import.meta.url);
const WASM = new URL('../../build/motion_bg.wasm', import.meta.url);

/**
 * The module anew, with nothing loaded yet.
 *
 * @param {string} name
 * @returns {Promise<typeof import('../../www/core.js')>}
 */
const core = (name) => import(`${CORE.href}?${name}`);

/** The chapter's canonical example. */
const CANONICAL = {
  command: { v: 1, omega: 0.5, dt: 1 },
  alphas: [0.02, 0.02, 0.02, 0.02, 0, 0],
  samples: 100_000,
};

test('importing and loading touch neither the DOM nor the network', async () => {
  /** @type {string[]} */
  const touched = [];
  const names = ['document', 'window', 'customElements', 'fetch', 'XMLHttpRequest', 'WebSocket'];
  const before = names.map((name) => Object.getOwnPropertyDescriptor(globalThis, name));
  for (const name of names) {
    Object.defineProperty(globalThis, name, { configurable: true, get: () => void touched.push(name) });
  }
  try {
    const { load } = await core('untouched');
    await load();
  } finally {
    names.forEach((name, i) => {
      const descriptor = before[i];
      if (descriptor) Object.defineProperty(globalThis, name, descriptor);
      else Reflect.deleteProperty(globalThis, name);
    });
  }
  assert.deepEqual(touched, []);
});

test('the module may come as bytes, as a URL and compiled', async () => {
  const bytes = await readFile(WASM);
  const sources = { inlined: undefined, bytes, url: WASM, compiled: await WebAssembly.compile(bytes) };
  const clouds = await Promise.all(
    Object.entries(sources).map(async ([name, source]) => {
      const { load } = await core(name);
      const motion = await load(source);
      return new motion.BananaMachine({ samples: 100 }).poses;
    }),
  );
  assert.equal(clouds[0].length, 300);
  for (const cloud of clouds) assert.deepEqual(cloud, clouds[0]);
});

test('the canonical cloud has the exact moments, to five standard errors', async () => {
  const motion = await (await core('canonical')).load();
  const machine = new motion.BananaMachine(CANONICAL);
  const { n, cartesian, crossTrackSkew, crossTrackSkewError } = machine.stats;
  assert.equal(n, CANONICAL.samples);
  assert.equal(machine.poses.length, 3 * n);
  // The share of a variance that is its standard error is √(2/n) for a Gaussian; this cloud is close to one.
  const near = (/** @type {number} */ value, /** @type {number} */ exact, /** @type {number} */ error) =>
    assert.ok(Math.abs(value - exact) < 5 * error, `${value} is not ${exact} ± 5 · ${error}`);
  near(cartesian.mean[0], 0.955006501, Math.sqrt(0.0235 / n));
  near(cartesian.mean[1], 0.243321663, Math.sqrt(0.00706 / n));
  near(cartesian.cov[0][0], 0.023497983, 0.0235 * Math.sqrt(2 / n));
  near(cartesian.cov[1][1], 0.007057304, 0.00706 * Math.sqrt(2 / n));
  near(crossTrackSkew, -0.30056, crossTrackSkewError);
  // Six over n is the squared standard error of the skew of a Gaussian, and this cloud's is of that order.
  assert.ok(crossTrackSkewError > 0 && crossTrackSkewError < 3 * Math.sqrt(6 / n));
});

test('a seed means one cloud, and another seed another', async () => {
  const motion = await (await core('seeds')).load();
  const cloud = (/** @type {number} */ seed) => new motion.BananaMachine({ samples: 100, seed }).poses;
  assert.deepEqual(cloud(1), cloud(1));
  assert.notDeepEqual(cloud(1), cloud(2));
  const seed = motion.randomSeed();
  assert.ok(Number.isInteger(seed) && seed >= 0 && seed < 2 ** 32);
});

test('what is wrong is named, and changes nothing', async () => {
  const motion = await (await core('wrong')).load();
  const machine = new motion.BananaMachine({ samples: 100 });
  const { config, poses } = machine;
  /** @type {[string, any][]} */
  const wrong = [
    ['alphas', { alphas: [0.1, 0.1] }],
    ['alphas', { alphas: [-0.1, 0, 0, 0, 0, 0] }],
    ['command', { command: { v: NaN, omega: 0, dt: 1 } }],
    ['dt', { command: { v: 1, omega: 0, dt: 0 } }],
    ['samples', { samples: 1.5 }],
    ['samples', { samples: motion.BananaMachine.maxSamples + 1 }],
    ['seed', { seed: '7' }],
    ['model', { model: 'magic' }],
    ['sampels', { sampels: 10 }],
  ];
  for (const [field, settings] of wrong) {
    const named = (/** @type {Error} */ error) =>
      (error instanceof TypeError || error instanceof RangeError) && error.message.includes(field);
    // One that is right beside it must not be taken over either.
    assert.throws(() => machine.configure({ noise: 'triangular', ...settings }), named, JSON.stringify(settings));
    assert.throws(() => new motion.BananaMachine(settings), named, JSON.stringify(settings));
    assert.deepEqual(machine.config, config);
    assert.deepEqual(machine.poses, poses);
  }
});

test('a handle is freed by free and by Symbol.dispose', async () => {
  const motion = await (await core('freed')).load();
  const freed = new motion.BananaMachine();
  freed.free();
  assert.throws(() => freed.stats);
  const disposed = new motion.BananaMachine();
  disposed[Symbol.dispose]();
  assert.throws(() => disposed.stats);
});
