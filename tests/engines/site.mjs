/**
 * Builds a copy of the page of `npm start` with two more scripts: one records errors, the other has functions that tests call.
 *
 * @module
 */

import { mkdtempSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { ROOT } from '../../scripts/process.mjs';
import { serve } from '../../scripts/serve.mjs';

const PAGE = 'index.html';
const LISTENING = '<script src="/tests/engines/listen.js"></script>';

/** @returns {Promise<{ address: string, stop: () => void }>} */
export async function site() {
  const directory = mkdtempSync(join(tmpdir(), 'motion-engines-'));
  for (const name of readdirSync(join(ROOT, 'dist'))) if (name !== PAGE) symlinkSync(join(ROOT, 'dist', name), join(directory, name));
  symlinkSync(join(ROOT, 'tests'), join(directory, 'tests'));
  writeFileSync(join(directory, PAGE), readFileSync(join(ROOT, 'dist', PAGE), 'utf8').replace('<head>', `<head>${LISTENING}`));
  const { address, close } = await serve(directory, { port: 0 });
  return {
    address,
    stop() {
      close();
      rmSync(directory, { recursive: true });
    },
  };
}
