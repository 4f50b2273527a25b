/** Every widget there is. */

import './banana-machine/banana-machine.js';
import './map-squeeze/map-squeeze.js';
import './arc-anatomy/arc-anatomy.js';
import './odometry-decomposer/odometry-decomposer.js';
import './dead-reckoning/dead-reckoning.js';
import './alpha-calibrator/alpha-calibrator.js';
