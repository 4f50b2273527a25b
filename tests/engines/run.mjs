/**
 * `npm run test:engines`: builds, and opens the page in Chromium, Firefox and WebKit. `npm run test:engines -- ENGINE…` takes some of
 * them. Pictures are in test-results/engines.
 *
 * @module
 */

import { build } from '../../scripts/build.mjs';
import { Missing, progress, runAsScript } from '../../scripts/process.mjs';
import { engines } from './browsers.mjs';
import { site } from './site.mjs';

/** @typedef {import('./checks.mjs').Result & { name: string, version: string, seconds: number }} Outcome */

/**
 * @param {string} name
 * @param {string} address
 * @returns {Promise<Outcome>}
 */
async function outcomeOf(name, address) {
  progress(name);
  const begin = Date.now();
  const seconds = () => (Date.now() - begin) / 1000;
  let version = 'none';
  try {
    const engine = await engines[name]();
    version = engine.version;
    try {
      // It imports what is built.
      const { check } = await import('./checks.mjs');
      return { name, version, ...(await check(name, engine, address)), seconds: seconds() };
    } finally {
      await engine.close();
    }
  } catch (error) {
    const failure = error instanceof Missing ? error.message : String(error instanceof Error ? error.stack : error);
    console.log(`FAILED ${name}: ${failure}`);
    return { name, version, passed: 0, failures: [failure], states: {}, seconds: seconds() };
  }
}

/**
 * What came out otherwise than in the first engine, after the same keys, or with the same files.
 *
 * @param {Outcome[]} outcomes
 * @returns {string[]}
 */
function disagreements([first, ...others]) {
  return others.flatMap(({ name, states }) =>
    Object.keys(states)
      .filter((what) => what in first.states && states[what] !== first.states[what])
      .map((what) => `${what}: ${name} has other bits than ${first.name}`),
  );
}

/**
 * @param {string[]} wanted the engines to try; all where there are none
 * @returns {Promise<boolean>} whether all is well
 */
async function test(wanted) {
  const known = Object.keys(engines);
  const unknown = wanted.find((name) => !known.includes(name));
  if (unknown !== undefined) throw new Missing(`"${unknown}" is no engine that is tried; allowed are ${known.join(', ')}.`);
  await build();
  const { address, stop } = await site();
  /** @type {Outcome[]} */
  const outcomes = [];
  try {
    for (const name of wanted.length > 0 ? wanted : known) outcomes.push(await outcomeOf(name, address));
  } finally {
    stop();
  }
  const disagreeing = disagreements(outcomes);
  progress(`Summary, by Node ${process.versions.node}`);
  for (const { name, version, passed, failures, seconds } of outcomes) {
    const counts = `${passed} passed, ${failures.length} failed`;
    console.log(`${failures.length === 0 ? 'ok    ' : 'FAILED'} ${name.padEnd(10)} ${version.padEnd(16)} ${seconds.toFixed(0).padStart(4)} s  ${counts}`);
  }
  for (const each of disagreeing) console.log(`FAILED ${each}`);
  const [passed, failed] = [outcomes.reduce((sum, each) => sum + each.passed, 0), outcomes.reduce((sum, each) => sum + each.failures.length, disagreeing.length)];
  console.log(`\n${passed} passed, ${failed} failed`);
  return failed === 0;
}

await runAsScript(import.meta.url, async () => {
  if (!(await test(process.argv.slice(2)))) process.exitCode = 1;
});
