/** Map files of the user: a floor plan as JSON, or a YAML file with an image, as ROS map_server reads them. */

import { YAMLException, load } from 'js-yaml';
import { limits } from '../../../../build/settings.js';
import type { MapSqueeze } from '../../../types.d.ts';

type RefusalWords = import('../../../messages/registry.ts').MessageCatalogue['squeeze']['refusals'];

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

/** Maximum size of a floor plan in bytes. It allows a hundred bytes for each of the allowed walls. */
const MAX_PLAN_BYTES = 2_000_000;

/** Maximum size of a YAML file, in bytes. */
const MAX_YAML_BYTES = 100_000;

/** Maximum number of characters of a quoted name or value. */
const MAX_QUOTED_LENGTH = 100;

/** First bytes of a PNG image. */
const PNG_MAGIC = [0x89, 0x50, 0x4e, 0x47];

/** Reads the map in the user's files. Rejects with a MapFileError, whose message is in the language of the given words. */
export async function readMapFiles(files: File[], decodePng: DecodePng, texts: RefusalWords): Promise<UserMap> {
  const filesOfPattern = (fileNamePattern: RegExp) => files.filter(({ name }) => fileNamePattern.test(name));
  const [planFiles, yamlFiles, imageFiles] = [filesOfPattern(/\.json$/i), filesOfPattern(/\.ya?ml$/i), filesOfPattern(/\.(pgm|png)$/i)];
  const isOneMap = planFiles.length + yamlFiles.length === 1 && planFiles.length + yamlFiles.length + imageFiles.length === files.length;
  if (!isOneMap) throw new MapFileError(texts.wrongFilesSentence(quoteText(files.map(({ name }) => name).join(', '))));
  return planFiles.length ? readPlan(planFiles[0].name, await readText(planFiles[0], MAX_PLAN_BYTES, texts), texts) : readGrid(yamlFiles[0], imageFiles, decodePng, texts);
}

/** Reads a file; throws if it has more than `maxBytes` bytes. */
async function readBytes(file: File, maxBytes: number, texts: RefusalWords) {
  checkSize(file.name, file.size, maxBytes, texts);
  return new Uint8Array(await file.arrayBuffer());
}

const readText = async (file: File, maxBytes: number, texts: RefusalWords) => new TextDecoder().decode(await readBytes(file, maxBytes, texts));

function checkSize(name: string, byteCount: number, maxBytes: number, texts: RefusalWords) {
  if (byteCount > maxBytes) throw new MapFileError(texts.largeFileSentence(quoteText(name), byteCount, maxBytes));
}

/** Shortens a text that a sentence quotes. */
function quoteText(quotedText: string) {
  return quotedText.length > MAX_QUOTED_LENGTH ? `${quotedText.slice(0, MAX_QUOTED_LENGTH)}…` : quotedText;
}

/** Reads a floor plan from the JSON of a file; throws a MapFileError. */
export function readPlan(name: string, planJson: string, texts: RefusalWords): UserMap {
  checkSize(name, planJson.length, MAX_PLAN_BYTES, texts);
  const explainReason = (reason: string) => texts.invalidPlanSentence(quoteText(name), quoteText(reason));
  const parsedPlan = explainErrors(() => JSON.parse(planJson), explainReason);
  return { name, applyTo: (simulation) => explainErrors(() => simulation.setPlan(parsedPlan), explainReason) };
}

async function readGrid(file: File, imageFiles: File[], decodePng: DecodePng, texts: RefusalWords): Promise<UserMap> {
  const quotedName = quoteText(file.name);
  const description = parseDescription(quotedName, await readText(file, MAX_YAML_BYTES, texts), texts);
  const { image: imagePath } = description;
  if (typeof imagePath !== 'string' || imagePath === '') throw new MapFileError(texts.invalidImageNameSentence(quotedName, imagePath === undefined ? '' : quoteText(JSON.stringify(imagePath))));
  const imageName = imagePath.slice(Math.max(imagePath.lastIndexOf('/'), imagePath.lastIndexOf('\\')) + 1);
  const imageFile = imageFiles.find(({ name }) => name === imageName);
  if (!imageFile) throw new MapFileError(texts.missingImageSentence(quotedName, quoteText(imageName), quoteText(imageFiles.map(({ name }) => name).join(', '))));
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

/** Words that map_server reads as true and false, although YAML 1.2 reads most of them as strings. */
const BOOLEAN_WORDS = new Map([['true', true], ['yes', true], ['on', true], ['false', false], ['no', false], ['off', false]]);

/** Fields that have numbers as values. map_server also accepts numbers in quotes. */
const NUMBER_FIELDS = ['resolution', 'origin', 'negate', 'occupied_thresh', 'free_thresh'];

/** Returns a number for a number in quotes, and any other value unchanged. */
function parseQuotedNumber(yamlValue: unknown): unknown {
  if (Array.isArray(yamlValue)) return yamlValue.map(parseQuotedNumber);
  return typeof yamlValue === 'string' && yamlValue.trim() !== '' && Number.isFinite(Number(yamlValue)) ? Number(yamlValue) : yamlValue;
}

/** Parses the fields of a map's YAML file as leniently as map_server. If the file has no fields, the caller reports that the image is missing. */
function parseDescription(quotedName: string, yamlText: string, texts: RefusalWords): Record<string, unknown> {
  try {
    // YAML forbids indentation by tabs. Tabs are removed, because the fields need no indentation. Aliases are refused: no map needs them, and they let a
    // short text expand to billions of values, or contain itself.
    const yamlFields: Record<string, unknown> = { ...(load(yamlText.replaceAll(/^\t+/gm, '').replaceAll('\t', ' '), { maxAliases: 0 }) as object) };
    for (const key of NUMBER_FIELDS) if (key in yamlFields) yamlFields[key] = parseQuotedNumber(yamlFields[key]);
    const { negate, mode } = yamlFields;
    if (typeof negate === 'string') yamlFields.negate = BOOLEAN_WORDS.get(negate.toLowerCase()) ?? negate;
    if (typeof mode === 'string') yamlFields.mode = mode.toLowerCase();
    return yamlFields;
  } catch (error) {
    if (!(error instanceof YAMLException)) throw error;
    throw new MapFileError(texts.invalidYamlSentence(quotedName, error.mark ? error.mark.line + 1 : 1, quoteText(error.reason)));
  }
}

/** Returns a sentence about a grid that the core has refused. The sentence names the YAML file or the image. */
function explainGridError(texts: RefusalWords, yamlName: string, imageName: string, reason: string) {
  const errorLine = /^line (\d+): (.*)$/.exec(reason);
  if (errorLine) return texts.invalidLineSentence(imageName, errorLine[1], errorLine[2]);
  return `${reason.startsWith('image') ? imageName : yamlName}: ${reason}.`;
}

/** Calls a parser or the core with a file. If they refuse the file, throws a MapFileError with the reason. */
function explainErrors<Result>(readOrApply: () => Result, explainReason: (reason: string) => string): Result {
  try {
    return readOrApply();
  } catch (error) {
    if (!(error instanceof RangeError || error instanceof TypeError || error instanceof SyntaxError)) throw error;
    throw new MapFileError(explainReason(error.message.replace(' is undefined;', ' is missing;')));
  }
}
