/**
 * What the module holds: bytes a pose, and whether events leave anything behind. Target 6.
 *
 * @module
 */

import { watchInstance } from './instance.js';
import { ALPHAS, VIEW, figures, picture } from './scene.js';

/** @typedef {import('../www/types.d.ts').Motion} Motion */

/**
 * @typedef {object} Memory
 * @property {number} bytesPerPose that the module grows by, from a cloud of a thousand to one of a million
 * @property {number} events
 * @property {number} coreGrowth bytes
 * @property {number} heapGrowth bytes of JavaScript after a collection
 */

/** Bytes that an event leaves behind if it leaves anything: V8's numbers take 12 on the heap, its objects 12 or more. */
export const SMALLEST_OBJECT = 12;
/** The picture is a few cells wide here: what is asked is whether it leaves anything behind, not how long it takes. */
const SMALL_VIEW = { ...VIEW, columns: 96, rows: 72 };
const [SMALL, LARGE] = [1000, 1_000_000];
/** Robots in the cloud that is dragged: buffers have sizes at any count, and events are many. */
const DRAGGED = 200;

/**
 * @template T
 * @param {() => Promise<T>} start what instantiates the module
 * @returns {Promise<{ result: T, memory: WebAssembly.Memory }>}
 */
export async function watchMemory(start) {
  const { result, exports } = await watchInstance(start);
  const memory = Object.values(exports).find((each) => each instanceof WebAssembly.Memory);
  if (!memory) throw new Error('The module exports no memory.');
  return { result, memory };
}

/**
 * To be asked before larger clouds have been: memory never shrinks.
 *
 * @param {Motion} motion
 * @param {WebAssembly.Memory} memory
 */
export function bytesPerPose(motion, memory) {
  const after = (/** @type {number} */ samples) => {
    const machine = new motion.BananaMachine({ alphas: ALPHAS, samples, seed: 1 });
    figures(machine, 0);
    const { byteLength } = memory.buffer;
    machine.free();
    return byteLength;
  };
  const small = after(SMALL);
  // A module's memory comes in pages of 64 KiB, which would show as a fraction of a byte.
  return Math.round((after(LARGE) - small) / (LARGE - SMALL));
}

/**
 * @param {Motion} motion
 * @param {WebAssembly.Memory} memory
 * @param {{ events: number, heap: () => number | Promise<number> }} options `heap` collects garbage and
 *   returns the bytes left
 */
export async function growth(motion, memory, { events, heap }) {
  const machine = new motion.BananaMachine({ alphas: ALPHAS, samples: DRAGGED, seed: 1 });
  const drag = async (/** @type {number} */ count) => {
    for (let event = 0; event < count; event++) {
      figures(machine, event);
      picture(machine, SMALL_VIEW);
      // Every now and then a page gets a breath, as between events.
      if (event % 1000 === 0) await new Promise((resolve) => setTimeout(resolve));
    }
  };
  // Until everything has been compiled and every buffer has its size.
  await drag(Math.max(2000, events / 10));
  const before = { core: memory.buffer.byteLength, heap: await heap() };
  await drag(events);
  const after = { core: memory.buffer.byteLength, heap: await heap() };
  machine.free();
  return {
    events,
    coreGrowth: after.core - before.core,
    heapGrowth: after.heap - before.heap,
  };
}
