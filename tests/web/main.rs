//! The core as WebAssembly, in a real browser: what the memory there holds, and where randomness comes from. That the bits
//! are those of this machine is for tests/e2e/digest.spec.js, with the module that ships.
#![cfg(target_arch = "wasm32")]

use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::FloorPlan;
use motion::sim::banana::{BananaMachine, MAX_SAMPLES, Settings};
use motion::sim::squeeze::{self, MapSqueeze};
use motion::stats::{CrossTrack, ExactMoments};
use motion::{MotionModel, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

wasm_bindgen_test_configure!(run_in_browser);

#[wasm_bindgen_test]
fn the_canonical_example_has_its_figures() {
    let alphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]);
    let model = VelocityModel { alphas, noise: NoiseKind::Normal };
    let u = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
    let end = SE2::exp(&TangentNoiseModel::twist(&u));
    assert!((end.x() - 0.958_851_077_208).abs() < 1e-12 && (end.y() - 0.244_834_876_219).abs() < 1e-12);
    let exact = ExactMoments::of_velocity(&model, &u);
    assert!((exact.cross_track_skew - -0.30056).abs() < 5e-6);
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(7);
    let cloud: Vec<SE2> = (0..50_000).map(|_| model.sample(&u, &SE2::identity(), &mut rng)).collect();
    let figures = CrossTrack::from_poses(&cloud);
    assert!((figures.skew - exact.cross_track_skew).abs() < 4.5 * figures.skew_error, "{figures:?}");
}

/// A cloud of the largest size fits into the module's memory, and a refused setting leaves the machine as it was.
#[wasm_bindgen_test]
fn the_machine_holds_its_largest_cloud_and_survives_bad_settings() {
    let largest = Settings { samples: MAX_SAMPLES, ..Settings::default() };
    let mut machine = BananaMachine::new(largest).expect("memory for the largest cloud");
    assert_eq!(machine.poses().len(), largest.samples);
    let figures = *machine.figures();
    assert!(machine.configure(Settings { samples: largest.samples + 1, ..largest }).is_err());
    assert!(machine.configure(Settings { velocity_alphas: [f64::NAN; 6], ..largest }).is_err());
    assert_eq!(*machine.settings(), largest);
    assert_eq!(*machine.figures(), figures);
    machine.configure(Settings { samples: 10, ..largest }).expect("a valid setting");
    assert_eq!(machine.poses().len(), 10);
}

/// The largest cloud and the largest plan fit into the module's memory, and a refused setting leaves the machine as it
/// was.
#[wasm_bindgen_test]
fn map_squeeze_holds_its_largest_cloud_in_its_largest_plan() {
    let settings = squeeze::Settings { samples: squeeze::MAX_SAMPLES, ..Default::default() };
    let mut machine = MapSqueeze::new(settings).expect("memory for the largest cloud");
    let tally = *machine.tally();
    assert_eq!(tally.draws, settings.samples);
    assert!(machine.configure(squeeze::Settings { clearance: -1.0, ..settings }).is_err());
    assert_eq!((*machine.settings(), *machine.tally()), (settings, tally));
    let blocked = Segment { from: [0.0, 0.0], to: [12.0, 0.0] };
    let plan =
        FloorPlan::new(vec![blocked; FloorPlan::MAX_WALLS], [0.0, 0.0, 12.0, 9.0]).expect("a valid plan");
    machine.set_plan(plan);
    assert!(machine.tally().accepted > tally.accepted, "the other walls are gone");
}

#[wasm_bindgen_test]
fn entropy_is_there() {
    assert_ne!(getrandom::u64().unwrap(), getrandom::u64().unwrap());
}
