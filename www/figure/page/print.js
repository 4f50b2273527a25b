/** Paper: who is about to be printed is told, and told again when it is over. */

/**
 * @param {(printing: boolean) => void} listener
 * @param {AbortSignal} signal that ends it
 */
export function onPrint(listener, signal) {
  addEventListener('beforeprint', () => listener(true), { signal });
  addEventListener('afterprint', () => listener(false), { signal });
  // Some browsers have only the one, others tell too late by the other.
  const media = matchMedia('print');
  media.addEventListener('change', () => listener(media.matches), { signal });
}
