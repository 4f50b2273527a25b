import assert from 'node:assert/strict';
import { german } from '../../www/logs/de.ts';
import { LogError } from '../../www/logs/log.ts';
import { openRecordings } from '../../www/logs/open.ts';

/**
 * Reads one log of a file.
 *
 * @param {import('../../www/logs/log.ts').Source} source
 * @param {Partial<import('../../www/logs/log.ts').LogChoice>} [choice]
 */
export async function readLog(source, choice) {
  const [recording] = await openRecordings([source]);
  const [log] = await recording.read([{ series: '', ...choice }]);
  return log;
}

/** Returns the error of a log that is refused, which has a German sentence too. @param {Promise<unknown>} reading @returns {Promise<LogError>} */
export async function catchRefusalError(reading) {
  const error = await reading.then(() => undefined, (reason) => reason);
  assert.ok(error instanceof LogError, String(error));
  assert.notEqual(error.sentence(german), error.message);
  return error;
}

/** Returns the message of the error with which a log is refused. @param {Promise<unknown>} reading */
export const catchRefusalSentence = async (reading) => (await catchRefusalError(reading)).message;
