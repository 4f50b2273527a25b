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
import type { FigurePicture } from '../scene/picture.ts';

/** Specification of the slider of a numeric setting. */
export interface SliderSpec extends Pick<SliderRow, 'colourRole' | 'min' | 'max' | 'step' | 'stops'> {
  /** Mathematical symbol, in the markup of messages: see formatMarkup. */
  symbol?: string;
  decimals: number;
  /** Returns the value of a slider that shows several settings as one number. */
  combinedValueOf?: (settingValues: any) => number;
  /** Noise parameter whose name and effect label the slider. */
  alpha?: [model: 'velocity' | 'odometry', index: number];
}

/** Returns the slider of a setting. `rowOverrides` replaces fields of the slider's specification. */
export function settingSliderHtml(figure: Figure, settingKey: string, rowOverrides?: Partial<SliderRow>, sliderSpec = figure.definition.sliderSpecs[settingKey]) {
  const { symbol: settingSymbol, decimals, combinedValueOf, ...sliderFields } = sliderSpec;
  const { name: settingName, effect: effectText } = findSettingWords(figure, settingKey);
  const allowedNumbers = declarationOf(figure, settingKey);
  const { unit: unitText } = allowedNumbers;
  const settingValues = figure.settings.requestedValues;
  const elementAttribute = figure.definition.attributes[settingKey] ?? createFieldProperty(settingKey);
  return sliderRowHtml({
    ...sliderFields,
    allowedNumbers,
    id: settingKey,
    symbol: settingSymbol && formatMarkup(settingSymbol),
    name: formatMarkup(settingName),
    value: combinedValueOf ? combinedValueOf(settingValues) : (elementAttribute.getValue(settingValues) as number),
    formatValue: (settingValue) => (decimals === 0 ? formatInteger(settingValue) : formatEditable(settingValue, decimals)) + (unitText ? ` ${unitText}` : ''),
    effect: effectText && formatMarkup(effectText),
    onInput: (settingValue) => figure.settings.requestChange((requestedValues) => elementAttribute.changesFor(settingValue, requestedValues)),
    onCommit: () => figure.gesture.commitChange(),
    ...rowOverrides,
  });
}

/** Returns the HTML of a picture with its title. The pointer selects samples in it. Only the first picture has handles. `Canvases` sets the size of its canvas. */
export function pictureHtml(figure: Figure, picture: FigurePicture<any>, title: string, pictureOptions: { className?: string, description?: string, contentBelow?: unknown } = {}) {
  const isFirst = picture === figure.pictures[0];
  const { className, description: pictureDescription = isFirst ? figure.description : title, contentBelow } = pictureOptions;
  const selectAtPointer = (pointerEvent: PointerEvent) => figure.selectAtPointer(picture, pointerEvent);
  return panelHtml(title, html`<div class="stage" part="picture">
      <canvas width="0" class=${picture.pictureName} role="img" aria-label=${pictureDescription} @pointermove=${selectAtPointer} @click=${selectAtPointer} @contextrestored=${() => figure.renderer.requestFrame()}></canvas>
      ${isFirst ? figure.handles.map((pictureHandles) => pictureHandles.render()) : nothing}
    </div>
    ${contentBelow}`, className);
}

export const settingSlidersHtml = (figure: Figure, sliderSpecs: Record<string, SliderSpec>) => Object.keys(sliderSpecs).map((settingKey) => settingSliderHtml(figure, settingKey));

export const settingRadiosHtml = (figure: Figure, settingKey: string, labelsByWord: Record<string, string>) =>
  radioGroupHtml(findSettingWords(figure, settingKey).name, settingKey, labelsByWord, figure.settings.requestedValues[settingKey], (chosenWord) => figure.gesture.requestAndCommit({ [settingKey]: chosenWord }));

export const settingCheckboxHtml = (figure: Figure, settingKey: string, checkboxLabel: unknown) =>
  checkboxHtml({ labelContent: checkboxLabel, isChecked: figure.settings.requestedValues[settingKey], onChange: (isChecked) => figure.gesture.requestAndCommit({ [settingKey]: isChecked }) });

interface DisclosureOptions {
  renderControls: () => unknown;
  renderNumbers: () => unknown;
  /** Tooltip of the button that saves a CSV file, if the file has something other than samples. */
  csvTitle?: string;
}

/** Returns a `details` element, whose content is rendered only while it is open. */
function disclosureHtml(figure: Figure, disclosureName: string, id: string, renderContent: () => unknown) {
  const isOpen = figure.renderRoot.querySelector<HTMLDetailsElement>(`#${id}`)?.open;
  return html`<details part="fold" id=${id} @toggle=${() => figure.requestUpdate()}>
    <summary>${disclosureName}</summary>
    <div class="folded">${isOpen ? renderContent() : noChange}</div>
  </details>`;
}

/** Returns the disclosures of controls and of numbers below a figure, the button that copies a link, and the button that starts the presentation. */
export function disclosuresHtml(figure: Figure, { renderControls, renderNumbers, csvTitle }: DisclosureOptions) {
  return html`<div class="folds">
    ${disclosureHtml(figure, words.moreControls, 'more', renderControls)}
    ${disclosureHtml(figure, words.numbersAndData, 'numbers', () => html`${renderNumbers()} ${exportButtonsHtml(figure, csvTitle)} ${embeddingControlsHtml(figure)}`)}
    <div class="begin">${linkButtonHtml(figure)} ${figure.presentationMode.buttonHtml()}</div>
  </div>
  <p class="on-paper small">${noiseParametersHtml(figure)}</p>`;
}

function noiseParametersHtml({ definition: { attributes, sliderSpecs }, settings: { requestedValues: settingValues } }: Figure) {
  return Object.entries(sliderSpecs).filter(([, { alpha }]) => alpha).flatMap(([settingKey, { symbol: settingSymbol = '', decimals }]) => {
    const alphaValue = attributes[settingKey].getValue(settingValues) as number | null;
    return alphaValue === null ? [] : html`${formatMarkup(`${settingSymbol}\u00a0=\u00a0${formatEditable(alphaValue, decimals)}`)}\u2003 `;
  });
}

/** Returns a picture or chart below its title. */
export function panelHtml(title: string, panelContent: unknown, className?: string) {
  return html`<figure class="panel ${className ?? ''}">
    <p class="panel-title">${title}</p>
    ${panelContent}
  </figure>`;
}

export const declarationOf = (figure: Figure, settingKey: string): Declaration & AllowedNumbers =>
  (figure.definition.settingDeclarations.find((settingDeclaration) => settingDeclaration.key === settingKey) ?? figure.definition.elementFields[settingKey]) as any;

function findSettingWords(figure: Figure, settingKey: string): { name: string, effect?: string } {
  const [motionModel, index] = figure.definition.sliderSpecs[settingKey]?.alpha ?? [];
  const [alphaName, alphaEffect] = motionModel ? words.alphas[motionModel][index as number] : [];
  return { ...(words.settings as any)[settingKey], ...(motionModel && { name: alphaName, effect: alphaEffect }), ...(words as any)[figure.definition.messageKey].settings[settingKey] };
}

/** Returns the legend of a figure's pictures, with names from the message catalogue. */
export function legendHtml(figure: Figure, stylesByLine: Record<string, LineStyle>) {
  const { overlays: shownOverlays } = figure.settings.elementState;
  const { overlays: overlayNames } = (words as any)[figure.definition.messageKey];
  const styleNames = Object.keys(stylesByLine);
  const allOverlays = figure.definition.attributes.overlays.words as string[];
  const setOverlayShown = (toggledName: string, isShown: boolean) =>
    figure.gesture.setElementField('overlays', allOverlays.filter((overlayName) => (overlayName === toggledName ? isShown : shownOverlays.includes(overlayName))));
  const highlightLine = (lineName: string | null) => (figure.highlight = lineName);
  return html`<div class="legend" part="legend" role="group" aria-label=${words.legendLabel}>
    ${styleNames.map((overlayName) => html`<span @pointerenter=${() => highlightLine(overlayName)} @pointerleave=${() => highlightLine(null)} @focusin=${() => highlightLine(overlayName)} @focusout=${() => highlightLine(null)}>
      ${checkboxHtml({
        labelContent: html`${swatchHtml(stylesByLine[overlayName])}<span>${formatMarkup(overlayNames[overlayName])}</span>`,
        isChecked: shownOverlays.includes(overlayName),
        onChange: (isShown) => setOverlayShown(overlayName, isShown),
      })}
    </span>`)}
  </div>`;
}
