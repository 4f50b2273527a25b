/** Conversion of states and bytes to text, and back. */

import { createRefusalError } from './checks.ts';

/** Maximum size of an unpacked state, in bytes, because a link may be malicious. The largest grid takes 11.2 million. */
const MAX_UNPACKED_BYTES = 12_000_000;

/** Returns a state as compressed JSON, written with letters, digits, - and _. */
export async function packJson(figureState: object): Promise<string> {
  const compressedStream = new Blob([JSON.stringify(figureState)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  const compressedBytes = new Uint8Array(await new Response(compressedStream).arrayBuffer());
  return toBase64(compressedBytes).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/** Returns the state that `packJson` packed into a text; throws a RangeError for any other text. */
export async function unpackJson(packedText: string): Promise<unknown> {
  try {
    const bytes = fromBase64(packedText.replaceAll('-', '+').replaceAll('_', '/'));
    let byteCount = 0;
    const checkSize = (byteChunk: Uint8Array, streamController: TransformStreamDefaultController) => {
      byteCount += byteChunk.length;
      if (byteCount > MAX_UNPACKED_BYTES) streamController.error();
      else streamController.enqueue(byteChunk);
    };
    const decompressedStream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    return await new Response(decompressedStream.pipeThrough(new TransformStream({ transform: checkSize }))).json();
  } catch {
    throw createRefusalError('state in the address', packedText, 'what shareLink gives');
  }
}

export function toBase64(bytes: Uint8Array & { toBase64?: () => string }) {
  // The native `toBase64`, which only newer browsers have, is a hundred times as fast as `btoa`.
  return bytes.toBase64?.() ?? btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
}

/** Returns the bytes of a base64 text; throws a DOMException or SyntaxError for any other text. */
export function fromBase64(packedText: string) {
  const { fromBase64: nativeFromBase64 } = Uint8Array as { fromBase64?: (packedText: string) => Uint8Array<ArrayBuffer> };
  return nativeFromBase64 ? nativeFromBase64.call(Uint8Array, packedText) : Uint8Array.from(atob(packedText), (binaryCharacter) => binaryCharacter.charCodeAt(0));
}
