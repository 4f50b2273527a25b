//! Offset of two clocks, by the correlation of turn rates.

use super::trajectory::Trajectory;

/// Smallest step (s) of the scans of clock offsets. A robot's turn lasts several such steps.
const FINEST_STEP: f64 = 0.05;

/// Largest clock offset (s) of the first scan. Synchronized clocks differ by less. One lap of a robot that drives in circles takes longer.
const MAX_NEAR_OFFSET: f64 = 10.0;

/// Number of offsets in the coarse scan, for clocks without a common start. They are 1 s apart, and cover an hour.
const COARSE_OFFSETS: f64 = 4096.0;

/// Maximum number of turn rates that are compared at each clock offset.
const MAX_SAMPLES: f64 = 100_000.0;

/// Correlation below which turn rates do not match. Unrelated turn rates reach this correlation only over a few seconds.
const MIN_CORRELATION: f64 = 0.5;

/// Correlation at which the search for other clock offsets ends. At the right offset the correlation is 1 up to a few hundredths.
const CONFIDENT_CORRELATION: f64 = 0.9;

/// Minimum increase of the correlation for which an offset beyond [`MAX_NEAR_OFFSET`] is preferred to a smaller offset.
const MIN_CORRELATION_GAIN: f64 = 0.05;

/// Factor on the absolute value of a negative correlation, which a mirrored recording has at the right offset: its turns are opposite. In a
/// drive along a figure eight, turns are also opposite at an offset that is wrong by half a period, up to small differences.
const MIRRORED_FACTOR: f64 = 0.85;

/// Clock offset (s), and the correlation of the two turn rates at this offset.
type OffsetMatch = (f64, f64);

/// Returns the time (s) by which the reference's clock is ahead of the odometry's clock: the offset with the largest correlation of turn
/// rates.
///
/// If turn rates do not correlate at any offset, for example because the robot does not turn, the offset is 0. None if the recordings do
/// not overlap in time either. An offset is compared only if half of the shorter recording overlaps the longer recording.
pub(super) fn clock_offset(odometry: &Trajectory, reference: &Trajectory) -> Option<f64> {
    let ([odom_start, odom_end], [ref_start, ref_end]) = (odometry.span()?, reference.span()?);
    let min_overlap = 0.5 * (odom_end - odom_start).min(ref_end - ref_start);
    let overlap = odom_end.min(ref_end) - odom_start.max(ref_start);
    let finest_step =
        FINEST_STEP.max(0.5 * odometry.median_period()).max((odom_end - odom_start) / MAX_SAMPLES);
    let near_match = if overlap < min_overlap {
        None
    } else {
        best_match(odometry, reference, [-MAX_NEAR_OFFSET, MAX_NEAR_OFFSET], finest_step)
    };
    if let Some((offset, _)) = near_match.filter(|(_, correlation)| *correlation >= CONFIDENT_CORRELATION) {
        return Some(offset);
    }
    let offset_range = [ref_start - odom_end + min_overlap, ref_end - odom_start - min_overlap];
    let mut offset_step = finest_step.max((offset_range[1] - offset_range[0]) / COARSE_OFFSETS);
    let mut far_match = best_match(odometry, reference, offset_range, offset_step);
    while let Some((rough_offset, _)) = far_match.filter(|_| offset_step > finest_step) {
        let nearby_range = [rough_offset - 2.0 * offset_step, rough_offset + 2.0 * offset_step];
        offset_step = finest_step.max(offset_step / 50.0);
        far_match = best_match(odometry, reference, nearby_range, offset_step);
    }
    // An offset outside of the first scan is accepted only if its correlation is clearly larger.
    let near_match = near_match.map(|(offset, correlation)| (offset, correlation + MIN_CORRELATION_GAIN));
    let best_match = [near_match, far_match].into_iter().flatten().max_by(|a, b| a.1.total_cmp(&b.1));
    best_match.map(|(offset, _)| offset).or((overlap >= 0.0).then_some(0.0))
}

/// Returns the offset within a range at which the turn rates correlate most, interpolated between steps. None if the largest correlation is below [`MIN_CORRELATION`].
fn best_match(
    odometry: &Trajectory,
    reference: &Trajectory,
    [min_offset, max_offset]: [f64; 2],
    step: f64,
) -> Option<OffsetMatch> {
    let [start, end] = odometry.span()?;
    let turn_count = ((end - start) / step) as usize;
    let offset_count = ((max_offset - min_offset) / step).round() as usize + 1;
    let odometry_turns = turns_of_steps(odometry, start, step, turn_count);
    let reference_turns = turns_of_steps(reference, start + min_offset, step, turn_count + offset_count - 1);
    let count_known = |turns: &[f64]| turns.iter().filter(|turn| !turn.is_nan()).count();
    let min_pairs = count_known(&odometry_turns).min(count_known(&reference_turns)) / 2;
    let correlation_of_offset = |offset: usize| {
        let correlation = correlation(&odometry_turns, &reference_turns[offset..], min_pairs);
        correlation.max(-MIRRORED_FACTOR * correlation)
    };
    let correlations: Vec<f64> = (0..offset_count).map(correlation_of_offset).collect();
    let (best_index, &max) = correlations.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    // Vertex of the parabola through the largest correlation and its neighbours.
    let [correlation_before, correlation_after] =
        [best_index.wrapping_sub(1), best_index + 1].map(|i| correlations.get(i).copied().unwrap_or(max));
    let curvature = correlation_before - 2.0 * max + correlation_after;
    let fraction =
        if curvature < 0.0 { 0.5 * (correlation_before - correlation_after) / curvature } else { 0.0 };
    (max >= MIN_CORRELATION).then_some((min_offset + (best_index as f64 + fraction) * step, max))
}

/// Returns the turns (rad) between successive times, which are `step_length` (s) apart. NaN outside of the trajectory, and across gaps.
fn turns_of_steps(trajectory: &Trajectory, start_time: f64, step_length: f64, step_count: usize) -> Vec<f64> {
    let headings = trajectory.unwrapped_heading();
    let heading_at = |time: f64| {
        let Some((sample_index, fraction)) = trajectory.locate(time) else { return f64::NAN };
        let previous_heading = headings[sample_index.saturating_sub(1)];
        previous_heading + fraction * (headings[sample_index] - previous_heading)
    };
    let times: Vec<f64> = (0..=step_count).map(|i| start_time + i as f64 * step_length).collect();
    let step_headings: Vec<f64> = times.iter().copied().map(heading_at).collect();
    let has_gap = |step_times: &[f64]| trajectory.has_gap(step_times[0], step_times[1]);
    let steps = times.windows(2).zip(step_headings.windows(2));
    steps.map(|(times, headings)| if has_gap(times) { f64::NAN } else { headings[1] - headings[0] }).collect()
}

/// Returns Pearson's correlation of two lists, over the positions at which neither number is NaN. 0 if there are fewer than `min_pairs` such
/// positions, or a list is constant.
fn correlation(a: &[f64], b: &[f64], min_pairs: usize) -> f64 {
    let (mut count, mut term_sums) = (0.0, [0.0; 5]);
    for (x, y) in a.iter().zip(b).filter(|(x, y)| !(**x + **y).is_nan()) {
        count += 1.0;
        for (sum, term) in term_sums.iter_mut().zip([*x, *y, x * x, y * y, x * y]) {
            *sum += term;
        }
    }
    let [x, y, xx, yy, xy] = term_sums.map(|sum| sum / count);
    let variance_product = (xx - x * x) * (yy - y * y);
    // Turns that are constant except for rounding count as constant.
    if count < min_pairs as f64 || variance_product <= 1e-18 * xx * yy || !variance_product.is_finite() {
        return 0.0;
    }
    (xy - x * y) / variance_product.sqrt()
}
