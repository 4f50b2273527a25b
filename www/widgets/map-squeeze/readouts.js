/**
 * Map Squeeze's figures: the key to the picture, the tally of the draws, the marked one, and what each
 * sampler costs.
 *
 * @module
 */

import { html } from 'lit';
import { live } from 'lit/directives/live.js';
import { words } from '../../messages/registry.js';
import { inputOf } from '../../ui/controls.js';
import { fixed, percent, rounded, whole } from '../../ui/format.js';
import { readoutList } from '../banana-machine/readouts.js';
import { DEMAND } from './cost.js';
import { SAMPLERS, keptWords, shareOf } from './words.js';

/**
 * @typedef {import('../../types.d.ts').SqueezeSettings} Settings
 * @typedef {import('../../types.d.ts').SqueezeStats} Stats
 * @typedef {import('./cost.js').CostMeter} CostMeter
 */

/**
 * What the marks in the picture mean.
 *
 * @param {Settings} config
 */
export function key(config) {
  const { kept, through } = keptWords(config);
  const { rejected, key: say } = words.squeeze;
  return html`<ul class="key" part="legend">
    <li>
      <svg class="rejected" viewBox="0 0 36 20" aria-hidden="true"><path d="M14 6l8 8m0-8l-8 8" /></svg>
      ${rejected}
    </li>
    <li>
      <svg class="accepted" viewBox="0 0 36 20" aria-hidden="true">
        <circle cx="14" cy="10" r="2" /><path d="M14 10h12" />
      </svg>
      ${say.accepted(kept)}
    </li>
    <li>
      <svg class="through" viewBox="0 0 36 20" aria-hidden="true">
        <path d="M1 18Q14 16 26 8" opacity="0.5" />
        <circle class="dot" cx="26" cy="8" r="2.5" /><circle cx="26" cy="8" r="6" />
      </svg>
      <span>${say.through(through)}</span>
    </li>
    <li>
      <svg class="commanded" viewBox="0 0 36 20" aria-hidden="true">
        <path d="M2 10h24" /><circle cx="26" cy="10" r="7" stroke-width="1.5" stroke-dasharray="3 3" />
      </svg>
      ${say.commanded}
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
  const all = whole(config.samples);
  const say = words.squeeze.tally;
  return readoutList([
    [say.drawn, whole(stats.drawn), all],
    [kept, whole(stats.accepted), all],
    [config.sampler === 'sub-stepped' ? say.rateOfParts : say.rate, percent(stats.acceptanceRate), percent(1)],
    [say.draws(kept), fixed(stats.drawsPerAccepted, 2), fixed(10, 2)],
    [through, whole(stats.throughWall), all],
    [say.share(kept) + (share.interval ? say.interval : ''), share.text, shareOf(CERTAIN, config).text],
    [say.paths, paths < stats.throughWall ? say.first(whole(paths)) : whole(paths), say.first(all)],
    [say.tests(kept), fixed(stats.wallTestsPerAccepted, 2), fixed(10, 2)],
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
      ${words.squeeze.sample}
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
      ${verdict || html`<span class="hint">${words.squeeze.markHint}</span>`}
    </output>
  </p>`;
}

/**
 * @param {CostMeter} meter
 * @param {number} steps parts of the sub-stepped sampler
 */
export function costTable({ costs, current }, steps) {
  const { samplers, costs: say } = words.squeeze;
  const room = fixed(10, 2);
  const name = (/** @type {import('../../types.d.ts').SamplerName} */ sampler) =>
    sampler === 'sub-stepped' ? html`${samplers[sampler]}, <i>k</i> = ${steps}` : samplers[sampler];
  return html`<div class="table" aria-busy=${!current}>
    <table part="table" class=${current ? '' : 'outdated'}>
      <caption>${say.caption}</caption>
      <thead>
        <tr>
          <th scope="col">${say.sampler}</th>
          <th scope="col">${say.draws}</th>
          <th scope="col">${say.tests}</th>
          <th scope="col">µs</th>
          <th scope="col">${say.core}</th>
        </tr>
      </thead>
      <tbody>
        ${SAMPLERS.map((sampler) => {
          const cost = costs[sampler] ?? 'none';
          return html`<tr>
            <th scope="row">${name(sampler)}</th>
            ${typeof cost === 'string'
              ? html`<td colspan="4">${say[cost]}</td>`
              : [
                  fixed(cost.draws, 2),
                  fixed(cost.wallTests, 2),
                  rounded(cost.micros, 2),
                  `${rounded(100 * cost.micros * 1e-6 * DEMAND, 2)}\u202f%`,
                ].map((text) => html`<td class="roomy" data-room=${room}>${text}</td>`)}
          </tr>`;
        })}
      </tbody>
    </table>
  </div>`;
}
