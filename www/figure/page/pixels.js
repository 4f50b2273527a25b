/** The screen's pixels: a window that moves to another screen, or is enlarged, has others. */

/**
 * @param {() => void} listener
 * @param {AbortSignal} signal that ends it
 */
export function onPixels(listener, signal) {
  const changed = () => {
    listener();
    onPixels(listener, signal);
  };
  matchMedia(`(resolution:${devicePixelRatio}dppx)`).addEventListener('change', changed, { once: true, signal });
}
