// Logs in text: formats, numbers, rows that are left out, and errors.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { log as german } from '../../www/logs/de.js';
import { pairLogs } from '../../www/logs/drives.ts';
import { log as english } from '../../www/logs/en.js';
import { LogError } from '../../www/logs/log-error.js';
import { summarize } from '../../www/logs/summary.ts';
import { readLog } from './log-support.js';

/** @param {string | Uint8Array<ArrayBuffer>} contents @param {Partial<import('../../www/logs/log.ts').Choice>} [choice] */
const read = (contents, choice) => readLog(new File([contents], 'run.csv'), choice);

/** @param {string} contents @returns {Promise<any>} */
const dataOf = async (contents, choice = {}) => Object.fromEntries(Object.entries((await read(contents, choice)).data).map(([name, values]) => [name, [...values]]));

/** @param {Promise<unknown>} reading @returns {Promise<LogError>} */
async function refusalOf(reading) {
  try {
    await reading;
  } catch (error) {
    assert.ok(error instanceof LogError, String(error));
    return error;
  }
  throw new assert.AssertionError({ message: 'nothing was refused' });
}

const close = (/** @type {number} */ is, /** @type {number} */ expected) => assert.ok(Math.abs(is - expected) < 1e-12, `${is} ${expected}`);

test('columns are found by their names, whatever separates them', async () => {
  const expected = { t: [0.5, 0.75], x: [1, 2], y: [-3, 4], theta: [0.25, 0.5], breaks: [] };
  for (const [header, ...rows] of [
    ['t,x,y,yaw', '0.5,1,-3,0.25', '0.75,2,4,0.5'],
    ['Time;Y;X;Theta', '0.5;-3;1;0.25', '0.75;4;2;0.5'],
    ['heading\ttimestamp\tx\ty', '0.25\t0.5\t1\t-3', '0.5\t0.75\t2\t4'],
    ['"time [s]", "x [m]", "y [m]", "yaw [rad]"', '0.5, 1, -3, 0.25', '0.75, 2e0, +4., 5E-1'],
    ['stamp x y z yaw', '0.5  1 -3 0 0.25', '  0.75 2   4 0 .5'],
    ['frame_id,header.stamp.sec,header.stamp.nanosec,pose.position.x,pose.position.y,yaw', '"map, odom",0,500000000,1,-3,0.25', 'map,0,750000000,2,4,0.5'],
  ]) {
    for (const end of ['\n', '\r\n']) assert.deepEqual(await dataOf([header, ...rows, ''].join(end)), expected, header);
    // Without the last line's end, behind a byte order mark, and with comments.
    assert.deepEqual(await dataOf(`\ufeff# by hand\n\n${header}\n# more\n${rows.join('\n')}`), expected, header);
  }
});

test('a header may be a comment, as in data sets of visual odometry', async () => {
  const { data, summary } = await read('#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n1403636579758555392,4,5,6,0,0,0,1\n1403636579763555584,4,5,6,0,0,0,-1\n');
  assert.equal(summary.columns?.x, 'p_RS_R_x [m]');
  assert.equal(summary.units.time.by, 'name');
  close(/** @type {any} */ (data).theta[0], Math.PI);
});

test('a log that a recorder exported: the stamp of the message, and poses before commands unless these are wanted', async () => {
  const name = (/** @type {string} */ each) => `field.${each}`;
  const header = ['%time', ...['header.seq', 'header.stamp', 'header.frame_id', 'child_frame_id', 'pose.pose.position.x', 'pose.pose.position.y', 'pose.pose.position.z', 'pose.pose.orientation.x', 'pose.pose.orientation.y', 'pose.pose.orientation.z', 'pose.pose.orientation.w', 'pose.covariance0', 'twist.twist.linear.x', 'twist.twist.linear.y', 'twist.twist.angular.x', 'twist.twist.angular.z'].map(name)];
  const row = (/** @type {number} */ i) => [2e18, i, `1700000000${100000000 + i}`, 'odom', 'base', i, -i, 0, 0, 0, Math.SQRT1_2, Math.SQRT1_2, 9, 0.5, 9, 9, 0.1].join(',');
  const text = [header.join(','), row(1), row(2), row(3)].join('\n');
  const poses = await read(text);
  assert.equal(poses.start, 1_700_000_000);
  assert.deepEqual([...poses.data.t], [0.100000001, 0.100000002, 0.100000003]);
  close(/** @type {any} */ (poses.data).theta[1], Math.PI / 2);
  // A message that contains another one has its own fields read.
  const nested = await read('time,object.pose.position.x,pose.position.x,pose.position.y,pose.yaw\n0,9,1,2,3\n1,9,1,2,3\n');
  assert.equal(nested.summary.columns?.x, 'pose.position.x');
  const commands = await read(text, { kind: 'commands' });
  assert.deepEqual([commands.kind, [.../** @type {any} */ (commands.data).v], [.../** @type {any} */ (commands.data).omega]], ['commands', [0.5, 0.5, 0.5], [0.1, 0.1, 0.1]]);
});

test('poses are read if commands are wanted and there are none', async () => {
  for (const text of ['t,x,y,yaw\n0,0,0,0\n1,2,0,0\n', '0 0 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n']) {
    const { kind, data } = await read(text, { kind: 'commands' });
    assert.deepEqual([kind, [.../** @type {any} */ (data).x]], ['poses', [0, 2]]);
  }
});

test('TUM: eight numbers a row', async () => {
  const { data, start } = await read('# timestamp tx ty tz qx qy qz qw\n1305031098.6659 1.25 -0.5 9 0 0 0 1\n1305031098.675900001 1.5 -0.5 9 0 0 0.6 0.8\n');
  assert.equal(start, 1_305_031_098);
  assert.deepEqual([...data.t], [0.6659, 0.675900001]);
  close(/** @type {any} */ (data).theta[1], 2 * Math.asin(0.6));
});

test('nanoseconds of the present keep their digits, in every unit', async () => {
  const times = [['1699999999999999999', '1700000000000000001'], ['1699999999999999.999', '1700000000000000.001'], ['1699999999999.999999', '1700000000000.000001'], ['1699999999.999999999', '1700000000.000000001']];
  for (const [i, unit] of /** @type {const} */ (['ns', 'us', 'ms', 's']).entries()) {
    const [one, other] = times[i];
    const { data, start, summary: { units: { time } } } = await read(`t,x,y,yaw\n${one},0,0,0\n${other},0,0,0`);
    assert.deepEqual([start, time.unit, time.by], [1_699_999_999, unit, 'size']);
    close(data.t[0], 0.999999999);
    close(data.t[1], 1.000000001);
    const named = await read(`t_${unit},x,y,yaw\n${one},0,0,0\n${other},0,0,0`);
    assert.deepEqual([named.data, named.summary.units.time.by], [data, 'name']);
  }
  // Units by name alone, negative times and short ones.
  assert.deepEqual((await dataOf('time (ms),x,y,yaw\n-250,0,0,0\n5,0,0,0\n10.5,0,0,0')).t, [0.75, 1.005, 1.0105]);
  assert.deepEqual((await dataOf('t_ns,x,y,yaw\n5,0,0,0\n10,0,0,0')).t, [5e-9, 1e-8]);
  assert.deepEqual((await dataOf('t,x,y,yaw\n1e1,0,0,0\n1.05e1,0,0,0')).t, [0, 0.5]);
});

test('numbers are the nearest doubles, and degrees are known by their name', async () => {
  const values = ['0.1', '-12345.6789012345', '1e-7', '123456789.012345678', '3.141592653589793238462643', '-0', '.5', '7.', '2.2250738585072014e-308'];
  const { x } = await dataOf(['t,x,y,yaw', ...values.map((value, i) => `${i},${value},0,0`)].join('\n'));
  assert.deepEqual(x, values.map(Number));
  assert.deepEqual((await dataOf('t,x,y,yaw_deg\n0,0,0,180\n1,0,0,90')).theta, [Math.PI, Math.PI / 2]);
});

test('unusable rows are left out and reported with the first line, and break the path', async () => {
  const rows = ['0,0,0,0', '1,nan,0,0', '2,,0,0', '3,0,0,0', '3,1,0,0', '4,0,0,0', '2.5,0,0,0', '5,0,inf,0', 'NaN,0,0,0', '6,0,0,0', '7,0'];
  const log = await read(`t,x,y,yaw\n${rows.join('\n')}`);
  assert.deepEqual([...log.data.t], [0, 2.5, 3, 4, 6]);
  const { dropped, rows: count, notes } = log.summary;
  assert.equal(count, rows.length);
  assert.deepEqual(dropped.notFinite, { count: 4, first: 3 });
  assert.deepEqual(dropped.duplicate, { count: 1, first: 6 });
  assert.deepEqual([dropped.short, notes.map(({ name }) => name)], [{ count: 1, first: 12 }, ['cutShort', 'sorted']]);
  // A repeated row is no hole.
  assert.deepEqual([...log.data.breaks], [2, 4]);
  assert.equal(summarize(log, english.found).length, 6);
  assert.equal(summarize(log, german.found).length, 6);
});

test('one time that is far ahead is left out by itself', async () => {
  const rows = Array.from({ length: 50 }, (_, i) => `${i === 20 ? 1e6 : i / 10},0,0,0`);
  const log = await read(`t,x,y,yaw\n${rows.join('\n')}`);
  assert.equal(log.data.t.length, 49);
  assert.deepEqual(log.summary.dropped.stray, { count: 1, first: 22 });
  assert.deepEqual([...log.data.breaks], []);
  // An unusable row before it still breaks the path.
  const lost = await read(`t,x,y,yaw\n${rows.toSpliced(20, 0, '1.95,nan,0,0').join('\n')}`);
  assert.deepEqual([...lost.data.breaks], [20]);
});

test('rows after a clock was set back are dropped', async () => {
  const rows = Array.from({ length: 300 }, (_, i) => `${(i < 200 ? i : i - 50) / 10},${i / 100},0,0`);
  const { data, summary } = await read(`t,x,y,yaw\n${rows.join('\n')}`);
  assert.deepEqual([summary.dropped.setBack, data.t.length], [{ count: 100, first: 202 }, 200]);
});

test('pauses and jumps are found', async () => {
  const rows = Array.from({ length: 400 }, (_, i) => [i / 20 + (i >= 100 ? 3 : 0), i / 100 + (i >= 200 ? 1 : 0), 0, i / 500 + (i >= 300 ? 1.5 : 0)].join(','));
  const { summary: { gaps, jumps }, data } = await read(`t,x,y,yaw\n${rows.join('\n')}`);
  assert.deepEqual([gaps.count, gaps.first, gaps.longest], [1, 99 / 20, 3.05]);
  assert.deepEqual([jumps.count, jumps.first], [2, 13]);
  assert.deepEqual([...data.breaks], [200, 300]);
  // A heading that wraps is no jump.
  const wrapped = rows.map((_, i) => [i / 20, 0, 0, ((i / 20 + Math.PI) % (2 * Math.PI)) - Math.PI].join(','));
  assert.equal((await read(`t,x,y,yaw\n${wrapped.join('\n')}`)).summary.jumps.count, 0);
});

test('two logs get one start', async () => {
  const [odometry, reference] = await Promise.all([read('t,x,y,yaw\n1700000000.25,0,0,0\n1700000009.5,0,0,0'), read('t,x,y,yaw\n1700000003.125,0,0,0\n1700000008.5,0,0,0')]);
  const both = pairLogs(odometry, reference);
  assert.equal(both.start, 1_700_000_000);
  assert.deepEqual([[...both.odometry.data.t], [...both.reference.data.t]], [[0.25, 9.5], [3.125, 8.5]]);
  const other = pairLogs(odometry, await read('t,x,y,yaw\n0,0,0,0\n1,0,0,0'));
  const apart = 'its times (0.00 s to 1.00 s) and those of run.csv (1700000000.25 s to 1700000009.50 s) have nothing in common: the clocks are aligned by how the robot turned';
  assert.deepEqual([other.start, summarize(other.reference, english.found).at(-1)], [0, apart]);
  assert.deepEqual([...other.odometry.data.t], [1_700_000_000.25, 1_700_000_009.5]);
  assert.equal(summarize(other.reference, german.found).length, summarize(both.reference, german.found).length + 1);
});

test('tables with swapped names are reported', async () => {
  const called = (/** @type {string} */ name) => readLog(new File(['t,x,y,yaw\n0,0,0,0\n9,0,0,0'], name));
  const lines = async (/** @type {string} */ odometry, /** @type {string} */ reference) =>
    summarize(pairLogs(await called(odometry), await called(reference)).reference, english.found).slice(1);
  assert.deepEqual(await lines('truth.csv', 'wheels.csv'), ['it is called as odometry is, and truth.csv is not: are the two the other way round?']);
  for (const [one, other] of [['wheels.csv', 'truth.csv'], ['odom.csv', 'odom-by-slam.csv'], ['a.csv', 'b.csv']]) assert.deepEqual(await lines(one, other), [], one);
});

test('a frozen reference is left out while the odometry moves on, and kept while it stands', async () => {
  const poses = (/** @type {(i: number) => number} */ x) => read(['t,x,y,yaw', ...Array.from({ length: 400 }, (_, i) => [i / 20, x(i), 0, 0].join(','))].join('\n'));
  const drives = (/** @type {number} */ i) => Math.max(0, i - 100) / 50;
  const [odometry, good, lost] = await Promise.all([poses(drives), poses(drives), poses((i) => drives(i >= 200 && i < 300 ? 200 : i))]);
  const same = pairLogs(odometry, good);
  assert.deepEqual([same.reference.data, same.reference.summary], [good.data, good.summary]);
  const { reference } = pairLogs(odometry, lost);
  assert.deepEqual([...reference.data.t], [...lost.data.t].filter((_, i) => i <= 200 || i >= 300));
  assert.deepEqual([...reference.data.breaks], [201]);
  assert.deepEqual(reference.summary.dropped.held, { count: 99, first: 0 });
  assert.ok(summarize(reference, english.found).includes('left out 99 rows: the pose stands while the odometry moves on'));
  const { message } = await refusalOf(poses(() => 7).then((still) => pairLogs(odometry, still)));
  assert.equal(message, 'run.csv: its pose stands while the odometry moves on; expected is one that follows the robot.');
  assert.equal((await refusalOf(read('t,v,omega\n0,0,0\n1,0,0').then((driven) => pairLogs(odometry, driven)))).message, 'run.csv: the columns are t, v, omega; expected are x, y and yaw (or qx, qy, qz and qw) among them.');
  // Commands tell too that the robot moves.
  const commands = await read(['t,v,omega', ...Array.from({ length: 400 }, (_, i) => `${i / 20},${i < 100 ? 0 : 0.4},0`)].join('\n'));
  assert.equal(pairLogs(commands, lost).reference.summary.dropped.held?.count, 99);
});

const LONG = 'x'.repeat(100);

/** Files and their errors. @type {[string | Uint8Array<ArrayBuffer>, string, ('poses' | 'commands')?][]} */
const REFUSED = [
  ['', 'run.csv: there is nothing in it; expected is a log of poses or commands.'],
  ['# t,x,y,yaw\n\n', 'run.csv: there is nothing in it; expected is a log of poses or commands.'],
  ['t,x,y,yaw\n', 'run.csv: 0 of 0 rows can be used; expected are at least 2.'],
  [Uint8Array.of(1, 2, 0, 4), 'run.csv: it is neither text nor an MCAP recording; expected is CSV, TUM or MCAP.'],
  ['1,2,3,4\n', 'run.csv, line 1: the first row is “1,2,3,4”; expected is a header with names such as t, x, y and yaw.'],
  ['x,y,yaw\n', 'run.csv, line 1: none of the columns x, y, yaw is the time; expected is one named t, time, timestamp or stamp, or two named sec and nanosec.'],
  ['t,x,y,qx\n', 'run.csv, line 1: none of the columns t, x, y, qx is the heading; expected is yaw, theta or heading, or qx, qy, qz and qw.'],
  [`t,${LONG}\n`, `run.csv, line 1: the columns are t, ${LONG.slice(0, 40)}…; expected are x, y and yaw (or qx, qy, qz and qw), or v and omega among them.`],
  ['t,y,v\n', 'run.csv, line 1: the columns are t, y, v; expected are x, y and yaw (or qx, qy, qz and qw), or v and omega among them.', 'commands'],
  ['t,v,omega\n', 'run.csv, line 1: the columns are t, v, omega; expected are x, y and yaw (or qx, qy, qz and qw) among them.', 'poses'],
  ['t,t,x,y,yaw\n', 'run.csv, line 1: both “t” and “t” may be the time; expected is one of them.'],
  ['__time,/odom/pose/pose/position/x,/odom/pose/pose/position/y,/truth/pose/pose/position/x\n', 'run.csv, line 1: both “/odom/pose/pose/position/x” and “/truth/pose/pose/position/x” may be x; expected is one of them.'],
  [`t,x,y,yaw\n0,0,0,0\n1,${LONG},0,0\n`, `run.csv, line 3: x is “${LONG.slice(0, 40)}…”; expected is a number.`],
  ['t,x,y,yaw\n0x10,0,0,0\n', 'run.csv, line 2: t is “0x10”; expected is a number.'],
  ['t,x,y,yaw\n0,0,0\n1,0,0,0\n', 'run.csv, line 2: the row has 3 cells; expected are at least 4.'],
  [`t,x,y,yaw\n${'1'.repeat(400_000)}`, 'run.csv, line 2: the line has more than 65536 bytes; expected is one row a line.'],
  ['t,x,y,yaw\nnan,0,0,0\n1,0,0,0', 'run.csv, line 2: 1 of 2 rows can be used (no finite number); expected are at least 2.'],
  ['0 0 0 0 0 0 0 0\n1 0 0 0 0 0 0 0\n', 'run.csv, line 1: 0 of 2 rows can be used (a quaternion that is no rotation); expected are at least 2.'],
  ['t,x,y,yaw\n1,0,0,0\n1,0,0,0\n', 'run.csv, line 3: 1 of 2 rows can be used (the time of the row before); expected are at least 2.'],
  ['t,x,y,yaw\n0,0,0,0\n1,0,1e300,0\n2,0,0,0\n', 'run.csv, line 3: a value is 1e+300; expected are numbers from -1000000000 to 1000000000, in m, rad and s.'],
];

test('other files are refused with the line, the value and what is expected', async () => {
  for (const [contents, sentence, kind] of REFUSED) {
    const error = await refusalOf(read(contents, { kind }));
    assert.equal(error.message, sentence);
    assert.match(error.sentence(german), /^run\.csv(, Zeile \d+)?: .+; (erwartet) (wird|werden) .+\.$/);
  }
});

test('a file that has been moved is refused', async () => {
  const gone = { name: `${'n'.repeat(50)}.csv`, size: 5, slice: () => ({ arrayBuffer: () => Promise.reject(new DOMException('', 'NotFoundError')) }) };
  const { message } = await refusalOf(readLog(/** @type {any} */ (gone)));
  assert.equal(message, `${'n'.repeat(40)}…: the file cannot be read (NotFoundError); expected is one that exists and may be read.`);
});

test('lines across the pieces of a large file are read whole', async () => {
  const rows = Array.from({ length: 120_000 }, (_, i) => `${i},${i / 8},${'x'.repeat(i % 40)},0,0.125`);
  const { x } = await dataOf(['t,x,note,y,yaw', ...rows].join('\n'));
  assert.deepEqual(x, rows.map((_, i) => i / 8));
});
