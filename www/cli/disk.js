/** A file on a disk, read where it is asked for. */

import { open } from 'node:fs/promises';
import { basename } from 'node:path';
import { LogError } from '../widgets/alpha-calibrator/log/refusal.js';

/** @import { Source } from '../widgets/alpha-calibrator/log/refusal.js' */

/**
 * @param {string} path
 * @returns {Promise<Source & { close(): Promise<void> }>} rejects with a LogError where there is no such file
 */
export async function onDisk(path) {
  const name = basename(path);
  try {
    const file = await open(path);
    const stat = await file.stat();
    if (!stat.isFile()) {
      await file.close();
      throw Object.assign(new Error(), { code: 'no file' });
    }
    return {
      name,
      size: stat.size,
      slice: (from, to) => ({
        async arrayBuffer() {
          const bytes = new Uint8Array(Math.max(to - from, 0));
          const { bytesRead } = await file.read(bytes, 0, bytes.length, from);
          return bytesRead === bytes.length ? bytes.buffer : bytes.buffer.slice(0, bytesRead);
        },
      }),
      close: () => file.close(),
    };
  } catch (error) {
    const { code } = /** @type {NodeJS.ErrnoException} */ (error);
    throw new LogError({ file: name }, (say) => say.gone(String(code)));
  }
}
