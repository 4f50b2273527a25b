// `npm run test:fuzz -- RUNS SEED`: coverage-guided fuzzing of everything in Rust that reads what others wrote. cargo-fuzz
// runs each target of fuzz/fuzz_targets RUNS times, from the corpus in fuzz/corpus; what it finds worth keeping is in
// build/fuzz, and the figures in build/fuzz/results.json.

import { mkdirSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Missing, ROOT, mustRun, progress, run, runAsScript } from './process.mjs';
import { nativeRust } from './toolchain.mjs';

/** @typedef {{ target: string, ok: boolean, runs: number, perSecond: number, edges: number, features: number, inputs: number, slowest: number, megabytes: number }} Outcome */

const OUTPUT = join(ROOT, 'build/fuzz');

/** What no input may exceed: seconds, and megabytes at once and in all, of which the program itself has 30. */
const LIMITS = ['-timeout=1', '-malloc_limit_mb=256', '-rss_limit_mb=286'];

/** Bytes of an input: what the longest sequence of calls takes. Longer ones would be slower and tell nothing else. */
const LENGTH = '-max_len=160';

const targets = readdirSync(join(ROOT, 'fuzz/fuzz_targets')).map((file) => file.replace(/\.rs$/, ''));

/** @param {string[]} args */
async function fuzz([runs = '10000000', seed = '1']) {
  for (const [name, number] of Object.entries({ RUNS: runs, SEED: seed })) {
    if (!/^[1-9]\d*$/.test(number)) throw new Missing(`${name} is "${number}", and has to be a whole number from 1.`);
  }
  const { bin, env } = await nativeRust();
  const cargo = join(bin, 'cargo');
  const sentence =
    'cargo-fuzz or a nightly Rust is missing: run `rustup toolchain install nightly` and `cargo install --locked cargo-fuzz`, and start again.';
  const { stdout } = await mustRun(sentence, cargo, ['+nightly', 'fuzz', '--version'], { env, quiet: true });
  const compiler = await run(join(bin, 'rustc'), ['+nightly', '--version'], { env, quiet: true });
  const versions = `${stdout.trim()}, ${compiler.stdout.trim()}`;
  progress(`${runs} runs of each of ${targets.join(', ')}, seed ${seed}; ${versions}`);
  // Safe Rust has no need of a sanitizer, which would make all of it twice as slow.
  const options = ['--sanitizer', 'none'];
  await mustRun('The targets do not compile: see above.', cargo, ['+nightly', 'fuzz', 'build', ...options], { env });
  const outcomes = await Promise.all(
    targets.map(async (target) => {
      const found = join(OUTPUT, target);
      mkdirSync(found, { recursive: true });
      const limits = [`-runs=${runs}`, `-seed=${seed}`, LENGTH, ...LIMITS, '-print_final_stats=1'];
      const command = ['+nightly', 'fuzz', 'run', ...options, target, found, join('fuzz/corpus', target), '--', ...limits];
      const { ok, output } = await run(cargo, command, { env, quiet: true });
      if (!ok) console.error(output.split('\n').slice(-60).join('\n'));
      const outcome = { target, ok, ...figures(output) };
      console.log(told(outcome));
      return outcome;
    }),
  );
  writeFileSync(join(OUTPUT, 'results.json'), `${JSON.stringify({ seed, versions, outcomes }, null, 2)}\n`);
  return outcomes.every(({ ok }) => ok);
}

/**
 * @param {string} output of libFuzzer
 * @returns {Omit<Outcome, 'target' | 'ok'>} NaN where it did not come to say
 */
function figures(output) {
  const last = (/** @type {string} */ pattern) => Number([...output.matchAll(new RegExp(pattern, 'g'))].pop()?.[1]);
  return {
    runs: last('stat::number_of_executed_units: *(\\d+)'),
    perSecond: last('stat::average_exec_per_sec: *(\\d+)'),
    edges: last(' cov: (\\d+)'),
    features: last(' ft: (\\d+)'),
    inputs: last(' corp: (\\d+)'),
    slowest: last('stat::slowest_unit_time_sec: *(\\d+)'),
    megabytes: last('stat::peak_rss_mb: *(\\d+)'),
  };
}

/** @param {Outcome} outcome */
function told({ target, ok, runs, perSecond, edges, features, inputs, slowest, megabytes }) {
  const speed = `${runs} runs, ${perSecond} a second, the slowest ${slowest} s, ${megabytes} MB`;
  return `${ok ? 'ok    ' : 'FAILED'} ${target.padEnd(8)} ${speed}; ${edges} edges, ${features} features, ${inputs} inputs`;
}

await runAsScript(import.meta.url, async () => {
  if (!(await fuzz(process.argv.slice(2)))) process.exitCode = 1;
});
