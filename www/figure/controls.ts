/** Controls of settings, from their declarations, sliders and words; and the legend, which shows and hides lines. */

import { html, noChange, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { radioGroup, formatMarkup, toggle } from '../ui/controls.ts';
import { formatLimit, parseNumber, formatEditable } from '../ui/format.ts';
import { sliderRow, type SliderRow } from '../ui/slider.ts';
import { swatchHtml, type LineStyle } from '../scene/draw.ts';
import { embeddingControls, exportButtons, linkButton } from './export.ts';
import type { Declaration } from '../../build/settings.js';
import type { Figure } from './figure.ts';

/** Appearance of a numeric setting. */
export interface SliderSpec {
  /** Mathematical symbol, in the markup of messages: see formatMarkup. */
  symbol?: string;
  role: 'prior' | 'prediction' | 'truth';
  /** Minimum of the slider, within the allowed values. */
  min: number;
  max: number;
  step: number;
  decimals: number;
  /** Value of a slider that shows several settings as one. */
  value?: (config: any) => number;
  /** Noise parameter whose name and effect label the slider. */
  alpha?: [model: 'velocity' | 'odometry', index: number];
}

/** Range and type of the values that can be typed. */
type AllowedNumbers = Pick<Declaration, 'type' | 'unit'> & { min: number, max: number };

/** Overrides of a slider row. `maxEntered` is a maximum of typed values, below that of the declaration. */
type RowOverrides = Partial<SliderRow> & { maxEntered?: number };

/** Returns the slider of a setting; `overrides` replaces fields of its slider row. */
export function settingSlider(figure: Figure, key: string, overrides?: RowOverrides, sliderSpec = figure.definition.sliderSpecs[key]) {
  const { symbol, decimals, value, ...sliderLook } = sliderSpec;
  const { name, effect } = wordsFor(figure, key);
  const declaration = declarationOf(figure, key);
  const { unit } = declaration;
  const config = figure.settings.requested;
  const setting = figure.definition.attributes[key];
  return editableSlider(figure, symbol ?? name, declaration, {
    ...sliderLook,
    id: key,
    symbol: symbol && formatMarkup(symbol),
    name: formatMarkup(name),
    value: value ? value(config) : (setting.get(config) as number),
    show: (shown) => formatEditable(shown, decimals) + (unit ? ` ${unit}` : ''),
    effect: effect && formatMarkup(effect),
    input: (number) => figure.settings.request((requested) => setting.change(number, requested)),
    commit: () => figure.gesture.commit(),
    ...overrides,
  });
}

/** Returns a slider whose value can also be typed, within an allowed range. */
export function editableSlider(figure: Figure, symbol: string, { min, max: declaredMax, type, unit }: AllowedNumbers, row: Omit<SliderRow, 'keys' | 'type' | 'refusal' | 'clearRefusal'> & { maxEntered?: number }) {
  const max = row.maxEntered ?? declaredMax;
  const isInteger = type === 'whole';
  // At an end of the slider, a text says that values beyond it can be typed.
  const sliderEnd = row.value >= row.max && row.max < max ? row.max : row.value <= row.min && row.min > min ? row.min : undefined;
  return sliderRow({
    ...row,
    effect: sliderEnd === undefined ? row.effect : words.sliderEnds(row.show(sliderEnd)),
    keys: min < 0 ? 'text' : isInteger ? 'numeric' : 'decimal',
    type: (text) => {
      const enteredNumber = parseEntered(figure, row.id, symbol, text, { min, max, type, unit });
      if (enteredNumber === undefined) return undefined;
      row.input(enteredNumber);
      row.commit();
      return row.show(enteredNumber);
    },
    refusal: figure.notice.beside(row.id),
    clearRefusal: () => figure.notice.dismiss(),
  });
}

/** Parses a number that the user typed. Returns undefined for a text that is refused, and shows the reason. */
export function parseEntered({ notice }: Figure, key: string, name: string, text: string, { min, max, unit, type }: AllowedNumbers) {
  const isInteger = type === 'whole';
  const number = parseNumber(text, unit, isInteger);
  if (number >= min && number <= max && (!isInteger || Number.isInteger(number))) {
    notice.dismiss();
    return number;
  }
  const typedText = Number.isNaN(number) ? `"${text}"` : text.trim().replace('-', '\u2212');
  notice.show(() => words.refused(name.replaceAll(/[*_{}]/g, ''), typedText, formatLimit(min), formatLimit(max), isInteger), { control: key });
}

/** Returns a picture's canvas, on which the pointer selects samples. `Canvases` sets its size. */
export function pictureCanvas(figure: Figure, picture: import('../scene/picture.ts').Picture<any>, description: string) {
  const selectAtPointer = (event: PointerEvent) => figure.cloud?.selectAtPointer(picture, event);
  return html`<canvas
    width="0"
    class=${picture.name}
    role="img"
    aria-label=${description}
    @pointermove=${selectAtPointer}
    @click=${selectAtPointer}
    @contextrestored=${() => figure.renderer.requestFrame()}
  ></canvas>`;
}

export const settingSliders = (figure: Figure, sliderSpecs: Record<string, SliderSpec>) => Object.keys(sliderSpecs).map((key) => settingSlider(figure, key));

export const settingRadios = (figure: Figure, key: string, labels: Record<string, string>) =>
  radioGroup(wordsFor(figure, key).name, key, labels, figure.settings.requested[key], (word) => figure.gesture.decide({ [key]: word }));

export const settingCheckbox = (figure: Figure, key: string, label: unknown) =>
  toggle({ label, checked: figure.settings.requested[key], change: (on) => figure.gesture.decide({ [key]: on }) });

interface DisclosureOptions {
  controls: () => unknown;
  numbers: () => unknown;
  /** Part of the names of exported files. */
  fileNameMark?: string | number;
  /** Description of a CSV file that has no samples. */
  csvTitle?: string;
}

/** Returns a disclosure. Its content is rendered only while it is open. */
function disclosure(figure: Figure, name: string, id: string, content: () => unknown) {
  const isOpen = figure.renderRoot.querySelector<HTMLDetailsElement>(`#${id}`)?.open;
  return html`<details part="fold" id=${id} @toggle=${() => figure.requestUpdate()}>
    <summary>${name}</summary>
    <div class="folded">${isOpen ? content() : noChange}</div>
  </details>`;
}

/** Returns the two disclosures below a figure, the button that copies a link, and the button that starts the presentation. */
export function disclosures(figure: Figure, { controls, numbers, fileNameMark = figure.viewModel.config.seed, csvTitle }: DisclosureOptions) {
  return html`<div class="folds">
    ${disclosure(figure, words.moreControls, 'more', controls)}
    ${disclosure(figure, words.numbersAndData, 'numbers', () => html`${numbers()} ${exportButtons(figure, fileNameMark, csvTitle)} ${embeddingControls(figure)}`)}
    <div class="begin">${linkButton(figure)} ${figure.presenting.button()}</div>
  </div>
  <p class="on-paper small">${noiseParameters(figure)}</p>`;
}

function noiseParameters({ definition: { attributes, sliderSpecs }, settings: { requested: config } }: Figure) {
  return Object.entries(sliderSpecs).filter(([, { alpha }]) => alpha).flatMap(([key, { symbol = '', decimals }]) => {
    const alphaValue = attributes[key].get(config) as number | null;
    return alphaValue === null ? [] : html`${formatMarkup(`${symbol}\u00a0=\u00a0${formatEditable(alphaValue, decimals)}`)}\u2003 `;
  });
}

export function titledPicture(title: unknown, picture: unknown, name?: string) {
  return html`<figure class="panel ${name ?? ''}">
    <p class="panel-title">${title}</p>
    ${picture}
  </figure>`;
}

export const declarationOf = (figure: Figure, key: string): Declaration & AllowedNumbers =>
  figure.definition.declarations.find((setting) => setting.key === key) as any;

function wordsFor(figure: Figure, key: string): { name: string, effect?: string } {
  const [model, index] = figure.definition.sliderSpecs[key]?.alpha ?? [];
  const [alphaName, alphaEffect] = model ? words.alphas[model][index as number] : [];
  return { ...(words.settings as any)[key], ...(model && { name: alphaName, effect: alphaEffect }), ...(words as any)[figure.definition.messageKey].settings[key] };
}

/** Returns the legend of a figure's pictures, with names from the catalogue. `extraEntries` have no toggle. */
export function legend(figure: Figure, styles: Record<string, LineStyle>, extraEntries: unknown = nothing) {
  const { overlays } = figure.settings.elementState;
  const { overlays: names } = (words as any)[figure.definition.messageKey];
  const styleNames = Object.keys(styles);
  const allOverlays = figure.definition.attributes.overlays.words as string[];
  const setShown = (name: string, shown: boolean) =>
    figure.gesture.choose('overlays', allOverlays.filter((overlay) => (overlay === name ? shown : overlays.includes(overlay))));
  const highlight = (name: string | null) => (figure.highlight = name);
  return html`<div class="legend" part="legend" role="group" aria-label=${words.legend}>
    ${styleNames.map((name) => html`<span @pointerenter=${() => highlight(name)} @pointerleave=${() => highlight(null)} @focusin=${() => highlight(name)} @focusout=${() => highlight(null)}>
      ${toggle({
        label: html`${swatchHtml(styles[name])}<span>${formatMarkup(names[name])}</span>`,
        checked: overlays.includes(name),
        change: (shown) => setShown(name, shown),
      })}
    </span>`)}
    ${extraEntries}
  </div>`;
}
