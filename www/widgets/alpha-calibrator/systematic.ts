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
function isSignificant(key: string, error: SystematicError) {
  const neutralValue = key.endsWith('Scale') ? 1 : 0;
  return componentsOf(error).some(({ interval }) => interval && (interval[0] > neutralValue || interval[1] < neutralValue));
}

/** Returns an error as text, with its name; an empty array if the error is not identifiable. */
function errorTextsOf(key: typeof SYSTEMATIC_ERRORS[number], error: SystematicError): string[] {
  const componentTexts = componentsOf(error).map(({ text, halfText }) => `${text} ${halfText}`);
  return componentTexts.length ? [`${words.calibrator.systematic.names[key]} ${componentTexts.join(', ')}`] : [];
}

export function systematicTable(figure: Figure) {
  const { stats: { systematicErrors: errors }, truth } = figure.viewModel;
  const texts = words.calibrator.systematic;
  const { requested } = figure.settings;
  const rows = SYSTEMATIC_ERRORS.map((key) => {
    const components = componentsOf(errors[key]);
    const correctCheckbox = toggle({ label: texts.names[key], checked: requested[key], change: (on) => figure.gesture.decide({ [key]: on }) });
    if (components.length === 0) return [correctCheckbox, texts.unknown];
    return [
      correctCheckbox,
      stackTexts(components.map(({ text }) => text)),
      html`<div class="muted">${stackTexts(components.map(({ halfText }) => halfText))}</div>`,
      errors[key].corrected ? texts.corrected : errors[key].constant ? texts.notCorrected : texts.notConstant,
      ...(truth ? [html`<div class="muted">${stackTexts([truth[key]].flat().map((component) => fixed(component, 3)))}</div>`] : []),
    ];
  });
  const columns = [texts.what, texts.value, words.calibrator.alphas.interval, texts.treatment, ...(truth ? [texts.truth] : [])];
  return html`<div class="systematic">${figureTable({ columns, rows })}</div>`;
}

const stackTexts = (texts: string[]) => texts.map((text) => html`<div>${text}</div>`);

/**
 * Returns the components of an identifiable error (two for a lever arm) with their intervals, and as texts: the value, and half the width of
 * the interval. Both have three decimals, or more if the interval is narrower than a thousandth.
 */
function componentsOf({ value, interval }: SystematicError) {
  const intervals = (Array.isArray(value) ? interval : [interval]) as (Interval | null)[];
  return [value].flat().flatMap((component, i) => {
    if (component === null) return [];
    const halfWidth = intervals[i] && (intervals[i][1] - intervals[i][0]) / 2;
    const decimals = halfWidth ? Math.min(MAX_DECIMALS, Math.max(3, -Math.floor(Math.log10(2 * halfWidth)))) : 3;
    return [{ interval: intervals[i], text: fixed(component, decimals), halfText: halfWidth === null ? '' : `± ${fixed(halfWidth, decimals)}` }];
  });
}
