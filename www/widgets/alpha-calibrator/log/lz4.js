/** LZ4 frames, as recordings have them: https://github.com/lz4/lz4/blob/dev/doc/lz4_Frame_format.md. */

const MAGIC = 0x184d2204;

/** Bits of the first byte after it, and what they say is there. */
const [VERSION, VERSION_1, BLOCK_CHECKSUMS, CONTENT_SIZE, DICTIONARY] = [0xc0, 0x40, 0x10, 0x08, 0x01];

/** A block that is not compressed has this bit in its length. */
const PLAIN = 0x80000000;

/** A match is this much longer than it says. */
const SHORTEST_MATCH = 4;

/**
 * @param {Uint8Array} bytes of a frame
 * @param {number} size of what is in it
 * @returns {Uint8Array<ArrayBuffer>}
 * @throws {RangeError} where it is damaged, or holds more or less. Checksums are those of the chunk around it.
 */
export function unlz4(bytes, size) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (view.getUint32(0, true) !== MAGIC) throw new RangeError('no LZ4 frame');
  const flags = view.getUint8(4);
  if ((flags & VERSION) !== VERSION_1 || flags & DICTIONARY) throw new RangeError('an LZ4 frame of another kind');
  // Magic, flags, the size of blocks, that of the contents where it is told, a checksum.
  let at = 7 + (flags & CONTENT_SIZE ? 8 : 0);
  const out = new Uint8Array(size);
  let filled = 0;
  for (;;) {
    const told = view.getUint32(at, true);
    at += 4;
    if (told === 0) break;
    const length = told & ~PLAIN;
    if (length > bytes.length - at) throw new RangeError('an LZ4 block is cut short');
    const block = bytes.subarray(at, at + length);
    if (told & PLAIN) {
      if (length > size - filled) throw tooLong();
      out.set(block, filled);
      filled += length;
    } else {
      filled = unblock(block, out, filled);
    }
    at += length + (flags & BLOCK_CHECKSUMS ? 4 : 0);
  }
  if (filled !== size) throw new RangeError(`an LZ4 frame of ${filled} bytes, where ${size} are announced`);
  return out;
}

const tooLong = () => new RangeError('an LZ4 frame is longer than announced');

/**
 * @param {Uint8Array} block
 * @param {Uint8Array} out
 * @param {number} filled
 * @returns {number} how much of it is filled then
 */
function unblock(block, out, filled) {
  let at = 0;
  /** A length that goes on as long as bytes are full. @param {number} length */
  const longer = (length) => {
    if (length < 15) return length;
    let byte;
    do {
      if (at >= block.length) throw new RangeError('an LZ4 block ends within a length');
      byte = block[at++];
      length += byte;
    } while (byte === 255);
    return length;
  };
  while (at < block.length) {
    const token = block[at++];
    const literals = longer(token >> 4);
    if (literals > block.length - at) throw new RangeError('an LZ4 block ends within its literals');
    if (literals > out.length - filled) throw tooLong();
    out.set(block.subarray(at, at + literals), filled);
    at += literals;
    filled += literals;
    // The last sequence has no match.
    if (at === block.length) break;
    if (at + 2 > block.length) throw new RangeError('an LZ4 block ends within a distance');
    const distance = block[at] | (block[at + 1] << 8);
    at += 2;
    const length = longer(token & 15) + SHORTEST_MATCH;
    if (distance === 0 || distance > filled) throw new RangeError('an LZ4 block refers to what is not there');
    if (length > out.length - filled) throw tooLong();
    // What repeats itself is copied in steps of what is there already.
    const end = filled + length;
    for (let from = filled - distance; filled < end; ) {
      const part = Math.min(end - filled, filled - from);
      out.copyWithin(filled, from, from + part);
      filled += part;
    }
  }
  return filled;
}
