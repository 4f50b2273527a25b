/**
 * What stands in for @playwright/test in the copy of the tests that figure.mjs runs. Without a plan it notes which mutants
 * each test reaches; with one, it runs a test once for each mutant that is planned for it and has not been caught.
 *
 * @module
 */

import { appendFileSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test as plain } from '@playwright/test';

export * from '@playwright/test';

const { MUTANTS_PLAN = '', MUTANTS_NOTES = '', MUTANTS_PLACE = '' } = process.env;

/** @type {Record<string, { mutants: string[], milliseconds: number }> | undefined} by tests, with the time that they take */
const plan = MUTANTS_PLAN === '' ? undefined : JSON.parse(readFileSync(MUTANTS_PLAN, 'utf8'));

const note = (/** @type {object} */ line) => appendFileSync(MUTANTS_NOTES, `${JSON.stringify(line)}\n`);

const isCaught = (/** @type {string} */ mutant) => readFileSync(MUTANTS_NOTES, 'utf8').includes(`"caught":"${mutant}"`);

const DIST = join(import.meta.dirname, '../../dist');
/** @type {[string, string][]} */
const switched = readdirSync(`${DIST}-with-all`, { recursive: true, withFileTypes: true })
  .filter((entry) => /\.(js|html)$/.test(entry.name))
  .map((entry) => join(entry.parentPath, entry.name))
  .map((path) => /** @type {[string, string]} */ ([path.replace('dist-with-all', 'dist'), readFileSync(path, 'utf8')]))
  .filter(([, text]) => text.includes(MUTANTS_PLACE));
let active = '';

/** Makes a mutant the active one, wherever a page takes the scripts from. @param {string} mutant */
function activate(mutant) {
  if (active === mutant) return;
  active = mutant;
  for (const [path, text] of switched) writeFileSync(path, text.replaceAll(MUTANTS_PLACE, mutant));
}

/** Notes which mutants a test reaches. */
const learning = plain.extend(/** @type {any} */ ({
  reaching: [
    async (/** @type {any} */ { context }, /** @type {any} */ use, /** @type {import('@playwright/test').TestInfo} */ info) => {
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

/** Runs a test with the mutant that its title ends in. */
const trying = plain.extend(/** @type {any} */ ({
  mutant: [
    // Playwright wants the names of what it needs.
    async (/** @type {any} */ { baseURL: _ }, /** @type {any} */ use, /** @type {import('@playwright/test').TestInfo} */ info) => {
      const mutant = mutantOf(info);
      info.skip(isCaught(mutant));
      activate(mutant);
      info.setTimeout(30_000 + 10 * Number(info.annotations.find(({ type }) => type === 'takes')?.description));
      await use();
      if (info.status !== info.expectedStatus) caught(info, info.error?.message ?? `${info.status}`);
    },
    { auto: true },
  ],
}));

const mutantOf = (/** @type {import('@playwright/test').TestInfo} */ { title }) => title.slice(title.lastIndexOf('#') + 1);

/** @param {import('@playwright/test').TestInfo} info @param {string} message */
function caught(info, message) {
  const mutant = mutantOf(info);
  if (!isCaught(mutant)) note({ caught: mutant, test: info.title, message: message.slice(0, 300) });
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
      const { mutants = [], milliseconds = 0 } = plan?.[key] ?? {};
      for (const mutant of mutants) target(`${title} #${mutant}`, { ...details, annotation: { type: 'takes', description: `${milliseconds}` } }, attempt(body));
    },
  });
}

/** @param {Record<string, any>} fixtures */
function attempted(fixtures) {
  if (plan === undefined) return fixtures;
  return Object.fromEntries(Object.entries(fixtures).map(([name, fixture]) => [name, typeof fixture === 'function' ? attempt(fixture) : fixture]));
}

/**
 * A test, or what it needs, that ends well where a mutant is caught: after a failed one, Playwright starts a process anew.
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
      caught(info, String(error instanceof Error ? error.message : error));
    }
  };
  // Of the text, Playwright learns which fixtures it needs.
  return Object.assign(attempted, { toString: () => work.toString() });
}

export const test = planned(plan === undefined ? learning : trying);
