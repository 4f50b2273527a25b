// Handles of each figure, and the positions to which the tests drag them.

import { load } from '../../dist/core.js';
import { toPascalCase } from '../../scripts/declarations.mjs';

/**
 * @typedef {object} Handle
 * @property {string} name class of its element
 * @property {number[]} targetPoint position to which it is dragged, m
 * @property {(simulation: any, targetPoint: number[]) => number[]} positionOf computes the position of the handle from the simulation's
 *   settings after the drag to `targetPoint`
 */

/** Handles of the figures by tag. Two figures have no handles. @type {Record<string, Handle[] | undefined>} */
export const handlesByTag = {
  'banana-machine': [{ name: 'end', targetPoint: [0.8, 0.4], positionOf: ({ contours }) => [...contours.command.slice(-2)] }],
  'map-squeeze': [
    { name: 'body', targetPoint: [2.4, 2.3], positionOf: ({ config: { start } }) => [start.x, start.y] },
    {
      name: 'turn',
      targetPoint: [2.6, 3.3],
      positionOf({ config: { start } }, [x, y]) {
        const startDistance = Math.hypot(x - start.x, y - start.y);
        return [start.x + startDistance * Math.cos(start.theta), start.y + startDistance * Math.sin(start.theta)];
      },
    },
  ],
  'arc-anatomy': [{ name: 'body.next', targetPoint: [0.8, 0.7], positionOf: ({ config: { next } }) => [next.x, next.y] }],
  'odometry-decomposer': [
    { name: 'body.from', targetPoint: [0.3, -0.2], positionOf: ({ config: { from } }) => [from.x, from.y] },
    { name: 'body.to', targetPoint: [0.9, 1.2], positionOf: ({ config: { to } }) => [to.x, to.y] },
  ],
};

/** Returns the simulation of a figure, in Node. @param {string} widgetTag @param {any} config @returns {Promise<any>} */
export async function createSimulation(widgetTag, config) {
  const core = /** @type {any} */ (await load());
  return new core[toPascalCase(widgetTag)](config);
}
