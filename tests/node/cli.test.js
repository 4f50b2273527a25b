// `npx motion-widgets calibrate`: options, output and errors.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { load } from '../../dist/core.js';
import { TRUE_PARAMETERS } from '../../scripts/example-log.mjs';
import { HELP_TEXT } from '../../www/cli/options.ts';
import { createDrivesSvg } from '../../www/cli/plot.ts';
import { formatReport } from '../../www/cli/report.ts';
import { runCommand } from '../../www/cli/run.ts';
import { warningsOf } from '../../www/logs/pairs.ts';
import { en } from '../../www/widgets/alpha-calibrator/en.ts';
import { useLanguageOf } from '../../www/messages/registry.ts';
import { judgeFit } from '../../www/widgets/alpha-calibrator/readouts.ts';
import { odometryMessageOf, poseOf, recordingOf, stampOf, transformMessageOf, twistOf } from '../mcap.js';

const CLI_PATH = fileURLToPath(new URL('../../dist/cli.js', import.meta.url));
const examplePathOf = (/** @type {string} */ exampleName) => fileURLToPath(new URL(`../../examples/calibration/${exampleName}.csv`, import.meta.url));
const LOG_ARGS = ['--odometry', examplePathOf('odometry'), '--reference', examplePathOf('reference')];

/** @type {string} */
let temporaryFolder;
before(() => (temporaryFolder = mkdtempSync(join(tmpdir(), 'motion-cli-'))));
after(() => rmSync(temporaryFolder, { recursive: true, force: true }));

/** Writes a file in the temporary folder, and returns its path. @param {string} fileName @param {string | Uint8Array} fileContents */
function writeInFolder(fileName, fileContents) {
  const filePath = join(temporaryFolder, fileName);
  writeFileSync(filePath, fileContents);
  return filePath;
}

/** Runs the command in this process, and returns its exit code and its output. @param {string[]} cliArguments @param {() => Promise<any>} [loadCore] */
async function runCalibrate(cliArguments, loadCore = load) {
  let [outputText, errorText] = ['', ''];
  const exitCode = await runCommand(['calibrate', ...cliArguments], { load: loadCore, print: (printedText) => (outputText += printedText), printError: (printedText) => (errorText += printedText), currentDate: new Date('2026-01-02T03:04:05Z') });
  return { exitCode, stdout: outputText, stderr: errorText };
}

/** Returns the options that the command passes to the core, with logs in arrays. @param {string[]} cliArguments @returns {Promise<any>} */
async function readCoreOptions(cliArguments) {
  /** @type {any} */
  let coreOptions;
  const { stderr } = await runCalibrate(cliArguments, async () => ({ calibrate(/** @type {any} */ calibrateOptions) { coreOptions = { ...calibrateOptions, odometry: [calibrateOptions.odometry].flat(), reference: [calibrateOptions.reference].flat() }; throw new RangeError('stop'); } }));
  assert.ok(coreOptions, stderr);
  return coreOptions;
}

useLanguageOf(/** @type {any} */ ({ closest: () => ({ getAttribute: () => 'en' }) }));

test('options of the command line are passed to the core', async () => {
  const { odometry: odometryLog, reference: referenceLog, ...fitOptions } = await readCoreOptions(LOG_ARGS);
  assert.deepEqual(fitOptions, { legs: { distance: 0.25, angle: 0.2 } });
  for (const coreLog of [...odometryLog, ...referenceLog]) assert.deepEqual(Object.keys(coreLog), ['t', 'x', 'y', 'theta', 'breaks']);
  const optionsText = '--model omnidirectional --rule omni --update-min-d 0.5 --update-min-a 0.3 --outliers keep --reference-position-std 0.001 --reference-yaw-std 2e-3';
  const coreOptions = await readCoreOptions([...LOG_ARGS, ...optionsText.split(' ')]);
  assert.deepEqual({ ...coreOptions, odometry: [], reference: [] }, { odometry: [], reference: [], model: 'omnidirectional', rule: 'omni', legs: { distance: 0.5, angle: 0.3 }, outliers: 'keep', positionStd: 0.001, yawStd: 0.002 });
  assert.deepEqual((await readCoreOptions([...LOG_ARGS, '--duration=0.5'])).legs, { duration: 0.5 });
  assert.equal((await readCoreOptions([...LOG_ARGS, '--rule', 'omni'])).model, 'omnidirectional');
});

test('files without an option are recordings, and single tables are paired as odometry and reference', async () => {
  const [odometryPath, referencePath] = [examplePathOf('odometry'), examplePathOf('reference')];
  const writeLaterCopy = (/** @type {string} */ copyName, /** @type {string} */ sourcePath) => writeInFolder(copyName, readFileSync(sourcePath, 'utf8').replaceAll(/^(\d+)/gm, (_, secondsText) => `${Number(secondsText) + 1000}`));
  const expectedOptions = await readCoreOptions(LOG_ARGS);
  assert.deepEqual(await readCoreOptions([referencePath, odometryPath]), expectedOptions);
  assert.deepEqual(await readCoreOptions([referencePath, '--recording', odometryPath]), expectedOptions);
  const [laterOdometryPath, laterReferencePath] = [writeLaterCopy('odom2.csv', odometryPath), writeLaterCopy('truth2.csv', referencePath)];
  const { odometry: odometryLogs, reference: referenceLogs } = await readCoreOptions([laterReferencePath, odometryPath, '--odometry', laterOdometryPath, '--reference', referencePath]);
  for (const coreLogs of [odometryLogs, referenceLogs]) assert.deepEqual(coreLogs.map((/** @type {any} */ { t }) => Math.floor(t[0] / 1000)), [0, 1]);
});

test('the option --correct selects all, some or none of the systematic errors', async () => {
  const readCorrectOption = async (/** @type {string} */ args) => (await readCoreOptions([...LOG_ARGS, ...args.split(' ')])).correct;
  assert.deepEqual(await readCorrectOption('--no-correct mountYaw,leverArm --correct turnScale'), { mountYaw: false, leverArm: false, turnScale: true });
  const noCorrection = { clockOffset: false, mountYaw: false, leverArm: false, distanceScale: false, turnScale: false };
  assert.deepEqual(await readCorrectOption('--no-correct all'), noCorrection);
  assert.deepEqual(await readCorrectOption('--correct clockOffset --no-correct all'), { ...noCorrection, clockOffset: true });
});

test('one recording can contain both logs, with topics and frames that are guessed or named', async () => {
  const odometryMessages = Array.from({ length: 40 }, (_, i) => {
    const t = 100 + i / 20;
    const poseStamped = { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(1.01 * i, 2, 0) };
    return [
      { topic: '/odom', type: 'nav_msgs/msg/Odometry', t, message: odometryMessageOf(t, i, 1, 0) },
      { topic: '/mocap', type: 'geometry_msgs/msg/PoseStamped', t, message: poseStamped },
      { topic: '/other', type: 'geometry_msgs/msg/PoseStamped', t, message: poseStamped },
      { topic: '/third', type: 'geometry_msgs/msg/PoseStamped', t, message: poseStamped },
      { topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', t, message: twistOf(1, 2) },
      { topic: '/tf', type: 'tf2_msgs/msg/TFMessage', t, message: { transforms: [transformMessageOf(t, 'odom', 'base_link', i, 1, 0), transformMessageOf(t, 'map', 'base_link', 1.01 * i, 2, 0)] } },
    ];
  }).flat();
  const writeRecordingArgs = async (/** @type {string} */ recordingName, /** @type {string[]} */ ...recordedTopics) =>
    ['--recording', writeInFolder(recordingName, await recordingOf(odometryMessages.filter(({ topic: topicName }) => recordedTopics.includes(topicName)), { compression: 'zstd' }))];
  const readFourthRow = async (/** @type {string[]} */ ...args) => {
    const coreOptions = await readCoreOptions(args);
    return [coreOptions.odometry[0].y?.[3], coreOptions.odometry[0].omega?.[3], coreOptions.reference[0].y[3]];
  };
  const allTopicsArgs = await writeRecordingArgs('run.mcap', '/odom', '/mocap', '/other', '/cmd_vel');
  assert.deepEqual(await readFourthRow(...allTopicsArgs), [1, undefined, 2]);
  assert.deepEqual(await readFourthRow(...allTopicsArgs, '--odometry-topic', '/mocap', '--reference-topic', '/odom'), [2, undefined, 1]);
  assert.deepEqual(await readFourthRow(...allTopicsArgs, '--model', 'velocity'), [undefined, 2, 2]);
  const framesArgs = await writeRecordingArgs('tf.mcap', '/tf');
  assert.deepEqual(await readFourthRow(...framesArgs, '--odometry-frames', 'odom,base_link', '--reference-frames', 'map,base_link'), [1, undefined, 2]);
  for (const [args, expectedError] of /** @type {const} */ ([
    [
      await writeRecordingArgs('unclear.mcap', '/odom', '/other', '/third'),
      'unclear.mcap: it is not clear what the reference is: /odom (Odometry), /other (PoseStamped), /third (PoseStamped). For example:\n  npx motion-widgets calibrate --recording DIR/unclear.mcap --reference-topic /other\n',
    ],
    [await writeRecordingArgs('alone.mcap', '/odom'), 'alone.mcap: it has one log only, /odom (Odometry), by name or type the odometry; give the reference too. For example:\n  npx motion-widgets calibrate --recording DIR/alone.mcap --reference FILE\n'],
  ])) assert.equal((await runCalibrate(args)).stderr.replace(temporaryFolder, 'DIR'), expectedError);
});

test('invalid input gives exit code 2 and an error message', async () => {
  const straightLogPath = writeInFolder('straight.csv', ['t,x,y,yaw', ...Array.from({ length: 2000 }, (_, i) => `${1_600_000_000 + i / 20},${i / 40},0,0`)].join('\n'));
  for (const [args, expectedErrorStart] of /** @type {[string[], string][]} */ ([
    [[...LOG_ARGS, '--columns', 'other.csv=t,x,y,yaw'], 'an option names the file other.csv; the files are odometry.csv, reference.csv.\n'],
    [['--odometri', 'a'], "Unknown option '--odometri'. --help lists all options.\n"],
    [['--update-min-d', '--json'], "Option '--update-min-d' argument is ambiguous. "],
    [['--columns', '-,t,x,y,yaw'], "Option '--columns' argument is ambiguous. Did you forget to specify the option argument for '--columns'? To specify an option argument starting with a dash use '--columns=-XYZ'. --help "],
    [['a.bag', '--help=3'], "Option '-h, --help' does not take an argument. --help lists all options.\n"],
    [[writeInFolder('days.csv', ['t,x,y,yaw', ...Array.from({ length: 40 }, (_, i) => `${45_244 + i / 1_728_000},${i / 40},0,0`)].join('\n')), LOG_ARGS[3]], 'days.csv: in s, the times would mean 1.73e+6 rows a second; write them in s, or as dates such as 2024-01-31 12:00:00.5 (a spreadsheet counts days).\n'],
    [['no/metadata.yaml', 'no/run.mcap'], 'no: there is no such file or folder.\n'],
    [['no.bag', '--rule', 'Nav2'], '--rule is "Nav2"; allowed is '],
    [['--json'], 'no logs are given; give a recording, as in npx motion-widgets inspect run.bag, or two files, odometry and reference.'],
    [[...LOG_ARGS, '--plot', 'x.png'], '--plot writes SVG; the name must end in .svg (got “x.png”).'],
    [[...LOG_ARGS, '--json', '--yaml'], '--json excludes --yaml: give one or the other.'],
    [[...LOG_ARGS, '--update-min-d', '0,25'], '--update-min-d must be a number with a decimal point, 0.25 (got “0,25”).'],
    [[...LOG_ARGS, '--update-min-a', 'wide'], '--update-min-a must be a number (got “wide”).'],
    [[...LOG_ARGS, '--duration', '1', '--update-min-a', '1'], '--duration excludes --update-min-d and --update-min-a: give one or the other.'],
    [[...LOG_ARGS, '--no-correct', 'yaw'], '--no-correct must be all, or names of clockOffset, mountYaw, leverArm, distanceScale, turnScale (got “yaw”).'],
    [[...LOG_ARGS, '--reference-frames', 'map'], '--reference-frames must be a parent and a child frame, as in map,base_link (got “map”).'],
    [[...LOG_ARGS, '--time-unit', 'min'], '--time-unit must be s, ms, us, or ns, or FILE=s for one file (got “min”).'],
    [[...LOG_ARGS.slice(0, 2), '--reference', join(temporaryFolder, 'no.csv')], `${join(temporaryFolder, 'no.csv')}: there is no such file or folder.`],
    [[...LOG_ARGS, '--plot', join(temporaryFolder, 'no', 'plot.svg')], '--plot '],
    // Error messages of the core are adapted to the command line: they name its options and files.
    [[...LOG_ARGS, '--update-min-d=-1'], '--update-min-d is -1; allowed is '],
    [[...LOG_ARGS, '--reference-position-std=-1'], '--reference-position-std is -1; allowed is '],
    [[...LOG_ARGS.slice(0, 2), '--reference', straightLogPath], 'odometry.csv and straight.csv: odometry and reference have no time in common, and their turn rates correlate at no clock offset; '],
  ])) {
    const { exitCode, stdout, stderr } = await runCalibrate(args);
    assert.deepEqual([exitCode, stdout.replaceAll(/^(Odometry|Reference): .*\n( {2}.*\n)*/gm, '')], [2, ''], stderr);
    assert.ok(stderr.startsWith(expectedErrorStart) && stderr.endsWith('\n'), stderr);
  }
});

test('run in a shell, the command prints help and errors, and tolerates a closed pipe', () => {
  const runInShell = (/** @type {string[]} */ ...args) => spawnSync(process.execPath, [CLI_PATH, ...args], { encoding: 'utf8' });
  for (const helpOutput of [runInShell(), runInShell('calibrate', '--help')]) assert.deepEqual([helpOutput.status, helpOutput.stdout, helpOutput.stderr], [0, HELP_TEXT, '']);
  const refusalOutput = runInShell('calibrate', '--odometry', 'no.csv', '--reference', 'no.csv');
  assert.deepEqual([refusalOutput.status, refusalOutput.stdout, refusalOutput.stderr], [2, '', 'no.csv: there is no such file or folder.\n']);
  assert.match(runInShell('my/bag').stderr, /^the command must be calibrate or inspect \(got “my\/bag”\), as in npx motion-widgets inspect my\/bag; --help has examples\.$/m);
  const outputOfClosedPipe = spawnSync('sh', ['-c', '"$0" "$@" | head -c 1', process.execPath, CLI_PATH, 'calibrate', ...LOG_ARGS, '--json'], { encoding: 'utf8' });
  assert.deepEqual([outputOfClosedPipe.stdout, outputOfClosedPipe.stderr], ['{', '']);
  const outputOfPipedLog = spawnSync('sh', ['-c', 'cat "$2" | "$0" "$1" inspect /dev/stdin', process.execPath, CLI_PATH, examplePathOf('odometry')], { encoding: 'utf8' });
  assert.match(outputOfPipedLog.stdout, /^stdin: table\n.*\n.* 4494 /);
});

test('the intervals for the example recording contain the true α’s, and the JSON output has the keys in doc/calibration.md', async () => {
  /** @type {import('../mcap.js').Message[]} */
  const rosMessages = [];
  for (const [topicName, logRole, type] of [['/odom', 'odometry', 'nav_msgs/msg/Odometry'], ['/truth', 'reference', 'geometry_msgs/msg/PoseStamped']]) {
    for (const csvRow of readFileSync(examplePathOf(logRole), 'utf8').trim().split('\n').slice(1)) {
      const [t, x, y, theta] = csvRow.split(',').map(Number);
      const rosMessage = topicName === '/odom' ? odometryMessageOf(t, x, y, theta) : { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(x, y, theta) };
      rosMessages.push({ topic: topicName, type, t, message: rosMessage });
    }
  }
  const recordingPath = writeInFolder('example.mcap', await recordingOf(rosMessages.sort((a, b) => a.t - b.t), { compression: 'zstd', chunkSize: 100_000 }));
  const { status, stdout, stderr } = spawnSync(process.execPath, [CLI_PATH, 'calibrate', '--recording', recordingPath, '--json'], { encoding: 'utf8' });
  assert.equal(status, 0, stderr);
  const calibrationResult = JSON.parse(stdout);
  const assertInside = (/** @type {number} */ trueValue, /** @type {[number, number]} */ [lowerLimit, upperLimit]) => assert.ok(lowerLimit <= trueValue && trueValue <= upperLimit, `${trueValue}: ${lowerLimit} to ${upperLimit}`);
  for (const [i, trueAlpha] of TRUE_PARAMETERS.alphas.entries()) assertInside(trueAlpha, calibrationResult.intervals[i]);
  for (const errorName of /** @type {const} */ (['mountYaw', 'clockOffset', 'distanceScale'])) assertInside(TRUE_PARAMETERS[errorName], calibrationResult.systematicErrors[errorName].interval);
  assert.deepEqual([calibrationResult.diagnostics.verdict, calibrationResult.start, calibrationResult.date.length], ['consistent', 9, 10]);
  const [, jsonSection] = readFileSync(new URL('../../doc/calibration.md', import.meta.url), 'utf8').match(/\n### JSON\n(.*?)\n### /s) ?? [];
  assert.deepEqual(Object.keys(calibrationResult).filter((resultKey) => !jsonSection.includes(`\`${resultKey}\``)), []);
});

test('the report names the stated reference noise, and the outliers', async () => {
  const { exitCode, stdout } = await runCalibrate([...LOG_ARGS, '--rule', 'nav2', '--reference-yaw-std', '0']);
  assert.equal(exitCode, 0);
  for (const linePattern of [/^reference yaw σ \(rad\) +0 +—$/m, /^outliers: 1 of \d+ legs, at \d+\.\d\d s after the start$/m]) assert.match(stdout, linePattern);
});

test('doc/calibration.md shows the report of the example log', async () => {
  const [, documentedReport] = readFileSync(new URL('../../doc/calibration.md', import.meta.url), 'utf8').match(/\n```text\n(.*?)\s*```\n/s) ?? [];
  const { stdout } = await runCalibrate([...LOG_ARGS, '--rule', 'nav2']);
  assert.equal(documentedReport.replace(/\d{4}-\d\d-\d\d$/m, '2026-01-02'), stdout.trimEnd());
});

test('the command below an error or a verdict answers the question about a file', async () => {
  const { alphas } = JSON.parse((await runCalibrate([...LOG_ARGS, '--json'])).stdout);
  for (const [logRole, headerLine, changeRow, ...answerOptions] of /** @type {[string, string, (row: number[]) => number[], ...string[]][]} */ ([
    ['odometry', 't,x,y,yaw', ([t, x, y, yaw]) => [t, x / 0.3048, y / 0.3048, yaw], '--length-unit', 'odometry.csv=ft'],
    ['reference', 't,x,y,yaw', ([t, x, y, yaw]) => [t, x, y, (180 / Math.PI) * yaw], '--angle-unit', 'rad', '--angle-unit', 'reference.csv=deg'],
    ['reference', 'zeit,ost,nord,richtung', (tableRow) => tableRow, '--columns', 'reference.csv=t,x,y,yaw'],
    ['odometry', 't,x,y,yaw', ([t, x, y, yaw]) => [t, x, -y, yaw], '--columns', 'odometry.csv=t,x,-y,yaw'],
    ['reference', 't,x [m],y [m],yaw', ([t, x, y, yaw]) => [t, x, -y, -yaw], '--columns', 'reference.csv=t,x [m],-y [m],-yaw'],
  ])) {
    const changedRows = readFileSync(examplePathOf(logRole), 'utf8').trim().split('\n').slice(1).map((csvRow) => changeRow(csvRow.split(',').map(Number)).join(','));
    const logPaths = [writeInFolder(`${logRole}.csv`, [headerLine, ...changedRows].join('\n')), examplePathOf(logRole === 'odometry' ? 'reference' : 'odometry')];
    const { stdout, stderr } = await runCalibrate([...logPaths, ...answerOptions.slice(0, -2)]);
    const [, proposedCommand = ''] = /^ {2}npx motion-widgets calibrate (.*)$/m.exec(stdout + stderr) ?? [];
    const commandArgs = [...proposedCommand.matchAll(/'([^']*)'|\S+/g)].map(([shellWord, quotedText]) => quotedText ?? shellWord);
    assert.deepEqual(commandArgs, [...logPaths, ...answerOptions], stderr);
    const resultOfAnswer = JSON.parse((await runCalibrate([...commandArgs, '--json'])).stdout);
    for (const [i, alpha] of alphas.entries()) assert.ok(Math.abs(resultOfAnswer.alphas[i] / alpha - 1) < 1e-6, `${logRole} ${headerLine} ${resultOfAnswer.alphas}`);
  }
});

test('logs in a folder are read, and its other files are skipped', async () => {
  const driveFolder = join(temporaryFolder, 'drive');
  mkdirSync(driveFolder);
  for (const [fileName, exampleName] of [['odom.csv', 'odometry'], ['truth.csv', 'reference'], ['._odom.csv', 'odometry'], ['run.db3-shm', 'odometry']]) writeFileSync(join(driveFolder, fileName), readFileSync(examplePathOf(exampleName)));
  writeFileSync(join(driveFolder, 'README.md'), '# A drive\n\nwith words, and no numbers\n');
  writeFileSync(join(driveFolder, 'camera.mcap'), await recordingOf([0, 1].map((t) => ({ topic: '/image', type: 'std_msgs/msg/String', t, message: { data: '' } }))));
  let inspectionText = '';
  await runCommand(['inspect', driveFolder], { load, print: (printedText) => (inspectionText += printedText), printError: () => {} });
  assert.match(inspectionText, /^ {2}npx motion-widgets calibrate \S+\/drive --rule nav2$/m);
  const { exitCode, stdout, stderr } = await runCalibrate(['metadata.yaml', 'odom.csv'].map((fileName) => join(driveFolder, fileName)));
  assert.deepEqual([exitCode, stdout.match(/^\w+: .*\.csv$/gm)], [0, ['Odometry: odom.csv', 'Reference: truth.csv']]);
  assert.match(stderr, /^skipped: README\.md: it does not look like a log, .*\nskipped: camera\.mcap: the topics are \/image \(String\); .*\n$/);
});

test('a database journal next to a recording is reported, unless the journal is empty', async () => {
  for (const [journalHex, expectedMessage] of [['', ''], ['377f0682', 'skipped: odometry.db3-wal: it is a journal']]) {
    writeInFolder('odometry.db3-wal', Buffer.from(journalHex, 'hex'));
    const { exitCode, stderr } = await runCalibrate(['--odometry', writeInFolder('odometry.db3', readFileSync(examplePathOf('odometry'))), ...LOG_ARGS.slice(2)]);
    assert.deepEqual([exitCode, stderr.split(' with')[0]], [0, expectedMessage]);
  }
  // The database file is empty: all messages of the recording are still in its write-ahead journal.
  const databasePath = writeInFolder('run.db3', 'SQLite format 3\0');
  writeInFolder('run.db3-wal', Buffer.from('377f0682', 'hex'));
  for (const jsonArgs of [[], ['--json']]) {
    let [stdout, stderr] = ['', ''];
    const exitCode = await runCommand(['inspect', databasePath, ...jsonArgs], { load, print: (printedText) => (stdout += printedText), printError: (printedText) => (stderr += printedText) });
    assert.deepEqual([exitCode, stdout], [2, '']);
    assert.match(stderr, /^run\.db3-wal: it is a journal with messages that its \.db3 file lacks; /m);
  }
});

/** Writes the reference of another drive: the path of the example from end to start. */
const writeReversedReference = () => {
  const [headerLine, ...rowsOfCells] = readFileSync(examplePathOf('reference'), 'utf8').trim().split('\n').map((tableRow) => tableRow.split(','));
  return writeInFolder('other.csv', [headerLine, ...rowsOfCells.map(([t], i) => [t, ...rowsOfCells[rowsOfCells.length - 1 - i].slice(1)])].join('\n'));
};

test('--yaml prints only the lines for Nav2, and nothing for an unusable log', async () => {
  const { exitCode, stdout, stderr } = await runCalibrate([...LOG_ARGS, '--yaml', '--rule', 'nav2']);
  assert.equal(exitCode, 0);
  assert.match(stdout, /^amcl:\n {2}ros__parameters:\n[^]*\n {4}update_min_a: 0\.2\n$/);
  assert.match(stderr, /^Odometry: odometry\.csv\n {2}\d+ of \d+ rows, [^]*^Trust\. .*\nUse the recommended α’s with legs of this length\.\nFirst multiply the odometry’s distances by .*\n$/m);
  assert.match((await runCalibrate([...LOG_ARGS, '--yaml'])).stderr, /\nWarning: fitted by another rule than Nav2’s; give --rule nav2\.\n$/);
  const swappedOutput = await runCalibrate(['--odometry', examplePathOf('reference'), '--reference', examplePathOf('odometry'), '--yaml']);
  assert.match(swappedOutput.stderr, /^Caution. Warning: by their names, odometry and reference seem to be swapped\. .*: exchange the two\.$/m);
  // The legs of a reference at 1 Hz are longer than requested.
  const [headerLine, ...tableRows] = readFileSync(examplePathOf('reference'), 'utf8').trim().split('\n');
  const sparsePath = writeInFolder('sparse.csv', [headerLine, ...tableRows.filter((_, i) => i % 20 === 0)].join('\n'));
  const sparseOutput = await runCalibrate([...LOG_ARGS.slice(0, 3), sparsePath, '--yaml', '--rule', 'nav2']);
  const [, lengthRatio, printedDistance, printedAngle] = /legs are (\S+) times as long as requested\. .*\n +update_min_d: (\S+)\n +update_min_a: (\S+)\n$/.exec(sparseOutput.stdout)?.map(Number) ?? [];
  assert.ok(lengthRatio > 1.5, sparseOutput.stdout);
  assert.deepEqual([printedDistance / 0.25, printedAngle / 0.2].map((printedRatio) => Math.abs(printedRatio / lengthRatio - 1) < 0.005), [true, true]);
  const reversedPath = writeReversedReference();
  const refusalOutput = await runCalibrate([...LOG_ARGS.slice(0, 3), reversedPath, '--yaml']);
  assert.deepEqual([refusalOutput.exitCode, refusalOutput.stdout], [3, '']);
  assert.match(refusalOutput.stderr, /^No lines for nav2_params\.yaml: the log is unusable\.$/m);
});

test('--plot writes a panel for each drive, with both paths aligned, and the ends of legs at the times of the reference', async () => {
  const plotPath = join(temporaryFolder, 'plot.svg');
  assert.equal((await runCalibrate([...LOG_ARGS, '--plot', plotPath])).exitCode, 0);
  assert.match(readFileSync(plotPath, 'utf8'), /^<svg xmlns=/);
  /** Returns a drive of ten seconds. The reference leads along x. The odometry leads along y, and begins half a second earlier. @returns {any} */
  const createDriveAt = (/** @type {number} */ startTime) => {
    const drivePositions = Float64Array.from({ length: 101 }, (_, i) => i / 10);
    const createLog = (/** @type {string} */ logRole, /** @type {number} */ startDelay, /** @type {Float64Array} */ x, /** @type {Float64Array} */ y) => ({ logName: `${logRole}${startTime}.csv`, motionData: { t: drivePositions.map((t) => startTime + t + startDelay), x, y, theta: drivePositions, breaks: [] } });
    return { odometry: createLog('odom', 0, drivePositions.map(() => 7), drivePositions), reference: createLog('truth', 0.5, drivePositions, drivePositions.map(() => 2)) };
  };
  const legs = { count: 3, times: [1, 3, 4, 6, 21, 23], outliers: [0, 1, 0] };
  const svgText = createDrivesSvg([createDriveAt(0), createDriveAt(20)], { legs, systematicErrors: { clockOffset: { value: 0.5 } } });
  const [, ...panelSvgs] = svgText.split('<title>');
  assert.deepEqual(panelSvgs.map((panelSvg) => panelSvg.split('<')[0]), ['odom0.csv and truth0.csv: 2 legs, 1 outlier', 'odom20.csv and truth20.csv: 1 legs, 0 outliers']);
  for (const panelSvg of panelSvgs) {
    for (const labelPattern of [/>x \(m\)</, />y \(m\)</, />odometry, aligned</]) assert.match(panelSvg, labelPattern);
    // The pixel positions of two axis marks are compared with those of the ends of the drawn paths.
    const [axisLeft, axisMiddle] = ['0', '5'].map((axisMark) => Number(RegExp(`<text x="([\\d.]+)" [^>]*text-anchor="middle"[^>]*>${axisMark}<`).exec(panelSvg)?.[1]));
    const axisRight = 2 * axisMiddle - axisLeft;
    const isNearPixel = (/** @type {number} */ x, /** @type {number} */ expectedX) => Math.abs(x - expectedX) < 2;
    const drawnPaths = Array.from(panelSvg.matchAll(/d="M([\d.]+),[^"]{40,}L([\d.]+),[^"]*" fill="none" stroke="([^"]*)" stroke-width="1.5"/g), ([, startX, endX, strokeColor]) => ({ leftX: Number(startX), rightX: Number(endX), color: strokeColor }));
    assert.ok(drawnPaths.every(({ leftX, rightX }) => isNearPixel(leftX, axisLeft) && isNearPixel(rightX, axisRight)), JSON.stringify(drawnPaths));
    assert.equal(new Set(drawnPaths.map(({ color }) => color)).size, 2);
    // The path of a disc starts at its left side, 2 px from the centre.
    assert.ok(isNearPixel(Number(/d="M([\d.]+),[\d.]+a2,2 /.exec(panelSvg)?.[1]) + 2, axisLeft + 0.3 * (axisRight - axisLeft)));
  }
});

test('output to a terminal has colours', async () => {
  let stdout = '';
  await runCommand(['calibrate', ...LOG_ARGS], { load, print: (printedText) => (stdout += printedText), printError: assert.fail, isColored: true });
  assert.ok(stdout.includes('\n\x1b[32mTrust\x1b[0m. '), stdout);
});

test('inspect lists the contents of a file, and suggests the next command', async () => {
  const inspectionOf = async (/** @type {string[]} */ inspectArguments, expectedExitCode = 0) => {
    let [outputText, errorText] = ['', ''];
    assert.equal(await runCommand(['inspect', ...inspectArguments], { load, print: (printedText) => (outputText += printedText), printError: (printedText) => (errorText += printedText) }), expectedExitCode);
    assert.equal(errorText === '', expectedExitCode === 0);
    return (outputText + errorText).replaceAll(temporaryFolder, 'DIR');
  };
  const rosMessages = Array.from({ length: 40 }, (_, i) => {
    const t = 100 + i / 20;
    const rosHeader = { stamp: stampOf(t), frame_id: 'map' };
    return [
      { topic: '/odom', type: 'nav_msgs/msg/Odometry', t, message: odometryMessageOf(t, i, 1, 0) },
      { topic: '/vicon/robot 1', type: 'geometry_msgs/msg/PoseStamped', t, message: { header: rosHeader, pose: poseOf(i, 2, 0) } },
      { topic: '/chatter', type: 'std_msgs/msg/String', t, message: { data: '' } },
      { topic: '/lost', type: 'geometry_msgs/msg/PoseStamped', t, message: { header: rosHeader, pose: poseOf(NaN, 2, 0) } },
      { topic: '/tf', type: 'tf2_msgs/msg/TFMessage', t, message: { transforms: [transformMessageOf(t, 'map', 'base_link', i, 2, 0)] } },
    ];
  }).flat();
  const recordingInspection = await inspectionOf([writeInFolder('run.mcap', await recordingOf(rosMessages, { compression: 'zstd' }))]);
  for (const linePattern of [
    /^run\.mcap: MCAP recording$/m, /^ {2}\/chatter +std_msgs\/msg\/String +40$/m, /^ {2}\/odom +nav_msgs\/msg\/Odometry +40 +20\.0 Hz +odometry$/m,
    /^ {2}\/vicon\/robot 1 +geometry_msgs\/msg\/PoseStamped +40 +20\.0 Hz +reference$/m,
    /^ {2}\/tf \(map → base_link\) +tf2_msgs\/msg\/TFMessage +40 +20\.0 Hz +reference \(a localizer\)$/m, /^ {2}\/tf \(map → base_link\): 40 of 40 rows, 2\.0 s at 20\.0 Hz, 39\.0 m driven$/m, /^run\.mcap, topic \/lost, message 1: 0 of 40 rows can be used/m,
    /^ {2}npx motion-widgets calibrate DIR\/run\.mcap --odometry-topic \/odom --reference-topic '\/vicon\/robot 1' --rule nav2$/m,
  ]) assert.match(recordingInspection, linePattern);
  const [referenceCopy, odometryCopy] = [['b', 'reference'], ['a', 'odometry']].map(([copyName, logRole]) => writeInFolder(`${copyName}.csv`, readFileSync(examplePathOf(logRole))));
  assert.match(await inspectionOf([referenceCopy, odometryCopy]), /^b\.csv: its name does not say whether it is odometry or reference; .* For example:\n {2}npx motion-widgets inspect --odometry DIR\/b\.csv --reference DIR\/a\.csv$/m);
  const millimetrePath = writeInFolder('mm.csv', readFileSync(examplePathOf('reference'), 'utf8').replaceAll(/^([\d.]+),([\d.e-]+),([\d.e-]+)/gm, (_, t, x, y) => [t, 1000 * x, 1000 * y].join(',')));
  assert.match(await inspectionOf([millimetrePath], 2), /^mm\.csv: in m, the robot would drive at .* For example:\n.* --length-unit mm\.csv=mm$/m);
  assert.match(await inspectionOf([referenceCopy, odometryCopy, writeInFolder('empty_table.csv', 't,x,y,yaw\n')], 2), /^b\.csv: its name does not say whether it is odometry or reference;/m);
  assert.match(await inspectionOf([writeInFolder('vicon.csv', 'Frame,RX,TX\n0,1,2\n1,1,2\n')], 2), /^vicon\.csv, line 1: .* For example:\n.* --columns vicon\.csv=NAME1,NAME2,NAME3$/m);
  const alternatingPath = writeInFolder('alternating.csv', ['t,odom_x,odom_y,odom_yaw,gt_x,gt_y,gt_yaw', ...Array.from({ length: 40 }, (_, i) => `${i >> 1},${i % 2},0,0,${i % 2},1,0`)].join('\n'));
  assert.equal((await inspectionOf([alternatingPath], 2)).match(/give the log of one robot/g)?.length, 1);
  assert.doesNotMatch(await inspectionOf([examplePathOf('odometry'), millimetrePath], 2), /give the reference too/);
  assert.match(await inspectionOf(['--odometry', examplePathOf('odometry'), '--reference', millimetrePath, '--length-unit', 'mm.csv=mm']), /^ {2}npx motion-widgets calibrate --odometry \S+odometry\.csv --reference DIR\/mm\.csv --length-unit mm\.csv=mm --rule nav2$/m);
  const positionsPath = writeInFolder('positions.csv', ['t,odom_x,odom_y,odom_yaw,gt_x,gt_y', ...Array.from({ length: 40 }, (_, i) => `${i / 20},${i / 40},0,0,${i / 40},1`)].join('\n'));
  const { recordings: [{ series: seriesList }], ...otherInspection } = JSON.parse(await inspectionOf([positionsPath, '--json']));
  assert.deepEqual(seriesList.map((/** @type {any} */ { name: seriesName, rows: rowCount, uses: possibleUses, summary: logSummary }) => [seriesName, rowCount, possibleUses, logSummary?.seconds]), [['odom', 40, ['odometry'], 1.95], ['gt', 0, [], undefined]]);
  assert.deepEqual([otherInspection.missing.split(';')[0], otherInspection.command], ['positions.csv: gt (gt_x, gt_y) are positions without a heading', undefined]);
});

test('for an unusable log the command prints a reason and no lines for Nav2', async () => {
  const reversedPath = writeReversedReference();
  const { exitCode, stdout } = await runCalibrate([...LOG_ARGS.slice(0, 3), reversedPath]);
  assert.equal(exitCode, 3);
  for (const linePattern of [
    /^Do not use\. Failed: mismatch of odometry and reference; .*; … \(5 of 12 checks\)\.\nThe reference does not follow the odometry: /m,
    /^reference-matches +\S+ +0\.00100 – 0\.700 +✕ failed +mismatch of odometry and reference$/m,
    /^α₁ rotation noise from rotation +\S.* —$/m, /^No lines for nav2_params\.yaml: the log is unusable\.$/m,
  ]) assert.match(stdout, linePattern);
  assert.doesNotMatch(stdout, /amcl:|not identifiable: /);
});

test('the report, the lines for Nav2 and the figure agree on whether a localizer made the reference', async () => {
  for (const [referenceName, isLocalizer] of /** @type {const} */ ([['slam_pose', true], ['cartographer', true], ['truth_amcl', false]])) {
    const args = [...LOG_ARGS.slice(0, 3), writeInFolder(`${referenceName}.csv`, readFileSync(examplePathOf('reference')))];
    const [{ stdout }, { stdout: jsonText }] = [await runCalibrate(args), await runCalibrate([...args, '--json'])];
    const { logs: allLogs, ...stats } = JSON.parse(jsonText);
    const { rating: logRating } = judgeFit(/** @type {any} */ ({ viewModel: { stats, legs: stats.legs, fittedConfig: stats.systematicErrors }, warnings: warningsOf(allLogs.map((/** @type {any} */ { summary: logSummary }) => logSummary)) }));
    const localizerNotes = [stdout.includes(`\nCaution. ${en.nav2.localizer}\n`) && !stdout.includes(en.useAnywaySentence), stdout.includes(`# ${en.nav2.localizer}`), logRating === 'questionable'];
    assert.deepEqual(localizerNotes, [isLocalizer, isLocalizer, isLocalizer], referenceName);
  }
});

test('the report advises against α’s that are too small because the odometry moves sideways', async () => {
  const swappedPaths = [writeInFolder('first.csv', readFileSync(examplePathOf('reference'))), writeInFolder('second.csv', readFileSync(examplePathOf('odometry')))];
  const { stdout } = await runCalibrate(['--odometry', swappedPaths[0], '--reference', swappedPaths[1]]);
  assert.match(stdout, /^Caution\. [^]*sideways/m);
  assert.ok(!stdout.includes(en.useAnywaySentence));
});

test('the report names failed checks, lost legs and unidentified α’s, and recommends motions', async () => {
  const { odometry: odometryLogs, reference: referenceLog, ...options } = await readCoreOptions(LOG_ARGS);
  const calibration = /** @type {any} */ (await load()).calibrate({ ...options, odometry: odometryLogs, reference: referenceLog });
  const { diagnostics: fitDiagnostics, lost, persistence, systematicErrors } = calibration;
  const formatChangedReport = (/** @type {any} */ calibrationChange, optionsChange = {}) => formatReport({ calibration: { ...calibration, ...calibrationChange }, options: { ...options, ...optionsChange }, logs: [], command: '', start: 0, driveStarts: [10, 1000], date: '' });
  const failedChecks = [{ name: 'enough-legs', value: 20, expected: [100, Infinity], passed: false, message: 'Drive on.' }];
  const reportOfFailure = formatChangedReport({ diagnostics: { ...fitDiagnostics, verdict: 'questionable', checks: failedChecks } });
  assert.match(reportOfFailure, /^\nCaution\. Failed: number of legs \(1 of 1 checks\)\.\nDrive on\.\nIf the log .*\n[^]*^enough-legs +20 +≥ 100 +✕ failed +number of legs\nenough-legs: Drive on\.$/m);
  const roundedChecks = [{ name: 'window-2m-covered', value: 0.8636, expected: [0.8641, 1], passed: false, message: '' }];
  assert.match(formatChangedReport({ diagnostics: { ...fitDiagnostics, verdict: 'questionable', checks: roundedChecks } }), /^window-2m-covered +86\.36 % +86\.41 % – 100\.00 % +✕ failed +held-out windows of ≥ 2 m within 95 %$/m);
  assert.match(formatChangedReport({ recommended: null, diagnostics: { ...fitDiagnostics, verdict: 'unusable' } }), /^\nDo not use\. The log identifies no α\.\n\n/);
  const inflationChecks = [{ name: 'inflation-bounded', value: Infinity, expected: [1, 30], passed: false, message: 'Find the cause.' }];
  assert.match(formatChangedReport({ recommended: null, diagnostics: { ...fitDiagnostics, verdict: 'unusable', checks: inflationChecks } }), /^\nDo not use\. Failed: inflation .*\nFind the cause\.\n\n/);
  const legsWithOutliers = { count: 3, times: [12, 13, 14, 15, 1005, 1006], outliers: [1, 0, 1] };
  assert.match(formatChangedReport({ legs: legsWithOutliers }), /^outliers: 2 of 3 legs, at 2\.00 s of drive 1, 5\.00 s of drive 2 after the start$/m);
  assert.match(formatChangedReport({ lost: { ...lost, withoutReference: 3, standing: 7 } }), /^lost legs: 3 without reference, 7 standing still$/m);
  assert.match(formatChangedReport({ persistence: { ...persistence, length: 0.987 } }), /^correlation length +0\.99 m +—$/m);
  assert.match(formatChangedReport({ systematicErrors: { ...systematicErrors, turnScale: { value: 0.9, interval: [0.88, 0.92], constant: false, corrected: false } } }), /^turn scale factor .*  not a constant$/m);
  assert.match(formatChangedReport({ systematicErrors: { ...systematicErrors, mountYaw: { value: null, interval: null, constant: true, corrected: false } } }), /^mount yaw \(rad\) +not determined$/m);
  const unidentifiedAlphas = { alphas: [0.1, null, 0.1, null], notIdentifiable: [null, 'collinear', null, 'collinear'] };
  const reportOfUnidentified = formatChangedReport(unidentifiedAlphas);
  assert.match(reportOfUnidentified, /^\nCaution\. Not determined by this log: α₂, α₄; add ~50 straight legs and ~50 in-place rotations\.\nIf the log /);
  assert.match(reportOfUnidentified, /^α₂ rotation noise from translation +not determined: rotation and translation are collinear in this log; /m);
  const { rating: logRating, finding } = judgeFit(/** @type {any} */ ({ viewModel: { stats: { ...calibration, ...unidentifiedAlphas }, legs: calibration.legs, fittedConfig: systematicErrors }, warnings: [] }));
  assert.deepEqual([logRating, finding], ['questionable', 'Not determined by this log: α₂, α₄; add ~50 straight legs and ~50 in-place rotations.']);
  assert.match(formatChangedReport({ ...unidentifiedAlphas, notIdentifiable: [null, 'insufficient-rotation', null, null] }, { model: 'velocity' }), /^Caution\. Not determined by this log: α₂; add ~50 legs in tight bends\.$/m);
  assert.match(formatChangedReport({ alphas: [0, 0.1, 0.1, 0.1], intervals: [[0, 0.00123], [0.05, 0.2], null, null] }), /^α₁ rotation noise from rotation +≤ 0\.0012, 0\.0000 – 0\.0012 +≤ 0\.0015$/m);
  assert.match(formatChangedReport({}, { model: 'velocity' }), /^No lines for nav2_params\.yaml: Nav2 has no velocity model\.$/m);
  for (const declaredReason of readDeclaredReasons()) assert.ok(declaredReason in en.alphas.missingMotions, declaredReason);
});

/** Returns the reasons for which an α is not identifiable, as the core declares them. */
function readDeclaredReasons() {
  const [, reasonList] = readFileSync(new URL('../../dist/simulations.d.ts', import.meta.url), 'utf8').match(/type NotIdentifiable = "(.*)";/) ?? [];
  return reasonList.split('" | "');
}
