//! What a fit costs: passes over the legs, for that is the same on every machine.

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
fn a_hundred_thousand_legs_are_fitted_with_intervals_in_few_passes() {
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

#[test]
fn a_perfect_log_is_fitted_in_not_many_more() {
    // Ever smaller α's are ever likelier: two passes halve them down to rounding. Where rounding alone keeps one up, intervals are halved.
    for model in COSTS {
        for noise in [NoiseKind::Normal, NoiseKind::Triangular] {
            for robust in [Robust::No, Robust::Estimated] {
                for count in [500, 10_000] {
                    let simulation = Simulation::of(model, noise, count, 7);
                    let [odometry, _] = simulation.log();
                    let observe = |leg| model.observe(leg, &Systematic::NONE, &Uncertainty::default());
                    let legs = cut(&odometry, &odometry, simulation.legs, 0.0);
                    let evidence = Evidence::new(model, noise, &legs.iter().map(observe).collect::<Vec<_>>());
                    let told = fit(&evidence, model.alphas(), robust);
                    assert!(told.log_likelihood.is_finite());
                    let passes = evidence.passes();
                    assert!(passes <= 600.0, "{model:?} {noise:?} {robust:?} {count}: {passes}");
                }
            }
        }
    }
}

#[test]
fn where_a_residual_is_bad_or_not_the_likelier_is_taken() {
    // Without bad legs the robust likelihood is that of all legs as good ones at least: that is one of its points.
    for model in [Model::Odometry(OdometryRule::Nav2), Model::Odometry(OdometryRule::Omni), Model::Velocity] {
        for seed in 0..10 {
            let simulation = Simulation::of(model, NoiseKind::Triangular, 3000, 70 + seed);
            let [odometry, reference] = simulation.log();
            let observe = |leg| model.observe(leg, &Systematic::NONE, &Uncertainty::default());
            let legs = cut(&odometry, &reference, simulation.legs, 0.0);
            let observations: Vec<_> = legs.iter().map(observe).collect();
            let evidence = Evidence::new(model, NoiseKind::Triangular, &observations);
            let [all, robust] = [Robust::No, Robust::Estimated]
                .map(|robust| fit(&evidence, model.alphas(), robust).log_likelihood);
            assert!(robust > all - 0.01, "{model:?} {seed}: {robust} of {all}");
        }
    }
}
