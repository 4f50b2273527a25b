// `npm run test:fuzz -- RUNS SEED TARGETS`: coverage-guided fuzzing of everything that reads what others wrote. cargo-fuzz
// runs each target of fuzz/fuzz_targets RUNS times, from the corpus in fuzz/corpus, and tests/fuzz/guided.mjs what
// JavaScript parses; of all of them, or of those that are named. What they find worth keeping is in build/fuzz, and the
// figures in build/fuzz/results.json.

import { mkdirSync, readdirSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { Missing, ROOT, mustRun, progress, run, runAsScript } from './process.mjs';
import { nativeRust } from './toolchain.mjs';

/** @typedef {{ runs?: number, slowest?: number, megabytes?: number, inputs?: number }} Figures with others beside them */
/** @typedef {{ target: string, ok: boolean } & Figures} Outcome */

const OUTPUT = join(ROOT, 'build/fuzz');

/** What no input may exceed: seconds, and megabytes at once and in all, of which the program itself has 30. */
const LIMITS = ['-timeout=1', '-malloc_limit_mb=256', '-rss_limit_mb=286'];

/** Bytes of an input: what the longest sequence of calls takes. Longer ones would be slower and tell nothing else. */
const LENGTH = '-max_len=160';

const rust = readdirSync(join(ROOT, 'fuzz/fuzz_targets')).map((file) => file.replace(/\.rs$/, ''));

/** @param {string[]} args */
async function fuzz([runs = '10000000', seed = '1', ...named]) {
  for (const [name, number] of Object.entries({ RUNS: runs, SEED: seed })) {
    if (!/^[1-9]\d*$/.test(number)) throw new Missing(`${name} is "${number}", and has to be a whole number from 1.`);
  }
  // Runs what is built.
  const { targets: parsers } = await import('../tests/fuzz/targets.js');
  const all = [...rust, ...Object.keys(parsers).map((name) => `js-${name}`)];
  const stranger = named.find((name) => !all.includes(name));
  if (stranger !== undefined) throw new Missing(`TARGETS has "${stranger}"; allowed are ${all.join(', ')}.`);
  const targets = all.filter((name) => named.length === 0 || named.includes(name));
  progress(`${runs} runs of each of ${targets.join(', ')}, seed ${seed}`);
  const versions = { node: process.version, rust: await compileTargets(targets.filter((name) => rust.includes(name))) };
  /** @type {Outcome[]} */
  const outcomes = [];
  const waiting = [...targets];
  const lane = async () => {
    for (let target = waiting.shift(); target !== undefined; target = waiting.shift()) {
      const outcome = rust.includes(target) ? await inRust(target, runs, seed) : await inJavaScript(target, runs, seed);
      console.log(told(outcome));
      outcomes.push(outcome);
    }
  };
  // A second is a second of a processor only where each has its own.
  await Promise.all(Array.from({ length: availableParallelism() }, lane));
  mkdirSync(OUTPUT, { recursive: true });
  writeFileSync(join(OUTPUT, 'results.json'), `${JSON.stringify({ seed, versions, outcomes }, null, 2)}\n`);
  return outcomes.every(({ ok }) => ok);
}

// Safe Rust has no need of a sanitizer, which would make all of it twice as slow, as would a look at every comparison: the
// numbers at which something begins are among the inputs.
const OPTIONS = ['--sanitizer', 'none', '--no-trace-compares'];

/** @param {string[]} targets @returns the versions of what compiled them, if there are any */
async function compileTargets(targets) {
  if (targets.length === 0) return '';
  const { bin, env } = await nativeRust();
  const cargo = join(bin, 'cargo');
  const sentence =
    'cargo-fuzz or a nightly Rust is missing: run `rustup toolchain install nightly` and `cargo install --locked cargo-fuzz`, and start again.';
  const { stdout } = await mustRun(sentence, cargo, ['+nightly', 'fuzz', '--version'], { env, quiet: true });
  const compiler = await run(join(bin, 'rustc'), ['+nightly', '--version'], { env, quiet: true });
  await mustRun('The targets do not compile: see above.', cargo, ['+nightly', 'fuzz', 'build', ...OPTIONS], { env });
  return `${stdout.trim()}, ${compiler.stdout.trim()}`;
}

/** @param {string} target @param {string} runs @param {string} seed @returns {Promise<Outcome>} */
async function inRust(target, runs, seed) {
  const { bin, env } = await nativeRust();
  const found = join(OUTPUT, target);
  mkdirSync(found, { recursive: true });
  const limits = [`-runs=${runs}`, `-seed=${seed}`, LENGTH, ...LIMITS, '-print_final_stats=1'];
  const command = ['+nightly', 'fuzz', 'run', ...OPTIONS, target, found, join('fuzz/corpus', target), '--', ...limits];
  const { ok, output } = await run(join(bin, 'cargo'), command, { env, quiet: true });
  if (!ok) console.error(output.split('\n').slice(-60).join('\n'));
  return { target, ok, ...figures(output) };
}

/** @param {string} target @param {string} runs @param {string} seed @returns {Promise<Outcome>} */
async function inJavaScript(target, runs, seed) {
  const { ok, output, stdout } = await run(process.execPath, ['tests/fuzz/guided.mjs', target.replace('js-', ''), runs, seed], { quiet: true });
  if (!ok) console.error(output);
  return { target, ok, ...(ok ? JSON.parse(stdout.trimEnd().split('\n').pop() ?? '') : {}) };
}

/**
 * @param {string} output of libFuzzer
 * @returns {Record<string, number>} NaN where it did not come to say
 */
function figures(output) {
  const last = (/** @type {string} */ pattern) => Number([...output.matchAll(new RegExp(pattern, 'g'))].pop()?.[1]);
  return {
    runs: last('stat::number_of_executed_units: *(\\d+)'),
    inputs: last(' corp: (\\d+)'),
    slowest: last('stat::slowest_unit_time_sec: *(\\d+)'),
    megabytes: last('stat::peak_rss_mb: *(\\d+)'),
    edges: last(' cov: (\\d+)'),
    features: last(' ft: (\\d+)'),
  };
}

/** @param {Outcome} outcome */
function told({ target, ok, ...figures }) {
  const list = Object.entries(figures).map(([name, value]) => `${name} ${value}`);
  return `${ok ? 'ok    ' : 'FAILED'} ${target.padEnd(14)} ${list.join(', ')}`;
}

await runAsScript(import.meta.url, async () => {
  if (!(await fuzz(process.argv.slice(2)))) process.exitCode = 1;
});
