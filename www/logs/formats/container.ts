/** Containers of messages: the interface that the readers of all formats share. */

import type { Recording, Source } from '../log.ts';
import { LogError, readBytes, reasonOf } from '../log-error.ts';

/** Topic of one publishing node. */
export interface Channel {
  topic: string;
  /** Message type as it was recorded. */
  type: string;
  /** Serialization: "cdr" of ROS 2, "ros1", or another. */
  encoding: string;
  /** Number of messages. */
  count: number;
}

export interface Message {
  channel: Channel;
  /** Time of recording, s. */
  time: number;
  /** View of the block that contains the serialized message. Messages share it, because creating a view takes as long as reading a message. */
  block: DataView;
  /** Range of the message in the block. */
  from: number;
  to: number;
}

export type IsWanted = (channel: Channel) => boolean;
export type OnMessage = (message: Message) => void;

export interface Container {
  format: Recording['format'];
  channels: Channel[];
  /** Reason why the end of the file cannot be read; undefined for a complete file. */
  cutReason: string | undefined;
  /**
   * Passes on the messages of channels, block by block. Stops after a block if `onProgress` returns true. Rejects with a LogError if a block is
   * damaged, unless it is at the end of a file that was not closed.
   */
  read(isWanted: IsWanted, onMessage: OnMessage, onProgress?: (share: number) => boolean | void): Promise<void>;
}

/** Base class of files of messages, with their channels by id. */
export abstract class MessageFile<Id> {
  abstract readonly format: Recording['format'];
  cutReason: string | undefined;
  protected readonly source: Source;
  protected readonly channelsById = new Map<Id, Channel>();

  constructor(source: Source) {
    this.source = source;
  }

  get channels() {
    return [...this.channelsById.values()];
  }

  /** Returns the error of a damaged block. An error of reading the file itself stays. */
  protected damagedError(error: unknown): LogError {
    return error instanceof LogError ? error : new LogError({ file: this.source.name }, (say) => say.damaged(reasonOf(error), this.format));
  }

  /** Notes the damage at which a file ends that was not closed. An error of reading the file itself is thrown again. */
  protected noteEnd(error: unknown): void {
    if (error instanceof LogError) throw error;
    this.cutReason = reasonOf(error);
  }
}

/** Maximum size of a block in bytes. Recorders write one to four million. */
export const MAX_BLOCK_BYTES = 2 ** 26;

/** Size of the pieces that are read at once, bytes. */
const PIECE_BYTES = 2 ** 22;

/** Returns a function that reads bytes of a source in pieces. Most positions must increase from call to call. */
export function readInPieces(source: Source): (from: number, to: number) => Promise<Uint8Array> {
  let piece = new Uint8Array();
  let pieceStart = 0;
  return async (from, to) => {
    if (from < pieceStart || to > pieceStart + piece.length) {
      piece = await readBytes(source, from, Math.min(Math.max(to, from + PIECE_BYTES), source.size));
      pieceStart = from;
    }
    return piece.subarray(from - pieceStart, to - pieceStart);
  };
}

export const dataViewOf = ({ buffer, byteOffset, byteLength }: Uint8Array) => new DataView(buffer, byteOffset, byteLength);

/** Returns an unsigned number of eight bytes. It is exact below 2^53, and rounded above. */
export const uint53 = (view: DataView, at: number) => view.getUint32(at, true) + 2 ** 32 * view.getUint32(at + 4, true);
