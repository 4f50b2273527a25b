//! The Odometry Decomposer under any settings and calls.

use super::input::Input;
use super::laws;
use super::settings::{allowed, changed};
use motion::geom::se2::SE2;
use motion::models::{OdomDelta, MAX_SPIN_DISTANCE};
use motion::sim::odometry_decomposer::{Drifted, OdometryDecomposer, Settings, Stats};
use motion::sim::settings::QUANTITY_RANGE;

/// Maximum number of outcomes, points of a curve and calls in a run.
const SAMPLES: usize = 12;
const POINTS: usize = 6;
const CALLS: usize = 4;

pub fn run(bytes: &[u8]) {
    let mut input = Input(bytes);
    let opening = changed(&with_few_samples(Settings::default()), &mut input);
    if !allowed(&opening) {
        assert!(OdometryDecomposer::new(opening).is_err());
        return;
    }
    let mut machine = OdometryDecomposer::new(with_few_samples(opening)).expect("allowed");
    for _ in 0..CALLS {
        if input.is_empty() {
            break;
        }
        call(&mut machine, &mut input);
    }
    assert_results(&machine);
}

/// Returns the same settings with fewer outcomes.
fn with_few_samples(settings: Settings) -> Settings {
    Settings { samples: settings.samples.min(SAMPLES), ..settings }
}

fn call(machine: &mut OdometryDecomposer, input: &mut Input) {
    let shown = machine.poses().len();
    match input.choice(7) {
        0 | 1 => configure(machine, input),
        2 => {
            let count = input.choice(SAMPLES);
            assert_eq!(machine.add_samples(count), (shown + count).min(machine.settings().samples));
        }
        3 => {
            machine.configure_first(*machine.settings(), 0).expect("allowed");
            assert!(machine.poses().is_empty());
        }
        4 => {
            let ghosts = machine.ghosts(usize::from(input.byte()));
            assert!(ghosts.len() <= shown);
            ghosts.as_flattened().iter().for_each(|pose| laws::assert_pose("a ghost", pose));
            assert!(ghosts.iter().zip(machine.poses()).all(|(ghost, pose)| ghost[3] == *pose));
        }
        5 => assert_curve(machine, input.within(0.0..=*QUANTITY_RANGE.end()), 1 + input.choice(POINTS)),
        _ => assert_nearest(machine, input),
    }
}

fn configure(machine: &mut OdometryDecomposer, input: &mut Input) {
    let settings = changed(machine.settings(), input);
    let (before, poses) = (*machine.settings(), machine.poses().to_vec());
    if !allowed(&settings) {
        assert!(machine.configure(settings).is_err());
        assert_eq!(*machine.settings(), before);
        assert_eq!(machine.poses(), poses);
        return;
    }
    let settings = with_few_samples(settings);
    machine.configure(settings).expect("allowed");
    assert_eq!(machine.poses().len(), settings.samples);
}

fn assert_curve(machine: &OdometryDecomposer, longest: f64, count: usize) {
    let points = machine.curve(longest, count);
    assert_eq!(points.len(), count);
    for point in points {
        laws::assert_finite("curve", &[point.trans, point.cross_track, point.lever, point.along]);
        assert!(point.cross_track >= 0.0 && point.lever >= 0.0 && point.along >= 0.0, "{point:?}");
    }
}

fn assert_nearest(machine: &OdometryDecomposer, input: &mut Input) {
    let target = [0; 2].map(|_| input.number());
    let radius = input.within(0.0..=f64::INFINITY);
    let Some(index) = machine.nearest(target, radius) else { return };
    let away = |pose: &SE2| ((pose.x() - target[0]) / radius).hypot((pose.y() - target[1]) / radius);
    let least = machine.poses().iter().map(away).fold(f64::INFINITY, f64::min);
    // The square of a distance below 1e-154 of the radius underflows to 0.
    let found = away(&machine.poses()[index]);
    assert!(found <= least * (1.0 + 1e-9) + 1e-150 && found <= 1.0 + 1e-9, "{target:?} {radius}: {index}");
}

/// Asserts that all results are finite, or NaN without outcomes.
fn assert_results(machine: &OdometryDecomposer) {
    let settings = machine.settings();
    machine.poses().iter().for_each(|pose| laws::assert_pose("an outcome", pose));
    machine.linkage().iter().for_each(|pose| laws::assert_pose("the linkage", pose));
    laws::assert_pose("the robot", &machine.robot());
    let Drifted { frame, from, to, legs } = machine.drifted();
    [frame, from, to].iter().for_each(|pose| laws::assert_pose("drifted", pose));
    assert_legs("drifted legs", &legs);
    assert_legs("reading", &machine.reading());

    let Stats {
        n,
        cross_track,
        cross_track_error,
        exact_cross_track,
        lever,
        heading,
        heading_error,
        exact_heading,
        independent_heading,
    } = machine.stats();
    assert_eq!(n, machine.poses().len());
    let exact = [exact_cross_track, lever, exact_heading, independent_heading];
    let measured = [cross_track, cross_track_error, heading, heading_error];
    laws::assert_finite("exact", &exact);
    laws::assert_finite_or_none("measured", &measured);
    assert_eq!(n == 0, cross_track.is_nan());
    assert!(
        exact.iter().chain(&measured).all(|figure| figure.is_nan() || *figure >= 0.0),
        "{exact:?} {measured:?}"
    );

    for figures in machine.rules() {
        assert_legs("legs", &figures.legs);
        let all = [&figures.deviations[..], &[figures.cross_track, figures.heading]].concat();
        laws::assert_finite("a rule", &all);
        assert!(all.iter().all(|figure| *figure >= 0.0), "{figures:?}");
        if figures.rule == settings.rule {
            assert_eq!(figures.legs, machine.legs());
            laws::assert_same_numbers("exact", &all[4..], &[exact_cross_track, exact_heading]);
        }
    }

    // Without noise the robot ends at the odometry pose, except for the direction of a tiny translation, which a spin ignores.
    let [x, y, _] = settings.to.0;
    let [.., end] = machine.linkage();
    let off = (end.x() - x).hypot(end.y() - y);
    let size = settings.from.0.iter().chain(&settings.to.0).fold(0.0, |most: f64, at| most.max(at.abs()));
    assert!(off <= 2.0 * MAX_SPIN_DISTANCE + 1e-14 * size, "{end:?} for {settings:?}: {off}");

    // Asserts that a machine depends on its settings only, and not on earlier calls.
    let mut other = OdometryDecomposer::new(*settings).expect("allowed");
    if n < settings.samples {
        other.configure_first(*settings, 0).expect("allowed");
        other.add_samples(n);
    }
    assert_eq!(other.poses(), machine.poses());
}

fn assert_legs(what: &str, legs: &OdomDelta) {
    laws::assert_finite(what, &[legs.rot1, legs.trans, legs.rot2]);
    assert!(legs.trans >= 0.0, "{what}: {legs:?}");
}
