/** Base class of all figures: a simulation of the core, canvases, and a state that a page can read and set. */

import { LitElement, type CSSResultGroup } from 'lit';
import { en } from '../messages/en.ts';
import { addEnglishMessages, useLanguageOf, words } from '../messages/registry.ts';
import { Canvases } from '../scene/canvases.ts';
import { layoutStyles } from '../ui/layout.ts';
import { plotStyles } from '../ui/plot.ts';
import { presentationStyles } from '../ui/presentation.ts';
import { reservedHeightCssOf } from '../ui/reserved-height.ts';
import { themeStyles } from '../ui/theme.ts';
import { FigureColours } from './colours.ts';
import { COMMON_PROPERTIES, checkCommonValue, type CommonProperty, type HEADING_LEVELS, type THEME_NAMES } from './definition.ts';
import { csvOf, embedCodeOf, pngOf, svgOf } from './export.ts';
import { UserGesture } from './gesture.ts';
import { StateLink } from './link.ts';
import { Announcer, FigureNotice } from './notice.ts';
import { PresentationMode } from './presentation.ts';
import { AttributeReflection, settingAccessorsOf } from './reflection.ts';
import { FigureRenderer } from './renderer.ts';
import { CoreRuntime } from './runtime.ts';
import { STATE_VERSION, FigureSettings, type StateValues } from './settings.ts';
import { FocusKeeper, TextHeights, figureHtml } from './surface.ts';
import type { FigurePicture } from '../scene/picture.ts';
import type { FigureState, Motion } from '../types.d.ts';

export type Figure = FigureElement<any, any>;

addEnglishMessages(en);

/**
 * Figure with one simulation object of the core. A widget defines its simulation, view model, pictures, HTML and export.
 *
 * Attributes and properties set the values of the figure, and have its present values also after changes by the user. Properties accept texts.
 * A value out of range causes an `error` event that names the field, the value and what is allowed, and the last valid value stays;
 * `setState` throws.
 *
 * @attr theme - Colours for a light or a dark page; auto follows the surroundings.
 * @attr share - Keeps the state in the fragment of the page’s address. A state in the address is opened and kept up to date in any case.
 * @attr presentation - Fills the screen, or the window, with pictures and numbers for an audience. C shows the controls, Escape ends it.
 * @attr heading-level - Makes the slot `title` a heading of this level; the property is `headingLevel`.
 * @slot title - Title above the figure, with its number; also the figure’s name for screen readers.
 * @slot caption - Caption below the figure.
 * @fires load - The figure is ready.
 * @fires {ErrorEvent} error - A value was refused, the core failed and was restarted, or the figure cannot run; `message` gives the
 *   reason. The event does not bubble; unless its default is prevented, the console shows the message too.
 * @fires input - The user has changed something, and may continue.
 * @fires change - A change by the user is complete.
 * @fires {CustomEvent} stats - The statistics have changed; `detail` has them.
 * @csspart picture - Canvas with its handles.
 * @csspart caption - Sentences below a picture.
 * @csspart legend - Legend, which also hides and shows lines and dots.
 * @csspart controls - All controls.
 * @csspart slider - Slider with its name, value and effect.
 * @csspart button - Button.
 * @csspart readouts - Statistics of the samples.
 * @csspart table - Table of numbers.
 * @csspart fold - Disclosure, with its name.
 * @csspart notice - Message over the lower edge, with a button that closes it, or that stops a long calculation.
 * @csspart exports - Buttons that save pictures and data.
 * @csspart copies - Button that copies HTML.
 * @cssprop --motion-paper - Background; default: that of the surroundings.
 * @cssprop --motion-ink - Text, and curves of charts; default: the colour of the text around.
 * @cssprop --motion-muted - Captions, axes, tracks.
 * @cssprop --motion-rule - Hairlines and grids.
 * @cssprop --motion-prior - Commanded motion.
 * @cssprop --motion-prediction - Predictions of the model: lines and text.
 * @cssprop --motion-cloud - Samples.
 * @cssprop --motion-truth - Facts independent of any model: walls, the robot at its start.
 * @cssprop --motion-posterior - Results of exponential coordinates or the map.
 * @cssprop --motion-accent - Selection, notes, and the focus.
 * @cssprop --motion-font - Font family of all text; default: that of the text around.
 * @cssprop --motion-sticky-top - Height of the site’s header at the window’s top, which a picture that sticks on a phone keeps clear of.
 * @cssprop --motion-sticky-bottom - Height of text below the figure beside which the picture still sticks. The text needs a `position` to
 *   be above the figure.
 */
export abstract class FigureElement<Simulation extends { free(): void, stats: object, config: StateValues, configure(settings: StateValues): StateValues }, ViewModel extends { config: StateValues, stats: object }> extends LitElement {
  static definition: import('./definition.ts').WidgetDefinition;

  static properties: Record<string, Partial<CommonProperty>> = { ...COMMON_PROPERTIES, highlight: { attribute: false, default: null } };

  /** Puts the styles of all figures before those of the widget. */
  static finalizeStyles(widgetStyles: CSSResultGroup = []) {
    // Lit also calls this method on the base class, which defines no widget.
    const reservedStyles = this.definition ? reservedHeightCssOf(this.definition.widgetTag) : [];
    return super.finalizeStyles([themeStyles, presentationStyles, reservedStyles, ...layoutStyles, plotStyles, widgetStyles]);
  }

  /** Colours: light, dark, or auto for those of the surroundings. */
  declare theme: (typeof THEME_NAMES)[number];
  /** True if the page's address carries the state. */
  declare share: boolean;
  /** True while the figure is presented to an audience. */
  declare presentation: boolean;
  /** Heading level of the title; null if it is no heading. */
  declare headingLevel: (typeof HEADING_LEVELS)[number] | null;
  /**
   * Name of the highlighted line, a word of `overlays`; null for none. No part of the state.
   * @public
   */
  declare highlight: string | null;
  /** AbortController that is aborted when the element is removed from the page. Its signal removes the listeners on other objects. */
  lifetime = new AbortController();
  runtime = new CoreRuntime(this);
  canvases = new Canvases(() => this.renderer.drawResized());
  renderer = new FigureRenderer(this);
  colours = new FigureColours(this);
  gesture = new UserGesture(this);
  settings = new FigureSettings(this);
  reflection = new AttributeReflection(this);
  stateLink = new StateLink(this);
  announcer = new Announcer();
  notice = new FigureNotice(this);
  focusKeeper = new FocusKeeper(this);
  presentationMode = new PresentationMode(this);
  textHeights = new TextHeights(this);
  /** Cloud of a figure with samples. */
  cloud: import('../widgets/shared/cloud.ts').Cloud | undefined;
  /** Player of a figure that animates a slider. `advanceAnimation` returns true while it plays. */
  player: { advanceAnimation(elapsedMs: number): boolean, stopAnimation(): void } | undefined;
  /** Handlers for dragged files, if the figure accepts files. */
  dropHandlers: Record<'onDragOver' | 'onDragLeave' | 'onDrop', (dragEvent: DragEvent) => void> | undefined;
  /** Pictures on the canvases. The first has the handles, and is exported. */
  pictures: FigurePicture<any>[] = [];
  /** Handles: `render` returns their HTML, and `placeHandles` moves them to their places in the first picture. */
  handles: { render(): unknown, placeHandles(scene: any): void }[] = [];
  /** View model of the simulation: all values that pictures, texts and tables show, read at one time. Undefined before the first frame. */
  viewModel: ViewModel = undefined as any;
  #placeholderDelay: Promise<void> | undefined;
  #isPlaceholderDue = false;
  #settledResolvers: (() => void)[] = [];

  get definition() {
    return (this.constructor as typeof FigureElement).definition;
  }

  // Members that widgets override; the abstract ones are required.

  /** Creates a simulation with the opening settings. */
  abstract createSimulation(motionCore: Motion): Simulation;

  /** Configures a new simulation for a state, and may add missing fields to the state. Throws a TypeError or RangeError for an invalid state. */
  enterState(simulation: Simulation, figureState: StateValues) {
    const stateSettings = this.settings.pickSettings(figureState);
    if (this.cloud) (simulation as any).configureFirst(stateSettings, figureState.shown);
    else simulation.configure(stateSettings);
  }

  /** Returns the view model of the simulation. Called once for each change. */
  abstract readViewModel(simulation: Simulation): ViewModel;

  /** Scene of the pictures: the view model, the state of the element, and the simulation. */
  get scene(): any {
    const viewModel = this.currentViewModel;
    return { ...this.settings.elementState, ...viewModel, simulation: this.simulation };
  }

  /** Returns the HTML of the figure. */
  abstract renderContent(viewModel: ViewModel): unknown;

  /** Returns sentences, without full stops, that describe the first picture. The announcement follows them in the text equivalent. */
  abstract describePicture(viewModel: ViewModel): string[];

  /** Text equivalent of the first picture, in the page and in exported files. */
  get description() {
    return [...this.describePicture(this.viewModel).map((descriptionSentence) => `${descriptionSentence}.`), this.announcementOf(this.viewModel)].join(' ');
  }

  /** Settings and columns for exported files, after all pending changes. */
  abstract get exportData(): import('./export.ts').ExportData;

  /** Returns the announcement for screen readers after a completed change. */
  abstract announcementOf(viewModel: ViewModel): string;

  /** Selects the sample at the pointer when the pointer moves or clicks on a picture. */
  selectAtPointer(picture: FigurePicture<any>, pointerEvent: PointerEvent) {
    this.cloud?.selectAtPointer(picture, pointerEvent);
  }

  /** Runs after the simulation was replaced. */
  onSimulationReplaced() {}

  takeSnapshot(): StateValues {
    return { widget: this.localName, version: STATE_VERSION, ...this.settings.elementState, ...this.settings.pickSettings(this.settings.currentValues), ...this.cloud?.takeSnapshot() };
  }

  /** Returns a partial state, completed by the fields whose values follow from it. */
  addDerivedFields(currentState: StateValues, changedValues: StateValues): StateValues {
    return { ...this.cloud?.addDerivedFields(currentState, changedValues), ...changedValues };
  }

  get simulation() {
    return this.runtime.simulation as Simulation | undefined;
  }

  get motion() {
    return this.runtime.motionCore as Motion;
  }

  updateViewModel() {
    const { simulation } = this;
    // Without a simulation, as after a trap, the previous view model stays.
    if (!simulation) return;
    useLanguageOf(this);
    this.cloud?.clearStaleSelection();
    this.viewModel = this.readViewModel(simulation);
    this.settings.isViewModelStale = false;
    this.announceOutcome();
    this.dispatchEvent(new CustomEvent('stats', { detail: this.viewModel.stats, bubbles: true, composed: true }));
  }

  /** Announces the outcome of a change, unless the cloud is still growing. */
  announceOutcome() {
    if (this.cloud?.isSettled ?? true) this.announcer.setOutcome(() => this.announcementOf(this.viewModel));
  }

  /** View model of the simulation after all pending changes are applied. */
  get currentViewModel(): ViewModel {
    if (!this.simulation) throw new Error('There is no figure yet: it is there from the load event on.');
    useLanguageOf(this);
    this.settings.applyPending();
    if (this.settings.isViewModelStale) this.updateViewModel();
    return this.viewModel;
  }

  /** Returns the result of a query to the simulation, after all pending changes; null without a simulation. */
  querySimulation<Answer>(askSimulation: (simulation: Simulation) => Answer): Answer | null {
    this.settings.applyPending();
    return this.simulation ? askSimulation(this.simulation) : null;
  }

  // Public properties and methods.

  /**
   * Statistics of the samples shown, with their number; null before there are any. A large cloud takes a few frames to complete: see `settled`.
   * @public
   */
  get stats(): Simulation['stats'] | null {
    return this.querySimulation((simulation) => simulation.stats);
  }

  /**
   * Promise that resolves when the figure is ready, all changes are in effect and in its text, all samples are shown and no log is being read.
   * Reading it starts a figure that is far from the window. It waits until a visible cloud has grown.
   * @public
   */
  get settled(): Promise<void> {
    return new Promise((resolveSettled) => {
      this.#settledResolvers.push(resolveSettled);
      if (this.isConnected) void this.runtime.startCore();
      this.renderer.requestFrame();
    });
  }

  /** True while a widget calculates in the background. */
  get isBusy() {
    return false;
  }

  get isSettledAwaited() {
    return this.#settledResolvers.length > 0;
  }

  /** Resolves `settled` if the figure is settled or cannot run. */
  resolveIfSettled() {
    if (!this.isSettledAwaited) return;
    const { simulation, cloud, settings, runtime, renderer } = this;
    const isSettled = simulation ? !this.isBusy && !settings.hasPendingChanges && !renderer.hasPendingFrames && (cloud?.isSettled ?? true) : runtime.failureMessage !== undefined;
    if (isSettled) for (const resolveSettled of this.#settledResolvers.splice(0)) resolveSettled();
  }

  /**
   * Returns the whole state as plain data for `setState` and JSON. Returns null until the element first comes near the viewport.
   * @public
   */
  getState(): StateValues | null {
    this.settings.applyPending();
    return this.simulation || this.viewModel ? structuredClone(this.takeSnapshot()) : null;
  }

  /**
   * Applies a state, which names its `widget` and `version`; other missing fields keep their values. Throws a TypeError or RangeError that
   * names the field, the value and what is allowed, and then changes nothing. Long work is spread over frames; a grid whose cells have too
   * many sides is reported by an `error` event.
   * @public
   */
  setState(figureState: Partial<StateValues> & FigureState) {
    this.reflection.applyWhenReady(() => this.settings.applyState(figureState));
  }

  /**
   * Returns the picture as PNG, with two pixels per CSS pixel. Throws before `load`, as `toSVG` and `toCSV` do.
   * @public
   */
  async toPNG(): Promise<Blob> {
    return pngOf(this);
  }

  /**
   * Returns the picture as SVG, with a title and a description.
   * @public
   */
  toSVG(): string {
    return svgOf(this);
  }

  /**
   * Returns the samples shown as CSV, after a line with the settings and the seed.
   * @public
   */
  toCSV(): string {
    return csvOf(this);
  }

  /**
   * Returns the address of this page with the present state, but without a map that would make it too long.
   * @public
   */
  async shareLink(): Promise<string> {
    return this.stateLink.createShareAddress();
  }

  /**
   * Returns HTML that shows the figure in its present state on another page. State without an attribute, such as the user's map, is lost.
   * @public
   */
  embedCode(): string {
    return embedCodeOf(this);
  }

  connectedCallback() {
    this.lifetime = new AbortController();
    super.connectedCallback();
    this.#placeholderDelay ??= this.#delayPlaceholder();
  }

  disconnectedCallback() {
    this.lifetime.abort();
    super.disconnectedCallback();
  }

  /** Returns the accessors of a property. A widget's property is kept in the settings, unless the widget has accessors of its own. */
  static getPropertyDescriptor(name: string, key: symbol, options: CommonProperty): PropertyDescriptor | undefined {
    if (this.definition) return Object.hasOwn(this.prototype, name) ? undefined : settingAccessorsOf(name);
    const { get, set } = super.getPropertyDescriptor(name, key, options) as Required<PropertyDescriptor>;
    return {
      get(this: Figure) { return get.call(this) ?? options.default; },
      set(this: Figure, value: unknown) { this.runtime.attemptOrReport(() => set.call(this, checkCommonValue(name, value, options))); },
    };
  }

  /** Reserves the figure's space until the next task of the event loop. If the core is ready by then, no placeholder is rendered. */
  async #delayPlaceholder() {
    // In forced colours no space is reserved: Chromium keeps light colours in content that is rendered before `colours` has found a dark scheme.
    if (!matchMedia('(forced-colors: active)').matches) {
      const reservedSpace = this.renderRoot.appendChild(document.createElement('div'));
      reservedSpace.className = 'reserved';
      await new Promise((resolveTimeout) => setTimeout(resolveTimeout));
      reservedSpace.remove();
    }
    this.#isPlaceholderDue = true;
    if (!this.hasUpdated) this.requestUpdate();
  }

  protected shouldUpdate() {
    return this.#isPlaceholderDue || this.simulation !== undefined;
  }

  protected async getUpdateComplete() {
    await this.#placeholderDelay;
    return super.getUpdateComplete();
  }

  /** Draws again after a change of a property that every figure has, such as the theme. */
  updated(changedProperties: Parameters<LitElement['updated']>[0]) {
    if (changedProperties.size > 0) this.colours.applyAndDraw();
  }

  update(changedProperties: Parameters<LitElement['update']>[0]) {
    const updateContent = () => {
      super.update(changedProperties);
      return this;
    };
    try {
      // After a failure, the second call renders the failure message. After a trap, it keeps the previous content.
      if (!this.runtime.attemptOrFail(updateContent)) updateContent();
    } catch {
      // Not even the failure message can be rendered as a template. It is set as plain text, and further updates are prevented.
      this.shouldUpdate = () => false;
      this.renderRoot.textContent = words.failureMessage(this.runtime.failureMessage ?? '');
    }
  }

  render() {
    return figureHtml(this);
  }
}
