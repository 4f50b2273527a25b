//! Logs of any robot, calibrated with any options.

use super::input::{Input, turn_of};
use super::laws;
use motion::NoiseKind;
use motion::calibrate::{
    CalibrateError, Calibrating, Calibration, Doubts, Error, Estimate, FACTORS, FEWEST, HeldOut, Inflation,
    LegLength, Model, Options, ReferenceError, Robust, Trajectory, TrajectoryError, TrajectoryFault, Verdict,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Parts of a drive, and rows of each, at most: of most drives a few, for what a calibration takes grows with them.
const PARTS: usize = 6;
const FEW_ROWS: usize = 12;
const ROWS: usize = 64;

/// Steps of a calibration at most, with room: each is a pass over the legs or less, and what is searched for takes sixty at most.
const STEPS: usize = 4000;

const MODELS: [Model; 5] = [
    Model::Odometry(OdometryRule::Table),
    Model::Odometry(OdometryRule::Nav2),
    Model::Odometry(OdometryRule::Beluga),
    Model::Odometry(OdometryRule::Omni),
    Model::Velocity,
];

pub fn run(bytes: &[u8]) {
    steps_of(bytes);
}

/// Returns the number of steps of the calibration, or 0 if a log is refused.
pub fn steps_of(bytes: &[u8]) -> usize {
    let mut input = Input(bytes);
    let options = options(&mut input);
    // Legs of other lengths take five calibrations, and searches among triangles and bad legs several times as long as of normal noise.
    let Options { by_length, noise, robust, .. } = options;
    let by_length = by_length && turn_of(16, bytes);
    let noise = if turn_of(16, bytes) { noise } else { NoiseKind::Normal };
    let robust = if turn_of(8, bytes) { robust } else { Robust::No };
    let options = Options { by_length, noise, robust, ..options };
    let mut driven = driven(&mut input, if turn_of(128, bytes) { ROWS } else { FEW_ROWS });
    let mut seen = seen(&driven, &mut input);
    edit(&mut driven, &mut input);
    edit(&mut seen, &mut input);
    let (Some(odometry), Some(reference)) = (trajectory(&driven, &mut input), trajectory(&seen, &mut input))
    else {
        return 0;
    };
    let mut calibrating = Calibrating::new(options);
    let mut progress = 0.0;
    for step in 1..=STEPS {
        let now = calibrating.progress();
        assert!((progress..=1.0).contains(&now), "{progress}, then {now}");
        progress = now;
        match calibrating.step(&odometry, &reference) {
            Ok(None) => {}
            Ok(Some(told)) => {
                makes_sense(&told, &options, [&odometry, &reference]);
                return step;
            }
            Err(CalibrateError::FewLegs { legs }) => {
                assert!(legs < FEWEST);
                return step;
            }
            Err(CalibrateError::Apart) => {
                let [one, other] = [&odometry, &reference].map(|each| each.span().expect("a row at least"));
                assert!(one[1] < other[0] || other[1] < one[0], "{one:?} {other:?}");
                return step;
            }
        }
    }
    panic!("{STEPS} steps, and {progress} is done");
}

fn options(input: &mut Input) -> Options {
    let legs = match input.choice(4) {
        0 => LegLength::AMCL,
        1 => LegLength::Lasted { duration: length(input) },
        _ => LegLength::Moved { distance: length(input), angle: length(input) },
    };
    let robust = match input.choice(4) {
        0 => Robust::Stated(input.within(1e-9..=0.5)),
        1 => Robust::Estimated,
        _ => Robust::No,
    };
    let removed = input.byte();
    let mut deviation = || if input.choice(3) == 0 { input.within(0.0..=1e3) } else { 0.0 };
    let reference_error = ReferenceError { position: deviation(), heading: deviation() };
    Options {
        model: input.of(&MODELS),
        legs,
        noise: input.of(&[NoiseKind::Normal, NoiseKind::Triangular]),
        robust,
        remove: std::array::from_fn(|error| removed >> error & 1 == 0),
        reference_error,
        seed: u64::from(input.byte()),
        by_length: input.choice(4) == 0,
    }
}

/// Length of a leg in m, rad or s.
fn length(input: &mut Input) -> f64 {
    if input.truth() { input.of(&[0.1, 0.2, 0.25, 0.5]) } else { input.within(1e-6..=1e6) }
}

type Row = (f64, SE2);

/// Mostly one of these.
fn usually(choices: &[f64], input: &mut Input) -> f64 {
    let choice = input.choice(choices.len() + 1);
    choices.get(choice).copied().unwrap_or_else(|| input.within(-1e9..=1e9))
}

fn driven(input: &mut Input, rows_of_a_part: usize) -> Vec<Row> {
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

/// The drive as it was, which is off by some part of each step, and jumps now and then.
fn seen(driven: &[Row], input: &mut Input) -> Vec<Row> {
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

/// Some rows are others than they were, or are missing.
fn edit(rows: &mut Vec<Row>, input: &mut Input) {
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
        // Their coordinates as commands.
        0 => Trajectory::from_commands(rows.iter().map(|(time, pose)| (*time, pose.x(), pose.theta()))),
        _ => Trajectory::new(rows.iter().copied()),
    };
    match read {
        Ok(trajectory) => {
            assert!(rows.is_sorted_by(|a, b| a.0 < b.0));
            let whole = trajectory.gaps();
            let breaks: Vec<usize> = (0..input.choice(4)).map(|_| usize::from(input.byte())).collect();
            let broken = trajectory.broken_before(breaks.iter().copied());
            assert!((whole..=whole + breaks.len()).contains(&broken.gaps()));
            Some(broken)
        }
        Err(TrajectoryError { sample, fault: TrajectoryFault::NotLater { before } }) => {
            assert!(sample > 0 && rows[sample].0 <= before && rows[sample - 1].0 == before);
            None
        }
        // Commands may lead further than numbers go.
        Err(TrajectoryError { sample, fault: TrajectoryFault::NotFinite }) => {
            assert!(sample < rows.len());
            None
        }
    }
}

fn makes_sense(told: &Calibration, options: &Options, [odometry, reference]: [&Trajectory; 2]) {
    let Calibration { estimate, bootstrap, systematic, removed, legs, observations, judged, .. } = told;
    assert!(legs.len() >= FEWEST);
    assert_eq!([observations.len(), judged.len()], [legs.len(); 2]);
    let count = options.model.alphas();
    assert_eq!([estimate.alphas.len(), estimate.intervals.len(), bootstrap.len()], [count; 3]);
    for (k, alpha) in estimate.alphas.iter().enumerate() {
        let Some([from, to]) = estimate.intervals[k] else {
            assert!(alpha.is_nan() && bootstrap[k].is_none(), "α{}: {estimate:?}", k + 1);
            continue;
        };
        assert!(
            0.0 <= from && from <= *alpha && *alpha <= to && alpha.is_finite(),
            "α{}: {estimate:?}",
            k + 1
        );
        let [low, high] = bootstrap[k].expect("as determined as the other");
        assert!(0.0 <= low && low <= high, "α{}: {bootstrap:?}", k + 1);
    }
    assert!(!estimate.log_likelihood.is_nan());
    assert_eq!(estimate.outliers.is_some(), options.robust != Robust::No);
    laws::share("bad legs", estimate.outliers.unwrap_or(0.0));
    for error in Error::ALL {
        let (value, interval) = (systematic.get(error), told.interval_of(error));
        assert!(value.is_finite() && interval.is_none_or(|[from, to]| from <= value && value <= to));
        let kept = if options.remove[error as usize] { systematic.get(error) } else { removed.get(error) };
        assert_eq!(kept, removed.get(error), "{error:?}");
    }
    for pair in legs.windows(2) {
        assert!(pair[0].times[1] <= pair[1].times[0]);
    }
    for leg in legs {
        let [from, to] = leg.times;
        assert!(from < to && !odometry.has_gap(from, to), "{leg:?}");
        let offset = removed.clock_offset;
        assert!(!reference.has_gap(from + offset, to + offset), "{leg:?}");
    }
    for leg in judged {
        laws::share("bad", leg.bad);
        assert!(leg.squared_error >= 0.0, "{leg:?}");
        assert!(leg.deviations.iter().all(|each| each.is_nan() || *each >= 0.0), "{leg:?}");
    }
    doubts_make_sense(told);
    assert_eq!(told.by_length.len(), if options.by_length { FACTORS.len() } else { 0 });
    for at in &told.by_length {
        let Some(Estimate { alphas, intervals, .. }) = &at.estimate else { continue };
        for (alpha, interval) in alphas.iter().zip(intervals) {
            assert!(interval.map_or(alpha.is_nan(), |[from, to]| from <= *alpha && *alpha <= to), "{at:?}");
        }
    }
}

fn doubts_make_sense(Calibration { doubts, inflation, legs, judged, .. }: &Calibration) {
    let Doubts { kinds, held_out, worst, verdict } = doubts;
    for kind in kinds {
        assert!(kind.quantiles.is_sorted() && kind.quantiles.len() == if kind.count > 0 { 99 } else { 0 });
        // The kurtosis is NaN if z⁴ overflows for a tiny deviation.
        assert!(kind.kurtosis.is_nan() || kind.kurtosis >= 0.99, "{kind:?}");
        assert!(!kind.autocorrelation.is_infinite(), "{kind:?}");
    }
    let HeldOut { coverage, coverage_interval: [from, to], squared_error_interval: [least, most], .. } =
        *held_out;
    laws::share("coverage", coverage);
    laws::share("its end", from);
    assert!(!(from > 0.95 || to < 0.95 || least > 1.0 || most < 1.0), "{held_out:?}");
    assert_eq!(worst.len(), legs.len().min(10));
    assert!(worst.is_sorted_by(|a, b| judged[*a].squared_error >= judged[*b].squared_error), "{worst:?}");
    assert_eq!(*verdict == Verdict::FewLegs, legs.len() < 100 || held_out.count < 50);
    let Inflation { factors, coverage, log_likelihood } = inflation;
    assert_eq!([factors.len(), coverage.len(), log_likelihood.len()], [25; 3]);
    coverage.iter().for_each(|share| laws::share("inflated", *share));
    assert!(log_likelihood.iter().all(|nats| !nats.is_nan()), "{log_likelihood:?}");
}
