/** Bytes and plain data as text. */

import { refusal } from './checks.js';

/**
 * Bytes of a state at most when it is unpacked: a link is anybody's, and a short text may say "a billion
 * times a". The outlines of the largest maps that are of use take a tenth of it.
 */
const MAX_BYTES = 4_000_000;

/**
 * @param {object} data
 * @returns {Promise<string>} letters, digits, - and _
 */
export async function pack(data) {
  const text = new Blob([JSON.stringify(data)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  const bytes = new Uint8Array(await new Response(text).arrayBuffer());
  return toBase64(bytes).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/**
 * @param {string} text
 * @returns {Promise<unknown>} what was packed
 * @throws {RangeError} if it is no such text
 */
export async function unpack(text) {
  try {
    const bytes = fromBase64(text.replaceAll('-', '+').replaceAll('_', '/'));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    const reader = stream.getReader();
    /** @type {BlobPart[]} */
    const parts = [];
    for (let size = 0; ; ) {
      const { done, value } = await reader.read();
      if (done) break;
      size += value.byteLength;
      if (size > MAX_BYTES) throw new RangeError('too long');
      parts.push(value);
    }
    return JSON.parse(await new Blob(parts).text());
  } catch {
    throw refusal('state in the address', text, 'what shareLink gives');
  }
}

/** @param {Uint8Array} bytes */
export function toBase64(bytes) {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}

/**
 * @param {string} text
 * @throws {DOMException} if it is not base64
 */
export function fromBase64(text) {
  return Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}
