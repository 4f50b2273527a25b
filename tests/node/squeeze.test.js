// MapSqueeze of dist/core.js in Node: what it says, what it refuses, and that a refusal changes nothing.

import assert from 'node:assert/strict';
import test from 'node:test';
import { declaredOpening, freshModule, near } from './support.js';

/** @type {typeof import('../../www/core.js')} */
const { load } = await freshModule();
const { MapSqueeze } = await load();

/** @typedef {InstanceType<typeof MapSqueeze>} Machine */

/** Everything that a machine shows. */
const picture = (/** @type {Machine} */ m) => ({
  config: m.config,
  plan: m.plan,
  grid: m.grid,
  poses: m.poses,
  verdicts: m.verdicts,
  stats: m.stats,
});

const DOORWAY = { x: 2.05, y: 2.6, theta: Math.PI / 2 };

/** Walls around (2.1, 2.1) at 10 cm: no room for a robot of 13 cm. */
const CELL = {
  bounds: [2, 2, 2.2, 2.2],
  walls: [
    [2, 2, 2.2, 2],
    [2.2, 2, 2.2, 2.2],
    [2.2, 2.2, 2, 2.2],
    [2, 2.2, 2, 2],
  ],
};

/** A picture of 4 × 3 cells whose lower left cell is occupied. */
const PGM = new TextEncoder().encode('P2\n# by hand\n4 3\n255\n255 255 255 255\n255 255 255 255\n0 255 255 255\n');
const YAML = { image: 'map.pgm', resolution: 0.5, origin: [1, 2, 0], negate: 0, occupied_thresh: 0.65, free_thresh: 0.196 };

/**
 * As an ImageData, which Node does not have.
 *
 * @param {number[]} greys
 * @returns {any}
 */
const imageData = (width = 4, height = 3, greys = [...Array(8).fill(255), 0, 255, 255, 255], alpha = 255) => ({
  width,
  height,
  data: new Uint8ClampedArray(greys.flatMap((grey) => [grey, grey, grey, alpha])),
});

/**
 * An error that names a field.
 *
 * @param {string} field
 */
const naming = (field) => (/** @type {unknown} */ error) => {
  assert.ok(error instanceof TypeError || error instanceof RangeError, String(error));
  assert.ok(error.message.includes(field), `${error.message} does not name ${field}`);
  return true;
};

/**
 * Each of the calls throws an error that names its field, and leaves the machine as it was.
 *
 * @param {Machine} machine
 * @param {[string, () => unknown][]} calls
 */
function refused(machine, calls) {
  const before = picture(machine);
  for (const [field, call] of calls) {
    assert.throws(call, naming(field), `${field}: ${call}`);
    assert.deepEqual(picture(machine), before, field);
  }
}

test('it opens facing a doorway of the apartment', () => {
  const machine = new MapSqueeze();
  assert.deepEqual(machine.config, {
    ...declaredOpening('map-squeeze'),
    start: DOORWAY,
    command: { v: 1, omega: 0, dt: 2 },
    alphas: [0.12, 0.12, 0.12, 0.12, 0.03, 0.03],
    clearance: 0.13,
    conditioned: true,
    unknown: 'free',
    sampler: 'endpoint',
    steps: 4,
    samples: 600,
    seed: 7,
  });
  assert.deepEqual([...MapSqueeze.alphasOfNoise(0.12)], machine.config.alphas);
  assert.deepEqual(MapSqueeze.presets, [
    { name: 'doorway', start: DOORWAY },
    { name: 'wall', start: { x: 3.3, y: 2.6, theta: Math.PI / 2 } },
    { name: 'corridor', start: { x: 1.4, y: 4.4, theta: 0 } },
  ]);
  assert.deepEqual([...machine.plan.bounds], [0, 0, 12, 9]);
  assert.equal(machine.plan.walls.length, 4 * 18);
  assert.equal(machine.shown, 600);
  assert.equal(machine.startFree, true);
  const { commanded } = machine;
  assert.deepEqual([...commanded.slice(0, 2)], [2.05, 2.6]);
  assert.ok(Math.hypot(commanded[commanded.length - 2] - 2.05, commanded[commanded.length - 1] - 4.6) < 1e-12);
});

test('the statistics count the verdicts', () => {
  for (const sampler of /** @type {const} */ (['endpoint', 'whole-arc', 'sub-stepped'])) {
    const machine = new MapSqueeze({ sampler, samples: 2000 });
    const { poses, verdicts, stats } = machine;
    assert.equal(poses.length, 6000);
    const count = (/** @type {(verdict: number) => boolean} */ holds) => verdicts.filter(holds).length;
    const parts = sampler === 'sub-stepped' ? 4 : 1;
    assert.equal(stats.attempts, 2000);
    assert.equal(stats.accepted, count((verdict) => (verdict & 4) > 0));
    assert.equal(stats.throughWall, count((verdict) => (verdict & 6) === 4));
    assert.equal(stats.throughWallRate, stats.throughWall / stats.accepted);
    assert.equal(stats.acceptanceRate, (stats.accepted * parts) / stats.drawn);
    assert.equal(stats.drawsPerAccepted, stats.drawn / stats.accepted);
    assert.ok(stats.wallTestsPerAccepted > 0 && stats.wallTestsPerAccepted < 1 && stats.gaveUp === false);
    const [low, high] = stats.throughWallInterval;
    assert.ok(low <= stats.throughWallRate && stats.throughWallRate <= high && high - low < 0.05);
    if (sampler === 'endpoint') assert.ok(verdicts.every((verdict) => (verdict & 4) / 4 === (verdict & 1)));
    if (sampler === 'whole-arc') assert.ok(verdicts.every((verdict) => (verdict & 4) / 4 === (verdict & 2) / 2));
    if (sampler === 'whole-arc') assert.equal(stats.throughWall, 0);
    if (sampler === 'sub-stepped') assert.ok(stats.accepted === 2000 && stats.drawn >= 8000);
  }
});

test('the published shares, to 4.5 standard errors of both samples', () => {
  const rows = /** @type {const} */ ([
    [0, 0, 0.849, 0.348],
    [1, 0, 0.832, 0.867],
    [2, 0, 0.84, 0.242],
    [0, 0.6, 0.781, 0.398],
  ]);
  for (const [preset, omega, acceptance, throughWall] of rows) {
    const { start } = MapSqueeze.presets[preset];
    const { stats } = new MapSqueeze({ start, command: { v: 1, omega, dt: 2 }, samples: 60_000, seed: 11 });
    // The published shares are rounded to three decimals.
    const error = (/** @type {number} */ share, /** @type {number} */ n) => 4.5 * Math.sqrt((2 * share * (1 - share)) / n) + 0.0005;
    near(stats.acceptanceRate, acceptance, error(acceptance, 60_000));
    near(stats.throughWallRate, throughWall, error(throughWall, stats.accepted));
  }
});

test('conditioning and the judging sampler change verdicts, not draws', () => {
  const machine = new MapSqueeze({ samples: 1000 });
  const { poses, verdicts } = machine;
  machine.configure({ conditioned: false });
  assert.deepEqual(machine.poses, poses);
  assert.deepEqual(machine.verdicts, verdicts.map((verdict) => verdict | 4));
  assert.equal(machine.stats.acceptanceRate, 1);
  machine.configure({ conditioned: true, sampler: 'whole-arc' });
  assert.deepEqual(machine.poses, poses);
  machine.configure({ samples: 300 });
  assert.deepEqual(machine.poses, poses.slice(0, 900));
  machine.configure({ sampler: 'endpoint', samples: 1000 });
  assert.deepEqual([machine.poses, machine.verdicts], [poses, verdicts]);
  machine.configure({ seed: 8 });
  assert.notDeepEqual(machine.poses, poses);
});

test('the number of parts is remembered under every sampler', () => {
  const machine = new MapSqueeze({ steps: 9, samples: 50 });
  assert.equal(machine.config.sampler, 'endpoint');
  machine.configure({ sampler: 'sub-stepped' });
  assert.equal(machine.config.steps, 9);
  assert.ok(machine.stats.drawn >= 450);
  machine.configure({ sampler: 'whole-arc', steps: 3 });
  assert.deepEqual([machine.config.sampler, machine.config.steps], ['whole-arc', 3]);
});

test('one noise level stands for all noise parameters', () => {
  const machine = new MapSqueeze({ samples: 50 });
  assert.equal(machine.noise, 0.12);
  machine.configure({ noise: 0.2 });
  assert.equal(machine.noise, 0.2);
  assert.deepEqual(machine.config.alphas, [...MapSqueeze.alphasOfNoise(0.2)]);
  assert.ok(!('noise' in machine.config));
  assert.deepEqual(picture(machine), picture(new MapSqueeze({ noise: 0.2, samples: 50 })));
  machine.configure({ alphas: [0.2, 0.2, 0.2, 0.1, 0.05, 0.05] });
  assert.equal(machine.noise, null);
  const configure = (/** @type {any} */ settings) => () => machine.configure(settings);
  refused(machine, [
    ['noise is -1; allowed is a number from 0 to 1000000', configure({ noise: -1 })],
    ['noise is NaN; allowed is a number from 0 to 1000000', configure({ noise: NaN })],
    ['noise is null; allowed is a number', configure({ noise: null })],
    ['noise is given beside alphas; allowed is one of the two', configure({ noise: 0.1, alphas: Array(6).fill(0.1) })],
  ]);
  machine.configure({ noise: undefined, seed: 8 });
  assert.equal(machine.noise, null);
});

test('attempts are shown a few at a time, with the paths they took', () => {
  const machine = new MapSqueeze({ sampler: 'sub-stepped', samples: 100 });
  const whole = picture(machine);
  machine.restart();
  assert.deepEqual([machine.shown, machine.poses.length, machine.stats.drawn], [0, 0, 0]);
  assert.ok(Number.isNaN(machine.stats.acceptanceRate) && Number.isNaN(machine.stats.throughWallRate));
  assert.deepEqual([machine.grow(30), machine.grow(0), machine.grow(1000)], [30, 30, 100]);
  assert.deepEqual(picture(machine), whole);
  for (let i = 0; i < 100; i += 9) {
    const path = machine.path(i);
    const [x, y] = machine.poses.slice(3 * i);
    assert.deepEqual([...path.slice(0, 2)], [2.05, 2.6]);
    assert.ok(Math.hypot(path[path.length - 2] - x, path[path.length - 1] - y) < 1e-12);
    assert.equal(machine.nearest(x, y, 1e-9), i);
  }
  assert.equal(machine.path(100).length, 0);
  assert.equal(machine.nearest(1000, 0, 1), -1);
});

test('every setting is checked, and a refused one changes nothing', () => {
  const machine = new MapSqueeze({ samples: 50 });
  const noNumbers = [NaN, Infinity, -Infinity, '1', null, true, [1], {}, 1n, Symbol('1'), () => 1, new Number(1)];
  const command = { v: 1, omega: 0, dt: 2 };
  const alphas = [0.1, 0.1, 0.1, 0.1, 0.1, 0.1];
  /** @type {[string, any][]} */
  const wrong = [
    ...noNumbers.flatMap((value) => /** @type {[string, any][]} */ ([
      ['start.x', { start: { ...DOORWAY, x: value } }],
      ['start.y', { start: { ...DOORWAY, y: value } }],
      ['start.theta', { start: { ...DOORWAY, theta: value } }],
      ['command.v', { command: { ...command, v: value } }],
      ['command.omega', { command: { ...command, omega: value } }],
      ['command.dt', { command: { ...command, dt: value } }],
      ['alphas[3]', { alphas: alphas.with(3, /** @type {any} */ (value)) }],
      ['clearance', { clearance: value }],
      ['steps', { steps: value }],
      ['samples', { samples: value }],
      ['seed', { seed: value }],
      ['sampler', { sampler: value }],
    ])),
    ...[null, 3, 'x', true, []].flatMap((value) => /** @type {[string, any][]} */ ([
      ['start', { start: value }],
      ['command', { command: value }],
    ])),
    ...[null, 3, 'xxxxxx', true, {}, [], [0.1], [...alphas, 0.1], new Float64Array(5), { length: 2 ** 40 }].map(
      (value) => /** @type {[string, any]} */ (['alphas', { alphas: value }]),
    ),
    ['start.theta', { start: { x: 1, y: 1 } }],
    ['start.z', { start: { ...DOORWAY, z: 1 } }],
    ['start.x', { start: { ...DOORWAY, x: 1e7 } }],
    ['command.dt', { command: { v: 1, omega: 0 } }],
    ['command.w', { command: { ...command, w: 1 } }],
    ['command.dt', { command: { ...command, dt: 0 } }],
    ['alphas[0]', { alphas: alphas.with(0, -1e-9) }],
    ['clearance', { clearance: -0.001 }],
    ['clearance', { clearance: 11 }],
    ...[null, 0, 1, 'true', {}].map((value) => /** @type {[string, any]} */ (['conditioned', { conditioned: value }])),
    ['sampler', { sampler: 'Endpoint' }],
    ['steps', { steps: 0 }],
    ['steps', { steps: 2.5 }],
    ['steps', { steps: 1001 }],
    ['samples', { samples: 0 }],
    ['samples', { samples: MapSqueeze.maxSamples + 1 }],
    ['samples', { samples: MapSqueeze.maxSamples, sampler: 'sub-stepped', steps: 2 }],
    ['seed', { seed: -1 }],
    ['seed', { seed: 2 ** 53 }],
    ['sampels', { sampels: 10 }],
  ];
  /** @type {[string, any][]} */
  const noSettings = [
    ['options', null],
    ['options', 7],
    ['options', 'doorway'],
    ['options has length 0', []],
  ];
  refused(machine, [
    // One that is right beside it must not be taken over either.
    ...wrong.map(([field, settings]) => /** @type {[string, () => void]} */ ([field, () => machine.configure({ seed: 99, ...settings })])),
    ...noSettings.map(([field, settings]) => /** @type {[string, () => void]} */ ([field, () => machine.configure(settings)])),
    ...[...wrong, ...noSettings].map(([field, settings]) => /** @type {[string, () => unknown]} */ ([field, () => new MapSqueeze(settings)])),
  ]);
  machine.configure({ samples: 60, seed: 3, alphas: /** @type {any} */ (new Float64Array(6)) });
  assert.equal(machine.stats.attempts, 60);
});

test('other arguments are checked too', () => {
  const machine = new MapSqueeze({ samples: 50 });
  const m = /** @type {any} */ (machine);
  refused(machine, [
    ['count', () => m.grow(-1)],
    ['count', () => m.grow('1')],
    ['count', () => m.grow()],
    ['index', () => m.path(1.5)],
    ['index', () => m.path(NaN)],
    ['x', () => m.nearest('0', 0, 1)],
    ['y', () => m.nearest(0, null, 1)],
    ['radius', () => m.nearest(0, 0)],
    ['sampler', () => m.trial('magic', 1, 1)],
    ['steps', () => m.trial('endpoint', 0, 1)],
    ['count', () => m.trial('endpoint', 1, 0)],
    ['count', () => m.trial('endpoint', 1, 1e9)],
    ['n is', () => /** @type {any} */ (MapSqueeze).alphasOfNoise('0.1')],
    ['n is NaN; allowed is a number from 0 to 1000000', () => MapSqueeze.alphasOfNoise(NaN)],
    ['radius is -1; allowed is a number from 0 to Infinity', () => m.nearest(0, 0, -1)],
    ['radius is NaN', () => m.nearest(0, 0, NaN)],
    ['columns is 16385; allowed is a whole number from 1 to 16384', () => m.picture(0, 0, 1, 1, 2 ** 14 + 1, 1, new Uint8Array(3072))],
    ['ramps has length 1024; allowed is a Uint8Array of 3072 bytes', () => m.picture(0, 0, 1, 1, 1, 1, new Uint8Array(1024))],
  ]);
  assert.equal(machine.nearest(NaN, 0, 1), -1);
});

test('a floor plan of one’s own, and back to the apartment', () => {
  const machine = new MapSqueeze({ samples: 100 });
  const before = picture(machine);
  const far = [[10, 8, 11, 8], new Float64Array([0, 0, 12, 0])];
  machine.setPlan({ bounds: new Float64Array([0, 0, 12, 9]), walls: far });
  assert.deepEqual([...machine.plan.walls], [10, 8, 11, 8, 0, 0, 12, 0]);
  assert.deepEqual(machine.poses, before.poses);
  assert.ok(machine.stats.accepted > before.stats.accepted);
  machine.setPlan({ bounds: [0, 0, 1, 1], walls: [] });
  assert.equal(machine.stats.accepted, 0);
  assert.ok(machine.verdicts.every((verdict) => verdict === 0), 'out of bounds');
  machine.setPlan(undefined);
  assert.deepEqual(picture(machine), before);
  machine.setPlan({ bounds: [0, 0, 12, 9], walls: Array(100_000).fill([0, 0, 12, 0]) });
  assert.equal(machine.plan.walls.length, 400_000);
});

test('a malformed floor plan is explained, and the present one stays', () => {
  const machine = new MapSqueeze({ samples: 50 });
  const { bounds, walls } = CELL;
  /** @type {[string, any][]} */
  const wrong = [
    ['plan', null],
    ['plan', 'apartment'],
    ['plan', 5],
    ['plan has length 0', []],
    ['bounds', {}],
    ['bounds', { walls }],
    ['bounds', { bounds: null, walls }],
    ['bounds', { bounds: [0, 0, 1], walls }],
    ['bounds[1]', { bounds: [0, '0', 1, 1], walls }],
    ['bounds', { bounds: [0, NaN, 1, 1], walls: [] }],
    ['bounds', { bounds: [0, 0, Infinity, 1], walls: [] }],
    ['bounds', { bounds: [1, 0, 0, 1], walls: [] }],
    ['bounds', { bounds: [0, 0, 1, 0], walls: [] }],
    ['walls', { bounds }],
    ['walls', { bounds, walls: null }],
    ['walls', { bounds, walls: {} }],
    ['walls', { bounds, walls: 'none' }],
    ['walls', { bounds, walls: { length: -1 } }],
    ['walls', { bounds, walls: { length: 2 ** 31 } }],
    ['walls', { bounds, walls: Array(100_001).fill(walls[0]) }],
    ['walls[0]', { bounds, walls: Array(100_000) }],
    ['walls[1]', { bounds, walls: [walls[0], null] }],
    ['walls[1]', { bounds, walls: [walls[0], [2, 2, 2.1]] }],
    ['walls[1][2]', { bounds, walls: [walls[0], [2, 2, '2.1', 2]] }],
    ['walls[1]', { bounds, walls: [walls[0], [2, 2, NaN, 2]] }],
    ['walls[1]', { bounds, walls: [walls[0], [2, 2, 2, -Infinity]] }],
    ['walls[1]', { bounds, walls: [walls[0], [2, 2, 2.4, 2]] }],
    ['doors', { bounds, walls, doors: [] }],
    ['walls', { bounds, get walls() { throw new Error('a trap'); } }],
    ['walls[0]', { bounds, walls: [new Proxy([], { get() { throw new Error('a trap'); } })] }],
    ['bounds', { get bounds() { return machine.setPlan(undefined); }, walls }],
  ];
  refused(machine, wrong.map(([field, plan]) => [field, () => machine.setPlan(plan)]));
  machine.setPlan(CELL);
  assert.equal(machine.stats.accepted, 0);
});

test('a map of map_server, its image as a PGM file or as pixels', () => {
  const machine = new MapSqueeze({ samples: 10, start: { x: 2.5, y: 3, theta: 0 }, clearance: 0.1 });
  const walls = [1, 2, 1.5, 2, 1, 2.5, 1.5, 2.5, 1, 2, 1, 2.5, 1.5, 2, 1.5, 2.5];
  machine.setGrid(YAML, PGM);
  const file = machine.plan;
  assert.deepEqual([...file.bounds], [1, 2, 3, 3.5]);
  assert.deepEqual([...file.walls], walls);
  assert.deepEqual(machine.grid, {
    columns: 4,
    rows: 3,
    resolution: 0.5,
    origin: new Float64Array([1, 2, 0]),
    occupied: new Uint8Array([1, ...Array(11).fill(0)]),
    unknown: new Uint8Array(12),
  });
  // In the middle of the 3 × 3 cells beside the occupied one.
  const { x, y, theta } = machine.openPlace ?? { x: NaN, y: NaN, theta: NaN };
  assert.deepEqual([x, y], [2.25, 2.75]);
  assert.ok(theta > -Math.PI && theta <= Math.PI);
  for (const [description, image] of /** @type {[any, any][]} */ ([
    [{ resolution: 0.5, origin: [1, 2, 0] }, PGM],
    [{ ...YAML, negate: false, mode: 'trinary' }, imageData()],
    [{ ...YAML, mode: 'scale' }, imageData()],
    [{ ...YAML, negate: 1 }, imageData(4, 3, [...Array(8).fill(0), 255, 0, 0, 0])],
    [{ ...YAML, negate: true }, imageData(4, 3, [...Array(8).fill(0), 255, 0, 0, 0])],
    [{ ...YAML, mode: 'raw' }, imageData(4, 3, [...Array(8).fill(0), 100, 99, 101, 255])],
  ])) {
    machine.setPlan(undefined);
    assert.equal(machine.grid, null);
    machine.setGrid(description, image);
    assert.deepEqual(machine.plan, file, JSON.stringify(description));
  }
  machine.setGrid({ ...YAML, mode: 'scale' }, imageData(4, 3, Array(12).fill(0), 0));
  assert.equal(machine.plan.walls.length, 0, 'transparent is unknown');
  machine.setGrid({ ...YAML, origin: [1, 2, Math.PI / 2] }, PGM);
  assert.ok(Math.abs(machine.plan.bounds[0] + 0.5) < 1e-12, 'turned by its yaw');
  machine.setGrid(YAML, imageData(4, 3, Array(12).fill(0)));
  assert.deepEqual([machine.openPlace, machine.stats.accepted], [null, 0]);
  assert.equal(machine.startFree, false);
});

test('a malformed map is explained by field and line, and the present one stays', () => {
  const machine = new MapSqueeze({ samples: 50 });
  const bytes = (/** @type {string} */ text) => new TextEncoder().encode(text);
  /** @type {[string, any, any][]} */
  const wrong = [
    ['description', null, PGM],
    ['description', 'image: map.pgm', PGM],
    ['resolution', {}, PGM],
    ...[0, -0.05, NaN, Infinity, 1e-9, '0.05', null].map((value) => /** @type {[string, any, any]} */ (['resolution', { ...YAML, resolution: value }, PGM])),
    ['origin', { resolution: 0.05 }, PGM],
    ...[null, 0, [0, 0], [0, 0, 0, 0], '0 0 0'].map((value) => /** @type {[string, any, any]} */ (['origin', { ...YAML, origin: value }, PGM])),
    ...[NaN, Infinity, '0', null].map((value) => /** @type {[string, any, any]} */ (['origin[2]', { ...YAML, origin: [0, 0, value] }, PGM])),
    ...[2, -1, 0.5, 'false', null].map((value) => /** @type {[string, any, any]} */ (['negate', { ...YAML, negate: value }, PGM])),
    ...[1.1, -0.1, NaN, '0.65', null].map((value) => /** @type {[string, any, any]} */ (['occupied_thresh', { ...YAML, occupied_thresh: value }, PGM])),
    ...[1.1, NaN, '0.2', 0.66].map((value) => /** @type {[string, any, any]} */ (['free_thresh', { ...YAML, free_thresh: value }, PGM])),
    ...['Trinary', '', 1, null].map((value) => /** @type {[string, any, any]} */ (['mode', { ...YAML, mode: value }, PGM])),
    ['image', YAML, undefined],
    ['image', YAML, 'map.pgm'],
    ['image.width', YAML, {}],
    ['image.width', YAML, [1, 2, 3]],
    ['image.width', YAML, { ...imageData(), width: 0 }],
    ['image.height', YAML, { ...imageData(), height: 2 ** 24 }],
    ['image.data', YAML, { ...imageData(), height: 4 }],
    ['image.data', YAML, { ...imageData(), data: [0] }],
    ['line 1: the magic number', YAML, bytes('')],
    ['line 1: the magic number', YAML, bytes('GIF89a')],
    ['line 3: the width', YAML, bytes('P5\n# wide\nwide 3\n255\n')],
    ['line 2: the height', YAML, bytes('P5\n16777216 2\n255\n')],
    ['line 3: the greatest value', YAML, bytes('P5\n4 3\n70000\n')],
    ['line 3: the length of the raster', YAML, bytes('P5\n4 3\n255\n0123456789')],
    ['line 4: a pixel', YAML, bytes('P2\n4 3\n255\n1 2 3')],
    ['line 5: a pixel', YAML, bytes('P2\n4 3\n255\n1 2 3\n4 five 6')],
    ['image', { ...YAML, resolution: 0.05 }, imageData(640, 320, Array.from({ length: 640 * 320 }, (_, i) => (i % 2 || Math.floor(i / 640) % 2 ? 255 : 0)))],
  ];
  refused(machine, wrong.map(([field, description, image]) => [field, () => machine.setGrid(description, image)]));
  const inSlices = (/** @type {any} */ description, /** @type {any} */ image) => {
    machine.beginGrid(description, image);
    while (!machine.advance(50));
  };
  refused(machine, wrong.map(([field, description, image]) => [field, () => inSlices(description, image)]));
  machine.setGrid(YAML, PGM);
  assert.equal(machine.plan.walls.length, 16);
});

test('a large map is read in slices: the last one that is begun, unless it is given up', () => {
  const side = 1024;
  const plain = new TextEncoder().encode(`P2 ${side} ${side} 255\n${'254 '.repeat(side ** 2 - side)}${'0 '.repeat(side)}`);
  const told = (/** @type {typeof machine} */ { stats, poses, verdicts, config, plan, grid }) => ({ stats, poses, verdicts, config, plan, grid });
  const whole = new MapSqueeze({ samples: 50 });
  const machine = new MapSqueeze({ samples: 50 });
  const before = told(machine);
  whole.setGrid({ resolution: 0.01, origin: [0, 0, 0] }, plain);
  const slices = () => {
    let count = 1;
    for (; !machine.advance(50_000); count++) assert.ok(machine.progress > 0 && machine.progress <= 1);
    return count;
  };

  machine.beginGrid({ resolution: 0.01, origin: [0, 0, 0] }, plain);
  for (let i = 0; i < 10; i++) assert.equal(machine.advance(50_000), false);
  assert.deepEqual(told(machine), before);
  machine.stop();
  assert.equal(slices(), 1, 'nothing is left to do');
  assert.deepEqual(told(machine), before);

  machine.beginGrid(YAML, PGM);
  const bytes = plain.slice();
  machine.beginGrid({ resolution: 0.01, origin: [0, 0, 0] }, bytes);
  bytes.fill(0);
  // A pixel of a plain image counts as much as a distance.
  assert.ok(slices() > side ** 2 / 50_000);
  assert.deepEqual(told(machine), told(whole));
  for (const each of [machine, whole]) each.free();
});

test('unknown cells are free or blocked, as the reader chooses', () => {
  // Free on the left, then unknown, then occupied: two rows of cells of 1 m.
  const strip = imageData(6, 2, [255, 255, 205, 205, 0, 0, 255, 255, 205, 205, 0, 0]);
  const description = { resolution: 1, origin: [0, 0, 0], free_thresh: 0.196 };
  const machine = new MapSqueeze({ samples: 2000, start: { x: 1, y: 1, theta: 0 } });
  machine.setGrid(description, strip);
  const cells = (/** @type {string} */ row) => Uint8Array.from([...row + row], Number);
  assert.deepEqual([machine.grid?.occupied, machine.grid?.unknown], [cells('000011'), cells('001100')]);
  const free = picture(machine);
  machine.configure({ unknown: 'blocked' });
  assert.deepEqual(machine.poses, free.poses, 'no draw is another');
  assert.ok(machine.stats.accepted < free.stats.accepted);
  const furthest = () => Math.max(...machine.poses.filter((_, i) => i % 3 === 0 && machine.verdicts[i / 3] & 4));
  assert.ok(furthest() < 2 - 0.13);
  assert.deepEqual(machine.grid, free.grid, 'it stays known which are unknown');
  // The choice outlasts a change of the map, and is heeded by the next.
  machine.setPlan(undefined);
  machine.setGrid(description, strip);
  assert.ok(furthest() < 2 - 0.13);
  machine.configure({ unknown: 'free' });
  assert.deepEqual(picture(machine), free);
  assert.ok(furthest() > 2 + 0.13);
  // What the threshold says is free is not unknown.
  machine.setGrid({ ...description, free_thresh: 0.25 }, strip);
  assert.deepEqual(machine.grid?.unknown, new Uint8Array(12));
  refused(machine, [['unknown', () => machine.configure({ unknown: /** @type {any} */ ('maybe') })]]);

  // A map that has too many sides when what is unknown is blocked.
  const side = 320;
  const speckled = imageData(side, side, Array.from({ length: side * side }, (_, i) => (i % 2 || Math.floor(i / side) % 2 ? 255 : 128)));
  machine.setGrid(description, speckled);
  assert.equal(machine.plan.walls.length, 0);
  refused(machine, [['unknown is blocked; allowed is free, as the cells of this map would have more than 100000 sides', () => machine.configure({ unknown: 'blocked' })]]);
  machine.setPlan(undefined);
  machine.configure({ unknown: 'blocked' });
  refused(machine, [['image', () => machine.setGrid(description, speckled)]]);
});

test('a density has the colours of what most of the attempts in a cell are', () => {
  const machine = new MapSqueeze({ samples: 5000 });
  const [columns, rows] = [40, 30];
  const [xMin, yMin, xMax, yMax] = [0, 2, 4, 7];
  const ramps = Uint8Array.from({ length: 3 * 4 * 256 }, (_, i) => [Math.floor(i / 1024), 0, Math.floor(i / 4) % 256, 255][i % 4]);
  const pixels = machine.picture(xMin, yMin, xMax, yMax, columns, rows, ramps).slice();
  const { poses, verdicts } = machine;
  const counts = Array.from({ length: columns * rows }, () => [0, 0, 0]);
  verdicts.forEach((verdict, i) => {
    const column = Math.floor(((poses[3 * i] - xMin) / (xMax - xMin)) * columns);
    const row = Math.floor(((yMax - poses[3 * i + 1]) / (yMax - yMin)) * rows);
    if (column < 0 || column >= columns || row < 0 || row >= rows) return;
    counts[row * columns + column][verdict & 4 ? (verdict & 2 ? 1 : 2) : 0]++;
  });
  const all = counts.map((kinds) => kinds[0] + kinds[1] + kinds[2]);
  const most = Math.max(...all);
  const seen = new Set();
  counts.forEach((kinds, cell) => {
    const [kind, , shade, alpha] = pixels.subarray(4 * cell, 4 * cell + 4);
    if (all[cell] === 0) return assert.equal(alpha, 0);
    assert.equal(kinds[kind], Math.max(...kinds), 'the kind of most');
    assert.equal(shade, Math.round(255 * Math.sqrt(all[cell] / most)));
    seen.add(kind);
  });
  assert.equal(seen.size, 3);
  const m = /** @type {any} */ (machine);
  refused(machine, [
    ['xMin', () => m.picture('0', 0, 1, 1, 2, 2, ramps)],
    ['columns', () => m.picture(0, 0, 1, 1, 0, 2, ramps)],
    ['ramps', () => m.picture(0, 0, 1, 1, 2, 2, ramps.subarray(4))],
  ]);
});

test('on the edge of a map a robot is on it', () => {
  const machine = new MapSqueeze({ samples: 500, start: { x: 3, y: 2, theta: Math.PI / 4 }, command: { v: 1, omega: 0, dt: 1 }, noise: 0.001 });
  machine.setPlan({ bounds: [3, 2, 7, 5], walls: [] });
  assert.equal(machine.startFree, true);
  assert.equal(machine.stats.accepted, 500);
  assert.equal(machine.stats.throughWall, 0);
  const { x, y } = machine.openPlace ?? { x: NaN, y: NaN };
  assert.ok(x > 4 && x < 6 && y > 3 && y < 4, 'in the open, not in the corner');
});

test('a wedged robot is told of, not waited for', () => {
  const machine = new MapSqueeze({ start: { x: 2.1, y: 2.1, theta: 0 } });
  assert.equal(machine.startFree, true);
  machine.setPlan(CELL);
  assert.deepEqual([machine.stats.accepted, machine.stats.acceptanceRate, machine.startFree], [0, 0, false]);
  assert.equal(machine.openPlace, null);
  assert.throws(() => machine.trial('whole-arc', 1, 10), {
    name: 'RangeError',
    message: 'sampler is "whole-arc", by which the robot is wedged: 10000 draws were tried and too few accepted; ' +
      'allowed is one of at most 10000 draws an accepted sample and 10200 for 10 of them',
  });
  machine.configure({ sampler: 'sub-stepped' });
  assert.equal(machine.stats.gaveUp, true);
  assert.ok(machine.stats.drawn <= 30_000 && machine.shown < 10);
  machine.setPlan(undefined);
  assert.deepEqual([machine.stats.gaveUp, machine.shown], [false, 600]);
  const { draws, wallTests } = machine.trial('sub-stepped', 4, 100);
  assert.ok(draws >= 400 && draws < 800 && wallTests > 0);
});

test('a handle is freed by free and by Symbol.dispose', () => {
  const freed = new MapSqueeze({ samples: 1 });
  freed.free();
  assert.throws(() => freed.stats);
  const disposed = new MapSqueeze({ samples: 1 });
  disposed[Symbol.dispose]();
  assert.throws(() => disposed.stats);
});

test('a hard plan takes a moment, in slices too, and can be given up', () => {
  const walls = Float64Array.from({ length: 400_000 }, (_, i) => [0, 0, 12, 9][i % 4]);
  const settings = /** @type {const} */ ({ sampler: 'whole-arc', samples: 2000, clearance: 0.05 });
  const whole = new MapSqueeze(settings);
  whole.setPlan({ bounds: [0, 0, 12, 9], walls });
  const sliced = MapSqueeze.empty(settings);
  sliced.setPlan(whole.plan);
  sliced.beginToGrow(2000);
  let slices = 1;
  while (!sliced.advance(50_000)) assert.ok(++slices && sliced.progress >= 0 && sliced.progress <= 1);
  assert.ok(slices > 100, `${slices} slices`);
  const told = (/** @type {typeof whole} */ { stats, poses, verdicts, config }) => ({ stats, poses, verdicts, config });
  assert.deepEqual(told(sliced), told(whole));
  assert.ok(whole.stats.wallTestsPerAccepted < 10, 'equal walls are one');

  sliced.begin({ clearance: 0.2 });
  sliced.advance(1);
  assert.ok(sliced.shown < 2000);
  sliced.stop();
  assert.deepEqual(told(sliced), told(whole));
  assert.throws(() => sliced.setPlan({ bounds: [0, 0, 12, 9], walls: new Float64Array(3) }), /^TypeError: walls is an object; allowed is an array of walls, or a Float64Array of four numbers a wall$/);
  for (const machine of [whole, sliced]) machine.free();
});
