/** Map files of the user: a JSON floor plan, or a pair of files as for ROS map_server. */

import { YAMLException, load } from 'js-yaml';
import { limits } from '../../../../build/settings.js';
import type { MapSqueeze } from '../../../types.d.ts';

type RefusalWords = import('../../../messages/registry.ts').Messages['squeeze']['refusals'];

/** Decodes a PNG image. Throws a RangeError for other files. */
export type DecodePng = (imageBytes: Uint8Array) => Promise<Pick<ImageData, 'width' | 'height' | 'data'>>;

export interface UserMap {
  name: string;
  /** Sets the map of a simulation, or throws a MapFileError and changes nothing. */
  applyTo: (simulation: MapSqueeze) => void;
}

/** Error whose message is one sentence that names the file, the line or field, and what was expected. */
export class MapFileError extends Error {
  name = 'MapFileError';
}

/** Maximum size of a floor plan, in bytes: a hundred for each allowed wall. */
const MAX_PLAN_BYTES = 2_000_000;

/** Maximum size of a YAML file, in bytes. */
const MAX_YAML_BYTES = 100_000;

/** Maximum number of quoted characters of a name or a value. */
const MAX_QUOTED_LENGTH = 100;

/** First bytes of a PNG image. */
const PNG_MAGIC = [0x89, 0x50, 0x4e, 0x47];

/** Reads the map in files; rejects with a MapFileError in the words of a language. */
export async function readMapFiles(files: File[], decodePng: DecodePng, texts: RefusalWords): Promise<UserMap> {
  const filesOfPattern = (fileNamePattern: RegExp) => files.filter(({ name }) => fileNamePattern.test(name));
  const [planFiles, yamlFiles, imageFiles] = [filesOfPattern(/\.json$/i), filesOfPattern(/\.ya?ml$/i), filesOfPattern(/\.(pgm|png)$/i)];
  const isOneMap = planFiles.length + yamlFiles.length === 1 && planFiles.length + yamlFiles.length + imageFiles.length === files.length;
  if (!isOneMap) throw new MapFileError(texts.wrongFiles(quoteText(files.map(({ name }) => name).join(', '))));
  return planFiles.length ? readPlan(planFiles[0].name, await readText(planFiles[0], MAX_PLAN_BYTES, texts), texts) : readGrid(yamlFiles[0], imageFiles, decodePng, texts);
}

/** Reads a file; throws if it has more than `maxBytes` bytes. */
async function readBytes(file: File, maxBytes: number, texts: RefusalWords) {
  checkSize(file.name, file.size, maxBytes, texts);
  return new Uint8Array(await file.arrayBuffer());
}

const readText = async (file: File, maxBytes: number, texts: RefusalWords) => new TextDecoder().decode(await readBytes(file, maxBytes, texts));

function checkSize(name: string, byteCount: number, maxBytes: number, texts: RefusalWords) {
  if (byteCount > maxBytes) throw new MapFileError(texts.fileTooLong(quoteText(name), byteCount, maxBytes));
}

/** Shortens a text that a sentence quotes. */
function quoteText(quotedText: string) {
  return quotedText.length > MAX_QUOTED_LENGTH ? `${quotedText.slice(0, MAX_QUOTED_LENGTH)}…` : quotedText;
}

/** Reads a floor plan from the JSON of a file; throws a MapFileError. */
export function readPlan(name: string, planJson: string, texts: RefusalWords): UserMap {
  checkSize(name, planJson.length, MAX_PLAN_BYTES, texts);
  const explainReason = (reason: string) => texts.invalidPlan(quoteText(name), quoteText(reason));
  const parsedPlan = explainErrors(() => JSON.parse(planJson), explainReason);
  return { name, applyTo: (simulation) => explainErrors(() => simulation.setPlan(parsedPlan), explainReason) };
}

async function readGrid(file: File, imageFiles: File[], decodePng: DecodePng, texts: RefusalWords): Promise<UserMap> {
  const quotedName = quoteText(file.name);
  const description = parseDescription(quotedName, await readText(file, MAX_YAML_BYTES, texts), texts);
  const { image: imagePath } = description;
  if (typeof imagePath !== 'string' || imagePath === '') throw new MapFileError(texts.invalidImageName(quotedName, imagePath === undefined ? '' : quoteText(JSON.stringify(imagePath))));
  const imageName = imagePath.slice(Math.max(imagePath.lastIndexOf('/'), imagePath.lastIndexOf('\\')) + 1);
  const imageFile = imageFiles.find(({ name }) => name === imageName);
  if (!imageFile) throw new MapFileError(texts.missingImage(quotedName, quoteText(imageName), quoteText(imageFiles.map(({ name }) => name).join(', '))));
  const imageBytes = await readBytes(imageFile, limits.bytes, texts);
  const isPng = PNG_MAGIC.every((byte, i) => byte === imageBytes[i]);
  const quotedImageName = quoteText(imageFile.name);
  const throwPngError = (error: Error) => explainErrors(() => { throw error; }, (reason) => `${quotedImageName}: ${reason}.`);
  const imageContent = isPng ? await decodePng(imageBytes).catch(throwPngError) : imageBytes;
  return {
    name: file.name,
    applyTo: (simulation) => explainErrors(() => simulation.setGrid(description, imageContent), (reason) => explainGridError(texts, quotedName, quotedImageName, reason)),
  };
}

/** Words for true and false, which are texts in YAML 1.2 and booleans for map_server. */
const BOOLEAN_WORDS = new Map([['true', true], ['yes', true], ['on', true], ['false', false], ['no', false], ['off', false]]);

/** Fields whose values are numbers. map_server also reads numbers in quotes. */
const NUMBER_FIELDS = ['resolution', 'origin', 'negate', 'occupied_thresh', 'free_thresh'];

/** Returns a number in quotes as a number, and other values unchanged. */
function parseQuotedNumber(yamlValue: unknown): unknown {
  if (Array.isArray(yamlValue)) return yamlValue.map(parseQuotedNumber);
  return typeof yamlValue === 'string' && yamlValue.trim() !== '' && Number.isFinite(Number(yamlValue)) ? Number(yamlValue) : yamlValue;
}

/** Parses the fields of a YAML description as leniently as map_server does. For a file without fields, the missing image is reported later. */
function parseDescription(quotedName: string, yamlText: string, texts: RefusalWords): Record<string, unknown> {
  try {
    // YAML forbids tabs as indentation, and the fields need no indentation. Aliases are refused: no map needs them, and with them a short
    // text can expand to billions of values, or contain itself.
    const fields: Record<string, unknown> = { ...(load(yamlText.replaceAll(/^\t+/gm, '').replaceAll('\t', ' '), { maxAliases: 0 }) as object) };
    for (const key of NUMBER_FIELDS) if (key in fields) fields[key] = parseQuotedNumber(fields[key]);
    const { negate, mode } = fields;
    if (typeof negate === 'string') fields.negate = BOOLEAN_WORDS.get(negate.toLowerCase()) ?? negate;
    if (typeof mode === 'string') fields.mode = mode.toLowerCase();
    return fields;
  } catch (error) {
    if (!(error instanceof YAMLException)) throw error;
    throw new MapFileError(texts.invalidYaml(quotedName, error.mark ? error.mark.line + 1 : 1, quoteText(error.reason)));
  }
}

/** Returns the sentence about a grid that the core refuses, with the name of the YAML file or of the image. */
function explainGridError(texts: RefusalWords, yamlName: string, imageName: string, reason: string) {
  const errorLine = /^line (\d+): (.*)$/.exec(reason);
  if (errorLine) return texts.invalidLine(imageName, errorLine[1], errorLine[2]);
  return `${reason.startsWith('image') ? imageName : yamlName}: ${reason}.`;
}

/** Runs a parser or the core with a file, and explains why the file is refused. */
function explainErrors<Result>(readOrApply: () => Result, explainReason: (reason: string) => string): Result {
  try {
    return readOrApply();
  } catch (error) {
    if (!(error instanceof RangeError || error instanceof TypeError || error instanceof SyntaxError)) throw error;
    throw new MapFileError(explainReason(error.message.replace(' is undefined;', ' is missing;')));
  }
}
