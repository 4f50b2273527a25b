/** Exercise 1: errors of three forms of the same motion at small turn rates. */

import { html } from 'lit';
import { words } from '../../messages/registry.ts';
import { rich } from '../../ui/controls.ts';
import { powerOfTen } from '../../ui/format.ts';
import { plot } from '../../ui/plot.ts';
import type { FormErrors, Motion } from '../../types.d.ts';

/** Range of errors in the plot, m: from below the last digit of the distance to more than all of it. */
const ERROR_RANGE = { from: 1e-18, to: 1 };

/** Cache of the errors of the forms, which depend on no setting. */
let errors: FormErrors | undefined;

export function formsPlot({ ArcAnatomy }: Motion) {
  const say = words.anatomy.forms;
  const { omega, arc, straight, chord, estimatedCrossover, threshold } = (errors ??= ArcAnatomy.formErrors());
  return html`<figure class="forms">
    ${plot({
      label: say.text,
      x: { name: '|ω̂| (rad/s)', from: omega[0], to: omega[omega.length - 1], logarithmic: true },
      y: { name: say.error, ...ERROR_RANGE, logarithmic: true },
      curves: [
        { name: say.arc, role: 'prediction', x: omega, y: arc },
        { name: say.straight, role: 'prior', dash: '2.5 3.5', x: omega, y: straight },
        { name: say.chord, role: 'posterior', dash: '7 3', x: omega, y: chord },
      ],
      marks: [
        { x: estimatedCrossover, text: `2·${powerOfTen(-8)}/Δt` },
        { x: threshold, text: powerOfTen(Math.log10(threshold)) },
      ],
    })}
    <figcaption>${rich(say.caption)}</figcaption>
  </figure>`;
}
