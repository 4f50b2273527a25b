/** Search for the odometry and the reference of each drive in recordings. */

import { sort } from 'd3-array';
import { LogError, listNames, readableSeriesOf, LOG_ROLES, formatFramesOption, formatFrames, type LogChoice, type FramePair, type LogKind, type Recording, type LogRole, type Series } from './log.ts';

/** Recording, with the choice of the log to read for each role. A recording with only one log is paired with another recording after both have been read. */
export interface PlannedRecording { recording: Recording; logChoices: Partial<Record<LogRole, LogChoice>> }

/** Choices of the user. The program guesses the choices that are missing. */
export interface UserChoices {
  /** `seriesName` is the name of a series. For a table, that is the common prefix of its columns without the separator at the end. `framePair` selects a pair of frames among transforms. */
  odometry?: { seriesName?: string; framePair?: FramePair };
  reference?: { seriesName?: string; framePair?: FramePair };
  /** Kind of odometry: `commands` prefers commands to poses, and `poses` excludes commands. By default poses come first. */
  logKind?: LogKind;
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

const describeSeries = (seriesList: Series[]) => listNames(seriesList.map(({ seriesName, messageType }) => (seriesName ? `${seriesName} (${messageType.replace(/^\w+\/(msg\/)?(?=\w+( as |$))/, '')})` : messageType)));

const isSameChoice = (logChoice: LogChoice, otherChoice?: LogChoice) => logChoice.seriesName === otherChoice?.seriesName && logChoice.framePair?.parent === otherChoice.framePair?.parent && logChoice.framePair?.child === otherChoice.framePair?.child;

/**
 * Chooses which logs of the recordings are read. Recordings with odometry come first. Throws a LogError, which has a question if the choice is ambiguous. Calls `onSkip` with the
 * error of each recording that is left out, because none of its series can be read.
 */
export function planDrives(allRecordings: Recording[], userChoices: UserChoices = {}, onSkip?: (error: LogError) => void): PlannedRecording[] {
  const usableRecordings = allRecordings.filter((recording) => recording.logRole || readableSeriesOf(recording).length > 0);
  const usedRecordings = usableRecordings.length > 0 ? usableRecordings : allRecordings;
  for (const recording of allRecordings) if (!usedRecordings.includes(recording)) onSkip?.(createUnusableError(recording));
  const guessedRoles = usedRecordings.map((recording) => recording.logRole ?? (usedRecordings.length > 1 ? roleOfRecording(recording, userChoices) : 'both'));
  const isHalfInRole = (logRole: LogRole) => 2 * guessedRoles.filter((otherRole) => otherRole === logRole).length >= usedRecordings.length;
  const drivePlan = usedRecordings.map((recording, i): PlannedRecording => {
    // If at least half of the recordings have the same role, a recording of unknown role gets the other role.
    const logRole = guessedRoles[i] ?? (isHalfInRole('odometry') ? 'reference' : isHalfInRole('reference') ? 'odometry' : undefined);
    if (!logRole) throw new LogError({ fileName: recording.recordingName }, (errorReasons) => errorReasons.unknownRoleReason, { optionName: 'roles', possibleAnswers: [] });
    return { recording, logChoices: logRole === 'both' ? chooseBothLogs(recording, userChoices) : { [logRole]: chooseLog(recording, logRole, userChoices) } };
  });
  const recordingsWithRole = (logRole: LogRole) => drivePlan.filter(({ logChoices }) => logChoices[logRole]);
  // If there are separate files for one role, the logs of that role in recordings with odometry and reference are not used.
  const [rarerRole, replacedRole] = recordingsWithRole('odometry').length < recordingsWithRole('reference').length ? LOG_ROLES : LOG_ROLES.toReversed();
  const completeRecordings = drivePlan.filter(({ logChoices }) => logChoices.odometry && logChoices.reference);
  if (completeRecordings.length === recordingsWithRole(replacedRole).length - recordingsWithRole(rarerRole).length) for (const { logChoices } of completeRecordings) delete logChoices[replacedRole];
  const [odometryRecordings, referenceRecordings] = LOG_ROLES.map((logRole) => recordingsWithRole(logRole).map(({ recording }) => recording));
  if (odometryRecordings.length !== referenceRecordings.length) {
    const unpairedRecordings = odometryRecordings.length > referenceRecordings.length ? odometryRecordings : referenceRecordings;
    // If a recording has several candidates for the missing log, this call throws a LogError that asks which one to read. Such a question helps more than
    // the error that is thrown below.
    for (const recording of unpairedRecordings) tryUnlessLogError(() => chooseBothLogs(recording, userChoices), ({ userQuestion }) => userQuestion?.optionName !== 'series');
    const [odometryNames, referenceNames] = [odometryRecordings, referenceRecordings].map((recordingsOfRole) => listNames(recordingsOfRole.map(({ recordingName }) => recordingName)));
    throw new LogError({ fileName: unpairedRecordings[0].recordingName }, (errorReasons) => errorReasons.unpairedLogsReason(odometryNames, referenceNames), { optionName: usedRecordings.length === 1 ? 'other' : 'roles', logRole: odometryNames ? 'odometry' : 'reference', possibleAnswers: [] });
  }
  return sort(drivePlan, ({ logChoices }) => Number(!logChoices.odometry));
}

/** Returns the role of one of several recordings: "both" if it has odometry and reference, and undefined if neither its name nor its contents show a role. */
function roleOfRecording(recording: Recording, userChoices: UserChoices): LogRole | 'both' | undefined {
  if (tryUnlessLogError(() => chooseBothLogs(recording, userChoices))) return 'both';
  const [isOdometry, isReference] = LOG_ROLES.map((logRole) => tryUnlessLogError(() => chooseLog(recording, logRole, userChoices)) !== undefined);
  if (isOdometry !== isReference) return isOdometry ? 'odometry' : 'reference';
  // A file with several rigid bodies has candidates for both roles, and therefore logs, although it is unclear which candidate to read.
  const hasLogs = isOdometry || LOG_ROLES.every((logRole) => findCandidates(recording, logRole, userChoices).some(({ length }) => length > 0));
  if (!hasLogs) return 'both';
  return guessRoleFromName(recording.recordingName) ?? (recording.seriesList.some(({ hasCommands }) => hasCommands) ? 'odometry' : undefined);
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

function chooseBothLogs(recording: Recording, userChoices: UserChoices): Record<LogRole, LogChoice> {
  // The reference that the user chose is excluded from the guess of the odometry.
  const { seriesName, framePair } = userChoices.reference ?? {};
  const chosenReference = seriesName !== undefined || framePair ? chooseLog(recording, 'reference', userChoices) : undefined;
  const odometryChoice = tryUnlessLogError(() => chooseLog(recording, 'odometry', userChoices, chosenReference)) ?? chooseLog(recording, 'odometry', userChoices);
  const referenceChoice = chosenReference ?? chooseLog(recording, 'reference', userChoices, odometryChoice);
  if (isSameChoice(odometryChoice, referenceChoice)) {
    const userQuestion = { optionName: 'series' as const, logRole: 'reference' as const, possibleAnswers: listSeriesNamesFor(recording, 'reference').filter((seriesName) => seriesName !== referenceChoice.seriesName) };
    throw new LogError({ fileName: recording.recordingName, topicName: referenceChoice.seriesName }, (errorReasons) => errorReasons.sameLogReason(referenceChoice.framePair ? formatFrames(referenceChoice.framePair) : referenceChoice.seriesName), userQuestion);
  }
  return { odometry: odometryChoice, reference: referenceChoice };
}

/** Returns the likeliest candidates for a role among those for which `isPossible` returns true. */
const findLikeliestChoices = (recording: Recording, logRole: LogRole, userChoices: UserChoices, isPossible: (logChoice: LogChoice) => boolean) =>
  findCandidates(recording, logRole, userChoices).map((choiceTier) => choiceTier.filter(isPossible)).find(({ length }) => length) ?? [];

/** Returns the choice of a log for a role. It is another log than `otherRoleChoice`, the choice for the other role. */
function chooseLog(recording: Recording, logRole: LogRole, userChoices: UserChoices, otherRoleChoice?: LogChoice): LogChoice {
  const { seriesName, framePair } = userChoices[logRole] ?? {};
  if (seriesName === undefined && !framePair) return guessChoice(recording, logRole, userChoices, otherRoleChoice);
  const logKind = logRole === 'reference' ? 'poses' : userChoices.logKind;
  const chosenSeries = seriesName === undefined
    ? recording.seriesList.find((seriesEntry) => seriesEntry.framePairs)
    : findSeriesByName(recording.seriesList, seriesName);
  if (!chosenSeries) {
    const seriesNames = listSeriesNamesFor(recording, logRole);
    throw new LogError(
      { fileName: recording.recordingName, topicName: seriesName },
      (errorReasons) => errorReasons.unknownTopicReason(describeSeries(readableSeriesOf(recording))),
      { optionName: 'series', logRole, possibleAnswers: seriesNames },
    );
  }
  if (chosenSeries.seriesKind !== 'transforms' || framePair) return { seriesName: chosenSeries.seriesName, ...(logKind && { logKind }), ...(framePair && { framePair }) };
  const frameChoices = findLikeliestChoices(recording, logRole, userChoices, (logChoice) => logChoice.seriesName === chosenSeries.seriesName);
  if (frameChoices.length === 1) return frameChoices[0];
  throw createFramesError(recording, chosenSeries, logRole);
}

function createFramesError({ recordingName }: Recording, { seriesName, framePairs = [] }: Series, logRole: LogRole): LogError {
  const frameTexts = [...new Set([...findLikeliestFrames(framePairs, logRole), ...framePairs])].map(formatFramesOption);
  return new LogError({ fileName: recordingName, topicName: seriesName }, (errorReasons) => errorReasons.missingFramesReason(listNames(framePairs.map(formatFrames))), { optionName: 'frames', logRole, possibleAnswers: frameTexts });
}

function guessChoice(recording: Recording, logRole: LogRole, userChoices: UserChoices, otherRoleChoice?: LogChoice): LogChoice {
  const bestChoices = findLikeliestChoices(recording, logRole, userChoices, (logChoice) => !isSameChoice(logChoice, otherRoleChoice));
  // Among equally likely choices, logs with the same robot frame as the other log are preferred.
  const choicesOfSameRobot = bestChoices.filter(({ framePair }) => framePair && framePair.child === otherRoleChoice?.framePair?.child);
  if (choicesOfSameRobot.length === 1) return choicesOfSameRobot[0];
  if (bestChoices.length === 1) return bestChoices[0];
  const recordingName = recording.recordingName;
  const usableSeries = readableSeriesOf(recording);
  if (usableSeries.length === 0) throw createUnusableError(recording);
  const transformSeries = usableSeries.filter(({ seriesKind }) => seriesKind === 'transforms');
  const hasOnlyOtherChoice = otherRoleChoice && transformSeries.every(({ seriesName, framePairs = [] }) => framePairs.every((framePair) => isSameChoice({ seriesName, framePair }, otherRoleChoice)));
  if (transformSeries.length === usableSeries.length && !hasOnlyOtherChoice) throw createFramesError(recording, transformSeries.find((seriesEntry) => seriesEntry.framePairs) ?? transformSeries[0], logRole);
  const positionSeries = usableSeries.filter(({ seriesName, seriesKind }) => seriesKind === 'positions' && !GOAL_NAMES.test(seriesName));
  if (positionSeries.length === usableSeries.length || (logRole === 'reference' && bestChoices.length === 0 && positionSeries.length > 0)) {
    throw new LogError({ fileName: recordingName }, (errorReasons) => errorReasons.noHeadingReason(describeSeries(positionSeries)));
  }
  if (usableSeries.length === 1) {
    const ownRole = roleOfSeries(recording, usableSeries[0]) ?? (otherRoleChoice?.framePair && LOG_ROLES.find((otherRole) => otherRole !== logRole));
    throw new LogError({ fileName: recordingName }, (errorReasons) => errorReasons.singleLogReason(describeSeries(usableSeries), ownRole), { optionName: 'other', logRole: ownRole, possibleAnswers: [] });
  }
  throw new LogError(
    { fileName: recordingName },
    (errorReasons) => (bestChoices.length > 0 ? errorReasons.ambiguousRoleReason : errorReasons.missingRoleReason)(logRole, describeSeries(usableSeries)),
    { optionName: 'series', logRole, possibleAnswers: bestChoices.length > 0 ? listSeriesNamesFor(recording, logRole).filter((seriesName) => seriesName !== otherRoleChoice?.seriesName) : usableSeries.filter(({ seriesKind }) => logRole === 'odometry' && seriesKind === 'commands').map(({ seriesName }) => seriesName) },
  );
}

function createUnusableError({ recordingName, seriesList }: Recording): LogError {
  const shortSeries = seriesList.find(({ seriesKind }) => seriesKind !== null);
  return new LogError({ fileName: recordingName, topicName: shortSeries?.seriesName }, (errorReasons) => (shortSeries ? errorReasons.fewRowsReason(shortSeries.messageCount, shortSeries.messageCount) : errorReasons.noLogTopicsReason(describeSeries(seriesList))));
}

/** Returns the role of the only series in a recording, from the name of the series, its contents or the name of the file; undefined if none of these shows a role. */
function roleOfSeries({ recordingName }: Recording, { seriesName, messageType, seriesKind, hasCommands }: Series): LogRole | undefined {
  if (seriesKind === 'commands') return 'odometry';
  return guessRoleFromName(seriesName) ?? (hasCommands || /Odometry$/.test(messageType) ? 'odometry' : guessRoleFromName(recordingName));
}

/** Returns true if a localizer, or a filter of the odometry, probably estimated the poses of a log, judging by the log's name or frames. */
export const isLocalizer = (seriesName: string, framePair?: FramePair): boolean => framePair?.parent === 'map' || ((LOCALIZER_NAMES.test(seriesName) || FILTER_NAMES.test(seriesName)) && !MEASUREMENT_NAMES.test(seriesName));

/** Returns the role that the name of a file shows; undefined if it shows none. */
export function guessRoleFromName(logName: string): LogRole | undefined {
  if (MEASUREMENT_NAMES.test(logName) || LOCALIZER_NAMES.test(logName)) return 'reference';
  return ODOMETRY_FILE_NAMES.test(logName) ? 'odometry' : undefined;
}

/** Returns the series with a name, or the series whose name differs only in separators and capitals. */
function findSeriesByName(seriesList: Series[], wantedSeriesName: string): Series | undefined {
  const wordsOfName = (seriesName: string) => seriesName.toLowerCase().split(/[^\p{L}\p{N}]+/u).filter(Boolean).join('.');
  return seriesList.find(({ seriesName }) => seriesName === wantedSeriesName) ?? seriesList.find(({ seriesName }) => wordsOfName(seriesName) !== '' && wordsOfName(seriesName) === wordsOfName(wantedSeriesName));
}

/** Returns the names of the series that could be the log of a role, the likeliest first. */
function listSeriesNamesFor(recording: Recording, logRole: LogRole): string[] {
  const usableSeries = readableSeriesOf(recording).filter(({ seriesKind }) => logRole === 'odometry' || seriesKind !== 'commands');
  return [...new Set([...findCandidates(recording, logRole).flat().map(({ seriesName }) => seriesName), ...usableSeries.map(({ seriesName }) => seriesName)])];
}

/** Returns the logs that could have a role, in tiers: groups of equal likelihood, the likeliest first. A tier of several logs is ambiguous. */
export function findCandidates(recording: Recording, logRole: LogRole, { logKind }: { logKind?: LogKind } = {}): LogChoice[][] {
  const isTableFile = recording.recordingFormat === 'csv';
  const seriesWithoutGoals = readableSeriesOf(recording).filter(({ seriesName }) => !GOAL_NAMES.test(seriesName));
  const poseSeries = seriesWithoutGoals.filter((seriesEntry) => seriesEntry.seriesKind === 'poses');
  const chainChoices = seriesWithoutGoals.flatMap(({ seriesName, framePairs = [] }) => findLikeliestFrames(framePairs, logRole).map((framePair) => ({ seriesName, framePair })));
  if (logRole === 'reference') {
    const unfilteredPaths = poseSeries.filter(({ seriesName }) => !FILTER_NAMES.test(seriesName) && !ODOMETRY_NAMES[0].test(seriesName));
    return [...rankChoicesByName(poseSeries, [MEASUREMENT_NAMES, LOCALIZER_NAMES], 'poses'), choicesOf(unfilteredPaths, 'poses'), ...(isTableFile && seriesWithoutGoals.length === 1 ? [choicesOf(poseSeries, 'poses')] : []), chainChoices];
  }
  // A topic of the message type Odometry probably contains wheel odometry.
  const wheelPaths = poseSeries.filter(({ seriesName, messageType }) => !MEASUREMENT_NAMES.test(seriesName) && !LOCALIZER_NAMES.test(seriesName) && (isTableFile || /Odometry$/.test(messageType)));
  const poseTiers = [...rankChoicesByName(wheelPaths, ODOMETRY_NAMES), choicesOf(wheelPaths), chainChoices];
  const commandSeries = seriesWithoutGoals.filter((seriesEntry) => seriesEntry.seriesKind === 'commands' || seriesEntry.hasCommands);
  const commandTiers = [...rankChoicesByName(commandSeries, COMMAND_NAMES, 'commands'), choicesOf(commandSeries, 'commands')];
  return logKind === 'commands' ? [...commandTiers, ...poseTiers] : isTableFile ? [...poseTiers, ...commandTiers] : poseTiers;
}

const choicesOf = (seriesList: Series[], logKind?: LogKind): LogChoice[] => seriesList.map(({ seriesName }) => ({ seriesName, ...(logKind && { logKind }) }));

const rankChoicesByName = (seriesList: Series[], namePatterns: RegExp[], logKind?: LogKind): LogChoice[][] => namePatterns.map((namePattern) => choicesOf(seriesList.filter(({ seriesName }) => namePattern.test(seriesName)), logKind));

/** Returns the likeliest pairs of frames for a role, by the names of the frames. */
function findLikeliestFrames(framePairs: FramePair[], logRole: LogRole): FramePair[] {
  const findFirstMatchingFrames = (framePairs: FramePair[], namePatterns: RegExp[], frameEnd: keyof FramePair) => namePatterns.map((namePattern) => framePairs.filter((framePair) => namePattern.test(framePair[frameEnd]))).find(({ length }) => length);
  const pairsWithFixedParent = findFirstMatchingFrames(framePairs, FIXED_FRAME_NAMES[logRole], 'parent') ?? [];
  return findFirstMatchingFrames(pairsWithFixedParent, BASE_FRAME_NAMES, 'child') ?? pairsWithFixedParent;
}
