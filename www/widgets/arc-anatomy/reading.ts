/** View model of Arc Anatomy. */

import type { ArcAnatomy } from '../../types.d.ts';

export type Reading = ReturnType<typeof readingOf>;

/** Reads everything that the picture and the readouts need of the machine, once for each change. */
export const readingOf = (machine: ArcAnatomy) => machine.read();
