//! JavaScript interface of `DeadReckoning`.

use crate::support::Object;
use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn a_step_after_the_last_has_no_outlines_and_no_poses() {
    let it = Object::new("new motion.DeadReckoning({ samples: 20 })");
    it.assert("Object.values(it.outlines(20)).every((line) => line instanceof Float64Array)");
    assert_eq!(it.get::<(Option<()>, usize)>("[it.outlines(21), it.posesAfter(21).length]"), (None, 0));
}

#[wasm_bindgen_test]
fn a_refused_call_changes_nothing() {
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
