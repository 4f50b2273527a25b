/**
 * Defines all custom elements. In dist/, motion-widgets.js contains the WebAssembly module, and motion-widgets.iife.js is the same as a
 * classic script.
 */

import './widgets/banana-machine/banana-machine.ts';
import './widgets/map-squeeze/map-squeeze.ts';
import './widgets/arc-anatomy/arc-anatomy.ts';
import './widgets/odometry-decomposer/odometry-decomposer.ts';
import './widgets/dead-reckoning/dead-reckoning.ts';
import './widgets/alpha-calibrator/alpha-calibrator.ts';

export { load } from './core.ts';
export { setMessages } from './messages/registry.ts';
