/** Opens recordings that are files or folders. */

import { openAsBlob } from 'node:fs';
import { readFile, readdir, stat } from 'node:fs/promises';
import { basename, join, relative } from 'node:path';
import { LogError, type FindOptions, type Recording, type SourceFile } from '../logs/log.ts';
import { openRecordings } from '../logs/open.ts';
import type { InputPath } from './options.ts';

/**
 * Opens the recordings of a file or folder. Error messages refer to it by `sourceName`. Rejects with a LogError if it has no log. Calls `onSkip` with the error
 * of each file that is not a log.
 */
export async function openRecordingsAt({ inputPath, logRole }: InputPath, sourceName: string, optionsOf: FindOptions, onSkip: (error: LogError) => void): Promise<Recording[]> {
  const logErrors: LogError[] = [];
  const recordings = await openRecordings(await openSources(inputPath, sourceName), (fileName) => ({ ...optionsOf(fileName), logRole }), (error) => logErrors.push(error));
  const refusalError = recordings.length === 0 ? logErrors.shift() : undefined;
  logErrors.forEach(onSkip);
  if (refusalError) throw refusalError;
  return recordings;
}

async function openSources(inputPath: string, sourceName: string): Promise<SourceFile[]> {
  try {
    if (!(await stat(inputPath)).isDirectory()) {
      // The file `-wal` (write-ahead log) next to an SQLite database has its latest messages, and is opened too.
      const hasJournal = await stat(`${inputPath}-wal`).then(({ size: journalSize }) => journalSize > 0, () => false);
      return await Promise.all(['', ...(hasJournal ? ['-wal'] : [])].map((pathEnding) => openSource(`${inputPath}${pathEnding}`, `${sourceName}${pathEnding}`)));
    }
    const folderEntries = await readdir(inputPath, { withFileTypes: true, recursive: true });
    const filePaths = folderEntries.filter((folderEntry) => folderEntry.isFile() && !/^\.|-shm$/.test(folderEntry.name)).map((folderEntry) => join(folderEntry.parentPath, folderEntry.name)).toSorted();
    if (filePaths.length === 0) throw Object.assign(new Error(), { code: 'an empty folder' });
    return await Promise.all(filePaths.map((filePath) => openSource(filePath, basename(filePath), join(sourceName, relative(inputPath, filePath)).replaceAll('\\', '/'))));
  } catch (error) {
    const { code: errorCode } = error as NodeJS.ErrnoException;
    if (error instanceof LogError || errorCode === undefined) throw error;
    throw new LogError({ fileName: inputPath }, (errorReasons) => errorReasons.unreadableFileReason(errorCode));
  }
}

/** Returns a file whose bytes are read when they are needed. */
async function openSource(filePath: string, sourceName: string, pathInFolder?: string): Promise<SourceFile> {
  // A pipe, such as <(zcat odom.csv.gz) in a shell, can be read only once, and is therefore read into memory.
  const fileContents = (await stat(filePath)).isFile() ? await openAsBlob(filePath) : await readFile(filePath);
  return Object.assign(new File([fileContents as BlobPart], sourceName), pathInFolder !== undefined && { path: pathInFolder });
}
