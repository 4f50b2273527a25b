// Map files: contents and sizes that are read, and messages about files that are refused.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { crc32 } from 'node:zlib';
import { limits } from '../../build/settings.js';
import { createMapYamlFile, createFile, createSimulationWithMap, catchRefusalMessage } from './map-support.js';

const PGM_FILE = createFile('map.pgm', 'P5 2 1 255\n\x00\x7f');
/** PNG image of the same two pixels as the PGM image. */
const PNG_BYTES = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR4nGNgqAcAAIIAgCASGTYAAAAASUVORK5CYII=', 'base64');

/** Time limit of a refusal in ms. It is a thousand times the usual time. */
const MAX_REFUSAL_MS = 1000;

/** Expects that a map description is refused at once, for a given reason. @param {string} yamlText @param {string} expectedReason */
async function assertRefusedAtOnce(yamlText, expectedReason) {
  const startTime = performance.now();
  const refusalMessage = await catchRefusalMessage([createFile('map.yaml', yamlText), PGM_FILE]);
  const durationMs = performance.now() - startTime;
  assert.match(refusalMessage, new RegExp(`^map\\.yaml, line \\d+: (${expectedReason}); expected is one field a line, as in resolution: 0\\.05\\.$`));
  assert.ok(durationMs < MAX_REFUSAL_MS, `${yamlText.slice(0, 40)} took ${durationMs} ms`);
}

test('a YAML description that repeats or contains itself is refused at once', async () => {
  const aliasError = 'aliases exceeded maxAliases \\(0\\)';
  await assertRefusedAtOnce('image: &a [*a]', aliasError);
  await assertRefusedAtOnce('image: &a map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nmode: *a', aliasError);
  for (const [nestingLevels, listLength] of [[9, 9], [7, 5], [30, 2]]) {
    const yamlAliasLines = Array.from({ length: nestingLevels }, (_, i) => `k${i}: &a${i} [${Array(listLength).fill(i ? `*a${i - 1}` : 'x').join(', ')}]`);
    await assertRefusedAtOnce(`${yamlAliasLines.join('\n')}\nimage: *a${nestingLevels - 1}`, aliasError);
  }
});

test('YAML features other than fields and values are refused at once', async () => {
  await assertRefusedAtOnce(`a: ${'['.repeat(1e4)}${']'.repeat(1e4)}`, 'nesting exceeded maxDepth \\(100\\)');
  await assertRefusedAtOnce('? '.repeat(3e4), 'nesting exceeded maxDepth \\(100\\)');
  await assertRefusedAtOnce('image: map.pgm\nimage: other.pgm', 'duplicated mapping key');
  await assertRefusedAtOnce('image: !!js/function x', 'unknown scalar tag .+');
  await assertRefusedAtOnce(`image: !${'x'.repeat(9e4)} y`, 'unknown scalar tag .{81}…');
  await assertRefusedAtOnce('image: map.pgm\n---\nimage: map.pgm', 'expected a single document in the stream, but found more');
  await assertRefusedAtOnce('image: *a', 'unidentified alias "a"|aliases exceeded maxAliases \\(0\\)');
  // Unknown keys are ignored, even if they are long or are names of properties that every object has.
  for (const ignoredKey of ['x'.repeat(9e4), '__proto__', 'constructor', 'toString', '<<']) {
    const { grid } = await createSimulationWithMap(createMapYamlFile({ image: 'map.pgm', [ignoredKey]: '{resolution: 9, image: [1]}' }), PGM_FILE);
    assert.deepEqual([grid?.columns, grid?.rows, grid?.resolution], [2, 1, 0.05]);
  }
  assert.equal(Reflect.get({}, 'resolution'), undefined);
});

test('files that are not exactly one map, and a plan that is not JSON, are refused with a message that states what is expected', async () => {
  const yamlFile = createMapYamlFile({ image: 'map.pgm' });
  const planFile = createFile('plan.json', '{"bounds": [0, 0, 1, 1], "walls": []}');
  for (const fileSelection of [[yamlFile, PGM_FILE, planFile], [PGM_FILE], [yamlFile, PGM_FILE, createFile('notes.txt', '')]]) {
    const fileNames = fileSelection.map(({ name: fileName }) => fileName).join(', ');
    assert.equal(await catchRefusalMessage(fileSelection), `${fileNames}: expected is one .json floor plan, or one .yaml file together with its .pgm or .png image.`);
  }
  assert.match(await catchRefusalMessage([createFile('plan.json', '{"bounds": [0, 0, 1, 1], "walls": [],}')]), /^plan\.json: .+; expected is \{"bounds"/);
});

test('a YAML map description is read as leniently as map_server reads it', async () => {
  const expectedSimulation = await createSimulationWithMap(createMapYamlFile({ image: 'map.pgm', origin: '[-1, 2, 0]', mode: 'trinary', negate: 1 }), PGM_FILE);
  for (const yamlText of [
    'image: map.pgm\r\nresolution: "0.05"\r\norigin: ["-1.0", \'2\', 0]\r\nnegate: "1"\r\nmode: Trinary\r\n',
    'image:\tmap.pgm\nresolution:\t0.05\t\norigin:\t[-1,\t2,\t0]\n\tnegate: Yes\nmode:\tTRINARY\n',
  ]) assert.deepEqual((await createSimulationWithMap(createFile('map.yaml', yamlText), PGM_FILE)).grid, expectedSimulation.grid, yamlText);
});

test('a PNG image may have any extension', async () => {
  const [pgmMap, pngMap] = await Promise.all([PGM_FILE, createFile('map.pgm', PNG_BYTES)].map((image) => createSimulationWithMap(createMapYamlFile({ image: 'map.pgm' }), image)));
  assert.deepEqual(pngMap.grid, pgmMap.grid);
});

test('invalid values of any type and length are refused with a readable message', async () => {
  const longText = 'x'.repeat(9e4);
  for (const yamlValue of [`"${longText}"`, `[${'[1], '.repeat(1e4)}]`, '{a: {b: [c]}}', 'null', 'true', '.nan', '1e999', '""']) {
    for (const fieldName of ['image', 'resolution', 'origin', 'negate', 'mode', 'occupied_thresh', 'free_thresh']) {
      const refusalMessage = await catchRefusalMessage([createMapYamlFile({ image: 'map.pgm', [fieldName]: yamlValue }), PGM_FILE]);
      const isAccepted = fieldName === 'negate' && yamlValue === 'true';
      assert.match(refusalMessage, isAccepted ? /^$/ : new RegExp(`^map\\.yaml: ${fieldName}(\\[0\\])? .+; (allowed|expected) (is|are) .+\\.$`), `${fieldName}: ${yamlValue.slice(0, 30)}`);
      assert.ok(refusalMessage.length < 400, `${fieldName}: ${yamlValue.slice(0, 30)}: ${refusalMessage.length} characters`);
    }
  }
});

test('the size of a file is checked before the file is read', async () => {
  for (const [fileName, maxBytes] of /** @type {[string, number][]} */ ([['plan.json', 2_000_000], ['map.yaml', 100_000], ['map.pgm', limits.bytes]])) {
    const largeFile = createFile(fileName, '');
    Object.defineProperty(largeFile, 'size', { value: maxBytes + 1 });
    largeFile.arrayBuffer = () => assert.fail(`${fileName} is read.`);
    const mapFiles = fileName === 'map.pgm' ? [createMapYamlFile({ image: fileName }), largeFile] : [largeFile];
    assert.equal(await catchRefusalMessage(mapFiles), `${fileName}: the file has ${maxBytes + 1} bytes; expected are at most ${maxBytes}.`);
  }
});

test('a damaged or too large PNG image is refused with an error message', async () => {
  const refusalMessage = await catchRefusalMessage([createMapYamlFile(), createFile('map.png', PNG_BYTES.subarray(0, 50))]);
  assert.match(refusalMessage, /^map\.png: the PNG image is damaged or cut short before byte \d+ of 50; allowed is a complete one\.$/);
  const largeImage = Buffer.from(PNG_BYTES);
  largeImage.fill(Buffer.of(0, 1, 0x86, 0xa0), 16, 24);
  // The checksum of the PNG header follows its type and its data.
  largeImage.writeUInt32BE(crc32(largeImage.subarray(12, 29)), 29);
  assert.equal(await catchRefusalMessage([createMapYamlFile(), createFile('map.png', largeImage)]), 'map.png: image has 100000 × 100000 pixels; allowed are at most 33554432.');
});
