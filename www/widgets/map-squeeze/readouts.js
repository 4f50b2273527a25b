/**
 * Map Squeeze's readouts: the key to the picture, the tally of the draws, the marked one, and what each
 * sampler costs.
 */

import { html, nothing } from 'lit';
import { markedField } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { counted, fixed, percent, rounded } from '../../ui/format.js';
import { figureTable, readoutList } from '../../ui/readouts.js';
import { DEMAND } from './cost.js';
import { SAMPLERS } from './settings.js';
import { keptWords, shareOf, verdictText } from './words.js';

/**
 * @import { SamplerName, SqueezeSettings as Settings, SqueezeStats as Stats } from '../../types.d.ts'
 * @import { Cost, CostMeter } from './cost.js'
 * @import { Reading } from './reading.js'
 */

/**
 * What the marks in the picture mean.
 *
 * @param {Reading} reading
 * @param {boolean} hasUnknown whether there are cells of which the map says nothing
 */
export function legend({ config, sorted }, hasUnknown) {
  const { kept, through } = keptWords(config);
  const { rejected, key: say } = words.squeeze;
  return html`<ul class="legend key" part="legend">
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
    ${hasUnknown
      ? html`<li>
          <svg class="unknown" viewBox="0 0 36 20" aria-hidden="true"><path d="M2 18L18 2M9 18L25 2M16 18L32 2" /></svg>
          ${say.unknown}
        </li>`
      : nothing}
  </ul>
  <p class="about">${sorted ? nothing : say.density} ${say.overview}</p>`;
}

/** The two rates that matter. @param {Reading} reading */
export function rates({ stats, config }) {
  const say = words.squeeze.rates;
  const { conditioned, sampler } = config;
  const accepted = !conditioned ? say.kept : sampler === 'sub-stepped' ? say.ofParts : say.accepted;
  const share = shareOf(stats, config);
  return readoutList([
    [accepted, percent(stats.acceptanceRate)],
    [share.interval ? say.interval : say.through, share.text],
  ]);
}

/** @param {Reading} reading */
export function tally({ stats, config, paths: { length: paths } }) {
  const { kept, through } = keptWords(config);
  const say = words.squeeze.tally;
  return readoutList([
    [say.drawn, counted(stats.drawn)],
    [kept, counted(stats.accepted)],
    [through, counted(stats.throughWall)],
    [say.paths, paths < stats.throughWall ? say.first(counted(paths)) : counted(paths)],
    [say.draws(kept), fixed(stats.drawsPerAccepted, 2)],
    [say.tests(kept), fixed(stats.wallTestsPerAccepted, 2)],
  ]);
}

/**
 * The marked draw, with the verdict on it.
 *
 * @param {import('./map-squeeze.js').MapSqueezeElement} figure
 * @returns {import('lit').TemplateResult}
 */
export function markedDraw(figure) {
  const { cloud, reading: { config, stats, verdicts } } = figure;
  const { sample, markHint } = words.squeeze;
  const told = cloud.isMarked ? verdictText(verdicts[cloud.index], config) : '';
  return markedField(figure, { id: 'sample', label: sample, hint: markHint, shown: stats.attempts, told });
}

/**
 * @param {CostMeter} meter
 * @param {number} steps parts of the sub-stepped sampler
 */
export function costTable({ costs, current }, steps) {
  const { samplers, costs: say } = words.squeeze;
  const row = (/** @type {SamplerName} */ sampler) => {
    const name = samplers[sampler];
    const cost = costs[sampler] ?? 'none';
    return [
      sampler === 'sub-stepped' ? html`${name}, <i>k</i> = ${steps}` : name,
      ...(typeof cost === 'string' ? [say[cost]] : costText(cost)),
    ];
  };
  return html`<div class="table" aria-busy=${!current}>
    ${figureTable({
      caption: say.caption,
      columns: [say.sampler, say.draws, say.tests, 'µs', say.core],
      rows: SAMPLERS.map(row),
      outdated: !current,
    })}
  </div>`;
}

/** @param {Cost} cost */
function costText({ draws, wallTests, micros }) {
  const share = `${rounded(100 * micros * 1e-6 * DEMAND, 2)}\u202f%`;
  return [fixed(draws, 2), fixed(wallTests, 2), rounded(micros, 2), share];
}
