/** Opens recordings that are files or folders. */

import { openAsBlob } from 'node:fs';
import { readFile, readdir, stat } from 'node:fs/promises';
import { basename, join, relative } from 'node:path';
import { LogError, type OptionsByName, type Recording, type Source } from '../logs/log.ts';
import { openRecordings } from '../logs/open.ts';
import type { InputPath } from './options.ts';

/**
 * Opens the recordings of a file or folder. Error messages refer to it by `name`. Rejects with a LogError if it has no log. Calls `onSkip` with the error
 * of each file that is not a log.
 */
export async function openRecordingsAt({ path, role }: InputPath, name: string, optionsOf: OptionsByName, onSkip: (error: LogError) => void): Promise<Recording[]> {
  const errors: LogError[] = [];
  const recordings = await openRecordings(await openSources(path, name), (file) => ({ ...optionsOf(file), role }), (error) => errors.push(error));
  const refusalError = recordings.length === 0 ? errors.shift() : undefined;
  errors.forEach(onSkip);
  if (refusalError) throw refusalError;
  return recordings;
}

async function openSources(path: string, name: string): Promise<Source[]> {
  try {
    if (!(await stat(path)).isDirectory()) {
      // The file `-wal` (write-ahead log) next to an SQLite database has its latest messages, and is opened too.
      const hasJournal = await stat(`${path}-wal`).then(({ size }) => size > 0, () => false);
      return await Promise.all(['', ...(hasJournal ? ['-wal'] : [])].map((ending) => openSource(`${path}${ending}`, `${name}${ending}`)));
    }
    const folderEntries = await readdir(path, { withFileTypes: true, recursive: true });
    const filePaths = folderEntries.filter((folderEntry) => folderEntry.isFile() && !/^\.|-shm$/.test(folderEntry.name)).map((folderEntry) => join(folderEntry.parentPath, folderEntry.name)).toSorted();
    if (filePaths.length === 0) throw Object.assign(new Error(), { code: 'an empty folder' });
    return await Promise.all(filePaths.map((file) => openSource(file, basename(file), join(name, relative(path, file)).replaceAll('\\', '/'))));
  } catch (error) {
    const { code } = error as NodeJS.ErrnoException;
    if (error instanceof LogError || code === undefined) throw error;
    throw new LogError({ file: path }, (texts) => texts.unreadableFileReason(code));
  }
}

/** Returns a file whose bytes are read when they are needed. */
async function openSource(file: string, name: string, path?: string): Promise<Source> {
  // A pipe, such as <(zcat odom.csv.gz) in a shell, can be read only once, and is therefore read into memory.
  const fileContents = (await stat(file)).isFile() ? await openAsBlob(file) : await readFile(file);
  return Object.assign(new File([fileContents as BlobPart], name), path !== undefined && { path });
}
