/**
 * Races of contenders, which take turns within one run. A slower machine then slows all contenders, and ratios are computed for each turn.
 *
 * @module
 */

/** Minimum duration of a turn in ms. The clock's step of 5 µs in an isolated page is half a per cent of this duration. */
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
 * @param {number} totalSeconds for all turns, if that is enough time for the minimum number of turns
 * @returns {Promise<Record<Name, number[]>>} ms an event, turn by turn
 */
export async function raceContenders(contenders, totalSeconds) {
  const contenderList = /** @type {[Name, (event: number) => void][]} */ (Object.entries(contenders));
  /** @type {Record<string, number[]>} */
  const turnTimes = Object.fromEntries(contenderList.map(([contenderName]) => [contenderName, []]));
  let eventNumber = 0;
  let endTime = Infinity;
  for (let turnNumber = -WARM_UP_TURNS; turnNumber < MAX_TURNS && (turnNumber < MIN_TURNS || performance.now() < endTime); turnNumber++) {
    if (turnNumber === 0) endTime = performance.now() + 1000 * totalSeconds;
    // Between two turns the page can handle events.
    await new Promise((resolve) => setTimeout(resolve));
    for (const [contenderName, handleEvent] of contenderList) {
      const [turnStart, firstEvent] = [performance.now(), eventNumber];
      let elapsedMs = 0;
      for (; elapsedMs < MIN_TURN_MS; elapsedMs = performance.now() - turnStart) handleEvent(eventNumber++);
      if (turnNumber >= 0) turnTimes[contenderName].push(elapsedMs / (eventNumber - firstEvent));
    }
  }
  return turnTimes;
}
