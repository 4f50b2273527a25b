/** Rendering of a figure: its start near the viewport, and the drawing of its pictures, then of its text, while it is visible and in print. */

import { nothing } from 'lit';
import { onLanguage } from '../messages/registry.ts';
import { hasPixels } from '../scene/canvases.ts';
import { clamp } from '../ui/format.ts';
import { FigureController } from './controller.ts';

type AnyPicture = import('../scene/picture.ts').Picture<any>;

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

export class Renderer extends FigureController {
  isVisible = false;
  #isNear = false;
  /** Observes the content, or the element before it has content. A sticky picture may be in sight while the element's own box is not. */
  #visibleObserver = new IntersectionObserver((entries) => this.#updateVisible(entries));
  #visibleTarget: Element | undefined;
  #nearObserver = new IntersectionObserver((entries) => {
    // Starting depends on the visibility, but the order in which the two observers call back is undefined.
    this.#updateVisible(this.#visibleObserver.takeRecords());
    for (const { isIntersecting } of entries) this.#setNear(isIntersecting);
  }, { rootMargin: NEAR_MARGIN_CSS });
  #hasRenderedText = false;
  /** Queue of the pictures to draw. The picture that has waited longest is first. */
  #undrawnPictures: Set<AnyPicture> = new Set();
  /** Time (ms) of the first picture that is newer than the text; undefined if the text is up to date. */
  #textPendingSince: number | undefined;
  #frameRequest: number | undefined;
  /** Time (ms) of the previous frame, or of a later request of a frame. */
  #previousFrameMs = 0;
  isPrinting = false;

  hostConnected() {
    const { signal } = this.host.lifetime;
    this.host.canvases.followPixelRatio(signal);
    addEventListener('beforeprint', () => this.#setPrinting(true), { signal });
    addEventListener('afterprint', () => this.#setPrinting(false), { signal });
    // Some browsers do not fire `beforeprint` and `afterprint`, and others fire them too late.
    const printQuery = matchMedia('print');
    printQuery.addEventListener('change', () => this.#setPrinting(printQuery.matches), { signal });
    // An element that is removed during print gets no event at the end of the print.
    if (this.isPrinting !== printQuery.matches) this.#setPrinting(printQuery.matches);
    onLanguage(this.host, () => this.#applyLanguage(), signal);
    this.#nearObserver.observe(this.host);
    // The figure starts in a microtask, because the script that defines the element may first call `load(source)`.
    queueMicrotask(() => {
      this.#checkPosition();
      this.#observeVisibility();
    });
  }

  hostDisconnected() {
    for (const observer of [this.#visibleObserver, this.#nearObserver]) observer.disconnect();
    this.#visibleTarget = undefined;
    this.#isNear = false;
    this.#setVisible(false);
  }

  #updateVisible(entries: IntersectionObserverEntry[]) {
    const isIntersecting = entries.at(-1)?.isIntersecting;
    if (isIntersecting !== undefined) this.#setVisible(isIntersecting);
  }

  #observeVisibility() {
    const target = this.host.shadowRoot?.querySelector('.simulation') ?? this.host;
    // An element may still be updated after its removal. It is then not observed.
    if (target === this.#visibleTarget || !this.host.isConnected) return;
    if (this.#visibleTarget) this.#visibleObserver.unobserve(this.#visibleTarget);
    this.#visibleTarget = target;
    this.#visibleObserver.observe(target);
  }

  /** Checks the position of the figure at once: the observers would report it a frame later. */
  #checkPosition() {
    const { top, bottom } = this.host.getBoundingClientRect();
    // The box of a removed element is all 0.
    if (top >= innerHeight || bottom <= 0) return;
    this.#setVisible(true);
    this.#setNear(true);
  }

  #setNear(isNear: boolean) {
    if (isNear && !this.#isNear) void this.host.runtime.startCore();
    this.#isNear = isNear;
  }

  #applyLanguage() {
    this.host.settings.isViewModelStale = true;
    this.host.requestUpdate();
    this.requestFrame();
  }

  hostUpdated() {
    const { host } = this;
    this.#observeVisibility();
    host.resolveIfSettled();
    if (!host.canvases.canvasElements) host.colours.applyAndDraw();
    if (!host.simulation || host.canvases.canvasElements) return;
    host.canvases.findAndObserve(host.renderRoot);
    this.requestFrame();
    if (this.isPrinting) this.#setPrinting(true);
  }

  #setVisible(isVisible: boolean) {
    if (!isVisible && (this.isOpening || this.#textPendingSince !== undefined)) this.#renderText();
    const hasAppeared = isVisible && !this.isVisible;
    this.isVisible = isVisible;
    // Changes of colours are not observed while the figure is out of the viewport. The colours are therefore applied again.
    if (hasAppeared) this.host.colours.applyAndDraw();
    else if (!isVisible && this.host.isSettledAwaited) this.requestFrame();
  }

  /** Allows the views of all pictures to zoom in and recenter, after the user or the page has chosen another scene. */
  letViewsZoomIn(minFill?: number) {
    for (const { view } of this.host.pictures) view.allowZoomIn(minFill);
  }

  /** Requests a frame, in which a visible figure draws all pictures. */
  requestFrame() {
    this.#markAllUndrawn();
    this.#scheduleFrame();
  }

  #scheduleFrame() {
    if (!this.host.simulation || this.#frameRequest !== undefined) return;
    this.#previousFrameMs = performance.now();
    this.#frameRequest = requestAnimationFrame((nowMs) => {
      this.#frameRequest = undefined;
      const elapsedMs = clamp(nowMs - this.#previousFrameMs, 0, MAX_TIME_STEP_MS);
      if (!this.isVisible) this.#updateUnseen();
      else if (this.#undrawnPictures.size > 0) this.#attemptDraw(elapsedMs);
      else this.#renderText();
      this.#previousFrameMs = nowMs;
    });
  }

  /** Applies changes and adds samples without drawing, while the figure is out of the viewport. */
  #updateUnseen() {
    const { host } = this;
    host.runtime.attemptOrFail(() => {
      const { simulation, cloud, settings } = host;
      if (!simulation) return;
      settings.applyPending();
      // If a script waits for all samples, they are added at once, because nobody sees the cloud grow.
      if (host.isSettledAwaited) cloud?.addAllSamples();
      if (cloud && !cloud.addSamplesUnseen()) this.#scheduleFrame();
      else if (settings.isViewModelStale) host.updateViewModel();
      host.resolveIfSettled();
    });
  }

  /** True if pictures or text remain to be drawn in later frames. */
  get hasPendingFrames() {
    return (this.isVisible && this.#undrawnPictures.size > 0) || this.#textPendingSince !== undefined;
  }

  /** True for a visible figure until its first picture is drawn and its text is rendered. */
  get isOpening() {
    return this.host.simulation !== undefined && !this.#hasRenderedText && this.isVisible && !document.hidden;
  }

  /** Returns the content, or nothing in the first frame, so that the first picture is drawn earlier. */
  renderAfterFirstPicture(renderContent: () => unknown) {
    return this.isOpening ? nothing : renderContent();
  }

  /** Draws the pending pictures, if a canvas is visible. During a resize no text is rendered, because it could change sizes again. */
  #attemptDraw(elapsedMs: number, isResizing = false) {
    // In a closed disclosure of the page, all canvases have size 0, and nothing is drawn.
    if (!this.host.simulation || !this.host.canvases.canvasElements?.some(hasPixels)) return;
    this.host.runtime.attemptOrFail(() => {
      this.#drawPictures(elapsedMs, isResizing);
      if (this.host.simulation) this.host.runtime.hasTrapped = false;
    });
  }

  #drawPictures(elapsedMs: number, isResizing: boolean) {
    const host = this.host;
    const { viewModel } = host;
    const startTimeMs = performance.now();
    host.settings.applyPending();
    // Without a simulation, as after a trap, nothing is drawn.
    if (!host.simulation) return;
    host.cloud?.addSamplesWhileDrawing();
    const { scene } = host;
    if (host.viewModel !== viewModel) this.#markAllUndrawn();
    const { isPressed, previousViewModel } = host.gesture;
    const drawOptions = { elapsedMs, isImmediate: this.isPrinting || prefersReducedMotion(), previousViewModel, highlight: host.highlight, drawsHandles: this.isPrinting };
    let isMoving = false;
    for (const picture of this.#undrawnPictures) {
      this.#undrawnPictures.delete(picture);
      const canvas = host.canvases.canvasOf(picture);
      if (!hasPixels(canvas)) continue;
      // A drag keeps the scale of pictures with handles, so that they stay under the pointer.
      const keepsScale = isPressed && canvas.parentElement!.querySelector('.handle') !== null;
      isMoving = picture.draw(host.canvases.surfaceOf(canvas), scene, host.colours.palette, { ...drawOptions, keepsScale }) || isMoving;
      if ((!isResizing || this.isOpening) && performance.now() - startTimeMs > MAX_DRAW_MS_PER_FRAME) break;
    }
    for (const handles of host.handles) handles.place(scene);
    const nowMs = performance.now();
    const pendingSinceMs = this.#textPendingSince;
    // The first picture is drawn without text.
    if (this.isOpening ? pendingSinceMs : !isResizing && (nowMs - startTimeMs < MAX_DRAW_MS_BEFORE_TEXT_OF_SAME_FRAME || nowMs - (pendingSinceMs ?? nowMs) > MAX_TEXT_DELAY_MS)) this.#renderText();
    else {
      this.#textPendingSince ??= startTimeMs;
      this.#scheduleFrame();
    }
    host.resolveIfSettled();
    const isPlaying = host.player?.advance(elapsedMs);
    if (this.#undrawnPictures.size > 0) this.#scheduleFrame();
    if (isPlaying || isMoving || host.cloud?.isSettled === false) this.requestFrame();
  }

  /** Renders the text of the latest picture and writes the attributes. */
  #renderText() {
    this.#hasRenderedText = true;
    this.#textPendingSince = undefined;
    this.host.reflection.updateAttributes();
    this.host.requestUpdate();
  }

  #markAllUndrawn() {
    for (const picture of this.host.pictures) this.#undrawnPictures.add(picture);
  }

  /** Draws at once, because resizing has cleared the canvases: a drawing in the next frame would flicker. */
  drawResized() {
    this.host.canvases.updateWidths(this.isPrinting);
    this.host.colours.applyPageColours();
    this.#markAllUndrawn();
    this.#attemptDraw(0, true);
  }

  /** Draws for print, in light colours and with all samples, or for the screen again. Printing starts a figure that is far from the viewport. */
  async #setPrinting(isPrinting: boolean) {
    const { host } = this;
    this.isPrinting = isPrinting;
    // Browsers run only microtasks before they print. Microtasks suffice to start this figure if another one has loaded the core.
    if (isPrinting && !host.simulation) {
      await host.runtime.startCore();
      await host.updateComplete;
    }
    host.settings.applyPending();
    if (!host.simulation) return;
    if (this.isPrinting) host.cloud?.addAllSamples();
    else host.canvases.observeSizes();
    this.drawResized();
    this.#renderText();
  }
}
