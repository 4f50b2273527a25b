//! Models, arcs and SE(2): functions that users call in exercises.

use crate::support::{JsObject, assert_near, get};
use motion::geom::se2::SE2;
use motion::{
    Compounding, ConfiguredOdometry, MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel,
    TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel, invert_arc,
};
use nalgebra::{Matrix3, Vector3};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use wasm_bindgen_test::wasm_bindgen_test;

/// JavaScript values for the tests. The constants and functions below have equal values in Rust.
const JS_VALUES: &str = "{
    start: { x: 1, y: -2, theta: 0.5 }, next: { x: 1.7, y: -1.3, theta: 1.2 },
    command: { v: 1, omega: 0.5, dt: 1 }, control: { rot1: 0.2, trans: 1, rot2: 0.3 },
    velocity: new motion.VelocityModel({ alphas: [0.02, 0.03, 0.04, 0.05, 0.01, 0.02], noise: 'triangular' }),
    odometry: new motion.OdometryModel({ alphas: [0.1, 0.05, 0.02, 0.03] }),
    aware: new motion.OdometryModel({ alphas: [0.1, 0.05, 0.02, 0.03], reverseAware: true }),
    back: { x: 0.1, y: -2.4, theta: 0.55 }, reverse: { rot1: 3, trans: 1, rot2: -3 },
}";
const VELOCITY_COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
const ODOMETRY_READING: OdomDelta = OdomDelta { rot1: 0.2, trans: 1.0, rot2: 0.3 };
const REVERSE_READING: OdomDelta = OdomDelta { rot1: 3.0, trans: 1.0, rot2: -3.0 };
const VELOCITY_MODEL: VelocityModel = VelocityModel {
    alphas: VelocityAlphas([0.02, 0.03, 0.04, 0.05, 0.01, 0.02]),
    noise: NoiseKind::Triangular,
};
const ODOMETRY_MODEL: OdometryModel =
    OdometryModel { alphas: OdomAlphas([0.1, 0.05, 0.02, 0.03]), noise: NoiseKind::Normal };

fn new_start_pose() -> SE2 {
    SE2::new(1.0, -2.0, 0.5)
}

fn new_next_pose() -> SE2 {
    SE2::new(1.7, -1.3, 1.2)
}

fn pose_behind() -> SE2 {
    SE2::new(0.1, -2.4, 0.55)
}

fn coordinates_of(pose: &SE2) -> [f64; 3] {
    [pose.x(), pose.y(), pose.theta()]
}

fn sample_coordinates<M: MotionModel>(model: &M, control: &M::Control) -> Vec<f64> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(9);
    (0..5).flat_map(|_| coordinates_of(&model.sample(control, &new_start_pose(), &mut rng))).collect()
}

fn score_and_density_of<M: MotionModel>(model: &M, x_next: &SE2, control: &M::Control) -> (f64, Option<f64>) {
    (model.prob(x_next, control, &new_start_pose()), model.pose_density(x_next, control, &new_start_pose()))
}

fn rows_of(matrix: &Matrix3<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|matrix_row| matrix_row.iter().copied().collect()).collect()
}

#[wasm_bindgen_test]
fn poses_and_twists_are_those_of_rust() {
    let js = JsObject::new(JS_VALUES);
    let twist = Vector3::new(0.3, -0.1, 0.7);
    let pose_of = |expression: &str| js.get::<[f64; 3]>(&format!("Object.values(motion.se2.{expression})"));
    assert_eq!(pose_of("exp([0.3, -0.1, 0.7])"), coordinates_of(&SE2::exp(&twist)));
    assert_eq!(pose_of("compose(it.start, it.next)"), coordinates_of(&(new_start_pose() * new_next_pose())));
    assert_eq!(pose_of("inverse(it.start)"), coordinates_of(&new_start_pose().inverse()));
    assert_eq!(
        pose_of("boxplus(it.start, new Float64Array([0.3, -0.1, 0.7]))"),
        coordinates_of(&new_start_pose().boxplus(twist))
    );
    assert_eq!(js.get::<Vec<f64>>("motion.se2.log(it.next)"), new_next_pose().log().as_slice());
    assert_eq!(
        js.get::<Vec<f64>>("motion.se2.boxminus(it.next, it.start)"),
        new_next_pose().boxminus(&new_start_pose()).as_slice()
    );
    let matrix_of = |expression: &str| js.get::<Vec<Vec<f64>>>(&format!("motion.se2.{expression}"));
    assert_eq!(matrix_of("adjoint(it.start)"), rows_of(&new_start_pose().adjoint()));
    assert_eq!(matrix_of("rightJacobian([0.3, -0.1, 0.7])"), rows_of(&SE2::right_jacobian(&twist)));
    assert_eq!(js.get::<Vec<String>>("Object.keys(motion.se2.inverse(it.start))"), ["x", "y", "theta"]);
}

#[wasm_bindgen_test]
fn an_arc_is_inverted_and_two_poses_are_decomposed() {
    let js = JsObject::new(JS_VALUES);
    let arc = invert_arc(&new_start_pose(), &new_next_pose(), 2.0);
    let [x, y] = arc.centre(&new_start_pose()).expect("an arc");
    assert_eq!(
        js.get::<Vec<f64>>(
            "(({ vHat, omegaHat, gammaHat, center, radius, turn }) =>
                [vHat, omegaHat, gammaHat, center.x, center.y, radius, turn])(motion.invertArc(it.start, it.next, 2))"
        ),
        [arc.v_hat, arc.omega_hat, arc.gamma_hat, x, y, arc.radius(), 2.0 * arc.omega_hat]
    );
    let straight_arc_call = "motion.invertArc({ x: 0, y: 0, theta: 0 }, { x: -2, y: 0, theta: 0.5 }, 0.5)";
    assert_eq!(
        get::<(f64, f64, f64, Option<()>, f64, f64)>(&format!("Object.values({straight_arc_call})")),
        (-4.0, 0.0, 1.0, None, f64::INFINITY, 0.0)
    );
    let legs = get("Object.values(motion.decompose({ x: 1, y: 1, theta: 0.2 }, { x: 4, y: 5, theta: 1.5 }))");
    let bearing = 4_f64.atan2(3.0);
    assert_near(legs, [bearing - 0.2, 5.0, 1.5 - bearing], 1e-15);
}

#[wasm_bindgen_test]
fn models_score_and_draw_as_in_rust() {
    let js = JsObject::new(JS_VALUES);
    let [velocity_scores, odometry_scores, reverse_aware_scores]: [(f64, Option<f64>); 3] = js.get(
        "[[it.velocity, it.next, it.command], [it.odometry, it.next, it.control], [it.aware, it.back,
            it.reverse]]
            .map(([model, next, control]) =>
                [model.prob(next, control, it.start), model.poseDensity(next, control, it.start)])",
    );
    assert_eq!(velocity_scores, score_and_density_of(&VELOCITY_MODEL, &new_next_pose(), &VELOCITY_COMMAND));
    assert_eq!(odometry_scores, score_and_density_of(&ODOMETRY_MODEL, &new_next_pose(), &ODOMETRY_READING));
    let reverse_aware_model = ConfiguredOdometry { model: ODOMETRY_MODEL, reverse_aware: true };
    assert_eq!(
        reverse_aware_scores,
        score_and_density_of(&reverse_aware_model, &pose_behind(), &REVERSE_READING)
    );
    assert!(
        reverse_aware_scores.0
            > 10.0 * ODOMETRY_MODEL.prob(&pose_behind(), &REVERSE_READING, &new_start_pose()),
        "the option has an effect"
    );

    for (js_call, expected) in [
        ("velocity.sample(it.command", sample_coordinates(&VELOCITY_MODEL, &VELOCITY_COMMAND)),
        ("odometry.sample(it.control", sample_coordinates(&ODOMETRY_MODEL, &ODOMETRY_READING)),
        ("aware.sample(it.reverse", sample_coordinates(&reverse_aware_model, &REVERSE_READING)),
    ] {
        assert_eq!(js.get::<Vec<f64>>(&format!("it.{js_call}, it.start, 5, 9)")), expected, "{js_call}");
    }
    js.assert("it.aware.sample(it.reverse, it.start, 5, 9) instanceof Float64Array");
    // Without a last turn the poses lie on a surface, and have no density over x, y and θ.
    let model_without_last_turn = "new motion.VelocityModel({ alphas: [0.02, 0.02, 0.02, 0.02, 0, 0] })";
    assert_eq!(
        js.get::<Option<f64>>(&format!(
            "{model_without_last_turn}.poseDensity(it.next, it.command, it.start)"
        )),
        None
    );
}

#[wasm_bindgen_test]
fn covariances_are_propagated_as_in_rust() {
    let noise_model =
        TangentNoiseModel::from_velocity(&VELOCITY_MODEL, &VELOCITY_COMMAND).expect("a covariance");
    let twist = TangentNoiseModel::twist(&VELOCITY_COMMAND);
    let js = JsObject::new(JS_VALUES);
    for (js_keyword, recursion) in [
        ("chapter", Compounding::Chapter),
        ("first-order", Compounding::FirstOrder),
        ("fourth-order", Compounding::FourthOrder),
    ] {
        let mut covariance = Matrix3::from_diagonal(&Vector3::new(0.01, 0.02, 0.03));
        for _ in 0..3 {
            covariance = noise_model.propagate(&covariance, &twist, recursion);
        }
        let js_options = format!(
            "{{ sigma: [[0.01, 0, 0], [0, 0.02, 0], [0, 0, 0.03]], command: it.command,
                alphas: [0.02, 0.03, 0.04, 0.05, 0.01, 0.02], compounding: '{js_keyword}', steps: 3 }}"
        );
        assert_eq!(
            js.get::<Vec<Vec<f64>>>(&format!("motion.propagate({js_options})")),
            rows_of(&covariance),
            "{js_keyword}"
        );
    }
    let propagate_call =
        "motion.propagate({ command: it.command, alphas: [0.02, 0.03, 0.04, 0.05, 0.01, 0.02] })";
    let cov_after_one_step = noise_model.propagate(&Matrix3::zeros(), &twist, Compounding::Chapter);
    assert_eq!(js.get::<Vec<Vec<f64>>>(propagate_call), rows_of(&cov_after_one_step));
}

#[wasm_bindgen_test]
fn random_seeds_are_whole_numbers_of_32_bits() {
    let seeds: Vec<f64> = get("Array.from({ length: 20 }, motion.randomSeed)");
    assert!(
        seeds.iter().all(|seed| (0.0..4_294_967_296.0).contains(seed) && seed.fract() == 0.0),
        "{seeds:?}"
    );
    assert!(seeds.iter().any(|seed| *seed != seeds[0]), "{seeds:?}");
}

#[wasm_bindgen_test]
fn errors_name_the_refused_value_and_what_is_allowed() {
    let js = JsObject::new(JS_VALUES);
    js.assert_refused(
        "it",
        r#"
        new motion.VelocityModel({ alphas: [1, 2] })
        RangeError: alphas has length 2; allowed is an array of 6 numbers
        new motion.OdometryModel({ alphas: [1, 2, 3, -4] })
        RangeError: alphas[3] is -4; allowed is a number from 0 to 1000000
        it.velocity.prob({ x: 1, y: 2 }, it.command, it.start)
        TypeError: next.theta is undefined; allowed is a number
        it.odometry.prob(it.next, it.command, it.start)
        TypeError: control.v is an unknown key; allowed are rot1, trans, rot2
        it.velocity.sample(it.command, it.start, 1, 0.5)
        RangeError: seed is 0.5; allowed is a whole number from 0 to 9007199254740991
        motion.invertArc(it.start, it.next, 0)
        RangeError: dt is 0; allowed is a number from 0.000001 to 1000000
        motion.se2.exp([1, 2, NaN])
        RangeError: twist[2] is NaN; allowed is a number from -1000000 to 1000000
        motion.propagate({ command: it.command, alphas: Array(6).fill(0.1), compounding: 'third' })
        RangeError: compounding is "third"; allowed is "chapter" or "first-order" or "fourth-order"
        motion.propagate({ command: it.command, alphas: Array(6).fill(0.1), sigma: [[1, 2, 0], [2, 1, 0], [0, 0, 1]] })
        RangeError: sigma is no covariance: the matrix has a negative variance in some direction; a covariance has none
        motion.propagate({ command: it.command, alphas: Array(6).fill(0.1), sigma: [[1, 2, 0], [0, 1, 0], [0, 0, 1]] })
        RangeError: sigma is no covariance: the matrix differs from its transpose; a covariance is symmetric
        motion.propagate({ command: { v: 1, omega: 3, dt: 0.7 }, alphas: Array(6).fill(1), compounding: 'fourth-order',
            steps: 7, })
        RangeError: steps is 7; allowed are at most 2 here: the next leaves no covariance, for the noise is too large
        "#,
    );
}
