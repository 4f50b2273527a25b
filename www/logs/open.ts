/** Opens recordings. The first bytes of a file determine its format. A recording of rosbag2 may consist of several files, which its metadata.yaml lists. */

import { group, sort } from 'd3-array';
import type { MessageContainer } from './formats/container.ts';
import { LogError, readBytes, type OpenOptions, type FindOptions, type Recording, type SourceFile } from './log.ts';
import { openTable } from './table.ts';

type FileFormat = 'mcap' | 'rosbag' | 'sqlite' | 'zstd' | 'metadata';

const FORMAT_MAGIC: Record<FileFormat, string> = {
  mcap: '\x89MCAP0\r\n',
  rosbag: '#ROSBAG V2.0\n',
  sqlite: 'SQLite format 3\0',
  zstd: '\x28\xb5\x2f\xfd',
  metadata: 'rosbag2_bagfile_information:',
};

/** First bytes of formats that are recognized but not read, each with the name of the format, and with the command that converts it if there is one. */
const UNREAD_FORMATS: [magic: string, name: string, command?: string][] = [
  ['#ROSBAG V1', 'ROS bag 1', 'rosbag reindex'], ['#ROSRECORD', 'ROS bag 1', 'rosbag reindex'], ['ULog\x01\x12\x35', 'PX4 ULog', 'ulog2csv'],
  ['\xa3\x95\x80', 'ArduPilot DataFlash', 'mavlogdump.py --format csv --types POS'], ['\x1f\x8b', 'gzip', 'gunzip'], ['BZh', 'bzip2', 'bunzip2'], ['\xfd7zXZ\0', 'xz', 'unxz'],
  ['\x04\x22\x4d\x18', 'LZ4', 'unlz4'], ['PK\x03\x04', 'ZIP (.zip, .xlsx, .ods)'], ['\x89HDF\r\n\x1a\n', 'HDF5'], ['MATLAB 5.0 MAT-file', 'MATLAB'], ['PAR1', 'Parquet'],
];

/** First bytes of the journal of an SQLite database. */
const JOURNAL_MAGIC = '\x37\x7f\x06';

const MAX_MAGIC_BYTES = 32;

/** Returns a function for the options of a file or log, from options by file name. The options of a file apply to its logs; those under the name "" apply to all files. */
export const createOptionsFinder = (optionsByFile: [file: string, OpenOptions][]): FindOptions => (name) =>
  Object.assign({}, ...optionsByFile.filter(([file]) => file === '' || name === file || name.startsWith(`${file}, `)).map(([, options]) => options));

/**
 * Opens files; rejects with a LogError that names the file, the line or topic, and what to do. Files that a metadata.yaml of rosbag2
 * lists become one recording.
 *
 * @param optionsOf returns the options of a file, and of a log in it
 * @param onSkip called with the error of each file that is not a log, and is skipped; without `onSkip` the first error rejects
 */
export async function openRecordings(givenFiles: SourceFile[], optionsOf: FindOptions = () => undefined, onSkip?: (error: LogError) => void): Promise<Recording[]> {
  const reportSkipped = (doWork: () => Promise<void>) => doWork().catch((error) => {
    if (!(error instanceof LogError) || !onSkip) throw error;
    onSkip(error);
  });
  const files = distinguishNames(givenFiles);
  const formatByFile = new Map<SourceFile, FileFormat | undefined>();
  for (const file of files) {
    await reportSkipped(async () => {
      const fileFormat = await detectFormat(file);
      const openedSource = fileFormat === 'zstd' ? await (await import('./formats/decompression.ts')).decompressZstdFile(file) : file;
      formatByFile.set(openedSource, fileFormat === 'zstd' ? await detectFormat(openedSource) : fileFormat);
    });
  }
  const openedSources = [...formatByFile.keys()];
  const recordings: Recording[] = [];
  const addRecording = (recording: Recording) => void recordings.push({ ...recording, logRole: optionsOf(recording.recordingName)?.logRole });
  // Files that a metadata.yaml lists are opened with the metadata.yaml, and not as recordings of their own.
  for (const sourceFile of sort(openedSources, (opened) => Number(formatByFile.get(opened) !== 'metadata'))) {
    if (!formatByFile.has(sourceFile)) continue;
    await reportSkipped(async () => {
      const format = formatByFile.get(sourceFile);
      formatByFile.delete(sourceFile);
      if (!format) return addRecording(await openTable(sourceFile, optionsOf));
      const { folderName, listedFiles } = format === 'metadata' ? await (await import('./formats/metadata.ts')).findListedFiles(sourceFile, openedSources) : { folderName: sourceFile.name, listedFiles: [sourceFile] };
      const partFormats = listedFiles.map((part) => (part === sourceFile ? format : formatByFile.get(part)));
      for (const part of listedFiles) formatByFile.delete(part);
      const container = joinContainers(await Promise.all(listedFiles.map((part, i) => openContainer(part, partFormats[i]))));
      addRecording(await (await import('./topics.ts')).createRecording(folderName, container, optionsOf));
    });
  }
  return recordings;
}

/** Returns files with distinct names: files of the same name are called by their paths, or are numbered. */
function distinguishNames(files: SourceFile[]): SourceFile[] {
  return Array.from(group(files, ({ name }) => name).values()).flatMap((sameNamed) => sameNamed.map((file, i) => {
    if (sameNamed.length === 1) return file;
    const { name, path, size } = file;
    return { name: path || `${name} (${i + 1})`, path, size, slice: (start?: number, end?: number) => file.slice(start, end) };
  }));
}

/** Returns the format of a file by its first bytes; undefined for a table. */
async function detectFormat(sourceFile: SourceFile): Promise<FileFormat | undefined> {
  const firstBytes = String.fromCharCode(...(await readBytes(sourceFile, 0, MAX_MAGIC_BYTES)));
  if (firstBytes.startsWith(JOURNAL_MAGIC)) throw new LogError({ fileName: sourceFile.name }, (errorReasons) => errorReasons.journalFileReason);
  const unreadFormat = UNREAD_FORMATS.find(([magic]) => firstBytes.startsWith(magic));
  if (unreadFormat) throw new LogError({ fileName: sourceFile.name }, (errorReasons) => errorReasons.unreadFormatReason(unreadFormat[1], unreadFormat[2]));
  return (Object.keys(FORMAT_MAGIC) as FileFormat[]).find((format) => firstBytes.startsWith(FORMAT_MAGIC[format]));
}

/** Opens a container. The module for its format is imported only when it is needed. */
async function openContainer(sourceFile: SourceFile, format: FileFormat | undefined): Promise<MessageContainer> {
  if (format === 'mcap') return (await import('./formats/mcap.ts')).openMcap(sourceFile);
  if (format === 'rosbag') return (await import('./formats/rosbag.ts')).openRosbag(sourceFile);
  if (format === 'sqlite') return (await import('./formats/sqlite.ts')).openSqlite(sourceFile);
  throw new LogError({ fileName: sourceFile.name }, (errorReasons) => errorReasons.listedFileReason);
}

/** Returns a container with the messages of several containers, one after the other. */
function joinContainers(containers: MessageContainer[]): MessageContainer {
  return {
    recordingFormat: containers[0].recordingFormat,
    topicChannels: containers.flatMap(({ topicChannels }) => topicChannels),
    get truncationReason() {
      return containers.find(({ truncationReason }) => truncationReason)?.truncationReason;
    },
    get damageReasons() {
      return containers.flatMap(({ damageReasons }) => damageReasons);
    },
    async readMessages(isWanted, onMessage, onProgress) {
      for (const [i, container] of containers.entries()) {
        let isReadingStopped = false;
        await container.readMessages(isWanted, onMessage, (progressFraction) => (isReadingStopped = onProgress?.((i + progressFraction) / containers.length) === true));
        if (isReadingStopped) return;
      }
    },
  };
}
