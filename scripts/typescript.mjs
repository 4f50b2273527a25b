// Imports modules of www/ into scripts: Node itself does not run TypeScript.

import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { once, ROOT } from './process.mjs';

/** Installs the loader. A bare clone has it only after the packages are installed. */
const registerLoader = once(async () => (await import('tsx/esm/api')).register());

/** Imports a module. @param {string} path from the root @returns {Promise<any>} */
export async function importTypeScript(path) {
  await registerLoader();
  return import(pathToFileURL(join(ROOT, path)).href);
}
