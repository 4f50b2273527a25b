// Helpers for tests that open map files: files as a browser gives them, and the result of reading them.

import { load } from '../../dist/core.js';
import { de } from '../../www/widgets/map-squeeze/de.ts';
import { en } from '../../www/widgets/map-squeeze/en.ts';
import { MapFileError, readMapFiles } from '../../www/widgets/map-squeeze/maps/files.ts';

const motionCore = await load();

const decodePng = async (/** @type {Uint8Array} */ pngBytes) => motionCore.readMapImage(pngBytes);

/** Returns a file with a name and contents. @param {string} fileName @param {BlobPart} fileContents */
export const createFile = (fileName, fileContents) => new File([fileContents], fileName);

/** Returns the YAML file that describes an image, with fields replaced or added. @param {Record<string, unknown>} [changedFields] */
export function createMapYamlFile(changedFields) {
  const allFields = { image: 'map.png', resolution: 0.05, origin: '[0, 0, 0]', ...changedFields };
  return createFile('map.yaml', Object.entries(allFields).map(([fieldName, fieldValue]) => `${fieldName}: ${fieldValue}\n`).join(''));
}

/** Returns a simulation with the map that is read from files. @param {File[]} mapFiles */
export async function createSimulationWithMap(...mapFiles) {
  const simulation = new motionCore.MapSqueeze({ samples: 1 });
  (await readMapFiles(mapFiles, decodePng, en.refusals)).applyTo(simulation);
  return simulation;
}

/** Simulation to which `catchRefusalMessage` applies one map after the other. */
const trialSimulation = new motionCore.MapSqueeze({ samples: 1 });

/** Returns the message with which map files are refused, or an empty text. Other errors are rethrown. @param {File[]} mapFiles @param {'en' | 'de'} [language] */
export async function catchRefusalMessage(mapFiles, language = 'en') {
  try {
    (await readMapFiles(mapFiles, decodePng, { en, de }[language].refusals)).applyTo(trialSimulation);
  } catch (error) {
    if (error instanceof MapFileError) return error.message;
    throw error;
  }
  return '';
}
