/** Registers the custom elements. */
import './elements/banana-machine.js';
import './elements/map-squeeze.js';
