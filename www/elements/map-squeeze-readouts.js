/**
 * Map Squeeze's figures: the key to the picture, the tally of the draws, the marked one, and what each
 * sampler costs.
 *
 * @module
 */

import { html } from 'lit';
import { live } from 'lit/directives/live.js';
import { inputOf } from '../ui/controls.js';
import { fixed, percent, rounded, whole } from '../ui/format.js';
import { readoutList } from './banana-readouts.js';
import { DEMAND } from './map-squeeze-cost.js';
import { NOT_FREE, SAMPLERS, SAMPLER_LABELS, keptWords, shareOf } from './map-squeeze-words.js';

/**
 * @typedef {import('../types.d.ts').SqueezeSettings} Settings
 * @typedef {import('../types.d.ts').SqueezeStats} Stats
 * @typedef {import('./map-squeeze-cost.js').CostMeter} CostMeter
 */

/**
 * What the marks in the picture mean.
 *
 * @param {Settings} config
 */
export function key(config) {
  const { kept, through } = keptWords(config);
  return html`<ul class="key">
    <li>
      <svg class="rejected" viewBox="0 0 36 20" aria-hidden="true"><path d="M14 6l8 8m0-8l-8 8" /></svg>
      rejected
    </li>
    <li>
      <svg class="accepted" viewBox="0 0 36 20" aria-hidden="true">
        <circle cx="14" cy="10" r="2" /><path d="M14 10h12" />
      </svg>
      ${kept}, with its heading
    </li>
    <li>
      <svg class="through" viewBox="0 0 36 20" aria-hidden="true">
        <path d="M1 18Q14 16 26 8" opacity="0.5" />
        <circle class="dot" cx="26" cy="8" r="2.5" /><circle cx="26" cy="8" r="6" />
      </svg>
      <span>${through}: the way it took, the thin line, is not free, it ${NOT_FREE}</span>
    </li>
    <li>
      <svg class="commanded" viewBox="0 0 36 20" aria-hidden="true">
        <path d="M2 10h24" /><circle cx="26" cy="10" r="7" stroke-width="1.5" stroke-dasharray="3 3" />
      </svg>
      the command without noise
    </li>
  </ul>`;
}

/** The share that is longest in print. @type {Pick<Stats, 'throughWallRate' | 'throughWallInterval' | 'gaveUp'>} */
const CERTAIN = { throughWallRate: 1, throughWallInterval: [1, 1], gaveUp: false };

/**
 * @param {Stats} stats
 * @param {Settings} config
 * @param {number} paths how many paths are drawn
 */
export function tally(stats, config, paths) {
  const { kept, through } = keptWords(config);
  const share = shareOf(stats, config);
  const parts = config.sampler === 'sub-stepped' ? ' of a part' : '';
  const all = whole(config.samples);
  return readoutList([
    ['drawn', whole(stats.drawn), all],
    [kept, whole(stats.accepted), all],
    [`acceptance rate${parts}`, percent(stats.acceptanceRate), percent(1)],
    [`draws per ${kept} sample`, fixed(stats.drawsPerAccepted, 2)],
    [through, whole(stats.throughWall), all],
    [`share of the ${kept}${share.interval ? ' (95 %)' : ''}`, share.text, shareOf(CERTAIN, config).text],
    ['of these, drawn with their path', paths < stats.throughWall ? `the first ${whole(paths)}` : whole(paths)],
    [`wall tests per ${kept} sample`, fixed(stats.wallTestsPerAccepted, 2)],
  ]);
}

/**
 * The marked draw, and the way to it from the keyboard.
 *
 * @param {object} marked
 * @param {number} marked.index −1 for none
 * @param {number} marked.shown draws there are
 * @param {string} marked.verdict empty for none
 * @param {(index: number) => void} marked.mark
 */
export function markedDraw({ index, shown, verdict, mark }) {
  return html`<p class="marked">
    <label>
      Sample
      <input
        id="sample"
        type="number"
        min="1"
        max=${shown}
        placeholder="1–${shown}"
        .value=${live(index < 0 ? '' : String(index + 1))}
        @input=${(/** @type {Event} */ event) => {
          const value = inputOf(event).valueAsNumber;
          mark(Number.isInteger(value) && value >= 1 && value <= shown ? value - 1 : -1);
        }}
      />
    </label>
    <output for="sample">
      ${verdict || html`<span class="hint">Point at one to see its path and the verdict on it.</span>`}
    </output>
  </p>`;
}

/**
 * @param {CostMeter} meter
 * @param {number} steps parts of the sub-stepped sampler
 */
export function costTable({ costs, current }, steps) {
  const name = (/** @type {import('../types.d.ts').SamplerName} */ sampler) =>
    sampler === 'sub-stepped' ? html`sub-stepped, <i>k</i> = ${steps}` : SAMPLER_LABELS[sampler];
  return html`<div class="table" aria-busy=${!current}>
    <table class=${current ? '' : 'outdated'}>
      <caption>
        One accepted sample of each sampler under the settings above, timed on this device when
        nothing moves; and the share of one core that 2000 particles at 20 Hz would take. All is from
        this one pose, and repeated runs differ by several per cent.
      </caption>
      <thead>
        <tr>
          <th scope="col">sampler</th>
          <th scope="col">draws</th>
          <th scope="col">wall tests</th>
          <th scope="col">µs</th>
          <th scope="col">of a core</th>
        </tr>
      </thead>
      <tbody>
        ${SAMPLERS.map((sampler) => {
          const cost = costs[sampler] ?? 'not yet measured';
          return html`<tr>
            <th scope="row">${name(sampler)}</th>
            ${typeof cost === 'string'
              ? html`<td colspan="4">${cost}</td>`
              : html`<td>${fixed(cost.draws, 2)}</td>
                  <td>${fixed(cost.wallTests, 2)}</td>
                  <td>${rounded(cost.micros, 2)}</td>
                  <td>${rounded(100 * cost.micros * 1e-6 * DEMAND, 2)}&#8239;%</td>`}
          </tr>`;
        })}
      </tbody>
    </table>
  </div>`;
}
