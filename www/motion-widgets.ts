/**
 * Registers the custom elements, all of them at once. In dist/ it comes twice: motion-widgets.js carries the
 * WebAssembly module inside, and motion-widgets.iife.js is that as a classic script.
 */
import './widgets/index.ts';

export { load } from './core.ts';
export { setMessages } from './messages/registry.ts';
