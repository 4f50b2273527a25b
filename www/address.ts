/** Address of the script that defines the elements; empty if it is unknown. scripts/bundle.mjs replaces this file in some bundles. */
export const address = import.meta.url;

/** True if that script is a classic script rather than a module. */
export const isClassic = false;
