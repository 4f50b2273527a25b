/**
 * What Map Squeeze says: captions of its parameters, verdicts, sentences about robots that cannot
 * move, and the text that stands for the picture.
 *
 * @module
 */

import { html } from 'lit';
import { fixed, percent, whole } from '../ui/format.js';
import { commandText } from './banana-words.js';

/**
 * @typedef {import('../types.d.ts').SqueezeSettings} Settings
 * @typedef {import('../types.d.ts').SqueezeStats} Stats
 * @typedef {import('../types.d.ts').SamplerName} SamplerName
 * @typedef {import('../types.d.ts').Plan} Plan
 */

/** Bits of a verdict. */
export const VERDICT = { endFree: 1, pathFree: 2, accepted: 4 };

export const PRESET_LABELS = {
  doorway: 'Facing a doorway',
  wall: 'Facing a wall',
  corridor: 'Open corridor',
};

export const SAMPLER_LABELS = {
  endpoint: 'endpoint',
  'whole-arc': 'whole arc',
  'sub-stepped': 'sub-stepped',
};

export const SAMPLERS = /** @type {SamplerName[]} */ (Object.keys(SAMPLER_LABELS));

/** What each sampler asks of a draw. */
export const SAMPLER_EFFECTS = {
  endpoint: 'Keeps a draw if the robot fits where it ends; nobody asks how it got there.',
  'whole-arc': 'Keeps a draw if the robot touches no wall all along the arc it drove.',
  'sub-stepped': html`Splits the command into <i>k</i> parts and keeps a part if the robot fits where that
    ends. At the doorway and in the corridor fewer pass a wall as <i>k</i> grows; facing the wall a larger
    share does, until the robot is stuck.`,
};

/** Sample counts of the slider. The machine takes more, but their marks would be one blot. */
export const SAMPLE_COUNTS = [1, 2, 5, 10, 20, 50, 100, 200, 300, 600, 1000, 2000, 5000, 10_000];

/** @type {import('./cloud.js').CloudWords} */
export const CLOUD_WORDS = {
  legend: 'Samples',
  play: 'Draw one after the other',
  step: (batch) => `Draw ${batch} more`,
  reset: 'Take all away; the same seed draws the same again',
  reseed: 'Draw others',
  count: 'N, samples',
  effect: 'Motions tried: more of them narrow the interval of the share through a wall.',
};

export const NOISE_SLIDER = {
  symbol: 'n',
  name: 'n, noise',
  min: 0,
  max: 0.4,
  step: 0.005,
  effect: html`Spreads the cloud: <i>α</i><sub>1</sub> to <i>α</i><sub>4</sub> are <i>n</i>, the others
    <i>n</i>/4.`,
};

export const COMMAND_SLIDERS = /** @type {const} */ ([
  {
    key: 'v',
    symbol: 'v',
    name: 'v, commanded speed',
    unit: 'm/s',
    min: -1.5,
    max: 1.5,
    step: 0.01,
    effect: 'How far it is sent, and so how many walls it may meet.',
  },
  {
    key: 'omega',
    symbol: 'ω',
    name: 'ω, commanded turn rate',
    unit: 'rad/s',
    min: -2,
    max: 2,
    step: 0.01,
    effect: 'Bends the way there: it can end in the open behind a corner.',
  },
  {
    key: 'dt',
    symbol: 'Δt',
    name: 'Δt, duration',
    unit: 's',
    min: 0.1,
    max: 4,
    step: 0.05,
    effect: 'How long it drives unwatched between two looks at the map.',
  },
]);

export const CLEARANCE_SLIDER = {
  symbol: 'r',
  name: 'r, clearance',
  min: 0,
  max: 0.4,
  step: 0.01,
  effect: 'Radius of the robot: a wider one fits in fewer places and meets more walls.',
};

export const STEPS_SLIDER = {
  symbol: 'k',
  name: 'k, parts of the command',
  min: 1,
  max: 64,
  step: 1,
  effect: html`Parts of the command. Each has noise of its own, so that the spread shrinks as 1/√<i>k</i>.`,
};

/**
 * A sentence on a robot that gets nowhere.
 *
 * @param {Settings} config
 * @param {Stats} stats
 * @param {boolean} startFree
 * @returns {string} empty for an ordinary cloud
 */
export function noteOn(config, stats, startFree) {
  const drawn = `${whole(stats.drawn)} draw${stats.drawn === 1 ? '' : 's'}`;
  if (stats.gaveUp) {
    const done = stats.accepted === 0 ? 'no motion' : `only ${whole(stats.accepted)} of ${whole(config.samples)} motions`;
    return `The robot is wedged: ${done} came to an end in the ${drawn} that were tried before giving up.`;
  }
  if (stats.drawn > 0 && stats.accepted === 0) {
    const why = config.sampler === 'whole-arc' ? 'touches no wall on its way' : 'ends where the robot fits';
    return `Nothing was accepted: of the ${drawn} that were tried, none ${why}.`;
  }
  if (!startFree) return 'The robot does not fit where it stands, so that every way from here begins in a wall.';
  return '';
}

/**
 * What is said of a draw that stays: without the condition nothing is judged, so nothing is accepted.
 *
 * @param {Settings} config
 */
export function keptWords({ conditioned }) {
  return conditioned
    ? { kept: 'accepted', through: 'accepted through a wall', ofThem: 'through a wall' }
    : { kept: 'kept', through: 'kept, way not free', ofThem: 'with a way that is not free' };
}

/** What makes a way not free, in the one place where it is explained and in verdicts. */
export const NOT_FREE = 'touches a wall or leaves the map';

/**
 * @param {number} verdict bits of `VERDICT`
 * @param {Settings} config
 */
export function verdictText(verdict, config) {
  const is = (/** @type {number} */ bit) => (verdict & bit) !== 0;
  const accepted = is(VERDICT.accepted);
  if (!accepted && config.sampler === 'sub-stepped') return 'rejected: one of its parts found no free end';
  const { kept, through } = keptWords(config);
  const outcome = accepted ? kept : 'rejected';
  if (!is(VERDICT.endFree)) return `${outcome}: the robot does not fit where it ends`;
  if (is(VERDICT.pathFree)) return `${outcome}: free at the end and all along the way`;
  return `${accepted ? through : outcome}: free at the end, but its way ${NOT_FREE}`;
}

/**
 * The share through a wall, with its interval where the draws are as many as were asked for: where
 * they end is chance too if the machine gave up.
 *
 * @param {Pick<Stats, 'throughWallRate' | 'throughWallInterval' | 'gaveUp'>} stats
 * @param {Settings} config
 * @returns {{ text: string, interval: boolean }} "32.7 % (28.8–36.9 %)"
 */
export function shareOf({ throughWallRate, throughWallInterval: [low, high], gaveUp }, { conditioned, sampler }) {
  if (Number.isNaN(throughWallRate)) return { text: percent(NaN), interval: false };
  if (conditioned && sampler === 'whole-arc') return { text: '0, by construction', interval: false };
  if (gaveUp) return { text: percent(throughWallRate), interval: false };
  return { text: `${percent(throughWallRate)} (${fixed(100 * low, 1)}–${percent(high)})`, interval: true };
}

/**
 * What is announced after a change has come to rest.
 *
 * @param {Settings} config
 * @param {Stats} stats
 * @param {string} note
 */
export function announcementOf(config, stats, note) {
  const { drawn, accepted, throughWall, throughWallRate } = stats;
  const { kept, ofThem } = keptWords(config);
  const counts = `${whole(drawn)} drawn, ${whole(accepted)} ${kept}`;
  if (note && accepted === 0) return note;
  const share = accepted > 0 ? `, ${whole(throughWall)} of them ${ofThem}: ${percent(throughWallRate)}` : '';
  return `${counts}${share}.${note ? ` ${note}` : ''}`;
}

/**
 * The name of a map with its size.
 *
 * @param {string} name
 * @param {Plan} plan
 */
export function mapText(name, { bounds, walls }) {
  const [left, bottom, right, top] = bounds;
  const count = walls.length / 4;
  return `${name}: ${fixed(right - left, 1)} m × ${fixed(top - bottom, 1)} m, ${whole(count)} wall${count === 1 ? '' : 's'}`;
}

/**
 * The text equivalent of the picture.
 *
 * @param {Settings} config
 * @param {Stats} stats
 * @param {string} map as `mapText` has it
 * @param {string} note
 */
export function pictureText(config, stats, map, note) {
  const { start } = config;
  const robot = `The robot stands at x ${fixed(start.x, 2)} m, y ${fixed(start.y, 2)} m, heading ${fixed(start.theta, 2)} rad. Commanded: ${commandText(config.command)}.`;
  const { accepted, drawn, throughWall } = stats;
  const { kept, ofThem } = keptWords(config);
  const rest = config.conditioned ? ' The rest is rejected, as crosses.' : '';
  const outcome = `${whole(drawn)} drawn; ${whole(accepted)} ${kept}, as dots; ${whole(throughWall)} of those ${ofThem}, ringed.${rest}`;
  return `Floor plan from above, x to the right and y up. ${map}. ${robot} ${outcome}${note ? ` ${note}` : ''}`;
}
