/** Canvases of a figure, and their sizes in device pixels. */

import type { DrawSurface } from './canvas.ts';

/** Pixels per CSS pixel in print. */
const PRINT_PIXEL_RATIO = 2;

/** Returns true if a canvas has pixels. Narrow figures hide some canvases. */
export const hasPixels = ({ width, height }: HTMLCanvasElement) => Math.min(width, height) > 0;

export class Canvases {
  #drawResized;
  /** Canvases whose sizes are observed; undefined until they are rendered. */
  canvasElements: HTMLCanvasElement[] | undefined;
  /** Cached widths of the canvases, CSS pixels. Reading a width from its element in a frame would cause a reflow. */
  #cssWidths: WeakMap<HTMLCanvasElement, number> = new WeakMap();
  #sizeObserver = new ResizeObserver((resizeEntries) => this.#resizeCanvases(resizeEntries));

  /** Creates the canvases of a figure. `drawResized` draws them again after a change of their size, which clears them. */
  constructor(drawResized: () => void) {
    this.#drawResized = drawResized;
  }

  findAndObserve(figureRoot: ParentNode) {
    this.canvasElements = [...figureRoot.querySelectorAll('canvas')];
    this.observeSizes();
  }

  /** Stops observing the canvases, which are no longer rendered. */
  stopObserving() {
    this.#sizeObserver.disconnect();
    this.canvasElements = undefined;
  }

  /** Measures the canvases again when the pixel ratio changes. WebKit's ResizeObserver does not report this change, because it measures in CSS pixels. */
  followPixelRatio(abortSignal: AbortSignal) {
    const onRatioChange = () => {
      this.observeSizes();
      this.followPixelRatio(abortSignal);
    };
    matchMedia(`(resolution:${devicePixelRatio}dppx)`).addEventListener('change', onRatioChange, { once: true, signal: abortSignal });
  }

  /** Observes the sizes of the canvases. The observer reports the present sizes first. */
  observeSizes() {
    this.#sizeObserver.disconnect();
    for (const canvas of this.canvasElements ?? []) {
      try {
        this.#sizeObserver.observe(canvas, { box: 'device-pixel-content-box' });
      } catch {
        this.#sizeObserver.observe(canvas);
      }
    }
  }

  /** Sets the size of each observed canvas in device pixels, and draws. */
  #resizeCanvases(resizeEntries: ResizeObserverEntry[]) {
    for (const { target: resizedCanvas, contentRect, devicePixelContentBoxSize } of resizeEntries) {
      const canvas = resizedCanvas as HTMLCanvasElement;
      const { inlineSize: width, blockSize: height } = devicePixelContentBoxSize?.[0] ?? { inlineSize: 0, blockSize: 0 };
      const [estimatedWidth, estimatedHeight] = [devicePixelRatio * contentRect.width, devicePixelRatio * contentRect.height];
      // While its developer tools emulate a phone, Chromium reports CSS pixels as device pixels. Reported sizes are used only if they agree with the estimate.
      const isEstimateExact = Math.max(Math.abs(width - estimatedWidth), Math.abs(height - estimatedHeight)) < 1;
      [canvas.width, canvas.height] = (isEstimateExact ? [width, height] : [estimatedWidth, estimatedHeight]).map(Math.round);
    }
    this.#drawResized();
  }

  /** Caches the CSS widths of the canvases. For print, it also sets the pixel sizes of the canvases, and stops observing them. */
  updateWidths(isPrinting: boolean) {
    if (isPrinting) this.#sizeObserver.disconnect();
    for (const canvas of this.canvasElements ?? []) {
      const { clientWidth, clientHeight } = canvas;
      this.#cssWidths.set(canvas, clientWidth);
      if (isPrinting) Object.assign(canvas, { width: PRINT_PIXEL_RATIO * clientWidth, height: PRINT_PIXEL_RATIO * clientHeight });
    }
  }

  canvasOf({ pictureName }: { pictureName: string }) {
    return this.canvasElements?.find(({ className }) => className === pictureName) as HTMLCanvasElement;
  }

  surfaceOf(canvas: HTMLCanvasElement): DrawSurface {
    const { width, height } = canvas;
    const clientWidth = this.#cssWidths.get(canvas) ?? canvas.clientWidth;
    return { width, height, clientWidth, fontStyle: getComputedStyle(canvas), canvasContext: canvas.getContext('2d') as CanvasRenderingContext2D };
  }
}
