//! Attempts of Map Squeeze, each from its own noise.

use super::settings::Settings;
use crate::geom::arc::Arc;
use crate::geom::lanes::LANE_COUNT;
use crate::geom::se2::SE2;
use crate::map::{AcceptedMotion, CollisionTester, Cost, MapConditioned, NoAcceptedSample, Sampler};
use crate::sim::cloud::draws::Draws;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::ops::Range;

/// Outcome of one attempt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attempt {
    /// Pose at the end of the motion.
    pub pose: SE2,
    /// True if the sampler accepts the motion.
    pub accepted: bool,
    /// True if the robot collides with nothing at its end pose.
    pub end_free: bool,
    /// True if the robot collides with nothing along the whole path.
    pub path_free: bool,
}

/// Bit of [`Attempt::verdict_bits`] for a free end pose.
pub const END_FREE_BIT: u8 = 1;
/// Bit of [`Attempt::verdict_bits`] for a free path.
pub const PATH_FREE_BIT: u8 = 2;
/// Bit of [`Attempt::verdict_bits`] for an accepted attempt.
pub const ACCEPTED_BIT: u8 = 4;

impl Attempt {
    /// Returns the outcome as the bits [`END_FREE_BIT`], [`PATH_FREE_BIT`] and [`ACCEPTED_BIT`].
    pub fn verdict_bits(&self) -> u8 {
        END_FREE_BIT * u8::from(self.end_free)
            + PATH_FREE_BIT * u8::from(self.path_free)
            + ACCEPTED_BIT * u8::from(self.accepted)
    }

    /// Returns true if the attempt is accepted although its path is not free.
    pub fn is_through_wall(&self) -> bool {
        self.accepted && !self.path_free
    }
}

/// Driver that makes attempts, each from its own noise.
pub struct Driver<'a> {
    model: &'a MapConditioned<'a>,
    collision_tester: CollisionTester<'a>,
    settings: &'a Settings,
    draws: &'a Draws,
}

impl<'a> Driver<'a> {
    pub fn new(model: &'a MapConditioned, settings: &'a Settings, draws: &'a Draws) -> Self {
        Self {
            model,
            collision_tester: model.collision_tester(&settings.command, &settings.start()),
            settings,
            draws,
        }
    }

    /// Makes attempts from the start of `indices`: up to four, in the lanes of a SIMD vector, or one with the sub-stepped sampler.
    #[inline(always)]
    pub fn make_next_attempts(&self, indices: Range<usize>, mut visit: impl FnMut(Attempt, Cost)) {
        if let Sampler::SubStepped(_) = self.settings.sampler {
            let (attempt, cost) = self.drive_parts(indices.start, &mut |_| ());
            return visit(attempt, cost);
        }
        let conditioned = self.settings.conditioned;
        let (group, first_lane) = (indices.start / LANE_COUNT, indices.start % LANE_COUNT);
        let lane_range = first_lane..LANE_COUNT.min(first_lane + indices.len());
        self.collision_tester.test_lanes(&self.draws.unit_noise[group], lane_range, |draw| {
            let deciding_verdict = self.model.deciding_verdict(&draw);
            let attempt = Attempt {
                pose: draw.pose,
                accepted: !conditioned || deciding_verdict.free,
                end_free: draw.end_verdict.free,
                path_free: draw.path_verdict.free,
            };
            let wall_tests = if conditioned { deciding_verdict.wall_tests } else { 0 };
            visit(attempt, Cost { draws: 1, wall_tests });
        });
    }

    /// Returns the arcs that are driven in an attempt.
    pub fn arcs(&self, index: usize) -> Vec<Arc> {
        let mut arcs = Vec::new();
        match self.settings.sampler {
            Sampler::SubStepped(_) => _ = self.drive_parts(index, &mut |arc| arcs.push(*arc)),
            _ => arcs.push(self.collision_tester.arc(self.draws.noise_of_sample(index))),
        }
        arcs
    }

    fn drive_parts(&self, index: usize, visit_arc: &mut dyn FnMut(&Arc)) -> (Attempt, Cost) {
        let Settings { command, conditioned, seed, .. } = *self.settings;
        let start = self.settings.start();
        // The walls determine how many random numbers an attempt uses. Each attempt has its own stream, so that the
        // others do not change.
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed ^ (index as u64).rotate_left(32));
        match self.model.sample_with_arcs(&command, &start, &mut rng, conditioned, visit_arc) {
            Ok(AcceptedMotion { pose, end_free, path_free, cost }) => {
                (Attempt { pose, accepted: true, end_free, path_free }, cost)
            }
            Err(NoAcceptedSample(cost)) => {
                (Attempt { pose: start, accepted: false, end_free: false, path_free: false }, cost)
            }
        }
    }
}
