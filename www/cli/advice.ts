/** Command that answers the question of an error. */

import { UNITS, type FileQuestion, type LogError } from '../logs/log.ts';
import { nameRoles, quoteForShell } from './options.ts';

export const formatCommand = (args: string[]): string => ['npx motion-widgets', ...args.map(quoteForShell)].join(' ');

/** Returns the message of an error, and below it the typed command with the option that answers the question of the error. */
export function explainWithCommand({ message, place: { file }, question }: LogError, typedArgs: string[]): string {
  const answeringArgs = question && answerQuestion({ ...question, file }, typedArgs);
  return answeringArgs ? `${message} For example:\n  ${formatCommand(answeringArgs)}` : message;
}

/** Adds to the arguments of a command the option that answers a question. Returns undefined if no option answers it. */
export function answerQuestion({ file, option, role, choices, columns = [] }: FileQuestion, typedArgs: string[]): string[] | undefined {
  const [likeliestChoice] = choices.filter(Boolean);
  const logRole = role ?? 'odometry';
  if (option === 'roles') return nameRoles(typedArgs);
  if (option === 'other') return [...typedArgs, ...(role ? [`--${role === 'odometry' ? 'reference' : 'odometry'}`] : []), 'FILE'];
  if (option === 'columns') return [...typedArgs, '--columns', `${file}=${likeliestChoice ?? `t,x,y,yaw${',-'.repeat(Math.max(0, columns.length - 4))}`}`];
  if (likeliestChoice === undefined) return undefined;
  if (option in UNITS) return [...typedArgs, `--${option.replace('Unit', '-unit')}`, `${file}=${likeliestChoice}`];
  return [...typedArgs, `--${logRole}-${option === 'series' ? 'topic' : 'frames'}`, likeliestChoice];
}
