// The programs made of wasm-bindgen, from the crate in scripts/bind: one binds the core, one runs its tests in a browser.
// Without optimization they are compiled in a fifth of the time, and bind in 0.3 s.

import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { filesOf } from './bundle.mjs';
import { ROOT, UserError, isProgram, once, progress, run } from './process.mjs';
import { CACHE, manifestValue, nativeRust } from './toolchain.mjs';

const CRATE = 'scripts/bind';

/** The program that binds the core, built once. */
export const binder = once(() => compiledProgram('bind', []));

/** The program that runs WebAssembly tests in a browser, built once. */
export const testRunner = once(async () => {
  // Most of its crates are compiled for the other program already.
  await binder();
  return compiledProgram('test-runner', ['--features', 'test-runner']);
});

/** Compiles a program once, and returns its path. @param {string} name @param {string[]} features */
async function compiledProgram(name, features) {
  const version = requireOneVersion();
  const sourceHash = createHash('sha256');
  for (const path of filesOf(CRATE)) sourceHash.update(readFileSync(join(ROOT, path)));
  const installDirectory = join(CACHE, `wasm-bindgen-${version}-${sourceHash.digest('hex').slice(0, 12)}`);
  const program = join(installDirectory, 'bin', name);
  if (isProgram(program)) return program;
  const { bin, env } = await nativeRust();
  progress(`Building ${name} of wasm-bindgen ${version}, once`);
  const args = ['install', '--quiet', '--debug', '--path', CRATE, '--bin', name, ...features, '--root', installDirectory, '--no-track', '--force'];
  // Cargo locks its directory while it builds, so this build has its own.
  const cargoOptions = { env: { ...env, CARGO_TARGET_DIR: join(ROOT, 'target/bind') }, seconds: 1200 };
  const lockedInstall = await run(join(bin, 'cargo'), [...args, '--locked'], { ...cargoOptions, quiet: true });
  // A crate of the lock file may be missing in a mirror.
  if (lockedInstall.ok || (await run(join(bin, 'cargo'), args, cargoOptions)).ok) return program;
  throw new UserError(
    `wasm-bindgen ${version} could not be built: check that this machine reaches the registry of Rust packages and start again.`,
  );
}

/** @returns {string} the version of wasm-bindgen that the core is compiled with, which has to be met exactly */
function requireOneVersion() {
  const version = manifestValue('Cargo.lock', /^name = "wasm-bindgen"\nversion = "(.+)"$/m);
  const binderVersion = manifestValue(`${CRATE}/Cargo.lock`, /^name = "wasm-bindgen-cli-support"\nversion = "(.+)"$/m);
  if (version === binderVersion) return version;
  throw new UserError(
    `The core has wasm-bindgen ${version} and ${CRATE} has ${binderVersion}: write "=${version}" into ${CRATE}/Cargo.toml, ` +
      `run \`cargo update --manifest-path ${CRATE}/Cargo.toml\` and start again.`,
  );
}
