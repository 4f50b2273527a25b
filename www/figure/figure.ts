/**
 * What every figure is: one simulation of a core of its own, pictures of it on canvases, and a state that
 * a page can read and set. Each of the parts that a figure is composed of has a file of its own.
 */

import { LitElement, nothing } from 'lit';
import { en } from '../messages/en.ts';
import { addEnglish, speak, words } from '../messages/registry.ts';
import { presentationStyles } from '../ui/presentation.ts';
import { theme } from '../ui/theme.ts';
import { Announcer } from './announcer.ts';
import { COMMON, HEADING_LEVELS } from './attributes.ts';
import { Focus } from './focus.ts';
import { Gesture } from './gesture.ts';
import { Link } from './link.ts';
import { Lettering } from './lettering.ts';
import { THEMES, schemeStyles } from './page/scheme.ts';
import { Notice, noticeStyles } from './notice.ts';
import { Progress, progressStyles } from './progress.ts';
import { Presentation } from './presentation.ts';
import { Reflection } from './reflection.ts';
import { Runtime } from './runtime.ts';
import { Settings } from './settings.ts';
import { Stage } from './stage.ts';
import { State } from './state.ts';
import { surface } from './surface.ts';
import { CopyMenu, embedding } from './takeaway/copy.ts';
import { csvOf, pngOf, svgOf } from './takeaway/export.ts';
import { Typing } from './typing.ts';
import type { FigureState, Motion } from '../types.d.ts';
import type { Values } from './state.ts';

/** Figure of whatever widget. */
export type Figure = FigureElement<any, any>;

addEnglish(en);

/**
 * A figure over one simulation object of a core. A widget says how its machine is made, what is asked of
 * it, what pictures and HTML show that, and what a reader may take along.
 *
 * Attributes and properties say what the figure shows, whoever has changed it, and take the same: a property takes texts too.
 * What is out of range is refused by an `error` event that names the field, the value and what is allowed, and the last good
 * value stays; `setState` throws.
 *
 * @attr theme - Colours for a light page or a dark one; auto is as the surroundings are.
 * @attr share - Keeps the state in the fragment of the page’s address. A state that it carries is opened, and kept up to date, in any case.
 * @attr presentation - Fills the screen, or the window, with pictures and figures for an audience: C shows the controls,
 *   Escape leaves.
 * @attr heading-level - Makes the slot `title` a heading of this level; the property is `headingLevel`.
 * @slot title - The title above the figure, with its number; the figure’s name for screen readers too.
 * @slot caption - What stands below it.
 * @fires load - The figure is ready.
 * @fires {ErrorEvent} error - Something was refused, or the core failed and was started again, or the figure cannot run;
 *   `message` says why. It does not bubble; where nothing prevents its default, the console says it too.
 * @fires input - The reader has changed something, and may go on.
 * @fires change - What the reader changed has come to rest.
 * @fires {CustomEvent} stats - There are fresh statistics; `detail` has them.
 * @csspart picture - A canvas with its handles.
 * @csspart caption - The sentences below a picture.
 * @csspart legend - What the lines and dots are, and which are shown.
 * @csspart controls - All controls.
 * @csspart slider - A slider with its name, value and effect.
 * @csspart button - A button.
 * @csspart readouts - The figures about the cloud.
 * @csspart table - A table of figures.
 * @csspart fold - What is folded away, with its name.
 * @csspart progress - The button that stops a long calculation.
 * @csspart exports - Pictures and data to take along.
 * @csspart copies - HTML to copy.
 * @cssprop --motion-paper - The ground of everything; without it, that of what is around the figure.
 * @cssprop --motion-ink - Text, and curves of charts; without it, the colour of the text around.
 * @cssprop --motion-muted - What explains: captions, axes, tracks.
 * @cssprop --motion-rule - Hairlines and grids.
 * @cssprop --motion-prior - What was commanded.
 * @cssprop --motion-prediction - What the model predicts: lines and text.
 * @cssprop --motion-cloud - The samples.
 * @cssprop --motion-truth - What is so, apart from any model: walls, the robot at its start.
 * @cssprop --motion-posterior - What exponential coordinates, or the map, make of it.
 * @cssprop --motion-accent - What is marked or noted, and the focus.
 * @cssprop --motion-font - The family of all text; without it, that of the text around.
 * @cssprop --motion-sticky-top - How much of the window’s top a header of the site covers: the picture that stays in sight on
 *   a phone keeps clear of it.
 * @cssprop --motion-sticky-bottom - Height of text below the figure beside which the picture still stays in sight. The text
 *   needs a `position` to be above the figure.
 */
export class FigureElement<Machine extends { free(): void, stats: object, config: Values, configure(settings: Values): Values }, Reading extends { config: Values, stats: object }> extends LitElement {
  static styles = [theme, schemeStyles, presentationStyles, progressStyles, noticeStyles];

  /** The widget's settings, as declared. */
  static declared: import('../settings.js').Declaration[];
  /** Appearance of the settings that have a slider. */
  static looks: Record<string, import('./controls.ts').Look> = {};
  /** The key of its words in the catalogues. */
  static vocabulary: string;
  /** Its attributes. */
  static attributes: import('./attributes.ts').Attributes = {};
  /** State of the element that is not its machine's. */
  static own: Record<string, import('./state.ts').Owned> = {};
  /** The settings whose values decide what others open with. */
  static defaultsDependOn: string[] = [];

  runtime = new Runtime(this);
  stage = new Stage(this);
  gesture = new Gesture(this);
  settings = new Settings(this);
  state = new State(this, this.kind.own);
  reflection = new Reflection(this, this.kind.attributes, this.kind.defaultsDependOn);
  link = new Link(this);
  announcer = new Announcer();
  progress = new Progress(this);
  notice = new Notice(this);
  copies = new CopyMenu(this);
  typing = new Typing(this);
  focusing = new Focus(this);
  lettering = new Lettering(this);
  presenting = new Presentation(this);
  /** Cloud of a figure with samples. */
  cloud: import('./cloud.ts').Cloud | undefined;
  /** Player of a figure that animates a slider. Called in each frame, it returns true if there is more. */
  player: { advance(elapsed: number): boolean } | undefined;
  /** The first is the one that is taken along, unless there is a plate. */
  pictures: import('../scene/picture.ts').Picture<any>[] = [];
  /** Picture for export, of a size of its own. */
  plate: import('../scene/picture.ts').Picture<any> & { size: { width: number, height: number } } | undefined;
  /** Latest reading of the machine; undefined before the first. */
  reading: Reading = undefined as any;
  #highlight: string | null = null;
  /** Resolves the promises of `settled`. */
  #waiting: (() => void)[] = [];
  #updating: boolean | undefined;

  /** The class of the widget, with what it says of all of its kind. */
  get kind() {
    return this.constructor as typeof FigureElement;
  }

  // What a widget says of itself; the first five, every widget does.

  /**
   * Makes a machine.
   *
   * @param _state that it is in; that of the opening where there is none
   * @throws {TypeError | RangeError} and there is none then
   */
  createMachine(_motion: Motion, _state?: Values): Machine {
    throw new Error('A widget makes its own machine.');
  }

  /** Completes a machine that was made of a state, and the state, where it takes more than settings. */
  complete(_machine: Machine, _state: Values) {}

  /** Everything that pictures and HTML need of the machine, asked once a change. */
  read(_machine: Machine): Reading {
    throw new Error('A widget reads its own machine.');
  }

  /** Scene of the pictures, with every change so far in effect. */
  get scene(): any {
    return this.fresh;
  }

  /** The figure in HTML. */
  content(_reading: Reading): unknown {
    return nothing;
  }

  /** Content for export, with every change so far in effect. */
  get takeaway(): import('./takeaway/export.ts').Takeaway {
    throw new Error('A widget says what is taken along.');
  }

  /** Announcement after a change has come to rest. */
  announcement(_reading: Reading) {
    return '';
  }

  /** Another machine has taken its place, and nothing of it is shown yet. */
  machineChanged() {}

  /** Lets go of what is no part of the state: the figure is to be as it opened. */
  startedOver() {}

  /** Puts the handles where the pictures have them now. */
  placeHandles(_scene: any) {}

  /** Everything that a reader can change, as the machine and the element have it. */
  snapshot(): Values {
    return { ...this.state.common, ...this.settings.declared(this.settings.present), ...this.cloud?.snapshot() };
  }

  /** A state that is given in part, with what follows of it for fields that are left out. */
  completed(present: Values, given: Values): Values {
    return { ...this.cloud?.completed(present, given), ...given };
  }

  get machine() {
    return this.runtime.machine as Machine | undefined;
  }

  get motion() {
    return this.runtime.motion as Motion;
  }

  // What is wanted, and what is shown.

  refresh() {
    const { machine } = this;
    if (!machine) return;
    speak(this);
    this.reading = this.read(machine);
    this.settings.stale = false;
    this.finishChange();
    this.dispatchEvent(new CustomEvent('stats', { detail: this.reading.stats, bubbles: true, composed: true }));
  }

  /** Keeps the state and announces what has come to rest, as of the latest reading. */
  finishChange() {
    this.announcer.setOutcome(() => this.announcement(this.reading));
    this.state.keep();
  }

  /** Reading of the machine, with every change so far in effect. */
  get fresh(): Reading {
    if (!this.machine) throw new Error('There is no figure yet: it is there from the load event on.');
    speak(this);
    this.settings.settle();
    if (this.settings.stale) this.refresh();
    return this.reading;
  }

  /**
   * Asks the machine, with every change so far in effect.
   *
   * @returns null where there is no machine
   */
  ask<Answer>(question: (machine: Machine) => Answer): Answer | null {
    const answer = this.runtime.attempt(() => {
      this.settings.settle();
      return this.machine && question(this.machine);
    });
    return answer ?? null;
  }

  // What a page has of every figure.

  /**
   * Statistics of the samples shown, which say how many these are; null before there are any. A large cloud is complete a few frames
   * after a change: see `settled`.
   *
   * @public
   */
  get stats(): Machine['stats'] | null {
    return this.ask((machine) => machine.stats);
  }

  /**
   * Promise that the figure is ready, every change is in effect, all samples are shown and no log is read. It starts a figure that is far
   * from the window. Growth that the reader sees is waited for.
   *
   * @public
   */
  get settled(): Promise<void> {
    return new Promise((resolve) => {
      this.#waiting.push(resolve);
      if (this.isConnected) void this.runtime.start();
      this.settings.show();
    });
  }

  /** True while a widget calculates something elsewhere. */
  get isBusy() {
    return false;
  }

  /** True if somebody waits for `settled`. */
  get isAwaited() {
    return this.#waiting.length > 0;
  }

  /** Resolves `settled` if the figure is. A figure that cannot run is. */
  resolveSettled() {
    if (!this.isAwaited) return;
    const { machine, cloud, settings, runtime } = this;
    const isSettled = machine ? !this.isBusy && !settings.isWaiting && (cloud?.isSettled ?? true) : runtime.failure !== undefined;
    if (isSettled) for (const resolve of this.#waiting.splice(0)) resolve();
  }

  /** Light, dark, or as the surroundings are. */
  get theme() {
    return THEMES.find((theme) => theme === this.getAttribute('theme')) ?? THEMES[0];
  }

  set theme(theme) {
    this.reflection.setAttribute('theme', theme);
  }

  /** Whether the page's address carries the state. */
  get share() {
    return this.hasAttribute('share');
  }

  set share(share: boolean | '') {
    this.toggleAttribute('share', share || share === '');
  }

  /** Whether it is shown to an audience. */
  get presentation() {
    return this.hasAttribute('presentation');
  }

  set presentation(presentation: boolean | '') {
    this.toggleAttribute('presentation', presentation || presentation === '');
  }

  /**
   * Name of the line that the pictures highlight, a word of `overlays`; null for none. No part of the state.
   *
   * @public
   */
  get highlight(): string | null {
    return this.#highlight;
  }

  set highlight(name) {
    this.#highlight = name;
    this.stage.requestFrame();
  }

  /** The level of the heading that the title is; null where it is none. */
  get headingLevel() {
    return HEADING_LEVELS.find((level) => level === this.getAttribute('heading-level')) ?? null;
  }

  set headingLevel(level) {
    this.reflection.setAttribute('heading-level', level);
  }

  /**
   * Everything that a reader can change, as plain data for `setState` and JSON. Of an element that is not
   * on the page, as it was when it left; null before it has come near the reader for the first time.
   *
   * @public
   */
  getState(): Values | null {
    return structuredClone(this.ask(() => this.snapshot()) ?? this.state.kept ?? null);
  }

  /**
   * Puts the element into a state, which names its `widget` and `version`; what else is left out stays as it is. Throws a
   * TypeError or RangeError that names the field, the value and what is allowed, and changes nothing then. What takes long comes
   * frame by frame; that the cells of a large grid have too many sides is told by an `error` event.
   *
   * @public
   */
  setState(state: Partial<Values> & FigureState) {
    this.reflection.whenReady(() => this.state.enter(state));
  }

  /**
   * The picture with twice the pixels of the screen, image/png. As the next two, throws before `load`.
   *
   * @public
   */
  async toPNG(): Promise<Blob> {
    return pngOf(this);
  }

  /**
   * The picture as vector graphics, with a title and a description.
   *
   * @public
   */
  toSVG(): string {
    return svgOf(this);
  }

  /**
   * Every sample shown, after a line with the settings and the seed.
   *
   * @public
   */
  toCSV(): string {
    return csvOf(this);
  }

  /**
   * The address of this page with the present state.
   *
   * @public
   */
  async shareLink(): Promise<string> {
    return this.link.address();
  }

  /**
   * HTML that shows the figure as it is now, on another page. What no attribute says, a map of one's own among it, is
   * not in it.
   *
   * @public
   */
  embedCode(): string {
    return embedding(this);
  }

  // The element's life.

  static get observedAttributes() {
    // HTML has attributes in lower case, whatever their properties are called.
    return [...super.observedAttributes, ...Object.keys({ ...this.attributes, ...COMMON }).map((name) => name.toLowerCase())];
  }

  attributeChangedCallback(name: string, old: string | null, text: string | null) {
    super.attributeChangedCallback(name, old, text);
    if (old === text) return;
    this.reflection.attributeChanged(name, text);
    if (!(name in COMMON)) return;
    this.requestUpdate();
    this.presenting.follow();
    this.stage.recolour();
  }

  /** LitElement does not hear of another update that is asked for while there is one. */
  requestUpdate(...change: Parameters<LitElement['requestUpdate']>) {
    // It asks for the first before there is anything of a figure.
    if (#updating in this && this.#updating) this.updateComplete.then(() => this.requestUpdate());
    else super.requestUpdate(...change);
  }

  update(changed: Parameters<LitElement['update']>[0]) {
    const rendered = () => {
      super.update(changed);
      return this;
    };
    this.#updating = true;
    try {
      // At once: what was shown before a trap stays, and in the place of what failed comes the sentence.
      if (!this.runtime.attemptOrFail(rendered)) rendered();
    } catch {
      // No template can be rendered here, now or later.
      this.shouldUpdate = () => false;
      this.renderRoot.textContent = words.failure(this.runtime.failure ?? '');
    } finally {
      this.#updating = false;
    }
  }

  render() {
    return surface(this);
  }
}
