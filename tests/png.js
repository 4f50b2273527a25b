/** PNG images in shades of grey, for tests. */

import { Buffer } from 'node:buffer';
import { crc32, deflateSync } from 'node:zlib';

/**
 * @typedef {object} Image
 * @property {number} width
 * @property {number} height
 * @property {boolean} [opacity] true if a pixel has a second sample, its opacity
 * @property {(column: number, row: number, channel: number) => number} sample value from 0 to 255; channel 0 is the grey, 1 the opacity
 */

export const PNG_SIGNATURE = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);

/** Returns a PNG file. @param {Image} image */
export function pngOf({ width, height, opacity = false, sample: sampleAt }) {
  const channels = opacity ? [0, 1] : [0];
  const columnIndices = Array.from({ length: width }, (_, column) => column);
  const scanlines = Array.from({ length: height }, (_, row) => [0, ...columnIndices.flatMap((column) => channels.map((channel) => sampleAt(column, row, channel)))]);
  return Buffer.concat([PNG_SIGNATURE, headerChunkOf({ width, height, opacity }), pngChunkOf('IDAT', deflateSync(Buffer.from(scanlines.flat()))), pngChunkOf('IEND', [])]);
}

/** Returns the chunk with the size and the kind of the image. @param {Omit<Image, 'sample'>} image */
export function headerChunkOf({ width, height, opacity = false }) {
  const headerData = Buffer.alloc(13);
  headerData.writeUInt32BE(width, 0);
  headerData.writeUInt32BE(height, 4);
  headerData.set([8, opacity ? 4 : 0], 8);
  return pngChunkOf('IHDR', headerData);
}

/** Returns a chunk of a PNG file. @param {string} type @param {Uint8Array | number[]} data */
function pngChunkOf(type, data) {
  const typeAndData = Buffer.concat([Buffer.from(type, 'latin1'), Buffer.from(data)]);
  const chunkBytes = Buffer.alloc(typeAndData.length + 8);
  chunkBytes.writeUInt32BE(data.length, 0);
  typeAndData.copy(chunkBytes, 4);
  chunkBytes.writeUInt32BE(crc32(typeAndData), typeAndData.length + 4);
  return chunkBytes;
}
