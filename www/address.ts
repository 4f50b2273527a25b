/** Address of the script that defines the elements; empty if it is unknown. For some bundles, scripts/bundle.mjs replaces this file by another that finds the address. */
export const address = import.meta.url;

/** True if the script that defines the elements is a classic script, false if it is a module. */
export const isClassic = false;
