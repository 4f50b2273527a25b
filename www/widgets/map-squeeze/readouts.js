/**
 * Map Squeeze's readouts: the tally of the samples, the marked one, and what each sampler costs.
 */

import { html } from 'lit';
import { markedField } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { counted, fixed, percent, rounded } from '../../ui/format.js';
import { figureTable, readoutList } from '../../ui/readouts.js';
import { DEMAND } from './cost.js';
import { SAMPLERS } from './settings.js';
import { verdictText } from './words.js';

/**
 * @import { SamplerName } from '../../types.d.ts'
 * @import { Cost, CostMeter } from './cost.js'
 * @import { Reading } from './reading.js'
 */

/** Returns the counts of the samples. @param {Reading} reading */
export function tally({ stats, config: { conditioned, sampler }, paths: { length: paths } }) {
  const say = words.squeeze.tally;
  const certain = conditioned && sampler === 'whole-arc';
  return readoutList([
    [say.drawn, counted(stats.drawn)],
    [say.accepted, counted(stats.accepted), say.ofDrawn(percent(stats.acceptanceRate), conditioned && sampler === 'sub-stepped')],
    [say.through, certain ? say.byConstruction : counted(stats.throughWall), certain ? undefined : say.ofAccepted(percent(stats.throughWallRate))],
    [say.paths, paths < stats.throughWall ? say.first(counted(paths)) : counted(paths)],
    [say.draws, fixed(stats.drawsPerAccepted, 2)],
    [say.tests, fixed(stats.wallTestsPerAccepted, 2)],
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
      sampler === 'sub-stepped' ? `${name} (${steps})` : name,
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
