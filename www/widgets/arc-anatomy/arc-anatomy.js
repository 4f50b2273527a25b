/** <arc-anatomy>: the arc between two poses, and how likely it is after a command. */

import { html } from 'lit';
import { canvas } from '../../figure/controls.js';
import { FigureElement } from '../../figure/figure.js';
import { reserve } from '../../figure/page/reserve.js';
import { define } from '../../figure/reflection.js';
import { exportMenu } from '../../figure/takeaway/export.js';
import { words } from '../../messages/registry.js';
import { fold } from '../../ui/fold.js';
import { PoseHandles } from '../shared/pose-handles.js';
import { alphaControls, commandControls, drawnControls, lineStepper, presetButtons, printedCheck } from './controls.js';
import { formsPlot } from './forms.js';
import { ArcPicture, RADIUS } from './picture.js';
import { readingOf } from './reading.js';
import { factorBars, legend, likelihoods, tableOf } from './readouts.js';
import { REACH, attributes, declared, looks, own, room, vocabulary } from './settings.js';
import { anatomyStyles } from './styles.js';
import { Sweep } from './sweep.js';
import { longestVerdict, pictureText, verdictOf } from './words.js';

/**
 * @import { ArcAnatomy as Machine } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 */

/** Where both poses can be dragged, m. */
const BOUNDS = [-REACH, -REACH, REACH, REACH];

/**
 * The arc between two poses, and how likely it is after a command.
 *
 * @attr preset - A command from the origin, and a final pose off its arc; none otherwise.
 * @attr twist - Whether the way of constant twist is drawn.
 *
 * @csspart chart - The plot of three forms of the arc near straight.
 *
 * @extends {FigureElement<Machine, Reading>}
 */
export class ArcAnatomyElement extends FigureElement {
  static styles = [...FigureElement.styles, reserve(room), ...anatomyStyles];

  static declared = declared;
  static attributes = attributes;
  static own = own;
  static looks = looks;
  static vocabulary = vocabulary;

  #picture = new ArcPicture();
  pictures = [this.#picture];
  /** The final one on top, where both poses are at one place. @type {PoseHandles[]} */
  #handles = /** @type {const} */ (['start', 'next']).map(
    (setting) =>
      new PoseHandles(this, setting, {
        view: () => this.#picture.view,
        bounds: () => BOUNDS,
        say: () => ({ ...words.anatomy.handles[setting], ends: words.anatomy.handles.ends }),
      }),
  );

  #sweep = new Sweep(this);

  /** @type {FigureElement<Machine, Reading>['createMachine']} */
  createMachine = (motion, state) => new motion.ArcAnatomy(state && this.settings.declared(state));

  read = readingOf;

  /** In a state that came, or came back, nothing is played. */
  machineChanged() {
    this.#sweep.playing = false;
  }

  get scene() {
    const { twist, line } = this.state.own;
    const { share } = this.#sweep;
    const reading = this.fresh;
    const underway = share < 1 ? this.machine?.underway(share) : undefined;
    const advance = (/** @type {number} */ elapsed) => this.#sweep.advance(elapsed);
    return { ...reading, machine: this.machine, twist: twist === 'shown', line, underway, advance };
  }

  get takeaway() {
    const { config, stats: { factors } } = this.fresh;
    return {
      title: this.lettering.name,
      description: pictureText(this.reading),
      settings: { element: this.localName, ...config },
      columns: ['estimate', 'residual', 'standard_deviation', 'residual_over_deviation', 'prob', 'share_of_peak'],
      row: (/** @type {number} */ i) => {
        const { estimate, residual, deviation, deviations, value, share } = factors[i];
        return [estimate, residual, deviation, deviations, value, share];
      },
      count: factors.length,
    };
  }

  announcement = verdictOf;

  get held() {
    return this.#handles.some(({ held }) => held);
  }

  /** @param {Reading} scene */
  placeHandles({ config: { start, next } }) {
    const [before, after] = this.#handles;
    before.place(start, RADIUS);
    after.place(next, RADIUS);
  }

  /** @param {Reading} reading */
  content(reading) {
    const say = words.anatomy;
    return html`
      <section class="machine" aria-label=${this.lettering.name}>
        <div class="views">
          <div class="stage" part="picture">
            ${canvas(this, this.#picture, pictureText(reading))} ${this.#handles.map((handle) => handle.render())}
          </div>
          ${this.stage.later(() => html`
          <p class="verdict caption roomy" part="caption" data-room=${longestVerdict()}><span>${verdictOf(reading)}</span></p>
          <div class="aside">
            ${factorBars(reading, this.state.own.line)} ${likelihoods(reading)} ${presetButtons(this)} ${printedCheck(this)}
          </div>`)}
        </div>
        ${this.stage.later(() => html`
        ${lineStepper(this)} ${this.#sweep.render()}
        <div class="controls" part="controls">${commandControls(this)} ${drawnControls(this)}</div>
        <div class="folds">
          ${fold(say.drawn, () => legend(reading, this.state.own.twist === 'shown'))}
          ${fold(say.noiseLabel, () => alphaControls(this))}
          ${fold(say.table.label, () => tableOf(reading, this.state.own.line))}
          ${fold(say.forms.label, () => formsPlot(this.motion))}
          ${exportMenu(this, 'figure', say.csvTitle)} ${this.copies.render()} ${this.presenting.button()}
        </div>`)}
      </section>
    `;
  }
}

define('arc-anatomy', ArcAnatomyElement);
