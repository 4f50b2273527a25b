/**
 * Maps of the reader's own: a JSON floor plan, or a pair of files as ROS map_server has them.
 *
 * @module
 */

import { LONGEST_SIDE } from '../ui/canvas.js';

/**
 * @typedef {import('../types.d.ts').MapSqueeze} MapSqueeze
 *
 * @typedef {object} OwnMap
 * @property {string} name
 * @property {(machine: MapSqueeze) => void} apply puts it into a machine; throws a MapFileError, with
 *   the machine's present map left as it is
 */

/** One sentence that names the file, the line or field, and what was expected. */
export class MapFileError extends Error {}

export const EXTENSIONS = ['.json', '.yaml', '.yml', '.pgm', '.png'];

/** What a floor plan looks like. */
const PLAN_FORM = '{"bounds": [x0, y0, x1, y1], "walls": [[x0, y0, x1, y1], …]} in metres';

/** Cells of a map at most, as for the core. */
const MOST_PIXELS = 2 ** 24;

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
    throw new MapFileError(
      `${stranger.name}: this kind of file is not read; expected is a .json floor plan, ` +
        'or a .yaml file together with its .pgm or .png image.',
    );
  }
  const maps = plans.length + descriptions.length;
  if (maps > 1) {
    const names = [...plans, ...descriptions].map(({ name }) => name).join(', ');
    throw new MapFileError(`${names}: these are ${maps} maps; expected is one at a time.`);
  }
  if (plans.length) return readPlan(plans[0].name, await textOf(plans[0]));
  if (descriptions.length) return readGrid(descriptions[0], images);
  const name = images[0]?.name ?? 'No file';
  throw new MapFileError(`${name}: an image alone has no scale; expected is its .yaml file together with it.`);
}

/**
 * What is in a file: it may have gone, or be forbidden, since it was chosen.
 *
 * @param {Blob} part of the file or all of it
 * @param {string} name
 * @returns {Promise<ArrayBuffer>}
 */
async function bytesOf(part, name) {
  try {
    return await part.arrayBuffer();
  } catch (error) {
    const reason = error instanceof Error ? error.name : String(error);
    throw new MapFileError(`${name}: the file cannot be read (${reason}); expected is one that is still there.`);
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
  const plan = await parsed(name, text, 'JSON', PLAN_FORM);
  return {
    name,
    apply: (machine) => {
      try {
        machine.setPlan(plan ?? null);
      } catch (error) {
        throw new MapFileError(`${name}: ${complaint(error)}; a floor plan is ${PLAN_FORM}.`);
      }
    },
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
 * @param {string} expected
 * @returns {Promise<unknown>}
 */
async function parsed(name, text, language, expected) {
  const { YAMLException, load: parseYaml } = await import('./yaml.js');
  try {
    return parseYaml(text);
  } catch (error) {
    if (!(error instanceof YAMLException)) throw error;
    const line = error.mark ? `, line ${error.mark.line + 1}` : '';
    throw new MapFileError(`${name}${line}: this is not ${language} (${error.reason}); expected is ${expected}.`);
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
    throw new MapFileError(`${file.name}: image is ${path === undefined ? 'missing' : JSON.stringify(path)}; expected is the name of a .pgm or .png file.`);
  }
  const wanted = path.split(/[\\/]/).pop();
  const image = images.find(({ name }) => name === wanted);
  if (!image) {
    const given = images.length ? ` (${images.map(({ name }) => name).join(', ')} came instead)` : '';
    throw new MapFileError(`${file.name}: image names ${wanted}, which is not there${given}; expected are both files together.`);
  }
  const pixels = /\.pgm$/i.test(image.name)
    ? new Uint8Array(await bytesOf(image, image.name))
    : await readPng(image);
  return {
    name: file.name,
    apply: (machine) => {
      try {
        machine.setGrid(description, pixels);
      } catch (error) {
        throw new MapFileError(gridComplaint(file.name, image.name, error));
      }
    },
  };
}

/** Truth in words: to the older YAML of map_server they are no strings. */
const WORDS = new Map([['yes', true], ['on', true], ['no', false], ['off', false]]);

/**
 * @param {string} name of the file
 * @param {string} text
 * @returns {Promise<Record<string, unknown>>}
 */
async function readDescription(name, text) {
  const description = await parsed(name, text, 'YAML', 'one field a line, as in resolution: 0.05');
  if (typeof description !== 'object' || description === null || Array.isArray(description)) {
    throw new MapFileError(`${name}: there are no fields in it; expected are at least image, resolution and origin.`);
  }
  const fields = /** @type {Record<string, unknown>} */ (description);
  const { negate } = fields;
  return typeof negate === 'string' ? { ...fields, negate: WORDS.get(negate.toLowerCase()) ?? negate } : fields;
}

/**
 * @param {File} file
 * @returns {Promise<ImageData>}
 */
async function readPng(file) {
  const header = new DataView(await bytesOf(file.slice(0, 24), file.name));
  const isPng = header.byteLength === 24 && header.getUint32(0) === 0x89504e47;
  if (!isPng) throw new MapFileError(`${file.name}: its first bytes are not those of a PNG image; expected is PNG.`);
  // Looked at before it is unpacked: a small file may hold an enormous image.
  const [width, height] = [header.getUint32(16), header.getUint32(20)];
  if (Math.max(width, height) > LONGEST_SIDE || width * height > MOST_PIXELS) {
    throw new MapFileError(
      `${file.name}: width × height is ${width} × ${height}; expected are sides up to ${LONGEST_SIDE} and at most ${MOST_PIXELS} pixels.`,
    );
  }
  try {
    return await decoded(file, width, height);
  } catch {
    throw new MapFileError(`${file.name}: the image data cannot be decoded; expected is a complete PNG image.`);
  }
}

/**
 * The values as they are in the file, not as a screen would show them.
 *
 * @param {File} file
 * @param {number} width
 * @param {number} height
 * @returns {Promise<ImageData>}
 */
async function decoded(file, width, height) {
  const asTheyAre = /** @type {const} */ ({ colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  if ('ImageDecoder' in globalThis) {
    const decoder = new ImageDecoder({ data: await file.arrayBuffer(), type: 'image/png', ...asTheyAre });
    const { image } = await decoder.decode();
    const { format } = image;
    const pixels = new ImageData(width, height);
    const { data } = pixels;
    // In its own format: a conversion would blacken what is fully transparent.
    await image.copyTo(data);
    image.close();
    decoder.close();
    for (let i = 0; i < data.length; i += 4) {
      if (format?.startsWith('B')) [data[i], data[i + 2]] = [data[i + 2], data[i]];
      if (format?.endsWith('X')) data[i + 3] = 255;
    }
    return pixels;
  }
  // A canvas blackens it too.
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
 * @param {string} description name of the YAML file
 * @param {string} image name of the image file
 * @param {unknown} error
 */
function gridComplaint(description, image, error) {
  const text = complaint(error);
  const line = /^line (\d+): (.*)$/.exec(text);
  if (line) return `${image}, line ${line[1]}: ${line[2]}.`;
  if (text.startsWith('image')) return `${image}: ${text}.`;
  if (text.startsWith('walls')) return `${image}: its occupied cells have too many sides: ${text}.`;
  return `${description}: ${text}.`;
}

/** @param {unknown} error of the core, which names a field and what is allowed */
function complaint(error) {
  if (!(error instanceof RangeError || error instanceof TypeError)) throw error;
  return error.message.replace(' is undefined;', ' is missing;');
}
