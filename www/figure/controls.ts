/** A setting's control, made of its declaration, of how it looks, and of the words for it. */

import { html, noChange, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { words } from '../messages/registry.ts';
import { group, inputOf, radioGroup, rich, toggle } from '../ui/controls.ts';
import { fold } from '../ui/fold.ts';
import { counted, limit, numberIn, typed } from '../ui/format.ts';
import { sliderRow, type SliderRow } from '../ui/slider.ts';
import { exportButtons } from './takeaway/export.ts';
import type { Setting } from './attributes.ts';
import type { Figure } from './figure.ts';

/** Appearance of a numeric setting. */
export interface Look {
  /** Symbol as in the book, in the marks of messages. */
  symbol?: string;
  role: 'prior' | 'prediction' | 'truth';
  /** Min of the slider, within what is allowed. */
  min: number;
  max: number;
  step: number;
  decimals: number;
  /** Value where several may be shown as one. */
  value?: (config: any) => number;
  /** Noise parameter whose words it has. */
  alpha?: [model: 'velocity' | 'odometry', index: number];
}

/** Row with the most that is allowed, where that is less than declared. */
export type Row = Partial<SliderRow> & { most?: number };

/**
 * @param key of a setting
 * @param otherwise what is not as in every row
 */
export function slider(figure: Figure, key: string, otherwise?: Row) {
  const { looks, attributes } = figure.kind;
  const { symbol, decimals, value, ...look } = looks[key];
  const { name, effect } = wordsFor(figure, key);
  const { unit } = declarationOf(figure, key);
  const config = figure.settings.wanted;
  const setting = attributes[key] as Setting;
  return typeable(figure, key, symbol ?? name, {
    ...look,
    id: key,
    symbol: symbol && rich(symbol),
    name: rich(name),
    value: value ? value(config) : (setting.get(config) as number),
    show: (shown) => typed(shown, decimals) + (unit ? ` ${unit}` : ''),
    effect: effect && rich(effect),
    input: (number) => want(figure, key, number),
    commit: () => figure.gesture.commit(),
    ...otherwise,
  });
}

/**
 * A slider whose value can be typed too, as far as the core goes.
 *
 * @param key of its setting
 * @param row with the values at which the slider ends, where it has others than these inside, and the most that is allowed, where that is less than declared
 * @param take a value that was typed
 */
function typeable(figure: Figure, key: string, symbol: string, row: Omit<SliderRow, 'keys' | 'type' | 'refusal' | 'forget'> & { ends?: number[], most?: number }, take: (number: number) => void = row.input, print: (number: number) => string = row.show) {
  const { min, max: declared, type, unit } = declarationOf(figure, key);
  const max = row.most ?? declared;
  const [first, last] = row.ends ?? [row.min, row.max];
  const whole = type === 'whole';
  // Some sliders begin or end where the core does.
  const end = row.value >= row.max && last < max ? last : row.value <= row.min && first > min ? first : undefined;
  return sliderRow({
    ...row,
    effect: end === undefined ? row.effect : words.sliderEnds(print(end)),
    keys: min < 0 ? 'text' : whole ? 'numeric' : 'decimal',
    type: (text) => {
      const number = numberIn(text, unit, whole);
      if (number >= min && number <= max && (!whole || Number.isInteger(number))) {
        take(number);
        row.commit();
        return print(number);
      }
      const given = Number.isNaN(number) ? `"${text}"` : text.trim().replace('-', '\u2212');
      figure.typing.refuse(key, words.refused(symbol.replaceAll(/[*_{}]/g, ''), given, limit(min), limit(max), whole));
    },
    refusal: figure.typing.refusalOf(key),
    forget: () => figure.typing.forget(),
  });
}

/**
 * A picture's canvas, on which the pointer marks samples. It gets its pixels when it is known how many the screen has there.
 *
 * @param description what it shows, in words
 */
export function canvas(figure: Figure, picture: import('../scene/picture.ts').Picture<any>, description: string) {
  const point = (event: PointerEvent) => figure.cloud?.point(picture, event);
  return html`<canvas
    width="0"
    class=${picture.name}
    role="img"
    aria-label=${description}
    @pointermove=${point}
    @click=${point}
    @contextrestored=${() => figure.stage.requestFrame()}
  ></canvas>`;
}

/** A slider for each of several settings. */
export function sliders(figure: Figure, looks: Record<string, Look>) {
  return Object.keys(looks).map((key) => slider(figure, key));
}

/**
 * Radio buttons for a setting that is a word.
 *
 * @param labels of its words
 */
export function choices(figure: Figure, key: string, labels: Record<string, string>) {
  return radioGroup(wordsFor(figure, key).name, key, labels, figure.settings.wanted[key], (word) => figure.gesture.decide({ [key]: word }));
}

/** @param key of a setting that is true or false */
export function check(figure: Figure, key: string, label: unknown) {
  return toggle({ label, checked: figure.settings.wanted[key], change: (on) => figure.gesture.decide({ [key]: on }) });
}

interface Disclosures {
  /** Controls that are needed less often than those in sight. */
  controls: () => unknown;
  /** Tables and charts. */
  numbers: () => unknown;
  /** Part of file names that distinguishes states. */
  mark?: string | number;
  /** Description of a CSV file that has no samples. */
  csvTitle?: string;
}

/** Returns the two disclosures below a figure, and the buttons that copy a link to it and present it. */
export function disclosures(figure: Figure, { controls, numbers, mark = figure.reading.config.seed, csvTitle }: Disclosures) {
  return html`<div class="folds">
    ${fold(words.moreControls, controls, 'more')}
    ${fold(words.numbersAndData, () => html`${numbers()} ${exportButtons(figure, mark, csvTitle)} ${figure.copies.codeButton()}`, 'numbers')}
    <div class="begin">${figure.copies.linkButton()} ${figure.presenting.button()}</div>
    ${figure.copies.answer('link')}
  </div>
  <p class="on-paper">${noiseOf(figure)}</p>`;
}

/** Returns the noise parameters with their values, for paper. */
function noiseOf({ kind: { attributes, looks }, settings: { wanted: config } }: Figure) {
  return Object.entries(looks).filter(([, { alpha }]) => alpha).flatMap(([key, { symbol = '', decimals }]) => {
    const value = (attributes[key] as Setting).get(config) as number | null;
    return value === null ? [] : html`<span>${rich(`${symbol}\u00a0=\u00a0${typed(value, decimals)}`)}</span> `;
  });
}

/**
 * Returns a picture of the figure, with its title above.
 *
 * @param picture canvas with its handles
 * @param name classes
 */
export function panel(title: unknown, picture: unknown, name?: string) {
  return html`<figure class="panel ${name ?? ''}">
    <p class="panel-title">${title}</p>
    ${picture}
  </figure>`;
}

/**
 * Growth, seed and size of the cloud.
 *
 * @param counts the sizes that the slider offers
 */
export function cloudControls(figure: Figure & { cloud: import('./cloud.ts').Cloud }, counts: readonly number[]) {
  const { samples } = figure.settings.wanted;
  const { name, effect } = wordsFor(figure, 'samples');
  const last = counts.length - 1;
  const nearest = counts.findIndex((count) => count >= samples);
  return group(words.samples, html`${typeable(
      figure,
      'samples',
      'N',
      {
        id: 'samples',
        symbol: html`<i>N</i>`,
        name,
        // Beyond the last there is no index, and the thumb says so.
        value: nearest < 0 ? last + 1 : nearest,
        min: 0,
        max: last,
        step: 1,
        ends: [counts[0], counts[last]],
        show: (index) => counted(index === nearest || index > last ? samples : counts[index]),
        effect,
        role: 'truth',
        input: (index) => want(figure, 'samples', counts[index]),
        commit: () => figure.gesture.commit(),
      },
      (count) => want(figure, 'samples', count),
      counted,
    )}
    ${figure.cloud.buttons()}`, 'cloud');
}

interface MarkedField {
  id: string;
  label: string;
  /** Number of samples shown. */
  shown: number;
  /** Text about the marked sample; nothing if none is marked. */
  told: unknown;
  /** Text if none is marked. */
  hint: string;
}

/** Field with the number of the marked sample. It keeps what was typed and is refused until it is right or left. */
export function markedField({ cloud, typing }: Figure & { cloud: import('./cloud.ts').Cloud }, { id, label, shown, told, hint }: MarkedField) {
  const refusal = typing.refusalOf('marked');
  const type = (event: Event) => {
    const text = inputOf(event).value;
    const number = Number(text);
    if (text && !(Number.isInteger(number) && number >= 1 && number <= shown)) {
      typing.refuse('marked', words.refused(label, text.replace('-', '\u2212'), '1', counted(shown), true));
      return;
    }
    typing.forget();
    cloud.mark(number - 1);
  };
  return html`<p class="marked">
    <label>
      ${label}
      <input
        id=${id}
        type="number"
        min="1"
        max=${Math.max(1, shown)}
        placeholder=${shown === 0 ? '' : `1–${counted(shown)}`}
        ?disabled=${shown === 0}
        .value=${refusal ? noChange : live(cloud.index < 0 ? '' : String(cloud.index + 1))}
        @input=${type}
        @blur=${() => typing.forget()}
      />
    </label>
    <output for=${id} role=${refusal ? 'alert' : nothing}>${refusal || told || html`<span class="hint">${hint}</span>`}</output>
  </p>`;
}

/** The reader wants another value of a setting, and may go on. */
function want(figure: Figure, key: string, value: unknown) {
  const setting = figure.kind.attributes[key] as Setting;
  figure.settings.want((wanted) => setting.change(value, wanted));
}

/** @param key of a setting that is a number */
function declarationOf(figure: Figure, key: string): import('../settings.js').Declaration & { min: number, max: number } {
  return figure.kind.declared.find((setting) => setting.key === key) as any;
}

function wordsOf(figure: Figure) {
  return (words as any)[figure.kind.vocabulary];
}

/** @returns what has no effect explains itself */
function wordsFor(figure: Figure, key: string): { name: string, effect?: string } {
  const [model, index] = figure.kind.looks[key]?.alpha ?? [];
  const ofAlpha = model && { name: words.alphas[model][(index as number)] };
  return { ...(words.settings as any)[key], ...ofAlpha, ...wordsOf(figure).settings[key] };
}
