/** <dead-reckoning>: one command driven step after step, and how well its growing uncertainty is predicted. */

import { html } from 'lit';
import { Cloud, enterCloud } from '../../figure/cloud.ts';
import { pictureCanvas, settingRadios, disclosures, titledPicture } from '../../figure/controls.ts';
import { FigureElement } from '../../figure/figure.ts';
import { legend } from '../../figure/overlays.ts';
import { define } from '../../figure/reflection.ts';
import { words } from '../../messages/registry.ts';
import { Memo } from '../../scene/memo.ts';
import { presetButtons } from '../shared/presets.ts';
import { moreControls, pathControls } from './controls.ts';
import { PathPicture, StepPicture } from './pictures.ts';
import { COMPONENTS, readingOf, type Reading } from './reading.ts';
import { headline, markedRobot, missTable, ratioPlot, straightPlot } from './readouts.ts';
import { OUTLINE_STYLES, RECURSIONS, definition } from './settings.ts';
import { styles } from './styles.ts';
import { announcementOf, captionOf, planeText, stepText } from './words.ts';
import type { Values } from '../../figure/settings.ts';
import type { DeadReckoning as Machine } from '../../types.d.ts';

/** Units of the components' variances. */
const VARIANCE_UNITS = { along: 'm2', lateral: 'm2', heading: 'rad2' };

/** Returns the names of the columns of a quantity in a table, one for each component. */
const columnsOf = (quantity: string) => COMPONENTS.map((name) => `${quantity}_${name}_${VARIANCE_UNITS[name]}`);

/**
 * One command driven step after step, and how well its growing uncertainty is predicted.
 *
 * @attr preset - A path to start from; null if the settings match no preset.
 * @attr overlays - Curves and outlines that are drawn; in the attribute with spaces between.
 * @csspart chart - The plot of predicted over measured variance.
 */
export class DeadReckoningElement extends FigureElement<Machine, Reading> {
  static styles = styles;

  static definition = definition;

  cloud = new Cloud(this);
  #floor = new PathPicture();
  #step = new StepPicture();
  pictures = [this.#floor, this.#step];

  #rollout: Memo<Float64Array> = new Memo();
  #straightGrowth: Memo<Machine['straightGrowth']> = new Memo();

  // The machine starts without robots: the user sees them appear, and the first frame does not wait for them.
  createMachine: FigureElement<Machine, Reading>['createMachine'] = (motion, state) => enterCloud(this, motion.DeadReckoning.empty(), state);

  withDerivedFields(currentState: Values, changes: Values) {
    // If the path gets shorter than the selected step, its last step is selected.
    const { steps = currentState.steps } = changes;
    return { step: Math.min(currentState.step, steps), ...super.withDerivedFields(currentState, changes) };
  }

  read = readingOf;

  get scene() {
    return { ...this.currentReading, marked: this.#markedPoses, overlays: this.state.elementState.overlays };
  }

  get exportData() {
    const { config } = this.currentReading;
    const { measured, relativeErrors, predicted } = this.machine as Machine;
    const triple = (triples: Float64Array, i: number) => triples.subarray(3 * i, 3 * i + 3);
    return {
      description: planeText(this.reading),
      settings: config,
      columns: [
        'step',
        ...columnsOf('measured'),
        ...COMPONENTS.map((name) => `relative_error_${name}`),
        ...RECURSIONS.flatMap((recursion) => columnsOf(recursion.replace('-', '_'))),
      ],
      row: (i: number) => [i + 1, ...triple(measured, i), ...triple(relativeErrors, i), ...RECURSIONS.flatMap((recursion) => [...triple(predicted[recursion], i)])],
      count: config.steps,
    };
  }

  announcement = (reading: Reading) => announcementOf(reading, this.state.elementState.overlays);

  /** Poses of the selected robot after each step, if that robot has been driven. */
  get #markedPoses() {
    const { machine, reading, cloud: { isMarked, selectedIndex: index } } = this;
    return isMarked && machine ? this.#rollout.get([reading.stats, index], () => machine.rollout(index)) : undefined;
  }

  content(reading: Reading) {
    const { condition, config: { step } } = reading;
    const { overlays } = this.state.elementState;
    const say = words.reckoning;
    return html`
      <div class="views">
        ${titledPicture(say.chart, html`<div class="chart">${ratioPlot(this, reading)}</div>`, 'ratios')}
        <div class="summary">
          ${headline(reading, overlays)}
          <p part="caption" class="caption ${condition !== 'certain' && 'note'}">${captionOf(reading, overlays)}</p>
          ${settingRadios(this, 'compounding', say.recursions)}
        </div>
        ${titledPicture(say.floor, html`<div class="stage" part="picture">${pictureCanvas(this, this.#floor, planeText(reading))}</div>`, 'floor')}
        ${titledPicture(say.atStepTitle(step), html`<div class="stage">${pictureCanvas(this, this.#step, stepText(reading))}</div>`, 'step')}
      </div>
      ${this.renderer.afterFirstPicture(() => html`
      ${legend(this, OUTLINE_STYLES)} ${presetButtons(this)} ${pathControls(this)}
      ${disclosures(this, {
        controls: () => moreControls(this),
        numbers: () => html`${missTable(reading, overlays)} ${markedRobot(this, this.#markedPoses)} ${straightPlot(this.#straightGrowth.get([reading.stats], () => (this.machine as Machine).straightGrowth))}`,
      })}`)}
    `;
  }
}

define(DeadReckoningElement);
