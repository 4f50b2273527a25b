/**
 * Defines all custom elements. In dist/, motion-widgets.js contains the WebAssembly module, and motion-widgets.iife.js is the same as a
 * classic script.
 */
import './widgets/index.ts';

export { load } from './core.ts';
export { setMessages } from './messages/registry.ts';
