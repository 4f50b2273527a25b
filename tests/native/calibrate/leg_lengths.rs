//! The α's of a log by the length of its legs, against closed forms of what was put into it.

use super::simulated::{ALPHAS, Simulation};
use motion::calibrate::{
    AtLength, Calibrating, Calibration, FACTORS, LegLength, Model, Options, ReferenceError, Robust,
    Systematic, Trajectory, calibrate,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::{NoiseKind, Variance};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

const NAV2: Model = Model::Odometry(OdometryRule::Nav2);

/// Straight on, m from row to row: so that legs of all lengths end where longer ones do, after 4, 8, 16, 32 and 64 rows.
const ROW: f64 = 0.0157;

/// The rows of the legs at each of the factors.
const ROWS: [usize; 5] = [4, 8, 16, 32, 64];

fn options() -> Options {
    Options {
        model: NAV2,
        legs: LegLength::AMCL,
        noise: NoiseKind::Normal,
        robust: Robust::No,
        remove: [true; 6],
        reference_error: ReferenceError::default(),
        seed: 0,
        by_length: true,
    }
}

struct Noise(Xoshiro256PlusPlus);

impl Noise {
    fn of(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    fn of_variance(&mut self, variance: f64) -> f64 {
        NoiseKind::Normal.sample(Variance(variance), &mut self.0)
    }
}

/// So many legs as asked for, straight on; a row of the reference is what `step` makes of the one before, and is seen as `seen` has
/// it.
fn straight(
    legs: usize,
    mut step: impl FnMut(usize, SE2) -> SE2,
    mut seen: impl FnMut(SE2) -> SE2,
) -> [Trajectory; 2] {
    let rows = 16 * legs + 1;
    let time = |row: usize| 0.05 * row as f64;
    let mut truth = SE2::identity();
    let reference: Vec<_> = (0..rows)
        .map(|row| {
            truth = if row == 0 { truth } else { step(row, truth) };
            (time(row), seen(truth))
        })
        .collect();
    let odometry = (0..rows).map(|row| (time(row), SE2::new(ROW * row as f64, 0.0, 0.0)));
    [Trajectory::new(odometry).expect("times rise"), Trajectory::new(reference).expect("times rise")]
}

fn ahead(from: SE2, way: f64, turn: f64) -> SE2 {
    from * SE2::new(way, 0.0, turn)
}

fn by_length(logs: &[Trajectory; 2], options: &Options) -> Vec<AtLength> {
    let told = calibrate(&logs[0], &logs[1], options).expect("legs enough");
    assert_eq!(told.by_length.iter().map(|each| each.factor).collect::<Vec<_>>(), FACTORS);
    told.by_length
}

/// Of many logs: each factor's α's over what they should be, the mean of that, and the share of intervals that hold it.
fn over(
    logs: impl Iterator<Item = [Trajectory; 2]>,
    options: &Options,
    alpha: usize,
    expected: impl Fn(usize) -> f64,
) -> [[f64; 2]; 5] {
    let (mut sums, mut count) = ([[0.0; 2]; 5], 0.0);
    for log in logs {
        count += 1.0;
        for (place, at) in by_length(&log, options).iter().enumerate() {
            let estimate = at.estimate.as_ref().expect("legs enough");
            let expected = expected(ROWS[place]);
            let [from, to] = estimate.intervals[alpha].expect("determined");
            sums[place][0] += estimate.alphas[alpha] / expected;
            sums[place][1] += f64::from(u8::from((from..=to).contains(&expected)));
        }
    }
    sums.map(|of| of.map(|sum| sum / count))
}

const LEGS: usize = 1600;

/// A mean over `logs` may be off by three of its deviations; that of one is √(`spread`/n) of n legs.
fn is_mean(mean: f64, place: usize, logs: u64, spread: f64) -> bool {
    let legs = (LEGS * 16 / ROWS[place]) as f64;
    (mean - 1.0).abs() < 3.0 * (spread / (legs * logs as f64)).sqrt()
}

/// Of the heading, rad² a metre: of some variance, but too little to bend a leg.
const STIFF: f64 = 1e-6;

#[test]
fn of_a_random_walk_they_fall_as_one_over_the_length() {
    // m² a metre, as of a robot whose α₃ falls from 0.014 on legs of 0.12 m to 0.0017 on legs of 1 m.
    const WALK: f64 = 0.0017;
    const LOGS: u64 = 100;
    let logs = (0..LOGS).map(|seed| {
        let mut noise = Noise::of(seed);
        let step =
            move |_, from| ahead(from, ROW + noise.of_variance(WALK * ROW), noise.of_variance(STIFF * ROW));
        straight(LEGS, step, |pose| pose)
    });
    let told = over(logs, &options(), 2, |rows| WALK / (ROW * rows as f64));
    for (place, [mean, covered]) in told.into_iter().enumerate() {
        // A residual's square has the variance 2; a share of 0.95 of 100 logs the deviation 0.022.
        assert!(is_mean(mean, place, LOGS, 2.0), "{place}: {mean}");
        assert!(covered > 0.95 - 3.0 * 0.022, "{place}: {covered}");
    }
}

#[test]
fn of_a_heading_that_walks_they_fall_as_one_over_three_lengths() {
    // rad² a metre.
    const WINDING: f64 = 0.003;
    const LOGS: u64 = 40;
    let logs = (0..LOGS).map(|seed| {
        let mut noise = Noise::of(300 + seed);
        let step = move |_, from| ahead(from, ROW, noise.of_variance(WINDING * ROW));
        straight(LEGS, step, |pose| pose)
    });
    // Of k steps of δ, each turned by what was before it: Var rot1 = μδ (k−1)(2k−1)/6k, Var rot2 is that and μδ, and the mean of both over d²
    // is μ/3d · (1 + 1/2k²). They correlate by a half: the mean of their squares has 1 + ¼ in place of 1.
    let told = over(logs, &options(), 1, |rows| {
        let rows = rows as f64;
        WINDING / (3.0 * ROW * rows) * (1.0 + 0.5 / (rows * rows))
    });
    for (place, [mean, _]) in told.into_iter().enumerate() {
        assert!(is_mean(mean, place, LOGS, 1.25), "{place}: {mean}");
    }
}

#[test]
fn of_errors_of_whole_legs_they_are_flat_up_to_these_and_then_fall() {
    // As the table has it, on legs of 16 rows: each is longer by a share of its own. Half of a leg is longer by the same share, two legs
    // by the mean of two.
    const ALPHA: f64 = 0.004;
    const LOGS: u64 = 40;
    let logs = (0..LOGS).map(|seed| {
        let (mut noise, mut share) = (Noise::of(100 + seed), 0.0);
        let step = move |row: usize, from| {
            if row % 16 == 1 {
                share = noise.of_variance(ALPHA);
            }
            ahead(from, ROW * (1.0 + share), noise.of_variance(STIFF * ROW))
        };
        straight(LEGS, step, |pose| pose)
    });
    let told = over(logs, &options(), 2, |rows| ALPHA * (16.0 / rows as f64).min(1.0));
    for (place, [mean, _]) in told.into_iter().enumerate() {
        // Parts of a leg say all the same: legs are what counts.
        assert!(is_mean(mean, place.max(2), LOGS, 2.0), "{place}: {mean}");
    }
}

#[test]
fn of_a_reference_that_shakes_they_fall_as_one_over_the_square() {
    // Both ends of a leg are off by 3 mm: 2σ² over d².
    const SHAKE: f64 = 9e-6;
    const LOGS: u64 = 40;
    let log = |seed: u64| {
        let mut noise = Noise::of(200 + seed);
        let seen = move |pose: SE2| {
            SE2::new(pose.x() + noise.of_variance(SHAKE), pose.y() + noise.of_variance(SHAKE), pose.theta())
        };
        straight(LEGS, |_, from| ahead(from, ROW, 0.0), seen)
    };
    let unstated = over((0..LOGS).map(log), &options(), 2, |rows| {
        let way = ROW * rows as f64;
        2.0 * SHAKE / (way * way)
    });
    for (place, [mean, _]) in unstated.into_iter().enumerate() {
        // Neighbours share an end, and their squares correlate by a quarter: 2 (1 + 2 · ¼).
        assert!(is_mean(mean, place, LOGS, 3.0), "{place}: {mean}");
    }
    let stated = Options { reference_error: ReferenceError { position: 3e-3, heading: 0.0 }, ..options() };
    for at in by_length(&log(0), &stated) {
        let [from, to] = at.estimate.expect("legs enough").intervals[2].expect("determined");
        assert!(
            from == 0.0 && to < 0.2 * 2.0 * SHAKE / (0.25 * 0.25) * (1.0 / at.factor).powi(2),
            "{from} {to}"
        );
    }
}

/// Every number, also NaN.
fn written(calibration: &Calibration) -> String {
    format!("{calibration:?}")
}

#[test]
fn the_legs_that_are_asked_for_are_those_of_the_fit() {
    // Of 120 intervals a share of 0.95 has the deviation 0.02: it is allowed three of them.
    const LOGS: u64 = 30;
    let errors = Systematic { mount_yaw: 0.07, lever_arm: [0.1, -0.05], ..Systematic::NONE };
    let mut covered = 0;
    for seed in 0..LOGS {
        let simulation = Simulation { errors, ..Simulation::of(NAV2, NoiseKind::Normal, 800, 700 + seed) };
        let [odometry, reference] = simulation.log();
        let mut told = calibrate(&odometry, &reference, &options()).expect("legs enough");
        let AtLength { factor, legs, estimate, bootstrap } = told.by_length[2].clone();
        assert_eq!((factor, legs, estimate.as_ref()), (1.0, told.legs.len(), Some(&told.estimate)));
        assert_eq!(bootstrap, told.bootstrap);
        for (k, interval) in estimate.expect("legs enough").intervals.into_iter().enumerate() {
            let [from, to] = interval.expect("determined");
            covered += u32::from((from..=to).contains(&ALPHAS[k]));
        }
        // Nothing else is another.
        let alone = Options { by_length: false, ..options() };
        told.by_length.clear();
        assert!(written(&told) == written(&calibrate(&odometry, &reference, &alone).expect("legs enough")));
    }
    let share = f64::from(covered) / (4.0 * LOGS as f64);
    assert!(share > 0.95 - 3.0 * 0.02, "{share}");
}

#[test]
fn what_is_removed_is_that_of_the_legs_that_are_asked_for() {
    // A mount of 0.07 rad, left in: each rotation is off by that, an α₂ of 0.07²/d², beside that of the heading's walk.
    let mut noise = Noise::of(5);
    let mount = SE2::new(0.0, 0.0, 0.07);
    let step = move |_, from| ahead(from, ROW, noise.of_variance(1e-4 * ROW));
    let logs = straight(LEGS, step, |pose| pose * mount);
    let left = Options { remove: [false; 6], ..options() };
    let [left, removed] = [left, options()].map(|options| by_length(&logs, &options));
    for (place, rows) in ROWS.into_iter().enumerate() {
        let [left, removed] =
            [&left, &removed].map(|told| told[place].estimate.as_ref().expect("legs").alphas[1]);
        let way = ROW * rows as f64;
        assert!(
            ((left - removed) / (0.07 * 0.07 / (way * way)) - 1.0).abs() < 0.02,
            "{place}: {left} {removed}"
        );
    }
}

/// Legs of other lengths begin and end anywhere in those of the noise, and some hardly lead anywhere: their directions are those of a
/// millimetre of the lever arm or the clock, and unless it is known how far off these may be a few legs decide on α₁ and α₂. Beside
/// what the same legs say when they are asked for, which removes errors of its own: of 96 α's 92 are within half as much again, and of
/// their intervals by the bootstrap 94 overlap. Where it was not known, 68 were.
#[test]
fn a_column_is_what_its_legs_say_when_they_are_asked_for() {
    let (mut near, mut agree, mut of) = (0, 0, 0);
    for (seed, rule) in (0..6).flat_map(|seed| [(seed, OdometryRule::Table), (seed, OdometryRule::Nav2)]) {
        let model = Model::Odometry(rule);
        let errors = Systematic { mount_yaw: 0.07, lever_arm: [0.1, -0.05], ..Systematic::NONE };
        let simulation = Simulation { errors, ..Simulation::of(model, NoiseKind::Normal, 1800, 40 + seed) };
        let logs = simulation.log();
        let options = Options { model, ..options() };
        for at in &by_length(&logs, &options)[3..] {
            let legs = LegLength::Moved { distance: 0.25 * at.factor, angle: 0.2 * at.factor };
            let options = Options { legs, by_length: false, ..options };
            let asked = calibrate(&logs[0], &logs[1], &options).expect("legs enough");
            let told = at.estimate.as_ref().expect("legs enough");
            for (alpha, of_asked) in told.alphas.iter().zip(&asked.estimate.alphas) {
                near += u32::from((1.0 / 1.5..1.5).contains(&(alpha / of_asked)));
                of += 1;
            }
            let both = at.bootstrap.iter().zip(&asked.bootstrap);
            agree += both
                .filter(|(ours, theirs)| ours.zip(**theirs).is_some_and(|([a, b], [c, d])| a <= d && c <= b))
                .count();
        }
    }
    assert!(of == 96 && near >= 90 && agree >= 93, "{near} and {agree} of {of}");
}

#[test]
fn too_few_legs_or_rows_tell_nothing() {
    let told_of = |legs: usize, asked: LegLength| {
        let mut noise = Noise::of(6);
        let step = move |_, from| ahead(from, ROW + noise.of_variance(1e-6), noise.of_variance(1e-6));
        let logs = straight(legs, step, |pose| pose);
        let told = by_length(&logs, &Options { legs: asked, ..options() });
        told.into_iter().map(|at| (at.legs, at.estimate.is_some())).collect::<Vec<_>>()
    };
    let all = [(128, true), (64, true), (32, true), (16, true), (8, true)];
    assert_eq!(told_of(32, LegLength::AMCL), all);
    // The last of them is not whole.
    assert_eq!(told_of(31, LegLength::AMCL), [(124, true), (62, true), (31, true), (15, true), (7, false)]);
    // Of 2, 4, 8, 16 and 32 rows.
    let shorter = LegLength::Moved { distance: 0.125, angle: 0.2 };
    assert_eq!(told_of(32, shorter), [(256, false), (128, true), (64, true), (32, true), (16, true)]);
    let lasting = LegLength::Lasted { duration: 0.4 };
    assert_eq!(told_of(32, lasting), [(256, false), (128, true), (64, true), (32, true), (16, true)]);
    // Five in six of 24 000 legs.
    assert_eq!(told_of(6000, LegLength::AMCL)[0], (20_000, true));
    // By turns of more than half a circle no leg ends; who does not want it to, has legs of all lengths.
    let [wide, wider] = [0.9, 4.0].map(|angle| told_of(64, LegLength::Moved { distance: 0.25, angle }));
    assert_eq!(wide[4], (0, false));
    assert_eq!(wider[4], (16, true));
}

#[test]
fn progress_goes_up_to_the_end() {
    let simulation = Simulation::of(Model::Velocity, NoiseKind::Normal, 300, 1);
    let [odometry, reference] = simulation.log();
    let options = Options { model: Model::Velocity, ..options() };
    let (mut calibrating, mut before) = (Calibrating::new(options), -1.0);
    let told = loop {
        // It goes up all the way, and has an end.
        assert!(before < calibrating.progress() && calibrating.progress() < 1.0);
        before = calibrating.progress();
        if let Some(told) = calibrating.step(&odometry, &reference).expect("legs enough") {
            break told;
        }
    };
    assert!(before > 0.9 && told.by_length.len() == 5);
}
