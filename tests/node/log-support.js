import assert from 'node:assert/strict';
import { german } from '../../www/logs/de.ts';
import { LogError } from '../../www/logs/log.ts';
import { openRecordings } from '../../www/logs/open.ts';

/** Reads one log of a file. @param {import('../../www/logs/log.ts').SourceFile} logFile @param {Partial<import('../../www/logs/log.ts').LogChoice>} [logChoice] */
export async function readLog(logFile, logChoice) {
  const [recording] = await openRecordings([logFile]);
  const [log] = await recording.readLogs([{ seriesName: '', ...logChoice }]);
  return log;
}

/** Returns the error of a refused log. The error must have a German sentence too. @param {Promise<unknown>} logPromise @returns {Promise<LogError>} */
export async function catchRefusalError(logPromise) {
  const refusalError = await logPromise.then(() => undefined, (rejectionReason) => rejectionReason);
  assert.ok(refusalError instanceof LogError, String(refusalError));
  assert.notEqual(refusalError.composeMessage(german), refusalError.message);
  return refusalError;
}

/** Returns the message of the error with which a log is refused. @param {Promise<unknown>} logPromise */
export const catchRefusalSentence = async (logPromise) => (await catchRefusalError(logPromise)).message;
