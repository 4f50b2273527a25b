/**
 * Timings of several functions (contenders) in rounds. If the machine is slower during a round, the ratios of the times in that round stay the same.
 */

/** Minimum duration (ms) of a contender's run in a round: 200 times the resolution of the clock in a cross-origin isolated page. */
const MIN_RUN_MS = 1;
/** Number of rounds before the measured rounds. After these rounds V8 has compiled all functions. */
const WARM_UP_ROUNDS = 8;
/** Limits of the number of measured rounds. Quartiles of fewer rounds are not meaningful, and more rounds do not change the quartiles. */
const [MIN_ROUNDS, MAX_ROUNDS] = [5, 60];

/**
 * Runs contenders in rounds, and returns their times.
 *
 * @template {string} Name
 * @param {Record<Name, (event: number) => void>} contenders functions that are called with the number of an event
 * @param {number} totalSeconds for all rounds, if that is enough time for the minimum number of rounds
 * @returns {Promise<Record<Name, number[]>>} ms an event, round by round
 */
export async function raceContenders(contenders, totalSeconds) {
  const contenderList = /** @type {[Name, (event: number) => void][]} */ (Object.entries(contenders));
  /** @type {Record<string, number[]>} */
  const timesByContender = Object.fromEntries(contenderList.map(([contenderName]) => [contenderName, []]));
  let eventNumber = 0;
  let endTime = Infinity;
  for (let roundIndex = -WARM_UP_ROUNDS; roundIndex < MAX_ROUNDS && (roundIndex < MIN_ROUNDS || performance.now() < endTime); roundIndex++) {
    if (roundIndex === 0) endTime = performance.now() + 1000 * totalSeconds;
    // The page handles pending events between rounds, so that they do not slow a round.
    await new Promise((resolve) => setTimeout(resolve));
    for (const [contenderName, handleEvent] of contenderList) {
      const [runStart, firstEvent] = [performance.now(), eventNumber];
      let elapsedMs = 0;
      for (; elapsedMs < MIN_RUN_MS; elapsedMs = performance.now() - runStart) handleEvent(eventNumber++);
      if (roundIndex >= 0) timesByContender[contenderName].push(elapsedMs / (eventNumber - firstEvent));
    }
  }
  return timesByContender;
}
