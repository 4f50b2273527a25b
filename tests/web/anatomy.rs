use crate::support::{JsObject, get};
use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn paths_heat_maps_and_errors_of_arc_forms_are_arrays() {
    let anatomy = JsObject::new("new motion.ArcAnatomy({ map: 'density' })");
    let path_names = "Object.entries(it.paths).filter(([, line]) => line instanceof Float64Array
        && line.length >= 4).map(([name]) => name)";
    assert_eq!(anatomy.get::<Vec<String>>(path_names), ["commanded", "inverted", "driven", "lie", "ticks"]);
    anatomy.assert(
        "(({ columns, rows, shades, prob, density }) =>
        shades instanceof Uint8Array && shades.length === columns * rows && Math.max(...shades) > 200
        && density.every((line) => line instanceof Float64Array) && density.length > 0)
        (it.surface([0, -0.5, 2, 1.5]))",
    );
    anatomy.run("it.configure({ map: 'none' })");
    assert_eq!(anatomy.get::<Option<()>>("it.surface([0, 0, 1, 1])"), None);
    assert!(get::<bool>("motion.ArcAnatomy.formErrors().arc instanceof Float64Array"));
}

#[wasm_bindgen_test]
fn a_refused_call_changes_nothing() {
    let anatomy = JsObject::new("new motion.ArcAnatomy()");
    anatomy.assert_refused(
        "[it.config, it.stats]",
        r#"
        it.configure({ map: 'all', printed: true })
        RangeError: map is "all"; allowed is "none" or "prob" or "density"
        it.underway(1.1)
        RangeError: share is 1.1; allowed is a number from 0 to 1
        it.surface([0, 0, -1, 1])
        RangeError: xMax is -1; allowed is a number from 0 to 1000000000000000000
        "#,
    );
}
