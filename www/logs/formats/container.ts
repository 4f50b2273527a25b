/** Containers of messages: the interface that the readers of all formats share. */

import type { Recording, Source } from '../log.ts';
import { bytesOf } from '../log-error.ts';

/** Topic as one node published it. */
export interface Channel {
  topic: string;
  /** Message type as it was recorded. */
  type: string;
  /** Serialization: "cdr" of ROS 2, "ros1", or another. */
  encoding: string;
  /** Name of the node, or a number of the container's own. */
  publisher: string;
  /** Number of messages. */
  count: number;
}

export interface Message {
  channel: Channel;
  /** Time of recording. */
  seconds: number;
  nanoseconds: number;
  data: Uint8Array;
}

export interface Container {
  format: Recording['format'];
  channels: Channel[];
  /** Reasons why damaged blocks were skipped, by the positions of the blocks. */
  damage: Map<number, string>;
  /** True if the end of the file is missing. */
  cutShort: boolean;
  /** Names of missing split files of the recording. */
  missing: string[];
  /** Passes on the messages of channels, block by block. Stops after a block if `onProgress` returns true. */
  read(isWanted: (channel: Channel) => boolean, each: (message: Message) => void, onProgress?: (share: number) => boolean | void): Promise<void>;
}

/** Maximum size of a block in bytes: recorders write one to four million. */
export const MAX_BLOCK = 2 ** 26;

/** Number of bytes that are read at once. */
const PIECE_BYTES = 2 ** 22;

/**
 * Returns a function that reads bytes of a source. Positions must increase from call to call. While positions follow each other, the next
 * piece is read during the work on the present one.
 */
export function readAhead(source: Source): (from: number, to: number) => Promise<Uint8Array> {
  let start = 0;
  let piece: Uint8Array = new Uint8Array();
  let next: Promise<Uint8Array> | undefined;
  const read = (from: number, to = from) => bytesOf(source, from, Math.min(Math.max(to, from + PIECE_BYTES), source.size));
  return async (from, to) => {
    const end = start + piece.length;
    if (from < start || to > end) {
      const follows = from >= start && from <= end;
      const isRead = follows && next && to <= end + PIECE_BYTES;
      piece = isRead ? joined(piece.subarray(from - start), await next!) : await read(from, to);
      start = from;
      next = follows ? read(start + piece.length) : undefined;
      // If the piece is never needed, an error of its read has no effect.
      next?.catch(() => {});
    }
    return piece.subarray(from - start, to - start);
  };
}

function joined(first: Uint8Array, second: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(first.length + second.length);
  bytes.set(first);
  bytes.set(second, first.length);
  return bytes;
}

export const viewOf = ({ buffer, byteOffset, byteLength }: Uint8Array) => new DataView(buffer, byteOffset, byteLength);

/** Returns a number of eight bytes that is below 2^53. */
export const uint53 = (view: DataView, at: number) => view.getUint32(at, true) + 2 ** 32 * view.getUint32(at + 4, true);

/** Splits a time in nanoseconds into seconds and nanoseconds, by digits of 16 bits. A BigInt would take as long as the rest of a message. */
export function stampAt(view: DataView, at: number) {
  let [seconds, rest] = [0, view.getUint32(at + 4, true)];
  for (const from of [at + 2, at]) {
    rest = rest * 2 ** 16 + view.getUint16(from, true);
    seconds = seconds * 2 ** 16 + Math.floor(rest / 1e9);
    rest %= 1e9;
  }
  return { seconds, nanoseconds: rest };
}
