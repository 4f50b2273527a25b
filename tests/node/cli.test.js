// `npx motion-widgets calibrate`: options, output and errors.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { load } from '../../dist/core.js';
import { TRUTH } from '../../scripts/example-log.mjs';
import { HELP } from '../../www/cli/options.js';
import { textOf } from '../../www/cli/report.js';
import { run } from '../../www/cli/run.js';
import { de } from '../../www/widgets/alpha-calibrator/de.js';
import { en } from '../../www/widgets/alpha-calibrator/en.js';
import { odometry, poseOf, recordingOf, stampOf, transform, twistOf } from '../mcap.js';

const CLI = fileURLToPath(new URL('../../dist/cli.js', import.meta.url));
const example = (/** @type {string} */ name) => fileURLToPath(new URL(`../../examples/calibration/${name}.csv`, import.meta.url));
const FILES = ['--odometry', example('odometry'), '--reference', example('reference')];

/** @type {string} */
let folder;
before(() => (folder = mkdtempSync(join(tmpdir(), 'motion-cli-'))));
after(() => rmSync(folder, { recursive: true, force: true }));

/** @param {string} name @param {string | Uint8Array} contents */
function file(name, contents) {
  const path = join(folder, name);
  writeFileSync(path, contents);
  return path;
}

/** Runs the command in this process. @param {string[]} args @param {() => Promise<any>} [core] */
async function outputOf(args, core = load) {
  let [out, err] = ['', ''];
  const code = await run(['calibrate', ...args], { load: core, print: (text) => (out += text), complain: (text) => (err += text), now: new Date('2026-01-02T03:04:05Z') });
  return { code, out, err };
}

/** Returns what the core is called with. @param {string[]} args @returns {Promise<any>} */
async function callOf(args) {
  /** @type {any} */
  let call;
  const { err } = await outputOf(args, async () => ({ calibrate(/** @type {any} */ options) { call = options; throw new RangeError('stop'); } }));
  assert.ok(call, err);
  return call;
}

test('options reach the core', async () => {
  const { odometry: own, reference, ...fit } = await callOf(FILES);
  assert.deepEqual(fit, { byLength: true, legs: { distance: 0.25, angle: 0.2 } });
  assert.deepEqual([Object.keys(own), Object.keys(reference)], [['t', 'x', 'y', 'theta', 'breaks'], ['t', 'x', 'y', 'theta', 'breaks']]);
  const all = '--model omnidirectional --rule nav2 --distance 0.5 --angle 0.3 --noise triangular --robust --without mountYaw,leverArm --seed 7 --position-deviation 0.001 --heading-deviation 2e-3';
  const { reference: stated, ...rest } = await callOf([...FILES, ...all.split(' ')]);
  delete rest.odometry;
  const systematic = { clockOffset: true, mountYaw: false, leverArm: false, distanceScale: true, turnScale: true };
  assert.deepEqual(rest, { model: 'omnidirectional', rule: 'nav2', legs: { distance: 0.5, angle: 0.3 }, noise: 'triangular', robust: true, systematic, seed: 7, byLength: true });
  assert.deepEqual([stated.positionDeviation, stated.headingDeviation], [0.001, 0.002]);
  assert.deepEqual((await callOf([...FILES, '--robust', '0.02'])).robust, { outliers: 0.02 });
  assert.deepEqual((await callOf([...FILES, '--robust=0.03', '--duration=0.5'])).legs, { duration: 0.5 });
  assert.equal((await callOf([...FILES, '--rule', 'omni'])).model, 'omnidirectional');
});

test('a recording has both logs, by topics and frames that are clear or named', async () => {
  const messages = Array.from({ length: 40 }, (_, i) => {
    const t = 100 + i / 20;
    const pose = { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(i, 2, 0) };
    return [
      { topic: '/odom', type: 'nav_msgs/msg/Odometry', t, message: odometry(t, i, 1, 0) },
      { topic: '/mocap', type: 'geometry_msgs/msg/PoseStamped', t, message: pose },
      { topic: '/other', type: 'geometry_msgs/msg/PoseStamped', t, message: pose },
      { topic: '/third', type: 'geometry_msgs/msg/PoseStamped', t, message: pose },
      { topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', t, message: twistOf(1, 2) },
      { topic: '/tf', type: 'tf2_msgs/msg/TFMessage', t, message: { transforms: [transform(t, 'odom', 'base_link', i, 1, 0), transform(t, 'map', 'base_link', i, 2, 0)] } },
    ];
  }).flat();
  const recorded = async (/** @type {string} */ name, /** @type {string[]} */ ...topics) =>
    ['--recording', file(name, await recordingOf(messages.filter(({ topic }) => topics.includes(topic)), { compression: 'zstd' }))];
  const numbersOf = async (/** @type {string[]} */ ...args) => {
    const call = await callOf(args);
    return [call.odometry.y?.[3], call.odometry.omega?.[3], call.reference.y[3]];
  };
  const all = await recorded('run.mcap', '/odom', '/mocap', '/other', '/cmd_vel');
  assert.deepEqual(await numbersOf(...all), [1, undefined, 2]);
  assert.deepEqual(await numbersOf(...all, '--odom-topic', '/mocap', '--reference-topic', '/odom'), [2, undefined, 1]);
  assert.deepEqual(await numbersOf(...all, '--model', 'velocity'), [undefined, 2, 2]);
  const frames = await recorded('tf.mcap', '/tf');
  assert.deepEqual(await numbersOf(...frames, '--odom-frames', 'odom,base_link', '--frames', 'map,base_link'), [1, undefined, 2]);
  for (const [args, sentence] of /** @type {const} */ ([
    [frames, 'tf.mcap: which topic is the odometry is not clear; expected is a choice of /tf (TFMessage), by --odom-frames.\n'],
    [
      await recorded('unclear.mcap', '/odom', '/other', '/third'),
      'unclear.mcap: which topic is the reference is not clear; expected is a choice of /odom (Odometry), /other (PoseStamped), /third (PoseStamped), by --reference-topic.\n',
    ],
    [await recorded('alone.mcap', '/odom'), 'alone.mcap: the only topic of use is /odom (Odometry); expected are two, of odometry and of the reference.\n'],
  ])) assert.equal((await outputOf(args)).err, sentence);
});

test('bad input has the exit code 2 and a sentence', async () => {
  const straight = file('straight.csv', ['t,x,y,yaw', ...Array.from({ length: 2000 }, (_, i) => `${1_600_000_000 + i / 20},${i / 40},0,0`)].join('\n'));
  for (const [args, start] of /** @type {[string[], string][]} */ ([
    [['odom.csv'], '“odom.csv” belongs to no option; expected are options such as --odometry.'],
    [['--odometri', 'a'], "Unknown option '--odometri'."],
    [['--distance', '--json'], "Option '--distance' argument is ambiguous."],
    [['--odometry', example('odometry')], '--reference is missing; expected is a file, or --recording with both.'],
    [[...FILES, '--distance', '0,25'], '--distance is “0,25”; expected is a number with a decimal point, 0.25.'],
    [[...FILES, '--angle', 'wide'], '--angle is “wide”; expected is a number.'],
    [[...FILES, '--robust=some'], '--robust is “some”; expected is a number.'],
    [[...FILES, '--duration', '1', '--angle', '1'], '--duration is 1 beside --distance or --angle; expected is either the one or the others.'],
    [[...FILES, '--without', 'yaw'], '--without has “yaw”; expected are names of clockOffset, mountYaw, leverArm, distanceScale, turnScale.'],
    [[...FILES, '--frames', 'map'], '--frames is “map”; expected are a parent and a child, as in map,base_link.'],
    [[...FILES, '--frames', 'map,base_link'], 'reference.csv is no recording and has no frames map and base_link; expected is an MCAP file.'],
    [[...FILES, '--odom-topic', '/odom'], 'odometry.csv is no recording and has no topic /odom; expected is an MCAP file.'],
    [['--recording', FILES[1]], 'odometry.csv is no MCAP recording; expected is one for both odometry and reference, or two tables.'],
    [[...FILES, '--reference', tmpdir()], `${tmpdir().slice(1)}: the file cannot be read (no file); expected is one that is still there.`],
    // Errors of the core, by the names of options and files.
    [[...FILES, '--distance=-1'], '--distance is -1; allowed is '],
    [[...FILES, '--robust', '0.9'], '--robust is 0.9; allowed is '],
    [[...FILES, '--position-deviation=-1'], '--position-deviation is -1; allowed is '],
    [[...FILES, '--rule', 'amcl'], '--rule is "amcl"; allowed is '],
    [[...FILES.slice(0, 2), '--reference', straight], 'odometry.csv and straight.csv: odometry and reference have no time in common, and turn alike at no offset of their clocks; '],
  ])) {
    const { code, out, err } = await outputOf(args);
    assert.deepEqual([code, out], [2, '']);
    assert.ok(err.startsWith(start) && err.endsWith('\n'), err);
  }
});

test('a shell gets help, errors, and a pipe that is closed', () => {
  const shell = (/** @type {string[]} */ ...args) => spawnSync(process.execPath, [CLI, ...args], { encoding: 'utf8' });
  for (const help of [shell(), shell('calibrate', '--help')]) assert.deepEqual([help.status, help.stdout, help.stderr], [0, HELP, '']);
  const refused = shell('calibrate', '--odometry', 'no.csv', '--reference', 'no.csv');
  assert.deepEqual([refused.status, refused.stdout, refused.stderr], [2, '', 'no.csv: the file cannot be read (ENOENT); expected is one that is still there.\n']);
  assert.match(shell('calibrat').stderr, /^the command is “calibrat”; expected is calibrate\.$/m);
  const closed = spawnSync('sh', ['-c', '"$0" "$@" | head -c 1', process.execPath, CLI, 'calibrate', ...FILES, '--json'], { encoding: 'utf8' });
  assert.deepEqual([closed.stdout, closed.stderr], ['{', '']);
});

test('a recording of the example has the truth in its intervals, and its JSON the keys of doc/calibration.md', async () => {
  /** @type {import('../mcap.js').Message[]} */
  const messages = [];
  for (const [topic, name, type] of [['/odom', 'odometry', 'nav_msgs/msg/Odometry'], ['/truth', 'reference', 'geometry_msgs/msg/PoseStamped']]) {
    for (const row of readFileSync(example(name), 'utf8').trim().split('\n').slice(1)) {
      const [t, x, y, theta] = row.split(',').map(Number);
      const message = topic === '/odom' ? odometry(t, x, y, theta) : { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(x, y, theta) };
      messages.push({ topic, type, t, message });
    }
  }
  const path = file('example.mcap', await recordingOf(messages.sort((a, b) => a.t - b.t), { compression: 'zstd', chunkSize: 100_000 }));
  const { status, stdout, stderr } = spawnSync(process.execPath, [CLI, 'calibrate', '--recording', path, '--json'], { encoding: 'utf8' });
  assert.equal(status, 0, stderr);
  const result = JSON.parse(stdout);
  const within = (/** @type {number} */ value, /** @type {[number, number]} */ [low, high]) => assert.ok(low <= value && value <= high, `${value}: ${low} to ${high}`);
  for (const [i, alpha] of TRUTH.alphas.entries()) within(alpha, result.intervals[i]);
  for (const name of /** @type {const} */ (['mountYaw', 'clockOffset', 'distanceScale'])) within(TRUTH[name], result.systematic[name].interval);
  assert.deepEqual([result.doubts.verdict, result.start], ['fits', 9]);
  const [, section] = readFileSync(new URL('../../doc/calibration.md', import.meta.url), 'utf8').match(/\n### JSON\n(.*?)\n### /s) ?? [];
  assert.deepEqual(Object.keys(result).filter((key) => !section.includes(`\`${key}\``)), []);
});

test('the text has the α’s, systematic errors, doubts, a verdict, lines for Nav2, and sentences for figures that are missing', async () => {
  const { out } = await outputOf([...FILES, '--rule', 'nav2', '--distance', '1', '--angle', '1', '--position-deviation', '0.001']);
  for (const line of [
    /^odometry\.csv: \d+ of \d+ rows, /m, /^the reference errs by 0\.001 m, as stated; its heading is taken to be exact; .*: state it by --heading-deviation$/m,
    /^alpha1 +\d\.\d+ +\S+ to \S+ +\S+ to \S+ +rotation noise from rotation$/m, /^by length +0\.25 m, 0\.25 rad +0\.5 m, 0\.5 rad /m, /^mount yaw +0\.0\d+ rad +\S+ to \S+ +removed$/m,
    /^held-out residuals inside of 95 % +\S+ % /m, /^amcl:\n {2}ros__parameters:\n {4}# \d+ legs of 1 m or 1 rad of odometry\.csv and reference\.csv, 2026-01-02; /m,
    /^ {4}alpha1: \d\.\d+ {2}# \S+ to \S+$/m, /^ {4}update_min_d: 1\.0\n {4}update_min_a: 1\.0$/m,
  ]) assert.match(out, line);

  const { reference, ...call } = await callOf(FILES);
  const calibration = /** @type {any} */ (await load()).calibrate({ ...call, reference });
  const { doubts, systematic, alphas, intervals, bootstrap } = calibration;
  const printed = (/** @type {any} */ change, fit = {}) =>
    textOf({ calibration: { ...calibration, ...change }, fit: { legs: call.legs, ...fit }, deviations: {}, logs: [], start: 0, date: '' });
  for (const verdict of /** @type {(keyof typeof en.verdicts)[]} */ (Object.keys(en.verdicts))) {
    const text = printed({ doubts: { ...doubts, verdict } });
    const sentence = `${en.verdicts[verdict](/(?<=inside of 95 % +)[\d.]+ %/.exec(text)?.[0] ?? '')} ${en.nextSteps[verdict]}`;
    assert.ok(text.includes(`\n${sentence}\n`), verdict);
    assert.equal(text.includes(`    # ${sentence}\n`), verdict !== 'fits', verdict);
  }
  const declared = readFileSync(new URL('../../dist/machines.d.ts', import.meta.url), 'utf8').match(/verdict: '(.*)';/)?.[1].split("' | '");
  for (const { verdicts } of [en, de]) assert.deepEqual(Object.keys(verdicts).sort(), declared?.sort());
  const undetermined = ['one-ratio', 'one-ratio', 'drives-too-little', 'one-ratio'];
  assert.match(printed({ undetermined }), /^alpha3 not determined: too little translation in this log; add ~50 straight legs\nalpha1, alpha2, and alpha4 not determined: /m);
  assert.match(printed({ undetermined: [null, 'turns-too-little', null, null] }, { model: 'velocity' }), /^alpha2 not determined: too little rotation in this log; add ~50 legs in tight bends$/m);
  const upTo = (/** @type {any[]} */ all) => all.toSpliced(1, 1, [0, 0.00123]);
  const zero = printed({ alphas: alphas.toSpliced(1, 1, 0), intervals: upTo(intervals), bootstrap: upTo(bootstrap) });
  assert.match(zero, /^alpha2 +≤ 0\.0012 +0\.0000 to 0\.0012 .*\n(.*\n)*alpha2 not told from 0: to tell it, add ~50 straight legs$/m);
  assert.match(printed({ alphas: [null, null, null, null], undetermined }), /^alpha1 +not determined by this log/m);
  assert.match(printed({ byLength: [{ factor: 1, legs: 3, alphas: [null, null, null, null], bootstrap: [null, null, null, null] }] }), /^–: too few legs, /m);
  assert.match(printed({ systematic: { ...systematic, mountYaw: { value: null, interval: null, removed: false } } }), /^mount yaw +not determined$/m);
  assert.match(printed({ gaps: { odometry: 1, reference: 2 } }), /^no leg leads across 1 gap of the odometry and 2 of the reference$/m);
});
