/**
 * Handles of each figure, and the positions to which the tests drag them.
 *
 * @module
 */

import { load } from '../../dist/core.js';
import { toPascalCase } from '../../scripts/declarations.mjs';

/**
 * @typedef {object} Handle
 * @property {string} name class of its element
 * @property {number[]} to place to which it is dragged, m
 * @property {(simulation: any, to: number[]) => number[]} placeOf position of the handle by the simulation's settings, after it was
 *   dragged to the place `to`
 */

/** Handles of the figures by tag. Two figures have no handles. @type {Record<string, Handle[] | undefined>} */
export const handlesByTag = {
  'banana-machine': [{ name: 'end', to: [0.8, 0.4], placeOf: ({ contours }) => [...contours.command.slice(-2)] }],
  'map-squeeze': [
    { name: 'body', to: [2.4, 2.3], placeOf: ({ config: { start } }) => [start.x, start.y] },
    {
      name: 'turn',
      to: [2.6, 3.3],
      placeOf({ config: { start } }, [x, y]) {
        const startDistance = Math.hypot(x - start.x, y - start.y);
        return [start.x + startDistance * Math.cos(start.theta), start.y + startDistance * Math.sin(start.theta)];
      },
    },
  ],
  'arc-anatomy': [{ name: 'body.next', to: [0.8, 0.7], placeOf: ({ config: { next } }) => [next.x, next.y] }],
  'odometry-decomposer': [
    { name: 'body.from', to: [0.3, -0.2], placeOf: ({ config: { from } }) => [from.x, from.y] },
    { name: 'body.to', to: [0.9, 1.2], placeOf: ({ config: { to } }) => [to.x, to.y] },
  ],
};

/** Returns the simulation of a figure, in Node. @param {string} widgetTag @param {any} config @returns {Promise<any>} */
export async function createSimulation(widgetTag, config) {
  const core = /** @type {any} */ (await load());
  return new core[toPascalCase(widgetTag)](config);
}
