//! Map Squeeze: motion conditioned on a floor plan, and paths through walls that the condition misses.

mod driver;
mod picture;
mod settings;
mod tally;

pub use super::noise_level::alphas_of_noise_level;
pub use driver::{ACCEPTED_BIT, Attempt, END_FREE_BIT, PATH_FREE_BIT};
pub use picture::OUTCOME_KIND_COUNT;
pub use settings::*;
pub use tally::{Stats, Tally};

use super::cloud::draws::Draws;
use super::cloud::picture::Ramp;
use super::cloud::views::{Grid, nearest_index};
use super::cloud_simulation::cloud_simulation;
use super::settings::{AllowedValues, Rules, SettingsError};
use crate::geom::arc::Arc;
use crate::geom::se2::SE2;
use crate::map::{
    Cost, FloorPlan, FloorPlanError, MAX_DRAWS, MapConditioned, NoAcceptedSample, OccupancyGrid, Sampler,
};
use crate::models::{VelocityAlphas, VelocityCmd, VelocityModel};
use crate::noise::NoiseKind;
use driver::Driver;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use tally::ratio;

/// Maximum number of parts of motions in a timing trial: accepted samples times the parts of each. A longer trial would block
/// the page.
pub const MAX_TRIAL_PARTS: u64 = 100_000;

/// Simulation of the widget: a map, settings, draws, and the attempts shown.
#[derive(Clone, Debug)]
pub struct MapSqueeze {
    plan: FloorPlan,
    settings: Settings,
    draws: Draws,
    /// Attempts that are shown, with the number of each outcome.
    attempts: Vec<Attempt>,
    tally: Tally,
    gave_up: bool,
    /// Latest picture. The page reads it in place.
    picture: Vec<[u8; 4]>,
}

/// Average number of draws for a part of a motion at which the simulation gives up: an acceptance of 5 %. With a smaller
/// limit it would stop where a filter still works; with a larger one a page would wait for seconds.
const MAX_MEAN_DRAWS_PER_PART: usize = 20;

/// Number of parts of motions that a block of attempts tests against the map. A block takes some milliseconds.
const PARTS_PER_BLOCK: usize = 4096;

cloud_simulation!(MapSqueeze);

impl MapSqueeze {
    fn empty(settings: Settings) -> Result<Self, SettingsError> {
        let mut simulation = Self {
            plan: FloorPlan::apartment(),
            settings,
            draws: Draws::new(settings.seed, NoiseKind::Normal),
            attempts: Vec::new(),
            tally: Tally::default(),
            gave_up: false,
            picture: Vec::new(),
        };
        simulation.reserve_memory(&settings)?;
        Ok(simulation)
    }

    fn reserve_memory(&mut self, settings: &Settings) -> Result<(), SettingsError> {
        let memory_error = |_| SettingsError::out_of_memory(settings.samples);
        let missing_attempts = settings.samples.saturating_sub(self.attempts.len());
        self.attempts.try_reserve_exact(missing_attempts).map_err(memory_error)?;
        self.draws.reserve(settings.samples).map_err(memory_error)
    }

    /// Returns the floor plan.
    pub fn plan(&self) -> &FloorPlan {
        &self.plan
    }

    /// Replaces the map, and keeps the start pose and the draws. The number of attempts stays, or becomes the full
    /// number if the simulation had given up.
    pub fn set_plan(&mut self, plan: FloorPlan) {
        self.plan = plan;
        let attempt_count = if self.has_given_up() { self.settings.samples } else { self.shown_count() };
        self.clear_attempts();
        self.add_samples(attempt_count);
    }

    /// Replaces the map by a grid, as [`MapSqueeze::set_plan`] replaces it by a plan. The settings define how unknown cells count.
    /// Errors are those of [`FloorPlan::from_grid`], and change nothing.
    pub fn set_grid(&mut self, grid: OccupancyGrid) -> Result<(), FloorPlanError> {
        self.set_plan(FloorPlan::from_grid(grid.with_unknown(self.settings.unknown))?);
        Ok(())
    }

    /// Changes the settings and makes the first block of attempts. [`MapSqueeze::add_samples`] makes the others, up to `target_count` in all.
    ///
    /// # Errors
    /// [`SettingsError`] as in [`MapSqueeze::new`], or if the map has too many walls when unknown cells count as `settings.unknown`
    /// says. Errors change nothing.
    pub fn configure_first(&mut self, settings: Settings, target_count: usize) -> Result<(), SettingsError> {
        settings.check()?;
        let outdated_grid = self.plan.grid().filter(|_| settings.unknown != self.settings.unknown);
        let plan =
            outdated_grid.map(|grid| FloorPlan::from_grid(grid.clone().with_unknown(settings.unknown)));
        // A grid that was accepted before can only be refused because of its unknown cells.
        let plan = plan.transpose().map_err(|_| SettingsError {
            field: "unknown".to_owned(),
            value: f64::NAN,
            allowed: AllowedValues::Keyword {
                given: "blocked",
                allowed: "free, as the cells of this map would have more than 20000 sides",
            },
        })?;
        self.reserve_memory(&settings)?;
        if let Some(plan) = plan {
            self.plan = plan;
        }
        self.settings = settings;
        self.clear_attempts();
        self.add_samples(target_count.min(self.block_size()));
        Ok(())
    }

    fn clear_attempts(&mut self) {
        self.attempts.clear();
        (self.tally, self.gave_up) = (Tally::default(), false);
    }

    /// Makes attempts up to a number. If nearly every draw collides, the simulation gives up, and further calls make none.
    fn show_samples(&mut self, target_count: usize) {
        self.draws.reset_if_changed(self.settings.seed, NoiseKind::Normal);
        self.draws.extend_to(target_count);
        let part_count = self.settings.part_count() as usize;
        let Self { plan, settings, draws, attempts, tally, gave_up, .. } = self;
        let model = conditioned_model(settings, plan, settings.sampler);
        let driver = Driver::new(&model, settings, draws);
        while attempts.len() < target_count && !*gave_up {
            driver.make_next_attempts(attempts.len()..target_count, |attempt, cost| {
                tally.draws += cost.draws;
                tally.wall_tests += cost.wall_tests;
                tally.accepted += usize::from(attempt.accepted);
                tally.through_wall += usize::from(attempt.is_through_wall());
                attempts.push(attempt);
            });
            *gave_up = tally.draws > max_draws(part_count * attempts.len());
        }
    }

    /// Returns the number of attempts that are made within a few milliseconds.
    pub fn block_size(&self) -> usize {
        (PARTS_PER_BLOCK / self.settings.part_count() as usize).max(1)
    }

    /// Returns the attempts shown, in sample order.
    pub fn attempts(&self) -> &[Attempt] {
        &self.attempts
    }

    /// Returns the number of attempts shown.
    pub fn shown_count(&self) -> usize {
        self.attempts.len()
    }

    /// Returns the counts over the attempts that are shown.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Returns true if the simulation stopped short of its samples because too few draws were accepted.
    pub fn has_given_up(&self) -> bool {
        self.gave_up
    }

    /// Returns the statistics of the attempts shown.
    pub fn stats(&self) -> Stats {
        let tally = &self.tally;
        Stats {
            attempts: self.attempts.len(),
            drawn: tally.draws,
            accepted: tally.accepted,
            acceptance_rate: tally.acceptance_rate(self.settings.part_count()),
            through_wall: tally.through_wall,
            through_wall_rate: tally.through_wall_rate(),
            through_wall_interval: tally.through_wall_interval(),
            draws_per_accepted: ratio(tally.draws, tally.accepted),
            wall_tests_per_accepted: ratio(tally.wall_tests, tally.accepted),
            gave_up: self.gave_up,
        }
    }

    /// Paints a density map of the ends of the attempts shown, one pixel for each cell of the grid. The most frequent kind of
    /// attempt in a cell selects the ramp. The colour is ramp[255·√(count/max_count)], where `count` is the number of attempts in
    /// the cell and `max_count` the largest count of all cells. Empty cells are transparent.
    pub fn paint(&mut self, grid: &Grid, ramps: &[Ramp; OUTCOME_KIND_COUNT]) -> &[[u8; 4]] {
        self.picture = picture::paint_attempts(&self.attempts, grid, ramps);
        &self.picture
    }

    /// Returns the attempt that ends nearest to a point (m) and within `radius` of it.
    pub fn nearest(&self, target: [f64; 2], radius: f64) -> Option<usize> {
        let positions = self.attempts.iter().map(|attempt| [attempt.pose.x(), attempt.pose.y()]);
        nearest_index(positions, target, [radius, radius])
    }

    /// Returns the arcs driven in an attempt that is shown.
    pub fn arcs(&self, index: usize) -> Vec<Arc> {
        if index >= self.attempts.len() {
            return Vec::new();
        }
        let model = conditioned_model(&self.settings, &self.plan, self.settings.sampler);
        Driver::new(&model, &self.settings, &self.draws).arcs(index)
    }

    /// Draws `count` accepted samples with a sampler and returns their cost. The caller measures the time.
    ///
    /// # Errors
    /// [`NoAcceptedSample`] if one of the samples is not accepted, or if the simulation would give up because of the number of draws.
    pub fn sampling_trial(&self, sampler: Sampler, count: usize) -> Result<Cost, NoAcceptedSample> {
        let model = conditioned_model(&self.settings, &self.plan, sampler);
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(self.settings.seed);
        let mut total_cost = Cost::default();
        let part_count = sampler.part_count() as usize * count;
        for _ in 0..count {
            let cost = model.sampling_cost(&self.settings.command, &self.settings.start(), &mut rng)?;
            total_cost.draws += cost.draws;
            total_cost.wall_tests += cost.wall_tests;
            if total_cost.draws > max_draws(part_count) {
                return Err(NoAcceptedSample(total_cost));
            }
        }
        Ok(total_cost)
    }

    /// Returns a free pose, see [`FloorPlan::find_free_pose`].
    pub fn find_free_pose(&self) -> Option<SE2> {
        self.plan.find_free_pose(self.settings.clearance)
    }

    /// Returns true if the robot collides with nothing at its start pose.
    pub fn is_start_free(&self) -> bool {
        let [x, y, _] = self.settings.start;
        self.plan.test_point([x, y], self.settings.clearance).free
    }

    /// Returns the noise-free arc of the command.
    pub fn commanded_arc(&self) -> Arc {
        let VelocityCmd { v, omega, dt } = self.settings.command;
        Arc { start: self.settings.start(), length: v * dt, turn: omega * dt }
    }
}

/// Returns the maximum number of draws for this many parts of motions, after which the simulation gives up.
pub fn max_draws(parts: usize) -> usize {
    MAX_DRAWS + MAX_MEAN_DRAWS_PER_PART * parts
}

fn conditioned_model<'a>(settings: &Settings, plan: &'a FloorPlan, sampler: Sampler) -> MapConditioned<'a> {
    let model = VelocityModel { alphas: VelocityAlphas(settings.alphas), noise: NoiseKind::Normal };
    MapConditioned { model, plan, clearance: settings.clearance, sampler }
}
