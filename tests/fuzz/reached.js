/** What of the program has run: what fuzzing goes by. */

import { Session } from 'node:inspector/promises';

/** What parses: ours, and the readers of YAML and of recordings. */
const PARSES = /\/(www|node_modules\/(js-yaml|@mcap\/core|@foxglove\/(cdr|rosmsg2-serialization)))\//;

/** The characters of each script that ran: 1 for one that did, as far as is told. @typedef {Map<string, Uint8Array>} Places */

export class Reached {
  #session = new Session();

  /** @type {Places} */
  #known = new Map();

  async start() {
    this.#session.connect();
    await this.#session.post('Profiler.enable');
    await this.#session.post('Profiler.startPreciseCoverage', { callCount: true, detailed: true });
  }

  stop() {
    this.#session.disconnect();
  }

  /** What ran since the last look. @returns {Promise<Places>} */
  async look() {
    const { result } = await this.#session.post('Profiler.takePreciseCoverage');
    const scripts = result.filter(({ url }) => PARSES.test(url));
    return new Map(
      scripts.map(({ url, functions }) => {
        const ran = new Uint8Array(Math.max(...functions.map(({ ranges }) => ranges[0].endOffset)));
        // What lies inside of another comes after it.
        for (const { startOffset, endOffset, count } of functions.flatMap(({ ranges }) => ranges)) {
          ran.fill(count > 0 ? 1 : 0, startOffset, endOffset);
        }
        return [url, ran];
      }),
    );
  }

  /** Whether there is anything in it that is not known. @param {Places} places */
  isNews(places) {
    return [...places].some(([url, ran]) => {
      const known = this.#known.get(url);
      return ran.some((did, at) => did === 1 && known?.[at] !== 1);
    });
  }

  /** @param {Places} places that are known from now on */
  learn(places) {
    for (const [url, ran] of places) {
      const before = this.#known.get(url) ?? new Uint8Array();
      const known = new Uint8Array(Math.max(before.length, ran.length));
      known.set(ran);
      before.forEach((did, at) => (known[at] ||= did));
      this.#known.set(url, known);
    }
  }
}
