/**
 * Every widget there is.
 *
 * @module
 */

import './banana-machine/banana-machine.js';
import './map-squeeze/map-squeeze.js';
