/** Logs of the reader's own: chosen or dropped, and read. */

import { html, nothing } from 'lit';
import { Part } from '../../figure/part.ts';
import { language, words } from '../../messages/registry.ts';
import { button, inputOf } from '../../ui/controls.ts';
import { FileDrop, fileInput } from '../shared/files.ts';
import { referenceNoise } from './controls.ts';
import { isStopped } from './log-service.ts';

export type Figure = import('./alpha-calibrator.ts').AlphaCalibratorElement;

export type LogError = import('../../logs/log-error.ts').LogError;

export type Poses = import('../../logs/log.ts').Poses;

export type Recording = import('../../logs/log.ts').Recording;

export type Series = import('../../logs/log.ts').Series;

export type CalibrationLog = import('../../types.d.ts').CalibrationLog;

type LogFailure = import('./log-service.ts').LogFailure;

export type Reader = Awaited<ReturnType<typeof loadReader>>;

/** One recording with its topics, or two tables without. */
export interface Chosen {
  /** Recordings; of two, the odometry first. */
  files: Recording[];
  topics: Series[];
  /** Topic; empty where it is ambiguous. */
  odometry: string;
  /** Topic; empty where it is ambiguous. */
  reference: string;
  /** Frames of topics of transforms. */
  frames: typeof FRAMES;
  /** Kind of odometry that the model wanted when it was read. */
  kind: 'commands' | undefined;
  /** True if the reader chose the topic of the odometry. */
  isExplicit: boolean;
}

/** Extensions that the file dialog offers. */
const EXTENSIONS = ['.csv', '.txt', '.tum', '.mcap'];

/** Id of the drop zone. */
const ZONE = 'log';

/** Usual frames of a topic of transforms: parent and child. */
const FRAMES = { odometry: 'odom, base_link', reference: 'map, base_link' };

export class LogOpener extends Part<Figure> {
  dropped = new FileDrop(this.host, ZONE, (files) => this.choose(files));
  /** Why the latest log was refused. */
  #complaint: (() => string) | undefined;
  /** Summary of the present log. */
  #found: (() => string[]) | undefined;
  /** Files and topics of the latest log. */
  chosen: Chosen | undefined;
  /** Log that was opened last, and whether its table has poses and commands. */
  #opened: { chosen: Chosen, log: CalibrationLog, hasBoth: boolean } | undefined;
  /** Share of the file that has been read; undefined while none is being read. */
  share: number | undefined;
  /** Number of the latest attempt to read files. */
  #latest = 0;

  /** Why the latest log was refused; empty where it was not. */
  get complaint() {
    return this.#complaint?.() ?? '';
  }

  /** Sentences about the present log: decisions, and rows that were left out. */
  get found() {
    return this.#found?.() ?? [];
  }

  /** Odometry that the model prefers where a log has both: the velocity model takes commands. */
  get #kind(): 'commands' | undefined {
    return this.host.reading.config.model === 'velocity' ? 'commands' : undefined;
  }

  /** Reads the files again where another model prefers another odometry of them. */
  hostUpdated() {
    if (!this.#opened || this.share !== undefined) return;
    const { chosen, log, hasBoth } = this.#opened;
    if (chosen !== this.chosen || log !== this.host.log || chosen.kind === this.#kind) return;
    chosen.kind = this.#kind;
    this.#attempt(async (reader) => {
      const { odometry } = chosen;
      if (!chosen.isExplicit && chosen.topics.length) chosen.odometry = guessOf(reader, chosen, 'odometry') || odometry;
      if (chosen.odometry !== odometry || hasBoth) await this.#read(chosen, reader);
    });
  }

  /** Returns to the simulated log. */
  leave() {
    this.#end();
    this.chosen = this.#complaint = this.#found = undefined;
    this.host.open(null).then(() => this.#commit());
  }

  /** Stops reading. */
  stop() {
    this.#end();
    this.#complaint = () => words.progress.stopped;
  }

  #end() {
    this.#latest++;
    this.host.service.stop();
    this.#rest();
  }

  /** Shows that nothing is being read, and lets the figure go on with what was waiting for that. */
  #rest() {
    this.share = undefined;
    this.host.settings.stale = true;
    this.host.stage.wake();
    this.host.requestUpdate();
  }

  #commit() {
    this.host.gesture.step();
    this.host.gesture.commit();
  }

  choose(files: File[]) {
    if (files.length === 0) return;
    this.chosen = undefined;
    this.#attempt(async (reader) => {
      const recordings = await this.host.service.open(files);
      const topics = recordings.length === 1 ? reader.usefulSeries(recordings[0]) : [];
      const chosen: Chosen = { files: recordings, topics, odometry: '', reference: '', frames: FRAMES, kind: this.#kind, isExplicit: false };
      const plan = () => reader.planDrives(recordings, { kind: chosen.kind });
      if (recordings.length === 1) {
        if (topics.length > 1 || topics[0]?.kind === 'transforms') this.chosen = chosen;
        for (const role of ['odometry', 'reference'] as const) chosen[role] = guessOf(reader, chosen, role);
        if (!chosen.odometry || !chosen.reference) plan();
      } else {
        const { drives, loose } = plan();
        const parts = [...loose.odometry, ...loose.reference].map(({ recording }) => recording);
        if (drives.length > 0 || parts.length > 2) throw new Error(words.calibrator.own.two(files.length));
        chosen.files = parts;
        this.chosen = chosen;
      }
      await this.#read(chosen, reader);
    });
  }

  /** Takes a choice of the reader. */
  change(change: Partial<Chosen>) {
    if (!this.chosen) return;
    const chosen = { ...this.chosen, ...change, isExplicit: this.chosen.isExplicit || change.odometry !== undefined };
    this.chosen = chosen;
    this.host.requestUpdate();
    if (chosen.topics.length > 0 && !(chosen.odometry && chosen.reference)) return;
    this.#attempt((reader) => this.#read(chosen, reader));
  }

  async #read(chosen: Chosen, reader: Reader) {
    const { files, topics, odometry, reference, frames, kind } = chosen;
    const roles = ['odometry', 'reference'] as const;
    const wishes = {
      kind,
      ...(topics.length
        ? { odometry: wishOf(topics, odometry, frames.odometry), reference: wishOf(topics, reference, frames.reference) }
        : { roles: new Map(files.map((recording, i) => [recording, roles[i]])) }),
    };
    const latest = this.#latest;
    const [paired] = await this.host.service.read(reader.planDrives(files, wishes), (share) => {
      if (latest !== this.#latest) return;
      this.share = share;
      this.host.requestUpdate();
    });
    const name = [...new Set(files.map((file) => file.name)), ...(topics.length ? [reference] : [])].join(', ');
    const log = { name, odometry: paired.odometry.data, reference: paired.reference.data as Poses };
    const say = await wordsOf();
    await this.host.open(log, ({ count }) => {
      if (count === 0) throw new RangeError(words.calibrator.none);
    });
    this.#commit();
    this.#opened = { chosen, log, hasBoth: !topics.length && files[0].series.some(({ hasCommands }) => hasCommands) };
    const logs = [paired.odometry, paired.reference];
    this.#found = () => logs.map((each) => `${each.name}: ${reader.summarize(each, say().found).join('; ')}`);
  }

  /** Shows why a log was refused. */
  async #refuse(error: unknown) {
    const { message, sentence, sentences } = error as Error & Partial<LogError & LogFailure>;
    const say = sentence && (await wordsOf());
    this.#complaint = () => sentences?.[language === 'de' ? 'de' : 'en'] ?? (say ? sentence(say()) : words.calibrator.own.refused(message));
    this.host.requestUpdate();
    await this.dropped.showRefusal(this.complaint);
  }

  /** Gives up the reading that is under way, and starts another. */
  async #attempt(work: (reader: Reader) => Promise<void>) {
    const number = ++this.#latest;
    this.host.service.stop();
    this.#complaint = undefined;
    this.share = 0;
    this.host.requestUpdate();
    try {
      await work(await loadReader());
    } catch (error) {
      if (number === this.#latest && !isStopped(error)) await this.#refuse(error);
    }
    if (number === this.#latest) this.#rest();
  }
}

/** Returns the series of a role that is not ambiguous. */
function guessOf(reader: Reader, { files: [recording], odometry, kind }: Chosen, role: import('../../logs/drives.ts').Role): string {
  const tiers = reader.candidates(recording, role, { kind }).map((tier) => tier.filter(({ series }) => role === 'odometry' || series !== odometry));
  const best = tiers.find(({ length }) => length > 0);
  return best?.length === 1 ? best[0].series : '';
}

/** Returns a choice of the reader, with the frames of a topic of transforms. */
function wishOf(topics: Series[], series: string, its: string) {
  const [parent, child = ''] = its.split(',').map((frame) => frame.trim());
  return { series, ...(holdsTransforms(topics, series) && { frames: { parent, child } }) };
}

/** Loads what plans drives, and what makes sentences of summaries. */
async function loadReader() {
  const [candidates, drives, summary] = await Promise.all([import('../../logs/candidates.ts'), import('../../logs/drives.ts'), import('../../logs/summary.ts')]);
  return { ...candidates, ...drives, ...summary };
}

const holdsTransforms = (topics: Series[], topic: string) => topics.some(({ name, kind }) => name === topic && kind === 'transforms');

/**
 * Loads the words of logs.
 *
 * @returns those of the present language
 */
async function wordsOf(): Promise<() => typeof import('../../logs/en.ts').log> {
  const [{ log: english }, { log: german }] = await Promise.all([import('../../logs/en.ts'), import('../../logs/de.ts')]);
  return () => (language === 'de' ? german : english);
}

/** Returns the line that logs are dropped on, and below it what becomes of a log: progress, topics, and why it is refused. */
export function dropZone(figure: Figure, opener: LogOpener) {
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

/** Returns the summary of the log, and the noise of its reference. */
export function logSection(figure: Figure, { found }: LogOpener) {
  const say = words.calibrator.own;
  return html`<p>${figure.log ? say.present(figure.logName) : say.simulated}</p>
    ${figure.log ? found.map((sentence) => html`<p class="muted">${sentence}</p>`) : nothing}
    ${referenceNoise(figure)}
    <p class="muted">${say.stds}</p>`;
}

function whichIsWhich(opener: LogOpener, { files, topics, frames, ...chosen }: Chosen) {
  const say = words.calibrator.own;
  if (topics.length === 0) {
    return html`<p>
      ${say.odometry}: ${files[0].name}; ${say.reference}: ${files[1].name}
      ${button(say.swap, () => opener.change({ files: [files[1], files[0]] }))}
    </p>`;
  }
  const select = (role: 'odometry' | 'reference') => html`<label>
      ${say[role]}
      <select aria-label=${say[role]} @change=${(event: Event) => opener.change({ [role]: (event.target as HTMLSelectElement).value })}>
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
            @change=${(event: Event) => opener.change({ frames: { ...frames, [role]: inputOf(event).value } })}
          />
        </label>`
      : nothing}`;
  return html`<p class="topics">${select('odometry')} ${select('reference')}</p>`;
}
