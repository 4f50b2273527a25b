//! Motion conditioned on a map by rejection sampling (Table 5.7), with three acceptance tests.

use super::floor_plan::{CollisionVerdict, FloorPlan};
use crate::geom::arc::{Arc, DrivenArc, PreparedPose};
use crate::geom::lanes::Trigonometry;
use crate::geom::se2::SE2;
use crate::models::{VelocityCmd, VelocityModel};
use rand::Rng;
use std::ops::{Add, Mul, Range};
use thiserror::Error;
use wide::f64x4;

/// Condition under which a drawn motion is accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampler {
    /// A motion is accepted if its end pose is free, as in Table 5.7, even if its path leads through a wall.
    Endpoint,
    /// A motion is accepted if its whole arc is free.
    WholeArc,
    /// The command is split into this many parts (1 or more). Each part is drawn until its end pose is free. The noises of the parts are
    /// independent, so that the spread of the whole motion is smaller by the root of the number of parts.
    SubStepped(u32),
}

impl Sampler {
    /// Returns the number of parts into which the sampler splits a motion.
    pub fn part_count(self) -> u32 {
        if let Self::SubStepped(part_count) = self { part_count } else { 1 }
    }

    /// Returns the sampler with another number of parts. A sampler that does not split motions is returned unchanged.
    pub fn with_part_count(self, part_count: u32) -> Self {
        if let Self::SubStepped(_) = self { Self::SubStepped(part_count) } else { self }
    }
}

/// Velocity model, conditioned on a floor plan for a round robot of radius `clearance` (m).
///
/// ```
/// use motion::geom::se2::SE2;
/// use motion::map::{FloorPlan, MapConditioned, Sampler};
/// use motion::{NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};
/// use rand::{SeedableRng, rngs::SmallRng};
///
/// let plan = FloorPlan::new(Vec::new(), [-2.0, -2.0, 2.0, 2.0])?;
/// let model = VelocityModel { alphas: VelocityAlphas([0.02; 6]), noise: NoiseKind::Normal };
/// let conditioned = MapConditioned { model, plan: &plan, clearance: 0.2, sampler: Sampler::WholeArc };
/// let command = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
/// let accepted = conditioned.sample(&command, &SE2::identity(), &mut SmallRng::seed_from_u64(7));
/// assert!(accepted.is_ok_and(|accepted| accepted.path_free));
/// # Ok::<(), motion::map::FloorPlanError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct MapConditioned<'a> {
    /// Velocity model from which motions are drawn.
    pub model: VelocityModel,
    /// Floor plan with which motions may collide.
    pub plan: &'a FloorPlan,
    /// Radius of the robot, m. The centre of the robot stays further away from walls than this radius.
    pub clearance: f64,
    /// Condition under which a drawn motion is accepted.
    pub sampler: Sampler,
}

/// Motion drawn from the model without a map, and the verdicts of its collision tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestedDraw {
    /// End pose of the motion.
    pub pose: SE2,
    /// Arc driven with (v̂, ω̂); `pose` is the end of the arc, turned by γ̂Δt.
    pub arc: Arc,
    /// Result of the collision test of the end pose.
    pub end_verdict: CollisionVerdict,
    /// Result of the collision test of the whole arc.
    pub path_verdict: CollisionVerdict,
}

/// Accepted motion and its cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AcceptedMotion {
    /// End pose of the motion.
    pub pose: SE2,
    /// True if the end pose is free. A conditioned motion always ends at a free pose.
    pub end_free: bool,
    /// True if the whole path is free. A motion conditioned with [`Sampler::WholeArc`] always has a free path.
    pub path_free: bool,
    /// Number of draws, and of wall distances computed, until the motion was accepted.
    pub cost: Cost,
}

/// Cost of drawing motions until one is accepted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), serde(rename_all = "camelCase"))]
pub struct Cost {
    /// Number of draws of the model, accepted or rejected.
    pub draws: usize,
    /// Number of wall distances computed for the tests, see [`CollisionVerdict`].
    pub wall_tests: usize,
}

impl Cost {
    pub(crate) fn add(&mut self, added_cost: Self) {
        self.draws += added_cost.draws;
        self.wall_tests += added_cost.wall_tests;
    }
}

/// Error if no motion was accepted: [`MAX_DRAWS`] draws in a row were rejected, or too many in total.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the robot is wedged: {} draws were tried and too few accepted", .0.draws)]
pub struct NoAcceptedSample(pub Cost);

/// Number of rejected draws in a row after which sampling fails. So many draws take about a tenth of a second. A motion that is accepted
/// less than once in ten thousand draws is useless to a particle filter; more draws would block a page.
pub const MAX_DRAWS: usize = 10_000;

/// Collision tester for random motions that all start at one pose under one command.
#[derive(Clone, Copy, Debug)]
pub struct CollisionTester<'a> {
    conditioned_model: &'a MapConditioned<'a>,
    noisy_command: NoisyCommand,
    prepared_start: PreparedPose,
    trigonometry: Trigonometry,
}

impl CollisionTester<'_> {
    /// Returns the motion with the noise `unit_noise` (three random numbers of variance 1), and the results of its collision tests.
    pub fn test_draw(&self, unit_noise: [f64; 3]) -> TestedDraw {
        self.test_motion(self.noisy_command.drive_with_noise(&self.prepared_start, unit_noise))
    }

    /// Tests the motions in the range `lanes` of four SIMD lanes, and calls `visit` with each tested motion. The poses may differ by
    /// rounding from those of [`CollisionTester::test_draw`].
    pub fn test_lanes(&self, unit_noise: &[f64x4; 3], lanes: Range<usize>, visit: impl FnMut(TestedDraw)) {
        let motion_of_lane =
            self.noisy_command.drive_four_with_noise(&self.prepared_start, &self.trigonometry, unit_noise);
        lanes.map(|lane_index| self.test_motion(motion_of_lane(lane_index))).for_each(visit);
    }

    fn test_motion(&self, (pose, driven_arc): (SE2, DrivenArc)) -> TestedDraw {
        let MapConditioned { plan, clearance, .. } = *self.conditioned_model;
        let end_verdict = plan.test_point(driven_arc.end, clearance);
        let path_verdict = plan.test_arc_after_end(&driven_arc, end_verdict, clearance);
        TestedDraw { pose, arc: driven_arc.arc, end_verdict, path_verdict }
    }

    /// Returns the arc driven with the noise `unit_noise` (three random numbers of variance 1).
    pub fn arc(&self, unit_noise: [f64; 3]) -> Arc {
        let [arc_length, arc_turn, _] = self.noisy_command.executed_motion(unit_noise);
        Arc { start: self.prepared_start.pose, length: arc_length, turn: arc_turn }
    }
}

#[derive(Clone, Copy, Debug)]
struct NoisyCommand {
    u: VelocityCmd,
    noise_stds: [f64; 3],
}

impl NoisyCommand {
    fn drive_with_noise(&self, prepared_start: &PreparedPose, unit_noise: [f64; 3]) -> (SE2, DrivenArc) {
        let [arc_length, arc_turn, last_turn] = self.executed_motion(unit_noise);
        with_last_turn(prepared_start.drive(arc_length, arc_turn), last_turn)
    }

    /// Computes four motions in SIMD lanes. Returns a function from the lane index to the end pose and the driven arc.
    #[inline(always)]
    fn drive_four_with_noise(
        &self,
        prepared_start: &PreparedPose,
        trigonometry: &Trigonometry,
        unit_noise: &[f64x4; 3],
    ) -> impl Fn(usize) -> (SE2, DrivenArc) {
        let [arc_length, arc_turn, last_turn] = self.executed_motion(*unit_noise);
        let (driven_arc, last_turn) =
            (prepared_start.drive_four_arcs(trigonometry, arc_length, arc_turn), last_turn.to_array());
        move |lane_index| with_last_turn(driven_arc(lane_index), last_turn[lane_index])
    }

    /// Returns the length (m) and turn of the arc, and the turn after it (rad): see [`VelocityModel::executed_motion`].
    fn executed_motion<T>(&self, [v_noise, omega_noise, gamma_noise]: [T; 3]) -> [T; 3]
    where
        T: Mul<f64, Output = T> + Add<f64, Output = T>,
    {
        let (VelocityCmd { v, omega, dt }, [v_std, omega_std, gamma_std]) = (self.u, self.noise_stds);
        [(v_noise * v_std + v) * dt, (omega_noise * omega_std + omega) * dt, gamma_noise * gamma_std * dt]
    }
}

fn with_last_turn(driven_arc: DrivenArc, last_turn: f64) -> (SE2, DrivenArc) {
    let [x, y] = driven_arc.end;
    (SE2::new(x, y, driven_arc.heading + last_turn), driven_arc)
}

impl MapConditioned<'_> {
    /// Returns an accepted motion from `x`. Fails with [`NoAcceptedSample`] after [`MAX_DRAWS`] rejected draws.
    pub fn sample<R: Rng + ?Sized>(
        &self,
        u: &VelocityCmd,
        x: &SE2,
        rng: &mut R,
    ) -> Result<AcceptedMotion, NoAcceptedSample> {
        self.sample_with_arcs(u, x, rng, true, |_| ())
    }

    /// Returns an accepted motion as [`MapConditioned::sample`] does, and calls `visit_arc` with the arc of each of its parts. If
    /// `is_conditioned` is false, every draw is accepted. For equal random numbers, conditioned and unconditioned motions are equal up to
    /// the first rejected draw.
    pub fn sample_with_arcs<R: Rng + ?Sized>(
        &self,
        u: &VelocityCmd,
        x: &SE2,
        rng: &mut R,
        is_conditioned: bool,
        mut visit_arc: impl FnMut(&Arc),
    ) -> Result<AcceptedMotion, NoAcceptedSample> {
        let (mut is_end_free, mut is_path_free) = (true, true);
        let (pose, cost) = self.drive_parts(u, x, rng, is_conditioned, &mut |driven_arc, end_verdict| {
            visit_arc(&driven_arc.arc);
            is_end_free = end_verdict.is_free;
            is_path_free =
                is_path_free && self.plan.test_arc_after_end(driven_arc, end_verdict, self.clearance).is_free;
        })?;
        Ok(AcceptedMotion { pose, end_free: is_end_free, path_free: is_path_free, cost })
    }

    /// Returns the number of draws and of computed wall distances for one accepted motion in a particle filter. A filter makes only the
    /// collision test on which the acceptance depends. Fails with [`NoAcceptedSample`] after [`MAX_DRAWS`] rejected draws.
    pub fn sampling_cost<R: Rng + ?Sized>(
        &self,
        u: &VelocityCmd,
        x: &SE2,
        rng: &mut R,
    ) -> Result<Cost, NoAcceptedSample> {
        self.drive_parts(u, x, rng, true, &mut |_, _| ()).map(|(_, cost)| cost)
    }

    fn noisy_command(&self, u: &VelocityCmd) -> NoisyCommand {
        NoisyCommand { u: *u, noise_stds: self.model.noise_stds(u) }
    }

    /// Draws each part of a motion until it is accepted. Calls `visit_part` with the arc of each part and the collision test of its end.
    /// Returns the end pose of the last part, and the total cost.
    fn drive_parts<R: Rng + ?Sized>(
        &self,
        u: &VelocityCmd,
        x: &SE2,
        rng: &mut R,
        is_conditioned: bool,
        visit_part: &mut dyn FnMut(&DrivenArc, CollisionVerdict),
    ) -> Result<(SE2, Cost), NoAcceptedSample> {
        let part_count = self.sampler.part_count().max(1);
        let noisy_command = self.noisy_command(&VelocityCmd { dt: u.dt / f64::from(part_count), ..*u });
        let (mut pose, mut cost) = (*x, Cost::default());
        for _ in 0..part_count {
            let start = PreparedPose::new(pose);
            let (end_pose, arc, end_verdict) =
                self.draw_until_accepted(&noisy_command, &start, rng, is_conditioned, &mut cost)?;
            visit_part(&arc, end_verdict);
            pose = end_pose;
        }
        Ok((pose, cost))
    }

    fn draw_until_accepted<R: Rng + ?Sized>(
        &self,
        command: &NoisyCommand,
        start: &PreparedPose,
        rng: &mut R,
        is_conditioned: bool,
        cost: &mut Cost,
    ) -> Result<(SE2, DrivenArc, CollisionVerdict), NoAcceptedSample> {
        for _ in 0..MAX_DRAWS {
            let (end_pose, driven_arc) =
                command.drive_with_noise(start, self.model.noise.sample_unit_triple(rng));
            let end_verdict = self.plan.test_point(driven_arc.end, self.clearance);
            let deciding_verdict = match self.sampler {
                _ if !is_conditioned => CollisionVerdict::FREE,
                Sampler::WholeArc => self.plan.test_arc_after_end(&driven_arc, end_verdict, self.clearance),
                _ => end_verdict,
            };
            cost.add(Cost { draws: 1, wall_tests: deciding_verdict.wall_tests });
            if deciding_verdict.is_free {
                return Ok((end_pose, driven_arc, end_verdict));
            }
        }
        Err(NoAcceptedSample(*cost))
    }

    /// Returns a collision tester for many draws from one pose. It computes terms that all draws have in common only once.
    pub fn collision_tester(&self, u: &VelocityCmd, x: &SE2) -> CollisionTester<'_> {
        let (command, start) = (self.noisy_command(u), PreparedPose::new(*x));
        CollisionTester {
            conditioned_model: self,
            noisy_command: command,
            prepared_start: start,
            trigonometry: Trigonometry::default(),
        }
    }

    /// Returns the result of the collision test on which the acceptance of a draw depends: of the whole path for [`Sampler::WholeArc`], of
    /// the end pose for other samplers.
    pub fn deciding_verdict(&self, tested_draw: &TestedDraw) -> CollisionVerdict {
        if self.sampler == Sampler::WholeArc { tested_draw.path_verdict } else { tested_draw.end_verdict }
    }
}
