/** Drives: odometry and reference of one drive, from the recordings that have them. */

import { withoutFrozenPoses } from './frozen-pose.ts';
import { LogError, listed } from './log-error.js';
import type { Log, LogKind, Note, Series } from './log.ts';

export type Role = 'odometry' | 'reference';

/** Series with their types, for a sentence. */
const described = (series: Series[]) => listed(series.map(({ name, type }) => `${name} (${type.replace(/^.*\//, '')})`));

/** Returns the series with messages that can be read; throws a LogError if there are none. */
export function usefulSeries(file: string, series: Series[]): Series[] {
  const useful = series.filter(({ kind, count }) => kind !== null && count > 1);
  if (useful.length === 0) throw new LogError({ file }, (say) => say.noTopics(described(series)));
  return useful;
}

/** Returns an error about a series that has to be chosen, by an option of the command line. */
export function ambiguousSeries(file: string, series: Series[], role: Role, option?: string): LogError {
  // Transforms may have both, of other frames.
  const isAlone = series.length === 1 && series[0].kind !== 'transforms';
  return new LogError(
    { file },
    (say) => (isAlone ? say.alone(described(series)) : say.choose(role, described(series), option)),
    { what: 'series', role, choices: series.map(({ name }) => name) },
  );
}

const NAME_OF_ODOMETRY = /odom|wheel|cmd/i;

/** Checks whether the second of two tables is named like an odometry, and the first is not. */
export const areSwapped = (first: string, second: string) => NAME_OF_ODOMETRY.test(second) && !NAME_OF_ODOMETRY.test(first);

/** Usual names of topics of odometry, commands and references. */
const ODOMETRY = /(^|\/)odom(etry)?$/i;
const COMMANDS = /(^|\/)cmd_vel$/i;
const REFERENCE = /truth|gt|mocap|vicon|optitrack|qualisys|vrpn|reference|station|slam|amcl/i;

/** Guesses the series by their types and names; null for an ambiguous one. */
export function guessSeries(series: Series[], kind?: LogKind): { odometry: string | null; reference: string | null } {
  const of = (wanted: Series['kind']) => series.filter(({ kind, count }) => kind === wanted && count > 1);
  /** Returns the name of the only series that matches, or of the only one. */
  const guess = (some: Series[], name: RegExp) => {
    const named = some.filter((each) => name.test(each.name));
    const [only] = named.length === 1 ? named : some.length === 1 ? some : [];
    return only?.name ?? null;
  };
  const poses = of('poses');
  const odometry = guess(poses.filter(({ type, name }) => type === 'nav_msgs/msg/Odometry' && !REFERENCE.test(name)), ODOMETRY);
  const commands = kind === 'commands' ? guess(of('commands'), COMMANDS) : null;
  return { odometry: commands ?? odometry, reference: guess(poses.filter(({ name }) => name !== odometry), REFERENCE) };
}

/**
 * Pairs two logs of one drive: with times after the same start, and without rows in which the reference had lost the robot. Logs
 * without a common time are noted. Throws a LogError if the reference has no poses, or does not follow the robot.
 */
export function pairLogs(odometry: Log, reference: Log): { odometry: Log; reference: Log; start: number } {
  const place = { file: reference.name };
  const isTable = reference.summary.columns !== undefined;
  if (!isTable && odometry.name === reference.name) throw new LogError(place, (say) => say.same);
  if (reference.kind === 'commands') throw new LogError(place, (say) => say.noColumns('poses', 't, v, omega'));
  const start = Math.min(odometry.start, reference.start);
  const [first, second] = [odometry, reference].map((log) => after(start, log));
  const [one, other] = [first.data.t, second.data.t];
  const isApart = one[0] > other[other.length - 1] || other[0] > one[one.length - 1];
  const reliable = withoutFrozenPoses(second, first);
  if (reliable.data.t.length < 2) throw new LogError(place, (say) => say.held);
  const notes: Note[] = [
    ...reliable.summary.notes,
    ...(isTable && areSwapped(odometry.name, reference.name) ? [{ name: 'swapped', values: [odometry.name] } as const] : []),
    ...(isApart ? [{ name: 'apart', values: [odometry.name, span(reference), span(odometry)] } as const] : []),
  ].map((note) => ({ ...note, values: [...note.values] }));
  return { odometry: first, reference: { ...reliable, summary: { ...reliable.summary, notes } }, start };
}

/** Moves times to another start. */
export function after(start: number, log: Log): Log {
  const later = log.start - start;
  return later === 0 ? log : { ...log, start, data: { ...log.data, t: log.data.t.map((each) => each + later) } };
}

function span({ start, data: { t } }: Log): string {
  const [from, to] = [t[0], t[t.length - 1]].map((each) => (start + each).toFixed(2));
  return `${from} s to ${to} s`;
}
