// MCAP recordings of ROS 2: formats, topics and coordinate frames, messages that are left out, and errors.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { planDrives } from '../../www/logs/drives.ts';
import { english } from '../../www/logs/en.ts';
import { createAheadReader } from '../../www/logs/formats/container.ts';
import { openRecordings } from '../../www/logs/open.ts';
import { summarySentencesOf } from '../../www/logs/log.ts';
import { odometryMessageOf, poseOf, recordingOf, stampOf, transformMessageOf, twistOf } from '../mcap.js';
import { createRandomGenerator } from '../random.js';
import { readLog, catchRefusalSentence } from './log-support.js';

/** @import { Message } from '../mcap.js' */

const START_TIME = 1000;
const MESSAGE_COUNT = 120;
const timeOf = (/** @type {number} */ i) => START_TIME + i / 20;
const TF_TYPE = 'tf2_msgs/msg/TFMessage';
const ODOMETRY_TYPE = 'nav_msgs/msg/Odometry';

/** Returns the messages of a drive along an arc. @returns {Message[]} */
function createDriveMessages() {
  /** @type {Message[]} */
  const driveMessages = [];
  for (let i = 0; i < MESSAGE_COUNT; i++) {
    // Messages are recorded a little later than their stamps.
    const [t, recordingTime] = [timeOf(i), timeOf(i) + 0.01];
    const [x, y, theta] = [i / 100, i / 200, i / 50];
    const addMessage = (/** @type {string} */ topicName, /** @type {string} */ type, /** @type {any} */ rosMessage) => driveMessages.push({ topic: topicName, type, t: recordingTime, message: rosMessage });
    if (i === MESSAGE_COUNT - 1) addMessage('/tf_static', TF_TYPE, { transforms: [transformMessageOf(t, '/base_footprint', 'base_link', 0.5, 0, 0)] });
    if (i % 5 === 0) addMessage('/tf', TF_TYPE, { transforms: [transformMessageOf(t + 1, 'map', 'odom', 1, 2, Math.PI / 2)] });
    addMessage('/tf', TF_TYPE, { transforms: [transformMessageOf(t, 'odom', 'base_footprint', x, y, theta), transformMessageOf(t, 'base_link', 'wheel', 0, 0, 9 * theta)] });
    addMessage('/odom', ODOMETRY_TYPE, odometryMessageOf(t, x, y, theta));
    addMessage('/mocap/pose', 'geometry_msgs/msg/PoseStamped', { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(x, y, theta) });
    addMessage('/cmd_vel', 'geometry_msgs/msg/Twist', twistOf(0.5, x));
    addMessage('/chatter', 'std_msgs/msg/String', { data: 'hello '.repeat(20) });
  }
  return driveMessages;
}

/** Returns messages of odometry along x. @param {number} messageCount @param {(i: number) => any} [createMessage] */
const createOdometryMessages = (messageCount, createMessage = (i) => odometryMessageOf(timeOf(i), i, 0, 0)) => Array.from({ length: messageCount }, (_, i) => ({ topic: '/odom', type: ODOMETRY_TYPE, t: timeOf(i), message: createMessage(i) }));

const mcapFileOf = (/** @type {Uint8Array<ArrayBuffer>} */ mcapBytes) => new File([mcapBytes], 'run.mcap');

const assertAllClose = (/** @type {ArrayLike<number>} */ actualValues, /** @type {(i: number) => number} */ expectedValueOf) => {
  for (let i = 0; i < actualValues.length; i++) assert.ok(Math.abs(actualValues[i] - expectedValueOf(i)) < 1e-9, `${i}: ${actualValues[i]}, not ${expectedValueOf(i)}`);
};

test('topics are listed, and logs of topics and of chains of frames are read in one pass', async () => {
  const mcapFile = mcapFileOf(await recordingOf(createDriveMessages()));
  const [recording] = await openRecordings([mcapFile]);
  assert.equal(recording.recordingFormat, 'mcap');
  assert.deepEqual(
    recording.seriesList.map(({ seriesName, messageCount, seriesKind }) => [seriesName, messageCount, seriesKind]),
    [
      ['/chatter', MESSAGE_COUNT, null], ['/cmd_vel', MESSAGE_COUNT, 'commands'], ['/mocap/pose', MESSAGE_COUNT, 'poses'], ['/odom', MESSAGE_COUNT, 'poses'],
      ['/tf', MESSAGE_COUNT + MESSAGE_COUNT / 5, 'transforms'], ['/tf_static', 1, 'transforms'],
    ],
  );
  assert.equal(recording.seriesList[3].messageType, ODOMETRY_TYPE);

  const allLogs = await recording.readLogs([
    ...['/odom', '/cmd_vel'].map((seriesName) => ({ seriesName })),
    ...[['map', '/base_link'], ['odom', 'base_footprint']].map(([parentFrame, childFrame]) => ({ seriesName: '/tf', framePair: { parent: parentFrame, child: childFrame } })),
  ]);
  for (const log of allLogs) assert.deepEqual([log.startTime, log.motionData.t.length, log.logSummary.notes], [START_TIME, MESSAGE_COUNT, []], log.logName);
  assert.deepEqual(await readLog(mcapFile, { seriesName: '/odom' }), allLogs[0]);
  const [odometryData, commandData, mapToBase, odomToFootprint] = allLogs.map(({ motionData }) => /** @type {any} */ (motionData));
  assertAllClose(odometryData.t, (i) => i / 20);
  // Messages of a type without a stamp have the time of recording.
  assertAllClose(commandData.t, (i) => i / 20 + 0.01);
  // The chain of transforms contains the drifting odom frame, and a static transform that is recorded last. base_link is 0.5 m ahead.
  assertAllClose(mapToBase.t, (i) => i / 20);
  assertAllClose(mapToBase.x, (i) => 1 - i / 200 - 0.5 * Math.sin(i / 50));
  assertAllClose(mapToBase.y, (i) => 2 + i / 100 + 0.5 * Math.cos(i / 50));
  assertAllClose(mapToBase.theta, (i) => { const theta = i / 50 + Math.PI / 2; return theta > Math.PI ? theta - 2 * Math.PI : theta; });
  assertAllClose(odomToFootprint.x, (i) => i / 100);
});

test('an incomplete index is not used', async () => {
  const recordingBytes = await recordingOf(createDriveMessages());
  const logWithIndex = await readLog(mcapFileOf(recordingBytes), { seriesName: '/odom' });
  // One of the chunk indexes gets an opcode that readers skip. The checksum of the summary is cleared, so that it does not reveal this change.
  const footerStart = recordingBytes.length - 28;
  recordingBytes.writeUInt32LE(0, footerStart + 16);
  const CHUNK_INDEX_CODE = 8;
  let recordPosition = Number(recordingBytes.readBigUInt64LE(footerStart));
  while (recordingBytes[recordPosition] !== CHUNK_INDEX_CODE) recordPosition += 9 + Number(recordingBytes.readBigUInt64LE(recordPosition + 1));
  recordingBytes[recordPosition] = 0x80;
  assert.deepEqual((await readLog(mcapFileOf(recordingBytes), { seriesName: '/odom' })).motionData, logWithIndex.motionData);
});

test('stamps that begin at 0 are used; messages without stamps get the recording times, with a note in the summary', async () => {
  const readLogWithStamps = async (/** @type {(i: number) => number} */ frameStampOf) => {
    const rosMessages = createOdometryMessages(100, (i) => odometryMessageOf(frameStampOf(i), i, 0, 0)).map((rosMessage, i) => ({ ...rosMessage, t: 1_700_000_000 + i / 20 }));
    const log = await readLog(mcapFileOf(await recordingOf(rosMessages)), { seriesName: '/odom' });
    return { ...log, sentences: summarySentencesOf(log, english.logSummaryTexts).join(' ') };
  };
  const simulatedLog = await readLogWithStamps((i) => i / 10);
  assert.deepEqual([simulatedLog.startTime, simulatedLog.logSummary.rows, simulatedLog.motionData.t[0], simulatedLog.motionData.t[99]], [0, 100, 0, 9.9]);
  // Only 48 of the 100 messages have a stamp, and the others have the stamp 0.
  const unstampedLog = await readLogWithStamps((i) => (i < 48 ? i : 0));
  assert.deepEqual([unstampedLog.startTime, unstampedLog.motionData.t.length, unstampedLog.motionData.t[20]], [1_700_000_000, 100, 1]);
  assert.match(unstampedLog.sentences, /times: when messages were recorded/);
  assert.doesNotMatch(simulatedLog.sentences, /recorded/);
  const recordingWithoutHeader = await recordingOf(createOdometryMessages(100).map((rosMessage, i) => ({ ...rosMessage, type: 'geometry_msgs/msg/Pose', t: 1_700_000_000 + i / 20, message: poseOf(i, 0, 0) })));
  assert.deepEqual((await readLog(mcapFileOf(recordingWithoutHeader), { seriesName: '/odom' })).motionData, unstampedLog.motionData);
});

test('poses with rotations about other axes than Z are refused', async () => {
  const rosMessages = createOdometryMessages(100, (i) => {
    const rosMessage = odometryMessageOf(timeOf(i), 0, 0, 0);
    return { ...rosMessage, pose: { ...rosMessage.pose, pose: { position: { x: i / 100, y: 0, z: 0 }, orientation: { x: 0, y: Math.sin(i / 50), z: 0, w: Math.cos(i / 50) } } } };
  });
  assert.match(await catchRefusalSentence(readLog(mcapFileOf(await recordingOf(rosMessages)), { seriesName: '/odom' })), /^run\.mcap, topic \/odom: the poses do not turn about a vertical Z axis; export or record them again with Z up\.$/);
});

test('unusable quaternions, numbers and times are left out', async () => {
  const rosMessages = createOdometryMessages(20, (i) => odometryMessageOf(i === 8 ? timeOf(2) : timeOf(i), { 5: NaN, 11: 1e300 }[i] ?? i, 0, 0, i === 3 ? 0 : 1));
  const { motionData, logSummary } = await readLog(mcapFileOf(await recordingOf(rosMessages)), { seriesName: '/odom' });
  assert.deepEqual([.../** @type {any} */ (motionData).x], Array.from({ length: 20 }, (_, i) => i).filter((i) => ![3, 5, 8, 11].includes(i)));
  assert.deepEqual(logSummary.dropped, { noRotation: { count: 1, first: 4 }, notFinite: { count: 2, first: 6 }, duplicate: { count: 1, first: 9 } });
  assert.deepEqual([...motionData.breaks], []);
});

test('messages in chunks that overlap in time are read in the order of their times', async () => {
  const rosMessages = createOdometryMessages(200);
  const shuffledMessages = rosMessages.map((_, i) => rosMessages[(i * 77) % 200]);
  const { motionData } = await readLog(mcapFileOf(await recordingOf(shuffledMessages, { chunkSize: 4096 })), { seriesName: '/odom' });
  assert.deepEqual([.../** @type {any} */ (motionData).x], Array.from({ length: 200 }, (_, i) => i));
});

test('topics and frames that cannot be read are refused', async () => {
  const poseTypes = 'nav_msgs/Odometry, geometry_msgs/PoseStamped, PoseWithCovarianceStamped, TransformStamped, Pose, Pose2D or tf2_msgs/TFMessage';
  const commandTypes = 'geometry_msgs/Twist, TwistStamped or TwistWithCovarianceStamped';
  const mcapFile = mcapFileOf(await recordingOf(createDriveMessages()));
  for (const [logChoice, expectedError] of /** @type {const} */ ([
    [{ seriesName: '/chatter' }, `run.mcap, topic /chatter: its type is “std_msgs/msg/String”; expected is ${poseTypes}, or ${commandTypes} (encoded as cdr or ros1).`],
    [{ seriesName: '/cmd_vel', logKind: 'poses' }, `run.mcap, topic /cmd_vel: its type is “geometry_msgs/msg/Twist”; expected is ${poseTypes} (encoded as cdr or ros1).`],
    [{ seriesName: '/odom', framePair: { parent: 'map', child: 'odom' } }, 'run.mcap, topic /odom: its type is “nav_msgs/msg/Odometry”; expected is tf2_msgs/TFMessage, which has frames (encoded as cdr or ros1).'],
    [{ seriesName: '/tf', framePair: { parent: 'map', child: 'laser' } }, 'run.mcap, topic /tf: no transforms connect map → laser; choose among the connected frames: base_footprint → base_link, map → odom, odom → base_footprint, base_link → wheel.'],
  ])) assert.equal(await catchRefusalSentence(readLog(mcapFile, logChoice)), expectedError);
});

test('a static transform is valid from the beginning, and a changing transform from its first message', async () => {
  const createTransformMessages = (/** @type {(i: number) => number} */ mountXOfMessage) => Array.from({ length: 60 }, (_, i) => [
    transformMessageOf(i / 10, 'world', 'marker', i / 20, 0, 0),
    ...(i % 3 === 0 && i >= 30 ? [transformMessageOf(i / 10, 'marker', 'base', mountXOfMessage(i), 0, 0)] : []),
  ].map((transform) => ({ topic: '/tf', type: TF_TYPE, t: i / 10, message: { transforms: [transform] } }))).flat();
  const readLogWithMount = async (/** @type {(i: number) => number} */ mountXOfMessage) => {
    const { startTime, motionData, logSummary } = await readLog(mcapFileOf(await recordingOf(createTransformMessages(mountXOfMessage))), { seriesName: '/tf', framePair: { parent: 'world', child: 'base' } });
    return [motionData.t.length, startTime + motionData.t[0], /** @type {any} */ (motionData).x[0], logSummary.rows];
  };
  assert.deepEqual(await readLogWithMount(() => 0.5), [60, 0, 0.5, 60]);
  // A static transform may be published again with another value. Its times are not times of the pose.
  const staticTransformMessages = [0, 3].map((t) => ({ topic: '/tf_static', type: TF_TYPE, t, message: { transforms: [transformMessageOf(t, 'base', 'laser', t, 0, 0)] } }));
  const recalibratedFile = mcapFileOf(await recordingOf([...createTransformMessages(() => 0.5), ...staticTransformMessages].sort((messageA, messageB) => messageA.t - messageB.t)));
  const { motionData: { t } } = await readLog(recalibratedFile, { seriesName: '/tf', framePair: { parent: 'world', child: 'laser' } });
  assert.equal(t.length, 60);
  // If the transform of the child frame changes, the log has one row for each message of this transform. The first one comes at 3 s.
  assert.deepEqual(await readLogWithMount((i) => i / 100), [10, 3, 1.8, 10]);
});

test('positions without a heading are refused, and the message names their type', async () => {
  const pointMessages = Array.from({ length: 20 }, (_, i) => ({
    topic: '/prism', type: 'geometry_msgs/msg/PointStamped', t: i / 10, message: { header: { stamp: stampOf(i / 10), frame_id: 'world' }, point: { x: i / 20, y: 0, z: 0 } },
  }));
  const [recording] = await openRecordings([mcapFileOf(await recordingOf([...createDriveMessages().filter(({ topic: topicName }) => topicName === '/odom'), ...pointMessages]))]);
  const expectedError = /^run\.mcap: \/prism \(PointStamped\) are positions without a heading; give a reference that measures the heading, /;
  assert.match(await catchRefusalSentence((async () => planDrives([recording]))()), expectedError);
  assert.match(await catchRefusalSentence(recording.readLogs([{ seriesName: '/prism' }])), /^run\.mcap, topic \/prism: geometry_msgs\/msg\/PointStamped are positions without a heading; /);
});

test('recordings with an unsupported compression or encoding, with too few messages or with too short ones are refused', async () => {
  const refusalOf = async (/** @type {Parameters<typeof recordingOf>[1]} */ recordingOptions, rosMessages = createDriveMessages()) => catchRefusalSentence(readLog(mcapFileOf(await recordingOf(rosMessages, recordingOptions)), { seriesName: '/odom' }));
  assert.equal(await refusalOf({ compression: 'odd' }), 'run.mcap, topic /odom: it is damaged or incomplete (compression by snappy, not by zstd or lz4); copy it again from the robot, or try “mcap recover”.');
  assert.match(await refusalOf({ encoding: 'json' }), /^run\.mcap, topic \/odom: its type is “nav_msgs\/msg\/Odometry as json”; /);
  const [jsonRecording] = await openRecordings([mcapFileOf(await recordingOf(createOdometryMessages(3), { encoding: 'json' }))]);
  assert.match(await catchRefusalSentence((async () => planDrives([jsonRecording]))()), /^run\.mcap: the topics are \/odom \(Odometry as json\); /);
  assert.equal(await refusalOf({}, []), 'run.mcap: 0 of 0 rows can be used; expected are at least 2.');
  assert.equal(await refusalOf({}, createDriveMessages().slice(0, 6)), 'run.mcap, topic /odom: 1 of 1 rows can be used; expected are at least 2.');
  // The type of these messages is odometry, and their contents are too short.
  const shortMessages = createOdometryMessages(3, () => ({ data: 'x' })).map((rosMessage) => ({ ...rosMessage, type: 'std_msgs/msg/String', schema: ODOMETRY_TYPE }));
  assert.match(await refusalOf({}, shortMessages), /^run\.mcap, topic \/odom, message 1: it cannot be read \(.+\); expected is one of the topic's type\.$/);
});

test('chunks with a wrong checksum or size are not read', async () => {
  const readReason = async (/** @type {Buffer<ArrayBuffer>} */ bytes) => /: it is damaged or incomplete \((.+)\); copy/.exec(await catchRefusalSentence(readLog(mcapFileOf(bytes), { seriesName: '/odom' })))?.[1];
  const damagedBytes = await recordingOf(createOdometryMessages(20), { chunkSize: 1e6 });
  damagedBytes[damagedBytes.length >> 2] ^= 1;
  assert.equal(await readReason(damagedBytes), 'the checksum of a chunk is wrong');

  const bytes = await recordingOf(createOdometryMessages(20), { compression: 'zstd', hasIndex: false, hasChunks: true, chunkSize: 1e6 });
  // In a chunk record, the name of the compression follows the record's code and length, the start time and end time, size, checksum and the name's length.
  const chunkPosition = bytes.indexOf(Buffer.from('zstd')) - 4 - 4 - 8 - 16 - 9;
  for (const [statedSize, expectedReason] of /** @type {const} */ ([
    [10n ** 12n, 'a chunk of 1000000000000 bytes'],
    [10n, 'a compressed block is not what was written'],
  ])) {
    bytes.writeBigUInt64LE(statedSize, chunkPosition + 9 + 16);
    assert.equal(await readReason(bytes), expectedReason);
  }
});

test('a file that is read in pieces gives the right bytes, across pieces and after skipped ranges', async () => {
  const drawRandom = createRandomGenerator(7);
  const bytes = Buffer.alloc(60e6, Buffer.from(Array.from({ length: 9973 }, () => drawRandom() * 256)));
  const readByteRange = createAheadReader(new File([bytes], 'run.mcap'));
  for (let start = 0; start < bytes.length; ) {
    const chunkEnd = Math.min(bytes.length, start + Math.floor(drawRandom() ** 8 * 3e7));
    assert.deepEqual([chunkEnd, bytes.compare(await readByteRange(start, chunkEnd), 0, chunkEnd - start, start, chunkEnd)], [chunkEnd, 0]);
    start = drawRandom() < 0.05 ? Math.min(bytes.length, chunkEnd + 3e6) : chunkEnd;
  }
});
