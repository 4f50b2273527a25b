/** Command that is proposed after an error with a question: the typed command, with an option that answers the question. */

import { UNITS, type FileQuestion, type LogError } from '../logs/log.ts';
import { nameRoles, quoteForShell } from './options.ts';

export const formatCommand = (args: string[]): string => ['npx motion-widgets', ...args.map(quoteForShell)].join(' ');

/** Returns the message of an error. If the error has a question, the typed command follows, with the option that answers the question. */
export function explainWithCommand({ message, place: { file }, question }: LogError, typedArgs: string[]): string {
  const answeringArgs = question && answerQuestion({ ...question, file }, typedArgs);
  return answeringArgs ? `${message} For example:\n  ${formatCommand(answeringArgs)}` : message;
}

/** Returns the arguments of a command together with the option that answers a question; undefined if no option answers it. */
export function answerQuestion({ file, option, role, choices }: FileQuestion, typedArgs: string[]): string[] | undefined {
  const [likeliestChoice] = choices.filter(Boolean);
  const logRole = role ?? 'odometry';
  if (option === 'roles') return nameRoles(typedArgs);
  if (option === 'other') return [...typedArgs, ...(role ? [`--${role === 'odometry' ? 'reference' : 'odometry'}`] : []), 'FILE'];
  if (likeliestChoice === undefined) return undefined;
  if (option === 'columns') return [...typedArgs, '--columns', `${file}=${likeliestChoice}`];
  if (option in UNITS) return [...typedArgs, `--${option.replace('Unit', '-unit')}`, `${file}=${likeliestChoice}`];
  return [...typedArgs, `--${logRole}-${option === 'series' ? 'topic' : 'frames'}`, likeliestChoice];
}
