/** Cloud of samples that grows in steps, and its controls. */

import { range } from 'd3-array';
import { html } from 'lit';
import { FigureController } from '../../figure/controller.ts';
import { declarationOf, settingSliderHtml, type SliderSpec } from '../../figure/controls.ts';
import { prefersReducedMotion } from '../../figure/renderer.ts';
import { words } from '../../messages/registry.ts';
import { toViewPixels } from '../../scene/canvas.ts';
import { buttonHtml, fieldsetHtml, numberFieldHtml } from '../../ui/controls.ts';
import { formatInteger } from '../../ui/format.ts';
import type { Figure } from '../../figure/figure.ts';
import type { StateValues } from '../../figure/settings.ts';
import type { FigurePicture } from '../../scene/picture.ts';
import type { BananaMachine } from '../../types.d.ts';

type GrowingSimulation = Pick<BananaMachine, 'shown' | 'block' | 'configureFirst' | 'addSamples'>;

const GROWTH_STEP_COUNT = 150;

/** Maximum time (ms) for adding samples in a frame. The whole frame with its pictures then takes less than 50 ms. */
const MAX_SAMPLING_MS = 12;

export class Cloud extends FigureController {
  #hasGivenUp;

  /** Creates the cloud. `hasGivenUp` returns true if a simulation stopped before it had drawn all requested samples. Its argument is the simulation, or data that was read from it. */
  constructor(figure: Figure, hasGivenUp: (latestCounts: any) => boolean = () => false) {
    super(figure);
    this.#hasGivenUp = hasGivenUp;
  }

  /** Fields in the state of the element that belong to the cloud. */
  get #elementState() {
    return this.figure.settings.elementState as { playing: boolean, shown: number, marked?: number | null };
  }

  /** True while the cloud grows. */
  get playing() {
    return this.#elementState.playing;
  }

  get #simulation(): GrowingSimulation {
    return this.figure.simulation as GrowingSimulation;
  }

  /** Latest numbers of samples: those in the data on screen, or if the simulation has changed since then, those of the simulation. */
  get #latestCounts(): Pick<GrowingSimulation, 'shown' | 'block'> {
    const { settings, viewModel } = this.figure;
    return (settings.isViewModelStale && this.#simulation) || viewModel;
  }

  /** True if the goal is the whole cloud: all requested samples, or as many as the simulation can draw. */
  get isComplete() {
    return this.#elementState.shown >= this.#requestedCount || this.#hasGivenUp(this.#latestCounts);
  }

  get #requestedCount(): number {
    return this.figure.settings.currentValues.samples;
  }

  get #batchSize() {
    return Math.ceil(this.#requestedCount / GROWTH_STEP_COUNT);
  }

  /** Number of samples up to which samples are added: the requested number if the cloud is complete, otherwise the number `shown` of the state. */
  get targetCount() {
    return this.isComplete ? this.#requestedCount : this.#elementState.shown;
  }

  /** True if the cloud does not grow, and has `targetCount` samples, or as many as the simulation can draw. */
  get isSettled(): boolean {
    return !this.playing && (this.#latestCounts.shown >= this.targetCount || this.#hasGivenUp(this.#latestCounts));
  }

  /** Starts to grow the cloud, or shows the samples of a given state. If the user prefers reduced motion, all samples are shown at once. */
  showOrGrow(givenState?: StateValues) {
    if (!givenState) this.#elementState.playing = true;
    if (!givenState || this.isComplete) this.#elementState.shown = Infinity;
    if (!givenState && !prefersReducedMotion()) this.#restartSampling();
    if (this.playing && prefersReducedMotion()) this.addAllSamples();
  }

  #restartSampling() {
    this.#elementState.shown = 0;
    if (this.#latestCounts.shown > 0) this.#simulation.configureFirst({}, 0);
    this.figure.settings.isViewModelStale = true;
  }

  /** Shows all requested samples at once. If the cloud was growing, it is then complete. */
  addAllSamples() {
    if (this.playing) this.#elementState.shown = Infinity;
    this.#elementState.playing = false;
    this.addSamplesUnseen(Infinity);
  }

  showSamples(sampleCount: number) {
    this.#elementState.shown = Math.min(sampleCount, this.#requestedCount);
    this.addSamplesUnseen(Infinity);
  }

  /** Adds samples for at most `limitMs` milliseconds. Returns true if the cloud has `targetCount` samples, or as many as the simulation can draw. */
  addSamplesUnseen(limitMs = MAX_SAMPLING_MS): boolean {
    const { targetCount } = this;
    const endTime = performance.now() + limitMs;
    const latestCounts = this.#latestCounts;
    const { block } = latestCounts;
    let { shown } = latestCounts;
    while (shown < targetCount) {
      if (performance.now() > endTime) return false;
      const shownBefore = shown;
      shown = this.#simulation.addSamples(Math.min(targetCount - shown, block));
      // If no sample was added, the simulation has given up: it accepts too few samples.
      if (shown === shownBefore) break;
      this.figure.settings.isViewModelStale = true;
    }
    return true;
  }

  takeSnapshot(): StateValues {
    return { shown: this.targetCount, ...(this.#elementState.marked !== undefined && { marked: this.#isSelectionPossible ? this.selectedIndex : null }) };
  }

  /** Returns the field `shown` (number of samples to show) for a change of settings that does not contain it. */
  addDerivedFields(currentState: StateValues, { samples = currentState.samples }: StateValues): StateValues {
    return { shown: currentState.shown === currentState.samples ? samples : Math.min(currentState.shown, samples) };
  }

  /** Index of the selected sample; −1 for none. */
  get selectedIndex(): number {
    return this.#elementState.marked ?? -1;
  }

  select(sampleIndex: number) {
    if (sampleIndex === this.selectedIndex) return;
    this.#elementState.marked = sampleIndex < 0 ? null : sampleIndex;
    this.figure.renderer.requestFrame();
  }

  selectAtPointer(picture: FigurePicture<any>, pointerEvent: PointerEvent) {
    const { simulation, gesture } = this.figure;
    // On a touch screen a moving finger scrolls the page, so that only a tap selects a sample.
    if (!simulation || gesture.isPressed || (pointerEvent.pointerType === 'touch' && pointerEvent.type !== 'click')) return;
    const [x, y] = toViewPixels(pointerEvent.currentTarget as Element, picture.pictureView, pointerEvent);
    const sampleIndex = picture.findNearestSample(simulation, x, y);
    if (sampleIndex >= 0 || pointerEvent.type === 'click') this.select(sampleIndex);
  }

  /** True if the selected sample is shown. */
  get isSelectionShown() {
    return this.selectedIndex >= 0 && this.selectedIndex < this.#latestCounts.shown;
  }

  /** True if the selected sample is shown, or will be shown when the cloud has grown. */
  get #isSelectionPossible() {
    return this.selectedIndex >= 0 && this.selectedIndex < this.selectableCount;
  }

  /** Number of samples that the user can select or pin. It includes samples that will be added. */
  get selectableCount() {
    return this.playing ? this.#requestedCount : this.targetCount;
  }

  /** Clears the selection if the selected sample will never be shown. */
  clearStaleSelection() {
    if (!this.#isSelectionPossible) this.select(-1);
  }

  /** Adds samples during a frame. In the first frame after a change no samples are added to the first block, so that dragging a slider stays smooth. */
  addSamplesWhileDrawing() {
    if (this.playing) this.addGrowthStep();
    else if (!this.figure.settings.isViewModelStale) this.addSamplesUnseen();
  }

  addGrowthStep() {
    this.showSamples(this.#latestCounts.shown + this.#batchSize);
    if (!this.isComplete) return;
    this.#elementState.shown = Infinity;
    this.#elementState.playing = false;
    this.figure.announcer.requestAnnouncement();
  }

  /** Runs the action of a button below the cloud. After the action the cloud grows if `shouldPlay` is true, and stops otherwise. */
  #runControl(shouldPlay: boolean, runAction: () => void) {
    if (!this.figure.simulation) return;
    runAction();
    this.#elementState.playing = shouldPlay;
    this.figure.gesture.commitOneStep();
    this.figure.renderer.requestFrame();
  }

  buttonsHtml() {
    const cloudWords = words.cloud;
    const togglePlaying = () => this.#runControl(!this.playing, () => {
      if (!this.playing && this.isComplete) this.#restartSampling();
    });
    const [currentLabel, otherLabel] = this.playing ? [words.pauseLabel, cloudWords.drawLabel] : [cloudWords.drawLabel, words.pauseLabel];
    return html`<div class="buttons">
      ${buttonHtml(currentLabel, togglePlaying, { title: cloudWords.playTitle, otherLabel })}
      ${buttonHtml(words.stepLabel, () => this.#runControl(false, () => this.showSamples(this.#latestCounts.shown + this.#batchSize)), { title: cloudWords.stepTitle(formatInteger(this.#batchSize)), disabled: this.isComplete })}
      ${buttonHtml(words.clearLabel, () => this.#runControl(false, () => this.#restartSampling()), { title: cloudWords.clearTitle })}
      ${seedFieldHtml(this.figure)} ${buttonHtml(words.newSeed, () => this.figure.gesture.requestAndCommit(() => ({ seed: this.figure.motion.randomSeed() })), { title: cloudWords.newSeedTitle })}
    </div>`;
  }
}

/** Read-only properties that `defineElement` adds to elements with a cloud. */
export const cloudProperties: PropertyDescriptorMap & ThisType<Figure> = {
  playing: { get() { return (this.cloud as Cloud).playing; } },
  poses: { get() { return this.querySimulation((simulation) => simulation.poses); } },
};

type CloudFigure = Figure & { cloud: Cloud };

/** Returns the specification of a slider for the number of samples. Its stops are 10, 20, 50, 100 and so on, up to a maximum. */
export function createSamplesSliderSpec(maxSampleCount: number): SliderSpec {
  const sliderStops = range(1, 7).flatMap((exponent) => [1, 2, 5].map((decadeFactor) => decadeFactor * 10 ** exponent)).filter((sampleCount) => sampleCount <= maxSampleCount);
  return { symbol: '*N*', colourRole: 'truth', min: sliderStops[0], max: maxSampleCount, step: 1, decimals: 0, stops: sliderStops };
}

/** Returns the controls of the cloud: its size, its growth and its seed. */
export function cloudControlsHtml(figure: CloudFigure) {
  return fieldsetHtml(words.samplesHeading, html`${settingSliderHtml(figure, 'samples')} ${figure.cloud.buttonsHtml()}`, 'cloud');
}

function seedFieldHtml(figure: Figure) {
  return html`<form method="dialog">
    <label class="seed">${words.seed} ${numberFieldHtml({ ...declarationOf(figure, 'seed'), value: figure.settings.requestedValues.seed, onChange: (seed) => figure.gesture.requestAndCommit({ seed }) })}</label>
  </form>`;
}

/**
 * Returns the input field for the number of the selected sample (from 1 to `shownCount`), followed by a text about this sample. `id` is also the key of the
 * field's label among the messages.
 */
export function sampleFieldHtml({ cloud, definition }: CloudFigure, id: 'robot' | 'sample', shownCount: number, selectedSampleText: unknown) {
  const { [id]: label, markHint } = (words as any)[definition.messageKey];
  return html`<form method="dialog" class="marked">
    <label>
      ${label}
      ${numberFieldHtml({
        id,
        min: 1,
        max: Math.max(1, shownCount),
        type: 'whole',
        value: cloud.selectedIndex < 0 ? null : cloud.selectedIndex + 1,
        isOptional: true,
        placeholder: shownCount === 0 ? '' : `1–${formatInteger(shownCount)}`,
        isDisabled: shownCount === 0,
        onChange: (sampleNumber) => cloud.select((sampleNumber || 0) - 1),
      })}
    </label>
    <output for=${id}>${selectedSampleText || html`<i class="muted">${markHint}</i>`}</output>
  </form>`;
}
