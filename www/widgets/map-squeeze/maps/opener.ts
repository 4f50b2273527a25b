/** Opener of the user's maps, which are chosen, dropped or pasted, with its controls. */

import { html } from 'lit';
import { instantiate } from '../../../core.ts';
import { words } from '../../../messages/registry.ts';
import { buttonHtml, fieldsetHtml } from '../../../ui/controls.ts';
import { FileOpener } from '../../shared/files.ts';
import type { MapSqueezeElement } from '../map-squeeze.ts';
import type { DecodePng, UserMap } from './files.ts';

/** Example of a floor plan: a room that is divided by a wall with a gap. */
const EXAMPLE_PLAN = `{
  "bounds": [0, 0, 6, 4],
  "walls": [
    [3, 0, 3, 1.5], [3, 2.5, 3, 4],
    [0, 0, 6, 0], [6, 0, 6, 4],
    [6, 4, 0, 4], [0, 4, 0, 0]
  ]
}`;

const MAP_FILE_EXTENSIONS = ['.json', '.yaml', '.yml', '.pgm', '.png'];

/** Total size of map files (bytes) above which a notice is shown while the files are read. */
const LARGE_MAP_BYTES = 1_000_000;

/** Decodes a PNG image with the core for all widgets, because the smaller core for this widget has no decoder. */
const decodePng: DecodePng = async (bytes) => (await instantiate()).readMapImage(bytes);

/** Opener of map files and pasted plans. If it refuses a map, it shows the reason. */
export class MapOpener extends FileOpener<MapSqueezeElement> {
  /** Id of the disclosure that shows the current map, and the reason why a new map was refused. */
  resultElementId = 'more';

  async chooseFiles(files: File[]) {
    if (files.reduce((sum, { size }) => sum + size, 0) > LARGE_MAP_BYTES) {
      this.figure.notice.showNotice(() => words.squeeze.userMap.readingNotice);
      // Waits for two frames, because the notice is visible only after the first frame has been drawn.
      for (let frameIndex = 0; frameIndex < 2; frameIndex++) await new Promise(requestAnimationFrame);
    }
    await this.#readAndEnter(({ readMapFiles }) => readMapFiles(files, decodePng, words.squeeze.refusals));
    this.figure.notice.dismissNotice();
  }

  openPasted(planJson: string) {
    this.#readAndEnter(({ readPlan }) => readPlan(words.squeeze.pastedMapName, planJson, words.squeeze.refusals));
  }

  #readAndEnter(readMap: (mapReader: typeof import('./files.ts')) => UserMap | Promise<UserMap>) {
    return this.runAttempt(async (isLatest) => {
      const map = await readMap(await import('./files.ts'));
      if (isLatest()) this.figure.openMap(map);
    });
  }

  explainRefusal({ name, message }: Error) {
    return name === 'MapFileError' ? message : words.squeeze.refusals.cannotOpenSentence(message);
  }
}

/** Returns the controls for a map of the user's own, with the name and size of the present map. */
export function userMapControlsHtml(figure: MapSqueezeElement, opener: MapOpener, mapText: string) {
  const texts = words.squeeze.userMap;
  const pasteMap = () => opener.openPasted((figure.renderRoot.querySelector('#map-text') as HTMLTextAreaElement).value);
  return fieldsetHtml(texts.title, html`<div class="own-map figures">
    <div>
      <p>${texts.instructionsText}</p>
      <p>${opener.fileButtonHtml('map-files', texts.chooseFilesLabel, MAP_FILE_EXTENSIONS)}</p>
      ${opener.refusalNoteHtml}
      <p class="present muted">${mapText}.</p>
    </div>
    <div>
      <label for="map-text">${texts.planFieldLabel}</label>
      <textarea id="map-text" rows="8" spellcheck="false" autocomplete="off" .defaultValue=${EXAMPLE_PLAN}></textarea>
      ${buttonHtml(texts.usePlanLabel, pasteMap)}
    </div>
  </div>`);
}
