// Imports modules of www/ into scripts: Node itself does not run TypeScript.

import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { register } from 'tsx/esm/api';
import { ROOT } from './process.mjs';

register();

/** Imports a module. @param {string} path from the root @returns {Promise<any>} */
export const importTypeScript = (path) => import(pathToFileURL(join(ROOT, path)).href);
