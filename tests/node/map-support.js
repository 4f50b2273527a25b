// Helpers for tests that open map files: files as a browser gives them, and the result of reading them.

import { load } from '../../dist/core.js';
import { de } from '../../www/widgets/map-squeeze/de.ts';
import { en } from '../../www/widgets/map-squeeze/en.ts';
import { MapFileError, readMapFiles } from '../../www/widgets/map-squeeze/maps/files.ts';

const motion = await load();

const decodePng = async (/** @type {Uint8Array} */ bytes) => motion.readMapImage(bytes);

/** Returns a file with these contents. @param {string} name @param {BlobPart} contents */
export const fileWith = (name, contents) => new File([contents], name);

/** Returns the YAML file that describes an image, with fields replaced or added. @param {Record<string, unknown>} [fields] */
export function mapYamlFile(fields) {
  const allFields = { image: 'map.png', resolution: 0.05, origin: '[0, 0, 0]', ...fields };
  return fileWith('map.yaml', Object.entries(allFields).map(([key, value]) => `${key}: ${value}\n`).join(''));
}

/** Returns a simulation with the map of some files. @param {File[]} files */
export async function simulationWithMap(...files) {
  const simulation = new motion.MapSqueeze({ samples: 1 });
  (await readMapFiles(files, decodePng)).apply(simulation);
  return simulation;
}

/** Simulation to which the maps of `catchRefusalMessage` are applied, one after the other. */
const trialSimulation = new motion.MapSqueeze({ samples: 1 });

/**
 * Returns the message with which files are refused, or an empty text. Other errors are rethrown.
 *
 * @param {File[]} files
 * @param {'en' | 'de'} [language]
 */
export async function catchRefusalMessage(files, language = 'en') {
  try {
    (await readMapFiles(files, decodePng)).apply(trialSimulation);
  } catch (error) {
    if (error instanceof MapFileError) return error.sentence({ en, de }[language].refused);
    throw error;
  }
  return '';
}
