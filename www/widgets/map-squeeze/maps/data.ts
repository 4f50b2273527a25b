/** Maps as plain data. States contain maps of the user in this form. */

import { range } from 'd3-array';
import { checkObject, createRefusalError, renameErrorField, checkNumber } from '../../../data/checks.ts';
import { fromBase64, toBase64 } from '../../../data/packing.ts';
import { limits } from '../../../../build/settings.js';
import type { CellGrid } from '../../../scene/walls.ts';
import type { MapData, MapSqueeze } from '../../../types.d.ts';

const freeze = Object.freeze;

const PLAN_KEYS = ['name', 'bounds', 'walls'];
const GRID_KEYS = ['name', 'columns', 'rows', 'resolution', 'origin', 'occupied', 'unknown'];

const GRID_ONLY_KEYS = GRID_KEYS.filter((key) => !PLAN_KEYS.includes(key));

/** Grey values of occupied and unknown cells in the image that passes a grid to the core. Occupied cells are brightest, and free cells are black. */
const [OCCUPIED_SHADE, UNKNOWN_SHADE] = [2, 1];

/** Returns the occupancy grid of a simulation; null for a floor plan. Each call copies the grid, which takes long if it is large. */
export function gridOf({ grid }: MapSqueeze): CellGrid | null {
  return grid && { ...grid, unknown: grid.unknown.includes(1) ? grid.unknown : undefined };
}

/** Returns the map of a simulation as a frozen object: a page must set a new object to change the map. */
export function mapDataOf(simulation: MapSqueeze, mapName: string, grid: CellGrid | null): MapData {
  if (grid) {
    const { columns, rows, resolution, origin } = grid;
    const occupied = packBits(grid.occupied);
    const unknownField = grid.unknown && { unknown: packBits(grid.unknown) };
    return freeze({ name: mapName, columns, rows, resolution, origin: freeze([...origin]), occupied, ...unknownField });
  }
  const { bounds, walls } = simulation.plan;
  const wallObjects = range(0, walls.length, 4).map((i) => freeze([...walls.subarray(i, i + 4)]));
  return freeze({ name: mapName, bounds: freeze([...bounds]), walls: freeze(wallObjects) });
}

/** Sets the map of a simulation. If the map is refused, throws a TypeError or RangeError that names the field, and changes nothing. */
export function applyMap(simulation: MapSqueeze, mapData: unknown) {
  if (typeof mapData !== 'object' || mapData === null || Array.isArray(mapData)) {
    throw createRefusalError('map', mapData, `a plan, an object of ${PLAN_KEYS.join(', ')}, or a grid, one of ${GRID_KEYS.join(', ')}`, TypeError);
  }
  const isGrid = GRID_ONLY_KEYS.some((key) => key in mapData);
  const map = checkObject('map', mapData, isGrid ? GRID_KEYS : PLAN_KEYS);
  if (map.name !== undefined && typeof map.name !== 'string') throw createRefusalError('map.name', map.name, 'a text', TypeError);
  if (!isGrid) {
    callWithRenamedFields(PLAN_KEYS, () => simulation.setPlan({ bounds: map.bounds, walls: map.walls }));
    return;
  }
  const columns = checkNumber('map.columns', map.columns, 1, limits.cells, true);
  const rows = checkNumber('map.rows', map.rows, 1, Math.floor(limits.cells / columns), true);
  const cellCount = columns * rows;
  const occupiedBits = decodeBits('map.occupied', map.occupied, cellCount);
  const unknownBits = map.unknown === undefined ? new Uint8Array(occupiedBits.length) : decodeBits('map.unknown', map.unknown, cellCount);
  const gridDescription = { resolution: map.resolution, origin: map.origin, negate: 1 };
  const pgmImage = pgmImageOf(columns, rows, occupiedBits, unknownBits);
  callWithRenamedFields(GRID_KEYS, () => simulation.setGrid(gridDescription, pgmImage));
}

/** Calls a function that passes a map to a simulation. Its error messages use the field names of the map instead of those of the simulation. */
function callWithRenamedFields(keys: string[], setMap: () => void) {
  try {
    setMap();
  } catch (error) {
    const renamedError = renameErrorField(error, 'occupied', 'image');
    const fieldKey = keys.find((key) => renamedError instanceof Error && renamedError.message.startsWith(key));
    throw fieldKey === undefined ? renamedError : renameErrorField(renamedError, `map.${fieldKey}`, fieldKey);
  }
}

/**
 * Returns cells as a PGM image for reading with `negate`, in which white cells are occupied. The rows are reversed: the first row of an image is at the
 * top, and of a grid at the bottom.
 */
function pgmImageOf(columns: number, rows: number, occupiedBits: Uint8Array, unknownBits: Uint8Array) {
  const pgmHeader = new TextEncoder().encode(`P5 ${columns} ${rows} ${OCCUPIED_SHADE}\n`);
  const pgmImage = new Uint8Array(pgmHeader.length + columns * rows);
  pgmImage.set(pgmHeader);
  const bitOf = (bits: Uint8Array, i: number) => (bits[i >> 3] >> (7 - (i & 7))) & 1;
  for (let rowIndex = 0, i = 0; rowIndex < rows; rowIndex++) {
    const rowStart = pgmImage.length - columns * (rowIndex + 1);
    for (let pixelIndex = rowStart; pixelIndex < rowStart + columns; pixelIndex++, i++) pgmImage[pixelIndex] = OCCUPIED_SHADE * bitOf(occupiedBits, i) + UNKNOWN_SHADE * bitOf(unknownBits, i);
  }
  return pgmImage;
}

/** Returns cells of 0 or 1 as base64 text. A byte has eight cells, with the first cell in the highest bit. */
function packBits(cells: Uint8Array): string {
  const packedBytes = new Uint8Array(Math.ceil(cells.length / 8));
  for (let i = 0; i < cells.length; i++) packedBytes[i >> 3] |= cells[i] << (7 - (i & 7));
  return toBase64(packedBytes);
}

function decodeBits(fieldName: string, encodedBits: unknown, cellCount: number) {
  const byteLength = Math.ceil(cellCount / 8);
  const createError = (ErrorType?: ErrorConstructor) => createRefusalError(fieldName, encodedBits, `base64 of ${byteLength} bytes, a bit for each cell`, ErrorType);
  if (typeof encodedBits !== 'string') throw createError(TypeError);
  try {
    const packedBytes = fromBase64(encodedBits);
    if (packedBytes.length === byteLength) return packedBytes;
  } catch {
    // `fromBase64` throws an error for a text that is not base64. Such a text is refused below.
  }
  throw createError();
}
