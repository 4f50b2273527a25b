/** Containers of messages: the interface that the readers of all formats share. */

import { LogError, readBytes, reasonOf, type Recording, type Source } from '../log.ts';

export interface Channel {
  topic: string;
  /** Message type as it was recorded. */
  type: string;
  /** Serialization of the messages: "cdr" (ROS 2), "ros1", or another one, which is not read. */
  encoding: string;
  count: number;
}

export interface Message {
  channel: Channel;
  /** Time of recording, s. */
  time: number;
  /** View of the block that contains the serialized message. All messages of a block share one view, because creating a view takes as long as reading a message. */
  block: DataView;
  /** Range of the message in the block. */
  start: number;
  end: number;
}

export type IsWanted = (channel: Channel) => boolean;
export type OnMessage = (message: Message) => void;
/** Callback after each block with the fraction of the file that has been read. If the callback returns true, reading stops. */
export type OnBlock = (fraction: number) => boolean | void;

/** Container of messages: one file, or several files of a recording. */
export type Container = Pick<MessageFile, 'format' | 'channels' | 'truncationReason' | 'damageReasons' | 'readMessages'>;

/** Base class of readers of message files. It has the channels of the file by id. */
export abstract class MessageFile {
  abstract readonly format: Recording['format'];
  /** Reason why the end of the file cannot be read; undefined for a complete file. */
  truncationReason: string | undefined;
  /** Reasons why damaged blocks were skipped, by the positions of the blocks. */
  readonly #damageByPosition = new Map<number, string>();
  protected readonly source: Source;
  protected readonly channelsById = new Map<number, Channel>();
  /** Chunks that the index of the file lists, each with the ids of its channels; undefined for a file without an index. */
  protected chunks: { position: number; ids: number[] }[] | undefined;

  constructor(source: Source) {
    this.source = source;
  }

  get channels() {
    return [...this.channelsById.values()];
  }

  get damageReasons() {
    return [...this.#damageByPosition.values()];
  }

  /** Reads blocks, and passes each message of the wanted channels to `onMessage`. Damaged blocks are skipped. */
  abstract readMessages(isWanted: IsWanted, onMessage: OnMessage, onBlock?: OnBlock): Promise<void>;

  /** Stores the reason why a block is damaged. An error while reading the file itself is thrown again. */
  protected noteDamage(position: number, error: unknown): void {
    if (error instanceof LogError) throw error;
    this.#damageByPosition.set(position, reasonOf(error));
  }

  /**
   * Reads the chunks that contain wanted messages, or all blocks in order if there is no index. Damaged blocks are recorded and skipped. `readBlock` calls
   * `setEnd` when it knows the end of its block. Without an index, reading stops at a damaged block whose end is unknown.
   */
  protected async readBlocks(start: number, isWanted: IsWanted, readBlock: (position: number, setEnd: (end: number) => void) => Promise<void>, onBlock?: OnBlock): Promise<void> {
    const { size } = this.source;
    const wantedIds = new Set([...this.channelsById].filter(([, channel]) => isWanted(channel)).map(([id]) => id));
    const chunks = this.chunks?.filter(({ ids }) => ids.some((id) => wantedIds.has(id)));
    this.truncationReason = undefined;
    for (let i = 0, nextPosition = start; chunks ? i < chunks.length : nextPosition < size; i++) {
      const position = chunks ? chunks[i].position : nextPosition;
      nextPosition = 0;
      await readBlock(position, (end) => (nextPosition = end)).catch((error) => {
        if (chunks || nextPosition > 0 || error instanceof LogError) this.noteDamage(position, error);
        else [this.truncationReason, nextPosition] = [reasonOf(error), size];
      });
      if (onBlock?.(chunks ? (i + 1) / chunks.length : nextPosition / size)) return;
    }
  }
}

/** Maximum size of a block in bytes. Recorders write blocks of one to four million bytes. */
export const MAX_BLOCK_BYTES = 2 ** 26;

/** Number of bytes in a piece, which is read at once, and number of pieces that are requested in advance. */
const [PIECE_BYTES, PIECES_AHEAD] = [2 ** 22, 3];

/** Returns a reader of bytes at increasing positions. The reader requests the next pieces in advance, which saves a quarter of the reading time in a browser. */
export function createAheadReader(source: Source): (start: number, requestedEnd: number) => Promise<Uint8Array> {
  const pieces = new Map<number, Promise<Uint8Array>>();
  let lastPieceIndex = -1;
  return async (start, requestedEnd) => {
    const end = Math.min(requestedEnd, source.size);
    const firstPieceIndex = Math.floor(start / PIECE_BYTES);
    const piecesAhead = firstPieceIndex <= lastPieceIndex + 1 ? PIECES_AHEAD : 0;
    lastPieceIndex = Math.max(firstPieceIndex, Math.floor((end - 1) / PIECE_BYTES));
    for (const i of pieces.keys()) if (i < firstPieceIndex) pieces.delete(i);
    for (let i = firstPieceIndex; i <= lastPieceIndex + piecesAhead && i * PIECE_BYTES < source.size; i++) {
      if (pieces.has(i)) continue;
      const piece = readBytes(source, i * PIECE_BYTES, Math.min((i + 1) * PIECE_BYTES, source.size));
      // If reading a piece fails, the error is reported only when a caller needs that piece.
      piece.catch(() => {});
      pieces.set(i, piece);
    }
    const neededPartOf = async (i: number) => ((await pieces.get(i)) ?? new Uint8Array()).subarray(Math.max(start - i * PIECE_BYTES, 0), end - i * PIECE_BYTES);
    if (lastPieceIndex === firstPieceIndex) return neededPartOf(firstPieceIndex);
    const bytes = new Uint8Array(end - start);
    for (let i = firstPieceIndex; i <= lastPieceIndex; i++) bytes.set(await neededPartOf(i), Math.max(i * PIECE_BYTES - start, 0));
    return bytes;
  };
}

export const dataViewOf = ({ buffer, byteOffset, byteLength }: Uint8Array) => new DataView(buffer, byteOffset, byteLength);

/** Returns an unsigned number of eight bytes. It is exact below 2^53, and rounded above. */
export const readUint53 = (view: DataView, position: number) => view.getUint32(position, true) + 2 ** 32 * view.getUint32(position + 4, true);
