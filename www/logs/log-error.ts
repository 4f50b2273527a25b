/** Errors of logs, and the bytes that logs are read from. */

import { english } from './en.ts';
import type { Question, Source } from './log.ts';

export type Words = typeof english;

export interface ErrorPlace {
  file: string;
  /** Number of a line, or of a message of the topic, from 1. */
  line?: number;
  topic?: string;
}

/** Maximum number of quoted characters in a sentence: of a name or value, and of a library's message. */
const [MAX_QUOTED, MAX_REASON] = [40, 100];

/** Error of a log. Its message is one sentence that names the file, the line or topic, the value, and what is expected. */
export class LogError extends Error {
  place: ErrorPlace;
  /** Question whose answer resolves the error. */
  ask?: Question;
  /** Returns the message in the language of the given words. */
  sentence: (texts: Words) => string;

  /** @param reason returns the end of the sentence in the language of the given words */
  constructor(place: ErrorPlace, reason: (texts: Words['refused']) => string, ask?: Question) {
    const sentenceOf = (texts: Words) => `${texts.place(truncate(place.file), place.line ?? 0, truncate(place.topic ?? ''))}: ${reason(texts.refused)}`;
    super(sentenceOf(english));
    this.name = 'LogError';
    this.place = place;
    this.ask = ask;
    this.sentence = sentenceOf;
  }
}

/** Shortens a text to one line for quotation in a sentence. */
export function truncate(text: string, maxLength = MAX_QUOTED): string {
  // oxlint-disable-next-line no-control-regex
  const shortLine = text.slice(0, maxLength + 1).replaceAll(/[\0-\x1f\x7f-\x9f\u2028\u2029]/g, '\ufffd');
  return shortLine.length > maxLength ? `${shortLine.slice(0, maxLength)}…` : shortLine;
}

/** Returns the message of a library's error, for a sentence. */
export function reasonOf(error: unknown): string {
  const message = error instanceof Error ? error.message : String(error);
  return truncate(message.replace(/ \[(library=[^\]]*|no header)\]$/, ''), MAX_REASON);
}

/** Returns a text with the first eight names of a list, for a sentence. */
export function listNames(names: string[]): string {
  const maxNames = 8;
  return [...names.slice(0, maxNames).map((name) => truncate(name)), ...(names.length > maxNames ? ['…'] : [])].join(', ');
}

/** Reads bytes of a source; rejects with a LogError if the file has been moved or changed since it was chosen. */
export async function readBytes(source: Source, from: number, to: number): Promise<Uint8Array<ArrayBuffer>> {
  try {
    return new Uint8Array(await source.slice(from, to).arrayBuffer());
  } catch (error) {
    const reason = error instanceof Error ? error.name : String(error);
    throw new LogError({ file: source.name }, (texts) => texts.gone(reason));
  }
}
