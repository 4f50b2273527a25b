/**
 * State in the page's address. Each figure has a part of the fragment: `#banana-machine.1=…&map-squeeze:my-id=…`. A figure with a part in
 * the address takes its state from that part, and updates the part after each change. A figure with `share` also adds a missing part.
 */

import { packJson, unpackJson } from '../data/packing.ts';
import { words } from '../messages/registry.ts';
import { FigureController } from './controller.ts';

/** Maximum length of a packed state. Firefox opens addresses of up to 1 MiB, other browsers up to 2 MiB and more. */
const MAX_PACKED_LENGTH = 1_000_000;

export class StateLink extends FigureController {
  /** True if the latest address was written without the user's map, because a map would make it too long. */
  lacksMap = false;
  /** Token of the latest write of the address. An earlier write that finishes later is dropped. */
  #latestWriteToken = {};

  hostConnected() {
    addEventListener('hashchange', () => {
      if (this.#isOwnFragmentPart(splitFragment()[0])) this.#scrollToFigure();
      void this.applyStateInAddress();
    }, { signal: this.figure.lifetime.signal });
    pendingLinkPart ??= wasOpenedByLink() ? splitFragment()[0] : '';
    if (!this.#isOwnFragmentPart(pendingLinkPart)) return;
    pendingLinkPart = '';
    this.#scrollToFigure();
  }

  #isOwnFragmentPart(fragmentPart = '') {
    return fragmentPart.startsWith(`${fragmentKeyOf(this.figure)}=`);
  }

  #scrollToFigure() {
    const { figure } = this;
    // The page scrolls after the update, which gives the figure its height.
    void figure.updateComplete.then(() => figure.scrollIntoView());
  }

  /** Applies the state in the page's address, if any, now or as soon as there is a simulation. */
  async applyStateInAddress() {
    const { figure } = this;
    const ownPart = splitFragment().find((fragmentPart) => this.#isOwnFragmentPart(fragmentPart));
    if (ownPart === undefined) return;
    try {
      const figureState = await unpackJson(ownPart.slice(ownPart.indexOf('=') + 1));
      figure.runtime.attemptOrReport(() => figure.setState(figureState as any));
    } catch (error) {
      figure.runtime.reportError(error);
      figure.notice.showNotice(() => words.unreadableLinkNotice);
    }
  }

  /** Writes the state into the address, if `share` is set or the address has the figure's state. The page does not scroll, and its history gets no entry. */
  async writeToAddress() {
    if (!this.figure.share && !splitFragment().some((fragmentPart) => this.#isOwnFragmentPart(fragmentPart))) return;
    const writeToken = (this.#latestWriteToken = {});
    const packedState = await this.#packState();
    if (writeToken !== this.#latestWriteToken || !this.figure.isConnected) return;
    const pageAddress = createAddress(fragmentKeyOf(this.figure), packedState);
    if (pageAddress === location.href) return;
    try {
      history.replaceState(history.state, document.title, pageAddress);
    } catch {
      // On pages without an address of their own, such as about:srcdoc, `replaceState` throws.
    }
  }

  /** Returns the address of this page with the state. The figure's part comes first, because a link scrolls to the figure of its first part. */
  async createShareAddress(): Promise<string> {
    return createAddress(fragmentKeyOf(this.figure), await this.#packState(), true);
  }

  async #packState() {
    const figureState = this.figure.getState() ?? {};
    const packedState = await packJson(figureState);
    this.lacksMap = packedState.length > MAX_PACKED_LENGTH;
    // A link without the map has no start pose either, because the pose may be invalid on another map.
    return this.lacksMap ? packJson({ ...figureState, map: undefined, start: undefined }) : packedState;
  }
}

/** Returns the key of an element's part: its tag with its id or its index among elements of that tag. Keys of shadow hosts come first. */
function fragmentKeyOf(element: Element): string {
  const { localName, id } = element;
  const rootNode = element.getRootNode() as any;
  const fragmentKey = (rootNode.host ? `${fragmentKeyOf(rootNode.host)}/` : '') + encodeURIComponent(localName);
  if (id) return `${fragmentKey}:${encodeURIComponent(id)}`;
  return `${fragmentKey}.${[...rootNode.querySelectorAll(CSS.escape(localName))].indexOf(element) + 1}`;
}

/** Returns the page's address with a figure's part added or replaced, or moved to the beginning if `isFirst`. */
function createAddress(fragmentKey: string, packedState: string, isFirst: boolean = false): string {
  const fragmentPart = `${fragmentKey}=${packedState}`;
  const allParts = splitFragment();
  const partIndex = allParts.findIndex((fragmentPart) => fragmentPart.startsWith(`${fragmentKey}=`));
  const otherParts = allParts.filter((_, i) => i !== partIndex);
  const newParts = isFirst ? [fragmentPart, ...otherParts] : partIndex < 0 ? [...allParts, fragmentPart] : allParts.with(partIndex, fragmentPart);
  // The address is absolute, because a `base` element would redirect a relative one.
  return `${location.href.replace(/#.*/, '')}#${newParts.join('&')}`;
}

const splitFragment = () => location.hash.slice(1).split('&').filter((fragmentPart) => fragmentPart !== '');

/** Fragment part of the figure to which a followed link still has to scroll. Empty after the scroll, and undefined until the first figure is connected. */
let pendingLinkPart: string | undefined;

/** Returns true if the page was opened by a link. After a reload, no figure needs to scroll: the browser restores the scroll position. */
function wasOpenedByLink() {
  const [navigationTiming] = performance.getEntriesByType('navigation') as PerformanceNavigationTiming[];
  return navigationTiming?.type === 'navigate';
}
