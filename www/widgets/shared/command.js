/** A velocity command and its noise, as every widget that has one prints them. */

import { html } from 'lit';
import { words } from '../../messages/registry.js';
import { fixed } from '../../ui/format.js';

/** The command in words. @param {import('../../types.d.ts').Command} command */
export function commandText({ v, omega, dt }) {
  return words.commandText(fixed(v, 2), fixed(omega, 2), fixed(dt, 2));
}

/** @param {number} index from 0 */
export function alphaSymbol(index) {
  return html`<i>α</i><sub>${index + 1}</sub>`;
}

/** @param {number} index from 0 */
export function alphaName(index) {
  return `α${String.fromCharCode(0x2081 + index)}`;
}
