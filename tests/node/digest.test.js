// Equal seeds give equal bits in Node. The list of configurations covers all settings of the simulations.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { presets, settings } from '../../build/settings.js';
import { findDifferences, computeDigest, resultFunctions } from '../digest/digest.js';
import { importFreshModule } from './support.js';

const readText = (/** @type {string} */ repositoryPath) => readFileSync(new URL(`../../${repositoryPath}`, import.meta.url), 'utf8');

/** @type {import('../digest/digest.js').Configurations} */
const configurationFile = JSON.parse(readText('tests/digest/configurations.json'));
const motionCore = await (await importFreshModule()).load();

/** Exports that the digest leaves to tests/web and tests/native: functions without random numbers, and the models. */
const EXCLUDED_EXPORTS = new Set(['VelocityModel', 'OdometryModel', 'invertArc', 'decompose', 'propagate', 'se2', 'calibrate']);

/** Classes of the simulations in core.js, by tag name. @type {Map<string, any>} */
const simulationClasses = new Map(
  Object.entries(motionCore)
    .filter(([exportName, exportedValue]) => 'free' in (exportedValue.prototype ?? {}) && !EXCLUDED_EXPORTS.has(exportName))
    .map(([className, exportedClass]) => [className.replace(/\B[A-Z]/g, '-$&').toLowerCase(), exportedClass]),
);

const goldenDigest = readText('tests/digest/golden.txt');

test('the results of each seed equal the golden digest, to the last bit', async () => {
  const computedDigest = await computeDigest(motionCore, configurationFile);
  if (process.env.UPDATE_DIGEST) writeFileSync(new URL('../digest/golden.txt', import.meta.url), computedDigest);
  else assert.deepEqual(findDifferences(goldenDigest, computedDigest), []);
});

test('every widget and class of the core has configurations, and the digest calls every function', () => {
  const listedTags = [...readText('www/motion-widgets.ts').matchAll(/^import '\.\/widgets\/([\w-]+)\//gm)].map(([, widgetTag]) => widgetTag);
  assert.deepEqual(Object.keys(configurationFile.widgets).sort(), listedTags.sort(), 'www/motion-widgets.ts');
  assert.deepEqual(Object.keys(configurationFile.widgets).sort(), [...simulationClasses.keys()].sort(), 'core.js');
  assert.deepEqual(Object.keys(resultFunctions).sort(), listedTags, 'digest.js');
  const functionNames = Object.keys(motionCore).filter((exportName) => !('free' in (motionCore[exportName].prototype ?? {})) && !MEMBERS_TESTED_ELSEWHERE.has(exportName) && !EXCLUDED_EXPORTS.has(exportName));
  for (const functionName of functionNames) assert.match(readText('tests/digest/digest.js'), new RegExp(`\\b${functionName}\\(`));
  const configurationCount = Object.values(configurationFile.widgets).reduce((countSum, { configurations }) => countSum + Object.keys(configurations).length, 0);
  // golden.txt must have no lines of configurations that were removed.
  assert.equal(configurationCount, readText('tests/digest/golden.txt').match(/^.+$/gm)?.length);
});

for (const [widgetTag, { configurations }] of Object.entries(configurationFile.widgets)) {
  const coveredValuesOf = (/** @type {string} */ settingKey) => new Set(Object.values(configurations).map((configuration) => JSON.stringify(configuration.settings[settingKey])));

  test(`configurations of ${widgetTag} cover every setting, every keyword and every preset`, () => {
    for (const { key: settingKey, type, words, nullable, default: defaultValue, in: groupKey } of settings[widgetTag]) {
      if (groupKey) continue;
      const coveredValues = coveredValuesOf(settingKey);
      const allowedValues = type === 'boolean' ? [true, false] : (words ?? []);
      for (const allowedValue of allowedValues) assert.ok(coveredValues.has(JSON.stringify(allowedValue)) || allowedValue === defaultValue, `${settingKey}: ${allowedValue}`);
      const otherValues = [...coveredValues].filter((coveredValue) => coveredValue !== undefined && coveredValue !== JSON.stringify(defaultValue));
      assert.ok(otherValues.length > 0, `${settingKey} is never set`);
      if (nullable && defaultValue !== null && type !== 'number') assert.ok(coveredValues.has('null'), `${settingKey}: null`);
    }
    for (const { name: presetName } of presets[/** @type {keyof typeof presets} */ (widgetTag)]) {
      assert.ok(Object.values(configurations).some(({ preset }) => preset === presetName), `preset ${presetName}`);
    }
  });

  test(`the digest of ${widgetTag} contains every result of its simulation`, () => {
    const functionText = resultFunctions[widgetTag].toString();
    const memberNames = Object.getOwnPropertyNames(simulationClasses.get(widgetTag).prototype);
    const missingNames = memberNames.filter((memberName) => !MEMBERS_TESTED_ELSEWHERE.has(memberName) && !new RegExp(`\\b${memberName}\\b`).test(functionText));
    assert.deepEqual(missingNames, [], `ask for them in digest.js and in tests/digest/`);
  });
}

test('every map is used by a configuration, and a difference is reported with its name', () => {
  const usedMapNames = new Set(Object.values(configurationFile.widgets['map-squeeze'].configurations).map(({ map }) => map));
  for (const map of Object.keys(configurationFile.maps)) assert.ok(usedMapNames.has(map), map);
  assert.deepEqual(findDifferences('a/b poses:1 table:2\na/c poses:3\n', 'a/b poses:1 table:9\na/d poses:3\n'), [
    'a/b: table',
    'a/c is gone',
    'a/d is not in golden.txt',
  ]);
});

/** Members that the digest does not contain. tests/native/simulations covers them: banana, morph, squeeze, dead_reckoning and alpha_calibrator. */
const MEMBERS_TESTED_ELSEWHERE = new Set([
  'constructor', 'free', '__destroy_into_raw', 'config', 'fittedConfig', 'isPending', 'save', 'read', 'firstPoses', 'firstTwists', 'configure', 'configureFirst', 'addSamples', 'block', 'alphasOfModels', 'milestones',
  'randomSeed', 'readMapImage', 'firstContact', 'unbendGaussian', 'unbendLine', 'gaps',
]);
