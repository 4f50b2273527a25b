/**
 * Races of contenders, each of which runs once in each round. A slower machine slows all contenders of a round alike. Ratios are by round.
 *
 * @module
 */

/** Minimum duration (ms) of a contender's run in a round. The clock's step of 5 µs in an isolated page is half a per cent of it. */
const MIN_RUN_MS = 1;
/** Number of warm-up rounds, after which V8 compiles nothing more. */
const WARM_UP_ROUNDS = 8;
/** Limits of the number of rounds. Fewer rounds have no meaningful quartiles, and more rounds change nothing. */
const [MIN_ROUNDS, MAX_ROUNDS] = [5, 60];

/**
 * Runs contenders in rounds, and returns their times.
 *
 * @template {string} Name
 * @param {Record<Name, (event: number) => void>} contenders what each does at an event
 * @param {number} totalSeconds for all rounds, if that is enough time for the minimum number of rounds
 * @returns {Promise<Record<Name, number[]>>} ms an event, round by round
 */
export async function raceContenders(contenders, totalSeconds) {
  const contenderList = /** @type {[Name, (event: number) => void][]} */ (Object.entries(contenders));
  /** @type {Record<string, number[]>} */
  const timesByContender = Object.fromEntries(contenderList.map(([contenderName]) => [contenderName, []]));
  let eventNumber = 0;
  let endTime = Infinity;
  for (let roundNumber = -WARM_UP_ROUNDS; roundNumber < MAX_ROUNDS && (roundNumber < MIN_ROUNDS || performance.now() < endTime); roundNumber++) {
    if (roundNumber === 0) endTime = performance.now() + 1000 * totalSeconds;
    // Between two rounds the page can handle events.
    await new Promise((resolve) => setTimeout(resolve));
    for (const [contenderName, handleEvent] of contenderList) {
      const [runStart, firstEvent] = [performance.now(), eventNumber];
      let elapsedMs = 0;
      for (; elapsedMs < MIN_RUN_MS; elapsedMs = performance.now() - runStart) handleEvent(eventNumber++);
      if (roundNumber >= 0) timesByContender[contenderName].push(elapsedMs / (eventNumber - firstEvent));
    }
  }
  return timesByContender;
}
