// One drive in all formats of recordings, each written by the library of the format (tests/reference/logs/generate.py). Damaged recordings
// must lead to an error, and not to a wrong result.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { gunzipSync } from 'node:zlib';
import xxhash from 'xxhash-wasm';
import { english } from '../../www/logs/en.ts';
import { decompressLz4 } from '../../www/logs/formats/decompression.ts';
import { summarySentencesOf, type LogChoice, type Commands, type Log, type Poses, type Recording, type SourceFile } from '../../www/logs/log.ts';
import { openRecordings } from '../../www/logs/open.ts';
import { odometryMessageOf, recordingOf, transformMessageOf, type Message } from '../mcap.js';
import { catchRefusalError, catchRefusalSentence } from './log-support.js';

/** Compressed recordings of one drive, by file name. */
const COMPRESSED_FILES: Record<string, string> = JSON.parse(readFileSync(new URL('../reference/logs/recordings.json', import.meta.url), 'utf8'));

const decompressFile = (fileName: string) => gunzipSync(Buffer.from(COMPRESSED_FILES[fileName], 'base64'));

const createFile = (fileContents: Uint8Array | string, fileName: string, folderPath?: string): SourceFile => Object.assign(new File([fileContents as BlobPart], fileName), folderPath ? { path: folderPath } : {});

/** Returns the files of a rosbag2 folder. In recordings.json their names begin with the name of the folder. */
const folderFilesOf = (recordingName: string): SourceFile[] =>
  Object.keys(COMPRESSED_FILES).filter((fileName) => fileName.startsWith(`${recordingName}-metadata`) || fileName.startsWith(`${recordingName}-${recordingName}.`)).map((fileName) => {
    const nameInFolder = fileName.slice(recordingName.length + 1);
    return createFile(decompressFile(fileName), nameInFolder, `${recordingName}/${nameInFolder}`);
  });

async function openRecording(...fileSources: SourceFile[]): Promise<Recording> {
  const recordings = await openRecordings(fileSources);
  assert.equal(recordings.length, 1);
  return recordings[0];
}

const summaryTextOf = (log: Log) => summarySentencesOf(log, english.logSummaryTexts).join('. ');

/** Odometry and reference of the drive, read from its tables. */
const tableLogPromises = (await openRecordings(['odometry.csv', 'reference.csv'].map((fileName) => createFile(decompressFile(fileName), fileName)))).map((recording) => recording.readLogs([{ seriesName: '' }]));
const [[odometryLog], [referenceLog]] = await Promise.all(tableLogPromises);
const ODOMETRY_AND_REFERENCE: LogChoice[] = [{ seriesName: '/odom' }, { seriesName: '/truth' }];

const fileListOf = (fileName: string) => [createFile(decompressFile(fileName), fileName)];

/** Metadata of a recording that consists of two files. */
const SPLIT_METADATA = 'rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths: [split0.mcap, split1.mcap]\n';
const splitRecordingFilesOf = (...partNumbers: number[]) => [
  ...partNumbers.map((partNumber) => createFile(decompressFile(`split${partNumber}-split${partNumber}.mcap`), `split${partNumber}.mcap`, `drive/split${partNumber}.mcap`)),
  createFile(SPLIT_METADATA, 'metadata.yaml', 'drive/metadata.yaml'),
];

const SOURCES_BY_RECORDING: Record<string, SourceFile[]> = {
  'none.bag': fileListOf('none.bag'), 'bz2.bag': fileListOf('bz2.bag'), 'lz4.bag': fileListOf('lz4.bag'),
  'none.mcap': fileListOf('none.mcap'), 'lz4.mcap': fileListOf('lz4.mcap'), 'zstd.mcap': fileListOf('zstd.mcap'), 'unindexed.mcap': fileListOf('unindexed.mcap'),
  'unchunked.mcap': fileListOf('unchunked.mcap'), 'ros1-support.mcap': fileListOf('ros1-support.mcap'), 'ros2-support.mcap': fileListOf('ros2-support.mcap'),
  'a compressed database alone': fileListOf('sqlite-file-sqlite-file.db3.zstd'),
  sqlite: folderFilesOf('sqlite'), 'sqlite-messages': folderFilesOf('sqlite-messages'), 'sqlite-file': folderFilesOf('sqlite-file'),
  'mcap-messages': folderFilesOf('mcap-messages'), 'mcap-file': folderFilesOf('mcap-file'),
  'split files': splitRecordingFilesOf(0, 1), 'split files in another order': splitRecordingFilesOf(1, 0),
};

for (const [caseName, recordingSources] of Object.entries(SOURCES_BY_RECORDING)) {
  test(`${caseName} contains the same rows as the tables, to the last bit`, async () => {
    const recording = await openRecording(...recordingSources);
    assert.deepEqual(recording.seriesList.map(({ seriesName, seriesKind, messageCount }) => [seriesName, seriesKind, messageCount]), [['/odom', 'poses', 100], ['/truth', 'poses', 100]]);
    const allLogs = await recording.readLogs(ODOMETRY_AND_REFERENCE);
    for (const [i, tableLog] of [odometryLog, referenceLog].entries()) {
      assert.deepEqual([allLogs[i].startTime, allLogs[i].motionData], [tableLog.startTime, tableLog.motionData]);
      assert.deepEqual([allLogs[i].logSummary.dropped, allLogs[i].logSummary.notes, allLogs[i].logSummary.clock], [{}, [], 'header.stamp']);
    }
  });
}

/** Returns the rows of the drive that a log has, and compares their poses. Headings may differ by `headingTolerance`. */
function rowIndicesOf({ startTime, motionData }: Log, headingTolerance = 0): number[] {
  const [logPoses, allPoses] = [motionData, odometryLog.motionData] as Poses[];
  const rowIndices = Array.from(logPoses.t, (t) => Math.round(20 * (startTime - odometryLog.startTime + t - allPoses.t[0])));
  for (const coordinate of ['x', 'y'] as const) assert.deepEqual([...logPoses[coordinate]], rowIndices.map((rowIndex) => allPoses[coordinate][rowIndex]));
  for (const [i, rowIndex] of rowIndices.entries()) assert.ok(Math.abs(logPoses.theta[i] - allPoses.theta[rowIndex]) <= headingTolerance, `${logPoses.theta[i]}, not ${allPoses.theta[rowIndex]}`);
  return rowIndices;
}

const createRange = (firstInteger: number, endInteger: number) => Array.from({ length: endInteger - firstInteger }, (_, i) => firstInteger + i);

for (const fileName of ['types.bag', 'types.mcap']) {
  test(`${fileName}: poses and commands of all message types are read`, async () => {
    const recording = await openRecording(createFile(decompressFile(fileName), fileName));
    const framePair = { parent: 'odom', child: 'base_link' };
    const poses = await recording.readLogs([...['/fused', '/vicon', '/pose2d'].map((seriesName) => ({ seriesName })), { seriesName: '/tf', framePair }]);
    // Headings that are computed from quaternions are rounded to steps of 1e-12. Pose2D stores the heading itself.
    for (const log of poses) assert.deepEqual(rowIndicesOf(log, log === poses[2] ? 0.5e-12 + Number.EPSILON : 0), createRange(0, 40), log.logName);
    // The expected commands have the same formulas as in tests/reference/logs/generate.py.
    const roundCommand = (commandValue: number) => Math.round(4096 * commandValue) / 4096;
    const expectedCommands = [createRange(0, 40).map((i) => roundCommand(0.5 + 0.2 * Math.sin(i / 9))), createRange(0, 40).map((i) => roundCommand(0.8 * Math.sin(i / 23)))];
    const allLogs = await recording.readLogs(['/cmd_vel', '/cmd_stamped', '/cmd_fused'].map((seriesName) => ({ seriesName })));
    for (const { motionData, logName } of allLogs) assert.deepEqual([[...(motionData as Commands).v], [...(motionData as Commands).omega]], expectedCommands, logName);
    assert.equal(allLogs[0].logSummary.clock, 'log time');
    // Frames of wheels only turn, and are no candidates for a reference. A frame that is fixed to the moving base is a candidate.
    const { framePairs } = recording.seriesList.find(({ seriesName }) => seriesName === '/tf') as Recording['seriesList'][number];
    assert.deepEqual(framePairs?.map(({ parent, child }) => `${parent} → ${child}`), ['odom → base_link', 'odom → base_footprint']);
  });
}

test('a recording with a missing file is refused', async () => {
  for (const [partNumbers, missingParts] of [[[1], 'split0.mcap'], [[], 'split0.mcap, split1.mcap']] as const) {
    assert.equal(await catchRefusalSentence(openRecordings(splitRecordingFilesOf(...partNumbers))), `drive/metadata.yaml: it describes a recording in ${missingParts}; give that file too, or the whole folder.`);
  }
  assert.match(await catchRefusalSentence(openRecordings([createFile(SPLIT_METADATA, 'metadata.yaml', '')])), /^metadata\.yaml: it describes/);
});

/** Reads the odometry from a file's contents. */
const readOdometry = async (fileBytes: Uint8Array, fileName: string) => (await (await openRecording(createFile(fileBytes, fileName))).readLogs([{ seriesName: '/odom' }]))[0];

/** Reads the odometry from a file in which some bytes are overwritten. */
const readDamagedOdometry = (fileName: string, damagePosition: number) => readOdometry(decompressFile(fileName).fill(0xff, damagePosition, damagePosition + 40), fileName);

const findPositions = (bytes: Buffer, searchText: string) => Array.from(bytes.toString('latin1').matchAll(RegExp(searchText, 'g')), ({ index }) => index);

/** Returns a function that finds one position in the compressed data of each chunk: 60 bytes after `headerText`, which the chunk's header contains. */
const findPositionsInChunks = (headerText: string) => (bytes: Buffer) => findPositions(bytes, headerText).map((bytePosition) => bytePosition + 60);

/** Functions that find a position in each block with messages of the odometry. In an MCAP file, they also find positions in chunk indexes, which name the compression too. */
const BLOCK_FINDERS: Record<string, (bytes: Buffer) => number[]> = {
  'bz2.bag': findPositionsInChunks('compression='), 'lz4.bag': findPositionsInChunks('compression='), 'zstd.mcap': findPositionsInChunks('zstd'), 'lz4.mcap': findPositionsInChunks('lz4'),
  'sqlite-sqlite.db3': (bytes) => [...new Set(findPositions(bytes, 'base_link').map((bytePosition) => bytePosition - (bytePosition % 4096)))],
};

for (const [fileName, findBlocks] of Object.entries(BLOCK_FINDERS)) {
  test(`${fileName}: only the rows of a damaged block, or the rows after the end of a truncated file, are lost`, async () => {
    const lostRowsSoFar: number[] = [];
    for (const bytePosition of findBlocks(decompressFile(fileName))) {
      const log = await readDamagedOdometry(fileName, bytePosition);
      const keptRows = rowIndicesOf(log);
      const lostRows = createRange(0, 100).filter((tableRow) => !keptRows.includes(tableRow));
      if (lostRows.length > 0) assert.match(summaryTextOf(log), /1 damaged block skipped \(.+\)$/);
      const truncatedLogPromise = readOdometry(decompressFile(fileName).subarray(0, bytePosition), fileName);
      if (lostRowsSoFar.length === 0) await catchRefusalError(truncatedLogPromise);
      else {
        assert.deepEqual(rowIndicesOf(await truncatedLogPromise), lostRowsSoFar);
        if (lostRows.length > 0) assert.match(summaryTextOf(await truncatedLogPromise), /gaps: none\. notes: the file is incomplete: it ends in the middle of a row or record$/);
      }
      assert.ok(lostRows.length < 50);
      lostRowsSoFar.push(...lostRows);
    }
    assert.deepEqual(lostRowsSoFar, createRange(0, 100));
  });
}

test('all messages of a database with an unfinished transaction are read', async () => {
  const bytes = decompressFile('sqlite-sqlite.db3');
  const rootPage = createRange(0, bytes.length / 4096).map((pageIndex) => 4096 * pageIndex).find((bytePosition) => bytes[bytePosition] === 5) ?? 0;
  // The header of the SQLite database gets 8 as the number of pages, and the first page of the messages becomes empty, as before the
  // transaction.
  bytes.writeUInt32BE(8, 28);
  bytes.fill(0, rootPage, rootPage + 5)[rootPage] = 13;
  const log = await readOdometry(bytes, 'run.db3');
  assert.deepEqual(rowIndicesOf(log), createRange(0, 100));
  assert.match(summaryTextOf(log), /gaps: none\. notes: the file is incomplete: it ends in the middle of a row or record$/);
});

test('a damaged message is dropped, and a file with damaged headers or compression is refused', async () => {
  const fileName = 'mcap-messages-mcap-messages.mcap';
  // The file contains messages in Zstandard frames. Messages of the odometry and the reference alternate.
  const log = await readDamagedOdometry(fileName, findPositions(decompressFile(fileName), '\\(\xb5/\xfd')[6] + 20);
  assert.deepEqual([rowIndicesOf(log), log.logSummary.dropped], [[...createRange(0, 3), ...createRange(4, 100)], { damaged: { count: 1, first: 4 } }]);
  const bagWithoutTopics = Buffer.from(decompressFile('none.bag').toString('latin1').replaceAll('topic=', 'topic-'), 'latin1');
  assert.match(await catchRefusalSentence(readOdometry(bagWithoutTopics, 'none.bag')), /^none\.bag: it is damaged or incomplete \(a record has no field topic\); copy/);
  assert.match(await catchRefusalSentence(readDamagedOdometry('sqlite-file-sqlite-file.db3.zstd', 4000)), /: it is damaged or incomplete \(.+\); copy it again from the robot\.$/);
});

test('LZ4 frames of a wrong size are refused, and so are damaged frames with checksums', async () => {
  const bytes = decompressFile('lz4.mcap');
  // The header of the first chunk contains the size of its records, a checksum, the compression, and the size of the compressed frame.
  const namePosition = bytes.indexOf('lz4');
  const [contentSize, lz4FrameSize] = [namePosition - 16, namePosition + 3].map((sizePosition) => Number(bytes.readBigUInt64LE(sizePosition)));
  const lz4Frame = bytes.subarray(namePosition + 11, namePosition + 11 + lz4FrameSize);
  const chunkRecords = await decompressLz4(lz4Frame, contentSize);
  for (const wrongSize of [contentSize - 1, contentSize + 1]) await assert.rejects(decompressLz4(lz4Frame, wrongSize), RangeError);
  // A checksum of the only block and a checksum of the contents are added to the LZ4 frame.
  const { h32Raw } = await xxhash();
  const checksumOf = (bytes: Uint8Array) => Buffer.from(Uint32Array.of(h32Raw(bytes)).buffer);
  const blockStart = lz4Frame[4] & 0x08 ? 15 : 7;
  const lz4FrameWithChecksums = Buffer.concat([lz4Frame.subarray(0, -4), checksumOf(lz4Frame.subarray(blockStart + 4, -4)), lz4Frame.subarray(-4), checksumOf(chunkRecords)]);
  lz4FrameWithChecksums[4] |= 0x14;
  assert.deepEqual(await decompressLz4(lz4FrameWithChecksums, contentSize), chunkRecords);
  for (let i = blockStart + 4; i < lz4FrameWithChecksums.length; i++) {
    const damagedLz4Frame = Buffer.from(lz4FrameWithChecksums);
    damagedLz4Frame[i] ^= 17;
    await assert.rejects(decompressLz4(damagedLz4Frame, contentSize), RangeError);
  }
});

test('unsupported formats are recognized by their contents, and refused with a command for conversion', async () => {
  for (const [firstBytesText, expectedMessage] of [
    ['#ROSBAG V1.2\n', 'ROS bag 1; convert it with “rosbag reindex”,'], ['ULog\x01\x12\x35', 'PX4 ULog; convert it with “ulog2csv”,'], ['\xa3\x95\x80', 'ArduPilot DataFlash; convert it with “mavlogdump.py'],
    ['\x1f\x8b\x08', 'gzip; convert it with “gunzip”,'], ['BZh9', 'bzip2;'], ['\xfd7zXZ\0', 'xz;'], ['\x04\x22\x4d\x18', 'LZ4;'], ['PK\x03\x04', 'ZIP (.zip, .xlsx, .ods); unpack it, or export'], ['\x89HDF\r\n\x1a\n', 'HDF5;'], ['PAR1', 'Parquet;'],
  ]) assert.ok((await catchRefusalSentence(openRecordings([createFile(Buffer.from(firstBytesText, 'latin1'), 'run.mcap')]))).startsWith(`run.mcap: it is in the format ${expectedMessage}`), expectedMessage);
});

test('a recording without a complete message is refused, and the message names a repair tool', async () => {
  for (const [fileName, repairCommand] of [['none.bag', 'rosbag reindex'], ['unindexed.mcap', 'mcap recover'], ['sqlite-sqlite.db3', 'sqlite3 FILE .recover | sqlite3 NEW.db3']]) {
    for (const byteCount of [20, 200]) {
      const refusalMessage = await catchRefusalSentence(openRecordings([createFile(decompressFile(fileName).slice(0, byteCount), fileName)]));
      assert.ok(refusalMessage.startsWith(`${fileName}: it is damaged or incomplete (`) && refusalMessage.includes(`“${repairCommand}”`), refusalMessage);
    }
  }
});

test('files that are not recordings are refused', async () => {
  const emptyDatabase = Uint8Array.from({ length: 4096 }, (_, i) => 'SQLite format 3\0\x10'.charCodeAt(i) || 0);
  // The first page, which lists all tables, becomes a leaf without rows.
  emptyDatabase[100] = 13;
  assert.match(await catchRefusalSentence(openRecordings([createFile(emptyDatabase, 'run.db3')])), /without the tables “topics” and “messages” of rosbag2; expected/);
  assert.match(await catchRefusalSentence(openRecordings([createFile('t,x,y,yaw\n', 'split0.mcap', 'drive/split0.mcap'), ...splitRecordingFilesOf(1)])), /^split0\.mcap: it is listed in the metadata\.yaml of a recording, but is not a recording;/);
  const largeFile = { name: 'run.db3', size: 2 ** 30 + 1, slice: () => new Blob([Uint8Array.of(0x28, 0xb5, 0x2f, 0xfd)]) };
  assert.match(await catchRefusalSentence(openRecordings([largeFile])), /^run\.db3: it has more than 1073741824 bytes when it is decompressed; decompress it with “zstd -d”/);
  const shortRecording = await openRecording(...fileListOf('small.db3'));
  assert.match(await catchRefusalSentence(shortRecording.readLogs([{ seriesName: '/pose' }])), /^small\.db3, topic \/pose: 0 of 0 rows can be used;/);
});

const TF_TYPE = 'tf2_msgs/msg/TFMessage';
const timeOf = (i: number) => 1_700_000_000 + i / 20;
const createTfMessage = (i: number, ...transforms: unknown[]): Message => ({ topic: '/tf', type: TF_TYPE, t: timeOf(i), message: { transforms } });
const stepCount = 40;
const createForEachStep = <T>(makeItem: (i: number) => T): T[] => Array.from({ length: stepCount }, (_, i) => makeItem(i));
const readLogsOf = async (rosMessages: Message[], ...logChoices: LogChoice[]) => (await openRecording(createFile(await recordingOf(rosMessages), 'run.mcap'))).readLogs(logChoices);
const ODOM_TO_BASE_CHOICE = { seriesName: '/tf', framePair: { parent: 'odom', child: 'base_link' } };
const createMovingTransform = (i: number) => transformMessageOf(timeOf(i), 'odom', 'base_footprint', i / 50, 0, 0);

test('a constant transform is not accepted as a log', async () => {
  const rosMessages = createForEachStep((i) => createTfMessage(i, transformMessageOf(timeOf(i), 'odom', 'base_link', 1, 2, 0), transformMessageOf(timeOf(i), 'map', 'robot', i / 50, 0, 0)));
  assert.equal(await catchRefusalSentence(readLogsOf(rosMessages, ODOM_TO_BASE_CHOICE)), 'run.mcap, topic /tf: the transform odom → base_link never changes, so it is not the path of a robot; expected are frames that move, such as map → robot.');
  const constantMessages = createForEachStep((i) => createTfMessage(i, transformMessageOf(timeOf(i), 'odom', 'base_link', 1, 2, 0)));
  assert.match(await catchRefusalSentence(readLogsOf(constantMessages, ODOM_TO_BASE_CHOICE)), /never changes, so it is not the path of a robot; expected are frames that move\.$/);
});

test('a constant transform that is published more often than the changing transform adds no rows', async () => {
  const rosMessages = createForEachStep((i) => [createTfMessage(i, createMovingTransform(i)), ...[0.3, 0.6].map((timeOffset) => createTfMessage(i + timeOffset, transformMessageOf(timeOf(i + timeOffset), 'base_footprint', 'base_link', 0.5, 0, 0)))]).flat();
  const [{ motionData }] = await readLogsOf(rosMessages, ODOM_TO_BASE_CHOICE);
  assert.deepEqual([...motionData.t].map((t) => Math.round(20 * t)), [...Array(stepCount).keys()]);
  assert.deepEqual([...(motionData as Poses).x], createForEachStep((i) => i / 50 + 0.5));
});

test('a topic with messages of two types is refused', async () => {
  const rosMessages: Message[] = createForEachStep((i) => {
    const rosMessage = { topic: '/odom', type: 'nav_msgs/msg/Odometry', t: timeOf(i), message: odometryMessageOf(timeOf(i), i / 50, 0, 0) };
    return i % 2 ? { ...rosMessage, schema: 'geometry_msgs/msg/PoseStamped' } : rosMessage;
  });
  assert.match(await catchRefusalSentence(readLogsOf(rosMessages, { seriesName: '/odom' })), /^run\.mcap, topic \/odom: its type is “nav_msgs\/msg\/Odometry, geometry_msgs\/msg\/PoseStamped”;/);
});
