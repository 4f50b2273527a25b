/**
 * What Map Squeeze says when, in the words of the present language: verdicts, sentences about robots
 * that cannot move, and the text that stands for the picture.
 */

import { addEnglish, words } from '../../messages/registry.js';
import { verdict as bits } from '../../settings.js';
import { counted, fixed, percent } from '../../ui/format.js';
import { commandText } from '../shared/command.js';
import { en } from './en.js';
import { throughText } from './reading.js';

/**
 * @import { Plan, SqueezeSettings as Settings, SqueezeStats as Stats } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 */

addEnglish({ squeeze: en });

/** What is said of a draw that stays. @param {Settings} config */
export function keptWords({ conditioned }) {
  return conditioned ? words.squeeze.accepted : words.squeeze.kept;
}

/**
 * @param {number} verdict see `verdict` of settings.js
 * @param {Settings} config
 */
export function verdictText(verdict, config) {
  const is = (/** @type {number} */ bit) => (verdict & bit) !== 0;
  const { rejected, verdict: reasons } = words.squeeze;
  const accepted = is(bits.accepted);
  if (!accepted && config.sampler === 'sub-stepped') return `${rejected}: ${reasons.part}`;
  const { kept, through } = keptWords(config);
  const outcome = accepted ? kept : rejected;
  if (!is(bits.endFree)) return `${outcome}: ${reasons.end}`;
  if (is(bits.pathFree)) return `${outcome}: ${reasons.free}`;
  return `${accepted ? through : outcome}: ${reasons.way}`;
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
  const certain = conditioned && sampler === 'whole-arc';
  // Before the first sample it is called what it will be.
  if (Number.isNaN(throughWallRate)) return { text: percent(NaN), interval: !certain && !gaveUp };
  if (certain) return { text: words.squeeze.byConstruction, interval: false };
  if (gaveUp) return { text: percent(throughWallRate), interval: false };
  return { text: `${percent(throughWallRate)} (${fixed(100 * low, 1)}–${percent(high)})`, interval: true };
}

/** What the picture shows, in one sentence; and what keeps the robot from moving, if something does. @param {Reading} reading */
export function verdictOf({ config, stats, note }) {
  const { accepted, attempts, gaveUp } = stats;
  // Of one that is wedged the note counts all there is.
  if (note && (accepted === 0 || gaveUp)) return note;
  if (attempts === 0) return words.squeeze.noneYet;
  const sentence = sentenceOf(config, { ...stats, all: attempts });
  return note ? `${sentence} ${note}` : sentence;
}

/**
 * @param {Pick<Settings, 'conditioned' | 'sampler'>} config
 * @param {Pick<Stats, 'accepted' | 'throughWall' | 'throughWallRate'> & { all: number }} counts
 */
function sentenceOf({ conditioned, sampler }, { accepted, all, ...stats }) {
  const say = words.squeeze;
  const tested = say.tested[conditioned ? sampler : 'off'](counted(accepted), counted(all));
  return say.verdictOf(tested, throughText(stats));
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
  return words.squeeze.mapText(name, fixed(right - left, 1), fixed(top - bottom, 1), count, counted(count));
}

/**
 * The text equivalent of the picture.
 *
 * @param {Reading} reading
 * @param {string} map as `mapText` has it
 */
export function pictureText({ config, stats, sorted, note }, map) {
  const { x, y, theta } = config.start;
  const { attempts, accepted, drawn, throughWall } = stats;
  const { kept, ofThem } = keptWords(config);
  const say = words.squeeze;
  const parts = config.conditioned && config.sampler === 'sub-stepped';
  return [
    say.picture(map),
    say.robotAt(fixed(x, 2), fixed(y, 2), fixed(theta, 2), commandText(config.command)),
    say.outcome(counted(drawn), parts, counted(accepted), kept, counted(throughWall), ofThem, !sorted),
    accepted < attempts && config.conditioned ? say.rest(!sorted) : '',
    note,
  ].filter(Boolean).join(' ');
}
