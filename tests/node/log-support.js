import { openRecordings } from '../../www/logs/open.ts';

/**
 * Reads one log of a file.
 *
 * @param {import('../../www/logs/log.ts').Source} source
 * @param {Partial<import('../../www/logs/log.ts').Choice>} [choice]
 */
export async function readLog(source, choice) {
  const [recording] = await openRecordings([source]);
  const [log] = await recording.read([{ series: '', ...choice }]);
  return log;
}
