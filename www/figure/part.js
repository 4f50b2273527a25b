/** A part of a figure: it knows the element that it is a part of, and the other parts through it. */

/** @import { Figure } from './figure.js' */

/** @template {Figure} [Host=Figure] */
export class Part {
  /** @param {Host} host which calls the part's `hostConnected` and its kin */
  constructor(host) {
    this.host = host;
    host.addController(/** @type {object} */ (this));
  }
}
