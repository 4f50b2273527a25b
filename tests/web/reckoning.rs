use crate::support::JsObject;
use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn a_refused_call_changes_nothing() {
    let reckoning = JsObject::new("new motion.DeadReckoning({ samples: 20 })");
    reckoning.assert_refused(
        "[it.config, it.stats]",
        r#"
        it.configure({ seed: 1, steps: 201 })
        RangeError: steps is 201; allowed is a whole number from 1 to 200
        it.configure({ alphas: Array(6).fill(0.1), headingNoise: 0.1 })
        TypeError: headingNoise is given beside alphas; allowed is one of the two
        it.rollout(20)
        RangeError: index is 20; allowed is one of the 20 samples shown, counted from 0
        "#,
    );
}
