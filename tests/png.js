/** PNG images of every kind, and damaged ones, for tests. */

import { Buffer } from 'node:buffer';
import { deflateSync } from 'node:zlib';

/**
 * @typedef {object} Image
 * @property {number} width
 * @property {number} height
 * @property {number} [depth] bits of a sample
 * @property {number} [colour] 0 grey, 2 red, green and blue, 3 of a palette, 4 and 6 grey and colours with opacity
 * @property {boolean} [interlaced]
 * @property {(column: number, row: number, part: number) => number} sample what the pixels are
 * @property {(row: number) => number} [filter] how a row is told, from 0 to 4
 * @property {[string, Uint8Array | number[]][]} [before] chunks before the pixels
 * @property {number} [pieces] chunks that the pixels are in
 */

export const SIGNATURE = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);

/** Samples of a pixel, by the kinds of colour. @type {Record<number, number>} */
export const SAMPLES = { 0: 1, 2: 3, 3: 1, 4: 2, 6: 4 };

/** @param {Image} image */
export function pngOf(image) {
  const { before = [], pieces = 1 } = image;
  const data = deflateSync(rasterOf(image));
  const cut = (/** @type {number} */ i) => Math.floor((i * data.length) / pieces);
  const parts = Array.from({ length: pieces }, (_, i) => chunk('IDAT', data.subarray(cut(i), cut(i + 1))));
  return Buffer.concat([SIGNATURE, header(image), ...before.map(([type, bytes]) => chunk(type, bytes)), ...parts, chunk('IEND', [])]);
}

/** The chunk that says what the pixels are. @param {Omit<Image, 'sample'>} image */
export function header({ width, height, depth = 8, colour = 0, interlaced = false }) {
  const data = Buffer.alloc(13);
  data.writeUInt32BE(width, 0);
  data.writeUInt32BE(height, 4);
  data.set([depth, colour, 0, 0, Number(interlaced)], 8);
  return chunk('IHDR', data);
}

/**
 * @param {string} type
 * @param {Uint8Array | number[]} data
 */
export function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), Buffer.from(data)]);
  const framed = Buffer.alloc(body.length + 8);
  framed.writeUInt32BE(data.length, 0);
  body.copy(framed, 4);
  framed.writeUInt32BE(crc32(body), body.length + 4);
  return framed;
}

/** Returns the raster of an image before compression. @param {Image} image */
export function rasterOf({ width, height, depth = 8, colour = 0, interlaced = false, sample, filter = () => 0 }) {
  const passes = interlaced
    ? [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]]
    : [[0, 0, 1, 1]];
  const samples = SAMPLES[colour];
  const step = Math.ceil((depth * samples) / 8);
  /** @type {Buffer[]} */
  const rows = [];
  for (const [x, y, dx, dy] of passes) {
    const columns = Math.ceil((width - x) / dx);
    if (columns <= 0) continue;
    const length = Math.ceil((columns * depth * samples) / 8);
    let above = Buffer.alloc(length);
    for (let row = y; row < height; row += dy) {
      // Written bit by bit, which works for every depth.
      let bits = '';
      for (let column = x; column < width; column += dx) {
        for (let part = 0; part < samples; part++) bits += sample(column, row, part).toString(2).padStart(depth, '0');
      }
      const bytes = Buffer.from((bits.match(/.{1,8}/g) ?? []).map((eight) => parseInt(eight.padEnd(8, '0'), 2)));
      const kind = filter(row);
      const told = bytes.map((byte, i) => {
        const [left, up, corner] = [bytes[i - step] ?? 0, above[i], (i >= step && above[i - step]) || 0];
        const plane = left + up - corner;
        const paeth = [left, up, corner].reduce((best, each) => (Math.abs(plane - each) < Math.abs(plane - best) ? each : best));
        return byte - [0, left, up, Math.floor((left + up) / 2), paeth][kind];
      });
      rows.push(Buffer.from([kind]), Buffer.from(told));
      above = bytes;
    }
  }
  return Buffer.concat(rows);
}

/** @param {Uint8Array} bytes */
function crc32(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return (crc ^ 0xffffffff) >>> 0;
}
