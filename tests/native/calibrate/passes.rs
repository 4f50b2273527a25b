//! Cost of a fit, as passes over the legs: the same on every machine.

use super::simulated::Simulation;
use motion::NoiseKind;
use motion::calibrate::{Evidence, Model, Robust, Systematic, Uncertainty, cut, fit};
use motion::models::OdometryRule;

/// Beluga's costs what Nav2's does.
const COSTS: [Model; 4] = [
    Model::Odometry(OdometryRule::Table),
    Model::Odometry(OdometryRule::Nav2),
    Model::Odometry(OdometryRule::Omni),
    Model::Velocity,
];

#[test]
#[ignore = "nightly: 24 fits of 100,000 legs"]
fn a_fit_with_intervals_takes_few_passes() {
    // The maximum in five or ten and each end of an interval in one or two, of twelve at most; triangular noise is first fitted as a
    // normal one, and for it the legs at the edge are looked for.
    for model in COSTS {
        for (noise, most) in [(NoiseKind::Normal, 30.0), (NoiseKind::Triangular, 60.0)] {
            for (robust, jumps) in [(Robust::No, 0.0), (Robust::Estimated, 0.0), (Robust::Estimated, 0.01)] {
                let simulation = Simulation { jumps, ..Simulation::of(model, noise, 100_000, 7) };
                let [odometry, reference] = simulation.log();
                let observe = |leg| model.observe(leg, &Systematic::NONE, &Uncertainty::default());
                let legs = cut(&odometry, &reference, simulation.legs, 0.0);
                let evidence = Evidence::new(model, noise, &legs.iter().map(observe).collect::<Vec<_>>());
                let told = fit(&evidence, model.alphas(), robust);
                assert!(told.intervals.iter().all(Option::is_some));
                let passes = evidence.passes();
                assert!(passes <= most, "{model:?} {noise:?} {robust:?} jumps {jumps}: {passes}");
            }
        }
    }
}
