/** Files and streams for millions of inputs: Node's own go through two threads and take longer than what reads them. */

import { Buffer } from 'node:buffer';
import { inflateRawSync, inflateSync } from 'node:zlib';

/** @type {Record<string, (bytes: Uint8Array) => Uint8Array>} */
const INFLATE = { deflate: inflateSync, 'deflate-raw': inflateRawSync };

/** A Blob, as far as it is used here. */
class MemoryBlob {
  /** @type {Buffer<ArrayBuffer>} */
  #bytes;

  /** @param {(string | Uint8Array)[]} parts */
  constructor(parts) {
    const all = parts.map((part) => (typeof part === 'string' ? Buffer.from(part) : part));
    this.#bytes = Buffer.concat(all);
  }

  get size() {
    return this.#bytes.length;
  }

  /** @param {number} from @param {number} to */
  slice(from, to) {
    return new MemoryBlob([this.#bytes.subarray(from, to)]);
  }

  async arrayBuffer() {
    return new Uint8Array(this.#bytes).buffer;
  }

  async text() {
    return new TextDecoder().decode(this.#bytes);
  }

  stream() {
    return { pipeThrough: (/** @type {MemoryDecompression} */ { format }) => ({ getReader: () => inflating(this.#bytes, format) }) };
  }
}

class MemoryFile extends MemoryBlob {
  /** @param {(string | Uint8Array)[]} parts @param {string} name */
  constructor(parts, name) {
    super(parts);
    this.name = name;
  }
}

class MemoryDecompression {
  /** @param {string} format */
  constructor(format) {
    this.format = format;
  }
}

/** Bytes of a piece of what is inflated, as Node has it. */
const PIECE = 2 ** 14;

/** @param {Uint8Array} bytes @param {string} format */
function inflating(bytes, format) {
  /** @type {Uint8Array | undefined} */
  let rest;
  return {
    async read() {
      rest ??= INFLATE[format](bytes);
      const value = rest.subarray(0, PIECE);
      rest = rest.subarray(PIECE);
      return value.length ? { done: false, value } : { done: true };
    },
    async cancel() {},
  };
}

/** From now on files are in memory, and inflated at once. */
export function useMemory() {
  Object.assign(globalThis, { Blob: MemoryBlob, File: MemoryFile, DecompressionStream: MemoryDecompression });
}
