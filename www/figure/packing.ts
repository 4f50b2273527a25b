/** Conversion of bytes and plain data to text and back. */

import { refusalError } from './checks.ts';

/** Maximum size of an unpacked state, in bytes, because a link may be malicious. The largest grid takes 11.2 million. */
const MAX_BYTES = 12_000_000;

/** Returns compressed data as letters, digits, - and _. */
export async function packJson(data: object): Promise<string> {
  const compressedStream = new Blob([JSON.stringify(data)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  const compressedBytes = new Uint8Array(await new Response(compressedStream).arrayBuffer());
  return toBase64(compressedBytes).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/** Returns the data of a packed text; throws a RangeError for any other text. */
export async function unpack(text: string): Promise<unknown> {
  try {
    const bytes = fromBase64(text.replaceAll('-', '+').replaceAll('_', '/'));
    const chunks = [];
    let byteCount = 0;
    const decompressedStream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    for (const reader = decompressedStream.getReader(); ; ) {
      const { done, value } = await reader.read();
      if (done) break;
      byteCount += value.length;
      if (byteCount > MAX_BYTES) throw new RangeError();
      chunks.push(value);
    }
    return JSON.parse(await new Blob(chunks).text());
  } catch {
    throw refusalError('state in the address', text, 'what shareLink gives');
  }
}

export function toBase64(bytes: Uint8Array & { toBase64?: () => string }) {
  // The method of newer browsers is a hundred times as fast.
  return bytes.toBase64?.() ?? btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
}

/** Returns the bytes; throws a DOMException or SyntaxError for other text. */
export function fromBase64(text: string) {
  const { fromBase64: nativeFromBase64 } = Uint8Array as { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> };
  return nativeFromBase64 ? nativeFromBase64.call(Uint8Array, text) : Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}
