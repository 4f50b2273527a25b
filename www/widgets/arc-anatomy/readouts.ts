/** Readouts of Arc Anatomy and their text alternatives: the likelihood, its factors as bars, Table 5.1, and errors of three formulas for the arc. */

import { html, nothing, svg } from 'lit';
import { addEnglishMessages, words } from '../../messages/registry.ts';
import { formatMarkup, radioButtonHtml } from '../../ui/controls.ts';
import { clampNumber, formatFixed, formatPercent, formatPowerOfTen, formatSignificant } from '../../ui/format.ts';
import { plotHtml } from '../../ui/plot.ts';
import { readoutsHtml } from '../../ui/readouts.ts';
import { en } from './en.ts';
import { TABLE_LINES, type ViewModel } from './settings.ts';
import type { FormErrors, Motion } from '../../types.d.ts';

addEnglishMessages({ anatomy: en });

/** Absolute value below which a number is printed as a power of ten. The density p is a product of three densities, and spans many decades. */
const MIN_PLAIN_NUMBER = 0.0005;

function formatScientific(printedNumber: number) {
  const [mantissa, exponent] = printedNumber.toExponential(1).split('e').map(Number);
  return `${formatFixed(mantissa, 1)}·${formatPowerOfTen(exponent)}`;
}

/** Returns true if a number is printed as a power of ten. */
const isPrintedAsPower = (printedNumber: number) => printedNumber > 0 && printedNumber < MIN_PLAIN_NUMBER;

const formatShare = (share: number) => (isPrintedAsPower(share) ? formatScientific(share) : formatPercent(share));

const formatDensity = (density: number) => (isPrintedAsPower(density) ? formatScientific(density) : formatSignificant(density, 3));

/** Returns the caption: a sentence about the factor that reduces the probability density p most. */
export function captionOf({ config, stats: { factors, weakest, share, driven, inverted } }: ViewModel) {
  const texts = words.anatomy.captionSentences;
  const { deviations, share: keptShare, deviation } = factors[weakest];
  const estimateName = `${words.anatomy.factorBars.estimateNames[weakest]} ${['v̂', 'ω̂', 'γ̂'][weakest]}`;
  if (config.printed && driven.arcLength !== inverted.arcLength) return texts.printedRadius(formatFixed(factors[0].estimate, 2), formatShare(share));
  if (share === 1) return texts.atPeak;
  if (deviation === 0) return texts.zeroVariance(estimateName);
  return texts.worstFactor(estimateName, formatFixed(Math.abs(deviations), 1), formatShare(keptShare), formatShare(share));
}

/** Scale of the bars for errors: maximum number of standard deviations to either side, and number of pixels per standard deviation. */
const BAR_SCALE = { maxDeviations: 4, pixelsPerDeviation: 22 };
const BAR_MIDDLE = BAR_SCALE.maxDeviations * BAR_SCALE.pixelsPerDeviation + 4;

/**
 * Symbol, error, sign and unit of each factor of the likelihood. The bars show v̂ − v, so that a bar to the right means more than commanded. Table 5.1 has
 * the errors of v and ω with the opposite sign.
 */
const FACTOR_NOTATIONS = [
  { symbol: '*v̂*', error: '(*v̂* − *v*)', residualSign: -1, unit: 'm/s' },
  { symbol: '*ω̂*', error: '(*ω̂* − *ω*)', residualSign: -1, unit: 'rad/s' },
  { symbol: '*γ̂*', error: '*γ̂*', residualSign: 1, unit: 'rad/s' },
];

export function headlineHtml({ stats: { share } }: ViewModel) {
  const texts = words.anatomy.headline;
  return readoutsHtml([[texts.beforeShare, formatShare(share), isPrintedAsPower(share) ? texts.afterPower : texts.afterShare]], 0);
}

/**
 * Returns bars of the three errors in standard deviations, each with its factor of the likelihood relative to the peak. They are highlighted together with
 * the last line of Table 5.1.
 */
export function factorBarsHtml({ stats: { factors, weakest, share } }: ViewModel, tableLine: number) {
  const texts = words.anatomy.factorBars;
  return html`<ul part="readouts" class="factors ${tableLine === TABLE_LINES ? 'lit' : ''}" aria-label=${texts.label}>
    ${factors.map((factor, i) => {
      const { symbol, error, residualSign, unit } = FACTOR_NOTATIONS[i];
      const deviations = residualSign * factor.deviations;
      return html`<li class=${i === weakest && share < 1 ? 'weakest' : nothing}>
        <span class="estimate">${formatMarkup(symbol)} ${texts.estimateNames[i]} = ${formatFixed(factor.estimate, 2)} ${unit}</span>
        ${barHtml(deviations)}
        <span class="keeps muted small">${texts.factorText(formatShare(factor.share))}</span>
        <span class="off small">${formatMarkup(error)}/<i>σ</i> = ${formatFixed(deviations, 1)}</span>
      </li>`;
    })}
  </ul>`;
}

function barHtml(deviations: number) {
  const barXOf = (deviationCount: number) => BAR_MIDDLE + BAR_SCALE.pixelsPerDeviation * clampNumber(deviationCount, -BAR_SCALE.maxDeviations, BAR_SCALE.maxDeviations);
  const isBeyondScale = Math.abs(deviations) > BAR_SCALE.maxDeviations;
  const barEnd = barXOf(deviations);
  const barSide = Math.sign(deviations);
  const barTicks = Array.from({ length: 2 * BAR_SCALE.maxDeviations + 1 }, (_, i) => i - BAR_SCALE.maxDeviations);
  return html`<svg viewBox="0 0 ${2 * BAR_MIDDLE} 20" preserveAspectRatio="none" aria-hidden="true">
    ${barTicks.map((deviationCount) => svg`<line stroke="var(--muted)" vector-effect="non-scaling-stroke" x1=${barXOf(deviationCount)} x2=${barXOf(deviationCount)} y1=${deviationCount === 0 ? 0 : 14} y2="20" />`)}
    <rect fill="var(--prediction)" x=${Math.min(barXOf(0), barEnd)} width=${Math.abs(barEnd - barXOf(0))} y="3" height="11" />
    ${isBeyondScale ? svg`<path fill="none" stroke="var(--prediction)" stroke-width="3" d="M${barEnd - 6 * barSide},1l${6 * barSide},7.5l${-6 * barSide},7.5" />` : nothing}
  </svg>`;
}

export function likelihoodReadoutsHtml({ stats: { prob, density, xi } }: ViewModel) {
  const texts = words.anatomy.likelihoodReadouts;
  const [xiAlong, xiLateral, xiHeading] = xi;
  return readoutsHtml([
    [texts.prob, formatDensity(prob)],
    [texts.density, density === null ? texts.undefinedDensity : formatDensity(density)],
    [texts.xiReadout, `(${formatFixed(xiAlong, 2)}, ${formatFixed(xiLateral, 2)}, ${formatFixed(xiHeading, 2)})`],
  ]);
}

/** Formulas in the lines of Table 5.1, in the markup of messages (*stars* for italics). */
const TABLE_LINE_FORMULAS = [
  '*μ* = ½ · [(*x* − *x*′) cos *θ* + (*y* − *y*′) sin *θ*] / [(*y* − *y*′) cos *θ* − (*x* − *x*′) sin *θ*]',
  '*x\\** = (*x* + *x*′)/2 + *μ*(*y* − *y*′)',
  '*y\\** = (*y* + *y*′)/2 + *μ*(*x*′ − *x*)',
  '*r\\** = ±√[(*x* − *x\\**)² + (*y* − *y\\**)²]',
  'Δ*θ* = atan2(*y*′ − *y\\**, *x*′ − *x\\**) − atan2(*y* − *y\\**, *x* − *x\\**)',
  '*v̂* = Δ*θ*/Δ*t* · *r\\**',
  '*ω̂* = Δ*θ*/Δ*t*',
  '*γ̂* = (*θ*′ − *θ*)/Δ*t* − *ω̂*',
  '*p* = prob(*v* − *v̂*) · prob(*ω* − *ω̂*) · prob(*γ̂*)',
];

const TABLE_LINE_UNITS = ['', ' m', ' m', ' m', ' rad', ' m/s', ' rad/s', ' rad/s', ''];

/** Returns the lines of Table 5.1 with their values as radio buttons. The selected line highlights constructions in the picture. */
export function tableLinesHtml({ viewModel: { table: { lines: lineValues }, config: { printed } }, settings: { elementState }, gesture }: import('./arc-anatomy.ts').ArcAnatomyElement) {
  const texts = words.anatomy.table;
  const lineTextOf = (lineFormula: string, i: number) => {
    const valueText = i === TABLE_LINES - 1 ? formatDensity(lineValues[i]) : formatFixed(lineValues[i], 3);
    return `${i + 1}. ${printed ? lineFormula.replace('±', '') : lineFormula} = ${valueText}${TABLE_LINE_UNITS[i]}`;
  };
  return html`<p>${texts.introduction}</p>
    <div role="radiogroup" aria-label=${texts.label}><ul class="lines" part="table">
      ${[texts.noLine, ...TABLE_LINE_FORMULAS.map(lineTextOf)].map((lineText, lineNumber) => html`<li>
        ${radioButtonHtml({ groupName: 'line', labelContent: formatMarkup(lineText), isChecked: lineNumber === elementState.line, onChoose: () => gesture.setElementField('line', lineNumber) })}
      </li>`)}
    </ul></div>
    <p class="muted">${formatMarkup(texts.signNote)}</p>`;
}

/** Range (m) of the plot's error axis. It starts below the rounding error of the driven distance, and ends above the distance itself. */
const ERROR_AXIS_RANGE = { min: 1e-18, max: 1 };

/** Cached errors of three formulas for the end of a motion: arc, straight line and chord. The errors do not depend on the settings. */
let cachedFormErrors: FormErrors | undefined;

export function formErrorsPlotHtml({ ArcAnatomy }: Motion) {
  const texts = words.anatomy.formErrorPlot;
  const { omega, arc, straight, chord, estimatedCrossover, threshold } = (cachedFormErrors ??= ArcAnatomy.formErrors());
  return html`<figure class="forms">
    ${plotHtml({
      plotLabel: texts.errorAxis,
      x: { axisLabel: '|ω̂| (rad/s)', min: omega[0], max: omega[omega.length - 1], isLogarithmic: true },
      y: { axisLabel: texts.errorAxis, ...ERROR_AXIS_RANGE, isLogarithmic: true },
      plotCurves: [
        { name: texts.arcFormula, colourRole: 'prediction', x: omega, y: arc },
        { name: texts.straightLineFormula, colourRole: 'prior', dash: [2.5, 3.5], x: omega, y: straight },
        { name: words.anatomy.overlays.chord, colourRole: 'posterior', dash: [7, 3], x: omega, y: chord },
      ],
      verticalMarks: [
        { x: estimatedCrossover, text: `2·${formatPowerOfTen(-8)}/Δt` },
        { x: threshold, text: formatPowerOfTen(Math.log10(threshold)) },
      ],
    })}
    <figcaption>${formatMarkup(texts.caption)}</figcaption>
  </figure>`;
}
