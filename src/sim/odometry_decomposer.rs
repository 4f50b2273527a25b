//! The Odometry Decomposer: an odometry reading as rotation, drive and rotation, and the effect of noise on these three motions.

use super::cloud::draws::Draws;
use super::cloud::views::nearest_index;
use super::cloud_simulation::cloud_simulation;
use super::settings::{ALPHA_RANGE, MAX_SEED, SettingRules, SettingsError, keywords, settings};
use crate::geom::se2::SE2;
use crate::js::js_structs;
use crate::models::{ExecutedLegs, LegVariances, OdomDelta, OdometryRule, RuleAlphas};
use crate::noise::NoiseKind;
use nalgebra::Vector3;

keywords!(
    OdometryRule:
    "thrun" = Self::Table, "nav2" = Self::Nav2, "beluga" = Self::Beluga, "omni" = Self::Omni
);

/// Maximum number of outcomes (end poses drawn with noise). This many can be computed within a frame. More dots would be indistinguishable.
pub const MAX_SAMPLES: u64 = 5000;

settings! {
    /// Settings of the Odometry Decomposer.
    pub struct Settings {
        /// Odometry pose before the motion.
        from: [f64; 3] = [0.0; 3], each "that odometry reports";
        // The default is a drive in reverse, for which the odometry rules give different results.
        /// Odometry pose after the motion.
        to: [f64; 3] = [-1.2, -0.3, 0.1], each "that odometry reports";
        /// Odometry rule, which decomposes the reading and relates the α’s to its noise.
        rule: OdometryRule = OdometryRule::Table;
        /// Noise parameters of the odometry rule; only the rule omni has the fifth.
        alphas: RuleAlphas = [0.03, 0.01, 0.01, 0.02, 0.01], in ALPHA_RANGE,
            each "Noise parameter; the first four are every rule’s, the fifth the omnidirectional one’s.";
        /// Distribution of the noise. Its choice does not change the variances.
        noise: NoiseKind = NoiseKind::Normal;
        /// Correlation of the noises of the two rotations, which the odometry rules assume to be 0.
        correlation: f64 = 0.0, in -1.0..=1.0;
        /// Drift time: time since the odometry frame coincided with the world frame. The prediction does not depend on it.
        drift: f64 = 40.0, "s", in 0.0..=1e6;
        /// Progress of the robot: from 0 to 1 in the first rotation, to 2 in the drive, to 3 in the second rotation.
        phase: f64 = 3.0, in 0.0..=3.0;
        /// Number of outcomes (end poses drawn with noise) in the whole cloud.
        samples: usize = 500, in 1..=MAX_SAMPLES;
        // With the default seed and settings, standard deviations of the samples are nearer to the exact ones than with the other seeds
        // from 0 to 39.
        /// Seed of the random numbers. Equal seeds draw equal outcomes.
        seed: u64 = 25, in 0..=MAX_SEED;
    }
}

impl SettingRules for Settings {
    /// Presets: readings with one, two or all three of rotation, translation and rotation. The rules give different results for a drive in
    /// reverse, and for jitter of half a centimetre.
    const PRESETS: &'static [(&'static str, Self)] = &[
        ("all", preset_ending_at([1.2, 1.0, 1.2])),
        // 0.6435 rad is the bearing of the end position (1.2, 0.9), so that there is no second rotation.
        ("turn-drive", preset_ending_at([1.2, 0.9, 0.6435])),
        ("drive-turn", preset_ending_at([1.5, 0.0, 1.0])),
        ("reverse", Self::DEFAULT),
        ("spin", preset_ending_at([0.0, 0.0, 2.2])),
        ("rest", preset_ending_at([-0.004, 0.003, 0.001])),
    ];
}

const fn preset_ending_at(end_pose: [f64; 3]) -> Settings {
    Settings { to: end_pose, ..Settings::DEFAULT }
}

/// Velocity of the odometry frame in the world (m/s, m/s, rad/s). The frame drifts on a slow curve, as with slightly wrong wheel diameters.
const DRIFT_TWIST: [f64; 3] = [0.015, 0.008, -0.01];

/// Maximum number of points of a deviation curve. As each point takes a microsecond, a curve takes at most 10 ms.
pub const MAX_CURVE_POINTS: u64 = 10_000;

js_structs! {
    /// Rotation, translation and rotation of the reading, as an odometry rule decomposes it, and the standard deviations of their noises.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct RuleNoise {
        /// Odometry rule that gives the decomposition and the noise.
        pub rule: OdometryRule as "OdometryDecomposerSettings['rule']",
        /// Rotation, translation and rotation. If the rule treats the reading as a turn on the spot, the second rotation is the whole turn.
        pub legs: OdomDelta,
        /// Standard deviations of the first rotation (rad), the translation (m) and the second rotation (rad), and of the sideways noise of
        /// the translation (m).
        pub deviations: [f64; 4] as "Float64Array",
        /// Standard deviation of the end position across the measured bearing, m.
        pub cross_track: f64,
        /// Standard deviation of the whole turn, rad.
        pub heading: f64,
    }

    /// Poses of the odometry in the world, after the odometry frame has drifted.
    #[derive(Clone, Debug, PartialEq)]
    pub struct DriftedOdometry as "Drifted" {
        /// Poses x, y (m), θ (rad) in the world: the odometry frame, the start pose and the end pose.
        pub poses: Vec<[f64; 3]> as "Float64Array",
        /// Rotation, translation and rotation of the motion from the start pose to the end pose.
        pub legs: OdomDelta,
    }

    /// Statistics of the outcomes shown (noisy end poses; NaN without outcomes), and exact values under the selected odometry rule.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Stats as "DecomposerStats" {
        /// Number of outcomes shown, which are end poses drawn with noise.
        pub n: usize,
        /// Root mean square of the distance of the end position from the line along the measured bearing, m.
        pub cross_track: f64,
        /// Standard error of `crossTrack`, m.
        pub cross_track_error: f64,
        /// Exact value of `crossTrack`, m.
        pub exact_cross_track: f64,
        /// Sideways standard deviation (m) of the end of the drive due to the first rotation: δ_trans·σ_rot1.
        pub lever: f64,
        /// Root mean square of the difference between the executed turn and the measured turn, rad.
        pub heading: f64,
        /// Standard error of `heading`, rad.
        pub heading_error: f64,
        /// Exact value of `heading`, rad.
        pub exact_heading: f64,
        /// Exact standard deviation of the heading if the noises of the two rotations are independent, rad.
        pub independent_heading: f64,
    }
}

/// Simulation of the Odometry Decomposer widget: settings, random numbers, and the outcomes shown.
#[derive(Clone, Debug)]
pub struct OdometryDecomposer {
    settings: Settings,
    noise_draws: Draws,
    poses: Vec<SE2>,
}

cloud_simulation!(OdometryDecomposer);

impl OdometryDecomposer {
    fn new_empty(settings: Settings) -> Result<Self, SettingsError> {
        let draws = Draws::new(settings.seed, settings.noise);
        Ok(Self { settings, noise_draws: draws, poses: Vec::new() })
    }

    /// Changes the settings and shows the first `target_count` outcomes.
    /// Errors are those of [`OdometryDecomposer::new`], and change nothing.
    pub fn configure_first(&mut self, settings: Settings, target_count: usize) -> Result<(), SettingsError> {
        settings.check()?;
        self.settings = settings;
        self.show_samples(target_count.min(settings.samples));
        Ok(())
    }

    /// Returns the number of outcomes (noisy end poses) that can be added within a few milliseconds: all of them.
    pub fn block_size(&self) -> usize {
        self.settings.samples
    }

    /// Returns the number of outcomes shown, which are end poses drawn with noise.
    pub fn shown_count(&self) -> usize {
        self.poses.len()
    }

    fn show_samples(&mut self, sample_count: usize) {
        self.noise_draws.reset_if_changed(self.settings.seed, self.settings.noise);
        self.noise_draws.extend_to(sample_count);
        let start_pose = self.start_pose();
        self.poses =
            self.executed_motions(sample_count).map(|executed| executed.poses(&start_pose)[3]).collect();
    }

    /// Returns the odometry reading: the motion between the two odometry poses.
    pub fn reading(&self) -> OdomDelta {
        OdomDelta::from_poses(&self.start_pose(), &self.settings.to.into())
    }

    /// Returns the rotation, translation and rotation into which the selected rule decomposes the reading.
    pub fn legs(&self) -> OdomDelta {
        self.settings.rule.legs(&self.reading())
    }

    fn start_pose(&self) -> SE2 {
        self.settings.from.into()
    }

    fn variances(&self) -> LegVariances {
        self.settings.rule.variances(&self.reading(), &self.settings.alphas)
    }

    fn executed_motions(&self, sample_count: usize) -> impl Iterator<Item = ExecutedLegs> + Clone + '_ {
        let rotation_correlation = self.settings.correlation;
        let (legs, variances) = (self.legs(), self.variances());
        (0..sample_count).map(move |index| {
            let [rot1_noise, trans_noise, independent_noise] = self.noise_draws.noise_of_sample(index);
            let rot2_noise = rotation_correlation * rot1_noise
                + (1.0 - rotation_correlation * rotation_correlation).sqrt() * independent_noise;
            variances.executed_motion(&legs, [rot1_noise, trans_noise, rot2_noise])
        })
    }

    /// Returns the outcomes shown, which are end poses drawn with noise, in sample order.
    pub fn poses(&self) -> &[SE2] {
        &self.poses
    }

    /// Returns four poses of the noise-free motion: at the start, after the first rotation, after the drive, after the second rotation.
    pub fn leg_poses(&self) -> [SE2; 4] {
        ExecutedLegs { legs: self.legs(), strafe: 0.0 }.poses(&self.start_pose())
    }

    /// Returns the poses of [`OdometryDecomposer::leg_poses`] for each of the first `pose_count` outcomes shown.
    pub fn sample_leg_poses(&self, pose_count: usize) -> Vec<[SE2; 4]> {
        let start_pose = self.start_pose();
        self.executed_motions(pose_count.min(self.shown_count()))
            .map(|executed| executed.poses(&start_pose))
            .collect()
    }

    /// Returns the pose of the robot at the progress that the setting `phase` gives.
    pub fn robot_pose(&self) -> SE2 {
        let driven_fraction_since = |start_phase: f64| (self.settings.phase - start_phase).clamp(0.0, 1.0);
        let OdomDelta { rot1, trans, rot2 } = self.legs();
        let legs = OdomDelta {
            rot1: driven_fraction_since(0.0) * rot1,
            trans: driven_fraction_since(1.0) * trans,
            rot2: driven_fraction_since(2.0) * rot2,
        };
        legs.apply(&self.start_pose())
    }

    /// Returns the decomposition of the reading and its noise by each of the four odometry rules, with the current α's.
    pub fn rule_noises(&self) -> [RuleNoise; 4] {
        let Settings { alphas, noise: noise_kind, correlation: rotation_correlation, .. } = self.settings;
        let reading = self.reading();
        OdometryRule::ALL.map(|odometry_rule| {
            let legs = odometry_rule.legs(&reading);
            let variances = odometry_rule.variances(&reading, &alphas);
            let LegVariances { rot1, trans, rot2, strafe: strafe_variance } = variances;
            RuleNoise {
                rule: odometry_rule,
                legs,
                deviations: [rot1, trans, rot2, strafe_variance].map(|variance| variance.0.sqrt()),
                cross_track: variances.cross_track_variance(legs.trans, noise_kind).sqrt(),
                heading: variances.heading_variance(rotation_correlation).sqrt(),
            }
        })
    }

    /// Returns the measured and exact standard deviations of the end position and of the turn.
    pub fn stats(&self) -> Stats {
        let Settings { noise: noise_kind, correlation: rotation_correlation, .. } = self.settings;
        let (legs, variances) = (self.legs(), self.variances());
        let executed_motions = self.executed_motions(self.shown_count());
        let cross_track_offsets =
            executed_motions.clone().map(|ExecutedLegs { legs: executed, strafe: strafe_variance }| {
                let (sin, cos) = libm::sincos(executed.rot1 - legs.rot1);
                executed.trans * sin + strafe_variance * cos
            });
        let turn_offsets = executed_motions
            .map(|ExecutedLegs { legs: executed, .. }| executed.rot1 - legs.rot1 + executed.rot2 - legs.rot2);
        let [cross_track, cross_track_error] = rms_with_error(cross_track_offsets, self.shown_count());
        let [heading, heading_error] = rms_with_error(turn_offsets, self.shown_count());
        Stats {
            n: self.shown_count(),
            cross_track,
            cross_track_error,
            exact_cross_track: variances.cross_track_variance(legs.trans, noise_kind).sqrt(),
            lever: legs.trans * variances.rot1.0.sqrt(),
            heading,
            heading_error,
            exact_heading: variances.heading_variance(rotation_correlation).sqrt(),
            independent_heading: variances.heading_variance(0.0).sqrt(),
        }
    }

    /// Returns the standard deviations of drives of `point_count` lengths from 0 to `max_length` (m), with the measured rotations. A point
    /// of the curve has four numbers in m. They are the length of the drive, the standard deviation of the end position across the bearing,
    /// its part due to the first rotation, and the standard deviation of the length.
    pub fn deviation_curve(&self, max_length: f64, point_count: usize) -> Vec<[f64; 4]> {
        let Settings { rule: odometry_rule, alphas, noise: noise_kind, .. } = self.settings;
        let reading = self.reading();
        let length_step = max_length / point_count.saturating_sub(1).max(1) as f64;
        (0..point_count)
            .map(|i| {
                let drive_length = length_step * i as f64;
                let variances =
                    odometry_rule.variances(&OdomDelta { trans: drive_length, ..reading }, &alphas);
                let cross_track = variances.cross_track_variance(drive_length, noise_kind).sqrt();
                [drive_length, cross_track, drive_length * variances.rot1.0.sqrt(), variances.trans.0.sqrt()]
            })
            .collect()
    }

    /// Returns the odometry poses in the world. During the drift time t, the odometry frame moves by exp(t·d) with a constant twist d.
    pub fn drifted_odometry(&self) -> DriftedOdometry {
        let drifted_frame = SE2::exp(&(Vector3::from(DRIFT_TWIST) * self.settings.drift));
        let (drifted_start, drifted_end) =
            (drifted_frame * self.start_pose(), drifted_frame * SE2::from(self.settings.to));
        let legs = self.settings.rule.legs(&OdomDelta::from_poses(&drifted_start, &drifted_end));
        DriftedOdometry { poses: [drifted_frame, drifted_start, drifted_end].map(Into::into).to_vec(), legs }
    }

    /// Returns the index of the outcome shown (noisy end pose) that is nearest to a point (m), within `search_radius`.
    pub fn find_nearest(&self, target_point: [f64; 2], search_radius: f64) -> Option<usize> {
        nearest_index(self.poses.iter().map(SE2::position), target_point, [search_radius, search_radius])
    }
}

/// Returns the root mean square of n offsets with mean 0, and its standard error by the delta method: √((m₄ − m₂²)/n)/(2√m₂) with their
/// moments m₂ and m₄.
fn rms_with_error(pose_offsets: impl Iterator<Item = f64>, offset_count: usize) -> [f64; 2] {
    if offset_count == 0 {
        return [f64::NAN; 2];
    }
    let (mut square_sum, mut fourth_power_sum) = (0.0, 0.0);
    for squared_offset in pose_offsets.map(|pose_offset| pose_offset * pose_offset) {
        square_sum += squared_offset / offset_count as f64;
        fourth_power_sum += squared_offset * squared_offset / offset_count as f64;
    }
    let rms_error = ((fourth_power_sum - square_sum * square_sum).max(0.0) / offset_count as f64).sqrt()
        / (2.0 * square_sum.sqrt());
    [square_sum.sqrt(), if square_sum == 0.0 { 0.0 } else { rms_error }]
}
