/** <banana-machine>: one command, thousands of outcomes, and the coordinates in which they are nearly a Gaussian. */

import { html, nothing, css } from 'lit';
import { checkObject } from '../../data/checks.ts';
import { pictureHtml, disclosuresHtml, settingCheckboxHtml, settingRadiosHtml, settingSliderHtml, settingSlidersHtml, legendHtml } from '../../figure/controls.ts';
import { FigureElement } from '../../figure/figure.ts';
import { defineElement } from '../../figure/reflection.ts';
import { words } from '../../messages/registry.ts';
import { hasLength } from '../../scene/draw.ts';
import { Handle, stepsOfKey } from '../../scene/handle.ts';
import { MemoizedResult } from '../../scene/cache.ts';
import { openingAlphas } from '../../../build/settings.js';
import { buttonHtml, formatMarkup, radioButtonHtml, fieldsetHtml, checkboxHtml } from '../../ui/controls.ts';
import { clampNumber, formatFixed, formatEditable } from '../../ui/format.ts';
import { plotHtml } from '../../ui/plot.ts';
import { cloudProperties } from '../shared/cloud.ts';
import { Player, presetButtonsHtml } from '../shared/controls.ts';
import { describeCommand, subscriptOf } from '../shared/sliders.ts';
import { IntroducedCloud } from './introduction.ts';
import { MORPH_DURATION_MS, morphOutlines, morphPoint } from './morph.ts';
import { PlanePicture, TwistPicture } from './pictures.ts';
import { markedRobotFieldHtml, otherReadoutsHtml, mainReadoutsHtml, workedExampleTableHtml, calloutsOf, captionOf, floorTitleOf, twistCaptionOf } from './readouts.ts';
import { sliderSpecs, LINE_STYLES, OVERLAY_NAMES, definition, COMMAND_SLIDERS, viewModelOf, viewModelOfSettings, type ViewModel } from './settings.ts';
import type { StateValues } from '../../figure/settings.ts';
import type { BananaMachine as Simulation, BananaMachineSettings as Settings, Inspection, Motion } from '../../types.d.ts';

/** Displacement of the end of the arc per press of an arrow key, metres. */
const KEY_STEP = 0.02;

/** Names of the columns for executed motions in the exported table, by motion model. */
const EXECUTED_COLUMNS = {
  velocity: 'v_hat_m_per_s omega_hat_rad_per_s gamma_hat_rad_per_s',
  odometry: 'delta_hat_rot1_rad delta_hat_trans_m delta_hat_rot2_rad',
};

/** Number of points of the curve in the skew chart. With fewer points, the steep part at ω = 0 would show corners. */
const CURVE_POINT_COUNT = 241;

/** Values that the maximum of the skew chart's vertical axis can have. They are few, so that the axis seldom changes during a drag. */
const CHART_MAXIMA = [0.25, 0.5, 1, 2, 4, 8];

/** Number of the α that the checkbox Isolate selects first, so that only this α has an effect. α₄ is the noise of the turn rate from turning. */
const FIRST_ISOLATED_ALPHA = 4;

function modelControlsHtml(figure: BananaMachineElement) {
  const { model, isolate } = figure.viewModel.config;
  const texts = words.banana;
  return fieldsetHtml(texts.modelGroupTitle, html`${settingRadiosHtml(figure, 'model', texts.modelNames)} ${settingRadiosHtml(figure, 'noise', words.noiseNames)}
    ${model === 'odometry' ? settingCheckboxHtml(figure, 'reverseAware', texts.reverseAwareLabel) : nothing}
    ${checkboxHtml({
      labelContent: texts.isolateLabel,
      isChecked: isolate !== null,
      onChange: (isChecked) => figure.gesture.requestAndCommit({ isolate: isChecked ? FIRST_ISOLATED_ALPHA : null }),
    })}`);
}

/**
 * Indices of the α's whose sliders are always visible, by motion model. They set the noise of distance and turn on a straight drive. The cloud looks like a
 * banana if the noise of the turn is much larger.
 */
const VISIBLE_ALPHAS: Record<string, number[]> = { velocity: [0, 2], odometry: [1, 2] };

/** Returns a group of sliders: those of the α's that are always visible, or those of all other α's. */
function alphaGroupHtml(figure: BananaMachineElement, isVisible: boolean) {
  const { model, alphas } = figure.viewModel.config;
  const alphaIndices = [...alphas.keys()].filter((alphaIndex) => VISIBLE_ALPHAS[model].includes(alphaIndex) === isVisible);
  return fieldsetHtml(words.noiseHeading, alphaIndices.map((alphaIndex) => alphaSliderHtml(figure, alphaIndex + 1, words.alphas[model as 'velocity' | 'odometry'][alphaIndex])), isVisible ? 'pair' : 'alphas');
}

/** Returns the slider of an α. α's are numbered from 1. */
function alphaSliderHtml(figure: BananaMachineElement, alphaNumber: number, [alphaLabel, effectText]: string[]) {
  const { isolate } = figure.viewModel.config;
  const hasNoEffect = isolate !== null && isolate !== alphaNumber;
  const chooseAlpha = () => figure.gesture.requestAndCommit({ isolate: alphaNumber });
  return settingSliderHtml(figure, `alpha${alphaNumber}`, {
    name: alphaLabel,
    effect: formatMarkup(effectText),
    hasNoEffect,
    leadingControl: isolate === null ? undefined : radioButtonHtml({ groupName: 'isolate', name: words.banana.isolateAlphaLabel(`α${subscriptOf(alphaNumber - 1)}`), isChecked: !hasNoEffect, onChoose: chooseAlpha }),
    formatValue: (newAlpha) => (hasNoEffect ? words.banana.ignoredAlphaText(formatEditable(newAlpha, 3)) : formatEditable(newAlpha, 3)),
    onInput: (newAlpha) => {
      if (hasNoEffect) chooseAlpha();
      figure.settings.requestChange(({ alphas }) => ({ alphas: alphas.with(alphaNumber - 1, newAlpha) }));
    },
  });
}

const styles = css`
  /* The margin keeps the controls of the morph clear of the gradient that fades scrolled text below the pictures. */
  .morphing {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 0.5em 1em;
    margin-top: 0.7em;
  }

  .morph {
    flex: 1;
  }

  .morph .slider {
    padding-bottom: 0;
  }

  .morphing button {
    margin-bottom: 0;
  }

  /*
   * A narrow figure shows only the first picture, which can be morphed from the floor to exponential coordinates. The slider of the morph is
   * on a separate row, so that its track is long enough.
   */
  @container (width < 30em) {
    .views > .twist {
      display: none;
    }

    .morph {
      display: contents;
    }

    .morph .slider {
      flex: 1 0 100%;
    }
  }

  /* The three main readouts are in columns of equal width if the figure is wide enough. */
  .surface .simulation > .readouts {
    display: grid;
    gap: 0.4em 1.25em;
  }

  @container (min-width: 30em) {
    .views {
      grid-template-columns: 1fr 1fr;
    }

    .surface .simulation > .readouts {
      grid-template-columns: repeat(3, 1fr);
    }
  }
`;

/**
 * One command, thousands of outcomes, and the coordinates in which they are close to an ordinary Gaussian.
 *
 * @attr preset - A command to start from; null if the settings match no preset.
 * @attr overlays - The outlines that are drawn, separated by spaces in the attribute.
 * @attr morph - Stage of the picture, from 0 (the floor) to 1 (exponential coordinates).
 * @csspart figures - Readouts, chart and table.
 * @csspart chart - The chart of the skew.
 */
export class BananaMachineElement extends FigureElement<Simulation, ViewModel> {
  static styles = styles;

  static definition = definition;

  cloud = new IntroducedCloud(this);
  #executedMotionMemo: MemoizedResult<Inspection> = new MemoizedResult();
  #skewCurveMemo: MemoizedResult<Float64Array> = new MemoizedResult();
  #planePicture = new PlanePicture();
  #twistPicture = new TwistPicture();
  pictures = [this.#planePicture, this.#twistPicture];
  /** Handle at the end of the commanded arc, drawn as a ring. */
  #arcEndHandle = new Handle('end', {
    getView: () => this.#planePicture.pictureView,
    dragTo: (x, y) => this.#moveArcEnd(x, y),
    handleKey: (keyEvent) => {
      const keySteps = stepsOfKey(keyEvent);
      if (!keySteps || !this.simulation) return false;
      const [x, y] = this.visibleArcEnd;
      // At the maximum speed, the straight arc ends further from the start than any other arc. Its length therefore limits x.
      const maxX = sliderSpecs.v.max * this.settings.requestedValues.command.dt;
      this.#moveArcEnd(clampNumber(x + KEY_STEP * keySteps[0], -maxX, maxX), y + KEY_STEP * keySteps[1]);
      return true;
    },
    commitChange: () => this.gesture.commitChange(),
  });

  handles = [{
    render: () => this.#handleHtml(this.viewModel.config.command),
    placeHandles: () => this.#arcEndHandle.placeElementAt(this.renderRoot, ...this.#planePicture.pictureView.toPixel(...this.visibleArcEnd)),
  }];

  #pinnedViewModelMemo: MemoizedResult<ViewModel> = new MemoizedResult();

  player: Player<'morph'> = new Player(this, { morph: { max: 1, durationMs: MORPH_DURATION_MS } });

  // The simulation starts without samples. The first frame then appears quickly, and the user sees the cloud grow.
  createSimulation = ({ BananaMachine }: Motion) => BananaMachine.empty();

  enterState(simulation: Simulation, state: StateValues) {
    const { model, alphas, pinned } = state;
    // The α's of the other motion model are also passed to the simulation, because each model keeps its own α's.
    const otherModel = model === 'velocity' ? 'odometry' : 'velocity';
    simulation.configureFirst({ model: otherModel, alphas: alphas[otherModel] }, 0);
    // This call throws an error if the pinned settings (saved for comparison) are invalid.
    this.#viewModelOfPinned(pinned);
    super.enterState(simulation, { ...state, alphas: alphas[model] });
  }

  readViewModel = viewModelOf;

  get scene() {
    const viewModel = this.currentViewModel;
    const { motion } = this;
    const pinned = this.#pinnedViewModel;
    const { overlays, morph } = this.settings.elementState as { overlays: string[], morph: number };
    // Callouts are hidden while the outlines move, because the cloud grows or is dragged. During a morph their texts would be wrong.
    const areOutlinesMoving = this.cloud.playing || (this.gesture.isPressed && viewModel !== this.gesture.previousViewModel);
    const shownOutlineNames = OVERLAY_NAMES.filter((name) => name !== 'command' && overlays.includes(name) && hasLength(viewModel.contours[name]));
    const callouts = areOutlinesMoving || morph > 0 || shownOutlineNames.join() !== 'ellipse,exponential' ? [] : calloutsOf(viewModel);
    return {
      ...viewModel,
      simulation: this.simulation as Simulation,
      overlays,
      markedMotion: this.#selectedMotion,
      morph,
      outlinesOf: (otherViewModel: ViewModel, outlineMorph: number) => morphOutlines(motion, otherViewModel, outlineMorph),
      callouts,
      pinned,
      /** Returns the points of the visible outlines of the pinned settings, at a stage of the morph (0: floor, 1: exponential coordinates). */
      pinnedPointsAt: (outlineMorph: number) =>
        pinned ? Object.entries(morphOutlines(motion, pinned, outlineMorph)).flatMap(([name, outlinePoints]) => (overlays.includes(name) ? [...outlinePoints] : [])) : [],
      drivingProgress: this.cloud.drivingProgress,
    };
  }

  /** Results for the pinned settings, which the figure compares with the current cloud. */
  get #pinnedViewModel() {
    return this.#viewModelOfPinned(this.settings.elementState.pinned);
  }

  #viewModelOfPinned(pinned: Settings | null): ViewModel | undefined {
    return pinned ? this.#pinnedViewModelMemo.getResult([pinned], () => viewModelOfSettings(this.motion, pinned)) : undefined;
  }

  /** Pins the current settings (saves them for comparison), or unpins them. The pinned results are those of the complete cloud, even while the cloud grows. */
  #togglePin() {
    const { config } = this.currentViewModel;
    this.gesture.setElementField('pinned', this.settings.elementState.pinned ? null : { ...config, samples: Math.max(1, this.cloud.selectableCount) });
  }

  get exportData() {
    const { config } = this.currentViewModel;
    const { poses, twists, executed } = this.simulation as Simulation;
    return {
      columns: { 'x_m y_m theta_rad': poses, 'xi_along_m xi_lateral_m xi_heading_rad': twists, [EXECUTED_COLUMNS[config.model]]: executed },
    };
  }

  announcementOf = captionOf;

  describePicture = ({ config }: ViewModel) => [this.#planeTitle, describeCommand(config.command)];

  takeSnapshot() {
    return { ...super.takeSnapshot(), alphas: ((this.settings.isViewModelStale && this.simulation) || this.viewModel).alphasOfModels };
  }

  addDerivedFields(currentState: StateValues, changes: StateValues) {
    const alphas = checkObject('state.alphas', changes.alphas ?? {}, Object.keys(openingAlphas));
    return { ...super.addDerivedFields(currentState, changes), alphas: { ...currentState.alphas, ...alphas } };
  }

  /** Position (in the view's world coordinates) at which the end of the commanded arc is drawn. */
  get visibleArcEnd() {
    const { v, omega, dt } = this.currentViewModel.config.command;
    return morphPoint([v * dt, 0, omega * dt], this.settings.elementState.morph);
  }

  /** Executed motion of the selected robot; undefined if no robot is selected, or the selected robot is not shown. */
  get #selectedMotion() {
    const { simulation, viewModel, cloud: { isSelectionShown, selectedIndex } } = this;
    return isSelectionShown && simulation ? this.#executedMotionMemo.getResult([viewModel.stats, selectedIndex], () => simulation.inspect(selectedIndex)) : undefined;
  }

  /**
   * Sets the command so that its arc ends at a point in the view's world coordinates, within the range of the sliders. If several arcs end there, it takes
   * the one nearest to the current arc.
   */
  #moveArcEnd(x: number, y: number) {
    this.settings.requestChange(({ command }) => {
      const { v, omega } = this.motion.commandReaching(x, y, command, this.settings.elementState.morph);
      const clampToSlider = (commandNumber: number, { min, max }: { min: number, max: number }) => clampNumber(commandNumber, min, max);
      return { command: { ...command, v: clampToSlider(v, sliderSpecs.v), omega: clampToSlider(omega, sliderSpecs.omega) } };
    });
  }

  /** Renders the handle at the end of the commanded arc. During the introduction, a hint invites the user to drag it. */
  #handleHtml({ v, omega }: Settings['command']) {
    const texts = words.banana;
    const { min, max } = sliderSpecs.omega;
    const isAtLimit = [v - sliderSpecs.v.min, sliderSpecs.v.max - v, omega - min, max - omega].some((distanceToLimit) => distanceToLimit <= 0);
    return this.#arcEndHandle.handleHtml({
      handleName: texts.handleName,
      keysHint: texts.handleKeysHint,
      title: words.pose.moveTitle,
      valueRange: [min, max],
      sliderValue: omega,
      valueText: `v = ${formatFixed(v, 2)} m/s, ω = ${formatFixed(omega, 2)} rad/s`,
      limitText: isAtLimit && texts.sliderLimitText,
      hintText: this.cloud.isAsking && texts.dragHint,
    });
  }

  get #planeTitle() {
    const { morph } = this.settings.elementState;
    return morph === 0 ? floorTitleOf(this.viewModel) : morph === 1 ? words.banana.morph.morphedTitle : words.banana.morph.morphingTitle;
  }

  renderContent(viewModel: ViewModel) {
    const { unusualCloudNote } = viewModel;
    const texts = words.banana;
    return html`
      <div class="views">
        ${pictureHtml(this, this.#planePicture, this.#planeTitle)}
        ${pictureHtml(this, this.#twistPicture, texts.twistTitle, { className: 'twist', description: twistCaptionOf(viewModel) })}
      </div>
      ${this.renderer.renderAfterFirstPicture(() => html`
      <div class="morphing">
        ${this.player.sliderHtml('morph', texts.morph.playLabel)}
        ${buttonHtml(this.#pinnedViewModel ? texts.unpinLabel : texts.pinLabel, () => this.#togglePin(), { title: texts.pinTooltip, otherLabel: this.#pinnedViewModel ? texts.pinLabel : texts.unpinLabel })}
      </div>
      ${legendHtml(this, LINE_STYLES)}
      <p part="caption" class="caption ${unusualCloudNote && 'note'}">${captionOf(viewModel)}</p>
      ${mainReadoutsHtml(viewModel, this.#pinnedViewModel)} ${presetButtonsHtml(this)}
      <div class="controls" part="controls">
        ${fieldsetHtml(words.commandHeading, settingSlidersHtml(this, COMMAND_SLIDERS))} ${alphaGroupHtml(this, true)} ${fieldsetHtml(words.samplesHeading, this.cloud.buttonsHtml(), 'cloud')}
      </div>
      ${disclosuresHtml(this, {
        renderControls: () => html`<div class="controls">${alphaGroupHtml(this, false)} ${modelControlsHtml(this)} ${fieldsetHtml(words.samplesHeading, settingSliderHtml(this, 'samples'))}</div>`,
        renderNumbers: () => html`${markedRobotFieldHtml(this, this.#selectedMotion)} ${this.#numbersHtml(viewModel)}`,
      })}`)}
    `;
  }

  #numbersHtml(viewModel: ViewModel) {
    const texts = words.banana;
    return html`${otherReadoutsHtml(viewModel)}<p>${formatMarkup(texts.gainNote)}</p>
      <div class="figures" part="figures">
        <figure>${this.#skewChartHtml(viewModel)}<figcaption>${formatMarkup(texts.chartCaption)}</figcaption></figure>
        <figure>${workedExampleTableHtml(viewModel)}<p>${twistCaptionOf(viewModel)}</p></figure>
      </div>`;
  }

  #skewChartHtml({ config, stats, exactSkew }: ViewModel) {
    const { model, noise, command: { v, omega, dt }, alphas, isolate } = config;
    const texts = words.banana;
    const { min, max, step } = sliderSpecs.omega;
    // The cached curve is computed again only if a setting that affects it changes.
    const skews = this.#skewCurveMemo.getResult([JSON.stringify([model, noise, v, dt, alphas, isolate])], () => (this.simulation as Simulation).skewCurve(min, max, CURVE_POINT_COUNT));
    const maxSkew = skews.reduce((largestSoFar, skew) => Math.max(largestSoFar, Math.abs(skew) || 0), 0);
    const chartMaximum = CHART_MAXIMA.find((maxShownSkew) => maxShownSkew >= maxSkew) ?? maxSkew;
    const omegaRange = [min, max];
    return plotHtml({
      plotLabel: texts.chartDescription,
      x: { axisLabel: 'ω (rad/s)', min, max },
      y: { axisLabel: texts.readouts.skew, min: -chartMaximum, max: chartMaximum },
      plotCurves: [
        { name: texts.readouts.skew, colourRole: 'ink', x: skews.map((_, i) => min + (i * (max - min)) / (skews.length - 1)), y: skews },
        { name: texts.gaussianLineName, colourRole: 'prediction', dash: [7, 4], x: omegaRange, y: [0, 0] },
      ],
      dataPoints: [
        { colourRole: 'prior', x: omega, y: exactSkew, error: 0 },
        { colourRole: 'prediction', x: omega, y: stats.crossTrackSkew, error: stats.crossTrackSkewError },
      ],
      slider: {
        id: 'chart-omega',
        name: texts.chartSliderName,
        step,
        value: omega,
        valueText: texts.chartSliderText(formatFixed(omega, 2), formatFixed(exactSkew, 3)),
        onInput: (newOmega) => this.settings.requestChange(({ command }) => ({ command: { ...command, omega: newOmega } })),
        onCommit: () => this.gesture.commitChange(),
      },
    });
  }
}

defineElement(BananaMachineElement, cloudProperties);
