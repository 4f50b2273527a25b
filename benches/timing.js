/**
 * Races of contenders, which take turns within one run. What slows the machine down then slows all of them, and ratios are computed for each
 * turn.
 *
 * @module
 */

/** Minimum duration of a turn in ms. The clock's step in an isolated page, 5 µs, is half a per cent of it. */
const MIN_TURN_MS = 1;
/** Number of warm-up turns, after which V8 compiles nothing more. */
const WARM_UP_TURNS = 8;
/** Limits of the number of turns. Fewer turns have no meaningful quartiles, and more turns change nothing. */
const [MIN_TURNS, MAX_TURNS] = [5, 60];

/**
 * Lets contenders take turns, and returns their times.
 *
 * @template {string} Name
 * @param {Record<Name, (event: number) => void>} contenders what each does at an event
 * @param {number} seconds for all turns, if that is enough time for the minimum number of turns
 * @returns {Promise<Record<Name, number[]>>} ms an event, turn by turn
 */
export async function raceContenders(contenders, seconds) {
  const contenderList = /** @type {[Name, (event: number) => void][]} */ (Object.entries(contenders));
  /** @type {Record<string, number[]>} */
  const turnTimes = Object.fromEntries(contenderList.map(([name]) => [name, []]));
  let eventNumber = 0;
  let endTime = Infinity;
  for (let turnNumber = -WARM_UP_TURNS; turnNumber < MAX_TURNS && (turnNumber < MIN_TURNS || performance.now() < endTime); turnNumber++) {
    if (turnNumber === 0) endTime = performance.now() + 1000 * seconds;
    // The page can handle events in between.
    await new Promise((resolve) => setTimeout(resolve));
    for (const [name, handleEvent] of contenderList) {
      const [turnStart, firstEvent] = [performance.now(), eventNumber];
      let elapsedMs = 0;
      for (; elapsedMs < MIN_TURN_MS; elapsedMs = performance.now() - turnStart) handleEvent(eventNumber++);
      if (turnNumber >= 0) turnTimes[name].push(elapsedMs / (eventNumber - firstEvent));
    }
  }
  return turnTimes;
}
