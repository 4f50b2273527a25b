/** Every widget there is. */

import './banana-machine/banana-machine.ts';
import './map-squeeze/map-squeeze.ts';
import './arc-anatomy/arc-anatomy.ts';
import './odometry-decomposer/odometry-decomposer.ts';
import './dead-reckoning/dead-reckoning.ts';
import './alpha-calibrator/alpha-calibrator.ts';
