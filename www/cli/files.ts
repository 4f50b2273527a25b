/** Recordings of files and folders. */

import { openAsBlob } from 'node:fs';
import { readdir, stat } from 'node:fs/promises';
import { basename, dirname, join, relative, resolve } from 'node:path';
import { LogError } from '../logs/log-error.ts';
import type { Recording, Source } from '../logs/log.ts';
import { openRecordings } from '../logs/open.ts';
import type { Input } from './options.ts';

/**
 * Opens a file or a folder; rejects with a LogError. In a folder without metadata.yaml other files than logs are skipped, each with a call
 * of `onSkip`.
 */
export async function recordingsOf({ path, open }: Input, onSkip: (reason: string) => void): Promise<Recording[]> {
  const sources = await sourcesOf(path);
  const bagFolders = sources.filter(({ name }) => name === 'metadata.yaml').map((source) => dirname(source.path ?? ''));
  const isJoined = ({ path = '' }: Source) => bagFolders.includes(dirname(path));
  const joined = sources.filter(isJoined);
  const recordings = joined.length > 0 ? await openRecordings(joined, open) : [];
  for (const source of sources.filter((each) => !isJoined(each))) {
    try {
      recordings.push(...(await openRecordings([source], open)));
    } catch (error) {
      if (!(error instanceof LogError) || sources.length === 1) throw error;
      onSkip(error.message);
    }
  }
  return recordings;
}

async function sourcesOf(path: string): Promise<Source[]> {
  const name = basename(resolve(path));
  try {
    if (!(await stat(path)).isDirectory()) return [await sourceOf(path, name)];
    const found = await readdir(path, { withFileTypes: true, recursive: true });
    const files = found.filter((entry) => entry.isFile() && !entry.name.startsWith('.')).map((entry) => join(entry.parentPath, entry.name)).toSorted();
    if (files.length === 0) throw Object.assign(new Error(), { code: 'an empty folder' });
    return await Promise.all(files.map((file) => sourceOf(file, basename(file), join(name, relative(path, file)).replaceAll('\\', '/'))));
  } catch (error) {
    const { code } = error as NodeJS.ErrnoException;
    if (error instanceof LogError || code === undefined) throw error;
    throw new LogError({ file: path }, (say) => say.gone(code));
  }
}

/** Returns a file whose bytes are read when they are needed. */
async function sourceOf(file: string, name: string, path?: string): Promise<Source> {
  return Object.assign(new File([await openAsBlob(file)], name), path !== undefined && { path });
}
