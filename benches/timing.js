/**
 * Races of contenders, which take turns within one run. What slows the simulation down then slows all of them, and ratios are computed for each
 * turn.
 *
 * @module
 */

/** Minimum duration of a turn, ms: the clock's step in an isolated page, 5 µs, is half a per cent of it. */
const MIN_TURN_DURATION = 1;
/** Number of warm-up turns: afterwards V8 compiles nothing more. */
const WARM_UP_TURNS = 8;
/** Limits of the number of turns: fewer have no meaningful quartiles, and more change nothing. */
const [MIN_TURNS, MAX_TURNS] = [5, 60];

/**
 * @template {string} Name
 * @param {Record<Name, (event: number) => void>} contenders what each does at an event
 * @param {number} seconds for all turns, if that is enough time for the minimum number of turns
 * @returns {Promise<Record<Name, number[]>>} ms an event, turn by turn
 */
export async function raceContenders(contenders, seconds) {
  const contenderList = /** @type {[Name, (event: number) => void][]} */ (Object.entries(contenders));
  /** @type {Record<string, number[]>} */
  const turnTimes = Object.fromEntries(contenderList.map(([name]) => [name, []]));
  let event = 0;
  let endTime = Infinity;
  for (let turn = -WARM_UP_TURNS; turn < MAX_TURNS && (turn < MIN_TURNS || performance.now() < endTime); turn++) {
    if (turn === 0) endTime = performance.now() + 1000 * seconds;
    // The page can handle events in between.
    await new Promise((resolve) => setTimeout(resolve));
    for (const [name, handleEvent] of contenderList) {
      const [start, firstEvent] = [performance.now(), event];
      let elapsed = 0;
      for (; elapsed < MIN_TURN_DURATION; elapsed = performance.now() - start) handleEvent(event++);
      if (turn >= 0) turnTimes[name].push(elapsed / (event - firstEvent));
    }
  }
  return turnTimes;
}
