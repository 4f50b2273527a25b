/** Recordings of rosbag2 that consist of several files. Their metadata.yaml lists the files. */

import { load } from 'js-yaml';
import { LogError, readBytes, listNames, reasonOf } from '../log-error.ts';
import type { Source } from '../log.ts';
import type { Container } from './container.ts';

const MAX_METADATA_BYTES = 2 ** 24;

const folderOf = ({ path = '' }: Source) => path.replace(/[^/]*$/, '');
const baseName = (path: string) => path.replace(/^.*\//, '');

/** Returns the files that a metadata.yaml lists, in its folder. */
export async function listedFiles(metadata: Source, sources: Source[]): Promise<{ name: string; files: Source[] }> {
  const errorPlace = { file: metadata.path || metadata.name };
  const fileNames: string[] = [];
  try {
    const text = new TextDecoder().decode(await readBytes(metadata, 0, Math.min(metadata.size, MAX_METADATA_BYTES)));
    const { rosbag2_bagfile_information: { relative_file_paths: paths } } = load(text) as { rosbag2_bagfile_information: { relative_file_paths: unknown[] } };
    fileNames.push(...paths.map((path) => baseName(String(path))));
  } catch (error) {
    if (error instanceof LogError) throw error;
    throw new LogError(errorPlace, (texts) => texts.damaged(reasonOf(error)));
  }
  const filesInFolder = sources.filter((source) => folderOf(source) === folderOf(metadata));
  // A decompressed file has no ".zstd" at the end of its name.
  const files = fileNames.map((name) => filesInFolder.find((source) => source.name === name || `${source.name}.zstd` === name));
  const missingNames = fileNames.filter((_, i) => !files[i]);
  if (missingNames.length > 0 || files.length === 0) throw new LogError(errorPlace, (texts) => texts.noFiles(listNames(missingNames)));
  const folder = baseName(folderOf(metadata).replace(/\/$/, ''));
  return { name: folder || fileNames[0], files: files as Source[] };
}

/** Returns a container with the messages of several containers, one after the other. */
export function joinedContainer(parts: Container[]): Container {
  return {
    format: parts[0].format,
    channels: parts.flatMap(({ channels }) => channels),
    get cutReason() {
      return parts.find(({ cutReason }) => cutReason)?.cutReason;
    },
    get damage() {
      return new Map(parts.flatMap(({ damage }, i) => [...damage].map(([position, reason]): [number, string] => [2 ** 48 * i + position, reason])));
    },
    async read(isWanted, onMessage, onProgress) {
      for (const [i, part] of parts.entries()) {
        let isStopped = false;
        await part.read(isWanted, onMessage, (share) => (isStopped = onProgress?.((i + share) / parts.length) === true));
        if (isStopped) return;
      }
    },
  };
}
