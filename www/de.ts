/** German words of the elements. A page may load this script before or after that of the elements. */

import { de } from './messages/de.ts';
import { setMessages } from './messages/registry.ts';
import { de as banana } from './widgets/banana-machine/de.ts';
import { de as squeeze } from './widgets/map-squeeze/de.ts';
import { de as anatomy } from './widgets/arc-anatomy/de.ts';
import { de as decomposer } from './widgets/odometry-decomposer/de.ts';
import { de as reckoning } from './widgets/dead-reckoning/de.ts';
import { de as calibrator } from './widgets/alpha-calibrator/de.ts';

const widgetWords = { banana, squeeze, anatomy, decomposer, reckoning, calibrator };

/** Messages of each widget, by the widget's short name. The messages of all languages have the same type. */
export type WidgetWords = typeof widgetWords;

setMessages('de', { ...de, ...widgetWords });
