/** <odometry-decomposer>: an odometry reading as rotate, drive, rotate, and the noise that localizers add to it. */

import { html, css } from 'lit';
import { pictureHtml, disclosuresHtml, settingRadiosHtml, settingSlidersHtml, legendHtml } from '../../figure/controls.ts';
import { FigureElement } from '../../figure/figure.ts';
import { defineElement } from '../../figure/reflection.ts';
import { words } from '../../messages/registry.ts';
import { MemoizedResult } from '../../scene/cache.ts';
import { formatMarkup, radioButtonHtml, fieldsetHtml } from '../../ui/controls.ts';
import { formatFixed } from '../../ui/format.ts';
import { tableHtml } from '../../ui/readouts.ts';
import { Cloud, cloudControlsHtml, cloudProperties } from '../shared/cloud.ts';
import { Player, presetButtonsHtml } from '../shared/controls.ts';
import { PoseHandles } from '../shared/robot.ts';
import { LegsPicture, ROBOT_RADIUS, WorldPicture } from './pictures.ts';
import { headlineHtml, outcomeReadoutsHtml, spreadPlotHtml, driftDistanceOf, captionOf } from './readouts.ts';
import { LINE_STYLES, definition, sliderSpecs, NOISE_SLIDERS, viewModelOf, type ViewModel } from './settings.ts';
import type { Motion, OdometryDecomposer as Simulation } from '../../types.d.ts';

/** Returns the table of standard deviations by noise model. Numbers that differ from those of Table 5.6 are bold. */
function noiseModelTableHtml(figure: OdometryDecomposerElement) {
  const { ruleNames, table: texts, settings } = words.decomposer;
  const { rules } = figure.viewModel;
  const currentRule = figure.settings.requestedValues.rule;
  const printedRows = rules.map(({ deviations, crossTrack, heading }) => [...deviations, crossTrack, heading].map((noiseValue) => formatFixed(noiseValue, 3)));
  return html`<div class="rules" role="radiogroup" aria-label=${settings.rule.name}>
    ${tableHtml({
      caption: formatMarkup(texts.caption),
      columnHeadings: [settings.rule.name, ...texts.columns.map(formatMarkup)],
      rows: rules.map(({ rule }, i) => [
        radioButtonHtml({ groupName: 'rule', labelContent: ruleNames[rule], isChecked: rule === currentRule, onChoose: () => figure.gesture.requestAndCommit({ rule }) }),
        ...printedRows[i].map((printedValue, columnIndex) => (printedValue === printedRows[0][columnIndex] ? printedValue : html`<strong>${printedValue}</strong>`)),
      ]),
    })}
  </div>`;
}

function noiseControlsHtml(figure: OdometryDecomposerElement) {
  return html`<div class="controls">
      ${fieldsetHtml(words.noiseHeading, html`${settingSlidersHtml(figure, NOISE_SLIDERS)} ${settingRadiosHtml(figure, 'noise', words.noiseNames)}`, 'alphas')}
      ${cloudControlsHtml(figure)}
    </div>
    <p>${formatMarkup(words.decomposer.correlationNote)}</p>`;
}

const styles = css`
  /* The picture is square, because on a phone the handles of two robots need space side by side. */
  .legs canvas {
    aspect-ratio: 1;
  }

  /* Two columns: the picture of the three legs with its texts, and the picture of the world with its texts. */
  @container (min-width: 38em) {
    .views {
      grid-template-columns: minmax(0, 3fr) minmax(0, 2fr);
    }

    /* Both pictures are as high as the window allows. */
    :host(:not([presentation])) .stage {
      height: clamp(12.5em, 100svh - 32.5em, min(45svh, 24em));
    }

    canvas {
      height: 100%;
    }

    .plays {
      display: grid;
      grid-template-columns: 1fr 1fr;
      column-gap: 2.5em;
    }

    /* Smaller gaps keep all presets in one row. */
    .presets {
      --beside: 0.45em;
      gap: 0.35em;
    }
  }

  @container (min-width: 56em) {
    :host(:not([presentation])) .stage {
      height: clamp(16.4em, 100svh - 28.6em, min(45svh, 24em));
    }
  }

  .rules table {
    max-width: none;
    margin-bottom: 0.5em;
  }

  /* Numbers that differ from the noise model of Table 5.6 are bold, on a tinted background. */
  .rules td:has(strong) {
    background: color-mix(in srgb, var(--prediction) 16%, var(--paper));
  }

  .rules :is(td, thead th:not(:first-child)) {
    padding-inline: clamp(0.05em, 4cqi - 1.1em, 0.54em);
  }

  .rules thead th:not(:first-child) {
    font-size: min(1em, 3.7cqi);
  }
`;

/**
 * Odometry read as rotate, drive, rotate, with the noise that localizers add to each part.
 *
 * @attr preset - An odometry reading to start from; null if the settings match no preset.
 * @attr overlays - Lines and marks that are drawn, separated by spaces in the attribute.
 * @csspart chart - Plot of the lateral standard deviation over the length of the drive.
 */
export class OdometryDecomposerElement extends FigureElement<Simulation, ViewModel> {
  static styles = styles;

  static definition = definition;

  cloud = new Cloud(this);
  player: Player<'phase' | 'drift'> = new Player(this, { phase: { max: sliderSpecs.phase.max, durationMs: 4000 }, drift: { max: sliderSpecs.drift.max, durationMs: 8000 } });
  #legsPicture = new LegsPicture();
  #worldPicture = new WorldPicture();
  pictures = [this.#legsPicture, this.#worldPicture];
  /** Handles of the poses before and after the motion. If both poses are at the same place, the handle of the second pose is on top. */
  handles: PoseHandles[] = ['from', 'to'].map((settingKey) => new PoseHandles(this, settingKey, () => ROBOT_RADIUS));

  createSimulation = ({ OdometryDecomposer }: Motion) => new OdometryDecomposer();

  #spreadCurveMemo: MemoizedResult<Float64Array> = new MemoizedResult();
  #spreadCurveOf = (maxLength: number, pointCount: number) =>
    this.#spreadCurveMemo.getResult([this.viewModel.stats, maxLength, pointCount], () => (this.simulation as Simulation).curve(maxLength, pointCount));

  readViewModel = viewModelOf;

  get exportData() {
    return { columns: { 'x_m y_m theta_rad': this.currentViewModel.poses } };
  }

  announcementOf = captionOf;

  describePicture = ({ legs: { rot1, trans, rot2 } }: ViewModel) => [words.decomposer.legsTitle, words.decomposer.readingDescription(formatFixed(rot1, 2), formatFixed(trans, 2), formatFixed(rot2, 2))];

  renderContent(viewModel: ViewModel) {
    const texts = words.decomposer;
    return html`
      <div class="views">
        ${pictureHtml(this, this.#legsPicture, texts.legsTitle, { className: 'legs' })}
        ${pictureHtml(this, this.#worldPicture, texts.worldTitle)}
        ${this.renderer.renderAfterFirstPicture(() => html`
        <div class="summary">${headlineHtml(viewModel)} <p class="caption" part="caption">${captionOf(viewModel)}</p></div>
        <p class="caption">${formatMarkup(texts.worldCaption(formatFixed(driftDistanceOf(viewModel), 2)))}</p>`)}
      </div>
      ${this.renderer.renderAfterFirstPicture(() => html`
      ${legendHtml(this, LINE_STYLES)} ${presetButtonsHtml(this)} ${noiseModelTableHtml(this)}
      <div class="plays" part="controls">${this.player.sliderHtml('phase', texts.playLabels.phase)} ${this.player.sliderHtml('drift', texts.playLabels.drift)}</div>
      ${disclosuresHtml(this, {
        renderControls: () => noiseControlsHtml(this),
        renderNumbers: () => html`${outcomeReadoutsHtml(viewModel)} ${spreadPlotHtml(this.#spreadCurveOf, viewModel)}`,
      })}`)}
    `;
  }
}

defineElement(OdometryDecomposerElement, cloudProperties);
