//! `ArcAnatomy`.

use crate::support::{Object, assert_near, get};
use motion::geom::se2::SE2;
use motion::{MotionModel, NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel, invert_arc};
use wasm_bindgen_test::wasm_bindgen_test;

const COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };

#[wasm_bindgen_test]
fn the_inversion_and_the_score_are_those_of_the_model() {
    let it = Object::new("new motion.ArcAnatomy()");
    let alphas = VelocityAlphas([0.05, 0.05, 0.05, 0.09, 0.01, 0.01]);
    let model = VelocityModel { alphas, noise: NoiseKind::Normal };
    let (start, next) = (SE2::identity(), SE2::new(1.1, 0.5, 1.1));
    let arc = invert_arc(&start, &next, 1.0);
    assert_near(
        it.get("it.stats.factors.map(({ estimate }) => estimate)"),
        [arc.v_hat, arc.omega_hat, arc.gamma_hat],
        1e-15,
    );
    let p = model.prob(&next, &COMMAND, &start);
    let density = model.pose_density(&next, &COMMAND, &start).expect("a density");
    let [prob_in_js, product_in_js, density_in_js]: [f64; 3] =
        it.get("[it.stats.prob, it.stats.factors.reduce((p, { value }) => p * value, 1), it.stats.density]");
    assert_near([prob_in_js / p, product_in_js / p, density_in_js / density], [1.0; 3], 1e-12);
    assert_near(it.get("it.table.lines.slice(-1)"), [p], 1e-15);
    let circle: (f64, [f64; 2], [f64; 3]) = it.get("pick(it.stats.commanded, 'radius', 'center', 'end')");
    assert_eq!((circle.0, circle.1), (2.0, [0.0, 2.0]));
    assert_near(circle.2, [0.958_851_077_208, 0.244_834_876_219, 0.5], 1e-12);
    assert_near([it.get("it.stats.weakest")], [2.0], 0.0);
    assert_near(it.get("it.stats.xi"), next.boxminus(&start).into(), 1e-12);
}

#[wasm_bindgen_test]
fn paths_maps_and_errors_of_forms_are_arrays() {
    let it = Object::new("new motion.ArcAnatomy({ map: 'density' })");
    let lines = "Object.entries(it.paths).filter(([, line]) => line instanceof Float64Array
        && line.length >= 4).map(([name]) => name)";
    assert_eq!(it.get::<Vec<String>>(lines), ["commanded", "inverted", "driven", "lie", "ticks"]);
    assert_near(it.get("it.paths.driven.slice(-2)"), [1.1, 0.5], 1e-12);
    assert_near(it.get("it.underway(1).slice(6)"), [1.1, 0.5, 1.1], 1e-12);
    it.assert(
        "(({ columns, rows, shades, prob, density }) =>
        shades instanceof Uint8Array && shades.length === columns * rows && Math.max(...shades) > 200
        && density.every((line) => line instanceof Float64Array) && density.length > 0)
        (it.surface(0, -0.5, 2, 1.5))",
    );
    it.run("it.configure({ map: 'none' })");
    assert_eq!(it.get::<Option<()>>("it.surface(0, 0, 1, 1)"), None);
    let [crossover, threshold, points]: [f64; 3] =
        get("(({ estimatedCrossover, threshold, arc }) => [estimatedCrossover, threshold, \
         arc.length])(motion.ArcAnatomy.formErrors())");
    assert!(crossover > 0.0 && threshold > crossover && points > 10.0, "{crossover} {threshold} {points}");
}

#[wasm_bindgen_test]
fn what_is_refused_changes_nothing() {
    let it = Object::new("new motion.ArcAnatomy()");
    it.assert_refused(
        "[it.config, it.stats]",
        r#"
        it.configure({ map: 'all', printed: true })
        RangeError: map is "all"; allowed is "none" or "prob" or "density"
        it.configure({ next: { x: NaN, y: 0, theta: 0 } })
        RangeError: next.x is NaN; allowed is a number from -1000000 to 1000000
        it.underway(1.1)
        RangeError: share is 1.1; allowed is a number from 0 to 1
        it.surface(0, 0, -1, 1)
        RangeError: xMax is -1; allowed is a number from 0 to 1000000000000000000
        "#,
    );
}
