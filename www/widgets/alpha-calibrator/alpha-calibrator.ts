/** <alpha-calibrator>: α's fitted to a log, with confidence intervals and goodness of fit. */

import { html, css } from 'lit';
import { checkObject } from '../../data/checks.ts';
import { pictureHtml, disclosuresHtml, settingRadiosHtml, settingSliderHtml, legendHtml } from '../../figure/controls.ts';
import { FigureElement } from '../../figure/figure.ts';
import { defineElement } from '../../figure/reflection.ts';
import { words } from '../../messages/registry.ts';
import { toViewPixels } from '../../scene/canvas.ts';
import { MemoizedResult } from '../../scene/cache.ts';
import { fieldsetHtml } from '../../ui/controls.ts';
import { formatInteger } from '../../ui/format.ts';
import { startOverButtonHtml } from '../shared/controls.ts';
import { LogOpener, LogService, dropZoneHtml, isAbortError } from './open.ts';
import { legControlsHtml, legReadoutsHtml, modelControlsHtml, referenceControlsHtml } from './controls.ts';
import { LegPicture, PathPicture } from './pictures.ts';
import { alphaTableHtml, captionOf, diagnosticsHtml, judgeFit, nav2ButtonHtml, nav2ExportControlsHtml, regressionPanelsHtml, systematicTableHtml, verdictHtml } from './readouts.ts';
import { explainRecommendation } from './result.ts';
import { NOISE_COMPONENTS, LINE_STYLES, REGRESSORS, definition, modelRuleOf, viewModelOf, type ViewModel } from './settings.ts';
import type { AlphaCalibrator as Simulation, CalibrationLog, CalibrationPanel, LegView, Motion } from '../../types.d.ts';
import type { LogWarning } from '../../logs/log.ts';

/** Log of the user or of the page, with the serialized fit to the log and the settings of that fit. */
interface OpenedLog {
  log: CalibrationLog;
  /** Warnings about the logs. They make the α's doubtful. */
  warnings: LogWarning[];
  config: Simulation['config'];
  fit: Uint8Array;
}

/** Duration (ms) of a fit after which a notice is shown. */
const NOTICE_DELAY_MS = 200;

const styles = css`
  .drop-zone {
    margin-bottom: 0.4em;
    padding: 0.25em 0.6em;
    border: 1px dashed var(--muted);
    border-radius: 3px;
  }

  .drop-zone p {
    margin: 0;
  }

  .choosers select {
    max-width: 100%;
    font: inherit;
  }

  /* In a presentation the figure fills the screen, and has no space for the questions about logs and the summary of logs. */
  :host([presentation]) :is(.choosers, .found) {
    display: none;
  }

  .drive {
    display: flex;
    flex-wrap: wrap;
    gap: 0.5em 1.5em;
    align-items: flex-start;
  }

  .found table {
    flex: 1 1 18em;
  }

  .found :is(thead th, th, td) {
    text-align: start;
    vertical-align: top;
  }

  .found td {
    overflow-wrap: anywhere;
  }

  .paths {
    flex: 0 0 14em;
  }

  .badge {
    margin-inline-end: 0.4em;
    padding: 0.1em 0.6em;
    border-radius: 3px;
    background: var(--role);
    color: var(--paper);
    font-weight: bold;
    forced-color-adjust: none;
  }

  /* Dims the results on screen while another log is read or a fit takes long, because they belong to the previous log or settings. */
  .spoken:has(progress) :is(.verdict, .fitted) {
    opacity: 0.4;
  }

  /* Greys out the results on screen if files were refused, because the results belong to the previous log. */
  .spoken:has(.other-results) :is(.verdict, canvas, .fitted, #numbers) {
    color: var(--muted);
    filter: grayscale(1);
  }

  /* A verdict below the reason for a refusal would be taken for the verdict on the refused files. */
  .spoken:has(.other-results) .verdict > :is(.badge, strong) {
    display: none;
  }

  table {
    max-width: none;
    margin: 0.2em 0 0.5em;
    font-size: 0.84em;
    line-height: 1.2;
  }

  .fitted > p {
    margin: 0.2em 0;
    line-height: 1.3;
  }

  /* Reserves space for advice. Otherwise a slider would move during a drag whenever advice appears. */
  .to-do {
    min-height: 3.9em;
  }

  /* In a presentation, the pictures fill the space that the verdict and the table leave free. */
  :host([presentation]) .views {
    grid-template-rows: auto 1fr;
  }

  :host([presentation]) .one {
    display: grid;
    grid-template-rows: 1fr auto;
    align-self: stretch;
  }

  @media print {
    :is(.drop-zone, .found) {
      display: none;
    }
  }

  @container (min-width: 38em) {
    .views {
      grid-template-columns: repeat(2, minmax(0, 1fr));
    }

    :is(.verdict, .fitted) {
      grid-column: 1 / -1;
    }

    .to-do {
      min-height: 6.5em;
    }

    .one canvas {
      aspect-ratio: 5 / 2;
    }
  }

  /* In a low window the pictures scroll away with the page. If they stayed in view, there would be no space for the controls. */
  @media (40em <= height < 60em) {
    @container (30em <= width < 56em) {
      .views {
        position: static;
      }
    }
  }

  @container (min-width: 56em) {
    .views {
      /* The table of the α's appears later than the pictures. The fixed width of its column prevents the pictures from moving then. */
      grid-template-columns: minmax(0, 1.2fr) minmax(0, 1fr) clamp(24em, 34cqi, 29em);
    }

    .fitted {
      grid-column: auto;
    }

    /* A wide figure reserves no space for advice, because the pictures next to the advice are higher. */
    .to-do {
      min-height: 0;
    }

    .fitted .panel-title {
      flex: 1 0 100%;
    }

    canvas {
      aspect-ratio: 8 / 7;
    }

    .one canvas {
      aspect-ratio: 5 / 4;
    }
  }
`;

/**
 * Noise parameters (α's) fitted to a log, with their confidence intervals, and checks of the model.
 *
 * @attr overlays - The lines that are drawn, separated by spaces in the attribute.
 * @csspart drop - The line that logs are dropped on.
 * @csspart chart - A plot of residuals.
 */
export class AlphaCalibratorElement extends FigureElement<Simulation, ViewModel> {
  static styles = styles;

  static definition = definition;

  static properties = { log: { attribute: false } };

  #pathPicture = new PathPicture();
  #legPicture = new LegPicture();
  pictures = [this.#pathPicture, this.#legPicture];
  #logOpener = new LogOpener(this);
  dropHandlers = this.#logOpener;
  logService = new LogService();
  #fitMemo: Parameters<typeof viewModelOf>[2] = new MemoizedResult();
  #predictedLegMemo: MemoizedResult<LegView | null> = new MemoizedResult();
  #panelsMemo: MemoizedResult<{ regressor: (typeof REGRESSORS)[number], componentPanels: CalibrationPanel[] }[]> = new MemoizedResult();
  /** Log of the user or of the page; null for the simulated log. */
  #givenLog: OpenedLog | null = null;
  /** Log of the page; null for the simulated log. */
  #pageLog: CalibrationLog | null = null;
  /** Log that was rendered most recently; null for the simulated log. */
  #renderedLog: CalibrationLog | null = null;

  createSimulation = ({ AlphaCalibrator }: Motion, givenLog = this.#givenLog) => (givenLog ? AlphaCalibrator.restored(givenLog.config, givenLog.fit) : new AlphaCalibrator());

  readViewModel(simulation: Simulation) {
    const viewModel = viewModelOf(simulation, this.log, this.#fitMemo);
    if (viewModel.isPending) this.#refit();
    return viewModel;
  }

  get isBusy() {
    return this.logService.isBusy || this.#logOpener.readFraction !== undefined || this.viewModel?.isPending;
  }

  connectedCallback() {
    super.connectedCallback();
    // An element outside the document computes no fits. Once it is in the document, it fits with the settings that were changed in between.
    this.settings.isViewModelStale = true;
  }

  disconnectedCallback() {
    super.disconnectedCallback();
    this.logService.endWorker();
  }

  updated() {
    const { viewModel } = this;
    if (!viewModel || viewModel.log === this.#renderedLog) return;
    // A new log may have shorter texts. The heights that were reserved for the texts on the previous log are therefore measured again.
    this.#renderedLog = viewModel.log;
    this.textHeights.measureAgain();
  }

  /** Index of the leg that the picture shows; −1 if the fit has no legs. */
  get chosenLegIndex() {
    const { viewModel: { defaultLeg, legs }, settings: { elementState: { leg } } } = this;
    return leg !== null && leg < legs.count ? leg : defaultLeg;
  }

  /** Selected leg in the latest complete fit: its predicted cloud, start pose, and end poses by odometry and reference. Null if the fit has no legs. */
  get predictedLeg() {
    const { chosenLegIndex, simulation, viewModel: { config } } = this;
    return chosenLegIndex < 0 || !simulation ? null : this.#predictedLegMemo.getResult([config, chosenLegIndex], () => simulation.leg(chosenLegIndex));
  }

  /** Squared residuals of each noise component, binned by squared rotation and by squared translation; empty without legs. */
  get regressionPanels() {
    const { simulation, viewModel: { stats, legs } } = this;
    return legs.count > 0 && simulation ? this.#panelsMemo.getResult([stats], () => REGRESSORS.map((regressor) => ({ regressor, componentPanels: simulation.panels(regressor) }))) : [];
  }

  get scene() {
    const viewModel = this.currentViewModel;
    return { ...viewModel, chosenLegIndex: this.chosenLegIndex, leg: this.predictedLeg, overlays: this.settings.elementState.overlays };
  }

  /** Chooses the leg that is clicked in the picture of the path. */
  selectAtPointer(picture: PathPicture | LegPicture, pointerEvent: PointerEvent) {
    const { simulation } = this;
    if (!simulation || pointerEvent.type !== 'click') return;
    const leg = picture.findNearestSample(simulation, ...toViewPixels(pointerEvent.target as Element, picture.pictureView, pointerEvent));
    if (leg >= 0) this.gesture.requestAndCommit({ leg });
  }

  /**
   * A log of the page’s own; null for the simulated one. `getState` and shared links do not contain it.
   *
   * @public
   */
  get log(): CalibrationLog | null {
    return this.#givenLog?.log ?? null;
  }

  set log(log) {
    this.reflection.setProperty('log', log, (newLog) => {
      if (newLog !== null) checkObject('log', newLog, ['name', 'odometry', 'reference']);
      this.logService.stopRequest();
      const acceptLog = () => {
        this.#pageLog = newLog;
        this.reflection.updateAttributes();
      };
      this.openLog(newLog, []).then(acceptLog, this.#reportError);
    });
  }

  #startOver = () => {
    this.settings.restoreAsUser();
    this.#logOpener.closeLog(this.#pageLog).catch(this.#reportError);
  };

  #reportError = (error: unknown) => {
    if (!isAbortError(error)) this.runtime.reportError(error);
  };

  /**
   * Fits a log, and then shows it in place of the present log; null stands for the simulated log. If `checkSimulation` throws, the present log stays.
   * `warnings` are about the new log, and make its α's doubtful.
   */
  async openLog(log: CalibrationLog | null, warnings: LogWarning[], checkSimulation?: (simulation: Simulation) => void) {
    const config = this.settings.pickSettings(this.settings.currentValues) as Simulation['config'];
    const openedLog = log && { log, warnings, config, fit: await this.logService.calibrate(config, log) };
    this.runtime.attemptWork(() => {
      if (!this.simulation) return;
      this.settings.applyPending();
      const simulation = this.createSimulation(this.motion, openedLog);
      this.enterState(simulation, this.settings.currentValues);
      checkSimulation?.(simulation);
      if (log !== this.log) {
        this.settings.elementState.leg = null;
        for (const { pictureView } of this.pictures) pictureView.clearTarget();
      }
      this.#givenLog = openedLog;
      this.runtime.replaceSimulation(simulation);
      this.renderer.requestFrame();
    });
  }

  /** Fits the present log with the requested settings. Until the fit is complete, the figure shows the previous fit. */
  async #refit() {
    const { log, logService, notice } = this;
    if (!log || logService.isBusy || !this.isConnected) return;
    const stopFit = () => {
      this.announcer.announceText(words.progress.stoppedNotice);
      this.#revertSettings();
    };
    const noticeTimerId = setTimeout(() => notice.showWork(() => html`<progress aria-label=${words.progress.label}></progress> ${words.progress.label}`, stopFit), NOTICE_DELAY_MS);
    try {
      await this.openLog(log, this.warnings);
    } catch (error) {
      if (!isAbortError(error)) this.#revertSettings();
      this.#reportError(error);
    } finally {
      clearTimeout(noticeTimerId);
      notice.endWork();
    }
  }

  /** Aborts a running fit, and restores the settings of the fit on screen. */
  #revertSettings() {
    this.logService.stopRequest();
    this.settings.assignValues(this.viewModel.fittedConfig);
  }

  /** Warnings about the logs. They make the α's doubtful. */
  get warnings() {
    return this.#givenLog?.warnings ?? [];
  }

  get logName() {
    const { log } = this.viewModel;
    return log ? log.name || words.calibrator.overlays.odometry : words.calibrator.simulatedLogName;
  }

  get exportData() {
    const { fittedConfig, legs } = this.currentViewModel;
    const missingNote = this.log ? words.calibrator.logNotInCopiesNote : '';
    const poseColumnsOf = (logName: string) => ['from', 'to'].flatMap((poseName) => ['x_m', 'y_m', 'theta_rad'].map((coordinateName) => `${logName}_${poseName}_${coordinateName}`)).join(' ');
    return {
      settings: { ...(this.log && { log: this.log.name }), ...fittedConfig },
      columns: {
        'begins_s ends_s': legs.times,
        [poseColumnsOf('odometry')]: legs.odometry,
        [poseColumnsOf('reference')]: legs.reference,
        [NOISE_COMPONENTS[fittedConfig.model].map((componentName) => `residual_${componentName}`).join(' ')]: legs.residuals,
        outlier: legs.outliers,
      },
      linkNote: missingNote,
      codeNote: missingNote,
    };
  }

  announcementOf(viewModel: ViewModel) {
    return captionOf({ viewModel, warnings: this.warnings, logName: this.logName });
  }

  describePicture = () => [words.calibrator.pathTitle];

  renderContent(viewModel: ViewModel) {
    const texts = words.calibrator;
    const { chosenLegIndex } = this;
    const hasDuration = this.settings.requestedValues.duration > 0;
    return html`
      ${dropZoneHtml(this, this.#logOpener)}
      <div class="views">
        <p part="caption" class="caption verdict">${this.renderer.renderAfterFirstPicture(() => verdictHtml(this))}</p>
        ${pictureHtml(this, this.#pathPicture, texts.pathTitle)}
        <div class="one">
          ${pictureHtml(this, this.#legPicture, texts.legTitle(formatInteger(chosenLegIndex + 1)))}
          ${this.renderer.renderAfterFirstPicture(() => html`<div class="looked with-button">${legControlsHtml(this)}</div>`)}
        </div>
        ${this.renderer.renderAfterFirstPicture(() => html`
        <div class="fitted" part="readouts">
          <div class="buttons result">
            <p class="panel-title">${texts.alphas.title(texts.modelRuleNames[modelRuleOf(viewModel.fittedConfig)])}</p>
            ${nav2ButtonHtml(this, this.#logOpener.otherResultsNote)} ${startOverButtonHtml(this, this.#startOver)}
          </div>
          <p class="to-do">${this.#logOpener.otherResultsNote || judgeFit(this).advice.join(' ')}</p>
          ${alphaTableHtml(viewModel)}
          <p class="muted small">${explainRecommendation(viewModel.stats, texts)}</p>
        </div>`)}
      </div>
      ${this.renderer.renderAfterFirstPicture(() => html`
      ${legendHtml(this, LINE_STYLES)}
      <div part="controls">
        ${fieldsetHtml(texts.leg.legsTitle, html`<div class="controls">${['distance', 'angle'].map((lengthSettingKey) => settingSliderHtml(this, lengthSettingKey, { hasNoEffect: hasDuration }))}</div>`)}
      </div>
      ${disclosuresHtml(this, {
        renderControls: () => html`${modelControlsHtml(this)}
          ${fieldsetHtml(texts.systematic.title, systematicTableHtml(this))}
          ${fieldsetHtml(texts.logControls.title, referenceControlsHtml(this))}
          ${fieldsetHtml(texts.predictionTitle, html`${settingRadiosHtml(this, 'noise', words.noiseNames)} ${settingSliderHtml(this, 'inflation')}`, 'fit')}`,
        renderNumbers: () => html`${fieldsetHtml(texts.legTitle(formatInteger(chosenLegIndex + 1)), legReadoutsHtml(this))}
          ${diagnosticsHtml(this)}
          ${fieldsetHtml(texts.panels.title, regressionPanelsHtml(this))}
          ${fieldsetHtml(texts.nav2.title, nav2ExportControlsHtml(this, this.#logOpener.otherResultsNote))}`,
        csvTitle: texts.csvTitle,
      })}
      ${this.#logOpener.logModule?.logSummaryHtml(this.#logOpener)}`)}
    `;
  }
}

defineElement(AlphaCalibratorElement);
