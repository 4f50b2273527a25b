/** Conversion of states and bytes to text, and back. */

import { createRefusalError } from './checks.ts';

/** Maximum size of an unpacked state, in bytes, because a link may be malicious. The largest grid takes 11.2 million. */
const MAX_UNPACKED_BYTES = 12_000_000;

/** Returns a state as compressed JSON, written with letters, digits, - and _. */
export async function packJson(state: object): Promise<string> {
  const compressedStream = new Blob([JSON.stringify(state)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  const compressedBytes = new Uint8Array(await new Response(compressedStream).arrayBuffer());
  return toBase64(compressedBytes).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/** Returns the state that `packJson` packed into a text; throws a RangeError for any other text. */
export async function unpackJson(text: string): Promise<unknown> {
  try {
    const bytes = fromBase64(text.replaceAll('-', '+').replaceAll('_', '/'));
    let byteCount = 0;
    const checkSize = (chunk: Uint8Array, controller: TransformStreamDefaultController) => {
      byteCount += chunk.length;
      if (byteCount > MAX_UNPACKED_BYTES) controller.error();
      else controller.enqueue(chunk);
    };
    const decompressedStream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    return await new Response(decompressedStream.pipeThrough(new TransformStream({ transform: checkSize }))).json();
  } catch {
    throw createRefusalError('state in the address', text, 'what shareLink gives');
  }
}

export function toBase64(bytes: Uint8Array & { toBase64?: () => string }) {
  // The native `toBase64`, which only newer browsers have, is a hundred times as fast as `btoa`.
  return bytes.toBase64?.() ?? btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
}

/** Returns the bytes of a base64 text; throws a DOMException or SyntaxError for any other text. */
export function fromBase64(text: string) {
  const { fromBase64: nativeFromBase64 } = Uint8Array as { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> };
  return nativeFromBase64 ? nativeFromBase64.call(Uint8Array, text) : Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}
