/** View model of Arc Anatomy. */

import type { ArcAnatomy } from '../../types.d.ts';

export type Reading = ReturnType<typeof readingOf>;

/** Everything that the picture and the readouts need of the machine, asked once a change. */
export const readingOf = (machine: ArcAnatomy) => machine.read();
