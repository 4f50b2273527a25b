/** Topics and messages of rosbag2's SQLite databases. https://www.sqlite.org/fileformat.html */

import { LogError, readBytes, type Source } from '../log.ts';
import { MessageFile, createAheadReader, dataViewOf, type Container, type IsWanted, type OnBlock, type OnMessage } from './container.ts';
import { loadZstd } from './decompression.ts';

/** First byte of pages with rows of a table, and largest first byte of all other pages: index pages, interior pages, and overflow pages of long rows. */
const [LEAF_PAGE_TYPE, MAX_OTHER_PAGE_TYPE] = [13, 10];

const HEADER_BYTES = 100;

/** Maximum size of a row, bytes. The largest messages are point clouds and images. */
const MAX_ROW_BYTES = 2 ** 28;

interface Row {
  /** Bytes of the row on the leaf page. All other bytes are on overflow pages. */
  localBytes: Uint8Array;
  /** Number of bytes of the row, including those on overflow pages. */
  byteCount: number;
  /** Number of the first overflow page; 0 if there is none. */
  overflowPage: number;
  id: number;
  columns: Column[];
}

/** Value in a row: its SQLite serial type, and the range of its bytes. */
interface Column { type: number; start: number; end: number }

const isInteger = (type: number) => type > 0 && type < 10;
const isBlob = (type: number) => type >= 12 && type % 2 === 0;
const isText = (type: number) => type >= 13 && type % 2 === 1;
const isRowId = (type: number) => type === 0;

/** Types of the first columns of tables: messages (id, topic, time, data), topics (id, name, type, serialization), and the list of all tables. */
const TABLE_COLUMNS = { messages: [isRowId, isInteger, isInteger, isBlob], topics: [isRowId, isText, isText, isText], tables: [isText, isText, isText, isInteger] };

const isRowOf = (table: keyof typeof TABLE_COLUMNS, { columns }: Row) => TABLE_COLUMNS[table].every((hasType, i) => hasType(columns[i]?.type));

export async function openSqlite(source: Source): Promise<Container> {
  await loadZstd();
  const database = new Rosbag2(source);
  await database.open();
  return database;
}

class Rosbag2 extends MessageFile {
  readonly format = 'sqlite';
  #pageSize = 0;
  /** Number of bytes in a page, without the bytes that are reserved at its end. */
  #usableBytes = 0;
  #tableNames = new Set<string>();
  #readBytesAt = createAheadReader(this.source);

  async open(): Promise<void> {
    const view = dataViewOf(await readBytes(this.source, 0, HEADER_BYTES));
    const createNotRosbag2Error = () => new LogError({ file: this.source.name }, (texts) => texts.foreignDatabaseReason);
    if (view.byteLength < HEADER_BYTES) {
      this.truncationReason = 'its header is cut short';
      return;
    }
    this.#pageSize = view.getUint16(16) === 1 ? 65536 : view.getUint16(16);
    this.#usableBytes = this.#pageSize - view.getUint8(20);
    if (this.#usableBytes < 480) throw createNotRosbag2Error();
    // The header has the number of pages of the last complete transaction. If the file has another size, the recorder did not close it.
    const pageCount = view.getUint32(28);
    if (pageCount > 0 && pageCount * this.#pageSize !== this.source.size) this.truncationReason = 'the recorder did not close it';
    const countsById = new Map<number, number>();
    await this.#visitRows((row) => {
      if (!isRowOf('messages', row)) return this.#addTopic(row);
      const topicId = integerOf(row.localBytes, row.columns[1]);
      countsById.set(topicId, (countsById.get(topicId) ?? 0) + 1);
      return undefined;
    });
    for (const [id, channel] of this.channelsById) channel.count = countsById.get(id) ?? 0;
    if (!['topics', 'messages'].every((name) => this.#tableNames.has(name)) && !this.truncationReason) throw createNotRosbag2Error();
  }

  /** Stores the topic from a row of the table `topics`, or the table name from a row of the list of all tables. Ignores other rows. */
  async #addTopic(row: Row): Promise<void> {
    const isTable = isRowOf('tables', row);
    if (!isTable && !isRowOf('topics', row)) return;
    const bytes = await this.#readWholeRow(row);
    const [, name, type, encoding] = row.columns.map(({ start, end }) => new TextDecoder().decode(bytes.subarray(start, end)));
    if (isTable) this.#tableNames.add(name);
    // Names of topics start with a slash. Other rows with the same columns are definitions of message types.
    else if (name.startsWith('/')) this.channelsById.set(row.id, { topic: name, type, encoding, count: 0 });
  }

  async readMessages(isWanted: IsWanted, onMessage: OnMessage, onProgress?: OnBlock): Promise<void> {
    const wantedChannels = new Map([...this.channelsById].filter(([, channel]) => isWanted(channel)));
    await this.#visitRows((row) => {
      const channel = isRowOf('messages', row) ? wantedChannels.get(integerOf(row.localBytes, row.columns[1])) : undefined;
      if (!channel) return undefined;
      const passMessage = (bytes: Uint8Array) => {
        const block = dataViewOf(bytes.subarray(row.columns[3].start, row.columns[3].end));
        onMessage({ channel, time: integerOf(bytes, row.columns[2]) / 1e9, block, start: 0, end: block.byteLength });
      };
      return row.localBytes.length < row.byteCount ? this.#readWholeRow(row).then(passMessage) : passMessage(row.localBytes);
    }, onProgress);
  }

  /** Calls `onRow` for the rows of all tables, in the order of the pages in the file. Damaged pages are skipped. */
  async #visitRows(onRow: (row: Row) => void | Promise<void>, onProgress?: OnBlock): Promise<void> {
    const pageCount = Math.floor(this.source.size / this.#pageSize) || 0;
    for (let pageNumber = 1; pageNumber <= pageCount; pageNumber++) {
      try {
        const pageBytes = await this.#readPage(pageNumber);
        for (const cellOffset of cellOffsetsOf(pageBytes, pageNumber)) {
          const pendingRow = onRow(this.#rowAt(pageBytes, cellOffset));
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
    const page = await this.#readBytesAt((pageNumber - 1) * this.#pageSize, pageNumber * this.#pageSize);
    if (page.length < this.#pageSize) throw new RangeError('a page is cut short');
    return page;
  }

  #rowAt(page: Uint8Array, cellOffset: number): Row {
    const [length, afterLength] = varintAt(page, cellOffset);
    const [id, start] = varintAt(page, afterLength);
    const localEnd = start + this.#localByteCountOf(length);
    if (localEnd > page.length || length > Math.min(MAX_ROW_BYTES, this.source.size)) throw new RangeError('a row is damaged');
    const localBytes = page.subarray(start, localEnd);
    return { id, localBytes, columns: columnsOf(localBytes, length), byteCount: length, overflowPage: localEnd - start < length ? dataViewOf(page).getUint32(localEnd) : 0 };
  }

  /** Returns the number of bytes of a row that are stored on its own page. All other bytes are on overflow pages. */
  #localByteCountOf(length: number): number {
    const maxLocalBytes = this.#usableBytes - 35;
    if (length <= maxLocalBytes) return length;
    const minLocalBytes = Math.floor(((this.#usableBytes - 12) * 32) / 255) - 23;
    const preferredLocalBytes = minLocalBytes + ((length - minLocalBytes) % (this.#usableBytes - 4));
    return preferredLocalBytes <= maxLocalBytes ? preferredLocalBytes : minLocalBytes;
  }

  /** Returns all bytes of a row, including those on overflow pages. */
  async #readWholeRow({ localBytes, byteCount, overflowPage }: Row): Promise<Uint8Array> {
    if (localBytes.length === byteCount) return localBytes;
    const row = new Uint8Array(byteCount);
    row.set(localBytes);
    for (let filledBytes = localBytes.length; filledBytes < byteCount; ) {
      const page = await this.#readPage(overflowPage);
      const overflowPart = page.subarray(4, Math.min(this.#usableBytes, 4 + byteCount - filledBytes));
      row.set(overflowPart, filledBytes);
      filledBytes += overflowPart.length;
      overflowPage = dataViewOf(page).getUint32(0);
    }
    return row;
  }
}

/** Returns the positions of the rows on a page; an empty list for a page without rows of a table. Throws a RangeError if the type of the page is invalid. */
function cellOffsetsOf(page: Uint8Array, pageNumber: number): number[] {
  const view = dataViewOf(page);
  const start = pageNumber === 1 ? HEADER_BYTES : 0;
  if (page[start] <= MAX_OTHER_PAGE_TYPE) return [];
  if (page[start] !== LEAF_PAGE_TYPE) throw new RangeError('a page is damaged');
  return Array.from({ length: view.getUint16(start + 3) }, (_, i) => view.getUint16(start + 8 + 2 * i));
}

/** Returns a variable-length integer of one to nine bytes, and the position after it. */
function varintAt(bytes: Uint8Array, start: number): [value: number, next: number] {
  let value = 0;
  for (let i = 0; i < 9; i++) {
    if (start + i >= bytes.length) break;
    const byte = bytes[start + i];
    if (i < 8 && byte & 0x80) value = value * 128 + (byte & 0x7f);
    else return [i < 8 ? value * 128 + byte : value * 256 + byte, start + i + 1];
  }
  throw new RangeError('a row is damaged');
}

/** Sizes in bytes of values, by their serial type from 0 to 9. Larger types are texts and blobs. */
const INTEGER_BYTES = [0, 1, 2, 3, 4, 6, 8, 8, 0, 0];

/** Returns the columns of a row of `byteCount` bytes; throws a RangeError if they do not fit into it. */
function columnsOf(row: Uint8Array, byteCount: number): Column[] {
  const columns: Column[] = [];
  let [valueStart, typeStart] = varintAt(row, 0);
  for (const end = valueStart; typeStart < end; ) {
    const [type, nextTypeStart] = varintAt(row, typeStart);
    const valueEnd = valueStart + (INTEGER_BYTES[type] ?? (type - 12 - (type % 2)) / 2);
    columns.push({ type, start: valueStart, end: valueEnd });
    [valueStart, typeStart] = [valueEnd, nextTypeStart];
  }
  if (valueStart !== byteCount) throw new RangeError('a row is damaged');
  return columns;
}

function integerOf(row: Uint8Array, { type, start, end }: Column): number {
  if (type === 6) return Number(dataViewOf(row).getBigInt64(start));
  if (type === 8 || type === 9) return type - 8;
  let value = 0;
  for (let position = start; position < end; position++) value = value * 256 + (position === start ? (row[position] << 24) >> 24 : row[position]);
  return value;
}
