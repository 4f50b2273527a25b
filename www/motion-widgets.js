/**
 * Registers the custom elements, all of them at once. In dist/ it comes twice: motion-widgets.js carries the
 * WebAssembly module inside, and motion-widgets.iife.js is that as a classic script.
 */
import './widgets/index.js';

export { load } from './core.js';
export { setMessages } from './messages/registry.js';
