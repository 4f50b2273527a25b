/**
 * Races: contenders take turns within one run, so that whatever slows the machine down slows all of them, and ratios are
 * taken turn by turn. Medians and quartiles, because what disturbs a measurement only ever makes it longer.
 *
 * @module
 */

/** @typedef {{ median: number, lower: number, upper: number, turns: number }} Quartiles median, quartiles, how many */

/** Minimum duration of a turn, ms: the clock's step in an isolated page, 5 µs, is half a per cent of it. */
const TURN = 1;
/** Number of warm-up events: afterwards V8 compiles nothing more. */
const WARM_UP = 8;
/** Minimum number of turns: fewer have no meaningful quartiles. */
const MIN_TURNS = 5;

/**
 * @template {string} Name
 * @param {Record<Name, (event: number) => void>} contenders what each does at an event
 * @param {{ seconds: number, most?: number }} limits of the turns altogether, once there are the least that count
 * @returns {Promise<Record<Name, number[]>>} ms an event, turn by turn
 */
export async function race(contenders, { seconds, most = 60 }) {
  const names = /** @type {Name[]} */ (Object.keys(contenders));
  let event = 0;
  const time = (/** @type {Name} */ name, /** @type {number} */ events) => {
    const start = performance.now();
    for (let i = 0; i < events; i++) contenders[name](event++);
    return performance.now() - start;
  };
  const batches = names.map((name) => {
    let [events, spent, last] = [0, 0, 0];
    // Warm-up. The functions of a slow contender have been optimized by V8 after fewer events.
    while (events < WARM_UP && (spent < 500 || events < 2)) {
      last = time(name, 1);
      spent += last;
      events += 1;
    }
    // Fast contenders are timed over many events.
    if (last < TURN) last = time(name, 200) / 200;
    return Math.max(1, Math.ceil(TURN / Math.max(last, 1e-4)));
  });
  /** @type {Record<string, number[]>} */
  const turns = Object.fromEntries(names.map((name) => [name, []]));
  const end = performance.now() + 1000 * seconds;
  for (let turn = 0; turn < most && (turn < MIN_TURNS || performance.now() < end); turn++) {
    // Each turn begins with the next contender, and the page can handle events in between.
    await new Promise((resolve) => setTimeout(resolve));
    names.forEach((_, k) => {
      const index = (k + turn) % names.length;
      turns[names[index]].push(time(names[index], batches[index]) / batches[index]);
    });
  }
  return turns;
}

/** Returns median and quartiles. @param {number[]} values @returns {Quartiles} */
export function quartiles(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const at = (/** @type {number} */ share) => {
    const position = share * (sorted.length - 1);
    const below = Math.floor(position);
    const above = Math.min(below + 1, sorted.length - 1);
    return sorted[below] + (position - below) * (sorted[above] - sorted[below]);
  };
  return { median: at(0.5), lower: at(0.25), upper: at(0.75), turns: sorted.length };
}

/** Returns the ratio of two times, turn by turn. @param {number[]} slow @param {number[]} fast */
export function ratio(slow, fast) {
  return quartiles(slow.map((value, turn) => value / fast[turn]));
}
