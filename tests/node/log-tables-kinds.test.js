// Logs as text tables of unusual kinds: dropped rows, guessed units, and refused tables.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { openRecordings } from '../../www/logs/open.ts';
import { german } from '../../www/logs/de.ts';
import { RowCollector } from '../../www/logs/rows.ts';
import { catchRefusalError, catchRefusalSentence } from './log-support.js';

/** Reads one log of a table. @param {string | Uint8Array<ArrayBuffer>} tableText @param {import('../../www/logs/log.ts').OpenOptions} [openOptions] @param {string} [seriesName] */
async function readTable(tableText, openOptions, seriesName = '') {
  const [recording] = await openRecordings([new File([tableText], 'run.csv')], () => openOptions);
  const [log] = await recording.readLogs([{ seriesName }]);
  return { ...log, data: /** @type {any} */ (log.motionData) };
}

/** Rows of a drive on a circle with a radius of 1 m, at 0.5 m/s, with 20 rows a second: time, x, y, heading. */
const CIRCLE_ROWS = Array.from({ length: 800 }, (_, i) => [i / 20, Math.sin(i / 40), -Math.cos(i / 40), Math.atan2(Math.sin(i / 40), Math.cos(i / 40))]);

/** Returns a table of a robot that drives on a circle. @param {(row: number[], i: number) => (string | number)[]} [cellsOf] makes the cells of a row from its time and pose @param {string} [headerLine] */
const circleTableOf = (cellsOf = (tableRow) => tableRow, headerLine = 't,x,y,yaw') => [headerLine, ...CIRCLE_ROWS.map((tableRow, i) => cellsOf(tableRow, i).join(','))].join('\n');

/** Returns a table of a robot that drives straight on, with a row at each time. @param {(number | string)[]} rowTimes */
const createStraightTable = (rowTimes) => ['t,x,y,yaw', ...rowTimes.map((t, i) => `${t},${i / 50},0,0`)].join('\n');
const createTimes = (/** @type {number} */ timeCount, startTime = 0) => Array.from({ length: timeCount }, (_, i) => startTime + i / 10);

test('present Unix times keep their microseconds, in every unit', async () => {
  const nanosecondTexts = ['1699999999999999000', '1700000000000001000'];
  for (const [timeUnit, decimalDigits] of Object.entries({ ns: 0, us: 3, ms: 6, s: 9 })) {
    const [firstTime, secondTime] = nanosecondTexts.map((nanosecondText) => (decimalDigits ? `${nanosecondText.slice(0, -decimalDigits)}.${nanosecondText.slice(-decimalDigits)}` : nanosecondText));
    for (const headerLine of ['t', `t_${timeUnit}`]) {
      const { data: logColumns, startTime, logSummary } = await readTable(`${headerLine},x,y,yaw\n${firstTime},0,0,0\n${secondTime},0,0,0`);
      assert.deepEqual([startTime, logSummary.units.time], [1_699_999_999, { unit: timeUnit, by: headerLine === 't' ? 'size' : 'name' }]);
      assert.deepEqual([...logColumns.t].map((t) => Math.round(t * 1e6)), [999_999, 1_000_001]);
    }
  }
});

test('numbers are read as the nearest doubles', async () => {
  const numberTexts = ['0.1', '-12345.6789012345', '1e-7', '123456789.012345678', '3.141592653589793238462643', '-0', '.5', '7.', '+4.', '2.2250738585072014e-308'];
  const { x } = (await readTable(['t,x,y,yaw', ...numberTexts.map((numberText, i) => `${i},${numberText},0,0`)].join('\n'), { lengthUnit: 'm' })).data;
  assert.deepEqual([...x], numberTexts.map(Number));
});

test('unusable rows are dropped and do not interrupt the path; the summary names the first line of each cause', async () => {
  const tableRows = ['0,0,0,0', '1,nan,0,0', '2,,0,0', '3,0,0,0', '3,1,0,0', '4,0,0,0', '5,0,inf,0', 'NaN,0,0,0', '6,0,0,0', '7,0', ...createTimes(90, 8).map((t) => `${t},0,0,0`), '17,0', '17.1,0,0.0.1,0', '18,0,0,0', '19,0'];
  const { data: logColumns, logSummary: { dropped, rows: rowCount, notes } } = await readTable(`t,x,y,yaw\n${tableRows.join('\n')}`);
  assert.deepEqual([[...logColumns.t], [...logColumns.breaks]], [[0, 3, 4, 6, ...createTimes(90, 8), 18], []]);
  assert.deepEqual(dropped, { notFinite: { count: 4, first: 3 }, short: { count: 3, first: 11 }, text: { count: 1, first: 103 }, duplicate: { count: 1, first: 6 } });
  assert.deepEqual([rowCount, notes], [tableRows.length, [{ name: 'cutShort', values: [] }]]);
  // If the last number has fewer decimals than all others, and no line break follows, the number is taken for truncated.
  const cutShortCounts = ['0.1', '0.1\n', '0.25'].map(async (lastYaw) => (await readTable(`t,x,y,yaw\n${createTimes(30).map((t) => `${t},0,0,0.25\n`).join('')}99,0,0,${lastYaw}`)).logSummary.notes.length);
  assert.deepEqual(await Promise.all(cutShortCounts), [1, 0, 0]);
});

test('late rows are sorted, and an isolated time has gaps before and after it', async () => {
  const rowTimes = createTimes(50);
  const { data: logColumns, logSummary } = await readTable(createStraightTable([...rowTimes.slice(0, 20), rowTimes[22], rowTimes[20], rowTimes[21], ...rowTimes.slice(23)]));
  assert.deepEqual([[...logColumns.t], [...logColumns.breaks]], [rowTimes, []]);
  assert.deepEqual([logColumns.x[20], logSummary.notes], [21 / 50, [{ name: 'sorted', values: [2] }]]);
  const swappedLog = await readTable(createStraightTable([...createTimes(50, 100), ...createTimes(50)]));
  assert.deepEqual([swappedLog.data.t.length, swappedLog.data.t[0], swappedLog.data.x[0]], [100, 0, 1]);
  for (const [isolatedTime, expectedOrder] of /** @type {[number, number[]][]} */ ([[1e6, [...rowTimes.keys()].toSpliced(20, 1).concat(20)], [-1e6, [20, ...[...rowTimes.keys()].toSpliced(20, 1)]]])) {
    const logWithIsolatedTime = await readTable(createStraightTable(rowTimes.with(20, isolatedTime)));
    assert.deepEqual([[...logWithIsolatedTime.data.x], logWithIsolatedTime.logSummary.gaps.count], [expectedOrder.map((i) => i / 50), 1]);
  }
});

test('a shuffled log is sorted, but a log with alternating times of two clocks is not', async () => {
  const [headerLine, ...rowLines] = circleTableOf().split('\n');
  const rowOrder = rowLines.map((_, i) => (i * 301) % rowLines.length);
  for (const shuffleRange of [8, rowLines.length]) {
    const shuffledIndices = rowLines.map((_, i) => i).toSorted((rowIndex, otherRowIndex) => rowIndex + (rowOrder[rowIndex] % shuffleRange) - otherRowIndex - (rowOrder[otherRowIndex] % shuffleRange));
    const { data: logColumns, logSummary } = await readTable([headerLine, ...shuffledIndices.map((i) => rowLines[i])].join('\n'));
    assert.deepEqual([[...logColumns.x], [...logColumns.breaks], logSummary.used], [CIRCLE_ROWS.map(([, x]) => x), [], rowLines.length]);
    assert.ok(logSummary.notes[0].name === 'sorted' && Number(logSummary.notes[0].values[0]) > rowLines.length / 8, JSON.stringify(logSummary.notes));
  }
  // Times of rows vary by a fifth of a step, and every third row comes late.
  const jitteredRows = CIRCLE_ROWS.map(([t, ...poseCells], i) => [t + ((rowOrder[i] % 21) - 10) / 1000, ...poseCells]);
  const tableWithLateRows = jitteredRows.map((_, i) => i).toSorted((index, otherIndex) => index + (index % 3 ? 0 : 3.5) - otherIndex - (otherIndex % 3 ? 0 : 3.5)).map((i) => jitteredRows[i].join(','));
  assert.deepEqual([...(await readTable([headerLine, ...tableWithLateRows].join('\n'))).data.x], CIRCLE_ROWS.map(([, x]) => x));
  const rowsOfTwoClocks = rowLines.flatMap((tableRow, i) => [tableRow, [CIRCLE_ROWS[i][0] + 5.02, ...CIRCLE_ROWS[rowLines.length - 1 - i].slice(1)].join(',')]);
  assert.match(await catchRefusalSentence(readTable([headerLine, ...rowsOfTwoClocks].join('\n'))), /^run\.csv, line 202: times go back by 4\.97 s and repeat those before;/);
});

test('a log whose clock was set back is refused', async () => {
  for (const [firstTimes, nextTimes, expectedLine, expectedSeconds] of /** @type {[number[], number[], number, string][]} */ ([
    [createTimes(200), createTimes(100, 15), 202, '4\\.90'], [createTimes(200), createTimes(100, 15.04), 202, '4\\.86'], [createTimes(60), createTimes(140, 4.03), 62, '1\\.87'],
    [createTimes(900), createTimes(100, 89.6), 902, '0\\.300'],
  ])) {
    const refusalSentence = await catchRefusalSentence(readTable(createStraightTable([...firstTimes, ...nextTimes])));
    assert.match(refusalSentence, RegExp(`^run\\.csv, line ${expectedLine}: times go back by ${expectedSeconds} s and repeat those before; split the file there, give one recording only, or write fractions with their leading zeros .*\\.$`));
  }
  // If a table contains the same recording twice, the rows of the second copy are left out.
  const straightTable = createStraightTable(createTimes(50));
  assert.equal((await readTable(straightTable + straightTable.slice(straightTable.indexOf('\n')))).data.t.length, 50);
});

test('zero bytes in a table remove only the row that contains them', async () => {
  const [headerLine, ...tableRows] = circleTableOf().split('\n');
  for (const rowIndex of [100, 700]) {
    const { data: logColumns, logSummary } = await readTable([headerLine, ...tableRows.with(rowIndex, `${tableRows[rowIndex].slice(0, 9)}${'\0'.repeat(100_000)}${tableRows[rowIndex + 1].slice(5)}`)].join('\n'));
    assert.deepEqual([logColumns.t.length, logSummary.dropped, [...logColumns.breaks]], [tableRows.length - 1, { text: { count: 1, first: rowIndex + 2 } }, []]);
  }
  assert.match(await catchRefusalSentence(readTable([headerLine, ...tableRows, '\0'.repeat(5_000_000)].join('\n'))), /^run\.csv, line 802: the line has more than 65536 bytes;/);
});

test('rows with the stamp 0 are dropped, and the other stamps are still used as the clock', async () => {
  const stampTextOf = (/** @type {number} */ i) => (i < 2 || i === 30 ? 0 : `${1_718_000_000 + Math.floor(i / 8)}${String((i % 8) * 125).padStart(3, '0')}000000`);
  const tableRows = Array.from({ length: 60 }, (_, i) => `${1_718_000_007 + i / 8},${stampTextOf(i)},${i / 20},0,0`);
  const { startTime, data: logColumns, logSummary } = await readTable(['time,header.stamp,x,y,yaw', ...tableRows].join('\n'));
  assert.deepEqual([startTime, logColumns.t.length, logColumns.t[0], logSummary.clock, logSummary.units.time.unit], [1_718_000_000, 57, 0.25, 'header.stamp', 'ns']);
  assert.deepEqual([logSummary.dropped, [...logColumns.breaks]], [{ noStamp: { count: 3, first: 2 } }, []]);
  const frozenStampLog = await readTable(['time,header.stamp,x,y,yaw', ...tableRows.map((tableRow) => tableRow.replace(/,\d+/, ',1718000000000000000'))].join('\n'));
  assert.deepEqual([frozenStampLog.data.t.length, frozenStampLog.logSummary.clock, frozenStampLog.logSummary.columns?.t], [60, 'time', 'time']);
});

test('poses that a table repeats at the rate of another log are used once', async () => {
  const { data: logColumns, logSummary } = await readTable(circleTableOf((tableRow, i) => [tableRow[0], ...CIRCLE_ROWS[i - (i % 5)].slice(1)]));
  assert.deepEqual([logColumns.t.length, logColumns.t[1], logColumns.x[1]], [160, 0.25, CIRCLE_ROWS[5][1]]);
  assert.deepEqual([logSummary.dropped, [...logColumns.breaks]], [{ repeated: { count: 640, first: 3 } }, []]);
  // The localizer publishes its last pose again and again until the robot has moved far enough.
  const poseOfRow = Array.from({ length: 700 }, (_, i) => Math.floor(i / 10) * 10 - (i % 70 >= 10 && i % 70 < 16 ? 10 : 0));
  const republishedLog = await readTable(circleTableOf((tableRow, i) => [tableRow[0], ...CIRCLE_ROWS[poseOfRow[i] ?? 690].slice(1)]));
  const timesOfFirstRows = poseOfRow.flatMap((pose, i) => (pose === poseOfRow[i - 1] ? [] : [i / 20]));
  assert.deepEqual([...republishedLog.data.t].slice(0, timesOfFirstRows.length), timesOfFirstRows);
  assert.deepEqual([...republishedLog.data.t].slice(timesOfFirstRows.length).map((t) => Math.round(20 * t)), [700, 710, 720, 730, 740, 750, 760, 770, 780, 790]);
});

test('pauses and jumps are found, and a heading that wraps around is not a jump', async () => {
  // Five median steps are not long enough for a pause. Eight times the usual speed is not fast enough for a jump.
  const delayOf = (/** @type {number} */ i) => (i >= 50 ? 0.19 : 0) + (i >= 60 ? 0.21 : 0) + (i >= 100 ? 3 : 0);
  const offsetOf = (/** @type {number} */ i) => (i >= 150 ? 0.34 : 0) + (i >= 200 ? 0.36 : 0);
  const tableRows = Array.from({ length: 400 }, (_, i) => [i / 20 + delayOf(i), i / 20 + offsetOf(i), 0, i / 500 + (i >= 300 ? 1.5 : 0)].join(','));
  const { logSummary, data: logColumns } = await readTable(`t,x,y,yaw\n${tableRows.join('\n')}`);
  assert.deepEqual(logSummary.gaps, { count: 2, longest: 3.05, first: 59 / 20 + 0.19 });
  assert.deepEqual([logSummary.jumps, [...logColumns.breaks]], [{ count: 2, first: 13.4 }, [200, 300]]);
  assert.ok(logSummary.distance > 20 && logSummary.distance < 20.3, `${logSummary.distance}`);
  assert.equal((await readTable(circleTableOf())).logSummary.jumps.count, 0);
});

test('ordinary logs are not mistaken for two paths or for another unit', async () => {
  const wrapAngle = (/** @type {number} */ angle) => Math.atan2(Math.sin(angle), Math.cos(angle));
  for (const tableText of [
    // These logs have few rows per lap, vibrations, a single distant pose, a robot that drives a curve back, the speed of a car, and a
    // column name with a unit.
    circleTableOf((_, i) => [2 * i, Math.sin(i), -Math.cos(i), wrapAngle(i)]),
    circleTableOf(([t, , , yaw], i) => [t, (i % 2) / 25, 0, yaw]),
    circleTableOf(([t], i) => (i < 10 ? [t, i === 4 ? 5 : 0, 0, 0] : [])),
    circleTableOf(([t], i) => [t, ...CIRCLE_ROWS[Math.min(i, 799 - i)].slice(1)]),
    circleTableOf(([t]) => [t, 40 * Math.sin(0.3 * t), 0, 0]),
    circleTableOf(([t]) => [t, 15 * Math.sin(t), 0, 0], 't,x_m,y_m,yaw'),
  ]) assert.equal((await readTable(tableText)).logSummary.units.length.unit, 'm');
});

test('units are guessed from two pieces of evidence', async () => {
  const toDegrees = (/** @type {number} */ yaw) => (yaw * 180) / Math.PI;
  /** Tables with the units of time and angle that are expected. @type {[string, string, string][]} */
  const unitCases = [
    [circleTableOf(), 's', 'rad'],
    [circleTableOf(([t, x, y], i) => [t, x, y, i / 40]), 's', 'rad'],
    [circleTableOf(([t, x, y, yaw]) => [t, x, y, toDegrees(yaw)]), 's', 'deg'],
    [circleTableOf(([t, x, y, yaw]) => [t, x, y, (toDegrees(yaw) + 360) % 360]), 's', 'deg'],
    [circleTableOf(([t, x, y, yaw]) => [1000 * t, x, y, yaw]), 'ms', 'rad'],
    [circleTableOf(([t, x, y, yaw]) => [1e9 * t, x, y, yaw]), 'ns', 'rad'],
    [circleTableOf(([t, x, y, yaw]) => [1e9 * t + 1e10, x, y, yaw]), 'ns', 'rad'],
    [circleTableOf(([t, x, y, yaw]) => [1000 * t, x, y, toDegrees(yaw)]), 'ms', 'deg'],
    [circleTableOf(([t, x, y, yaw]) => [1e9 * t, x, y, yaw], '%time,field.x,field.y,field.theta'), 'ns', 'rad'],
  ];
  for (const [tableText, timeUnit, angleUnit] of unitCases) {
    const { data: logColumns, logSummary: { units } } = await readTable(tableText);
    assert.deepEqual([units.time.unit, units.angle.unit], [timeUnit, angleUnit]);
    assert.ok(Math.abs(logColumns.t.at(-1) - logColumns.t[0] - CIRCLE_ROWS[799][0]) < 1e-9, `${logColumns.t[799]}`);
    assert.ok(Math.abs(Math.sin(logColumns.theta[799] - CIRCLE_ROWS[799][3])) < 1e-9, `${logColumns.theta[799]}`);
  }
});

/**
 * Tables that lead to a question about a unit. Each table has the option that answers the question, and a field of row 9 with its value
 * after the answer.
 * @type {[string, string, RegExp, import('../../www/logs/log.ts').OpenOptions, [string, number]][]}
 */
const UNIT_QUESTIONS = [
  ['millimetres', circleTableOf(([t, x, y, yaw]) => [t, 1000 * x, 1000 * y, yaw]), /in m, the robot would drive at \d+ m\/s; .*: mm \(0\.\d+ m\/s\) or cm \(\d.* or m \(.* or in \(.* or ft \(\d+ m\/s\)\.$/, { lengthUnit: 'mm' }, ['x', CIRCLE_ROWS[9][1]]],
  ['centimetres of a slow robot', circleTableOf(([t]) => [t, 15 * Math.sin(t), 0, 0]), /in m, the robot would drive at 1\d\.\d m\/s; .*: cm \(0\.15 m\/s\) or m \(15 m\/s\) or mm \(0\.015 m\/s\) or in \(0\.37 m\/s\) or ft \(4\.5 m\/s\)\.$/, { lengthUnit: 'cm' }, ['x', 0.15 * Math.sin(0.45)]],
  ['commands in centimetres', ['t,v,omega', ...createTimes(50).map((t) => `${t},${10 * Math.sin(2 * t)},0`)].join('\n'), /in m, the robot would drive at \d\.\d+ m\/s;/, { lengthUnit: 'cm' }, ['v', 0.1 * Math.sin(1.8)]],
  ['commands in milliseconds', ['t,v,omega', ...createTimes(50).map((t, i) => `${1000 * t},${i % 2},0.5`)].join('\n'), /in s, the times would mean 0\.01\d* rows a second; state their unit/, { timeUnit: 'ms' }, ['t', 0.9]],
  ['degrees of a robot that drives straight on', circleTableOf(([t]) => [t, t / 2, 0, 20 * Math.sin(t / 9)]), /headings in rad .*: rad or deg\.$/, { angleUnit: 'deg' }, ['theta', (Math.sin(0.05) * Math.PI) / 9]],
  ['radians that are called degrees', circleTableOf(undefined, 't,x,y,yaw_deg'), /headings in deg would turn at \d\.\d+ rad\/s; state their unit: rad or deg\.$/, { angleUnit: 'rad' }, ['theta', CIRCLE_ROWS[9][3]]],
  ['turn rates in degrees', ['t,v,omega', ...createTimes(50).map((t) => `${t},0.5,30`)].join('\n'), /headings in rad would turn at 30\.0 rad\/s/, { angleUnit: 'deg' }, ['omega', Math.PI / 6]],
];

test('columns of times in minutes or hours are refused because of their name', async () => {
  for (const [headerLine, unit] of [['t_min', 'min'], ['Time [hours]', 'h']]) assert.match(await catchRefusalSentence(readTable(circleTableOf(undefined, `${headerLine},x,y,yaw`))), new RegExp(`^run\\.csv: the unit ${unit} of a column is not known`));
  assert.equal((await readTable(circleTableOf(([t, ...poseCells]) => [`0:00:${t.toFixed(3).padStart(6, '0')}`, ...poseCells], 'Time [HH:MM:SS],x,y,yaw'))).logSummary.units.time.by, 'date');
});

for (const [caseName, tableText, expectedMessage, answerOptions, [fieldName, expectedValue]] of UNIT_QUESTIONS) {
  test(`the reader asks about ${caseName}`, async () => {
    const refusalError = await catchRefusalError(readTable(tableText));
    assert.match(refusalError.message, expectedMessage);
    const [[questionedUnit, chosenUnit]] = Object.entries(answerOptions);
    assert.equal(refusalError.userQuestion?.optionName, questionedUnit);
    assert.ok(refusalError.userQuestion.possibleAnswers.includes(chosenUnit), String(refusalError.userQuestion.possibleAnswers));
    const { data: logColumns, logSummary: { units } } = await readTable(tableText, answerOptions);
    assert.deepEqual(units[/** @type {'time' | 'length' | 'angle'} */ (questionedUnit.replace('Unit', ''))], { unit: chosenUnit, by: 'option' });
    assert.ok(Math.abs(logColumns[fieldName][9] - expectedValue) < 1e-12, `${logColumns[fieldName][9]}, not ${expectedValue}`);
  });
}

const LONG_WORD = 'x'.repeat(100);

/** Tables that are refused, with the expected message. @type {[string, string | Uint8Array<ArrayBuffer>, RegExp, import('../../www/logs/log.ts').OpenOptions?][]} */
const REFUSED_TABLES = [
  ['nothing', '', /^run\.csv: there is nothing in it;/],
  ['a header alone', 't,x,y,yaw\n', /0 of 0 rows can be used;/],
  ['bytes', Uint8Array.of(1, 2, 0, 4), /it is neither text nor/],
  ['one number a line', '1\n2\n', /^run\.csv: it does not look like a log, as it has no rows of numbers;/],
  ['no header', '1,2,3,4\n2,3,4,5\n', /^run\.csv, line 1: the table has no header, and its first row is “1,2,3,4”; name its 4 columns\.$/],
  ['no time', 'x,y,yaw\n0,0,0\n', /, line 1: none of the columns x, y, yaw is the time;/],
  ['a count of rows as times', ',x,y,yaw\n0,0,0,0\n1,0,0,0\n', /is the time;/],
  ['x and y of one source and the heading of another', 't,x,y,imu_yaw\n0,0,0,0\n1,0,0,0\n', /: x, y are positions without a heading;/],
  ['other columns', `t,${LONG_WORD}\n0,1\n`, /, line 1: the columns are t, x{40}…; expected are x, y and yaw/],
  ['a unit that is not known', 't,x [yd],y [yd],yaw\n0,0,0,0\n1,0,0,0\n', /the unit yd of a column is not known/],
  ['text in many rows', 't,x,y,yaw\n0,0,0,0\n1,a,0,0\n2,b,0,0\n', /, line 3: x is “a”; expected is a number\. 2 of 3 rows are damaged; at most 10 % may be\.$/],
  ['hexadecimal digits', 't,x,y,yaw\n0x10,0,0,0\n', /, line 2: t is “0x10”;/],
  ['thousands beside decimal commas', 't;x;y;yaw\n0,5;1.234;0;0\n1,5;1;0;0\n', /, line 2: x is “1\.234”;/],
  ['thousands in quotes', circleTableOf(([t, x, y, yaw]) => [`"${1000 * t}"`.replace(/\B(?=\d{3}")/, ','), x, y, yaw], 't_ms,x,y,yaw'), /t_ms is “1,000”; expected is a number without separators of thousands\./],
  ['decimal commas between commas', 't,x,y,yaw\n0,5,1,25,2,5,0,1\n1,5,1,25,2,5,0,1\n', /has 8 cells, and the header in line 1 4;/],
  ['short rows', 't,x,y,yaw\n0,0,0,0\n0,0,0\n1,0,0,0\n', /, line 3: the row has 3 cells;/],
  ['a long line', `t,x,y,yaw\n0,0,0,0\n${'1'.repeat(400_000)}`, /, line 3: the line has more than 65536 bytes;/],
  ['few rows', 't,x,y,yaw\nnan,0,0,0\n1,0,0,0', /, line 2: 1 of 2 rows can be used \(a value that is not finite, or above a billion\);/],
  ['a large value', 't,x,y,yaw\n1,0,0,0\n2,0,1e300,0\n', /, line 3: 1 of 2 rows can be used \(a value that is not finite, or above a billion\);/],
  ['two logs at the same times', circleTableOf((tableRow, i) => tableRow.with(0, CIRCLE_ROWS[i - (i % 2)][0])), /, line 3: 400 of 800 rows, this one first, have the time of another row/],
  ['nanoseconds without leading zeros', circleTableOf(([t, ...pose]) => [`${Math.floor(t)}.${Math.round((t % 1) * 1e9)}`, ...pose]), /, line 4: times go back by 0\.400 s and repeat those before; .* write fractions with their leading zeros \(1\.050000000 for 1 s and 50000000 ns\)\.$/],
  ['a height in y, and headings from x to z', circleTableOf(([t, x, y, yaw]) => [t, x, 0.1, y, yaw], 't,x,y,z,yaw'), /the headings follow the path in x and z, so the vertical axis is Y;/],
  ['several frames', circleTableOf((tableRow, i) => [...tableRow, i % 2 ? 'base' : 'wheel'], 't,x,y,yaw,child_frame_id'), /of several frames, topics or robots \(wheel, base\); keep/],
  ['robots one after the other', circleTableOf((tableRow, i) => [...tableRow, i >> 9], 't,x,y,yaw,robot_id'), /of several frames, topics or robots \(0, 1\); keep/],
  ['robots one after the other, with a prefix', circleTableOf((tableRow, i) => [...tableRow, i >> 9], 't,odom_x,odom_y,odom_yaw,robot_id'), /of several frames, topics or robots \(0, 1\); keep/],
  ['two robots in turns', circleTableOf((tableRow, i) => [...tableRow, i % 2], 't,x,y,yaw,robot_id'), /of several frames, topics or robots \(0, 1\); keep/],
  ['two paths', circleTableOf(([t, x, ...yawAndRest], i) => [t, i % 6 ? x : x + 1, ...yawAndRest]), /poses of two paths alternate, 1\.\d m apart: .*; keep those of one\.$/],
  ['Euler angles of Motive', 'Format Version,1.23,Take Name,x,Rotation Type,XYZ,Length Units,Meters\n\n,Type,Rigid Body\n,Name,Robot\n,ID,1\n,,Rotation\nFrame,Time (Seconds),X\n0,0.0,1\n1,0.1,1\n', /Euler angles \(XYZ\); export/],
  ['a program’s messages', '[INFO] [1718000000.1] [amcl]: at 1.0, 2.0\n'.repeat(3), /does not look like a log/],
  ['YAML', 'header:\n  seq: 1\n---\n', /it is YAML, not a table; write/],
  ['positions on the globe', 'time,latitude,longitude,heading\n0,48.1,11.5,0\n1,48.1,11.5,0\n', /latitude and longitude are angles; give x and y in metres/],
  ['dates in an order that is not clear', 't,x,y,yaw\n6/10/2024 12:00:00,0,0,0\n6/10/2024 12:00:01,0,0,0\n', /, or a date as 2024-01-31 12:00:00\.5\.$/],
  ['columns for a table of another width', '0 1 2 3 4\n1 1 2 3 4\n', /has 5 cells, and --columns names 4;/, { columnNames: ['t', 'x', 'y', 'yaw'] }],
];

for (const [caseName, tableText, expectedMessage, options] of REFUSED_TABLES) {
  test(`the reader refuses ${caseName}`, async () => {
    const refusalError = await catchRefusalError(readTable(tableText, options));
    assert.match(refusalError.message, expectedMessage);
    assert.match(refusalError.message, /; [a-z].+\.$/);
    assert.match(refusalError.composeMessage(german), /^run\.csv(, Zeile \d+)?: .+; .+\.$/);
  });
}

for (const [axesName, tableText] of [
  ['Y up, and headings from x to z', circleTableOf(([t, x, y, yaw]) => [t, x, 0.1, y, yaw], 't,x,y,z,yaw')],
  ['Y up, and headings from x to −z', circleTableOf(([t, x, y, yaw]) => [t, x, 0.1, -y, yaw], 't,x,y,z,yaw')],
  ['x and y exchanged', circleTableOf(([t, x, y, yaw]) => [t, y, x, yaw])],
  ['y negated', circleTableOf(([t, x, y, yaw]) => [t, x, -y, yaw])],
]) {
  test(`the columns proposed for a table with ${axesName} give the path on the floor`, async () => {
    const { userQuestion } = await catchRefusalError(readTable(tableText));
    const { motionData } = await readTable(tableText, { columnNames: userQuestion?.possibleAnswers[0].split(',') });
    assert.deepEqual([[.../** @type {any} */ (motionData).x], [.../** @type {any} */ (motionData).y]], [1, 2].map((columnIndex) => CIRCLE_ROWS.map((tableRow) => tableRow[columnIndex])));
  });
}

test('of rows that arrive in bursts, the last of each burst is read', async () => {
  const { motionData, logSummary } = await readTable(circleTableOf((tableRow, i) => tableRow.with(0, CIRCLE_ROWS[i - (i % 5)][0] + 1e-4 * (i % 5))));
  assert.deepEqual([logSummary.units.time, logSummary.gaps.count, logSummary.dropped.burst?.count], [{ unit: 's', by: 'usage' }, 0, 0.8 * CIRCLE_ROWS.length]);
  assert.deepEqual([.../** @type {any} */ (motionData).x], CIRCLE_ROWS.filter((_, i) => i % 5 === 4).map(([, x]) => x));
});

test('missing columns are proposed for columns of unknown names, unless no column fits', async () => {
  for (const [headerLine, proposedNames] of /** @type {[string, string[]][]} */ ([
    ['Zeit,PosX,PosY,Winkel', ['t,PosX,PosY,yaw']],
    ['ID,Zeit,X [mm],Y [mm],Winkel', ['-,t,X [mm],Y [mm],yaw']],
    ['Frame,RX,TX [mm],TY [mm]', []],
    ['t,left,right', ['t,v,omega']],
    ['linear.x,linear.y,angular.z,angular.x', []],
    ['a,b,c,d,e,f', []],
  ])) {
    const rowPrefix = headerLine.startsWith('ID') ? ['7'] : [];
    const { userQuestion } = await catchRefusalError(readTable(circleTableOf((tableRow) => [...rowPrefix, ...tableRow].slice(0, headerLine.split(',').length), headerLine)));
    assert.deepEqual(userQuestion?.possibleAnswers, proposedNames, headerLine);
  }
});

test('columns named by the user keep the units of a row below the header', async () => {
  const { motionData } = await readTable(circleTableOf(([t, x, y, yaw], i) => (i === 0 ? ['s', 'mm', 'mm', 'rad'] : [t, 1000 * x, 1000 * y, yaw]), 'Zeit,Rechts,Hoch,Winkel'), { columnNames: ['t', 'x', 'y', 'yaw'] });
  assert.ok(Math.abs(/** @type {any} */ (motionData).x[5] - CIRCLE_ROWS[6][1]) < 1e-9);
});

test('a heading without a prefix belongs to the only path of a table', async () => {
  const { logSummary: { columns: tableColumns } } = await readTable(circleTableOf((tableRow) => tableRow, 'Frame Time,Center X,Center Y,Rotation'));
  assert.deepEqual(tableColumns, { t: 'Frame Time', x: 'Center X', y: 'Center Y', yaw: 'Rotation' });
});

test('a heading beside velocities is not that of a path with a prefix', async () => {
  const [{ seriesList }] = await openRecordings([new File(['t,v,omega,theta,gps.x,gps.y\n0,1,0,0,0,0\n1,1,0,0,1,0\n'], 'run.csv')]);
  assert.deepEqual(seriesList.map(({ seriesKind }) => seriesKind), ['commands', 'positions']);
});

test('a table with more rows than a day at 100 Hz is refused', async () => {
  const rowCollector = Object.assign(new RowCollector({ fileName: 'run.csv' }), { rowCount: 1e7 - 1 });
  const addRow = async () => rowCollector.addRow({ sampleTime: 0, a: 0, b: 0, c: 0 }, 1);
  await addRow();
  assert.equal(await catchRefusalSentence(addRow()), 'run.csv: there are more rows; expected are at most 10000000.');
});

test('a file that has been moved is refused', async () => {
  const movedFile = { name: `${'n'.repeat(50)}.csv`, size: 5, slice: () => ({ arrayBuffer: () => Promise.reject(new DOMException('', 'NotFoundError')) }) };
  assert.equal(await catchRefusalSentence(openRecordings([/** @type {any} */ (movedFile)])), `${'n'.repeat(40)}…: the file cannot be read (NotFoundError); check that it exists and may be read.`);
});

test('lines that span two pieces of a large file are read completely', async () => {
  const tableRows = Array.from({ length: 120_000 }, (_, i) => `${i},${i / 8},${'x'.repeat(i % 40)},0,0.125`);
  const { motionData } = await readTable(['t,x,note,y,yaw', ...tableRows].join('\n'));
  assert.deepEqual([.../** @type {any} */ (motionData).x], tableRows.map((_, i) => i / 8));
});
