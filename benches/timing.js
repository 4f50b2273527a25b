/**
 * Races: contenders take turns within one run, so that whatever slows the machine down slows all of them, and ratios are
 * taken turn by turn.
 *
 * @module
 */

/** Minimum duration of a turn, ms: the clock's step in an isolated page, 5 µs, is half a per cent of it. */
const TURN = 1;
/** Number of warm-up turns: afterwards V8 compiles nothing more. */
const WARM_UP = 8;
/** Numbers of turns: fewer have no meaningful quartiles, and more change nothing. */
const [MIN_TURNS, MAX_TURNS] = [5, 60];

/**
 * @template {string} Name
 * @param {Record<Name, (event: number) => void>} contenders what each does at an event
 * @param {number} seconds for all turns, once there are the fewest that count
 * @returns {Promise<Record<Name, number[]>>} ms an event, turn by turn
 */
export async function race(contenders, seconds) {
  const entries = /** @type {[Name, (event: number) => void][]} */ (Object.entries(contenders));
  /** @type {Record<string, number[]>} */
  const turns = Object.fromEntries(entries.map(([name]) => [name, []]));
  let event = 0;
  let end = Infinity;
  for (let turn = -WARM_UP; turn < MAX_TURNS && (turn < MIN_TURNS || performance.now() < end); turn++) {
    if (turn === 0) end = performance.now() + 1000 * seconds;
    // The page can handle events in between.
    await new Promise((resolve) => setTimeout(resolve));
    for (const [name, work] of entries) {
      const [start, first] = [performance.now(), event];
      let spent = 0;
      for (; spent < TURN; spent = performance.now() - start) work(event++);
      if (turn >= 0) turns[name].push(spent / (event - first));
    }
  }
  return turns;
}
