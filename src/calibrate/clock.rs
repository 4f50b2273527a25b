//! How far two clocks are apart, by when the robot turned.

use super::trajectory::Trajectory;

/// Between two looks at the turns, s: a robot does not begin and end a turn in less than a few of them.
const STEP: f64 = 0.05;

/// The deviation (s) of an offset that was found by such looks: anything up to half a step from the best of them.
pub(super) const KNOWN_TO: f64 = STEP * 0.288_675_134_594_812_9;

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

/// Products of two rates in a step: some twenty milliseconds of them.
const WORK: usize = 8_000_000;

/// By how much (s) the reference's clock is ahead of the odometry's, being sought: where the correlation of their turn rates is
/// largest. Where they are not alike anywhere, as of a robot that does not turn, 0 if the recordings overlap at all, and none if they
/// do not.
///
/// Where the recordings overlap for half of the shorter one at least, and are surely alike at an offset of [`NEARLY`] 10 s at most, that
/// is taken; otherwise any that makes them overlap so is looked at, coarsely, and then ever finer around the best.
#[derive(Clone, Debug, Default)]
pub(super) struct Alignment {
    look: Option<Look>,
    /// The best of what is near, once that was looked at.
    near: Option<Option<Likeness>>,
    /// How many looks are done.
    looks: u8,
}

/// An offset (s), and how alike the turn rates are there.
type Likeness = (f64, f64);

impl Alignment {
    /// How much is done, from 0 to 1; of the looks that are left nobody knows how many they are.
    pub fn progress(&self) -> f64 {
        let share = |look: &Look| look.alike.len() as f64 / (look.offsets + 1) as f64;
        1.0 - libm::exp2(-(f64::from(self.looks) + self.look.as_ref().map_or(0.0, share)))
    }

    /// Goes on by a step; the offset after the last one.
    pub fn step(&mut self, odometry: &Trajectory, reference: &Trajectory) -> Option<Option<f64>> {
        let [Some([from, to]), Some([start, end])] = [odometry, reference].map(Trajectory::span) else {
            return Some(None);
        };
        let half = 0.5 * (to - from).min(end - start);
        let finest = STEP.max(0.5 * odometry.usual_step()).max((to - from) / MOST);
        let common = to.min(end) - from.max(start);
        let look_at = |range, step: f64| Some(Look::new(odometry, reference, range, finest.max(step)));
        let range = [start - to + half, end - from - half];
        let anywhere = || look_at(range, (range[1] - range[0]) / COARSE);
        if self.look.is_none() && common < half {
            self.near = Some(None);
            self.look = anywhere();
        }
        let nearly = || look_at([-NEARLY, NEARLY], NEARLY / COARSE);
        let mut look = self.look.take().or_else(nearly)?;
        if !look.go_on() {
            self.look = Some(look);
            return None;
        }
        self.looks += 1;
        let found = look.best();
        let Some(near) = self.near else {
            if let Some((lag, _)) = found.filter(|(_, alike)| *alike >= SURELY) {
                return Some(Some(lag));
            }
            self.near = Some(found);
            self.look = anywhere();
            return None;
        };
        if let Some((about, _)) = found.filter(|_| look.step > finest) {
            let around = [about - 2.0 * look.step, about + 2.0 * look.step];
            self.look = look_at(around, look.step / 50.0);
            return None;
        }
        // Of two that are as alike the nearer one.
        Some(match [near, found] {
            [Some((lag, alike)), Some((_, farther))] if farther - alike < CLEARLY => Some(lag),
            [_, Some((lag, _))] | [Some((lag, _)), None] => Some(lag),
            [None, None] => (common >= 0.0).then_some(0.0),
        })
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

/// Turn rates at all offsets of a range.
#[derive(Clone, Debug)]
struct Look {
    /// The first offset, s.
    from: f64,
    /// Between two of them, s.
    step: f64,
    read: Vec<Option<f64>>,
    seen: Vec<Option<f64>>,
    /// Fewer rates that are known of both tell nothing.
    least: usize,
    /// How alike they are at each offset so far, and how many offsets there are.
    alike: Vec<f64>,
    offsets: usize,
}

impl Look {
    fn new(odometry: &Trajectory, reference: &Trajectory, [from, to]: [f64; 2], step: f64) -> Self {
        let [first, last] = odometry.span().unwrap_or_default();
        let count = ((last - first) / step) as usize;
        let offsets = ((to - from) / step).round() as usize + 1;
        let read = Turns::new(odometry).rates(first, step, count);
        let seen = Turns::new(reference).rates(first + from, step, count + offsets - 1);
        let known = |rates: &[Option<f64>]| rates.iter().flatten().count();
        let least = known(&read).min(known(&seen)) / 2;
        Self { from, step, read, seen, least, alike: Vec::with_capacity(offsets), offsets }
    }

    /// Whether all is looked at.
    fn go_on(&mut self) -> bool {
        let until = self.offsets.min(self.alike.len() + WORK / self.read.len().max(1) + 1);
        for offset in self.alike.len()..until {
            self.alike.push(correlation(&self.read, &self.seen[offset..], self.least));
        }
        until == self.offsets
    }

    /// Where they are most alike, to a part of a step, and how much; none where they are not.
    fn best(&self) -> Option<Likeness> {
        let (place, most) = self.alike.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        if most < ALIKE {
            return None;
        }
        // The vertex of the parabola through it and its neighbours.
        let beside = |place: usize| self.alike.get(place).copied().unwrap_or(most);
        let (before, after) = (beside(place.wrapping_sub(1)), beside(place + 1));
        let bend = before - 2.0 * most + after;
        let part = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
        Some((self.from + (place as f64 + part) * self.step, most))
    }
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
