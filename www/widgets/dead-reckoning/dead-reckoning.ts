/** <dead-reckoning>: one command driven step after step, and how well its growing uncertainty is predicted. */

import { html, css } from 'lit';
import { pictureHtml, settingRadiosHtml, disclosuresHtml, panelHtml, settingSliderHtml, settingSlidersHtml, legendHtml } from '../../figure/controls.ts';
import { FigureElement } from '../../figure/figure.ts';
import { defineElement } from '../../figure/reflection.ts';
import { words } from '../../messages/registry.ts';
import { MemoizedResult } from '../../scene/cache.ts';
import { fieldsetHtml } from '../../ui/controls.ts';
import { formatFixed } from '../../ui/format.ts';
import { Cloud, cloudControlsHtml, cloudProperties } from '../shared/cloud.ts';
import { presetButtonsHtml } from '../shared/controls.ts';
import { describeCommand } from '../shared/sliders.ts';
import { PathPicture, StepPicture } from './pictures.ts';
import { headlineHtml, missTableHtml, ratioPlotHtml, straightGrowthPlotHtml, captionOf } from './readouts.ts';
import { CURVE_STYLES, OUTLINE_STYLES, RECURSIONS, definition, COMMAND_SLIDERS, NOISE_SLIDERS, TWIST_COMPONENTS, viewModelOf, type ViewModel } from './settings.ts';
import type { StateValues } from '../../figure/settings.ts';
import type { DeadReckoning as Simulation, Motion } from '../../types.d.ts';

/** Units of variances in column names, by component of the exponential coordinates. */
const VARIANCE_UNITS = { along: 'm2', lateral: 'm2', heading: 'rad2' };

/** Returns the names of an exported quantity's columns: one for each component of the exponential coordinates. */
const columnTitlesOf = (quantityName: string) => TWIST_COMPONENTS.map((name) => `${quantityName}_${name}_${VARIANCE_UNITS[name]}`).join(' ');

/** Returns settings that divide the same path into another number of steps. The selected step stays at about the same point of the path. */
function adaptSettingsToSteps({ command, steps: previousSteps, step }: Record<string, any>, steps: number) {
  return { steps, step: Math.max(1, Math.round((step * steps) / previousSteps)), command: { ...command, dt: (command.dt * previousSteps) / steps } };
}

function moreControlsHtml(figure: DeadReckoningElement) {
  const { steps, step, command: { dt } } = figure.settings.requestedValues;
  const { drivenTime, perNames } = words.reckoning;
  const drivenTimeText = drivenTime(formatFixed(step * dt, 2), formatFixed(steps * dt, 2));
  return html`<div class="controls">
    ${fieldsetHtml(words.commandHeading, html`${settingSlidersHtml(figure, COMMAND_SLIDERS)}
      ${settingSliderHtml(figure, 'step', { max: Math.max(2, steps), allowedNumbers: { min: 1, max: steps, type: 'whole' }, hasNoEffect: steps === 1, effect: drivenTimeText })}`)}
    ${fieldsetHtml(words.noiseHeading, html`${settingSlidersHtml(figure, NOISE_SLIDERS)} ${settingRadiosHtml(figure, 'per', perNames)}`)}
    ${cloudControlsHtml(figure)}
  </div>`;
}

const styles = css`
  .chart .plotted {
    max-width: calc(var(--most, 60svh) * 1.52);
    margin-inline: auto;
  }

  /* The line at the selected step can be dragged along the chart. */
  .chart input {
    cursor: ew-resize;
  }

  :host([presentation]) .views {
    --most: 41svh;
  }

  :host([presentation]) .step .stage {
    min-height: 20vh;
  }

  @container (min-width: 30em) {
    canvas {
      aspect-ratio: 1;
    }

    .step canvas {
      aspect-ratio: 2;
    }

    /* Two columns: the chart above its message, and the picture of the floor above the picture of the selected step. */
    .views {
      grid-template: auto auto / minmax(0, 1.45fr) minmax(0, 1fr);
      grid-auto-flow: column;
    }

    :host([presentation]) .views {
      grid-template-rows: 1fr auto;
    }

    .summary .caption {
      font-size: 0.95em;
      line-height: 1.25;
    }

    .summary .choices {
      grid-column: 1 / -1;
    }
  }

  @container (min-width: 56em) {
    :is(canvas, .step canvas) {
      aspect-ratio: 6 / 7;
    }

    .views {
      grid-template-columns: minmax(0, 1.75fr) repeat(2, minmax(0, 1fr));
    }

    .summary {
      grid-area: 2 / 1 / auto / -1;
      grid-template-columns: fit-content(12em) minmax(13.5em, 1fr) minmax(0, max-content);
      column-gap: 2em;
    }

    .summary .choices {
      grid-column: auto;
    }
  }
`;

/**
 * One command driven step after step, and how well its growing uncertainty is predicted.
 *
 * @attr preset - A path to start from; null if the settings match no preset.
 * @attr overlays - Curves and outlines that are drawn, separated by spaces in the attribute.
 * @csspart chart - The plot of predicted over measured variance.
 */
export class DeadReckoningElement extends FigureElement<Simulation, ViewModel> {
  static styles = styles;

  static definition = definition;

  cloud = new Cloud(this);
  #floorPicture = new PathPicture();
  #stepPicture = new StepPicture();
  pictures = [this.#floorPicture, this.#stepPicture];

  #straightGrowthMemo: MemoizedResult<Simulation['straightGrowth']> = new MemoizedResult();

  // The simulation starts without robots. The first frame then appears quickly, and the user sees the robots appear.
  createSimulation = ({ DeadReckoning }: Motion) => DeadReckoning.empty();

  addDerivedFields(currentState: StateValues, changedFields: StateValues) {
    // If the new path has fewer steps than the number of the selected step, its last step is selected.
    const { steps = currentState.steps } = changedFields;
    return { step: Math.min(currentState.step, steps), ...super.addDerivedFields(currentState, changedFields) };
  }

  readViewModel = viewModelOf;

  get exportData() {
    const { config } = this.currentViewModel;
    const { measured, relativeErrors, predicted } = this.simulation as Simulation;
    return {
      columns: {
        step: Array.from({ length: config.steps }, (_, i) => i + 1),
        [columnTitlesOf('measured')]: measured,
        [TWIST_COMPONENTS.map((name) => `relative_error_${name}`).join(' ')]: relativeErrors,
        ...Object.fromEntries(RECURSIONS.map((recursion) => [columnTitlesOf(recursion.replace('-', '_')), predicted[recursion]])),
      },
    };
  }

  describePicture = ({ config: { command, steps } }: ViewModel) => [words.reckoning.floorTitle, `${describeCommand(command)}; ${words.reckoning.settings.steps.name}: ${steps}`];

  announcementOf = (viewModel: ViewModel) => captionOf(viewModel, this.settings.elementState.overlays);

  renderContent(viewModel: ViewModel) {
    const { ratioCondition, config: { step } } = viewModel;
    const { overlays } = this.settings.elementState;
    const texts = words.reckoning;
    return html`
      <div class="views">
        ${panelHtml(texts.chartTitle, html`<div class="chart">${ratioPlotHtml(this, viewModel)}</div> ${legendHtml(this, CURVE_STYLES)}`, 'ratios')}
        <div class="summary">
          ${headlineHtml(viewModel, overlays)}
          <p part="caption" class="caption ${ratioCondition !== 'certain' && 'note'}">${captionOf(viewModel, overlays)}</p>
          ${settingRadiosHtml(this, 'compounding', texts.recursions)}
        </div>
        ${pictureHtml(this, this.#floorPicture, texts.floorTitle, { className: 'floor' })} ${pictureHtml(this, this.#stepPicture, texts.atStepTitle(step), { className: 'step' })}
      </div>
      ${this.renderer.renderAfterFirstPicture(() => html`
      ${legendHtml(this, OUTLINE_STYLES)} ${presetButtonsHtml(this)} 
      <div class="controls" part="controls">
        ${settingSliderHtml(this, 'headingNoise')} ${settingSliderHtml(this, 'steps', { onInput: (newStepCount) => this.settings.requestChange((requestedSettings) => adaptSettingsToSteps(requestedSettings, newStepCount)) })}
      </div>
      ${disclosuresHtml(this, {
        renderControls: () => moreControlsHtml(this),
        renderNumbers: () => html`${missTableHtml(viewModel, overlays)} ${straightGrowthPlotHtml(this.#straightGrowthMemo.getResult([viewModel.stats], () => (this.simulation as Simulation).straightGrowth))}`,
      })}`)}
    `;
  }
}

defineElement(DeadReckoningElement, cloudProperties);
