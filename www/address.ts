/** Address of the script that defines the elements; empty if it is unknown. scripts/bundle.mjs replaces this file in some bundles. */
export const address = import.meta.url;

/** True if the script that defines the elements is a classic script, false if it is a module. */
export const isClassic = false;
