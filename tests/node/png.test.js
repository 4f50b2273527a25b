// Maps as PNG images: the same cells whatever reads them, and a sentence for what is damaged.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { decodePng } from '../../www/widgets/map-squeeze/maps/png.js';
import { SAMPLES, SIGNATURE, chunk, header, pngOf, rasterOf } from '../png.js';
import { description, file, opened, refusalOf } from './map-support.js';
import { generator } from '../random.js';

/** @typedef {import('../png.js').Image} Image */

/** Depths that the standard allows, by the kinds of colour. @type {Record<number, number[]>} */
const DEPTHS = { 0: [1, 2, 4, 8, 16], 2: [8, 16], 3: [1, 2, 4, 8], 4: [8, 16], 6: [8, 16] };

/** Chunks that browsers change colours by: gamma of 1/2.2, primaries, and that of screens. @type {[string, number[]][]} */
const COLOURING = [
  ['gAMA', [0, 0, 0xb1, 0x8f]],
  ['cHRM', Array(32).fill(9)],
  ['sRGB', [0]],
  ['tEXt', [...Buffer.from('Comment\0by hand')]],
];

/** 20 × 20 cells with a border. @type {Image} */
const ROOM = { width: 20, height: 20, sample: (column, row) => (column % 19 && row % 19 ? 254 : 0), filter: (row) => row % 5 };

/** @param {Uint8Array<ArrayBuffer>} bytes */
const refusal = (bytes) => refusalOf([description(), file('map.png', bytes)]);

/**
 * An image of these chunks.
 *
 * @param {[string, Uint8Array | number[]][]} chunks
 */
const made = (...chunks) => Buffer.concat([SIGNATURE, ...chunks.map(([type, data]) => chunk(type, data))]);

test('every kind of image is read sample for sample', async () => {
  const random = generator(12);
  const whole = (/** @type {number} */ below) => Math.floor(random() * below);
  let count = 0;
  for (const [colour, depths] of Object.entries(DEPTHS).map(([key, value]) => /** @type {const} */ ([Number(key), value]))) {
    for (const depth of depths) {
      for (const [width, height] of [[1, 1], [2, 3], [5, 4], [9, 8], [33, 17]]) {
        for (const interlaced of [false, true]) {
          for (const clear of [false, true]) {
            const samples = Array.from({ length: 4 * width * height }, () => whole(2 ** depth));
            const sampleOf = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ part) => samples[4 * (y * width + x) + part];
            const palette = Array.from({ length: 2 ** depth }, () => [whole(256), whole(256), whole(256)]);
            const opacities = Array.from({ length: 2 ** (depth - 1) }, () => whole(256));
            const first = Array.from({ length: SAMPLES[colour] }, (_, part) => sampleOf(0, 0, part));
            /** @type {[string, number[]][]} */
            const before = colour === 3 ? [['PLTE', palette.flat()]] : [];
            if (clear) before.push(['tRNS', colour === 3 ? opacities : first.flatMap((value) => [value >> 8, value & 255])]);
            const filter = () => whole(5);
            // A kind of colour with opacities of its own has no use for one that is clear, and keeps them.
            const bytes = pngOf({ width, height, depth, colour, interlaced, sample: sampleOf, filter, before: [...COLOURING, ...before], pieces: 1 + whole(3) });
            const { data } = await decodePng(new Uint8Array(bytes));

            const scaled = (/** @type {number} */ value) => Math.round((255 * value) / (2 ** depth - 1));
            const expected = Array.from({ length: width * height }, (_, i) => {
              const own = samples.slice(4 * i, 4 * i + 4);
              const isClear = clear && first.every((value, part) => value === own[part]);
              if (colour === 0) return [own[0], own[0], own[0]].map(scaled).concat(isClear ? 0 : 255);
              if (colour === 2) return own.slice(0, 3).map(scaled).concat(isClear ? 0 : 255);
              if (colour === 3) return [...palette[own[0]], (clear ? opacities[own[0]] : undefined) ?? 255];
              if (colour === 4) return [own[0], own[0], own[0], own[1]].map(scaled);
              return own.map(scaled);
            });
            assert.deepEqual([...data], expected.flat(), JSON.stringify({ colour, depth, width, height, interlaced, clear }));
            count += 1;
          }
        }
      }
    }
  }
  assert.equal(count, 15 * 5 * 2 * 2);
});

test('what is transparent is read as map_server has it', async () => {
  const cells = async (/** @type {string} */ mode, /** @type {Image} */ image) => {
    const { grid } = await opened(description({ mode }), file('map.png', pngOf(image)));
    const count = (/** @type {Uint8Array | undefined} */ flags) => flags?.filter(Boolean).length;
    return [count(grid?.occupied), count(grid?.unknown)];
  };
  const size = { width: 16, height: 16, colour: 6 };
  // White that is clear: opacity counts as a fourth colour, and three of four are full.
  const white = { ...size, sample: (/** @type {number} */ _x, /** @type {number} */ _y, /** @type {number} */ part) => (part < 3 ? 255 : 0) };
  assert.deepEqual(await cells('trinary', white), [0, 256]);
  assert.deepEqual(await cells('scale', white), [0, 256]);
  assert.deepEqual(await cells('raw', white), [0, 256]);
  // Every grey, half transparent: occupied where 1 − (3v + 128)/1020 > 0.65, so v < 76.3, and unknown from there to
  // 1 − (3v + 128)/1020 ≥ 0.196, so v ≤ 230.7.
  const ramp = { ...size, sample: (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ part) => (part < 3 ? 16 * y + x : 128) };
  assert.deepEqual(await cells('trinary', ramp), [77, 231 - 77]);
  assert.deepEqual(await cells('scale', ramp), [0, 256]);
  assert.deepEqual(await cells('raw', ramp), [1, 155]);
  // The same greys by a palette, of which one is clear, and opaque.
  const palette = /** @type {[string, number[]]} */ (['PLTE', Array.from({ length: 768 }, (_, i) => Math.floor(i / 3))]);
  const indexed = { ...ramp, colour: 3, before: [palette] };
  assert.deepEqual(await cells('scale', { ...indexed, before: [palette, ['tRNS', [0]]] }), [89, 1]);
  assert.deepEqual(await cells('trinary', indexed), [90, 205 - 89]);
});

test('an image that is cut short is refused wherever it ends', async () => {
  const bytes = pngOf({ ...ROOM, pieces: 3 });
  assert.equal(await refusal(bytes), '');
  for (let length = 0; length < bytes.length; length++) {
    const sentence = await refusal(bytes.subarray(0, length));
    const expected = length < 8 ? /^map\.png: its first bytes are not those of a PNG/ : new RegExp(`^map\\.png: the file ends after ${length} bytes, within [A-Z]{4}; expected is a complete PNG image\\.$`);
    assert.match(sentence, expected, `${length} bytes`);
  }
  // What follows the image is not of it.
  assert.equal(await refusal(Buffer.concat([bytes, Buffer.from('\n')])), '');
});

test('no byte can be another without being noticed', async () => {
  const bytes = pngOf({ ...ROOM, before: [['gAMA', [0, 0, 0xb1, 0x8f]]] });
  const random = generator(7);
  for (let at = 0; at < bytes.length; at++) {
    const damaged = Buffer.from(bytes);
    damaged[at] ^= 1 + Math.floor(255 * random());
    assert.match(await refusal(damaged), /^map\.png: .+; expected is (PNG|a complete PNG image)\.$/, `byte ${at}`);
  }
});

test('what is no image by the standard is refused by its part, value and what is allowed', async () => {
  const size = { width: 20, height: 20 };
  const told = (/** @type {number[]} */ ...bytes) => /** @type {[string, number[]]} */ (['IHDR', [0, 0, 0, 20, 0, 0, 0, 20, ...bytes]]);
  const IHDR = told(8, 0, 0, 0, 0);
  const INDEXED = told(2, 3, 0, 0, 0);
  const raster = rasterOf(ROOM);
  const IDAT = /** @type {[string, Uint8Array]} */ (['IDAT', deflateSync(raster)]);
  const IEND = /** @type {[string, number[]]} */ (['IEND', []]);
  const PLTE = /** @type {[string, number[]]} */ (['PLTE', [0, 0, 0, 255, 255, 255]]);
  const deflated = (/** @type {Uint8Array} */ bytes) => /** @type {[string, Uint8Array]} */ (['IDAT', deflateSync(bytes)]);
  const filtered = Buffer.from(raster);
  filtered[21] = 5;
  const changed = Buffer.from(IDAT[1]);
  changed[changed.length - 1] ^= 1;
  /** @type {[Uint8Array<ArrayBuffer>, string][]} */
  const cases = [
    [made(['IDAT', IDAT[1]], IEND), 'chunk 1 is IDAT; allowed is IHDR'],
    [made(['IHDR', [...IHDR[1], 0]], IDAT, IEND), 'IHDR.length is 14; allowed is 13'],
    [Buffer.concat([SIGNATURE, header({ width: 0, height: 4 })]), 'IHDR.width is 0; allowed is ≥ 1'],
    [Buffer.concat([SIGNATURE, header({ width: 4, height: 0 })]), 'IHDR.height is 0; allowed is ≥ 1'],
    [made(told(3, 0, 0, 0, 0)), 'IHDR.depth is 3; allowed is 1, 2, 4, 8, 16'],
    [made(told(4, 2, 0, 0, 0)), 'IHDR.depth is 4; allowed is 8, 16'],
    [made(told(8, 5, 0, 0, 0)), 'IHDR.color is 5; allowed is 0, 2, 3, 4, 6'],
    [made(told(8, 0, 1, 0, 0)), 'IHDR.compression is 1; allowed is 0'],
    [made(told(8, 0, 0, 2, 0)), 'IHDR.filter is 2; allowed is 0'],
    [made(told(8, 0, 0, 0, 2)), 'IHDR.interlace is 2; allowed is 0, 1'],
    [made(IHDR, IEND), 'chunk 2 is IEND; allowed is IDAT, PLTE'],
    [made(IHDR, IHDR, IDAT, IEND), 'chunk 2 is IHDR; allowed is IDAT, PLTE'],
    [made(IHDR, ['ABCD', []], IDAT, IEND), 'chunk 2 is ABCD; allowed is IDAT, PLTE'],
    [made(IHDR, IDAT, ['tEXt', []], IDAT, IEND), 'chunk 4 is IDAT; allowed is IEND'],
    [made(IHDR, PLTE, PLTE, IDAT, IEND), 'chunk 3 is PLTE; allowed is IDAT'],
    [made(INDEXED, deflated(raster), IEND), 'chunk 2 is IDAT; allowed is PLTE'],
    [made(INDEXED, ['PLTE', Array(15).fill(0)], IDAT, IEND), 'PLTE.length is 15; allowed is 3, 6 … 12'],
    [made(INDEXED, ['PLTE', [1, 2]], IDAT, IEND), 'PLTE.length is 2; allowed is 3, 6 … 12'],
    [made(INDEXED, PLTE, ['tRNS', [1, 2, 3]], IDAT, IEND), 'tRNS.length is 3; allowed is ≤ 2'],
    [made(INDEXED, PLTE, deflated(Buffer.alloc(120).fill(2, 1, 2)), IEND), 'pixel is 2; allowed is < 2'],
    [made(IHDR, ['tRNS', [0]], IDAT, IEND), 'tRNS.length is 1; allowed is 2'],
    [made(IHDR, deflated(filtered), IEND), 'filter is 5; allowed is < 5'],
    [made(IHDR, deflated(raster.subarray(0, 400)), IEND), 'IDAT.length is 400; allowed is 420'],
    [made(IHDR, deflated(Buffer.concat([raster, raster])), IEND), 'IDAT.length is > 420; allowed is 420'],
    [made(IHDR, ['IDAT', IDAT[1].subarray(0, 20)], IEND), 'IDAT is not what was written'],
    [made(IHDR, ['IDAT', changed], IEND), 'IDAT is not what was written'],
    [made(IHDR, ['IDAT', []], IEND), 'IDAT is not what was written'],
  ];
  for (const [bytes, reason] of cases) assert.equal(await refusal(bytes), `map.png: ${reason}; expected is a complete PNG image.`);
  assert.equal(await refusal(made(told(8, 0, 0, 0, 0), IDAT, IEND)), '', JSON.stringify(size));
  const german = await refusalOf([description(), file('map.png', made(told(3, 0, 0, 0, 0)))], 'de');
  assert.equal(german, 'map.png: IHDR.depth ist 3; erlaubt ist 1, 2, 4, 8, 16; erwartet wird ein vollständiges PNG-Bild.');
});

test('what is too large is refused before it is read, and what unpacks to more before it is unpacked', async () => {
  /** @param {number} size */
  const guarded = (size, bytes = pngOf(ROOM)) => {
    const image = file('map.png', bytes);
    Object.defineProperty(image, 'size', { value: size });
    image.arrayBuffer = () => assert.fail('It is read.');
    return image;
  };
  const large = Buffer.concat([SIGNATURE, header({ width: 100_000, height: 100_000 })]);
  assert.match(await refusalOf([description(), guarded(100, large)]), /^map\.png: width × height is 100000 × 100000; expected are sides up to 16384 and at most 16777216 pixels\.$/);
  assert.equal(await refusalOf([description(), guarded(2e9)]), 'map.png: the file has 2000000000 bytes; expected are at most 100667392.');

  // A hundred megabytes in a hundred kilobytes.
  const bomb = made(['IHDR', [0, 0, 0, 4, 0, 0, 0, 4, 8, 0, 0, 0, 0]], ['IDAT', deflateSync(Buffer.alloc(1e8))], ['IEND', []]);
  const before = process.memoryUsage().arrayBuffers;
  assert.match(await refusal(bomb), /^map\.png: IDAT\.length is > 20; allowed is 20;/);
  assert.ok(process.memoryUsage().arrayBuffers - before < 1e7);

  // A million parts, each of which takes time.
  const empty = chunk('IDAT', []);
  const parts = Buffer.concat([SIGNATURE, header({ width: 4, height: 4 }), ...Array(200_000).fill(empty)]);
  assert.match(await refusal(parts), /^map\.png: chunks is > 100000; allowed is ≤ 100000;/);
});

test('whoever reads an image lets others have their turn after a row, when it is time', async (context) => {
  let [time, turns] = [0, 0];
  // Each row takes a fiftieth of a second.
  context.mock.method(performance, 'now', () => (time += 20));
  const { MessageChannel } = globalThis;
  globalThis.MessageChannel = class extends MessageChannel {
    constructor() {
      super();
      turns++;
    }
  };
  context.after(() => (globalThis.MessageChannel = MessageChannel));
  await decodePng(new Uint8Array(pngOf(ROOM)));
  assert.equal(turns, ROOM.height);
});
