/** Topics and messages of rosbag2's SQLite databases. https://www.sqlite.org/fileformat.html */

import { LogError, readBytes, type Source } from '../log.ts';
import { MessageFile, createAheadReader, dataViewOf, type Channel, type Container, type IsWanted, type OnBlock, type OnMessage } from './container.ts';
import { loadZstd } from './decompression.ts';

const [INTERIOR_PAGE_TYPE, LEAF_PAGE_TYPE] = [5, 13];

const HEADER_BYTES = 100;

/** Maximum size of a row, bytes. The largest messages are point clouds and images. */
const MAX_ROW_BYTES = 2 ** 28;

type SqliteValue = number | Uint8Array;

interface Row {
  id: number;
  /** Bytes of the row on the leaf page. All other bytes are on overflow pages. */
  localBytes: Uint8Array;
  /** Number of all bytes of the row. */
  byteCount: number;
  /** Number of the first overflow page; 0 if there is none. */
  overflowPage: number;
}

interface SqliteTable { rootPage: number; columns: string[] }

const decodeText = (value: SqliteValue) => (value instanceof Uint8Array ? new TextDecoder().decode(value) : '');

export async function openSqlite(source: Source): Promise<Container> {
  await loadZstd();
  const database = new Rosbag2(source);
  await database.open();
  return database;
}

class Rosbag2 extends MessageFile<SqliteValue> {
  readonly format = 'sqlite';
  #pageSize = 0;
  /** Bytes of a page without those reserved at its end. */
  #usableBytes = 0;
  #messages: SqliteTable = { rootPage: 0, columns: [] };
  #readBytesAt = createAheadReader(this.source);

  async open(): Promise<void> {
    const view = dataViewOf(await readBytes(this.source, 0, HEADER_BYTES));
    const createNotRosbag2Error = () => new LogError({ file: this.source.name }, (texts) => texts.noRosbag2);
    if (view.byteLength < HEADER_BYTES) {
      this.truncationReason = 'its header is cut short';
      return;
    }
    this.#pageSize = view.getUint16(16) === 1 ? 65536 : view.getUint16(16);
    this.#usableBytes = this.#pageSize - view.getUint8(20);
    if (this.#usableBytes < 480) throw createNotRosbag2Error();
    // Pages beyond the number in the header belong to an unfinished transaction.
    const pageCount = view.getUint32(28);
    if (pageCount > 0 && pageCount * this.#pageSize !== this.source.size) this.truncationReason = 'the recorder did not close it';
    const tablesByName = new Map<string, SqliteTable>();
    await this.#visitRows({ rootPage: 1, columns: [] }, async (row) => {
      const bytes = await this.#readWholeRow(row);
      const [name, rootPage, sql] = [1, 3, 4].map((column) => columnValueOf(bytes, column));
      const columns = decodeText(sql).replace(/^[^(]*\(|\)[^)]*$/g, '').split(',').map((column) => column.trim().split(/\s/)[0]);
      tablesByName.set(decodeText(name), { rootPage: Number(rootPage), columns });
    });
    const [topics, messages] = ['topics', 'messages'].map((name) => tablesByName.get(name));
    if (!topics || !messages) {
      if (this.truncationReason) return;
      throw createNotRosbag2Error();
    }
    this.#messages = messages;
    await this.#visitRows(topics, async (row) => {
      const bytes = await this.#readWholeRow(row);
      const [topic, type, encoding] = ['name', 'type', 'serialization_format'].map((column) => decodeText(columnValueOf(bytes, topics.columns.indexOf(column))));
      this.channelsById.set(row.id, { topic, type, encoding, count: 0 });
    });
    const topicColumn = messages.columns.indexOf('topic_id');
    await this.#visitRows(messages, ({ localBytes: bytes }) => {
      const channel = this.channelsById.get(columnValueOf(bytes, topicColumn));
      if (channel) channel.count += 1;
    });
  }

  async readMessages(isWanted: IsWanted, onMessage: OnMessage, onProgress?: OnBlock): Promise<void> {
    const wantedChannels = new Map([...this.channelsById].filter(([, channel]) => isWanted(channel)));
    const [topicColumn, timeColumn, dataColumn] = ['topic_id', 'timestamp', 'data'].map((column) => this.#messages.columns.indexOf(column));
    const passRow = (channel: Channel, bytes: Uint8Array) => {
      const block = dataViewOf(columnValueOf(bytes, dataColumn) as Uint8Array);
      onMessage({ channel, time: Number(columnValueOf(bytes, timeColumn)) / 1e9, block, start: 0, end: block.byteLength });
    };
    await this.#visitRows(this.#messages, (row) => {
      const channel = wantedChannels.get(columnValueOf(row.localBytes, topicColumn));
      if (!channel) return undefined;
      return row.localBytes.length < row.byteCount ? this.#readWholeRow(row).then((bytes) => passRow(channel, bytes)) : passRow(channel, row.localBytes);
    }, onProgress);
  }

  /** Calls `onRow` for the rows of a table in the order of their ids. Damaged pages are skipped. */
  async #visitRows({ rootPage }: SqliteTable, onRow: (row: Row) => void | Promise<void>, onProgress?: OnBlock): Promise<void> {
    // In an incomplete file interior pages may be missing, so all pages are tried. Pages of other tables then fail without a note.
    const triesAllPages = this.truncationReason !== undefined && rootPage === this.#messages.rootPage;
    const leafPages = triesAllPages ? Array.from({ length: this.source.size / this.#pageSize }, (_, i) => i + 1) : await this.#leavesOf(rootPage);
    for (const [i, pageNumber] of leafPages.entries()) {
      try {
        const pageBytes = await this.#readPage(pageNumber);
        for (const cellOffset of cellOffsetsOf(pageBytes, pageNumber, LEAF_PAGE_TYPE)) {
          const pendingRow = onRow(this.#rowAt(pageBytes, cellOffset));
          if (pendingRow) await pendingRow;
        }
      } catch (error) {
        if (!triesAllPages || error instanceof LogError) this.noteDamage(pageNumber, error);
      }
      if (onProgress?.((i + 1) / leafPages.length)) return;
    }
  }

  /** Returns the numbers of a table's leaf pages, which have its rows, in the order of the rows. */
  async #leavesOf(rootPage: number): Promise<number[]> {
    let pagesOfLevel = [rootPage];
    const visitedPages = new Set<number>();
    while (pagesOfLevel.length > 0) {
      const pagesOfNextLevel: number[] = [];
      for (const pageNumber of pagesOfLevel) {
        // The pointers of damaged pages may form a circle.
        if (visitedPages.has(pageNumber)) continue;
        visitedPages.add(pageNumber);
        // Interior pages are far from each other, so that reading larger pieces would be slow.
        const page = await readBytes(this.source, (pageNumber - 1) * this.#pageSize, pageNumber * this.#pageSize);
        const start = pageNumber === 1 ? HEADER_BYTES : 0;
        if (page[start] === LEAF_PAGE_TYPE && pagesOfNextLevel.length === 0) return pagesOfLevel;
        try {
          const view = dataViewOf(page);
          for (const cellOffset of cellOffsetsOf(page, pageNumber, INTERIOR_PAGE_TYPE)) pagesOfNextLevel.push(view.getUint32(cellOffset));
          pagesOfNextLevel.push(view.getUint32(start + 8));
        } catch (error) {
          this.noteDamage(pageNumber, error);
        }
      }
      pagesOfLevel = pagesOfNextLevel;
    }
    return [];
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
    return { id, localBytes: page.subarray(start, localEnd), byteCount: length, overflowPage: localEnd - start < length ? dataViewOf(page).getUint32(localEnd) : 0 };
  }

  /** Returns the number of bytes of a row on its own page. The other bytes are on overflow pages. */
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

/** Returns the positions of the cells of a page. Throws a RangeError if the page has another type. */
function cellOffsetsOf(page: Uint8Array, pageNumber: number, type: number): number[] {
  const view = dataViewOf(page);
  const start = pageNumber === 1 ? HEADER_BYTES : 0;
  if (view.getUint8(start) !== type) throw new RangeError('a page is damaged');
  const cellPointers = start + (type === LEAF_PAGE_TYPE ? 8 : 12);
  return Array.from({ length: view.getUint16(start + 3) }, (_, i) => view.getUint16(cellPointers + 2 * i));
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

/** Sizes in bytes of values, by their serial type valueStart 0 valueEnd 9. Larger types are texts and blobs. */
const INTEGER_BYTES = [0, 1, 2, 3, 4, 6, 8, 8, 0, 0];

/** Returns the value of a column; throws a RangeError if the bytes end before it. */
function columnValueOf(row: Uint8Array, column: number): SqliteValue {
  let [valueStart, typeStart] = varintAt(row, 0);
  const end = valueStart;
  for (let i = 0; typeStart < end; i++) {
    const [type, nextTypeStart] = varintAt(row, typeStart);
    const valueEnd = valueStart + (INTEGER_BYTES[type] ?? (type - 12 - (type % 2)) / 2);
    if (i < column) [valueStart, typeStart] = [valueEnd, nextTypeStart];
    else if (valueEnd > row.length) break;
    else if (type >= 12) return row.subarray(valueStart, valueEnd);
    else return integerOf(row, type, valueStart, valueEnd);
  }
  throw new RangeError('a row is damaged');
}

function integerOf(row: Uint8Array, type: number, start: number, end: number): number {
  if (type === 6) return Number(dataViewOf(row).getBigInt64(start));
  if (type === 8 || type === 9) return type - 8;
  let value = 0;
  for (let position = start; position < end; position++) value = value * 256 + (position === start ? (row[position] << 24) >> 24 : row[position]);
  return value;
}
