// `npm test`: every check, the cheapest first. One that fails does not keep the others from running.

import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build } from './build.mjs';
import { CHROME_ARGUMENTS, ensureBrowser } from './browser.mjs';
import { ROOT, progress, run, runAsScript } from './process.mjs';
import { ensureLints, ensurePackages, nativeRust, wasmBindgen, wasmRust } from './toolchain.mjs';

/** @typedef {{ passed: number, failed: number, skipped: number }} Tally */
/** @typedef {{ name: string, ok: boolean, seconds: number, tally?: Tally, note?: string }} Outcome */

/** Seconds that a stage may take: a test that hangs must not hang what waits for the result. */
const LIMIT = 1200;

const at = (/** @type {string} */ path) => join(ROOT, path);
const npmProgram = (/** @type {string} */ path) => [process.execPath, at(join('node_modules', path))];

/** @returns {Promise<boolean>} whether all is well */
async function test() {
  await ensurePackages();
  const native = await nativeRust();
  await ensureLints(native);
  const wasm = await wasmRust(native);
  await ensureLints(wasm);
  const bindgen = await wasmBindgen(native);
  const browser = await ensureBrowser();
  console.log(`\nNode ${process.versions.node}; ${native.description}; for WebAssembly ${wasm.description}; Chromium ${browser.version}`);
  rmSync(at('test-results'), { recursive: true, force: true });
  mkdirSync(at('test-results'));

  /** @type {Outcome[]} */
  const outcomes = [];
  /**
   * @param {string} name
   * @param {string[]} command
   * @param {Record<string, string>} [env]
   * @param {(output: string) => Tally} [count] for a stage that runs tests, counts them in what it printed
   */
  const stage = async (name, [program, ...args], env, count) => {
    progress(name);
    const start = Date.now();
    const { ok, output, timedOut } = await run(program, args, { env, seconds: LIMIT });
    const tally = count?.(output);
    const noTests = tally !== undefined && tally.passed + tally.failed === 0;
    const note = timedOut ? `ended after ${LIMIT} s` : noTests ? 'no test ran' : undefined;
    outcomes.push({ name, ok: ok && !noTests && !tally?.failed, seconds: (Date.now() - start) / 1000, tally, note });
  };
  const cargo = (/** @type {import('./toolchain.mjs').Rust} */ { bin }, /** @type {string[]} */ ...args) => [join(bin, `cargo${args[0] === 'test' ? '' : `-${args[0]}`}`), ...args];
  const lintRules = ['--', '-D', 'warnings'];

  await stage('rustfmt', cargo(native, 'fmt', '--check'), native.env);
  await stage('eslint', [...npmProgram('eslint/bin/eslint.js'), '--max-warnings', '0', '.']);

  progress('build');
  const start = Date.now();
  const built = await build().then(
    () => true,
    (error) => (console.error(error instanceof Error ? error.message : error), false),
  );
  outcomes.push({ name: 'build', ok: built, seconds: (Date.now() - start) / 1000 });
  const needsBuild = async (/** @type {string} */ name, /** @type {() => Promise<void>} */ go) => {
    if (built) await go();
    else outcomes.push({ name, ok: false, seconds: 0, note: 'not run without a build' });
  };

  await needsBuild('tsc', () => stage('tsc', npmProgram('typescript/bin/tsc')));
  await stage('clippy', cargo(native, 'clippy', '--locked', '--all-targets', ...lintRules), native.env);
  await stage(
    'clippy for WebAssembly',
    cargo(wasm, 'clippy', '--locked', '--lib', '--test', 'web', ...wasm.target, ...lintRules),
    wasm.env,
  );
  await stage('Rust tests', cargo(native, 'test', '--locked', '--no-fail-fast'), native.env, rustTally);
  await stage(
    'WebAssembly tests in Chromium',
    cargo(wasm, 'test', '--locked', '--release', '--test', 'web', ...wasm.target),
    { ...wasm.env, ...testRunner(bindgen, browser) },
    rustTally,
  );
  await needsBuild('Node tests', () =>
    stage('Node tests', nodeTests('tests/node'), {}, tapTally),
  );
  await needsBuild('package tests', () =>
    stage('package tests', nodeTests('tests/package'), { CHROME: browser.chrome }, tapTally),
  );
  await needsBuild('browser tests', () =>
    stage('browser tests', [...npmProgram('@playwright/test/cli.js'), 'test'], { CHROME: browser.chrome }, playwrightTally),
  );
  return summarize(outcomes);
}

/**
 * What makes `cargo test` run its WebAssembly tests in the browser.
 *
 * @param {string} bindgen the directory of wasm-bindgen's programs
 * @param {import('./browser.mjs').Browser} browser
 */
function testRunner(bindgen, browser) {
  const capabilities = at('test-results/webdriver.json');
  const options = { binary: browser.chrome, args: ['--headless', ...CHROME_ARGUMENTS] };
  writeFileSync(capabilities, JSON.stringify({ 'goog:chromeOptions': options }));
  return {
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER: join(bindgen, 'wasm-bindgen-test-runner'),
    CHROMEDRIVER: browser.driver,
    WASM_BINDGEN_TEST_WEBDRIVER_JSON: capabilities,
    // Seconds for all tests of a file; the runner's own 20 are short on a busy machine.
    WASM_BINDGEN_TEST_TIMEOUT: '180',
  };
}

/**
 * @param {string} directory
 * @returns {string[]} the command that runs its tests
 */
function nodeTests(directory) {
  const files = readdirSync(at(directory)).filter((name) => name.endsWith('.test.js'));
  return [process.execPath, '--test', '--test-reporter', 'tap', ...files.map((name) => join(directory, name))];
}

/**
 * @param {string} output of cargo test, one "test result" line for each of its programs
 * @returns {Tally}
 */
function rustTally(output) {
  const tally = { passed: 0, failed: 0, skipped: 0 };
  for (const [, passed, failed, ignored] of output.matchAll(/^test result: .*?(\d+) passed; (\d+) failed; (\d+) ignored/gm)) {
    tally.passed += Number(passed);
    tally.failed += Number(failed);
    tally.skipped += Number(ignored);
  }
  return tally;
}

/**
 * @param {string} output of node --test
 * @returns {Tally}
 */
function tapTally(output) {
  const last = (/** @type {string} */ word) => Number([...output.matchAll(new RegExp(`^# ${word} (\\d+)$`, 'gm'))].pop()?.[1] ?? 0);
  return { passed: last('pass'), failed: last('fail') + last('cancelled'), skipped: last('skipped') + last('todo') };
}

/** @returns {Tally} */
function playwrightTally() {
  const report = at('test-results/e2e.json');
  if (!existsSync(report)) return { passed: 0, failed: 0, skipped: 0 };
  const { stats } = JSON.parse(readFileSync(report, 'utf8'));
  return { passed: stats.expected, failed: stats.unexpected + stats.flaky, skipped: stats.skipped };
}

/**
 * @param {Outcome[]} outcomes
 * @returns {boolean} whether all is well
 */
function summarize(outcomes) {
  progress('Summary');
  let passed = 0;
  let failed = 0;
  for (const { name, ok, seconds, tally, note } of outcomes) {
    const counts = tally === undefined ? [] : [`${tally.passed} passed`, `${tally.failed} failed`];
    if (tally?.skipped) counts.push(`${tally.skipped} skipped`);
    if (note !== undefined) counts.push(note);
    console.log(`${ok ? 'ok    ' : 'FAILED'} ${name.padEnd(30)} ${seconds.toFixed(0).padStart(4)} s  ${counts.join(', ')}`);
    passed += tally?.passed ?? 0;
    // A check that fails without a failed test to show for it counts as one.
    failed += ok ? 0 : Math.max(1, tally?.failed ?? 0);
  }
  console.log(`\n${passed} passed, ${failed} failed`);
  return failed === 0;
}

await runAsScript(import.meta.url, async () => {
  if (!(await test())) process.exitCode = 1;
});
