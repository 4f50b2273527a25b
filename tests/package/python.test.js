// Python package as pip builds it. The wheel is installed, imported and used.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdtempSync, readFileSync, readdirSync, renameSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';
import { after, before, test } from 'node:test';
import { toPascalCase } from '../../scripts/declarations.mjs';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { pythonNameOf } from '../../scripts/python.mjs';
import { CACHE_DIRECTORY, ensurePip } from '../../scripts/toolchain.mjs';

const SOURCE_DIRECTORY = join(REPOSITORY_ROOT, 'python');
const pyprojectText = readFileSync(join(SOURCE_DIRECTORY, 'pyproject.toml'), 'utf8');

/** @type {string} */
let temporaryDirectory;
/** Search path of Python: the directories of the package and of its dependencies. @type {string} */
let pythonSearchPath;

/** Runs Python, and returns its output. @param {string[]} pythonArguments @param {string} [pythonPath] */
const runPython = (pythonArguments, pythonPath = '') => {
  const pythonEnvironment = { ...process.env, PYTHONPATH: pythonPath, PIP_ROOT_USER_ACTION: 'ignore', PIP_DISABLE_PIP_VERSION_CHECK: '1' };
  return execFileSync('python3', pythonArguments, { encoding: 'utf8', env: pythonEnvironment });
};

/** Runs pip. @param {string[]} pipArguments @param {string} [pythonPath] */
const runPip = (pipArguments, pythonPath) => runPython(['-m', 'pip', '--quiet', ...pipArguments], pythonPath);

/** Installs the packages that the Python package needs to be built and to run. Returns their directory, which all clones of the repository share. */
function installDependencies() {
  const requirementLines = pyprojectText.match(/^(?:requires|dependencies) = .*$/gm) ?? [];
  const requirements = requirementLines.flatMap((requirementLine) => requirementLine.match(/(?<=")[\w<>=.,]+(?=")/g) ?? []);
  assert.ok(requirements.length >= 2, pyprojectText);
  const pythonVersion = runPython(['--version']);
  const installDirectory = join(CACHE_DIRECTORY, `python-${createHash('sha256').update(requirements + pythonVersion).digest('hex').slice(0, 12)}`);
  if (existsSync(installDirectory)) return installDirectory;
  const incompleteDirectory = `${installDirectory}-${process.pid}`;
  runPip(['install', '--target', incompleteDirectory, ...requirements]);
  renameSync(incompleteDirectory, installDirectory);
  return installDirectory;
}

before(async () => {
  await ensurePip();
  temporaryDirectory = mkdtempSync(join(tmpdir(), 'motion-widgets-'));
  const dependencyDirectory = installDependencies();
  runPip(['wheel', '--no-deps', '--no-build-isolation', '--wheel-dir', temporaryDirectory, SOURCE_DIRECTORY], dependencyDirectory);
  const [pythonWheelFileName] = readdirSync(temporaryDirectory);
  const { version: packageVersion } = JSON.parse(readFileSync(join(REPOSITORY_ROOT, 'package.json'), 'utf8'));
  assert.equal(pythonWheelFileName, `motion_widgets-${packageVersion}-py3-none-any.whl`);
  const installDirectory = join(temporaryDirectory, 'site');
  runPip(['install', '--no-deps', '--target', installDirectory, join(temporaryDirectory, pythonWheelFileName)]);
  pythonSearchPath = [installDirectory, dependencyDirectory].join(delimiter);
});

after(() => rmSync(temporaryDirectory, { recursive: true, force: true }));

test('the installed package can be imported, and settings named like Python keywords have a trailing underscore', () => {
  const pythonLines = [
    'import json, motion_widgets as m',
    'figure = m.OdometryDecomposer(from_={"x": 1, "y": 2, "theta": 0.5})',
    'm.BananaMachine(reverse_aware=True, morph=0.5); m.MapSqueeze(steps=4)',
    'print(json.dumps([m.__file__, figure.get_state(["widget", "from_"])]))',
  ];
  const [importedFile, figureState] = JSON.parse(runPython(['-c', pythonLines.join('\n')], pythonSearchPath));
  assert.ok(importedFile.startsWith(temporaryDirectory), importedFile);
  assert.deepEqual(figureState, { widget: 'odometry-decomposer', from_: { x: 1, y: 2, theta: 0.5 } });
});

test('no trait hides a member of every ipywidgets widget', () => {
  const pythonLines = [
    'import motion_widgets as m',
    'from motion_widgets._figure import Figure',
    'from traitlets import TraitType',
    'print([f"{name}.{each}" for name in m.__all__ for each, trait in vars(getattr(m, name)).items()',
    '       if isinstance(trait, TraitType) and hasattr(Figure, each)])',
  ];
  assert.equal(runPython(['-c', pythonLines.join('\n')], pythonSearchPath).trim(), '[]');
});

test('values out of range and groups with wrong or missing fields are refused, and the message states the allowed values', () => {
  const refusedCalls = [
    ['MapSqueeze(omega=2e6)', 'omega is 2000000.0; allowed is a number from -1000000 to 1000000'],
    ['MapSqueeze(steps=0)', 'steps is 0; allowed is a whole number from 1 to 1000'],
    ['BananaMachine(model="car")', "model is 'car'; allowed is one of velocity, odometry"],
    ['MapSqueeze(command={"v": 1, "dt": 2})', "command has 'v', 'dt'; it needs 'v', 'omega', 'dt'"],
    ['MapSqueeze(command={"v": 1, "omega": 0, "dt": 0})', "command['dt'] is 0; allowed is a number from 1e-06 to 1000000"],
    ['BananaMachine(alphas=[1, "2"])', "alphas[1] is '2'; allowed is a number from 0 to 1000000"],
    ['BananaMachine(overlays=["elipse"])', "overlays[0] is 'elipse'; allowed is one of command, ellipse, exponential, linearized, additive"],
  ];
  const pythonLines = ['import motion_widgets as m, traitlets', ...refusedCalls.flatMap(([refusedCall]) => [`try: m.${refusedCall}`, 'except traitlets.TraitError as error: print(error)'])];
  assert.deepEqual(runPython(['-c', pythonLines.join('\n')], pythonSearchPath).trim().split('\n'), refusedCalls.map(([, expectedMessage]) => expectedMessage));
});

test('a setting reported by the figure is applied, unless Python has changed the setting since', () => {
  const pythonLines = [
    'import comm, json, motion_widgets as m',
    'from comm.base_comm import BaseComm',
    'sent = []',
    'class Comm(BaseComm):',
    '    def publish_msg(self, msg_type, data=None, **_): sent.append(data)',
    'comm.create_comm = Comm',
    'f = m.BananaMachine()',
    'f.preset = "hard"; heard = f._asked; f.omega = 0.2; sent.clear()',
    'f.set_state({"omega": 1.2, "dt": 1.4, "_shown": {"heard": heard, "settings": {"preset": "hard", "omega": 1.2, "dt": 1.4}}})',
    'print(json.dumps([f.preset, f.omega, f.dt, [sorted(each["state"]) for each in sent]]))',
  ];
  assert.deepEqual(JSON.parse(runPython(['-c', pythonLines.join('\n')], pythonSearchPath)), ['hard', 0.2, 1.4, [['_shown', 'dt']]]);
});

test('settings that the constructor did not receive are None', () => {
  assert.equal(runPython(['-c', 'import motion_widgets as m; f = m.MapSqueeze(); print({getattr(f, name) for name in m.MapSqueeze._settings})'], pythonSearchPath).trim(), '{None}');
});

test('names in generated Python and JavaScript code are valid', () => {
  assert.deepEqual(['reverseAware', 'lambda', 'log'].map(pythonNameOf), ['reverse_aware', 'lambda_', 'log_']);
  assert.throws(() => pythonNameOf('2d'), /2d cannot be the name of a trait/);
  assert.equal(toPascalCase('from'), 'From');
  for (const invalidKey of ['map', '2d']) assert.throws(() => toPascalCase(invalidKey), { message: new RegExp(`^${invalidKey} `, 'i') });
});
