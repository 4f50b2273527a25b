/** LZ4 frames: https://github.com/lz4/lz4/blob/dev/doc/lz4_Frame_format.md. */

const MAGIC = 0x184d2204;

/** Bits of the flags. */
const [VERSION, VERSION_1, BLOCK_CHECKSUMS, CONTENT_SIZE, CHECKSUM, DICTIONARY] = [0xc0, 0x40, 0x10, 0x08, 0x04, 0x01];

/** Bit in the length of a block that is not compressed. */
const UNCOMPRESSED = 0x80000000;

/** Minimum length of a match. Lengths are written without it. */
const MIN_MATCH = 4;

function check(condition: boolean): void {
  if (!condition) throw new RangeError('a damaged LZ4 frame');
}

/** Hash of checksums, loaded with the first frame that has one. */
let hash: ((bytes: Uint8Array) => number) | undefined;

/** Decompresses a frame; rejects with a RangeError if it is damaged, its contents have another size, or a checksum is wrong. */
export async function unlz4(bytes: Uint8Array, size: number): Promise<Uint8Array<ArrayBuffer>> {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const flags = view.getUint8(4);
  check(view.getUint32(0, true) === MAGIC && (flags & VERSION) === VERSION_1 && !(flags & DICTIONARY));
  if (flags & (BLOCK_CHECKSUMS | CHECKSUM)) hash ??= (await (await import('xxhash-wasm')).default()).h32Raw;
  const verify = (part: Uint8Array, at: number) => check(hash?.(part) === view.getUint32(at, true));
  const out = new Uint8Array(size);
  let filled = 0;
  // Magic number, two bytes of flags, the size if there is one, and a checksum come first.
  for (let at = 7 + (flags & CONTENT_SIZE ? 8 : 0); ; ) {
    const word = view.getUint32(at, true);
    if (word === 0) {
      if (flags & CHECKSUM) verify(out, at + 4);
      break;
    }
    const from = at + 4;
    const to = from + (word & ~UNCOMPRESSED);
    check(to <= bytes.length);
    if (word & UNCOMPRESSED) {
      out.set(bytes.subarray(from, to), filled);
      filled += to - from;
    } else {
      filled = decompressBlock(bytes.subarray(from, to), out, filled);
    }
    if (flags & BLOCK_CHECKSUMS) verify(bytes.subarray(from, to), to);
    at = to + (flags & BLOCK_CHECKSUMS ? 4 : 0);
  }
  check(filled === size);
  return out;
}

/** Appends a decompressed block to `out`, which has `filled` bytes, and returns the new number. */
function decompressBlock(block: Uint8Array, out: Uint8Array, filled: number): number {
  let at = 0;
  /** Reads the rest of a length of four bits. */
  const lengthFrom = (length: number) => {
    if (length < 15) return length;
    for (let byte = 255; byte === 255; length += byte) {
      check(at < block.length);
      byte = block[at++];
    }
    return length;
  };
  while (at < block.length) {
    const token = block[at++];
    const literals = lengthFrom(token >> 4);
    check(literals <= block.length - at && literals <= out.length - filled);
    out.set(block.subarray(at, at + literals), filled);
    at += literals;
    filled += literals;
    // The last sequence has no match.
    if (at === block.length) break;
    const distance = block[at] | (block[at + 1] << 8);
    at += 2;
    const end = filled + lengthFrom(token & 15) + MIN_MATCH;
    check(distance > 0 && distance <= filled && end <= out.length);
    // A match longer than its distance repeats bytes that it has just written.
    for (const from = filled - distance; filled < end; ) {
      const part = Math.min(end - filled, filled - from);
      out.copyWithin(filled, from, from + part);
      filled += part;
    }
  }
  return filled;
}
