/** Rendering of a figure: its start near the viewport, and the drawing of its pictures, then of its text, while it is visible and in print. */

import { nothing } from 'lit';
import { onLanguage } from '../messages/registry.ts';
import { hasPixels } from '../scene/canvases.ts';
import { clampNumber } from '../ui/format.ts';
import { FigureController } from './controller.ts';

type AnyPicture = import('../scene/picture.ts').FigurePicture<any>;

/** Maximum drawing time (ms) with which the text is rendered in the same frame. After a longer drawing, the text follows in the next frame. */
const MAX_DRAW_MS_BEFORE_TEXT_OF_SAME_FRAME = 5;

/**
 * Drawing time in a frame, ms, after which further pictures wait for the next frame. With the processor four times slower, a drag of the
 * Banana Machine then takes 19 ms a frame instead of 28, and the first picture comes 10 ms earlier.
 */
const MAX_DRAW_MS_PER_FRAME = 8;

const MAX_TEXT_DELAY_MS = 100;

/** Distance from the viewport at which a figure starts. A smaller distance would show empty frames. A larger one would start figures that nobody sees. */
const NEAR_MARGIN_CSS = '600px';

/** Maximum time step of an animation, ms. An animation therefore continues after a pause without a jump. */
const MAX_TIME_STEP_MS = 100;

export const prefersReducedMotion = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

export class FigureRenderer extends FigureController {
  isVisible = false;
  #isNear = false;
  /** Observes the content, or the element before it has content. A sticky picture may be in sight while the element's own box is not. */
  #visibleObserver = new IntersectionObserver((observerEntries) => this.#updateVisible(observerEntries));
  #visibleTarget: Element | undefined;
  #nearObserver = new IntersectionObserver((observerEntries) => {
    // Whether a figure starts depends on its visibility. The observer of the visibility may call back later, so that its records are taken here.
    this.#updateVisible(this.#visibleObserver.takeRecords());
    for (const { isIntersecting } of observerEntries) this.#setNear(isIntersecting);
  }, { rootMargin: NEAR_MARGIN_CSS });
  #hasRenderedText = false;
  /** Queue of the pictures to draw. The picture that has waited longest is first. */
  #undrawnPictures: Set<AnyPicture> = new Set();
  /** Time (ms) of the first picture that is newer than the text; undefined if the text is up to date. */
  #textPendingSince: number | undefined;
  #frameRequest: number | undefined;
  /** Start (ms) of the time step of the next frame: the previous frame if it has requested the next one, otherwise the time of the request. */
  #previousFrameMs = 0;
  isPrinting = false;

  hostConnected() {
    const { signal: abortSignal } = this.figure.lifetime;
    this.figure.canvases.followPixelRatio(abortSignal);
    addEventListener('beforeprint', () => this.#setPrinting(true), { signal: abortSignal });
    addEventListener('afterprint', () => this.#setPrinting(false), { signal: abortSignal });
    // Some browsers do not fire `beforeprint` and `afterprint`, and others fire them too late.
    const printQuery = matchMedia('print');
    printQuery.addEventListener('change', () => this.#setPrinting(printQuery.matches), { signal: abortSignal });
    // If the element was removed from the page during print, it has missed the event at the end of the print.
    if (this.isPrinting !== printQuery.matches) this.#setPrinting(printQuery.matches);
    onLanguage(this.figure, () => {
      this.figure.settings.isViewModelStale = true;
      this.figure.requestUpdate();
      this.requestFrame();
    }, abortSignal);
    this.#nearObserver.observe(this.figure);
    // The figure starts in a microtask, because the script that defines the element may first call `load(moduleSource)`.
    queueMicrotask(() => {
      this.#checkPosition();
      this.#observeVisibility();
    });
  }

  hostDisconnected() {
    for (const visibilityObserver of [this.#visibleObserver, this.#nearObserver]) visibilityObserver.disconnect();
    this.#visibleTarget = undefined;
    this.#isNear = false;
    this.#setVisible(false);
  }

  #updateVisible(observerEntries: IntersectionObserverEntry[]) {
    const isIntersecting = observerEntries.at(-1)?.isIntersecting;
    if (isIntersecting !== undefined) this.#setVisible(isIntersecting);
  }

  #observeVisibility() {
    const observedElement = this.figure.shadowRoot?.querySelector('.simulation') ?? this.figure;
    // An element may still be updated after its removal. It is then not observed.
    if (observedElement === this.#visibleTarget || !this.figure.isConnected) return;
    if (this.#visibleTarget) this.#visibleObserver.unobserve(this.#visibleTarget);
    this.#visibleTarget = observedElement;
    this.#visibleObserver.observe(observedElement);
  }

  /** Checks the position of the figure at once: the observers would report it a frame later. */
  #checkPosition() {
    const { top: topEdge, bottom: bottomEdge } = this.figure.getBoundingClientRect();
    // An element out of the viewport is not started here. Neither is a removed element, all of whose edges are 0.
    if (topEdge >= innerHeight || bottomEdge <= 0) return;
    this.#setVisible(true);
    this.#setNear(true);
  }

  #setNear(isNear: boolean) {
    if (isNear && !this.#isNear) void this.figure.runtime.startCore();
    this.#isNear = isNear;
  }

  hostUpdated() {
    const { figure } = this;
    this.#observeVisibility();
    figure.resolveIfSettled();
    if (!figure.canvases.canvasElements) figure.colours.applyAndDraw();
    if (!figure.simulation || figure.canvases.canvasElements) return;
    figure.canvases.findAndObserve(figure.renderRoot);
    this.requestFrame();
    if (this.isPrinting) this.#setPrinting(true);
  }

  #setVisible(isVisible: boolean) {
    if (!isVisible && (this.isOpening || this.#textPendingSince !== undefined)) this.#renderText();
    const hasAppeared = isVisible && !this.isVisible;
    this.isVisible = isVisible;
    // Changes of colours are not observed while the figure is out of the viewport. The colours are therefore applied again.
    if (hasAppeared) this.figure.colours.applyAndDraw();
    else if (!isVisible && this.figure.isSettledAwaited) this.requestFrame();
  }

  /** Allows the views of all pictures to zoom in and recenter, after the user or the page has chosen another scene. */
  letViewsZoomIn(minFillFraction?: number) {
    for (const { pictureView } of this.figure.pictures) pictureView.allowZoomIn(minFillFraction);
  }

  /** Requests a frame, in which a visible figure draws all pictures. */
  requestFrame() {
    this.#markAllUndrawn();
    this.#scheduleFrame();
  }

  #scheduleFrame() {
    if (!this.figure.simulation || this.#frameRequest !== undefined) return;
    this.#previousFrameMs = performance.now();
    this.#frameRequest = requestAnimationFrame((nowMs) => {
      this.#frameRequest = undefined;
      const elapsedMs = clampNumber(nowMs - this.#previousFrameMs, 0, MAX_TIME_STEP_MS);
      if (!this.isVisible) this.#updateInvisible();
      else if (this.#undrawnPictures.size > 0) this.#attemptDraw(elapsedMs);
      else this.#renderText();
      this.#previousFrameMs = nowMs;
    });
  }

  /** Applies changes and adds samples without drawing, while the figure is out of the viewport. */
  #updateInvisible() {
    const { figure } = this;
    figure.runtime.attemptOrFail(() => {
      const { simulation, cloud, settings } = figure;
      if (!simulation) return;
      settings.applyPending();
      // If a script waits for all samples, they are added at once, because nobody sees the cloud grow.
      if (figure.isSettledAwaited) cloud?.addAllSamples();
      if (cloud && !cloud.addSamplesUnseen()) this.#scheduleFrame();
      else if (settings.isViewModelStale) figure.updateViewModel();
      // A change of the width draws pictures out of the viewport too, and leaves their text to this frame.
      if (this.#textPendingSince !== undefined) this.#renderText();
      figure.resolveIfSettled();
    });
  }

  /** True if pictures or text remain to be drawn in later frames. */
  get hasPendingFrames() {
    return (this.isVisible && this.#undrawnPictures.size > 0) || this.#textPendingSince !== undefined;
  }

  /** True for a visible figure until its first picture is drawn and its text is rendered. */
  get isOpening() {
    return this.figure.simulation !== undefined && !this.#hasRenderedText && this.isVisible && !document.hidden;
  }

  /** Returns the content, or nothing in the first frame, so that the first picture is drawn earlier. */
  renderAfterFirstPicture(renderContent: () => unknown) {
    return this.isOpening ? nothing : renderContent();
  }

  /** Draws the pending pictures, if a canvas is visible. During a resize the text around the pictures is not rendered, because it could change their sizes again. */
  #attemptDraw(elapsedMs: number, isResizing = false) {
    // In a closed disclosure of the page, all canvases have size 0, and nothing is drawn.
    if (!this.figure.simulation || !this.figure.canvases.canvasElements?.some(hasPixels)) return;
    this.figure.runtime.attemptOrFail(() => {
      this.#drawPictures(elapsedMs, isResizing);
      if (this.figure.simulation) this.figure.runtime.hasTrapped = false;
    });
  }

  #drawPictures(elapsedMs: number, isResizing: boolean) {
    const figure = this.figure;
    const { viewModel } = figure;
    const startTimeMs = performance.now();
    figure.settings.applyPending();
    // Without a simulation, as after a trap, nothing is drawn.
    if (!figure.simulation) return;
    figure.cloud?.addSamplesWhileDrawing();
    const { scene: drawnScene } = figure;
    if (figure.viewModel !== viewModel) this.#markAllUndrawn();
    const { isPressed, previousViewModel } = figure.gesture;
    const drawOptions = { elapsedMs, isImmediate: this.isPrinting || prefersReducedMotion(), previousViewModel, highlight: figure.highlight, drawsHandles: this.isPrinting };
    let isMoving = false;
    for (const undrawnPicture of this.#undrawnPictures) {
      this.#undrawnPictures.delete(undrawnPicture);
      const canvas = figure.canvases.canvasOf(undrawnPicture);
      if (!hasPixels(canvas)) continue;
      // A drag keeps the scale of pictures with handles, so that they stay under the pointer.
      const keepsScale = isPressed && canvas.parentElement!.querySelector('.handle') !== null;
      isMoving = undrawnPicture.drawPicture(figure.canvases.surfaceOf(canvas), drawnScene, figure.colours.palette, { ...drawOptions, keepsScale }) || isMoving;
      if ((!isResizing || this.isOpening) && performance.now() - startTimeMs > MAX_DRAW_MS_PER_FRAME) break;
    }
    for (const pictureHandles of figure.handles) pictureHandles.placeHandles(drawnScene);
    const nowMs = performance.now();
    const pendingSinceMs = this.#textPendingSince;
    // While the figure opens, its text waits for the frame after the first picture.
    if (this.isOpening ? pendingSinceMs : !isResizing && (nowMs - startTimeMs < MAX_DRAW_MS_BEFORE_TEXT_OF_SAME_FRAME || nowMs - (pendingSinceMs ?? nowMs) > MAX_TEXT_DELAY_MS)) this.#renderText();
    else {
      this.#textPendingSince ??= startTimeMs;
      this.#scheduleFrame();
    }
    figure.resolveIfSettled();
    const isPlaying = figure.player?.advanceAnimation(elapsedMs);
    if (this.#undrawnPictures.size > 0) this.#scheduleFrame();
    if (isPlaying || isMoving || figure.cloud?.isSettled === false) this.requestFrame();
  }

  /** Renders the text of the latest picture and writes the attributes. */
  #renderText() {
    this.#hasRenderedText = true;
    this.#textPendingSince = undefined;
    this.figure.reflection.updateAttributes();
    this.figure.requestUpdate();
  }

  #markAllUndrawn() {
    for (const undrawnPicture of this.figure.pictures) this.#undrawnPictures.add(undrawnPicture);
  }

  /** Draws at once, because resizing has cleared the canvases: a drawing in the next frame would flicker. */
  drawResized() {
    this.figure.canvases.updateWidths(this.isPrinting);
    this.figure.colours.applyPageColours();
    this.#markAllUndrawn();
    this.#attemptDraw(0, true);
  }

  /** Draws for print, in light colours and with all samples, or for the screen again. Printing starts a figure that is far from the viewport. */
  async #setPrinting(isPrinting: boolean) {
    const { figure } = this;
    this.isPrinting = isPrinting;
    // Browsers run only microtasks before they print. Microtasks suffice to start this figure if another one has loaded the core.
    if (isPrinting && !figure.simulation) {
      await figure.runtime.startCore();
      await figure.updateComplete;
    }
    figure.settings.applyPending();
    if (!figure.simulation) return;
    if (this.isPrinting) figure.cloud?.addAllSamples();
    else figure.canvases.observeSizes();
    this.drawResized();
    this.#renderText();
  }
}
