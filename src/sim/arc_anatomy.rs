//! Arc Anatomy: the arc between two poses, the motion that it implies, and the likelihood of that motion (Tables 5.1 and 5.3).

use super::settings::{ALPHA_RANGE, SettingRules, SettingsError, keywords, settings};
use crate::geom::arc::{Arc, ArcInversion, PreparedPose, invert_arc};
use crate::geom::se2::SE2;
use crate::js::js_structs;
use crate::models::{MotionModel, VelocityAlphas, VelocityCmd, VelocityModel};
use crate::noise::{NoiseKind, Variance, product_or_zero};
use crate::stats::trace_level_set;

/// Quantity of the heat map: a function of the final position, while the final heading is fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeatMapKind {
    /// No heat map.
    NoHeatMap,
    /// [`MotionModel::prob`], the score of Table 5.1.
    Prob,
    /// [`MotionModel::pose_density`], the density of the sampler.
    Density,
}

keywords!(HeatMapKind: "none" = Self::NoHeatMap, "prob" = Self::Prob, "density" = Self::Density);

settings! {
    /// Settings of Arc Anatomy.
    pub struct Settings {
        /// Start pose of the robot.
        start: [f64; 3] = [0.0; 3], each "at which the robot starts";
        /// Pose of the robot after the command.
        next: [f64; 3] = [1.1, 0.5, 1.1], each "of the robot after the command";
        /// Command between the two poses.
        command: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
        /// Noise parameters, the six of the velocity model.
        alphas: [f64; 6] = [0.05, 0.05, 0.05, 0.09, 0.01, 0.01], in ALPHA_RANGE,
            each "Noise parameter of the velocity model.";
        /// Distribution of the noise. Its choice does not change the variances.
        noise: NoiseKind = NoiseKind::Normal;
        /// True for a radius without a sign, as Table 5.1 prints it.
        printed: bool = false;
        /// Quantity that the heat map shows at each possible final position, with the heading of the final pose.
        map: HeatMapKind = HeatMapKind::NoHeatMap;
    }
}

impl SettingRules for Settings {
    /// Presets: an arc to the left, its mirror images to the right and in reverse, and a straight drive. The final pose is not on the
    /// commanded arc, so that no residual is 0.
    const PRESETS: &'static [(&'static str, Self)] = &[
        ("left", Self::DEFAULT),
        ("right", create_preset([1.0, -0.5], [1.1, -0.5, -1.1])),
        ("reverse", create_preset([-1.0, 0.5], [-1.1, -0.5, 1.1])),
        ("straight", create_preset([1.0, 0.0], [1.2, 0.0, 0.2])),
    ];
}

const fn create_preset([v, omega]: [f64; 2], next_pose: [f64; 3]) -> Settings {
    Settings { command: VelocityCmd { v, omega, dt: 1.0 }, next: next_pose, ..Settings::DEFAULT }
}

impl Settings {
    fn start_pose(&self) -> SE2 {
        self.start.into()
    }

    fn next_pose(&self) -> SE2 {
        self.next.into()
    }

    fn velocity_model(&self) -> VelocityModel {
        VelocityModel { alphas: VelocityAlphas(self.alphas), noise: self.noise }
    }
}

const TWIST_PATH_CHORDS: usize = 64;
/// Number of ticks on the path of the constant twist, at equal intervals of time.
const TWIST_PATH_TICKS: usize = 8;

/// Maximum number of exponential functions evaluated for a heat map, which takes some milliseconds on a phone. The density sums over the
/// full turns that noise may cause. If there are many such turns, the heat map has fewer and larger cells.
const MAX_EXPONENTIALS: f64 = 1e5;

/// Maximum number of full turns in each direction over which the density of the last turn is summed. They suffice for standard deviations
/// of up to nine radians, above which the density is uniform.
const MAX_LAST_TURNS: f64 = 27.0;

/// Heights of the contours, relative to the maximum of the heat map.
pub const CONTOUR_LEVELS: [f64; 3] = [0.5, 0.1, 0.01];

js_structs! {
    /// Arc, with the radius and centre of its circle.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct ArcWithCircle {
        /// Length, m; negative in reverse.
        pub arc_length: f64,
        /// Turn, rad, positive to the left.
        pub turn: f64,
        /// Radius, m; positive with the centre to the left of the heading, infinite for a straight arc.
        pub radius: f64,
        /// Centre of the circle, m; null (None) for a straight arc.
        #[cfg_attr(target_arch = "wasm32", serde(rename = "center"))]
        pub centre: Option<[f64; 2]>,
        /// End pose: x, y (m) and θ (rad).
        pub end: [f64; 3],
    }

    /// One of the three factors of the score p of Table 5.1.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct ProbFactor {
        /// Value of v̂, ω̂ or γ̂ that the final pose implies (m/s, rad/s).
        pub estimate: f64,
        /// Residual v − v̂, ω − ω̂ or γ̂: the argument of `prob` in Table 5.1.
        pub residual: f64,
        /// Standard deviation σ of the noise.
        pub deviation: f64,
        /// Residual divided by σ. If σ is 0, the quotient is 0 for a residual of 0 up to rounding, and infinite otherwise.
        pub deviations: f64,
        /// Value of the factor: the density `prob` at the residual.
        pub value: f64,
        /// Value of the factor relative to its maximum, which is `prob` at a residual of 0; from 0 to 1.
        pub share: f64,
    }

    /// Arcs between the start and the final pose, and the likelihood of the final pose.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Stats as "AnatomyStats" {
        /// Arc of the command.
        pub commanded: ArcWithCircle,
        /// Arc to the final position.
        pub inverted: ArcWithCircle,
        /// Arc that v̂ and ω̂ drive. It is the arc to the final position, unless the settings select the unsigned radius of Table 5.1.
        pub driven: ArcWithCircle,
        /// Final turn γ̂Δt, rad.
        pub last_turn: f64,
        /// Factors of the score p, for v̂, ω̂ and γ̂.
        pub factors: [ProbFactor; 3],
        /// Index of the factor whose residual is the largest, in standard deviations.
        pub weakest: usize,
        /// p, the product of the three factors.
        pub prob: f64,
        /// Score p relative to the score of the noise-free pose, from 0 to 1.
        pub share: f64,
        /// Density of the sampler over dx dy dθ; null (None) if a variance is 0.
        pub density: Option<f64>,
        /// ξ = next ⊟ start: along (m), lateral (m), heading (rad).
        pub xi: [f64; 3],
    }

    /// Values of the lines of Table 5.1. The radius r* of line 4 is signed, unless the settings select the unsigned radius.
    ///
    /// μ, the centre and r* are infinite if the displacement is parallel to the heading. μ is NaN without a displacement.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Table as "AnatomyTable" {
        /// Values of the lines: μ, x* (m), y* (m), r* (m), Δθ (rad), v̂ (m/s), ω̂ (rad/s), γ̂ (rad/s) and p.
        pub lines: [f64; 9],
        /// Midpoint of the start and final positions, m. The centre is the midpoint plus μ times `normal`.
        pub middle: [f64; 2],
        /// Displacement rotated by a quarter turn to the left, m: (y − y′, x′ − x).
        pub normal: [f64; 2],
    }

    /// Lines that the picture of the arcs shows: x, y pairs of their points, m.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Paths as "AnatomyPaths" {
        /// Noise-free arc of the command.
        pub commanded: Vec<[f64; 2]> as "Float64Array",
        /// Arc to the final position.
        pub inverted: Vec<[f64; 2]> as "Float64Array",
        /// Arc driven with the estimates v̂ and ω̂. It is the arc to the final position, unless the radius is unsigned.
        pub driven: Vec<[f64; 2]> as "Float64Array",
        /// Path of the constant twist ξ: start · exp(tξ) for t from 0 to 1. If γ̂ ≠ 0 it differs from the driven arc, and has a
        /// lateral velocity, which wheels do not allow.
        pub lie: Vec<[f64; 2]> as "Float64Array",
        /// Line segments that start on the path `lie`, as x, y, x, y in m. Each is the sideways displacement that the lateral velocity at
        /// its start would cause within Δt.
        pub ticks: Vec<[f64; 4]> as "Float64Array",
    }

    /// Heat map over final positions, with the heading of the final pose: the score p of Table 5.1, or the density of the sampler.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Surface as "AnatomySurface" {
        /// Number of cells along x.
        pub columns: usize,
        /// Number of cells along y.
        pub rows: usize,
        /// Values of the cells from 0 to 255, relative to the maximum; row by row from the top. All are 0 if a noise has no variance.
        pub shades: Vec<u8> as "Uint8Array",
        /// Contours of the score p at a half, a tenth and a hundredth of its maximum, as x, y pairs in m.
        pub prob: Vec<Vec<[f64; 2]>> as "Float64Array[]",
        /// Contours of the sampler's density at a half, a tenth and a hundredth of its maximum, as x, y pairs in m.
        pub density: Vec<Vec<[f64; 2]>> as "Float64Array[]",
    }
}

/// Simulation of the Arc Anatomy widget. Every method computes its result from the settings.
#[derive(Clone, Debug)]
pub struct ArcAnatomy {
    settings: Settings,
}

impl ArcAnatomy {
    /// Creates a simulation with `settings`. Fails with [`SettingsError`] for the first setting out of range.
    pub fn new(settings: Settings) -> Result<Self, SettingsError> {
        settings.check()?;
        Ok(Self { settings })
    }

    /// Returns the settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Changes the settings. Errors are those of [`ArcAnatomy::new`], and leave the settings unchanged.
    pub fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
        *self = Self::new(settings)?;
        Ok(())
    }

    /// Returns the arcs of the command and to the final pose, with the likelihood of that pose.
    pub fn stats(&self) -> Stats {
        let Settings { command, noise: noise_kind, .. } = &self.settings;
        let (start, next) = (self.settings.start_pose(), self.settings.next_pose());
        let controls = self.selected_inversion();
        let factors = self.noise_residuals(&controls).map(|residual| ProbFactor::new(*noise_kind, residual));
        let size_of = |i: &usize| factors[*i].deviations.abs();
        let weakest_index = (0..3).rev().max_by(|a, b| size_of(a).total_cmp(&size_of(b))).unwrap_or(0);
        let [commanded_arc, inverted_arc, driven_arc] = self.list_arcs().map(ArcWithCircle::from);
        Stats {
            commanded: commanded_arc,
            inverted: inverted_arc,
            driven: driven_arc,
            last_turn: controls.gamma_hat * command.dt,
            factors,
            weakest: weakest_index,
            prob: self.prob(),
            share: factors.iter().map(|prob_factor| prob_factor.share).product(),
            density: self.settings.velocity_model().pose_density(&next, command, &start),
            xi: next.boxminus(&start).into(),
        }
    }

    /// Returns the arc of the command, the arc to the final position, and the arc that the estimates v̂ and ω̂ drive. The last two differ
    /// only for the unsigned radius of Table 5.1.
    fn list_arcs(&self) -> [Arc; 3] {
        let VelocityCmd { v, omega, dt } = self.settings.command;
        let (inverted_arc, controls) = (self.signed_inversion(), self.selected_inversion());
        let arc_speeds =
            [[v, omega], [inverted_arc.v_hat, inverted_arc.omega_hat], [controls.v_hat, controls.omega_hat]];
        arc_speeds.map(|[v, omega]| Arc {
            start: self.settings.start_pose(),
            length: v * dt,
            turn: omega * dt,
        })
    }

    fn signed_inversion(&self) -> ArcInversion {
        let signed_arc =
            invert_arc(&self.settings.start_pose(), &self.settings.next_pose(), self.settings.command.dt);
        // A straight drive in reverse has the turn rate −0. Adding 0 makes it 0, so that no minus is shown.
        ArcInversion { omega_hat: signed_arc.omega_hat + 0.0, ..signed_arc }
    }

    /// Returns the arc to the final position with the radius that the settings select. With the unsigned radius r* of Table 5.1, v̂ = Δθ/Δt
    /// · r* has the sign of Δθ. That sign is wrong if the centre is to the right of the heading.
    fn selected_inversion(&self) -> ArcInversion {
        let signed_arc = self.signed_inversion();
        let ArcInversion { v_hat, omega_hat, .. } = signed_arc;
        if !self.settings.printed || omega_hat == 0.0 {
            return signed_arc;
        }
        ArcInversion { v_hat: v_hat.abs().copysign(omega_hat), ..signed_arc }
    }

    /// Returns the estimate v̂, ω̂ or γ̂, its residual, and the variance of its noise, for each of the three controls.
    fn noise_residuals(&self, controls: &ArcInversion) -> [(f64, f64, Variance); 3] {
        let ArcInversion { v_hat, omega_hat, gamma_hat } = *controls;
        let command = &self.settings.command;
        let [v_variance, omega_variance, gamma_variance] = self.settings.velocity_model().variances(command);
        [
            (v_hat, command.v - v_hat, v_variance),
            (omega_hat, command.omega - omega_hat, omega_variance),
            (gamma_hat, gamma_hat, gamma_variance),
        ]
    }

    fn prob(&self) -> f64 {
        product_or_zero(
            self.noise_residuals(&self.selected_inversion())
                .map(|(_, residual, variance)| self.settings.noise.prob(residual, variance)),
        )
    }

    /// Returns the values of the lines of Table 5.1. With the displacement (a, b) in the frame of the start, line 1 is ½ · (−a)/(−b).
    pub fn table(&self) -> Table {
        let (start, next) = (self.settings.start_pose(), self.settings.next_pose());
        let relative_pose = start.motion_to(&next);
        let signed_arc @ ArcInversion { v_hat, omega_hat, gamma_hat } = self.selected_inversion();
        let [x, y] = self.signed_inversion().centre(&start).unwrap_or([f64::INFINITY; 2]);
        // The quotient is halved last, because half of the smallest double is 0.
        let mu = 0.5 * (relative_pose.x() / relative_pose.y());
        let arc_turn = omega_hat * self.settings.command.dt;
        Table {
            lines: [mu, x, y, signed_arc.radius(), arc_turn, v_hat, omega_hat, gamma_hat, self.prob()],
            middle: [0.5 * (start.x() + next.x()), 0.5 * (start.y() + next.y())],
            normal: [start.y() - next.y(), next.x() - start.x()],
        }
    }

    /// Returns the arcs, the path of the constant twist and its sideways displacements, as lines of the picture.
    pub fn paths(&self) -> Paths {
        let (start, next) = (self.settings.start_pose(), self.settings.next_pose());
        let [commanded_arc, inverted_arc, driven_arc] =
            self.list_arcs().map(|picture_arc| picture_arc.points());
        let xi = next.boxminus(&start);
        let pose_on_twist_path =
            |i: usize, segment_count: usize| start.boxplus(xi * (i as f64 / segment_count as f64));
        let segment_of_lateral_velocity = |i: usize| {
            let pose = pose_on_twist_path(i, TWIST_PATH_TICKS);
            let [x, y] = PreparedPose::new(pose).transform_point([0.0, xi.y]);
            [pose.x(), pose.y(), x, y]
        };
        Paths {
            commanded: commanded_arc,
            inverted: inverted_arc,
            driven: driven_arc,
            lie: (0..=TWIST_PATH_CHORDS)
                .map(|i| pose_on_twist_path(i, TWIST_PATH_CHORDS).position())
                .collect(),
            ticks: (0..=TWIST_PATH_TICKS).map(segment_of_lateral_velocity).collect(),
        }
    }

    /// Returns the poses after a fraction of the time, from 0 to 1: on the commanded arc, on the arc that the estimates v̂ and ω̂ drive,
    /// and on the path of the constant twist.
    pub fn poses_at(&self, fraction: f64) -> [SE2; 3] {
        let start_pose = self.settings.start_pose();
        let [commanded_arc, _, driven_arc] = self.list_arcs().map(|arc| arc.leading_part(fraction).end());
        let xi = self.settings.next_pose().boxminus(&start_pose);
        [commanded_arc, driven_arc, start_pose.boxplus(xi * fraction)]
    }

    /// Returns the heat map over the rectangle from `min_corner` to `max_corner` (m, `min_corner` below `max_corner` in x and in y); None
    /// if no heat map is selected.
    pub fn surface(&self, min_corner: [f64; 2], max_corner: [f64; 2]) -> Option<Surface> {
        let Settings { command, map: heat_map, next: [.., theta], .. } = self.settings;
        if heat_map == HeatMapKind::NoHeatMap {
            return None;
        }
        let (model, start) = (self.settings.velocity_model(), self.settings.start_pose());
        let winding_count = f64::from(2 * model.max_windings(&command) + 1);
        let max_cells =
            MAX_EXPONENTIALS / (3.0 + 2.0 * winding_count + MAX_LAST_TURNS.min(winding_count + 2.0));
        let [width, height] = [max_corner[0] - min_corner[0], max_corner[1] - min_corner[1]];
        let column_count = (max_cells * width / height).sqrt().max(1.0).min(max_cells).floor();
        let row_count = (max_cells / column_count).max(1.0).floor();
        let cell_size = [width / column_count, height / row_count];
        let (column_count, row_count) = (column_count as usize, row_count as usize);
        let cell_centre_at = |[cell_column, row]: [f64; 2]| {
            [min_corner[0] + (cell_column + 0.5) * cell_size[0], max_corner[1] - (row + 0.5) * cell_size[1]]
        };
        let score_cells = |score_at: &dyn Fn([f64; 3]) -> f64| -> Vec<f64> {
            let cell_score_at = |i: usize| {
                let [x, y] = cell_centre_at([(i % column_count) as f64, (i / column_count) as f64]);
                score_at([x, y, theta]).min(f64::MAX)
            };
            (0..column_count * row_count).map(cell_score_at).collect()
        };
        let prob_values = score_cells(&|next| Self { settings: Settings { next, ..self.settings } }.prob());
        let density_values =
            score_cells(&|next| model.pose_density(&next.into(), &command, &start).unwrap_or(0.0));
        let shown_values = if heat_map == HeatMapKind::Prob { &prob_values } else { &density_values };
        let maximum_of = |field_values: &[f64]| field_values.iter().copied().fold(0.0, f64::max);
        let shown_maximum = maximum_of(shown_values);
        let shade_of = |cell_value: &f64| {
            if shown_maximum > 0.0 { (255.0 * (cell_value / shown_maximum)).round() as u8 } else { 0 }
        };
        let contours_of = |field_values: &[f64]| {
            let max_value = maximum_of(field_values);
            // Contours are interpolated between the logarithms of the values, which are more nearly linear between cells.
            let log_values: Vec<f64> =
                field_values.iter().map(|value| libm::log(value.max(f64::MIN_POSITIVE))).collect();
            let log_levels = CONTOUR_LEVELS
                .iter()
                .filter(|_| max_value > 0.0)
                .map(|fraction| libm::log(fraction * max_value));
            let contour_lines =
                log_levels.flat_map(|log_level| trace_level_set(&log_values, column_count, log_level));
            contour_lines.map(|contour_line| contour_line.into_iter().map(cell_centre_at).collect()).collect()
        };
        Some(Surface {
            columns: column_count,
            rows: row_count,
            shades: shown_values.iter().map(shade_of).collect(),
            prob: contours_of(&prob_values),
            density: contours_of(&density_values),
        })
    }
}

impl From<Arc> for ArcWithCircle {
    fn from(arc: Arc) -> Self {
        let Arc { start, length, turn: arc_turn } = arc;
        let signed_arc = ArcInversion { v_hat: length, omega_hat: arc_turn, gamma_hat: 0.0 };
        Self {
            arc_length: length,
            turn: arc_turn,
            radius: signed_arc.radius(),
            centre: signed_arc.centre(&start),
            end: arc.end().into(),
        }
    }
}

impl ProbFactor {
    fn new(noise_kind: NoiseKind, (estimate, residual, variance): (f64, f64, Variance)) -> Self {
        let (value, prob_at_zero) = (noise_kind.prob(residual, variance), noise_kind.prob(0.0, variance));
        let noise_std = variance.0.sqrt();
        let deviations = match (noise_std == 0.0, value > 0.0) {
            (false, _) => residual / noise_std,
            (true, true) => 0.0,
            (true, false) => f64::INFINITY.copysign(residual),
        };
        Self { estimate, residual, deviation: noise_std, deviations, value, share: value / prob_at_zero }
    }
}
