//! `DeadReckoning`.

use crate::support::{Object, assert_near};
use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn recursions_are_compared_with_the_robots() {
    let it = Object::new("new motion.DeadReckoning({ step: 20 })");
    for order in ["chapter", "first-order", "fourth-order"] {
        let [along, across]: [f64; 2] =
            it.get(&format!("it.stats.misses['{order}'].slice(0, 2).map(({{ end }}) => end)"));
        let propagated: [[f64; 3]; 3] = it.get(&format!(
            "motion.propagate({{ command: it.config.command, alphas: it.config.alphas,
                compounding: '{order}', steps: 20 }})"
        ));
        let predicted: [[f64; 3]; 3] = it.get(&format!("it.stats.predicted['{order}']"));
        for (row, expected) in predicted.into_iter().zip(propagated) {
            assert_near(row, expected, 1e-15);
        }
        assert_near(
            it.get(&format!("it.predicted['{order}'].slice(57)")),
            [0, 1, 2].map(|i| propagated[i][i]),
            1e-15,
        );
        let ratios: [f64; 2] = it.get(&format!("it.ratios['{order}'].slice(57, 59)"));
        assert_near(ratios, [along + 1.0, across + 1.0], 1e-12);
    }
    it.assert("(({ told, first, last }) => told && first > 1 && last === 20)(it.stats.misses.chapter[0])");
    let measured: [f64; 3] = it.get("it.measured.slice(57)");
    assert_near(measured, it.get("it.stats.measured.cov.map((row, i) => row[i])"), 1e-15);
    assert_eq!(it.get::<usize>("it.relativeErrors.length"), 60);
}

#[wasm_bindgen_test]
fn robots_and_outlines_are_those_of_a_step() {
    let it = Object::new("new motion.DeadReckoning({ samples: 2000 })");
    assert_eq!(
        it.get::<[usize; 3]>("[it.poses.length, it.twists.length, it.nominal.length]"),
        [1800, 1800, 60]
    );
    assert_near(it.get("it.nominal.slice(57)"), [2.0 * 2_f64.sin(), 2.0 * (1.0 - 2_f64.cos()), 2.0], 1e-12);
    assert_near(it.get("it.commanded.slice(-2)"), [2.0 * 2_f64.sin(), 2.0 * (1.0 - 2_f64.cos())], 1e-12);
    assert_eq!(
        it.get::<Vec<f64>>("it.rollout(5).slice(3, 6)"),
        it.get::<Vec<f64>>("it.posesAfter(2).slice(15, 18)")
    );
    assert_eq!(it.get::<i32>("it.nearest(it.poses[15], it.poses[16], 1e-9)"), 5);
    let outlines = "Object.entries(it.outlines(2)).filter(([, line]) => line.length > 60
        && line[0] === line.at(-2)).map(([name]) => name)";
    assert_eq!(it.get::<Vec<String>>(outlines), ["ellipse", "exponential", "predicted", "measured"]);
    assert_eq!(it.get::<(Option<()>, usize)>("[it.outlines(21), it.posesAfter(21).length]"), (None, 0));
    it.assert(
        "['durations', 'along', 'across', 'alongFirstOrder', 'acrossFirstOrder'].every((key) =>
        it.straightGrowth[key].length === it.straightGrowth.durations.length)",
    );
}

#[wasm_bindgen_test]
fn one_level_stands_for_all_heading_noise() {
    let it = Object::new("new motion.DeadReckoning({ samples: 10, headingNoise: 0.04 })");
    assert_eq!(it.get::<Vec<f64>>("it.config.alphas"), [0.02, 0.02, 0.04, 0.04, 0.01, 0.01]);
    assert_eq!(it.get::<f64>("it.headingNoise"), 0.04);
    it.run("it.configure({ alphas: [0.02, 0.02, 0.04, 0.05, 0.01, 0.01] })");
    assert_eq!(it.get::<Option<f64>>("it.headingNoise"), None);
}

#[wasm_bindgen_test]
fn what_is_refused_changes_nothing() {
    let it = Object::new("new motion.DeadReckoning({ samples: 20 })");
    it.assert_refused(
        "[it.config, it.stats]",
        r#"
        it.configure({ seed: 1, steps: 201 })
        RangeError: steps is 201; allowed is a whole number from 1 to 200
        it.configure({ alphas: Array(6).fill(0.1), headingNoise: 0.1 })
        TypeError: headingNoise is given beside alphas; allowed is one of the two
        it.rollout(20)
        RangeError: index is 20; allowed is one of the 20 samples shown, counted from 0
        it.outlines(0)
        RangeError: step is 0; allowed is a whole number from 1 to 200
        it.posesAfter()
        RangeError: step is NaN; allowed is a whole number from 1 to 200
        "#,
    );
}
