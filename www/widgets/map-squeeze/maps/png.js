/**
 * PNG images, pixel for pixel as they are in the file, the same in every browser. Browsers show images: they take what is
 * cut short, correct colours and blacken what is transparent, each in its own way. Here what is damaged is refused, gamma
 * and profiles are left alone, and only inflating is the browser's. By the standard, https://www.w3.org/TR/png-3/.
 */

import { breathing } from '../../../figure/breath.js';
import { inflated } from '../../../figure/packing.js';

/**
 * @typedef {import('../../../messages/registry.js').Messages['squeeze']['refused']['png']} Reasons
 *
 * @typedef {object} Header
 * @property {number} width
 * @property {number} height
 * @property {number} depth bits of a sample
 * @property {number} colour what a pixel consists of, see COLOURS
 * @property {number} interlace 1 where the pixels come in passes
 *
 * @typedef {object} Parts
 * @property {Header} header
 * @property {Uint8Array} palette red, green and blue of each colour
 * @property {Uint8Array} transparency the opacity of each colour in the palette, or the samples of the one that is clear
 * @property {Uint8Array<ArrayBuffer>[]} chunks what together inflates to the pixels
 */

/** Why bytes are no PNG image. */
export class PngError extends Error {
  /** @param {(say: Reasons) => string} reason in the words of the time when it is shown */
  constructor(reason) {
    super('The image is damaged.');
    this.reason = reason;
  }
}

/** The first bytes of every PNG image. */
const SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];

/** Those up to the end of the header. */
export const HEADER_BYTES = 33;

/** A kind of colour, that of images with a palette. */
const INDEXED = 3;

/**
 * Samples of a pixel, and bits that each may have, by the kinds of colour.
 *
 * @type {Record<number, { samples: number, depths: number[] }>}
 */
const COLOURS = {
  0: { samples: 1, depths: [1, 2, 4, 8, 16] },
  2: { samples: 3, depths: [8, 16] },
  [INDEXED]: { samples: 1, depths: [1, 2, 4, 8] },
  4: { samples: 2, depths: [8, 16] },
  6: { samples: 4, depths: [8, 16] },
};

/** Bytes of a transparency that says which colour is clear, by the kinds of colour. @type {Record<number, number>} */
const CLEAR_BYTES = { 0: 2, 2: 6 };

/** Pixels of each pass where an image is interlaced: from which column and row, and how far to the next ones. */
const PASSES = [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];

/** Chunks at most: a map of the largest size has some thousand, and even an empty one costs time. */
const MAX_CHUNKS = 100_000;

/** The ways to tell a row: each byte as the difference from 0, the one to the left, above, the mean of these two, or `nearest`. */
const FILTERS = 5;

/** What each byte adds to a checksum. */
const CHECKSUMS = Int32Array.from({ length: 256 }, (_, sum) => {
  for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 && 0xedb88320);
  return sum;
});

/** Whether bytes begin as those of every PNG image. @param {Uint8Array} bytes */
export function isPng(bytes) {
  return SIGNATURE.every((byte, i) => byte === bytes[i]);
}

/**
 * What an image says of itself before its pixels: a small file may hold an enormous one.
 *
 * @param {Uint8Array<ArrayBuffer>} bytes that begin as a PNG image does
 * @returns {Header}
 * @throws {PngError}
 */
export function headerOf(bytes) {
  if (bytes.length < HEADER_BYTES) throw cut(bytes, 'IHDR');
  const type = typeAt(bytes, SIGNATURE.length);
  const view = viewOf(bytes);
  if (type !== 'IHDR') throw refused('chunk 1', type, 'IHDR');
  heed('IHDR.length', view.getUint32(8), [13]);
  // It is as it was written.
  chunksOf(bytes).next();
  const [width, height] = [view.getUint32(16), view.getUint32(20)];
  const [depth, colour, compression, filter, interlace] = bytes.subarray(24);
  heed('IHDR.color', colour, Object.keys(COLOURS).map(Number));
  heed('IHDR.depth', depth, COLOURS[colour].depths);
  heed('IHDR.compression', compression, [0]);
  heed('IHDR.filter', filter, [0]);
  heed('IHDR.interlace', interlace, [0, 1]);
  if (width < 1) throw refused('IHDR.width', width, '≥ 1');
  if (height < 1) throw refused('IHDR.height', height, '≥ 1');
  return { width, height, depth, colour, interlace };
}

/**
 * @param {Uint8Array<ArrayBuffer>} bytes of the whole file, which begins as a PNG image does; how large it is was looked at
 * @returns {Promise<{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }>} as an ImageData: what is
 *   transparent keeps its colour, and of 16 bits the nearest in 8 is told
 * @throws {PngError}
 */
export async function decodePng(bytes) {
  const parts = partsOf(bytes);
  const { width, height, depth, colour, interlace } = parts.header;
  const bits = depth * COLOURS[colour].samples;
  const step = Math.ceil(bits / 8);
  const pixelOf = readerOf(parts);
  const passes = (interlace ? PASSES : [[0, 0, 1, 1]])
    .map(([x, y, dx, dy]) => ({ x, y, dx, dy, columns: Math.ceil((width - x) / dx), rows: Math.ceil((height - y) / dy) }))
    .filter(({ columns, rows }) => columns > 0 && rows > 0);
  const lengthOf = (/** @type {number} */ columns) => 1 + Math.ceil((columns * bits) / 8);
  const length = passes.reduce((sum, { columns, rows }) => sum + rows * lengthOf(columns), 0);
  const pixels = new Uint32Array(width * height);
  const raster = new Raster(parts.chunks, length);
  const breathe = breathing({});
  try {
    for (const { x, y, dx, dy, columns, rows } of passes) {
      // What would be to the left of a row, or above the first, counts as 0.
      let row = new Uint8Array(step - 1 + lengthOf(columns));
      let above = new Uint8Array(row.length);
      for (let i = 0; i < rows; i++) {
        await raster.read(row, step - 1);
        await breathe(i / rows);
        const filter = row[step - 1];
        if (filter >= FILTERS) throw refused('filter', filter, `< ${FILTERS}`);
        row[step - 1] = 0;
        unfilter(filter, row, above, step);
        const samples = row.subarray(step);
        let at = (y + i * dy) * width + x;
        for (let column = 0; column < columns; column++, at += dx) pixels[at] = pixelOf(samples, column);
        [row, above] = [above, row];
      }
    }
    await raster.end();
  } finally {
    raster.close();
  }
  return { width, height, data: new Uint8ClampedArray(pixels.buffer) };
}

/** The bytes that an image inflates to: as many as its pixels take, and no more are inflated. */
class Raster {
  #pieces;
  #piece = new Uint8Array();
  /** Bytes of the piece that were read. */
  #used = 0;
  /** All that were read. */
  #count = 0;
  #length;

  /**
   * @param {Uint8Array<ArrayBuffer>[]} chunks
   * @param {number} length
   */
  constructor(chunks, length) {
    this.#pieces = inflated(chunks, 'deflate');
    this.#length = length;
  }

  /**
   * @param {Uint8Array} into is filled
   * @param {number} from this place of it
   */
  async read(into, from) {
    while (from < into.length) {
      if (!(await this.#more())) throw refused('IDAT.length', this.#count, this.#length);
      const part = this.#piece.subarray(this.#used, this.#used + into.length - from);
      into.set(part, from);
      from += part.length;
      this.#used += part.length;
      this.#count += part.length;
    }
  }

  /** There is to be nothing more. */
  async end() {
    if (await this.#more()) throw refused('IDAT.length', `> ${this.#length}`, this.#length);
  }

  close() {
    this.#pieces.return();
  }

  async #more() {
    while (this.#used === this.#piece.length) {
      const { value } = await this.#pieces.next().catch(() => {
        throw changed('IDAT');
      });
      if (!value) return false;
      [this.#piece, this.#used] = [value, 0];
    }
    return true;
  }
}

/**
 * @param {number} filter
 * @param {Uint8Array} row of differences, which become samples
 * @param {Uint8Array} above
 * @param {number} step bytes of a pixel, and those before the first
 */
function unfilter(filter, row, above, step) {
  const { length } = row;
  if (filter === 1) for (let i = step; i < length; i++) row[i] += row[i - step];
  if (filter === 2) for (let i = step; i < length; i++) row[i] += above[i];
  if (filter === 3) for (let i = step; i < length; i++) row[i] += (row[i - step] + above[i]) >> 1;
  if (filter === 4) for (let i = step; i < length; i++) row[i] += nearest(row[i - step], above[i], above[i - step]);
}

/**
 * What is nearest to left + up − corner. Of two that are, the former.
 *
 * @param {number} left
 * @param {number} up
 * @param {number} corner to the left above
 */
function nearest(left, up, corner) {
  const toLeft = Math.abs(up - corner);
  const toUp = Math.abs(left - corner);
  const toCorner = Math.abs(left + up - 2 * corner);
  if (toLeft <= toUp && toLeft <= toCorner) return left;
  return toUp <= toCorner ? up : corner;
}

/**
 * @param {Parts} parts
 * @returns {(row: Uint8Array, column: number) => number} a pixel of a row
 */
function readerOf({ header: { depth, colour }, palette, transparency }) {
  const sample = sampleOf(depth);
  if (colour === INDEXED) {
    const colours = Array.from({ length: palette.length / 3 }, (_, i) =>
      pixel(palette[3 * i], palette[3 * i + 1], palette[3 * i + 2], transparency[i] ?? 255),
    );
    return (row, column) => {
      const i = sample(row, column);
      if (i >= colours.length) throw refused('pixel', i, `< ${colours.length}`);
      return colours[i];
    };
  }
  const { samples } = COLOURS[colour];
  const grey = samples < 3;
  const greatest = 2 ** depth - 1;
  const scale = 255 / greatest;
  // Two bytes each, of which the lowest bits count.
  const [clearRed, clearGreen = clearRed, clearBlue = clearRed] = Array.from(
    { length: transparency.length / 2 },
    (_, i) => sampleOf(16)(transparency, i) & greatest,
  );
  return (row, column) => {
    const first = column * samples;
    const red = sample(row, first);
    const green = grey ? red : sample(row, first + 1);
    const blue = grey ? red : sample(row, first + 2);
    let opacity = greatest;
    if (samples % 2 === 0) opacity = sample(row, first + samples - 1);
    else if (red === clearRed && green === clearGreen && blue === clearBlue) opacity = 0;
    return pixel(scale * red, scale * green, scale * blue, scale * opacity);
  };
}

/**
 * Four bytes as one number, the first of them lowest, as every machine has them that runs WebAssembly.
 *
 * @param {number} red
 * @param {number} green
 * @param {number} blue
 * @param {number} opacity
 */
function pixel(red, green, blue, opacity) {
  return (red + 0.5) | ((green + 0.5) << 8) | ((blue + 0.5) << 16) | ((opacity + 0.5) << 24);
}

/**
 * @param {number} depth bits
 * @returns {(row: Uint8Array, i: number) => number}
 */
function sampleOf(depth) {
  if (depth === 8) return (row, i) => row[i];
  if (depth === 16) return (row, i) => 256 * row[2 * i] + row[2 * i + 1];
  return (row, i) => (row[(i * depth) >> 3] >> (8 - depth - ((i * depth) & 7))) & (2 ** depth - 1);
}

/**
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @returns {Parts}
 */
function partsOf(bytes) {
  const header = headerOf(bytes);
  const { colour, depth } = header;
  /** @type {Parts} */
  const parts = { header, palette: new Uint8Array(), transparency: new Uint8Array(), chunks: [] };
  let before = '';
  let count = 0;
  for (const { type, data } of chunksOf(bytes)) {
    if (++count > MAX_CHUNKS) throw refused('chunks', `> ${MAX_CHUNKS}`, `≤ ${MAX_CHUNKS}`);
    const only = (/** @type {string[]} */ ...allowed) => {
      if (!allowed.includes(type)) throw refused(`chunk ${count}`, type, allowed.join(', '));
    };
    // What is in capitals has to be understood.
    if (/^[A-Z]/.test(type)) {
      if (count === 1) only('IHDR');
      else if (colour === INDEXED && !parts.palette.length) only('PLTE');
      else if (!parts.chunks.length) only('IDAT', ...(parts.palette.length ? [] : ['PLTE']));
      else only('IEND', ...(before === 'IDAT' ? ['IDAT'] : []));
    }
    if (type === 'PLTE') {
      const colours = data.length / 3;
      const most = colour === INDEXED ? 2 ** depth : 256;
      if (!Number.isInteger(colours) || colours < 1 || colours > most) throw refused('PLTE.length', data.length, `3, 6 … ${3 * most}`);
      parts.palette = data;
    } else if (type === 'tRNS' && !parts.transparency.length && !parts.chunks.length) {
      const most = parts.palette.length / 3;
      if (colour in CLEAR_BYTES) heed('tRNS.length', data.length, [CLEAR_BYTES[colour]]);
      else if (colour === INDEXED && data.length > most) throw refused('tRNS.length', data.length, `≤ ${most}`);
      if (COLOURS[colour].samples % 2) parts.transparency = data;
    } else if (type === 'IDAT') parts.chunks.push(data);
    before = type;
  }
  return parts;
}

/**
 * The chunks up to that which ends the image, each as it was written.
 *
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @returns {Generator<{ type: string, data: Uint8Array<ArrayBuffer> }, void>}
 */
function* chunksOf(bytes) {
  const view = viewOf(bytes);
  let type = '';
  for (let at = SIGNATURE.length; type !== 'IEND'; ) {
    // Its length, its type, its data and their checksum.
    if (at + 12 > bytes.length) throw cut(bytes, type);
    type = typeAt(bytes, at);
    const end = at + 12 + view.getUint32(at);
    if (end > bytes.length) throw cut(bytes, type);
    if (checksum(bytes.subarray(at + 4, end - 4)) !== view.getInt32(end - 4)) throw changed(type);
    yield { type, data: bytes.subarray(at + 8, end - 4) };
    at = end;
  }
}

/**
 * @param {Uint8Array} bytes
 * @param {number} at the beginning of a chunk
 */
function typeAt(bytes, at) {
  const type = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
  if (!/^[a-z]{4}$/i.test(type)) throw refused(`byte ${at + 5}`, JSON.stringify(type), 'A–Z, a–z');
  return type;
}

/** @param {Uint8Array} bytes */
function checksum(bytes) {
  let sum = -1;
  for (let i = 0; i < bytes.length; i++) sum = (sum >>> 8) ^ CHECKSUMS[(sum ^ bytes[i]) & 255];
  return ~sum;
}

/** @param {Uint8Array} bytes */
function viewOf({ buffer, byteOffset, byteLength }) {
  return new DataView(buffer, byteOffset, byteLength);
}

/**
 * @param {string} field
 * @param {number} value
 * @param {number[]} allowed
 */
function heed(field, value, allowed) {
  if (!allowed.includes(value)) throw refused(field, value, allowed.join(', '));
}

/**
 * @param {string} field
 * @param {number | string} value
 * @param {number | string} allowed
 */
function refused(field, value, allowed) {
  return new PngError((say) => say.field(field, value, allowed));
}

/**
 * @param {Uint8Array} bytes
 * @param {string} chunk
 */
function cut({ length }, chunk) {
  return new PngError((say) => say.cut(length, chunk));
}

/** @param {string} chunk */
function changed(chunk) {
  return new PngError((say) => say.changed(chunk));
}
