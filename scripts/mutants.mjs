// `npm run test:mutants -- SEED COUNT`: whether the native tests notice when the program is wrong. A mutant is the program
// with one small change, and cargo-mutants lists them all; COUNT of them, drawn at random, meet the tests. What became of
// each is in build/mutants/results.json.

import { createHash } from 'node:crypto';
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { basename, dirname, join } from 'node:path';
import { Missing, ROOT, findProgram, progress, run, runAsScript } from './process.mjs';
import { CHOSEN, TELL, mutated, writeSchemata } from './schemata.mjs';
import { nativeRust } from './toolchain.mjs';

/** @typedef {import('./schemata.mjs').Mutant} Mutant */
/** @typedef {{ program: string, name: string, seconds: number, reached: Set<number> }} Test */
/** @typedef {{ name: string, by?: string, how?: string }} Outcome of a mutant: by which test it was caught, if it was */

const OUTPUT = join(ROOT, 'build/mutants');
const COPY = join(OUTPUT, 'copy');

/** The least share of them that the tests have to notice. */
const NOTICED = 0.95;

/** Two-sided, 95 % of a normal distribution. */
const Z = 1.96;

/**
 * Seconds of a processor that a test may take beyond twenty times what it takes without a mutant. What uses them up is a loop
 * without end.
 */
const PATIENCE = 10;

/** Kilobytes of addresses: a loop that collects without end is to fail before it takes the machine's memory. */
const ADDRESSES = 8e6;

const cargo = async (/** @type {string[]} */ args, /** @type {string} */ cwd) => {
  const { bin, env } = await nativeRust();
  return run(join(bin, 'cargo'), args, { env: { ...env, CARGO_TARGET_DIR: join(OUTPUT, 'target') }, cwd, quiet: true });
};

/** @param {string[]} args */
async function mutants([seed = '1', amount = '300']) {
  const count = Number(amount);
  if (!Number.isInteger(count) || count < 1) throw new Missing(`COUNT is "${amount}", and has to be a whole number from 1.`);
  const all = inOrderOf(seed, await list());
  const { stdout } = await run('git', ['describe', '--always', '--dirty'], { quiet: true });
  const sample = `${count} of ${all.length} mutants of ${stdout.trim()}`;
  progress(`${sample}, seed "${seed}"`);
  const { together, bodies, alone, unviable } = await compileSample(all, count);
  const outcomes = await meetTests(together, bodies, alone);
  const results = { sample, seed, outcomes, unviable: unviable.map(({ name }) => name) };
  writeFileSync(join(OUTPUT, 'results.json'), `${JSON.stringify(results, null, 2)}\n`);
  return report(outcomes, unviable.length);
}

/** @returns {Promise<Mutant[]>} */
async function list() {
  const { bin } = await nativeRust();
  const sentence = 'cargo-mutants lists no mutants: run `cargo install --locked cargo-mutants` and start again.';
  if (findProgram('cargo-mutants', [bin]) === undefined) throw new Missing(sentence);
  const listed = await cargo(['mutants', '--list', '--json'], ROOT);
  if (!listed.ok) throw new Missing(sentence);
  return JSON.parse(listed.stdout);
}

/**
 * In an order that is random, and the same for a seed: that of their digests.
 *
 * @param {string} seed
 * @param {Mutant[]} mutants
 */
export function inOrderOf(seed, mutants) {
  const key = (/** @type {Mutant} */ { name }) => createHash('sha256').update(`${seed} ${name}`).digest('hex');
  return mutants
    .map((mutant) => ({ mutant, key: key(mutant) }))
    .sort((a, b) => (a.key < b.key ? -1 : 1))
    .map(({ mutant }) => mutant);
}

/**
 * Draws the first mutants that compile: one that does not gives its place to the next.
 *
 * @param {Mutant[]} all
 * @param {number} count
 */
async function compileSample(all, count) {
  /** @type {Map<number, Mutant>} */
  let together = new Map();
  /** @type {Map<number, number>} */
  let bodies = new Map();
  /** @type {Mutant[]} */
  const alone = [];
  /** @type {Mutant[]} */
  const unviable = [];
  for (let next = 0; together.size + alone.length < count && next < all.length; ) {
    const more = all.slice(next, next + count - together.size - alone.length);
    const numbers = more.map((mutant, i) => /** @type {const} */ ([next + i + 1, mutant]));
    next += more.length;
    const compiled = await compileTogether(new Map([...together, ...numbers]));
    ({ together, bodies } = compiled);
    unviable.push(...compiled.unviable);
    for (const mutant of compiled.left) {
      await copyWith(mutant);
      const { ok } = await cargo(['check', '--lib'], COPY);
      (ok ? alone : unviable).push(mutant);
    }
  }
  await freshCopy();
  writeSchemata(COPY, together);
  return { together, bodies, alone, unviable };
}

/**
 * @param {Map<number, Mutant>} together those in the copy
 * @param {Map<number, number>} bodies
 * @param {Mutant[]} alone
 */
async function meetTests(together, bodies, alone) {
  /** @type {Outcome[]} */
  const outcomes = [];
  const tell = (/** @type {Outcome} */ outcome) => {
    outcomes.push(outcome);
    const { name, by, how = '' } = outcome;
    console.log(`${by === undefined ? 'MISSED' : 'caught'} ${name}  ${by ?? ''} ${how}`);
  };
  const tests = await readTests();
  await onAllCores([...together], async ([number, { name }]) => {
    const body = /** @type {number} */ (bodies.get(number));
    tell({ name, ...(await meeting(tests.filter(({ reached }) => reached.has(body)), `${number}`)) });
  });
  for (const mutant of alone) {
    await copyWith(mutant);
    await programs();
    tell({ name: mutant.name, ...(await meeting(tests, '0')) });
  }
  return outcomes;
}

/** @param {Mutant} mutant */
async function copyWith(mutant) {
  await freshCopy();
  const path = join(COPY, mutant.file);
  writeFileSync(path, mutated(readFileSync(path, 'utf8'), mutant));
}

/** The repository's files as they are. */
async function freshCopy() {
  const { stdout } = await run('git', ['ls-files', '--cached', '--others', '--exclude-standard'], { quiet: true });
  rmSync(COPY, { recursive: true, force: true });
  for (const path of stdout.trim().split('\n')) {
    mkdirSync(dirname(join(COPY, path)), { recursive: true });
    copyFileSync(join(ROOT, path), join(COPY, path));
  }
}

/**
 * Compiles mutants into one program.
 *
 * @param {Map<number, Mutant>} mutants
 * @returns {Promise<{ together: Map<number, Mutant>, bodies: Map<number, number>, left: Mutant[], unviable: Mutant[] }>}
 *   those in the program, the numbers of the bodies that they are in, those that are to be compiled alone, and those whose
 *   own text is wrong
 */
async function compileTogether(mutants) {
  const together = new Map(mutants);
  /** @type {[Mutant[], Mutant[]]} */
  const [left, unviable] = [[], []];
  for (;;) {
    await freshCopy();
    const { parts, bodies, outside } = writeSchemata(COPY, together);
    const { ok, stdout } = await cargo(['check', '--lib', '--message-format', 'json'], COPY);
    const wrong = new Map(outside.map((number) => [number, left]));
    for (const { reason, message } of messages(stdout)) {
      if (reason !== 'compiler-message' || message.level !== 'error') continue;
      for (const { file_name: file, line_start: line, is_primary: primary } of message.spans) {
        if (!primary) continue;
        const part = parts.find(({ file: other, lines: [from, to] }) => other === file && from <= line && line <= to);
        if (part?.number !== undefined) wrong.set(part.number, unviable);
        else for (const [number, body] of bodies) if (body === part?.body) wrong.set(number, left);
      }
    }
    if (ok && wrong.size === 0) return { together, bodies, left, unviable };
    if (wrong.size === 0) throw new Error(`The mutants do not compile together:\n${stdout}`);
    for (const [number, list] of wrong) {
      list.push(/** @type {Mutant} */ (together.get(number)));
      together.delete(number);
    }
  }
}

/** @param {string} stdout of cargo @returns {any[]} */
function messages(stdout) {
  return stdout
    .split('\n')
    .filter((line) => line.startsWith('{'))
    .map((line) => JSON.parse(line));
}

/** @returns {Promise<string[]>} the test programs, compiled of the copy as it is */
async function programs() {
  const { ok, stdout, output } = await cargo(['test', '--no-run', '--test', '*', '--message-format', 'json'], COPY);
  if (!ok) throw new Error(`The tests do not compile:\n${output}`);
  return messages(stdout).flatMap(({ executable }) => executable ?? []);
}

/** @returns {Promise<Test[]>} all tests, the quickest first, with what each reaches */
async function readTests() {
  progress('Compiling, and running every test');
  /** @type {Test[]} */
  const tests = [];
  for (const program of await programs()) {
    const { stdout } = await run(program, ['--list', '--format', 'terse'], { quiet: true });
    for (const [, name] of stdout.matchAll(/^(.+): test$/gm)) tests.push({ program, name, seconds: Infinity, reached: new Set() });
  }
  await onAllCores(tests, async (test) => {
    const start = Date.now();
    const { ok, output } = await runTest(test, TELL);
    if (!ok) throw new Error(`A test fails without a mutant:\n${output}`);
    for (const [, body] of output.matchAll(/^reached (\d+)$/gm)) test.reached.add(Number(body));
    test.seconds = (Date.now() - start) / 1000;
  });
  return tests.sort((a, b) => a.seconds - b.seconds);
}

/**
 * @template T
 * @param {T[]} items
 * @param {(item: T) => Promise<void>} work
 */
async function onAllCores(items, work) {
  const waiting = items.values();
  const core = async () => {
    for (const item of waiting) await work(item);
  };
  await Promise.all(Array.from({ length: availableParallelism() }, core));
}

/**
 * @param {Test} test
 * @param {string} chosen
 */
function runTest({ program, name, seconds }, chosen) {
  const limit = Number.isFinite(seconds) ? Math.ceil(20 * seconds + PATIENCE) : 'unlimited';
  const limited = `ulimit -c 0 -v ${ADDRESSES} -t ${limit}; exec "$@"`;
  const args = ['-c', limited, 'sh', program, '--exact', name, '--nocapture', '--test-threads', '1'];
  // One that waits for ever uses no processor.
  return run('sh', args, { env: { [CHOSEN]: chosen }, cwd: COPY, seconds: 3600, quiet: true });
}

/**
 * @param {Test[]} tests
 * @param {string} chosen
 * @returns {Promise<{ by?: string, how?: string }>} the first test that fails; and whether it said why
 */
async function meeting(tests, chosen) {
  for (const test of tests) {
    const { ok, output } = await runTest(test, chosen);
    const by = `${basename(test.program).replace(/-[0-9a-f]+$/, '')}::${test.name}`;
    if (!ok) return { by, ...(/panicked at/.test(output) ? {} : { how: 'without an answer' }) };
  }
  return {};
}

/**
 * @param {Outcome[]} outcomes
 * @param {number} unviable
 * @returns {boolean} whether enough were noticed
 */
function report(outcomes, unviable) {
  const missed = outcomes.filter(({ by }) => by === undefined);
  progress('Missed');
  for (const { name } of missed) console.log(name);
  const [n, caught] = [outcomes.length, outcomes.length - missed.length];
  const [share, low, high] = [caught / n, ...wilson(caught, n)].map((part) => `${(100 * part).toFixed(1)} %`);
  console.log(`\n${caught} of ${n} caught: ${share}, with 95 % confidence ${low} to ${high}.`);
  console.log(`${unviable} more were drawn that do not compile.`);
  return caught / n >= NOTICED;
}

/**
 * Wilson's score interval of a share.
 *
 * @param {number} hits
 * @param {number} n
 */
export function wilson(hits, n) {
  const p = hits / n;
  const centre = (p + Z ** 2 / (2 * n)) / (1 + Z ** 2 / n);
  const half = (Z / (1 + Z ** 2 / n)) * Math.sqrt((p * (1 - p)) / n + Z ** 2 / (4 * n ** 2));
  return [centre - half, centre + half];
}

await runAsScript(import.meta.url, async () => {
  if (!(await mutants(process.argv.slice(2)))) process.exitCode = 1;
});
