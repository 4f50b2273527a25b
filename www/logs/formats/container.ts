/** Containers of messages: the interface that the readers of all formats share. */

import { LogError, readBytes, reasonOf, type Recording, type SourceFile } from '../log.ts';

export interface TopicChannel {
  topicName: string;
  /** Message type as it was recorded. */
  messageType: string;
  /** Serialization of the messages: "cdr" (ROS 2), "ros1", or another one, which is not read. */
  encoding: string;
  messageCount: number;
}

export interface RecordedMessage {
  topicChannel: TopicChannel;
  /** Time of recording, s. */
  recordTime: number;
  /** View of the block that contains the serialized message. All messages of a block share one view, because creating a view takes as long as reading a message. */
  blockView: DataView;
  /** Range of the message in the block. */
  messageStart: number;
  messageEnd: number;
}

export type IsWanted = (topicChannel: TopicChannel) => boolean;
export type OnMessage = (recordedMessage: RecordedMessage) => void;
/** Callback after each block with the fraction of the file that has been read. If the callback returns true, reading stops. */
export type OnBlock = (progressFraction: number) => boolean | void;

/** Container of messages: one file, or several files of a recording. */
export type MessageContainer = Pick<MessageFile, 'recordingFormat' | 'topicChannels' | 'truncationReason' | 'damageReasons' | 'readMessages'>;

/** Base class of readers of message files. It has the channels of the file by id. */
export abstract class MessageFile {
  abstract readonly recordingFormat: Recording['recordingFormat'];
  /** Reason why the end of the file cannot be read; undefined for a complete file. */
  truncationReason: string | undefined;
  /** Reasons why damaged blocks were skipped, by the positions of the blocks. */
  readonly #damageByPosition = new Map<number, string>();
  protected readonly sourceFile: SourceFile;
  protected readonly channelsById = new Map<number, TopicChannel>();
  /** Chunks that the index of the file lists, each with the ids of its channels; undefined for a file without an index. */
  protected indexedChunks: { chunkStart: number; channelIds: number[] }[] | undefined;

  constructor(sourceFile: SourceFile) {
    this.sourceFile = sourceFile;
  }

  get topicChannels() {
    return [...this.channelsById.values()];
  }

  get damageReasons() {
    return [...this.#damageByPosition.values()];
  }

  /** Reads blocks, and passes each message of the wanted channels to `onMessage`. Damaged blocks are skipped. */
  abstract readMessages(isWanted: IsWanted, onMessage: OnMessage, onBlock?: OnBlock): Promise<void>;

  /** Stores the reason why a block is damaged. An error while reading the file itself is thrown again. */
  protected noteDamage(blockStart: number, error: unknown): void {
    if (error instanceof LogError) throw error;
    this.#damageByPosition.set(blockStart, reasonOf(error));
  }

  /**
   * Reads the chunks that contain wanted messages, or all blocks in order if there is no index. Damaged blocks are recorded and skipped. `readBlock` calls
   * `setEnd` when it knows the end of its block. Without an index, reading stops at a damaged block whose end is unknown.
   */
  protected async readBlocks(firstBlockStart: number, isWanted: IsWanted, readBlock: (blockStart: number, setEnd: (blockEnd: number) => void) => Promise<void>, onBlock?: OnBlock): Promise<void> {
    const { size: fileSize } = this.sourceFile;
    const wantedIds = new Set([...this.channelsById].filter(([, topicChannel]) => isWanted(topicChannel)).map(([id]) => id));
    const wantedChunks = this.indexedChunks?.filter(({ channelIds }) => channelIds.some((id) => wantedIds.has(id)));
    this.truncationReason = undefined;
    for (let i = 0, nextPosition = firstBlockStart; wantedChunks ? i < wantedChunks.length : nextPosition < fileSize; i++) {
      const blockStart = wantedChunks ? wantedChunks[i].chunkStart : nextPosition;
      nextPosition = 0;
      await readBlock(blockStart, (blockEnd) => (nextPosition = blockEnd)).catch((error) => {
        if (wantedChunks || nextPosition > 0 || error instanceof LogError) this.noteDamage(blockStart, error);
        else [this.truncationReason, nextPosition] = [reasonOf(error), fileSize];
      });
      if (onBlock?.(wantedChunks ? (i + 1) / wantedChunks.length : nextPosition / fileSize)) return;
    }
  }
}

/** Maximum size of a block in bytes. Recorders write blocks of one to four million bytes. */
export const MAX_BLOCK_BYTES = 2 ** 26;

/** Number of bytes in a piece, which is read at once, and number of pieces that are requested in advance. */
const [PIECE_BYTES, PREFETCHED_PIECE_COUNT] = [2 ** 22, 3];

/** Returns a reader of bytes at increasing positions. The reader requests the next pieces in advance, which saves a quarter of the reading time in a browser. */
export function createAheadReader(sourceFile: SourceFile): (byteStart: number, requestedEnd: number) => Promise<Uint8Array> {
  const pieceReadPromises = new Map<number, Promise<Uint8Array>>();
  let lastPieceIndex = -1;
  return async (byteStart, requestedEnd) => {
    const byteEnd = Math.min(requestedEnd, sourceFile.size);
    const firstPieceIndex = Math.floor(byteStart / PIECE_BYTES);
    const piecesAhead = firstPieceIndex <= lastPieceIndex + 1 ? PREFETCHED_PIECE_COUNT : 0;
    lastPieceIndex = Math.max(firstPieceIndex, Math.floor((byteEnd - 1) / PIECE_BYTES));
    for (const i of pieceReadPromises.keys()) if (i < firstPieceIndex) pieceReadPromises.delete(i);
    for (let i = firstPieceIndex; i <= lastPieceIndex + piecesAhead && i * PIECE_BYTES < sourceFile.size; i++) {
      if (pieceReadPromises.has(i)) continue;
      const pieceReadPromise = readBytes(sourceFile, i * PIECE_BYTES, Math.min((i + 1) * PIECE_BYTES, sourceFile.size));
      // If reading a piece fails, the error is reported only when a caller needs that piece.
      pieceReadPromise.catch(() => {});
      pieceReadPromises.set(i, pieceReadPromise);
    }
    const neededPartOf = async (i: number) => ((await pieceReadPromises.get(i)) ?? new Uint8Array()).subarray(Math.max(byteStart - i * PIECE_BYTES, 0), byteEnd - i * PIECE_BYTES);
    if (lastPieceIndex === firstPieceIndex) return neededPartOf(firstPieceIndex);
    const bytes = new Uint8Array(byteEnd - byteStart);
    for (let i = firstPieceIndex; i <= lastPieceIndex; i++) bytes.set(await neededPartOf(i), Math.max(i * PIECE_BYTES - byteStart, 0));
    return bytes;
  };
}

export const dataViewOf = ({ buffer, byteOffset, byteLength }: Uint8Array) => new DataView(buffer, byteOffset, byteLength);

/** Returns an unsigned number of eight bytes. It is exact below 2^53, and rounded above. */
export const readUint53 = (dataView: DataView, byteOffset: number) => dataView.getUint32(byteOffset, true) + 2 ** 32 * dataView.getUint32(byteOffset + 4, true);
