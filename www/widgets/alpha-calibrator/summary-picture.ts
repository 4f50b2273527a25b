/** Exported picture: the path, the α's with their intervals, the verdict, and the systematic errors. */

import { words } from '../../messages/registry.ts';
import { brushOn } from '../../scene/canvas.ts';
import { Picture } from '../../scene/picture.ts';
import { View } from '../../scene/view.ts';
import { PathPicture, type Scene } from './pictures.ts';
import { alphaTexts } from './readouts.ts';
import { systematicTexts } from './systematic.ts';
import { captionOf, recommendationReason } from './words.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

/** Size in pixels. The path is at the left with the α's beside it, and sentences are below. */
const [WIDTH, HEIGHT] = [720, 560];
const PATH_SIZE = { width: 430, height: 344 };

/** Height of a legend in two lines, CSS pixels. */
const KEY_HEIGHT = 42;

/** Line height, pixels. */
const LINE_HEIGHT = 18;

export class SummaryPicture extends Picture<Scene> {
  size = { width: WIDTH, height: HEIGHT };
  #path = new PathPicture(KEY_HEIGHT);
  name = 'exportPicture';
  view: View = new View();
  #figure;

  constructor(figure: Figure) {
    super();
    this.#figure = figure;
  }

  draw(surface: Parameters<Picture<Scene>['draw']>[0], scene: Parameters<Picture<Scene>['draw']>[1], palette: Parameters<Picture<Scene>['draw']>[2]) {
    const { viewModel } = this.#figure;
    const brush = { ...brushOn(surface, this.view, palette), exported: true };
    const pathPicture = this.#path;
    pathPicture.view.resize(PATH_SIZE.width, PATH_SIZE.height);
    pathPicture.fit(scene);
    pathPicture.view.ease(0, true);
    const { context } = brush;
    context.save();
    pathPicture.paint({ ...brush, view: pathPicture.view }, scene);
    context.restore();
    Object.assign(context, { fillStyle: palette.ink, font: brush.font, textAlign: 'left', textBaseline: 'top' });
    const alphasLeft = PATH_SIZE.width + 20;
    let y = 2;
    for (const sentence of [`${words.calibrator.alphas.caption}:`, ...alphaTexts(viewModel)]) y = writeText(context, sentence, alphasLeft, y, WIDTH - alphasLeft) + LINE_HEIGHT / 3;
    y = Math.max(PATH_SIZE.height, y) + LINE_HEIGHT;
    for (const sentence of [captionOf(this.#figure), recommendationReason(viewModel), ...systematicTexts(viewModel)]) y = writeText(context, sentence, 2, y, WIDTH - 2);
    return false;
  }
}

/** Writes a text in lines that are not longer than the width, and returns the y of the next line. */
function writeText(context: CanvasRenderingContext2D, sentence: string, x: number, y: number, width: number): number {
  const [firstWord, ...otherWords] = sentence.split(' ');
  const textLines = [firstWord];
  for (const nextWord of otherWords) {
    const extendedLine = `${textLines.at(-1)} ${nextWord}`;
    if (context.measureText(extendedLine).width <= width) textLines.splice(-1, 1, extendedLine);
    else textLines.push(nextWord);
  }
  textLines.forEach((textLine, i) => context.fillText(textLine, x, y + i * LINE_HEIGHT));
  return y + textLines.length * LINE_HEIGHT;
}
