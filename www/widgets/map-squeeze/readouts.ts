/** Map Squeeze's readouts: counts of the samples, the selected one, the cost of each sampler, and the whole map beside a close view. */

import { html, nothing } from 'lit';
import { words } from '../../messages/registry.ts';
import { button } from '../../ui/controls.ts';
import { integer, fixed, formatRounded } from '../../ui/format.ts';
import { figureTable, readoutList } from '../../ui/readouts.ts';
import { SAMPLES_PER_SECOND, type SampleCost } from './cost.ts';
import { SAMPLERS } from './settings.ts';
import type { SamplerName } from '../../types.d.ts';
import type { MapSqueezeElement as Figure } from './map-squeeze.ts';
import type { ViewModel } from './view-model.ts';

export function tallyReadouts({ stats, paths: { length: paths } }: ViewModel) {
  const { tally: texts } = words.squeeze;
  return readoutList([
    [texts.drawn, integer(stats.drawn)],
    [texts.paths, integer(paths)],
    [texts.draws, fixed(stats.drawsPerAccepted, 2)],
    [texts.tests, fixed(stats.wallTestsPerAccepted, 2)],
  ]);
}

/** Returns the button that measures the cost of each sampler, and the table of the costs. */
export function costTable(figure: Figure) {
  const { samplers, costs: texts } = words.squeeze;
  const { costs, viewModel: { config } } = figure;
  const costRow = (sampler: SamplerName, cost: SampleCost) => [
    sampler === 'sub-stepped' ? `${samplers[sampler]} (${config.steps})` : samplers[sampler],
    ...(typeof cost === 'string' ? [texts[cost]] : [fixed(cost.draws, 2), fixed(cost.wallTests, 2), formatRounded(cost.micros, 2), coreShareText(cost.micros)]),
  ];
  return html`<div class="table">
    ${button(texts.measure, () => figure.measureSamplerCosts())}
    ${costs ? figureTable({ caption: texts.caption, columns: [texts.sampler, texts.draws, texts.tests, 'µs', texts.core], rows: SAMPLERS.map((sampler) => costRow(sampler, costs[sampler])) }) : nothing}
  </div>`;
}

const coreShareText = (micros: number) => `${formatRounded(100 * micros * 1e-6 * SAMPLES_PER_SECOND, 2)}\u202f%`;

/** Maximum fraction of the map's area that a close view with an overview shows. */
const MAX_SHOWN_FRACTION = 0.6;

/** Returns the overview, or nothing if the picture already shows most of the map. */
export function overviewMapHtml(picture: import('./picture.ts').FloorPicture, { config, commanded }: import('./view-model.ts').ViewModel) {
  const { xMin, yMin, xMax, yMax } = picture.knownExtentAround(config.start);
  const [width, height] = [xMax - xMin, yMax - yMin];
  const { extent } = picture.view;
  const shownSize = [extent.xMax - extent.xMin, extent.yMax - extent.yMin];
  if (!picture.isClose || shownSize[0] * shownSize[1] > MAX_SHOWN_FRACTION * width * height) return nothing;
  return html`<svg class="overview" viewBox=${`${xMin} ${-yMax} ${width} ${height}`} aria-hidden="true">
    <g transform="scale(1 -1)" fill="none">
      <path vector-effect="non-scaling-stroke" stroke="var(--muted)" d=${picture.wallPathData} />
      <polyline vector-effect="non-scaling-stroke" stroke="var(--prior)" stroke-width="2" points=${[...commanded].join(' ')} />
      <rect vector-effect="non-scaling-stroke" stroke="var(--ink)" x=${extent.xMin} y=${extent.yMin} width=${shownSize[0]} height=${shownSize[1]} />
    </g>
  </svg>`;
}
