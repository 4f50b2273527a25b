// `npm run test:mutants:figure -- SEED COUNT`: whether the browser tests notice when www/figure is wrong. A mutant is the
// figure with one small change; all that Stryker's instrumenter makes are compiled into one build, where those are active that
// a page names, and COUNT of them, drawn at random, meet the tests.
//
// On the build without a mutant the tests run once, to learn which mutants each of them reaches and how long it takes; that is
// kept for as long as the sources and the tests are the same. A mutant then meets those that reach it, the most promising
// first, until one notices it: it fails, passes without the mutant, and fails with it again. A test that twice fails without
// one tells nothing. Mutants that outlive the first round meet further tests several at a time: where a test passes with all of
// them, it is taken to pass with each. One that no test reaches is not caught, nor one that outlives all rounds. What became of
// each is in build/mutants-figure/results.json.

import { createHash } from 'node:crypto';
import { appendFileSync, cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { basename, join } from 'node:path';
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
 * @typedef {Record<string, { milliseconds: number, runs: string[][] }>} Plan the mutants that are active in each run of a test
 */

const PROCESSES = Array.from({ length: availableParallelism() }, (_, i) => i + 1);

const OUTPUT = join(ROOT, 'build/mutants-figure');
const COPY = join(OUTPUT, 'copy');
const inCopy = (/** @type {string} */ path) => join(COPY, path);

/** What a bundle and the tests read, besides what is in build/ itself. */
const COPIED = ['www', 'scripts', 'python', 'examples', 'doc', 'src', 'tests', 'package.json', 'package-lock.json', 'playwright.config.js'];

/** How many tests each mutant meets by itself first. */
const FIRST = 4;

/** How many tests the mutants that are left meet in each round after that, several of them at a time. */
const ROUNDS = [
  { count: 10, together: 3 },
  { count: 30, together: 5 },
  { count: 100, together: 8 },
  { count: Infinity, together: 12 },
];

/** Tests of much on one page, line for line, which notice most: they come first. */
const DENSE = /^figure-/;

/** Tests that take longer without a mutant, milliseconds, meet none after the first round. */
const LONG = 20_000;

/** The least share that the tests have to notice. */
const NOTICED = 0.95;

/** What instrumented scripts import: which mutants are active, and who is told of those that are reached. */
const SWITCH = `const active = new Set(globalThis.activeMutants);
export const stryMutAct_9fa48 = (id) => active.has(id);
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
  rmSync(COPY, { recursive: true, force: true });
  mkdirSync(COPY, { recursive: true });
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
  await bundle({ changed: (/** @type {string} */ path, /** @type {string} */ script) =>
    contents.has(path) ? `import { stryCov_9fa48, stryMutAct_9fa48 } from '${inCopy('www/switch.js')}';\n${contents.get(path)}` : script,
  });

  for (const path of readdirSync(inCopy('tests/e2e'))) {
    const specs = readFileSync(inCopy(`tests/e2e/${path}`), 'utf8');
    writeFileSync(inCopy(`tests/e2e/${path}`), specs.replace(/(import \{.*\} from) '@playwright\/test'/, "$1 '../mutants/playwright.js'"));
  }
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
 * Runs tests, which note in a file what they find.
 *
 * @param {string} notes
 * @param {{ plan?: string, options?: string[] }} which the file that has the mutants of each test; what else says which tests
 * @returns {Promise<any[]>} what they noted
 */
async function noted(notes, { plan = '', options = [] }) {
  const { chrome } = await ensureBrowser();
  const { address, close } = await serve(inCopy('dist'));
  writeFileSync(notes, '');
  const command = ['test', '--config', inCopy('tests/mutants/playwright.config.js'), '--workers', '1', '--reporter', 'dot', ...options];
  try {
    await run(process.execPath, [join(ROOT, 'node_modules/@playwright/test/cli.js'), ...command, '--output', `${notes}-results`], {
      env: { CHROME: chrome, SERVED_AT: address, MUTANTS_NOTES: notes, MUTANTS_PLAN: plan },
    });
  } finally {
    close();
  }
  return linesOf(notes);
}

/** @param {string} path @returns {any[]} */
const linesOf = (path) => readFileSync(path, 'utf8').split('\n').filter(Boolean).map((line) => JSON.parse(line));

/** What the tests reach, learnt of the files of tests that are not known. @returns {Promise<Trial[]>} */
async function learn() {
  const files = filesOf('tests/e2e');
  const isSpec = (/** @type {string} */ path) => path.endsWith('.spec.js');
  const shared = digestOf(['www', 'src', 'package-lock.json'].flatMap(filesOf).concat(files.filter((path) => !isSpec(path))));
  const known = new Map(files.filter(isSpec).map((path) => {
    const name = basename(path, '.spec.js');
    return [name, join(OUTPUT, `reached-${name}-${digestOf([path], shared).slice(0, 16)}`)];
  }));
  const unknown = [...known].filter(([, file]) => !existsSync(file));
  if (unknown.length > 0) {
    progress('Running tests without a mutant');
    const patterns = unknown.map(([name]) => `/${name}\\.spec\\.js`);
    const shards = PROCESSES.map((i) => noted(join(OUTPUT, `reached-${i}`), { options: [...patterns, '--shard', `${i}/${PROCESSES.length}`] }));
    const lines = (await Promise.all(shards)).flat();
    if (lines.every(({ passed }) => !passed)) throw new Missing('No test passes on the build without a mutant: see above.');
    for (const [name, file] of unknown) {
      const own = lines.filter(({ test }) => test.startsWith(`${name} › `));
      writeFileSync(file, own.map((line) => `${JSON.stringify(line)}\n`).join(''));
    }
  }
  return [...known.values()].flatMap(linesOf).map((trial) => ({ ...trial, reached: new Set(trial.reached) }));
}

/**
 * @param {string[]} paths
 * @param {string} [seed]
 */
function digestOf(paths, seed = '') {
  const hash = createHash('sha256').update(seed);
  for (const path of paths) hash.update(`\0${path}\0`).update(readFileSync(join(ROOT, path)));
  return hash.digest('hex');
}

/**
 * Who meets whom: the mutants of a process, and what is known of the tests.
 */
class Meeting {
  /** Tests by the mutants that they caught. @type {Map<string, string>} */
  caught = new Map();
  /** The tests that each mutant has met. @type {Map<string, Set<string>>} */
  #met = new Map();
  /** How promising each test is for each mutant, before any was met. @type {Map<string, Map<string, number>>} */
  #promise;
  /** Of each test, how many mutants it has met by itself and how many of them it has caught. @type {Map<string, { met: number, caught: number }>} */
  #record = new Map();
  /** Tests that failed without a mutant too. @type {Set<string>} */
  #unsound = new Set();
  /** Tests that did so once, and passed in a browser of their own. @type {Set<string>} */
  #doubtful = new Set();
  #process;
  #sample;
  #trials;

  /**
   * @param {number} process its number
   * @param {Mutant[]} sample
   * @param {Mutant[]} mutants
   * @param {Trial[]} trials
   */
  constructor(process, sample, mutants, trials) {
    this.#process = process;
    this.#sample = sample;
    this.#trials = new Map(trials.map((trial) => [trial.test, trial]));
    this.#promise = new Map(sample.map((mutant) => [mutant.id, promises(mutant, mutants, trials)]));
    for (const { id } of sample) this.#met.set(id, new Set());
  }

  get #left() {
    return this.#sample.map(({ id }) => id).filter((id) => !this.caught.has(id));
  }

  /** @returns {Promise<Map<string, string>>} */
  async all() {
    progress(`${this.#left.length} mutants meet ${FIRST} tests each`);
    await this.#meet(this.#ownTests(), 1);
    for (const { count, together } of ROUNDS) {
      if (this.#left.length === 0) break;
      progress(`${this.#left.length} mutants meet ${count === Infinity ? 'all other' : count} tests, ${together} at a time`);
      await this.#meet(this.#sharedTests(count), together);
    }
    return this.caught;
  }

  /**
   * @param {Map<string, string[]>} next the mutants that each test meets
   * @param {number} together how many at a time
   */
  async #meet(next, together) {
    const failed = await this.#run(new Map([...next].map(([test, ids]) => [test, inGroups(ids, together)])));
    // Which of them it was.
    /** @type {Map<string, string[][]>} */
    const suspects = new Map();
    for (const { test, ids } of failed) suspects.set(test, [...(suspects.get(test) ?? []), ...ids.map((id) => [id])]);
    if (suspects.size > 0) await this.#run(suspects);
  }

  /** The most promising tests of each mutant, with the mutants that meet them. */
  #ownTests() {
    /** @type {Map<string, string[]>} */
    const next = new Map();
    for (const id of this.#left) {
      const tests = [...this.#promises(id)].sort(([, a], [, b]) => b - a).slice(0, FIRST);
      for (const [test] of tests) next.set(test, [...(next.get(test) ?? []), id]);
    }
    return next;
  }

  /**
   * The tests that are most promising for all mutants together that are left and have not met them, with these.
   *
   * @param {number} count
   */
  #sharedTests(count) {
    /** @type {Map<string, { ids: string[], promise: number }>} */
    const tests = new Map();
    for (const id of this.#left) {
      for (const [test, promise] of this.#promises(id)) {
        const { milliseconds } = /** @type {Trial} */ (this.#trials.get(test));
        if (this.#met.get(id)?.has(test) || this.#unsound.has(test) || milliseconds > LONG) continue;
        const { ids, promise: others } = tests.get(test) ?? { ids: [], promise: 0 };
        tests.set(test, { ids: [...ids, id], promise: others + promise * this.#success(test) });
      }
    }
    const chosen = [...tests].sort(([, a], [, b]) => b.promise - a.promise).slice(0, count);
    return new Map(chosen.map(([test, { ids }]) => [test, ids]));
  }

  /** @param {string} id of a mutant */
  #promises(id) {
    return /** @type {Map<string, number>} */ (this.#promise.get(id));
  }

  /** The share of mutants that a test has caught so far, as of ten more of which it caught one. @param {string} test */
  #success(test) {
    const { met, caught } = this.#record.get(test) ?? { met: 0, caught: 0 };
    return (caught + 1) / (met + 10);
  }

  /**
   * @param {Map<string, string[][]>} runs of each test
   * @returns {Promise<{ test: string, ids: string[] }[]>} those of several mutants that failed
   */
  async #run(runs) {
    /** @type {Plan} */
    const plan = {};
    for (const [test, ids] of runs) plan[test] = { milliseconds: /** @type {Trial} */ (this.#trials.get(test)).milliseconds, runs: ids };
    const file = join(OUTPUT, `plan-${this.#process}`);
    writeFileSync(file, JSON.stringify(plan));
    const notes = await noted(join(OUTPUT, `notes-${this.#process}`), { plan: file });
    appendFileSync(join(OUTPUT, 'all-notes'), notes.map((note) => `${JSON.stringify(note)}\n`).join(''));
    for (const { kind, test, ids } of notes) {
      if (kind === 'caught') this.caught.set(ids[0], test);
      if (kind === 'unsound' || (kind === 'doubtful' && this.#doubtful.has(test))) this.#unsound.add(test);
      if (kind === 'doubtful') this.#doubtful.add(test);
    }
    // What fails now and then tells nothing, nor has it before.
    for (const [id, test] of this.caught) if (this.#unsound.has(test)) this.caught.delete(id);
    for (const [test, groups] of runs) {
      for (const id of groups.flat()) this.#met.get(id)?.add(test);
      const alone = groups.filter(({ length }) => length === 1).length;
      const { met, caught } = this.#record.get(test) ?? { met: 0, caught: 0 };
      const more = notes.filter((note) => note.kind === 'caught' && note.test === test).length;
      this.#record.set(test, { met: met + alone, caught: caught + more });
    }
    return notes.filter(({ kind, ids }) => kind === 'failed' && ids.length > 1);
  }
}

/**
 * How promising the tests are that reach a mutant: those of much on one page, those that are quick, and those that reach what
 * few others do around it, for that is what they are about.
 *
 * @param {Mutant} mutant
 * @param {Mutant[]} mutants
 * @param {Trial[]} trials
 * @returns {Map<string, number>}
 */
function promises({ id, fileName }, mutants, trials) {
  const rarity = (/** @type {Mutant} */ { id: other }) =>
    Math.log(trials.length / trials.filter(({ reached }) => reached.has(other)).length) / (1 + Math.abs(Number(other) - Number(id)) / 3);
  const around = mutants
    .filter((other) => other.fileName === fileName && Math.abs(Number(other.id) - Number(id)) <= 10)
    .map((other) => ({ id: other.id, weight: rarity(other) }));
  const promise = (/** @type {Trial} */ { test, reached, milliseconds }) =>
    (DENSE.test(test) ? 20 : 1) * (0.5 + around.reduce((sum, other) => sum + (reached.has(other.id) ? other.weight : 0), 0)) / (1000 + milliseconds);
  return new Map(trials.filter(({ passed, reached }) => passed && reached.has(id)).map((trial) => [trial.test, promise(trial)]));
}

/** @param {string[]} ids @param {number} size */
function inGroups(ids, size) {
  const count = Math.ceil(ids.length / size);
  // Those of neighbouring lines apart: what stops one is likely to hide the other.
  return Array.from({ length: count }, (_, i) => ids.filter((_, j) => j % count === i));
}

const percent = (/** @type {number} */ share) => `${(100 * share).toFixed(1)} %`;

/** @param {string[]} args */
async function figure([seed = '1', amount = '300']) {
  const [start, count] = [seed, amount].map(Number);
  if (![start, count].every((number) => Number.isInteger(number) && number > 0)) {
    throw new Missing(`SEED and COUNT are "${seed}" and "${amount}", and have to be whole numbers from 1.`);
  }
  const mutants = await prepare();
  const trials = await learn();
  progress(`${trials.filter((trial) => trial.passed).length} of ${trials.length} tests pass`);
  rmSync(join(OUTPUT, 'all-notes'), { force: true });
  const sample = sampleOf(mutants, count, start);
  const parts = PROCESSES.map((i) => new Meeting(i, sample.filter((_, j) => j % PROCESSES.length === i - 1), mutants, trials).all());
  const caught = new Map((await Promise.all(parts)).flatMap((part) => [...part]));
  const outcomes = sample.map(({ id, fileName, location, mutatorName, replacement }) => {
    const reaching = trials.filter(({ reached }) => reached.has(id)).length;
    // Lines are counted from 0.
    const name = `${fileName}:${location.start.line + 1}:${location.start.column + 1} ${mutatorName} ${replacement}`;
    return { id, name, reaching, by: caught.get(id) };
  });
  writeFileSync(join(OUTPUT, 'results.json'), `${JSON.stringify({ seed: start, outcomes }, null, 2)}\n`);
  progress('Not caught');
  for (const { name, reaching, by } of outcomes) if (by === undefined) console.log(`${name} (reached by ${reaching} tests)`);
  const share = caught.size / sample.length;
  const [least, most] = wilson(caught.size, sample.length).map(percent);
  progress(`${caught.size} of ${sample.length} caught, out of ${mutants.length} (seed ${start}): ${percent(share)}, 95 % interval ${least} to ${most}`);
  if (share < NOTICED) process.exitCode = 1;
}

await runAsScript(import.meta.url, () => figure(process.argv.slice(2)));
