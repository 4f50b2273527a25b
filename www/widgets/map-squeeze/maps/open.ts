/** Opening maps of the user: chosen, dropped or pasted. Shows why the latest one was refused. */

import { instantiate } from '../../../core.ts';
import { words } from '../../../messages/registry.ts';
import { FileOpener } from '../../shared/files.ts';
import type { UserMap } from './files.ts';

/** Extensions of map files. */
export const EXTENSIONS = ['.json', '.yaml', '.yml', '.pgm', '.png'];

/** Size of a file in bytes above which a message is shown while it is read. */
const LARGE_BYTES = 1_000_000;

/** Decodes a PNG image with the whole core, because the core of the figure has no decoder. */
const decodePng: import('./files.ts').DecodePng = async (bytes) => (await instantiate()).readMapImage(bytes);

export class MapOpener extends FileOpener<import('../map-squeeze.ts').MapSqueezeElement> {
  /** Disclosure with the current map and the reason why another one was refused. */
  id = 'more';
  /** True while a large file is being read. */
  isReading = false;

  async choose(files: File[]) {
    if (files.reduce((sum, { size }) => sum + size, 0) > LARGE_BYTES) {
      this.isReading = true;
      this.host.announcer.announce(words.squeeze.own.reading);
      this.host.requestUpdate();
      // Waits for two frames, because the message is on the screen only after the first one was drawn.
      for (let frame = 0; frame < 2; frame++) await new Promise(requestAnimationFrame);
    }
    await this.#open(({ readMapFiles }) => readMapFiles(files, decodePng));
    this.isReading = false;
    this.host.requestUpdate();
  }

  paste(text: string) {
    this.#open(({ readPlan }) => readPlan(words.squeeze.pasted, text));
  }

  #open(readMap: (reader: typeof import('./files.ts')) => UserMap | Promise<UserMap>) {
    return this.runAttempt(async (isLatest) => {
      const map = await readMap(await import('./files.ts'));
      if (isLatest()) this.host.openMap(map);
    });
  }

  explain({ message, sentence }: Error & Partial<import('./files.ts').MapFileError>) {
    const { refused } = words.squeeze;
    return sentence ? sentence(refused) : refused.cannot(message);
  }
}
