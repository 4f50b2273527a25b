/** How a log of the reader's own gets in: chosen or dropped; and why the latest was refused. */

import { html, nothing } from 'lit';
import { Part } from '../../figure/part.js';
import { language, words } from '../../messages/registry.js';
import { button, inputOf } from '../../ui/controls.js';
import { FileDrop, fileInput } from '../shared/files.js';
import { deviations } from './controls.js';

/**
 * @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure
 * @typedef {import('./log/rows.js').Poses} Poses
 * @typedef {import('./log/read.js').Topic} Topic
 * @typedef {import('../../types.d.ts').CalibrationLog} CalibrationLog
 * @typedef {typeof import('./log/read.js')} Reader
 * @typedef {{ onProgress: (share: number) => void, signal: AbortSignal }} Watched
 */

/** What the names of files may end in. */
const EXTENSIONS = ['.csv', '.txt', '.tum', '.mcap'];

/** Milliseconds between two looks at how much of a log has been read: to show it takes some of them. */
const BETWEEN = 100;

/** The fold that says which log is there and why another was refused. */
export const FOLD = 'log-fold';

/** Which frames of a topic of transforms are usually meant: a parent and a child. */
const FRAMES = { odometry: 'odom, base_link', reference: 'map, base_link' };

/**
 * A recording whose topics are to be chosen, with the frames of those that hold transforms; or two tables. `kind` is what was wanted of the
 * odometry when it was read, `isTold` whether the reader said which topic that is.
 *
 * @typedef {{ files: File[], topics: Topic[], odometry: string, reference: string, frames: typeof FRAMES, kind: 'commands' | undefined, isTold: boolean }} Chosen
 */

/** Of a part of what is watched. @param {Watched} watching @param {number} from @param {number} to @returns {Watched} */
const partOf = ({ onProgress, signal }, from, to) => ({ signal, onProgress: (share) => onProgress(from + share * (to - from)) });

/** @extends {Part<Figure>} */
export class LogOpener extends Part {
  dropped = new FileDrop(this.host, FOLD, (files) => this.choose(files));
  /** Why the latest log was refused. @type {(() => string) | undefined} */
  #complaint;
  /** What was found in the present log. @type {(() => string[]) | undefined} */
  #found;
  /** What is read, and which of it is which. @type {Chosen | undefined} */
  chosen;
  /** What was opened last, and whether there are poses and commands in its table. @type {{ chosen: Chosen, log: CalibrationLog, hasBoth: boolean } | undefined} */
  #opened;
  /** How much of it has been read; undefined where nothing is. @type {number | undefined} */
  share;
  /** Stops what is being read. */
  #stopping = new AbortController();

  /** Empty where there is nothing to complain of. */
  get complaint() {
    return this.#complaint?.() ?? '';
  }

  /** What was left out of the present log, and what was decided about it. */
  get found() {
    return this.#found?.() ?? [];
  }

  /** What the model takes of an odometry that has both: velocities are commanded. */
  get #kind() {
    return this.host.reading.config.model === 'velocity' ? 'commands' : undefined;
  }

  /** Another model may take what else the same files have. */
  hostUpdated() {
    if (!this.#opened || this.share !== undefined) return;
    const { chosen, log, hasBoth } = this.#opened;
    if (chosen !== this.chosen || log !== this.host.log || chosen.kind === this.#kind) return;
    chosen.kind = this.#kind;
    this.#attempt(async (reader, watching) => {
      const { odometry } = reader.usualTopics(chosen.topics, chosen.kind);
      const isOther = odometry !== null && odometry !== chosen.odometry && !chosen.isTold;
      if (isOther) chosen.odometry = odometry;
      if (isOther || hasBoth) await this.#read(reader, watching);
    });
  }

  /** Back to the simulated log. */
  leave() {
    this.#stopping.abort();
    this.share = this.chosen = this.#complaint = this.#found = undefined;
    this.host.open(null);
  }

  /** The reader does not want to wait. */
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
      if (files.length > 2) throw new Error(words.calibrator.own.two(files.length));
      const recording = files.length === 1;
      const [{ name }] = files;
      // What is called a recording is refused as one.
      const recorded = await Promise.all(files.map(reader.isRecording));
      if (recording ? !(recorded[0] || /\.mcap$/i.test(name)) : recorded.includes(true)) throw new Error(words.calibrator.own.two(files.length));
      // To find the topics a recording without an index is read as a whole, and then once more.
      const topics = recording ? reader.usefulTopics(name, await reader.topicsOf(files[0], partOf(watching, 0, 0.5))) : [];
      const kind = this.#kind;
      const usual = reader.usualTopics(topics, kind);
      const [first, second] = reader.areSwapped(name, files.at(-1)?.name ?? '') ? [...files].reverse() : files;
      this.chosen = { files: recording ? files : [first, second], topics, odometry: usual.odometry ?? '', reference: usual.reference ?? '', frames: FRAMES, kind, isTold: false };
      if (recording) reader.checkClear(name, topics, usual);
      await this.#read(reader, watching);
    });
  }

  /** The reader says which is which. @param {Partial<Chosen>} change */
  change(change) {
    const { chosen } = this;
    if (!chosen) return;
    this.chosen = { ...chosen, ...change, isTold: chosen.isTold || change.odometry !== undefined };
    const { topics, odometry, reference } = this.chosen;
    this.host.requestUpdate();
    if (topics.length === 0 || (odometry && reference)) this.#attempt((reader, watching) => this.#read(reader, watching));
  }

  /**
   * @param {Reader} reader
   * @param {Watched} watching
   */
  async #read(reader, watching) {
    const chosen = /** @type {Chosen} */ (this.chosen);
    const { files, topics, odometry, reference, frames, kind } = chosen;
    const topic = (/** @type {string} */ name, /** @type {string} */ its) => {
      const [parent, child = ''] = its.split(',').map((frame) => frame.trim());
      return { topic: name, ...(holdsTransforms(topics, name) && { frames: { parent, child } }) };
    };
    const both = [topic(odometry, frames.odometry), topic(reference, frames.reference)];
    const [first, second] = topics.length
      ? await reader.logsOf(files[0], both, partOf(watching, this.share ?? 0, 1))
      : [await reader.readLog(files[0], { kind, ...partOf(watching, 0, 0.5) }), await reader.readLog(files[1], { kind: 'poses', ...partOf(watching, 0.5, 1) })];
    // Each of these takes about as long as a frame has.
    await reader.turn();
    const logs = reader.together(first, second);
    await reader.turn();
    watching.signal.throwIfAborted();
    const name = [...new Set(files.map((file) => file.name))].join(', ');
    const log = { name, odometry: logs.odometry.data, reference: /** @type {Poses} */ (logs.reference.data) };
    const say = await wordsOf();
    watching.signal.throwIfAborted();
    this.host.open(log, () => {
      this.#opened = { chosen, log, hasBoth: first.how.hasBoth };
      this.#found = () => [logs.odometry, logs.reference].flatMap((log) => [`${log.name}: ${reader.tell(log, say().found).join(' ')}`]);
    }, (error) => this.#refuse(error));
  }

  /** Says why a log was refused. @param {unknown} error */
  async #refuse(error) {
    const { message, sentence } = /** @type {Error & Partial<import('./log/refusal.js').LogError>} */ (error);
    const say = sentence && (await wordsOf());
    this.#complaint = () => (say ? sentence(say()) : words.calibrator.own.refused(message));
    this.host.requestUpdate();
    await this.dropped.showRefusal();
  }

  /** @param {(reader: Reader, watching: Watched) => Promise<void>} work */
  async #attempt(work) {
    this.#stopping.abort();
    const stopping = (this.#stopping = new AbortController());
    this.#complaint = undefined;
    let shown = -Infinity;
    const onProgress = (/** @type {number} */ share) => {
      const now = performance.now();
      if (stopping.signal.aborted || now - shown < BETWEEN) return;
      shown = now;
      this.share = share;
      this.host.requestUpdate();
    };
    try {
      onProgress(0);
      await work(await import('./log/read.js'), { onProgress, signal: stopping.signal });
    } catch (error) {
      if (stopping.signal.aborted) return;
      this.share = undefined;
      await this.#refuse(error);
    } finally {
      if (!stopping.signal.aborted) this.share = undefined;
      this.host.requestUpdate();
    }
  }
}

/** @param {Topic[]} topics @param {string} topic */
const holdsTransforms = (topics, topic) => topics.some(({ name, kind }) => name === topic && kind === 'transforms');

/** The words of logs, which come with the first log. @returns {Promise<() => typeof import('./log/en.js').log>} those of the time when they are said */
async function wordsOf() {
  const [{ log: english }, { log: german }] = await Promise.all([import('./log/en.js'), import('./log/de.js')]);
  return () => (language === 'de' ? german : english);
}

/**
 * @param {Figure} figure
 * @param {LogOpener} opener
 */
export function ownLog(figure, opener) {
  const say = words.calibrator.own;
  const { chosen, complaint, share, found } = opener;
  return html`<div class="own-log">
    <p>${say.text}</p>
    <label for="log-files">${say.files}</label>
    ${fileInput('log-files', EXTENSIONS, (files) => opener.choose(files))}
    <p>${say.deviations}</p>
    ${deviations(figure)}
    ${share === undefined ? nothing : html`<p><progress aria-label=${say.reading} .value=${share}></progress> ${button(words.progress.stop, () => opener.stop())}</p>`}
    ${chosen ? whichIsWhich(opener, chosen) : nothing}
    <p class="note" role="alert" ?hidden=${complaint === ''}>${complaint}</p>
    <p class="present">${figure.log ? say.present(figure.logName) : say.simulated}</p>
    ${figure.log ? html`${found.map((sentence) => html`<p class="muted">${sentence}</p>`)} ${button(say.leave, () => opener.leave())}` : nothing}
  </div>`;
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
