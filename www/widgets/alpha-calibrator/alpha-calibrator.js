/** <alpha-calibrator>: the α's of a log, how well they are known, and whether the model is any good. */

import { html } from 'lit';
import { object } from '../../figure/checks.js';
import { canvas, disclosures, panel } from '../../figure/controls.js';
import { FigureElement } from '../../figure/figure.js';
import { legend } from '../../figure/overlays.js';
import { reserve } from '../../figure/page/room.js';
import { define } from '../../figure/reflection.js';
import { orFree } from '../../figure/runtime.js';
import { LONGEST_WORK, advancing } from '../../figure/settings.js';
import { words } from '../../messages/registry.js';
import { pointOn } from '../../scene/canvas.js';
import { group } from '../../ui/controls.js';
import { counted } from '../../ui/format.js';
import { startOverButton } from '../shared/presets.js';
import { legControls, legLengths, legReadouts, modelControls, predictionControls } from './controls.js';
import { diagnostics } from './diagnostics.js';
import { Copied, copyButton, nav2 } from './nav2.js';
import { LogOpener, dropZone, logSection } from './open.js';
import { panels } from './panels.js';
import { LegPicture, WayPicture } from './pictures.js';
import { Plate } from './plate.js';
import { legOf, readingOf } from './reading.js';
import { alphaTable, alphaTexts, verdictLine } from './readouts.js';
import { COMPONENTS, LINES, attributes, declared, looks, own, vocabulary } from './settings.js';
import { calibratorStyles } from './styles.js';
import { systematicTable, systematicTexts } from './systematic.js';
import { captionOf, legText, reasonOf, wayText } from './words.js';

/**
 * @import { AlphaCalibrator as Machine, CalibrationLog } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 */

/** Keys of a log. */
const KEYS = ['name', 'odometry', 'reference'];

/**
 * The α's of a log, how well they are known, and whether the model is any good.
 *
 * @attr overlays - The lines that are drawn; in the attribute with spaces between.
 *
 * @csspart drop - The line that logs are dropped on.
 * @csspart chart - A plot of residuals.
 *
 * @extends {FigureElement<Machine, Reading>}
 */
export class AlphaCalibratorElement extends FigureElement {
  static styles = [...FigureElement.styles, reserve('alpha-calibrator'), ...calibratorStyles];

  static declared = declared;
  static attributes = attributes;
  static own = own;
  static looks = looks;
  static vocabulary = vocabulary;

  #way = new WayPicture();
  #one = new LegPicture();
  pictures = [this.#way, this.#one];
  plate = new Plate(this);
  #opener = new LogOpener(this);
  #copied = new Copied(this);
  /** Log of the reader or of the page; null for the simulated one. @type {CalibrationLog | null} */
  #log = null;

  /** @type {FigureElement<Machine, Reading>['createMachine']} */
  createMachine = (motion, state) => {
    if (!state) return new motion.AlphaCalibrator();
    // Fitting goes on in later frames.
    const machine = motion.AlphaCalibrator.empty(this.settings.declared(state));
    return orFree(machine, () => this.#log && machine.beginLog(this.#log.odometry, this.#log.reference));
  };

  /** @param {Machine} machine */
  read(machine) {
    return readingOf(machine, this.#log, this.reading);
  }

  /** Leg that is shown, from 0; −1 if there is none. */
  get chosen() {
    return legOf(this.reading, this.state.own.leg);
  }

  /** Prediction and end of that leg, as of the latest fit that is complete. */
  get predicted() {
    const { chosen } = this;
    return chosen < 0 ? null : (this.machine?.leg(chosen) ?? null);
  }

  get scene() {
    const reading = this.fresh;
    return { ...reading, chosen: this.chosen, leg: this.predicted, overlays: this.state.own.overlays };
  }

  /** Shows a leg while the reader moves between legs. @param {number} leg from 0 */
  look(leg) {
    this.state.own.leg = leg;
    this.gesture.step();
    this.stage.wake();
  }

  /** Shows a leg that the reader has chosen. @param {number} leg from 0 */
  choose(leg) {
    this.look(leg);
    this.gesture.commit();
  }

  /** Shows the leg that was clicked in the picture. @param {MouseEvent} event */
  #press = (event) => {
    this.runtime.attempt(() => {
      const { machine } = this;
      if (!machine || !(event.target instanceof HTMLCanvasElement)) return;
      const [x, y] = pointOn(event.target, this.#way.view, event);
      const leg = this.#way.nearest(machine, x, y);
      if (leg >= 0) this.choose(leg);
    });
  };

  /**
   * A log of the page’s own; null for the simulated one. It is in no state and in no link.
   *
   * @public
   * @returns {CalibrationLog | null}
   */
  get log() {
    return this.#log;
  }

  set log(log) {
    this.reflection.give('log', log, (given) => {
      if (given !== null) object('log', given, KEYS);
      this.#enter(given);
      this.reflection.tell();
      this.settings.show();
    });
  }

  /**
   * Opens a log of the reader's.
   *
   * @param {CalibrationLog | null} log
   * @param {() => void} [arrived] is called when the log is fitted
   * @param {(error: unknown) => void} [refuse] is called if the log is refused while it is fitted, as one without legs
   */
  open(log, arrived, refuse) {
    this.runtime.attempt(() => this.#enter(log, () => {
      this.gesture.step();
      this.gesture.commit();
      arrived?.();
    }, refuse));
    this.stage.wake();
  }

  /**
   * Replaces the log. Another machine is fitted to it first: all stays as it is if the log is refused, or the reader stops.
   *
   * @param {CalibrationLog | null} log
   * @param {() => void} [arrived] is called when the log is fitted
   * @param {(error: unknown) => void} [refuse] is called if the log is refused while it is fitted; without it a log may have no legs
   * @throws {TypeError | RangeError} if the log is refused at once
   */
  #enter(log, arrived = () => this.reflection.tell(), refuse = undefined) {
    const { motion, settings } = this;
    if (!motion) return;
    const end = performance.now() + LONGEST_WORK;
    const machine = motion.AlphaCalibrator.empty(settings.declared(settings.wanted));
    orFree(machine, () => log && machine.beginLog(log.odometry, log.reference));
    settings.prepare(machine, this.#entering(machine, log, arrived, refuse !== undefined), refuse ?? ((error) => this.runtime.report(error)), end);
  }

  /**
   * @param {Machine} machine with the log
   * @param {CalibrationLog | null} log
   * @param {() => void} arrived
   * @param {boolean} isStrict whether the log must have legs
   * @returns {import('../../figure/settings.js').Job}
   */
  *#entering(machine, log, arrived, isStrict) {
    yield* advancing(machine);
    if (isStrict && machine.count === 0) throw new RangeError(words.calibrator.none);
    this.#log = log;
    this.state.own.leg = null;
    this.runtime.replace(machine);
    this.settings.arrive();
    this.settings.stale = true;
    arrived();
  }

  /** Name of the log. */
  get logName() {
    const { log } = this.reading;
    return log ? log.name || words.calibrator.own.odometry : words.calibrator.simulated;
  }

  get takeaway() {
    const { config, legs } = this.fresh;
    const of = (/** @type {Float64Array} */ numbers, /** @type {number} */ i, /** @type {number} */ size) => numbers.subarray(size * i, size * (i + 1));
    const poses = (/** @type {string} */ whose) => ['from', 'to'].flatMap((end) => ['x_m', 'y_m', 'theta_rad'].map((name) => `${whose}_${end}_${name}`));
    return {
      title: this.lettering.name,
      description: [wayText(this.reading, this.chosen), ...alphaTexts(this.reading).map((text) => `${text}.`), captionOf(this.reading, this.logName), reasonOf(this.reading), ...systematicTexts(this.reading)].join(' '),
      settings: { element: this.localName, log: this.#log?.name ?? null, ...config },
      columns: [
        'begins_s', 'ends_s', ...poses('odometry'), ...poses('reference'), 'reading_1', 'reading_2', 'reading_3',
        ...['residual', 'standardized', 'std'].flatMap((what) => COMPONENTS[config.model].map((name) => `${what}_${name}`)), 'squared_mahalanobis', 'outlier',
      ],
      row: (/** @type {number} */ i) => [
        ...of(legs.times, i, 2), ...of(legs.odometry, i, 6), ...of(legs.reference, i, 6), ...of(legs.readings, i, 3),
        ...of(legs.residuals, i, 3), ...of(legs.standardized, i, 3), ...of(legs.stds, i, 3), legs.squared[i], legs.outliers[i],
      ],
      count: legs.count,
      notInCode: this.#log ? words.calibrator.logNotInCode : '',
    };
  }

  /** @param {Reading} reading */
  announcement(reading) {
    return captionOf(reading, this.logName);
  }

  /** @param {Reading} reading */
  content(reading) {
    const say = words.calibrator;
    const { chosen } = this;
    return html`
      <section
        class="machine"
        aria-label=${this.lettering.name}
        @dragover=${this.#opener.dropped.over}
        @dragleave=${this.#opener.dropped.away}
        @drop=${this.#opener.dropped.drop}
      >
        ${dropZone(this, this.#opener)}
        <p part="caption" class="caption verdict">${this.stage.later(() => verdictLine(this))}</p>
        <div class="views">
          ${panel(say.path, html`<div class="stage" part="picture" @click=${this.#press}>${canvas(this, this.#way, wayText(reading, chosen))}</div>`)}
          <div class="one">
            ${panel(say.oneLeg(counted(chosen + 1)), html`<div class="stage">${canvas(this, this.#one, legText(this.predicted, chosen))}</div>`)}
            ${this.stage.later(() => html`<div class="looked">${legControls(this)}</div>`)}
          </div>
          ${this.stage.later(() => html`
          <div class="fitted" part="readouts">
            <div class="buttons told">
              <p class="panel-title">${say.alphas.title}</p>
              ${copyButton(this, this.#copied)} ${startOverButton(this)}
            </div>
            ${alphaTable(reading)}
            <p class="muted reason">${reasonOf(reading)}</p>
          </div>`)}
        </div>
        ${this.stage.later(() => html`
        ${legend(this, LINES)}
        <div part="controls">${legLengths(this)}</div>
        ${disclosures(this, {
          controls: () => html`${modelControls(this)}
            ${group(say.systematic.title, systematicTable(this))}
            ${group(say.own.title, logSection(this, this.#opener))}
            ${predictionControls(this)}`,
          numbers: () => html`${group(say.oneLeg(counted(chosen + 1)), legReadouts(this))}
            ${diagnostics(this)}
            ${group(say.panels.title, panels(this))}
            ${group(say.nav2.title, nav2(this))}`,
          csvTitle: say.csvTitle,
        })}`)}
      </section>
    `;
  }
}

define('alpha-calibrator', AlphaCalibratorElement);
