// `npm test` runs the checks of every change. `npm run test:all` also runs the nightly checks, which take longer. `npm test -- PART` runs
// one part, and passes the remaining arguments to its program. All parts run, even if a part fails.
//
// Nightly tests have `#[ignore = "nightly: …"]` in Rust, and `@nightly` in their title in JavaScript. `*.nightly.test.js` has only nightly
// tests.

import { existsSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { ensureTestRunner } from './bindgen.mjs';
import { CHROME_ARGUMENTS, ensureBrowser } from './browser.mjs';
import { buildProject } from './build.mjs';
import { UserError, absolutePathOf, filesOf, collectOutputOf, memoizeWork, printStep, runProgram, runAsScript, settleAll } from './process.mjs';
import { ensureLints, ensurePackages, ensureNativeRust, ensureRustForWasm } from './toolchain.mjs';

/** @typedef {{ passed: number, failed: number, skipped: number }} Tally */
/** @typedef {{ name: string, hasSucceeded: boolean, seconds: number, output?: string, tally?: Tally, note?: string }} Outcome */
/** @typedef {() => Promise<{ hasSucceeded: boolean, output: string, hasTimedOut: boolean }>} Job */
/**
 * @typedef {object} Part
 * @property {(programArgs: string[]) => Promise<Job>} prepare waits for the tools that the part needs, and installs missing ones. `programArgs` are
 *   additional arguments for its program
 * @property {Record<keyof Tally, RegExp>} [countPatterns] patterns of the numbers of tests in the output, if the part runs tests
 */

/** True if the nightly tests run as well. */
const IS_NIGHTLY = process.argv.includes('--all');

/** Time limit of a part in s, so that a hanging test does not stop the run. */
const TIME_LIMIT_SECONDS = IS_NIGHTLY ? 3600 : 1200;

/** @type {('tests' | 'tests/package' | 'tests/engines')[]} workspaces of package.json that the tests need */
const TEST_WORKSPACES = IS_NIGHTLY ? ['tests', 'tests/package', 'tests/engines'] : ['tests'];

/**
 * Builds dist/ and installs the packages of the tests. Daily tests use the common core in all figures. Nightly tests also use the core of
 * each figure.
 */
const ensureBuilt = memoizeWork(() => settleAll([buildProject({ isLocal: !IS_NIGHTLY }), ...TEST_WORKSPACES.map((workspaceName) => ensurePackages(workspaceName))]));

/** Versions of the tools that the parts of this test run have used so far. */
const toolVersions = new Set([`Node ${process.versions.node}`]);

/**
 * Returns a function that ensures that a tool is installed, and adds its version to `toolVersions`.
 *
 * @template Tool
 * @param {() => Promise<Tool>} ensureTool
 * @param {(tool: Tool) => string} versionOf
 */
const recordVersionOf = (ensureTool, versionOf) => memoizeWork(async () => {
  const requiredTool = await ensureTool();
  toolVersions.add(versionOf(requiredTool));
  return requiredTool;
});

const ensureRust = recordVersionOf(ensureNativeRust, ({ description }) => description);
const ensureWasmRust = recordVersionOf(ensureRustForWasm, ({ description }) => `for WebAssembly ${description}`);
const ensureTestBrowser = recordVersionOf(ensureBrowser, ({ version }) => `Chromium ${version}`);

/**
 * Returns a job that runs a program.
 *
 * @param {string[]} command
 * @param {Record<string, string>} [programEnvironment]
 * @returns {Job}
 */
const createProgramJob = ([programName, ...programArguments], programEnvironment) => () => runProgram(programName, programArguments, { env: programEnvironment, timeLimitSeconds: TIME_LIMIT_SECONDS });

/**
 * Returns a job that runs a script of a package.
 *
 * @param {string} scriptPath path in node_modules
 * @param {string[]} scriptArguments
 * @param {Record<string, string>} [env]
 */
const createNpmJob = (scriptPath, scriptArguments, env) => createProgramJob([process.execPath, absolutePathOf(join('node_modules', scriptPath)), ...scriptArguments], env);

/**
 * Returns a job that runs cargo.
 *
 * @param {import('./toolchain.mjs').Rust} rust
 * @param {string[]} cargoArguments
 * @param {Record<string, string>} [moreEnvironment]
 */
const createCargoJob = ({ cargoDirectory, env: rustEnvironment }, cargoArguments, moreEnvironment) => createProgramJob([join(cargoDirectory, 'cargo'), ...cargoArguments], { ...rustEnvironment, ...moreEnvironment });

/**
 * Returns a job that runs rustfmt or clippy.
 *
 * @param {import('./toolchain.mjs').Rust} rustTools
 * @param {'fmt' | 'clippy'} lintName
 * @param {string[]} lintArguments
 */
async function createLintJob(rustTools, lintName, lintArguments) {
  await ensureLints(rustTools);
  return createProgramJob([join(rustTools.cargoDirectory, `cargo-${lintName}`), lintName, ...lintArguments], rustTools.env);
}

const LINT_RULES = ['--', '-D', 'warnings'];

/** Patterns of the numbers of tests in the output of each program. @satisfies {Record<string, Record<keyof Tally, RegExp>>} */
const COUNT_PATTERNS = {
  cargo: { passed: /^test result: .*?(\d+) passed/gm, failed: /^test result: .*?(\d+) failed/gm, skipped: /^test result: .*?(\d+) ignored/gm },
  node: { passed: /^# pass (\d+)$/gm, failed: /^# (?:fail|cancelled) (\d+)$/gm, skipped: /^# (?:skipped|todo) (\d+)$/gm },
  playwright: { passed: /^ +(\d+) passed/gm, failed: /^ +(\d+) (?:failed|interrupted|did not run)/gm, skipped: /^ +(\d+) skipped/gm },
};

/** @type {Record<string, Part>} */
const TEST_PARTS = {
  rustfmt: {
    prepare: async (programArgs) => createLintJob(await ensureRust(), 'fmt', ['--check', ...programArgs, '--', ...filesOf('scripts/bind/src'), 'fuzz/main.rs']),
  },
  oxlint: {
    async prepare(programArgs) {
      await ensurePackages('tests');
      return createNpmJob('oxlint/bin/oxlint', ['--deny-warnings', ...programArgs, '.']);
    },
  },
  build: {
    prepare: async () => () => ensureBuilt().then(() => ({ hasSucceeded: true, output: '', hasTimedOut: false })),
  },
  tsc: {
    async prepare(programArgs) {
      await ensureBuilt();
      // Only the nightly tier checks the types of tests/engines and tests/package, because only this tier has installed their packages.
      return createNpmJob('typescript/bin/tsc', ['-p', IS_NIGHTLY ? 'tests/types.json' : '.', ...programArgs]);
    },
  },
  clippy: {
    prepare: async (programArgs) => createLintJob(await ensureRust(), 'clippy', ['--locked', '--all-targets', ...programArgs, ...LINT_RULES]),
  },
  'clippy-wasm': {
    async prepare(programArgs) {
      const rustTools = await ensureWasmRust();
      // Clippy uses the profile of the tests, for which Cargo has compiled the procedural macros already.
      const cargoTestOptions = ['--locked', '--profile', 'web', '--lib', '--test', 'web', ...rustTools.target];
      return createLintJob(rustTools, 'clippy', [...cargoTestOptions, ...programArgs, ...LINT_RULES]);
    },
  },
  docs: {
    prepare: async (programArgs) => createCargoJob(await ensureRust(), ['doc', '--locked', '--no-deps', ...programArgs], { RUSTDOCFLAGS: '-D warnings' }),
  },
  rust: {
    async prepare(programArgs) {
      // The first compilation is not incremental, which would take 18 % more processor time.
      const env = existsSync(absolutePathOf('target/debug')) ? undefined : { CARGO_INCREMENTAL: '0' };
      return createCargoJob(await ensureRust(), ['test', '--locked', '--no-fail-fast', ...programArgs, ...(IS_NIGHTLY ? ['--', '--include-ignored'] : [])], env);
    },
    countPatterns: COUNT_PATTERNS.cargo,
  },
  wasm: {
    async prepare(programArgs) {
      const rustTools = await ensureWasmRust();
      const cargoTestOptions = ['--locked', '--profile', 'web', '--test', 'web', ...rustTools.target];
      return createCargoJob(rustTools, ['test', ...cargoTestOptions, ...programArgs], createBrowserEnvironment(await ensureTestRunner(), await ensureTestBrowser()));
    },
    countPatterns: COUNT_PATTERNS.cargo,
  },
  node: {
    prepare: (programArgs) => createNodeTestJob('tests/node', programArgs),
    countPatterns: COUNT_PATTERNS.node,
  },
  package: {
    prepare: async (programArgs) => createNodeTestJob('tests/package', programArgs, { CHROME: (await ensureTestBrowser()).chromePath }),
    countPatterns: COUNT_PATTERNS.node,
  },
  browser: {
    async prepare(programArgs) {
      await ensureBuilt();
      const grepOptions = IS_NIGHTLY ? [] : ['--grep-invert', '@nightly'];
      return createNpmJob('@playwright/test/cli.js', ['test', ...grepOptions, ...programArgs], { CHROME: (await ensureTestBrowser()).chromePath });
    },
    countPatterns: COUNT_PATTERNS.playwright,
  },
  // Only `npm run test:all` runs the parts in Firefox and WebKit, and in projects that embed the package.
  engines: { prepare: async () => createProgramJob([process.execPath, 'tests/engines/run.mjs']) },
  embeddings: { prepare: async () => createProgramJob([process.execPath, 'tests/embeddings/run.mjs']) },
};

/**
 * Parts of the test run, in lanes. Lanes run side by side, so that no processor core is idle while a linker, a download, a frame or a test
 * waits. Parts of a lane run one after the other. Cargo itself waits while a part of another lane uses Cargo's directory.
 */
const PART_LANES = [
  ['build', 'browser', ...(IS_NIGHTLY ? ['engines', 'embeddings'] : [])],
  ['rustfmt', 'rust', 'clippy', ...(IS_NIGHTLY ? ['docs'] : [])],
  ['wasm', ...(IS_NIGHTLY ? ['clippy-wasm'] : [])],
  ['oxlint', 'tsc', 'node', 'package'],
];

/** Runs a single part or all parts, and returns true if they pass. @param {string[]} cliArguments */
async function runParts(cliArguments) {
  const [partName, ...moreArguments] = cliArguments.filter((cliArgument) => cliArgument !== '--all');
  if (partName !== undefined && !Object.hasOwn(TEST_PARTS, partName)) {
    throw new UserError(`"${partName}" is no part of the tests: \`npm test -- PART\` takes ${Object.keys(TEST_PARTS).join(', ')}.`);
  }
  rmSync(absolutePathOf('test-results'), { recursive: true, force: true });
  mkdirSync(absolutePathOf('test-results'));
  if (partName !== undefined) return printSummary([await runPart(partName, moreArguments)]);

  // Installation starts before any part runs, because some lanes need the tools late. A part that needs a missing tool reports it.
  for (const ensureTool of [ensureTestBrowser, ensureTestRunner]) ensureTool().catch(() => {});
  /** @type {Outcome[]} */
  const partOutcomes = [];
  await Promise.all(
    PART_LANES.map(async (partNames) => {
      for (const partName of partNames) partOutcomes.push(await collectOutputOf(() => runPart(partName, [])));
    }),
  );
  return printSummary(partOutcomes);
}

/**
 * Runs a part.
 *
 * @param {string} partName
 * @param {string[]} programArgs
 * @returns {Promise<Outcome>}
 */
async function runPart(partName, programArgs) {
  const { prepare: prepareJob, countPatterns } = TEST_PARTS[partName];
  let startTime = Date.now();
  const getElapsedSeconds = () => (Date.now() - startTime) / 1000;
  try {
    const runJob = await prepareJob(programArgs);
    printStep(partName);
    startTime = Date.now();
    const { hasSucceeded, output: programOutput, hasTimedOut } = await runJob();
    const addUpMatches = (/** @type {RegExp} */ numberPattern) => [...programOutput.matchAll(numberPattern)].reduce((sumSoFar, [, matchedCount]) => sumSoFar + Number(matchedCount), 0);
    const testTally = countPatterns && { passed: addUpMatches(countPatterns.passed), failed: addUpMatches(countPatterns.failed), skipped: addUpMatches(countPatterns.skipped) };
    const hasRunNoTest = testTally !== undefined && testTally.passed + testTally.failed === 0;
    const outcomeNote = hasTimedOut ? `ended after ${TIME_LIMIT_SECONDS} s` : hasRunNoTest ? 'no test ran' : undefined;
    return { name: partName, hasSucceeded: hasSucceeded && !hasRunNoTest && !testTally?.failed, seconds: getElapsedSeconds(), output: programOutput, tally: testTally, note: outcomeNote };
  } catch (error) {
    printStep(`${partName}: ${error instanceof UserError ? error.message : (error instanceof Error && error.stack) || error}`);
    return { name: partName, hasSucceeded: false, seconds: getElapsedSeconds(), note: 'not run: see above' };
  }
}

/**
 * Returns the environment in which `cargo test` runs its WebAssembly tests in the browser.
 *
 * @param {string} runnerPath path of the program that runs the tests
 * @param {import('./browser.mjs').Browser} browser
 */
function createBrowserEnvironment(runnerPath, { chromePath, driverPath }) {
  const capabilitiesFile = absolutePathOf('test-results/webdriver.json');
  const chromeSettings = { binary: chromePath, args: ['--headless', ...CHROME_ARGUMENTS] };
  writeFileSync(capabilitiesFile, JSON.stringify({ 'goog:chromeOptions': chromeSettings }));
  return {
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER: runnerPath,
    CHROMEDRIVER: driverPath,
    WASM_BINDGEN_TEST_WEBDRIVER_JSON: capabilitiesFile,
    // Time limit in seconds for all tests of a file. The runner's own limit of 20 s is too short on a busy machine.
    WASM_BINDGEN_TEST_TIMEOUT: '180',
  };
}

/**
 * Returns a job that runs the tests of a directory, or only named files of the directory.
 *
 * @param {string} testDirectory
 * @param {string[]} programArgs files or options
 * @param {Record<string, string>} [env]
 */
async function createNodeTestJob(testDirectory, programArgs, env) {
  const testFiles = filesOf(testDirectory).filter((filePath) => /\.test\.[jt]s$/.test(filePath) && (IS_NIGHTLY || !filePath.endsWith('.nightly.test.js')));
  const namedFiles = testFiles.filter((filePath) => programArgs.some((programArgument) => !programArgument.startsWith('-') && filePath.includes(programArgument)));
  const unknownName = programArgs.find((programArgument, i) => !programArgument.startsWith('-') && !programArgs[i - 1]?.startsWith('-') && !testFiles.some((filePath) => filePath.includes(programArgument)));
  if (unknownName !== undefined) throw new UserError(`"${unknownName}" is in no name of a test file; ${testDirectory} has ${testFiles.map((filePath) => filePath.slice(testDirectory.length + 1)).join(', ')}.`);
  const nodeOptions = programArgs.filter((programArgument) => !namedFiles.some((filePath) => filePath.includes(programArgument)));
  // Node runs a test if the name of the test or of a parent matches. The root of all tests is named "<root>", and must not match.
  const grepOptions = IS_NIGHTLY ? [] : ['--test-name-pattern', '/^(?!<root>|.*@nightly)/'];
  await ensureBuilt();
  // Node's default number of processes would leave a processor core idle.
  return createProgramJob([process.execPath, '--import', 'tsx', '--test', '--test-reporter', 'tap', '--test-concurrency', `${availableParallelism()}`, ...grepOptions, ...nodeOptions, ...(namedFiles.length > 0 ? namedFiles : testFiles)], env);
}

/** Number of last lines of a failed program's output that are shown again below the summary, because they contain the errors. */
const SHOWN_ERROR_LINES = 60;

/** Prints the outcomes, and returns true if all parts passed. @param {Outcome[]} partOutcomes */
function printSummary(partOutcomes) {
  printStep('Summary');
  console.log(`${[...toolVersions].join('; ')}\n`);
  let passedCount = 0;
  let failedCount = 0;
  for (const { name, hasSucceeded, seconds, tally: testTally, note: outcomeNote } of partOutcomes) {
    const testCountTexts = testTally === undefined ? [] : [`${testTally.passed} passed`, `${testTally.failed} failed`];
    if (testTally?.skipped) testCountTexts.push(`${testTally.skipped} skipped`);
    if (outcomeNote !== undefined) testCountTexts.push(outcomeNote);
    console.log(`${hasSucceeded ? 'ok    ' : 'FAILED'} ${name.padEnd(12)} ${seconds.toFixed(0).padStart(4)} s  ${testCountTexts.join(', ')}`);
    passedCount += testTally?.passed ?? 0;
    // A part that fails without a failed test is counted as one failed test.
    failedCount += hasSucceeded ? 0 : Math.max(1, testTally?.failed ?? 0);
  }
  for (const { name, hasSucceeded, output: programOutput } of partOutcomes) {
    if (!hasSucceeded && programOutput && partOutcomes.length > 1) console.log(`\n${name}: …\n${programOutput.trimEnd().split('\n').slice(-SHOWN_ERROR_LINES).join('\n')}`);
  }
  console.log(`\n${passedCount} passed, ${failedCount} failed`);
  return failedCount === 0;
}

await runAsScript(import.meta.url, async () => {
  if (!(await runParts(process.argv.slice(2)))) process.exitCode = 1;
});
