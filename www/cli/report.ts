/** Calibration result as text and as JSON. */

import { english } from '../logs/en.ts';
import { ROLES, type Summary } from '../logs/log.ts';
import { warningsOf } from '../logs/pairs.ts';
import { en as sharedTexts } from '../messages/en.ts';
import { en } from '../widgets/alpha-calibrator/en.ts';
import { SYSTEMATIC_ERRORS, formatAlphaOrBound, correctionAdvice, formatInterval, failedChecksOf, formatEstimate, isNav2Rule, missingAlphas, nav2Lines, formatPercent, formatNumber } from '../widgets/alpha-calibrator/lines.ts';

type Interval = [number, number] | null;

/** Log with its summary, as numbers and as sentences. */
interface ReadLog { name: string; summary: Summary; sentences: string[] }

export interface CalibrationResult {
  calibration: any;
  options: Record<string, any>;
  /** Odometry and reference of each drive. */
  logs: ReadLog[];
  /** Whole seconds that were subtracted from all times. */
  start: number;
  /** Times of the odometry's first row in each drive. */
  driveStarts: number[];
  date: string;
}

const LOST_LEG_CAUSES = ['withoutReference', 'acrossBreaks', 'acrossPauses', 'standing'] as const;

/** Checks whose failure makes a log unusable. */
const DECISIVE_CHECKS = ['reference-matches', 'enough-legs', 'inflation-bounded'];

const MAX_LISTED_OUTLIERS = 5;

/** Returns the summaries of the logs (odometry and reference of each drive), without the result of the fit. */
export const logSummaries = (logs: ReadLog[]): string =>
  logs.map(({ name, sentences }, i) => `${[`${english.choose.roles[ROLES[i % 2]]}: ${name}`, ...sentences].join('\n  ')}\n`).join('');

/** Returns the text report, which follows the summaries of the logs. */
export function reportText({ calibration, options, logs, start, driveStarts, date }: CalibrationResult, isColored = false): string {
  const { legs, lost, diagnostics: { checks, windows } } = calibration;
  const { model = 'odometry', rule = 'thrun' } = options;
  const { distance, angle, duration } = options.legs;
  const lengthText = duration === undefined ? en.nav2.moved(formatNumber(distance), formatNumber(angle)) : en.nav2.lasted(formatNumber(duration));
  const { yaml, reason } = nav2Yaml({ calibration, options, logs, start, driveStarts, date });
  const failedChecks = failedChecksOf(checks);
  const windowRows = windows.map(({ length, count, coverage, nees }: any) => [`of ${formatNumber(length)} m`, String(count), formatPercent(coverage), formatNumber(nees)]);
  const lostLegTexts = LOST_LEG_CAUSES.filter((cause) => lost[cause] > 0).map((cause) => `${lost[cause]} ${en.lost[cause]}`);
  const excludedLegLines = [...(lostLegTexts.length ? [`lost legs: ${lostLegTexts.join(', ')}`] : []), ...outlierLines(legs, driveStarts)];
  const uncoloredReport = [
    '',
    ...verdictLines({ calibration, options, logs }),
    '',
    `${legs.count} legs ${lengthText}; model ${model}${model === 'odometry' ? `, rule ${rule}` : ''}`,
    '',
    ...alphaTable(calibration, model),
    '',
    ...alignRows([['', 'value', '95 %', ''], ...noiseRows(calibration, options), ...SYSTEMATIC_ERRORS.map((name) => systematicRow(name, calibration)), persistenceRow(calibration)]),
    '',
    ...alignRows([['check', 'value', 'expected', ''], ...checks.map(checkRow)]),
    ...failedChecks.map(({ name, message }) => `${name}: ${message}`),
    '',
    ...(excludedLegLines.length ? [...excludedLegLines, ''] : []),
    ...alignRows([['held-out windows', 'number', 'covered', 'squared error / variance (NEES)'], ...windowRows]),
    '',
    ...(reason ? [reason] : [...ruleWarning({ options }), '# nav2_params.yaml', yaml.trimEnd()]),
    '',
  ].join('\n');
  return isColored ? uncoloredReport.replaceAll(/^Consistent|\bok$/gm, colorize(GREEN)).replace(/^Questionable/m, colorize(YELLOW)).replaceAll(/^Unusable|\bFAILED$/gm, colorize(RED)) : uncoloredReport;
}

const [RED, GREEN, YELLOW] = [31, 32, 33];

const colorize = (color: number) => (text: string) => `\x1b[${color}m${text}\x1b[0m`;

/** Returns the warnings of the logs, the verdict, and the missing drives for α's that are not identifiable. */
export const verdictLines = ({ calibration, options, logs }: Pick<CalibrationResult, 'calibration' | 'options' | 'logs'>): string[] => [
  ...warningsOf(logs).map((name) => en.nav2[name]),
  verdictSentence(calibration, warningsOf(logs).length > 0),
  ...missingAlphas(en.alphas.lacking, options.model, calibration).map(({ indices, lack, drive }) => `${alphaNames(indices)} not identifiable: ${lack}; ${drive}`),
  ...correctionAdvice(calibration, en.nav2),
];

/** Returns a sentence with the verdict and the advice. A warning of the logs makes consistent α's questionable, as on the page. */
function verdictSentence({ alphas, diagnostics: { verdict, checks } }: any, hasWarnings: boolean): string {
  const failedChecks = failedChecksOf(checks);
  const useAnyway = 'If the log cannot be improved, use the recommended α’s.';
  if (verdict === 'consistent' && hasWarnings) return `Questionable: all checks passed, but the warning remains. ${useAnyway}`;
  if (verdict === 'consistent') {
    const missingIndices = alphas.flatMap((alpha: number | null, i: number) => (alpha === null ? [i] : []));
    return `Consistent: all checks passed${missingIndices.length ? `, but ${alphaNames(missingIndices)} cannot be identified` : ''}. Use the recommended α’s with legs of this length.`;
  }
  if (verdict === 'questionable') {
    const failedText = failedChecks.length === 1 ? 'one check' : `${failedChecks.length} of ${checks.length} checks`;
    return `Questionable: ${failedText} failed (${failedChecks.map(({ name }) => name).join(', ')}). ${failedChecks[0].message} ${useAnyway}`;
  }
  const checkMessage = failedChecks.find(({ name }) => DECISIVE_CHECKS.includes(name))?.message ?? 'It does not identify any α.';
  return `Unusable: no α’s are recommended from this log. ${checkMessage}`;
}

const alphaNames = (indices: number[]) => new Intl.ListFormat('en').format(indices.map((i) => `alpha${i + 1}`));

/** Returns the table of the α's, and the reason for the inflation. */
function alphaTable({ alphas, intervals, recommended }: any, model: string): string[] {
  const alphaRows = alphas.map((alpha: number | null, i: number) => [
    `alpha${i + 1}`,
    alpha === null ? 'not identifiable' : formatAlphaOrBound(alpha, intervals[i]),
    formatInterval(intervals[i]),
    recommended && alpha !== null ? formatAlphaOrBound(alpha, intervals[i], recommended.inflation) : '–',
    sharedTexts.alphas[model === 'velocity' ? 'velocity' : 'odometry'][i][0],
  ]);
  return [...alignRows([['', 'fitted', '95 %', 'recommended', ''], ...alphaRows]), ...(recommended ? [recommended.reason] : [])];
}

function noiseRows({ referenceNoise }: any, options: CalibrationResult['options']): string[][] {
  const noiseRow = (name: string, key: 'positionStd' | 'yawStd', unit: string) => {
    const { value, interval } = referenceNoise[key];
    const isStated = options[key] !== undefined;
    return [name, `${formatEstimate(value, interval)} ${unit}`, isStated ? '' : formatInterval(interval), isStated ? 'as stated' : 'estimated'];
  };
  return [noiseRow('reference position σ', 'positionStd', 'm'), noiseRow('reference yaw σ', 'yawStd', 'rad')];
}

function systematicRow(name: (typeof SYSTEMATIC_ERRORS)[number], { systematicErrors }: any): string[] {
  const { value, interval, constant, corrected } = systematicErrors[name];
  const [estimates, intervals] = Array.isArray(value) ? [value, interval] : [[value], [interval]];
  if (estimates.includes(null)) return [en.systematic.names[name], 'not identifiable'];
  const joinEstimates = (print: (value: any, interval: Interval) => string) => estimates.map((value: any, i: number) => print(value, intervals[i])).join(', ');
  return [
    en.systematic.names[name],
    joinEstimates(formatEstimate),
    joinEstimates((_, interval) => formatInterval(interval)),
    `${corrected ? 'corrected' : 'not corrected'}${constant ? '' : ', not a constant'}`,
  ];
}

function persistenceRow({ persistence: { correlation: { value, interval }, length } }: any): string[] {
  return ['correlation of neighbouring legs', formatEstimate(value, interval), formatInterval(interval), length > 0 ? `errors persist over ${formatNumber(length, 2)} m` : ''];
}

function checkRow({ name, value, expected: [low, high], passed }: any): string[] {
  // A failing value is printed with more digits if it would round to a bound.
  const digitCount = [3, 4, 6, 17].find((count) => passed || [low, high].every((bound) => formatNumber(value, count) !== formatNumber(bound, count)));
  const boundsText = low === -Infinity ? `≤ ${formatNumber(high, digitCount)}` : high === Infinity ? `≥ ${formatNumber(low, digitCount)}` : `${formatNumber(low, digitCount)} to ${formatNumber(high, digitCount)}`;
  return [name, value === Infinity ? '∞' : formatNumber(value, digitCount), boundsText, passed ? 'ok' : 'FAILED'];
}

/** Lists outliers by their times after the start of the odometry. */
function outlierLines({ count, times, outliers }: any, driveStarts: number[]): string[] {
  const outlierLegs = Array.from({ length: count }, (_, leg) => leg).filter((leg) => outliers[leg] === 1);
  const timeTexts = outlierLegs.slice(0, MAX_LISTED_OUTLIERS).map((leg) => {
    const driveStart = Math.max(...driveStarts.filter((begin) => begin <= times[2 * leg]));
    return `${(times[2 * leg] - driveStart).toFixed(2)} s${driveStarts.length > 1 ? ` of drive ${driveStarts.indexOf(driveStart) + 1}` : ''}`;
  }).join(', ');
  return outlierLegs.length ? [`outliers: ${outlierLegs.length} of ${count} legs, at ${timeTexts}${outlierLegs.length > MAX_LISTED_OUTLIERS ? ', …' : ''} after the start`] : [];
}

/** Returns a warning if the α's were fitted by another rule than that of Nav2's AMCL. */
export const ruleWarning = ({ options: { model = 'odometry', rule = 'thrun' } }: Pick<CalibrationResult, 'options'>): string[] =>
  (isNav2Rule(model, rule) ? [] : ['Warning: fitted by another rule than Nav2’s; give --rule nav2.']);

/** Returns the lines for nav2_params.yaml, or the reason why there are none. */
export function nav2Yaml({ calibration, options: { model = 'odometry', rule = 'thrun', legs }, logs, date }: CalibrationResult): { yaml: string; reason?: string } {
  if (calibration.recommended === null) return { yaml: '', reason: 'No lines for nav2_params.yaml: the log is unusable.' };
  const logNames = new Intl.ListFormat('en').format(new Set(logs.map(({ name }) => name)));
  const yamlLines = nav2Lines({ calibration, count: calibration.legs.count, model, rule, legs, log: logNames, warnings: warningsOf(logs), date }, en.nav2);
  return yamlLines.length ? { yaml: `${yamlLines.join('\n')}\n` } : { yaml: '', reason: 'No lines for nav2_params.yaml: Nav2 has no velocity model.' };
}

export function alignRows(rows: string[][]): string[] {
  const columnWidths = rows[0].map((_, column) => Math.max(...rows.map((row) => (row[column] ?? '').length)));
  return rows.map((row) => row.map((cell, column) => cell.padEnd(columnWidths[column])).join('  ').trimEnd());
}

/** Returns the result as JSON, with typed arrays as plain arrays. */
export function resultJson({ calibration, options, logs, start, date }: CalibrationResult): string {
  const replaceTypedArrays = (_: string, value: unknown) => (ArrayBuffer.isView(value) ? [...(value as Float64Array)] : value);
  return `${JSON.stringify({ date, options, logs, start, ...calibration }, replaceTypedArrays, 1)}\n`;
}
