/** Advice on the command-line option that resolves an error. */

import { LogError, truncate, UNITS } from '../logs/log.ts';

/** Quotes a text as one argument of a shell command, if necessary. */
export const quoteForShell = (text: string): string => (/^[\w./,@%+=:-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

/** Returns a sentence with the option that answers the question of an error. */
export function adviseOption({ ask, message }: LogError): string {
  if (!ask || message.includes(' --')) return '';
  const { what, role = 'odometry', choices, columns = [], doubted } = ask;
  if (what === 'other' || what === 'roles') return ' Name both, with --odometry FILE and --reference FILE.';
  const optionText = { series: `--${role}-topic`, frames: `--${role}-frames`, columns: '--columns', timeUnit: '--time-unit', lengthUnit: '--length-unit', angleUnit: '--angle-unit' }[what];
  if (ask.pair) return ` Choose with --odometry FILE --reference FILE ${optionText} ${ask.pair}.`;
  if (what in UNITS) {
    const allUnits: readonly string[] = UNITS[what as keyof typeof UNITS];
    const usualUnit = doubted ?? allUnits[0];
    const otherUnit = [...choices, ...allUnits].find((unit) => unit !== usualUnit);
    return ` Choose with ${optionText}, as in ${optionText} ${otherUnit}; if odometry and reference differ, with --odometry FILE --reference FILE ${optionText} ${usualUnit},${otherUnit}.`;
  }
  const [exampleChoice] = choices.length > 0 ? choices.filter(Boolean) : what === 'columns' ? [`t,x,y,yaw${',-'.repeat(Math.max(0, columns.length - 4))}`] : [];
  if (exampleChoice === undefined) return ` Choose with ${optionText}.`;
  const quotedExample = quoteForShell(truncate(exampleChoice));
  return ` Choose with ${optionText}, as in ${optionText} ${quotedExample}${what === 'columns' ? `; if only one file has these columns, with --odometry FILE --reference FILE --reference-columns ${quotedExample} (or --odometry-columns)` : ''}.`;
}
