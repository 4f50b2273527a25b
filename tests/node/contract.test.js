// The contract of dist/core.js, in Node: what it offers, and that the numbers are right.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { declaredOpening, freshModule, near } from './support.js';

const CANONICAL = {
  model: 'velocity',
  noise: 'normal',
  command: { v: 1, omega: 0.5, dt: 1 },
  alphas: [0.02, 0.02, 0.02, 0.02, 0, 0],
  samples: 200_000,
  seed: 7,
};

test('importing and loading touch neither the DOM nor the network, and load gives one module', async () => {
  /** @type {string[]} */
  const touched = [];
  const names = ['document', 'window', 'customElements', 'fetch', 'XMLHttpRequest', 'WebSocket'];
  const before = names.map((name) => Object.getOwnPropertyDescriptor(globalThis, name));
  for (const name of names) {
    Object.defineProperty(globalThis, name, { configurable: true, get: () => void touched.push(name) });
  }
  try {
    const core = await freshModule();
    assert.deepEqual(touched, []);
    const motion = await core.load();
    assert.equal(await core.load(), motion);
  } finally {
    names.forEach((name, i) => {
      const descriptor = before[i];
      if (descriptor) Object.defineProperty(globalThis, name, descriptor);
      else Reflect.deleteProperty(globalThis, name);
    });
  }
  assert.deepEqual(touched, []);
});

test('load takes bytes, a compiled module, or an address, and fails with a sentence', async () => {
  const address = new URL('../../build/motion.wasm', import.meta.url);
  const bytes = await readFile(address);
  for (const source of [undefined, bytes, new Uint8Array(bytes).buffer, await WebAssembly.compile(bytes), address, address.href]) {
    const motion = await (await freshModule()).load(source);
    const machine = new motion.BananaMachine({ samples: 5 });
    assert.equal(machine.stats.n, 5);
    machine.free();
  }
  const core = await freshModule();
  await assert.rejects(core.load(42), TypeError);
  await assert.rejects(core.load(new Uint8Array([1, 2, 3])));
  assert.ok((await core.load()).BananaMachine, 'a failed load can be tried again');
});

test('a machine opens in the state of the widget', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const opening = {
    ...declaredOpening('banana-machine'),
    model: 'velocity',
    noise: 'normal',
    command: { v: 1, omega: 0.5, dt: 1 },
    alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01],
    isolate: null,
    samples: 50_000,
    seed: 3,
  };
  for (const machine of [new BananaMachine(), new BananaMachine({}), new BananaMachine(undefined)]) {
    assert.deepEqual(machine.config, opening);
    assert.equal(machine.shown, 50_000);
    near(machine.table.exact.crossTrackSkew, -0.43093, 5e-6);
  }
  assert.ok(BananaMachine.maxSamples >= 100_000);
  assert.deepEqual(BananaMachine.presets, [
    { name: 'straight', v: 1, omega: 0, dt: 2, alphas: null },
    { name: 'gentle', v: 1, omega: 0.5, dt: 1, alphas: null },
    { name: 'hard', v: 1, omega: 1.2, dt: 1.4, alphas: null },
    { name: 'pivot', v: 0.06, omega: 1.5, dt: 1, alphas: null },
    { name: 'banana', v: 1, omega: 0, dt: 2, alphas: [0.002, 0.002, 0.1, 0.1, 0.002, 0.002] },
    { name: 'worked', v: 1, omega: 0.5, dt: 1, alphas: [0.02, 0.02, 0.02, 0.02, 0, 0] },
  ]);
});

test('the canonical example has the figures that were computed by quadrature', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const machine = new BananaMachine(CANONICAL);
  const { linearized, exact } = machine.table;
  linearized.mean.forEach((/** @type {number} */ value, /** @type {number} */ i) =>
    near(value, [0.958851077208, 0.244834876219, 0.5][i], 1e-12),
  );
  for (const [i, j, value] of [[0, 0, 0.023645], [1, 1, 0.007002], [0, 1, 0.003963], [0, 2, -0.004063], [1, 2, 0.01173]]) {
    near(linearized.cov[i][j], value, 5.1e-7);
    near(linearized.cov[j][i], value, 5.1e-7);
  }
  assert.equal(linearized.crossTrackSkew, 0, 'no Gaussian in (x, y) has a skew');
  near(exact.mean[0], 0.955006501, 5.1e-10);
  near(exact.mean[1], 0.243321663, 5.1e-10);
  near(exact.cov[0][0], 0.023497983, 5.1e-10);
  near(exact.cov[1][1], 0.007057304, 5.1e-10);
  near(exact.crossTrackSkew, -0.30056, 5.1e-6);

  // Measured: 4.5 standard errors, σ/√n of a mean and √(2/n) of a variance (ξ is Gaussian).
  const { stats } = machine;
  assert.equal(stats.n, CANONICAL.samples);
  near(stats.crossTrackSkew, exact.crossTrackSkew, 4.5 * stats.crossTrackSkewError);
  assert.ok(stats.crossTrackSkewError > 0.003 && stats.crossTrackSkewError < 0.02);
  near(stats.cartesian.mean[0], exact.mean[0], 4.5 * Math.sqrt(exact.cov[0][0] / stats.n));
  near(stats.exponential.mean[0], 1, 4.5 * Math.sqrt(0.025 / stats.n));
  near(stats.exponential.mean[2], 0.5, 4.5 * Math.sqrt(0.025 / stats.n));
  near(stats.exponential.cov[0][0], 0.025, 0.025 * 4.5 * Math.sqrt(2 / stats.n));
  near(stats.exponential.cov[2][2], 0.025, 0.025 * 4.5 * Math.sqrt(2 / stats.n));
  near(stats.exponential.cov[1][1], 0, 1e-20);
  near(stats.gaussianSkew, -0.30056, 0.01);
  // Correlation of d = −x sin h + y cos h with θ, from the exact covariance; its error is (1 − ρ²)/√n and a little.
  const [sin, cos] = [Math.sin(0.5), Math.cos(0.5)];
  const { cov } = exact;
  const acrossVariance = cov[0][0] * sin * sin - 2 * cov[0][1] * sin * cos + cov[1][1] * cos * cos;
  const rho = (cov[1][2] * cos - cov[0][2] * sin) / Math.sqrt(acrossVariance * cov[2][2]);
  near(stats.rhoCrossHeading, rho, 4.5 * 2 * ((1 - rho * rho) / Math.sqrt(stats.n)));
  near(stats.coverage.exponential, 1 - Math.exp(-2), 4.5 * Math.sqrt(0.117 / stats.n));
  assert.ok(stats.coverage.ellipse > 0.85 && stats.coverage.ellipse < 0.89);
  machine.free();
});

test('the likelihood gain is that of the published figures, with its error, and stands beside the exact one', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const command = { v: 1, omega: 0.5, dt: 1 };
  const opening = new BananaMachine({ command, alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01], samples: 200_000 });
  const { likelihoodGain, likelihoodGainError, areaRatio } = opening.stats;
  const { exact, measured, linearized } = opening.table;
  for (const key of /** @type {const} */ (['pose', 'floor'])) {
    near(likelihoodGain[key], exact.likelihoodGain[key], 4.5 * likelihoodGainError[key]);
    assert.equal(measured.likelihoodGain[key], likelihoodGain[key]);
    assert.equal(linearized.likelihoodGain[key], 0);
  }
  near(exact.likelihoodGain.pose, 0.124, 5e-4);
  near(exact.areaRatio, 1.007, 5e-4);
  near(areaRatio, exact.areaRatio, 0.02);
  assert.deepEqual([measured.areaRatio, linearized.areaRatio], [areaRatio, 1]);
});

test('the gain is infinite on a surface, and NaN at a point with all that is said of one', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const surface = new BananaMachine(CANONICAL).stats;
  assert.deepEqual([surface.likelihoodGain.pose, surface.likelihoodGainError.pose], [Infinity, NaN]);
  near(surface.likelihoodGain.floor, 0.0178, 4.5 * surface.likelihoodGainError.floor);
  const point = new BananaMachine({ alphas: [0, 0, 0, 0, 0.1, 0], samples: 5000 });
  const { likelihoodGain, likelihoodGainError, coverage, ...rest } = point.stats;
  const figures = [likelihoodGain, likelihoodGainError, coverage].flatMap((pair) => Object.values(pair));
  figures.push(rest.crossTrackSkew, rest.crossTrackSkewError, rest.gaussianSkew, rest.rhoCrossHeading, rest.areaRatio);
  assert.deepEqual(figures, Array(11).fill(NaN));
  // A dust of noise is noise.
  const dust = new BananaMachine({ alphas: Array(6).fill(1e-12), samples: 5000 }).stats;
  assert.ok([dust.crossTrackSkew, dust.gaussianSkew, dust.coverage.ellipse, dust.areaRatio].every(Number.isFinite));
  near(dust.likelihoodGain.pose, 0, 1e-6);
});

test('stats are those of the poses', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  for (const model of ['velocity', 'odometry']) {
    for (const noise of ['normal', 'triangular']) {
      const machine = new BananaMachine({ model, noise, samples: 1000, seed: 3 });
      const { poses, stats } = machine;
      assert.ok(poses instanceof Float64Array);
      assert.equal(poses.length, 3000);
      /** @type {(axis: number) => number[]} */
      const column = (axis) => Array.from({ length: 1000 }, (_, i) => poses[3 * i + axis]);
      /** @type {(values: number[]) => number} */
      const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
      const [x, y, theta] = [0, 1, 2].map(column);
      near(stats.cartesian.mean[0], mean(x), 1e-12);
      near(stats.cartesian.mean[1], mean(y), 1e-12);
      const heading = Math.atan2(mean(theta.map(Math.sin)), mean(theta.map(Math.cos)));
      near(stats.cartesian.mean[2], heading, 1e-12);
      const d = x.map((_, i) => -(x[i] - mean(x)) * Math.sin(heading) + (y[i] - mean(y)) * Math.cos(heading));
      const skew = mean(d.map((value) => value ** 3)) / mean(d.map((value) => value ** 2)) ** 1.5;
      near(stats.crossTrackSkew, skew, 1e-10);
      const { twists } = machine;
      assert.equal(twists.length, 3000);
      near(stats.exponential.mean[0], mean(Array.from({ length: 1000 }, (_, i) => twists[3 * i])), 1e-12);
      near(stats.cartesian.cov[0][0], (mean(x.map((value) => (value - mean(x)) ** 2)) * 1000) / 999, 1e-12);
      machine.free();
    }
  }
});

test('a slider moves the same robots, a larger cloud begins with the smaller one, a seed is a cloud', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const machine = new BananaMachine({ samples: 500 });
  const before = machine.poses;
  machine.configure({ samples: 700 });
  assert.deepEqual(machine.poses.slice(0, 1500), before);
  machine.configure({ alphas: [0.1, 0, 0, 0, 0, 0] });
  machine.configure({ alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01], samples: 500 });
  assert.deepEqual(machine.poses, before);
  machine.configure({ seed: 8 });
  assert.notDeepEqual(machine.poses, before);
  assert.deepEqual(new BananaMachine({ samples: 500, seed: 8 }).poses, machine.poses);
});

test('each model keeps its own alphas', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const machine = new BananaMachine({ samples: 10 });
  machine.configure({ alphas: [1, 2, 3, 4, 5, 6] });
  machine.configure({ model: 'odometry' });
  assert.equal(machine.config.alphas.length, 4);
  machine.configure({ alphas: [0.4, 0.3, 0.2, 0.1] });
  machine.configure({ model: 'velocity' });
  assert.deepEqual(machine.config.alphas, [1, 2, 3, 4, 5, 6]);
  machine.configure({ model: 'odometry' });
  assert.deepEqual(machine.config.alphas, [0.4, 0.3, 0.2, 0.1]);
  machine.configure({ isolate: 2 });
  assert.deepEqual([machine.config.isolate, machine.config.alphas], [2, [0.4, 0.3, 0.2, 0.1]]);
  machine.configure({ isolate: null });
  assert.equal(machine.config.isolate, null);
  machine.configure({ alphas: new Float64Array([1, 1, 1, 1]) });
  assert.deepEqual(machine.config.alphas, [1, 1, 1, 1]);
  assert.deepEqual(machine.alphasOfModels, { velocity: [1, 2, 3, 4, 5, 6], odometry: [1, 1, 1, 1] });
});

test('what is handed out is a copy', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const machine = new BananaMachine({ samples: 20 });
  const [poses, config, stats] = [machine.poses, machine.config, machine.stats];
  poses.fill(NaN);
  config.alphas[0] = 9;
  config.command.v = 9;
  stats.cartesian.mean[0] = 9;
  assert.ok(machine.poses.every(Number.isFinite));
  assert.deepEqual([machine.config.alphas[0], machine.config.command.v], [0.05, 1]);
  assert.notEqual(machine.stats.cartesian.mean[0], 9);
  // A view of the module's memory would go blank when that memory grows.
  const kept = machine.poses;
  const copy = kept.slice();
  const large = new BananaMachine({ samples: BananaMachine.maxSamples });
  assert.equal(large.shown, BananaMachine.maxSamples);
  large.free();
  assert.deepEqual(kept, copy);
});

test('the cloud grows, restarts and is undefined where there is nothing', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const machine = new BananaMachine({ samples: 300 });
  const whole = machine.poses;
  machine.restart();
  assert.equal(machine.shown, 0);
  assert.equal(machine.poses.length, 0);
  const { stats } = machine;
  assert.equal(stats.n, 0);
  for (const value of [stats.crossTrackSkew, stats.gaussianSkew, stats.coverage.ellipse, stats.cartesian.mean[0]]) {
    assert.ok(Number.isNaN(value));
  }
  assert.equal(machine.contours.ellipse.length, 0);
  assert.equal(machine.grow(1), 1);
  assert.ok(Number.isNaN(machine.stats.crossTrackSkewError) && Number.isFinite(machine.stats.cartesian.mean[0]));
  assert.equal(machine.grow(100), 101);
  assert.deepEqual(machine.poses, whole.slice(0, 303));
  assert.equal(machine.grow(1000), 300);
  assert.deepEqual(machine.poses, whole);
});

test('contours, curve, inspection and views', async () => {
  const { BananaMachine, commandReaching, randomSeed } = await (await freshModule()).load();
  const machine = new BananaMachine({ samples: 4000 });
  const { command, ...outlines } = machine.contours;
  assert.deepEqual(Object.keys(outlines).sort(), ['additive', 'ellipse', 'exponential', 'linearized', 'twistEllipse']);
  for (const outline of Object.values(outlines)) {
    assert.ok(outline instanceof Float64Array && outline.length > 60);
    assert.deepEqual(outline.slice(0, 2), outline.slice(-2), 'closed');
  }
  near(command.at(-2), 2 * Math.sin(0.5), 1e-12);
  near(command.at(-1), 2 * (1 - Math.cos(0.5)), 1e-12);

  const curve = machine.skewCurve(-1, 1, 5);
  assert.equal(curve.length, 5);
  near(curve[3], -0.43093, 5e-6);
  near(curve[1], 0.43093, 5e-6);

  const sample = machine.inspect(17);
  assert.deepEqual([...sample.pose], [...machine.poses.slice(51, 54)]);
  assert.deepEqual([...sample.twist], [...machine.twists.slice(51, 54)]);
  const turn = sample.omegaHat;
  near((sample.vHat * Math.sin(turn)) / turn, sample.pose[0], 1e-12);
  near((sample.vHat * (1 - Math.cos(turn))) / turn, sample.pose[1], 1e-12);
  near(turn + sample.gammaHat, sample.pose[2], 1e-12);

  assert.equal(machine.nearest('plane', sample.pose[0], sample.pose[1], 1e-6, 1e-6), 17);
  assert.equal(machine.nearest('twist', sample.twist[0], sample.twist[2], 1e-6, 1e-6), 17);
  assert.equal(machine.nearest('plane', 100, 100, 1, 1), -1);
  const counts = machine.density('plane', -4, -4, 4, 4, 20, 10);
  assert.ok(counts instanceof Uint32Array && counts.length === 200);
  assert.equal(counts.reduce((sum, count) => sum + count, 0), 4000);
  const { poses } = machine;
  const upper = Array.from({ length: 4000 }, (_, i) => poses[3 * i + 1]).filter((y) => y > 0).length;
  near(counts.slice(0, 100).reduce((sum, count) => sum + count, 0), upper, 0, 'row 0 is at the top');

  const ramp = Uint8Array.from({ length: 1024 }, (_, i) => (i % 4 === 3 ? 255 : i >> 2));
  const pixels = machine.picture('plane', -4, -4, 4, 4, 20, 10, ramp);
  assert.ok(pixels instanceof Uint8ClampedArray && pixels.length === 800);
  const most = Math.max(...counts);
  counts.forEach((count, cell) => {
    const shade = Math.round(255 * Math.sqrt(count / most));
    assert.deepEqual([...pixels.slice(4 * cell, 4 * cell + 4)], count > 0 ? [shade, shade, shade, 255] : [0, 0, 0, 0]);
  });
  assert.deepEqual(machine.density('plane', -4, -4, 4, 4, 20, 10), counts, 'nothing of a picture is left for the next');
  near(machine.heading(17), poses[53], 0);

  const { v, omega } = commandReaching(1, -0.4, { v: 1, omega: 0.2, dt: 2 });
  machine.configure({ command: { v, omega, dt: 2 } });
  near(machine.contours.command.at(-2), 1, 1e-12);
  near(machine.contours.command.at(-1), -0.4, 1e-12);
  const seeds = Array.from({ length: 20 }, randomSeed);
  assert.ok(seeds.every((seed) => Number.isInteger(seed) && seed >= 0 && seed < 2 ** 32));
  assert.ok(new Set(seeds).size > 15);
});

test('a change in slices ends where a change at once does', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const [sliced, whole] = [new BananaMachine(), new BananaMachine()];
  const change = { command: { v: 1, omega: 1.2, dt: 1.4 }, samples: 20_000, seed: 3 };
  const before = sliced.stats;
  sliced.begin(change);
  let slices = 1;
  while (!sliced.advance(1000)) {
    assert.deepEqual(sliced.stats.cartesian, before.cartesian);
    slices += 1;
  }
  assert.ok(slices > 30, `${slices} slices`);
  whole.configure(change);
  assert.deepEqual(sliced.stats, whole.stats);
  assert.deepEqual(sliced.poses, whole.poses);
  assert.throws(() => sliced.begin({ samples: 0 }), RangeError);
  assert.equal(sliced.advance(1), true, 'nothing was begun');
});

test('free and Symbol.dispose give the memory back, and a freed machine says so', async () => {
  const { BananaMachine } = await (await freshModule()).load();
  const machine = new BananaMachine({ samples: 10 });
  machine.free();
  assert.throws(() => machine.stats, Error);
  assert.throws(() => machine.configure({ samples: 5 }), Error);
  const other = new BananaMachine({ samples: 10 });
  other[Symbol.dispose]();
  assert.throws(() => other.poses, Error);
  // Each cloud takes 400 MB, and what is left of all is less than 1 MB: a twentieth of one that did not come back would be seen.
  const large = () => new BananaMachine({ samples: BananaMachine.maxSamples }).free();
  large();
  const resident = process.memoryUsage().rss;
  for (let i = 0; i < 4; i += 1) large();
  assert.ok(process.memoryUsage().rss - resident < 80e6);
  assert.equal(new BananaMachine({ samples: 3 }).shown, 3);
});
