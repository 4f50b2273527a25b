/** The lines of a text, piece by piece: no more of a file is held than a piece and a line. */

import { LogError, bytesOf } from './refusal.js';

/** @import { Source } from './refusal.js' */

/** Bytes that are read at once: some milliseconds' work. */
const PIECE = 2 ** 18;

/** Bytes of a line at most: a row of a thousand columns. */
const LONGEST = 2 ** 16;

/** What some programs put at the beginning of a text. */
const BYTE_ORDER_MARK = [0xef, 0xbb, 0xbf];

const [LINE_FEED, RETURN, NUL] = [10, 13, 0];

export class Lines {
  #source;
  /** Bytes of the file that were read. */
  #read = 0;
  #next = 0;

  /** What was read last, and where in it the present line is. */
  bytes = new Uint8Array();
  from = 0;
  to = 0;

  /** The number of the present line, from 1. */
  number = 0;

  /** Whether nothing ends the present line: it is the file's last, and may have been cut. */
  isOpen = false;

  /** @param {Source} source */
  constructor(source) {
    this.#source = source;
  }

  /** How much was read, from 0 to 1. */
  get share() {
    return this.#source.size ? this.#read / this.#source.size : 1;
  }

  /** Goes on to the next line, as far as it has been read. @returns {boolean} whether there is one */
  step() {
    const end = this.bytes.indexOf(LINE_FEED, this.#next);
    if (end < 0) return false;
    this.#take(end, end + 1);
    return true;
  }

  /** Reads on, where `step` found nothing. @returns {Promise<boolean>} whether there is a line */
  async more() {
    const source = this.#source;
    while (this.#read < source.size) {
      const rest = this.bytes.subarray(this.#next);
      if (rest.length > LONGEST) this.#refuse((say) => say.longLine(LONGEST));
      const piece = await bytesOf(source, this.#read, Math.min(this.#read + PIECE, source.size));
      // A file may have become shorter.
      if (piece.length === 0) break;
      if (piece.includes(NUL)) this.#refuse((say) => say.binary);
      this.#read += piece.length;
      this.bytes = new Uint8Array(rest.length + piece.length);
      this.bytes.set(rest);
      this.bytes.set(piece, rest.length);
      this.#next = this.number === 0 && BYTE_ORDER_MARK.every((byte, i) => byte === this.bytes[i]) ? BYTE_ORDER_MARK.length : 0;
      if (this.step()) return true;
    }
    const { length } = this.bytes;
    if (this.#next >= length) return false;
    this.isOpen = true;
    this.#take(length, length);
    return true;
  }

  /** @param {number} to @param {number} next */
  #take(to, next) {
    this.from = this.#next;
    this.to = to > this.from && this.bytes[to - 1] === RETURN ? to - 1 : to;
    this.#next = next;
    this.number += 1;
    if (this.to - this.from > LONGEST) throw new LogError({ file: this.#source.name, line: this.number }, (say) => say.longLine(LONGEST));
  }

  /** @param {(say: import('./refusal.js').Words['refused']) => string} reason @returns {never} of the line that is not yet there */
  #refuse(reason) {
    throw new LogError({ file: this.#source.name, line: this.number + 1 }, reason);
  }
}
