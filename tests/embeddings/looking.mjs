/**
 * What there is to see on a page. Everything here runs in it, and imports nothing.
 *
 * @module
 */

/**
 * @param {Element} canvas of a figure
 * @returns {Promise<{ drawn: number, stats: number, samples: number }>} when the cloud has all of its samples: pixels
 *   nearer to the cloud's colour than to the ground, how many samples the statistics are of, and how many were asked for
 */
export async function cloudPixels(canvas) {
  const picture = /** @type {HTMLCanvasElement} */ (canvas);
  const shadow = /** @type {ShadowRoot} */ (picture.getRootNode());
  const host = /** @type {any} */ (shadow.host);
  // What one widget calls a sample is an attempt of the other.
  const counted = () => host.stats?.n ?? host.stats?.attempts ?? 0;
  const colour = (/** @type {string} */ role) => {
    const probe = document.createElement('span');
    probe.style.color = `var(--${role})`;
    (picture.parentElement ?? shadow).append(probe);
    const context = /** @type {CanvasRenderingContext2D} */ (document.createElement('canvas').getContext('2d'));
    context.fillStyle = getComputedStyle(probe).color;
    probe.remove();
    context.fillRect(0, 0, 1, 1);
    return context.getImageData(0, 0, 1, 1).data;
  };
  const distance = (/** @type {Uint8ClampedArray} */ data, /** @type {number} */ at, /** @type {Uint8ClampedArray} */ to) =>
    Math.hypot(data[at] - to[0], data[at + 1] - to[1], data[at + 2] - to[2]);
  const end = performance.now() + 60_000;
  for (;;) {
    await new Promise(requestAnimationFrame);
    // A figure may have none.
    const samples = host.samples ?? 0;
    const over = performance.now() > end;
    if (counted() !== samples && !over) continue;
    const ground = colour('paper');
    const cloud = colour('cloud');
    const copy = Object.assign(document.createElement('canvas'), { width: picture.width, height: picture.height });
    if (copy.width === 0 || copy.height === 0) continue;
    const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext('2d', { willReadFrequently: true }));
    context.fillStyle = `rgb(${ground.slice(0, 3).join(' ')})`;
    context.fillRect(0, 0, copy.width, copy.height);
    context.drawImage(picture, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let drawn = 0;
    for (let i = 0; i < data.length; i += 4) if (distance(data, i, cloud) < 0.5 * distance(data, i, ground)) drawn++;
    if (drawn > 200 || over) return { drawn, stats: counted(), samples };
  }
}

/**
 * Type around a figure and in it, sizes in px. `median` is the size that half of the figure's letters have at least.
 *
 * @param {Element} figure
 */
export function textOf(figure) {
  const type = (/** @type {Element} */ element) => {
    const { fontFamily, fontSize } = getComputedStyle(element);
    return { family: fontFamily, size: Number.parseFloat(fontSize) };
  };
  /** @type {{ size: number, letters: number }[]} */
  const found = [];
  const walker = document.createTreeWalker(/** @type {ShadowRoot} */ (figure.shadowRoot), NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const parent = node.parentElement;
    const letters = node.nodeValue?.trim().length ?? 0;
    if (parent === null || letters === 0 || parent instanceof SVGElement || parent.localName === 'style' || !parent.checkVisibility()) continue;
    found.push({ size: type(parent).size, letters });
  }
  found.sort((a, b) => a.size - b.size);
  let left = found.reduce((sum, { letters }) => sum + letters, 0) / 2;
  const median = found.find(({ letters }) => (left -= letters) <= 0)?.size ?? 0;
  const surface = /** @type {ShadowRoot} */ (figure.shadowRoot).querySelector('p, button, summary');
  return {
    page: type(/** @type {Element} */ (figure.parentElement)),
    figure: { ...type(figure), family: type(surface ?? figure).family },
    median,
  };
}

/** From before there is anything that could move. */
export function watchShifts() {
  const { shifts, heights } = Object.assign(globalThis, { shifts: /** @type {any[]} */ ([]), heights: /** @type {Map<Element, number>} */ (new Map()) });
  const observer = new PerformanceObserver((entries) => {
    for (const entry of entries.getEntries()) shifts.push(entry);
  });
  observer.observe({ type: 'layout-shift', buffered: true });
  // While no script of the page has come, a figure has the height that is kept for it.
  const look = () => {
    for (const figure of document.querySelectorAll(':is(banana-machine, map-squeeze):not(:defined)')) heights.set(figure, figure.getBoundingClientRect().height);
    requestAnimationFrame(look);
  };
  look();
}

/**
 * What has moved, where nobody has touched anything, and what it was.
 *
 * @param {boolean} movesItself whether what stands before the figure may move, which does not on account of the figure, and
 *   all that moves with it
 * @returns {{ total: number, sources: string[], grown: number[] }} `grown` is by how much each figure became higher when it
 *   came, CSS pixels
 */
export function shifts(movesItself) {
  const figure = document.querySelector('banana-machine, map-squeeze');
  const { shifts, heights } = /** @type {any} */ (globalThis);
  const isBefore = (/** @type {any} */ { node }) =>
    figure !== null && node?.compareDocumentPosition(figure) === Node.DOCUMENT_POSITION_FOLLOWING;
  const entries = shifts.filter((/** @type {any} */ { hadRecentInput, sources }) => !hadRecentInput && !(movesItself && sources.some(isBefore)));
  const placeOf = (/** @type {DOMRect} */ { x, y, width, height }) => `${width} × ${height} at ${x}, ${y}`;
  const name = (/** @type {any} */ { node, previousRect, currentRect }) =>
    `${node?.localName ?? node?.nodeName}.${node?.className ?? ''} ${placeOf(previousRect)}→${placeOf(currentRect)}`;
  return {
    total: entries.reduce((/** @type {number} */ sum, /** @type {any} */ entry) => sum + entry.value, 0),
    sources: entries.flatMap((/** @type {any} */ entry) => entry.sources.map(name)),
    grown: [...heights].map(([each, height]) => each.getBoundingClientRect().height - height),
  };
}
