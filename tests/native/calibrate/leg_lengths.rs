//! Alphas by leg length, against closed forms of simulated errors.

use super::simulated::Simulation;
use motion::calibrate::{
    AtLength, Calibration, FACTORS, LegLength, Model, Options, Robust, Systematic, Trajectory, calibrate,
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
    Options { by_length: true, ..Simulation::of(NAV2, NoiseKind::Normal, 0, 0).options(Robust::No) }
}

fn noise_of(seed: u64) -> impl FnMut(f64) -> f64 {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    move |variance| NoiseKind::Normal.sample(Variance(variance), &mut rng)
}

/// So many legs as asked for, straight on; a row of the reference is what `step` makes of the one before.
fn straight(legs: usize, mut step: impl FnMut(SE2) -> SE2) -> [Trajectory; 2] {
    let rows = 16 * legs + 1;
    let time = |row: usize| 0.05 * row as f64;
    let poses = std::iter::successors(Some(SE2::identity()), |pose| Some(step(*pose)));
    let reference = poses.take(rows).enumerate().map(|(row, pose)| (time(row), pose));
    let odometry = (0..rows).map(|row| (time(row), SE2::new(ROW * row as f64, 0.0, 0.0)));
    [Trajectory::new(odometry).expect("times rise"), Trajectory::new(reference).expect("times rise")]
}

fn by_length(logs: &[Trajectory; 2], options: &Options) -> Vec<AtLength> {
    let told = calibrate(&logs[0], &logs[1], options).expect("legs enough");
    assert_eq!(told.by_length.iter().map(|each| each.factor).collect::<Vec<_>>(), FACTORS);
    told.by_length
}

#[test]
fn alphas_of_a_random_walk_fall_with_the_leg_length() {
    // m² a metre, as of a robot whose α₃ falls from 0.014 on legs of 0.12 m to 0.0017 on legs of 1 m; and of the heading, rad² a
    // metre, some variance, but too little to bend a leg.
    const WALK: f64 = 0.0017;
    const STIFF: f64 = 1e-6;
    const LOGS: u64 = 5;
    const LEGS: usize = 1600;
    let mut sums = [[0.0; 2]; 5];
    for seed in 0..LOGS {
        let mut noise = noise_of(seed);
        let log = straight(LEGS, |from| from * SE2::new(ROW + noise(WALK * ROW), 0.0, noise(STIFF * ROW)));
        for ((at, sums), rows) in by_length(&log, &options()).iter().zip(&mut sums).zip(ROWS) {
            let estimate = at.estimate.as_ref().expect("legs enough");
            let expected = WALK / (ROW * rows as f64);
            let [from, to] = estimate.intervals[2].expect("determined");
            sums[0] += estimate.alphas[2] / expected / LOGS as f64;
            sums[1] += f64::from(u8::from((from..=to).contains(&expected))) / LOGS as f64;
        }
    }
    for ([mean, covered], rows) in sums.into_iter().zip(ROWS) {
        // A residual's square has the variance 2, and the mean of many three deviations of theirs; a share of 0.95 of 5 logs has
        // the deviation 0.097.
        let residuals = (LEGS * 16 / rows) as f64 * LOGS as f64;
        assert!((mean - 1.0).abs() < 3.0 * (2.0 / residuals).sqrt(), "{rows} rows: {mean}");
        assert!(covered > 0.95 - 3.0 * 0.097, "{rows} rows: {covered}");
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
        let mut noise = noise_of(6);
        let logs = straight(legs, move |from| from * SE2::new(ROW + noise(1e-6), 0.0, noise(1e-6)));
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
