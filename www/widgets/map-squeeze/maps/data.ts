/** Maps as plain data, the form in which a state contains a map of the reader. */

import { asObject, refusalError, withFieldRenamed, wholeNumber } from '../../../figure/checks.ts';
import { fromBase64, toBase64 } from '../../../figure/packing.ts';
import { limits } from '../../../settings.js';
import type { Cells } from '../../../scene/walls.ts';
import type { MapData, MapSqueeze } from '../../../types.d.ts';

const frozen = Object.freeze;

const PLAN_KEYS = ['name', 'bounds', 'walls'];
const GRID_KEYS = ['name', 'columns', 'rows', 'resolution', 'origin', 'occupied', 'unknown'];

/** Keys that only a grid has. */
const GRID_ONLY_KEYS = GRID_KEYS.filter((key) => !PLAN_KEYS.includes(key));

/** Maximum number of walls in the core. */
const MAX_WALLS = 20_000;

/** Grey values of cells in the image that passes a grid to the core. The brightest is occupied. */
const [OCCUPIED_SHADE, UNKNOWN_SHADE] = [2, 1];

/** Returns the grid of a machine, if it has one. Copying a large grid takes long. */
export function cellsOf({ grid }: MapSqueeze): Cells | null {
  return grid && { ...grid, unknown: grid.unknown.includes(1) ? grid.unknown : undefined };
}

/** Returns the map of a machine, frozen: a page that changes it gives another map. */
export function mapData(machine: MapSqueeze, name: string, grid: Cells | null): MapData {
  if (grid) {
    const { columns, rows, resolution, origin } = grid;
    const occupied = packBits(grid.occupied);
    const unknownField = grid.unknown && { unknown: packBits(grid.unknown) };
    return frozen({ name, columns, rows, resolution, origin: frozen([...origin]), occupied, ...unknownField });
  }
  const { bounds, walls } = machine.plan;
  const listed = [];
  for (let i = 0; i < walls.length; i += 4) listed.push(frozen([walls[i], walls[i + 1], walls[i + 2], walls[i + 3]]));
  return frozen({ name, bounds: frozen([...bounds]), walls: frozen(listed) });
}

/** Flattens the walls of a floor plan, because the core reads one array fastest. Other values are unchanged, and the core refuses them. */
function flatWalls(walls: unknown) {
  if (!Array.isArray(walls) || walls.length > MAX_WALLS) return walls;
  const numbers = new Float64Array(4 * walls.length);
  for (const [i, wall] of walls.entries()) {
    if (!Array.isArray(wall) || wall.length !== 4 || !wall.every((each) => typeof each === 'number')) return walls;
    numbers.set(wall, 4 * i);
  }
  return numbers;
}

/** Sets the map of a machine. Throws a TypeError or RangeError that names the field, and then changes nothing. */
export function applyMap(machine: MapSqueeze, data: unknown) {
  if (typeof data !== 'object' || data === null || Array.isArray(data)) {
    throw refusalError('map', data, `a plan, an object of ${PLAN_KEYS.join(', ')}, or a grid, one of ${GRID_KEYS.join(', ')}`, TypeError);
  }
  const isGrid = GRID_ONLY_KEYS.some((key) => key in data);
  const map = asObject('map', data, isGrid ? GRID_KEYS : PLAN_KEYS);
  if (map.name !== undefined && typeof map.name !== 'string') throw refusalError('map.name', map.name, 'a text', TypeError);
  if (!isGrid) {
    renamingFields(PLAN_KEYS, () => machine.setPlan({ bounds: map.bounds, walls: flatWalls(map.walls) }));
    return;
  }
  const columns = wholeNumber('map.columns', map.columns, 1, limits.cells);
  const rows = wholeNumber('map.rows', map.rows, 1, Math.floor(limits.cells / columns));
  const count = columns * rows;
  const occupiedBits = bitsOf('map.occupied', map.occupied, count);
  const unknownBits = map.unknown === undefined ? new Uint8Array(occupiedBits.length) : bitsOf('map.unknown', map.unknown, count);
  const description = { resolution: map.resolution, origin: map.origin, negate: 1 };
  const image = imageOf(columns, rows, occupiedBits, unknownBits);
  renamingFields(GRID_KEYS, () => machine.setGrid(description, image));
}

/** Calls a machine with fields of a map. In an error of the machine, the field gets its name in the map. */
function renamingFields(keys: string[], take: () => void) {
  try {
    take();
  } catch (refused) {
    const error = withFieldRenamed(refused, 'occupied', 'image');
    const key = keys.find((each) => error instanceof Error && error.message.startsWith(each));
    throw key === undefined ? error : withFieldRenamed(error, `map.${key}`, key);
  }
}

/** Returns cells as a PGM image. Rows of an image begin at the top, those of a grid at the bottom; negated, white is occupied. */
function imageOf(columns: number, rows: number, occupiedBits: Uint8Array, unknownBits: Uint8Array) {
  const header = new TextEncoder().encode(`P5 ${columns} ${rows} ${OCCUPIED_SHADE}\n`);
  const image = new Uint8Array(header.length + columns * rows);
  image.set(header);
  const bit = (bits: Uint8Array, i: number) => (bits[i >> 3] >> (7 - (i & 7))) & 1;
  for (let row = 0, i = 0; row < rows; row++) {
    const start = image.length - columns * (row + 1);
    for (let at = start; at < start + columns; at++, i++) image[at] = OCCUPIED_SHADE * bit(occupiedBits, i) + UNKNOWN_SHADE * bit(unknownBits, i);
  }
  return image;
}

/** Returns cells of 0 or 1 as base64 of eight a byte, the first one highest. */
function packBits(cells: Uint8Array): string {
  const bytes = new Uint8Array(Math.ceil(cells.length / 8));
  for (let i = 0; i < cells.length; i++) bytes[i >> 3] |= cells[i] << (7 - (i & 7));
  return toBase64(bytes);
}

function bitsOf(field: string, text: unknown, count: number) {
  const length = Math.ceil(count / 8);
  const allowed = `base64 of ${length} bytes, a bit for each cell`;
  if (typeof text !== 'string') throw refusalError(field, text, allowed, TypeError);
  let bytes;
  try {
    bytes = fromBase64(text);
  } catch {
    throw refusalError(field, text, allowed);
  }
  if (bytes.length !== length) throw refusalError(field, text, allowed);
  return bytes;
}
