// MCAP recordings of ROS 2: what is read of them in every form, in how much memory, and what is refused.

import assert from 'node:assert/strict';
import { closeSync, mkdtempSync, openSync, rmSync, statSync, writeSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { loadDecompressHandlers } from '@mcap/support';
import { onDisk } from '../../www/cli/disk.js';
import { log as german } from '../../www/widgets/alpha-calibrator/log/de.js';
import { MAX_CHUNK, decompressors } from '../../www/widgets/alpha-calibrator/log/decompress.js';
import { unlz4 } from '../../www/widgets/alpha-calibrator/log/lz4.js';
import { LogError, isRecording, logsOf, readLog, tell, together, topicsOf, usualTopics } from '../../www/widgets/alpha-calibrator/log/read.js';
import { log as english } from '../../www/widgets/alpha-calibrator/log/en.js';
import { lz4, odometry, poseOf, recordingOf, stampOf, transform, twistOf } from '../mcap.js';
import { generator } from '../random.js';

/** @import { Message } from '../mcap.js' */

const START = 1000;
const COUNT = 120;
const at = (/** @type {number} */ i) => START + i / 20;
const TF = 'tf2_msgs/msg/TFMessage';

/** @returns {Message[]} a drive along an arc, told in every way */
function drive() {
  /** @type {Message[]} */
  const messages = [];
  for (let i = 0; i < COUNT; i++) {
    // Recorded a little later than it was true.
    const [t, recorded] = [at(i), at(i) + 0.01];
    const [x, y, theta] = [i / 100, i / 200, i / 50];
    const add = (/** @type {string} */ topic, /** @type {string} */ type, /** @type {any} */ message) => messages.push({ topic, type, t: recorded, message });
    if (i === 0) add('/tf_static', TF, { transforms: [transform(t, '/base_footprint', 'base_link', 0.5, 0, 0)] });
    if (i % 5 === 0) add('/tf', TF, { transforms: [transform(t + 1, 'map', 'odom', 1, 2, Math.PI / 2)] });
    add('/tf', TF, { transforms: [transform(t, 'odom', 'base_footprint', x, y, theta), transform(t, 'base_link', 'wheel', 0, 0, 9 * theta)] });
    add('/odom', 'nav_msgs/msg/Odometry', odometry(t, x, y, theta));
    add('/mocap/pose', 'geometry_msgs/msg/PoseStamped', { header: { stamp: stampOf(t), frame_id: 'map' }, pose: poseOf(x, y, theta) });
    add('/fused', 'geometry_msgs/msg/PoseWithCovarianceStamped', { header: { stamp: stampOf(t), frame_id: 'map' }, pose: { pose: poseOf(y, x, -theta), covariance: new Float64Array(36) } });
    add('/cmd_vel', 'geometry_msgs/msg/Twist', twistOf(0.5, x));
    add('/cmd_stamped', 'geometry_msgs/msg/TwistStamped', { header: { stamp: stampOf(t), frame_id: '' }, twist: twistOf(0.25, y) });
    add('/chatter', 'std_msgs/msg/String', { data: 'hello '.repeat(20) });
  }
  return messages;
}

const file = (/** @type {Uint8Array<ArrayBuffer>} */ bytes, name = 'run.mcap') => new File([bytes], name);

/** @param {Promise<unknown>} reading */
async function sentenceOf(reading) {
  try {
    await reading;
  } catch (error) {
    assert.ok(error instanceof LogError, String(error));
    assert.match(error.sentence(german), /; erwartet (wird|werden) /);
    return error.message;
  }
  throw new assert.AssertionError({ message: 'nothing was refused' });
}

const close = (/** @type {ArrayLike<number>} */ is, /** @type {(i: number) => number} */ expected) => {
  for (let i = 0; i < is.length; i++) assert.ok(Math.abs(is[i] - expected(i)) < 1e-9, `${i}: ${is[i]}, not ${expected(i)}`);
};

/** @type {[string, Parameters<typeof recordingOf>[1]][]} */
const FORMS = [
  ['chunks and an index', {}],
  ['chunks by zstd', { compression: 'zstd' }],
  ['chunks by lz4', { compression: 'lz4' }],
  ['no index', { index: false, chunks: true, compression: 'zstd' }],
  ['neither index nor chunks', { index: false }],
  ['an index without chunks', { chunks: false }],
];

for (const [what, options] of FORMS) {
  test(`${what}: topics are listed, poses and commands are read`, async () => {
    const source = file(await recordingOf(drive(), options));
    assert.ok(await isRecording(source));
    const topics = await topicsOf(source);
    assert.deepEqual(
      topics.map(({ name, count, kind }) => [name, count, kind]),
      [
        ['/chatter', COUNT, null], ['/cmd_stamped', COUNT, 'commands'], ['/cmd_vel', COUNT, 'commands'], ['/fused', COUNT, 'poses'],
        ['/mocap/pose', COUNT, 'poses'], ['/odom', COUNT, 'poses'], ['/tf', COUNT + COUNT / 5, 'transforms'], ['/tf_static', 1, 'transforms'],
      ],
    );
    assert.equal(topics[5].type, 'nav_msgs/msg/Odometry');
    assert.deepEqual(usualTopics(topics), { odometry: '/odom', reference: '/mocap/pose' });
    assert.deepEqual(usualTopics(topics, 'commands'), { odometry: '/cmd_vel', reference: '/mocap/pose' });

    const read = async (/** @type {string} */ topic, /** @type {object} */ more = {}) => {
      const log = await readLog(source, { topic, ...more });
      assert.deepEqual([log.name, log.start, log.data.t.length, log.how.cutShort], [`run.mcap, ${topic}`, START, COUNT, false]);
      return /** @type {any} */ (log.data);
    };
    for (const topic of ['/odom', '/mocap/pose']) {
      const { t, x, y, theta } = await read(topic);
      close(t, (i) => i / 20);
      close(x, (i) => i / 100);
      close(y, (i) => i / 200);
      close(theta, (i) => i / 50);
    }
    const fused = await read('/fused');
    close(fused.x, (i) => i / 200);
    close(fused.theta, (i) => -i / 50);
    const { t, v, omega } = await read('/cmd_vel');
    // Without a stamp, the time is when it was recorded.
    close(t, (i) => i / 20 + 0.01);
    close(v, () => 0.5);
    close(omega, (i) => i / 100);
    const stamped = await read('/cmd_stamped');
    close(stamped.t, (i) => i / 20);
    close(stamped.omega, (i) => i / 200);
    // From the map over what drifts and what stands still; the base's link is half a metre ahead.
    const chained = await read('/tf', { frames: { parent: 'map', child: '/base_link' } });
    close(chained.t, (i) => i / 20);
    close(chained.x, (i) => 1 - i / 200 - 0.5 * Math.sin(i / 50));
    close(chained.y, (i) => 2 + i / 100 + 0.5 * Math.cos(i / 50));
    close(chained.theta, (i) => { const theta = i / 50 + Math.PI / 2; return theta > Math.PI ? theta - 2 * Math.PI : theta; });
    close((await read('/tf', { frames: { parent: 'odom', child: 'base_footprint' } })).x, (i) => i / 100);
  });
}

test('two logs of a recording that is gone through once are those that are read one after the other', async () => {
  const choices = [{ topic: '/odom' }, { topic: '/tf', frames: { parent: 'map', child: 'base_link' } }, { topic: '/cmd_vel' }];
  for (const [what, options] of FORMS) {
    const source = file(await recordingOf(drive(), options));
    const apart = [];
    for (const choice of choices) apart.push(await readLog(source, choice));
    assert.deepEqual(await logsOf(source, choices), apart, what);
  }
});

test('of what is wrong with two topics, that of the first is told, whichever is found first', async () => {
  const source = file(await recordingOf(drive()));
  // Found before the first message, with the first of the topic, and after the last.
  const wrong = [{ topic: '/od' }, { topic: '/chatter' }, { topic: '/tf' }];
  for (const one of wrong) {
    const expected = await sentenceOf(readLog(source, one));
    for (const other of [...wrong, { topic: '/odom' }]) assert.equal(await sentenceOf(logsOf(source, [one, other])), expected);
    assert.equal(await sentenceOf(logsOf(source, [{ topic: '/odom' }, one])), expected);
  }
});

test('of a recording every byte is read once for two logs, and not in small pieces', async () => {
  const long = Array.from({ length: 5000 }, (_, i) => [
    { topic: '/odom', type: 'nav_msgs/msg/Odometry', t: at(i), message: odometry(at(i), i / 100, 0, 0) },
    { topic: '/mocap/pose', type: 'geometry_msgs/msg/PoseStamped', t: at(i), message: { header: { stamp: stampOf(at(i)), frame_id: 'map' }, pose: poseOf(i / 100, 0, 0) } },
  ]).flat();
  for (const [what, options] of FORMS) {
    const bytes = await recordingOf(long, { ...options, chunkSize: 100_000 });
    let [read, pieces] = [0, 0];
    const source = {
      name: 'run.mcap',
      size: bytes.length,
      slice(/** @type {number} */ from, /** @type {number} */ to) {
        read += to - from;
        pieces += 1;
        return new Blob([bytes.subarray(from, to)]);
      },
    };
    await logsOf(source, [{ topic: '/odom' }, { topic: '/mocap/pose' }]);
    assert.ok(read < 1.05 * bytes.length + 10_000, `${what}: ${read} of ${bytes.length} bytes`);
    assert.ok(pieces < 12 + bytes.length / 2 ** 20, `${what}: ${pieces} pieces of ${bytes.length} bytes`);
  }
});

test('what is decompressed is what the libraries of MCAP make of it', async () => {
  const [own, theirs] = await Promise.all([decompressors({ file: '' }), loadDecompressHandlers()]);
  const { default: zstd } = await import('@foxglove/wasm-zstd');
  const random = generator(5);
  for (const length of [0, 1, 5, 12, 13, 100, 4096, 70_000, 300_000]) {
    for (const kinds of [1, 3, 256]) {
      const bytes = Uint8Array.from({ length }, () => Math.floor(kinds * random()));
      for (const [name, compressed] of /** @type {const} */ ([['lz4', lz4(bytes)], ['zstd', new Uint8Array(zstd.compress(Buffer.from(bytes)))]])) {
        const size = BigInt(length);
        assert.deepEqual(Buffer.from(own[name]?.(compressed, size) ?? []), Buffer.from(bytes), `${name} ${length} ${kinds}`);
        if (length) assert.deepEqual(Buffer.from(theirs[name]?.(compressed, size) ?? []), Buffer.from(bytes));
        // Of nothing, nothing is looked at.
        if (length > 1) assert.throws(() => own[name]?.(compressed, size - 1n));
        assert.throws(() => own[name]?.(compressed, size + 1n));
      }
    }
  }
});

test('a damaged frame of LZ4 is refused, whichever byte is another', () => {
  const bytes = Uint8Array.from({ length: 500 }, (_, i) => (i % 7 === 0 ? i : 3));
  const frame = lz4(bytes);
  for (let i = 0; i < frame.length; i++) {
    for (const value of [0, 1, 255, frame[i] ^ 16]) {
      const damaged = frame.slice();
      damaged[i] = value;
      try {
        assert.equal(unlz4(damaged, bytes.length).length, bytes.length);
      } catch (error) {
        assert.ok(error instanceof RangeError, String(error));
      }
    }
    assert.throws(() => unlz4(frame.subarray(0, i), bytes.length), RangeError);
  }
});

test('a recording that breaks off is read as far as it goes', async () => {
  for (const [, options] of FORMS) {
    const whole = await recordingOf(drive(), options);
    const log = await readLog(file(whole.subarray(0, Math.floor(0.4 * whole.length))), { topic: '/odom' });
    assert.ok(log.how.cutShort);
    const { length } = log.data.t;
    assert.ok(length > 0.1 * COUNT && length < 0.6 * COUNT, `${length}`);
    close(/** @type {any} */ (log.data).x, (i) => i / 100);
  }
});

test('a clock that begins at 0 has stamps, and messages without stamps the times at which they were recorded, which is said', async () => {
  const rows = async (/** @type {(i: number) => number} */ stamp) => {
    const messages = Array.from({ length: 100 }, (_, i) => {
      const message = odometry(stamp(i), i, 0, 0);
      return { topic: '/odom', type: 'nav_msgs/msg/Odometry', t: 1_700_000_000 + i / 20, message };
    });
    const log = await readLog(file(await recordingOf(messages)), { topic: '/odom' });
    return { ...log, told: tell(log, english.found).join(' ') };
  };
  const simulated = await rows((i) => i / 10);
  assert.deepEqual([simulated.start, simulated.found.rows, simulated.data.t[0], simulated.data.t[99]], [0, 100, 0, 9.9]);
  const unstamped = await rows(() => 0);
  assert.deepEqual([unstamped.start, unstamped.data.t.length, unstamped.data.t[20]], [1_700_000_000, 100, 1]);
  assert.match(unstamped.told, /times are those at which messages were recorded/);
  assert.doesNotMatch(simulated.told, /recorded/);
  // A stamp that was forgotten is one that goes back.
  const forgotten = await rows((i) => (i === 50 ? 0 : 5 + i / 10));
  assert.deepEqual([forgotten.data.t.length, forgotten.found.leftOut.falling.count], [99, 1]);
  assert.doesNotMatch(forgotten.told, /recorded/);
  // Of a recording it is the message that is named, for there are no lines.
  assert.match(await sentenceOf(rows((i) => 50 - i / 10)), /^run\.mcap, topic \/odom: 99 of 100 rows, that of message 2 first, go back in time;/);
});

test('one topic is no two logs, and what has no frames is not asked for some', async () => {
  const source = file(await recordingOf(drive()));
  const [one, other] = await logsOf(source, [{ topic: '/odom' }, { topic: '/odom' }]);
  assert.match(await sentenceOf((async () => together(one, other))()), /^run\.mcap, \/odom: it is both odometry and reference; expected are two logs of one drive\.$/);
  const [two, frames] = await logsOf(source, [{ topic: '/tf', frames: { parent: 'odom', child: 'base_footprint' } }, { topic: '/tf', frames: { parent: 'map', child: 'base_footprint' } }]);
  assert.ok(together(two, frames).reference.data.t.length > 1);
  assert.match(await sentenceOf(readLog(source, { topic: '/odom', frames: { parent: 'map', child: 'odom' } })), /^run\.mcap, topic \/odom: its type is “nav_msgs\/msg\/Odometry”; expected is tf2_msgs\/msg\/TFMessage/);
});

test('quaternions that are no rotation, numbers that are none and times that fall are left out', async () => {
  const messages = Array.from({ length: 20 }, (_, i) => {
    const t = i === 8 ? at(2) : at(i);
    const message = odometry(t, i === 5 ? NaN : i, 0, 0, i === 3 ? 0 : 1);
    return { topic: '/odom', type: 'nav_msgs/msg/Odometry', t: at(i), message };
  });
  const { data, found } = await readLog(file(await recordingOf(messages)), { topic: '/odom' });
  assert.deepEqual([.../** @type {any} */ (data).x], Array.from({ length: 20 }, (_, i) => i).filter((i) => ![3, 5, 8].includes(i)));
  const { noRotation, notFinite, falling } = found.leftOut;
  assert.deepEqual([noRotation.count, noRotation.line, notFinite.count, notFinite.line, falling.count, falling.line], [1, 4, 1, 6, 1, 9]);
  assert.deepEqual([...data.breaks], [3, 4]);
});

test('messages that were not written in the order of their times are read in it, inside of chunks and where chunks overlap', async () => {
  const random = generator(5);
  const messages = Array.from({ length: 200 }, (_, i) => ({ topic: '/odom', type: 'nav_msgs/msg/Odometry', t: at(i), message: odometry(at(i), i, 0, 0) }));
  const order = messages.map((message) => ({ message, key: random() })).sort((one, other) => one.key - other.key);
  const shuffled = order.map(({ message }) => message);
  // All in one chunk, or in dozens.
  for (const chunkSize of [1e6, 4096]) {
    const { data } = await readLog(file(await recordingOf(shuffled, { chunkSize })), { topic: '/odom' });
    assert.deepEqual([.../** @type {any} */ (data).x], Array.from({ length: 200 }, (_, i) => i));
  }
});

test('a chunk in which any byte is another is refused, or is what it was', async () => {
  const messages = Array.from({ length: 20 }, (_, i) => ({ topic: '/odom', type: 'nav_msgs/msg/Odometry', t: at(i), message: odometry(at(i), i, 0, 0) }));
  const random = generator(6);
  for (const compression of /** @type {const} */ (['none', 'zstd', 'lz4'])) {
    const whole = await recordingOf(messages, { chunkSize: 1e6, compression });
    const { data } = await readLog(file(whole), { topic: '/odom' });
    let refused = 0;
    for (let i = 0; i < 200; i++) {
      const bytes = whole.slice();
      bytes[40 + Math.floor(random() * (0.5 * whole.length - 40))] ^= 1 + Math.floor(random() * 255);
      try {
        assert.deepEqual((await readLog(file(bytes), { topic: '/odom' })).data, data);
      } catch (error) {
        assert.ok(error instanceof LogError, String(error));
        refused++;
      }
    }
    assert.ok(refused > 100, `${compression}: ${refused}`);
  }
});

test('a choice that is not there, or of no use: a sentence', async () => {
  const source = file(await recordingOf(drive()));
  const poses = 'nav_msgs/msg/Odometry, geometry_msgs/msg/PoseStamped, PoseWithCovarianceStamped or tf2_msgs/msg/TFMessage';
  const commands = 'geometry_msgs/msg/Twist or TwistStamped';
  for (const [choice, sentence] of /** @type {const} */ ([
    [{ topic: '/od' }, 'run.mcap, topic /od: there is no such topic; expected is one of /tf_static, /tf, /odom, /mocap/pose, /fused, /cmd_vel, /cmd_stamped, /chatter.'],
    [{ topic: '/chatter' }, `run.mcap, topic /chatter: its type is “std_msgs/msg/String”; expected is ${poses}, or ${commands}.`],
    [{ topic: '/cmd_vel', kind: 'poses' }, `run.mcap, topic /cmd_vel: its type is “geometry_msgs/msg/Twist”; expected is ${poses}.`],
    [{ topic: '/tf' }, 'run.mcap, topic /tf: which frames are meant is not told; expected are a parent and a child, connected by map to odom, odom to base_footprint, base_link to wheel.'],
    [{ topic: '/tf', frames: { parent: 'map', child: 'laser' } }, 'run.mcap, topic /tf: no transforms lead from map to laser; expected are frames that are connected, of base_footprint to base_link, map to odom, odom to base_footprint, base_link to wheel.'],
  ])) assert.equal(await sentenceOf(readLog(source, choice)), sentence);
});

test('what other recorders write: a sentence', async () => {
  const read = async (/** @type {Parameters<typeof recordingOf>[1]} */ options, messages = drive()) => sentenceOf(readLog(file(await recordingOf(messages, options)), { topic: '/odom' }));
  assert.equal(await read({ compression: 'odd' }), 'run.mcap: its chunks are compressed by “snappy”; expected is zstd, lz4 or none.');
  assert.equal(await read({ encoding: 'ros1' }), 'run.mcap, topic /odom: its messages are encoded as “ros1”; expected is cdr, that of ROS 2.');
  assert.equal(await read({}, []), 'run.mcap, topic /odom: there is no such topic; expected is one of none: it has no messages.');
  assert.equal(await read({}, drive().slice(0, 9)), 'run.mcap, topic /odom: 1 of 1 rows can be used; expected are at least 2.');
  // Another message under the name of odometry.
  const short = drive().map((message) => (message.topic === '/odom' ? { ...message, type: 'std_msgs/msg/String', message: { data: 'x' } } : message));
  const bytes = await recordingOf(short);
  const renamed = Buffer.from(bytes.toString('latin1').replaceAll('std_msgs/msg/String', 'nav_msgs/msg/Odometr'), 'latin1');
  assert.match(await sentenceOf(readLog(file(renamed), { topic: '/odom' })), /^run\.mcap.*; expected is /);
});

test('chunks that announce more than there is room for: a sentence, and no memory', async () => {
  const bytes = await recordingOf(drive(), { compression: 'zstd', index: false, chunks: true });
  // The record of the first chunk: its code, its length, two times, the size.
  const chunk = bytes.indexOf(Buffer.from('zstd')) - 4 - 4 - 8 - 16 - 9;
  assert.equal(bytes[chunk], 6);
  for (const [size, reason] of /** @type {const} */ ([
    [10n ** 12n, `a chunk of 1000000000000 bytes is announced; expected are at most ${MAX_CHUNK}.`],
    [BigInt(MAX_CHUNK), 'the recording is damaged (a compressed chunk is not what was written); expected is an undamaged MCAP file.'],
    [10n, 'the recording is damaged (a compressed chunk is not what was written); expected is an undamaged MCAP file.'],
  ])) {
    const bomb = Buffer.from(bytes);
    bomb.writeBigUInt64LE(size, chunk + 9 + 16);
    assert.equal(await sentenceOf(readLog(file(bomb), { topic: '/odom' })), `run.mcap: ${reason}`);
  }
  // A record of so many bytes that the file would never fill it.
  const long = Buffer.from(bytes);
  long.writeBigUInt64LE(2n ** 40n, chunk + 1);
  assert.match(await sentenceOf(readLog(file(long), { topic: '/odom' })), /there is no such topic/);
});

/**
 * A recording with something else in its index, and no checksum of it.
 *
 * @param {Buffer<ArrayBuffer>} bytes
 * @param {(record: Buffer<ArrayBuffer>, code: number) => void} change what a record holds, after its code and length
 */
function withIndex(bytes, change) {
  const changed = Buffer.from(bytes);
  const footer = changed.length - 8 - 20;
  changed.writeUInt32LE(0, footer + 16);
  for (let at = Number(changed.readBigUInt64LE(footer)); at < footer - 9; at += 9 + Number(changed.readBigUInt64LE(at + 1))) {
    change(changed.subarray(at + 9, at + 9 + Number(changed.readBigUInt64LE(at + 1))), changed[at]);
  }
  return changed;
}

/** Codes of records in an index. */
const [CHUNK_INDEX, STATISTICS] = [8, 11];

test('an index that is not to be trusted is not gone by', async () => {
  const bytes = await recordingOf(drive());
  const plain = await readLog(file(bytes), { topic: '/odom' });
  /** @type {[string, Parameters<typeof withIndex>[1]][]} */
  const changes = [
    ['chunks are missing', (record, code) => code === STATISTICS && record.writeUInt32LE(1, 22)],
    ['all at one time, and of a gigabyte', (record, code) => {
      if (code !== CHUNK_INDEX) return;
      record.writeBigUInt64LE(0n, 0);
      record.writeBigUInt64LE(2n ** 62n, 8);
      record.writeBigUInt64LE(2n ** 30n, record.length - 8);
    }],
    ['longer than the file', (record, code) => code === CHUNK_INDEX && record.writeBigUInt64LE(BigInt(bytes.length), 24)],
    ['that ends where it begins', (record, code) => code === CHUNK_INDEX && record.fill(255)],
  ];
  for (const [what, change] of changes) {
    const changed = withIndex(bytes, change);
    assert.ok(!changed.equals(bytes), what);
    const log = await readLog(file(changed), { topic: '/odom' });
    assert.deepEqual([log.data, log.found], [plain.data, plain.found], what);
  }
  // Where all of it holds together, and yet chunks are not where it says: a sentence.
  const astray = withIndex(bytes, (record, code) => code === CHUNK_INDEX && record.writeBigUInt64LE(20n, 16));
  assert.match(await sentenceOf(readLog(file(astray), { topic: '/odom' })), /^run\.mcap: the recording is damaged \(.*\); expected is an undamaged MCAP file\.$/);
});

/** Bytes of a file that are larger than what may be held of it. */
const LARGE = 400 * 2 ** 20;

for (const index of [true, false]) {
  test(`a recording of ${LARGE} bytes ${index ? 'by its index' : 'without one'} needs less than a third of it`, { timeout: 120_000 }, async () => {
    const folder = mkdtempSync(join(tmpdir(), 'motion-log-'));
    const path = join(folder, 'large.mcap');
    try {
      const output = openSync(path, 'w');
      const picture = { data: 'x'.repeat(2 ** 20) };
      /** @returns {Generator<Message>} */
      function* messages() {
        for (let i = 0; i < LARGE / 2 ** 20; i++) {
          yield { topic: '/odom', type: 'nav_msgs/msg/Odometry', t: at(i), message: odometry(at(i), i / 100, 0, 0) };
          yield { topic: '/camera', type: 'std_msgs/msg/String', t: at(i), message: picture };
        }
      }
      await recordingOf(messages(), { index, chunks: true, chunkSize: 2 ** 21, write: (bytes) => writeSync(output, bytes) });
      closeSync(output);
      assert.ok(statSync(path).size > LARGE);
      const source = await onDisk(path);
      const before = process.memoryUsage().rss;
      let most = before;
      const watch = setInterval(() => (most = Math.max(most, process.memoryUsage().rss)), 5);
      const log = await readLog(source, { topic: '/odom' });
      clearInterval(watch);
      await source.close();
      assert.equal(log.data.t.length, LARGE / 2 ** 20);
      console.log(`${((most - before) / 2 ** 20).toFixed(0)} MB`);
      assert.ok(most - before < LARGE / 3, `${most - before} bytes`);
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  });
}
