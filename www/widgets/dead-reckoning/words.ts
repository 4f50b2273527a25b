/** Texts of Dead Reckoning in the current language. */

import { greatest, max } from 'd3-array';
import { addEnglish, words } from '../../messages/registry.ts';
import { NO_VALUE, integer, fixed, formatWithError } from '../../ui/format.ts';
import { commandText } from '../shared/sliders.ts';
import { en } from './en.ts';
import { COMPONENTS, type ViewModel } from './view-model.ts';

addEnglish({ reckoning: en });

/** Steps at which the caption gives the ratio of the worst component. */
const CAPTION_STEPS = [1, 2, 5];

/** Prints a fraction in per cent, with a sign unless it rounds to 0. */
function signedPercent(share: number, printedPercent: string = fixed(100 * share, 1)) {
  if (Number.isNaN(share)) return NO_VALUE;
  return `${100 * share >= 0.05 ? '+' : ''}${printedPercent}\u202f%`;
}

/** Returns the relative error of the predicted variance after the last step, as text. */
export const finalErrorText = ({ end, error }: { end: number, error: number }) => signedPercent(end, formatWithError(100 * end, 100 * error, 1));

/** Returns a caption that says how well the recursion predicts the components that are shown. */
export function captionOf({ config: { compounding }, stats: { misses, n }, condition, curves }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  if (condition !== 'certain') return texts.conditions[condition];
  const recursionMisses = misses[compounding];
  if (recursionMisses.every(({ first }) => first === null)) return texts.right(integer(n));
  // The component whose ratio is furthest from 1 at the end, and the one whose ratio is furthest from 1 at any step.
  const endAxis = worstAxisOf(overlays, (axis) => Math.abs(recursionMisses[axis].end));
  const worstAxis = worstAxisOf(overlays, (axis) => max(curves[axis].ratio, (ratio) => Math.abs(ratio - 1)) ?? NaN);
  const ratioList = ratiosAtSteps(Array.from(curves[worstAxis].ratio));
  return texts.wrong(texts.of[COMPONENTS[worstAxis]], ratioList, signedPercent(recursionMisses[endAxis].end), texts.of[COMPONENTS[endAxis]]);
}

/** Returns the index of the shown component whose miss (error of the prediction) is greatest; NaN is not a miss. */
function worstAxisOf(overlays: string[], missOf: (axis: number) => number) {
  const shownAxes = shownComponentsOf(overlays).map((name) => COMPONENTS.indexOf(name));
  return greatest(shownAxes, missOf) ?? shownAxes[0];
}

const ratiosAtSteps = (ratios: number[]) =>
  CAPTION_STEPS.filter((step) => step <= ratios.length).map((step) => `${fixed(ratios[step - 1], 2)} (${words.reckoning.atStepMark(step)})`).join(', ');

/** Returns the components whose curves are shown, or all components if no curve is shown. */
export function shownComponentsOf(overlays: string[]): readonly (typeof COMPONENTS)[number][] {
  const selectedComponents = COMPONENTS.filter((name) => overlays.includes(name));
  return selectedComponents.length > 0 ? selectedComponents : COMPONENTS;
}

/** Returns the component whose ratio at the selected step is furthest from 1, of those shown. */
export function worstComponentAt({ config: { step }, curves }: ViewModel, overlays: string[]) {
  const axis = worstAxisOf(overlays, (i) => Math.abs(curves[i].ratio[step - 1] - 1));
  return { component: COMPONENTS[axis], ratio: curves[axis].ratio[step - 1], error: curves[axis].error[step - 1] };
}

export function ratioText({ config: { step, compounding }, curves }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  const ratioTexts = shownComponentsOf(overlays).map((name) => {
    const { ratio, error } = curves[COMPONENTS.indexOf(name)];
    return `${texts.overlays[name]} ${formatWithError(ratio[step - 1], error[step - 1], 2)}`;
  });
  return texts.ratioText(texts.recursions[compounding], String(step), ratioTexts.join(', '));
}

export function planeText({ config, shown, pose }: ViewModel) {
  const { command, steps, step, compounding } = config;
  const texts = words.reckoning;
  return texts.plane(commandText(command), String(steps), integer(shown), String(step), fixed(pose[0], 2), fixed(pose[1], 2), texts.recursions[compounding]);
}

export function stepText({ config: { step, compounding }, stats: { measured, predicted } }: ViewModel) {
  const texts = words.reckoning;
  const planeDeviations = (cov: number[][] | null) => [0, 1].map((axis) => fixed(Math.sqrt(cov?.[axis][axis] ?? NaN), 4));
  return texts.stepText(String(step), planeDeviations(measured.cov), planeDeviations(predicted[compounding]));
}
