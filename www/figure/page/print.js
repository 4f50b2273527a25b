/** Paper: who is about to be printed is told, and told again when it is over. */

/**
 * @param {(printing: boolean) => void} listener
 * @returns {() => void} ends it
 */
export function onPrint(listener) {
  const before = () => listener(true);
  const after = () => listener(false);
  // Some browsers have only the one, others tell too late by the other.
  const media = matchMedia('print');
  const change = () => listener(media.matches);
  addEventListener('beforeprint', before);
  addEventListener('afterprint', after);
  media.addEventListener('change', change);
  return () => {
    removeEventListener('beforeprint', before);
    removeEventListener('afterprint', after);
    media.removeEventListener('change', change);
  };
}
