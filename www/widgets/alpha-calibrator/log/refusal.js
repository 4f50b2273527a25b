/** Why a log is refused, and what a source of bytes is. */

import { log as english } from './en.js';

/**
 * @typedef {typeof english} Words
 *
 * @typedef {object} Source a File, or what reads one from a disk
 * @property {string} name
 * @property {number} size in bytes
 * @property {(from: number, to: number) => { arrayBuffer(): Promise<ArrayBuffer> }} slice
 *
 * @typedef {object} Place where in a source; of line and topic at most one
 * @property {string} file
 * @property {number} [line] from 1
 * @property {string} [topic] of a recording
 */

/** Characters of a name or a value that a sentence quotes, and of a reason that a library gave. */
const [QUOTED, REASON] = [40, 100];

/** One sentence that names the file, the line or topic, the value, and what is expected. */
export class LogError extends Error {
  /**
   * @param {Place} place
   * @param {(say: Words['refused']) => string} reason in the words of the time when it is shown
   */
  constructor(place, reason) {
    const sentence = (/** @type {Words} */ say) =>
      `${say.place(cut(place.file), place.line ?? 0, cut(place.topic ?? ''))}: ${reason(say.refused)}`;
    super(sentence(english));
    this.name = 'LogError';
    this.place = place;
    this.sentence = sentence;
  }
}

/**
 * As much of a text as a sentence quotes, on one line.
 *
 * @param {string} text
 * @param {number} [most] characters
 */
export function cut(text, most = QUOTED) {
  // eslint-disable-next-line no-control-regex
  const line = text.slice(0, most + 1).replaceAll(/[\0-\x1f\x7f-\x9f\u2028\u2029]/g, '\ufffd');
  return line.length > most ? `${line.slice(0, most)}…` : line;
}

/** What a library said, as the reason of a sentence. @param {unknown} error */
export function reasonOf(error) {
  const said = error instanceof Error ? error.message : String(error);
  return cut(said.replace(/ \[(library=[^\]]*|no header)\]$/, ''), REASON);
}

/**
 * Names in a list that a sentence quotes: the first few.
 *
 * @param {string[]} names
 */
export function listed(names) {
  const most = 8;
  return [...names.slice(0, most).map((name) => cut(name)), ...(names.length > most ? ['…'] : [])].join(', ');
}

/**
 * @param {Source} source
 * @param {number} from
 * @param {number} to
 * @returns {Promise<Uint8Array<ArrayBuffer>>} rejects with a LogError where the file has gone since it was chosen
 */
export async function bytesOf(source, from, to) {
  try {
    return new Uint8Array(await source.slice(from, to).arrayBuffer());
  } catch (error) {
    const reason = error instanceof Error ? error.name : String(error);
    throw new LogError({ file: source.name }, (say) => say.gone(reason));
  }
}
