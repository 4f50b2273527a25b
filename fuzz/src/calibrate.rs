//! Logs of any robot, calibrated with any options.

use super::input::{Input, turn_of};
use super::laws;
use motion::calibrate::{
    CalibrateError, Calibration, Check, Drive, LegLength, MIN_LEGS, Model, Options, Outliers,
    SystematicError, Trajectory, TrajectoryError, Verdict, calibrate,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Maximum number of parts of a drive.
const PARTS: usize = 6;

/// Maximum number of rows of each part of a drive: `FEW_ROWS` of most drives, `ROWS` of the others. The time of a calibration grows with
/// the rows.
const FEW_ROWS: usize = 12;
const ROWS: usize = 64;

const MODELS: [Model; 5] = [
    Model::Odometry(OdometryRule::Table),
    Model::Odometry(OdometryRule::Nav2),
    Model::Odometry(OdometryRule::Beluga),
    Model::Odometry(OdometryRule::Omni),
    Model::Velocity,
];

pub fn run(bytes: &[u8]) {
    let mut input = Input(bytes);
    let options = options(&mut input);
    let mut driven = odometry_rows(&mut input, if turn_of(128, bytes) { ROWS } else { FEW_ROWS });
    let mut seen = reference_rows(&driven, &mut input);
    edit_rows(&mut driven, &mut input);
    edit_rows(&mut seen, &mut input);
    let (Some(odometry), Some(reference)) = (trajectory(&driven, &mut input), trajectory(&seen, &mut input))
    else {
        return;
    };
    match calibrate(&[Drive { odometry: &odometry, reference: &reference }], &options) {
        Ok(calibration) => assert_calibration(&calibration, &options),
        Err(CalibrateError::TooFewLegs { legs }) => assert!(legs < MIN_LEGS),
        Err(CalibrateError::NoCommonTime) => {
            let [one, other] = [&odometry, &reference].map(|each| each.span().expect("a row at least"));
            assert!(one[1] < other[0] || other[1] < one[0], "{one:?} {other:?}");
        }
    }
}

fn options(input: &mut Input) -> Options {
    let legs = match input.choice(4) {
        0 => LegLength::AMCL,
        1 => LegLength::Duration { duration: length(input) },
        _ => LegLength::Displacement { distance: length(input), angle: length(input) },
    };
    let outliers = input.of(&[Outliers::Reject, Outliers::Keep]);
    let corrected = input.byte();
    let mut stated = || (input.choice(3) == 0).then(|| input.within(0.0..=1e3));
    let [position_std, yaw_std] = [stated(), stated()];
    Options {
        model: input.of(&MODELS),
        legs,
        outliers,
        correct: std::array::from_fn(|error| (corrected >> error & 1 == 1).then_some(corrected & 64 == 0)),
        position_std,
        yaw_std,
    }
}

/// Returns the length of a leg in m, rad or s.
fn length(input: &mut Input) -> f64 {
    if input.truth() { input.of(&[0.1, 0.2, 0.25, 0.5]) } else { input.within(1e-6..=1e6) }
}

type Row = (f64, SE2);

/// Returns one of the usual values in most cases.
fn usually(choices: &[f64], input: &mut Input) -> f64 {
    let choice = input.choice(choices.len() + 1);
    choices.get(choice).copied().unwrap_or_else(|| input.within(-1e9..=1e9))
}

fn odometry_rows(input: &mut Input, rows_of_a_part: usize) -> Vec<Row> {
    let step = usually(&[0.05, 0.1, 0.1, 0.5, 1.0], input).abs();
    let mut rows = vec![(usually(&[0.0, 10.0, 1.7e9], input), SE2::identity())];
    for _ in 0..=input.choice(PARTS) {
        let v = usually(&[0.0, 0.2, 0.5, 0.8, -0.3], input);
        let omega = usually(&[0.0, 0.2, -0.4, 0.9, -0.9], input);
        for _ in 0..1 + usize::from(input.byte()) % rows_of_a_part {
            let (time, pose) = rows[rows.len() - 1];
            rows.push((time + step, pose.boxplus(Vector3::new(v, 0.0, omega) * step)));
        }
    }
    rows
}

/// Returns the reference: the odometry with an error in each step, and with occasional jumps.
fn reference_rows(driven: &[Row], input: &mut Input) -> Vec<Row> {
    let offset = usually(&[0.0, 0.12, -3.0, 50.0], input);
    let mount = SE2::new(0.1 * f64::from(input.choice(3) as u8), 0.0, usually(&[0.0, 0.07, 3.0], input));
    let off = usually(&[0.0, 0.01, 0.1, 0.5], input);
    let every = usize::from(input.byte());
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(u64::from(input.byte()));
    let mut pose = SE2::new(1.0, 2.0, 3.0);
    let mut rows = vec![(driven[0].0 + offset, pose * mount)];
    for (i, pair) in driven.windows(2).enumerate() {
        let step = pair[1].1.boxminus(&pair[0].1);
        let noise = Vector3::from_fn(|_, _| rng.random_range(-1.0..=1.0)) * off * step.norm();
        pose = pose.boxplus(step + noise);
        if every > 0 && i % every == 0 {
            pose = SE2::new(0.5, 0.0, 0.0) * pose;
        }
        rows.push((pair[1].0 + offset, pose * mount));
    }
    rows
}

/// Changes or removes some rows.
fn edit_rows(rows: &mut Vec<Row>, input: &mut Input) {
    for _ in 0..input.choice(4) {
        let at = usize::from(u16::from_le_bytes(input.bytes())) % rows.len();
        let (time, pose) = rows[at];
        let [x, y, theta] = [pose.x(), pose.y(), pose.theta()];
        match input.choice(6) {
            0 => rows[at].0 = input.number(),
            1 => rows[at].1 = SE2::new(input.number(), y, theta),
            2 => rows[at].1 = SE2::new(x, y, input.number()),
            3 => rows[at..].iter_mut().for_each(|row| row.0 += 10.0),
            4 => rows[at].0 = time.next_up(),
            _ => drop(rows.drain(at..(at + 1 + usize::from(input.byte()) % ROWS).min(rows.len()))),
        }
        if rows.is_empty() {
            rows.push((time, pose));
        }
    }
}

/// Returns the trajectory of the rows with breaks before some, or None if a row is refused.
fn trajectory(rows: &[Row], input: &mut Input) -> Option<Trajectory> {
    let read = match input.choice(4) {
        // Returns coordinates as commands.
        0 => Trajectory::from_commands(rows.iter().map(|(time, pose)| (*time, pose.x(), pose.theta()))),
        _ => Trajectory::new(rows.iter().copied()),
    };
    match read {
        Ok(trajectory) => {
            assert!(rows.is_sorted_by(|a, b| a.0 < b.0));
            let whole = trajectory.gaps();
            let breaks: Vec<usize> = (0..input.choice(4)).map(|_| usize::from(input.byte())).collect();
            let broken = trajectory.with_breaks_before(breaks.iter().copied());
            assert!((whole..=whole + breaks.len()).contains(&broken.gaps()));
            Some(broken)
        }
        Err(TrajectoryError::NotLater { sample, before }) => {
            assert!(sample > 0 && rows[sample].0 <= before && rows[sample - 1].0 == before);
            None
        }
        // Poses after large commands may overflow.
        Err(TrajectoryError::NotFinite { sample }) => {
            assert!(sample < rows.len());
            None
        }
    }
}

fn assert_calibration(calibration: &Calibration, options: &Options) {
    let Calibration { alphas, intervals, not_identifiable, legs, observations, leg_fits, .. } = calibration;
    assert!(legs.len() >= MIN_LEGS);
    assert_eq!([observations.len(), leg_fits.len()], [legs.len(); 2]);
    let count = options.model.alphas();
    assert_eq!([alphas.len(), intervals.len(), not_identifiable.len()], [count; 3]);
    for (k, alpha) in alphas.iter().enumerate() {
        assert_eq!([alpha.is_none(), intervals[k].is_none()], [not_identifiable[k].is_some(); 2]);
        let Some((alpha, [low, high])) = alpha.zip(intervals[k]) else { continue };
        let inside = 0.0 <= low && low <= alpha && alpha <= high && alpha.is_finite();
        assert!(inside, "α{}: {low} {alpha} {high}", k + 1);
    }
    for noise in calibration.reference_noise {
        let [low, high] = noise.interval;
        assert!(0.0 <= low && low <= noise.value && noise.value <= high, "{noise:?}");
    }
    // Numbers overflow where a pose is further away than the square root of the largest double; the log is unusable then.
    let is_usable = calibration.diagnostics.verdict != Verdict::Unusable;
    assert!(!is_usable || !calibration.log_likelihood.is_nan());
    for (i, error) in SystematicError::ALL.into_iter().enumerate() {
        let (value, interval) = (calibration.systematic.get(error), calibration.interval_of(error));
        assert!(value.is_finite() && interval.is_none_or(|[low, high]| low <= value && value <= high));
        let may = interval.is_some() && options.correct[i] != Some(false);
        assert!(may || !calibration.is_corrected[i], "{error:?}");
    }
    for pair in legs.windows(2) {
        assert!(pair[0].times[1] <= pair[1].times[0]);
    }
    assert!(legs.iter().all(|leg| leg.times[0] < leg.times[1]));
    for leg in leg_fits {
        let is_finite = leg.squared.is_finite() && leg.stds.iter().all(|std| std.is_nan() || *std >= 0.0);
        assert!(!is_usable || is_finite, "{leg:?}");
        assert!(options.outliers == Outliers::Reject || !leg.is_outlier);
    }
    assert_diagnostics(calibration);
}

fn assert_diagnostics(Calibration { alphas, diagnostics, persistence, recommended, .. }: &Calibration) {
    for Check { name, value, expected: [low, high], passed } in &diagnostics.checks {
        assert_eq!(*passed, low <= value && value <= high, "{name:?}: {value} {low} {high}");
    }
    let consistent = diagnostics.checks.iter().all(|check| check.passed);
    assert!(consistent || diagnostics.verdict != Verdict::Consistent);
    for window in diagnostics.windows.iter().filter(|window| window.count > 0) {
        laws::assert_share("covered windows", window.coverage);
    }
    laws::assert_share("persistence", persistence.correlation.value);
    assert_eq!(recommended.is_none(), diagnostics.verdict == Verdict::Unusable);
    let Some(recommended) = recommended else { return };
    assert!((1.0..=100.0).contains(&recommended.inflation), "{recommended:?}");
    for (alpha, inflated) in alphas.iter().zip(&recommended.alphas) {
        assert_eq!(alpha.map(|alpha| alpha * recommended.inflation), *inflated);
    }
}
