// Choice of the logs of a calibration, their pairing into drives (an odometry log and a reference log each), checks, and summaries.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { german } from '../../www/logs/de.ts';
import { planDrives } from '../../www/logs/drives.ts';
import { english } from '../../www/logs/en.ts';
import { openRecordings } from '../../www/logs/open.ts';
import { pairLogs, readDrives } from '../../www/logs/pairs.ts';
import { LOG_ROLES, summarySentencesOf } from '../../www/logs/log.ts';
import { catchRefusalError, catchRefusalSentence } from './log-support.js';

/** @import { Recording } from '../../www/logs/log.ts' */

const SERIES_TYPE_AND_KIND = /** @type {const} */ ({
  odometry: ['nav_msgs/msg/Odometry', 'poses'], pose: ['geometry_msgs/msg/PoseStamped', 'poses'], point: ['geometry_msgs/msg/PointStamped', 'positions'],
  twist: ['geometry_msgs/msg/Twist', 'commands'], tf: ['tf2_msgs/msg/TFMessage', 'transforms'], text: ['std_msgs/msg/String', null], columns: ['t, x, y, yaw', 'poses'],
});

/**
 * Returns a recording with series (topics or tables) whose rows are never read.
 *
 * @param {Record<string, keyof typeof SERIES_TYPE_AND_KIND>} typesBySeries types by name
 * @param {Partial<Recording>} [moreFields]
 * @param {string[]} [framePairs] pairs of frames, as "odom base_link"
 * @returns {Recording}
 */
const createRecording = (typesBySeries, moreFields, framePairs = []) => ({
  recordingName: 'run.mcap',
  recordingFormat: 'mcap',
  seriesList: Object.entries(typesBySeries).map(([seriesName, typeName]) => {
    const [messageType, seriesKind] = SERIES_TYPE_AND_KIND[typeName];
    return { seriesName, messageType, seriesKind, messageCount: 9, ...(seriesKind === 'transforms' && { framePairs: framePairs.map((framePair) => ({ parent: framePair.split(' ')[0], child: framePair.split(' ')[1] })) }) };
  }),
  readLogs: () => Promise.reject(new Error('not read')),
  ...moreFields,
});

/** Returns the choice of a series and its frames as text. @param {import('../../www/logs/log.ts').LogChoice | undefined} choice */
const choiceTextOf = ({ seriesName, framePair } = { seriesName: '' }) => (framePair ? `${seriesName} ${framePair.parent} ${framePair.child}` : seriesName);

/** Returns the plan of drives, or rejects the promise if planning throws. @param {Recording[]} recordings @param {import('../../www/logs/drives.ts').UserChoices} [userChoices] */
const planDrivesAsync = async (recordings, userChoices) => planDrives(recordings, userChoices);

/**
 * Recordings with a single plausible choice of odometry and reference. Each item has the series of a recording, the expected odometry and
 * reference, the frames in /tf, and the user's options.
 * @type {[Parameters<typeof createRecording>[0], string, string, string[]?, any?][]}
 */
const UNAMBIGUOUS_ROLE_CASES = [
  [{ '/odom': 'odometry', '/vrpn_client_node/robot/pose': 'pose', '/amcl_pose': 'pose', '/cmd_vel': 'twist' }, '/odom', '/vrpn_client_node/robot/pose'],
  [{ '/odom': 'odometry', '/vicon/robot': 'pose', '/cmd_vel': 'twist' }, '/cmd_vel', '/vicon/robot', [], { logKind: 'commands' }],
  [{ '/odom': 'odometry', '/vicon/robot': 'pose' }, '/odom', '/vicon/robot', [], { logKind: 'commands' }],
  [{ '/robot1/wheel_odometry': 'odometry', '/base_pose_ground_truth': 'odometry' }, '/robot1/wheel_odometry', '/base_pose_ground_truth'],
  [{ '/odom': 'odometry', '/leica/position': 'point', '/pose': 'pose' }, '/odom', '/pose'],
  [{ '/odom': 'odometry', '/tf': 'tf' }, '/odom', '/tf map base_footprint', ['odom base_footprint', 'map base_footprint', 'odom base_link', 'map base_link']],
  [{ '/tf': 'tf', '/mocap': 'pose' }, '/tf odom base_link', '/mocap', ['odom base_link', 'map base_link']],
  [{ '/tf': 'tf' }, '/tf r1/odom r1/base_link', '/tf map r1/base_link', ['r1/odom r1/base_link', 'map r2/base_link', 'map r1/base_link']],
  [{ '/odom': 'odometry', '/slam': 'pose', '/mocap': 'pose' }, '/odom', '/slam', [], { reference: { seriesName: '/slam' } }],
  [{ '/odom': 'odometry', '/mocap': 'pose' }, '/mocap', '/odom', [], { odometry: { seriesName: 'mocap/' }, reference: { seriesName: '/odom' } }],
  [{ '/ecstatic/tf': 'tf', '/mocap': 'pose' }, '/ecstatic/tf odom base', '/mocap', [], { odometry: { framePair: { parent: 'odom', child: 'base' } } }],
];

test('odometry and reference are guessed from types, names and frames', () => {
  for (const [typesBySeries, odometryName, referenceName, frames, userChoices] of UNAMBIGUOUS_ROLE_CASES) {
    const [{ logChoices }] = planDrives([createRecording(typesBySeries, {}, frames)], userChoices);
    assert.deepEqual([logChoices.odometry, logChoices.reference].map(choiceTextOf), [odometryName, referenceName]);
  }
});

test('groups of columns are guessed like topics, and may be named without the trailing separator', () => {
  const csvFields = /** @type {const} */ ({ recordingName: 'run.csv', recordingFormat: 'csv' });
  for (const [typesBySeries, odometryName, referenceName, userChoices] of /** @type {[Parameters<typeof createRecording>[0], string, string, any?][]} */ ([
    [{ odom_: 'columns', gt_: 'columns' }, 'odom_', 'gt_'], [{ '': 'columns', gt_: 'columns' }, '', 'gt_'], [{ '': 'columns', _true: 'columns' }, '', '_true'], [{ '/truth': 'columns', '/odom': 'columns' }, '/odom', '/truth'],
    [{ a_: 'columns', b_: 'columns' }, 'b_', 'a_', { odometry: { seriesName: 'b' } }],
  ])) {
    const [{ logChoices }] = planDrives([createRecording(typesBySeries, csvFields)], userChoices);
    assert.deepEqual([logChoices.odometry?.seriesName, logChoices.reference?.seriesName], [odometryName, referenceName]);
  }
});

test('ambiguous roles lead to a question', async () => {
  for (const [typesBySeries, expectedSentence, askedQuestion, logRole, expectedChoices, frames, userChoices] of /** @type {[Parameters<typeof createRecording>[0], string, string?, string?, string[]?, string[]?, any?][]} */ ([
    [{ '/odom': 'odometry', '/a': 'pose', '/b': 'pose' }, 'it is not clear what the reference is: /odom (Odometry), /a (PoseStamped), /b (PoseStamped).', 'series', 'reference', ['/a', '/b']],
    [{ '/odom': 'odometry', '/wheel/odometry': 'odometry', '/mocap': 'pose' }, 'it is not clear what the odometry is: ', 'series', 'odometry'],
    [{ '/odom': 'odometry', '/odometry/filtered': 'odometry', '/cmd_vel': 'twist' }, 'by its names and types it has no reference, but /odom (Odometry), ', 'series', 'reference', []],
    [{ '/cmd_vel': 'twist', '/amcl_pose': 'pose' }, 'by its names and types it has no odometry, but ', 'series', 'odometry', ['/cmd_vel']],
    [{ '/odom': 'odometry', '/goal_pose': 'pose' }, 'by its names and types it has no reference, but ', 'series', 'reference'],
    [{ '/odom': 'odometry' }, 'it has no such topic, group of columns or transforms; expected is one of /odom (Odometry).', 'series', 'odometry', ['/odom'], [], { odometry: { framePair: { parent: 'odom', child: 'base' } } }],
    [{ '/tf': 'tf' }, 'give a parent and a child frame; connected are base_link → laser.', 'frames', 'odometry', ['base_link,laser'], ['base_link laser']],
    [{ '/tf': 'tf' }, 'it has one log only, /tf (TFMessage), by name or type the odometry; give the reference too.', 'other', 'odometry', undefined, ['odom base']],
    [{ '/odom': 'odometry' }, 'it has one log only, /odom (Odometry), by name or type the odometry; give the reference too.', 'other', 'odometry'],
    [{ '/mocap': 'pose' }, 'it has one log only, /mocap (PoseStamped), by name or type the reference; give the odometry too.', 'other', 'reference'],
    [{ '/cmd_vel': 'twist' }, 'it has one log only, /cmd_vel (Twist), by name or type the odometry; give the reference too.', 'other', 'odometry', undefined, [], { logKind: 'commands' }],
    [{ '/odom': 'odometry', '/leica/position': 'point' }, '/leica/position (PointStamped) are positions without a heading; '],
    [{ '/odom': 'odometry', '/clicked_point': 'point' }, 'by its names and types it has no reference, but ', 'series', 'reference'],
    [{ '/rosout': 'text' }, 'the topics are /rosout (String); '],
    [{ '/odom': 'odometry', '/mocap': 'pose' }, 'it has no such topic, group of columns or transforms; expected is one of /odom (Odometry), /mocap (PoseStamped).', 'series', 'reference', ['/mocap', '/odom'], [], { reference: { seriesName: '/moc' } }],
    [{ '/odom': 'odometry', '/mocap': 'pose' }, '/odom is the odometry itself; ', 'series', 'reference', ['/mocap'], [], { reference: { seriesName: '/odom' } }],
    [{ '/tf': 'tf' }, 'odom → base is the odometry itself; ', 'series', 'reference', [], ['odom base', 'mocap robot'], { reference: { framePair: { parent: 'odom', child: 'base' } } }],
  ])) {
    const { message: refusalMessage, userQuestion } = await catchRefusalError(planDrivesAsync([createRecording(typesBySeries, {}, frames)], userChoices));
    assert.ok(refusalMessage.startsWith('run.mcap') && refusalMessage.includes(`: ${expectedSentence}`), refusalMessage);
    assert.deepEqual([userQuestion?.optionName, userQuestion?.logRole], [askedQuestion, logRole], refusalMessage);
    if (expectedChoices) assert.deepEqual(userQuestion?.possibleAnswers, expectedChoices);
  }
});

test('several recordings are separate drives, or each contains one log of the same drive', async () => {
  const recordingWithBothLogs = createRecording({ '/odom': 'odometry', '/mocap': 'pose' });
  /** Returns the series that are chosen from each recording: odometry and reference. @param {Parameters<typeof planDrives>} planArguments */
  const plannedSeriesOf = (...planArguments) => planDrives(...planArguments).map(({ logChoices: { odometry, reference } }) => [odometry?.seriesName, reference?.seriesName]);
  assert.deepEqual(plannedSeriesOf([recordingWithBothLogs, recordingWithBothLogs]), [['/odom', '/mocap'], ['/odom', '/mocap']]);
  assert.deepEqual(plannedSeriesOf([createRecording({ '/mocap': 'pose' }), createRecording({ '/odom': 'odometry', '/cmd_vel': 'twist' })]), [['/odom', undefined], [undefined, '/mocap']]);
  assert.deepEqual(plannedSeriesOf([recordingWithBothLogs, createRecording({ '': 'columns' }, { recordingName: 'truth.csv', recordingFormat: 'csv' })]), [['/odom', undefined], [undefined, '']]);
  // A recording that has neither odometry nor reference is left out, unless the user chose it as odometry or reference.
  const cameraRecording = createRecording({ '/image': 'text' }, { recordingName: 'camera.mcap' });
  const skippedMessages = /** @type {string[]} */ ([]);
  assert.deepEqual(plannedSeriesOf([cameraRecording, recordingWithBothLogs], {}, ({ message: refusalMessage }) => void skippedMessages.push(refusalMessage.slice(0, 48))), [['/odom', '/mocap']]);
  assert.deepEqual(skippedMessages, ['camera.mcap: the topics are /image (String); exp']);
  assert.match(await catchRefusalSentence(planDrivesAsync([recordingWithBothLogs, { ...cameraRecording, logRole: 'reference' }])), /^camera\.mcap: the topics are \/image \(String\); /);
  const unpairedNamesOf = async (/** @type {string[]} */ ...recordingNames) => {
    const drivePlan = planDrives(recordingNames.map((recordingName) => createRecording({ '': 'columns' }, { recordingName, recordingFormat: 'csv' })));
    return LOG_ROLES.map((role) => drivePlan.filter(({ logChoices }) => logChoices[role]).map(({ recording: { recordingName } }) => recordingName));
  };
  assert.deepEqual(await unpairedNamesOf('truth.csv', 'a.csv'), [['a.csv'], ['truth.csv']]);
  assert.deepEqual(await unpairedNamesOf('odom1.csv', 'x.csv', 'y.csv', 'odom2.csv'), [['odom1.csv', 'odom2.csv'], ['x.csv', 'y.csv']]);
  assert.match(await catchRefusalSentence(unpairedNamesOf('a.csv', 'b.csv')), /^a\.csv: its name does not say whether it is odometry or reference; /);
  assert.match(await catchRefusalSentence(unpairedNamesOf('odom1.csv', 'odom2.csv', 'truth.csv')), /^odom1\.csv: the odometry is in odom1\.csv, odom2\.csv, and the reference in truth\.csv; /);
  // If one file is the odometry and the other has two series, only the choice of the reference is ambiguous.
  const twoBodyRecording = createRecording({ Robot: 'columns', Cart: 'columns' }, { recordingName: 'take.csv', recordingFormat: 'csv' });
  const odometryTable = createRecording({ '': 'columns' }, { recordingName: 'odom.csv', recordingFormat: 'csv' });
  const { userQuestion } = await catchRefusalError(planDrivesAsync([odometryTable, twoBodyRecording]));
  assert.deepEqual([userQuestion?.optionName, userQuestion?.logRole, userQuestion?.possibleAnswers], ['series', 'reference', ['Robot', 'Cart']]);
  assert.deepEqual(plannedSeriesOf([odometryTable, twoBodyRecording], { reference: { seriesName: 'Cart' } }), [['', undefined], [undefined, 'Cart']]);
  const ambiguousRecording = createRecording({ '/odom': 'odometry', '/a': 'pose', '/b': 'pose' });
  assert.match(await catchRefusalSentence(planDrivesAsync([ambiguousRecording, ambiguousRecording])), /^run\.mcap: it is not clear what the reference is: /);
});

/** Reads drives from tables, which are given by name. @param {Record<string, string>} textByName @param {import('../../www/logs/drives.ts').UserChoices} [userChoices] */
const readDrivesOf = async (textByName, userChoices) => readDrives(planDrives(await openRecordings(Object.entries(textByName).map(([fileName, tableText]) => new File([tableText], fileName))), userChoices));

/** Returns a table of poses with a time column. @param {number} rowCount @param {(i: number) => number[]} createRow */
const poseTableOf = (rowCount, createRow) => ['t,x,y,yaw', ...Array.from({ length: rowCount }, (_, i) => createRow(i).join(','))].join('\n');

/** Returns a table of poses along x at 20 Hz. @param {(i: number) => number} xOfRow @param {number} [startTime] */
const straightTableOf = (xOfRow, startTime = 0) => poseTableOf(400, (i) => [startTime + i / 20, xOfRow(i), 0, 0]);

test('logs of several drives are paired by their times, or in their order', async () => {
  const pairedNamesOf = async (/** @type {Record<string, number>} */ startTimes) => (await readDrivesOf(Object.fromEntries(Object.entries(startTimes).map(([fileName, startTime], k) => [fileName, straightTableOf((i) => (i * (10 + k)) / 1000, startTime)])))).map(({ odometry: odometryLog, reference: referenceLog }) => [odometryLog.logName, referenceLog.logName]);
  assert.deepEqual(await pairedNamesOf({ 'odom1.csv': 100, 'odom2.csv': 500, 'truth_a.csv': 501, 'truth_b.csv': 99 }), [['odom1.csv', 'truth_b.csv'], ['odom2.csv', 'truth_a.csv']]);
  assert.deepEqual(await pairedNamesOf({ 'odom1.csv': 0, 'odom2.csv': 0, 'truth_a.csv': 0, 'truth_b.csv': 0 }), [['odom1.csv', 'truth_a.csv'], ['odom2.csv', 'truth_b.csv']]);
});

test('two logs get a common start time, and logs without common time are reported', async () => {
  const odometryTable = 't,x,y,yaw\n1700000000.25,0,0,0\n1700000009.5,0.01,0,0';
  const [overlappingDrive] = await readDrivesOf({ 'odom.csv': odometryTable, 'truth.csv': 't,x,y,yaw\n1700000003.125,0,0,0\n1700000008.5,0,0,0' });
  assert.equal(overlappingDrive.odometry.startTime, 1_700_000_000);
  assert.deepEqual([[...overlappingDrive.odometry.motionData.t], [...overlappingDrive.reference.motionData.t]], [[0.25, 9.5], [3.125, 8.5]]);
  const [disjointDrive] = await readDrivesOf({ 'odom.csv': odometryTable, 'truth.csv': 't,x,y,yaw\n0,0,0,0\n1,0,0,0' });
  assert.deepEqual([disjointDrive.odometry.startTime, [...disjointDrive.odometry.motionData.t]], [0, [1_700_000_000.25, 1_700_000_009.5]]);
  assert.match(summarySentencesOf(disjointDrive.reference, english.logSummaryTexts).at(-1) ?? '', /^notes: no time in common with odom\.csv \(0\.00 s to 1\.00 s, and 1700000000\.25 s to 1700000009\.50 s\): /);
  assert.equal(summarySentencesOf(disjointDrive.reference, german.logSummaryTexts).length, summarySentencesOf(overlappingDrive.reference, german.logSummaryTexts).length + 1);
});

test('names that suggest a localizer, or swapped logs, are reported', async () => {
  const noteNamesOf = async (/** @type {string} */ odometryName, /** @type {string} */ referenceName) => {
    const logFiles = [odometryName, referenceName].map((fileName, k) => new File([straightTableOf((i) => (i * (k + 1)) / 100)], fileName));
    const [drive] = await readDrives(planDrives(await openRecordings(logFiles, (fileName) => ({ logRole: fileName === odometryName ? 'odometry' : 'reference' }))));
    return drive.reference.logSummary.notes.map(({ name: noteName }) => noteName);
  };
  assert.deepEqual(await noteNamesOf('truth.csv', 'wheels.csv'), ['swappedRoles']);
  assert.deepEqual(await noteNamesOf('odom.csv', 'amcl_pose.csv'), ['localizer']);
  const [{ odometry: odometryLog, reference: referenceLog }] = await readDrivesOf({ 'odom.csv': straightTableOf((i) => i / 90), 'truth.csv': straightTableOf((i) => i / 80) });
  const frameNotesOf = (/** @type {string} */ parent) => pairLogs(odometryLog, { ...referenceLog, logSummary: { ...referenceLog.logSummary, frames: { parent, child: 'base_link' } } }).reference.logSummary.notes;
  assert.deepEqual([frameNotesOf('mocap'), frameNotesOf('map')], [[], [{ name: 'localizer', values: [] }]]);
  for (const [firstName, secondName] of [['wheels.csv', 'truth.csv'], ['odom.csv', 'reference-by-odom.csv'], ['a.csv', 'b.csv']]) assert.deepEqual(await noteNamesOf(firstName, secondName), [], firstName);
});

test('a frozen reference is interrupted only while the odometry moves', async () => {
  const odometryXOf = (/** @type {number} */ i) => Math.max(0, i - 100) / 50;
  const movingOdometryTable = straightTableOf(odometryXOf);
  const referenceXOf = (/** @type {number} */ i) => 1.01 * odometryXOf(i);
  const readReference = async (/** @type {string} */ referenceTable, odometryTable = movingOdometryTable) => (await readDrivesOf({ 'odom.csv': odometryTable, 'truth.csv': referenceTable }))[0].reference;
  assert.deepEqual([(await readReference(straightTableOf(referenceXOf))).logSummary.dropped, (await readReference(straightTableOf(referenceXOf))).logSummary.used], [{}, 400]);
  const tableWithFrozenPose = straightTableOf((i) => referenceXOf(i >= 200 && i < 300 ? 200 : i));
  const { motionData, logSummary } = await readReference(tableWithFrozenPose);
  assert.deepEqual([motionData.t.length, [...motionData.breaks], logSummary.used, logSummary.dropped], [400, Array.from({ length: 100 }, (_, i) => 201 + i), 301, { held: { count: 99, first: 0 } }]);
  assert.equal(await catchRefusalSentence(readReference(straightTableOf(() => 7))), 'truth.csv: its pose stands still while the odometry moves on: it has lost the robot; give one that follows the robot.');
  assert.equal(await catchRefusalSentence(readReference(movingOdometryTable, straightTableOf(() => 7))), 'odom.csv: its pose never changes; give the odometry of a robot that drives.');
  // If the reference stays constant, it counts as lost if the odometry moves by more than five centimetres between the first and last second of that time.
  const countDroppedDuring = async (/** @type {number} */ pauseSeconds, /** @type {number} */ pauseSpeed) => {
    const odometryXOfRow = (/** @type {number} */ i) => (pauseSpeed * i) / 20;
    return (await readReference(straightTableOf((i) => 1.01 * odometryXOfRow(i >= 200 && i <= 200 + 20 * pauseSeconds ? 200 : i)), straightTableOf(odometryXOfRow))).logSummary.dropped.held?.count;
  };
  assert.deepEqual([await countDroppedDuring(2, 0.4), await countDroppedDuring(2.2, 0.4), await countDroppedDuring(7, 0.0095), await countDroppedDuring(7, 0.0105)], [undefined, 44, undefined, 140]);
  // A log of commands shows by its speeds that the robot moves.
  const commandTable = ['t,v,omega', ...Array.from({ length: 400 }, (_, i) => `${i / 20},${i < 100 ? 0 : 0.4},0`)].join('\n');
  assert.equal((await readReference(tableWithFrozenPose, commandTable)).logSummary.dropped.held?.count, 99);
});

test('logs with mirrored axes, or with different units of length, are refused', async () => {
  const exampleHeadings = Array.from({ length: 1200 }, (_, i) => 2 * Math.sin(i / 60) + Math.cos(i / 23) + i / 300);
  const pathPoints = [[0, 0]];
  for (const [i, stepHeading] of exampleHeadings.entries()) pathPoints.push([pathPoints[i][0] + Math.cos(stepHeading) / 40, pathPoints[i][1] + Math.sin(stepHeading) / 40]);
  const createChangedTable = (/** @type {(row: number[]) => number[]} */ changeRow) => poseTableOf(1200, (i) => changeRow([i / 20, ...pathPoints[i], exampleHeadings[i]]).map((cellValue) => Number(cellValue.toFixed(6))));
  const distortRow = (/** @type {number[]} */ [t, x, y, yaw]) => [t + 0.2, 1.02 * x + 3, 1.02 * y, 1.01 * yaw];
  // The changed tables have mirrored axes, swapped axes, and compass headings, which are clockwise from north.
  const mirrorRows = /** @type {((row: number[]) => number[])[]} */ ([([t, x, y, yaw]) => [t, x, -y, yaw], ([t, x, y, yaw]) => [t, -x, y, yaw], ([t, x, y, yaw]) => [t, y, x, yaw], ([t, x, y, yaw]) => [t, x, y, Math.PI / 2 - yaw]]);
  for (const mirrorRow of mirrorRows) {
    const [mirroredTable, unmirroredTable] = [createChangedTable((tableRow) => mirrorRow(distortRow(tableRow))), createChangedTable(distortRow)];
    for (const [odometryTable, referenceTable, questionedLog] of [[mirroredTable, unmirroredTable, 'odom'], [unmirroredTable, mirroredTable, 'truth'], [mirroredTable, mirroredTable, 'odom']]) {
      assert.match(await catchRefusalSentence(readDrivesOf({ 'odom.csv': odometryTable, 'truth.csv': referenceTable })), RegExp(`^${questionedLog}\\.csv: the headings turn the other way than the path; expected`));
    }
  }
  // If the log of a slow robot is read alone, no question about its unit is asked.
  const createSlowTable = (/** @type {number} */ lengthFactor) => createChangedTable(([t, x, y, yaw]) => [20 * t, lengthFactor * x, lengthFactor * y, yaw]);
  for (const [odometryFactor, referenceFactor, refusedFile, expectedUnit] of /** @type {const} */ ([[1, 100, 'truth', 'cm'], [100, 1, 'odom', 'cm'], [3.281, 1, 'odom', 'ft']])) {
    const { message: refusalMessage, userQuestion } = await catchRefusalError(readDrivesOf({ 'odom.csv': createSlowTable(odometryFactor), 'truth.csv': createSlowTable(referenceFactor) }));
    assert.match(refusalMessage, RegExp(`^${refusedFile}\\.csv: the robot would drive \\d+ times as fast as in \\w+\\.csv: its lengths seem to be in ${expectedUnit}; state their unit\\.`));
    assert.deepEqual([userQuestion?.optionName, userQuestion?.possibleAnswers], ['lengthUnit', [expectedUnit, 'm']]);
  }
});

test('a summary contains the driven distance, units and their evidence, dropped rows and gaps', async () => {
  const tableRows = Array.from({ length: 200 }, (_, i) => `${1_700_000_000_000 + 50 * i + (i > 100 ? 3000 : 0)},${i === 9 ? 'nan' : i / 100},${(i % 2) / 1000},${i / 2}`);
  const [{ reference: referenceLog }] = await readDrivesOf({ 'odom.csv': straightTableOf((i) => i / 90, 1_700_000_000), 'truth.csv': ['t,x,y,yaw_deg', ...tableRows].join('\n') });
  assert.equal(referenceLog.logSummary.distance.toFixed(1), '2.0');
  assert.deepEqual(summarySentencesOf(referenceLog, english.logSummaryTexts), [
    '199 of 200 rows, 13.0 s at 20.0 Hz, 2.0 m driven', 'columns: t, x, y, yaw_deg', 'units: time in ms (by size), lengths in m (assumed), yaw in degrees (by name)',
    'left out: 1 row, line 11: a value that is not finite, or above a billion', 'gaps: 1, the first 5.00 s after the start, the longest of 3.05 s',
  ]);
});
