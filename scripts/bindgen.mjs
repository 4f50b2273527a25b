// The programs made of wasm-bindgen, from the crate in scripts/bind: one binds the core, one runs its tests in a browser.
// Without optimization they are compiled in a fifth of the time, and bind in 0.3 s.

import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { filesOf } from './bundle.mjs';
import { Missing, ROOT, isProgram, once, progress, run } from './process.mjs';
import { CACHE, manifestValue, nativeRust } from './toolchain.mjs';

const CRATE = 'scripts/bind';

/** The program that binds the core, built once. */
export const binder = once(() => built('bind', []));

/** The program that runs WebAssembly tests in a browser, built once. */
export const testRunner = once(async () => {
  // Most of its crates are compiled for the other program already.
  await binder();
  return built('test-runner', ['--features', 'test-runner']);
});

/** Compiles a program once, and returns its path. @param {string} name @param {string[]} features */
async function built(name, features) {
  const version = requireOneVersion();
  const sources = createHash('sha256');
  for (const path of filesOf(CRATE)) sources.update(readFileSync(join(ROOT, path)));
  const root = join(CACHE, `wasm-bindgen-${version}-${sources.digest('hex').slice(0, 12)}`);
  const program = join(root, 'bin', name);
  if (isProgram(program)) return program;
  const { bin, env } = await nativeRust();
  progress(`Building ${name} of wasm-bindgen ${version}, once`);
  const args = ['install', '--quiet', '--debug', '--path', CRATE, '--bin', name, ...features, '--root', root, '--no-track', '--force'];
  // Cargo locks its directory while it builds, so this build has its own.
  const options = { env: { ...env, CARGO_TARGET_DIR: join(ROOT, 'target/bind') }, seconds: 1200 };
  const locked = await run(join(bin, 'cargo'), [...args, '--locked'], { ...options, quiet: true });
  // A crate of the lock file may be missing in a mirror.
  if (locked.ok || (await run(join(bin, 'cargo'), args, options)).ok) return program;
  throw new Missing(
    `wasm-bindgen ${version} could not be built: check that this machine reaches the registry of Rust packages and start again.`,
  );
}

/** @returns {string} the version of wasm-bindgen that the core is compiled with, which has to be met exactly */
function requireOneVersion() {
  const version = manifestValue('Cargo.lock', /^name = "wasm-bindgen"\nversion = "(.+)"$/m);
  const ours = manifestValue(`${CRATE}/Cargo.lock`, /^name = "wasm-bindgen-cli-support"\nversion = "(.+)"$/m);
  if (version === ours) return version;
  throw new Missing(
    `The core has wasm-bindgen ${version} and ${CRATE} has ${ours}: write "=${version}" into ${CRATE}/Cargo.toml, ` +
      `run \`cargo update --manifest-path ${CRATE}/Cargo.toml\` and start again.`,
  );
}
