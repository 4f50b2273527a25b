/** Context for drawing pictures, and basic shapes on a canvas. */

/** Surface for drawing: a canvas, or its substitute for export. */
export interface DrawSurface {
  width: number;
  height: number;
  clientWidth: number;
  fontStyle: { fontFamily: string, fontSize: string };
  context: CanvasRenderingContext2D;
}

/** Box of a text in a picture: middle, half width and half height, pixels. */
export type TextBox = { x: number, y: number, halfWidth: number, halfHeight: number };

/** Canvas context, view and colours for drawing a picture. Pixels of the view scale with the font size: at 13 px, a pixel of the view is a CSS pixel. */
export interface DrawContext {
  context: CanvasRenderingContext2D;
  view: import('./view.ts').View;
  palette: import('../ui/theme.ts').Palette;
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
export const formatEm = (pixels: number) => `${pixels / 16}em`;

/** Converts a point of the window to pixels of the view that an element shows. The page may have scaled the element. */
export function toViewPixels(element: Element, view: import('./view.ts').View, { clientX, clientY }: { clientX: number, clientY: number }): [x: number, y: number] {
  const { left, top, width } = element.getBoundingClientRect();
  const elementScale = width / view.width;
  return [(clientX - left) / elementScale, (clientY - top) / elementScale];
}

/** Returns the context of a hidden canvas that is copied to visible ones. It is drawn by the CPU, because a GPU may lose its contents. */
export function createHiddenContext(canvas: OffscreenCanvas) {
  return canvas.getContext('2d', { willReadFrequently: true }) as OffscreenCanvasRenderingContext2D;
}

/** Clears a canvas, sets the view to its size, and returns the context with which a picture is drawn. */
export function createDrawContext({ width, height, clientWidth, fontStyle: { fontFamily, fontSize }, context }: DrawSurface, view: import('./view.ts').View, palette: import('../ui/theme.ts').Palette) {
  const pixelRatio = ((width / Math.max(1, clientWidth)) * parseFloat(fontSize)) / FONT_SIZE_PX;
  view.resize(width / pixelRatio, height / pixelRatio);
  context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
  context.clearRect(0, 0, view.width, view.height);
  // Labels are drawn from left to right, also in right-to-left languages, so that the unit follows the number.
  context.direction = 'ltr';
  return { context, view, palette, pixelRatio, font: `${FONT_SIZE_PX}px ${fontFamily}`, placedBoxes: [] as TextBox[] };
}

type AnyContext2D = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

/** Calls `paint` with the context's opacity multiplied by `opacity`. */
export function paintWithOpacity(context: AnyContext2D, opacity: number, paint: () => void) {
  const { globalAlpha } = context;
  context.globalAlpha = opacity * globalAlpha;
  paint();
  context.globalAlpha = globalAlpha;
}

/** Style of a line; dashes in pixels. */
export interface LineStroke { colour: string, width: number, dash?: number[], lineCap?: CanvasLineCap }

export function strokePath(context: AnyContext2D, { colour, width, dash = [], lineCap = 'butt' }: LineStroke, addPath: () => void) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.lineCap = lineCap;
  context.setLineDash(dash);
  context.beginPath();
  addPath();
  context.stroke();
  context.setLineDash([]);
}

export function fillPath(context: AnyContext2D, colour: string, addPath: () => void) {
  context.fillStyle = colour;
  context.beginPath();
  addPath();
  context.fill();
}

export const addLine = (context: AnyContext2D, points: number[][]) => points.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));

export const strokeLine = (context: AnyContext2D, points: number[][], style: LineStroke) => strokePath(context, style, () => addLine(context, points));

export function drawDisc(context: AnyContext2D, [x, y]: number[], radius: number, fillColour?: string, edgeStroke?: LineStroke) {
  const addCircle = () => context.arc(x, y, radius, 0, 2 * Math.PI);
  if (fillColour) fillPath(context, fillColour, addCircle);
  if (edgeStroke) strokePath(context, edgeStroke, addCircle);
}
