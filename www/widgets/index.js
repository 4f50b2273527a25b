/** Every widget there is. */

import './banana-machine/banana-machine.js';
import './map-squeeze/map-squeeze.js';
