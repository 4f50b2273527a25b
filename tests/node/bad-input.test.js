// Whatever JavaScript hands in: an error that names the field, the value and what is allowed, and an object that goes
// on as if nothing had been asked.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { inspect } from 'node:util';
import { generator } from '../random.js';
import { freshModule } from './support.js';

const { BananaMachine, commandReaching } = await (await freshModule()).load();

const COMMAND = { v: 1, omega: 0.5, dt: 1 };
const ALPHAS = [0.1, 0.1, 0.1, 0.1, 0.1, 0.1];

/** @param {number} index @param {unknown} value */
const alphasWith = (index, value) => ALPHAS.with(index, /** @type {number} */ (value));

/** @param {string} key */
const throwing = (key) => ({
  get [key]() {
    throw new Error('from the getter');
  },
});

/**
 * Options, the class of the error, the field that it names, and the value as it says it.
 *
 * @type {[unknown, ErrorConstructor, string, string][]}
 */
const BAD = [
  // Not numbers at all, and numbers that are none.
  [{ command: { ...COMMAND, v: NaN } }, RangeError, 'command.v', 'NaN'],
  [{ command: { ...COMMAND, v: Infinity } }, RangeError, 'command.v', 'Infinity'],
  [{ command: { ...COMMAND, omega: -Infinity } }, RangeError, 'command.omega', '-Infinity'],
  [{ command: { ...COMMAND, dt: NaN } }, RangeError, 'command.dt', 'NaN'],
  [{ command: { ...COMMAND, dt: Infinity } }, RangeError, 'command.dt', 'Infinity'],
  [{ command: { ...COMMAND, dt: 0 } }, RangeError, 'command.dt', '0'],
  [{ command: { ...COMMAND, dt: -0 } }, RangeError, 'command.dt', '0'],
  [{ command: { ...COMMAND, dt: -1 } }, RangeError, 'command.dt', '-1'],
  [{ command: { ...COMMAND, v: 1e300 } }, RangeError, 'command.v', '1e+300'],
  [{ command: { ...COMMAND, v: '1' } }, TypeError, 'command.v', '"1"'],
  [{ command: { ...COMMAND, v: 1n } }, TypeError, 'command.v', 'bigint'],
  [{ command: { ...COMMAND, v: null } }, TypeError, 'command.v', 'null'],
  [{ command: { ...COMMAND, v: true } }, TypeError, 'command.v', 'true'],
  [{ command: { ...COMMAND, v: new Number(1) } }, TypeError, 'command.v', 'object'],
  [{ command: { ...COMMAND, v: Symbol('v') } }, TypeError, 'command.v', 'symbol'],
  [{ command: { ...COMMAND, v: () => 1 } }, TypeError, 'command.v', 'function'],
  [{ command: { v: 1, omega: 0.5 } }, TypeError, 'command.dt', 'undefined'],
  [{ command: {} }, TypeError, 'command.v', 'undefined'],
  [{ command: { ...COMMAND, gamma: 1 } }, TypeError, 'command.gamma', 'unknown'],
  [{ command: null }, TypeError, 'command', 'null'],
  [{ command: 1 }, TypeError, 'command', '1'],
  [{ command: 'forward' }, TypeError, 'command', '"forward"'],
  [{ command: [1, 0.5, 1] }, TypeError, 'command', 'length 3'],
  [{ command: new Float64Array(3) }, TypeError, 'command', 'length 3'],

  [{ alphas: alphasWith(0, NaN) }, RangeError, 'alphas[0]', 'NaN'],
  [{ alphas: alphasWith(5, Infinity) }, RangeError, 'alphas[5]', 'Infinity'],
  [{ alphas: alphasWith(3, -0.01) }, RangeError, 'alphas[3]', '-0.01'],
  [{ alphas: alphasWith(3, -1e-300) }, RangeError, 'alphas[3]', '-1e-300'],
  [{ alphas: alphasWith(1, undefined) }, TypeError, 'alphas[1]', 'undefined'],
  [{ alphas: alphasWith(1, null) }, TypeError, 'alphas[1]', 'null'],
  [{ alphas: alphasWith(1, '0.1') }, TypeError, 'alphas[1]', '"0.1"'],
  [{ alphas: alphasWith(1, 1n) }, TypeError, 'alphas[1]', 'bigint'],
  // eslint-disable-next-line no-sparse-arrays
  [{ alphas: [0.1, , 0.1, 0.1, 0.1, 0.1] }, TypeError, 'alphas[1]', 'undefined'],
  [{ alphas: [] }, RangeError, 'alphas', '0'],
  [{ alphas: ALPHAS.slice(1) }, RangeError, 'alphas', '5'],
  [{ alphas: [...ALPHAS, 0.1] }, RangeError, 'alphas', '7'],
  [{ alphas: [0.1, 0.1, 0.1, 0.1] }, RangeError, 'alphas', '4'],
  [{ model: 'odometry', alphas: ALPHAS }, RangeError, 'alphas', '6'],
  [{ alphas: new Float64Array(5) }, RangeError, 'alphas', '5'],
  [{ alphas: new Array(4e9) }, RangeError, 'alphas', '4000000000'],
  [{ alphas: 0.1 }, TypeError, 'alphas', '0.1'],
  [{ alphas: null }, TypeError, 'alphas', 'null'],
  [{ alphas: '0.1,0.1' }, TypeError, 'alphas', '"0.1,0.1"'],
  [{ alphas: {} }, TypeError, 'alphas', 'object'],
  [{ alphas: { length: 6 } }, TypeError, 'alphas[0]', 'undefined'],
  [{ alphas: new BigInt64Array(6) }, TypeError, 'alphas[0]', 'bigint'],

  [{ samples: 0 }, RangeError, 'samples', '0'],
  [{ samples: -1 }, RangeError, 'samples', '-1'],
  [{ samples: 2.5 }, RangeError, 'samples', '2.5'],
  [{ samples: NaN }, RangeError, 'samples', 'NaN'],
  [{ samples: Infinity }, RangeError, 'samples', 'Infinity'],
  [{ samples: BananaMachine.maxSamples + 1 }, RangeError, 'samples', String(BananaMachine.maxSamples + 1)],
  [{ samples: 2 ** 32 + 5 }, RangeError, 'samples', String(2 ** 32 + 5)],
  [{ samples: '100' }, TypeError, 'samples', '"100"'],
  [{ samples: 100n }, TypeError, 'samples', 'bigint'],
  [{ samples: null }, TypeError, 'samples', 'null'],
  [{ samples: [100] }, TypeError, 'samples', 'object'],

  [{ seed: -1 }, RangeError, 'seed', '-1'],
  [{ seed: 0.5 }, RangeError, 'seed', '0.5'],
  [{ seed: NaN }, RangeError, 'seed', 'NaN'],
  [{ seed: 2 ** 53 }, RangeError, 'seed', String(2 ** 53)],
  [{ seed: '7' }, TypeError, 'seed', '"7"'],
  [{ seed: 7n }, TypeError, 'seed', 'bigint'],
  [{ seed: null }, TypeError, 'seed', 'null'],

  [{ isolate: 0 }, RangeError, 'isolate', '0'],
  [{ isolate: 7 }, RangeError, 'isolate', '7'],
  [{ isolate: 1.5 }, RangeError, 'isolate', '1.5'],
  [{ isolate: '4' }, TypeError, 'isolate', '"4"'],
  [{ isolate: false }, TypeError, 'isolate', 'false'],
  [{ model: 'odometry', isolate: 5 }, RangeError, 'isolate', '5'],

  [{ model: 'Velocity' }, RangeError, 'model', '"Velocity"'],
  [{ model: '' }, RangeError, 'model', '""'],
  [{ model: 1 }, TypeError, 'model', '1'],
  [{ model: null }, TypeError, 'model', 'null'],
  [{ model: 'x'.repeat(1e6) }, RangeError, 'model', '"xxxx'],
  [{ noise: 'gaussian' }, RangeError, 'noise', '"gaussian"'],
  [{ noise: {} }, TypeError, 'noise', 'object'],

  [{ sample: 100 }, TypeError, 'sample', 'unknown'],
  [{ samples: 100, Seed: 1 }, TypeError, 'Seed', 'unknown'],
  [{ '': 1 }, TypeError, '', 'unknown'],
  [{ __proto__: null, constructor: 1 }, TypeError, 'constructor', 'unknown'],
  [null, TypeError, 'options', 'null'],
  [5, TypeError, 'options', '5'],
  ['velocity', TypeError, 'options', '"velocity"'],
  [true, TypeError, 'options', 'true'],
  [7n, TypeError, 'options', 'bigint'],
  [Symbol('s'), TypeError, 'options', 'symbol'],
  [[1, 2], TypeError, 'options', 'length 2'],

  // Code of the caller's that runs while it is read.
  [throwing('samples'), TypeError, 'samples', 'throws'],
  [throwing('alphas'), TypeError, 'alphas', 'throws'],
  [throwing('model'), TypeError, 'model', 'throws'],
  [{ command: { v: 1, omega: 0.5, get dt() { throw new Error('dt'); } } }, TypeError, 'command.dt', 'throws'],
  [{ alphas: Object.defineProperty([...ALPHAS], 2, { get() { throw new Error('2'); } }) }, TypeError, 'alphas[2]', 'throws'],
  [{ alphas: new Proxy(ALPHAS, { get() { throw new Error('proxy'); } }) }, TypeError, 'alphas', 'throws'],
  [new Proxy({}, { ownKeys() { throw new Error('proxy'); } }), TypeError, 'options', 'throws'],
  [{ command: new Proxy({}, { ownKeys() { throw new Error('proxy'); } }) }, TypeError, 'command', 'throws'],
];

/** @param {any} machine */
const state = (machine) => ({ config: machine.config, stats: machine.stats, poses: machine.poses, shown: machine.shown });

/**
 * @param {() => unknown} act
 * @param {ErrorConstructor} type
 * @param {string} field
 * @param {string} value
 * @param {string} what
 */
function assertRefused(act, type, field, value, what) {
  assert.throws(
    act,
    (/** @type {Error} */ error) => {
      assert.ok(error instanceof type, `${what}: ${error?.constructor?.name}: ${error?.message}`);
      assert.equal(error.constructor, type, what);
      assert.ok(error.message.startsWith(`${field} `), `${what} names another field: ${error.message}`);
      assert.ok(error.message.includes(value), `${what} does not name the value: ${error.message}`);
      assert.match(error.message, /allowed (is|are) \S/, what);
      assert.ok(error.message.length < 400, `${what}: ${error.message.length} characters`);
      return true;
    },
    what,
  );
}

test('every bad option is refused, and the machine is as it was', () => {
  const machine = new BananaMachine({ samples: 300, seed: 11 });
  machine.restart();
  machine.grow(120);
  const before = state(machine);
  for (const [i, [options, type, field, value]] of BAD.entries()) {
    const what = `case ${i} (${field})`;
    assertRefused(() => machine.configure(options), type, field, value, what);
    assert.deepEqual(state(machine), before, what);
    assertRefused(() => new BananaMachine(options), type, field, value, `new, ${what}`);
  }
  // Nothing that came along with a bad value is taken over.
  assert.throws(() => machine.configure({ model: 'odometry', samples: 10, seed: 1, alphas: [1, 2, 3, NaN] }), RangeError);
  assert.throws(() => machine.configure({ alphas: [1, 1, 1, 1, 1, 1], samples: 0 }), RangeError);
  assert.deepEqual(state(machine), before);

  machine.configure({ samples: 200, command: { v: -1, omega: 0.2, dt: 2 } });
  assert.equal(machine.grow(1000), 200);
  assert.equal(machine.stats.n, 200);
  machine.free();
});

test('undefined counts as left out, and symbols as no keys', () => {
  const machine = new BananaMachine({ samples: undefined, seed: undefined, [Symbol('note')]: 1 });
  assert.equal(machine.config.samples, 50_000);
  machine.configure({ alphas: undefined, isolate: undefined, model: undefined });
  assert.equal(machine.config.seed, 3);
  assert.throws(() => machine.configure(), TypeError);
  machine.free();
});

test('a getter that calls back into the machine harms nothing', () => {
  const machine = new BananaMachine({ samples: 50 });
  const before = state(machine);
  /** @param {() => unknown} act */
  const calling = (act) => ({
    get samples() {
      act();
      return 60;
    },
  });
  for (const act of [
    () => machine.config,
    () => machine.poses,
    () => machine.configure({ samples: 10 }),
    () => machine.grow(1),
    () => new BananaMachine({ samples: 10 }).stats,
  ]) {
    try {
      machine.configure(calling(act));
      assert.equal(machine.config.samples, 60);
    } catch (error) {
      assert.ok(error instanceof TypeError, String(error));
    }
    machine.configure({ samples: 50 });
    machine.grow(50);
    assert.deepEqual(state(machine), before);
  }
  assert.throws(() => machine.configure(calling(() => machine.free())), Error);
  assert.equal(new BananaMachine({ samples: 5 }).stats.n, 5, 'other machines go on');
});

test('an object that grows while it is read is read once', () => {
  let reads = 0;
  const machine = new BananaMachine({ samples: 5 });
  machine.configure({
    get samples() {
      reads += 1;
      return reads === 1 ? 6 : NaN;
    },
  });
  assert.deepEqual([reads, machine.config.samples], [1, 6]);
});

test('arguments of the other methods', () => {
  const machine = new BananaMachine({ samples: 100 });
  const before = state(machine);
  /** @type {[() => unknown, ErrorConstructor, string, string][]} */
  const bad = [
    [() => machine.grow(), TypeError, 'count', 'undefined'],
    [() => machine.grow(-1), RangeError, 'count', '-1'],
    [() => machine.grow(1.5), RangeError, 'count', '1.5'],
    [() => machine.grow('1'), TypeError, 'count', '"1"'],
    [() => machine.grow(1n), TypeError, 'count', 'bigint'],
    [() => machine.inspect(100), RangeError, 'index', '100'],
    [() => machine.inspect(-1), RangeError, 'index', '-1'],
    [() => machine.inspect(0.5), RangeError, 'index', '0.5'],
    [() => machine.inspect(NaN), RangeError, 'index', 'NaN'],
    [() => machine.inspect('0'), TypeError, 'index', '"0"'],
    [() => machine.skewCurve(NaN, 1, 5), RangeError, 'omegaMin', 'NaN'],
    [() => machine.skewCurve(0, Infinity, 5), RangeError, 'omegaMax', 'Infinity'],
    [() => machine.skewCurve(0, 1, 1), RangeError, 'points', '1'],
    [() => machine.skewCurve(0, 1, 1e9), RangeError, 'points', '1000000000'],
    [() => machine.skewCurve(0, 1), TypeError, 'points', 'undefined'],
    [() => machine.nearest('side', 0, 0, 1, 1), RangeError, 'view', '"side"'],
    [() => machine.nearest('plane', '0', 0, 1, 1), TypeError, 'x', '"0"'],
    [() => machine.nearest('plane', 0, 0, 1), TypeError, 'radiusY', 'undefined'],
    [() => machine.nearest('plane', 0, 0, -1, 1), RangeError, 'radiusX', '-1'],
    [() => machine.nearest('plane', 0, 0, 1, NaN), RangeError, 'radiusY', 'NaN'],
    [() => machine.density('plane', 0, 0, NaN, 1, 10, 10), RangeError, 'xMax', 'NaN'],
    [() => machine.density('plane', 0, 0, -1, 1, 10, 10), RangeError, 'xMax', '-1'],
    [() => machine.density('plane', 0, 0, 1, 1, 0, 10), RangeError, 'columns', '0'],
    [() => machine.density('plane', 0, 0, 1, 1, 2 ** 14, 2 ** 10 + 1), RangeError, 'rows', '1025; allowed is a whole number from 1 to 1024'],
    [() => machine.density('plane', 0, 0, 1, 1, 1, 2 ** 14 + 1), RangeError, 'rows', '16385; allowed is a whole number from 1 to 16384'],
    [() => machine.picture('plane', 0, 0, 1, 1, 2 ** 14 + 1, 1, new Uint8Array(1024)), RangeError, 'columns', '16385; allowed is a whole number from 1 to 16384'],
    [() => machine.density('plane', 0, 0, 1, 1, 1e12, 1), RangeError, 'columns', '1000000000000'],
    [() => machine.density(null, 0, 0, 1, 1, 1, 1), TypeError, 'view', 'null'],
    [() => machine.picture('plane', 0, 0, 1, 1, 10, 0, new Uint8Array(1024)), RangeError, 'rows', '0'],
    [() => machine.picture('plane', 0, 0, 1, 1, 10, 10, new Uint8Array(1023)), RangeError, 'ramp', '1023'],
    [() => machine.picture('plane', 0, 0, 1, 1, 10, 10), TypeError, 'ramp', 'undefined'],
    [() => machine.heading(1e9), RangeError, 'index', '1000000000'],
    [() => machine.advance(0), RangeError, 'poses', '0'],
    [() => commandReaching(NaN, 0, { v: 1, omega: 1, dt: 1 }), RangeError, 'x', 'NaN'],
    [() => commandReaching(1, '0', { v: 1, omega: 1, dt: 1 }), TypeError, 'y', '"0"'],
    [() => commandReaching(1, 0, { v: 1, omega: 1, dt: 0 }), RangeError, 'command.dt', '0'],
    [() => commandReaching(1, 0, { v: 1, omega: 1 }), TypeError, 'command.dt', 'undefined'],
    [() => commandReaching(1, 0), TypeError, 'command', 'undefined'],
  ];
  for (const [act, type, field, value] of bad) assertRefused(act, type, field, value, `${act}`);
  assert.deepEqual(state(machine), before);
  // Points without meaning are near to nothing; they are no reason to stop a pointer.
  assert.equal(machine.nearest('plane', NaN, 0, 1, 1), -1);
  assert.equal(machine.nearest('plane', 9, 9, 0, 0), -1);
  machine.restart();
  assertRefused(() => machine.inspect(0), RangeError, 'index', '0', 'inspect of an empty cloud');
});

test('thousands of arbitrary settings: refused whole or taken whole, and nothing traps', () => {
  const random = generator(2005);
  /** @type {<T>(values: T[]) => T} */
  const pick = (values) => values[Math.floor(random() * values.length)];
  const NUMBERS = [0, -0, 1, -1, 0.5, 3.2, 1e-300, 5e-324, 1e-6, 1e6, -1e6, 1e7, 1e308, NaN, Infinity, -Infinity, 2 ** 31, 2 ** 32, 2 ** 53];
  const OTHERS = [undefined, null, '', '1', true, 1n, {}, [], () => 1, Symbol('x'), new Date(0), new Float64Array(4), Object.create(null)];
  /** Mostly a number that may pass. @returns {unknown} */
  const value = () => (random() < 0.9 ? pick(random() < 0.7 ? [0, 0.01, 0.3, 1, -2, 1e-6, 1e6] : NUMBERS) : pick(OTHERS));
  const list = () => Array.from({ length: pick([4, 6, 6, 6, 5]) }, () => (random() < 0.9 ? Math.abs(random()) : value()));
  /** @type {Record<string, () => unknown>} */
  const keys = {
    model: () => pick(['velocity', 'odometry', 'velocity', value()]),
    noise: () => pick(['normal', 'triangular', 'normal', value()]),
    command: () => (random() < 0.95 ? { v: value(), omega: value(), dt: value() } : value()),
    alphas: () => (random() < 0.95 ? list() : value()),
    isolate: () => pick([null, 1, 2, 4, 6, value()]),
    samples: () => pick([1, 2, 3, 17, 40, value()]),
    seed: () => pick([0, 1, 2 ** 53 - 1, value()]),
    extra: () => 1,
  };
  let machine = new BananaMachine({ samples: 20 });
  const tally = { taken: 0, refused: 0 };
  for (let round = 0; round < 4000; round += 1) {
    const chosen = Object.keys(keys).filter((key) => random() < (key === 'extra' ? 0.02 : 0.25));
    const options = Object.fromEntries(chosen.map((key) => [key, keys[key]()]));
    const before = state(machine);
    const doing = () => `round ${round}: ${inspect(options)}`;
    try {
      machine.configure(options);
      tally.taken += 1;
    } catch (error) {
      tally.refused += 1;
      assert.ok(error instanceof TypeError || error instanceof RangeError, `${doing()}: ${error}`);
      assert.match(error.message, /allowed/, doing());
      assert.deepEqual(state(machine), before, doing());
    }
    const { stats, contours, table, config } = machine;
    assert.equal(stats.n, machine.poses.length / 3, doing());
    assert.equal(stats.n, config.samples, doing());
    assert.ok(machine.poses.every(Number.isFinite), doing());
    assert.ok(contours.command.length >= 4 && table.exact.cov.length === 3, doing());
    assert.equal(machine.skewCurve(-1e6, 1e6, 3).length, 3);
    assert.ok(machine.density(pick(['plane', 'twist']), -1, -1, 1, 1, 3, 3).length === 9);
    machine.inspect(0);
    if (config.samples > 1000) {
      machine.free();
      machine = new BananaMachine({ samples: 20 });
    }
  }
  assert.ok(tally.taken > 400 && tally.refused > 400, JSON.stringify(tally));
  machine.free();
});

test('methods on what is no machine throw', () => {
  const { configure, grow } = BananaMachine.prototype;
  assert.throws(() => configure.call({}, { samples: 5 }), Error);
  assert.throws(() => grow.call(undefined, 5), Error);
  assert.throws(() => BananaMachine({ samples: 5 }), TypeError);
  assert.equal(new BananaMachine({ samples: 5 }).stats.n, 5);
});
