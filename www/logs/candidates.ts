/** Series that could be odometry or reference, by their types and names. */

import type { Choice, Frames, LogKind, Recording, Role, Series } from './log.ts';

/** Names of odometry and of commands, the likeliest first. */
const ODOMETRY_NAMES = [/(^|[/_.])odom(etry)?[/_.]?$/i, /odom|wheel|encoder/i];
const COMMAND_NAMES = [/(^|[/_.])cmd_?vel[/_.]?$/i, /cmd|command|twist/i];

/** Names of measurements from outside. */
const MEASUREMENT_NAMES = /truth|(^|[^a-z])(gt|ref|true)([^a-z]|$)|mocap|vicon|optitrack|qualisys|vrpn|motive|natnet|phasespace|reference|station|leica|prism|tracker/i;

/** Names of estimates by localizers. Their errors follow those of the odometry if they use it. */
const LOCALIZER_NAMES = /slam|amcl|locali[sz]|carto|tracked_pose|icp|loam|scan_?match|pose_graph/i;

/** Names of filters over the odometry. */
const FILTER_NAMES = /odometry[/_]filtered|ekf|ukf|odom_combined/i;

/** Names of topics with poses that are not a path of the robot. */
export const GOAL_NAMES = /goal|initial_?pose|waypoint|target|setpoint|clicked_?point/i;

/** Names of frames on a robot, and of fixed frames for each role, the likeliest first. */
const BASE_FRAMES = [/(^|\/)base_footprint$/, /(^|\/)base_link$/, /(^|\/)base/];
const FIXED_FRAMES = { odometry: [/(^|[/_])odom(etry)?$/], reference: [/mocap|vicon|optitrack|world/, /(^|\/)map$/] };

const ODOMETRY_FILE_NAMES = /odom|wheel|encoder|cmd/i;

/** Returns true if a recording is a table, which has groups of columns instead of topics. */
export const isTable = ({ format }: Pick<Recording, 'format'>): boolean => !['mcap', 'rosbag', 'sqlite'].includes(format);

/** Returns true if, by its name and frames, a log is the estimate of a localizer, or of a filter over the odometry. */
export const isLocalizer = (name: string, frames?: Frames): boolean => frames?.parent === 'map' || ((LOCALIZER_NAMES.test(name) || FILTER_NAMES.test(name)) && !MEASUREMENT_NAMES.test(name));

/** Returns the role that is in the name of a file; undefined if there is none. */
export function roleByName(name: string): Role | undefined {
  if (MEASUREMENT_NAMES.test(name) || LOCALIZER_NAMES.test(name)) return 'reference';
  return ODOMETRY_FILE_NAMES.test(name) ? 'odometry' : undefined;
}

/** Returns the series that can be read. A topic needs two messages. */
export const readableSeries = (recording: Recording): Series[] => recording.series.filter(({ kind, count }) => kind !== null && (isTable(recording) || count > 1));

/** Returns the series with a name. The name may lack the separators at its ends. */
export function seriesNamed(series: Series[], wantedName: string): Series | undefined {
  const trimmed = (name: string) => name.replaceAll(/^[/_.]+|[/_.]+$/g, '');
  return series.find(({ name }) => name === wantedName) ?? series.find(({ name }) => trimmed(name) !== '' && trimmed(name) === trimmed(wantedName));
}

/** Returns the names of the series that could be the log of a role, the likeliest first. */
export function seriesNamesFor(recording: Recording, role: Role): string[] {
  const usableSeries = readableSeries(recording).filter(({ kind }) => role === 'odometry' || kind !== 'commands');
  return [...new Set([...candidates(recording, role).flat().map(({ series }) => series), ...usableSeries.map(({ name }) => name)])];
}

/** Returns the logs that could have a role, in groups of equal likelihood, the likeliest first. A group of several logs is ambiguous. */
export function candidates(recording: Recording, role: Role, { kind }: { kind?: LogKind } = {}): Choice[][] {
  const isTableFile = isTable(recording);
  const useful = readableSeries(recording).filter(({ name }) => !GOAL_NAMES.test(name));
  const poseSeries = useful.filter((entry) => entry.kind === 'poses');
  const chains = useful.flatMap(({ name, frames = [] }) => likeliestFrames(frames, role).map((pair) => ({ series: name, frames: pair })));
  if (role === 'reference') {
    const unfilteredPaths = poseSeries.filter(({ name }) => !FILTER_NAMES.test(name) && !ODOMETRY_NAMES[0].test(name));
    return [...tiersByName(poseSeries, [MEASUREMENT_NAMES, LOCALIZER_NAMES], 'poses'), choicesOf(unfilteredPaths, 'poses'), ...(isTableFile && useful.length === 1 ? [choicesOf(poseSeries, 'poses')] : []), chains];
  }
  // The type of the message is a sign that it is odometry.
  const wheelPaths = poseSeries.filter(({ name, type }) => !MEASUREMENT_NAMES.test(name) && !LOCALIZER_NAMES.test(name) && (isTableFile || /Odometry$/.test(type)));
  const poseTiers = [...tiersByName(wheelPaths, ODOMETRY_NAMES), choicesOf(wheelPaths), chains];
  const commandSeries = useful.filter((entry) => entry.kind === 'commands' || (isTableFile && entry.hasCommands));
  const commandTiers = [...tiersByName(commandSeries, COMMAND_NAMES, 'commands'), choicesOf(commandSeries, 'commands')];
  return kind === 'commands' ? [...commandTiers, ...poseTiers] : isTableFile ? [...poseTiers, ...commandTiers] : poseTiers;
}

const choicesOf = (series: Series[], kind?: LogKind): Choice[] => series.map(({ name }) => ({ series: name, ...(kind && { kind }) }));

const tiersByName = (series: Series[], names: RegExp[], kind?: LogKind): Choice[][] => names.map((pattern) => choicesOf(series.filter(({ name }) => pattern.test(name)), kind));

/** Returns the likeliest pairs of frames for a role, by the names of the frames. */
export function likeliestFrames(frames: Frames[], role: Role): Frames[] {
  const firstNamed = (candidates: Frames[], names: RegExp[], end: keyof Frames) => names.map((name) => candidates.filter((pair) => name.test(pair[end]))).find(({ length }) => length);
  const pairsWithFixedParent = firstNamed(frames, FIXED_FRAMES[role], 'parent') ?? [];
  return firstNamed(pairsWithFixedParent, BASE_FRAMES, 'child') ?? pairsWithFixedParent;
}
