/**
 * What of each figure is dragged, and where to; and maps of a reader's own.
 *
 * @module
 */

import { load } from '../../dist/core.js';
import { pgm, png, yaml } from '../e2e/squeeze-support.js';

/**
 * @typedef {object} Handle
 * @property {string} name class of its element
 * @property {number[]} to where it is dragged, m
 * @property {(machine: any, to: number[]) => number[]} placeOf what a machine is told, where the handle stands for it; `to` is
 *   how far away it was dragged
 *
 * @typedef {{ name: string, files: import('../e2e/squeeze-support.js').MapFile[], description: object, image: Uint8Array }} OwnMap
 *   `image` is a PGM file of the same cells
 */

/** By their tags. @type {Record<string, { handles: Handle[] }>} */
export const figures = {
  'banana-machine': {
    handles: [{ name: 'end', to: [0.8, 0.4], placeOf: ({ contours }) => [...contours.command.slice(-2)] }],
  },
  'map-squeeze': {
    handles: [
      { name: 'body', to: [2.4, 2.3], placeOf: ({ config: { start } }) => [start.x, start.y] },
      {
        name: 'turn',
        to: [2.6, 3.3],
        placeOf({ config: { start } }, [x, y]) {
          const distance = Math.hypot(x - start.x, y - start.y);
          return [start.x + distance * Math.cos(start.theta), start.y + distance * Math.sin(start.theta)];
        },
      },
    ],
  },
};

/**
 * @param {string} tag
 * @param {any} config
 * @param {OwnMap} [map]
 * @returns {Promise<any>} the machine of a figure, in Node
 */
export async function machineOf(tag, config, map) {
  const motion = /** @type {any} */ (await load());
  const machine = new motion[tag.replace(/(^|-)(\w)/g, (_, _dash, letter) => letter.toUpperCase())](config);
  if (map) machine.setGrid(map.description, map.image);
  return machine;
}

/** Two rooms with a door between them. @type {import('../e2e/squeeze-support.js').Occupied} */
const rooms = (column, row) => column === 0 || row === 0 || column === 59 || row === 39 || (column === 30 && (row < 15 || row > 24));

/** @returns {OwnMap[]} the same in both formats */
export function maps() {
  const description = { resolution: 0.1, origin: [-1, -2, 0], negate: 0, occupied_thresh: 0.65, free_thresh: 0.196 };
  const image = pgm('rooms.pgm', 60, 40, rooms);
  const told = (/** @type {string} */ name) => yaml('rooms.yaml', { ...description, image: name, origin: '[-1, -2, 0]' });
  return [image, png('rooms.png', 60, 40, rooms)].map((file) => ({
    name: file.name,
    files: [told(file.name), file],
    description,
    image: new Uint8Array(image.buffer),
  }));
}
