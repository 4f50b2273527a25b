/**
 * What the figure is drawn on: canvases that match the screen's pixels, frames while it is in sight, and
 * colours that follow the page, the theme and paper.
 */

import { nothing } from 'lit';
import { onLanguage } from '../messages/registry.ts';
import { resolvePalette } from '../ui/theme.ts';
import { sleep, wake } from './page/frames.ts';
import { ancestors, surroundings } from './page/scheme.ts';
import { Part } from './part.ts';

/**
 * A picture that took no longer, milliseconds, has its words in the same frame: to lay them out takes about as long again.
 * After a longer one they follow in the next frame, so that neither takes longer than one.
 */
const QUICK = 5;

/** Longest that words wait while every frame has a picture, milliseconds: what comes later is no answer to the hand. */
const LATEST_WORDS = 100;

/** Pixels of paper a CSS pixel: as fine as in a file. */
const PAPER_RATIO = 2;

let calm: MediaQueryList | undefined;

/** Whether the reader has asked for less motion. */
export const isCalm = () => (calm ??= matchMedia('(prefers-reduced-motion: reduce)')).matches;

/** Returns whether a canvas has room: a narrow figure may leave one out. */
const isShown = ({ clientWidth, clientHeight }: HTMLCanvasElement) => Math.min(clientWidth, clientHeight) > 0;

export class Stage extends Part {
  /** Whether the reader can see it. */
  inSight = false;
  #palette: import('../ui/theme.ts').Palette | undefined;
  /** Once there is something to draw. */
  #canvases: HTMLCanvasElement[] | undefined;
  /** Whether the words of the first picture have come. */
  #isDescribed = false;
  /** True if there is something to draw, as soon as it is in sight. */
  #needsDrawing: boolean | undefined;
  /** When the first picture was drawn whose words have not come yet. */
  #undescribedSince: number | undefined;
  #printing = false;
  /** Words of other heights would change the sizes that are being told of: they wait for the next frame. */
  #resizing: boolean | undefined;
  #sizes: ResizeObserver | undefined;
  /** Ends listening for the printer and for other words. */
  #listening = new AbortController();

  hostConnected() {
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    addEventListener('beforeprint', () => this.#print(true), { signal });
    addEventListener('afterprint', () => this.#print(false), { signal });
    // Some browsers have only the one, others tell too late by the other.
    const media = matchMedia('print');
    media.addEventListener('change', () => this.#print(media.matches), { signal });
    this.#followPixels(signal);
    onLanguage(this.host, () => this.#languageChanged(), signal);
    // What the text around says at once, a background that fades says when it has arrived.
    const backgroundChanged = ({ target, propertyName }: TransitionEvent) => {
      if (propertyName === 'background-color' && ancestors(this.host).includes(target as Element)) this.recolour();
    };
    document.addEventListener('transitionend', backgroundChanged, { signal });
  }

  hostDisconnected() {
    this.#listening.abort();
  }

  /** The words or the language may be others. */
  #languageChanged() {
    this.host.settings.stale = true;
    this.host.requestUpdate();
    this.requestFrame();
  }

  hostUpdated() {
    this.host.resolveSettled();
    if (!this.#canvases) this.recolour();
    if (!this.host.machine || this.#canvases) return;
    this.#canvases = [...this.host.renderRoot.querySelectorAll('canvas')];
    this.#sizes = new ResizeObserver((entries) => this.#resize(entries));
    this.#measure();
    this.requestFrame();
  }

  /** Measures again when the window moves to a screen of other pixels: in WebKit the observer reports CSS pixels alone. */
  #followPixels(signal: AbortSignal) {
    const changed = () => {
      this.#measure();
      this.#followPixels(signal);
    };
    matchMedia(`(resolution:${devicePixelRatio}dppx)`).addEventListener('change', changed, { once: true, signal });
  }

  /** Observes the sizes of the canvases, beginning with the present ones. */
  #measure() {
    if (!this.#sizes || !this.#canvases) return;
    this.#sizes.disconnect();
    for (const canvas of this.#canvases) {
      try {
        this.#sizes.observe(canvas, { box: 'device-pixel-content-box' });
      } catch {
        this.#sizes.observe(canvas);
      }
    }
  }

  setVisible(inSight: boolean) {
    if (!inSight && (this.opening || this.#undescribedSince !== undefined)) this.#describe();
    this.inSight = inSight;
    if (!inSight && this.host.isAwaited) this.host.settings.show();
    // Of what was skipped nothing tells that its colours changed.
    if (inSight) this.recolour();
  }

  /** Lets the views close in and recenter: the reader, or the page, has chosen to see something else. */
  release() {
    for (const { view } of this.host.pictures) view.release();
  }

  /** Asks for one drawing in the next frame, when there is somebody to see it. */
  requestFrame() {
    this.#needsDrawing = true;
    if (this.host.machine && this.inSight) wake(this);
  }

  /**
   * Whether the first picture is still on its way to the reader, who sees it before anything else. Nobody waits for it who
   * cannot see it.
   */
  get opening() {
    return this.host.machine !== undefined && !this.#isDescribed && this.inSight && !document.hidden;
  }

  /** Content below the pictures. It comes with the frame after the first, so that the pictures are seen at once. */
  later(content: () => unknown) {
    return this.opening ? nothing : content();
  }

  /** There is nothing to draw any more: the canvases keep their places, and no pixels. */
  clear() {
    sleep(this);
    this.#sizes?.disconnect();
    for (const canvas of this.#canvases ?? []) canvas.width = canvas.height = 0;
    this.#sizes = this.#canvases = this.#palette = this.#undescribedSince = undefined;
  }

  /** @param elapsed milliseconds since the frame before */
  frame(elapsed: number) {
    if (this.#needsDrawing) this.#drawNow(elapsed);
    else this.#describe();
  }

  /** @param elapsed milliseconds since the frame before */
  #drawNow(elapsed: number) {
    if (!this.host.machine || !this.#hasSize) return;
    this.#needsDrawing = false;
    this.host.runtime.attemptOrFail(() => {
      this.#draw(elapsed);
      // Not where what was on its way has trapped.
      if (this.host.machine) this.host.runtime.confirmHealthy();
    });
  }

  #draw(elapsed: number) {
    const host = this.host;
    const began = performance.now();
    host.settings.settle();
    // It has trapped: the next picture is that of the core in its place.
    if (!host.machine) return;
    host.cloud?.advance(this.#printing);
    const { scene } = host;
    const { pressed: still, former } = host.gesture;
    const how = { elapsed, still, atOnce: this.#printing || isCalm(), former, highlight: host.highlight, handles: this.#printing };
    const shown = host.pictures.filter((picture) => isShown(this.canvasOf(picture)));
    const moving = shown.map((picture) => picture.draw(this.canvasOf(picture), scene, this.palette, how));
    host.placeHandles(scene);
    const now = performance.now();
    const since = this.#undescribedSince;
    // With the first picture there comes nothing else.
    if (this.opening ? since : !this.#resizing && (now - began < QUICK || now - (since ?? now) > LATEST_WORDS)) this.#describe();
    else {
      this.#undescribedSince ??= began;
      wake(this);
    }
    host.resolveSettled();
    const playing = host.player?.advance(elapsed);
    if (playing || moving.includes(true) || host.cloud?.isSettled === false) this.requestFrame();
  }

  /** Has the words rendered of what was drawn last, and the attributes say it. */
  #describe() {
    this.#isDescribed = true;
    this.#undescribedSince = undefined;
    this.host.reflection.updateAttributes();
    this.host.requestUpdate();
  }

  canvasOf({ name }: import('../scene/picture.ts').Picture<any>) {
    const canvases = this.#canvases as HTMLCanvasElement[];
    return canvases.find(({ className }) => className === name) as HTMLCanvasElement;
  }

  /** Whether there is something to draw on: not before a canvas has its pixels, nor inside a closed tab, where everything has size 0. */
  get #hasSize() {
    const shown = this.#canvases?.filter(isShown) ?? [];
    return shown.length > 0 && shown.every(({ width, height }) => Math.min(width, height) > 0);
  }

  /** Gives each canvas as many pixels as the screen has under it. */
  #resize(entries: ResizeObserverEntry[]) {
    for (const { target, contentRect, devicePixelContentBoxSize } of entries) {
      const canvas = target as HTMLCanvasElement;
      const exact = devicePixelContentBoxSize?.[0];
      canvas.width = Math.round(exact?.inlineSize ?? devicePixelRatio * contentRect.width);
      canvas.height = Math.round(exact?.blockSize ?? devicePixelRatio * contentRect.height);
    }
    this.#drawResized();
  }

  #drawResized() {
    if (this.#printing) {
      for (const canvas of this.#canvases ?? []) {
        const { clientWidth, clientHeight } = canvas;
        Object.assign(canvas, { width: PAPER_RATIO * clientWidth, height: PAPER_RATIO * clientHeight });
      }
    }
    // Inside a closed tab neither.
    this.#colour();
    // At once: a canvas that was resized is blank, and the next frame is too late to hide that.
    this.#resizing = true;
    this.#drawNow(0);
    this.#resizing = false;
  }

  /** The colours as they are now. */
  get palette() {
    return (this.#palette ??= resolvePalette(this.#find('.surface')));
  }

  /** The page's colours may be others, or the figure is to have other ones. */
  recolour() {
    this.#colour();
    this.requestFrame();
  }

  /** Paper and ink of the surroundings, or the figure's own where it is to be light and they are not, or dark. */
  #colour() {
    const style = this.#find('.surface')?.style;
    if (!style) return;
    const { scheme, ...around } = surroundings(this.#find('.scheme-probe'));
    // Forced colours are those of every theme.
    const theme = matchMedia('(forced-colors: active)').matches ? 'auto' : this.host.theme;
    style.colorScheme = this.#printing ? 'light' : theme === 'auto' ? scheme : theme;
    const own = this.#printing || style.colorScheme !== scheme;
    for (const [name, colour] of Object.entries(around)) style.setProperty(`--${name}`, own ? '' : colour);
    style.setProperty('--back', own ? 'var(--paper)' : '');
    // What the stylesheet takes from the page is for the page's own ground.
    for (const name of ['muted', 'rule']) style.setProperty(`--mw-${name}`, own ? 'initial' : '');
    this.#palette = undefined;
  }

  /** Paper is light, whatever the screen is, and has every figure of the page, complete and as fine as in a file. */
  #print(printing: boolean) {
    this.#printing = printing;
    const { machine, cloud } = this.host;
    if (!machine) {
      // The printer waits for no frame, but microtasks pass, and a module that another figure has needs no more.
      if (printing) void this.#startAndPrint();
      return;
    }
    if (printing) cloud?.finish();
    else this.#measure();
    this.#drawResized();
    this.#describe();
  }

  /** Makes a figure ready that is far from the window, and prints it. */
  async #startAndPrint() {
    await this.host.runtime.start();
    await this.host.updateComplete;
    if (this.host.machine) this.#print(this.#printing);
  }

  /** @param selector of what is there once the figure was rendered */
  #find(selector: string) {
    return this.host.renderRoot?.querySelector(selector) as HTMLElement;
  }
}
