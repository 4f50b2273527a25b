//! `OdometryDecomposer`.

use crate::support::{Object, assert_near};
use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn the_reading_is_taken_apart_by_every_rule() {
    let it = Object::new("new motion.OdometryDecomposer({ to: { x: 1.2, y: 1, theta: 1.2 } })");
    assert_eq!(
        it.get::<Vec<String>>("it.rules.map(({ rule }) => rule)"),
        ["thrun", "nav2", "beluga", "omni"]
    );
    let rot1 = (1_f64 / 1.2).atan();
    assert_near(it.get("Object.values(it.rules[0].legs)"), [rot1, 2.44_f64.sqrt(), 1.2 - rot1], 1e-12);
    assert_near(it.get("it.linkage.slice(-3)"), [1.2, 1.0, 1.2], 1e-12);
    assert_near(it.get("Object.values(it.robot)"), [1.2, 1.0, 1.2], 1e-12);
    assert_near(it.get("Object.values(it.drifted.legs)"), [rot1, 2.44_f64.sqrt(), 1.2 - rot1], 1e-12);
    assert_eq!(
        it.get::<[usize; 3]>("[it.drifted.poses.length, it.ghosts(7).length, it.curve(2, 5).length]"),
        [9, 84, 20]
    );
}

#[wasm_bindgen_test]
fn outcomes_have_the_exact_spread() {
    let it = Object::new("new motion.OdometryDecomposer({ samples: 5000, seed: 4 })");
    let [measured, error, exact]: [f64; 3] =
        it.get("pick(it.stats, 'crossTrack', 'crossTrackError', 'exactCrossTrack')");
    assert_near([measured], [exact], 4.5 * error);
    assert_eq!(it.get::<i32>("it.nearest(it.poses[3 * 40], it.poses[3 * 40 + 1], 1e-9)"), 40);
    let cloud: Vec<f64> = it.get("it.poses");
    it.run("it.configureFirst({}, 0)");
    assert_eq!(it.get::<[usize; 3]>("[it.shown, it.addSamples(30), it.addSamples(5000)]"), [0, 30, 5000]);
    assert_eq!(it.get::<Vec<f64>>("it.poses"), cloud);
}

#[wasm_bindgen_test]
fn what_is_refused_changes_nothing() {
    let it = Object::new("new motion.OdometryDecomposer()");
    it.assert_refused(
        "[it.config, it.stats]",
        r#"
        it.configure({ seed: 1, rule: 'amcl' })
        RangeError: rule is "amcl"; allowed is "thrun" or "nav2" or "beluga" or "omni"
        it.curve(-1, 5)
        RangeError: longest is -1; allowed is a number from 0 to 1000000
        it.nearest(0, 0)
        RangeError: radius is NaN; allowed is a number from 0 to Infinity
        "#,
    );
}
