// Finds or installs the tools of the build and the tests: npm packages, Rust, its WebAssembly target and lints. Several tools may be
// installed at the same time. This script imports only Node built-ins, because it runs in a bare clone.

import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { homedir } from 'node:os';
import { delimiter, dirname, join } from 'node:path';
import { REPOSITORY_ROOT, UserError, findProgram, runOrThrow, memoizeWork, printStep, createTaskQueue, runProgram, runAsScript } from './process.mjs';

const WASM_TARGET = 'wasm32-unknown-unknown';
const RUSTUP_BIN = join(process.env.CARGO_HOME ?? join(homedir(), '.cargo'), 'bin');
const DEBIAN_BIN = '/usr/bin';

/** Directory of tools that are built or downloaded once, and that all clones of this user share. */
export const CACHE_DIRECTORY = join(
  process.env.XDG_CACHE_HOME ||
    join(homedir(), process.platform === 'darwin' ? 'Library/Caches' : '.cache'),
  'motion-widgets',
);

/**
 * Workspaces of package.json, whose packages are installed when a script needs them. For a local server, the packages of the root are
 * enough.
 *
 * @typedef {'scripts' | 'tests' | 'tests/package' | 'tests/engines'} Workspace
 */

/** Installations by npm run one at a time, because all of them write to one directory. */
const enqueueForNpm = createTaskQueue();

/** @type {Map<string, Promise<void>>} */
const installationByWorkspace = new Map();

/**
 * Installs the npm packages of the root, and those of a workspace, unless the versions of package-lock.json are already installed.
 *
 * @param {Workspace} [workspaceName]
 */
export async function ensurePackages(workspaceName) {
  if (workspaceName) await ensurePackages();
  const workspaceKey = workspaceName ?? 'root';
  if (!installationByWorkspace.has(workspaceKey)) installationByWorkspace.set(workspaceKey, enqueueForNpm(() => installPackages(workspaceKey)));
  return installationByWorkspace.get(workspaceKey);
}

/** Installs the packages of a workspace. @param {string} workspaceKey a workspace, or "root" */
async function installPackages(workspaceKey) {
  const lockHash = createHash('sha256').update(readFileSync(join(REPOSITORY_ROOT, 'package-lock.json'))).digest('hex');
  const workspaceName = `motion-widgets-${workspaceKey.replace('/', '-')}`;
  const stampFile = join(REPOSITORY_ROOT, `node_modules/.installed-${workspaceName}`);
  if (existsSync(stampFile) && readFileSync(stampFile, 'utf8') === lockHash) return;
  printStep(`Installing npm packages${workspaceKey === 'root' ? '' : ` of ${workspaceKey}`}`);
  // Install scripts are skipped, because no package needs them. `npm ci` would remove the packages of the other workspaces.
  await runOrThrow(
    'The npm packages could not be installed: check that this machine reaches its npm registry and start again.',
    'npm',
    ['install', '--no-save', '--ignore-scripts', '--no-audit', '--no-fund', workspaceKey === 'root' ? '--workspaces=false' : `--workspace=${workspaceName}`],
    { timeLimitSeconds: 600 },
  );
  writeFileSync(stampFile, lockHash);
}

/** Queues of apt and of rustup. They ensure that neither program runs twice at the same time. */
const [enqueueForApt, enqueueForRustup] = [createTaskQueue(), createTaskQueue()];

/**
 * Installs packages by apt, if apt needs no password. Otherwise throws a `UserError`.
 *
 * @param {string[]} debianPackages
 * @param {string} purposeSentence thrown as `UserError` otherwise
 */
export const installByApt = (debianPackages, purposeSentence) => enqueueForApt(async () => {
  if (findProgram('apt-get') === undefined) throw new UserError(purposeSentence);
  const rootCommand = process.getuid?.() === 0 ? [] : ['sudo', '-n'];
  if (rootCommand.length > 0 && !(await runProgram('sudo', ['-n', 'true'], { isQuiet: true })).hasSucceeded) throw new UserError(purposeSentence);
  printStep(`Installing ${debianPackages.join(' ')} by apt`);
  const [programName, ...firstArguments] = [...rootCommand, 'env', 'DEBIAN_FRONTEND=noninteractive', 'apt-get'];
  await runProgram(programName, [...firstArguments, 'update', '-qq'], { timeLimitSeconds: 300 });
  // Apt must not remove an installed package, in particular not another installation of Rust.
  const aptOptions = ['-y', '-qq', '--no-remove', '--no-install-recommends', '-o', 'DPkg::Lock::Timeout=300'];
  await runOrThrow(purposeSentence, programName, [...firstArguments, 'install', ...aptOptions, ...debianPackages], { timeLimitSeconds: 900 });
});

/** Ensures that Python and pip, which build the Python package, are installed. */
export async function ensurePip() {
  if ((await runProgram('python3', ['-m', 'pip', '--version'], { isQuiet: true })).hasSucceeded) return;
  await installByApt(['python3', 'python3-pip'], 'Python 3 or its pip is missing: install them as python.org says and start again.');
}

/**
 * @typedef {object} Rust
 * @property {string} cargoDirectory directory of cargo, cargo-fmt and cargo-clippy
 * @property {Record<string, string>} env
 * @property {string[]} target arguments that make cargo build for this target
 * @property {string} description
 */

/** Finds or installs Rust for this machine: by rustup, or from Debian if rustup's server cannot be reached. */
export const ensureNativeRust = memoizeWork(/** @returns {Promise<Rust>} */ async () => {
  let cargoPath = findProgram('cargo', [RUSTUP_BIN]);
  if (cargoPath === undefined) {
    if (!(await installRustup())) {
      await installByApt(['rustc-web', 'cargo-web'], 'Rust is missing: install it as rustup.rs says and start again.');
    }
    cargoPath = findProgram('cargo', [RUSTUP_BIN]) ?? join(DEBIAN_BIN, 'cargo');
  }
  if (findProgram('cc') === undefined) {
    const installHint = process.platform === 'darwin' ? 'run `xcode-select --install`' : 'install gcc';
    await installByApt(['gcc', 'libc6-dev'], `A C compiler, which Rust links with, is missing: ${installHint} and start again.`);
  }
  const cargoDirectory = dirname(cargoPath);
  const rustEnvironment = cargoDirectory === DEBIAN_BIN ? createDebianEnvironment() : createEnvironment(cargoDirectory);
  const rustcVersion = await requireRustVersion(cargoDirectory, rustEnvironment, 'run `rustup update stable`');
  return { cargoDirectory, env: rustEnvironment, target: [], description: rustcVersion };
});

/** Installs Rust by rustup, and returns true if that succeeded. @returns {Promise<boolean>} */
async function installRustup() {
  printStep('Installing Rust by rustup');
  const rustupScript = await runProgram('curl', ['--proto', '=https', '--tlsv1.2', '-sSf', '--max-time', '60', 'https://sh.rustup.rs'], { isQuiet: true });
  const rustupArguments = ['-y', '--no-modify-path', '--profile', 'default', '--target', WASM_TARGET];
  return rustupScript.hasSucceeded && (await runProgram('sh', ['-c', rustupScript.stdout, 'sh', ...rustupArguments], { timeLimitSeconds: 600 })).hasSucceeded;
}

/**
 * Finds or installs Rust for WebAssembly. The standard library of the target comes from rustup. If rustup's server cannot be reached, Debian's
 * compiler builds that library from Debian's sources.
 */
export const ensureRustForWasm = memoizeWork(/** @returns {Promise<Rust>} */ async () => {
  const nativeToolchain = await ensureNativeRust();
  if (nativeToolchain.cargoDirectory !== DEBIAN_BIN && (await enqueueForRustup(() => hasWasmTarget(nativeToolchain)))) {
    return { ...nativeToolchain, target: ['--target', WASM_TARGET], description: `${nativeToolchain.description}, ${WASM_TARGET} of rustup` };
  }
  const missingMessage =
    `Rust's ${WASM_TARGET} target is missing: run \`rustup target add ${WASM_TARGET}\`, ` +
    'or on Debian `sudo apt-get install rustc-web cargo-web rust-web-src lld`, and start again.';
  const requiredFiles = ['rustc', 'cargo', 'wasm-ld'].map((programName) => join(DEBIAN_BIN, programName));
  if (![...requiredFiles, '/usr/lib/rustlib/src/rust/library/Cargo.lock'].every(existsSync)) {
    await installByApt(['rustc-web', 'cargo-web', 'rust-web-src', 'lld'], missingMessage);
  }
  // Tests abort on panic, like the published module. The standard library is therefore compiled only once for both.
  const env = { ...createDebianEnvironment(), CARGO_UNSTABLE_PANIC_ABORT_TESTS: 'true' };
  const rustcVersion = await requireRustVersion(DEBIAN_BIN, env, 'run `sudo apt-get update && sudo apt-get install rustc-web`');
  return {
    cargoDirectory: DEBIAN_BIN,
    env,
    target: ['--target', WASM_TARGET, '-Zbuild-std=std,panic_abort'],
    description: `${rustcVersion} of Debian, standard library from source`,
  };
});

/**
 * Returns true if the standard library for WebAssembly is installed. If it is missing, rustup is asked to install it first.
 *
 * @param {Rust} native
 */
async function hasWasmTarget({ cargoDirectory, env }) {
  const sysrootResult = await runProgram(join(cargoDirectory, 'rustc'), ['--print', 'sysroot'], { env, isQuiet: true });
  if (existsSync(join(sysrootResult.stdout.trim(), 'lib/rustlib', WASM_TARGET))) return true;
  const rustupPath = findProgram('rustup', [cargoDirectory]);
  if (rustupPath === undefined) return false;
  // Behind some firewalls rustup never returns. Such a firewall is detected once a day, by a time limit. The limit is longer if Debian's
  // packages cannot replace rustup.
  const unreachableMarkPath = join(CACHE_DIRECTORY, 'rustup-unreachable');
  const canFallBack = findProgram('apt-get') !== undefined;
  const dayInMs = 24 * 3600 * 1000;
  if (canFallBack && existsSync(unreachableMarkPath) && Date.now() - statSync(unreachableMarkPath).mtimeMs < dayInMs) return false;
  printStep(`Asking rustup for ${WASM_TARGET}`);
  const installWasmTarget = () => runProgram(rustupPath, ['target', 'add', WASM_TARGET], { env, timeLimitSeconds: canFallBack ? 60 : 600 });
  const { hasSucceeded, hasTimedOut } = canFallBack && (await isServerSilent()) ? { hasSucceeded: false, hasTimedOut: true } : await installWasmTarget();
  if (hasSucceeded) return true;
  if (hasTimedOut) {
    console.log('rustup does not answer.');
    mkdirSync(CACHE_DIRECTORY, { recursive: true });
    writeFileSync(unreachableMarkPath, '');
  }
  return false;
}

/**
 * Returns true if rustup's server does not answer a small request within 15 s. Even a satellite link with three lost packets answers within
 * 10 s; a slower link could not transfer the 20 MB of the target.
 *
 * @returns {Promise<boolean>} false if curl is missing
 */
async function isServerSilent() {
  const rustupServer = process.env.RUSTUP_DIST_SERVER ?? 'https://static.rust-lang.org';
  // Any answer shows that the server is reachable, even an answer with an unknown certificate.
  const curlArguments = ['--silent', '--head', '--insecure', '--output', '/dev/null', `${rustupServer}/dist/channel-rust-stable.toml.sha256`];
  return (await runProgram('curl', curlArguments, { timeLimitSeconds: 15, isQuiet: true })).hasTimedOut;
}

/** Returns the environment of Debian's stable compiler, with the unstable features that `-Zbuild-std` needs. */
function createDebianEnvironment() {
  return {
    ...createEnvironment(DEBIAN_BIN),
    RUSTC: join(DEBIAN_BIN, 'rustc'),
    RUSTC_BOOTSTRAP: '1',
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER: 'wasm-ld',
  };
}

/**
 * Returns the variables PATH and CARGO with which the programs of `cargoDirectory` are found first. cargo-clippy runs the program that CARGO names.
 *
 * @param {string} cargoDirectory
 */
function createEnvironment(cargoDirectory) {
  return { PATH: cargoDirectory + delimiter + process.env.PATH, CARGO: join(cargoDirectory, 'cargo') };
}

/**
 * Returns rustc's description of itself. Throws if rustc is too old.
 *
 * @param {string} cargoDirectory
 * @param {Record<string, string>} env
 * @param {string} remedySentence
 * @returns {Promise<string>}
 */
async function requireRustVersion(cargoDirectory, env, remedySentence) {
  const requiredVersion = readManifestValue('Cargo.toml', /^rust-version = "(.+)"$/m);
  const { stdout } = await runProgram(join(cargoDirectory, 'rustc'), ['--version'], { env, isQuiet: true });
  const [, rustMajor, rustMinor] = stdout.match(/^rustc (\d+)\.(\d+)/) ?? ['', '0', '0'];
  const [minMajor, minMinor] = requiredVersion.split('.').map(Number);
  if (Number(rustMajor) < minMajor || (Number(rustMajor) === minMajor && Number(rustMinor) < minMinor)) {
    throw new UserError(`Rust ${requiredVersion} or newer is needed and ${join(cargoDirectory, 'rustc')} is not: ${remedySentence} and start again.`);
  }
  return stdout.split(' ').slice(0, 2).join(' ');
}

/** Ensures that rustfmt and clippy are installed for a cargo. @param {Rust} rust */
export async function ensureLints({ cargoDirectory, env }) {
  const hasLints = async () => {
    const versionResults = ['cargo-fmt', 'cargo-clippy'].map((lintName) => runProgram(join(cargoDirectory, lintName), ['--version'], { env, isQuiet: true }));
    return (await Promise.all(versionResults)).every(({ hasSucceeded }) => hasSucceeded);
  };
  if (await hasLints()) return;
  const missingMessage = 'rustfmt or clippy is missing: run `rustup component add rustfmt clippy` and start again.';
  if (cargoDirectory === DEBIAN_BIN) {
    await installByApt(['rustfmt-web', 'rust-web-clippy'], missingMessage);
  } else {
    const rustupPath = findProgram('rustup', [cargoDirectory]);
    if (rustupPath === undefined) throw new UserError(missingMessage);
    await enqueueForRustup(() => runOrThrow(missingMessage, rustupPath, ['component', 'add', 'rustfmt', 'clippy'], { env, timeLimitSeconds: 300 }));
  }
  if (!(await hasLints())) throw new UserError(missingMessage);
}

/** Returns the part of a file that the first group of a pattern matches. @param {string} filePath @param {RegExp} patternWithGroup */
export function readManifestValue(filePath, patternWithGroup) {
  const patternMatch = readFileSync(join(REPOSITORY_ROOT, filePath), 'utf8').match(patternWithGroup);
  if (patternMatch === null) throw new Error(`${filePath} has nothing like ${patternWithGroup}`);
  return patternMatch[1];
}

// `node scripts/toolchain.mjs WORKSPACE` installs packages that another script imports statically.
await runAsScript(import.meta.url, () => ensurePackages(/** @type {Workspace} */ (process.argv[2])));
