/** Recordings of rosbag2 that consist of several files, which a metadata.yaml lists. */

import { load } from 'js-yaml';
import { LogError, bytesOf, listed, reasonOf } from '../log-error.ts';
import type { Source } from '../log.ts';
import type { Channel, Container, Message } from './container.ts';

/** Maximum size of a metadata.yaml, bytes. */
const MAX_METADATA = 2 ** 24;

/** Files of a recording. */
interface Folder {
  name: string;
  /** Files in the order of recording. */
  found: Source[];
  missing: string[];
}

const folderOf = ({ path = '' }: Source) => path.replace(/[^/]*$/, '');
const nameOf = (path: string) => path.replace(/^.*\//, '');

/** Returns the files that a metadata.yaml lists, in its folder. */
export async function filesOf(metadata: Source, sources: Source[]): Promise<Folder> {
  const place = { file: metadata.path || metadata.name };
  const names: string[] = [];
  try {
    const text = new TextDecoder().decode(await bytesOf(metadata, 0, Math.min(metadata.size, MAX_METADATA)));
    const { rosbag2_bagfile_information: { relative_file_paths: paths } } = load(text) as { rosbag2_bagfile_information: { relative_file_paths: unknown[] } };
    names.push(...paths.map((path) => nameOf(String(path))));
  } catch (error) {
    if (error instanceof LogError) throw error;
    throw new LogError(place, (say) => say.damaged(reasonOf(error)));
  }
  const beside = sources.filter((source) => folderOf(source) === folderOf(metadata));
  // A decompressed file has no ".zstd" at the end of its name.
  const files = names.map((name) => beside.find((source) => source.name === name || `${source.name}.zstd` === name));
  const found = files.filter((file) => file !== undefined);
  const missing = names.filter((_, i) => !files[i]);
  if (found.length === 0) throw new LogError(place, (say) => say.noFiles(listed(names)));
  const folder = nameOf(folderOf(metadata).replace(/\/$/, ''));
  return { name: folder || found[0].name, found, missing };
}

/** Returns a container with the messages of several containers, one after the other. */
export function joined(parts: Container[], missing: string[]): Container {
  return {
    format: parts[0].format,
    channels: parts.flatMap(({ channels }) => channels),
    missing,
    get damage() {
      return new Map(parts.flatMap(({ damage }, i) => [...damage].map(([position, reason]) => [2 ** 48 * i + position, reason])));
    },
    get cutShort() {
      return parts.some(({ cutShort }) => cutShort);
    },
    async read(isWanted: (channel: Channel) => boolean, each: (message: Message) => void, onProgress?: (share: number) => boolean | void) {
      for (const [i, part] of parts.entries()) {
        let isDone = false;
        await part.read(isWanted, each, (share) => (isDone = onProgress?.((i + share) / parts.length) === true));
        if (isDone) return;
      }
    },
  };
}
