/** Reads the odometry and reference of each drive, and checks that the two logs of a drive belong together. */

import { min, zip } from 'd3-array';
import type { CalibrationLog } from '../types.d.ts';
import { isLocalizer, guessRoleFromName, type PlannedRecording } from './drives.ts';
import { LogError, LOG_ROLES, UNIT_NAMES, formatFrames, type Log, type LogChoice, type LogNote, type Poses, type LogRole, type LogSummary, type LogWarning } from './log.ts';
import { pathOf, poseAt, wrapAngle, type TimedPath } from './path.ts';
import { METRES_PER_UNIT, logSpeedOf } from './units.ts';

/** Two logs of one drive. The times of both logs count from the same start. */
export interface LoggedDrive { odometry: Log; reference: Log }

/** Minimum overlap in time of odometry and reference, as a fraction of the shorter log's duration. */
const MIN_OVERLAP = 0.5;

/** Duration (s) at both ends of a frozen pose (equal poses in succession) in which the odometry may move. The two clocks may differ by this much. */
const END_MARGIN_SECONDS = 1;

/** Minimum motion of the odometry, in metres plus radians, that shows that a constant reference pose is frozen. Encoders of a robot at rest may still count a pulse or two. */
const MIN_ODOMETRY_MOTION = 0.05;

/** Minimum speed (m/s) at which the speeds of two logs are compared: the 90 % quantile of a log. In a log of a robot that mostly stands, this quantile measures only noise. */
const MIN_COMPARED_SPEED = 0.02;

/** Maximum factor between a ratio of two speeds and a ratio of two units. It allows for wheels of another size than the odometry assumes. */
const MAX_UNIT_ERROR = 1.2;

const timeSpanOf = ({ startTime, motionData: { t } }: Log): [number, number] => [startTime + t[0], startTime + t[t.length - 1]];

const formatTimeSpan = (log: Log) => timeSpanOf(log).map((sampleTime) => `${sampleTime.toFixed(2)} s`).join(' to ');

/** Returns the duration of the overlap of two logs; negative if there is a gap between them. */
function overlapSecondsOf(firstLog: Log, secondLog: Log): number {
  const [[a, b], [c, d]] = [timeSpanOf(firstLog), timeSpanOf(secondLog)];
  return Math.min(b, d) - Math.max(a, c);
}

/** Pairs odometry and reference logs of several drives. If each odometry overlaps exactly one reference in time, these two are a pair. Otherwise logs are paired in their order. */
function matchLogs(odometryLogs: Log[], referenceLogs: Log[]): Log[][] {
  const partnersOfEach = odometryLogs.map((odometryLog) => referenceLogs.filter((referenceLog) =>
    overlapSecondsOf(odometryLog, referenceLog) > MIN_OVERLAP * Math.min(odometryLog.logSummary.seconds, referenceLog.logSummary.seconds)));
  const hasUniquePartners = partnersOfEach.every(({ length }) => length === 1) && new Set(partnersOfEach.flat()).size === referenceLogs.length;
  return odometryLogs.map((odometryLog, i) => [odometryLog, hasUniquePartners ? partnersOfEach[i][0] : referenceLogs[i]]);
}

/** Pairs the odometry and reference of one drive, whose times count from the same start. Throws a LogError if the logs do not fit together, or one may have another unit of length. */
export function pairLogs(odometryLog: Log, referenceLog: Log): LoggedDrive {
  const referencePlace = { fileName: referenceLog.logName };
  if (referenceLog.logKind === 'commands') throw new LogError(referencePlace, (errorReasons) => errorReasons.missingColumnsReason('poses', 't, v, omega'));
  const { frames: framePair } = referenceLog.logSummary;
  if (framePair?.parent === 'odom') throw new LogError(referencePlace, (errorReasons) => errorReasons.sameLogReason(formatFrames(framePair)));
  const odometryPath = pathOf(odometryLog.motionData);
  const [firstPose] = odometryPath.poses;
  if (odometryPath.poses.every((pose) => pose.every((coordinate, i) => coordinate === firstPose[i]))) throw new LogError({ fileName: odometryLog.logName }, (errorReasons) => errorReasons.stillOdometryReason);
  const brokenReference = breakFrozenPoses(referenceLog, odometryPath);
  if (brokenReference.logSummary.used < 2) throw new LogError(referencePlace, (errorReasons) => errorReasons.frozenReferenceReason);
  const matchedLogs = { odometry: odometryLog, reference: brokenReference };
  checkLengthUnits(matchedLogs);
  const logNotes: LogNote[] = [
    ...brokenReference.logSummary.notes,
    ...(guessRoleFromName(odometryLog.logName) !== 'odometry' && guessRoleFromName(referenceLog.logName) === 'odometry' ? [{ name: 'swappedRoles' as const, values: [odometryLog.logName] }] : []),
    ...(isLocalizer(referenceLog.logName, framePair) ? [{ name: 'localizer' as const, values: [] }] : []),
    ...(overlapSecondsOf(odometryLog, referenceLog) < 0 ? [{ name: 'apart' as const, values: [odometryLog.logName, formatTimeSpan(referenceLog), formatTimeSpan(odometryLog)] }] : []),
  ];
  return { ...matchedLogs, reference: { ...brokenReference, logSummary: { ...brokenReference.logSummary, notes: logNotes } } };
}

/** Returns the reference with a break at each pose that is repeated although the odometry moves: motion capture has probably lost the robot. */
function breakFrozenPoses(referenceLog: Log, odometryPath: TimedPath): Log {
  const { motionData: poseData, logSummary } = referenceLog;
  const { t, x, y, theta } = poseData as Poses;
  const breakRows = new Set(poseData.breaks);
  let frozenCount = 0;
  for (let runStart = 0, runEnd; runStart < t.length; runStart = runEnd) {
    for (runEnd = runStart + 1; runEnd < t.length && x[runEnd] === x[runStart] && y[runEnd] === y[runStart] && theta[runEnd] === theta[runStart]; ) runEnd += 1;
    const [runStartTime, runEndTime] = [t[runStart] + END_MARGIN_SECONDS, t[runEnd - 1] - END_MARGIN_SECONDS];
    if (!(runEndTime > runStartTime)) continue;
    const [[startX, startY, startHeading], [endX, endY, endHeading]] = [poseAt(odometryPath, runStartTime), poseAt(odometryPath, runEndTime)];
    if (Math.hypot(endX - startX, endY - startY) + Math.abs(wrapAngle(endHeading - startHeading)) <= MIN_ODOMETRY_MOTION) continue;
    frozenCount += runEnd - runStart - 1;
    for (let rowIndex = runStart + 1; rowIndex <= Math.min(runEnd, t.length - 1); rowIndex++) breakRows.add(rowIndex);
  }
  if (frozenCount === 0) return referenceLog;
  const droppedRows = { ...logSummary.dropped, held: { count: frozenCount, first: 0 } };
  return { ...referenceLog, motionData: { ...poseData, breaks: Uint32Array.from(breakRows).sort() }, logSummary: { ...logSummary, used: logSummary.used - frozenCount, dropped: droppedRows } };
}

export const warningsOf = (logSummaries: LogSummary[]): LogWarning[] =>
  (['localizer', 'swappedRoles'] as const).filter((logWarning) => logSummaries.some(({ notes }) => notes.some(({ name: noteName }) => noteName === logWarning)));

/** Returns the logs of drives in the form that the core takes: one log of each role, or an array for several drives. */
export function calibrationLogOf(loggedDrives: LoggedDrive[]): Pick<CalibrationLog, LogRole> {
  const odometryData = loggedDrives.map((loggedDrive) => loggedDrive.odometry.motionData);
  const referenceData = loggedDrives.map((loggedDrive) => loggedDrive.reference.motionData as Poses);
  return loggedDrives.length === 1 ? { odometry: odometryData[0], reference: referenceData[0] } : { odometry: odometryData, reference: referenceData };
}

/** Reads the logs of planned recordings, and pairs them. All times count from the same start. Rejects with a LogError. */
export async function readDrives(drivePlan: PlannedRecording[], onProgress?: (progressFraction: number) => void): Promise<LoggedDrive[]> {
  const plannedLogs: { log: Log; logRole: LogRole; isPaired: boolean }[] = [];
  for (const [i, { recording, logChoices }] of drivePlan.entries()) {
    const logRoles = LOG_ROLES.filter((logRole) => logChoices[logRole]);
    const logsOfRecording = await recording.readLogs(logRoles.map((logRole) => logChoices[logRole] as LogChoice), (progressFraction) => onProgress?.((i + progressFraction) / drivePlan.length));
    plannedLogs.push(...logsOfRecording.map((log, k) => ({ log, logRole: logRoles[k], isPaired: logRoles.length === 2 })));
  }
  const startTime = min(plannedLogs, ({ log }) => log.startTime) ?? 0;
  const logsOf = (isWantedPaired: boolean) => LOG_ROLES.map((wantedRole) => plannedLogs.filter(({ logRole, isPaired }) => logRole === wantedRole && isPaired === isWantedPaired).map(({ log }): Log =>
    ({ ...log, startTime, motionData: { ...log.motionData, t: log.motionData.t.map((sampleTime) => sampleTime + (log.startTime - startTime)) } })));
  const [[pairedOdometry, pairedReference], [unpairedOdometry, unpairedReference]] = [logsOf(true), logsOf(false)];
  const logPairs = [...zip(pairedOdometry, pairedReference), ...matchLogs(unpairedOdometry, unpairedReference)];
  return logPairs.map(([odometryLog, referenceLog]) => pairLogs(odometryLog, referenceLog));
}

/** Throws a LogError with a question if the ratio of two logs' speeds is that of two units of length, such as metres and feet. */
function checkLengthUnits(logsOfDrive: Record<LogRole, Log>): void {
  const [odometrySpeed, referenceSpeed] = LOG_ROLES.map((logRole) => logSpeedOf(logsOfDrive[logRole].motionData));
  if (Math.min(odometrySpeed, referenceSpeed) < MIN_COMPARED_SPEED) return;
  for (const [logRole, otherRole, speedRatio] of [['reference', 'odometry', referenceSpeed / odometrySpeed], ['odometry', 'reference', odometrySpeed / referenceSpeed]] as const) {
    const { unit: assumedUnit, by: unitBasis } = logsOfDrive[logRole].logSummary.units.length;
    const likelyUnit = UNIT_NAMES.lengthUnit.find((lengthUnit) => {
      const unitRatio = METRES_PER_UNIT[assumedUnit] / METRES_PER_UNIT[lengthUnit];
      return unitRatio > 1 && Math.max(speedRatio / unitRatio, unitRatio / speedRatio) < MAX_UNIT_ERROR;
    });
    if (!likelyUnit || unitBasis !== 'usage') continue;
    throw new LogError({ fileName: logsOfDrive[logRole].logName }, (errorReasons) => errorReasons.otherUnitReason(speedRatio, logsOfDrive[otherRole].logName, likelyUnit), { optionName: 'lengthUnit', possibleAnswers: [likelyUnit, assumedUnit] });
  }
}
