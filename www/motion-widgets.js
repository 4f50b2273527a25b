/** Registers the custom elements. */
import './elements/banana-machine.js';
