// Large arguments: looked at, type and length, before anything of them is copied, so that a refusal is quick and takes no
// memory, and what is allowed takes what was asked for and little more.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { freshModule } from './support.js';

/** @type {any} */
const motion = await (await freshModule()).load();
const { BananaMachine, MapSqueeze, commandReaching } = motion;

const RECTANGLE = [-1, -1, 1, 1];
const MEBIBYTE = 2 ** 20;
const refusals = { name: /^(Type|Range)Error$/, message: /^\S.{0,400}allowed (is|are) \S.{0,400}$/s };

/** Bytes of the core's memory: what a picture is a view of. */
const coreBytes = () => pixels(new BananaMachine({ samples: 1 }), 1, 1).buffer.byteLength;

/** @param {any} machine @param {number} columns @param {number} rows @returns {Uint8ClampedArray} */
function pixels(machine, columns, rows) {
  const [view, colours] = machine instanceof BananaMachine ? [['plane'], 1] : [[], 3];
  return machine.picture(...view, ...RECTANGLE, columns, rows, new Uint8Array(4 * 256 * colours));
}

/** The least of some runs, in ms: the others were disturbed. @param {() => unknown} act */
function quickest(act, runs = 5) {
  return Math.min(...Array.from({ length: runs }, () => {
    const start = performance.now();
    act();
    return performance.now() - start;
  }));
}

test('what is too long is refused as quickly as what is not', () => {
  const banana = new BananaMachine({ samples: 5 });
  const squeeze = new MapSqueeze({ samples: 5 });
  /** Calls that refuse lists of any length. @type {((list: unknown) => unknown)[]} */
  const calls = [
    (list) => banana.configure(list),
    (list) => new BananaMachine(list),
    (list) => banana.configure({ command: list }),
    (list) => banana.configure({ alphas: list }),
    (list) => banana.picture('plane', ...RECTANGLE, 1, 1, list),
    (list) => commandReaching(1, 1, list),
    (list) => squeeze.configure(list),
    (list) => squeeze.configure({ start: list }),
    (list) => squeeze.setPlan(list),
    (list) => squeeze.setPlan({ bounds: list, walls: [] }),
    (list) => squeeze.setGrid({ resolution: 1, origin: list }, new Uint8Array()),
  ];
  /** @type {((length: number) => unknown)[]} */
  const lists = [(length) => new Array(length), (length) => new Float64Array(length), (length) => new Uint8Array(length), (length) => new String('x'.repeat(length))];
  for (const make of lists) {
    const [short, long] = [make(10), make(1e7)];
    for (const call of calls) {
      for (const list of [short, long]) assert.throws(() => call(list), refusals, `${make}, ${call}`);
      const refuse = (/** @type {unknown} */ list) => () => { try { call(list); } catch { /* As it should. */ } };
      // One that reads all ten million takes seconds, a million times as long. A hundred times 5 µs, the usual refusal, is
      // what a busy device may take away for a moment.
      const [quick, slow] = [quickest(refuse(short)), quickest(refuse(long))];
      assert.ok(slow < Math.max(100 * quick, 5), `${make}, ${call}: ${slow} ms, and ${quick} ms where it is short`);
    }
  }
  for (const machine of [banana, squeeze]) machine.free();
});

test('a text of any length is refused in a short sentence, without a copy of it', () => {
  const banana = new BananaMachine({ samples: 5 });
  const squeeze = new MapSqueeze({ samples: 5 });
  // Put together by the engine of pieces: whoever looks into it makes it 200 MB long.
  const text = () => 'x'.repeat(2e8);
  /** @type {((text: string) => unknown)[]} */
  const calls = [
    (long) => banana.configure({ model: long }),
    (long) => banana.configure({ samples: long }),
    (long) => banana.configure({ alphas: [long, 0, 0, 0, 0, 0] }),
    (long) => banana.configure({ command: long }),
    (long) => banana.configure(long),
    (long) => banana.nearest(long, 0, 0, 1, 1),
    (long) => banana.grow(long),
    (long) => squeeze.configure({ sampler: long, unknown: long }),
    (long) => squeeze.trial(long, 1, 1),
    (long) => squeeze.setPlan(long),
    (long) => squeeze.setGrid({ resolution: 1, origin: [0, 0, 0], mode: long }, new Uint8Array()),
    (long) => squeeze.setGrid({ resolution: long }, new Uint8Array()),
    (long) => MapSqueeze.alphasOfNoise(long),
    (long) => commandReaching(long, 1, { v: 1, omega: 1, dt: 1 }),
  ];
  const core = coreBytes();
  const process_ = process.memoryUsage().rss;
  for (const call of calls) {
    assert.throws(() => call(text()), { ...refusals, message: /^.{0,30} is a text of 200000000 characters; allowed is .{0,200}$/ }, `${call}`);
  }
  // A page of WebAssembly's memory holds every sentence; half of one text would be 100 MB.
  assert.ok(coreBytes() - core <= 65_536, `${coreBytes() - core}`);
  const grown = (process.memoryUsage().rss - process_) / MEBIBYTE;
  assert.ok(grown < 95, `${grown} MiB`);
  // A key is one piece already.
  assert.throws(() => banana.configure({ ['k'.repeat(1e7)]: 1 }), { message: new RegExp(`^${'k'.repeat(40)}… is an unknown key; allowed are .*seed$`) });
  assert.ok(coreBytes() - core <= 65_536);
  for (const machine of [banana, squeeze]) machine.free();
});

test('what is quoted is cut after whole characters', () => {
  const machine = new BananaMachine({ samples: 5 });
  for (const character of ['x', 'é', '→', '🤖']) {
    const [full, over] = [character.repeat(40), character.repeat(41)];
    for (const [text, shown] of [[full, full], [over, `${full}…`], [`${full}\ud83e`, `${full}…`]]) {
      assert.throws(() => machine.configure({ model: text }), { message: `model is "${shown}"; allowed is "velocity" or "odometry"` });
      assert.throws(() => machine.configure({ [text]: 1 }), { message: new RegExp(`^${shown} is an unknown key; `) });
      assert.throws(() => machine.configure({ command: { [text]: 1 } }), { message: new RegExp(`^command\\.${shown} is an unknown key; `) });
    }
  }
  assert.throws(() => machine.configure({ 'a\nb\0': 1 }), { message: /^a\ufffdb\ufffd is an unknown key; / });
  machine.free();
});

test('a file that is too long is not copied', () => {
  const machine = new MapSqueeze({ samples: 5 });
  const core = coreBytes();
  assert.throws(() => machine.setGrid({ resolution: 1, origin: [0, 0, 0] }, new Uint8Array(2 ** 28)), /^RangeError: image\.length is 268435456; allowed is a whole number from 0 to \d+$/);
  assert.throws(
    () => machine.setGrid({ resolution: 1, origin: [0, 0, 0] }, { width: 1, height: 1, data: new Uint8ClampedArray(2 ** 28) }),
    /^RangeError: image\.data has length 268435456; allowed is 4$/,
  );
  assert.ok(coreBytes() - core <= 65_536);
  machine.free();
});

test('the largest pictures take what was asked for, and no more than 256 MiB besides', () => {
  for (const Machine of [BananaMachine, MapSqueeze]) {
    const machine = new Machine({ samples: 5 });
    assert.throws(() => pixels(machine, 1, 2 ** 24), { message: 'rows is 16777216; allowed is a whole number from 1 to 16384' });
    assert.throws(() => pixels(machine, 2 ** 24, 1), { message: 'columns is 16777216; allowed is a whole number from 1 to 16384' });
    const before = coreBytes();
    for (const [columns, rows] of [[1, 2 ** 14], [2 ** 14, 1]]) assert.equal(pixels(machine, columns, rows).length, 4 * columns * rows);
    // A cell has a count and a pixel, and a narrow picture a frame of twice its cells: 16 bytes for each cell of one column.
    assert.ok(coreBytes() - before <= 4 * MEBIBYTE, `${coreBytes() - before}`);
    const asked = pixels(machine, 2 ** 14, 2 ** 10).length;
    assert.ok(coreBytes() - before - asked <= 256 * MEBIBYTE, `${Machine.name}: ${coreBytes() - before - asked}`);
    machine.free();
  }
});

/** Milliseconds of the processor that anything may take that is allowed; the hardest known take two thirds of it. */
const WAIT = 1000;

const SIDE = 4096;
/** @param {(column: number, row: number) => boolean} occupied */
const cells = (occupied) => Uint8Array.from({ length: SIDE ** 2 }, (_, i) => (occupied(i % SIDE, Math.floor(i / SIDE)) ? 0 : 254));
/** @param {string} magic @param {Uint8Array} pixels */
const pgm = (magic, pixels) => new Uint8Array(Buffer.concat([Buffer.from(`${magic} ${SIDE} ${SIDE} 255\n`), pixels]));
const DESCRIPTION = { resolution: 0.01, origin: [0, 0, 0] };
/** As many cells apart from each other as have 100,000 sides, and every other row. */
const dots = cells((column, row) => column % 26 === 0 && row % 26 === 0);
const lines = cells((_, row) => row % 2 === 0);

/** @type {[string, (machine: any) => void, (machine: any) => unknown][]} */
const HARD = [
  ['a plan of 100,000 walls through one point', () => {}, (machine) => machine.setPlan(star())],
  ['a map of 4096 × 4096 cells with 100,000 sides', () => {}, (machine) => machine.setGrid(DESCRIPTION, pgm('P5', dots))],
  ['the same as a plain image', () => {}, (machine) => machine.setGrid(DESCRIPTION, plain)],
  ['a place where there is none', ready(lines, 0.16), (machine) => assert.equal(machine.openPlace, null)],
  ['a place for a robot that hardly fits anywhere', ready(dots, 2), (machine) => assert.equal(machine.openPlace, null)],
  ['other unknown cells', ready(dots, 0.1), (machine) => machine.configure({ unknown: 'blocked' })],
];

const plain = pgm('P2', new Uint8Array(Buffer.from(Array.from(dots, (shade) => (shade ? '254 ' : '000 ')).join(''))));

function star() {
  const walls = new Float64Array(400_000).fill(5);
  for (let i = 0; i < walls.length; i += 4) {
    walls[i + 2] += 5 * Math.cos(i);
    walls[i + 3] += 5 * Math.sin(i);
  }
  return { bounds: [0, 0, 10, 10], walls };
}

/** @param {Uint8Array} pixels @param {number} clearance @returns {(machine: any) => void} */
function ready(pixels, clearance) {
  return (machine) => {
    machine.configure({ clearance });
    machine.setGrid(DESCRIPTION, pgm('P5', pixels));
  };
}

for (const [name, prepare, act] of HARD) {
  test(`${name} keeps nobody waiting`, () => {
    const times = Array.from({ length: 3 }, () => {
      const machine = new MapSqueeze({ samples: 2000 });
      prepare(machine);
      const before = process.cpuUsage();
      act(machine);
      const { user, system } = process.cpuUsage(before);
      machine.free();
      return (user + system) / 1000;
    });
    assert.ok(Math.min(...times) < WAIT, `${times} ms`);
  });
}
