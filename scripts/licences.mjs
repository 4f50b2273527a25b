// The licences of what others wrote and the bundles carry: who ships them has to name it.

import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { ROOT } from './process.mjs';

/** @typedef {{ name: string, version: string, licence: string, directory: string }} Package */

/** Licence of the standard library, which is no package. A toolchain may be installed without its documents. */
const STANDARD_LIBRARY = 'The standard library of Rust (MIT OR Apache-2.0), copyright The Rust Project contributors: see rust-lang.org.';

/**
 * Returns the crates that are compiled into the module.
 *
 * @param {string} tree by `cargo tree`, a name and a version a line
 * @param {{ packages: any[] }} metadata by `cargo metadata`: of all crates that some target or feature would take
 * @returns {Package[]}
 */
export function cratesOf(tree, { packages }) {
  const listed = new Set(tree.match(/^\S+ v\S+/gm));
  return packages
    .filter(({ name, version, source }) => source !== null && listed.has(`${name} v${version}`))
    .map(({ name, version, license, manifest_path: manifest }) => ({ name, version, licence: license, directory: dirname(manifest) }));
}

/**
 * Returns the npm packages with code in a bundle.
 *
 * @param {Record<string, import('esbuild').Metafile['outputs'][string]>} outputs
 * @returns {Package[]}
 */
export function packagesOf(outputs) {
  const inputs = Object.values(outputs).flatMap(({ inputs }) => Object.keys(inputs).filter((path) => inputs[path].bytesInOutput > 0));
  const directories = inputs.flatMap((path) => path.match(/^.*node_modules\/(?:@[^/]+\/)?[^/]+/) ?? []);
  return [...new Set(directories)].map((path) => {
    const directory = join(ROOT, path);
    const { name, version, license } = JSON.parse(readFileSync(join(directory, 'package.json'), 'utf8'));
    return { name, version, licence: license, directory };
  });
}

/** Returns each licence text once, below the packages that have it. @param {Package[]} packages */
export function licences(packages) {
  /** @type {Map<string, string[]>} */
  const holders = new Map();
  for (const { name, version, licence, directory } of packages) {
    const texts = readdirSync(directory).filter((file) => /^(licen[cs]e|copying)/i.test(file));
    // MIT is the shortest licence of several to choose from.
    const file = texts.find((each) => /mit/i.test(each)) ?? texts[0];
    if (file === undefined) throw new Error(`${name} ${version} (${licence}) comes without the text of its licence.`);
    const text = readFileSync(join(directory, file), 'utf8').replaceAll('\r', '').trim();
    holders.set(text, [...(holders.get(text) ?? []), `${name} ${version} (${licence})`]);
  }
  const parts = [...holders].map(([text, names]) => [names.sort().join('\n'), text]);
  const listed = parts.sort(([a], [b]) => (a < b ? -1 : 1)).map((part) => part.join('\n\n'));
  return `${['The bundles of motion-widgets carry parts of these works.', STANDARD_LIBRARY, ...listed].join(`\n\n${'-'.repeat(72)}\n\n`)}\n`;
}
