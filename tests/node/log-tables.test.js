// Logs as text tables. Each format is read, and gives the expected rows.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { openRecordings } from '../../www/logs/open.ts';
import { german } from '../../www/logs/de.ts';
import { english } from '../../www/logs/en.ts';
import { summarySentencesOf } from '../../www/logs/log.ts';

/**
 * @import { LogChoice, OpenOptions } from '../../www/logs/log.ts'
 *
 * @typedef {object} TableCase
 * @property {string} name
 * @property {string | Uint8Array<ArrayBuffer>} tableText
 * @property {'poses' | 'commands'} [kind] default: poses
 * @property {number} [start] time of the first row; default 0
 * @property {string[]} [series] names of the series; default: one series without a name
 * @property {Partial<LogChoice>} [choice]
 * @property {OpenOptions} [options]
 * @property {RegExp} [summaryPattern] pattern of sentences of the summary
 */

/** Rows of a robot that drives on a circle: time, x, y, heading, speed, turn rate. */
const CIRCLE_ROWS = Array.from({ length: 24 }, (_, i) => {
  const [t, r, theta] = [i / 16, 1.25, i / 32 - 0.75];
  return { i, t, x: r * Math.sin(theta), y: -r * Math.cos(theta), theta, v: 0.625, omega: 0.5, qz: Math.sin(theta / 2), qw: Math.cos(theta / 2) };
});

/** @typedef {typeof CIRCLE_ROWS[0]} Row */

/** Returns a table of all rows of the circle. @param {string} headerCells @param {(row: Row) => (string | number)[]} cellsOf @param {string} [separator] */
const tableOf = (headerCells, cellsOf, separator = ',') => [headerCells, ...CIRCLE_ROWS.map((circleRow) => cellsOf(circleRow).join(separator)), ''].join('\n');

const EPOCH_SECONDS = 1_718_000_000;
/** Returns the digits of a time (s) in nanoseconds. @param {number} t */
const formatNanoseconds = (t) => `${EPOCH_SECONDS + Math.floor(t)}${String(Math.round((t % 1) * 1e9)).padStart(9, '0')}`;
const splitSeconds = (/** @type {number} */ t) => [EPOCH_SECONDS + Math.floor(t), Math.round((t % 1) * 1e9)];
const useDecimalComma = (/** @type {unknown} */ cellValue) => String(cellValue).replace('.', ',');
const toDegrees = (/** @type {number} */ radians) => (radians * 180) / Math.PI;
const isoDateOf = (/** @type {number} */ t) => new Date((EPOCH_SECONDS + Math.floor(t)) * 1000).toISOString().slice(0, 19) + `.${String(Math.round((t % 1) * 1e9)).padStart(9, '0')}`;
const poseCellsOf = (/** @type {Row} */ { x, y, qz, qw }) => [x, y, 0, 0, 0, qz, qw];
const zerosOf = (/** @type {number} */ zeroCount) => Array.from({ length: zeroCount }, () => 0);
const ABBREVIATED_ARRAY = '<array type: double[36]>';
const utf16BytesOf = (/** @type {string} */ plainText) => new Uint8Array(Buffer.from(`\ufeff${plainText}`, 'utf16le'));

const ODOMETRY_COLUMNS = 'seq header.frame_id child_frame_id pose.pose.position.x pose.pose.position.y pose.pose.position.z pose.pose.orientation.x pose.pose.orientation.y pose.pose.orientation.z pose.pose.orientation.w'.split(' ');
const VELOCITY_COLUMNS = ['twist.twist.linear.x', 'twist.twist.linear.y', 'twist.twist.angular.x', 'twist.twist.angular.z'];
const rostopicTableOf = (/** @type {(row: Row) => string | number} */ stampOf) =>
  tableOf(['%time', 'field.header.stamp', ...[...ODOMETRY_COLUMNS, 'pose.covariance0', ...VELOCITY_COLUMNS].map((fieldName) => `field.${fieldName}`)].join(','), (tableRow) => [formatNanoseconds(tableRow.t), stampOf(tableRow), tableRow.i, 'odom', 'base', ...poseCellsOf(tableRow), 9, tableRow.v, 9, 9, tableRow.omega]);
const bagpyTableOf = (/** @type {string} */ secondsColumn, /** @type {string} */ nanosecondsColumn) =>
  tableOf(['Time', secondsColumn, nanosecondsColumn, ...ODOMETRY_COLUMNS, ...VELOCITY_COLUMNS].join(','), (tableRow) => [EPOCH_SECONDS + tableRow.t + 7, ...splitSeconds(tableRow.t), tableRow.i, 'odom', 'base', ...poseCellsOf(tableRow), tableRow.v, 9, 9, tableRow.omega]);

/** PlotJuggler's table of two topics, in which each sample of a topic has its own row. */
const plotjugglerTable = [
  ['__time', ...['position/x', 'position/y', 'orientation/x', 'orientation/y', 'orientation/z', 'orientation/w'].flatMap((fieldPath) => [`/odom/pose/pose/${fieldPath}`, `/mocap/pose/${fieldPath}`]), '/imu/angular_velocity/z'].join(','),
  ...CIRCLE_ROWS.flatMap(({ t, x, y, qz, qw }) => [
    [EPOCH_SECONDS + t, ...[x, y, 0, 0, qz, qw].flatMap((cellValue) => [cellValue, '']), ''],
    [EPOCH_SECONDS + t + 0.01, ...[x + 4, y, 0, 0, qz, qw].flatMap((cellValue) => ['', cellValue]), ''],
    [EPOCH_SECONDS + t + 0.02, ...Array.from({ length: 12 }, () => ''), 0.5],
  ]).map((rowCells) => rowCells.join(',')),
].join('\n');

/** Returns a Motive export: preamble, and columns of a body and a marker. @param {'Meters' | 'Millimeters'} lengthUnit @param {boolean} isYUp */
function motiveTableOf(lengthUnit, isYUp) {
  const unitsPerMetre = lengthUnit === 'Meters' ? 1 : 1000;
  const repeatCell = (/** @type {string} */ cellText, /** @type {number} */ repeatCount) => Array.from({ length: repeatCount }, () => cellText).join(',');
  return [
    `Format Version,1.25,Take Name,drive,Take Notes,,Capture Frame Rate,16.000000,Export Frame Rate,16.000000,Capture Start Time,2024-06-10 06.13.20.000 AM,Total Frames in Take,60,Rotation Type,Quaternion,Length Units,${lengthUnit},Coordinate Space,Global`,
    '',
    `,Type,${repeatCell('Rigid Body', 8)},${repeatCell('Rigid Body Marker', 3)}`,
    `,Name,${repeatCell('Robot', 8)},${repeatCell('Robot:Marker1', 3)}`,
    `,ID,${repeatCell('6E6B', 11)}`,
    `,,${repeatCell('Rotation', 4)},${repeatCell('Position', 3)},Mean Marker Error,${repeatCell('Position', 3)}`,
    'Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,,X,Y,Z',
    ...CIRCLE_ROWS.map(({ i, t, x, y, qz, qw }) => {
      // A positive heading about the vertical axis Y turns Z towards X.
      const bodyCells = isYUp ? [0, qz, 0, qw, x * unitsPerMetre, 0.1, -y * unitsPerMetre] : [0, 0, qz, qw, x * unitsPerMetre, y * unitsPerMetre, 0.1];
      return [i, t, ...bodyCells, 0.0001, 1, 2, 3].join(',');
    }),
  ].join('\r\n');
}

/** Lines of tables that pandas wrote, by tests/reference/logs/tables.py. */
const PANDAS_TABLES = JSON.parse(readFileSync(new URL('../reference/logs/tables.json', import.meta.url), 'utf8'));

const pandasTableOf = (/** @type {string} */ tableName) => `${PANDAS_TABLES[tableName].join('\n')}\n`;

/** @type {TableCase[]} */
const READABLE_TABLES = [
  { name: 'pandas: an index without a name', tableText: pandasTableOf('index') },
  { name: 'pandas: dates of UTC', start: EPOCH_SECONDS, tableText: pandasTableOf('utc') },
  { name: 'pandas: dates of Berlin', start: EPOCH_SECONDS, tableText: pandasTableOf('berlin') },
  { name: 'pandas: dates without a zone', start: EPOCH_SECONDS, tableText: pandasTableOf('naive') },
  { name: 'pandas: durations', tableText: pandasTableOf('timedelta') },
  { name: 'pandas: decimal commas in UTF-16', tableText: utf16BytesOf(pandasTableOf('german')) },
  { name: 'pandas: nanoseconds in quotes', start: EPOCH_SECONDS, tableText: pandasTableOf('nanoseconds') },
  { name: 'pandas: a log of two that are merged', series: ['odom', 'gt'], choice: { seriesName: 'odom' }, tableText: pandasTableOf('merged') },
  { name: 'blanks after commas, quoted names, units', tableText: tableOf('"time [s]", "x [m]", "y [m]", "yaw [rad]"', ({ t, x, y, theta }) => [t, x, y, theta], ', ') },
  { name: 'tabs, columns in another order', tableText: tableOf('heading\ttimestamp\tx\ty', ({ t, x, y, theta }) => [theta, t, x, y], '\t') },
  { name: 'a separator in quotes', tableText: tableOf('note,t,x,y,yaw', ({ t, x, y, theta }) => ['"a, b"', t, x, y, theta]) },
  { name: 'semicolons, decimal commas, sep=', tableText: `\ufeffsep=;\r\n${tableOf('Time [s];X [m];Y [m];Yaw [rad]', ({ t, x, y, theta }) => [t, x, y, theta].map(useDecimalComma), ';').replaceAll('\n', '\r\n')}` },
  { name: 'a spreadsheet in UTF-16', tableText: utf16BytesOf(tableOf('t\tx\ty\tyaw', ({ t, x, y, theta }) => [t, x, y, theta].map(useDecimalComma), '\t')) },
  { name: 'commas in quotes', tableText: tableOf('t,x,y,yaw', ({ t, x, y, theta }) => [t, x, y, theta].map((cellValue) => `"${useDecimalComma(cellValue)}"`)) },
  { name: 'times with exponents', start: EPOCH_SECONDS, tableText: tableOf('t;x;y;yaw', ({ t, x, y, theta }) => [`1,${formatNanoseconds(t).slice(1)}E+18`, ...[x, y, theta].map(useDecimalComma)], ';') },
  { name: 'units in a row below the header', tableText: tableOf('t,x,y,yaw,battery\n[ms],mm,mm,deg,V', ({ t, x, y, theta }) => [t * 1000, x * 1000, y * 1000, toDegrees(theta), 24.5]), summaryPattern: /time in ms \(by name\), lengths in mm \(by name\), yaw in degrees \(by name\)/ },
  { name: 'quantities over their units', tableText: tableOf('t/ms,x pos/mm,y pos / mm,yaw in deg', ({ t, x, y, theta }) => [t * 1000, x * 1000, y * 1000, toDegrees(theta)]), summaryPattern: /time in ms \(by name\), lengths in mm \(by name\), yaw in degrees \(by name\)/ },
  { name: 'bars, seconds and microseconds', start: EPOCH_SECONDS, tableText: tableOf('tv_sec|tv_usec|x|y|yaw', ({ t, x, y, theta }) => [EPOCH_SECONDS + Math.floor(t), (t % 1) * 1e6, x, y, theta], '|') },
  { name: 'rows of two topics, each with columns of its own', series: ['a', 'b'], choice: { seriesName: 'b' }, tableText: CIRCLE_ROWS.flatMap(({ t, x, y, theta }) => [`/a,${t},9,9,9,,,`, `/b,${t},,,,${x},${y},${theta}`]).toSpliced(0, 0, 'topic,t,a_x,a_y,a_yaw,b_x,b_y,b_yaw').join('\n') },
  { name: 'two logs that are joined with NaN', series: ['a', 'b'], choice: { seriesName: 'b' }, summaryPattern: /^24 of 24 rows/, tableText: CIRCLE_ROWS.flatMap(({ t, x, y, theta }) => [`${t + 0.01},9,9,9,NaN,NaN,NaN`, `${t},NaN,NaN,NaN,${x},${y},${theta}`]).toSpliced(0, 0, 't,a_x,a_y,a_yaw,b_x,b_y,b_yaw').join('\n') },
  { name: 'numbers of laps and landmarks', tableText: tableOf('t,id,tag_id,x,y,yaw', ({ i, t, x, y, theta }) => [t, i >> 3, i >> 3, x, y, theta]) },
  { name: 'semicolons below a long preamble', tableText: `${'Parameter 1: value, 2\n'.repeat(80)}${tableOf('t;x;y;yaw', ({ t, x, y, theta }) => [t, x, y, theta], ';')}` },
  { name: 'names of MATLAB', tableText: tableOf('Time,x_m_,y_m_,yaw_deg_', ({ t, x, y, theta }) => [t, x, y, toDegrees(theta)]), summaryPattern: /degrees/ },
  { name: 'durations of MATLAB', tableText: tableOf('Time,x,y,yaw', ({ t, x, y, theta }) => [`00:00:${String(Math.floor(t)).padStart(2, '0')}.${String(t % 1).slice(2).padEnd(1, '0')}`, x, y, theta]) },
  { name: 'millimetres, degrees and milliseconds by name', tableText: tableOf('t_ms,x [mm],y [mm],yaw (deg)', ({ t, x, y, theta }) => [t * 1000, x * 1000, y * 1000, toDegrees(theta)]) },
  { name: 'rostopic echo -p', start: EPOCH_SECONDS, tableText: rostopicTableOf(({ t }) => formatNanoseconds(t)) },
  { name: 'rostopic echo -p with stamps of 0', start: EPOCH_SECONDS, tableText: rostopicTableOf(() => 0) },
  { name: 'rostopic echo -p, commands', start: EPOCH_SECONDS, kind: 'commands', choice: { logKind: 'commands' }, tableText: rostopicTableOf(({ t }) => formatNanoseconds(t)) },
  { name: 'bagpy', start: EPOCH_SECONDS, tableText: bagpyTableOf('header.stamp.secs', 'header.stamp.nsecs') },
  { name: 'stamp_sec, stamp_nsec', start: EPOCH_SECONDS, tableText: bagpyTableOf('stamp_sec', 'stamp_nsec') },
  { name: 'seconds, nanoseconds', start: EPOCH_SECONDS, tableText: bagpyTableOf('seconds', 'nanoseconds [ns]') },
  { name: 'ros2 topic echo --csv of odometry', start: EPOCH_SECONDS, tableText: tableOf('', (tableRow) => [...splitSeconds(tableRow.t), 'odom', 'base', ...poseCellsOf(tableRow), ...zerosOf(36), tableRow.v, 0, 0, 0, 0, tableRow.omega, ...zerosOf(36)]).slice(1) },
  { name: 'ros2 topic echo --csv --no-arr of odometry', start: EPOCH_SECONDS, tableText: tableOf('', (tableRow) => [...splitSeconds(tableRow.t), 'odom', 'base', ...poseCellsOf(tableRow), ABBREVIATED_ARRAY, tableRow.v, 0, 0, 0, 0, tableRow.omega, ABBREVIATED_ARRAY]).slice(1) },
  { name: 'ros2 topic echo --csv --no-arr of poses with covariance', start: EPOCH_SECONDS, tableText: tableOf('', (tableRow) => [...splitSeconds(tableRow.t), 'map', ...poseCellsOf(tableRow), ABBREVIATED_ARRAY]).slice(1) },
  { name: 'ros2 topic echo --csv of poses', start: EPOCH_SECONDS, tableText: tableOf('', (tableRow) => [...splitSeconds(tableRow.t), 'map', ...poseCellsOf(tableRow)]).slice(1) },
  { name: 'ros2 topic echo --csv of commands', start: EPOCH_SECONDS, kind: 'commands', tableText: tableOf('', ({ t, v, omega }) => [...splitSeconds(t), 'base', v, 0, 0, 0, 0, omega]).slice(1) },
  { name: 'PlotJuggler, a topic of two', start: EPOCH_SECONDS, series: ['odom', 'mocap', 'imu'], choice: { seriesName: 'odom' }, tableText: plotjugglerTable },
  {
    name: 'PlotJuggler, stamps of two topics', start: EPOCH_SECONDS, series: ['mocap.pose', 'cmd.vel'], choice: { seriesName: 'mocap.pose' },
    tableText: tableOf('__time,/mocap/pose/header/stamp,/mocap/pose/pose/position/x,/mocap/pose/pose/position/y,/mocap/pose/pose/orientation/yaw,/cmd_vel/header/stamp,/cmd_vel/twist/linear/x,/cmd_vel/twist/angular/z',
      ({ t, x, y, theta, v, omega }) => [EPOCH_SECONDS + t + 0.5, EPOCH_SECONDS + t, x, y, theta, EPOCH_SECONDS + t + 0.25, v, omega]),
  },
  { name: 'a prefix', series: ['gt', 'odom'], choice: { seriesName: 'odom' }, tableText: tableOf('t,gt_x,gt_y,gt_yaw,odom_x,odom_y,odom_yaw', ({ t, x, y, theta }) => [t, 7, 8, 9, x, y, theta]) },
  { name: 'a suffix', series: ['gt', 'odom'], choice: { seriesName: 'gt' }, tableText: tableOf('t,x_gt,y_gt,theta_gt,x_odom,y_odom,theta_odom', ({ t, x, y, theta }) => [t, x, y, theta, 7, 8, 9]) },
  { name: 'an own message before one that it contains', tableText: tableOf('time,object.pose.position.x,pose.position.x,pose.position.y,pose.yaw', ({ t, x, y, theta }) => [t, 9, x, y, theta]), series: ['', 'object'] },
  { name: 'Motive in metres, Y up', tableText: motiveTableOf('Meters', true), summaryPattern: /Y is the vertical axis/ },
  { name: 'Motive in millimetres, Z up', tableText: motiveTableOf('Millimeters', false) },
  { name: 'quaternions that start with w, against their header', tableText: tableOf('t,x,y,z,qx,qy,qz,qw', ({ t, x, y, qz, qw }) => [t, x, y, 0, qw, 0, 0, qz]), summaryPattern: /the quaternions start with w/ },
  { name: 'TUM', start: EPOCH_SECONDS, tableText: tableOf('# timestamp tx ty tz qx qy qz qw', (tableRow) => [EPOCH_SECONDS + tableRow.t, ...poseCellsOf(tableRow)], ' ') },
  { name: 'TUM without a header, tabs', tableText: tableOf('', (tableRow) => [tableRow.t, ...poseCellsOf(tableRow)], '\t').slice(1) },
  { name: 'UTIAS', start: EPOCH_SECONDS, tableText: tableOf('# Ground truth\n# Time [s]    x [m]    y [m]    orientation [rad]', ({ t, x, y, theta }) => [EPOCH_SECONDS + t, x, y, theta], '    ') },
  { name: 'UTIAS, commands', kind: 'commands', tableText: tableOf('# Time [s]    forward velocity [m/s]    angular velocity[rad/s]', ({ t, v, omega }) => [t, v, omega], '\t') },
  { name: 'a commented header in another order', tableText: tableOf('# ground truth\n# timestamp tx ty tz qw qx qy qz', ({ t, x, y, qz, qw }) => [t, x, y, 0, qw, 0, 0, qz], ' ') },
  { name: 'EuRoC', start: EPOCH_SECONDS, tableText: tableOf('#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1]', ({ t, x, y, qz, qw }) => [formatNanoseconds(t), x, y, 0, qw, 0, 0, qz, 1, 1]) },
  { name: 'columns that are given, some skipped', options: { columnNames: ['-', 't', 'x', 'y', 'yaw_deg'] }, tableText: tableOf('a,b,c,d,e', ({ i, t, x, y, theta }) => [i, t, x, y, toDegrees(theta)]) },
  { name: 'columns that are given, with the units of the header', options: { columnNames: ['t', 'x', 'y', 'yaw'] }, tableText: tableOf('Zeit [ms],X [mm],Y [mm],Winkel [deg]', ({ t, x, y, theta }) => [t * 1000, x * 1000, y * 1000, toDegrees(theta)]) },
  { name: 'dates with a zone, in a column without a name', start: EPOCH_SECONDS, tableText: tableOf(',x,y,yaw', ({ t, x, y, theta }) => [`${isoDateOf(t + 7200)}+02:00`, x, y, theta]) },
  { name: 'times in ms, by rate and speed', tableText: tableOf('t,x,y,yaw', ({ t, x, y, theta }) => [t * 1000, x, y, theta]), summaryPattern: /time in ms \(by rate and speed\)/ },
];

for (const { name: caseName, tableText, kind = 'poses', start = 0, series: seriesNames = [''], choice, options, summaryPattern } of READABLE_TABLES) {
  test(`the reader reads ${caseName}`, async () => {
    const [recording] = await openRecordings([new File([tableText], 'run.csv')], () => options);
    assert.deepEqual(recording.seriesList.map((foundSeries) => foundSeries.seriesName), seriesNames);
    const [log] = await recording.readLogs([{ seriesName: '', ...choice }]);
    const { t, ...tableColumns } = /** @type {any} */ (log.motionData);
    assert.equal(log.logKind, kind);
    const fieldNames = /** @type {(keyof Row)[]} */ (kind === 'poses' ? ['x', 'y', 'theta'] : ['v', 'omega']);
    assert.equal(t.length, CIRCLE_ROWS.length);
    for (const tableRow of CIRCLE_ROWS) {
      assert.equal(log.startTime - start + t[tableRow.i], tableRow.t);
      // Conversion from other units or from quaternions rounds values, by up to 1.25 units in the last place.
      for (const fieldName of fieldNames) assert.ok(Math.abs(tableColumns[fieldName][tableRow.i] - tableRow[fieldName]) <= Number.EPSILON, `${fieldName} ${tableColumns[fieldName][tableRow.i]} ${tableRow[fieldName]}`);
    }
    const summaryLines = summarySentencesOf(log, english.logSummaryTexts);
    if (summaryPattern) assert.match(summaryLines.join('\n'), summaryPattern);
    assert.equal(summarySentencesOf(log, german.logSummaryTexts).length, summaryLines.length);
  });
}
