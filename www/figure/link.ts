/**
 * The state in the page's address: each element has a part of the fragment of its own, and leaves all
 * others as they are: `#plain-anchor&banana-machine.1=…&map-squeeze:my-id=…`. Every element opens what
 * is there for it, so that a link which was copied works, and keeps it up to date. One that is shared writes there in any case.
 */

import { pack, unpack } from './packing.ts';
import { Part } from './part.ts';

export class Link extends Part {
  /** A state from the address that waits for the machine. */
  #pending: unknown;
  /** The latest look at the address, and the latest text for it: an earlier one that is ready later is void. */
  #latestRead = {};
  #latestWrite = {};

  hostConnected() {
    addEventListener('hashchange', this.#changed);
    scrollToAnchor();
    // The reader may have gone elsewhere before it came.
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

  /** Checks whether a part of the address is this figure's. */
  #isOf(part: string | undefined) {
    return part?.startsWith(`${keyOf(this.host)}=`);
  }

  /** Who follows a link to this figure is to see it. */
  #scrollHere() {
    const { host } = this;
    // It has its room then.
    void host.updateComplete.then(() => host.scrollIntoView());
  }

  /** Looks for a state to open in: the first time only, as the address says where the figure began. */
  async prepare() {
    if (!this.host.state.kept) await this.follow();
  }

  /** Enters the state that waited for the machine. */
  applyPending() {
    const pending = this.#pending;
    this.#pending = undefined;
    if (pending !== undefined) this.host.runtime.attemptOrReport(() => this.host.setState(pending as any));
  }

  /** The page's address may carry another state. */
  follow = async () => {
    const request = (this.#latestRead = {});
    const state = await this.#read();
    if (request !== this.#latestRead) return;
    this.#pending = state;
    if (this.host.machine) this.applyPending();
  };

  /** @returns undefined where the address has no state */
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

  /**
   * Puts the state into the page's address, where that is shared or has a state of the figure. The page does not move, and
   * going back does not lead through it.
   */
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
      // A page that was put together by a script has no address to write.
    }
  }

  /** @returns the address of this page with the present state, which is gone to unless the page's own anchor is */
  async address(): Promise<string> {
    return addressWith(keyOf(this.host), await this.#pack(), !isAnchor(parts()[0]));
  }

  #pack() {
    return pack(this.host.getState() ?? {});
  }
}

/**
 * Name of an element's part: its id, or without one, its place among its kind on the page. In a shadow root it is the place there,
 * after the name of the host.
 */
function keyOf(element: Element): string {
  const { localName, id } = element;
  const root = element.getRootNode() as any;
  const name = (root.host ? `${keyOf(root.host)}/` : '') + encodeURIComponent(localName);
  if (id) return `${name}:${encodeURIComponent(id)}`;
  const kind = [...root.querySelectorAll(CSS.escape(localName))];
  return `${name}.${kind.indexOf(element) + 1}`;
}

/**
 * @param first whether it is before all others
 * @returns the page's address with it
 */
function addressWith(key: string, text: string, first: boolean = false): string {
  const part = `${key}=${text}`;
  const all = parts();
  const at = all.findIndex((each) => each.startsWith(`${key}=`));
  const others = all.filter((_, i) => i !== at);
  const next = first ? [part, ...others] : at < 0 ? [...all, part] : all.with(at, part);
  // In full: a base element of the page does not matter then.
  return `${location.href.replace(/#.*/, '')}#${next.join('&')}`;
}

function parts() {
  return location.hash.slice(1).split('&').filter((part) => part !== '');
}

const isAnchor = (part: string | undefined) => part !== undefined && !part.includes('=');

let hasScrolled = false;

/** The part of the link by which the reader came that is to be gone to, until it is. */
let linked: string | undefined;

/**
 * Goes to the page's own anchor, once: a browser looks for the whole fragment, states included, and does
 * not find it.
 */
function scrollToAnchor() {
  if (hasScrolled) return;
  hasScrolled = true;
  // On a reload the browser goes back to where the reader was.
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
