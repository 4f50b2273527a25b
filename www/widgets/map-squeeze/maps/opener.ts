/** Opener of maps of the user: chosen, dropped or pasted; and its controls. */

import { html } from 'lit';
import { instantiate } from '../../../core.ts';
import { words } from '../../../messages/registry.ts';
import { buttonHtml, fieldsetHtml } from '../../../ui/controls.ts';
import { FileOpener } from '../../shared/files.ts';
import type { MapSqueezeElement } from '../map-squeeze.ts';
import type { DecodePng, UserMap } from './files.ts';

/** Example of a floor plan: a room with a gap in its wall. */
const EXAMPLE_PLAN = `{
  "bounds": [0, 0, 6, 4],
  "walls": [
    [3, 0, 3, 1.5], [3, 2.5, 3, 4],
    [0, 0, 6, 0], [6, 0, 6, 4],
    [6, 4, 0, 4], [0, 4, 0, 0]
  ]
}`;

/** Extensions of map files. */
const MAP_FILE_EXTENSIONS = ['.json', '.yaml', '.yml', '.pgm', '.png'];

/** Size of map files in bytes above which a message is shown while it is read. */
const LARGE_MAP_BYTES = 1_000_000;

/** Decodes a PNG image with the whole core, because the core of the figure has no decoder. */
const decodePng: DecodePng = async (bytes) => (await instantiate()).readMapImage(bytes);

/** Opener of maps. Shows why the latest one was refused. */
export class MapOpener extends FileOpener<MapSqueezeElement> {
  /** Disclosure with the current map and the reason why another one was refused. */
  id = 'more';

  async chooseFiles(files: File[]) {
    if (files.reduce((sum, { size }) => sum + size, 0) > LARGE_MAP_BYTES) {
      this.host.notice.show(() => words.squeeze.own.reading);
      // Waits for two frames, because the message is on the screen only after the first one was drawn.
      for (let frame = 0; frame < 2; frame++) await new Promise(requestAnimationFrame);
    }
    await this.#readAndEnter(({ readMapFiles }) => readMapFiles(files, decodePng, words.squeeze.refused));
    this.host.notice.dismiss();
  }

  openPasted(text: string) {
    this.#readAndEnter(({ readPlan }) => readPlan(words.squeeze.pasted, text, words.squeeze.refused));
  }

  #readAndEnter(readMap: (reader: typeof import('./files.ts')) => UserMap | Promise<UserMap>) {
    return this.runAttempt(async (isLatest) => {
      const map = await readMap(await import('./files.ts'));
      if (isLatest()) this.host.openMap(map);
    });
  }

  explainRefusal({ name, message }: Error) {
    return name === 'MapFileError' ? message : words.squeeze.refused.cannot(message);
  }
}

/** Returns the controls for a map of the user's own, with the name and size of the present map. */
export function userMapControlsHtml(figure: MapSqueezeElement, opener: MapOpener, mapText: string) {
  const texts = words.squeeze.own;
  const pasteMap = () => opener.openPasted((figure.renderRoot.querySelector('#map-text') as HTMLTextAreaElement).value);
  return fieldsetHtml(texts.legend, html`<div class="own-map figures">
    <div>
      <p>${texts.text}</p>
      <p>${opener.fileButtonHtml('map-files', texts.files, MAP_FILE_EXTENSIONS)}</p>
      ${opener.refusalNoteHtml}
      <p class="present muted">${mapText}.</p>
    </div>
    <div>
      <label for="map-text">${texts.plan}</label>
      <textarea id="map-text" rows="8" spellcheck="false" autocomplete="off" .defaultValue=${EXAMPLE_PLAN}></textarea>
      ${buttonHtml(texts.use, pasteMap)}
    </div>
  </div>`);
}
