/**
 * What stands in for @playwright/test in the copy of the tests that figure.mjs runs. Without a plan it notes which mutants
 * each test reaches; with one, it runs a test once for each mutant, or several, that are planned for it and not caught yet.
 * One that fails with a single mutant runs once more without it, and if it passes then, once more with it: only what fails
 * both times was noticed, and no accident of a busy machine. What fails without it may have been left so by the failure before:
 * it has another try in a browser of its own.
 *
 * @module
 */

import { appendFileSync, readFileSync } from 'node:fs';
import { test as plain } from '@playwright/test';

export * from '@playwright/test';

const { MUTANTS_PLAN = '', MUTANTS_NOTES = '' } = process.env;

/** @type {import('./figure.mjs').Plan | undefined} by tests, with the time that they take */
const plan = MUTANTS_PLAN === '' ? undefined : JSON.parse(readFileSync(MUTANTS_PLAN, 'utf8'));

/**
 * @typedef {import('@playwright/test').TestInfo} TestInfo
 * @typedef {'first' | 'without' | 'anew' | 'again'} Turn of a test with its mutants
 * @typedef {{ test: string, ids: string[], turn: Turn, milliseconds: number }} Run
 */

const note = (/** @type {object} */ line) => appendFileSync(MUTANTS_NOTES, `${JSON.stringify(line)}\n`);

/** What a failure tells in each turn. @type {Record<Turn, 'failed' | 'doubtful' | 'unsound' | 'caught'>} */
const FAILURES = { first: 'failed', without: 'doubtful', anew: 'unsound', again: 'caught' };

/**
 * @param {'failed' | 'doubtful' | 'sound' | 'unsound' | 'caught'} kind
 * @param {string[]} ids
 * @param {string} [test] of any test without it
 */
function isNoted(kind, ids, test) {
  const line = JSON.stringify({ kind, ids, test }).slice(0, -1);
  return readFileSync(MUTANTS_NOTES, 'utf8').includes(line);
}

/** Notes which mutants a test reaches. */
const learning = plain.extend(/** @type {any} */ ({
  reaching: [
    async (/** @type {any} */ { context }, /** @type {any} */ use, /** @type {TestInfo} */ info) => {
      const reached = new Set();
      await context.exposeBinding('tellReached', (/** @type {unknown} */ _, /** @type {string[]} */ ids) => ids.forEach((id) => reached.add(id)));
      await context.addInitScript(() => {
        const told = new Set();
        /** @type {string[]} */
        let fresh = [];
        Object.assign(globalThis, {
          reachedMutants(/** @type {string[]} */ ids) {
            for (const id of ids) {
              if (told.has(id)) continue;
              told.add(id);
              if (fresh.push(id) > 1) continue;
              queueMicrotask(() => {
                Reflect.get(globalThis, 'tellReached')(fresh);
                fresh = [];
              });
            }
          },
        });
      });
      const began = performance.now();
      await use();
      const key = info.annotations.find(({ type }) => type === 'key')?.description;
      note({ test: key, milliseconds: Math.round(performance.now() - began), passed: info.status === info.expectedStatus, reached: [...reached] });
    },
    { auto: true },
  ],
}));

/** Runs a test with the mutants that it is annotated with. */
const trying = plain.extend(/** @type {any} */ ({
  turn: [
    // Playwright wants the names of what it needs.
    async (/** @type {any} */ { baseURL: _ }, /** @type {any} */ use, /** @type {TestInfo} */ info) => {
      const { test, ids, turn, milliseconds } = runOf(info);
      info.skip(ids.every((id) => isNoted('caught', [id])));
      if (turn === 'without') info.skip(!isNoted('failed', ids, test));
      if (turn === 'anew') info.skip(!isNoted('doubtful', ids, test));
      if (turn === 'again') info.skip(!isNoted('sound', ids, test));
      info.setTimeout(20_000 + 5 * milliseconds);
      await use();
      if (info.status !== info.expectedStatus) failed(info, info.error?.message ?? `${info.status}`);
      else if (isWithout(turn) && !isNoted(FAILURES[turn], ids, test)) note({ kind: 'sound', ids, test });
    },
    { auto: true },
  ],
  mutants: [
    async (/** @type {any} */ { context }, /** @type {any} */ use, /** @type {TestInfo} */ info) => {
      const { ids, turn } = runOf(info);
      const active = isWithout(turn) ? [] : ids.filter((id) => !isNoted('caught', [id]));
      await context.addInitScript((/** @type {string[]} */ given) => Object.assign(globalThis, { activeMutants: given }), active);
      await use();
    },
    { auto: true },
  ],
}));

const isWithout = (/** @type {Turn} */ turn) => turn === 'without' || turn === 'anew';

/** @param {TestInfo} info @returns {Run} */
const runOf = (info) => JSON.parse(String(info.annotations.find(({ type }) => type === 'run')?.description));

/** @param {TestInfo} info @param {string} message */
function failed(info, message) {
  const { test, ids, turn } = runOf(info);
  const kind = FAILURES[turn];
  if (!isNoted(kind, ids, test)) note({ kind, ids, test, message: message.slice(0, 300) });
}

/**
 * @param {any} test
 * @returns {any} it, where tests and what is extended of it are declared as here
 */
function planned(test) {
  return new Proxy(test, {
    get: (target, name) => (name === 'extend' ? (/** @type {Record<string, any>} */ fixtures) => planned(target.extend(attempted(fixtures))) : Reflect.get(target, name)),
    apply(target, _, given) {
      const [title, body] = [given[0], given.at(-1)];
      const details = given.length > 2 ? given[1] : {};
      const key = `${new Error().stack?.match(/([\w-]+)\.spec\.js/)?.[1]} › ${title}`;
      if (plan === undefined) target(title, { ...details, annotation: { type: 'key', description: key } }, body);
      const { runs = [], milliseconds = 0 } = plan?.[key] ?? {};
      for (const ids of runs) {
        const turns = /** @type {Turn[]} */ (ids.length > 1 ? ['first'] : ['first', 'without', 'anew', 'again']);
        for (const turn of turns) {
          const description = JSON.stringify({ test: key, ids, turn, milliseconds });
          target(`${title} #${ids.join('+')} ${turn}`, { ...details, annotation: { type: 'run', description } }, attempt(body));
        }
      }
    },
  });
}

/** @param {Record<string, any>} fixtures */
function attempted(fixtures) {
  if (plan === undefined) return fixtures;
  return Object.fromEntries(Object.entries(fixtures).map(([name, fixture]) => [name, typeof fixture === 'function' ? attempt(fixture) : fixture]));
}

/**
 * A test, or what it needs, that ends well where a mutant is noticed: after a failed one, Playwright starts a process anew.
 *
 * @param {(...given: any[]) => Promise<void>} work
 */
function attempt(work) {
  const attempted = async (/** @type {any} */ fixtures, /** @type {any[]} */ ...more) => {
    const info = more.at(-1);
    try {
      await work(fixtures, ...more);
    } catch (error) {
      if (info.status === 'timedOut' || info.status === 'interrupted') throw error;
      failed(info, String(error instanceof Error ? error.message : error));
      if (runOf(info).turn === 'without') throw error;
    }
  };
  // Of the text, Playwright learns which fixtures it needs.
  return Object.assign(attempted, { toString: () => work.toString() });
}

export const test = planned(plan === undefined ? learning : trying);
