// Imports modules of www/ into scripts. Node itself does not run TypeScript.

import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { register } from 'tsx/esm/api';
import { ROOT } from './process.mjs';

register();

/** Imports a TypeScript module of www/. @param {string} repositoryPath from the root @returns {Promise<any>} */
export const importTypeScript = (repositoryPath) => import(pathToFileURL(join(ROOT, repositoryPath)).href);
