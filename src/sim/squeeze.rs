//! Map Squeeze: motion conditioned on a floor plan, and what the condition cannot see.

use super::draws::Draws;
use super::settings::{MAX_SEED, SPEED, SettingsError, check_alphas, check_command, check_real, check_whole};
use crate::geom::arc::Arc;
use crate::geom::lanes::LANES;
use crate::geom::se2::SE2;
use crate::map::{Accepted, Cost, FloorPlan, Judging, MOST_DRAWS, MapConditioned, Sampler, Wedged};
use crate::models::{VelocityAlphas, VelocityCmd, VelocityModel};
use crate::noise::NoiseKind;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::FRAC_PI_2;
use std::ops::{Range, RangeInclusive};

/// Everything a user sets, but for the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// x, y (m) and heading (rad) where the robot starts.
    pub start: [f64; 3],
    pub command: VelocityCmd,
    pub alphas: [f64; 6],
    /// Radius of the robot, m.
    pub clearance: f64,
    /// Whether draws are judged at all; where not, all of them are accepted.
    pub conditioned: bool,
    pub sampler: Sampler,
    /// Motions attempted.
    pub samples: usize,
    pub seed: u64,
}

/// Where the presets start, in the apartment.
pub const PRESETS: [(&str, [f64; 3]); 3] =
    [("doorway", [2.05, 2.6, FRAC_PI_2]), ("wall", [3.3, 2.6, FRAC_PI_2]), ("corridor", [1.4, 4.4, 0.0])];

/// The widget's one noise slider: α₁₋₄ = n, α₅,₆ = n/4.
pub fn alphas_of_noise(n: f64) -> [f64; 6] {
    [n, n, n, n, n / 4.0, n / 4.0]
}

impl Default for Settings {
    /// The widget's opening state: facing a doorway.
    fn default() -> Self {
        Self {
            start: PRESETS[0].1,
            command: VelocityCmd { v: 1.0, omega: 0.0, dt: 2.0 },
            alphas: alphas_of_noise(0.12),
            clearance: 0.13,
            conditioned: true,
            sampler: Sampler::Endpoint,
            samples: 600,
            seed: 7,
        }
    }
}

/// From a point to a robot of ten metres.
pub const CLEARANCE: RangeInclusive<f64> = 0.0..=10.0;
/// A million attempts take 56 MB, and some seconds where the map is hard.
pub const MAX_SAMPLES: usize = 1_000_000;
/// Parts of a command: at a thousand the sampler is as good as judging the arc, and a thousand times as dear.
pub const MAX_STEPS: u64 = 1000;

impl Settings {
    fn check(&self) -> Result<(), SettingsError> {
        let [x, y, theta] = self.start;
        for (field, value) in [("start.x", x), ("start.y", y), ("start.theta", theta)] {
            check_real(field, value, &SPEED)?;
        }
        check_command(&self.command)?;
        check_alphas(&self.alphas)?;
        check_real("clearance", self.clearance, &CLEARANCE)?;
        let parts = if let Sampler::SubStepped(steps) = self.sampler {
            check_whole("steps", f64::from(steps), 1, MAX_STEPS)?
        } else {
            1
        };
        check_whole("samples", self.samples as f64, 1, MAX_SAMPLES as u64 / parts)?;
        check_whole("seed", self.seed as f64, 0, MAX_SEED).map(|_| ())
    }

    /// The parts that an attempt is made of.
    pub fn parts(&self) -> u32 {
        match self.sampler {
            Sampler::SubStepped(steps) => steps,
            _ => 1,
        }
    }

    fn start(&self) -> SE2 {
        let [x, y, theta] = self.start;
        SE2::new(x, y, theta)
    }

    fn conditioned_on<'a>(&self, plan: &'a FloorPlan, sampler: Sampler) -> MapConditioned<'a> {
        let model = VelocityModel { alphas: VelocityAlphas(self.alphas), noise: NoiseKind::Normal };
        MapConditioned { model, plan, clearance: self.clearance, sampler }
    }
}

/// What became of one attempt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attempt {
    pub pose: SE2,
    pub accepted: bool,
    /// Whether the robot fits where it ends, and all along the way.
    pub end_free: bool,
    pub path_free: bool,
}

/// Counts over the attempts shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Draws of the model; for the sub-stepped sampler, of its shorter motions.
    pub draws: usize,
    pub wall_tests: usize,
    pub accepted: usize,
    /// Accepted although the way there was blocked.
    pub through_wall: usize,
}

impl Tally {
    /// The share of accepted draws: of an attempt of k parts, k draws are accepted.
    pub fn acceptance_rate(&self, steps: u32) -> f64 {
        share(self.accepted * steps as usize, self.draws)
    }

    pub fn through_wall_rate(&self) -> f64 {
        share(self.through_wall, self.accepted)
    }

    /// The 95 % interval of the share through a wall (Wilson, 1927): right also for shares of 0 and 1.
    pub fn through_wall_interval(&self) -> [f64; 2] {
        let (n, p) = (self.accepted as f64, self.through_wall_rate());
        // The normal quantile of 97.5 %.
        let z = NoiseKind::Normal.quantile(0.475);
        let (middle, scale) = (p + z * z / (2.0 * n), 1.0 + z * z / n);
        let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
        // At shares of 0 and 1 the interval ends there, which rounding would miss.
        let low = if self.through_wall == 0 { 0.0 } else { (middle - half) / scale };
        let high = if self.through_wall == self.accepted { 1.0 } else { (middle + half) / scale };
        if n > 0.0 { [low, high] } else { [0.0, 1.0] }
    }
}

fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole as f64
}

/// The simulation behind the widget: a map, settings, draws, and the attempts shown.
#[derive(Clone, Debug)]
pub struct MapSqueeze {
    plan: FloorPlan,
    settings: Settings,
    draws: Draws,
    attempts: Vec<Attempt>,
    tally: Tally,
    gave_up: bool,
}

/// Draws a part of a motion on average before the machine gives up: an acceptance of 5 % over all attempts. Fewer
/// would give up where a patient filter still works; more would keep a page waiting for seconds.
const PATIENCE: usize = 20;

impl MapSqueeze {
    /// A machine in the apartment, all of its samples attempted.
    ///
    /// # Errors
    /// [`SettingsError`] for the first setting out of range, or where memory does not suffice for the samples.
    pub fn new(settings: Settings) -> Result<Self, SettingsError> {
        let mut machine = Self {
            plan: FloorPlan::apartment(),
            settings: Settings { samples: 0, ..settings },
            draws: Draws::new(settings.seed, NoiseKind::Normal),
            attempts: Vec::new(),
            tally: Tally::default(),
            gave_up: false,
        };
        machine.configure(settings)?;
        Ok(machine)
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    pub fn plan(&self) -> &FloorPlan {
        &self.plan
    }

    /// Puts the robot into another map, where it stands and with the luck it has.
    pub fn set_plan(&mut self, plan: FloorPlan) {
        self.plan = plan;
        let shown = self.shown_of(self.settings.samples);
        self.restart();
        self.grow(shown);
    }

    /// How many attempts to show when there are `samples` from now on.
    fn shown_of(&self, samples: usize) -> usize {
        let complete = self.gave_up || self.attempts.len() == self.settings.samples;
        if complete { samples } else { self.attempts.len().min(samples) }
    }

    /// Changes the settings; the draws stay the same. A complete cloud stays complete; one that is still growing keeps
    /// its count, as far as there are samples for it.
    ///
    /// # Errors
    /// As [`MapSqueeze::new`]; nothing has changed then.
    pub fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
        settings.check()?;
        let shown = self.shown_of(settings.samples);
        self.attempts
            .try_reserve_exact(settings.samples.saturating_sub(self.attempts.len()))
            .map_err(|_| SettingsError::no_memory(settings.samples))?;
        self.draws.reserve(settings.samples).map_err(|_| SettingsError::no_memory(settings.samples))?;
        self.draws.restart(settings.seed, NoiseKind::Normal);
        self.draws.extend_to(settings.samples);
        self.settings = settings;
        self.restart();
        self.grow(shown);
        Ok(())
    }

    /// Takes every attempt off the picture; the draws remain.
    pub fn restart(&mut self) {
        self.attempts.clear();
        self.tally = Tally::default();
        self.gave_up = false;
    }

    /// Shows up to `count` attempts more; returns how many are shown. Stops for good where the robot is wedged.
    pub fn grow(&mut self, count: usize) -> usize {
        let end = self.attempts.len().saturating_add(count).min(self.settings.samples);
        let steps = self.settings.parts() as usize;
        let Self { plan, settings, draws, attempts, tally, gave_up } = self;
        let model = settings.conditioned_on(plan, settings.sampler);
        let driver = Driver::new(&model, settings, draws);
        while attempts.len() < end && !*gave_up {
            driver.drive_some(attempts.len()..end, |attempt, cost| {
                tally.draws += cost.draws;
                tally.wall_tests += cost.wall_tests;
                tally.accepted += usize::from(attempt.accepted);
                tally.through_wall += usize::from(attempt.accepted && !attempt.path_free);
                attempts.push(attempt);
            });
            *gave_up = tally.draws > MOST_DRAWS + PATIENCE * steps * attempts.len();
        }
        self.attempts.len()
    }

    /// The attempts shown, in sample order.
    pub fn attempts(&self) -> &[Attempt] {
        &self.attempts
    }

    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Whether the machine stopped short of its samples because too few draws were accepted.
    pub fn gave_up(&self) -> bool {
        self.gave_up
    }

    /// The arcs driven in an attempt that is shown.
    pub fn arcs(&self, index: usize) -> Vec<Arc> {
        if index >= self.attempts.len() {
            return Vec::new();
        }
        let model = self.settings.conditioned_on(&self.plan, self.settings.sampler);
        Driver::new(&model, &self.settings, &self.draws).arcs(index)
    }

    /// What `count` accepted samples of a sampler cost here and now, to be timed by the caller.
    ///
    /// # Errors
    /// [`Wedged`] where one of them is not to be had, or where all of them take so many draws that the machine would give
    /// up.
    pub fn trial(&self, sampler: Sampler, count: usize) -> Result<Cost, Wedged> {
        let conditioned = self.settings.conditioned_on(&self.plan, sampler);
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(self.settings.seed);
        let mut total = Cost::default();
        let parts = if let Sampler::SubStepped(steps) = sampler { steps as usize } else { 1 };
        for _ in 0..count {
            let Cost { draws, wall_tests } =
                conditioned.cost(&self.settings.command, &self.settings.start(), &mut rng)?;
            total.draws += draws;
            total.wall_tests += wall_tests;
            if total.draws > MOST_DRAWS + PATIENCE * parts * count {
                return Err(Wedged(total));
            }
        }
        Ok(total)
    }

    /// Whether the robot fits where it starts.
    pub fn start_free(&self) -> bool {
        let [x, y, _] = self.settings.start;
        self.plan.point_free([x, y], self.settings.clearance).free
    }

    /// The arc that the command drives without noise.
    pub fn commanded(&self) -> Arc {
        let VelocityCmd { v, omega, dt } = self.settings.command;
        Arc { start: self.settings.start(), length: v * dt, turn: omega * dt }
    }
}

/// Makes attempts, each from its own noise.
struct Driver<'a> {
    model: &'a MapConditioned<'a>,
    judging: Judging<'a>,
    settings: &'a Settings,
    draws: &'a Draws,
}

impl<'a> Driver<'a> {
    fn new(model: &'a MapConditioned, settings: &'a Settings, draws: &'a Draws) -> Self {
        Self { model, judging: model.judging(&settings.command, &settings.start()), settings, draws }
    }

    /// The first of these attempts, or up to four where they are judged once.
    #[inline(always)]
    fn drive_some(&self, indices: Range<usize>, mut see: impl FnMut(Attempt, Cost)) {
        if let Sampler::SubStepped(steps) = self.settings.sampler {
            let (attempt, cost) = self.drive_parts(indices.start, steps, &mut |_| ());
            return see(attempt, cost);
        }
        let conditioned = self.settings.conditioned;
        let (four, first) = (indices.start / LANES, indices.start % LANES);
        let lanes = first..LANES.min(first + indices.len());
        self.judging.judge_four(&self.draws.fours()[four], lanes, |draw| {
            let deciding = self.model.deciding(&draw);
            let attempt = Attempt {
                pose: draw.pose,
                accepted: !conditioned || deciding.free,
                end_free: draw.end.free,
                path_free: draw.path.free,
            };
            see(attempt, Cost { draws: 1, wall_tests: if conditioned { deciding.wall_tests } else { 0 } });
        });
    }

    /// The arcs driven in an attempt.
    fn arcs(&self, index: usize) -> Vec<Arc> {
        let Sampler::SubStepped(steps) = self.settings.sampler else {
            return vec![self.judging.arc(self.draws.of(index))];
        };
        let mut arcs = Vec::new();
        self.drive_parts(index, steps, &mut |arc| arcs.push(*arc));
        arcs
    }

    fn drive_parts(&self, index: usize, steps: u32, along: &mut dyn FnMut(&Arc)) -> (Attempt, Cost) {
        let Settings { command, conditioned, seed, .. } = *self.settings;
        let start = self.settings.start();
        // How many numbers an attempt uses depends on the walls, so that each has a stream of its own.
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed ^ (index as u64).rotate_left(32));
        if !conditioned {
            let (end, path_free) = self.model.sample_unconditioned(&command, &start, &mut rng, along);
            let attempt = Attempt { pose: end.pose, accepted: true, end_free: end.end.free, path_free };
            return (attempt, Cost { draws: steps as usize, wall_tests: 0 });
        }
        match self.model.sample_along(&command, &start, &mut rng, along) {
            Ok(Accepted { pose, path_free, cost }) => {
                (Attempt { pose, accepted: true, end_free: true, path_free }, cost)
            }
            Err(Wedged(cost)) => {
                (Attempt { pose: start, accepted: false, end_free: false, path_free: false }, cost)
            }
        }
    }
}
