// `npm run test:fuzz -- RUNS SEED TARGETS` runs targets of fuzz/src (default: all) with cargo-fuzz, RUNS inputs each. Each run starts from
// the packed inputs in fuzz/corpus. `npm run test:fuzz -- keep TARGETS` adds inputs of build/fuzz that reach new code to the packed inputs.

import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { REPOSITORY_ROOT, UserError, runOrThrow, printStep, runProgram, runAsScript } from './process.mjs';
import { ensureNativeRust } from './toolchain.mjs';

const FUZZ_TARGETS = readdirSync(join(REPOSITORY_ROOT, 'fuzz/corpus')).map((corpusFile) => corpusFile.replace(/\.txt$/, ''));

/** Limits for each input: time (s), allocated memory (MB), memory of the process (30 MB without an input), and size (bytes). */
const INPUT_LIMITS = ['-timeout=1', '-malloc_limit_mb=256', '-rss_limit_mb=286', '-max_len=256'];

/** Options of the build. Safe Rust needs no sanitizer, and tracing of comparisons would halve the speed. */
const BUILD_OPTIONS = ['--sanitizer', 'none', '--no-trace-compares'];

/** Returns the path of the packed inputs of a target. The file has one hexadecimal input a line. @param {string} targetName */
const packedPathOf = (targetName) => join(REPOSITORY_ROOT, 'fuzz/corpus', `${targetName}.txt`);

/** Returns the folder of unpacked inputs of a target. @param {string} targetName @param {'known' | 'found' | 'merged'} folderKind */
const inputFolderOf = (targetName, folderKind) => join(REPOSITORY_ROOT, 'build/fuzz', targetName, folderKind);

/** Writes the packed inputs of a target as files for libFuzzer. @param {string} targetName */
function unpackInputs(targetName) {
  const knownInputFolder = inputFolderOf(targetName, 'known');
  rmSync(knownInputFolder, { recursive: true, force: true });
  mkdirSync(knownInputFolder, { recursive: true });
  mkdirSync(inputFolderOf(targetName, 'found'), { recursive: true });
  const inputLines = readFileSync(packedPathOf(targetName), 'latin1').split('\n').slice(0, -1);
  inputLines.forEach((hexLine, i) => writeFileSync(join(knownInputFolder, String(i)), Buffer.from(hexLine, 'hex')));
}

/** Runs a target with cargo-fuzz. @param {string} targetName @param {string[]} inputFolders @param {string[]} fuzzerOptions options of libFuzzer */
async function runCargoFuzz(targetName, inputFolders, fuzzerOptions) {
  const { cargoDirectory, env } = await ensureNativeRust();
  const cargoArguments = ['+nightly', 'fuzz', 'run', ...BUILD_OPTIONS, 'target', ...inputFolders, '--', ...fuzzerOptions];
  return runProgram(join(cargoDirectory, 'cargo'), cargoArguments, { env: { ...env, FUZZ_TARGET: targetName }, isQuiet: true });
}

/**
 * Runs a target on new inputs, and returns false if an input failed.
 * @param {string} targetName @param {string} runCount @param {string} seed @returns {Promise<boolean>}
 */
async function runFuzzTarget(targetName, runCount, seed) {
  unpackInputs(targetName);
  const fuzzOptions = [`-runs=${runCount}`, `-seed=${seed}`, ...INPUT_LIMITS];
  const { hasSucceeded, output: programOutput } = await runCargoFuzz(targetName, [inputFolderOf(targetName, 'found'), inputFolderOf(targetName, 'known')], fuzzOptions);
  if (!hasSucceeded) console.error(programOutput.split('\n').slice(-60).join('\n'));
  const coveredEdgeCount = [...programOutput.matchAll(/ cov: (\d+)/g)].pop()?.[1];
  console.log(`${hasSucceeded ? 'ok    ' : 'FAILED'} ${targetName.padEnd(12)} edges ${coveredEdgeCount}, ${programOutput.match(/^Done .*$/m)?.[0]}`);
  return hasSucceeded;
}

/** Packs the smallest set of known and found inputs that reaches the same code. @param {string} fuzzTargetName */
async function keepInputs(fuzzTargetName) {
  unpackInputs(fuzzTargetName);
  const mergedFolder = inputFolderOf(fuzzTargetName, 'merged');
  rmSync(mergedFolder, { recursive: true, force: true });
  mkdirSync(mergedFolder);
  // The merge keeps one input for each control-flow edge. With hit counts of edges, the corpus would be five times as large.
  const mergeOptions = ['-set_cover_merge=1', '-use_counters=0', ...INPUT_LIMITS];
  const { hasSucceeded, output: programOutput } = await runCargoFuzz(fuzzTargetName, [mergedFolder, inputFolderOf(fuzzTargetName, 'known'), inputFolderOf(fuzzTargetName, 'found')], mergeOptions);
  if (!hasSucceeded) throw new UserError(programOutput);
  const inputLines = readdirSync(mergedFolder).map((inputName) => readFileSync(join(mergedFolder, inputName)).toString('hex'));
  writeFileSync(packedPathOf(fuzzTargetName), inputLines.sort().map((hexLine) => `${hexLine}\n`).join(''));
  console.log(`${fuzzTargetName}: ${inputLines.length} inputs`);
  return true;
}

await runAsScript(import.meta.url, async () => {
  const commandArguments = process.argv.slice(2);
  const isKeepMode = commandArguments[0] === 'keep';
  const [runCount, seed] = isKeepMode ? [] : [commandArguments[0] ?? '1000000', commandArguments[1] ?? '1'];
  const namedTargets = commandArguments.slice(isKeepMode ? 1 : 2);
  for (const [parameterName, parameterText] of Object.entries({ RUNS: runCount, SEED: seed })) {
    if (parameterText !== undefined && !/^[1-9]\d*$/.test(parameterText)) throw new UserError(`${parameterName} must be a whole number from 1 (got "${parameterText}").`);
  }
  const unknownTarget = namedTargets.find((targetName) => !FUZZ_TARGETS.includes(targetName));
  if (unknownTarget !== undefined) throw new UserError(`"${unknownTarget}" is not a target; targets are ${FUZZ_TARGETS.join(', ')}.`);
  const targetQueue = namedTargets.length > 0 ? namedTargets : [...FUZZ_TARGETS];
  printStep(`${isKeepMode ? 'keep' : `${runCount} inputs each, seed ${seed}`}: ${targetQueue.join(', ')}`);
  const { cargoDirectory, env } = await ensureNativeRust();
  const missingMessage = 'cargo-fuzz or a nightly Rust is missing: run `rustup toolchain install nightly` and `cargo install --locked cargo-fuzz`, and start again.';
  await runOrThrow(missingMessage, join(cargoDirectory, 'cargo'), ['+nightly', 'fuzz', '--version'], { env, isQuiet: true });
  await runOrThrow('The targets do not compile: see above.', join(cargoDirectory, 'cargo'), ['+nightly', 'fuzz', 'build', ...BUILD_OPTIONS], { env });
  const runWaitingTargets = async () => {
    for (let fuzzTargetName = targetQueue.shift(); fuzzTargetName !== undefined; fuzzTargetName = targetQueue.shift()) {
      const fuzzResult = isKeepMode ? keepInputs(fuzzTargetName) : runFuzzTarget(fuzzTargetName, `${runCount}`, `${seed}`);
      if (!(await fuzzResult)) process.exitCode = 1;
    }
  };
  await Promise.all(Array.from({ length: availableParallelism() }, runWaitingTargets));
});
