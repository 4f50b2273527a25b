/**
 * Keeps an element's attributes saying what its settings are: those that have changed since it opened.
 *
 * @module
 */

import { isSetting } from './attributes.js';

/**
 * @typedef {import('./attributes.js').Attributes} Attributes
 * @typedef {Map<string, string | null>} Texts of attributes; null for none
 */

export class Reflection {
  /** Whether the attributes are being written, and a change of one is no news. */
  writing = false;
  /** The attribute that is being read: what it says is not written over. @type {string | undefined} */
  hearing;
  #element;
  #attributes;
  /** As the attributes tell it, or would. @type {Texts | undefined} */
  #told;

  /**
   * @param {Element} element
   * @param {Attributes} attributes
   */
  constructor(element, attributes) {
    this.#element = element;
    this.#attributes = attributes;
  }

  /**
   * What the attributes should say.
   *
   * @param {object} config
   * @param {unknown} motion
   * @returns {Texts}
   */
  texts(config, motion) {
    return new Map(
      Object.entries(this.#attributes).map(([name, entry]) => {
        const value = isSetting(entry) ? entry.get(config, motion) : Reflect.get(this.#element, name);
        return [name, entry.kind.write(value ?? null)];
      }),
    );
  }

  /**
   * Writes what has changed. The first time there is nothing to write: so the element opens.
   *
   * @param {Texts} texts
   */
  tell(texts) {
    const told = this.#told;
    this.#told = texts;
    if (!told) return;
    const changed = new Set([...texts.keys()].filter((name) => texts.get(name) !== told.get(name)));
    for (const [name, entry] of Object.entries(this.#attributes)) {
      if (texts.get(name) !== null || !changed.has(name)) continue;
      for (const covered of entry.covers ?? []) changed.add(covered);
    }
    if (this.hearing) changed.delete(this.hearing);
    this.writing = true;
    for (const name of changed) {
      const text = texts.get(name) ?? null;
      if (text === null) this.#element.removeAttribute(name);
      else this.#element.setAttribute(name, text);
    }
    this.writing = false;
  }

  /**
   * The attributes that a figure needs which opens otherwise.
   *
   * @param {Texts} texts
   * @param {Texts} usual as the widget opens without any
   * @returns {[string, string][]}
   */
  needed(texts, usual) {
    /** @type {Set<string>} */
    const covered = new Set();
    /** @type {[string, string][]} */
    const needed = [];
    for (const [name, entry] of Object.entries(this.#attributes)) {
      const text = texts.get(name) ?? null;
      if (text === null) continue;
      if (text !== usual.get(name) && !covered.has(name)) needed.push([name, text]);
      for (const each of entry.covers ?? []) covered.add(each);
    }
    return needed;
  }
}
