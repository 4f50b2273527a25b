/** Buttons that copy texts, such as a link to the figure or its HTML. Each has a message, or shows the text if the clipboard cannot be used. */

import { html, nothing } from 'lit';
import { address, isClassic } from '../address.ts';
import { words } from '../messages/registry.ts';
import { escapeXml } from '../scene/svg.ts';
import { button, group } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

export class CopyMenu extends FigureController {
  #lastCopy: { kind: string, text: string, isCopied?: boolean, note: string } | undefined;

  async #copyText(kind: string, text: string, note: string) {
    // Frames without permission may not use the clipboard. Pages without HTTPS do not have it.
    const isCopied = await Promise.resolve(navigator.clipboard?.writeText(text).then(() => true)).catch(() => undefined);
    this.#lastCopy = { kind, text, isCopied, note };
    this.host.requestUpdate();
  }

  clearMessage() {
    this.#lastCopy = undefined;
    this.host.requestUpdate();
  }

  /** Returns a button that copies a text. The message is followed by a note, such as on the parts of the state that the text lacks. */
  button(kind: string, label: string, textOf: () => string | Promise<string>, options: { title?: string, disabled?: boolean }, noteOf: () => string | undefined = () => '') {
    return button(label, async () => this.#copyText(kind, await textOf(), noteOf() ?? ''), options);
  }

  linkButton() {
    return this.button('link', words.copies.link, () => this.host.shareLink(), { title: words.copies.linkTitle }, () => this.host.exportData.linkNote);
  }

  codeButton() {
    return group(words.copies.label, html`<div class="buttons">
        ${this.button('code', words.copies.code, () => this.host.embedCode(), { title: words.copies.codeTitle }, () => this.host.exportData.codeNote)}
      </div>
      ${this.messageHtml('code')}`, 'copies', 'copies');
  }

  /** Returns the message about the last copy, unless the button would copy another text now. */
  messageHtml(kind: string, text?: string) {
    const shownCopy = this.#lastCopy?.kind === kind && this.#lastCopy.text === (text ?? this.#lastCopy.text) ? this.#lastCopy : undefined;
    return html`<output class="copied">${shownCopy ? `${shownCopy.isCopied ? words.copies.done : words.copies.byHand} ${shownCopy.note}` : nothing}</output>
      ${shownCopy && !shownCopy.isCopied
        ? html`<textarea readonly rows="3" aria-label=${words.copies.byHand} .value=${shownCopy.text}></textarea>`
        : nothing}`;
  }
}

/** Address of the published script, used if the address of this script is unknown. */
const PUBLISHED_SCRIPT = 'https://cdn.jsdelivr.net/npm/motion-widgets@0.1/dist/external.js';

/** Returns HTML for any page: the script, and the tag with the attributes that differ from the defaults. */
export function embeddingHtml(figure: import('./figure.ts').Figure) {
  const pageAttributes = ['theme', 'lang', 'dir'].map((name) => [name, figure.getAttribute(name) ?? ''] as [string, string]);
  const stateAttributes = figure.simulation ? figure.reflection.neededAttributes() : [];
  // Addresses of local files and inline scripts do not work on other pages.
  const isWebAddress = /^https?:/.test(address);
  const scriptType = (isWebAddress && isClassic ? ['defer', ''] : ['type', 'module']) as [string, string];
  const scriptTag = tagHtml('script', [scriptType, ['src', isWebAddress ? address : PUBLISHED_SCRIPT]]);
  return `${scriptTag}\n${tagHtml(figure.localName, [...pageAttributes.filter(([, text]) => text !== ''), ...stateAttributes])}\n`;
}

function tagHtml(name: string, attributes: [string, string][]) {
  return `<${name}${attributes.map(([key, text]) => (text === '' ? ` ${key}` : ` ${key}="${escapeXml(text)}"`)).join('')}></${name}>`;
}
