/** Bytes of a source, of which the next are read while the present ones are gone through. */

import { bytesOf } from './refusal.js';

/**
 * @import { Source } from './refusal.js'
 *
 * @typedef {[from: number, to: number]} Part of a source
 */

/** Bytes that are read at once, where no part has more: to ask a browser for a few takes as long as for a million. */
export const PIECE = 2 ** 21;

/** Pieces that are held at once: the present one and the next. */
const HELD = 2;

export class Ahead {
  #source;
  /** @type {Part[]} */
  #pieces = [];
  /** Those that are being read or have been, by their place among all. @type {Map<number, Promise<Uint8Array<ArrayBuffer>>>} */
  #held = new Map();

  /** @param {Source} source */
  constructor(source) {
    this.#source = source;
  }

  /**
   * Tells what will be asked for: bytes that lie inside of these parts, and of one part after the other.
   *
   * @param {Part[]} parts by where they begin
   */
  expect(parts) {
    this.#held.clear();
    this.#pieces = [];
    for (const [from, to] of parts) {
      const last = this.#pieces.at(-1);
      if (last && to - last[0] <= PIECE) last[1] = Math.max(last[1], to);
      else this.#pieces.push([from, to]);
    }
  }

  /**
   * @param {number} from
   * @param {number} to
   * @returns {Promise<Uint8Array<ArrayBuffer>>} rejects as `bytesOf`
   */
  async read(from, to) {
    const at = this.#pieces.findLastIndex(([start]) => start <= from);
    if (at < 0 || to > this.#pieces[at][1]) return bytesOf(this.#source, from, to);
    const present = this.#hold(at);
    if (at + 1 < this.#pieces.length) this.#hold(at + 1);
    const [start] = this.#pieces[at];
    return (await present).subarray(from - start, to - start);
  }

  /** @param {number} at */
  #hold(at) {
    const held = this.#held.get(at);
    if (held) return held;
    const bytes = bytesOf(this.#source, ...this.#pieces[at]);
    // Nobody may ever ask for it.
    bytes.catch(() => {});
    for (const oldest of this.#held.keys()) if (this.#held.size >= HELD) this.#held.delete(oldest);
    this.#held.set(at, bytes);
    return bytes;
  }
}
