/** Files of a rosbag2 recording, which its metadata.yaml lists. */

import { load } from 'js-yaml';
import { LogError, listNames, readBytes, reasonOf, type SourceFile } from '../log.ts';

const MAX_METADATA_BYTES = 2 ** 24;

const folderOf = ({ path: filePath = '' }: SourceFile) => filePath.replace(/[^/]*$/, '');
const baseNameOf = (filePath: string) => filePath.replace(/^.*\//, '');

/** Returns the files in the folder of a metadata.yaml that the metadata.yaml lists. */
export async function findListedFiles(metadata: SourceFile, sourceFiles: SourceFile[]): Promise<{ folderName: string; listedFiles: SourceFile[] }> {
  const errorPlace = { fileName: metadata.path || metadata.name };
  const fileNames: string[] = [];
  try {
    const metadataText = new TextDecoder().decode(await readBytes(metadata, 0, Math.min(metadata.size, MAX_METADATA_BYTES)));
    const { rosbag2_bagfile_information: { relative_file_paths: listedPaths } } = load(metadataText) as { rosbag2_bagfile_information: { relative_file_paths: unknown[] } };
    fileNames.push(...listedPaths.map((filePath) => baseNameOf(String(filePath))));
  } catch (error) {
    if (error instanceof LogError) throw error;
    throw new LogError(errorPlace, (errorReasons) => errorReasons.damagedFileReason(reasonOf(error)));
  }
  const filesInFolder = sourceFiles.filter((sourceFile) => folderOf(sourceFile) === folderOf(metadata));
  // A file that the user has decompressed lacks the ending ".zstd" of the listed name.
  const listedFiles = fileNames.map((fileName) => filesInFolder.find((sourceFile) => [fileName, fileName.replace(/\.zstd$/, '')].includes(baseNameOf(sourceFile.name))));
  const missingNames = fileNames.filter((_, i) => !listedFiles[i]);
  if (missingNames.length > 0 || listedFiles.length === 0) throw new LogError(errorPlace, (errorReasons) => errorReasons.missingFilesReason(listNames(missingNames)));
  const folderName = baseNameOf(folderOf(metadata).replace(/\/$/, ''));
  return { folderName: folderName || fileNames[0], listedFiles: listedFiles as SourceFile[] };
}
