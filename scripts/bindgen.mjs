// Programs of the crate scripts/bind, which use wasm-bindgen. One generates the JavaScript glue (bindings) of the core. One runs its
// browser tests. The programs are not optimized, so that they compile five times as fast. Even then, generating the glue takes only 0.3 s.

import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { REPOSITORY_ROOT, UserError, filesOf, isProgram, memoizeWork, printStep, runProgram } from './process.mjs';
import { CACHE_DIRECTORY, readManifestValue, ensureNativeRust } from './toolchain.mjs';

const BINDGEN_CRATE = 'scripts/bind';

/** Returns the path of the program that generates the core's JavaScript glue. The first call builds it. */
export const ensureBindProgram = memoizeWork(() => compileProgram('bind', []));

/** Returns the path of the program that runs WebAssembly tests in a browser. The first call builds it. */
export const ensureTestRunner = memoizeWork(async () => {
  // The generator of JavaScript glue is built first, because its build compiles most crates that the test runner needs too.
  await ensureBindProgram();
  return compileProgram('test-runner', ['--features', 'test-runner']);
});

/** Compiles a program once, and returns its path. @param {string} programName @param {string[]} cargoFeatures */
async function compileProgram(programName, cargoFeatures) {
  const bindgenVersion = readManifestValue(`${BINDGEN_CRATE}/Cargo.lock`, /^name = "wasm-bindgen-cli-support"\nversion = "(.+)"$/m);
  const sourceHash = createHash('sha256');
  for (const sourcePath of filesOf(BINDGEN_CRATE)) sourceHash.update(readFileSync(join(REPOSITORY_ROOT, sourcePath)));
  const installDirectory = join(CACHE_DIRECTORY, `wasm-bindgen-${bindgenVersion}-${sourceHash.digest('hex').slice(0, 12)}`);
  const programPath = join(installDirectory, 'bin', programName);
  if (isProgram(programPath)) return programPath;
  const { cargoDirectory, env } = await ensureNativeRust();
  printStep(`Building ${programName} of wasm-bindgen ${bindgenVersion}, once`);
  const cargoArguments = ['install', '--quiet', '--debug', '--path', BINDGEN_CRATE, '--bin', programName, ...cargoFeatures, '--root', installDirectory, '--no-track', '--force'];
  // Cargo locks its target directory during a build. A separate target directory avoids waiting for other builds.
  const cargoOptions = { env: { ...env, CARGO_TARGET_DIR: join(REPOSITORY_ROOT, 'target/bind') }, timeLimitSeconds: 1200 };
  const installResult = await runProgram(join(cargoDirectory, 'cargo'), [...cargoArguments, '--locked'], { ...cargoOptions, isQuiet: true });
  // The second attempt ignores the lock file, because a mirror of the registry may lack a crate of the lock file.
  if (installResult.hasSucceeded || (await runProgram(join(cargoDirectory, 'cargo'), cargoArguments, cargoOptions)).hasSucceeded) return programPath;
  throw new UserError(
    `wasm-bindgen ${bindgenVersion} could not be built: check that this machine reaches the registry of Rust packages and start again.`,
  );
}
