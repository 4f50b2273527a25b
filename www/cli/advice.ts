/** Advice on the command-line option that resolves an error. */

import { LogError, truncate, UNITS } from '../logs/log.ts';

/** Quotes a text as one argument of a shell command, if necessary. */
export const quoteForShell = (text: string): string => (/^[\w./,@%+=:-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

/** Returns a sentence with the option that answers the question of an error. */
export function adviseOption({ question, message }: LogError): string {
  if (!question || message.includes(' --')) return '';
  const { option, role = 'odometry', choices, columns = [], assumedUnit } = question;
  if (option === 'other' || option === 'roles') return ' Name both, with --odometry FILE and --reference FILE.';
  const optionText = { series: `--${role}-topic`, frames: `--${role}-frames`, columns: '--columns', timeUnit: '--time-unit', lengthUnit: '--length-unit', angleUnit: '--angle-unit' }[option];
  if (question.unitPair) return ` Choose with --odometry FILE --reference FILE ${optionText} ${question.unitPair}.`;
  if (option in UNITS) {
    const allUnits: readonly string[] = UNITS[option as keyof typeof UNITS];
    const usualUnit = assumedUnit ?? allUnits[0];
    const otherUnit = [...choices, ...allUnits].find((unit) => unit !== usualUnit);
    return ` Choose with ${optionText}, as in ${optionText} ${otherUnit}; if odometry and reference differ, with --odometry FILE --reference FILE ${optionText} ${usualUnit},${otherUnit}.`;
  }
  const [exampleChoice] = choices.length > 0 ? choices.filter(Boolean) : option === 'columns' ? [`t,x,y,yaw${',-'.repeat(Math.max(0, columns.length - 4))}`] : [];
  if (exampleChoice === undefined) return ` Choose with ${optionText}.`;
  const quotedExample = quoteForShell(truncate(exampleChoice));
  return ` Choose with ${optionText}, as in ${optionText} ${quotedExample}${option === 'columns' ? `; if only one file has these columns, with --odometry FILE --reference FILE --reference-columns ${quotedExample} (or --odometry-columns)` : ''}.`;
}
