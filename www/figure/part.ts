/** A part of a figure: it knows the element that it is a part of, and the other parts through it. */

import type { Figure } from './figure.ts';

export class Part<Host extends Figure = Figure> {
  /** Figure, which calls the part's `hostConnected` and its kin. */
  host: Host;

  constructor(host: Host) {
    this.host = host;
    host.addController(this as object);
  }
}
