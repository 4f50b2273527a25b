// `npm run test:mutants:figure -- SEED COUNT`: whether the browser tests notice when www/figure is wrong. A mutant is the
// figure with one small change; all that Stryker's instrumenter makes are compiled into one build, where one at a time is
// active, and COUNT of them, drawn at random, meet the tests.
//
// On the build without a mutant the tests run once, to learn which mutants each of them reaches and how long it takes. A
// mutant then meets those that reach it, until one of them fails. One that no test reaches is not caught, nor one that
// outlives the tests of all ROUNDS. Each processor has a copy of its own, with its part of the tests and of the mutants.

import { appendFileSync, cpSync, mkdirSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { Instrumenter } from '@stryker-mutator/instrumenter';
import { ensureBrowser } from '../../scripts/browser.mjs';
import { build } from '../../scripts/build.mjs';
import { filesOf } from '../../scripts/bundle.mjs';
import { wilson } from '../../scripts/mutants.mjs';
import { Missing, ROOT, progress, run, runAsScript } from '../../scripts/process.mjs';
import { serve } from '../../scripts/serve.mjs';
import { generator } from '../random.js';

/**
 * @typedef {{ id: string, fileName: string, mutatorName: string, replacement: string, location: { start: { line: number, column: number } } }} Mutant
 * @typedef {{ test: string, milliseconds: number, passed: boolean, reached: Set<string> }} Trial of a test, without a mutant
 */

const COPIES = Array.from({ length: availableParallelism() }, (_, i) => join(ROOT, `build/mutants-figure-${i + 1}`));
const inCopy = (/** @type {string} */ path) => join(COPIES[0], path);

/** What a bundle and the tests read, besides what is in build/ itself. */
const COPIED = ['www', 'scripts', 'python', 'examples', 'doc', 'src', 'tests', 'package.json', 'package-lock.json', 'playwright.config.js'];

/** Where tests/mutants/playwright.js puts the number of a mutant. */
const PLACE = '@mutant@';

/** How many tests a mutant has met at most after each round: most are caught by the first. */
const ROUNDS = [4, 12, 24];

/** The least share that the tests have to notice. */
const NOTICED = 0.95;

/** What instrumented scripts import: which mutant is active, and who is told of those that are reached. */
const SWITCH = `export const stryMutAct_9fa48 = (id) => id === '${PLACE}';
export const stryCov_9fa48 = (...ids) => globalThis.reachedMutants?.(ids);
`;

/**
 * Builds the copy, with all mutants in it.
 *
 * @returns {Promise<Mutant[]>}
 */
async function prepare() {
  await build();
  progress('Building a copy with every mutant in it');
  for (const copy of COPIES) rmSync(copy, { recursive: true, force: true });
  mkdirSync(COPIES[0], { recursive: true });
  for (const path of COPIED) cpSync(join(ROOT, path), inCopy(path), { recursive: true });
  mkdirSync(inCopy('build'));
  for (const path of readdirSync(join(ROOT, 'build'), { withFileTypes: true })) {
    if (path.isFile()) cpSync(join(ROOT, 'build', path.name), inCopy(`build/${path.name}`));
  }
  symlinkSync(join(ROOT, 'node_modules'), inCopy('node_modules'));

  const silent = { isDebugEnabled: () => false, debug() {}, info() {} };
  const files = filesOf('www/figure').filter((path) => path.endsWith('.js'));
  const sources = files.map((name) => ({ name, mutate: true, content: readFileSync(join(ROOT, name), 'utf8') }));
  // All mutators, and no header, for scripts of one page share it.
  const options = { plugins: null, excludedMutations: [], ignorers: [], noHeader: true };
  const instrumented = await new Instrumenter(/** @type {any} */ (silent)).instrument(sources, options);
  writeFileSync(inCopy('www/switch.js'), SWITCH);
  const contents = new Map(instrumented.files.map(({ name, content }) => [inCopy(name), content]));
  const { bundle } = await import(inCopy('scripts/bundle.mjs'));
  await bundle((/** @type {string} */ path, /** @type {string} */ script) =>
    contents.has(path) ? `import { stryCov_9fa48, stryMutAct_9fa48 } from '${inCopy('www/switch.js')}';\n${contents.get(path)}` : script,
  );
  cpSync(inCopy('dist'), inCopy('dist-with-all'), { recursive: true });

  for (const path of readdirSync(inCopy('tests/e2e'))) {
    const specs = readFileSync(inCopy(`tests/e2e/${path}`), 'utf8');
    writeFileSync(inCopy(`tests/e2e/${path}`), specs.replace(/(import \{.*\} from) '@playwright\/test'/, "$1 '../mutants/playwright.js'"));
  }
  for (const copy of COPIES.slice(1)) cpSync(COPIES[0], copy, { recursive: true, verbatimSymlinks: true });
  return /** @type {any} */ (instrumented.mutants);
}

/**
 * A sample in a random order that a seed decides.
 *
 * @template T
 * @param {T[]} all
 * @param {number} count
 * @param {number} seed
 */
function sampleOf(all, count, seed) {
  const random = generator(seed);
  const rest = [...all];
  return Array.from({ length: Math.min(count, all.length) }, () => rest.splice(Math.floor(random() * rest.length), 1)[0]);
}

/**
 * Runs tests of a copy, which note in a file what they find.
 *
 * @param {string} copy
 * @param {string} notes
 * @param {{ plan?: string, options?: string[] }} which the file that has the mutants of each test; what else says which tests
 * @returns {Promise<any[]>} what they noted
 */
async function noted(copy, notes, { plan = '', options = [] }) {
  const { chrome } = await ensureBrowser();
  const { address, close } = await serve(join(copy, 'dist'));
  appendFileSync(notes, '');
  const command = ['test', '--config', join(copy, 'tests/mutants/playwright.config.js'), '--workers', '1', '--reporter', 'dot', ...options];
  try {
    await run(process.execPath, [join(ROOT, 'node_modules/@playwright/test/cli.js'), ...command], {
      env: { CHROME: chrome, SERVED_AT: address, MUTANTS_NOTES: notes, MUTANTS_PLAN: plan, MUTANTS_PLACE: PLACE },
    });
  } finally {
    close();
  }
  return linesOf(notes);
}

/** @param {string} path @returns {any[]} */
const linesOf = (path) => readFileSync(path, 'utf8').split('\n').filter(Boolean).map((line) => JSON.parse(line));

/**
 * The tests that reach a mutant, the most promising first: those that are quick, and reach what few others do around it,
 * for that is what they are about.
 *
 * @param {Mutant} mutant
 * @param {Mutant[]} mutants
 * @param {Trial[]} trials
 */
function testsOf({ id, fileName }, mutants, trials) {
  const rarity = (/** @type {Mutant} */ { id: other }) =>
    Math.log(trials.length / trials.filter(({ reached }) => reached.has(other)).length) / (1 + Math.abs(Number(other) - Number(id)) / 3);
  const around = mutants
    .filter((other) => other.fileName === fileName && Math.abs(Number(other.id) - Number(id)) <= 10)
    .map((other) => ({ id: other.id, weight: rarity(other) }));
  const promise = (/** @type {Trial} */ { reached, milliseconds }) =>
    (0.5 + around.reduce((sum, other) => sum + (reached.has(other.id) ? other.weight : 0), 0)) / (1000 + milliseconds);
  return trials
    .filter(({ passed, reached }) => passed && reached.has(id))
    .sort((a, b) => promise(b) - promise(a))
    .map(({ test, milliseconds }) => ({ test, milliseconds }));
}

const percent = (/** @type {number} */ share) => `${(100 * share).toFixed(1)} %`;

/**
 * @param {string} copy
 * @param {Mutant[]} sample
 * @param {Mutant[]} mutants
 * @param {Trial[]} trials
 * @returns {Promise<Map<string, string>>} tests by the mutants that they caught
 */
async function meet(copy, sample, mutants, trials) {
  const caught = new Map();
  const tests = new Map(sample.map((mutant) => [mutant, testsOf(mutant, mutants, trials)]));
  for (const [round, most] of ROUNDS.entries()) {
    const left = sample.filter(({ id }) => !caught.has(id));
    /** @type {Record<string, { milliseconds: number, mutants: string[] }>} */
    const plan = {};
    for (const mutant of left) {
      for (const { test, milliseconds } of tests.get(mutant)?.slice(ROUNDS[round - 1] ?? 0, most) ?? []) {
        (plan[test] ??= { milliseconds, mutants: [] }).mutants.push(mutant.id);
      }
    }
    if (Object.keys(plan).length === 0) break;
    progress(`${left.length} mutants meet ${most} tests`);
    const file = join(copy, 'plan');
    writeFileSync(file, JSON.stringify(plan));
    for (const each of await noted(copy, join(copy, 'caught'), { plan: file })) caught.set(each.caught, each.test);
  }
  return caught;
}

/** @param {string[]} args */
async function figure([seed = '1', amount = '300']) {
  const [start, count] = [seed, amount].map(Number);
  if (![start, count].every((number) => Number.isInteger(number) && number > 0)) {
    throw new Missing(`SEED and COUNT are "${seed}" and "${amount}", and have to be whole numbers from 1.`);
  }
  const mutants = await prepare();
  progress('Running the tests without a mutant');
  const shards = COPIES.map((copy, i) => noted(copy, join(copy, 'reached'), { options: ['--shard', `${i + 1}/${COPIES.length}`] }));
  const trials = (await Promise.all(shards)).flat().map((trial) => ({ ...trial, reached: new Set(trial.reached) }));
  const passed = trials.filter((trial) => trial.passed).length;
  if (passed === 0) throw new Missing('No test passes on the build without a mutant: see above.');
  progress(`${passed} of ${trials.length} tests pass`);
  const sample = sampleOf(mutants, count, start);
  const parts = COPIES.map((copy, i) => meet(copy, sample.filter((_, j) => j % COPIES.length === i), mutants, trials));
  const caught = new Map((await Promise.all(parts)).flatMap((part) => [...part]));
  progress('Not caught');
  for (const { id, fileName, location, mutatorName, replacement } of sample.filter(({ id }) => !caught.has(id))) {
    const reaching = trials.filter(({ reached }) => reached.has(id)).length;
    // Lines are counted from 0.
    console.log(`${fileName}:${location.start.line + 1}:${location.start.column + 1} ${mutatorName} ${replacement} (reached by ${reaching} tests)`);
  }
  const share = caught.size / sample.length;
  const [least, most] = wilson(caught.size, sample.length).map(percent);
  progress(`${caught.size} of ${sample.length} caught, out of ${mutants.length} (seed ${start}): ${percent(share)}, 95 % interval ${least} to ${most}`);
  if (share < NOTICED) process.exitCode = 1;
}

await runAsScript(import.meta.url, () => figure(process.argv.slice(2)));
