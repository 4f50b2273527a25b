/** Address of the script that defines the elements; a bundle knows it in another way. Empty where it is unknown. */
export const address = import.meta.url;

/** True for a classic script. */
export const classic = false;
