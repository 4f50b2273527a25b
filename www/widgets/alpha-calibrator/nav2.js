/** What the Alpha Calibrator's figures are for: lines of nav2_params.yaml, and everything as JSON. */

import { html, nothing } from 'lit';
import { Part } from '../../figure/part.js';
import { save } from '../../figure/takeaway/export.js';
import { words } from '../../messages/registry.js';
import { button } from '../../ui/controls.js';

/** @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure */

/** Significant digits of an α in a file: its interval has fewer. */
const DIGITS = 4;

/** What Nav2 calls its models. @type {Record<string, string>} */
const TYPES = { odometry: 'nav2_amcl::DifferentialMotionModel', omnidirectional: 'nav2_amcl::OmniMotionModel' };

/** As a file has it, whatever the reader's language. @param {number} value */
const plain = (value) => String(Number(value.toPrecision(DIGITS)));

/**
 * Lines for nav2_params.yaml, each with what is known of it.
 *
 * @param {Figure} figure
 * @returns {string} none where Nav2 has no such model
 */
export function yamlOf({ reading: { config, stats, legs }, logName }) {
  const { model, rule, distance, angle, inflation } = config;
  const say = words.calibrator.nav2;
  const type = TYPES[model];
  if (!type) return '';
  const date = new Date().toISOString().slice(0, 10);
  const notes = [
    say.of(String(legs.count), logName, date),
    ...(rule === 'nav2' || rule === 'omni' ? [] : [say.otherRule]),
    ...(inflation === 1 ? [] : [say.inflated(plain(inflation))]),
  ];
  const alphas = stats.alphas.map((alpha, i) => {
    const interval = stats.intervals[i]?.map((end) => plain(inflation * end));
    // A name may have lines of its own, which would end the comment.
    return alpha === null ? `# alpha${i + 1}: ${say.undetermined}` : `alpha${i + 1}: ${plain(inflation * alpha)}  # ${interval?.join(' – ') ?? ''}`;
  });
  const lines = [`robot_model_type: "${type}"`, ...alphas, `update_min_d: ${plain(distance)}`, `update_min_a: ${plain(angle)}`];
  const comments = notes.map((note) => `    # ${note.replaceAll(/\s+/g, ' ')}`);
  return ['amcl:', '  ros__parameters:', ...comments, ...lines.map((line) => `    ${line}`), ''].join('\n');
}

/** All that was found, with typed arrays as plain ones. @param {Figure} figure */
export function jsonOf({ reading: { config, stats, legs, truth }, logName }) {
  const all = { log: logName, date: new Date().toISOString(), settings: config, ...stats, ...(truth && { truth }), legs };
  return JSON.stringify(all, (_, value) => (ArrayBuffer.isView(value) ? [.../** @type {Float64Array} */ (value)] : value), 1);
}

/** What was copied last. @extends {Part<Figure>} */
export class Copied extends Part {
  /** @type {string | undefined} */
  #text;

  /** Whether these lines are on the clipboard. @param {string} text */
  has(text) {
    return this.#text === text;
  }

  /** @param {string} text */
  async copy(text) {
    // Refused in a frame without the permission, and absent where the page came without encryption: the lines are there to be copied.
    await Promise.resolve(navigator.clipboard?.writeText(text).then(() => (this.#text = text))).catch(() => undefined);
    this.host.requestUpdate();
  }
}

/**
 * @param {Figure} figure
 * @param {Copied} copied
 */
export function nav2(figure, copied) {
  const say = words.calibrator.nav2;
  const yaml = yamlOf(figure);
  const name = `${figure.localName}-${figure.reading.config.seed}.json`;
  return html`${yaml ? html`<textarea class="yaml" readonly rows=${yaml.split('\n').length} aria-label=${say.label} .value=${yaml}></textarea>` : html`<p>${say.none}</p>`}
    <div class="buttons">
      ${yaml ? button(say.copy, () => copied.copy(yaml)) : nothing}
      ${button(say.json, () => save(name, new Blob([jsonOf(figure)], { type: 'application/json' })))}
      <output>${copied.has(yaml) ? say.copied : nothing}</output>
    </div>`;
}
