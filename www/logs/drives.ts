/** Search for the odometry and the reference of each drive in recordings. */

import { sort } from 'd3-array';
import { LogError, listNames, readableSeriesOf, ROLES, formatFramesOption, formatFrames, type LogChoice, type FramePair, type LogKind, type Recording, type Role, type Series } from './log.ts';

/** Recording, with the choice of the log to read for each role. A recording with only one log is paired with another recording after both have been read. */
export interface PlannedRecording { recording: Recording; choices: Partial<Record<Role, LogChoice>> }

/** Choices of the user. The program guesses the choices that are missing. */
export interface UserChoices {
  /** `series` is the name of a series. For a table, that is the common prefix of its columns without the separator at the end. `frames` selects a pair of frames among transforms. */
  odometry?: { series?: string; frames?: FramePair };
  reference?: { series?: string; frames?: FramePair };
  /** Kind of odometry: `commands` prefers commands to poses, and `poses` excludes commands. By default poses come first. */
  kind?: LogKind;
}

/** Patterns of names of odometry and of commands, the likeliest first. */
const ODOMETRY_NAMES = [/(^|[/_.])odom(etry)?[/_.]?$/i, /odom|wheel|encoder/i];
const COMMAND_NAMES = [/(^|[/_.])cmd[_.]?vel[/_.]?$/i, /cmd|command|twist/i];

/** Patterns of names of external measurements of the pose, such as motion capture or a total station. */
const MEASUREMENT_NAMES = /truth|(^|[^a-z])(gt|ref|true)([^a-z]|$)|mocap|vicon|optitrack|qualisys|vrpn|motive|natnet|phasespace|reference|station|leica|prism|tracker/i;

/** Patterns of names of poses estimated by localizers. The errors of such poses are correlated with those of the odometry that a localizer uses. */
const LOCALIZER_NAMES = /slam|amcl|locali[sz]|carto|tracked[_.]pose|icp|loam|scan[_.]?match|pose[_.]graph/i;

/** Patterns of names of poses that a filter estimated from the odometry. */
const FILTER_NAMES = /odometry[/_.]filtered|ekf|ukf|odom[_.]combined/i;

/** Patterns of topics whose poses are goals or clicked points, and not a path of the robot. */
const GOAL_NAMES = /goal|initial[_.]?pose|waypoint|target|setpoint|clicked[_.]?point/i;

/** Patterns of names of a robot's base frames, and of fixed frames by the role of the log, the likeliest first. */
const BASE_FRAME_NAMES = [/(^|\/)base_footprint$/, /(^|\/)base_link$/, /(^|\/)base/];
const FIXED_FRAME_NAMES = { odometry: [/(^|[/_])odom(etry)?$/], reference: [/mocap|vicon|optitrack|world/, /(^|\/)map$/] };

const ODOMETRY_FILE_NAMES = /odom|wheel|encoder|cmd/i;

const describeSeries = (series: Series[]) => listNames(series.map(({ name, type }) => (name ? `${name} (${type.replace(/^\w+\/(msg\/)?(?=\w+( as |$))/, '')})` : type)));

const isSameChoice = (choice: LogChoice, otherChoice?: LogChoice) => choice.series === otherChoice?.series && choice.frames?.parent === otherChoice.frames?.parent && choice.frames?.child === otherChoice.frames?.child;

/**
 * Chooses the logs of recordings that are read. Recordings with odometry come first. Throws a LogError, which has a question if the choice is ambiguous. Calls `onSkip` with the
 * error of each recording that is left out, because none of its series can be read.
 */
export function planDrives(allRecordings: Recording[], userChoices: UserChoices = {}, onSkip?: (error: LogError) => void): PlannedRecording[] {
  const usableRecordings = allRecordings.filter((recording) => recording.role || readableSeriesOf(recording).length > 0);
  const recordings = usableRecordings.length > 0 ? usableRecordings : allRecordings;
  for (const recording of allRecordings) if (!recordings.includes(recording)) onSkip?.(createUnusableError(recording));
  const rolesByName = recordings.map((recording) => recording.role ?? (recordings.length > 1 ? roleOfRecording(recording, userChoices) : 'both'));
  const isHalfOf = (role: Role) => 2 * rolesByName.filter((otherRole) => otherRole === role).length >= recordings.length;
  const plan = recordings.map((recording, i): PlannedRecording => {
    // If at least half of the recordings have the same role, a recording of unknown role gets the other role.
    const role = rolesByName[i] ?? (isHalfOf('odometry') ? 'reference' : isHalfOf('reference') ? 'odometry' : undefined);
    if (!role) throw new LogError({ file: recording.name }, (texts) => texts.unknownRoleReason, { option: 'roles', choices: [] });
    return { recording, choices: role === 'both' ? chooseBothLogs(recording, userChoices) : { [role]: chooseLog(recording, role, userChoices) } };
  });
  const recordingsWith = (role: Role) => plan.filter(({ choices }) => choices[role]);
  // If there are separate files for one role, the logs of that role in recordings with odometry and reference are not used.
  const [scarceRole, replacedRole] = recordingsWith('odometry').length < recordingsWith('reference').length ? ROLES : ROLES.toReversed();
  const completeRecordings = plan.filter(({ choices }) => choices.odometry && choices.reference);
  if (completeRecordings.length === recordingsWith(replacedRole).length - recordingsWith(scarceRole).length) for (const { choices } of completeRecordings) delete choices[replacedRole];
  const [odometry, reference] = ROLES.map((role) => recordingsWith(role).map(({ recording }) => recording));
  if (odometry.length !== reference.length) {
    const unpairedRecordings = odometry.length > reference.length ? odometry : reference;
    // If a recording has several candidates for the missing log, this call throws a LogError that asks which one to read. Such a question helps more than
    // the error that is thrown below.
    for (const recording of unpairedRecordings) tryUnlessLogError(() => chooseBothLogs(recording, userChoices), ({ question }) => question?.option !== 'series');
    const [odometryNames, referenceNames] = [odometry, reference].map((recordingsOfRole) => listNames(recordingsOfRole.map(({ name }) => name)));
    throw new LogError({ file: unpairedRecordings[0].name }, (texts) => texts.unpairedLogsReason(odometryNames, referenceNames), { option: recordings.length === 1 ? 'other' : 'roles', role: odometryNames ? 'odometry' : 'reference', choices: [] });
  }
  return sort(plan, ({ choices }) => Number(!choices.odometry));
}

/** Returns the role of one of several recordings: "both" if it has odometry and reference, and undefined if neither its name nor its contents show a role. */
function roleOfRecording(recording: Recording, userChoices: UserChoices): Role | 'both' | undefined {
  if (tryUnlessLogError(() => chooseBothLogs(recording, userChoices))) return 'both';
  const [isOdometry, isReference] = ROLES.map((role) => tryUnlessLogError(() => chooseLog(recording, role, userChoices)) !== undefined);
  if (isOdometry !== isReference) return isOdometry ? 'odometry' : 'reference';
  // A file with several rigid bodies has candidates for both roles, and therefore logs, although it is unclear which candidate to read.
  const hasLogs = isOdometry || ROLES.every((role) => findCandidates(recording, role, userChoices).some(({ length }) => length > 0));
  if (!hasLogs) return 'both';
  return roleByName(recording.name) ?? (recording.series.some(({ hasCommands }) => hasCommands) ? 'odometry' : undefined);
}

/** Returns the result of a function, or undefined if it throws an expected LogError. */
function tryUnlessLogError<Result>(doWork: () => Result, isExpected: (error: LogError) => boolean = () => true): Result | undefined {
  try {
    return doWork();
  } catch (error) {
    if (error instanceof LogError && isExpected(error)) return undefined;
    throw error;
  }
}

function chooseBothLogs(recording: Recording, userChoices: UserChoices): Record<Role, LogChoice> {
  // The reference that the user chose is excluded from the guess of the odometry.
  const { series, frames } = userChoices.reference ?? {};
  const chosenReference = series !== undefined || frames ? chooseLog(recording, 'reference', userChoices) : undefined;
  const odometry = tryUnlessLogError(() => chooseLog(recording, 'odometry', userChoices, chosenReference)) ?? chooseLog(recording, 'odometry', userChoices);
  const reference = chosenReference ?? chooseLog(recording, 'reference', userChoices, odometry);
  if (isSameChoice(odometry, reference)) {
    const question = { option: 'series' as const, role: 'reference' as const, choices: seriesNamesFor(recording, 'reference').filter((name) => name !== reference.series) };
    throw new LogError({ file: recording.name, topic: reference.series }, (texts) => texts.sameLogReason(reference.frames ? formatFrames(reference.frames) : reference.series), question);
  }
  return { odometry, reference };
}

/** Returns the likeliest candidates for a role among those for which `isPossible` returns true. */
const findLikeliestChoices = (recording: Recording, role: Role, userChoices: UserChoices, isPossible: (choice: LogChoice) => boolean) =>
  findCandidates(recording, role, userChoices).map((choiceTier) => choiceTier.filter(isPossible)).find(({ length }) => length) ?? [];

/** Returns the choice of a log for a role. It is another log than `otherRoleChoice`, the choice for the other role. */
function chooseLog(recording: Recording, role: Role, userChoices: UserChoices, otherRoleChoice?: LogChoice): LogChoice {
  const { series, frames } = userChoices[role] ?? {};
  if (series === undefined && !frames) return guessChoice(recording, role, userChoices, otherRoleChoice);
  const kind = role === 'reference' ? 'poses' : userChoices.kind;
  const chosenSeries = series === undefined
    ? recording.series.find((entry) => entry.frames)
    : findSeriesByName(recording.series, series);
  if (!chosenSeries) {
    const names = seriesNamesFor(recording, role);
    throw new LogError(
      { file: recording.name, topic: series },
      (texts) => texts.unknownTopicReason(describeSeries(readableSeriesOf(recording))),
      { option: 'series', role, choices: names },
    );
  }
  if (chosenSeries.kind !== 'transforms' || frames) return { series: chosenSeries.name, ...(kind && { kind }), ...(frames && { frames }) };
  const chains = findLikeliestChoices(recording, role, userChoices, (choice) => choice.series === chosenSeries.name);
  if (chains.length === 1) return chains[0];
  throw createFramesError(recording, chosenSeries, role);
}

function createFramesError({ name: file }: Recording, { name: topic, frames = [] }: Series, role: Role): LogError {
  const frameTexts = [...new Set([...findLikeliestFrames(frames, role), ...frames])].map(formatFramesOption);
  return new LogError({ file, topic }, (texts) => texts.missingFramesReason(listNames(frames.map(formatFrames))), { option: 'frames', role, choices: frameTexts });
}

function guessChoice(recording: Recording, role: Role, userChoices: UserChoices, otherRoleChoice?: LogChoice): LogChoice {
  const bestChoices = findLikeliestChoices(recording, role, userChoices, (choice) => !isSameChoice(choice, otherRoleChoice));
  // Among equally likely choices, logs with the same robot frame as the other log are preferred.
  const choicesOfSameRobot = bestChoices.filter(({ frames }) => frames && frames.child === otherRoleChoice?.frames?.child);
  if (choicesOfSameRobot.length === 1) return choicesOfSameRobot[0];
  if (bestChoices.length === 1) return bestChoices[0];
  const file = recording.name;
  const usableSeries = readableSeriesOf(recording);
  if (usableSeries.length === 0) throw createUnusableError(recording);
  const chains = usableSeries.filter(({ kind }) => kind === 'transforms');
  const hasOnlyOtherChoice = otherRoleChoice && chains.every(({ name: series, frames = [] }) => frames.every((ends) => isSameChoice({ series, frames: ends }, otherRoleChoice)));
  if (chains.length === usableSeries.length && !hasOnlyOtherChoice) throw createFramesError(recording, chains.find((chain) => chain.frames) ?? chains[0], role);
  const positionSeries = usableSeries.filter(({ name, kind }) => kind === 'positions' && !GOAL_NAMES.test(name));
  if (positionSeries.length === usableSeries.length || (role === 'reference' && bestChoices.length === 0 && positionSeries.length > 0)) {
    throw new LogError({ file }, (texts) => texts.noHeadingReason(describeSeries(positionSeries)));
  }
  if (usableSeries.length === 1) {
    const ownRole = roleOfSeries(recording, usableSeries[0]) ?? (otherRoleChoice?.frames && ROLES.find((otherRole) => otherRole !== role));
    throw new LogError({ file }, (texts) => texts.singleLogReason(describeSeries(usableSeries), ownRole), { option: 'other', role: ownRole, choices: [] });
  }
  throw new LogError(
    { file },
    (texts) => (bestChoices.length > 0 ? texts.ambiguousRoleReason : texts.missingRoleReason)(role, describeSeries(usableSeries)),
    { option: 'series', role, choices: bestChoices.length > 0 ? seriesNamesFor(recording, role).filter((name) => name !== otherRoleChoice?.series) : usableSeries.filter(({ kind }) => role === 'odometry' && kind === 'commands').map(({ name }) => name) },
  );
}

function createUnusableError({ name: file, series }: Recording): LogError {
  const shortSeries = series.find(({ kind }) => kind !== null);
  return new LogError({ file, topic: shortSeries?.name }, (texts) => (shortSeries ? texts.fewRowsReason(shortSeries.count, shortSeries.count) : texts.noLogTopicsReason(describeSeries(series))));
}

/** Returns the role of the only series in a recording, from the name of the series, its contents or the name of the file; undefined if none of these shows a role. */
function roleOfSeries({ name: file }: Recording, { name, type, kind, hasCommands }: Series): Role | undefined {
  if (kind === 'commands') return 'odometry';
  return roleByName(name) ?? (hasCommands || /Odometry$/.test(type) ? 'odometry' : roleByName(file));
}

/** Returns true if a localizer, or a filter of the odometry, probably estimated the poses of a log, judging by the log's name or frames. */
export const isLocalizer = (name: string, frames?: FramePair): boolean => frames?.parent === 'map' || ((LOCALIZER_NAMES.test(name) || FILTER_NAMES.test(name)) && !MEASUREMENT_NAMES.test(name));

/** Returns the role that the name of a file shows; undefined if it shows none. */
export function roleByName(name: string): Role | undefined {
  if (MEASUREMENT_NAMES.test(name) || LOCALIZER_NAMES.test(name)) return 'reference';
  return ODOMETRY_FILE_NAMES.test(name) ? 'odometry' : undefined;
}

/** Returns the series with a name, or the series whose name differs only in separators and capitals. */
function findSeriesByName(series: Series[], wantedName: string): Series | undefined {
  const wordsOfName = (name: string) => name.toLowerCase().split(/[^\p{L}\p{N}]+/u).filter(Boolean).join('.');
  return series.find(({ name }) => name === wantedName) ?? series.find(({ name }) => wordsOfName(name) !== '' && wordsOfName(name) === wordsOfName(wantedName));
}

/** Returns the names of the series that could be the log of a role, the likeliest first. */
function seriesNamesFor(recording: Recording, role: Role): string[] {
  const usableSeries = readableSeriesOf(recording).filter(({ kind }) => role === 'odometry' || kind !== 'commands');
  return [...new Set([...findCandidates(recording, role).flat().map(({ series }) => series), ...usableSeries.map(({ name }) => name)])];
}

/** Returns the logs that could have a role, in tiers: groups of equal likelihood, the likeliest first. A tier of several logs is ambiguous. */
export function findCandidates(recording: Recording, role: Role, { kind }: { kind?: LogKind } = {}): LogChoice[][] {
  const isTableFile = recording.format === 'csv';
  const seriesWithoutGoals = readableSeriesOf(recording).filter(({ name }) => !GOAL_NAMES.test(name));
  const poseSeries = seriesWithoutGoals.filter((entry) => entry.kind === 'poses');
  const chainChoices = seriesWithoutGoals.flatMap(({ name, frames = [] }) => findLikeliestFrames(frames, role).map((pair) => ({ series: name, frames: pair })));
  if (role === 'reference') {
    const unfilteredPaths = poseSeries.filter(({ name }) => !FILTER_NAMES.test(name) && !ODOMETRY_NAMES[0].test(name));
    return [...choiceTiersByName(poseSeries, [MEASUREMENT_NAMES, LOCALIZER_NAMES], 'poses'), choicesOf(unfilteredPaths, 'poses'), ...(isTableFile && seriesWithoutGoals.length === 1 ? [choicesOf(poseSeries, 'poses')] : []), chainChoices];
  }
  // A topic of the message type Odometry probably contains wheel odometry.
  const wheelPaths = poseSeries.filter(({ name, type }) => !MEASUREMENT_NAMES.test(name) && !LOCALIZER_NAMES.test(name) && (isTableFile || /Odometry$/.test(type)));
  const poseTiers = [...choiceTiersByName(wheelPaths, ODOMETRY_NAMES), choicesOf(wheelPaths), chainChoices];
  const commandSeries = seriesWithoutGoals.filter((entry) => entry.kind === 'commands' || entry.hasCommands);
  const commandTiers = [...choiceTiersByName(commandSeries, COMMAND_NAMES, 'commands'), choicesOf(commandSeries, 'commands')];
  return kind === 'commands' ? [...commandTiers, ...poseTiers] : isTableFile ? [...poseTiers, ...commandTiers] : poseTiers;
}

const choicesOf = (series: Series[], kind?: LogKind): LogChoice[] => series.map(({ name }) => ({ series: name, ...(kind && { kind }) }));

const choiceTiersByName = (series: Series[], names: RegExp[], kind?: LogKind): LogChoice[][] => names.map((pattern) => choicesOf(series.filter(({ name }) => pattern.test(name)), kind));

/** Returns the likeliest pairs of frames for a role, by the names of the frames. */
function findLikeliestFrames(frames: FramePair[], role: Role): FramePair[] {
  const findFirstMatchingFrames = (framePairs: FramePair[], names: RegExp[], end: keyof FramePair) => names.map((name) => framePairs.filter((pair) => name.test(pair[end]))).find(({ length }) => length);
  const pairsWithFixedParent = findFirstMatchingFrames(frames, FIXED_FRAME_NAMES[role], 'parent') ?? [];
  return findFirstMatchingFrames(pairsWithFixedParent, BASE_FRAME_NAMES, 'child') ?? pairsWithFixedParent;
}
