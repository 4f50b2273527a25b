//! `cargo bench`: time of fitting α's with intervals to 100,000 legs, and the number of passes over them.

#[path = "../tests/native/calibrate/simulated.rs"]
#[allow(dead_code, reason = "the tests need more of it")]
mod simulated;

use motion::NoiseKind;
use motion::calibrate::{Evidence, Observation, Robust, Systematic, Uncertainty, cut, fit};
use simulated::{MODELS, Simulation};
use std::time::Instant;

const LEGS: usize = 100_000;
/// Repetitions, whose median is printed.
const TIMES: usize = 5;

fn main() {
    for model in MODELS {
        for noise in [NoiseKind::Normal, NoiseKind::Triangular] {
            for (robust, jumps) in [(Robust::No, 0.0), (Robust::Estimated, 0.0), (Robust::Estimated, 0.01)] {
                let simulation = Simulation { jumps, ..Simulation::of(model, noise, LEGS, 7) };
                let [odometry, reference] = simulation.log();
                let observations: Vec<Observation> = cut(&odometry, &reference, simulation.legs, 0.0)
                    .iter()
                    .map(|leg| model.observe(leg, &Systematic::NONE, &Uncertainty::default()))
                    .collect();
                let evidence = Evidence::new(model, noise, &observations);
                let mut times = [0; TIMES].map(|_| {
                    let start = Instant::now();
                    fit(&evidence, model.alphas(), robust);
                    start.elapsed().as_secs_f64() * 1e3
                });
                times.sort_by(f64::total_cmp);
                let passes = evidence.passes() / TIMES as f64;
                println!(
                    "{model:?} {noise:?} {robust:?}, jumps in {jumps} of the legs: {:.0} ms, {passes:.0} passes",
                    times[TIMES / 2]
                );
            }
        }
    }
}
