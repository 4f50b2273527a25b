const CORE_ADDRESS = new URL('../../dist/core.js', import.meta.url).href;
let copyCount = 0;

/**
 * Returns a new instance of the built module, because `load` caches its first core.
 *
 * @returns {Promise<any>} any, because tests also call it with wrong types
 */
export function importFreshModule() {
  copyCount += 1;
  return import(`${CORE_ADDRESS}?copy=${copyCount}`);
}
