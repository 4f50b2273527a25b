//! `BananaMachine`.

use crate::support::{Object, assert_near};
use motion::geom::se2::SE2;
use motion::stats::cross_track_skew;
use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn arrays_are_copies_of_the_samples() {
    let it = Object::new(
        "new motion.BananaMachine({ model: 'odometry', noise: 'triangular', samples: 1000, seed: 3 })",
    );
    it.assert(
        "[it.poses, it.twists, it.executed].every((each) => each instanceof Float64Array
        && each.length === 3000)",
    );
    let poses: Vec<f64> = it.get("it.poses");
    let poses: Vec<_> = poses.chunks_exact(3).map(|pose| SE2::new(pose[0], pose[1], pose[2])).collect();
    assert_near([it.get("it.stats.crossTrackSkew")], [cross_track_skew(&poses)], 1e-12);
    it.run(
        "[it.poses.fill(NaN), it.config.command.v = 9, it.config.alphas[0] = 9,
        it.stats.cartesian.mean[0] = 9]",
    );
    it.assert("it.poses.every(Number.isFinite) && it.config.command.v === 1 && it.config.alphas[0] !== 9");
}

#[wasm_bindgen_test]
fn each_model_keeps_its_alphas_and_a_seed_its_cloud() {
    let it = Object::new("new motion.BananaMachine({ samples: 500, seed: 8 })");
    let cloud: Vec<f64> = it.get("it.poses");
    it.run("it.configure({ model: 'odometry', samples: 700 })");
    it.run("it.configure({ alphas: new Float64Array([4, 3, 2, 1]), isolate: 2 })");
    it.run("it.configure({ model: 'velocity', isolate: null, samples: undefined })");
    assert_eq!(it.get::<[f64; 4]>("it.alphasOfModels.odometry"), [4.0, 3.0, 2.0, 1.0]);
    assert_eq!(it.get::<Vec<f64>>("it.alphasOfModels.velocity"), [0.002, 0.002, 0.1, 0.1, 0.002, 0.002]);
    assert_eq!(it.get::<Vec<f64>>("it.poses.slice(0, 1500)"), cloud);
    assert_eq!(it.get::<[f64; 2]>("[it.poses.length, it.config.samples]"), [2100.0, 700.0]);
}

#[wasm_bindgen_test]
fn samples_can_be_inspected_found_and_counted() {
    let it = Object::new("new motion.BananaMachine({ samples: 4000 })");
    let (pose, twist): ([f64; 3], [f64; 3]) = it.get("pick(it.inspect(17), 'pose', 'twist')");
    assert_eq!((pose, twist), it.get("[it.poses.slice(51, 54), it.twists.slice(51, 54)]"));
    it.assert("it.firstPoses(18).join() === it.poses.slice(0, 54).join()");
    let arc: [f64; 3] = it.get("pick(it.inspect(17), 'vHat', 'omegaHat', 'gammaHat')");
    assert_eq!(arc, it.get::<[f64; 3]>("it.executed.slice(51, 54)"));
    assert_near([2.0 * (arc[1] + arc[2]), it.get("it.heading(17)")], [pose[2], pose[2]], 1e-12);
    assert_eq!(it.get::<Option<()>>("it.inspect(17).legs"), None);
    assert_near(it.get("it.inspect(17).path.slice(-2)"), [pose[0], pose[1]], 1e-12);
    assert_eq!(
        it.get::<[i32; 3]>(&format!(
            "[it.nearest('plane', {}, {}, 1e-6, 1e-6), it.nearest('twist', {}, {}, 1e-6, 1e-6), \
             it.nearest('plane', 100, 100, 1, 1)]",
            pose[0], pose[1], twist[0], twist[2]
        )),
        [17, 17, -1]
    );
    let counts: Vec<u32> = it.get("it.density('plane', -4, -4, 4, 4, 20, 10)");
    let upper_count = it.get::<u32>("it.poses.filter((y, i) => i % 3 === 1 && y > 0).length");
    assert_eq!(
        (counts.iter().sum::<u32>(), counts[..100].iter().sum::<u32>()),
        (4000, upper_count),
        "row 0 is at the top"
    );
    it.assert("it.density('twist', -4, -4, 4, 4, 20, 10) instanceof Uint32Array");
    it.assert("it.picture('plane', -4, -4, 4, 4, 20, 10, new Uint8Array(1024)).length === 800");
}

#[wasm_bindgen_test]
fn outlines_and_curves_are_arrays_of_points() {
    let it = Object::new(
        "new motion.BananaMachine({
            command: { v: 1, omega: 0.5, dt: 1 }, alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01], samples: 4000,
        })",
    );
    let closed_outlines = "(({ command, ...outlines }) => Object.entries(outlines)
        .filter(([, at]) => at instanceof Float64Array && at.length > 60 && at[0] === at.at(-2) && at[1] === at.at(-1))
        .map(([name]) => name))(it.contours)";
    assert_eq!(
        it.get::<Vec<String>>(closed_outlines),
        ["ellipse", "linearized", "exponential", "twistEllipse", "additive"]
    );
    assert_near(it.get("it.contours.command.slice(-2)"), [0.958_851_077_208, 0.244_834_876_219], 1e-12);
    let reading = it.get("Object.values(it.reading)");
    assert_near(reading, [0.25, 0.989_615_837_018, 0.25], 1e-9);
    it.assert("it.chartHolds");
}

#[wasm_bindgen_test]
fn a_cloud_made_in_blocks_equals_one_made_at_once() {
    let it = Object::new(
        "({ blocks: motion.BananaMachine.empty({ samples: 300 }), whole: new motion.BananaMachine({ samples: 300 }) })",
    );
    it.assert(
        "it.blocks.shown === 0 && it.blocks.contours.ellipse.length === 0
        && Number.isNaN(it.blocks.stats.gaussianSkew)",
    );
    let are_equal = || {
        it.get::<bool>(
            "JSON.stringify([it.blocks.config, it.blocks.stats, [...it.blocks.poses]]) ===
             JSON.stringify([it.whole.config, it.whole.stats, [...it.whole.poses]])",
        )
    };
    assert_eq!(
        it.get::<[usize; 3]>("[1, 100, 1000].map((count) => it.blocks.addSamples(count))"),
        [1, 101, 300]
    );
    assert!(are_equal());
    let change = "{ command: { v: 1, omega: 1.2, dt: 1.4 }, samples: 120_000, seed: 5 }";
    it.run(&format!("it.blocks.configureFirst({change}, Infinity)"));
    it.assert("it.blocks.shown === 25_000 && it.blocks.stats.n === 25_000");
    it.run("(() => { while (it.blocks.shown < 120_000) it.blocks.addSamples(it.blocks.block); })()");
    it.run(&format!("it.whole.configure({change})"));
    assert!(are_equal());
}

#[wasm_bindgen_test]
fn every_kind_of_bad_value_is_refused_and_changes_nothing() {
    let it = Object::new("new motion.BananaMachine({ samples: 30, seed: 11 })");
    it.assert_refused(
        "[it.config, it.stats, [...it.poses]]",
        r#"
        it.configure({ seed: 1, alphas: [1, 2, 3, NaN, 5, 6], model: 'velocity' })
        RangeError: alphas[3] is NaN; allowed is a number from 0 to 1000000
        it.configure({ alphas: [1, 2, 3, 4] })
        RangeError: alphas has length 4; allowed is an array of 6 numbers
        it.configure({ alphas: [1, 2, 3, 4, 5, '6'] })
        TypeError: alphas[5] is "6"; allowed is a number
        it.configure({ command: { v: Infinity, omega: 0, dt: 1 } })
        RangeError: command.v is Infinity; allowed is a number from -1000000 to 1000000
        it.configure({ command: { v: 1, omega: 0 } })
        TypeError: command.dt is undefined; allowed is a number
        it.configure({ command: { v: 1, omega: 0, dt: 1, w: 1 } })
        TypeError: command.w is an unknown key; allowed are v, omega, dt
        it.configure({ samples: 0 })
        RangeError: samples is 0; allowed is a whole number from 1 to 10000000
        it.configure({ samples: 7n })
        TypeError: samples is a bigint; allowed is a number
        it.configure({ isolate: 7 })
        RangeError: isolate is 7; allowed is a whole number from 1 to 6
        it.configure({ model: 'Velocity' })
        RangeError: model is "Velocity"; allowed is "velocity" or "odometry"
        it.configure({ noise: 1 })
        TypeError: noise is 1; allowed is "normal" or "triangular"
        it.configure({ reverseAware: 'yes' })
        TypeError: reverseAware is "yes"; allowed is true or false
        it.configure({ Seed: 1 })
        TypeError: Seed is an unknown key; allowed are model, noise, command, alphas, reverseAware, isolate, samples, seed
        it.configure()
        TypeError: options is undefined; allowed is an object with keys from model, noise, command, alphas, reverseAware,
            isolate, samples, seed
        new motion.BananaMachine({ model: 'x'.repeat(50) })
        RangeError: model is "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx…"; allowed is "velocity" or "odometry"
        it.configureFirst({ samples: 0 }, 1)
        RangeError: samples is 0; allowed is a whole number from 1 to 10000000
        it.addSamples(-1)
        RangeError: count is -1; allowed is a whole number from 0 to 10000000
        it.inspect(30)
        RangeError: index is 30; allowed is one of the 30 samples shown, counted from 0
        it.heading()
        RangeError: index is NaN; allowed is a whole number from 0 to 10000000
        it.skewCurve(NaN, 1, 5)
        RangeError: omegaMin is NaN; allowed is a number from -1000000 to 1000000
        it.nearest('side', 0, 0, 1, 1)
        RangeError: view is "side"; allowed is "plane" or "twist"
        it.density('plane', 0, 0, -1, 1, 9, 9)
        RangeError: xMax is -1; allowed is a number from 0 to 1000000000000000000
        it.density('plane', 0, 0, 1, 1, 2 ** 14, 2 ** 10 + 1)
        RangeError: rows is 1025; allowed is a whole number from 1 to 1024
        it.picture('plane', 0, 0, 1, 1, 9, 9, new Uint8Array(1023))
        RangeError: ramp has length 1023; allowed is a Uint8Array of 1024 bytes, 256 colours of four
        "#,
    );
}
