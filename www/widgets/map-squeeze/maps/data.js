/** Maps as plain data: what a state holds of a map of the reader's own. */

import { object, refusal, wholeNumber } from '../../../figure/checks.js';
import { fromBase64, toBase64 } from '../../../figure/packing.js';
import { limits } from '../../../settings.js';

/** @import { MapData, MapSqueeze } from '../../../types.d.ts' */

const PLAN_KEYS = ['name', 'bounds', 'walls'];
const GRID_KEYS = ['name', 'columns', 'rows', 'resolution', 'origin', 'occupied', 'unknown'];

/** The most that the core takes. */
const MAX_WALLS = 100_000;

/** Shades of a cell in the image that a grid is handed over as, white being occupied. */
const [OCCUPIED, UNKNOWN] = [2, 1];

/**
 * The map that a machine has.
 *
 * @param {MapSqueeze} machine
 * @param {string} name
 * @returns {MapData}
 */
export function mapData(machine, name) {
  const { grid } = machine;
  if (grid) {
    const { columns, rows, resolution, origin, occupied, unknown } = grid;
    const data = { name, columns, rows, resolution, origin: [...origin], occupied: packBits(occupied) };
    return unknown.includes(1) ? { ...data, unknown: packBits(unknown) } : data;
  }
  const { bounds, walls } = machine.plan;
  const listed = [];
  for (let i = 0; i < walls.length; i += 4) listed.push([walls[i], walls[i + 1], walls[i + 2], walls[i + 3]]);
  return { name, bounds: [...bounds], walls: listed };
}

/**
 * The walls of a floor plan as the core reads them soonest, one after the other; as they are where they are something else
 * than such a list, of which the core says what is wrong.
 *
 * @param {unknown} walls
 */
export function inOneList(walls) {
  if (!Array.isArray(walls) || walls.length > MAX_WALLS) return walls;
  const numbers = new Float64Array(4 * walls.length);
  for (const [i, wall] of walls.entries()) {
    if (!Array.isArray(wall) || wall.length !== 4 || !wall.every((each) => typeof each === 'number')) return walls;
    numbers.set(wall, 4 * i);
  }
  return numbers;
}

/**
 * Puts a map into a machine.
 *
 * @param {MapSqueeze} machine
 * @param {unknown} data to be MapData
 * @throws {TypeError | RangeError} with the machine's present map left as it is
 */
export function applyMap(machine, data) {
  const isGrid = typeof data === 'object' && data !== null && 'occupied' in data;
  const map = object('map', data, isGrid ? GRID_KEYS : PLAN_KEYS);
  if (map.name !== undefined && typeof map.name !== 'string') throw refusal('map.name', map.name, 'a text', TypeError);
  if (!isGrid) {
    machine.setPlan({ bounds: map.bounds, walls: inOneList(map.walls) });
    return;
  }
  const columns = wholeNumber('map.columns', map.columns, 1, limits.cells);
  const rows = wholeNumber('map.rows', map.rows, 1, Math.floor(limits.cells / columns));
  const cells = unpackBits('map.occupied', map.occupied, columns * rows).map((bit) => OCCUPIED * bit);
  if (map.unknown !== undefined) {
    unpackBits('map.unknown', map.unknown, cells.length).forEach((bit, i) => (cells[i] ||= UNKNOWN * bit));
  }
  const header = new TextEncoder().encode(`P5 ${columns} ${rows} ${OCCUPIED}\n`);
  const image = new Uint8Array(header.length + cells.length);
  image.set(header);
  // Cells are counted from the bottom, and rows of an image from the top; negated, white is what is occupied.
  for (let at = 0; at < cells.length; at += columns) {
    image.set(cells.subarray(at, at + columns), image.length - columns - at);
  }
  machine.setGrid({ resolution: map.resolution, origin: map.origin, negate: 1 }, image);
}

/**
 * @param {Uint8Array} cells one a byte
 * @returns {string} base64 of eight a byte, the first one highest
 */
function packBits(cells) {
  const bytes = new Uint8Array(Math.ceil(cells.length / 8));
  for (let i = 0; i < cells.length; i++) if (cells[i]) bytes[i >> 3] |= 128 >> (i & 7);
  return toBase64(bytes);
}

/**
 * @param {string} field
 * @param {unknown} text
 * @param {number} count
 */
function unpackBits(field, text, count) {
  const length = Math.ceil(count / 8);
  const allowed = `base64 of ${length} bytes, a bit for each cell`;
  if (typeof text !== 'string') throw refusal(field, text, allowed, TypeError);
  let bytes;
  try {
    bytes = fromBase64(text);
  } catch {
    throw refusal(field, text, allowed);
  }
  if (bytes.length !== length) throw refusal(field, text, allowed);
  const cells = new Uint8Array(count);
  for (let i = 0; i < count; i++) cells[i] = (bytes[i >> 3] >> (7 - (i & 7))) & 1;
  return cells;
}
