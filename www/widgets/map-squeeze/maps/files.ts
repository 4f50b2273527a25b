/** Map files of the user: a JSON floor plan, or a pair of files as for ROS map_server. */

import { limits } from '../../../settings.js';
import type { MapSqueeze } from '../../../types.d.ts';

export type RefusalWords = import('../../../messages/registry.ts').Messages['squeeze']['refused'];

/** Decodes a PNG image. Throws a RangeError for other files. */
export type DecodePng = (bytes: Uint8Array) => Promise<Pick<ImageData, 'width' | 'height' | 'data'>>;

export interface OwnMap {
  name: string;
  /** Sets the map of a simulation, or throws a MapFileError and changes nothing. */
  apply: (simulation: MapSqueeze) => void;
}

/** Error with one sentence that names the file, the line or field, and what was expected. */
export class MapFileError extends Error {
  sentence: (say: RefusalWords) => string;

  /** Creates the error of a file; the sentence is made when it is shown, in the language of that time. */
  constructor(file: string, sentence: (say: RefusalWords, file: string) => string) {
    super('The map is refused.');
    this.sentence = (say: RefusalWords) => sentence(say, quoteText(file));
  }
}

/** Maximum size of a floor plan, in bytes: a hundred for each allowed wall. */
const MAX_PLAN_BYTES = 2_000_000;

/** Maximum size of a YAML file, in bytes. */
const MAX_YAML_BYTES = 100_000;

/** Maximum length of a plan that the tolerant YAML parser reads: it would take seconds for a longer one. */
const MAX_TOLERANT_LENGTH = 200_000;

/** Maximum number of quoted characters of a name or a value. */
const MAX_QUOTED = 100;

/** First bytes of a PNG image. */
const PNG_MAGIC = [0x89, 0x50, 0x4e, 0x47];

/** Form of a floor plan. */
const PLAN_FORM = '{"bounds": [x0, y0, x1, y1], "walls": [[x0, y0, x1, y1], …]}';

/** Reads the map in files; rejects with a MapFileError. */
export async function readMapFiles(files: File[], decodePng: DecodePng): Promise<OwnMap> {
  const filesNamed = (pattern: RegExp) => files.filter(({ name }) => pattern.test(name));
  const [plans, descriptions, images] = [filesNamed(/\.json$/i), filesNamed(/\.ya?ml$/i), filesNamed(/\.(pgm|png)$/i)];
  const otherFile = files.find((file) => ![...plans, ...descriptions, ...images].includes(file));
  if (otherFile) {
    throw new MapFileError(otherFile.name, (say, name) => say.kind(name));
  }
  const mapCount = plans.length + descriptions.length;
  if (mapCount > 1) {
    const mapNames = [...plans, ...descriptions].map(({ name }) => name).join(', ');
    throw new MapFileError(mapNames, (say, names) => say.several(names, mapCount));
  }
  if (plans.length) return readPlan(plans[0].name, await textOf(plans[0], MAX_PLAN_BYTES));
  if (descriptions.length) return readGrid(descriptions[0], images, decodePng);
  throw new MapFileError(images[0]?.name ?? '', (say, image) => say.alone(image || say.noFile));
}

/** Reads a file, which may have been deleted after it was chosen; throws if it has more than `maxBytes` bytes. */
async function bytesOf(file: File, maxBytes: number) {
  checkSize(file.name, file.size, maxBytes);
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch (error) {
    const reason = error instanceof Error ? error.name : String(error);
    throw new MapFileError(file.name, (say, name) => say.gone(name, reason));
  }
}

const textOf = async (file: File, maxBytes: number) => new TextDecoder().decode(await bytesOf(file, maxBytes));

function checkSize(name: string, size: number, maxBytes: number) {
  if (size > maxBytes) throw new MapFileError(name, (say, file) => say.long(file, size, maxBytes));
}

/** Shortens a text that a sentence quotes. */
function quoteText(text: string) {
  return text.length > MAX_QUOTED ? `${text.slice(0, MAX_QUOTED)}…` : text;
}

/** Reads a floor plan from the JSON of a file; rejects with a MapFileError. */
export async function readPlan(name: string, text: string): Promise<OwnMap> {
  checkSize(name, text.length, MAX_PLAN_BYTES);
  const parsedPlan = await parsePlan(name, text);
  return {
    name,
    apply: (simulation) =>
      applyOrExplain(name, () => simulation.setPlan(parsedPlan ?? null), (say, file, reason) => say.plan(file, reason, PLAN_FORM)),
  };
}

/** Parses a plan. The browser parses JSON fifty times as fast as the YAML library, which also reads slightly invalid JSON. */
async function parsePlan(name: string, text: string) {
  try {
    return JSON.parse(text);
  } catch (error) {
    if (text.length <= MAX_TOLERANT_LENGTH) return parseYamlOrJson(name, text, 'JSON');
    const { message } = error as SyntaxError;
    throw new MapFileError(name, (say, file) => say.syntax(file, 0, 'JSON', quoteText(message), say.planForm(PLAN_FORM)));
  }
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

/**
 * Parses a text with the YAML library, which also reads JSON. The library accepts a trailing comma or a comment in a plan written by hand,
 * and reports the line of a mistake. It is loaded with the first map that needs it.
 */
async function parseYamlOrJson(name: string, text: string, language: 'JSON' | 'YAML') {
  const { YAMLException, parseYaml } = await import('./yaml.ts');
  try {
    return parseYaml(text);
  } catch (error) {
    if (!(error instanceof YAMLException)) throw error;
    const errorLine = error.mark ? error.mark.line + 1 : 0;
    throw new MapFileError(name, (say, file) =>
      say.syntax(file, errorLine, language, quoteText(error.reason), language === 'JSON' ? say.planForm(PLAN_FORM) : say.yamlForm),
    );
  }
}

async function readGrid(file: File, images: File[], decodePng: DecodePng): Promise<OwnMap> {
  const description = await readDescription(file.name, await textOf(file, MAX_YAML_BYTES));
  const { image: path } = description;
  if (typeof path !== 'string' || path === '') {
    throw new MapFileError(file.name, (say, name) => say.image(name, path === undefined ? '' : quoteText(JSON.stringify(path))));
  }
  const imageName = path.slice(Math.max(path.lastIndexOf('/'), path.lastIndexOf('\\')) + 1);
  const image = images.find(({ name }) => name === imageName);
  if (!image) {
    const givenNames = images.map(({ name }) => name).join(', ');
    throw new MapFileError(file.name, (say, name) => say.pair(name, quoteText(imageName), quoteText(givenNames)));
  }
  const bytes = await bytesOf(image, limits.bytes);
  const isPng = PNG_MAGIC.every((byte, i) => byte === bytes[i]);
  const throwPngError = (error: Error) => {
    throw error instanceof RangeError ? new MapFileError(image.name, (say, name) => say.broken(name, error.message)) : error;
  };
  const pixelsOrBytes = isPng ? await decodePng(bytes).catch(throwPngError) : bytes;
  return {
    name: file.name,
    apply: (simulation) =>
      applyOrExplain(
        file.name,
        () => simulation.setGrid(description, pixelsOrBytes),
        (say, name, reason) => gridErrorSentence(say, name, quoteText(image.name), reason),
      ),
  };
}

/** Words for true and false, which are strings in YAML 1.2 and booleans for map_server. */
const BOOLEAN_WORDS = new Map([['true', true], ['yes', true], ['on', true], ['false', false], ['no', false], ['off', false]]);

/** Fields of numbers. map_server also reads numbers in quotes. */
const NUMBER_FIELDS = ['resolution', 'origin', 'negate', 'occupied_thresh', 'free_thresh'];

/** Returns a number in quotes as a number, and other values unchanged. */
function numberFromText(value: unknown): unknown {
  if (Array.isArray(value)) return value.map(numberFromText);
  return typeof value === 'string' && value.trim() !== '' && Number.isFinite(Number(value)) ? Number(value) : value;
}

/** Parses a description as leniently as map_server does. */
async function readDescription(name: string, text: string) {
  // YAML forbids tabs as indentation, and the fields need no indentation.
  const description = await parseYamlOrJson(name, text.replaceAll(/^\t+/gm, '').replaceAll('\t', ' '), 'YAML');
  if (!isObject(description)) throw new MapFileError(name, (say, file) => say.fields(file));
  const yamlFields = { ...description };
  for (const key of NUMBER_FIELDS) if (key in yamlFields) yamlFields[key] = numberFromText(yamlFields[key]);
  const { negate, mode } = yamlFields;
  if (typeof negate === 'string') yamlFields.negate = BOOLEAN_WORDS.get(negate.toLowerCase()) ?? negate;
  if (typeof mode === 'string') yamlFields.mode = mode.toLowerCase();
  return yamlFields;
}

/** Returns the sentence about a grid that the core refuses, with the name of the YAML file or of the image. */
function gridErrorSentence(say: RefusalWords, description: string, image: string, reason: string) {
  const errorLine = /^line (\d+): (.*)$/.exec(reason);
  if (errorLine) return say.line(image, errorLine[1], errorLine[2]);
  return `${reason.startsWith('image') ? image : description}: ${reason}.`;
}

/** Calls the core with the map of a file, and explains why it is refused. */
function applyOrExplain(name: string, take: () => void, sentence: (say: RefusalWords, file: string, reason: string) => string) {
  try {
    take();
  } catch (error) {
    if (!(error instanceof RangeError || error instanceof TypeError)) throw error;
    const reason = error.message.replace(' is undefined;', ' is missing;');
    throw new MapFileError(name, (say, file) => sentence(say, file, reason));
  }
}
