/**
 * What books have in common that are made by a program and a classic script: their tools stand outside of the book, as a
 * program that reads a whole directory would read them too; every link loads another document.
 *
 * @module
 */

import { copyFileSync, mkdirSync, rmSync } from 'node:fs';
import { join } from 'node:path';

/** What the author copies out of the package. */
const COPIED = ['motion-widgets.iife.js', 'motion-widgets.css'];

/** @param {string} directory of the book */
export const beside = (directory) => `${directory}.tools`;

/**
 * @param {string} directory
 * @param {string} name of a program that `pythonInstall` has installed
 */
export const pythonProgram = (directory, name) => join(beside(directory), 'bin', name);

/** @type {import('./project.mjs').Engine['install']} */
export async function unpack(directory, { run, tarball }) {
  const packed = join(beside(directory), 'package');
  rmSync(packed, { recursive: true, force: true });
  mkdirSync(packed, { recursive: true });
  return run('tar', ['-xzf', tarball, '--strip-components', '1', '-C', packed]);
}

/** For programs that are Python packages. @type {import('./project.mjs').Engine['install']} */
export async function pythonInstall(directory, tools) {
  await tools.run('python3', ['-m', 'venv', beside(directory)]);
  await tools.run(pythonProgram(directory, 'pip'), ['install', '--quiet', '--disable-pip-version-check', '--requirement', 'requirements.txt']);
  return unpack(directory, tools);
}

/**
 * @param {string} directory
 * @param {string} folder of the book
 */
export function copyScript(directory, folder) {
  mkdirSync(join(directory, folder), { recursive: true });
  for (const name of COPIED) copyFileSync(join(beside(directory), 'package/dist', name), join(directory, folder, name));
}

/** By the first link to it that the reader sees. @type {import('./project.mjs').Engine['go']} */
export const follow = (page, path) => page.locator(`a[href$="${path}"]`).filter({ visible: true }).first().click();

/** @type {import('./project.mjs').Expected[]} */
export const expected = [{ selector: 'banana-machine', properties: { omega: 0.8, samples: 20000 } }];

/**
 * @param {string} button that takes the next of light, dark, and what the system has
 * @returns {NonNullable<import('./project.mjs').Engine['dark']>}
 */
export const nextScheme = (button) => async (page, on) => {
  const chosen = page.locator(`[data-theme="${on ? 'dark' : 'light'}"]`);
  for (let i = 0; i < 3 && (await chosen.count()) === 0; i++) await page.locator(button).filter({ visible: true }).click();
};

/** Of a list that a button opens. @type {NonNullable<import('./project.mjs').Engine['dark']>} */
export async function schemeFromList(page, on) {
  await page.locator('.theme-switch-button').filter({ visible: true }).click();
  return page.locator(`.theme-change-button[data-mode="${on ? 'dark' : 'light'}"]`).filter({ visible: true }).click();
}
