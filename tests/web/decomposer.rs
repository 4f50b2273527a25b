use crate::support::JsObject;
use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn a_refused_call_changes_nothing() {
    let decomposer = JsObject::new("new motion.OdometryDecomposer()");
    decomposer.assert_refused(
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
