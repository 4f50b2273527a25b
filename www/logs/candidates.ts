/** Series that could be odometry or reference, by their types and names. */

import type { LogChoice, FramePair, LogKind, Recording, Role, Series } from './log.ts';

/** Names of odometry and of commands, the likeliest first. */
const ODOMETRY_NAMES = [/(^|[/_.])odom(etry)?[/_.]?$/i, /odom|wheel|encoder/i];
const COMMAND_NAMES = [/(^|[/_.])cmd[_.]?vel[/_.]?$/i, /cmd|command|twist/i];

/** Names of external measurements of the pose, such as motion capture or a total station. */
const MEASUREMENT_NAMES = /truth|(^|[^a-z])(gt|ref|true)([^a-z]|$)|mocap|vicon|optitrack|qualisys|vrpn|motive|natnet|phasespace|reference|station|leica|prism|tracker/i;

/** Names of poses estimated by localizers. Their errors are correlated with those of the odometry that they use. */
const LOCALIZER_NAMES = /slam|amcl|locali[sz]|carto|tracked[_.]pose|icp|loam|scan[_.]?match|pose[_.]graph/i;

/** Names of poses estimated by filters of the odometry. */
const FILTER_NAMES = /odometry[/_.]filtered|ekf|ukf|odom[_.]combined/i;

/** Names of topics with poses that are not a path of the robot. */
export const GOAL_NAMES = /goal|initial[_.]?pose|waypoint|target|setpoint|clicked[_.]?point/i;

/** Names of base frames of a robot, and of fixed frames by the role of the log, the likeliest first. */
const BASE_FRAME_NAMES = [/(^|\/)base_footprint$/, /(^|\/)base_link$/, /(^|\/)base/];
const FIXED_FRAME_NAMES = { odometry: [/(^|[/_])odom(etry)?$/], reference: [/mocap|vicon|optitrack|world/, /(^|\/)map$/] };

const ODOMETRY_FILE_NAMES = /odom|wheel|encoder|cmd/i;

/** Returns true if a recording is a table. Its series are groups of columns, not topics. */
export const isTable = ({ format }: Pick<Recording, 'format'>): boolean => !['mcap', 'rosbag', 'sqlite'].includes(format);

/** Returns true if the name or the frames of a log show that a localizer or a filter of the odometry estimated its poses. */
export const isLocalizer = (name: string, frames?: FramePair): boolean => frames?.parent === 'map' || ((LOCALIZER_NAMES.test(name) || FILTER_NAMES.test(name)) && !MEASUREMENT_NAMES.test(name));

/** Returns the role that the name of a file shows; undefined if it shows none. */
export function roleByName(name: string): Role | undefined {
  if (MEASUREMENT_NAMES.test(name) || LOCALIZER_NAMES.test(name)) return 'reference';
  return ODOMETRY_FILE_NAMES.test(name) ? 'odometry' : undefined;
}

/** Returns the series that can be read. A topic needs two messages. */
export const readableSeries = (recording: Recording): Series[] => recording.series.filter(({ kind, count }) => kind !== null && (isTable(recording) || count > 1));

/** Returns the series with a name. Separators and capitals do not count. */
export function seriesNamed(series: Series[], wantedName: string): Series | undefined {
  const words = (name: string) => name.toLowerCase().split(/[^\p{L}\p{N}]+/u).filter(Boolean).join('.');
  return series.find(({ name }) => name === wantedName) ?? series.find(({ name }) => words(name) !== '' && words(name) === words(wantedName));
}

/** Returns the names of the series that could be the log of a role, the likeliest first. */
export function seriesNamesFor(recording: Recording, role: Role): string[] {
  const usableSeries = readableSeries(recording).filter(({ kind }) => role === 'odometry' || kind !== 'commands');
  return [...new Set([...findCandidates(recording, role).flat().map(({ series }) => series), ...usableSeries.map(({ name }) => name)])];
}

/** Returns the logs that could have a role, in tiers: groups of equal likelihood, the likeliest first. A tier of several logs is ambiguous. */
export function findCandidates(recording: Recording, role: Role, { kind }: { kind?: LogKind } = {}): LogChoice[][] {
  const isTableFile = isTable(recording);
  const seriesWithoutGoals = readableSeries(recording).filter(({ name }) => !GOAL_NAMES.test(name));
  const poseSeries = seriesWithoutGoals.filter((entry) => entry.kind === 'poses');
  const chainChoices = seriesWithoutGoals.flatMap(({ name, frames = [] }) => likeliestFrames(frames, role).map((pair) => ({ series: name, frames: pair })));
  if (role === 'reference') {
    const unfilteredPaths = poseSeries.filter(({ name }) => !FILTER_NAMES.test(name) && !ODOMETRY_NAMES[0].test(name));
    return [...choiceTiersByName(poseSeries, [MEASUREMENT_NAMES, LOCALIZER_NAMES], 'poses'), choicesOf(unfilteredPaths, 'poses'), ...(isTableFile && seriesWithoutGoals.length === 1 ? [choicesOf(poseSeries, 'poses')] : []), chainChoices];
  }
  // A topic of the type Odometry is likely to be odometry.
  const wheelPaths = poseSeries.filter(({ name, type }) => !MEASUREMENT_NAMES.test(name) && !LOCALIZER_NAMES.test(name) && (isTableFile || /Odometry$/.test(type)));
  const poseTiers = [...choiceTiersByName(wheelPaths, ODOMETRY_NAMES), choicesOf(wheelPaths), chainChoices];
  const commandSeries = seriesWithoutGoals.filter((entry) => entry.kind === 'commands' || (isTableFile && entry.hasCommands));
  const commandTiers = [...choiceTiersByName(commandSeries, COMMAND_NAMES, 'commands'), choicesOf(commandSeries, 'commands')];
  return kind === 'commands' ? [...commandTiers, ...poseTiers] : isTableFile ? [...poseTiers, ...commandTiers] : poseTiers;
}

const choicesOf = (series: Series[], kind?: LogKind): LogChoice[] => series.map(({ name }) => ({ series: name, ...(kind && { kind }) }));

const choiceTiersByName = (series: Series[], names: RegExp[], kind?: LogKind): LogChoice[][] => names.map((pattern) => choicesOf(series.filter(({ name }) => pattern.test(name)), kind));

/** Returns the likeliest pairs of frames for a role, by the names of the frames. */
export function likeliestFrames(frames: FramePair[], role: Role): FramePair[] {
  const firstMatchingFrames = (framePairs: FramePair[], names: RegExp[], end: keyof FramePair) => names.map((name) => framePairs.filter((pair) => name.test(pair[end]))).find(({ length }) => length);
  const pairsWithFixedParent = firstMatchingFrames(frames, FIXED_FRAME_NAMES[role], 'parent') ?? [];
  return firstMatchingFrames(pairsWithFixedParent, BASE_FRAME_NAMES, 'child') ?? pairsWithFixedParent;
}
