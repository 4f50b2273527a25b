/**
 * What every figure does with what it is given, asked and told, much of it on one page: line for line as in
 * figure-contract.txt. A change there is to be meant: `UPDATE_CONTRACT=1` writes it anew.
 *
 * @module
 */

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect } from '@playwright/test';
import { ready, show } from './element-support.js';

const FILE = join(import.meta.dirname, 'figure-contract.txt');

/**
 * Compares lines with those that the file has below a title.
 *
 * @param {string} title
 * @param {string[]} given
 */
export function expectRecorded(title, given) {
  const lines = given.map((line) => line.trimEnd());
  const sections = new Map(
    readFileSync(FILE, 'utf8').split(/^## /m).slice(1).map((section) => {
      const [name, ...rest] = section.trimEnd().split('\n');
      return [name, rest];
    }),
  );
  if (process.env.UPDATE_CONTRACT) {
    sections.set(title, lines);
    const texts = [...sections].sort(([a], [b]) => (a < b ? -1 : 1)).map(([name, rest]) => `## ${name}\n${rest.join('\n')}\n`);
    writeFileSync(FILE, texts.join('\n'));
  } else {
    expect(lines).toEqual(sections.get(title));
  }
}

/**
 * A page with a small cloud, whole from the start.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} [attributes]
 * @param {string} [inside]
 */
export async function cloudOn(page, attributes = 'samples="150"', inside = '') {
  await show(page, `<p>Above</p><banana-machine ${attributes}>${inside}</banana-machine><p inert>Below</p>`);
  const widget = page.locator('banana-machine');
  await ready(widget);
  return widget;
}

/** HTML without what Lit notes in it, and what the letters of the machine decide. @param {string} html */
export const plain = (html) => html.replace(/<!--.*?-->/g, '').replace(/ (width|height)="[1-9]\d*"/g, '').replace(/\s+/g, ' ').replace(/> </g, '><');
