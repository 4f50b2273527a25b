/** <arc-anatomy>: the arc between two poses, and how likely it is after a command. */

import { html, nothing, css } from 'lit';
import { pictureHtml, disclosuresHtml, settingCheckboxHtml, settingRadiosHtml, settingSlidersHtml, legendHtml } from '../../figure/controls.ts';
import { FigureElement } from '../../figure/figure.ts';
import { defineElement } from '../../figure/reflection.ts';
import { words } from '../../messages/registry.ts';
import { swatchHtml } from '../../ui/theme.ts';
import { fieldsetHtml, formatMarkup } from '../../ui/controls.ts';
import { Player, presetButtonsHtml } from '../shared/controls.ts';
import { PoseHandles } from '../shared/robot.ts';
import { describeCommand } from '../shared/sliders.ts';
import { ArcPicture, ROBOT_RADIUS } from './picture.ts';
import { formErrorsPlotHtml, factorBarsHtml, headlineHtml, likelihoodReadoutsHtml, tableLinesHtml, captionOf } from './readouts.ts';
import { LINE_STYLES, UNDERWAY_AT_END, definition, CONTOUR_STYLES, ALPHA_SLIDERS, COMMAND_SLIDERS, type ViewModel } from './settings.ts';
import type { ArcAnatomy as Simulation, Motion } from '../../types.d.ts';

/** Returns the controls of the likelihood: a checkbox that switches to the sign of the radius as printed in the book, radio buttons that choose a heat map, and a legend of the contours. */
function likelihoodControlsHtml(figure: ArcAnatomyElement) {
  const { likelihoodTitle, mapNames, printedRadiusLabel } = words.anatomy;
  const { map } = figure.settings.requestedValues;
  const contourEntryHtml = (name: 'prob' | 'density') => html`<span>${swatchHtml(CONTOUR_STYLES[name])} ${mapNames[name]}</span>`;
  return fieldsetHtml(likelihoodTitle, html`${settingCheckboxHtml(figure, 'printed', formatMarkup(printedRadiusLabel))} ${settingRadiosHtml(figure, 'map', mapNames)}
    ${map === 'none' ? nothing : html`<p class="legend">${contourEntryHtml('prob')} ${contourEntryHtml('density')}</p>`}`);
}

const styles = css`
  :is(.factors, .lines) {
    display: grid;
    gap: 0.5em;
    margin-bottom: 0.6em;
  }

  .factors li {
    display: grid;
    grid-template-columns: 1fr auto;
    align-content: start;
    padding-left: calc(0.5em + 3px);
  }

  :is(.factors.lit li, .weakest) {
    padding-left: 0.5em;
    border-left: 3px solid var(--accent);
  }

  .factors :is(.estimate, svg) {
    grid-column: 1 / -1;
  }

  .factors svg {
    width: 100%;
    height: 1.3em;
  }

  /* In a wide figure, the likelihood is next to the picture. */
  @container (min-width: 38em) {
    .views {
      grid-template-columns: minmax(0, 1fr) 16em;
    }
  }

  .handle.turn {
    --ring: var(--prediction);
  }

  .handle.turn.start {
    --ring: var(--truth);
  }
`;

/**
 * The arc between two poses, and how likely it is after a command.
 *
 * @attr preset - Command from the origin, and a final pose near its arc; null if the settings match no preset.
 * @attr overlays - The lines that are drawn, separated by spaces in the attribute.
 * @csspart chart - The plot of errors of three formulas of the arc, for nearly straight motions.
 */
export class ArcAnatomyElement extends FigureElement<Simulation, ViewModel> {
  static styles = styles;

  static definition = definition;

  #picture = new ArcPicture();
  pictures = [this.#picture];
  /** Handles of the start pose and the final pose. If the poses are at the same place, the handle of the final pose is on top. */
  handles: PoseHandles[] = ['start', 'next'].map((settingKey) => new PoseHandles(this, settingKey, () => ROBOT_RADIUS));

  /** Player of the animation in which robots drive along the arcs. It takes the same time for every command. */
  player: Player<'underway'> = new Player(this, { underway: { max: UNDERWAY_AT_END, durationMs: 2000 } });

  createSimulation = ({ ArcAnatomy }: Motion) => new ArcAnatomy();

  readViewModel = (simulation: Simulation): ViewModel => simulation.read();

  get exportData() {
    const { stats: { factors } } = this.currentViewModel;
    return {
      columns: {
        'estimate residual standard_deviation residual_over_deviation prob share_of_peak':
          factors.flatMap(({ estimate, residual, deviation, deviations, value, share }) => [estimate, residual, deviation, deviations, value, share]),
      },
    };
  }

  announcementOf = captionOf;

  describePicture = ({ config }: ViewModel) => [words.anatomy.floorTitle, describeCommand(config.command)];

  renderContent(viewModel: ViewModel) {
    const texts = words.anatomy;
    return html`
      <div class="views">
        ${pictureHtml(this, this.#picture, texts.floorTitle)}
        ${this.renderer.renderAfterFirstPicture(() => html`
        <div class="aside">${headlineHtml(viewModel)} ${factorBarsHtml(viewModel, this.settings.elementState.line)}</div>`)}
      </div>
      ${this.renderer.renderAfterFirstPicture(() => html`
      ${legendHtml(this, LINE_STYLES)}
      <p class="verdict caption" part="caption">${captionOf(viewModel)}</p>
      ${presetButtonsHtml(this)}
      <div class="controls" part="controls">${fieldsetHtml(words.commandHeading, settingSlidersHtml(this, COMMAND_SLIDERS))} ${fieldsetHtml(texts.timeTitle, this.player.sliderHtml('underway', words.playLabel))}</div>
      ${disclosuresHtml(this, {
        renderControls: () => html`<div class="controls">${likelihoodControlsHtml(this)}
          ${fieldsetHtml(words.noiseHeading, html`${settingRadiosHtml(this, 'noise', words.noiseNames)} ${settingSlidersHtml(this, ALPHA_SLIDERS)}`, 'alphas')}</div>`,
        renderNumbers: () => html`${tableLinesHtml(this)} ${likelihoodReadoutsHtml(viewModel)} ${formErrorsPlotHtml(this.motion)}`,
        csvTitle: texts.csvTitle,
      })}`)}
    `;
  }
}

defineElement(ArcAnatomyElement);
