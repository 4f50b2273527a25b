//! Memory of the module: the largest clouds fit, and what is freed is used again.

use crate::support::Object;
use motion::geom::segment::Segment;
use motion::map::FloorPlan;
use motion::sim::squeeze::{self, MapSqueeze};
use wasm_bindgen_test::wasm_bindgen_test;

/// Bytes of the module's memory.
fn size() -> u32 {
    let memory: js_sys::WebAssembly::Memory = wasm_bindgen::JsCast::unchecked_into(wasm_bindgen::memory());
    js_sys::ArrayBuffer::byte_length(&wasm_bindgen::JsCast::unchecked_into(memory.buffer()))
}

#[wasm_bindgen_test]
fn a_freed_machine_is_gone_with_its_memory() {
    let it = Object::new(
        "({ make: {
            BananaMachine: () => new motion.BananaMachine({ samples: 20_000 }),
            MapSqueeze: () => new motion.MapSqueeze({ samples: 20_000 }),
            ArcAnatomy: () => new motion.ArcAnatomy(),
            OdometryDecomposer: () => new motion.OdometryDecomposer({ samples: 5_000 }),
            DeadReckoning: () => new motion.DeadReckoning({ samples: 2_000 }),
            AlphaCalibrator: () => new motion.AlphaCalibrator(),
            VelocityModel: () => new motion.VelocityModel({ alphas: Array(6).fill(0.1) }),
            OdometryModel: () => new motion.OdometryModel({ alphas: Array(4).fill(0.1) }),
        } })",
    );
    for name in it.get::<Vec<String>>("Object.keys(it.make)") {
        let used = format!(
            "(() => {{ for (const each of [it.make.{name}(), it.make.{name}()]) [each.stats, each.poses,
                each.free()]; }})()"
        );
        it.run(&used);
        let before = size();
        for _ in 0..10 {
            it.run(&used);
        }
        // Each cloud is larger than a page, and ten would be seen.
        assert!(size() <= before + 65_536, "{name} left {} bytes", size() - before);
        it.run(&format!(
            "[it.freed = it.make.{name}(), it.freed.free(), it.disposed = it.make.{name}(),
            it.disposed[Symbol.dispose]()]"
        ));
        for handle in ["freed", "disposed"] {
            for work in ["stats", "config", "prob({}, {}, {})"] {
                let expression = format!("it.{handle}.{work}");
                let known =
                    it.get::<bool>(&format!("'{}' in it.{handle}", work.split('(').next().unwrap_or(work)));
                assert!(!known || it.error(&expression).starts_with("Error: "), "{name}: {expression}");
            }
        }
    }
}

#[wasm_bindgen_test]
fn the_largest_cloud_fits_and_outlives_refused_settings() {
    let it = Object::new("new motion.BananaMachine({ samples: motion.BananaMachine.maxSamples, seed: 1 })");
    let skew: f64 = it.get("it.stats.crossTrackSkew");
    assert!(
        it.error("it.configure({ samples: motion.BananaMachine.maxSamples + 1 })")
            .starts_with("RangeError: samples ")
    );
    assert!(it.error("it.configure({ alphas: Array(6).fill(NaN) })").starts_with("RangeError: alphas[0] "));
    assert_eq!(it.get::<(usize, f64)>("[it.shown, it.stats.crossTrackSkew]"), (10_000_000, skew));
    it.run("it.configure({ samples: 10 })");
    assert_eq!(it.get::<usize>("it.poses.length"), 30);
    it.run("it.free()");
}

#[wasm_bindgen_test]
fn the_largest_cloud_fits_in_the_largest_plan() {
    let settings = squeeze::Settings { samples: squeeze::MAX_SAMPLES, ..Default::default() };
    let mut machine = MapSqueeze::new(settings).expect("memory for the largest cloud");
    let tally = *machine.tally();
    assert_eq!(tally.draws, settings.samples);
    let blocked = Segment { from: [0.0, 0.0], to: [12.0, 0.0] };
    let plan =
        FloorPlan::new(vec![blocked; FloorPlan::MAX_WALLS], [0.0, 0.0, 12.0, 9.0]).expect("a valid plan");
    machine.set_plan(plan);
    assert!(machine.tally().accepted > tally.accepted, "the other walls are gone");
}
