/** Base class of a figure's reactive controllers. */

import type { Figure } from './figure.ts';

export class FigureController<Host extends Figure = Figure> {
  figure: Host;

  constructor(figure: Host) {
    this.figure = figure;
    figure.addController(this as object);
  }
}
