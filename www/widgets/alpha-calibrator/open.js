/** Logs of the reader's own: chosen or dropped, and read. */

import { html, nothing } from 'lit';
import { Part } from '../../figure/part.js';
import { language, words } from '../../messages/registry.js';
import { button, inputOf } from '../../ui/controls.js';
import { FileDrop, fileInput } from '../shared/files.js';
import { referenceNoise } from './controls.js';

/**
 * @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure
 * @typedef {import('../../logs/log-error.js').LogError} LogError
 * @typedef {import('../../logs/log.ts').Poses} Poses
 * @typedef {import('../../logs/log.ts').Recording} Recording
 * @typedef {import('../../logs/log.ts').Series} Series
 * @typedef {import('../../types.d.ts').CalibrationLog} CalibrationLog
 * @typedef {Awaited<ReturnType<typeof loadReader>>} Reader
 * @typedef {{ onProgress: (share: number) => void, signal: AbortSignal }} Watched
 *
 * @typedef {object} Chosen recording with its topics, or two tables without
 * @property {Recording[]} files
 * @property {Series[]} topics
 * @property {string} odometry topic; empty where it is ambiguous
 * @property {string} reference topic; empty where it is ambiguous
 * @property {typeof FRAMES} frames of topics of transforms
 * @property {'commands' | undefined} kind of odometry that the model wanted when it was read
 * @property {boolean} isExplicit whether the reader chose the topic of the odometry
 */

/** Extensions that the file dialog offers. */
const EXTENSIONS = ['.csv', '.txt', '.tum', '.mcap'];

/** Id of the drop zone. */
const ZONE = 'log';

/** Usual frames of a topic of transforms: parent and child. */
const FRAMES = { odometry: 'odom, base_link', reference: 'map, base_link' };

/**
 * Progress of one part of the reading, which throws once it is cancelled.
 *
 * @param {Watched} watching
 * @param {number} from
 * @param {number} to
 * @returns {(share: number) => void}
 */
const partOf = ({ onProgress, signal }, from, to) => (share) => {
  signal.throwIfAborted();
  onProgress(from + share * (to - from));
};

/** @extends {Part<Figure>} */
export class LogOpener extends Part {
  dropped = new FileDrop(this.host, ZONE, (files) => this.choose(files));
  /** Why the latest log was refused. @type {(() => string) | undefined} */
  #complaint;
  /** Summary of the present log. @type {(() => string[]) | undefined} */
  #found;
  /** Files and topics of the latest log. @type {Chosen | undefined} */
  chosen;
  /**
   * Log that was opened last, and whether its table has poses and commands.
   *
   * @type {{ chosen: Chosen, log: CalibrationLog, hasBoth: boolean } | undefined}
   */
  #opened;
  /** Share of the file that has been read; undefined while none is being read. @type {number | undefined} */
  share;
  /** Cancels the reading. */
  #stopping = new AbortController();

  /** Why the latest log was refused; empty where it was not. */
  get complaint() {
    return this.#complaint?.() ?? '';
  }

  /** Sentences about the present log: decisions, and rows that were left out. */
  get found() {
    return this.#found?.() ?? [];
  }

  /** Odometry that the model prefers where a log has both: the velocity model takes commands. */
  /** @returns {'commands' | undefined} */
  get #kind() {
    return this.host.reading.config.model === 'velocity' ? 'commands' : undefined;
  }

  /** Reads the files again where another model prefers another odometry of them. */
  hostUpdated() {
    if (!this.#opened || this.share !== undefined) return;
    const { chosen, log, hasBoth } = this.#opened;
    if (chosen !== this.chosen || log !== this.host.log || chosen.kind === this.#kind) return;
    chosen.kind = this.#kind;
    this.#attempt(async (reader, watching) => {
      const { odometry } = reader.guessSeries(chosen.topics, chosen.kind);
      const isOther = odometry !== null && odometry !== chosen.odometry && !chosen.isExplicit;
      if (isOther) chosen.odometry = odometry;
      if (isOther || hasBoth) await this.#read(chosen, reader, watching);
    });
  }

  /** Returns to the simulated log. */
  leave() {
    this.#stopping.abort();
    this.share = this.chosen = this.#complaint = this.#found = undefined;
    this.host.open(null);
  }

  /** Stops reading. */
  stop() {
    this.#stopping.abort();
    this.share = undefined;
    this.#complaint = () => words.progress.stopped;
    this.host.requestUpdate();
  }

  /** @param {File[]} files */
  choose(files) {
    if (files.length === 0) return;
    this.chosen = undefined;
    this.#attempt(async (reader, watching) => {
      const recordings = await reader.openRecordings(files);
      const [{ name, series }, second] = recordings;
      const areTables = recordings.map(isTable);
      if (second ? files.length > 2 || areTables.includes(false) : areTables[0]) throw new Error(words.calibrator.own.two(files.length));
      const topics = second ? [] : reader.usefulSeries(name, series);
      const kind = this.#kind;
      const guess = reader.guessSeries(topics, kind);
      const chosen = {
        files: second && reader.areSwapped(name, second.name) ? recordings.toReversed() : recordings,
        topics,
        odometry: guess.odometry ?? '',
        reference: guess.reference ?? '',
        frames: FRAMES,
        kind,
        isExplicit: false,
      };
      this.chosen = chosen;
      const role = guess.odometry === null ? 'odometry' : 'reference';
      if (!second && guess[role] === null) throw reader.ambiguousSeries(name, topics, role);
      await this.#read(chosen, reader, watching);
    });
  }

  /** Takes a choice of the reader. @param {Partial<Chosen>} change */
  change(change) {
    if (!this.chosen) return;
    const chosen = { ...this.chosen, ...change, isExplicit: this.chosen.isExplicit || change.odometry !== undefined };
    this.chosen = chosen;
    this.host.requestUpdate();
    if (chosen.topics.length > 0 && !(chosen.odometry && chosen.reference)) return;
    this.#attempt((reader, watching) => this.#read(chosen, reader, watching));
  }

  /**
   * @param {Chosen} chosen
   * @param {Reader} reader
   * @param {Watched} watching
   */
  async #read(chosen, reader, watching) {
    const { files, topics, odometry, reference, frames, kind } = chosen;
    const choice = (/** @type {string} */ topic, /** @type {string} */ its) => {
      const [parent, child = ''] = its.split(',').map((frame) => frame.trim());
      return { series: topic, ...(holdsTransforms(topics, topic) && { frames: { parent, child } }) };
    };
    const [first, second] = topics.length
      ? await files[0].read([choice(odometry, frames.odometry), choice(reference, frames.reference)], partOf(watching, this.share ?? 0, 1))
      : [
          ...(await files[0].read([{ series: '', kind }], partOf(watching, 0, 0.5))),
          ...(await files[1].read([{ series: '', kind: 'poses' }], partOf(watching, 0.5, 1))),
        ];
    const paired = reader.pairLogs(first, second);
    const name = [...new Set(files.map((file) => file.name)), ...(topics.length ? [reference] : [])].join(', ');
    const log = { name, odometry: paired.odometry.data, reference: /** @type {Poses} */ (paired.reference.data) };
    const say = await wordsOf();
    watching.signal.throwIfAborted();
    this.host.open(log, () => {
      this.#opened = { chosen, log, hasBoth: !topics.length && files[0].series[0].hasCommands === true };
      const logs = [paired.odometry, paired.reference];
      this.#found = () => logs.map((each) => `${each.name}: ${reader.summarize(each, say().found).join(' ')}`);
    }, (error) => this.#refuse(error));
  }

  /** Shows why a log was refused. @param {unknown} error */
  async #refuse(error) {
    const { message, sentence } = /** @type {Error & Partial<LogError>} */ (error);
    const say = sentence && (await wordsOf());
    this.#complaint = () => (say ? sentence(say()) : words.calibrator.own.refused(message));
    this.host.requestUpdate();
    await this.dropped.showRefusal(this.complaint);
  }

  /**
   * Loads the reader of logs, cancels a reading that is under way, and starts another.
   *
   * @param {(reader: Reader, watching: Watched) => Promise<void>} work
   */
  async #attempt(work) {
    this.#stopping.abort();
    this.#stopping = new AbortController();
    const { signal } = this.#stopping;
    this.#complaint = undefined;
    const show = (/** @type {number | undefined} */ share) => {
      if (signal.aborted) return;
      this.share = share;
      this.host.requestUpdate();
    };
    show(0);
    try {
      await work(await loadReader(), { onProgress: show, signal });
      show(undefined);
    } catch (error) {
      show(undefined);
      if (!signal.aborted) await this.#refuse(error);
    }
  }
}

/** @param {Recording} recording */
const isTable = ({ format }) => format === 'csv' || format === 'tum';

/** Loads the reader of logs. */
async function loadReader() {
  const [drives, open, summary] = await Promise.all([import('../../logs/drives.ts'), import('../../logs/open.ts'), import('../../logs/summary.ts')]);
  return { ...drives, ...open, ...summary };
}

/** @param {Series[]} topics @param {string} topic */
const holdsTransforms = (topics, topic) => topics.some(({ name, kind }) => name === topic && kind === 'transforms');

/** Loads the words of logs. @returns {Promise<() => typeof import('../../logs/en.js').log>} those of the present language */
async function wordsOf() {
  const [{ log: english }, { log: german }] = await Promise.all([import('../../logs/en.js'), import('../../logs/de.js')]);
  return () => (language === 'de' ? german : english);
}

/**
 * Returns the line that logs are dropped on, and below it what becomes of a log: progress, topics, and why it is refused.
 *
 * @param {Figure} figure
 * @param {LogOpener} opener
 */
export function dropZone(figure, opener) {
  const say = words.calibrator.own;
  const { chosen, complaint, share } = opener;
  return html`<div class="drop-zone" id=${ZONE} part="drop">
    <p title=${say.dropTitle}>
      ${say.drop}
      <label class="files"><span>${say.files}</span>${fileInput('log-files', EXTENSIONS, (files) => opener.dropped.take(files))}</label>
      ${figure.log ? html`<span class="present">${say.present(figure.logName)}</span> ${button(say.leave, () => opener.leave())}` : nothing}
    </p>
    ${share === undefined ? nothing : html`<p><progress aria-label=${say.reading} .value=${share}></progress> ${button(words.progress.stop, () => opener.stop())}</p>`}
    ${chosen ? whichIsWhich(opener, chosen) : nothing}
    <p class="note" role=${figure.notice.isShown ? nothing : 'alert'} ?hidden=${complaint === ''}>${complaint}</p>
  </div>`;
}

/**
 * Returns the summary of the log, and the noise of its reference.
 *
 * @param {Figure} figure
 * @param {LogOpener} opener
 */
export function logSection(figure, { found }) {
  const say = words.calibrator.own;
  return html`<p>${figure.log ? say.present(figure.logName) : say.simulated}</p>
    ${figure.log ? found.map((sentence) => html`<p class="muted">${sentence}</p>`) : nothing}
    ${referenceNoise(figure)}
    <p class="muted">${say.stds}</p>`;
}

/**
 * @param {LogOpener} opener
 * @param {Chosen} chosen
 */
function whichIsWhich(opener, { files, topics, frames, ...chosen }) {
  const say = words.calibrator.own;
  if (topics.length === 0) {
    return html`<p>
      ${say.odometry}: ${files[0].name}; ${say.reference}: ${files[1].name}
      ${button(say.swap, () => opener.change({ files: [files[1], files[0]] }))}
    </p>`;
  }
  const select = (/** @type {'odometry' | 'reference'} */ role) => html`<label>
      ${say[role]}
      <select aria-label=${say[role]} @change=${(/** @type {Event} */ event) => opener.change({ [role]: /** @type {HTMLSelectElement} */ (event.target).value })}>
        <option value="" ?selected=${chosen[role] === ''}></option>
        ${topics.map(({ name, count }) => html`<option value=${name} ?selected=${name === chosen[role]}>${name} (${count})</option>`)}
      </select>
    </label>
    ${holdsTransforms(topics, chosen[role])
      ? html`<label>
          ${say.frames}
          <input
            type="text"
            aria-label="${say[role]}: ${say.frames}"
            .value=${frames[role]}
            @change=${(/** @type {Event} */ event) => opener.change({ frames: { ...frames, [role]: inputOf(event).value } })}
          />
        </label>`
      : nothing}`;
  return html`<p class="topics">${select('odometry')} ${select('reference')}</p>`;
}
