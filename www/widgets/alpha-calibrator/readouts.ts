/** Readouts of the Alpha Calibrator: the verdict, and the table of the α's with their intervals. */

import { extent, range } from 'd3-array';
import { html, nothing, svg } from 'lit';
import { words } from '../../messages/registry.ts';
import { formatMarkup } from '../../ui/controls.ts';
import { NO_VALUE, formatPowerOfTen, tick } from '../../ui/format.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { adviceOf, formatAlphaOrBound, formatEstimate } from './lines.ts';
import { isTruthComparable, type ViewModel } from './view-model.ts';
import { judgementOf, legsText, localized, noiseNames, rangeText } from './words.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

/** Size of the plot of one α's interval (a whisker) in the table. */
const WHISKER_ROW = { width: 200, height: 24, middle: 12, inset: 12 };

/** Maximum number of intervals between labels of the axis. */
const MAX_AXIS_INTERVALS = 4;

/** Icons and colours of the ratings. */
const RATING_LOOKS = { consistent: ['✓', 'posterior'], questionable: ['!', 'prediction'], unusable: ['✕', 'accent'] };

/** Returns the badge that rates the α's, the finding, and the number of legs. On a wide page it has at most two lines. */
export function verdictHtml({ viewModel, logName, warnings }: Figure) {
  const { rating, badge, finding } = judgementOf(viewModel, warnings);
  const [icon, role] = RATING_LOOKS[rating];
  return html`<span class="badge" data-role=${role}><span aria-hidden="true">${icon}</span> ${badge}</span>
    <strong>${finding}</strong> <span class="muted">${legsText(viewModel, logName)}</span>`;
}

export function alphaTable(viewModel: ViewModel) {
  const { alphas, intervals } = viewModel.stats;
  const texts = words.calibrator.alphas;
  const noiseLabels = noiseNames(viewModel.fitted.model);
  const truth = isTruthComparable(viewModel) ? viewModel.truth?.alphas : undefined;
  const axis = logarithmicAxis([...alphas, ...intervals.flatMap((interval) => interval ?? []), ...(truth ?? [])]);
  return html`<table class="alphas" part="table">
    <thead>
      <tr><th scope="col">${formatMarkup('*α*')}</th><th scope="col">${truth ? texts.noiseTrue : texts.noise}</th><th scope="col">${texts.value}</th><th scope="col">${texts.recommended}</th></tr>
    </thead>
    <tbody>
      ${alphas.map((alpha, i) => html`<tr>
        <th scope="row">${formatMarkup(`*α*${subscriptOf(i)}`)}</th>
        ${alpha === null
          ? html`<td colspan="3"><div class="of muted">${noiseLabels[i]}</div><i>${missingAlphaText(viewModel, i)}</i></td>`
          : html`<td class="chart"><div class="line"><div class="of muted">${noiseLabels[i]}</div>${whiskerSvg(axis, alpha, intervals[i], truth?.[i])}</div></td>
            <td><div class="line"><div class="fitted-value" data-longest="0.00000">${fittedAlphaText(viewModel, i)}</div><div class="between muted" data-longest=${rangeText('0.00000', '0.00000')}>${intervalText(viewModel, i)}</div></div></td>
            <td class="recommended" data-longest="0.00000">${recommendedAlphaText(viewModel, i)}</td>`}
      </tr>`)}
      <tr class="axis" aria-hidden="true">
        <td></td>
        <td class="chart">
          <div class="line"><div class="of muted"></div><div class="scale muted small">${axis.decades.map((decade) => html`<span .style=${`left: ${(100 * axis.at(decade)) / WHISKER_ROW.width}%`}>${decade < 5e-4 ? formatPowerOfTen(Math.round(Math.log10(decade))) : tick(decade, decade)}</span>`)}</div></div>
        </td>
        <td colspan="2"></td>
      </tr>
    </tbody>
  </table>`;
}

function recommendedAlphaText({ stats: { recommended, alphas, intervals } }: ViewModel, index: number) {
  return recommended && alphas[index] !== null ? localized(formatAlphaOrBound(alphas[index], intervals[index], recommended.inflation)) : NO_VALUE;
}

const fittedAlphaText = ({ stats: { alphas, intervals } }: ViewModel, index: number) => localized(formatAlphaOrBound(alphas[index], intervals[index]));

/** Returns the reason why an α is not identifiable, and the drive that would identify it. */
function missingAlphaText({ stats: { notIdentifiable }, fitted: { model } }: ViewModel, index: number) {
  const texts = words.calibrator.alphas;
  const reason = notIdentifiable[index];
  if (!reason) return NO_VALUE;
  const { lack, drive } = adviceOf(texts.lacking, model, reason);
  return texts.unknown(lack, drive);
}

/** Returns all α's as texts, each with its interval. */
export function alphaTexts(viewModel: ViewModel) {
  const { stats: { alphas }, fitted } = viewModel;
  const recommendedName = words.calibrator.alphas.recommended.replace('\u00AD', '');
  return alphas.map((alpha, i) => {
    const alphaParts = alpha === null ? [missingAlphaText(viewModel, i)] : [fittedAlphaText(viewModel, i), intervalText(viewModel, i), `${recommendedName} ${recommendedAlphaText(viewModel, i)}`];
    return `α${subscriptOf(i)} ${noiseNames(fitted.model)[i]}: ${alphaParts.join(', ')}`;
  });
}

function intervalText({ stats: { intervals } }: ViewModel, index: number) {
  const interval = intervals[index];
  return interval ? rangeText(localized(formatEstimate(interval[0], interval)), localized(formatEstimate(interval[1], interval))) : NO_VALUE;
}

/** Returns a logarithmic axis over whole decades that contain the values. */
function logarithmicAxis(values: (number | null)[]) {
  const [lowest = -3, highest = 0] = extent(values.filter((value) => value && value < Infinity), (value) => Math.log10(value ?? 0));
  const minExponent = Math.floor(Math.min(0, Math.max(lowest, highest - 4)));
  const maxExponent = Math.max(minExponent + 1, Math.ceil(highest));
  const { width, inset } = WHISKER_ROW;
  const at = (value: number) => {
    const axisFraction = (Math.log10(Math.max(value, 0)) - minExponent) / (maxExponent - minExponent);
    // A mark outside the axis is drawn at its edge.
    return Math.max(inset / 3, Math.min(width - inset / 3, inset + axisFraction * (width - 2 * inset)));
  };
  // At most MAX_AXIS_INTERVALS + 1 labels fit without touching.
  const decadesPerLabel = Math.ceil((maxExponent - minExponent) / MAX_AXIS_INTERVALS);
  return { at, decades: range(minExponent, maxExponent + 1, decadesPerLabel).map((exponent) => 10 ** exponent) };
}

function whiskerSvg({ at }: ReturnType<typeof logarithmicAxis>, value: number, interval: [number, number] | null, truth: number | undefined) {
  const { width, height, middle } = WHISKER_ROW;
  const [low, high] = (interval ?? [value, value]).map(at);
  return html`<svg viewBox="0 0 ${width} ${height}" preserveAspectRatio="none" aria-hidden="true">
    ${truth === undefined ? nothing : svg`<path vector-effect="non-scaling-stroke" stroke="var(--truth)" stroke-width="3" d="M${at(truth)} 2V${height - 2}" />`}
    <path vector-effect="non-scaling-stroke" fill="none" stroke="var(--prediction)" stroke-width="1.9" d="M${low} ${middle}H${high}M${low} ${middle - 4}v8M${high} ${middle - 4}v8" />
    <path vector-effect="non-scaling-stroke" stroke="var(--prediction)" stroke-width="5" stroke-linecap="round" d="M${at(value)} ${middle}h0" />
  </svg>`;
}
