//! JavaScript interface of `calibrate` and `AlphaCalibrator`: logs as arguments, α's as results.

use crate::support::JsObject;
use motion::geom::se2::SE2;
use motion::{MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel};
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use serde::Serialize;
use wasm_bindgen_test::wasm_bindgen_test;

const ALPHAS: [f64; 4] = [0.05, 0.01, 0.005, 0.004];

#[derive(Serialize)]
struct Logs {
    odometry: LogColumns,
    reference: LogColumns,
}

#[derive(Serialize)]
struct LogColumns {
    t: Vec<f64>,
    x: Vec<f64>,
    y: Vec<f64>,
    theta: Vec<f64>,
}

/// Returns odometry and reference of 400 legs, each a second long with ten rows. The reference is simulated with `ALPHAS` and a mount yaw of
/// 0.03 rad.
fn simulate_logs() -> JsObject {
    let model = OdometryModel { alphas: OdomAlphas(ALPHAS), noise: NoiseKind::Normal };
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(5);
    let (mut odometry_pose, mut true_pose) = (SE2::identity(), SE2::identity());
    let (mut odometry_poses, mut reference_poses) = (Vec::new(), Vec::new());
    for leg_index in 0..400 {
        let leg_turn = 0.5 * libm::sin(0.7 * f64::from(leg_index));
        let twist = Vector3::new(0.3 + 0.1 * libm::sin(1.3 * f64::from(leg_index)), 0.0, leg_turn);
        let odom_delta = OdomDelta::from_poses(&SE2::identity(), &SE2::exp(&twist));
        let executed_twist = model.sample(&odom_delta, &SE2::identity(), &mut rng).log();
        for row_index in 0..10 {
            let leg_fraction = f64::from(row_index) / 10.0;
            odometry_poses.push(odometry_pose.boxplus(twist * leg_fraction));
            reference_poses.push(true_pose.boxplus(executed_twist * leg_fraction) * SE2::new(0.0, 0.0, 0.03));
        }
        (odometry_pose, true_pose) = (odometry_pose.boxplus(twist), true_pose.boxplus(executed_twist));
    }
    let columns_of = |log_poses: &[SE2]| LogColumns {
        t: (0..log_poses.len()).map(|row_index| row_index as f64 / 10.0).collect(),
        x: log_poses.iter().map(SE2::x).collect(),
        y: log_poses.iter().map(SE2::y).collect(),
        theta: log_poses.iter().map(SE2::theta).collect(),
    };
    (&Logs { odometry: columns_of(&odometry_poses), reference: columns_of(&reference_poses) }).into()
}

#[wasm_bindgen_test]
fn alphas_of_a_log_are_found_with_their_intervals() {
    let js_logs = simulate_logs();
    js_logs.run("it.found = motion.calibrate({ ...it, legs: { duration: 1 } })");
    let intervals: Vec<(f64, f64)> = js_logs.get("it.found.intervals");
    let alphas: Vec<f64> = js_logs.get("it.found.alphas");
    for ((alpha, (low, high)), truth) in alphas.iter().zip(&intervals).zip(ALPHAS) {
        // The 95 % intervals are doubled in width, so that only one log in ten thousand has a true value outside of an interval.
        assert!(low < alpha && alpha < high, "{low} {alpha} {high}");
        assert!(2.0 * low - alpha < truth && truth < 2.0 * high - alpha, "{low} {truth} {high}");
    }
    let [leg_count, time_count, squared_count]: [usize; 3] =
        js_logs.get("[it.found.legs.count, it.found.legs.times.length, it.found.legs.squared.length]");
    assert!(
        (390..=400).contains(&leg_count) && time_count == 2 * leg_count && squared_count == leg_count,
        "{leg_count} {time_count} {squared_count}"
    );
    assert_eq!(js_logs.get::<Vec<Option<String>>>("it.found.notIdentifiable"), [None, None, None, None]);
    js_logs.run(
        "it.broken = motion.calibrate({ odometry: it.odometry, reference: { ...it.reference, breaks: [1005, 2005] },
            legs: { duration: 1 } })",
    );
    js_logs.assert("it.broken.lost.acrossBreaks === 2 && it.found.lost.acrossBreaks === 0");
    js_logs.assert(
        "it.found.recommended.alphas.every((alpha, i) =>
        alpha === it.found.recommended.inflation * it.found.alphas[i])",
    );
    js_logs.assert(
        "it.found.diagnostics.checks.every(({ passed, message, value, expected: [low, high] }) =>
        passed === (low <= value && value <= high) && passed === (message === ''))",
    );
    let typed_odometry = "Object.fromEntries(Object.entries(it.odometry).map(([key, column]) => [key,
        Float64Array.from(column)]))";
    js_logs.run(&format!(
        "it.again = motion.calibrate({{ odometry: {typed_odometry}, reference: it.reference,
        legs: {{ duration: 1 }}, rule: 'thrun' }})"
    ));
    assert_eq!(js_logs.get::<Vec<f64>>("it.again.alphas"), alphas);
}

#[wasm_bindgen_test]
fn commands_have_six_alphas_and_a_straight_drive_identifies_no_turn_alphas() {
    let it = simulate_logs();
    it.run(
        "it.commands = { t: it.odometry.t, v: it.odometry.t.map((t) => 0.3 + 0.1 * Math.sin(t)),
        omega: it.odometry.t.map((t) => 0.6 * Math.sin(0.17 * t)) }",
    );
    it.run(
        "it.velocity = motion.calibrate({ odometry: it.commands, reference: it.reference,
        model: 'velocity', legs: { duration: 1 } })",
    );
    assert_eq!(it.get::<[usize; 2]>("[it.velocity.alphas.length, it.velocity.intervals.length]"), [6, 6]);
    it.run(
        "it.straight = (shake) => ({ t: it.odometry.t, x: it.odometry.t.map((t, i) =>
        0.5 * t + shake * (i % 7)), y: it.odometry.t.map(() => 0), theta: it.odometry.t.map(() => 0) })",
    );
    it.run("it.ahead = motion.calibrate({ odometry: it.straight(0), reference: it.straight(1e-3) })");
    assert_eq!(
        it.get::<[String; 2]>("[it.ahead.notIdentifiable[0], it.ahead.notIdentifiable[3]]"),
        ["insufficient-rotation", "insufficient-rotation"]
    );
    assert_eq!(
        it.get::<[Option<f64>; 3]>(
            "[it.ahead.alphas[0], it.ahead.alphas[3], it.ahead.systematicErrors.turnScale.value]"
        ),
        [None; 3]
    );
}

#[wasm_bindgen_test]
fn the_figure_opens_with_a_log_of_known_alphas() {
    let it = JsObject::new("new motion.AlphaCalibrator()");
    it.assert(
        "it.truth.alphas.length === 4 && it.count === it.legs.count && it.count === it.legs.squared.length
        && it.fits === 1 && it.stats.legs === undefined",
    );
    assert_eq!(
        it.get::<Vec<usize>>(
            "it.panels('turn').map(({ alpha }) => alpha).concat(it.panels('distance').map(({ alpha }) => alpha))"
        ),
        [0, 3, 0, 1, 2, 1]
    );
    let array_lengths: [f64; 2] = it.get(
        "(({ outcomes, outline, read, ended }) =>
        [outcomes.length % 3 + (outline.length % 2), read.length + ended.length])(it.leg(0))",
    );
    assert_eq!(array_lengths, [0.0, 6.0]);
    assert_eq!(it.get::<Option<()>>("it.leg(it.count)"), None);
    assert_eq!(it.get::<i32>("it.nearest(1e6, 1e6, 1)"), -1);
}

#[wasm_bindgen_test]
fn another_log_replaces_the_simulated_log_and_its_fit_can_be_restored() {
    let it = simulate_logs();
    it.run("it.simulation = new motion.AlphaCalibrator({ outliers: 'keep', duration: 1 })");
    it.run("it.simulation.setLog(it.odometry, it.reference)");
    assert_eq!(it.get::<Option<()>>("it.simulation.truth"), None);
    assert_eq!(
        it.get::<Vec<f64>>("it.simulation.stats.alphas"),
        it.get::<Vec<f64>>(
            "motion.calibrate({ odometry: it.odometry, reference: it.reference,
        legs: { duration: 1 }, outliers: 'keep' }).alphas"
        )
    );
    it.run("it.restored = motion.AlphaCalibrator.restored(it.simulation.config, it.simulation.save())");
    let results_of = |name: &str| {
        it.get::<String>(&format!("JSON.stringify([it.{name}.config, it.{name}.stats, it.{name}.count])"))
    };
    assert_eq!(results_of("restored"), results_of("simulation"));
    it.run("it.restored.configure({ rule: 'nav2' })");
    it.assert("it.restored.isPending && it.restored.fittedConfig.rule === 'thrun' && it.restored.fits === 1");
    it.run("it.simulation.configure({ rule: 'nav2' })");
    it.assert("!it.simulation.isPending && it.simulation.fits === 3");
}

#[wasm_bindgen_test]
fn errors_name_the_refused_value_and_what_is_allowed() {
    let it = simulate_logs();
    it.run("it.few = { t: [0, 1], x: [0, 1], y: [0, 0], theta: [0, 0] }");
    it.run("it.simulation = new motion.AlphaCalibrator()");
    it.assert_refused(
        "it.simulation.config",
        r#"
        motion.calibrate({})
        TypeError: odometry is undefined; allowed is an object with keys from t, x, y, theta, breaks or from t, v, omega, breaks
        motion.calibrate({ odometry: it.few })
        TypeError: reference is undefined; allowed is an object with keys from t, x, y, theta, breaks
        motion.calibrate({ odometry: it.few, reference: { ...it.few, x: [1] } })
        RangeError: reference.x has length 1; allowed is 2, as of reference.t
        motion.calibrate({ odometry: { ...it.few, t: [] }, reference: it.few })
        RangeError: odometry.t has length 0; allowed is 2 to 10000000
        motion.calibrate({ odometry: { ...it.few, x: [0, 'a'] }, reference: it.few })
        TypeError: odometry.x[1] is "a"; allowed is a number
        motion.calibrate({ odometry: { ...it.few, theta: [0, NaN] }, reference: it.few })
        RangeError: odometry.theta[1] is NaN; allowed is a number from -1000000000 to 1000000000
        motion.calibrate({ odometry: { ...it.few, t: [1, 1] }, reference: it.few })
        RangeError: odometry: sample 1 is not later than the one before; allowed are increasing times
        motion.calibrate({ odometry: { ...it.few, breaks: [2] }, reference: it.few })
        RangeError: odometry.breaks[0] is 2; allowed is a whole number from 1 to 1
        motion.calibrate({ odometry: it.few, reference: it.few })
        RangeError: not enough data: 1 legs have poses in both logs, and 8 are needed. Take both logs from one drive, choose
            shorter legs, or drive longer
        motion.calibrate({ odometry: it.few, reference: it.few, model: 'banana' })
        RangeError: model is "banana"; allowed is "odometry" or "omnidirectional" or "velocity"
        motion.calibrate({ odometry: it.few, reference: it.few, model: 'velocity', rule: 'nav2' })
        RangeError: rule does not go with the model; allowed is thrun, nav2 or beluga with odometry, omni with omnidirectional,
            and none with velocity
        motion.calibrate({ odometry: it.few, reference: it.few, legs: { duration: 1, angle: 1 } })
        RangeError: legs.duration is given beside a distance or an angle; allowed is one of the two
        motion.calibrate({ odometry: it.few, reference: it.few, correct: { yaw: true } })
        TypeError: correct.yaw is an unknown key; allowed are clockOffset, mountYaw, leverArm, distanceScale, turnScale
        it.simulation.configure({ seed: 1, rule: 'omnibus' })
        RangeError: rule is "omnibus"; allowed is "thrun" or "nav2" or "beluga" or "omni"
        motion.AlphaCalibrator.restored({}, new Uint8Array(3))
        TypeError: saved is no fit; allowed is that of another simulation
        "#,
    );
}
