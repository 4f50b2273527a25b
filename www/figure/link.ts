/**
 * State in the page's address. Each figure has a part of the fragment: `#plain-anchor&banana-machine.1=…&map-squeeze:my-id=…`.
 * A figure opens its part and keeps it up to date; with `share`, it adds one.
 */

import { pack, unpack } from './packing.ts';
import { Part } from './part.ts';

export class Link extends Part {
  /** State from the address that waits for the machine. */
  #pending: unknown;
  /** Tokens of the latest read and write of the address. The results of earlier ones are dropped. */
  #latestRead = {};
  #latestWrite = {};

  hostConnected() {
    addEventListener('hashchange', this.#changed);
    scrollToAnchor();
    // The reader may have followed another link meanwhile.
    if (linked === parts()[0] && this.#isOf(linked)) {
      linked = undefined;
      this.#scrollHere();
    }
  }

  hostDisconnected() {
    removeEventListener('hashchange', this.#changed);
  }

  #changed = () => {
    if (this.#isOf(parts()[0])) this.#scrollHere();
    void this.follow();
  };

  /** Returns true for this figure's part of the address. */
  #isOf(part: string | undefined) {
    return part?.startsWith(`${keyOf(this.host)}=`);
  }

  /** Scrolls to the figure that a link names. */
  #scrollHere() {
    const { host } = this;
    // The figure has its height then.
    void host.updateComplete.then(() => host.scrollIntoView());
  }

  /** Reads the state to open with, before the first machine. */
  async prepare() {
    if (!this.host.state.kept) await this.follow();
  }

  /** Applies the state that waited for the machine. */
  applyPending() {
    const pending = this.#pending;
    this.#pending = undefined;
    if (pending !== undefined) this.host.runtime.attemptOrReport(() => this.host.setState(pending as any));
  }

  /** Applies the state in the page's address. */
  follow = async () => {
    const request = (this.#latestRead = {});
    const state = await this.#read();
    if (request !== this.#latestRead) return;
    this.#pending = state;
    if (this.host.machine) this.applyPending();
  };

  /** Returns the state in the address, if any. */
  async #read(): Promise<unknown> {
    const key = `${keyOf(this.host)}=`;
    const text = parts().find((part) => part.startsWith(key))?.slice(key.length);
    if (text === undefined) return undefined;
    try {
      return await unpack(text);
    } catch (error) {
      this.host.runtime.report(error);
    }
  }

  /** Writes the state into the address, if `share` is set or the address has the figure's state. It neither scrolls nor adds to the history. */
  async write() {
    if (!this.host.share && !parts().some((part) => this.#isOf(part))) return;
    const request = (this.#latestWrite = {});
    const text = await this.#pack();
    if (request !== this.#latestWrite || !this.host.isConnected) return;
    const address = addressWith(keyOf(this.host), text);
    if (address === location.href) return;
    try {
      history.replaceState(history.state, document.title, address);
    } catch {
      // Pages without an address of their own, such as those made by a script, throw.
    }
  }

  /** Returns the address of this page with the state. The figure's part comes first, or after an anchor of the page. */
  async address(): Promise<string> {
    return addressWith(keyOf(this.host), await this.#pack(), !isAnchor(parts()[0]));
  }

  #pack() {
    return pack(this.host.getState() ?? {});
  }
}

/** Returns the key of an element's part: its tag with its id or its index among elements of that tag. Keys of shadow hosts come first. */
function keyOf(element: Element): string {
  const { localName, id } = element;
  const root = element.getRootNode() as any;
  const name = (root.host ? `${keyOf(root.host)}/` : '') + encodeURIComponent(localName);
  if (id) return `${name}:${encodeURIComponent(id)}`;
  const kind = [...root.querySelectorAll(CSS.escape(localName))];
  return `${name}.${kind.indexOf(element) + 1}`;
}

/** Returns the page's address with a figure's part added or replaced, or moved to the beginning if `first` is true. */
function addressWith(key: string, text: string, first: boolean = false): string {
  const part = `${key}=${text}`;
  const all = parts();
  const at = all.findIndex((each) => each.startsWith(`${key}=`));
  const others = all.filter((_, i) => i !== at);
  const next = first ? [part, ...others] : at < 0 ? [...all, part] : all.with(at, part);
  // The address is complete, because a base element would change a relative one.
  return `${location.href.replace(/#.*/, '')}#${next.join('&')}`;
}

const parts = () => location.hash.slice(1).split('&').filter((part) => part !== '');

const isAnchor = (part: string | undefined) => part !== undefined && !part.includes('=');

let hasScrolled = false;

/** First part of the fragment of a followed link, until the page has scrolled to it. */
let linked: string | undefined;

/** Scrolls to an anchor of the page, once. Browsers do not find it, because the fragment also has the states. */
function scrollToAnchor() {
  if (hasScrolled) return;
  hasScrolled = true;
  // On a reload the browser restores the scroll position.
  const [navigation] = performance.getEntriesByType('navigation') as PerformanceNavigationTiming[];
  if (navigation?.type !== 'navigate') return;
  const [first, second] = parts();
  linked = first;
  if (second && isAnchor(first)) document.getElementById(decoded(first))?.scrollIntoView();
}

function decoded(text: string) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
