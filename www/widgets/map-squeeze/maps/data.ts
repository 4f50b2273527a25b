/** Maps as plain data: what a state holds of a map of the reader's own. */

import { object, refusal, renamed, wholeNumber } from '../../../figure/checks.ts';
import { fromBase64, toBase64 } from '../../../figure/packing.ts';
import { limits } from '../../../settings.js';
import type { Cells } from '../../../scene/walls.ts';
import type { MapData, MapSqueeze } from '../../../types.d.ts';

const frozen = Object.freeze;

const PLAN_KEYS = ['name', 'bounds', 'walls'];
const GRID_KEYS = ['name', 'columns', 'rows', 'resolution', 'origin', 'occupied', 'unknown'];

/** Keys that only a grid has. */
const KEYS_OF_GRIDS_ALONE = GRID_KEYS.filter((key) => !PLAN_KEYS.includes(key));

/** The most that the core takes. */
const MAX_WALLS = 20_000;

/** Shades of a cell in the image that a grid is handed over as, white being occupied; what is brighter counts as white. */
const [OCCUPIED, UNKNOWN] = [2, 1];

/** Four cells, a byte each, of four bits: a grid has millions, and goes from one to the other in a few milliseconds so. */
const FOURS = Uint32Array.from({ length: 16 }, (_, bits) => {
  const cells = Uint8Array.of(bits >> 3, (bits >> 2) & 1, (bits >> 1) & 1, bits & 1);
  return new Uint32Array(cells.buffer)[0];
});

/** Times four cells, all four bits are the highest of 28, in their order. */
const GATHER = 0x08040201;

/** The grid of a machine, if it has one: to ask for it takes long where it is large. */
export function cellsOf({ grid }: MapSqueeze): Cells | null {
  return grid && { ...grid, unknown: grid.unknown.includes(1) ? grid.unknown : undefined };
}

/**
 * The map that a machine has, frozen: a page may look at what an element has, and changes that by another one.
 *
 * @param grid of the machine
 */
export function mapData(machine: MapSqueeze, name: string, grid: Cells | null): MapData {
  if (grid) {
    const { columns, rows, resolution, origin } = grid;
    const occupied = packBits(grid.occupied);
    const unknown = grid.unknown && { unknown: packBits(grid.unknown) };
    return frozen({ name, columns, rows, resolution, origin: frozen([...origin]), occupied, ...unknown });
  }
  const { bounds, walls } = machine.plan;
  const listed = [];
  for (let i = 0; i < walls.length; i += 4) listed.push(frozen([walls[i], walls[i + 1], walls[i + 2], walls[i + 3]]));
  return frozen({ name, bounds: frozen([...bounds]), walls: frozen(listed) });
}

/**
 * The walls of a floor plan as the core reads them soonest, one after the other; as they are where they are something else
 * than such a list, of which the core says what is wrong.
 */
function inOneList(walls: unknown) {
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
 * @param data to be MapData
 * @throws {TypeError | RangeError} with the machine's present map left as it is
 */
export function applyMap(machine: MapSqueeze, data: unknown) {
  if (typeof data !== 'object' || data === null || Array.isArray(data)) {
    throw refusal('map', data, `a plan, an object of ${PLAN_KEYS.join(', ')}, or a grid, one of ${GRID_KEYS.join(', ')}`, TypeError);
  }
  const isGrid = KEYS_OF_GRIDS_ALONE.some((key) => key in data);
  const map = object('map', data, isGrid ? GRID_KEYS : PLAN_KEYS);
  if (map.name !== undefined && typeof map.name !== 'string') throw refusal('map.name', map.name, 'a text', TypeError);
  if (!isGrid) {
    renamingFields(PLAN_KEYS, () => machine.setPlan({ bounds: map.bounds, walls: inOneList(map.walls) }));
    return;
  }
  const columns = wholeNumber('map.columns', map.columns, 1, limits.cells);
  const rows = wholeNumber('map.rows', map.rows, 1, Math.floor(limits.cells / columns));
  const count = columns * rows;
  const occupied = bitsOf('map.occupied', map.occupied, count);
  const unknown = map.unknown === undefined ? undefined : bitsOf('map.unknown', map.unknown, count);
  const description = { resolution: map.resolution, origin: map.origin, negate: 1 };
  const fours = new Uint32Array(2 * Math.ceil(count / 8));
  shade(fours, occupied, OCCUPIED);
  if (unknown) shade(fours, unknown, UNKNOWN);
  const image = imageOf(columns, new Uint8Array(fours.buffer, 0, count));
  renamingFields(GRID_KEYS, () => machine.setGrid(description, image));
}

/**
 * Lets the machine take fields of a map.
 *
 * @param keys of the fields
 * @throws {TypeError | RangeError} that names the field as one of the map's
 */
function renamingFields(keys: string[], take: () => void) {
  try {
    take();
  } catch (error) {
    throw ofMap(keys, renamed(error, 'occupied', 'image'));
  }
}

/**
 * Has a refusal name the field as one of the map's.
 *
 * @param keys of the fields
 */
function ofMap(keys: string[], error: unknown) {
  const key = keys.find((each) => error instanceof Error && error.message.startsWith(each));
  return key === undefined ? error : renamed(error, `map.${key}`, key);
}

/**
 * Shades as a PGM file.
 *
 * @param cells row by row from the bottom
 */
function imageOf(columns: number, cells: Uint8Array) {
  const header = new TextEncoder().encode(`P5 ${columns} ${cells.length / columns} ${OCCUPIED}\n`);
  const image = new Uint8Array(header.length + cells.length);
  image.set(header);
  // Rows of an image are counted from the top; negated, white is what is occupied.
  for (let at = 0; at < cells.length; at += columns) {
    image.set(cells.subarray(at, at + columns), image.length - columns - at);
  }
  return image;
}

/**
 * @param cells one a byte, 0 or 1
 * @returns base64 of eight a byte, the first one highest
 */
function packBits(cells: Uint8Array): string {
  const bytes = new Uint8Array(Math.ceil(cells.length / 8));
  const padded = new Uint8Array(8 * bytes.length);
  padded.set(cells);
  const fours = new Uint32Array(padded.buffer);
  const bits = (four: number) => (Math.imul(four, GATHER) >>> 24) & 15;
  for (let i = 0; i < bytes.length; i++) bytes[i] = (bits(fours[2 * i]) << 4) | bits(fours[2 * i + 1]);
  return toBase64(bytes);
}

/**
 * Adds a shade to the cells whose bits are set.
 *
 * @param fours of cells
 */
function shade(fours: Uint32Array, bits: Uint8Array, shade: number) {
  for (let i = 0; i < bits.length; i++) {
    fours[2 * i] += FOURS[bits[i] >> 4] * shade;
    fours[2 * i + 1] += FOURS[bits[i] & 15] * shade;
  }
}

function bitsOf(field: string, text: unknown, count: number) {
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
  return bytes;
}
