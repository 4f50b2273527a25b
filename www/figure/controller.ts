/** Base class of a figure's reactive controllers. */

import type { Figure } from './figure.ts';

export class FigureController<Host extends Figure = Figure> {
  host: Host;

  constructor(host: Host) {
    this.host = host;
    host.addController(this as object);
  }
}
