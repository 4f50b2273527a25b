// `npx motion-widgets calibrate`, as a shell has it.

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
import { run } from '../../www/cli/run.js';
import { de } from '../../www/widgets/alpha-calibrator/de.js';
import { en } from '../../www/widgets/alpha-calibrator/en.js';
import { between } from '../../www/widgets/alpha-calibrator/lines.js';
import { readLog, together } from '../../www/widgets/alpha-calibrator/log/read.js';
import { odometry, poseOf, recordingOf, stampOf, twistOf, transform } from '../mcap.js';

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

/** What the command says, in this process. @param {string[]} args @param {() => Promise<any>} [core] */
async function said(args, core = load) {
  let [out, err] = ['', ''];
  const code = await run(args, { load: core, print: (text) => (out += text), complain: (text) => (err += text), now: new Date('2026-01-02T03:04:05Z') });
  return { code, out, err };
}

/** What the core is asked for. @param {string[]} args @returns {Promise<any>} */
async function askedOf(args) {
  /** @type {any} */
  let asked;
  class Asked extends RangeError {}
  const calibrate = (/** @type {any} */ options) => {
    asked = options;
    throw new Asked('enough');
  };
  const { err } = await said(['calibrate', ...args], async () => ({ calibrate }));
  assert.ok(asked, err);
  return asked;
}

test('the options reach the core', async () => {
  const { odometry: own, reference, ...fit } = await askedOf(FILES);
  assert.deepEqual(fit, { byLength: true, legs: { distance: 0.25, angle: 0.2 } });
  assert.deepEqual([Object.keys(own), Object.keys(reference)], [['t', 'x', 'y', 'theta', 'breaks'], ['t', 'x', 'y', 'theta', 'breaks']]);
  const all = '--model omnidirectional --rule nav2 --distance 0.5 --angle 0.3 --noise triangular --robust --without mountYaw,leverArm --seed 7 --position-deviation 0.001 --heading-deviation 2e-3';
  const { reference: told, ...rest } = await askedOf([...FILES, ...all.split(' ')]);
  delete rest.odometry;
  const systematic = { clockOffset: true, mountYaw: false, leverArm: false, distanceScale: true, turnScale: true };
  assert.deepEqual(rest, { model: 'omnidirectional', rule: 'nav2', legs: { distance: 0.5, angle: 0.3 }, noise: 'triangular', robust: true, systematic, seed: 7, byLength: true });
  assert.deepEqual([told.positionDeviation, told.headingDeviation], [0.001, 0.002]);
  assert.deepEqual((await askedOf([...FILES, '--robust', '0.02', '--duration', '0.5'])).robust, { outliers: 0.02 });
  assert.deepEqual((await askedOf([...FILES, '--robust=0.03', '--duration=0.5'])).legs, { duration: 0.5 });
});

test('a recording gives both, by the topics that can be meant or are named', async () => {
  const messages = Array.from({ length: 40 }, (_, i) => {
    const t = 100 + i / 20;
    const pose = { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(i, 2, 0) };
    return [
      { topic: '/odom', type: 'nav_msgs/msg/Odometry', t, message: odometry(t, i, 1, 0) },
      { topic: '/mocap', type: 'geometry_msgs/msg/PoseStamped', t, message: pose },
      { topic: '/other', type: 'geometry_msgs/msg/PoseStamped', t, message: pose },
      { topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', t, message: twistOf(1, 2) },
    ];
  }).flat();
  const path = file('run.mcap', await recordingOf(messages, { compression: 'zstd' }));
  const both = await askedOf(['--recording', path]);
  assert.deepEqual([both.odometry.y[3], both.reference.y[3]], [1, 2]);
  const named = await askedOf(['--recording', path, '--odom-topic', '/mocap', '--reference-topic', '/odom']);
  assert.deepEqual([named.odometry.y[3], named.reference.y[3]], [2, 1]);
  const driven = await askedOf(['--recording', path, '--model', 'velocity']);
  assert.deepEqual([driven.odometry.v[3], driven.odometry.omega[3]], [1, 2]);
  assert.deepEqual((await askedOf(['--recording', path, '--odom-topic', '/odom', '--model', 'velocity'])).odometry.y[3], 1);
  const unclear = file('unclear.mcap', await recordingOf(messages.filter(({ topic }) => topic !== '/mocap').map((each) => (each.topic === '/cmd_vel' ? { ...each, topic: '/third', type: 'nav_msgs/msg/Odometry', message: odometry(each.t, 0, 0, 0) } : each))));
  const { code, err } = await said(['calibrate', '--recording', unclear]);
  assert.deepEqual([code, err], [2, 'unclear.mcap: which topic is the reference is not clear; expected is a choice of /odom (Odometry), /other (PoseStamped), /third (Odometry), by --reference-topic.\n']);
  // Of transforms alone the frames are asked for, and are enough.
  const moving = messages.filter(({ topic }) => topic === '/odom').flatMap(({ t }, i) => [['odom', 'base_link', i, 1], ['map', 'base_link', i, 2]].map(([parent, child, x, y]) => ({ topic: '/tf', type: 'tf2_msgs/msg/TFMessage', t, message: { transforms: [transform(t, String(parent), String(child), Number(x), Number(y), 0)] } })));
  const frames = file('tf.mcap', await recordingOf(moving));
  assert.equal((await said(['calibrate', '--recording', frames])).err, 'tf.mcap: which topic is the odometry is not clear; expected is a choice of /tf (TFMessage), by --odom-frames.\n');
  const framed = await askedOf(['--recording', frames, '--odom-frames', 'odom,base_link', '--frames', 'map,base_link']);
  assert.deepEqual([framed.odometry.y[3], framed.reference.y[3]], [1, 2]);
  const alone = file('alone.mcap', await recordingOf(messages.filter(({ topic }) => topic === '/odom')));
  assert.equal((await said(['calibrate', '--recording', alone])).err, 'alone.mcap: the only topic of use is /odom (Odometry); expected are two, of odometry and of the reference.\n');
});

for (const [args, sentence] of /** @type {[string[], RegExp][]} */ ([
  [['calibrat'], /^the command is “calibrat”; expected is calibrate\.$/],
  [['calibrate', 'odom.csv'], /^“odom\.csv” belongs to no option; expected are options such as --odometry\.$/],
  [['calibrate', '--odometri', 'a'], /^--odometri is no option; expected are those of --help\.$/],
  [['calibrate', '--odometry'], /^--odometry has no value; expected is one after it, or after = where it begins with -\.$/],
  [['calibrate', ...FILES, '--distance', '-1', '-2'], /^-2 is no option; expected are those of --help\.$/],
  [['calibrate', ...FILES, '--distance', '--json'], /^--distance has no value; expected is one after it, or after = where it begins with -\.$/],
  [['calibrate', '--odometry', '-odom.csv'], /^--odometry has no value; expected is one after it, or after = where it begins with -\.$/],
  [['calibrate', ...FILES, '--odometry', 'b.csv'], /^--odometry is given more than once; expected is one of it\.$/],
  [['calibrate', ...FILES, '--robust', '--robust', '0.1'], /^--robust is given more than once; expected is one of it\.$/],
  [['calibrate', ...FILES, '--distance', '0,25'], /^--distance is “0,25”; expected is a number with a decimal point, 0\.25\.$/],
  [['calibrate', ...FILES, '--position-deviation', '-0,5'], /^--position-deviation is “-0,5”; expected is a number with a decimal point, -0\.5\.$/],
  [['calibrate', ...FILES, '--distance', '0,25,3'], /^--distance is “0,25,3”; expected is a number\.$/],
  [['calibrate', '--reference', 'a.csv'], /^--odometry is missing; expected is a file, or --recording with both\.$/],
  [['calibrate', ...FILES, '--angle', 'wide'], /^--angle is “wide”; expected is a number\.$/],
  [['calibrate', ...FILES, '--robust=some'], /^--robust is “some”; expected is a number\.$/],
  [['calibrate', ...FILES, '--duration', '1', '--angle', '1'], /^--duration is 1 beside --distance or --angle; expected is either the one or the others\.$/],
  [['calibrate', ...FILES, '--without', 'yaw'], /^--without has “yaw”; expected are names of clockOffset, mountYaw, leverArm, distanceScale, turnScale\.$/],
  [['calibrate', ...FILES, '--frames', 'map'], /^--frames is “map”; expected are a parent and a child, as in map,base_link\.$/],
  [['calibrate', ...FILES, '--frames', 'map,base_link'], /^reference\.csv is no recording and has no frames map and base_link; expected is an MCAP file\.$/],
  [['calibrate', ...FILES, '--odom-topic', '/odom'], /^odometry\.csv is no recording and has no topic \/odom; expected is an MCAP file\.$/],
  [['calibrate', ...FILES.slice(0, 2), '--reference', 'none.csv'], /^none\.csv: the file cannot be read \(ENOENT\); expected is one that is still there\.$/],
  [['calibrate', ...FILES.slice(0, 2), '--reference', tmpdir()], /^.*: the file cannot be read \(no file\); expected is one that is still there\.$/],
])) {
  test(`bad input has the exit code 2 and a sentence: ${args.filter((arg) => !arg.includes('/')).join(' ')}`, async () => {
    const { code, out, err } = await said(args);
    assert.deepEqual([code, out], [2, '']);
    assert.match(err.trimEnd(), sentence);
  });
}

test('what the core refuses of the options, it refuses by their names', async () => {
  for (const [asked, start] of /** @type {[string[], string][]} */ ([
    [['--distance=-1'], '--distance is -1;'],
    [['--distance', '-1'], '--distance is -1;'],
    [['--angle', '0'], '--angle is 0;'],
    [['--duration', '1e9'], '--duration is 1000000000;'],
    [['--robust', '0.9'], '--robust is 0.9;'],
    [['--position-deviation', '-1'], '--position-deviation is -1;'],
    [['--heading-deviation', '1e4'], '--heading-deviation is 10000;'],
    [['--seed', '1.5'], '--seed is 1.5;'],
    [['--model', 'omni'], '--model is "omni";'],
    [['--rule', 'amcl'], '--rule is "amcl";'],
    [['--model', 'velocity', '--rule', 'nav2'], '--rule does not go with the model;'],
    [['--noise', 'gauss'], '--noise is "gauss";'],
  ])) {
    const { code, err } = await said(['calibrate', ...(asked[1] === 'velocity' ? COMMANDS() : FILES), ...asked]);
    assert.equal(code, 2);
    assert.ok(err.startsWith(start), err);
    assert.match(err, /; allowed (is|are) .*[^.]\.\n$/);
  }
});

/** The example with commands in the place of its odometry. */
const COMMANDS = () => ['--odometry', file('driven.csv', 't,v,omega\n10,1,0\n11,1,0\n12,1,0\n'), '--reference', example('reference')];

test('what the core refuses of the logs, it refuses by theirs', async () => {
  const { code, err } = await said(['calibrate', ...FILES, '--distance', '1000', '--angle', '1000']);
  assert.equal(code, 2);
  assert.match(err, /^odometry\.csv and reference\.csv: /);
});

test('the help names what the core takes', async () => {
  const motion = /** @type {any} */ (await load());
  const { odometry: own, reference } = await askedOf(FILES);
  for (const name of ['model', 'rule', 'noise']) {
    assert.throws(() => motion.calibrate({ odometry: own, reference, [name]: 'none' }), ({ message }) => {
      const words = [...message.slice(message.indexOf(';')).matchAll(/"(\w+)"/g)].map(([, word]) => word);
      assert.ok(words.length > 1);
      const [, said] = HELP.match(new RegExp(`\n  --${name} NAME ((?:[^\n]|\n {10})*)`)) ?? [];
      assert.deepEqual(words.filter((word) => !new RegExp(`\\b${word}\\b`).test(said)), []);
      return true;
    });
  }
});

test('tables with decimal commas are refused by a sentence that says what is expected', async () => {
  const texts = ['odometry', 'reference'].map((name) => /** @type {[string, string]} */ ([name, readFileSync(example(name), 'utf8')]));
  const asked = (/** @type {string} */ kind, /** @type {(text: string) => string} */ change) =>
    texts.flatMap(([name, text]) => [`--${name}`, file(`${kind}-${name}.csv`, change(text))]);
  const semicolons = await said(['calibrate', ...asked('semicolons', (text) => text.replaceAll(',', ';').replaceAll('.', ','))]);
  assert.deepEqual([semicolons.code, semicolons.err], [2, 'semicolons-odometry.csv, line 2: t is “10,000”; expected is a number with a decimal point.\n']);
  const commas = await said(['calibrate', ...asked('commas', (text) => text.replaceAll('.', ','))]);
  assert.equal(commas.code, 2);
  assert.match(commas.err, /^commas-odometry\.csv, line \d: the row has \d cells, and the header 4; expected are as many, with decimal points in numbers\.\n$/);
  // Semicolons alone separate as commas do, and a comma at the end of each row is none between cells.
  const points = await said(['calibrate', ...asked('points', (text) => text.replaceAll(',', ';')), '--json']);
  const ends = await said(['calibrate', ...asked('ends', (text) => text.replaceAll(/(?<=\d)$/gm, ',')), '--json']);
  const clean = await said(['calibrate', ...FILES, '--json']);
  for (const { out } of [points, ends]) assert.deepEqual(JSON.parse(out).alphas, JSON.parse(clean.out).alphas);
});

test('each verdict has its sentence, and stands beside the lines for Nav2 where there is something to doubt', async () => {
  const motion = /** @type {any} */ (await load());
  const declared = readFileSync(new URL('../../dist/machines.d.ts', import.meta.url), 'utf8').match(/verdict: ('.*');/)?.[1];
  const known = /** @type {(keyof typeof en.verdicts)[]} */ (declared?.split(' | ').map((each) => each.slice(1, -1)));
  for (const { verdicts } of [en, de]) assert.deepEqual(Object.keys(verdicts).sort(), known.toSorted());
  for (const verdict of known) {
    const calibrate = (/** @type {any} */ options) => {
      const told = motion.calibrate(options);
      return { ...told, doubts: { ...told.doubts, verdict } };
    };
    const { out } = await said(['calibrate', ...FILES], async () => ({ calibrate }));
    const lines = out.split('\n');
    const [coverage] = out.match(/(?<=inside of 95 % +)[\d.]+ %/) ?? [''];
    const sentence = en.verdicts[verdict](coverage);
    assert.ok(lines.includes(sentence), `${verdict}: ${out}`);
    assert.equal(lines.includes(`    # ${sentence}`), verdict !== 'fits', verdict);
  }
});

/** The example's reference with other rows. @param {(cells: number[], i: number) => number[] | undefined} change */
function referenceOf(change) {
  const [header, ...rows] = readFileSync(example('reference'), 'utf8').trim().split('\n');
  const cells = rows.map((row) => row.split(',').map(Number)).flatMap((row, i) => [change(row, i) ?? []]);
  return file('changed.csv', [header, ...cells.filter((row) => row.length).map((row) => row.join(','))].join('\n'));
}

/** What is told of the example with another reference. @param {string} path @param {string[]} more */
async function toldOf(path, ...more) {
  const { code, out, err } = await said(['calibrate', '--odometry', example('odometry'), '--reference', path, '--json', ...more]);
  assert.equal(code, 0, err);
  return JSON.parse(out);
}

test('a reference that jumps, is lost and says nothing for a while: what is left is as good without --robust', async () => {
  const clean = await toldOf(example('reference'));
  // Fifty times half a metre aside for three rows, and back; ten times no number; four seconds of one pose.
  const jumps = (/** @type {number} */ i) => i % 80 >= 40 && i % 80 < 43;
  let held = [0, 0, 0];
  const path = referenceOf(([t, x, y, yaw], i) => {
    if (i <= 1000) held = [x, y, yaw];
    if (i > 1000 && i < 1080) return [t, ...held];
    if (i % 400 === 7) return [t, NaN, y, yaw];
    return jumps(i) ? [t, x + 0.4, y + 0.3, yaw] : [t, x, y, yaw];
  });
  const told = await toldOf(path);
  assert.ok(told.gaps.reference > 100 && told.gaps.odometry === 0, JSON.stringify(told.gaps));
  assert.match(told.logs[1].found.join('\n'), /jumps, the first at .*/);
  for (const [i, alpha] of TRUTH.alphas.entries()) {
    const [low, high] = told.intervals[i];
    assert.ok(low <= alpha && alpha <= high, `α${i + 1}: ${low} to ${high}`);
    assert.ok(Math.abs(told.alphas[i] / clean.alphas[i] - 1) < 0.35, `α${i + 1}: ${told.alphas[i]}, ${clean.alphas[i]}`);
  }
  assert.equal(told.doubts.verdict, 'fits');
  // Handed to the core without its breaks, the same log says something else.
  const motion = /** @type {any} */ (await load());
  const { odometry: own, reference } = together(...(await Promise.all([readLog(new File([readFileSync(example('odometry'))], 'odometry.csv')), readLog(new File([readFileSync(path)], 'changed.csv'))])));
  const { alphas } = motion.calibrate({ odometry: own.data, reference: { ...reference.data, breaks: undefined } });
  assert.ok(Math.max(...alphas.map((/** @type {number} */ alpha, /** @type {number} */ i) => alpha / clean.alphas[i])) > 10, alphas.join(' '));
});

test('clocks without a common time are aligned by the turns, which is said; two drives are refused', async () => {
  const clean = await toldOf(example('reference'));
  const told = await toldOf(referenceOf(([t, ...pose]) => [t + 1_600_000_000, ...pose]));
  assert.match(told.logs[1].found.at(-1), /^its times \(16000000\d\d\.\d\d s to .* s\) and those of odometry\.csv \(10\.00 s to .* s\) have nothing in common: the clocks are aligned by how the robot turned$/);
  const { value, interval } = told.systematic.clockOffset;
  assert.ok(Math.abs(value - 1_600_000_000.12) < 0.01 && interval[0] < 1_600_000_000.12 && 1_600_000_000.12 < interval[1], `${value} ${interval}`);
  // A quarter of a microsecond is all that doubles know of such times.
  for (const [i, alpha] of told.alphas.entries()) assert.ok(Math.abs(alpha / clean.alphas[i] - 1) < 1e-3, `${alpha}`);
  const straight = referenceOf(([t, x]) => [t + 1_600_000_000, x, 0, 0]);
  const { code, err } = await said(['calibrate', '--odometry', example('odometry'), '--reference', straight]);
  assert.deepEqual([code, err], [2, 'odometry.csv and changed.csv: odometry and reference have no time in common, and turn alike at no offset of their clocks; allowed are two logs of one drive.\n']);
});

test('from a shell: help, a sentence, and a pipe that is closed', () => {
  const shell = (/** @type {string[]} */ ...args) => spawnSync(process.execPath, [CLI, ...args], { encoding: 'utf8' });
  for (const help of [shell(), shell('--help'), shell('calibrate', '--help')]) assert.deepEqual([help.status, help.stdout, help.stderr], [0, HELP, '']);
  const refused = shell('calibrate', '--odometry', 'no.csv', '--reference', 'no.csv');
  assert.deepEqual([refused.status, refused.stdout, refused.stderr], [2, '', 'no.csv: the file cannot be read (ENOENT); expected is one that is still there.\n']);
  const closed = spawnSync('sh', ['-c', '"$0" "$@" | head -c 1', process.execPath, CLI, 'calibrate', ...FILES, '--json'], { encoding: 'utf8' });
  assert.deepEqual([closed.stdout, closed.stderr], ['{', '']);
});

test('the example log: the truth lies in the intervals, and the command says what the function does', async () => {
  const { status, stdout } = spawnSync(process.execPath, [CLI, 'calibrate', ...FILES, '--json'], { encoding: 'utf8' });
  assert.equal(status, 0);
  const told = JSON.parse(stdout);
  const within = (/** @type {number} */ value, /** @type {[number, number]} */ [low, high]) => assert.ok(low <= value && value <= high, `${value}: ${low} to ${high}`);
  for (const [i, alpha] of TRUTH.alphas.entries()) within(alpha, told.intervals[i]);
  for (const name of /** @type {const} */ (['mountYaw', 'clockOffset', 'distanceScale'])) within(TRUTH[name], told.systematic[name].interval);
  within(1, told.systematic.turnScale.interval);
  assert.equal(told.doubts.verdict, 'fits');

  const motion = /** @type {any} */ (await load());
  const logs = await Promise.all(['odometry', 'reference'].map((name) => readLog(new File([readFileSync(example(name))], `${name}.csv`))));
  const { odometry: own, reference } = together(logs[0], logs[1]);
  const calibration = motion.calibrate({ odometry: own.data, reference: reference.data });
  for (const key of ['alphas', 'intervals', 'bootstrap', 'systematic', 'logLikelihood', 'outliers', 'gaps']) assert.deepEqual(told[key], calibration[key], key);
  // JSON knows no NaN.
  assert.deepEqual(told.legs.residuals, Array.from(calibration.legs.residuals, (each) => (Number.isNaN(each) ? null : each)));
});

test('doc/calibration.md names what is in the JSON', async () => {
  const told = JSON.parse((await said(['calibrate', ...FILES, '--json'])).out);
  const [, section] = readFileSync(new URL('../../doc/calibration.md', import.meta.url), 'utf8').match(/\n### JSON\n(.*?)\n### /s) ?? [];
  const missing = Object.keys(told).filter((key) => !section.includes(`\`${key}\``));
  assert.deepEqual(missing, []);
  assert.deepEqual([told.start, told.legs.times[0] >= 0, told.fit], [9, true, { legs: { distance: 0.25, angle: 0.2 }, byLength: true }]);
  assert.deepEqual(told.logs.map((/** @type {any} */ { name }) => name), ['odometry.csv', 'reference.csv']);
});

test('a recording says the same as tables of the same drive', async () => {
  /** @type {import('../mcap.js').Message[]} */
  const messages = [];
  for (const [topic, name, type] of [['/odom', 'odometry', 'nav_msgs/msg/Odometry'], ['/truth', 'reference', 'geometry_msgs/msg/PoseStamped']]) {
    for (const row of readFileSync(example(name), 'utf8').trim().split('\n').slice(1)) {
      const [t, x, y, theta] = row.split(',').map(Number);
      const message = topic === '/odom' ? odometry(t, x, y, theta) : { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(x, y, theta) };
      messages.push({ topic, type, t, message });
    }
  }
  messages.sort((a, b) => a.t - b.t);
  const tables = JSON.parse((await said(['calibrate', ...FILES, '--json'])).out);
  for (const compression of /** @type {const} */ (['zstd', 'lz4'])) {
    const path = file(`${compression}.mcap`, await recordingOf(messages, { compression, chunkSize: 100_000 }));
    const { status, stdout, stderr } = spawnSync(process.execPath, [CLI, 'calibrate', '--recording', path, '--json'], { encoding: 'utf8' });
    assert.equal(status, 0, stderr);
    for (const [i, alpha] of JSON.parse(stdout).alphas.entries()) assert.ok(Math.abs(alpha / tables.alphas[i] - 1) < 1e-6, `${alpha} ${tables.alphas[i]}`);
  }
});

test('as text: a table of the α’s, what is systematic, the doubts, a verdict, and lines for Nav2', async () => {
  const { code, out } = await said(['calibrate', ...FILES, '--rule', 'nav2']);
  assert.equal(code, 0);
  const { alphas, bootstrap } = JSON.parse((await said(['calibrate', ...FILES, '--rule', 'nav2', '--json'])).out);
  for (const [i, alpha] of alphas.entries()) {
    const [, value] = out.match(new RegExp(`^    alpha${i + 1}: (\\S+)  # \\S+ to \\S+$`, 'm')) ?? [];
    assert.ok(Math.abs(Number(value) / alpha - 1) < 0.01, `${value} ${alpha}`);
    assert.match(out, new RegExp(`^alpha${i + 1}  +${value}  `, 'm'));
    assert.ok(out.includes(`  # ${between(bootstrap[i])}\n`), `alpha${i + 1}`);
  }
  assert.match(out, /^amcl:\n {2}ros__parameters:\n {4}# \d+ legs of 0\.25 m or 0\.2 rad of odometry\.csv and reference\.csv, 2026-01-02; 95 % intervals by bootstrap\n {4}# with these errors removed: clockOffset 0\.1\d+; [^\n]+\n {4}# Heavy tails: [^\n]+\n {4}robot_model_type: "nav2_amcl::DifferentialMotionModel"\n/m);
  for (const line of [/^odometry\.csv: \d+ of \d+ rows, /m, /^mount yaw +0\.0\d+ rad +\S+ to \S+ +removed$/m, /^held-out residuals inside of 95 % +\S+ % /m]) assert.match(out, line);
  const { out: byTable } = await said(['calibrate', ...FILES]);
  assert.match(byTable, /^the reference is taken to be exact; .* --position-deviation and --heading-deviation$/m);
  for (const [given, error, whose, missing] of [['position', '0.001 m', 'heading', 'heading'], ['heading', '0.001 rad', 'position', 'position']]) {
    const { out: half } = await said(['calibrate', ...FILES, `--${given}-deviation`, '0.001']);
    assert.match(half, new RegExp(`^the reference errs by ${error}, as stated; its ${whose} is taken to be exact; .*: state it by --${missing}-deviation$`, 'm'));
  }
  const stated = [...FILES, '--position-deviation', '0.001', '--heading-deviation', '0.002'];
  assert.match((await said(['calibrate', ...stated])).out, /^the reference errs by 0\.001 m and 0\.002 rad, as stated$/m);
  assert.deepEqual(JSON.parse((await said(['calibrate', ...stated, '--json'])).out).deviations, { positionDeviation: 0.001, headingDeviation: 0.002 });
  assert.match(byTable, /^The model fits: of unseen residuals, [\d.]+ % are inside its 95 %\.$/m);
  assert.match(byTable, /^ {4}# fitted under another rule than Nav2’s: choose that of Nav2$/m);
});

test('each reason why an α is not determined has a sentence, and advice that fits the model', async () => {
  const motion = /** @type {any} */ (await load());
  const [t, rows] = [Array.from({ length: 100 }, (_, i) => i / 10), (/** @type {(time: number) => number} */ f) => (/** @type {number} */ time) => `${time},${f(time)},${f(2 * time)},0`];
  const commands = file('commands.csv', ['t,v,omega,other', ...t.map(rows(Math.cos))].join('\n'));
  const told = motion.calibrate(await askedOf(FILES));
  /** What is said of α's that are not determined. @param {(string | null)[]} undetermined @param {string[]} args */
  const lacking = async (undetermined, ...args) => {
    const { out, err } = await said(['calibrate', ...(args.includes('--odometry') ? [] : FILES), ...args], async () => ({ calibrate: () => ({ ...told, undetermined }) }));
    assert.equal(err, '');
    return out.split('\n').filter((line) => /^alpha.* not determined: /.test(line));
  };
  assert.deepEqual(await lacking([null, null, null, null]), []);
  assert.deepEqual(await lacking(['one-ratio', 'one-ratio', 'drives-too-little', 'one-ratio']), [
    'alpha3 not determined: this log hardly goes anywhere; drive straight on, some fifty legs',
    'alpha1, alpha2, and alpha4 not determined: this log turns and drives in one ratio; drive straight on and turn on the spot, some fifty legs of each',
  ]);
  assert.deepEqual(await lacking([null, 'turns-too-little', null, 'turns-too-little'], '--odometry', commands, '--model', 'velocity', '--reference', file('moving.csv', ['t,x,y,yaw', ...t.map(rows((time) => time))].join('\n'))), [
    'alpha2 and alpha4 not determined: this log turns too little; drive tight bends, some fifty legs',
  ]);
});

test('an α that is not told from 0 is no result of 0: at most so much, and what to drive', async () => {
  const motion = /** @type {any} */ (await load());
  const told = motion.calibrate({ ...(await askedOf(FILES)), byLength: true });
  const zeros = (/** @type {any} */ [first, , third]) => [first, [0, 0.00123], third, [0, 0.0021]];
  const zero = (/** @type {any} */ at) => ({ ...at, alphas: [at.alphas[0], 0, at.alphas[2], 1e-9], intervals: zeros(at.intervals), bootstrap: zeros(at.bootstrap) });
  const calibrate = () => ({ ...zero(told), byLength: told.byLength.map(zero) });
  const { out } = await said(['calibrate', ...FILES], async () => ({ calibrate }));
  assert.match(out, /^alpha2 +≤ 0\.0012 +0\.0000 to 0\.0012 /m);
  assert.match(out, /^alpha4 +≤ 0\.0021 +0\.0000 to 0\.0021 /m);
  assert.match(out, /^alpha4 not told from 0: to tell it, turn on the spot, some fifty times\nalpha2 not told from 0: to tell it, drive straight on, some fifty legs$/m);
  assert.match(out, /^alpha2( +≤ 0\.0012){5}$/m);
  assert.match(out, /^ {4}# alpha2: not told from 0 by this log, 0\.0012 at most$/m);
  assert.doesNotMatch(out, /alpha\d:? +0(\.0*)?( |$)/m);
});

test('lines for Nav2 have doubles, as its parameters are', async () => {
  const { out } = await said(['calibrate', ...FILES, '--rule', 'nav2', '--distance', '1', '--angle', '1']);
  assert.match(out, /^ {4}update_min_d: 1\.0\n {4}update_min_a: 1\.0$/m);
});

test('a log of ten seconds has no lines for Nav2 with values', async () => {
  const short = ['odometry', 'reference'].flatMap((name) => {
    const [header, ...rows] = readFileSync(example(name), 'utf8').trim().split('\n');
    return [`--${name}`, file(`short-${name}.csv`, [header, ...rows.filter((row) => parseFloat(row) < 20)].join('\n'))];
  });
  const { out } = await said(['calibrate', ...short]);
  assert.match(out, /^Too few legs to say whether the model is any good\. Drive on, or take shorter legs\.$/m);
  assert.deepEqual(out.split('\n').filter((line) => /alpha[1-4]:/.test(line)), [1, 2, 3, 4].map((i) => `    # alpha${i}: left out, for the reason above`));
});

test('the α’s by the length of legs are a table', async () => {
  const { byLength } = JSON.parse((await said(['calibrate', ...FILES, '--json'])).out);
  const { out } = await said(['calibrate', ...FILES]);
  assert.match(out, /^by length +0\.0625 m, 0\.05 rad +0\.125 m, 0\.1 rad +0\.25 m, 0\.2 rad +0\.5 m, 0\.4 rad +1 m, 0\.8 rad\n/m);
  const table = out.slice(out.indexOf('by length')).split('\n').map((line) => line.trim().split(/ {2,}/));
  assert.deepEqual(table[1], ['95 % by bootstrap', ...byLength.map((/** @type {any} */ { legs }) => `${legs} legs`)]);
  for (const [k, row] of [2, 4, 6, 8].entries()) {
    assert.equal(table[row][0], `alpha${k + 1}`);
    for (const [i, { alphas, bootstrap }] of byLength.entries()) {
      if (alphas[k] === null) {
        assert.equal(table[row][1 + i], '–');
        continue;
      }
      assert.ok(Math.abs(Number(table[row][1 + i]) - alphas[k]) <= 0.05 * (bootstrap[k][1] - bootstrap[k][0]), `${table[row][1 + i]} ${alphas[k]}`);
    }
  }
  // The shortest legs are of three rows.
  assert.match(out, /^–: too few legs, most of them shorter than four rows of a log, or turns of more than half a circle\n\n/m);
  const lasting = await said(['calibrate', ...FILES, '--duration', '1']);
  assert.match(lasting.out, /^by length +0\.25 s +0\.5 s +1 s +2 s +4 s\n/m);
  assert.doesNotMatch(lasting.out, /^–: /m);
});

test('by the omnidirectional rule five α’s, and one table is no two logs', async () => {
  const { code, out } = await said(['calibrate', ...FILES, '--rule', 'omni']);
  assert.equal(code, 0);
  assert.match(out, /^alpha5  +0\.\d+ .*slide from driving$/m);
  const twice = await said(['calibrate', '--odometry', FILES[1], '--reference', FILES[1]]);
  assert.equal(twice.code, 2);
  assert.match(twice.err, /^odometry\.csv is no MCAP recording; expected is one for both odometry and reference, or two tables\.$/m);
});

test('where a log does not determine an α, no line says one', async () => {
  // Straight on, and never turning.
  const rows = Array.from({ length: 2000 }, (_, i) => [i / 20, i / 40, 0.002 * Math.sin(i * i), 0.003 * Math.sin(3 * i * i)].join(','));
  const straight = file('straight.csv', ['t,x,y,yaw', ...Array.from({ length: 2000 }, (_, i) => `${i / 20},${i / 40},0,0`)].join('\n'));
  const truth = file('truth.csv', ['t,x,y,yaw', ...rows].join('\n'));
  const { code, out, err } = await said(['calibrate', '--odometry', straight, '--reference', truth]);
  assert.equal(code, 0, err);
  assert.match(out, /^alpha1 +not determined by this log/m);
  assert.match(out, /^ {4}# alpha1: not determined by this log$/m);
  assert.match(out, /^alpha1 and alpha4 not determined: this log turns too little; turn on the spot, some fifty times$/m);
});

test('figures that are nowhere, tiny or one alone, in the text', async () => {
  const motion = /** @type {any} */ (await load());
  const told = motion.calibrate(await askedOf(FILES));
  /** What is printed of other figures. @param {any} change */
  const printed = async (change) => (await said(['calibrate', ...FILES], async () => ({ calibrate: () => ({ ...told, ...change }) }))).out;
  const kinds = told.doubts.kinds.map((/** @type {any} */ kind) => ({ ...kind, autocorrelation: NaN, autocorrelationLimit: Infinity }));
  const nowhere = await printed({ doubts: { ...told.doubts, kinds, squaredError: { mean: 1.02, interval: [0, Infinity] } } });
  assert.match(nowhere, /^squared error by degree of freedom +1\.02$/m);
  assert.match(nowhere, /^autocorrelation, rot1 +–$/m);
  const tiny = await printed({ alphas: [2.34e-13, ...told.alphas.slice(1)], intervals: [[1.8e-13, 2.9e-13], ...told.intervals.slice(1)] });
  assert.match(tiny, /^alpha1 +2\.3e-13 +1\.8e-13 to 2\.9e-13 /m);
  const gaps = async (/** @type {number} */ odometry) => (await printed({ gaps: { odometry, reference: 1 } })).match(/^no leg .*$/m)?.[0];
  assert.equal(await gaps(1), 'no leg leads across 1 gap of the odometry and 1 of the reference');
  assert.equal(await gaps(2), 'no leg leads across 2 gaps of the odometry and 1 of the reference');
  assert.equal(await gaps(0), 'no leg leads across 0 gaps of the odometry and 1 of the reference');
});
