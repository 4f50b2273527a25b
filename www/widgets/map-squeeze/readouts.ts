/** Readouts of Map Squeeze and their text alternatives: outcomes of the samples, the measured costs of the samplers, and an overview of the map. */

import { html, nothing } from 'lit';
import { addEnglishMessages, words } from '../../messages/registry.ts';
import { limits } from '../../../build/settings.js';
import { buttonHtml } from '../../ui/controls.ts';
import { formatInteger, formatFixed, formatPercent, formatRounded } from '../../ui/format.ts';
import { tableHtml, readoutsHtml } from '../../ui/readouts.ts';
import { en } from './en.ts';
import { formatThroughWallRate, SAMPLERS, type ViewModel } from './settings.ts';
import type { MapSqueeze, Plan, SamplerName, SqueezeStats as Stats } from '../../types.d.ts';
import type { MapSqueezeElement as Figure } from './map-squeeze.ts';

addEnglishMessages({ squeeze: en });

/** Returns the headline: the share of accepted motions that go through a wall. */
export function headlineOf({ attempts, accepted, throughWall }: Pick<Stats, 'attempts' | 'accepted' | 'throughWall'>) {
  const texts = words.squeeze.headline;
  if (attempts === 0) return texts.noMotionHeadline;
  if (accepted === 0) return texts.noneAcceptedHeadline;
  return throughWall === 0 ? texts.noneThroughWallHeadline : texts.shareThroughWallHeadline(formatPercent(throughWall / accepted));
}

/** Returns the caption: the numbers of samples by outcome, or the reason why the robot cannot move. */
export function captionOf({ config: { conditioned, sampler }, stats, stuckNote }: ViewModel) {
  const { accepted, attempts, gaveUp } = stats;
  const texts = words.squeeze;
  // The note about a robot that cannot move is the whole caption, because it also contains the number of motions.
  if (stuckNote && (accepted === 0 || gaveUp)) return stuckNote;
  if (attempts === 0) return `${texts.headline.noMotionHeadline}.`;
  const testedText = texts.testedSentences[conditioned ? sampler : 'off'](formatInteger(accepted), formatInteger(attempts));
  return `${testedText}; ${formatThroughWallRate(stats, conditioned && sampler === 'whole-arc')}. ${stuckNote}`.trim();
}

/** Returns the name of a map with its size. */
export function describeMap(mapName: string, { bounds, walls }: Plan) {
  const [xMin, yMin, xMax, yMax] = bounds;
  return words.squeeze.mapDescription(mapName, formatFixed(xMax - xMin, 1), formatFixed(yMax - yMin, 1), formatInteger(walls.length / 4));
}

export function tallyReadoutsHtml({ stats }: ViewModel) {
  const { tallyLabels: texts } = words.squeeze;
  return readoutsHtml([
    [texts.drawnSamplesLabel, formatInteger(stats.drawn)],
    [texts.drawsPerAcceptedLabel, formatFixed(stats.drawsPerAccepted, 2)],
    [texts.wallTestsPerAcceptedLabel, formatFixed(stats.wallTestsPerAccepted, 2)],
  ]);
}

/** Cost of an accepted sample: time in microseconds, number of draws, and number of wall tests; 'wedged' if no sample is accepted. */
type SampleCost = { microseconds: number, drawCount: number, wallTestCount: number } | 'wedged';

/** Samples per second that the chapter's exercise needs: 2000 particles, 20 updates per second. */
const SAMPLES_PER_SECOND = 2000 * 20;

/** Minimum duration of a measured run, ms. It is much longer than 1 ms, which is the resolution of the clock in some browsers. */
const MIN_RUN_MS = 20;

/** Measures the cost of every sampler. All measurements together take less than half a second. */
export const measureCosts = (simulation: MapSqueeze, subStepCount: number) =>
  Object.fromEntries(SAMPLERS.map((sampler) => [sampler, measureCost(simulation, sampler, sampler === 'sub-stepped' ? subStepCount : 1)])) as Record<SamplerName, SampleCost>;

/** Measures the cost of a sampler. The number of samples is doubled until the run takes long enough. */
function measureCost(simulation: MapSqueeze, sampler: SamplerName, subStepCount: number): SampleCost {
  const maxSampleCount = Math.floor(limits.trial / subStepCount);
  let sampleCount = 1;
  try {
    for (;;) {
      const startTime = performance.now();
      const { draws, wallTests } = simulation.trial(sampler, subStepCount, sampleCount);
      const elapsedMs = performance.now() - startTime;
      if (elapsedMs >= MIN_RUN_MS || sampleCount === maxSampleCount) return { microseconds: (1000 * elapsedMs) / sampleCount, drawCount: draws / sampleCount, wallTestCount: wallTests / sampleCount };
      sampleCount = Math.min(maxSampleCount, 2 * sampleCount);
    }
  } catch (error) {
    if (!(error instanceof RangeError && error.message.includes('wedged'))) throw error;
    return 'wedged';
  }
}

/** Returns the button that measures the cost of each sampler, and the table of the costs. */
export function costTableHtml(figure: Figure) {
  const { samplerNames, costTable: texts } = words.squeeze;
  const { samplerCosts, viewModel: { config } } = figure;
  const costRowOf = (sampler: SamplerName, sampleCost: SampleCost) => [
    sampler === 'sub-stepped' ? `${samplerNames[sampler]} (${config.steps})` : samplerNames[sampler],
    ...(typeof sampleCost === 'string' ? [texts[sampleCost]] : [formatFixed(sampleCost.drawCount, 2), formatFixed(sampleCost.wallTestCount, 2), formatRounded(sampleCost.microseconds, 2), `${formatRounded(100 * sampleCost.microseconds * 1e-6 * SAMPLES_PER_SECOND, 2)}\u202f%`]),
  ];
  return html`<div class="table">
    ${buttonHtml(texts.measureLabel, () => figure.measureSamplerCosts())}
    ${samplerCosts ? tableHtml({ caption: texts.caption, columnHeadings: [texts.samplerColumn, texts.drawsColumn, texts.wallTestsColumn, 'µs', texts.coreShareColumn], rows: SAMPLERS.map((sampler) => costRowOf(sampler, samplerCosts[sampler])) }) : nothing}
  </div>`;
}

/** Maximum fraction of the map's area that a close view may show if an overview is to be shown next to it. */
const MAX_SHOWN_FRACTION = 0.6;

/** Returns the overview of the map, or nothing if the picture already shows most of the map. */
export function overviewMapHtml({ picture, settings, viewModel: { config, commanded } }: Figure) {
  const { xMin, yMin, xMax, yMax } = picture.knownExtentOf(config.start);
  const [width, height] = [xMax - xMin, yMax - yMin];
  const { shownExtent } = picture.pictureView;
  const shownSize = [shownExtent.xMax - shownExtent.xMin, shownExtent.yMax - shownExtent.yMin];
  if (settings.elementState.view === 'whole' || shownSize[0] * shownSize[1] > MAX_SHOWN_FRACTION * width * height) return nothing;
  return html`<svg class="overview" viewBox=${`${xMin} ${-yMax} ${width} ${height}`} aria-hidden="true">
    <g transform="scale(1 -1)" fill="none">
      <path vector-effect="non-scaling-stroke" stroke="var(--muted)" d=${picture.wallPathData} />
      <polyline vector-effect="non-scaling-stroke" stroke="var(--prior)" stroke-width="2" points=${[...commanded].join(' ')} />
      <rect vector-effect="non-scaling-stroke" stroke="var(--ink)" x=${shownExtent.xMin} y=${shownExtent.yMin} width=${shownSize[0]} height=${shownSize[1]} />
    </g>
  </svg>`;
}
