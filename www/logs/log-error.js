/** Errors of logs, and the bytes that logs are read from. */

import { log as english } from './en.js';

/**
 * @typedef {typeof english} Words
 *
 * @import { Question, Source } from './log.ts'
 *
 * @typedef {object} Place position in a source, with a line or a topic but not both
 * @property {string} file
 * @property {number} [line] from 1
 * @property {string} [topic] of a recording
 */

/** Most characters that a sentence quotes of a name or value, and of a library's message. */
const [QUOTED, REASON] = [40, 100];

/** Error with one sentence that names the file, the line or topic, the value, and what is expected. */
export class LogError extends Error {
  /**
   * @param {Place} place
   * @param {(say: Words['refused']) => string} reason in the language of the page when the error is shown
   * @param {Question} [ask] question whose answer resolves the error
   */
  constructor(place, reason, ask) {
    const sentence = (/** @type {Words} */ say) =>
      `${say.place(cut(place.file), place.line ?? 0, cut(place.topic ?? ''))}: ${reason(say.refused)}`;
    super(sentence(english));
    this.name = 'LogError';
    this.place = place;
    this.ask = ask;
    this.sentence = sentence;
  }
}

/**
 * Shortens a text to one line that a sentence can quote.
 *
 * @param {string} text
 * @param {number} [most] characters
 */
export function cut(text, most = QUOTED) {
  // oxlint-disable-next-line no-control-regex
  const line = text.slice(0, most + 1).replaceAll(/[\0-\x1f\x7f-\x9f\u2028\u2029]/g, '\ufffd');
  return line.length > most ? `${line.slice(0, most)}…` : line;
}

/** Message of a library's error, for a sentence. @param {unknown} error */
export function reasonOf(error) {
  const message = error instanceof Error ? error.message : String(error);
  return cut(message.replace(/ \[(library=[^\]]*|no header)\]$/, ''), REASON);
}

/** First few names of a list, for a sentence. @param {string[]} names */
export function listed(names) {
  const most = 8;
  return [...names.slice(0, most).map((name) => cut(name)), ...(names.length > most ? ['…'] : [])].join(', ');
}

/**
 * Reads bytes of a source.
 *
 * @param {Source} source
 * @param {number} from
 * @param {number} to
 * @returns {Promise<Uint8Array<ArrayBuffer>>} rejects with a LogError if the file has been moved or changed since it was chosen
 */
export async function bytesOf(source, from, to) {
  try {
    return new Uint8Array(await source.slice(from, to).arrayBuffer());
  } catch (error) {
    const reason = error instanceof Error ? error.name : String(error);
    throw new LogError({ file: source.name }, (say) => say.gone(reason));
  }
}
