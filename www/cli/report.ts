/** Calibration result as text and as JSON. */

import { english } from '../logs/en.ts';
import { ROLES, type Summary } from '../logs/log.ts';
import { warningsOf } from '../logs/pairs.ts';
import { en as sharedTexts } from '../messages/en.ts';
import { en, yamlWords } from '../widgets/alpha-calibrator/en.ts';
import { errorComponentsOf, formatAlphaOrBound, formatEstimate, formatInterval, formatNumber, formatPercent, isNav2Rule, formatNav2Lines } from '../widgets/alpha-calibrator/result.ts';
import { LOST_LEG_CAUSES, SYSTEMATIC_ERRORS, adviceOf, judgementOf } from '../widgets/alpha-calibrator/result.ts';
import type { Calibration, CalibrationCheck } from '../types.d.ts';

/** Log with its summary, as numbers and as sentences. */
interface ReadLog { name: string; summary: Summary; sentences: string[] }

type JudgedResult = Pick<CalibrationResult, 'calibration' | 'options' | 'logs'>;

export interface CalibrationResult {
  calibration: Calibration;
  options: Record<string, any>;
  /** Odometry and reference of each drive. */
  logs: ReadLog[];
  /** Whole seconds that were subtracted from all times. */
  start: number;
  /** Times of the odometry's first row in each drive. */
  driveStarts: number[];
  date: string;
}

const MAX_LISTED_OUTLIERS = 5;

/** Returns the summaries of the logs (odometry and reference of each drive), without the result of the fit. */
export const formatLogSummaries = (logs: ReadLog[]): string =>
  logs.map(({ name, sentences }, i) => `${[`${english.choose.roles[ROLES[i % 2]]}: ${name}`, ...sentences].join('\n  ')}\n`).join('');

/** Codes of colours in a terminal. */
const [RED, GREEN, YELLOW] = [31, 32, 33];

/** Colours of the verdict's badge, by the rating of the α's. */
const RATING_COLORS = { consistent: GREEN, questionable: YELLOW, unusable: RED };

const colorizeText = (color: number) => (text: string) => `\x1b[${color}m${text}\x1b[0m`;

/** Returns the text report, which follows the summaries of the logs. */
export function formatReport(calibrationResult: CalibrationResult, isColored = false): string {
  const { calibration, options, driveStarts } = calibrationResult;
  const { legs, lost, diagnostics: { checks, windows } } = calibration;
  const { model = 'odometry', rule = 'thrun' } = options;
  const { distance, angle, duration } = options.legs;
  const lengthText = duration === undefined ? yamlWords.legsByMotion(formatNumber(distance), formatNumber(angle)) : yamlWords.legsByDuration(formatNumber(duration));
  const { yaml, reason } = formatNav2Yaml(calibrationResult);
  const windowRows = windows.map(({ length, count, coverage, nees }) => [`of ${formatNumber(length)} m`, String(count), formatPercent(coverage), formatNumber(nees)]);
  const lostLegTexts = LOST_LEG_CAUSES.filter((cause) => lost[cause] > 0).map((cause) => `${lost[cause]} ${en.lostLegs[cause]}`);
  const excludedLegLines = [...(lostLegTexts.length ? [`lost legs: ${lostLegTexts.join(', ')}`] : []), ...formatOutliers(legs, driveStarts)];
  const uncoloredReport = [
    '',
    ...formatVerdict(calibrationResult),
    '',
    `${legs.count} legs ${lengthText}; model ${model}${model === 'odometry' ? `, rule ${rule}` : ''}`,
    '',
    ...formatAlphaTable(calibration, model),
    '',
    ...alignRows([['', 'value', '95 %', ''], ...formatNoiseRows(calibration, options), ...SYSTEMATIC_ERRORS.map((name) => formatSystematicRow(name, calibration)), formatPersistenceRow(calibration)]),
    '',
    ...alignRows([['check', 'value', 'expected', '', ''], ...checks.map(formatCheckRow)]),
    ...checks.filter(({ passed }) => !passed).map(({ name, message }) => `${name}: ${message}`),
    '',
    ...(excludedLegLines.length ? [...excludedLegLines, ''] : []),
    ...alignRows([['held-out windows', 'number', 'covered', 'squared error / variance (NEES)'], ...windowRows]),
    '',
    ...(reason ? [reason] : [...warnAboutRule(calibrationResult), '# nav2_params.yaml', yaml.trimEnd()]),
    '',
  ].join('\n');
  if (!isColored) return uncoloredReport;
  const { rating, badge } = judgeResult(calibrationResult);
  return uncoloredReport.replace(badge, colorizeText(RATING_COLORS[rating])).replaceAll(/\bok(?= {2})/g, colorizeText(GREEN)).replaceAll(/\bFAILED(?= {2})/g, colorizeText(RED));
}

function judgeResult({ calibration, options: { model, correct = {} }, logs }: JudgedResult) {
  return judgementOf({ stats: calibration, legCount: calibration.legs.count, model, corrections: correct, warnings: warningsOf(logs) }, en, '--no-correct');
}

/** Returns the verdict as on the page, and what to do, in a line for each sentence. */
export function formatVerdict(judgedResult: JudgedResult): string[] {
  const { badge, finding, advice } = judgeResult(judgedResult);
  return [`${badge}. ${finding}`, ...advice];
}

/** Returns the table of the α's, and the reason for the inflation. */
function formatAlphaTable({ alphas, intervals, notIdentifiable, recommended }: Calibration, model: string): string[] {
  const alphaRows = alphas.map((alpha, i) => [
    `alpha${i + 1}`,
    alpha === null ? 'not identifiable' : formatAlphaOrBound(alpha, intervals[i]),
    formatInterval(intervals[i]),
    recommended && alpha !== null ? formatAlphaOrBound(alpha, intervals[i], recommended.inflation) : '–',
    [sharedTexts.alphas[model === 'velocity' ? 'velocity' : 'odometry'][i][0], ...(notIdentifiable[i] ? [adviceOf(en.alphas.missingMotions, model, notIdentifiable[i]).lack] : [])].join('; '),
  ]);
  return [...alignRows([['', 'fitted', '95 %', 'recommended', ''], ...alphaRows]), ...(recommended ? [recommended.reason] : [])];
}

function formatNoiseRows({ referenceNoise }: Calibration, options: CalibrationResult['options']): string[][] {
  const formatNoiseRow = (name: string, key: 'positionStd' | 'yawStd', unit: string) => {
    const { value, interval } = referenceNoise[key];
    const isStated = options[key] !== undefined;
    return [name, `${formatEstimate(value, interval)} ${unit}`, isStated ? '' : formatInterval(interval), isStated ? 'as stated' : 'estimated'];
  };
  return [formatNoiseRow('reference position σ', 'positionStd', 'm'), formatNoiseRow('reference yaw σ', 'yawStd', 'rad')];
}

function formatSystematicRow(name: (typeof SYSTEMATIC_ERRORS)[number], { systematicErrors }: Calibration): string[] {
  const { constant, corrected } = systematicErrors[name];
  const components = errorComponentsOf(systematicErrors[name]);
  if (components.some(({ value }) => value === null)) return [en.systematic.errorNames[name], 'not identifiable'];
  return [
    en.systematic.errorNames[name],
    components.map(({ value, interval }) => formatEstimate(value, interval)).join(', '),
    components.map(({ interval }) => formatInterval(interval)).join(', '),
    `${corrected ? 'corrected' : 'not corrected'}${constant ? '' : ', not a constant'}`,
  ];
}

function formatPersistenceRow({ persistence: { correlation: { value, interval }, length } }: Calibration): string[] {
  return ['correlation of neighbouring legs', formatEstimate(value, interval), formatInterval(interval), length > 0 ? `errors persist over ${formatNumber(length, 2)} m` : ''];
}

function formatCheckRow({ name, value, expected: [low, high], passed }: CalibrationCheck): string[] {
  // If a value that fails its check would round to a bound of the check, both are printed with more digits.
  const digitCount = [3, 4, 6, 17].find((count) => passed || [low, high].every((bound) => formatNumber(value, count) !== formatNumber(bound, count)));
  const boundsText = low === -Infinity ? `≤ ${formatNumber(high, digitCount)}` : high === Infinity ? `≥ ${formatNumber(low, digitCount)}` : `${formatNumber(low, digitCount)} to ${formatNumber(high, digitCount)}`;
  return [name, value === Infinity ? '∞' : formatNumber(value, digitCount), boundsText, passed ? 'ok' : 'FAILED', en.checks.checkNames[name]];
}

/** Lists outliers by their times after the start of the odometry. */
function formatOutliers({ count, times, outliers }: Calibration['legs'], driveStarts: number[]): string[] {
  const outlierLegs = Array.from({ length: count }, (_, leg) => leg).filter((leg) => outliers[leg] === 1);
  const timeTexts = outlierLegs.slice(0, MAX_LISTED_OUTLIERS).map((leg) => {
    const driveStart = Math.max(...driveStarts.filter((start) => start <= times[2 * leg]));
    return `${(times[2 * leg] - driveStart).toFixed(2)} s${driveStarts.length > 1 ? ` of drive ${driveStarts.indexOf(driveStart) + 1}` : ''}`;
  }).join(', ');
  return outlierLegs.length ? [`outliers: ${outlierLegs.length} of ${count} legs, at ${timeTexts}${outlierLegs.length > MAX_LISTED_OUTLIERS ? ', …' : ''} after the start`] : [];
}

/** Returns a warning if the α's were fitted by another rule than that of Nav2's AMCL. */
export const warnAboutRule = ({ options: { model = 'odometry', rule = 'thrun' } }: Pick<CalibrationResult, 'options'>): string[] =>
  (isNav2Rule(model, rule) ? [] : ['Warning: fitted by another rule than Nav2’s; give --rule nav2.']);

/** Returns the lines for nav2_params.yaml, or the reason why there are none. */
export function formatNav2Yaml({ calibration, options: { model = 'odometry', rule = 'thrun', legs }, logs, date }: CalibrationResult): { yaml: string; reason?: string } {
  if (calibration.recommended === null) return { yaml: '', reason: 'No lines for nav2_params.yaml: the log is unusable.' };
  const logNames = new Intl.ListFormat('en').format(new Set(logs.map(({ name }) => name)));
  const yamlLines = formatNav2Lines({ calibration, legCount: calibration.legs.count, model, rule, legs, logName: logNames, warnings: warningsOf(logs), date });
  return yamlLines.length ? { yaml: `${yamlLines.join('\n')}\n` } : { yaml: '', reason: 'No lines for nav2_params.yaml: Nav2 has no velocity model.' };
}

export function alignRows(rows: string[][]): string[] {
  const columnWidths = rows[0].map((_, column) => Math.max(...rows.map((row) => (row[column] ?? '').length)));
  return rows.map((row) => row.map((cell, column) => cell.padEnd(columnWidths[column])).join('  ').trimEnd());
}

/** Returns the result as JSON, with typed arrays as plain arrays. */
export function formatResultJson({ calibration, options, logs, start, date }: CalibrationResult): string {
  const replaceTypedArrays = (_: string, value: unknown) => (ArrayBuffer.isView(value) ? [...(value as Float64Array)] : value);
  return `${JSON.stringify({ date, options, logs, start, ...calibration }, replaceTypedArrays, 1)}\n`;
}
