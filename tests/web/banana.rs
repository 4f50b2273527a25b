use crate::support::JsObject;
use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn arrays_are_copies_of_the_samples() {
    let sim = JsObject::new(
        "new motion.BananaMachine({ model: 'odometry', noise: 'triangular', samples: 1000, seed: 3 })",
    );
    sim.assert(
        "[it.poses, it.twists, it.executed].every((array) => array instanceof Float64Array
        && array.length === 3000)",
    );
    sim.assert("Object.values(it.contours).every((outline) => outline instanceof Float64Array)");
    sim.assert("it.density(1, [-4, -4, 4, 4], 20, 10) instanceof Uint32Array");
    sim.assert("it.firstPoses(18).join() === it.poses.slice(0, 54).join()");
    sim.assert("it.firstTwists(18).join() === it.twists.slice(0, 54).join()");
    sim.run(
        "[it.poses.fill(NaN), it.config.command.v = 9, it.config.alphas[0] = 9,
        it.stats.cartesian.mean[0] = 9]",
    );
    sim.assert("it.poses.every(Number.isFinite) && it.config.command.v === 1 && it.config.alphas[0] !== 9");
}

#[wasm_bindgen_test]
fn each_model_keeps_its_alphas_and_a_seed_its_cloud() {
    let sim = JsObject::new("new motion.BananaMachine({ samples: 500, seed: 8 })");
    let cloud_coordinates: Vec<f64> = sim.get("it.poses");
    sim.run("it.configure({ model: 'odometry', samples: 700 })");
    sim.run("it.configure({ alphas: new Float64Array([4, 3, 2, 1]), isolate: 2 })");
    sim.run("it.configure({ model: 'velocity', isolate: null, samples: undefined })");
    assert_eq!(sim.get::<[f64; 4]>("it.alphasOfModels.odometry"), [4.0, 3.0, 2.0, 1.0]);
    assert_eq!(sim.get::<Vec<f64>>("it.alphasOfModels.velocity"), [0.002, 0.002, 0.1, 0.1, 0.002, 0.002]);
    assert_eq!(sim.get::<Vec<f64>>("it.poses.slice(0, 1500)"), cloud_coordinates);
    assert_eq!(sim.get::<[f64; 2]>("[it.poses.length, it.config.samples]"), [2100.0, 700.0]);
}

#[wasm_bindgen_test]
fn a_cloud_made_in_blocks_equals_one_made_at_once() {
    let sim = JsObject::new(
        "({ blocks: motion.BananaMachine.empty({ samples: 300 }), whole: new motion.BananaMachine({ samples: 300 }) })",
    );
    sim.assert(
        "it.blocks.shown === 0 && it.blocks.contours.ellipse.length === 0
        && Number.isNaN(it.blocks.stats.gaussianSkew)",
    );
    let are_equal = || {
        sim.get::<bool>(
            "JSON.stringify([it.blocks.config, it.blocks.stats, [...it.blocks.poses]]) ===
             JSON.stringify([it.whole.config, it.whole.stats, [...it.whole.poses]])",
        )
    };
    assert_eq!(
        sim.get::<[usize; 3]>("[1, 100, 1000].map((count) => it.blocks.addSamples(count))"),
        [1, 101, 300]
    );
    assert!(are_equal());
    let changed_settings = "{ command: { v: 1, omega: 1.2, dt: 1.4 }, samples: 120_000, seed: 5 }";
    sim.run(&format!("it.blocks.configureFirst({changed_settings}, Infinity)"));
    sim.assert("it.blocks.shown === 10_000 && it.blocks.stats.n === 10_000");
    sim.run("(() => { while (it.blocks.shown < 120_000) it.blocks.addSamples(it.blocks.block); })()");
    sim.run(&format!("it.whole.configure({changed_settings})"));
    assert!(are_equal());
}

#[wasm_bindgen_test]
fn every_kind_of_bad_value_is_refused_and_changes_nothing() {
    let sim = JsObject::new("new motion.BananaMachine({ samples: 30, seed: 11 })");
    sim.assert_refused(
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
        it.skewCurve(NaN, 1, 5)
        RangeError: omegaMin is NaN; allowed is a number from -1000000 to 1000000
        it.nearest('side', 0, 0, 1, 1)
        RangeError: morph is NaN; allowed is a number from 0 to 1
        it.density(0, [0, 0, -1, 1], 9, 9)
        RangeError: xMax is -1; allowed is a number from 0 to 1000000000000000000
        it.density(0, [0, 0, 1, 1], 2 ** 14, 2 ** 10 + 1)
        RangeError: rows is 1025; allowed is a whole number from 1 to 1024
        it.picture(0, [0, 0, 1, 1], 9, 9, new Uint8Array(1023))
        RangeError: ramp has length 1023; allowed is a Uint8Array of 1024 bytes, 256 colours of four
        "#,
    );
}
