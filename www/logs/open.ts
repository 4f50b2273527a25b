/** Recordings in files, by the contents of each. */

import { bytesOf } from './log-error.js';
import type { OpenOptions, Recording, Source } from './log.ts';
import { openTable } from './table.ts';

/** First bytes of an MCAP recording. */
const MCAP = [0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a];

/** Opens files; rejects with a LogError that names the file, the line or topic, and what is expected. */
export async function openRecordings(sources: Source[], options: OpenOptions = {}): Promise<Recording[]> {
  const recordings = [];
  for (const source of sources) {
    const start = await bytesOf(source, 0, MCAP.length);
    recordings.push(await (MCAP.every((byte, i) => byte === start[i]) ? mcapOf(source) : openTable(source, options)));
  }
  return recordings;
}

async function mcapOf(source: Source): Promise<Recording> {
  const { listTopics, readRecording } = await import('./recording.js');
  return {
    name: source.name,
    format: 'mcap',
    series: await listTopics(source),
    read: (choices, onProgress) => readRecording(source, choices, onProgress),
  };
}
