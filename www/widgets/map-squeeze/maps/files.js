/** Maps of the reader's own: a JSON floor plan, or a pair of files as ROS map_server has them. */

import { LONGEST_SIDE } from '../../../scene/canvas.js';
import { limits } from '../../../settings.js';

/**
 * @import { MapSqueeze } from '../../../types.d.ts'
 *
 * @typedef {import('../../../messages/registry.js').Messages['squeeze']['refused']} Refused
 *
 * @typedef {object} OwnMap
 * @property {string} name
 * @property {(machine: MapSqueeze) => void} apply puts it into a machine; throws a MapFileError, with
 *   the machine's present map left as it is
 */

/** One sentence that names the file, the line or field, and what was expected. */
export class MapFileError extends Error {
  /** @param {(say: Refused) => string} sentence in the words of the time when it is shown */
  constructor(sentence) {
    super('The map is refused.');
    this.sentence = sentence;
  }
}

/** What a floor plan looks like. */
const PLAN_FORM = '{"bounds": [x0, y0, x1, y1], "walls": [[x0, y0, x1, y1], …]}';

/**
 * The map that files hold.
 *
 * @param {File[]} files
 * @returns {Promise<OwnMap>}
 * @throws {MapFileError}
 */
export async function readMapFiles(files) {
  const named = (/** @type {RegExp} */ pattern) => files.filter(({ name }) => pattern.test(name));
  const [plans, descriptions, images] = [named(/\.json$/i), named(/\.ya?ml$/i), named(/\.(pgm|png)$/i)];
  const stranger = files.find((file) => ![...plans, ...descriptions, ...images].includes(file));
  if (stranger) {
    throw new MapFileError((say) => say.kind(stranger.name));
  }
  const maps = plans.length + descriptions.length;
  if (maps > 1) {
    const names = [...plans, ...descriptions].map(({ name }) => name).join(', ');
    throw new MapFileError((say) => say.several(names, maps));
  }
  if (plans.length) return readPlan(plans[0].name, await textOf(plans[0]));
  if (descriptions.length) return readGrid(descriptions[0], images);
  throw new MapFileError((say) => say.alone(images[0]?.name ?? say.noFile));
}

/**
 * What is in a file: it may have gone, or be forbidden, since it was chosen.
 *
 * @param {Blob} part of the file or all of it
 * @param {string} name
 */
async function bytesOf(part, name) {
  try {
    return await part.arrayBuffer();
  } catch (error) {
    const reason = error instanceof Error ? error.name : String(error);
    throw new MapFileError((say) => say.gone(name, reason));
  }
}

/** @param {File} file */
async function textOf(file) {
  return new TextDecoder().decode(await bytesOf(file, file.name));
}

/**
 * A floor plan from JSON.
 *
 * @param {string} name of the file
 * @param {string} text
 * @returns {Promise<OwnMap>}
 * @throws {MapFileError}
 */
export async function readPlan(name, text) {
  const plan = await parsed(name, text, 'JSON');
  return {
    name,
    apply: (machine) =>
      retold(() => machine.setPlan(plan ?? null), (say, reason) => say.plan(name, reason, PLAN_FORM)),
  };
}

/**
 * What a text says. JSON is YAML too: the one parser forgives a trailing comma or a comment in a plan
 * written by hand, and knows the line of a mistake, which JSON.parse says in some browsers only. It is
 * as long as both widgets together, and loaded when the first map is opened.
 *
 * @param {string} name of the file
 * @param {string} text
 * @param {'JSON' | 'YAML'} language
 */
async function parsed(name, text, language) {
  const { YAMLException, load: parseYaml } = await import('./yaml.js');
  try {
    return parseYaml(text);
  } catch (error) {
    if (!(error instanceof YAMLException)) throw error;
    const line = error.mark ? error.mark.line + 1 : 0;
    throw new MapFileError((say) =>
      say.syntax(name, line, language, error.reason, language === 'JSON' ? say.planForm(PLAN_FORM) : say.yamlForm),
    );
  }
}

/**
 * @param {File} file YAML
 * @param {File[]} images
 * @returns {Promise<OwnMap>}
 */
async function readGrid(file, images) {
  const description = await readDescription(file.name, await textOf(file));
  const { image: path } = description;
  if (typeof path !== 'string' || path === '') {
    throw new MapFileError((say) => say.image(file.name, path === undefined ? '' : JSON.stringify(path)));
  }
  const wanted = path.split(/[\\/]/).pop();
  const image = images.find(({ name }) => name === wanted);
  if (!image) {
    const given = images.map(({ name }) => name).join(', ');
    throw new MapFileError((say) => say.pair(file.name, wanted, given));
  }
  const pixels = /\.pgm$/i.test(image.name)
    ? new Uint8Array(await bytesOf(image, image.name))
    : await readPng(image);
  return {
    name: file.name,
    apply: (machine) =>
      retold(
        () => machine.setGrid(description, pixels),
        (say, reason) => gridComplaint(say, file.name, image.name, reason),
      ),
  };
}

/** Truth in words: to the older YAML of map_server they are no strings. */
const WORDS = new Map([['yes', true], ['on', true], ['no', false], ['off', false]]);

/**
 * @param {string} name of the file
 * @param {string} text
 */
async function readDescription(name, text) {
  const description = await parsed(name, text, 'YAML');
  if (typeof description !== 'object' || description === null || Array.isArray(description)) {
    throw new MapFileError((say) => say.fields(name));
  }
  const fields = /** @type {Record<string, unknown>} */ (description);
  const { negate } = fields;
  return typeof negate === 'string' ? { ...fields, negate: WORDS.get(negate.toLowerCase()) ?? negate } : fields;
}

/** @param {File} file */
async function readPng(file) {
  const header = new DataView(await bytesOf(file.slice(0, 24), file.name));
  const isPng = header.byteLength === 24 && header.getUint32(0) === 0x89504e47;
  if (!isPng) throw new MapFileError((say) => say.noPng(file.name));
  // Before the image is unpacked: a small file may hold an enormous one.
  const [width, height] = [header.getUint32(16), header.getUint32(20)];
  if (Math.max(width, height) > LONGEST_SIDE || width * height > limits.cells) {
    throw new MapFileError((say) => say.large(file.name, `${width} × ${height}`, LONGEST_SIDE, limits.cells));
  }
  try {
    return await decoded(file, width, height);
  } catch {
    throw new MapFileError((say) => say.broken(file.name));
  }
}

/**
 * The values as they are in the file, not as a screen would show them.
 *
 * @param {File} file
 * @param {number} width
 * @param {number} height
 */
async function decoded(file, width, height) {
  const asTheyAre = /** @type {const} */ ({ colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  if ('ImageDecoder' in globalThis) {
    const decoder = new ImageDecoder({ data: await file.arrayBuffer(), type: 'image/png', ...asTheyAre });
    const { image } = await decoder.decode();
    const { format } = image;
    const pixels = new ImageData(width, height);
    const { data } = pixels;
    // In the image's own format: a conversion would blacken what is fully transparent.
    await image.copyTo(data);
    image.close();
    decoder.close();
    for (let i = 0; i < data.length; i += 4) {
      if (format?.startsWith('B')) [data[i], data[i + 2]] = [data[i + 2], data[i]];
      if (format?.endsWith('X')) data[i + 3] = 255;
    }
    return pixels;
  }
  // Other browsers have a canvas only, which blackens what is fully transparent.
  const bitmap = await createImageBitmap(file, asTheyAre);
  const canvas = new OffscreenCanvas(width, height);
  const context = /** @type {OffscreenCanvasRenderingContext2D} */ (
    canvas.getContext('2d', { willReadFrequently: true })
  );
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return context.getImageData(0, 0, width, height);
}

/**
 * @param {Refused} say
 * @param {string} description name of the YAML file
 * @param {string} image name of the image file
 * @param {string} reason
 */
function gridComplaint(say, description, image, reason) {
  const line = /^line (\d+): (.*)$/.exec(reason);
  if (line) return say.line(image, line[1], line[2]);
  if (reason.startsWith('image')) return `${image}: ${reason}.`;
  return reason.startsWith('walls') ? say.cells(image, reason) : `${description}: ${reason}.`;
}

/**
 * @param {() => void} apply what the core may refuse: it names a field and what is allowed
 * @param {(say: Refused, reason: string) => string} sentence
 */
function retold(apply, sentence) {
  try {
    apply();
  } catch (error) {
    if (!(error instanceof RangeError || error instanceof TypeError)) throw error;
    const reason = error.message.replace(' is undefined;', ' is missing;');
    throw new MapFileError((say) => sentence(say, reason));
  }
}
