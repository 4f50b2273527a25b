/** Calibration result as text and as JSON. */

import { english } from '../logs/en.ts';
import { ROLES, type Summary } from '../logs/log.ts';
import { warningsOf } from '../logs/pairs.ts';
import { en as sharedTexts } from '../messages/en.ts';
import { MINUS } from '../ui/format.ts';
import { en } from '../widgets/alpha-calibrator/en.ts';
import { LOST_LEG_CAUSES, describeLegLength, explainRecommendation, formatJson, formatNav2Yaml, isNav2Rule, judgementOf, type Result } from '../widgets/alpha-calibrator/result.ts';
import { alphaTableOf, checkTableOf, noiseTableOf, systematicTableOf, windowTableOf, type ResultTable } from '../widgets/alpha-calibrator/tables.ts';
import type { Calibration } from '../types.d.ts';

/** Log that was read, with its summary as numbers and as sentences. */
interface ReadLog { name: string; summary: Summary; sentences: string[] }

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

const resultOf = ({ calibration, options: { model = 'odometry', rule = 'thrun', legs, correct = {} }, logs }: CalibrationReport): Result => ({
  stats: calibration, legCount: calibration.legs.count, model, rule, legLength: legs, corrections: correct,
  logName: new Intl.ListFormat('en').format(new Set(logs.map(({ name }) => name))), warnings: warningsOf(logs),
});

/** Labels and texts of the report's tables. */
const REPORT_WORDS = { alphas: sharedTexts.alphas, calibrator: en };

const MAX_LISTED_OUTLIERS = 5;

/** Returns the summaries of the logs (odometry and reference of each drive), without the result of the fit. */
export const formatLogSummaries = (logs: ReadLog[]): string =>
  logs.map(({ name, sentences }, i) => `${[`${english.choose.roleNames[ROLES[i % 2]]}: ${name}`, ...sentences].join('\n  ')}\n`).join('');

/** Codes of colours in a terminal. */
const [RED, GREEN, YELLOW] = [31, 32, 33];

/** Colours of the verdict's badge, by the rating of the α's. */
const RATING_COLORS = { consistent: GREEN, questionable: YELLOW, unusable: RED };

const colorizeText = (color: number) => (text: string) => `\x1b[${color}m${text}\x1b[0m`;

/** Returns the text report, which follows the summaries of the logs. */
export function formatReport(report: CalibrationReport, isColored = false): string {
  const { calibration, driveStarts } = report;
  const { legs, lost, recommended } = calibration;
  const { model, rule, legLength } = resultOf(report);
  const { yaml, notes } = formatYamlWithNotes(report);
  const lostLegTexts = LOST_LEG_CAUSES.filter((cause) => lost[cause] > 0).map((cause) => `${lost[cause]} ${en.lostLegs[cause]}`);
  const excludedLegLines = [...(lostLegTexts.length ? [`lost legs: ${lostLegTexts.join(', ')}`] : []), ...formatOutliers(legs, driveStarts)];
  const uncoloredReport = [
    '',
    ...formatVerdict(report),
    '',
    `${legs.count} legs ${describeLegLength(legLength)}; model ${model}${model === 'odometry' ? `, rule ${rule}` : ''}`,
    '',
    ...formatTable(alphaTableOf(calibration, model, REPORT_WORDS)),
    ...(recommended ? [explainRecommendation(calibration, en)] : []),
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
    ...notes,
    ...(yaml ? ['# nav2_params.yaml', yaml.trimEnd()] : []),
    '',
  ].join('\n');
  if (!isColored) return uncoloredReport;
  const { rating, badge } = judgeReport(report);
  return uncoloredReport.replace(badge, colorizeText(RATING_COLORS[rating])).replaceAll(/✓ \w+/g, colorizeText(GREEN)).replaceAll(/✕ \w+/g, colorizeText(RED));
}

const judgeReport = (report: CalibrationReport) => judgementOf(resultOf(report), en, '--no-correct');

/** Returns the verdict as on the page, and the advice, with one sentence per line. */
export function formatVerdict(report: CalibrationReport): string[] {
  const { badge, finding, advice } = judgeReport(report);
  return [`${badge}. ${finding}`, ...advice, ...(report.command ? [`  ${report.command}`] : [])];
}

/** Returns the lines of a table, as plain text: with minus signs that can be copied, and several values of a cell in one line. */
function formatTable({ columnHeadings, rows }: ResultTable): string[] {
  const toPlainText = (text: string) => text.replaceAll('*', '').replaceAll(MINUS, '-').replaceAll('\u202f', ' ').replaceAll('\n', ', ');
  return alignRows([columnHeadings, ...rows].map((row) => row.map(toPlainText)));
}

/** Returns the table of the checks, and the message of each failed check. Checks have the same names as in JSON and in documents. */
function formatChecks(calibration: Calibration): string[] {
  const { checks } = calibration.diagnostics;
  const { columnHeadings, rows } = checkTableOf(calibration, REPORT_WORDS);
  const namedRows = rows.map(([description, ...cells], i) => [checks[i].name, ...cells, description]);
  return [...formatTable({ columnHeadings: [...columnHeadings, ''], rows: namedRows }), ...checks.filter(({ passed }) => !passed).map(({ name, message }) => `${name}: ${message}`)];
}

/** Lists outliers by their times, in seconds after the start of the odometry. */
function formatOutliers({ count, times, outliers }: Calibration['legs'], driveStarts: number[]): string[] {
  const outlierLegs = Array.from({ length: count }, (_, leg) => leg).filter((leg) => outliers[leg] === 1);
  const timeTexts = outlierLegs.slice(0, MAX_LISTED_OUTLIERS).map((leg) => {
    const driveStart = Math.max(...driveStarts.filter((start) => start <= times[2 * leg]));
    return `${(times[2 * leg] - driveStart).toFixed(2)} s${driveStarts.length > 1 ? ` of drive ${driveStarts.indexOf(driveStart) + 1}` : ''}`;
  }).join(', ');
  return outlierLegs.length ? [`outliers: ${outlierLegs.length} of ${count} legs, at ${timeTexts}${outlierLegs.length > MAX_LISTED_OUTLIERS ? ', …' : ''} after the start`] : [];
}

/** Returns the lines for nav2_params.yaml. The notes say why there are no lines, or that the fit used another noise rule than Nav2's AMCL. */
export function formatYamlWithNotes(report: CalibrationReport): { yaml: string; notes: string[] } {
  const result = resultOf(report);
  const yaml = formatNav2Yaml(result, report.date);
  if (!yaml) return { yaml, notes: [`No lines for nav2_params.yaml: ${result.stats.recommended ? 'Nav2 has no velocity model' : 'the log is unusable'}.`] };
  return { yaml, notes: isNav2Rule(result.model, result.rule) ? [] : ['Warning: fitted by another rule than Nav2’s; give --rule nav2.'] };
}

export function alignRows(rows: string[][]): string[] {
  // The last cell of a row does not count for the width of its column, because nothing follows it.
  const columnWidths = rows[0].map((_, column) => Math.max(...rows.map((row) => (column < row.length - 1 ? row[column].length : 0))));
  return rows.map((row) => row.map((cell, column) => cell.padEnd(columnWidths[column])).join('  ').trimEnd());
}

export const formatReportJson = ({ calibration, options, logs, start, date }: CalibrationReport): string => `${formatJson({ date, options, logs, start, ...calibration })}\n`;
