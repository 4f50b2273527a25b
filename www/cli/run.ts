/** Commands `calibrate` and `inspect`. */

import { writeFile } from 'node:fs/promises';
import { planDrives, readDrives, type Drive } from '../logs/drives.ts';
import { english } from '../logs/en.ts';
import { LogError, cut } from '../logs/log-error.ts';
import { logOf } from '../logs/pairs.ts';
import { summarize } from '../logs/summary.ts';
import { adviceOf } from './advice.ts';
import { recordingsOf } from './files.ts';
import { byOrder, inspect, textOf as textOfContents, type Given } from './inspect.ts';
import { HELP, UsageError, optionsOf, withOption, type Calibrate } from './options.ts';
import { plotOf } from './plot.ts';
import { jsonOf, logSummaries, nav2YamlOf, ruleWarning, textOf, verdictLines, type Result } from './report.ts';

interface Environment {
  /** Loads the core. */
  load(): Promise<any>;
  print(text: string): void;
  complain(text: string): void;
  /** Shows the progress of reading; undefined hides it. */
  onProgress?(share: number | undefined): void;
  version?: string;
  isColored?: boolean;
  now?: Date;
}

/** Exit codes of a shell. */
const [SUCCESS, BAD_INPUT, UNUSABLE] = [0, 2, 3];

/** Runs a command, and returns the exit code; rejects on a defect of the program. */
export async function run(args: string[], environment: Environment): Promise<number> {
  const { print, complain, onProgress } = environment;
  const onSkip = ({ message }: LogError) => complain(`skipped: ${message}\n`);
  try {
    const options = optionsOf(args);
    if (options === 'help') print(HELP);
    else if (options === 'version') print(`${environment.version}\n`);
    else if (options.command === 'inspect') {
      const given: Given[] = [];
      for (const input of options.inputs) for (const recording of await recordingsOf(input, onSkip)) given.push({ recording, path: input.path });
      const contents = await inspect(given, options.stated, onProgress);
      print(options.isJson ? `${JSON.stringify(contents, undefined, 1)}\n` : textOfContents(contents));
      if (contents.command === undefined) return BAD_INPUT;
    } else return await calibrate(options, environment, onSkip);
    return SUCCESS;
  } catch (error) {
    onProgress?.(undefined);
    if (!(error instanceof LogError || error instanceof UsageError)) throw error;
    complain(`${error.message}${error instanceof LogError ? adviceOf(error) : ''}\n`);
    return BAD_INPUT;
  }
}

async function calibrate({ inputs, wishes, fit, output, plot }: Calibrate, { load, print, complain, onProgress, isColored = false, now = new Date() }: Environment, onSkip: (error: LogError) => void): Promise<number> {
  const roles = new Map();
  const recordings = [];
  for (const kind of ['recording', 'odometry', 'reference'] as const) {
    for (const input of inputs[kind]) {
      const opened = await recordingsOf(input, onSkip);
      recordings.push(...opened);
      if (kind !== 'recording') for (const each of opened) roles.set(each, kind);
    }
  }
  if (recordings.length === 0) throw new UsageError('there are no logs in the folder.');
  const plan = planDrives(recordings, { ...wishes, roles });
  plan.unused.forEach(onSkip);
  if (plan.isByOrder) complain(`${byOrder(plan)}\n`);
  const drives = await readDrives(plan, onProgress);
  onProgress?.(undefined);
  const [{ odometry: { start } }] = drives;
  const logs = drives.flatMap(({ odometry, reference }) => [odometry, reference]).map(({ name, ...log }) => ({ name, summary: log.summary, sentences: summarize({ name, ...log }, english.found) }));
  // The summary is shown even if the fit is refused.
  if (output === 'text') print(logSummaries(logs));
  if (output === 'yaml') complain(logSummaries(logs));
  const calibration = fitted(await load(), fit, drives);
  const result: Result = { calibration, options: fit, logs, start, begins: drives.map(({ odometry }) => odometry.data.t[0]), date: now.toISOString().slice(0, 10) };
  if (plot !== undefined) await save(plot, plotOf(drives, calibration));
  const isUnusable = calibration.recommended === null;
  if (output === 'yaml') {
    const { yaml, reason } = nav2YamlOf(result);
    complain([...verdictLines(result), ...(yaml ? ruleWarning(result) : []), ...(reason ? [reason] : []), ''].join('\n'));
    print(yaml);
    return isUnusable ? UNUSABLE : yaml ? SUCCESS : BAD_INPUT;
  }
  print(output === 'json' ? jsonOf(result) : textOf(result, isColored));
  return isUnusable ? UNUSABLE : SUCCESS;
}

async function save(path: string, text: string): Promise<void> {
  await writeFile(path, text).catch(({ code }: NodeJS.ErrnoException) => {
    throw new UsageError(`--plot ${cut(path)} cannot be written (${code}).`);
  });
}

function fitted(motion: any, fit: Calibrate['fit'], drives: Drive[]): any {
  try {
    return motion.calibrate({ ...fit, ...logOf(drives) });
  } catch (error) {
    if (!(error instanceof RangeError || error instanceof TypeError)) throw error;
    const names = drives.flatMap(({ odometry, reference }) => [odometry.name, reference.name]);
    throw new UsageError(withOption(error.message) ?? `${new Intl.ListFormat('en').format(names)}: ${error.message}.`);
  }
}
