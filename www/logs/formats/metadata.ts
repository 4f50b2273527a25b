/** Files of a rosbag2 recording, which its metadata.yaml lists. */

import { load } from 'js-yaml';
import { LogError, listNames, readBytes, reasonOf, type Source } from '../log.ts';

const MAX_METADATA_BYTES = 2 ** 24;

const folderOf = ({ path = '' }: Source) => path.replace(/[^/]*$/, '');
const baseNameOf = (path: string) => path.replace(/^.*\//, '');

/** Returns the files in the folder of a metadata.yaml that the metadata.yaml lists. */
export async function findListedFiles(metadata: Source, sources: Source[]): Promise<{ name: string; files: Source[] }> {
  const errorPlace = { file: metadata.path || metadata.name };
  const fileNames: string[] = [];
  try {
    const text = new TextDecoder().decode(await readBytes(metadata, 0, Math.min(metadata.size, MAX_METADATA_BYTES)));
    const { rosbag2_bagfile_information: { relative_file_paths: paths } } = load(text) as { rosbag2_bagfile_information: { relative_file_paths: unknown[] } };
    fileNames.push(...paths.map((path) => baseNameOf(String(path))));
  } catch (error) {
    if (error instanceof LogError) throw error;
    throw new LogError(errorPlace, (texts) => texts.damagedFileReason(reasonOf(error)));
  }
  const filesInFolder = sources.filter((source) => folderOf(source) === folderOf(metadata));
  // A file that the user has decompressed lacks the ending ".zstd" of the listed name.
  const files = fileNames.map((name) => filesInFolder.find((source) => [name, name.replace(/\.zstd$/, '')].includes(baseNameOf(source.name))));
  const missingNames = fileNames.filter((_, i) => !files[i]);
  if (missingNames.length > 0 || files.length === 0) throw new LogError(errorPlace, (texts) => texts.missingFilesReason(listNames(missingNames)));
  const folder = baseNameOf(folderOf(metadata).replace(/\/$/, ''));
  return { name: folder || fileNames[0], files: files as Source[] };
}
