/**
 * Parsers of www/ as functions of bytes. Each returns true if it accepts the bytes and false if it refuses them with a proper
 * sentence. An exception of another kind is a failure.
 */

import assert from 'node:assert/strict';
import { Buffer } from 'node:buffer';
import { readFileSync } from 'node:fs';
import { deflateRawSync, gunzipSync } from 'node:zlib';
import { load } from '../../dist/core.js';
import { toPascalCase } from '../../scripts/declarations.mjs';
import { selectAttributes, propertiesOf } from '../../www/figure/definition.ts';
import { packJson, unpackJson } from '../../www/data/packing.ts';
import { settings } from '../../build/settings.js';
import { LogError } from '../../www/logs/log.ts';
import { openRecordings } from '../../www/logs/open.ts';
import { applyMap, gridOf, mapDataOf } from '../../www/widgets/map-squeeze/maps/data.ts';
import { odometryMessageOf, poseOf, recordingOf, stampOf, transformMessageOf, twistOf } from '../mcap.js';
import { readLog } from '../node/log-support.js';
import { createFile, catchRefusalMessage } from '../node/map-support.js';

/**
 * @typedef {object} Target
 * @property {Uint8Array[]} corpus inputs, most of them valid
 * @property {(bytes: Buffer<ArrayBuffer>) => Promise<boolean>} run
 */

const core = await load();

/** Calibrator with a log of one second, which it calibrates again after each change. */
const calibrator = new core.AlphaCalibrator();
const logOfOneSecond = { t: [0, 0.5, 1], x: [0, 0.5, 1], y: [0, 0, 0], theta: [0, 0, 0] };
calibrator.setLog(logOfOneSecond, logOfOneSecond);

const mapSqueeze = new core.MapSqueeze({ samples: 1 });

/**
 * Simulations of the elements, with their attributes and opening settings.
 *
 * @type {{ attributes: ReturnType<typeof selectAttributes>, simulation: any, opening: any }[]}
 */
const widgetTestCases = Object.entries(settings).map(([widgetTag, declaredSettings]) => {
  const hasSamples = declaredSettings.some(({ key }) => key === 'samples');
  const simulation = { 'map-squeeze': mapSqueeze, 'alpha-calibrator': calibrator }[widgetTag] ?? new (/** @type {any} */ (core)[toPascalCase(widgetTag)])(hasSamples ? { samples: 1 } : {});
  return { attributes: selectAttributes(propertiesOf(declaredSettings)), simulation, opening: simulation.config };
});

/** Maximum length of the message of a refusal, in which long quotations are shortened. */
const MAX_MESSAGE_LENGTH = 700;

/** Pattern of the message of a refusal. The message says which values are allowed, or what to do. */
const REFUSAL_PATTERN = /; (allowed|expected) (is|are) |; (add|choose|convert|copy|decompress|export|give|keep|name|open|split|state|unzip|write) /;

/** Asserts that the message of a refusal is proper. @param {string} refusalMessage */
function assertProperMessage(refusalMessage) {
  assert.match(refusalMessage, REFUSAL_PATTERN);
  assert.ok(refusalMessage.length <= MAX_MESSAGE_LENGTH, `${refusalMessage.length} characters: ${refusalMessage}`);
}

/** Returns true if the files are accepted as a map. @param {File[]} mapFiles */
async function areFilesAccepted(...mapFiles) {
  const refusalMessage = await catchRefusalMessage(mapFiles);
  if (refusalMessage === '') return true;
  assert.ok(refusalMessage.startsWith(mapFiles[0].name.replace(/\..*/, '')), refusalMessage);
  assertProperMessage(refusalMessage);
  return false;
}

/** Returns true if a call of the core succeeds. If the core refuses the call, checks the message. @param {() => void} callCore */
function isAccepted(callCore) {
  try {
    callCore();
    return true;
  } catch (error) {
    if (!(error instanceof RangeError || error instanceof TypeError)) throw error;
    assertProperMessage(error.message);
    return false;
  }
}

/** Returns true if a log is read. The log must have finite numbers and rising times. @param {() => ReturnType<typeof readLog>} readRecordingLog */
async function isLogRead(readRecordingLog) {
  let loadedLog;
  try {
    loadedLog = await readRecordingLog();
  } catch (error) {
    if (!(error instanceof LogError)) throw error;
    assert.ok(error.message.startsWith('run.'), error.message);
    assertProperMessage(error.message);
    return false;
  }
  const { t, breaks, ...columns } = loadedLog.motionData;
  assert.ok(t.length > 1 && t.every((rowTime, i) => Number.isFinite(rowTime) && rowTime > (t[i - 1] ?? -1)));
  for (const logColumn of Object.values(columns)) assert.ok(logColumn.length === t.length && logColumn.every(Number.isFinite));
  const { rows, dropped } = loadedLog.logSummary;
  assert.equal(Object.values(dropped).reduce((rowSum, { count }) => rowSum + count, t.length), rows);
  assert.ok(breaks.every((breakRow, i) => breakRow > (breaks[i - 1] ?? 0) && breakRow < t.length));
  return true;
}

/** Returns recordings of four topics in several forms, with or without compression, index and chunks. */
async function createRecordings() {
  const messages = Array.from({ length: 2 }, (_, i) => {
    const [t, rosStamp] = [1 + i / 8, stampOf(1 + i / 8)];
    const TF = 'tf2_msgs/msg/TFMessage';
    return [
      { topic: '/odom', type: 'nav_msgs/msg/Odometry', t, message: odometryMessageOf(t, i, 0, 0) },
      { topic: '/pose', type: 'geometry_msgs/msg/PoseStamped', t, message: { header: { stamp: rosStamp, frame_id: 'map' }, pose: poseOf(i, 0, 0) } },
      { topic: '/cmd_vel', type: 'geometry_msgs/msg/TwistStamped', t, message: { header: { stamp: rosStamp, frame_id: '' }, twist: twistOf(1, 0) } },
      { topic: '/tf', type: TF, t, message: { transforms: [transformMessageOf(t, 'map', 'odom', i, 0, 0), transformMessageOf(t, 'odom', 'base', i, 0, 0)] } },
    ];
  }).flat();
  const recordingOptions = /** @type {const} */ ([{ chunkSize: 4096 }, { compression: 'zstd' }, { compression: 'lz4' }, { hasIndex: false }, { hasIndex: false, hasChunks: true, compression: 'lz4' }]);
  return Promise.all(recordingOptions.map(async (recordingForm) => clearChecksums(await recordingOf(messages, { chunkSize: 1024, ...recordingForm }))));
}

/** Clears the checksums of a recording. Otherwise readers would refuse every changed chunk. @param {Buffer<ArrayBuffer>} recordingBytes */
function clearChecksums(recordingBytes) {
  const [CHUNK_CODE, FOOTER_CODE] = [6, 2];
  for (let i = 8; i + 9 < recordingBytes.length; i += 9 + Number(recordingBytes.readBigUInt64LE(i + 1))) {
    // The checksum of an MCAP chunk follows two timestamps and a size. The checksum of the footer follows two file positions.
    const checksumOffset = { [CHUNK_CODE]: 24, [FOOTER_CODE]: 16 }[recordingBytes[i]];
    if (checksumOffset) recordingBytes.writeUInt32LE(0, i + 9 + checksumOffset);
  }
  return recordingBytes;
}

/** Reads recordings that other libraries wrote. @param {string[]} fixtureNames */
function readFixtures(...fixtureNames) {
  const compressedFiles = JSON.parse(readFileSync(new URL('../reference/logs/recordings.json', import.meta.url), 'utf8'));
  return fixtureNames.map((fixtureName) => gunzipSync(Buffer.from(compressedFiles[fixtureName], 'base64')));
}

/** Topics and frames that the targets read from a recording. */
const TOPIC_CHOICES = [{ seriesName: '/odom' }, { seriesName: '/pose' }, { seriesName: '/cmd_vel' }, { seriesName: '/tf', framePair: { parent: 'map', child: 'base' } }];

/** Options of the fastest deflation. */
const FASTEST_DEFLATE = { level: 0, memLevel: 1 };

const bytesOfTexts = (/** @type {string[]} */ ...encodedTexts) => encodedTexts.map((encodedText) => Buffer.from(encodedText));

const MAP_YAMLS = bytesOfTexts(
  'image: map.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n',
  '# by hand\nimage: "maps/map.pgm"\nresolution: 5e-2\norigin:\n  - 1\n  - -2.5\n  - 1.57\nmode: scale\nnegate: false\n',
  '{image: map.pgm, resolution: .1, origin: [0, 0, 0], mode: raw, negate: true}',
  "? image\n: 'map.pgm'\nresolution: !!float 0.1\norigin: &o [0, 0, 0]\n",
);

const FLOOR_PLANS = bytesOfTexts(
  '{"bounds": [0, 0, 6, 4], "walls": [[0, 0, 6, 0], [6, 0, 6, 4], [3, 0, 3, 1.5]]}',
  '{\n  "bounds": [-1e2, -3, 6, 4],\n  "walls": []\n}',
);

/** @type {Record<string, Target>} */
export const fuzzTargets = {
  yaml: { corpus: MAP_YAMLS, run: (yamlBytes) => areFilesAccepted(createFile('map.yaml', yamlBytes), createFile('map.pgm', 'P5 2 1 255\nab')) },
  plan: { corpus: FLOOR_PLANS, run: (bytes) => areFilesAccepted(createFile('map.json', bytes)) },
  csv: {
    corpus: bytesOfTexts(
      't,x,y,yaw\n0.5,1,2,3\n0.75,1,2,-3\n1,nan,2,3\n1.25,1,2,3\n',
      '# by hand\nstamp_ns;v;omega\n1700000000000000001;0.5;-1e-1\n1700000000100000001;.5;+0.1',
      '"time [ms]"\t"x"\t"y"\t"heading_deg"\r\n0\t1\t2\t90\r\n50\t1\t2\t91\r\n',
      '# timestamp tx ty tz qx qy qz qw\n1305031098.6659 1.25 -0.5 9 0 0 0 1\n1305031098.6759 1.5 -0.5 9 0 0 0.6 0.8\n',
      '0 0 0 0 0 0 0 1\n\t1  2 3 4 0 0 1 0\n2 0 0 0 0 0 0 0\n',
      'sep=;\r\nTime;x_mm_;y_mm_;Gierwinkel [\u00b0]\r\n2024-06-10 06:13:20,5;0,5;1,5E+2;90\r\n10.06.2024 06:13:21;1;2;91\r\n',
      'Format Version,1.23,Rotation Type,Quaternion,Length Units,Millimeters\n\n,Type,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body\n,Name,A,A,A,A,A,A,A\n,,Rotation,Rotation,Rotation,Rotation,Position,Position,Position\nFrame,Time (Seconds),X,Y,Z,W,X,Y,Z\n0,0,0,0,0,1,1,2,3\n1,0.1,0,0.6,0,0.8,2,2,3\n',
      'ODOM 1 2 3 0.5 0.1 0 7 host 8\nODOM 1 2 3 0.5 0.1 0 8 host 8\nFLASER 2 1 1 1 2 3 1 2 3 7 host 8\n',
      'header.stamp.sec,header.stamp.nanosec,pose.pose.position.x,pose.pose.position.y,pose.pose.orientation.z,pose.pose.orientation.w\n7,5,1,2,0,1\n7,9,1,2,1,0\n',
    ),
    run: (bytes) => isLogRead(() => readLog(new File([bytes], 'run.csv'), { logKind: bytes[0] % 8 === 1 ? 'commands' : undefined })),
  },
  ...Object.fromEntries([['mcap', await createRecordings()], ['rosbag', readFixtures('small.bag')], ['sqlite', readFixtures('small.db3')]].map(([name, corpus]) => [name, {
    corpus,
    async run(/** @type {Buffer<ArrayBuffer>} */ bytes) {
      const recordingFile = new File([bytes], 'run.mcap');
      const { length } = TOPIC_CHOICES;
      const byteSum = bytes.reduce((sum, inputByte) => sum + inputByte, 0);
      const isRead = await isLogRead(() => readLog(recordingFile, TOPIC_CHOICES[byteSum % length]));
      // For one input in four, the list of topics is read too.
      if (Math.floor(byteSum / length) % 4) return isRead;
      try {
        for (const { seriesName, messageCount } of (await openRecordings([recordingFile]))[0].seriesList) assert.ok(typeof seriesName === 'string' && messageCount >= 0);
      } catch (error) {
        if (!(error instanceof LogError)) throw error;
        assertProperMessage(error.message);
      }
      return isRead;
    },
  }])),
  link: {
    corpus: [...bytesOfTexts(...(await Promise.all(createStates().map(packJson)))), ...bytesOfTexts(...createStates().map((linkState) => JSON.stringify(linkState)))],
    async run(bytes) {
      const packedText = bytes.length % 2 ? deflateRawSync(bytes, FASTEST_DEFLATE).toString('base64url') : bytes.toString('latin1');
      try {
        await unpackJson(packedText);
        return true;
      } catch (error) {
        assert.ok(error instanceof RangeError);
        assertProperMessage(error.message);
        return false;
      }
    },
  },
  state: {
    corpus: createStates().map((state) => Buffer.from(JSON.stringify(state))),
    async run(bytes) {
      let parsedState;
      try {
        parsedState = JSON.parse(bytes.toString());
      } catch {
        return false;
      }
      const { map = null, ...fields } = Object(parsedState);
      // The core does not know the field `map`, which the element itself checks.
      delete fields.widget;
      const mapBefore = currentMapOf(mapSqueeze, '');
      const isMapAccepted = map === null || isAccepted(() => applyMap(mapSqueeze, map));
      if (!isMapAccepted) assert.deepEqual(currentMapOf(mapSqueeze, ''), mapBefore);
      const isConfigured = isAccepted(() => mapSqueeze.configure(fields));
      mapSqueeze.configure(widgetTestCases[1].opening);
      return isMapAccepted && isConfigured;
    },
  },
  attributes: {
    corpus: bytesOfTexts('v=1', 'omega=-0.5', 'alpha1=1e-3', 'conditioned=false', 'conditioned=', 'sampler=whole-arc', 'samples=10', 'seed=7', 'x=2.05', 'noise=0.12', 'model=odometry', 'alpha6=0', 'nextY=-0.5', 'rule=nav2', 'phase=1.5', 'steps=40', 'per=path', 'map=density', 'startTheta=1'),
    async run(bytes) {
      const [attributeName, ...valueParts] = bytes.toString().split('=');
      const { attributes, simulation, opening } = widgetTestCases[bytes.length % widgetTestCases.length];
      const inputAttribute = Object.hasOwn(attributes, attributeName) ? attributes[attributeName] : Object.values(attributes)[bytes.length % 9];
      // Millions of samples would take too much memory.
      if (/^(samples|steps)$/.test(attributeName) && Number(valueParts.join('=')) > 1e5) return false;
      if (!isAccepted(() => simulation.configure(inputAttribute.changesFor(inputAttribute.converter.fromAttribute(valueParts.join('=')), simulation.config)))) return false;
      assert.equal(typeof inputAttribute.converter.toAttribute(inputAttribute.getValue(simulation.config)), 'string');
      simulation.configure(opening);
      return true;
    },
  },
};

/** Returns the map of a simulation as links contain it. @param {InstanceType<typeof core.MapSqueeze>} simulation @param {string} name */
function currentMapOf(simulation, name) {
  return mapDataOf(simulation, name, gridOf(simulation));
}

/** Returns states of Map Squeeze as links contain them. */
function createStates() {
  const simulation = new core.MapSqueeze({ samples: 1 });
  const { config } = simulation;
  const planMap = { name: 'room.json', bounds: [0, 0, 3, 3], walls: [[0, 0, 3, 3]] };
  simulation.setGrid({ resolution: 0.5, origin: [0, 0, 0.5] }, Buffer.from('P5 3 2 255\n\0\xff\x80\0\xff\xff', 'latin1'));
  const gridMap = currentMapOf(simulation, 'map.yaml');
  simulation.free();
  return [{ ...config, map: null }, { ...config, map: planMap }, { widget: 'map-squeeze', samples: 1, map: gridMap }];
}
