/** Exported picture: the path, the α's with their intervals, the panels, the systematic errors, and the verdict. */

import { words } from '../../messages/registry.js';
import { clipped, drawAxes } from '../../scene/axes.js';
import { brushOn } from '../../scene/canvas.js';
import { Picture } from '../../scene/picture.js';
import { View } from '../../scene/view.js';
import { lineKey } from '../shared/line-key.js';
import { panelsOf } from './panels.js';
import { WayPicture } from './pictures.js';
import { alphaTexts } from './readouts.js';
import { systematicTexts } from './systematic.js';
import { captionOf } from './words.js';

/**
 * @import { Brush } from '../../scene/canvas.js'
 * @import { Plot } from '../../ui/plot.js'
 * @import { Scene } from './pictures.js'
 * @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure
 */

/** Pixels: the path at the left, the α's beside it; below them the panels, and six lines. */
const [WIDTH, HEIGHT] = [720, 712];
const WAY = { width: 430, height: 344 };
const PANEL = { width: WIDTH / 3, height: 236 };

/** Room for a key in two lines, CSS pixels. */
const TWO_LINES = 42;

/** Distance of lines. */
const LINE = 18;

/** Opacity of a band. */
const PALE = 0.22;

/** @extends {Picture<Scene>} */
export class Plate extends Picture {
  size = { width: WIDTH, height: HEIGHT };
  #way = new WayPicture(TWO_LINES);
  #panel = new View({ equal: false, left: 46, top: 60 });
  #figure;

  /** @param {Figure} figure */
  constructor(figure) {
    super('plate', new View());
    this.#figure = figure;
  }

  /** @type {Picture<Scene>['draw']} */
  draw(surface, scene, palette) {
    const { reading, logName } = this.#figure;
    const brush = { ...brushOn(surface, this.view, palette), exported: true };
    const way = this.#way;
    within(brush, way.view, 0, 0, WAY, (own) => {
      way.fit(scene);
      way.view.ease(0, true);
      way.paint(own, scene);
    });
    const { context } = brush;
    context.fillStyle = palette.ink;
    context.font = brush.font;
    context.textAlign = 'left';
    context.textBaseline = 'top';
    const beside = WAY.width + 20;
    let y = 2;
    for (const text of [`${words.calibrator.alphas.caption}:`, ...alphaTexts(reading)]) y = write(context, text, beside, y, WIDTH - beside) + LINE / 3;
    y = WAY.height + PANEL.height + LINE;
    for (const text of [captionOf(reading, logName), ...systematicTexts(reading)]) y = write(context, text, 2, y, WIDTH - 2);
    panelsOf(this.#figure).forEach(({ plot }, i) =>
      within(brush, this.#panel, i * PANEL.width, WAY.height + LINE / 2, PANEL, (own) => drawPlot(own, plot)));
    return false;
  }
}

/**
 * Paints with a brush of its own in a part of the plate.
 *
 * @param {Brush} brush
 * @param {View} view
 * @param {number} x
 * @param {number} y
 * @param {{ width: number, height: number }} size
 * @param {(brush: Brush) => void} paint
 */
function within(brush, view, x, y, { width, height }, paint) {
  view.resize(width, height);
  brush.context.save();
  brush.context.translate(x, y);
  paint({ ...brush, view });
  brush.context.restore();
}

/**
 * Writes a text in lines that are not longer than the width.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {number} x
 * @param {number} y
 * @param {number} width
 * @returns {number} where the next one may begin
 */
function write(context, text, x, y, width) {
  let line = '';
  for (const word of text.split(' ')) {
    const longer = line && `${line} ${word}`;
    if (longer && context.measureText(longer).width <= width) {
      line = longer;
      continue;
    }
    if (line) context.fillText(line, x, y);
    if (line) y += LINE;
    line = word;
  }
  context.fillText(line, x, y);
  return y + LINE;
}

/**
 * A plot as ui/plot.js has it.
 *
 * @param {Brush} brush
 * @param {Plot} plot over linear axes
 */
function drawPlot(brush, { x: across, y: up, curves, points = [] }) {
  const { context, palette, view } = brush;
  view.extent = { xMin: across.from, xMax: across.to, yMin: up.from, yMax: up.to };
  const key = curves.map(({ name, role, area }) => {
    const entry = lineKey(brush, name.replaceAll('*', ''), { colour: palette[role], width: area ? 8 : 1.9, dash: [] });
    const draw = (/** @type {Parameters<typeof entry.draw>} */ ...at) => {
      context.globalAlpha = area ? PALE : 1;
      entry.draw(...at);
      context.globalAlpha = 1;
    };
    return { ...entry, draw };
  });
  drawAxes(brush, { x: across.name, y: up.name }, key);
  clipped(brush, () => {
    context.lineWidth = 1.9;
    for (const { role, x, y, error = [], area } of curves.filter((curve) => curve.x.length > 0)) {
      const to = (/** @type {number} */ i, /** @type {number} */ side) => context.lineTo(view.toPixelX(x[i]), view.toPixelY(y[i] + side * (error[i] ?? 0)));
      context.strokeStyle = context.fillStyle = palette[role];
      context.beginPath();
      for (let i = 0; i < x.length; i++) to(i, 1);
      for (let i = x.length - 1; area && i >= 0; i--) to(i, -1);
      context.globalAlpha = area ? PALE : 1;
      if (area) context.fill();
      else context.stroke();
      context.globalAlpha = 1;
    }
    for (const { role, x, y, error } of points) {
      const [atX, atY] = [view.toPixelX(x), view.toPixelY(y)];
      context.strokeStyle = context.fillStyle = palette[role];
      context.beginPath();
      context.moveTo(atX, view.toPixelY(y - error));
      context.lineTo(atX, view.toPixelY(y + error));
      context.stroke();
      context.beginPath();
      context.arc(atX, atY, 3, 0, 2 * Math.PI);
      context.fill();
    }
  });
}
