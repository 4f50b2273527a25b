// Interface of dist/core.js in Node: loading, and names of exports. tests/digest compares the results of simulations, and tests/web
// compares those of other exports.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { toPascalCase } from '../../scripts/declarations.mjs';
import { MAX_VALUE } from '../../www/logs/rows.ts';
import { settings } from '../../build/settings.js';
import { importFreshModule } from './support.js';

test('importing and loading use neither the DOM nor the network, and load always returns the same core', async () => {
  /** @type {string[]} */
  const accessedGlobals = [];
  const browserGlobals = ['document', 'window', 'customElements', 'fetch', 'XMLHttpRequest', 'WebSocket'];
  const descriptorsBefore = browserGlobals.map((globalName) => Object.getOwnPropertyDescriptor(globalThis, globalName));
  for (const globalName of browserGlobals) {
    Object.defineProperty(globalThis, globalName, { configurable: true, get: () => void accessedGlobals.push(globalName) });
  }
  try {
    const coreModule = await importFreshModule();
    assert.deepEqual(accessedGlobals, []);
    const loadedCore = await coreModule.load();
    assert.equal(await coreModule.load(), loadedCore);
  } finally {
    browserGlobals.forEach((globalName, i) => {
      const globalDescriptor = descriptorsBefore[i];
      if (globalDescriptor) Object.defineProperty(globalThis, globalName, globalDescriptor);
      else Reflect.deleteProperty(globalThis, globalName);
    });
  }
  assert.deepEqual(accessedGlobals, []);
});

test('load accepts bytes, a compiled module or an address, and fails with a clear message', async () => {
  const moduleAddress = new URL('../../build/motion.wasm', import.meta.url);
  const moduleBytes = await readFile(moduleAddress);
  for (const moduleSource of [undefined, moduleBytes, new Uint8Array(moduleBytes).buffer, await WebAssembly.compile(moduleBytes), moduleAddress, moduleAddress.href]) {
    const loadedCore = await (await importFreshModule()).load(moduleSource);
    const simulation = new loadedCore.BananaMachine({ samples: 5 });
    assert.equal(simulation.stats.n, 5);
    simulation.free();
  }
  const motionCore = await importFreshModule();
  await assert.rejects(motionCore.load(42), TypeError);
  await assert.rejects(motionCore.load(new Uint8Array([1, 2, 3])));
  assert.ok((await motionCore.load()).BananaMachine, 'a failed load can be tried again');
});

test('the core exports every public name', async () => {
  const motionCore = await (await importFreshModule()).load();
  const simulationNames = ['AlphaCalibrator', 'ArcAnatomy', 'BananaMachine', 'DeadReckoning', 'MapSqueeze', 'OdometryDecomposer'];
  const modelNames = ['OdometryModel', 'VelocityModel'];
  const functionNames = ['calibrate', 'commandReaching', 'decompose', 'invertArc', 'propagate', 'randomSeed', 'readMapImage', 'unbendGaussian', 'unbendLine'];
  assert.deepEqual(Object.keys(motionCore).sort(), [...simulationNames, ...modelNames, ...functionNames, 'se2'].sort());
  for (const [classNames, memberNames] of [[simulationNames, ['configure', 'config', 'stats']], [modelNames, ['prob', 'poseDensity', 'sample']]]) {
    for (const className of classNames) {
      for (const memberName of [...memberNames, 'free', Symbol.dispose]) assert.ok(memberName in motionCore[className].prototype, `${className}: ${String(memberName)}`);
    }
  }
  const se2FunctionNames = ['adjoint', 'boxminus', 'boxplus', 'compose', 'exp', 'inverse', 'log', 'rightJacobian'];
  assert.deepEqual(Object.keys(motionCore.se2).sort(), se2FunctionNames);
});

test('a new simulation has the default settings of its declarations', async () => {
  const motionCore = await (await importFreshModule()).load();
  for (const [widgetTag, declaredSettings] of Object.entries(settings)) {
    const SimulationClass = motionCore[toPascalCase(widgetTag)];
    const fieldsOf = (/** @type {string} */ groupKey) => declaredSettings.filter((settingDeclaration) => settingDeclaration.in === groupKey).map(({ key: settingKey, field = settingKey, default: defaultValue }) => [field, defaultValue]);
    const topLevelSettings = declaredSettings.filter((settingDeclaration) => !settingDeclaration.in && !settingDeclaration.of).map(({ key: settingKey, type, default: defaultValue }) => [settingKey, type === 'group' ? Object.fromEntries(fieldsOf(settingKey)) : defaultValue]);
    assert.deepEqual(new SimulationClass().config, Object.fromEntries(topLevelSettings), widgetTag);
  }
});

test('a simulation computes, rejects invalid input with an error class and message, and can be freed', async () => {
  const { BananaMachine, invertArc } = await (await importFreshModule()).load();
  const simulation = new BananaMachine({ command: { v: 1, omega: 0.5, dt: 1 }, alphas: [0.02, 0.02, 0.02, 0.02, 0, 0], samples: 100 });
  assert.equal(simulation.table.exact.crossTrackSkew.toFixed(5), '-0.30056');
  assert.throws(() => simulation.configure({ samples: 0 }), { name: 'RangeError', message: /^samples is 0; allowed is a whole number / });
  assert.throws(() => invertArc({ x: 0, y: 0 }), { name: 'TypeError', message: 'start.theta is undefined; allowed is a number' });
  assert.equal(simulation.stats.n, 100);
  simulation.free();
  simulation.free();
  assert.throws(() => simulation.stats, { name: 'TypeError', message: 'this BananaMachine was freed; create a new one.' });
});

test('calibrate accepts coordinates up to the same limit as the readers of logs', async () => {
  const { calibrate } = await (await importFreshModule()).load();
  const referenceLog = { t: [0, 1], x: [0, 1], y: [0, 0], theta: [0, 0] };
  const createOdometryTo = (/** @type {number} */ x) => ({ ...referenceLog, x: [0, x] });
  assert.throws(() => calibrate({ odometry: createOdometryTo(MAX_VALUE), reference: referenceLog }), { message: /^not enough data: \d legs/ });
  const expectedError = { message: /^odometry\.x\[1\] is 2000000000; allowed / };
  assert.throws(() => calibrate({ odometry: createOdometryTo(2 * MAX_VALUE), reference: referenceLog }), expectedError);
});
