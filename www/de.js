/** German words for the elements: load it beside motion-widgets.js, before or after it. */

import { de } from './messages/de.js';
import { setMessages } from './messages/registry.js';
import { de as banana } from './widgets/banana-machine/de.js';
import { de as squeeze } from './widgets/map-squeeze/de.js';
import { de as anatomy } from './widgets/arc-anatomy/de.js';
import { de as decomposer } from './widgets/odometry-decomposer/de.js';
import { de as reckoning } from './widgets/dead-reckoning/de.js';
import { de as calibrator } from './widgets/alpha-calibrator/de.js';

setMessages('de', { ...de, banana, squeeze, anatomy, decomposer, reckoning, calibrator });
