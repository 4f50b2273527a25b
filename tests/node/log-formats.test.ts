// One drive in all formats of recordings, as their own libraries wrote it (tests/reference/logs/generate.py), and one input for each silent error.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { gunzipSync } from 'node:zlib';
import { log as german } from '../../www/logs/de.ts';
import { log as english } from '../../www/logs/en.ts';
import { LogError } from '../../www/logs/log-error.ts';
import type { Choice, Log, Recording, Source } from '../../www/logs/log.ts';
import { openRecordings } from '../../www/logs/open.ts';
import { summarize } from '../../www/logs/summary.ts';
import { odometry, poseOf, recordingOf, stampOf, transform, type Message } from '../mcap.js';

/** Compressed files by name. */
const FILES: Record<string, string> = JSON.parse(readFileSync(new URL('../reference/logs/recordings.json', import.meta.url), 'utf8'));

const bytesOf = (name: string) => gunzipSync(Buffer.from(FILES[name], 'base64'));

const fileOf = (bytes: Uint8Array | string, name: string, path?: string): Source => Object.assign(new File([bytes as BlobPart], name), path ? { path } : {});

/** Files of a rosbag2 folder, whose names it prefixes. */
const folderOf = (name: string): Source[] =>
  Object.keys(FILES).filter((file) => file.startsWith(`${name}-metadata`) || file.startsWith(`${name}-${name}.`)).map((file) => {
    const plain = file.slice(name.length + 1);
    return fileOf(bytesOf(file), plain, `${name}/${plain}`);
  });

async function open(...sources: Source[]): Promise<Recording> {
  const recordings = await openRecordings(sources);
  assert.equal(recordings.length, 1);
  return recordings[0];
}

const sentences = (log: Log) => summarize(log, english.found).join('. ');

async function refusalOf(reading: Promise<unknown>): Promise<string> {
  const error = await reading.then(() => undefined, (reason) => reason);
  assert.ok(error instanceof LogError, String(error));
  assert.notEqual(error.sentence(german), error.message);
  return error.message;
}

/** Odometry and reference of the drive, from its tables. */
const tables = (await openRecordings(['odometry.csv', 'reference.csv'].map((name) => fileOf(bytesOf(name), name)))).map((table) => table.read([{ series: '' }]));
const [[wheels], [truth]] = await Promise.all(tables);
const BOTH: Choice[] = [{ series: '/odom' }, { series: '/truth' }];

const bag = (name: string) => [fileOf(bytesOf(name), name)];

/** Metadata of a recording in two files. */
const SPLIT = 'rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths: [split0.mcap, split1.mcap]\n';
const split = (...parts: number[]) => [
  ...parts.map((part) => fileOf(bytesOf(`split${part}-split${part}.mcap`), `split${part}.mcap`, `drive/split${part}.mcap`)),
  fileOf(SPLIT, 'metadata.yaml', 'drive/metadata.yaml'),
];

const FORMS: Record<string, Source[]> = {
  'none.bag': bag('none.bag'), 'bz2.bag': bag('bz2.bag'), 'lz4.bag': bag('lz4.bag'),
  'none.mcap': bag('none.mcap'), 'lz4.mcap': bag('lz4.mcap'), 'zstd.mcap': bag('zstd.mcap'), 'unindexed.mcap': bag('unindexed.mcap'),
  'unchunked.mcap': bag('unchunked.mcap'), 'ros1-support.mcap': bag('ros1-support.mcap'), 'ros2-support.mcap': bag('ros2-support.mcap'),
  'a database alone': bag('sqlite-sqlite.db3'), 'a compressed database alone': bag('sqlite-file-sqlite-file.db3.zstd'),
  sqlite: folderOf('sqlite'), 'sqlite-messages': folderOf('sqlite-messages'), 'sqlite-file': folderOf('sqlite-file'),
  mcap: folderOf('mcap'), 'mcap-messages': folderOf('mcap-messages'), 'mcap-file': folderOf('mcap-file'),
  'split files': split(0, 1), 'split files in another order': split(1, 0),
};

for (const [name, sources] of Object.entries(FORMS)) {
  test(`${name} has the rows of the tables to the last bit`, async () => {
    const recording = await open(...sources);
    assert.deepEqual(recording.series.map(({ name: topic, kind, count }) => [topic, kind, count]), [['/odom', 'poses', 100], ['/truth', 'poses', 100]]);
    const logs = await recording.read(BOTH);
    for (const [i, table] of [wheels, truth].entries()) {
      assert.deepEqual([logs[i].start, logs[i].data], [table.start, table.data]);
      assert.deepEqual([logs[i].summary.dropped, logs[i].summary.notes, logs[i].summary.clock], [{}, [], 'header.stamp']);
    }
  });
}

for (const name of ['types.bag', 'types.mcap']) {
  test(`${name}: poses and commands of all types`, async () => {
    const recording = await open(fileOf(bytesOf(name), name));
    const { x, y, theta } = wheels.data as { x: Float64Array; y: Float64Array; theta: Float64Array };
    const expected = { x: x.slice(0, 40), y: y.slice(0, 40), theta: theta.slice(0, 40) };
    const frames = { parent: 'odom', child: 'base_link' };
    const logs = await recording.read([...['/fused', '/vicon', '/pose2d'].map((series) => ({ series })), { series: '/tf', frames }]);
    for (const { name: its, data } of logs) {
      assert.deepEqual([...(data as typeof expected).x], [...expected.x], its);
      // Pose2D has a heading, which was computed from the quaternion elsewhere.
      for (const [i, theta] of expected.theta.entries()) assert.ok(Math.abs((data as typeof expected).theta[i] - theta) <= (/pose2d/.test(its) ? 1e-15 : 0), its);
    }
    const [plain, stamped] = await recording.read([{ series: '/cmd_vel' }, { series: '/cmd_stamped' }]);
    assert.deepEqual(plain.data, stamped.data);
    assert.equal(plain.summary.clock, 'log time');
    // Joints only turn, and a base that is fixed to the moving frame is one too.
    const { frames: ends } = recording.series.find(({ name: its }) => its === '/tf') as Recording['series'][number];
    assert.deepEqual(ends?.map(({ parent, child }) => `${parent} → ${child}`), ['odom → base_link', 'odom → base_footprint']);
  });
}

test('what is missing or damaged is said, and the rest is read', async () => {
  const second = await open(...split(1));
  const [odometry] = await second.read(BOTH);
  assert.equal(odometry.data.t.length, 50);
  assert.match(sentences(odometry), /the files split0\.mcap of the recording are missing/);
  assert.match(await refusalOf(openRecordings(split())), /^drive\/metadata\.yaml: it describes a recording in split0\.mcap, split1\.mcap; give that file too/);
  assert.match(await refusalOf(openRecordings([fileOf(SPLIT, 'metadata.yaml', '')])), /^metadata\.yaml: it describes/);

  const readOf = async (bytes: Uint8Array, name: string) => (await open(fileOf(bytes, name))).read([{ series: '/odom' }]);
  for (const [name, share, rows] of [['lz4.bag', 0.8, 100], ['zstd.mcap', 0.4, 38], ['unchunked.mcap', 0.4, 40], ['sqlite-sqlite.db3', 0.8, 72]] as const) {
    const whole = bytesOf(name);
    const [log] = await readOf(whole.subarray(0, share * whole.length), name);
    assert.equal(log.data.t.length, rows, name);
    assert.match(sentences(log), /the file ends in the middle of a row or record/);
  }
  /** Reads a file in which some bytes are overwritten. */
  const damaged = (name: string, share: number) => {
    const bytes = bytesOf(name);
    const from = Math.floor(share * bytes.length);
    return readOf(bytes.fill(0xff, from, from + 40), name);
  };
  for (const [name, share, rows] of [['zstd.mcap', 0.1, 81], ['unindexed.mcap', 0.3, 81], ['sqlite-sqlite.db3', 0.5, 96]] as const) {
    const [log] = await damaged(name, share);
    assert.equal(log.data.t.length, rows, name);
    assert.match(sentences(log), /1 damaged block skipped \(.+\)/);
  }
  const [messages] = await damaged('mcap-messages-mcap-messages.mcap', 0.1);
  assert.deepEqual(messages.summary.dropped, { damaged: { count: 1, first: 3 } });
  for (const name of ['lz4.bag', 'bz2.bag', 'sqlite-file-sqlite-file.db3.zstd']) assert.match(await refusalOf(damaged(name, 0.5)), /none of its messages can be read \(.+\); expected/);
});

test('formats that are not read are refused with the cure, by their contents', async () => {
  for (const [start, sentence] of [
    ['#ROSBAG V1.2\n', 'a ROS bag of version 1.2; convert it with “rosbag reindex”.'],
    ['ULog\x01\x12\x35', 'a PX4 log (ULog); convert it with “ulog2csv”, and give two of the tables.'],
    ['PK\x03\x04', 'a zip archive; unzip it, and give the files in it.'],
    ['\x1f\x8b\x08', 'compressed by gzip; decompress it with “gunzip”, and give the result.'],
    ['\xd4\xc3\xb2\xa1', 'a network capture; expected is a recording of “ros2 bag record” or “rosbag record”.'],
  ]) assert.equal(await refusalOf(openRecordings([fileOf(Buffer.from(start, 'latin1'), 'run.mcap')])), `run.mcap: it is ${sentence}`);
  assert.match(await refusalOf(openRecordings([fileOf('SQLite format 3\0', 'run.db3')])), /without the tables “topics” and “messages” of rosbag2; expected/);
});

const TF = 'tf2_msgs/msg/TFMessage';
const at = (i: number) => 1_700_000_000 + i / 20;
const tf = (i: number, ...transforms: unknown[]): Message => ({ topic: '/tf', type: TF, t: at(i), message: { transforms } });
const count = 40;
const each = <T>(make: (i: number) => T): T[] => Array.from({ length: count }, (_, i) => make(i));
const read = async (messages: Message[], ...choices: Choice[]) => (await open(fileOf(await recordingOf(messages), 'run.mcap'))).read(choices);
const BASE = { series: '/tf', frames: { parent: 'odom', child: 'base_link' } };
const drive = (i: number) => transform(at(i), 'odom', 'base_footprint', i / 50, 0, 0);

test('a transform that never changes is no log', async () => {
  const messages = each((i) => tf(i, transform(at(i), 'odom', 'base_link', 1, 2, 0), transform(at(i), 'map', 'robot', i / 50, 0, 0)));
  assert.equal(await refusalOf(read(messages, BASE)), 'run.mcap, topic /tf: the transform odom → base_link never changes, so it is no path of a robot; expected are frames that move, as map → robot.');
});

test('a constant transform that is published more often than the moving one adds no rows', async () => {
  const messages = each((i) => [tf(i, drive(i)), ...[0.3, 0.6].map((part) => tf(i + part, transform(at(i + part), 'base_footprint', 'base_link', 0.5, 0, 0)))]).flat();
  const [{ data }] = await read(messages, BASE);
  assert.deepEqual([...data.t].map((t) => Math.round(20 * t)), [...Array(count).keys()]);
});

test('a static transform holds for what was recorded before it', async () => {
  const late: Message = { topic: '/tf_static', type: TF, t: at(count), message: { transforms: [transform(at(0), 'base_footprint', 'base_link', 0.5, 0, 0)] } };
  const [{ data }] = await read([...each((i) => tf(i, drive(i))), late], BASE);
  assert.deepEqual([...(data as { x: Float64Array }).x], each((i) => i / 50 + 0.5));
});

test('two nodes that publish a topic at the same time are refused; two types too', async () => {
  const nodes = await open(fileOf(bytesOf('nodes.bag'), 'nodes.bag'));
  assert.equal(await refusalOf(nodes.read(BOTH)), 'nodes.bag, topic /odom: several nodes publish it in turns (/base, /simulator); expected is one: rename the topic of one node, and record again.');
});

test('messages without a stamp among others are dropped, and the times of recording are used if most have none', async () => {
  const message = (i: number, stamp: number): Message => ({ topic: '/odom', type: 'nav_msgs/msg/Odometry', t: at(i) + 0.01, message: odometry(stamp, i / 50, 0, 0) });
  const [some] = await read(each((i) => message(i, i < 2 ? 0 : at(i))), { series: '/odom' });
  assert.deepEqual([some.summary.clock, some.data.t.length, some.summary.dropped.noStamp?.count], ['header.stamp', count - 2, 2]);
  const [most] = await read(each((i) => message(i, i < count - 2 ? 0 : at(i))), { series: '/odom' });
  assert.deepEqual([most.summary.clock, most.data.t.length], ['log time', count]);
});

test('one damaged message is skipped and counted', async () => {
  const messages: Message[] = each((i) => ({ topic: '/pose', type: 'geometry_msgs/msg/PoseStamped', t: at(i), message: { header: { stamp: stampOf(at(i)), frame_id: 'map' }, pose: poseOf(i === 7 ? 1e300 : i / 50, 0, 0) } }));
  const [{ data, summary }] = await read(messages, { series: '/pose' });
  assert.deepEqual([data.t.length, summary.dropped.damaged], [count - 1, { count: 1, first: 8 }]);
});
