/** Context for drawing pictures, and basic shapes on a canvas. */

/** Surface for drawing: a canvas, or its substitute for export. */
export interface DrawSurface {
  width: number;
  height: number;
  clientWidth: number;
  fontStyle: { fontFamily: string, fontSize: string };
  canvasContext: CanvasRenderingContext2D;
}

/** Box of a text in a picture: middle, half width and half height, pixels. */
export type TextBox = { x: number, y: number, halfWidth: number, halfHeight: number };

/** Canvas context, view and colours for drawing a picture. Pixels of the view scale with the font size: at 13 px, a pixel of the view is a CSS pixel. */
export interface DrawContext {
  canvasContext: CanvasRenderingContext2D;
  pictureView: import('./view.ts').PictureView;
  palette: import('../ui/theme.ts').ColourPalette;
  /** Device pixels per pixel of the view. */
  pixelRatio: number;
  /** Font of labels, in CSS notation. */
  font: string;
  /** Boxes of the texts drawn so far. Further texts avoid them. */
  placedBoxes: TextBox[];
  /** True if the picture is drawn for a file. Such a picture contains its own legend. */
  isExported?: boolean;
  /** True if handles are part of the drawing. On the screen, handles are elements over the picture. */
  drawsHandles?: boolean;
  /** Name of the highlighted line. It is drawn thicker, and all others faint. */
  highlight?: string | null;
  /** View model of the simulation before the current gesture. Its outlines stay visible for comparison if the gesture zooms the view out. */
  previousViewModel?: any;
}

/** Font size of a picture in pixels of its view. 13 pixels of a view are 13/16 em of the figure: see the style of canvases in ui/layout.ts. */
const FONT_SIZE_PX = 13;

/** Returns a length in pixels of a view as CSS em of the figure. */
export const formatEm = (pixelLength: number) => `${pixelLength / 16}em`;

/** Converts a point of the window to pixels of the view that an element shows. The page may have scaled the element. */
export function toViewPixels(element: Element, pictureView: import('./view.ts').PictureView, { clientX, clientY }: { clientX: number, clientY: number }): [x: number, y: number] {
  const { left, top, width } = element.getBoundingClientRect();
  const elementScale = width / pictureView.width;
  return [(clientX - left) / elementScale, (clientY - top) / elementScale];
}

/** Returns the context of a hidden canvas that is copied to visible ones. It is drawn by the CPU, because a GPU may lose its contents. */
export function createHiddenContext(canvas: OffscreenCanvas) {
  return canvas.getContext('2d', { willReadFrequently: true }) as OffscreenCanvasRenderingContext2D;
}

/** Clears a canvas, sets the view to its size, and returns the context with which a picture is drawn. */
export function createDrawContext({ width, height, clientWidth, fontStyle: { fontFamily, fontSize }, canvasContext }: DrawSurface, pictureView: import('./view.ts').PictureView, palette: import('../ui/theme.ts').ColourPalette) {
  const pixelRatio = ((width / Math.max(1, clientWidth)) * parseFloat(fontSize)) / FONT_SIZE_PX;
  pictureView.setSize(width / pixelRatio, height / pixelRatio);
  canvasContext.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
  canvasContext.clearRect(0, 0, pictureView.width, pictureView.height);
  // Labels are drawn from left to right, also in right-to-left languages, so that the unit follows the number.
  canvasContext.direction = 'ltr';
  return { canvasContext, pictureView, palette, pixelRatio, font: `${FONT_SIZE_PX}px ${fontFamily}`, placedBoxes: [] as TextBox[] };
}

type AnyContext2D = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

/** Calls `paintContents` with the context's opacity multiplied by `opacity`. */
export function paintWithOpacity(canvasContext: AnyContext2D, opacity: number, paintContents: () => void) {
  const { globalAlpha } = canvasContext;
  canvasContext.globalAlpha = opacity * globalAlpha;
  paintContents();
  canvasContext.globalAlpha = globalAlpha;
}

/** Style of a line; dashes in pixels. */
export interface LineStroke { colour: string, width: number, dash?: number[], lineCap?: CanvasLineCap }

export function strokePath(canvasContext: AnyContext2D, { colour: lineColour, width, dash = [], lineCap = 'butt' }: LineStroke, addPath: () => void) {
  canvasContext.strokeStyle = lineColour;
  canvasContext.lineWidth = width;
  canvasContext.lineCap = lineCap;
  canvasContext.setLineDash(dash);
  canvasContext.beginPath();
  addPath();
  canvasContext.stroke();
  canvasContext.setLineDash([]);
}

export function fillPath(canvasContext: AnyContext2D, fillColour: string, addPath: () => void) {
  canvasContext.fillStyle = fillColour;
  canvasContext.beginPath();
  addPath();
  canvasContext.fill();
}

export const addLine = (canvasContext: AnyContext2D, pixelPoints: number[][]) => pixelPoints.forEach(([x, y], i) => (i ? canvasContext.lineTo(x, y) : canvasContext.moveTo(x, y)));

export const strokeLine = (canvasContext: AnyContext2D, pixelPoints: number[][], lineStroke: LineStroke) => strokePath(canvasContext, lineStroke, () => addLine(canvasContext, pixelPoints));

export function drawDisc(canvasContext: AnyContext2D, [x, y]: number[], radius: number, fillColour?: string, edgeStroke?: LineStroke) {
  const addCircle = () => canvasContext.arc(x, y, radius, 0, 2 * Math.PI);
  if (fillColour) fillPath(canvasContext, fillColour, addCircle);
  if (edgeStroke) strokePath(canvasContext, edgeStroke, addCircle);
}

/** Half the size of a cross, CSS pixels. */
const CROSS_HALF_SIZE = 2.6;

/** Adds a cross at a point in CSS pixels to the path. */
export function addCross(canvasContext: AnyContext2D, x: number, y: number) {
  addLine(canvasContext, [[x - CROSS_HALF_SIZE, y - CROSS_HALF_SIZE], [x + CROSS_HALF_SIZE, y + CROSS_HALF_SIZE]]);
  addLine(canvasContext, [[x - CROSS_HALF_SIZE, y + CROSS_HALF_SIZE], [x + CROSS_HALF_SIZE, y - CROSS_HALF_SIZE]]);
}
