//! Offset of two clocks, by the correlation of turn rates.

use super::trajectory::Trajectory;

/// Step (s) of the finest scan of clock offsets. Turns of a robot last several steps.
const FINEST_STEP: f64 = 0.05;

/// Largest clock offset (s) of the first scan. Clocks of one network differ by less, and a drive in circles takes longer for one round.
const MAX_NEAR_OFFSET: f64 = 10.0;

/// Number of offsets in the coarse scan of clocks without a common start: over an hour they are 1 s apart.
const COARSE_OFFSETS: f64 = 4096.0;

/// Maximum number of turn rates that are compared at each clock offset.
const MAX_SAMPLES: f64 = 100_000.0;

/// Correlation of two turn rates below which they do not match: unrelated ones reach it within a few seconds.
const MIN_CORRELATION: f64 = 0.5;

/// Correlation at which the search for other clock offsets ends. At the right offset the correlation is 1 up to a few hundredths.
const CONFIDENT_CORRELATION: f64 = 0.9;

/// Increase of the correlation for which an offset beyond [`MAX_NEAR_OFFSET`] is preferred to one within.
const MIN_CORRELATION_GAIN: f64 = 0.05;

/// Clock offset (s), and the correlation of the two turn rates at this offset.
type Match = (f64, f64);

/// Returns the time (s) by which the reference's clock is ahead of the odometry's. At this offset the correlation of their turn rates is
/// largest.
///
/// If turn rates do not correlate at any offset, as of a robot that does not turn, the offset is 0. It is None if the recordings do not
/// overlap either. Only offsets at which half of the shorter recording overlaps the other one are compared.
pub(super) fn clock_offset(odometry: &Trajectory, reference: &Trajectory) -> Option<f64> {
    let ([from, to], [start, end]) = (odometry.span()?, reference.span()?);
    let half = 0.5 * (to - from).min(end - start);
    let common = to.min(end) - from.max(start);
    let finest = FINEST_STEP.max(0.5 * odometry.median_period()).max((to - from) / MAX_SAMPLES);
    let scan = |range: [f64; 2], step: f64| best_match(odometry, reference, range, finest.max(step));
    let near = if common < half { None } else { scan([-MAX_NEAR_OFFSET, MAX_NEAR_OFFSET], 0.0) };
    if let Some((offset, _)) = near.filter(|(_, correlation)| *correlation >= CONFIDENT_CORRELATION) {
        return Some(offset);
    }
    let range = [start - to + half, end - from - half];
    let mut step = finest.max((range[1] - range[0]) / COARSE_OFFSETS);
    let mut far = scan(range, step);
    while let Some((about, _)) = far.filter(|_| step > finest) {
        let around = [about - 2.0 * step, about + 2.0 * step];
        step = finest.max(step / 50.0);
        far = scan(around, step);
    }
    match [near, far] {
        [Some((offset, correlation)), Some((_, farther))] if farther - correlation < MIN_CORRELATION_GAIN => {
            Some(offset)
        }
        [_, Some((offset, _))] | [Some((offset, _)), None] => Some(offset),
        [None, None] => (common >= 0.0).then_some(0.0),
    }
}

/// Returns the offset within a range at which the turn rates correlate most, interpolated between steps. None if the largest correlation is
/// below [`MIN_CORRELATION`].
fn best_match(
    odometry: &Trajectory,
    reference: &Trajectory,
    [from, to]: [f64; 2],
    step: f64,
) -> Option<Match> {
    let [first, last] = odometry.span()?;
    let count = ((last - first) / step) as usize;
    let offsets = ((to - from) / step).round() as usize + 1;
    let read = turns(odometry, first, step, count);
    let seen = turns(reference, first + from, step, count + offsets - 1);
    let known = |rates: &[Option<f64>]| rates.iter().flatten().count();
    let least = known(&read).min(known(&seen)) / 2;
    let correlations: Vec<f64> =
        (0..offsets).map(|offset| correlation(&read, &seen[offset..], least)).collect();
    let (best, most) = correlations.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    if most < MIN_CORRELATION {
        return None;
    }
    // Vertex of the parabola through the best and its neighbours.
    let at = |offset: usize| correlations.get(offset).copied().unwrap_or(most);
    let (before, after) = (at(best.wrapping_sub(1)), at(best + 1));
    let bend = before - 2.0 * most + after;
    let fraction = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
    Some((from + (best as f64 + fraction) * step, most))
}

/// Returns the turns (rad) from each of `count` evenly spaced times to the next. None before and after the trajectory, and across gaps.
fn turns(trajectory: &Trajectory, start: f64, step: f64, count: usize) -> Vec<Option<f64>> {
    let times: Vec<f64> = trajectory.samples().map(|(time, _)| time).collect();
    let headings = trajectory.unwrapped_heading();
    let (mut next, mut gaps) = (0, 0);
    // Number of gaps so far, and heading.
    let mut at = |time: f64| {
        while next < times.len() && times[next] < time {
            next += 1;
            gaps += usize::from(next < times.len() && trajectory.has_gap_before(next));
        }
        let after = *times.get(next)?;
        if after == time {
            return Some((gaps, headings[next]));
        }
        let before = next.checked_sub(1).filter(|_| !trajectory.has_gap_before(next))?;
        let fraction = (time - times[before]) / (after - times[before]);
        Some((gaps, headings[before] + fraction * (headings[next] - headings[before])))
    };
    let headings: Vec<Option<(usize, f64)>> = (0..=count).map(|i| at(start + i as f64 * step)).collect();
    let turn = |pair: &[Option<(usize, f64)>]| {
        let [(before, from), (after, to)] = [pair[0]?, pair[1]?];
        (before == after).then_some(to - from)
    };
    headings.windows(2).map(turn).collect()
}

/// Returns Pearson's correlation over the pairs of which both numbers are known. 0 if there are fewer than `least` pairs, or one list is
/// constant.
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
