/** HTML of the controls of a figure's settings, and of its legend, whose checkboxes show and hide lines. */

import { html, noChange, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { radioGroupHtml, formatMarkup, checkboxHtml, type AllowedNumbers } from '../ui/controls.ts';
import { formatEditable, formatInteger } from '../ui/format.ts';
import { sliderRowHtml, type SliderRow } from '../ui/slider.ts';
import { swatchHtml, type LineStyle } from '../ui/theme.ts';
import { createFieldProperty } from './definition.ts';
import { embeddingControlsHtml, exportButtonsHtml, linkButtonHtml } from './export.ts';
import type { Declaration } from '../../build/settings.js';
import type { Figure } from './figure.ts';
import type { Picture } from '../scene/picture.ts';

/** Specification of the slider of a numeric setting. */
export interface SliderSpec {
  /** Mathematical symbol, in the markup of messages: see formatMarkup. */
  symbol?: string;
  role: 'prior' | 'prediction' | 'truth';
  /** Minimum of the slider, within the allowed values. */
  min: number;
  max: number;
  step: number;
  decimals: number;
  /** Values of the slider, if they are not in equal steps. */
  stops?: readonly number[];
  /** Returns the value of a slider that shows several settings as one number. */
  combinedValueOf?: (config: any) => number;
  /** Noise parameter whose name and effect label the slider. */
  alpha?: [model: 'velocity' | 'odometry', index: number];
}

/** Returns the slider of a setting. `overrides` replaces fields of its slider row. */
export function settingSliderHtml(figure: Figure, key: string, overrides?: Partial<SliderRow>, sliderSpec = figure.definition.sliderSpecs[key]) {
  const { symbol, decimals, combinedValueOf, ...sliderFields } = sliderSpec;
  const { name, effect } = wordsFor(figure, key);
  const allowedNumbers = declarationOf(figure, key);
  const { unit } = allowedNumbers;
  const config = figure.settings.requested;
  const attribute = figure.definition.attributes[key] ?? createFieldProperty(key);
  return sliderRowHtml({
    ...sliderFields,
    allowedNumbers,
    id: key,
    symbol: symbol && formatMarkup(symbol),
    name: formatMarkup(name),
    value: combinedValueOf ? combinedValueOf(config) : (attribute.get(config) as number),
    formatValue: (value) => (decimals === 0 ? formatInteger(value) : formatEditable(value, decimals)) + (unit ? ` ${unit}` : ''),
    effect: effect && formatMarkup(effect),
    onInput: (value) => figure.settings.requestChange((requested) => attribute.changesFor(value, requested)),
    onCommit: () => figure.gesture.commitChange(),
    ...overrides,
  });
}

/** Returns a picture with its title. The pointer selects samples in the picture. The first picture has the handles. `Canvases` sizes the canvas. */
export function pictureHtml(figure: Figure, picture: Picture<any>, title: string, options: { className?: string, description?: string, contentBelow?: unknown } = {}) {
  const isFirst = picture === figure.pictures[0];
  const { className, description = isFirst ? figure.description : title, contentBelow: below } = options;
  const selectAtPointer = (event: PointerEvent) => figure.selectAtPointer(picture, event);
  return panelHtml(title, html`<div class="stage" part="picture">
      <canvas width="0" class=${picture.name} role="img" aria-label=${description} @pointermove=${selectAtPointer} @click=${selectAtPointer} @contextrestored=${() => figure.renderer.requestFrame()}></canvas>
      ${isFirst ? figure.handles.map((handles) => handles.render()) : nothing}
    </div>
    ${below}`, className);
}

export const settingSlidersHtml = (figure: Figure, sliderSpecs: Record<string, SliderSpec>) => Object.keys(sliderSpecs).map((key) => settingSliderHtml(figure, key));

export const settingRadiosHtml = (figure: Figure, key: string, labels: Record<string, string>) =>
  radioGroupHtml(wordsFor(figure, key).name, key, labels, figure.settings.requested[key], (word) => figure.gesture.requestAndCommit({ [key]: word }));

export const settingCheckboxHtml = (figure: Figure, key: string, label: unknown) =>
  checkboxHtml({ label, checked: figure.settings.requested[key], onChange: (isChecked) => figure.gesture.requestAndCommit({ [key]: isChecked }) });

interface DisclosureOptions {
  renderControls: () => unknown;
  renderNumbers: () => unknown;
  /** Suffix of the names of exported files. */
  fileNameSuffix?: string | number;
  /** Tooltip of the button that saves a CSV file, if the file has something other than samples. */
  csvTitle?: string;
}

/** Returns a `details` element, whose content is rendered only while it is open. */
function disclosureHtml(figure: Figure, name: string, id: string, renderContent: () => unknown) {
  const isOpen = figure.renderRoot.querySelector<HTMLDetailsElement>(`#${id}`)?.open;
  return html`<details part="fold" id=${id} @toggle=${() => figure.requestUpdate()}>
    <summary>${name}</summary>
    <div class="folded">${isOpen ? renderContent() : noChange}</div>
  </details>`;
}

/** Returns the disclosures of controls and of numbers below a figure, the button that copies a link, and the button that starts the presentation. */
export function disclosuresHtml(figure: Figure, { renderControls, renderNumbers, fileNameSuffix = figure.viewModel.config.seed, csvTitle }: DisclosureOptions) {
  return html`<div class="folds">
    ${disclosureHtml(figure, words.moreControls, 'more', renderControls)}
    ${disclosureHtml(figure, words.numbersAndData, 'numbers', () => html`${renderNumbers()} ${exportButtonsHtml(figure, fileNameSuffix, csvTitle)} ${embeddingControlsHtml(figure)}`)}
    <div class="begin">${linkButtonHtml(figure)} ${figure.presentationMode.buttonHtml()}</div>
  </div>
  <p class="on-paper small">${noiseParametersHtml(figure)}</p>`;
}

function noiseParametersHtml({ definition: { attributes, sliderSpecs }, settings: { requested: config } }: Figure) {
  return Object.entries(sliderSpecs).filter(([, { alpha }]) => alpha).flatMap(([key, { symbol = '', decimals }]) => {
    const alphaValue = attributes[key].get(config) as number | null;
    return alphaValue === null ? [] : html`${formatMarkup(`${symbol}\u00a0=\u00a0${formatEditable(alphaValue, decimals)}`)}\u2003 `;
  });
}

/** Returns a picture or chart below its title. */
export function panelHtml(title: string, content: unknown, className?: string) {
  return html`<figure class="panel ${className ?? ''}">
    <p class="panel-title">${title}</p>
    ${content}
  </figure>`;
}

export const declarationOf = (figure: Figure, key: string): Declaration & AllowedNumbers =>
  (figure.definition.declarations.find((declaration) => declaration.key === key) ?? figure.definition.elementFields[key]) as any;

function wordsFor(figure: Figure, key: string): { name: string, effect?: string } {
  const [motionModel, index] = figure.definition.sliderSpecs[key]?.alpha ?? [];
  const [alphaName, alphaEffect] = motionModel ? words.alphas[motionModel][index as number] : [];
  return { ...(words.settings as any)[key], ...(motionModel && { name: alphaName, effect: alphaEffect }), ...(words as any)[figure.definition.messageKey].settings[key] };
}

/** Returns the legend of a figure's pictures, with names from the message catalogue. */
export function legendHtml(figure: Figure, styles: Record<string, LineStyle>) {
  const { overlays } = figure.settings.elementState;
  const { overlays: overlayNames } = (words as any)[figure.definition.messageKey];
  const styleNames = Object.keys(styles);
  const allOverlays = figure.definition.attributes.overlays.words as string[];
  const setOverlayShown = (name: string, isShown: boolean) =>
    figure.gesture.setElementField('overlays', allOverlays.filter((overlay) => (overlay === name ? isShown : overlays.includes(overlay))));
  const highlightLine = (name: string | null) => (figure.highlight = name);
  return html`<div class="legend" part="legend" role="group" aria-label=${words.legendLabel}>
    ${styleNames.map((name) => html`<span @pointerenter=${() => highlightLine(name)} @pointerleave=${() => highlightLine(null)} @focusin=${() => highlightLine(name)} @focusout=${() => highlightLine(null)}>
      ${checkboxHtml({
        label: html`${swatchHtml(styles[name])}<span>${formatMarkup(overlayNames[name])}</span>`,
        checked: overlays.includes(name),
        onChange: (isShown) => setOverlayShown(name, isShown),
      })}
    </span>`)}
  </div>`;
}
