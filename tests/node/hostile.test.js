// Arguments that do everything but hold still: they throw, run code that calls the machine back, have lost their memory.
// Each method is tried with each of them; after every one the machine answers as before.

import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { test } from 'node:test';
import { freshModule } from './support.js';

const core = await freshModule();
/** @type {any} */
const motion = await core.load();

const RECTANGLE = [-1, -1, 1, 1, 4, 4];
const PLAN = { bounds: [0, 0, 4, 3], walls: [[1, 1, 2, 1]] };
const DESCRIPTION = { resolution: 0.5, origin: [0, 0, 0] };
const PGM = new TextEncoder().encode('P2 2 2 255 255 255 255 0');
const COMMAND = { v: 1, omega: 0.5, dt: 1 };

/** Arguments that each method takes. @type {Record<string, Record<string, unknown[]>>} */
const METHODS = {
  BananaMachine: {
    configure: [{}], begin: [{}], advance: [1e6], grow: [0], beginToGrow: [0], restart: [], skewCurve: [-1, 1, 3], inspect: [0], heading: [0],
    nearest: ['plane', 0, 0, 1, 1], density: ['plane', ...RECTANGLE], picture: ['plane', ...RECTANGLE, new Uint8Array(4 * 256)],
  },
  MapSqueeze: {
    configure: [{}], begin: [{}], advance: [1e6], stop: [], setPlan: [PLAN], setGrid: [DESCRIPTION, PGM], beginGrid: [DESCRIPTION, PGM], grow: [0], beginToGrow: [0], restart: [], path: [0], trial: ['endpoint', 1, 1],
    picture: [...RECTANGLE, new Uint8Array(3 * 4 * 256)], nearest: [0, 0, 1],
  },
};

/** What reads objects in its first argument, and places in them. @type {Record<string, [string, unknown, string[]][]>} */
const PLACES = {
  BananaMachine: [['configure', { command: COMMAND, alphas: Array(6).fill(0.1) }, ['command', 'command.v', 'alphas', 'alphas.3', 'model', 'noise', 'isolate', 'samples', 'seed', 'reverseAware']]],
  MapSqueeze: [
    ['configure', { start: { x: 2, y: 2.6, theta: 1 }, command: COMMAND, alphas: Array(6).fill(0.1) }, ['start', 'start.x', 'alphas', 'noise', 'conditioned', 'sampler', 'steps', 'unknown']],
    ['setPlan', PLAN, ['bounds', 'bounds.2', 'walls', 'walls.0', 'walls.0.1']],
    ['setGrid', DESCRIPTION, ['resolution', 'origin', 'origin.1', 'mode', 'negate', 'free_thresh', 'occupied_thresh']],
  ],
};
const IMAGE = { width: 2, height: 2, data: new Uint8ClampedArray(16) };

/** @param {any} machine */
function digest(machine) {
  return createHash('sha256').update(machine.poses).update(JSON.stringify([machine.config, machine.stats])).digest('hex');
}

/** @template {object} T @param {T} array whose memory is gone afterwards */
function detached(array) {
  structuredClone(/** @type {any} */ (array).buffer, { transfer: [/** @type {any} */ (array).buffer] });
  return array;
}

const TRAPS = /** @type {const} */ (['get', 'has', 'ownKeys', 'getPrototypeOf', 'getOwnPropertyDescriptor']);
const CONVERSIONS = ['toString', 'valueOf', 'toJSON', 'length', 'constructor', Symbol.iterator, Symbol.toPrimitive, Symbol.toStringTag, Symbol.hasInstance];

/**
 * @param {() => never} act what code of a value does when it is run
 * @returns {unknown[]} values that run it wherever one may
 */
function acting(act) {
  const everywhere = () => Object.fromEntries(TRAPS.map((trap) => [trap, act]));
  const getters = Object.fromEntries(CONVERSIONS.map((name) => [name, { get: act }]));
  const methods = Object.fromEntries(CONVERSIONS.map((name) => [name, { value: act }]));
  return [
    ...[{}, [], () => 1, new Uint8Array(1024)].flatMap((target) => TRAPS.map((trap) => new Proxy(target, { [trap]: act }))),
    new Proxy({}, everywhere()),
    Object.create(new Proxy({}, everywhere())),
    ...[Object.prototype, Array.prototype, Uint8Array.prototype, null].flatMap((prototype) => [Object.create(prototype, getters), Object.create(prototype, methods)]),
    Object.defineProperty(Array(6).fill(0.1), 2, { get: act }),
    Object.defineProperty(new Uint8Array(1024), 'length', { get: act }),
    Object.defineProperty(new Uint8ClampedArray(16), 'length', { get: act }),
    Object.defineProperty({}, 'seed', { get: act, enumerable: true }),
    Object.defineProperty({}, 'bounds', { get: act, enumerable: true }),
    Object.defineProperty({}, 'width', { get: act, enumerable: true }),
    Object.defineProperty({}, 'resolution', { get: act, enumerable: true }),
    { ...IMAGE, data: Object.defineProperty(new Uint8ClampedArray(16), 'length', { get: act }) },
  ];
}

function proxies() {
  const revoked = Proxy.revocable({}, {});
  revoked.revoke();
  const revokedList = Proxy.revocable([], {});
  revokedList.revoke();
  const revoking = Proxy.revocable(/** @type {any} */ ({}), {
    ownKeys() {
      revoking.revoke();
      return ['seed'];
    },
  });
  const listRevoking = Proxy.revocable(/** @type {any} */ ([1, 2, 3, 4, 5, 6]), {
    get(target, key) {
      if (key === '1') listRevoking.revoke();
      return target[key];
    },
  });
  return [revoked.proxy, revokedList.proxy, revoking.proxy, listRevoking.proxy];
}

/** Typed arrays that are none, or none any more. */
function views() {
  const resizable = new /** @type {any} */ (ArrayBuffer)(1024, { maxByteLength: 2048 });
  const beyond = new Uint8Array(resizable, 512, 512);
  resizable.resize(256);
  return [
    ...[Uint8Array, Uint8ClampedArray, Float64Array, BigInt64Array].flatMap((Kind) => [
      detached(new Kind(1024)),
      new Proxy(new Kind(1024), {}),
      Object.create(new Kind(1024)),
      Object.create(Kind.prototype),
      Object.setPrototypeOf(new Kind(1024), Uint8Array.prototype),
      Object.setPrototypeOf(new Kind(1024), null),
      Object.defineProperty(new Kind(8), 'length', { value: 1024 }),
      Object.defineProperty(new Kind(2048), 'length', { value: 1024 }),
    ]),
    beyond,
    new Uint8Array(new SharedArrayBuffer(1024)),
    Object.setPrototypeOf(new DataView(new ArrayBuffer(1024)), Uint8Array.prototype),
    ...[detached(new Uint8ClampedArray(16)), new Proxy(new Uint8ClampedArray(16), {}), Object.create(new Uint8ClampedArray(16))].map((data) => ({ ...IMAGE, data })),
  ];
}

/**
 * Made anew for each call: some work only once.
 *
 * @param {any} machine that the values call back
 * @returns {unknown[]}
 */
const hostile = (machine) => [
  ...acting(() => { throw new Error('from the value'); }),
  ...acting(() => { throw undefined; }),
  ...acting(() => {
    const tries = [() => machine.restart(), () => machine.grow(1), () => machine.configure({ seed: 99 }), () => machine.free(), () => machine.stats, () => machine.picture()];
    for (const attempt of tries) {
      try {
        attempt();
        answered.push(String(attempt));
      } catch {
        // As it should be.
      }
    }
    return /** @type {never} */ (1);
  }),
  ...proxies(),
  ...views(),
  Symbol('s'), 1n, () => 1, class {}, new Date(NaN), /x/, new Map(), new WeakRef({}), Promise.resolve(1), globalThis,
  undefined, null, NaN, -0, -1, Infinity, 2 ** 53, '', '\ud800', '\0', 'toString', '__proto__', new String('plane'), new Number(1), [[[]]], [NaN], { length: -1 }, { length: 2 ** 53 },
  { __proto__: null, length: '6' }, { ['__proto__']: 1 }, { constructor: 1 },
];

/** Calls of a machine that it answered while it was reading its arguments. @type {string[]} */
const answered = [];

/** @param {any} target @param {string[]} path @param {unknown} value */
function placed(target, [first, ...rest], value) {
  const copy = Array.isArray(target) ? [...target] : { ...target };
  copy[first] = rest.length === 0 ? value : placed(copy[first], rest, value);
  return copy;
}

/** @param {string} name of a class */
function* calls(name) {
  for (const [method, good] of Object.entries(METHODS[name])) {
    for (const i of good.keys()) yield { method, fill: (/** @type {unknown} */ value) => good.with(i, value) };
  }
  for (const [method, good, places] of PLACES[name]) {
    for (const place of places) yield { method, fill: (/** @type {unknown} */ value) => [placed(good, place.split('.'), value), PGM].slice(0, METHODS[name][method].length) };
  }
}

for (const name of Object.keys(METHODS)) {
  const Machine = motion[name];

  test(`${name}: all of its methods are tried`, () => {
    const properties = Object.entries(Object.getOwnPropertyDescriptors(Machine.prototype));
    const methods = properties.filter(([key, { value }]) => value && !/^(constructor$|free$|__)/.test(key)).map(([key]) => key);
    assert.deepEqual(methods.sort(), Object.keys(METHODS[name]).sort());
  });

  test(`${name}: no argument of any method throws past the core`, () => {
    const machine = new Machine({ samples: 20, seed: 11 });
    const opening = machine.config;
    const before = digest(machine);
    const tally = { taken: 0, refused: 0 };
    for (const { method, fill } of calls(name)) {
      for (const [i, value] of hostile(machine).entries()) {
        const doing = `${method}, ${fill('VALUE')}, value ${i}`;
        const whole = machine.shown;
        try {
          machine[method](...fill(value));
          tally.taken += 1;
        } catch (error) {
          tally.refused += 1;
          assert.ok(error instanceof TypeError || error instanceof RangeError, `${doing}: ${error}`);
          // Lines are those of a map's file.
          if (!error.message.startsWith('line ')) assert.match(error.message, /^\S.* (is|has|ends at) .*allowed (is|are) \S/s, doing);
          assert.ok(error.message.length < 400, doing);
          assert.equal(machine.shown, whole, doing);
        }
        // What is taken may be another map or command; then the former ones come back.
        if (name === 'MapSqueeze' && method.startsWith('set')) machine.setPlan(undefined);
        machine.configure(opening);
        machine.grow(20);
        assert.equal(digest(machine), before, doing);
      }
    }
    assert.ok(tally.refused > 1000 && tally.taken > 10, JSON.stringify(tally));
    assert.deepEqual(answered, []);
    machine.free();
  });

  test(`${name}: methods are of a machine of the same class and core, in use`, async () => {
    const machine = new Machine({ samples: 20, seed: 11 });
    const before = digest(machine);
    const freed = new Machine({ samples: 5 });
    freed.free();
    freed.free();
    const other = new motion[Object.keys(METHODS).find((each) => each !== name) ?? '']({ samples: 5 });
    const elsewhere = new /** @type {any} */ (await core.instantiate())[name]({ samples: 5 });
    const strangers = [other, elsewhere, {}, Object.create(machine), Object.create(Machine.prototype), Machine.prototype, undefined, null, 1, 'x', new Proxy({}, {})];
    for (const [key, { get, value }] of Object.entries(Object.getOwnPropertyDescriptors(Machine.prototype))) {
      const work = get ?? value;
      if (/^(constructor$|__)/.test(key)) continue;
      const arguments_ = METHODS[name][key] ?? [];
      for (const stranger of strangers) {
        assert.throws(() => work.apply(stranger, arguments_), { name: 'TypeError', message: `${name}.${key} is called on something else; allowed is a ${name} of the same core, in use` });
      }
      if (key !== 'free') {
        assert.throws(() => work.apply(freed, arguments_), { name: 'TypeError', message: `${name}.${key} is called on a freed one; allowed is a ${name} of the same core, in use` });
      }
    }
    assert.deepEqual([other.shown, elsewhere.shown, digest(machine)], [5, 5, before]);
    for (const each of [machine, other, elsewhere]) each.free();
  });

  test(`${name}: where the stack ends, a call has not begun`, () => {
    const machine = new Machine({ samples: 20, seed: 11 });
    const before = digest(machine);
    let calls = 0;
    let ends = 0;
    const getters = Object.entries(Object.getOwnPropertyDescriptors(Machine.prototype)).filter(([, { get }]) => get).map(([key]) => key);
    const acts = [() => machine.configure({ seed: 11 }), () => machine.restart(), () => machine.grow(20), ...getters.map((key) => () => machine[key])];
    // The engine compiles a function when it is first called, which takes a deep stack of its own.
    for (const act of acts) act();
    const dive = () => {
      try {
        dive();
      } catch {
        // The end. From here it goes up, a little more room at a time.
      }
      if (calls === 600) return;
      calls += 1;
      for (const act of acts) {
        try {
          act();
        } catch (error) {
          assert.ok(error instanceof RangeError && /stack/.test(error.message), String(error));
          ends += 1;
        }
      }
    };
    dive();
    assert.ok(ends > 10, `${ends}`);
    machine.grow(20);
    assert.equal(digest(machine), before);
    machine.free();
  });

  test(`${name}: setters of a page's own on what all objects inherit do no harm`, () => {
    const machine = new Machine({ samples: 20, seed: 11 });
    const before = digest(machine);
    const getters = Object.entries(Object.getOwnPropertyDescriptors(Machine.prototype)).filter(([, { get }]) => get).map(([key]) => key);
    /** @param {unknown} value @returns {string[]} */
    const keysIn = (value) => (typeof value !== 'object' || value === null || ArrayBuffer.isView(value) ? [] : Object.entries(value).flatMap(([key, part]) => [key, ...keysIn(part)]));
    const keys = new Set(getters.flatMap((key) => keysIn(machine[key])).filter((key) => !/^\d+$/.test(key)));
    assert.ok(keys.size > 5);
    const polluted = /** @type {any} */ (Object.prototype);
    for (const key of keys) {
      for (const set of [() => { throw new Error('from the page'); }, () => machine.restart(), () => machine.free()]) {
        Object.defineProperty(polluted, key, { set, get: () => undefined, configurable: true });
        for (const getter of getters) {
          try {
            void machine[getter];
          } catch {
            // Of the page's making.
          }
        }
        delete polluted[key];
      }
      assert.equal(digest(machine), before, key);
    }
    machine.configure({ seed: 12 });
    machine.configure({ seed: 11 });
    assert.equal(digest(machine), before);
    machine.free();
  });
}

const POSE = { x: 1, y: 2, theta: 0.5 };
const LEGS = { rot1: 0.1, trans: 1, rot2: 0.2 };
const TWIST = [1, 0, 0.5];

/**
 * @param {(...given: any[]) => any} work
 * @param {unknown[]} good arguments
 * @returns {((value: unknown) => any)[]} it, with another value in the place of each
 */
const taking = (work, good) => good.map((_, i) => (value) => work(...good.with(i, value)));

test('what needs no machine is as safe', () => {
  const { commandReaching, BananaMachine, MapSqueeze, VelocityModel, OdometryModel, invertArc, decompose, propagate, se2 } = motion;
  const spare = new BananaMachine({ samples: 20 });
  const before = digest(spare);
  const works = [
    (/** @type {unknown} */ value) => new BananaMachine(value),
    (/** @type {unknown} */ value) => BananaMachine.empty(value),
    (/** @type {unknown} */ value) => new MapSqueeze(value),
    (/** @type {unknown} */ value) => MapSqueeze.alphasOfNoise(value),
    (/** @type {unknown} */ value) => commandReaching(value, 1, COMMAND),
    (/** @type {unknown} */ value) => commandReaching(1, 1, value),
    (/** @type {unknown} */ value) => commandReaching(1, 1, { ...COMMAND, dt: value }),
    ...[VelocityModel, OdometryModel].flatMap((Model, i) => {
      const [alphas, control] = [Array(6 - 2 * i).fill(0.1), [COMMAND, LEGS][i]];
      const model = new Model({ alphas });
      return [
        (/** @type {unknown} */ value) => new Model(value),
        (/** @type {unknown} */ value) => new Model({ alphas: value }),
        (/** @type {unknown} */ value) => new Model({ alphas, noise: value }),
        ...['prob', 'poseDensity'].flatMap((method) => taking((...given) => model[method](...given), [POSE, control, POSE])),
        ...taking((...given) => model.sample(...given), [control, POSE, 2, 1]),
      ];
    }),
    ...taking(invertArc, [POSE, POSE, 1]),
    ...taking(decompose, [POSE, POSE]),
    (/** @type {unknown} */ value) => propagate(value),
    ...['sigma', 'command', 'alphas', 'compounding', 'steps'].map((key) => (/** @type {unknown} */ value) => propagate({ command: COMMAND, alphas: Array(6).fill(0.1), [key]: value })),
    (/** @type {unknown} */ value) => propagate({ command: COMMAND, alphas: Array(6).fill(0.1), sigma: [[1, 0, 0], value, [0, 0, 1]] }),
    ...taking(se2.exp, [TWIST]),
    ...taking(se2.log, [POSE]),
    ...taking(se2.compose, [POSE, POSE]),
    ...taking(se2.inverse, [POSE]),
    ...taking(se2.boxplus, [POSE, TWIST]),
    ...taking(se2.boxminus, [POSE, POSE]),
    ...taking(se2.adjoint, [POSE]),
    ...taking(se2.rightJacobian, [TWIST]),
  ];
  for (const work of works) {
    for (const [i, value] of hostile(undefined).entries()) {
      try {
        work(value)?.free?.();
      } catch (error) {
        assert.ok(error instanceof TypeError || error instanceof RangeError, `${work}, value ${i}: ${error}`);
        assert.match(error.message, /allowed (is|are) \S/, `${work}, value ${i}`);
      }
    }
  }
  assert.equal(digest(spare), before);
  assert.throws(() => MapSqueeze.alphasOfNoise(NaN), { name: 'RangeError', message: 'n is NaN; allowed is a number from 0 to 1000000' });
  assert.throws(() => MapSqueeze.alphasOfNoise(-1), { name: 'RangeError', message: 'n is -1; allowed is a number from 0 to 1000000' });
  spare.free();
});
