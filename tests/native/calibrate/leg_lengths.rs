//! Alphas by leg length, against closed forms of simulated errors.

use super::simulated::Simulation;
use motion::calibrate::{
    AtLength, Calibration, FACTORS, LegLength, Model, Options, ReferenceError, Robust, Systematic,
    Trajectory, calibrate,
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
fn alphas_of_a_random_walk_fall_with_the_leg_length() {
    // m² a metre, as of a robot whose α₃ falls from 0.014 on legs of 0.12 m to 0.0017 on legs of 1 m.
    const WALK: f64 = 0.0017;
    const LOGS: u64 = 10;
    let logs = (0..LOGS).map(|seed| {
        let mut noise = Noise::of(seed);
        let step =
            move |_, from| ahead(from, ROW + noise.of_variance(WALK * ROW), noise.of_variance(STIFF * ROW));
        straight(LEGS, step, |pose| pose)
    });
    let told = over(logs, &options(), 2, |rows| WALK / (ROW * rows as f64));
    for (place, [mean, covered]) in told.into_iter().enumerate() {
        // A residual's square has the variance 2; a share of 0.95 of 10 logs the deviation 0.069.
        assert!(is_mean(mean, place, LOGS, 2.0), "{place}: {mean}");
        assert!(covered > 0.95 - 3.0 * 0.069, "{place}: {covered}");
    }
}

/// Every number, also NaN.
fn written(calibration: &Calibration) -> String {
    format!("{calibration:?}")
}

#[test]
fn the_column_of_the_requested_leg_length_is_the_main_fit() {
    const LOGS: u64 = 2;
    let errors = Systematic { mount_yaw: 0.07, lever_arm: [0.1, -0.05], ..Systematic::NONE };
    for seed in 0..LOGS {
        let simulation = Simulation { errors, ..Simulation::of(NAV2, NoiseKind::Normal, 800, 700 + seed) };
        let [odometry, reference] = simulation.log();
        let mut told = calibrate(&odometry, &reference, &options()).expect("legs enough");
        let AtLength { factor, legs, estimate, bootstrap } = told.by_length[2].clone();
        assert_eq!((factor, legs, estimate.as_ref()), (1.0, told.legs.len(), Some(&told.estimate)));
        assert_eq!(bootstrap, told.bootstrap);
        // Nothing else is another.
        let alone = Options { by_length: false, ..options() };
        told.by_length.clear();
        assert!(written(&told) == written(&calibrate(&odometry, &reference, &alone).expect("legs enough")));
    }
}

#[test]
fn too_few_legs_or_rows_give_no_estimate() {
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
