/** Calibration result as text and as JSON. */

import { english } from '../logs/en.ts';
import { LOG_ROLES, type LogSummary } from '../logs/log.ts';
import { warningsOf } from '../logs/pairs.ts';
import { en as sharedTexts } from '../messages/en.ts';
import { MINUS_SIGN } from '../ui/format.ts';
import { en } from '../widgets/alpha-calibrator/en.ts';
import { LOST_LEG_CAUSES, describeLegLength, explainRecommendation, formatJson, formatNav2Yaml, isNav2Rule, judgementOf, type CalibrationResult } from '../widgets/alpha-calibrator/result.ts';
import { alphaTableOf, checkTableOf, noiseTableOf, systematicTableOf, windowTableOf, type ResultTable } from '../widgets/alpha-calibrator/tables.ts';
import type { Calibration } from '../types.d.ts';

/** Log that was read, with its summary as numbers and as sentences. */
interface ReadLog { name: string; summary: LogSummary; sentences: string[] }

export interface CalibrationReport {
  calibration: Calibration;
  /** Command that remedies a failed check; empty if there is none. */
  command: string;
  options: Record<string, any>;
  /** Logs of the drives in turn: odometry and reference of the first drive, then those of the next. */
  logs: ReadLog[];
  /** Whole seconds that were subtracted from all times of the logs. */
  start: number;
  /** Times of the odometry's first row in each drive. */
  driveStarts: number[];
  date: string;
}

const resultOf = ({ calibration, options: { model: modelName = 'odometry', rule: ruleName = 'thrun', legs, correct: corrections = {} }, logs: reportedLogs }: CalibrationReport): CalibrationResult => ({
  stats: calibration, legCount: calibration.legs.count, model: modelName, rule: ruleName, legLength: legs, corrections,
  logName: new Intl.ListFormat('en').format(new Set(reportedLogs.map(({ name: logName }) => logName))), warnings: warningsOf(reportedLogs.map(({ summary }) => summary)),
});

/** Labels and texts of the report's tables. */
const REPORT_WORDS = { alphas: sharedTexts.alphas, calibrator: en };

const MAX_LISTED_OUTLIERS = 5;

/** Returns the summaries of the logs (odometry and reference of each drive), without the result of the fit. */
export const formatLogSummaries = (reportedLogs: ReadLog[]): string =>
  reportedLogs.map(({ name: logName, sentences: summarySentences }, i) => `${[`${english.logChoiceTexts.roleNames[LOG_ROLES[i % 2]]}: ${logName}`, ...summarySentences].join('\n  ')}\n`).join('');

/** Codes of colours in a terminal. */
const [RED_CODE, GREEN_CODE, YELLOW_CODE] = [31, 32, 33];

/** Colours of the verdict's badge, by the rating of the α's. */
const RATING_COLORS = { consistent: GREEN_CODE, questionable: YELLOW_CODE, unusable: RED_CODE };

const colorizeText = (colorCode: number) => (plainText: string) => `\x1b[${colorCode}m${plainText}\x1b[0m`;

/** Returns the text report, which follows the summaries of the logs. */
export function formatReport(calibrationReport: CalibrationReport, isColored = false): string {
  const { calibration, driveStarts } = calibrationReport;
  const { legs, lost: lostLegs, recommended: recommendation } = calibration;
  const { model: modelName, rule: ruleName, legLength } = resultOf(calibrationReport);
  const { yaml, notes: yamlNotes } = formatYamlWithNotes(calibrationReport);
  const lostLegTexts = LOST_LEG_CAUSES.filter((lossCause) => lostLegs[lossCause] > 0).map((lossCause) => `${lostLegs[lossCause]} ${en.lostLegs[lossCause]}`);
  const excludedLegLines = [...(lostLegTexts.length ? [`lost legs: ${lostLegTexts.join(', ')}`] : []), ...formatOutliers(legs, driveStarts)];
  const uncoloredReport = [
    '',
    ...formatVerdict(calibrationReport),
    '',
    `${legs.count} legs ${describeLegLength(legLength)}; model ${modelName}${modelName === 'odometry' ? `, rule ${ruleName}` : ''}`,
    '',
    ...formatTable(alphaTableOf(calibration, modelName, REPORT_WORDS)),
    ...(recommendation ? [explainRecommendation(calibration, en)] : []),
    '',
    ...formatTable(systematicTableOf(calibration, REPORT_WORDS)),
    '',
    ...formatTable(noiseTableOf(calibration, REPORT_WORDS)),
    '',
    ...formatChecks(calibration),
    '',
    ...(excludedLegLines.length ? [...excludedLegLines, ''] : []),
    `${en.windowTable.title}: ${en.windowTable.caption}`,
    ...formatTable(windowTableOf(calibration, REPORT_WORDS)),
    '',
    ...yamlNotes,
    ...(yaml ? ['# nav2_params.yaml', yaml.trimEnd()] : []),
    '',
  ].join('\n');
  if (!isColored) return uncoloredReport;
  const { rating: logRating, badge: ratingBadge } = judgeReport(calibrationReport);
  return uncoloredReport.replace(ratingBadge, colorizeText(RATING_COLORS[logRating])).replaceAll(/✓ \w+/g, colorizeText(GREEN_CODE)).replaceAll(/✕ \w+/g, colorizeText(RED_CODE));
}

const judgeReport = (calibrationReport: CalibrationReport) => judgementOf(resultOf(calibrationReport), en, '--no-correct');

/** Returns the verdict as on the page, and the advice, with one sentence per line. */
export function formatVerdict(calibrationReport: CalibrationReport): string[] {
  const { badge: ratingBadge, finding: logFinding, advice } = judgeReport(calibrationReport);
  return [`${ratingBadge}. ${logFinding}`, ...advice, ...(calibrationReport.command ? [`  ${calibrationReport.command}`] : [])];
}

/** Returns the lines of a table, as plain text: with minus signs that can be copied, and several values of a cell in one line. */
function formatTable({ columnHeadings, rows: tableRows }: ResultTable): string[] {
  const toPlainText = (plainText: string) => plainText.replaceAll('*', '').replaceAll(MINUS_SIGN, '-').replaceAll('\u202f', ' ').replaceAll('\n', ', ');
  return alignRows([columnHeadings, ...tableRows].map((rowCells) => rowCells.map(toPlainText)));
}

/** Returns the table of the checks, and the message of each failed check. Checks have the same names as in JSON and in documents. */
function formatChecks(calibration: Calibration): string[] {
  const { checks: checkResults } = calibration.diagnostics;
  const { columnHeadings, rows: tableRows } = checkTableOf(calibration, REPORT_WORDS);
  const namedRows = tableRows.map(([checkDescription, ...rowCells], i) => [checkResults[i].name, ...rowCells, checkDescription]);
  return [...formatTable({ columnHeadings: [...columnHeadings, ''], rows: namedRows }), ...checkResults.filter(({ passed: hasPassed }) => !hasPassed).map(({ name: checkName, message: failureMessage }) => `${checkName}: ${failureMessage}`)];
}

/** Lists outliers by their times, in seconds after the start of the odometry. */
function formatOutliers({ count: legCount, times: legTimes, outliers: outlierFlags }: Calibration['legs'], driveStarts: number[]): string[] {
  const outlierLegs = Array.from({ length: legCount }, (_, legIndex) => legIndex).filter((legIndex) => outlierFlags[legIndex] === 1);
  const timeTexts = outlierLegs.slice(0, MAX_LISTED_OUTLIERS).map((legIndex) => {
    const driveStart = Math.max(...driveStarts.filter((startTime) => startTime <= legTimes[2 * legIndex]));
    return `${(legTimes[2 * legIndex] - driveStart).toFixed(2)} s${driveStarts.length > 1 ? ` of drive ${driveStarts.indexOf(driveStart) + 1}` : ''}`;
  }).join(', ');
  return outlierLegs.length ? [`outliers: ${outlierLegs.length} of ${legCount} legs, at ${timeTexts}${outlierLegs.length > MAX_LISTED_OUTLIERS ? ', …' : ''} after the start`] : [];
}

/** Returns the lines for nav2_params.yaml. The notes say why there are no lines, or that the fit used another noise rule than Nav2's AMCL. */
export function formatYamlWithNotes(calibrationReport: CalibrationReport): { yaml: string; notes: string[] } {
  const calibrationResult = resultOf(calibrationReport);
  const yaml = formatNav2Yaml(calibrationResult, calibrationReport.date);
  if (!yaml) return { yaml, notes: [`No lines for nav2_params.yaml: ${calibrationResult.stats.recommended ? 'Nav2 has no velocity model' : 'the log is unusable'}.`] };
  return { yaml, notes: isNav2Rule(calibrationResult.model, calibrationResult.rule) ? [] : ['Warning: fitted by another rule than Nav2’s; give --rule nav2.'] };
}

export function alignRows(tableRows: string[][]): string[] {
  // The last cell of a row does not count for the width of its column, because nothing follows it.
  const columnWidths = tableRows[0].map((_, columnIndex) => Math.max(...tableRows.map((rowCells) => (columnIndex < rowCells.length - 1 ? rowCells[columnIndex].length : 0))));
  return tableRows.map((rowCells) => rowCells.map((cell, columnIndex) => cell.padEnd(columnWidths[columnIndex])).join('  ').trimEnd());
}

export const formatReportJson = ({ calibration, options, logs, start, date }: CalibrationReport): string => `${formatJson({ date, options, logs, start, ...calibration })}\n`;
