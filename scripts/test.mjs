// `npm test`: the checks of every change. `npm run test:all`: those and the nightly ones, which take longer. `npm test -- PART`
// runs one part and gives the remaining arguments to its program. A part that fails does not keep the others from running.
//
// Nightly tests are marked where they stand: `#[ignore = "nightly: …"]` in Rust, `@nightly` in the title of a test in JavaScript,
// `*.nightly.test.js` for whole files.

import { existsSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { testRunner } from './bindgen.mjs';
import { CHROME_ARGUMENTS, ensureBrowser } from './browser.mjs';
import { build } from './build.mjs';
import { filesOf } from './bundle.mjs';
import { Missing, ROOT, inOnePiece, once, progress, run, runAsScript, together } from './process.mjs';
import { ensureLints, ensurePackages, nativeRust, wasmRust } from './toolchain.mjs';

/** @typedef {{ passed: number, failed: number, skipped: number }} Tally */
/** @typedef {{ name: string, ok: boolean, seconds: number, output?: string, tally?: Tally, note?: string }} Outcome */
/** @typedef {() => Promise<{ ok: boolean, output: string, timedOut: boolean }>} Job */
/**
 * @typedef {object} Part
 * @property {(more: string[]) => Promise<Job>} prepare waits for what it needs, installed if need be. `more` are
 *   arguments for its program
 * @property {Record<keyof Tally, RegExp>} [counts] where tests run, numbers in what is printed that are added
 */

/** Runs the nightly tests as well. */
const ALL = process.argv.includes('--all');

/** Time limit of a part, s, so that a hanging test does not stop the run. */
const LIMIT = ALL ? 3600 : 1200;

const at = (/** @type {string} */ path) => join(ROOT, path);
/** @type {('tests' | 'tests/package' | 'tests/engines')[]} workspaces of package.json that the tests need */
const PACKAGES = ALL ? ['tests', 'tests/package', 'tests/engines'] : ['tests'];

/** The quick tier tests the whole core in all figures. The nightly one also builds the modules of single figures. */
const built = once(() => together([build({ local: !ALL }), ...PACKAGES.map((name) => ensurePackages(name))]));

/** Versions of the tools that the parts used. */
const versions = new Set([`Node ${process.versions.node}`]);

async function native() {
  const rust = await nativeRust();
  versions.add(rust.description);
  return rust;
}

async function wasm() {
  const rust = await wasmRust();
  versions.add(`for WebAssembly ${rust.description}`);
  return rust;
}

const browser = once(async () => {
  const found = await ensureBrowser();
  versions.add(`Chromium ${found.version}`);
  return found;
});

/**
 * @param {string[]} command
 * @param {Record<string, string>} [env]
 * @returns {Job}
 */
const program = ([name, ...args], env) => () => run(name, args, { env, seconds: LIMIT });

/**
 * @param {string} path of a script in node_modules
 * @param {string[]} args
 * @param {Record<string, string>} [env]
 */
const npmProgram = (path, args, env) => program([process.execPath, at(join('node_modules', path)), ...args], env);

/** @param {string} path of a script of this repository */
const script = (path) => program([process.execPath, at(path)]);

/**
 * @param {import('./toolchain.mjs').Rust} rust
 * @param {string[]} args
 * @param {Record<string, string>} [env]
 */
const cargo = ({ bin, env: environment }, args, env) => program([join(bin, 'cargo'), ...args], { ...environment, ...env });

/**
 * @param {import('./toolchain.mjs').Rust} rust
 * @param {'fmt' | 'clippy'} name
 * @param {string[]} args
 */
async function lint(rust, name, args) {
  await ensureLints(rust);
  return program([join(rust.bin, `cargo-${name}`), name, ...args], rust.env);
}

const LINT_RULES = ['--', '-D', 'warnings'];

/** Numbers of tests in the output of each program. @satisfies {Record<string, Record<keyof Tally, RegExp>>} */
const COUNTS = {
  cargo: { passed: /^test result: .*?(\d+) passed/gm, failed: /^test result: .*?(\d+) failed/gm, skipped: /^test result: .*?(\d+) ignored/gm },
  node: { passed: /^# pass (\d+)$/gm, failed: /^# (?:fail|cancelled) (\d+)$/gm, skipped: /^# (?:skipped|todo) (\d+)$/gm },
  playwright: { passed: /^ +(\d+) passed/gm, failed: /^ +(\d+) (?:failed|interrupted|did not run)/gm, skipped: /^ +(\d+) skipped/gm },
};

/** @type {Record<string, Part>} */
const PARTS = {
  rustfmt: {
    prepare: async (more) => lint(await native(), 'fmt', ['--check', ...more, '--', ...filesOf('scripts/bind/src'), 'fuzz/main.rs']),
  },
  oxlint: {
    async prepare(more) {
      await ensurePackages('tests');
      return npmProgram('oxlint/bin/oxlint', ['--deny-warnings', ...more, '.']);
    },
  },
  build: {
    prepare: async () => () => built().then(() => ({ ok: true, output: '', timedOut: false })),
  },
  tsc: {
    async prepare(more) {
      await built();
      // The nightly tier also needs the packages of the engines and of tests/package.
      return npmProgram('typescript/bin/tsc', ['-p', ALL ? 'tests/types.json' : '.', ...more]);
    },
  },
  clippy: {
    prepare: async (more) => lint(await native(), 'clippy', ['--locked', '--all-targets', ...more, ...LINT_RULES]),
  },
  'clippy-wasm': {
    async prepare(more) {
      const rust = await wasm();
      // Uses the profile of the tests, in which the macros are compiled already.
      const options = ['--locked', '--profile', 'web', '--lib', '--test', 'web', ...rust.target];
      return lint(rust, 'clippy', [...options, ...more, ...LINT_RULES]);
    },
  },
  docs: {
    prepare: async (more) => cargo(await native(), ['doc', '--locked', '--no-deps', ...more], { RUSTDOCFLAGS: '-D warnings' }),
  },
  rust: {
    async prepare(more) {
      // Incremental compilation makes the first compilation 18 % slower in processor time.
      const env = existsSync(at('target/debug')) ? undefined : { CARGO_INCREMENTAL: '0' };
      return cargo(await native(), ['test', '--locked', '--no-fail-fast', ...more, ...(ALL ? ['--', '--include-ignored'] : [])], env);
    },
    counts: COUNTS.cargo,
  },
  wasm: {
    async prepare(more) {
      const rust = await wasm();
      const options = ['--locked', '--profile', 'web', '--test', 'web', ...rust.target];
      return cargo(rust, ['test', ...options, ...more], inBrowser(await testRunner(), await browser()));
    },
    counts: COUNTS.cargo,
  },
  node: {
    async prepare(more) {
      await built();
      return program(nodeTests('tests/node', more));
    },
    counts: COUNTS.node,
  },
  package: {
    async prepare(more) {
      await built();
      return program(nodeTests('tests/package', more), { CHROME: (await browser()).chrome });
    },
    counts: COUNTS.node,
  },
  browser: {
    async prepare(more) {
      await built();
      const tier = ALL ? [] : ['--grep-invert', '@nightly'];
      return npmProgram('@playwright/test/cli.js', ['test', ...tier, ...more], { CHROME: (await browser()).chrome });
    },
    counts: COUNTS.playwright,
  },
  // Nightly: Firefox and WebKit, and projects that embed the package.
  engines: { prepare: async () => script('tests/engines/run.mjs') },
  embeddings: { prepare: async () => script('tests/embeddings/run.mjs') },
};

/**
 * Lanes of parts that run side by side, so that no core is idle while a linker, a download, a frame or a test waits. Parts of one
 * lane run one after the other. Cargo waits by itself for a directory that another part writes.
 */
const LANES = [
  ['build', 'browser', ...(ALL ? ['engines', 'embeddings'] : [])],
  ['rustfmt', 'rust', 'clippy', ...(ALL ? ['docs'] : [])],
  ['wasm', ...(ALL ? ['clippy-wasm'] : [])],
  ['oxlint', 'tsc', 'node', 'package'],
];

/**
 * @param {string[]} args of the command line
 * @returns {Promise<boolean>} whether all is well
 */
async function test(args) {
  const [only, ...more] = args.filter((each) => each !== '--all');
  if (only !== undefined && !Object.hasOwn(PARTS, only)) {
    throw new Missing(`"${only}" is no part of the tests: \`npm test -- PART\` takes ${Object.keys(PARTS).join(', ')}.`);
  }
  rmSync(at('test-results'), { recursive: true, force: true });
  mkdirSync(at('test-results'));
  if (only !== undefined) return summarize([await outcomeOf(only, more)]);

  // Installation starts now, because some lanes need the tools late. A part that needs a missing one reports it.
  for (const tool of [browser, testRunner]) tool().catch(() => {});
  /** @type {Outcome[]} */
  const outcomes = [];
  await Promise.all(
    LANES.map(async (names) => {
      for (const name of names) outcomes.push(await inOnePiece(() => outcomeOf(name, [])));
    }),
  );
  return summarize(outcomes);
}

/**
 * @param {string} name of a part
 * @param {string[]} more
 * @returns {Promise<Outcome>}
 */
async function outcomeOf(name, more) {
  const { prepare, counts } = PARTS[name];
  let start = Date.now();
  const seconds = () => (Date.now() - start) / 1000;
  try {
    const job = await prepare(more);
    progress(name);
    start = Date.now();
    const { ok, output, timedOut } = await job();
    const total = (/** @type {RegExp} */ number) => [...output.matchAll(number)].reduce((sum, [, each]) => sum + Number(each), 0);
    const tally = counts && { passed: total(counts.passed), failed: total(counts.failed), skipped: total(counts.skipped) };
    const noTests = tally !== undefined && tally.passed + tally.failed === 0;
    const note = timedOut ? `ended after ${LIMIT} s` : noTests ? 'no test ran' : undefined;
    return { name, ok: ok && !noTests && !tally?.failed, seconds: seconds(), output, tally, note };
  } catch (error) {
    progress(`${name}: ${error instanceof Missing ? error.message : (error instanceof Error && error.stack) || error}`);
    return { name, ok: false, seconds: seconds(), note: 'not run: see above' };
  }
}

/**
 * Returns the environment in which `cargo test` runs its WebAssembly tests in the browser.
 *
 * @param {string} runner of wasm-bindgen
 * @param {import('./browser.mjs').Browser} browser
 */
function inBrowser(runner, { chrome, driver }) {
  const capabilities = at('test-results/webdriver.json');
  const options = { binary: chrome, args: ['--headless', ...CHROME_ARGUMENTS] };
  writeFileSync(capabilities, JSON.stringify({ 'goog:chromeOptions': options }));
  return {
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER: runner,
    CHROMEDRIVER: driver,
    WASM_BINDGEN_TEST_WEBDRIVER_JSON: capabilities,
    // Seconds for all tests of a file; the runner's own 20 are short on a busy machine.
    WASM_BINDGEN_TEST_TIMEOUT: '180',
  };
}

/**
 * Returns the command that runs the tests of a directory, or the named files of it.
 *
 * @param {string} directory
 * @param {string[]} more files or options
 */
function nodeTests(directory, more) {
  const files = filesOf(directory).filter((path) => /\.test\.[jt]s$/.test(path) && (ALL || !path.endsWith('.nightly.test.js')));
  const named = files.filter((path) => more.some((each) => !each.startsWith('-') && path.includes(each)));
  const options = more.filter((each) => !named.some((path) => path.includes(each)));
  // Node runs every test of a parent that matches, and the parent of all is called "<root>".
  const tier = ALL ? [] : ['--test-name-pattern', '/^(?!<root>|.*@nightly)/'];
  // With its default number of processes a core stays idle.
  return [process.execPath, '--import', 'tsx', '--test', '--test-reporter', 'tap', '--test-concurrency', `${availableParallelism()}`, ...tier, ...options, ...(named.length > 0 ? named : files)];
}

/** Number of last lines of a failed program's output that are shown again below the summary. They have its errors. */
const LAST_LINES = 60;

/**
 * @param {Outcome[]} outcomes
 * @returns {boolean} whether all is well
 */
function summarize(outcomes) {
  progress('Summary');
  console.log(`${[...versions].join('; ')}\n`);
  let passed = 0;
  let failed = 0;
  for (const { name, ok, seconds, tally, note } of outcomes) {
    const counts = tally === undefined ? [] : [`${tally.passed} passed`, `${tally.failed} failed`];
    if (tally?.skipped) counts.push(`${tally.skipped} skipped`);
    if (note !== undefined) counts.push(note);
    console.log(`${ok ? 'ok    ' : 'FAILED'} ${name.padEnd(12)} ${seconds.toFixed(0).padStart(4)} s  ${counts.join(', ')}`);
    passed += tally?.passed ?? 0;
    // A part that fails without a failed test counts as one failed test.
    failed += ok ? 0 : Math.max(1, tally?.failed ?? 0);
  }
  for (const { name, ok, output } of outcomes) {
    if (!ok && output && outcomes.length > 1) console.log(`\n${name}: …\n${output.trimEnd().split('\n').slice(-LAST_LINES).join('\n')}`);
  }
  console.log(`\n${passed} passed, ${failed} failed`);
  return failed === 0;
}

await runAsScript(import.meta.url, async () => {
  if (!(await test(process.argv.slice(2)))) process.exitCode = 1;
});
