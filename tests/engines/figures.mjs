/**
 * What of each figure is dragged, and where to; and maps of a reader's own.
 *
 * @module
 */

import { load } from '../../dist/core.js';
import { pgm } from '../e2e/squeeze-support.js';
import { description, file, opened } from '../node/map-support.js';
import { pngOf } from '../png.js';

/**
 * @typedef {object} Handle
 * @property {string} name class of its element
 * @property {number[]} to where it is dragged, m
 * @property {(machine: any, to: number[]) => number[]} placeOf what a machine is told, where the handle stands for it; `to` is
 *   how far away it was dragged
 */

/** By their tags; Dead Reckoning has none. @type {Record<string, { handles: Handle[] }>} */
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
  'arc-anatomy': {
    handles: [{ name: 'body.next', to: [0.8, 0.7], placeOf: ({ config: { next } }) => [next.x, next.y] }],
  },
  'odometry-decomposer': {
    handles: [
      { name: 'body.from', to: [0.3, -0.2], placeOf: ({ config: { from } }) => [from.x, from.y] },
      { name: 'body.to', to: [0.9, 1.2], placeOf: ({ config: { to } }) => [to.x, to.y] },
    ],
  },
  'dead-reckoning': { handles: [] },
  'alpha-calibrator': { handles: [] },
};

/**
 * @param {string} tag
 * @param {any} config
 * @param {File[]} [map]
 * @returns {Promise<any>} the machine of a figure, in Node
 */
export async function machineOf(tag, config, map) {
  if (map) {
    const machine = await opened(...map);
    machine.configure(config);
    return machine;
  }
  const motion = /** @type {any} */ (await load());
  return new motion[tag.replace(/(^|-)(\w)/g, (_, _dash, letter) => letter.toUpperCase())](config);
}

/** Two rooms with a door between them. @type {(column: number, row: number) => boolean} */
const isWall = (column, row) => column === 0 || row === 0 || column === 59 || row === 39 || (column === 30 && (row < 15 || row > 24));
const ROOMS = { width: 60, height: 40, sample: (/** @type {number} */ column, /** @type {number} */ row) => (isWall(column, row) ? 0 : 254) };

/** Every shade behind glass of every opacity, told in the order of an interlaced image, with a gamma that is nothing to a map. */
const GLASS = {
  width: 64,
  height: 64,
  colour: 4,
  interlaced: true,
  sample: (/** @type {number} */ column, /** @type {number} */ row, /** @type {number} */ part) => 4 * (part === 0 ? column : row),
  before: /** @type {[string, number[]][]} */ ([['gAMA', [0, 0, 0xb1, 0x8f]]]),
};

/** Maps of a reader's own, by what they are. @type {Record<string, File[]>} */
export const maps = {
  'a PGM image': [description({ resolution: 0.1, image: 'map.pgm' }), file('map.pgm', new Uint8Array(pgm('map.pgm', ROOMS.width, ROOMS.height, isWall).buffer))],
  'a PNG image': [description({ resolution: 0.1 }), file('map.png', pngOf(ROOMS))],
  'a PNG image of glass': [description({ resolution: 0.1 }), file('map.png', pngOf(GLASS))],
};

/** The first half of an image. */
const half = pngOf(ROOMS).subarray(0, pngOf(ROOMS).length / 2);

/** What is no map. @type {Record<string, File[]>} */
export const damaged = {
  'half a PNG image': [description(), file('map.png', half)],
  'a YAML file that holds itself': [file('map.yaml', 'image: &a [*a]')],
};
