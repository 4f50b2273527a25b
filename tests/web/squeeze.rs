//! JavaScript interface of `MapSqueeze`: sampled motions, floor plans and maps.

use crate::support::{JsObject, assert_near};
use wasm_bindgen_test::wasm_bindgen_test;

/// Object with a simulation, the YAML fields and the PGM file of a map, and a function that makes images. The map has 4 × 3 cells of half a
/// metre, and its lower left cell is occupied.
const MAP_FILES_AND_SIMULATION: &str = "({ simulation: new motion.MapSqueeze({ samples: 50, clearance: 0.1 }),
    yaml: { image: 'map.pgm', resolution: 0.5, origin: [1, 2, 0], negate: 0, occupied_thresh: 0.65, free_thresh: 0.196 },
    pgm: new TextEncoder().encode('P2\\n# by hand\\n4 3\\n255\\n255 255 255 255\\n255 255 255 255\\n0 255 255 255\\n'),
    image: (greys, opacity = 255, width = 4, height = greys.length / width) =>
        new ImageData(new Uint8ClampedArray(greys.flatMap((grey) => [grey, grey, grey, opacity])), width, height),
})";
const SIMULATION_STATE: &str = "[it.simulation.config, it.simulation.stats, it.simulation.plan, it.simulation.grid, [...it.simulation.verdicts]]";

#[wasm_bindgen_test]
fn a_noise_level_sets_all_alphas() {
    let squeeze = JsObject::new("new motion.MapSqueeze({ samples: 100 })");
    assert_eq!(squeeze.get::<[i32; 2]>("[it.nearest(1000, 0, 1), it.path(100).length]"), [-1, 0]);
    squeeze.run("it.configure({ noise: 0.2 })");
    assert_eq!(
        squeeze.get::<(f64, [f64; 6])>("[it.noise, it.config.alphas]"),
        (0.2, [0.2, 0.2, 0.2, 0.2, 0.05, 0.05])
    );
}

#[wasm_bindgen_test]
fn a_floor_plan_replaces_the_apartment_and_can_be_removed() {
    let squeeze = JsObject::new("new motion.MapSqueeze({ samples: 100 })");
    let accepted_before: usize = squeeze.get("it.stats.accepted");
    squeeze.run(
        "it.setPlan({ bounds: new Float64Array([0, 0, 12, 9]), walls: [[10, 8, 11, 8],
        new Float64Array([0, 0, 12, 0])] })",
    );
    assert_eq!(squeeze.get::<[f64; 8]>("it.plan.walls"), [10.0, 8.0, 11.0, 8.0, 0.0, 0.0, 12.0, 0.0]);
    assert!(squeeze.get::<usize>("it.stats.accepted") > accepted_before);
    let plan_fields: String = squeeze.get("JSON.stringify(it.plan)");
    squeeze.run("it.setPlan(it.plan)");
    assert_eq!(squeeze.get::<String>("JSON.stringify(it.plan)"), plan_fields);
    squeeze.run("it.setPlan(undefined)");
    assert_eq!(squeeze.get::<[usize; 2]>("[it.plan.walls.length, it.stats.accepted]"), [72, accepted_before]);
}

#[wasm_bindgen_test]
fn a_map_is_read_from_a_file_or_from_pixels() {
    let squeeze = JsObject::new(MAP_FILES_AND_SIMULATION);
    squeeze.run("it.simulation.setGrid(it.yaml, it.pgm)");
    let plan_json: String = squeeze.get("JSON.stringify(it.simulation.plan)");
    assert_eq!(squeeze.get::<[f64; 4]>("it.simulation.plan.bounds"), [1.0, 2.0, 3.0, 3.5]);
    assert_eq!(squeeze.get::<Vec<f64>>("it.simulation.plan.walls.slice(0, 4)"), [1.0, 2.0, 1.5, 2.0]);
    let grid_fields: (usize, usize, f64, [f64; 3]) =
        squeeze.get("pick(it.simulation.grid, 'columns', 'rows', 'resolution', 'origin')");
    assert_eq!(grid_fields, (4, 3, 0.5, [1.0, 2.0, 0.0]));
    assert_eq!(squeeze.get::<Vec<u8>>("it.simulation.grid.occupied"), [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(squeeze.get::<[f64; 2]>("pick(it.simulation.openPlace, 'x', 'y')"), [2.25, 2.75]);
    for js_call in [
        "{ resolution: 0.5, origin: [1, 2, 0] }, it.pgm",
        "it.yaml, it.image([...Array(8).fill(255), 0, 255, 255, 255])",
        "{ ...it.yaml, negate: true, mode: 'scale' }, it.image([...Array(8).fill(0), 255, 0, 0, 0])",
        "{ ...it.yaml, mode: 'raw' }, { width: 4, height: 3, data: it.image([...Array(8).fill(0), 100, 99, \
         101, 255]).data }",
    ] {
        squeeze.run(&format!("[it.simulation.setPlan(undefined), it.simulation.setGrid({js_call})]"));
        assert_eq!(squeeze.get::<String>("JSON.stringify(it.simulation.plan)"), plan_json, "{js_call}");
    }
    squeeze.run("it.simulation.setGrid({ ...it.yaml, origin: [1, 2, Math.PI / 2] }, it.pgm)");
    assert_near([squeeze.get("it.simulation.plan.bounds[0]")], [-0.5], 1e-12);

    // The three cells of a row of the map are free, unknown and occupied.
    squeeze.run(
        "it.simulation.setGrid({ resolution: 1, origin: [0, 0, 0], free_thresh: 0.196 }, it.image([255,
        205, 0, 255, 205, 0], 255, 3))",
    );
    assert_eq!(
        squeeze.get::<(Vec<u8>, Vec<u8>)>("[it.simulation.grid.unknown, it.simulation.grid.occupied]"),
        (vec![0, 1, 0, 0, 1, 0], vec![0, 0, 1, 0, 0, 1])
    );
    squeeze.run("it.simulation.configure({ start: { x: 1.5, y: 1, theta: 0 } })");
    squeeze.assert("it.simulation.startFree");
    squeeze.run("it.simulation.configure({ unknown: 'blocked' })");
    assert!(!squeeze.get::<bool>("it.simulation.startFree"));
}

#[wasm_bindgen_test]
fn a_refused_call_changes_nothing() {
    let squeeze = JsObject::new(MAP_FILES_AND_SIMULATION);
    squeeze.assert_refused(
        SIMULATION_STATE,
        r#"
        it.simulation.configure({ seed: 9, clearance: -1 })
        RangeError: clearance is -1; allowed is a number from 0 to 10
        it.simulation.configure({ noise: 0.1, alphas: Array(6).fill(0.1) })
        TypeError: noise is given beside alphas; allowed is one of the two
        it.simulation.path(NaN)
        RangeError: index is NaN; allowed is a whole number from 0 to 1000000
        it.simulation.trial('endpoint', 1, 0)
        RangeError: count is 0; allowed is a whole number from 1 to 100000
        it.simulation.picture([0, 0, 1, 1], 1, 1, new Uint8Array(1024))
        RangeError: ramps has length 1024; allowed is a Uint8Array of 3072 bytes, 768 colours of four
        "#,
    );
}

#[wasm_bindgen_test]
fn a_malformed_plan_or_map_is_refused_with_a_reason_and_the_current_one_stays() {
    let squeeze = JsObject::new(MAP_FILES_AND_SIMULATION);
    squeeze.assert_refused(
        SIMULATION_STATE,
        r#"
        it.simulation.setPlan('apartment')
        TypeError: plan is "apartment"; allowed is an object with keys from bounds, walls
        it.simulation.setPlan({ bounds: [0, 0, 1], walls: [] })
        RangeError: bounds has length 3; allowed is an array of 4 numbers
        it.simulation.setPlan({ bounds: [1, 0, 0, 1], walls: [] })
        RangeError: bounds is [1, 0, 0, 1]; allowed is min x, min y, max x,
            max y: numbers from -1000000 to 1000000, the sides from 0.01 to 100000
        it.simulation.setPlan({ bounds: [0, 0, 1, 1] })
        TypeError: walls is undefined; allowed is an array of walls, each [x, y, x, y]
        it.simulation.setPlan({ bounds: [0, 0, 1, 1], walls: [[0, 0, 1]] })
        RangeError: walls[0] has length 3; allowed is an array of 4 numbers
        it.simulation.setPlan({ bounds: [0, 0, 1, 1], walls: [[0, 0, 2, 0]] })
        RangeError: walls[0] ends at [2, 0]; allowed is a point inside the bounds
        it.simulation.setPlan({ bounds: [0, 0, 1, 1], walls: new Float64Array(3) })
        TypeError: walls is an object; allowed is an array of walls, or a Float64Array of four numbers a wall
        it.simulation.setGrid(null, it.pgm)
        TypeError: description is null; allowed is an object
        it.simulation.setGrid({ ...it.yaml, free_thresh: 0.7 }, it.pgm)
        RangeError: free_thresh is 0.7; allowed is at most occupied_thresh, 0.65
        it.simulation.setGrid(it.yaml, undefined)
        TypeError: image is undefined; allowed is an object
        it.simulation.setGrid(it.yaml, { width: 4, height: 4, data: new Uint8ClampedArray(48) })
        RangeError: image.data has length 48; allowed is 64
        it.simulation.setGrid(it.yaml, new TextEncoder().encode('GIF89a'))
        RangeError: line 1: the magic number is "GIF89a"; allowed is P5 or P2
        "#,
    );
}
