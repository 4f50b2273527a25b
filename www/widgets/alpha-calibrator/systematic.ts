/** Systematic errors of the Alpha Calibrator: as a table, and as sentences. */

import { html } from 'lit';
import { words } from '../../messages/registry.ts';
import { toggle } from '../../ui/controls.ts';
import { fixed } from '../../ui/format.ts';
import { figureTable } from '../../ui/readouts.ts';
import { SYSTEMATIC_ERRORS } from './lines.ts';
import type { Interval } from '../../types.d.ts';
import type { ViewModel } from './view-model.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

type SystematicError = ViewModel['stats']['systematicErrors']['mountYaw' | 'leverArm'];

/** Maximum number of decimals of a systematic error. */
const MAX_DECIMALS = 6;

/** Returns two sentences: one on the systematic errors that were corrected, and one on those that the α's include as noise. */
export function systematicTexts({ stats: { systematicErrors: errors } }: ViewModel) {
  const texts = words.calibrator.systematic;
  const errorTexts = (corrected: boolean) => SYSTEMATIC_ERRORS.filter((key) => errors[key].corrected === corrected).flatMap((key) => errorTextsOf(key, errors[key])).join('; ');
  const [corrected, uncorrected] = [errorTexts(true), errorTexts(false)];
  return [...(corrected ? [texts.removed(corrected)] : []), ...(uncorrected ? [texts.left(uncorrected)] : [])];
}

/** Returns a sentence on significant systematic errors that the settings leave uncorrected; empty if there are none. */
export function uncorrectedText({ stats: { systematicErrors: errors }, fitted }: ViewModel): string {
  const texts = words.calibrator.systematic;
  const uncorrectedTexts = SYSTEMATIC_ERRORS.filter((key) => !fitted[key] && isSignificant(key, errors[key])).flatMap((key) => errorTextsOf(key, errors[key]));
  return uncorrectedTexts.length > 0 ? texts.matters(uncorrectedTexts.join('; ')) : '';
}

/** Returns true if the interval of an error excludes 0, or that of a scale excludes 1. */
function isSignificant(key: string, { interval }: SystematicError) {
  const neutralValue = key.endsWith('Scale') ? 1 : 0;
  return intervalsOf(interval).some((ends) => ends && (ends[0] > neutralValue || ends[1] < neutralValue));
}

/** Returns an error as text, with its name; an empty array if the error is not identifiable. */
function errorTextsOf(key: typeof SYSTEMATIC_ERRORS[number], error: SystematicError): string[] {
  const { values, halves } = formatError(error);
  return values.length ? [`${words.calibrator.systematic.names[key]} ${values.map((value, i) => `${value} ± ${halves[i]}`).join(', ')}`] : [];
}

/** Returns the intervals of an error: two for a lever arm. */
function intervalsOf(interval: SystematicError['interval']) {
  const isPair = Array.isArray(interval) && interval.some((end) => typeof end !== 'number');
  return (isPair ? interval : [interval]) as (Interval | null)[];
}

export function systematicTable(figure: Figure) {
  const { stats: { systematicErrors: errors }, truth } = figure.viewModel;
  const texts = words.calibrator.systematic;
  const { requested } = figure.settings;
  const rows = SYSTEMATIC_ERRORS.map((key) => {
    const { values, halves } = formatError(errors[key]);
    const correctCheckbox = toggle({ label: texts.names[key], checked: requested[key], change: (on) => figure.gesture.decide({ [key]: on }) });
    if (values.length === 0) return [correctCheckbox, texts.unknown];
    return [
      correctCheckbox,
      stackTexts(values),
      html`<div class="muted">${stackTexts(halves.map((halfWidth) => `± ${halfWidth}`))}</div>`,
      errors[key].corrected ? texts.corrected : errors[key].constant ? texts.notCorrected : texts.notConstant,
      ...(truth ? [html`<div class="muted">${stackTexts([truth[key]].flat().map((component) => fixed(component, 3)))}</div>`] : []),
    ];
  });
  const columns = [texts.what, texts.value, words.calibrator.alphas.interval, texts.treatment, ...(truth ? [texts.truth] : [])];
  return html`<div class="systematic">${figureTable({ columns, rows })}</div>`;
}

const stackTexts = (texts: string[]) => texts.map((text) => html`<div>${text}</div>`);

/** Formats the values of an error (two for a lever arm) and half the width of each interval, with significant digits. */
function formatError({ value, interval }: SystematicError) {
  const halfWidths = intervalsOf(interval).map((limits) => limits && (limits[1] - limits[0]) / 2);
  return {
    values: [value].flat().flatMap((component, i) => (component === null ? [] : [fixed(component, decimalsOf(halfWidths[i]))])),
    halves: halfWidths.flatMap((halfWidth) => (halfWidth === null ? [] : [fixed(halfWidth, decimalsOf(halfWidth))])),
  };
}

/** Returns the number of decimals of an error: three, or more if its interval is narrower than a thousandth. */
const decimalsOf = (halfWidth: number | null | undefined) => (halfWidth ? Math.min(MAX_DECIMALS, Math.max(3, -Math.floor(Math.log10(2 * halfWidth)))) : 3);
