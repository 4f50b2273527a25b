/**
 * Registers the custom elements. In dist/ it comes three times: motion-widgets.js carries the
 * WebAssembly module inside, motion-widgets.iife.js is that as a classic script, and external.js
 * leaves the module in a file of its own.
 *
 * @module
 */
import './widgets/banana-machine/banana-machine.js';
import './widgets/map-squeeze/map-squeeze.js';

export { load } from './core.js';
export { setMessages } from './messages/registry.js';
