//! How far two clocks are apart, by when the robot turned.

use super::trajectory::Trajectory;

/// Between two looks at the turns, s: a robot does not begin and end a turn in less than a few of them.
const STEP: f64 = 0.05;

/// Clocks of one computer network differ by less than this, s: further away a drive in circles would be found again in its next
/// round.
const NEARLY: f64 = 10.0;

/// Samples of a coarse look, where the clocks have nothing to do with each other: an hour of them is a second each.
const COARSE: f64 = 4096.0;

/// Looks at most: what takes longer than an hour and a half is looked at less often.
const MOST: f64 = 100_000.0;

/// How alike the turn rates have to be: what two that have nothing to do with each other reach in a few seconds.
const ALIKE: f64 = 0.5;

/// Turns of one robot, at the right offset, are alike to a few hundredths: further away nothing is looked for.
const SURELY: f64 = 0.9;

/// By how much more alike they have to be far away.
const CLEARLY: f64 = 0.05;

/// By how much (s) the reference's clock is ahead of the odometry's: where the correlation of their turn rates is largest. Where
/// they are not alike anywhere, as of a robot that does not turn, 0 if the recordings overlap at all, and none if they do not.
///
/// Where the recordings overlap for half of the shorter one at least, and are surely alike at an offset of [`NEARLY`] 10 s at most, that
/// is taken; otherwise any that makes them overlap so is looked at.
pub(super) fn clock_offset(odometry: &Trajectory, reference: &Trajectory) -> Option<f64> {
    let [Some([from, to]), Some([start, end])] = [odometry, reference].map(Trajectory::span) else {
        return None;
    };
    let [read, seen] = [odometry, reference].map(Turns::new);
    let half = 0.5 * (to - from).min(end - start);
    let finest = STEP.max(0.5 * odometry.usual_step()).max((to - from) / MOST);
    let common = to.min(end) - from.max(start);
    let near = if common >= half {
        best(&read, &seen, [-NEARLY, NEARLY], finest.max(NEARLY / COARSE))
    } else {
        None
    };
    if let Some((lag, _)) = near.filter(|(_, alike)| *alike >= SURELY) {
        return Some(lag);
    }
    let range = [start - to + half, end - from - half];
    let mut step = finest.max((range[1] - range[0]) / COARSE);
    let mut far = best(&read, &seen, range, step);
    while let Some((about, _)) = far.filter(|_| step > finest) {
        let around = [about - 2.0 * step, about + 2.0 * step];
        step = finest.max(step / 50.0);
        far = best(&read, &seen, around, step);
    }
    // Of two that are as alike the nearer one.
    match [near, far] {
        [Some((lag, alike)), Some((_, farther))] if farther - alike < CLEARLY => Some(lag),
        [_, Some((lag, _))] | [Some((lag, _)), None] => Some(lag),
        [None, None] => (common >= 0.0).then_some(0.0),
    }
}

/// Turns of a trajectory since its beginning.
struct Turns<'a> {
    trajectory: &'a Trajectory,
    times: Vec<f64>,
    turned: Vec<f64>,
}

impl<'a> Turns<'a> {
    fn new(trajectory: &'a Trajectory) -> Self {
        let times = trajectory.samples().map(|(time, _)| time).collect();
        Self { trajectory, times, turned: trajectory.turned() }
    }

    /// By how much it turns from each of `count` times to the next; none outside, and across gaps.
    fn rates(&self, start: f64, step: f64, count: usize) -> Vec<Option<f64>> {
        let (mut next, mut gaps) = (0, 0);
        // With how many gaps there are before.
        let mut at = |time: f64| {
            while next < self.times.len() && self.times[next] < time {
                next += 1;
                gaps += usize::from(next < self.times.len() && self.trajectory.has_gap_before(next));
            }
            let after = *self.times.get(next)?;
            if after == time {
                return Some((gaps, self.turned[next]));
            }
            let before = next.checked_sub(1).filter(|_| !self.trajectory.has_gap_before(next))?;
            let share = (time - self.times[before]) / (after - self.times[before]);
            Some((gaps, self.turned[before] + share * (self.turned[next] - self.turned[before])))
        };
        let turned: Vec<Option<(usize, f64)>> = (0..=count).map(|i| at(start + i as f64 * step)).collect();
        let turn = |pair: &[Option<(usize, f64)>]| {
            let [(before, from), (after, to)] = [pair[0]?, pair[1]?];
            (before == after).then_some(to - from)
        };
        turned.windows(2).map(turn).collect()
    }
}

/// The lag in a range at which two are most alike, to a part of `step`, and how much; none where they are not.
fn best(read: &Turns, seen: &Turns, [from, to]: [f64; 2], step: f64) -> Option<(f64, f64)> {
    let (first, last) = (*read.times.first()?, *read.times.last()?);
    let count = ((last - first) / step) as usize;
    let lags = ((to - from) / step).round() as usize + 1;
    let read = read.rates(first, step, count);
    let seen = seen.rates(first + from, step, count + lags - 1);
    let known = |rates: &[Option<f64>]| rates.iter().flatten().count();
    let least = known(&read).min(known(&seen)) / 2;
    let alike: Vec<f64> = (0..lags).map(|lag| correlation(&read, &seen[lag..], least)).collect();
    let (lag, most) = alike.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    if most < ALIKE {
        return None;
    }
    // The vertex of the parabola through it and its neighbours.
    let beside = |lag: usize| alike.get(lag).copied().unwrap_or(most);
    let (before, after) = (beside(lag.wrapping_sub(1)), beside(lag + 1));
    let bend = before - 2.0 * most + after;
    let part = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
    Some((from + (lag as f64 + part) * step, most))
}

/// Pearson's, of as many as are known of both; 0 where that is fewer than `least`, or one does not change.
fn correlation(a: &[Option<f64>], b: &[Option<f64>], least: usize) -> f64 {
    let pairs = || a.iter().zip(b).filter_map(|(a, b)| a.zip(*b));
    let (mut count, mut sums) = (0.0, [0.0; 5]);
    for (x, y) in pairs() {
        count += 1.0;
        for (sum, term) in sums.iter_mut().zip([x, y, x * x, y * y, x * y]) {
            *sum += term;
        }
    }
    let [x, y, xx, yy, xy] = sums.map(|sum| sum / count);
    let spread = (xx - x * x) * (yy - y * y);
    // Rates that are constant but for rounding have no spread.
    if count < least as f64 || spread <= 1e-18 * xx * yy || !spread.is_finite() {
        return 0.0;
    }
    (xy - x * y) / spread.sqrt()
}
