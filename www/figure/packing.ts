/** Bytes and plain data as text. */

import { refusal } from './checks.ts';

/**
 * Bytes of a state at most when it is unpacked: a link is anybody's, and a short text may say "a billion
 * times a". The largest grid has 11.2 million.
 */
const MAX_BYTES = 12_000_000;

/** @returns letters, digits, - and _ */
export async function pack(data: object): Promise<string> {
  const text = new Blob([JSON.stringify(data)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  const bytes = new Uint8Array(await new Response(text).arrayBuffer());
  return toBase64(bytes).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/**
 * @returns what was packed
 * @throws {RangeError} if it is no such text
 */
export async function unpack(text: string): Promise<unknown> {
  try {
    const bytes = fromBase64(text.replaceAll('-', '+').replaceAll('_', '/'));
    const parts = [];
    let size = 0;
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    for (const reader = stream.getReader(); ; ) {
      const { done, value } = await reader.read();
      if (done) break;
      size += value.length;
      if (size > MAX_BYTES) throw new RangeError();
      parts.push(value);
    }
    return JSON.parse(await new Blob(parts).text());
  } catch {
    throw refusal('state in the address', text, 'what shareLink gives');
  }
}

/** As many arguments as any engine takes. */
const ARGUMENTS = 4096;

export function toBase64(bytes: Uint8Array & { toBase64?: () => string }) {
  // In a hundredth of the time, where the browser has it.
  if (bytes.toBase64) return bytes.toBase64();
  let text = '';
  for (let at = 0; at < bytes.length; at += ARGUMENTS) text += String.fromCharCode(...bytes.subarray(at, at + ARGUMENTS));
  return btoa(text);
}

/** @throws {DOMException | SyntaxError} if it is not base64 */
export function fromBase64(text: string) {
  const { fromBase64: native } = Uint8Array as { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> };
  if (native) return native.call(Uint8Array, text);
  return Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}
