// Licences of the packages and crates whose code is in the bundles. Anyone who distributes the bundles has to include them.

import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { REPOSITORY_ROOT } from './process.mjs';

/** @typedef {{ name: string, version: string, licence: string, directory: string }} Package */

/** Licence notice of Rust's standard library, which is not a package. Some toolchains lack the library's licence files. */
const STANDARD_LIBRARY_NOTICE = 'The standard library of Rust (MIT OR Apache-2.0), copyright The Rust Project contributors: see rust-lang.org.';

/**
 * Returns the crates that are compiled into the module.
 *
 * @param {string} crateTree output of `cargo tree`, with a name and a version in each line
 * @param {{ packages: any[] }} metadata output of `cargo metadata`, with all crates that any target or feature would need
 * @returns {Package[]}
 */
export function listCrates(crateTree, { packages: listedPackages }) {
  const crateLines = new Set(crateTree.match(/^\S+ v\S+/gm));
  return listedPackages
    .filter(({ name: packageName, version: packageVersion, source }) => source !== null && crateLines.has(`${packageName} v${packageVersion}`))
    .map(({ name: packageName, version: packageVersion, license, manifest_path: manifest }) => ({ name: packageName, version: packageVersion, licence: license, directory: dirname(manifest) }));
}

/**
 * Returns the npm packages with code in a bundle.
 *
 * @param {Record<string, import('esbuild').Metafile['outputs'][string]>} bundleOutputs
 * @returns {Package[]}
 */
export function listBundledPackages(bundleOutputs) {
  const bundledFiles = Object.values(bundleOutputs).flatMap(({ inputs }) => Object.keys(inputs).filter((inputPath) => inputs[inputPath].bytesInOutput > 0));
  const packageDirectories = bundledFiles.flatMap((bundledFile) => bundledFile.match(/^.*node_modules\/(?:@[^/]+\/)?[^/]+/) ?? []);
  return [...new Set(packageDirectories)].map((directoryPath) => {
    const packageDirectory = join(REPOSITORY_ROOT, directoryPath);
    const { name: packageName, version: packageVersion, license } = JSON.parse(readFileSync(join(packageDirectory, 'package.json'), 'utf8'));
    return { name: packageName, version: packageVersion, licence: license, directory: packageDirectory };
  });
}

/** Returns each licence text once, below the names of the packages that have this licence. @param {Package[]} listedPackages */
export function readLicenceTexts(listedPackages) {
  /** @type {Map<string, string[]>} */
  const packagesByText = new Map();
  for (const { name: packageName, version: packageVersion, licence: packageLicence, directory: packageDirectory } of listedPackages) {
    const licenceFiles = readdirSync(packageDirectory).filter((fileName) => /^(licen[cs]e|copying)/i.test(fileName));
    // From the licences that a package offers, MIT is chosen, because its text is the shortest.
    const licenceFile = licenceFiles.find((licenceFileName) => /mit/i.test(licenceFileName)) ?? licenceFiles[0];
    if (licenceFile === undefined) throw new Error(`${packageName} ${packageVersion} (${packageLicence}) comes without the text of its licence.`);
    const licenceText = readFileSync(join(packageDirectory, licenceFile), 'utf8').replaceAll('\r', '').trim();
    packagesByText.set(licenceText, [...(packagesByText.get(licenceText) ?? []), `${packageName} ${packageVersion} (${packageLicence})`]);
  }
  const licenceSections = [...packagesByText].map(([licenceText, packageNames]) => [packageNames.sort().join('\n'), licenceText]);
  const sectionTexts = licenceSections.sort(([a], [b]) => (a < b ? -1 : 1)).map((namesAndText) => namesAndText.join('\n\n'));
  return `${['The bundles of motion-widgets carry parts of these works.', STANDARD_LIBRARY_NOTICE, ...sectionTexts].join(`\n\n${'-'.repeat(72)}\n\n`)}\n`;
}
