// Generated from the declarations in src/sim by `UPDATE_SETTINGS=1 cargo test --test native settings`. Do not edit it.

/**
 * Declaration of a setting.
 *
 * @typedef {object} Declaration
 * @property {string} key name of the setting as attribute, as property and in states
 * @property {string} [in] key of the group or list that contains the setting
 * @property {string} [of] key of another setting that this setting sets in another form
 * @property {number[]} [weights] ratios of the last numbers of that other setting to this setting
 * @property {string} [field] key in the group, if a field of another group has the same key
 * @property {number} [index] index in the list, from 0
 * @property {'word' | 'number' | 'whole' | 'boolean' | 'numbers' | 'group'} type
 * @property {string[]} [words] allowed words
 * @property {string[]} [fields] keys of the fields of a group
 * @property {string} [unit]
 * @property {boolean} [nullable] true if the value may be null
 * @property {number} [min] minimum of the number, or of each number of a list
 * @property {number} [max] maximum of the number, or of each number of a list
 * @property {string | number | boolean | number[] | null} [default] initial value
 * @property {string} sentence description
 */

/** @type {Record<string, Declaration[]>} declared settings of each widget by its tag, in order */
export const settings = {
  'banana-machine': [
    { key: 'model', type: 'word', words: ['velocity', 'odometry'], default: 'velocity', sentence: 'Model of the noise; each model keeps its own alphas.' },
    { key: 'noise', type: 'word', words: ['normal', 'triangular'], default: 'normal', sentence: 'Distribution of the noise; the variances are the same.' },
    { key: 'command', type: 'group', fields: ['v', 'omega', 'dt'], sentence: 'Command of all robots.' },
    { key: 'v', in: 'command', type: 'number', unit: 'm/s', min: -1000000, max: 1000000, default: 1, sentence: 'Commanded speed; negative in reverse.' },
    { key: 'omega', in: 'command', type: 'number', unit: 'rad/s', min: -1000000, max: 1000000, default: 0, sentence: 'Commanded turn rate; positive to the left.' },
    { key: 'dt', in: 'command', type: 'number', unit: 's', min: 0.000001, max: 1000000, default: 2, sentence: 'Duration of the command.' },
    { key: 'alphas', type: 'numbers', min: 0, max: 1000000, default: [0.002, 0.002, 0.1, 0.1, 0.002, 0.002], sentence: 'Noise parameters of the present model: six of the velocity model, four of the odometry model.' },
    { key: 'alpha1', in: 'alphas', index: 0, type: 'number', min: 0, max: 1000000, default: 0.002, sentence: 'Noise parameter of the present model.' },
    { key: 'alpha2', in: 'alphas', index: 1, type: 'number', min: 0, max: 1000000, default: 0.002, sentence: 'Noise parameter of the present model.' },
    { key: 'alpha3', in: 'alphas', index: 2, type: 'number', min: 0, max: 1000000, default: 0.1, sentence: 'Noise parameter of the present model.' },
    { key: 'alpha4', in: 'alphas', index: 3, type: 'number', min: 0, max: 1000000, default: 0.1, sentence: 'Noise parameter of the present model.' },
    { key: 'alpha5', in: 'alphas', index: 4, type: 'number', nullable: true, min: 0, max: 1000000, default: 0.002, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha6', in: 'alphas', index: 5, type: 'number', nullable: true, min: 0, max: 1000000, default: 0.002, sentence: 'Noise parameter of the velocity model.' },
    { key: 'reverseAware', type: 'boolean', default: false, sentence: 'True if a drive in reverse gets noise for the rotations that the robot made, and not for two additional half turns.' },
    { key: 'isolate', type: 'whole', nullable: true, min: 1, max: 6, default: null, sentence: 'Number of the only noise parameter in effect; null for all of them.' },
    { key: 'samples', type: 'whole', min: 1, max: 10000000, default: 50000, sentence: 'Number of robots in the whole cloud.' },
    { key: 'seed', type: 'whole', min: 0, max: 9007199254740991, default: 87, sentence: 'Seed of the random numbers. Equal seeds draw equal robots.' },
  ],
  'map-squeeze': [
    { key: 'start', type: 'group', fields: ['x', 'y', 'theta'], sentence: 'Start pose of the robot.' },
    { key: 'x', in: 'start', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: 2.05, sentence: 'Position at which the robot starts.' },
    { key: 'y', in: 'start', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: 2.6, sentence: 'Position at which the robot starts.' },
    { key: 'theta', in: 'start', type: 'number', unit: 'rad', min: -1000000, max: 1000000, default: 1.5707963267948966, sentence: 'Heading of the robot at the start.' },
    { key: 'command', type: 'group', fields: ['v', 'omega', 'dt'], sentence: 'Command of all attempts.' },
    { key: 'v', in: 'command', type: 'number', unit: 'm/s', min: -1000000, max: 1000000, default: 1, sentence: 'Commanded speed; negative in reverse.' },
    { key: 'omega', in: 'command', type: 'number', unit: 'rad/s', min: -1000000, max: 1000000, default: 0, sentence: 'Commanded turn rate; positive to the left.' },
    { key: 'dt', in: 'command', type: 'number', unit: 's', min: 0.000001, max: 1000000, default: 2, sentence: 'Duration of the command.' },
    { key: 'alphas', type: 'numbers', min: 0, max: 1000000, default: [0.12, 0.12, 0.12, 0.12, 0.03, 0.03], sentence: 'Noise parameters, the six of the velocity model.' },
    { key: 'noise', of: 'alphas', weights: [1.0, 1.0, 1.0, 1.0, 0.25, 0.25], type: 'number', nullable: true, min: 0, max: 1000000, default: 0.12, sentence: 'Noise level n: the first four noise parameters are n, the others n/4. Null if they have other ratios.' },
    { key: 'clearance', type: 'number', unit: 'm', min: 0, max: 10, default: 0.13, sentence: 'Radius of the robot.' },
    { key: 'conditioned', type: 'boolean', default: true, sentence: 'True if draws are judged by the map; otherwise all are accepted.' },
    { key: 'unknown', type: 'word', words: ['free', 'blocked'], default: 'free', sentence: 'Treatment of unknown cells as free or blocked.' },
    { key: 'sampler', type: 'word', words: ['endpoint', 'whole-arc', 'sub-stepped'], default: 'endpoint', sentence: 'Sampler that judges the draws.' },
    { key: 'steps', type: 'whole', min: 1, max: 1000, default: 4, sentence: 'Parts of the command, for the sub-stepped sampler.' },
    { key: 'samples', type: 'whole', min: 1, max: 1000000, default: 600, sentence: 'Number of attempts.' },
    { key: 'seed', type: 'whole', min: 0, max: 9007199254740991, default: 7, sentence: 'Seed of the random numbers. Equal seeds draw equal motions.' },
  ],
  'arc-anatomy': [
    { key: 'start', type: 'group', fields: ['x', 'y', 'theta'], sentence: 'Start pose of the robot.' },
    { key: 'startX', in: 'start', field: 'x', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: 0, sentence: 'Position at which the robot starts.' },
    { key: 'startY', in: 'start', field: 'y', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: 0, sentence: 'Position at which the robot starts.' },
    { key: 'startTheta', in: 'start', field: 'theta', type: 'number', unit: 'rad', min: -1000000, max: 1000000, default: 0, sentence: 'Heading of the robot at the start.' },
    { key: 'next', type: 'group', fields: ['x', 'y', 'theta'], sentence: 'Pose of the robot after the command.' },
    { key: 'nextX', in: 'next', field: 'x', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: 1.1, sentence: 'Position of the robot after the command.' },
    { key: 'nextY', in: 'next', field: 'y', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: 0.5, sentence: 'Position of the robot after the command.' },
    { key: 'nextTheta', in: 'next', field: 'theta', type: 'number', unit: 'rad', min: -1000000, max: 1000000, default: 1.1, sentence: 'Heading of the robot after the command.' },
    { key: 'command', type: 'group', fields: ['v', 'omega', 'dt'], sentence: 'Command between the two poses.' },
    { key: 'v', in: 'command', type: 'number', unit: 'm/s', min: -1000000, max: 1000000, default: 1, sentence: 'Commanded speed; negative in reverse.' },
    { key: 'omega', in: 'command', type: 'number', unit: 'rad/s', min: -1000000, max: 1000000, default: 0.5, sentence: 'Commanded turn rate; positive to the left.' },
    { key: 'dt', in: 'command', type: 'number', unit: 's', min: 0.000001, max: 1000000, default: 1, sentence: 'Duration of the command.' },
    { key: 'alphas', type: 'numbers', min: 0, max: 1000000, default: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01], sentence: 'Noise parameters, the six of the velocity model.' },
    { key: 'alpha1', in: 'alphas', index: 0, type: 'number', min: 0, max: 1000000, default: 0.05, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha2', in: 'alphas', index: 1, type: 'number', min: 0, max: 1000000, default: 0.05, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha3', in: 'alphas', index: 2, type: 'number', min: 0, max: 1000000, default: 0.05, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha4', in: 'alphas', index: 3, type: 'number', min: 0, max: 1000000, default: 0.09, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha5', in: 'alphas', index: 4, type: 'number', min: 0, max: 1000000, default: 0.01, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha6', in: 'alphas', index: 5, type: 'number', min: 0, max: 1000000, default: 0.01, sentence: 'Noise parameter of the velocity model.' },
    { key: 'noise', type: 'word', words: ['normal', 'triangular'], default: 'normal', sentence: 'Distribution of the noise; the variances are the same.' },
    { key: 'printed', type: 'boolean', default: false, sentence: 'True for a radius without a sign, as Table 5.1 prints it.' },
    { key: 'map', type: 'word', words: ['none', 'prob', 'density'], default: 'none', sentence: 'Quantity of the heat map over all positions, at the heading of the final pose.' },
  ],
  'odometry-decomposer': [
    { key: 'from', type: 'group', fields: ['x', 'y', 'theta'], sentence: 'Odometry pose before the motion.' },
    { key: 'fromX', in: 'from', field: 'x', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: 0, sentence: 'Position x that odometry reports.' },
    { key: 'fromY', in: 'from', field: 'y', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: 0, sentence: 'Position y that odometry reports.' },
    { key: 'fromTheta', in: 'from', field: 'theta', type: 'number', unit: 'rad', min: -1000000, max: 1000000, default: 0, sentence: 'Heading that odometry reports.' },
    { key: 'to', type: 'group', fields: ['x', 'y', 'theta'], sentence: 'Odometry pose after the motion.' },
    { key: 'toX', in: 'to', field: 'x', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: -1.2, sentence: 'Position x that odometry reports.' },
    { key: 'toY', in: 'to', field: 'y', type: 'number', unit: 'm', min: -1000000, max: 1000000, default: -0.3, sentence: 'Position y that odometry reports.' },
    { key: 'toTheta', in: 'to', field: 'theta', type: 'number', unit: 'rad', min: -1000000, max: 1000000, default: 0.1, sentence: 'Heading that odometry reports.' },
    { key: 'rule', type: 'word', words: ['thrun', 'nav2', 'beluga', 'omni'], default: 'thrun', sentence: 'Rule that relates the α’s to the noise.' },
    { key: 'alphas', type: 'numbers', min: 0, max: 1000000, default: [0.03, 0.01, 0.01, 0.02, 0.01], sentence: 'Noise parameters of the rule; only the rule omni has the fifth.' },
    { key: 'alpha1', in: 'alphas', index: 0, type: 'number', min: 0, max: 1000000, default: 0.03, sentence: 'Noise parameter; the first four are every rule’s, the fifth the omnidirectional one’s.' },
    { key: 'alpha2', in: 'alphas', index: 1, type: 'number', min: 0, max: 1000000, default: 0.01, sentence: 'Noise parameter; the first four are every rule’s, the fifth the omnidirectional one’s.' },
    { key: 'alpha3', in: 'alphas', index: 2, type: 'number', min: 0, max: 1000000, default: 0.01, sentence: 'Noise parameter; the first four are every rule’s, the fifth the omnidirectional one’s.' },
    { key: 'alpha4', in: 'alphas', index: 3, type: 'number', min: 0, max: 1000000, default: 0.02, sentence: 'Noise parameter; the first four are every rule’s, the fifth the omnidirectional one’s.' },
    { key: 'alpha5', in: 'alphas', index: 4, type: 'number', min: 0, max: 1000000, default: 0.01, sentence: 'Noise parameter; the first four are every rule’s, the fifth the omnidirectional one’s.' },
    { key: 'noise', type: 'word', words: ['normal', 'triangular'], default: 'normal', sentence: 'Distribution of the noise; the variances are the same.' },
    { key: 'correlation', type: 'number', min: -1, max: 1, default: 0, sentence: 'Correlation of the noises of the two rotations, which the rules take to be independent.' },
    { key: 'drift', type: 'number', unit: 's', min: 0, max: 1000000, default: 40, sentence: 'Time for which the frame of the odometry has drifted away from the world.' },
    { key: 'phase', type: 'number', min: 0, max: 3, default: 3, sentence: 'Progress of the robot: in the first rotation up to 1, in the drive up to 2, in the second rotation up to 3.' },
    { key: 'samples', type: 'whole', min: 1, max: 5000, default: 500, sentence: 'Number of outcomes in the whole cloud.' },
    { key: 'seed', type: 'whole', min: 0, max: 9007199254740991, default: 25, sentence: 'Seed of the random numbers. Equal seeds draw equal outcomes.' },
  ],
  'dead-reckoning': [
    { key: 'command', type: 'group', fields: ['v', 'omega', 'dt'], sentence: 'Command of each step.' },
    { key: 'v', in: 'command', type: 'number', unit: 'm/s', min: -1000000, max: 1000000, default: 1, sentence: 'Commanded speed; negative in reverse.' },
    { key: 'omega', in: 'command', type: 'number', unit: 'rad/s', min: -1000000, max: 1000000, default: 0.5, sentence: 'Commanded turn rate; positive to the left.' },
    { key: 'dt', in: 'command', type: 'number', unit: 's', min: 0.000001, max: 1000000, default: 0.2, sentence: 'Duration of the command.' },
    { key: 'steps', type: 'whole', min: 1, max: 200, default: 20, sentence: 'Number of steps.' },
    { key: 'step', type: 'whole', min: 1, max: 200, default: 20, sentence: 'Number of the selected step.' },
    { key: 'alphas', type: 'numbers', min: 0, max: 1000000, default: [0.02, 0.02, 0.02, 0.02, 0.005, 0.005], sentence: 'Noise parameters, the six of the velocity model.' },
    { key: 'alpha1', in: 'alphas', index: 0, type: 'number', min: 0, max: 1000000, default: 0.02, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha2', in: 'alphas', index: 1, type: 'number', min: 0, max: 1000000, default: 0.02, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha3', in: 'alphas', index: 2, type: 'number', min: 0, max: 1000000, default: 0.02, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha4', in: 'alphas', index: 3, type: 'number', min: 0, max: 1000000, default: 0.02, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha5', in: 'alphas', index: 4, type: 'number', min: 0, max: 1000000, default: 0.005, sentence: 'Noise parameter of the velocity model.' },
    { key: 'alpha6', in: 'alphas', index: 5, type: 'number', min: 0, max: 1000000, default: 0.005, sentence: 'Noise parameter of the velocity model.' },
    { key: 'headingNoise', of: 'alphas', weights: [1.0, 1.0, 0.25, 0.25], type: 'number', nullable: true, min: 0, max: 1000000, default: 0.02, sentence: 'Level h of the heading noise: α₃ and α₄ are h, α₅ and α₆ are h/4. Null if they have other ratios.' },
    { key: 'per', type: 'word', words: ['step', 'path'], default: 'step', sentence: 'Motion to which the noise parameters apply: each step, or the whole path. Each of n steps then has 1/n of its variance.' },
    { key: 'compounding', type: 'word', words: ['chapter', 'first-order', 'fourth-order'], default: 'chapter', sentence: 'Recursion of the covariance that is shown.' },
    { key: 'samples', type: 'whole', min: 1, max: 1000000, default: 50000, sentence: 'Number of rollouts of the whole path.' },
    { key: 'seed', type: 'whole', min: 0, max: 9007199254740991, default: 29, sentence: 'Seed of the random numbers. Equal seeds draw equal noise for each step.' },
  ],
  'alpha-calibrator': [
    { key: 'model', type: 'word', words: ['odometry', 'omnidirectional', 'velocity'], default: 'odometry', sentence: 'Model whose α’s are calibrated: four of odometry, five of a robot that can drive sideways, or six of commands.' },
    { key: 'rule', type: 'word', words: ['thrun', 'nav2', 'beluga', 'omni'], default: 'thrun', sentence: 'Rule that relates the α’s to the noise of odometry. The rule omni belongs to the omnidirectional model.' },
    { key: 'noise', type: 'word', words: ['normal', 'triangular'], default: 'normal', sentence: 'Distribution of the noise in the predicted outcomes of a leg; the variances are the same.' },
    { key: 'outliers', type: 'word', words: ['reject', 'keep'], default: 'reject', sentence: 'Treatment of outliers, such as jumps of the reference: excluded, or fitted as noise.' },
    { key: 'distance', type: 'number', unit: 'm', min: 0.01, max: 100, default: 0.25, sentence: 'Distance in x or in y of the odometry after which a leg ends: `update_min_d` of AMCL.' },
    { key: 'angle', type: 'number', unit: 'rad', min: 0.01, max: 3, default: 0.2, sentence: 'Rotation of the odometry after which a leg ends: `update_min_a` of AMCL.' },
    { key: 'duration', type: 'number', unit: 's', min: 0, max: 1000, default: 0, sentence: 'Duration of a leg; 0 for legs that end after a distance or rotation.' },
    { key: 'mountYaw', type: 'boolean', default: true, sentence: 'Correction of the yaw at which the reference is mounted, if the log identifies it.' },
    { key: 'leverArm', type: 'boolean', default: true, sentence: 'Correction of the reference’s lever arm, if the log identifies it.' },
    { key: 'distanceScale', type: 'boolean', default: true, sentence: 'Correction of the odometry’s scale of distances, if the log identifies it and it is constant.' },
    { key: 'turnScale', type: 'boolean', default: true, sentence: 'Correction of the odometry’s scale of turns, if the log identifies it and it is constant.' },
    { key: 'clockOffset', type: 'boolean', default: true, sentence: 'Correction of the offset between the two clocks, if the log identifies it.' },
    { key: 'positionStd', type: 'number', unit: 'm', min: 0, max: 1000, default: 0, sentence: 'Standard deviation of each coordinate of the reference; 0: estimated.' },
    { key: 'yawStd', type: 'number', unit: 'rad', min: 0, max: 1000, default: 0, sentence: 'Standard deviation of the reference’s heading; 0: estimated.' },
    { key: 'inflation', type: 'number', min: 0.01, max: 100, default: 1, sentence: 'Factor of the α’s in predictions.' },
    { key: 'seed', type: 'whole', min: 0, max: 9007199254740991, default: 8, sentence: 'Seed of the simulated log.' },
  ],
};

/** Presets of the widgets, by their tags. */
export const presets = {
  'banana-machine': [
    { name: 'straight', v: 1, omega: 0, dt: 2, alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01] },
    { name: 'gentle', v: 1, omega: 0.5, dt: 1, alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01] },
    { name: 'hard', v: 1, omega: 1.2, dt: 1.4, alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01] },
    { name: 'pivot', v: 0.06, omega: 1.5, dt: 1, alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01] },
    { name: 'banana', v: 1, omega: 0, dt: 2, alphas: [0.002, 0.002, 0.1, 0.1, 0.002, 0.002] },
    { name: 'worked', v: 1, omega: 0.5, dt: 1, alphas: [0.02, 0.02, 0.02, 0.02, 0.0, 0.0] },
  ],
  'map-squeeze': [
    { name: 'doorway', start: { x: 2.05, y: 2.6, theta: 1.5707963267948966 } },
    { name: 'wall', start: { x: 3.3, y: 2.6, theta: 1.5707963267948966 } },
    { name: 'corridor', start: { x: 1.4, y: 4.4, theta: 0 } },
  ],
  'arc-anatomy': [
    { name: 'left', v: 1, omega: 0.5, dt: 1, nextX: 1.1, nextY: 0.5, nextTheta: 1.1 },
    { name: 'right', v: 1, omega: -0.5, dt: 1, nextX: 1.1, nextY: -0.5, nextTheta: -1.1 },
    { name: 'reverse', v: -1, omega: 0.5, dt: 1, nextX: -1.1, nextY: -0.5, nextTheta: 1.1 },
    { name: 'straight', v: 1, omega: 0, dt: 1, nextX: 1.2, nextY: 0, nextTheta: 0.2 },
  ],
  'odometry-decomposer': [
    { name: 'all', from: { x: 0, y: 0, theta: 0 }, to: { x: 1.2, y: 1, theta: 1.2 } },
    { name: 'turn-drive', from: { x: 0, y: 0, theta: 0 }, to: { x: 1.2, y: 0.9, theta: 0.6435 } },
    { name: 'drive-turn', from: { x: 0, y: 0, theta: 0 }, to: { x: 1.5, y: 0, theta: 1 } },
    { name: 'reverse', from: { x: 0, y: 0, theta: 0 }, to: { x: -1.2, y: -0.3, theta: 0.1 } },
    { name: 'spin', from: { x: 0, y: 0, theta: 0 }, to: { x: 0, y: 0, theta: 2.2 } },
    { name: 'rest', from: { x: 0, y: 0, theta: 0 }, to: { x: -0.004, y: 0.003, theta: 0.001 } },
  ],
  'dead-reckoning': [
    { name: 'chapter', command: { v: 1, omega: 0.5, dt: 0.2 }, steps: 20, step: 20, alphas: [0.02, 0.02, 0.02, 0.02, 0.005, 0.005] },
    { name: 'doubled', command: { v: 1, omega: 0.5, dt: 0.2 }, steps: 20, step: 20, alphas: [0.02, 0.02, 0.08, 0.08, 0.02, 0.02] },
    { name: 'fine', command: { v: 1, omega: 0.5, dt: 0.02 }, steps: 200, step: 200, alphas: [0.02, 0.02, 0.02, 0.02, 0.005, 0.005] },
    { name: 'straight', command: { v: 1, omega: 0, dt: 0.2 }, steps: 20, step: 20, alphas: [0.02, 0.02, 0.02, 0.02, 0.005, 0.005] },
  ],
  'alpha-calibrator': [],
};

/** Initial noise parameters of each model. */
export const openingAlphas = { velocity: [0.002, 0.002, 0.1, 0.1, 0.002, 0.002], odometry: [0.05, 0.05, 0.05, 0.05] };

/**
 * Limits of the core. `cells` is the maximum number of cells of a grid and of pixels of an image. `bytes` is the maximum size of an image
 * file. `trial` is the maximum product of samples and parts in a call of `MapSqueeze.trial`. `ramp` is the number of colours of a ramp.
 */
export const limits = { cells: 33554432, bytes: 201330688, trial: 100000, ramp: 256 };

/** Bits of a verdict on an attempt of Map Squeeze. */
export const verdict = { endFree: 1, pathFree: 2, accepted: 4 };
