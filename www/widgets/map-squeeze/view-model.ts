/** View model of Map Squeeze. */

import { words } from '../../messages/registry.ts';
import { verdict as bits } from '../../../build/settings.js';
import { integer, fixed, percent } from '../../ui/format.ts';
import type { MapSqueeze, SqueezeSettings, SqueezeStats } from '../../types.d.ts';

export type ViewModel = ReturnType<typeof viewModelOf>;

/** Number of samples above which they are drawn as a density: dots would be indistinguishable, and take longer than a frame. */
export const MAX_DOTS = 1500;

export function viewModelOf(simulation: MapSqueeze) {
  const results = simulation.read();
  const { config, stats, verdicts, poses, startFree } = results;
  return {
    ...results,
    posesByOutcome: stats.attempts > MAX_DOTS ? undefined : groupByOutcome(poses, verdicts),
    note: stuckRobotNote(config, stats, startFree),
  };
}

function groupByOutcome(poses: Float64Array, verdicts: Uint8Array) {
  const posesOfOutcome = (outcome: number) => {
    const indices = [...verdicts.keys()].filter((i) => outcomeIndex(verdicts[i]) === outcome);
    return Float64Array.from(indices.flatMap((i) => [poses[3 * i], poses[3 * i + 1], poses[3 * i + 2]]));
  };
  return { rejected: posesOfOutcome(0), free: posesOfOutcome(1), through: posesOfOutcome(2) };
}

/** Returns 0 for a rejected sample, 1 for an accepted one, and 2 for an accepted one whose path goes through a wall. */
export function outcomeIndex(verdict: number) {
  if ((verdict & bits.accepted) === 0) return 0;
  return (verdict & bits.pathFree) === 0 ? 2 : 1;
}

/**
 * Returns a text on the accepted motions that went through a wall: their number, and their share with its interval. There is no interval if
 * the sampler excludes such motions (`certain`), or if the simulation gave up, because giving up depends on chance.
 */
export function throughWallText({ throughWall, throughWallRate, throughWallInterval: [low, high], gaveUp }: Pick<SqueezeStats, 'throughWall' | 'throughWallRate' | 'throughWallInterval' | 'gaveUp'>, isCertain: boolean) {
  const intervalText = isCertain || gaveUp ? '' : `${fixed(100 * low, 1)}\u2060–\u2060${percent(high)}`;
  return words.squeeze.throughOf(throughWall, integer(throughWall), percent(throughWallRate), intervalText);
}

/** Returns a sentence on a robot that cannot move; empty for an ordinary cloud. */
function stuckRobotNote(config: SqueezeSettings, stats: SqueezeStats, startFree: boolean): string {
  const { wedged, nothing, noRoom } = words.squeeze;
  const { accepted, drawn } = stats;
  if (stats.gaveUp) return wedged(integer(drawn), integer(accepted), integer(config.samples), throughWallText(stats, false));
  if (drawn > 0 && accepted === 0) return nothing(integer(drawn));
  return startFree ? '' : noRoom;
}
