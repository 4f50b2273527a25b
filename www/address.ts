/**
 * Where the script that defines the elements came from, in full; a bundle has its own way to know. Empty where nothing
 * says it.
 */
export const address = import.meta.url;

/** Whether it is a classic script. */
export const classic = false;
