//! Memory of the WebAssembly module: the largest clouds fit, and freed memory is used again.

use crate::support::JsObject;
use js_sys::{ArrayBuffer, WebAssembly};
use motion::geom::segment::Segment;
use motion::map::FloorPlan;
use motion::sim::squeeze::{self, MapSqueeze};
use wasm_bindgen::JsCast;
use wasm_bindgen_test::wasm_bindgen_test;

fn memory_size_in_bytes() -> u32 {
    let wasm_memory: WebAssembly::Memory = wasm_bindgen::memory().unchecked_into();
    wasm_memory.buffer().unchecked_into::<ArrayBuffer>().byte_length()
}

/// Constructor calls, each with a property or call that accesses the object's memory.
const CLASSES_AND_READS: [(&str, &str); 8] = [
    ("BananaMachine({ samples: 20_000 })", "stats"),
    ("MapSqueeze({ samples: 20_000 })", "stats"),
    ("ArcAnatomy()", "stats"),
    ("OdometryDecomposer({ samples: 5_000 })", "stats"),
    ("DeadReckoning({ samples: 2_000 })", "stats"),
    ("AlphaCalibrator()", "stats"),
    ("VelocityModel({ alphas: Array(6).fill(0.1) })", SCORE_CALL),
    ("OdometryModel({ alphas: Array(4).fill(0.1), reverseAware: true })", SCORE_CALL),
];
const SCORE_CALL: &str = "prob(it.pose, it.pose, it.pose)";

#[wasm_bindgen_test]
fn a_freed_object_is_gone_with_its_memory() {
    let js = JsObject::new("({ pose: { x: 0, y: 0, theta: 0 } })");
    for (class_name, read_expression) in CLASSES_AND_READS {
        let use_and_free_script = format!("[it.one = new motion.{class_name}, it.one.stats, it.one.free()]");
        js.run(&use_and_free_script);
        let byte_length_before = memory_size_in_bytes();
        for _ in 0..10 {
            js.run(&use_and_free_script);
        }
        // If a cloud were not freed, the memory would grow by more than a WebAssembly page of 64 KiB.
        assert!(
            memory_size_in_bytes() <= byte_length_before + 65_536,
            "{class_name} left {} bytes",
            memory_size_in_bytes() - byte_length_before
        );
        assert!(js.error(&format!("it.one.{read_expression}")).starts_with("Error: "), "{class_name}");
        js.run(&format!("[it.one = new motion.{class_name}, it.one[Symbol.dispose]()]"));
        assert!(js.error(&format!("it.one.{read_expression}")).starts_with("Error: "), "{class_name}");
    }
}

#[wasm_bindgen_test]
fn the_largest_cloud_fits_and_outlives_refused_settings() {
    let js = JsObject::new("new motion.BananaMachine({ samples: 10_000_000, seed: 1 })");
    let cross_track_skew: f64 = js.get("it.stats.crossTrackSkew");
    assert!(js.error("it.configure({ samples: 10_000_001 })").starts_with("RangeError: samples "));
    assert!(js.error("it.configure({ alphas: Array(6).fill(NaN) })").starts_with("RangeError: alphas[0] "));
    assert_eq!(js.get::<(usize, f64)>("[it.shown, it.stats.crossTrackSkew]"), (10_000_000, cross_track_skew));
    js.run("it.configure({ samples: 10 })");
    assert_eq!(js.get::<usize>("it.poses.length"), 30);
    js.run("it.free()");
}

#[wasm_bindgen_test]
fn the_largest_cloud_fits_in_the_largest_plan() {
    let settings = squeeze::Settings { samples: squeeze::MAX_SAMPLES, ..Default::default() };
    let mut simulation = MapSqueeze::new(settings).expect("memory for the largest cloud");
    let stats_before = simulation.stats();
    assert_eq!(stats_before.drawn, settings.samples);
    let wall = Segment { from: [0.0, 0.0], to: [12.0, 0.0] };
    let plan = FloorPlan::new(vec![wall; FloorPlan::MAX_WALLS], [0.0, 0.0, 12.0, 9.0]).expect("a valid plan");
    simulation.set_plan(plan);
    assert!(simulation.stats().accepted > stats_before.accepted, "the other walls are gone");
}

#[wasm_bindgen_test]
fn the_results_of_read_equal_the_properties_of_the_same_names() {
    for property_name in [
        "BananaMachine",
        "ArcAnatomy",
        "DeadReckoning",
        "OdometryDecomposer",
        "MapSqueeze",
        "AlphaCalibrator",
    ] {
        let js = JsObject::new(&format!("new motion.{property_name}()"));
        js.assert("Object.keys(it.read()).length > 3");
        let differing_keys: Vec<String> = js.get(
            "Object.entries(it.read())
                .filter(([key, value]) => typeof it[key] !== 'function' && key in it && JSON.stringify(value) !== JSON.stringify(it[key]))
                .map(([key]) => key)",
        );
        assert_eq!(differing_keys, Vec::<String>::new(), "{property_name}");
    }
}
