//! Map Squeeze: motion conditioned on a floor plan, and accepted motions whose paths lead through walls.

mod settings;

pub use super::noise_level::alphas_of_noise_level;
pub use settings::*;

use super::cloud::draws::Draws;
use super::cloud::picture::{self, Ramp};
use super::cloud::views::{ViewGrid, nearest_index};
use super::cloud_simulation::cloud_simulation;
use super::settings::{AllowedValues, SettingRules, SettingsError};
use crate::geom::arc::Arc;
use crate::geom::lanes::LANE_COUNT;
use crate::geom::se2::SE2;
use crate::geom::segment::Segment;
use crate::js::js_structs;
use crate::map::{
    AcceptedMotion, CollisionTester, Cost, FloorPlan, FloorPlanError, MAX_DRAWS, MapConditioned,
    NoAcceptedSample, OccupancyGrid, Sampler,
};
use crate::models::{VelocityAlphas, VelocityCmd, VelocityModel};
use crate::noise::NoiseKind;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::ops::Range;

/// Maximum size of a timing trial: the number of samples times the number of parts into which the sampler splits each motion. A longer
/// trial would block the page.
pub const MAX_TRIAL_PARTS: u64 = 100_000;

/// Simulation of the Map Squeeze widget: a map, settings, random numbers, and the attempts shown (see [`Attempt`]).
#[derive(Clone, Debug)]
pub struct MapSqueeze {
    floor_plan: FloorPlan,
    settings: Settings,
    noise_draws: Draws,
    tested_attempts: Vec<Attempt>,
    outcome_tally: OutcomeTally,
    picture_pixels: Vec<[u8; 4]>,
}

/// Counts of the attempts shown that are accepted, or accepted through a wall, and the cost of all attempts shown.
#[derive(Clone, Copy, Debug, Default)]
struct OutcomeTally {
    total_cost: Cost,
    accepted_count: usize,
    through_wall: usize,
    /// True if the simulation stopped before it had all samples.
    gave_up: bool,
}

/// Average number of draws for a part of a motion above which the simulation gives up. Only the sub-stepped sampler has several parts in a
/// motion. A smaller limit would stop the simulation where a filter still works. A larger limit (acceptance below 5 %) would let a page
/// wait for seconds.
const MAX_MEAN_DRAWS_PER_PART: usize = 20;

/// Number of parts of motions in one block of attempts. A block takes some milliseconds.
const PARTS_PER_BLOCK: usize = 4096;

cloud_simulation!(MapSqueeze);

impl MapSqueeze {
    fn new_empty(settings: Settings) -> Result<Self, SettingsError> {
        let mut simulation = Self {
            floor_plan: FloorPlan::apartment(),
            settings,
            noise_draws: Draws::new(settings.seed, NoiseKind::Normal),
            tested_attempts: Vec::new(),
            outcome_tally: OutcomeTally::default(),
            picture_pixels: Vec::new(),
        };
        simulation.reserve_memory(&settings)?;
        Ok(simulation)
    }

    fn reserve_memory(&mut self, settings: &Settings) -> Result<(), SettingsError> {
        let to_memory_error = |_| SettingsError::out_of_memory(settings.samples);
        let missing_attempt_count = settings.samples.saturating_sub(self.tested_attempts.len());
        self.tested_attempts.try_reserve_exact(missing_attempt_count).map_err(to_memory_error)?;
        self.noise_draws.reserve(settings.samples).map_err(to_memory_error)
    }

    /// Returns the floor plan.
    pub fn plan(&self) -> &FloorPlan {
        &self.floor_plan
    }

    /// Replaces the map, and keeps the start pose and the random numbers. Makes as many attempts as before, or all if the simulation had
    /// given up.
    pub fn set_plan(&mut self, plan: FloorPlan) {
        self.floor_plan = plan;
        let attempt_count =
            if self.outcome_tally.gave_up { self.settings.samples } else { self.shown_count() };
        self.clear_attempts();
        self.add_samples(attempt_count);
    }

    /// Replaces the map by a grid, as [`MapSqueeze::set_plan`] replaces it by a floor plan. The setting `unknown` defines whether unknown
    /// cells are obstacles. Errors are those of [`FloorPlan::from_grid`], and change nothing.
    pub fn set_grid(&mut self, map_grid: OccupancyGrid) -> Result<(), FloorPlanError> {
        self.set_plan(FloorPlan::from_grid(map_grid.with_unknown(self.settings.unknown))?);
        Ok(())
    }

    /// Changes the settings and makes the first block of attempts. [`MapSqueeze::add_samples`] makes the remaining attempts up to
    /// `target_count`. Fails with [`SettingsError`] as in [`MapSqueeze::new`], or if the map has too many walls under the new setting
    /// `unknown`. After an error nothing has changed.
    pub fn configure_first(&mut self, settings: Settings, target_count: usize) -> Result<(), SettingsError> {
        settings.check()?;
        let outdated_grid = self.floor_plan.grid().filter(|_| settings.unknown != self.settings.unknown);
        let plan = outdated_grid
            .map(|map_grid| FloorPlan::from_grid(map_grid.clone().with_unknown(settings.unknown)));
        // A grid that was accepted before is refused only if its unknown cells, which are now obstacles, have too many outlines.
        let plan = plan.transpose().map_err(|_| SettingsError {
            key: "unknown".to_owned(),
            value: f64::NAN,
            allowed: AllowedValues::Keyword {
                given_keyword: "blocked",
                allowed: "free, as the cells of this map would have more than 20000 sides",
            },
        })?;
        self.reserve_memory(&settings)?;
        if let Some(plan) = plan {
            self.floor_plan = plan;
        }
        self.settings = settings;
        self.clear_attempts();
        self.add_samples(target_count.min(self.block_size()));
        Ok(())
    }

    fn clear_attempts(&mut self) {
        self.tested_attempts.clear();
        self.outcome_tally = OutcomeTally::default();
    }

    /// Makes attempts until `target_count` are shown, or gives up if nearly every draw collides. Later calls then make no attempts.
    fn show_samples(&mut self, target_count: usize) {
        self.noise_draws.reset_if_changed(self.settings.seed, NoiseKind::Normal);
        self.noise_draws.extend_to(target_count);
        let part_count = self.settings.part_count() as usize;
        let Self { floor_plan: plan, settings, noise_draws, tested_attempts, outcome_tally, .. } = self;
        let map_model = conditioned_model(settings, plan, settings.sampler);
        let attempt_driver = AttemptDriver::new(&map_model, settings, noise_draws);
        while tested_attempts.len() < target_count && !outcome_tally.gave_up {
            attempt_driver.make_next_attempts(tested_attempts.len()..target_count, |next_attempt, cost| {
                outcome_tally.total_cost.add(cost);
                outcome_tally.accepted_count += usize::from(next_attempt.accepted);
                outcome_tally.through_wall += usize::from(next_attempt.is_through_wall());
                tested_attempts.push(next_attempt);
            });
            outcome_tally.gave_up =
                outcome_tally.total_cost.draws > max_draws(part_count * tested_attempts.len());
        }
    }

    /// Returns the number of attempts (motions, accepted or rejected) that are made within a few milliseconds.
    pub fn block_size(&self) -> usize {
        (PARTS_PER_BLOCK / self.settings.part_count() as usize).max(1)
    }

    /// Returns the attempts shown (motions, accepted or rejected), in sample order.
    pub fn attempts(&self) -> &[Attempt] {
        &self.tested_attempts
    }

    /// Returns the number of attempts shown (motions, accepted or rejected).
    pub fn shown_count(&self) -> usize {
        self.tested_attempts.len()
    }

    /// Returns the statistics of the attempts shown (motions, accepted or rejected).
    pub fn stats(&self) -> Stats {
        let OutcomeTally { total_cost: cost, accepted_count, through_wall, gave_up } = self.outcome_tally;
        // The ratio is NaN for 0/0, and infinite for another number over 0.
        let ratio_of = |event_count: usize, total_count: usize| event_count as f64 / total_count as f64;
        Stats {
            attempts: self.tested_attempts.len(),
            drawn: cost.draws,
            accepted: accepted_count,
            // An accepted attempt of k parts has k accepted draws.
            acceptance_rate: ratio_of(accepted_count * self.settings.part_count() as usize, cost.draws),
            through_wall,
            through_wall_rate: ratio_of(through_wall, accepted_count),
            through_wall_interval: wilson_interval(through_wall, accepted_count),
            draws_per_accepted: ratio_of(cost.draws, accepted_count),
            wall_tests_per_accepted: ratio_of(cost.wall_tests, accepted_count),
            gave_up,
        }
    }

    /// Paints the density of the ends of the attempts shown, by [`Attempt::outcome_kind`]: see [`picture::paint_cell_counts`].
    pub fn paint_picture(
        &mut self,
        view_grid: &ViewGrid,
        colour_ramps: &[Ramp; OUTCOME_KIND_COUNT],
    ) -> &[[u8; 4]] {
        let (ViewGrid { min_corner, max_corner, .. }, cells_per_metre) =
            (*view_grid, view_grid.cells_per_unit());
        let mut cell_counts = vec![[0u32; OUTCOME_KIND_COUNT]; view_grid.column_count * view_grid.row_count];
        for shown_attempt in &self.tested_attempts {
            let cell_column = ((shown_attempt.pose.x() - min_corner[0]) * cells_per_metre[0]).floor();
            let cell_row = ((max_corner[1] - shown_attempt.pose.y()) * cells_per_metre[1]).floor();
            if let Some(cell_index) = view_grid.cell_index(cell_column, cell_row) {
                cell_counts[cell_index][shown_attempt.outcome_kind()] += 1;
            }
        }
        self.picture_pixels = picture::paint_cell_counts(&cell_counts, colour_ramps);
        &self.picture_pixels
    }

    /// Returns the index of the attempt (accepted or rejected motion) that ends nearest to `target_point` (m), within `search_radius` (m).
    pub fn find_nearest(&self, target_point: [f64; 2], search_radius: f64) -> Option<usize> {
        let end_positions = self.tested_attempts.iter().map(|shown_attempt| shown_attempt.pose.position());
        nearest_index(end_positions, target_point, [search_radius, search_radius])
    }

    /// Returns the arcs driven in an attempt that is shown.
    pub fn arcs(&self, attempt_index: usize) -> Vec<Arc> {
        if attempt_index >= self.tested_attempts.len() {
            return Vec::new();
        }
        let map_model = conditioned_model(&self.settings, &self.floor_plan, self.settings.sampler);
        AttemptDriver::new(&map_model, &self.settings, &self.noise_draws).arcs(attempt_index)
    }

    /// Returns the point of a wall that the robot touches first in an attempt that is shown; None if it touches no wall.
    pub fn first_contact(&self, attempt_index: usize) -> Option<[f64; 2]> {
        let is_free = |arc: &Arc| self.floor_plan.test_arc(arc, self.settings.clearance).is_free;
        let arc = self.arcs(attempt_index).into_iter().find(|arc| !is_free(arc))?;
        let mut bracket = 0.0..1.0;
        for _ in 0..CONTACT_BISECTIONS {
            let midpoint = 0.5 * (bracket.start + bracket.end);
            *(if is_free(&arc.leading_part(midpoint)) { &mut bracket.start } else { &mut bracket.end }) =
                midpoint;
        }
        let stop_point = arc.leading_part(bracket.end).end().position();
        let distance_of = |wall: &Segment| wall.distance_to_point(stop_point);
        let walls = self.floor_plan.walls().iter();
        Some(walls.min_by(|a, b| distance_of(a).total_cmp(&distance_of(b)))?.nearest_point(stop_point))
    }

    /// Draws `sample_count` accepted samples with a sampler and returns their cost. The caller measures the time. Fails with
    /// [`NoAcceptedSample`] if one of the samples is not accepted, or if there are so many draws that the simulation would give up.
    pub fn sampling_trial(&self, sampler: Sampler, sample_count: usize) -> Result<Cost, NoAcceptedSample> {
        let map_model = conditioned_model(&self.settings, &self.floor_plan, sampler);
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(self.settings.seed);
        let mut total_cost = Cost::default();
        let part_count = sampler.part_count() as usize * sample_count;
        for _ in 0..sample_count {
            let cost =
                map_model.sampling_cost(&self.settings.command, &self.settings.start_pose(), &mut rng)?;
            total_cost.add(cost);
            if total_cost.draws > max_draws(part_count) {
                return Err(NoAcceptedSample(total_cost));
            }
        }
        Ok(total_cost)
    }

    /// Returns true if the robot collides with nothing at its start pose.
    pub fn is_start_free(&self) -> bool {
        let [x, y, _] = self.settings.start;
        self.floor_plan.test_point([x, y], self.settings.clearance).is_free
    }

    /// Returns the noise-free arc of the command.
    pub fn commanded_arc(&self) -> Arc {
        let VelocityCmd { v, omega, dt } = self.settings.command;
        Arc { start: self.settings.start_pose(), length: v * dt, turn: omega * dt }
    }
}

/// Number of bisections that locate a contact with a wall, to 10⁻⁹ of an arc.
const CONTACT_BISECTIONS: u32 = 30;

/// Returns the number of draws for `part_count` parts of motions after which the simulation gives up.
pub fn max_draws(part_count: usize) -> usize {
    MAX_DRAWS + MAX_MEAN_DRAWS_PER_PART * part_count
}

fn conditioned_model<'a>(settings: &Settings, plan: &'a FloorPlan, sampler: Sampler) -> MapConditioned<'a> {
    let velocity_model = VelocityModel { alphas: VelocityAlphas(settings.alphas), noise: NoiseKind::Normal };
    MapConditioned { model: velocity_model, plan, clearance: settings.clearance, sampler }
}

js_structs! {
    /// Statistics of the attempts shown. Fractions of no attempts are NaN. Costs per accepted attempt are infinite if none is accepted.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Stats as "SqueezeStats" {
        /// Number of attempts shown (motions, accepted or rejected).
        pub attempts: usize,
        /// Number of motions that were drawn. The sub-stepped sampler counts the parts of motions that it drew.
        pub drawn: usize,
        /// Number of attempts whose motion is accepted.
        pub accepted: usize,
        /// Number of accepted draws, divided by the number of draws.
        pub acceptance_rate: f64,
        /// Number of attempts accepted although a wall blocks the path.
        pub through_wall: usize,
        /// Fraction of accepted attempts in which a wall blocks the path.
        pub through_wall_rate: f64,
        /// 95 % interval of the fraction of accepted attempts in which a wall blocks the path.
        pub through_wall_interval: [f64; 2],
        /// Number of draws, divided by the number of accepted attempts.
        pub draws_per_accepted: f64,
        /// Number of wall distances computed, divided by the number of accepted attempts.
        pub wall_tests_per_accepted: f64,
        /// True if the simulation stopped before it had all samples, because too few draws were accepted.
        pub gave_up: bool,
    }
}

/// Returns the 95 % confidence interval of a probability, of which `success_count` successes in `trial_count` trials were observed (Wilson,
/// 1927). It is also valid if there are no or only successes.
pub fn wilson_interval(success_count: usize, trial_count: usize) -> [f64; 2] {
    let n = trial_count as f64;
    let p = success_count as f64 / n;
    // 97.5 % quantile of the normal distribution. `quantile` takes the probability above the median.
    let z = NoiseKind::Normal.quantile(0.475);
    let (numerator, denominator) = (p + z * z / (2.0 * n), 1.0 + z * z / n);
    let half_width = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    // Despite rounding, the interval of the fraction 0 begins at exactly 0, and that of the fraction 1 ends at exactly 1.
    let lower_bound = if success_count == 0 { 0.0 } else { (numerator - half_width) / denominator };
    let upper_bound = if success_count == trial_count { 1.0 } else { (numerator + half_width) / denominator };
    if n > 0.0 { [lower_bound, upper_bound] } else { [0.0, 1.0] }
}

/// Number of kinds of outcomes, each with a colour ramp: rejected, accepted with a free path, and accepted through a wall.
pub const OUTCOME_KIND_COUNT: usize = 3;

/// Motion that is accepted or rejected by the map. The sub-stepped sampler draws each part of a motion until the part is accepted.
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

    /// Returns the index of the kind of outcome: 0 rejected, 1 accepted with a free path, 2 accepted through a wall.
    pub fn outcome_kind(&self) -> usize {
        usize::from(self.accepted) + usize::from(self.is_through_wall())
    }

    /// Returns true if the attempt is accepted although its path is not free.
    pub fn is_through_wall(&self) -> bool {
        self.accepted && !self.path_free
    }
}

struct AttemptDriver<'a> {
    map_model: &'a MapConditioned<'a>,
    collision_tester: CollisionTester<'a>,
    settings: &'a Settings,
    draws: &'a Draws,
}

impl<'a> AttemptDriver<'a> {
    fn new(map_model: &'a MapConditioned, settings: &'a Settings, noise_draws: &'a Draws) -> Self {
        Self {
            map_model,
            collision_tester: map_model.collision_tester(&settings.command, &settings.start_pose()),
            settings,
            draws: noise_draws,
        }
    }

    /// Makes the first attempts of the range `attempt_indices`: up to four in SIMD lanes, or one with the sub-stepped sampler. Calls
    /// `visit` with each attempt and its cost.
    #[inline(always)]
    fn make_next_attempts(&self, attempt_indices: Range<usize>, mut visit: impl FnMut(Attempt, Cost)) {
        if let Sampler::SubStepped(_) = self.settings.sampler {
            let (new_attempt, cost) = self.drive_parts(attempt_indices.start, &mut |_| ());
            return visit(new_attempt, cost);
        }
        let is_conditioned = self.settings.conditioned;
        let (group_id, first_lane) = (attempt_indices.start / LANE_COUNT, attempt_indices.start % LANE_COUNT);
        let lane_range = first_lane..LANE_COUNT.min(first_lane + attempt_indices.len());
        self.collision_tester.test_lanes(&self.draws.unit_noise[group_id], lane_range, |tested_draw| {
            let deciding_verdict = self.map_model.deciding_verdict(&tested_draw);
            let new_attempt = Attempt {
                pose: tested_draw.pose,
                accepted: !is_conditioned || deciding_verdict.is_free,
                end_free: tested_draw.end_verdict.is_free,
                path_free: tested_draw.path_verdict.is_free,
            };
            let wall_tests = if is_conditioned { deciding_verdict.wall_tests } else { 0 };
            visit(new_attempt, Cost { draws: 1, wall_tests });
        });
    }

    fn arcs(&self, attempt_index: usize) -> Vec<Arc> {
        let mut arcs = Vec::new();
        match self.settings.sampler {
            Sampler::SubStepped(_) => _ = self.drive_parts(attempt_index, &mut |arc| arcs.push(*arc)),
            _ => arcs.push(self.collision_tester.arc(self.draws.noise_of_sample(attempt_index))),
        }
        arcs
    }

    fn drive_parts(&self, attempt_index: usize, visit_arc: &mut dyn FnMut(&Arc)) -> (Attempt, Cost) {
        let Settings { command, conditioned: is_conditioned, seed, .. } = *self.settings;
        let start_pose = self.settings.start_pose();
        // The number of random numbers that an attempt uses depends on the walls. Each attempt has its own stream of numbers, so that a
        // wall changes only attempts near the wall.
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed ^ (attempt_index as u64).rotate_left(32));
        match self.map_model.sample_with_arcs(&command, &start_pose, &mut rng, is_conditioned, visit_arc) {
            Ok(AcceptedMotion { pose, end_free: is_end_free, path_free: is_path_free, cost }) => {
                (Attempt { pose, accepted: true, end_free: is_end_free, path_free: is_path_free }, cost)
            }
            Err(NoAcceptedSample(cost)) => {
                (Attempt { pose: start_pose, accepted: false, end_free: false, path_free: false }, cost)
            }
        }
    }
}
