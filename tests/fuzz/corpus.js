/** The inputs of a target: those that are written with it, and those that fuzzing found worth keeping. */

import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const ROOT = fileURLToPath(new URL('../..', import.meta.url));

/** What is committed, and what is found. */
const [KEPT, FOUND] = ['tests/fuzz/corpus', 'build/fuzz'].map((folder) => join(ROOT, folder));

/** @param {string} folder */
const filesOf = (folder) => (existsSync(folder) ? readdirSync(folder).sort() : []).map((name) => readFileSync(join(folder, name)));

/** @param {string} target */
export const keptOf = (target) => filesOf(join(KEPT, target));

/** @param {string} target @param {Uint8Array} bytes */
export function keep(target, bytes) {
  const folder = join(FOUND, target);
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, createHash('sha1').update(bytes).digest('hex')), bytes);
}
