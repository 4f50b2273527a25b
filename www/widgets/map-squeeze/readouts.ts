/** Map Squeeze's readouts: counts of the samples, the selected one, and the cost of each sampler. */

import { html } from 'lit';
import { sampleField } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { counted, fixed, percent, rounded } from '../../ui/format.ts';
import { figureTable, readoutList } from '../../ui/readouts.ts';
import { SAMPLES_PER_SECOND, type Cost, type CostMeter } from './cost.ts';
import { SAMPLERS } from './settings.ts';
import { verdictText } from './words.ts';
import type { SamplerName } from '../../types.d.ts';
import type { Reading } from './reading.ts';

/** Returns the counts of the samples. */
export function tally({ stats, config: { conditioned, sampler }, paths: { length: paths } }: Reading) {
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

/** Returns the readout of the selected sample, with its outcome. */
export function markedDraw(figure: import('./map-squeeze.ts').MapSqueezeElement): import('lit').TemplateResult {
  const { cloud, reading: { config, stats, verdicts } } = figure;
  const { sample, markHint } = words.squeeze;
  const selected = cloud.isMarked ? verdictText(verdicts[cloud.index], config) : '';
  return sampleField(figure, { id: 'sample', label: sample, hint: markHint, shown: stats.attempts, selected });
}

/** Returns the table of costs for a number of sub-steps. */
export function costTable({ costs, current }: CostMeter, steps: number) {
  const { samplers, costs: say } = words.squeeze;
  const row = (sampler: SamplerName) => {
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

function costText({ draws, wallTests, micros }: Cost) {
  const share = `${rounded(100 * micros * 1e-6 * SAMPLES_PER_SECOND, 2)}\u202f%`;
  return [fixed(draws, 2), fixed(wallTests, 2), rounded(micros, 2), share];
}
