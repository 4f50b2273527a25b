/** Topics and messages of rosbag2's SQLite databases. https://www.sqlite.org/fileformat.html */

import { LogError, readBytes, type SourceFile } from '../log.ts';
import { MessageFile, createAheadReader, dataViewOf, type MessageContainer, type IsWanted, type OnBlock, type OnMessage } from './container.ts';
import { loadZstd } from './decompression.ts';

/** First byte of pages with rows of a table, and largest first byte of all other pages: index pages, interior pages, and overflow pages of long rows. */
const [LEAF_PAGE_TYPE, MAX_OTHER_PAGE_TYPE] = [13, 10];

const HEADER_BYTES = 100;

/** Maximum size of a row, bytes. The largest messages are point clouds and images. */
const MAX_ROW_BYTES = 2 ** 28;

interface TableRow {
  /** Bytes of the row on the leaf page. All other bytes are on overflow pages. */
  localBytes: Uint8Array;
  /** Number of bytes of the row, including those on overflow pages. */
  byteCount: number;
  /** Number of the first overflow page; 0 if there is none. */
  overflowPage: number;
  id: number;
  rowValues: RowValue[];
}

/** Value in a row: its SQLite serial type, and the range of its bytes. */
interface RowValue { serialType: number; valueStart: number; valueEnd: number }

const isInteger = (serialType: number) => serialType > 0 && serialType < 10;
const isBlob = (serialType: number) => serialType >= 12 && serialType % 2 === 0;
const isText = (serialType: number) => serialType >= 13 && serialType % 2 === 1;
const isRowId = (serialType: number) => serialType === 0;

/** Types of the first columns of tables: messages (id, topic, time, data), topics (id, name, type, serialization), and the list of all tables. */
const TABLE_COLUMNS = { messages: [isRowId, isInteger, isInteger, isBlob], topics: [isRowId, isText, isText, isText], tables: [isText, isText, isText, isInteger] };

const isRowOfTable = (tableName: keyof typeof TABLE_COLUMNS, { rowValues }: TableRow) => TABLE_COLUMNS[tableName].every((hasType, i) => hasType(rowValues[i]?.serialType));

export async function openSqlite(sourceFile: SourceFile): Promise<MessageContainer> {
  await loadZstd();
  const databaseFile = new Rosbag2(sourceFile);
  await databaseFile.readSchema();
  return databaseFile;
}

class Rosbag2 extends MessageFile {
  readonly recordingFormat = 'sqlite';
  #pageSize = 0;
  /** Number of bytes in a page, without the bytes that are reserved at its end. */
  #usableBytes = 0;
  #tableNames = new Set<string>();
  #readBytesAt = createAheadReader(this.sourceFile);

  async readSchema(): Promise<void> {
    const headerView = dataViewOf(await readBytes(this.sourceFile, 0, HEADER_BYTES));
    const createNotRosbag2Error = () => new LogError({ fileName: this.sourceFile.name }, (errorReasons) => errorReasons.foreignDatabaseReason);
    if (headerView.byteLength < HEADER_BYTES) {
      this.truncationReason = 'its header is cut short';
      return;
    }
    this.#pageSize = headerView.getUint16(16) === 1 ? 65536 : headerView.getUint16(16);
    this.#usableBytes = this.#pageSize - headerView.getUint8(20);
    if (this.#usableBytes < 480) throw createNotRosbag2Error();
    // The header has the number of pages of the last complete transaction. If the file has another size, the recorder did not close it.
    const pageCount = headerView.getUint32(28);
    if (pageCount > 0 && pageCount * this.#pageSize !== this.sourceFile.size) this.truncationReason = 'the recorder did not close it';
    const countsById = new Map<number, number>();
    await this.#visitRows((tableRow) => {
      if (!isRowOfTable('messages', tableRow)) return this.#addTopic(tableRow);
      const topicId = integerOf(tableRow.localBytes, tableRow.rowValues[1]);
      countsById.set(topicId, (countsById.get(topicId) ?? 0) + 1);
      return undefined;
    });
    for (const [id, topicChannel] of this.channelsById) topicChannel.messageCount = countsById.get(id) ?? 0;
    if (!['topics', 'messages'].every((tableName) => this.#tableNames.has(tableName)) && !this.truncationReason) throw createNotRosbag2Error();
  }

  /** Stores the topic from a row of the table `topics`, or the table name from a row of the list of all tables. Ignores other rows. */
  async #addTopic(tableRow: TableRow): Promise<void> {
    const isTable = isRowOfTable('tables', tableRow);
    if (!isTable && !isRowOfTable('topics', tableRow)) return;
    const bytes = await this.#readWholeRow(tableRow);
    const [, topicName, messageType, encoding] = tableRow.rowValues.map(({ valueStart, valueEnd }) => new TextDecoder().decode(bytes.subarray(valueStart, valueEnd)));
    if (isTable) this.#tableNames.add(topicName);
    // Names of topics start with a slash. Other rows with the same columns are definitions of message types.
    else if (topicName.startsWith('/')) this.channelsById.set(tableRow.id, { topicName, messageType, encoding, messageCount: 0 });
  }

  async readMessages(isWanted: IsWanted, onMessage: OnMessage, onProgress?: OnBlock): Promise<void> {
    const wantedChannels = new Map([...this.channelsById].filter(([, topicChannel]) => isWanted(topicChannel)));
    await this.#visitRows((tableRow) => {
      const topicChannel = isRowOfTable('messages', tableRow) ? wantedChannels.get(integerOf(tableRow.localBytes, tableRow.rowValues[1])) : undefined;
      if (!topicChannel) return undefined;
      const passMessage = (bytes: Uint8Array) => {
        const blockView = dataViewOf(bytes.subarray(tableRow.rowValues[3].valueStart, tableRow.rowValues[3].valueEnd));
        onMessage({ topicChannel, recordTime: integerOf(bytes, tableRow.rowValues[2]) / 1e9, blockView, messageStart: 0, messageEnd: blockView.byteLength });
      };
      return tableRow.localBytes.length < tableRow.byteCount ? this.#readWholeRow(tableRow).then(passMessage) : passMessage(tableRow.localBytes);
    }, onProgress);
  }

  /** Calls `onRow` for the rows of all tables, in the order of the pages in the file. Damaged pages are skipped. */
  async #visitRows(onRow: (tableRow: TableRow) => void | Promise<void>, onProgress?: OnBlock): Promise<void> {
    const pageCount = Math.floor(this.sourceFile.size / this.#pageSize) || 0;
    for (let pageNumber = 1; pageNumber <= pageCount; pageNumber++) {
      try {
        const pageBytes = await this.#readPage(pageNumber);
        for (const cellOffset of cellOffsetsOf(pageBytes, pageNumber)) {
          const pendingRow = onRow(this.#readRowAt(pageBytes, cellOffset));
          if (pendingRow) await pendingRow;
        }
      } catch (error) {
        // If the end of the file is missing, the last rows continue on missing pages. Such rows are not reported as damaged.
        if (!this.truncationReason || error instanceof LogError) this.noteDamage(pageNumber, error);
      }
      if (onProgress?.(pageNumber / pageCount)) return;
    }
  }

  async #readPage(pageNumber: number): Promise<Uint8Array> {
    const pageBytes = await this.#readBytesAt((pageNumber - 1) * this.#pageSize, pageNumber * this.#pageSize);
    if (pageBytes.length < this.#pageSize) throw new RangeError('a page is cut short');
    return pageBytes;
  }

  #readRowAt(pageBytes: Uint8Array, cellOffset: number): TableRow {
    const [payloadLength, afterLength] = readVarintAt(pageBytes, cellOffset);
    const [id, payloadStart] = readVarintAt(pageBytes, afterLength);
    const localEnd = payloadStart + this.#localByteCountOf(payloadLength);
    if (localEnd > pageBytes.length || payloadLength > Math.min(MAX_ROW_BYTES, this.sourceFile.size)) throw new RangeError('a row is damaged');
    const localBytes = pageBytes.subarray(payloadStart, localEnd);
    return { id, localBytes, rowValues: rowValuesOf(localBytes, payloadLength), byteCount: payloadLength, overflowPage: localEnd - payloadStart < payloadLength ? dataViewOf(pageBytes).getUint32(localEnd) : 0 };
  }

  /** Returns the number of bytes of a row that are stored on its own page. All other bytes are on overflow pages. */
  #localByteCountOf(payloadLength: number): number {
    const maxLocalBytes = this.#usableBytes - 35;
    if (payloadLength <= maxLocalBytes) return payloadLength;
    const minLocalBytes = Math.floor(((this.#usableBytes - 12) * 32) / 255) - 23;
    const preferredLocalBytes = minLocalBytes + ((payloadLength - minLocalBytes) % (this.#usableBytes - 4));
    return preferredLocalBytes <= maxLocalBytes ? preferredLocalBytes : minLocalBytes;
  }

  /** Returns all bytes of a row, including those on overflow pages. */
  async #readWholeRow({ localBytes, byteCount, overflowPage }: TableRow): Promise<Uint8Array> {
    if (localBytes.length === byteCount) return localBytes;
    const rowBytes = new Uint8Array(byteCount);
    rowBytes.set(localBytes);
    for (let filledBytes = localBytes.length; filledBytes < byteCount; ) {
      const pageBytes = await this.#readPage(overflowPage);
      const overflowPart = pageBytes.subarray(4, Math.min(this.#usableBytes, 4 + byteCount - filledBytes));
      rowBytes.set(overflowPart, filledBytes);
      filledBytes += overflowPart.length;
      overflowPage = dataViewOf(pageBytes).getUint32(0);
    }
    return rowBytes;
  }
}

/** Returns the positions of the rows on a page; an empty list for a page without rows of a table. Throws a RangeError if the type of the page is invalid. */
function cellOffsetsOf(pageBytes: Uint8Array, pageNumber: number): number[] {
  const pageView = dataViewOf(pageBytes);
  const headerStart = pageNumber === 1 ? HEADER_BYTES : 0;
  if (pageBytes[headerStart] <= MAX_OTHER_PAGE_TYPE) return [];
  if (pageBytes[headerStart] !== LEAF_PAGE_TYPE) throw new RangeError('a page is damaged');
  return Array.from({ length: pageView.getUint16(headerStart + 3) }, (_, i) => pageView.getUint16(headerStart + 8 + 2 * i));
}

/** Returns a variable-length integer of one to nine bytes, and the position after it. */
function readVarintAt(bytes: Uint8Array, varintStart: number): [value: number, next: number] {
  let varintValue = 0;
  for (let i = 0; i < 9; i++) {
    if (varintStart + i >= bytes.length) break;
    const byte = bytes[varintStart + i];
    if (i < 8 && byte & 0x80) varintValue = varintValue * 128 + (byte & 0x7f);
    else return [i < 8 ? varintValue * 128 + byte : varintValue * 256 + byte, varintStart + i + 1];
  }
  throw new RangeError('a row is damaged');
}

/** Sizes in bytes of values, by their serial type from 0 to 9. Larger types are texts and blobs. */
const INTEGER_BYTES = [0, 1, 2, 3, 4, 6, 8, 8, 0, 0];

/** Returns the values of a row of `byteCount` bytes; throws a RangeError if they do not fit into it. */
function rowValuesOf(rowBytes: Uint8Array, byteCount: number): RowValue[] {
  const rowValues: RowValue[] = [];
  let [valueStart, typeStart] = readVarintAt(rowBytes, 0);
  for (const headerEnd = valueStart; typeStart < headerEnd; ) {
    const [serialType, nextTypeStart] = readVarintAt(rowBytes, typeStart);
    const valueEnd = valueStart + (INTEGER_BYTES[serialType] ?? (serialType - 12 - (serialType % 2)) / 2);
    rowValues.push({ serialType, valueStart, valueEnd });
    [valueStart, typeStart] = [valueEnd, nextTypeStart];
  }
  if (valueStart !== byteCount) throw new RangeError('a row is damaged');
  return rowValues;
}

function integerOf(rowBytes: Uint8Array, { serialType, valueStart, valueEnd }: RowValue): number {
  if (serialType === 6) return Number(dataViewOf(rowBytes).getBigInt64(valueStart));
  if (serialType === 8 || serialType === 9) return serialType - 8;
  let integerValue = 0;
  for (let byteIndex = valueStart; byteIndex < valueEnd; byteIndex++) integerValue = integerValue * 256 + (byteIndex === valueStart ? (rowBytes[byteIndex] << 24) >> 24 : rowBytes[byteIndex]);
  return integerValue;
}
