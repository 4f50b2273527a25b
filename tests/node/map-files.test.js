// Contents and sizes of map files that are read, and sentences about those that are not.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { limits } from '../../www/settings.js';
import { SIGNATURE, header, pngOf } from '../png.js';
import { description, file, opened, refusalOf } from './map-support.js';

const PGM = file('map.pgm', 'P5 2 1 255\n\x00\x7f');

/** Time limit of a refusal in milliseconds: a thousand times the usual time, and about the patience of a reader. */
const INSTANT = 1000;

/** Expects that a description is refused at once, for a reason. @param {string} yaml @param {string} reason */
async function refused(yaml, reason) {
  const start = performance.now();
  const sentence = await refusalOf([file('map.yaml', yaml), PGM]);
  const took = performance.now() - start;
  assert.match(sentence, new RegExp(`^map\\.yaml(, line \\d+)?: this is not YAML \\(${reason}\\); expected is one field a line, as in resolution: 0\\.05\\.$`));
  assert.ok(took < INSTANT, `${yaml.slice(0, 40)} took ${took} ms`);
}

test('a map that repeats or contains itself is refused at once', async () => {
  const aliases = 'aliases exceeded maxAliases \\(0\\)';
  await refused('image: &a [*a]', aliases);
  await refused('image: &a map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nmode: *a', aliases);
  for (const [levels, width] of [[9, 9], [7, 5], [30, 2]]) {
    const bomb = Array.from({ length: levels }, (_, i) => `k${i}: &a${i} [${Array(width).fill(i ? `*a${i - 1}` : 'x').join(', ')}]`);
    await refused(`${bomb.join('\n')}\nimage: *a${levels - 1}`, aliases);
  }
  const plan = await refusalOf([file('plan.json', '{"bounds": &b [0, 0, 1, 1], "walls": [*b]}')]);
  assert.match(plan, /^plan\.json, line 1: this is not JSON \(aliases/);
});

test('what else YAML has beyond fields and values is refused at once', async () => {
  await refused(`a: ${'['.repeat(1e4)}${']'.repeat(1e4)}`, 'nesting exceeded maxDepth \\(100\\)');
  await refused('? '.repeat(3e4), 'nesting exceeded maxDepth \\(100\\)');
  await refused('image: map.pgm\nimage: other.pgm', 'duplicated mapping key');
  await refused('image: !!js/function x', 'unknown scalar tag .+');
  await refused(`image: !${'x'.repeat(9e4)} y`, 'unknown scalar tag .{81}…');
  await refused('image: map.pgm\n---\nimage: map.pgm', 'expected a single document in the stream, but found more');
  await refused('image: *a', 'unidentified alias "a"|aliases exceeded maxAliases \\(0\\)');
  // A long key, or one with the name of a property of objects, is ignored like other unknown fields.
  for (const key of ['x'.repeat(9e4), '__proto__', 'constructor', 'toString', '<<']) {
    const { grid } = await opened(description({ image: 'map.pgm', [key]: '{resolution: 9, image: [1]}' }), PGM);
    assert.deepEqual([grid?.columns, grid?.rows, grid?.resolution], [2, 1, 0.05]);
  }
  assert.equal(Reflect.get({}, 'resolution'), undefined);
});

test('two maps at a time are refused', async () => {
  const plan = file('plan.json', '{"bounds": [0, 0, 1, 1], "walls": []}');
  assert.equal(await refusalOf([description({ image: 'map.pgm' }), PGM, plan]), 'plan.json, map.yaml: these are 2 maps; expected is one at a time.');
});

test('a description is read as leniently as map_server reads it', async () => {
  const plain = await opened(description({ image: 'map.pgm', origin: '[-1, 2, 0]', mode: 'trinary', negate: 1 }), PGM);
  for (const yaml of [
    'image: map.pgm\r\nresolution: "0.05"\r\norigin: ["-1.0", \'2\', 0]\r\nnegate: "1"\r\nmode: Trinary\r\n',
    'image:\tmap.pgm\nresolution:\t0.05\t\norigin:\t[-1,\t2,\t0]\n\tnegate: Yes\nmode:\tTRINARY\n',
  ]) assert.deepEqual((await opened(file('map.yaml', yaml), PGM)).grid, plain.grid, yaml);
  const png = pngOf({ width: 2, height: 1, sample: (column) => [0, 127][column] });
  const misnamed = await opened(description({ image: 'map.pgm', origin: '[-1, 2, 0]', negate: 1 }), file('map.pgm', png));
  assert.deepEqual(misnamed.grid, plain.grid, 'a PNG image with another extension');
});

test('a value of any kind or length is refused by a sentence that can be read', async () => {
  const long = 'x'.repeat(9e4);
  for (const value of [`"${long}"`, `[${'[1], '.repeat(1e4)}]`, '{a: {b: [c]}}', 'null', 'true', '.nan', '1e999', '""']) {
    for (const field of ['image', 'resolution', 'origin', 'negate', 'mode', 'occupied_thresh', 'free_thresh']) {
      const sentence = await refusalOf([description({ image: 'map.pgm', [field]: value }), PGM]);
      const taken = field === 'negate' && value === 'true';
      assert.match(sentence, taken ? /^$/ : new RegExp(`^map\\.yaml: ${field}(\\[0\\])? .+; (allowed|expected) (is|are) .+\\.$`), `${field}: ${value.slice(0, 30)}`);
      assert.ok(sentence.length < 400, `${field}: ${value.slice(0, 30)}: ${sentence.length} characters`);
    }
  }
});

test('a plan that is not quite JSON is forgiven as long as it may be written by hand', async () => {
  /** @param {number} count */
  const plan = (count) => file('plan.json', `{"bounds": [0, 0, 9, 9], "walls": [${'[0, 0, 1.5, 1.5],'.repeat(count)}]}`);
  assert.equal((await opened(plan(1000))).plan.walls.length, 4000);
  // The tolerant parser would take seconds for the largest allowed plan. It is used for small files, and never for valid JSON.
  assert.match(await refusalOf([plan(20_000)]), /^plan\.json: this is not JSON \(.+\); expected is \{"bounds"/);
  const whole = JSON.stringify({ bounds: [0, 0, 9, 9], walls: Array(20_000).fill([0, 0, 1.5, 1.5]) });
  assert.equal((await opened(file('plan.json', whole))).plan.walls.length, 80_000);
});

test('how large files are is looked at before they are read', async () => {
  for (const [name, most] of /** @type {[string, number][]} */ ([['plan.json', 2_000_000], ['map.yaml', 100_000], ['map.pgm', limits.bytes]])) {
    const large = file(name, '');
    Object.defineProperty(large, 'size', { value: most + 1 });
    large.arrayBuffer = () => assert.fail(`${name} is read.`);
    const files = name === 'map.pgm' ? [description({ image: name }), large] : [large];
    assert.equal(await refusalOf(files), `${name}: the file has ${most + 1} bytes; expected are at most ${most}.`);
  }
});

test('a damaged or too large PNG image is refused by a sentence', async () => {
  const png = pngOf({ width: 2, height: 1, sample: (column) => [0, 127][column] });
  const sentence = await refusalOf([description(), file('map.png', png.subarray(0, 50))]);
  assert.match(sentence, /^map\.png: the PNG image is damaged or cut short before byte \d+ of 50; allowed is a complete one\.$/);
  const large = Buffer.concat([SIGNATURE, header({ width: 100_000, height: 100_000 })]);
  assert.equal(await refusalOf([description(), file('map.png', large)]), 'map.png: image has 100000 × 100000 pixels; allowed are at most 33554432.');
});
