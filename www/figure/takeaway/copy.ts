/** Buttons that copy a link to the figure, or its HTML. */

import { html, nothing } from 'lit';
import { address, classic } from '../../address.ts';
import { words } from '../../messages/registry.ts';
import { escaped } from '../../scene/svg.ts';
import { button } from '../../ui/controls.ts';
import { Part } from '../part.ts';

export type Kind = 'link' | 'code';

/** Buttons that copy a text. Each has a message, or shows the text if the clipboard cannot be used. */
export class CopyMenu extends Part {
  #copied: { kind: Kind, text: string, done?: boolean, missing: string } | undefined;

  /** Copies a text. The message says which parts of the state it does not have. */
  async #copy(kind: Kind, text: string) {
    const missing = this.host.takeaway.notInCopies ?? '';
    // Frames without permission may not use the clipboard. Pages without HTTPS do not have it.
    const done = await Promise.resolve(navigator.clipboard?.writeText(text).then(() => true)).catch(() => undefined);
    this.#copied = { kind, text, done, missing };
    this.host.requestUpdate();
  }

  /** Clears the message. */
  forget() {
    this.#copied = undefined;
    this.host.requestUpdate();
  }

  linkButton() {
    const say = words.copies;
    return button(say.link, async () => this.#copy('link', await this.host.shareLink()), { title: say.linkTitle });
  }

  /** Returns the button that copies the HTML, with its message. */
  codeButton() {
    const say = words.copies;
    const { host } = this;
    return html`<fieldset class="copies" part="copies">
      <legend>${say.label}</legend>
      <div class="buttons">
        ${button(say.code, () => this.#copy('code', host.embedCode()), { title: say.codeTitle })}
      </div>
      ${this.answer('code')}
    </fieldset>`;
  }

  /** Returns the message of a button. */
  answer(kind: Kind) {
    const say = words.copies;
    const copied = this.#copied?.kind === kind ? this.#copied : undefined;
    return html`<output class="copied">${copied ? `${copied.done ? say.done : say.byHand} ${copied.missing}` : nothing}</output>
      ${copied && !copied.done
        ? html`<textarea readonly rows="3" aria-label=${say.byHand} .value=${copied.text}></textarea>`
        : nothing}`;
  }
}

/** Address of the published script, used if the address of this script is unknown. */
const PUBLISHED = 'https://cdn.jsdelivr.net/npm/motion-widgets@0.1/dist/external.js';

/** Returns HTML for any page: the script, and the tag with the attributes that differ from the defaults. */
export function embedding(figure: import('../figure.ts').Figure) {
  const given = ['theme', 'lang', 'dir'].map((name) => [name, figure.getAttribute(name) ?? ''] as [string, string]);
  const needed = figure.machine ? figure.reflection.nonDefaultAttributes() : [];
  // Addresses of local files and inline scripts do not work on other pages.
  const known = /^https?:/.test(address);
  const kind = (known && classic ? ['defer', ''] : ['type', 'module']) as [string, string];
  const script = tag('script', [kind, ['src', known ? address : PUBLISHED]]);
  return `${script}\n${tag(figure.localName, [...given.filter(([, text]) => text !== ''), ...needed])}\n`;
}

function tag(name: string, attributes: [string, string][]) {
  return `<${name}${attributes.map(([key, text]) => (text === '' ? ` ${key}` : ` ${key}="${escaped(text)}"`)).join('')}></${name}>`;
}
