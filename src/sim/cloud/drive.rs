//! Motions of many robots from the origin, four at a time.

use crate::geom::lanes::{SinCos, Trigonometry, is_any_lane_set};
use crate::models::PolarMotion;
use crate::stats::two_pass::{FourArcs, FourPoses, JacobianScale, ReferencePoint};
use std::f64::consts::FRAC_PI_2;
use wide::f64x4;

type AffineInNoise = [f64; 2];

/// Motion of all robots under given settings, as a function of three noises of variance 1, in the order in which the model draws them.
/// Lengths, bearings and headings of a [`PolarMotion`] are affine functions of the noises.
#[derive(Clone, Copy, Debug)]
pub struct NoisyDrive {
    is_arc: bool,
    length: AffineInNoise,
    bearing: AffineInNoise,
    /// Coefficients of half the heading angle: `bearing_weight` · bearing + `half_heading_offset` (rad).
    bearing_weight: f64,
    half_heading_offset: AffineInNoise,
    /// Half of the commanded turn (rad). Of all logarithms and arcs, those with the turn nearest to the commanded turn are used.
    half_commanded_turn: f64,
    /// Middle and half the width (rad) of the interval of φ/2, with the turn φ, in which the formulas for angles up to π/2 suffice.
    short_formula_interval: [f64; 2],
    trigonometry: Trigonometry,
}

#[derive(Clone, Copy)]
pub struct FourMotions {
    length: f64x4,
    bearing: f64x4,
    pub half_heading: f64x4,
}

impl NoisyDrive {
    pub fn new(polar_motion: &PolarMotion) -> Self {
        let PolarMotion { is_arc, length, bearing, last_turn, .. } = *polar_motion;
        let noise_sign = if is_arc { 1.0 } else { -1.0 };
        let half_commanded_turn = 0.5 * polar_motion.commanded_turn;
        Self {
            is_arc,
            length: [length[0], noise_sign * length[1]],
            bearing: [bearing[0], noise_sign * bearing[1]],
            bearing_weight: 0.5 * polar_motion.turn_per_bearing(),
            half_heading_offset: [0.5 * last_turn[0], noise_sign * 0.5 * last_turn[1]],
            half_commanded_turn,
            short_formula_interval: short_formula_interval(half_commanded_turn),
            trigonometry: Trigonometry::default(),
        }
    }

    pub fn turn_std(&self) -> f64 {
        2.0 * libm::hypot(self.bearing_weight * self.bearing[1], self.half_heading_offset[1])
    }

    #[inline(always)]
    pub fn compute_motions(&self, unit_noise: &[f64x4; 3]) -> FourMotions {
        let [first_noise, second_noise, third_noise] = *unit_noise;
        let (length, bearing) =
            if self.is_arc { (first_noise, second_noise) } else { (second_noise, first_noise) };
        let bearing = bearing * self.bearing[1] + self.bearing[0];
        FourMotions {
            length: length * self.length[1] + self.length[0],
            bearing,
            half_heading: bearing * self.bearing_weight
                + (third_noise * self.half_heading_offset[1] + self.half_heading_offset[0]),
        }
    }

    /// Returns the end points (x, y) of four motions, the arcs from the origin to these points, and true if these are regular arcs: those
    /// that the robots drove. Noise changes the length and half the turn of regular arcs by [`NoisyDrive::regular_arc_deviations`].
    #[inline(always)]
    pub fn end_points(&self, motions: &FourMotions) -> ([f64x4; 2], FourArcs, bool) {
        let FourMotions { length, bearing, .. } = *motions;
        let is_outside_short_formulas = self.is_outside_short_formulas(motions);
        let bearing_sin_cos = if is_outside_short_formulas {
            self.trigonometry.sin_cos_any_angle(bearing)
        } else {
            self.trigonometry.sin_cos_small_angle(bearing)
        };
        let end_positions = self.end_points_on_bearing(motions, &bearing_sin_cos);
        if is_outside_short_formulas || !self.is_arc {
            return (end_positions, self.arcs_to_points(bearing, end_positions), false);
        }
        (end_positions, FourArcs { arc_length: length, half_turn: bearing, sinc: bearing_sin_cos.sinc }, true)
    }

    #[inline(always)]
    fn end_points_on_bearing(&self, motions: &FourMotions, bearing_sin_cos: &SinCos) -> [f64x4; 2] {
        let chord_length = if self.is_arc { motions.length * bearing_sin_cos.sinc } else { motions.length };
        [chord_length * bearing_sin_cos.cos, chord_length * bearing_sin_cos.sin]
    }

    /// Returns the deviations that noise adds to the length and half the turn of regular arcs: the arcs that the robots drove.
    #[inline(always)]
    pub fn regular_arc_deviations(&self, unit_noise: &[f64x4; 3]) -> [f64x4; 2] {
        let noise_stds = if self.is_arc { [self.length[1], self.bearing[1]] } else { [0.0; 2] };
        [unit_noise[0] * noise_stds[0], unit_noise[1] * noise_stds[1]]
    }

    /// Converts sums of the unit noise into sums of [`NoisyDrive::regular_arc_deviations`].
    pub fn sums_of_regular_arc_deviations(&self, [a, b, aa, ab, bb]: [f64; 5]) -> [f64; 5] {
        if !self.is_arc {
            return [0.0; 5];
        }
        let ([_, s], [_, t]) = (self.length, self.bearing);
        [a * s, b * t, aa * (s * s), ab * (s * t), bb * (t * t)]
    }

    #[inline(never)]
    fn arcs_to_points(&self, bearing: f64x4, [x, y]: [f64x4; 2]) -> FourArcs {
        let (half_turn, SinCos { sinc, sin, cos }) =
            self.trigonometry.sin_cos_on_branch(bearing, self.half_commanded_turn);
        FourArcs { arc_length: (x * cos + y * sin) / sinc, half_turn, sinc }
    }

    /// Returns the poses of four motions that ended at `end_points`, and their logarithms on the branch of the commanded turn.
    #[inline(always)]
    pub fn poses(&self, motions: &FourMotions, end_points: &[f64x4; 2]) -> FourPoses {
        let turn = if self.is_outside_short_formulas(motions) {
            self.trigonometry.sin_cos_on_branch(motions.half_heading, self.half_commanded_turn)
        } else {
            (motions.half_heading, self.trigonometry.sin_cos_small_angle(motions.half_heading))
        };
        with_logarithms(*end_points, turn)
    }

    /// Returns the points of four end poses in a picture, at a stage of its transition from positions to exponential coordinates: see
    /// [`crate::geom::unbend`].
    #[inline(always)]
    pub fn morphed_points(&self, motions: &FourMotions, end_points: &[f64x4; 2], morph: f64) -> [f64x4; 2] {
        let FourPoses { along: along_lanes, lateral, half_heading, .. } = self.poses(motions, end_points);
        let remaining_bend = 1.0 - morph;
        let SinCos { sinc, sin, cos } = self.trigonometry.sin_cos(half_heading * remaining_bend);
        let (along_lanes, lateral) = (along_lanes * sinc, lateral * sinc * remaining_bend);
        [along_lanes * cos - lateral * sin, along_lanes * sin + lateral * cos + half_heading * (2.0 * morph)]
    }

    #[inline(always)]
    fn is_outside_short_formulas(&self, motions: &FourMotions) -> bool {
        let [interval_middle, interval_half_width] = self.short_formula_interval;
        let is_beyond =
            |angle: f64x4| (angle - interval_middle).abs().simd_gt(f64x4::splat(interval_half_width));
        is_any_lane_set(is_beyond(motions.bearing) | is_beyond(motions.half_heading))
    }

    /// Returns the poses of four robots and the arcs to their positions, by formulas for any angle. Loops over all robots of a cloud use
    /// shorter formulas for angles up to π/2 instead.
    #[inline(never)]
    pub fn coordinates_of_four(&self, unit_noise: &[f64x4; 3]) -> (FourPoses, FourArcs) {
        let motions = self.compute_motions(unit_noise);
        let bearing_sin_cos = self.trigonometry.sin_cos_any_angle(motions.bearing);
        let end_points = self.end_points_on_bearing(&motions, &bearing_sin_cos);
        let turn = self.trigonometry.sin_cos_on_branch(motions.half_heading, self.half_commanded_turn);
        (with_logarithms(end_points, turn), self.arcs_to_points(motions.bearing, end_points))
    }

    /// Returns the reference point of all sums (the noise-free end pose in all coordinates), and the scales of the Jacobians.
    pub fn nominal_coordinates(&self) -> (ReferencePoint, JacobianScale) {
        let (poses, arcs) = self.coordinates_of_four(&[f64x4::splat(0.0); 3]);
        let mut reference_coordinates = [
            poses.x,
            poses.y,
            poses.along,
            poses.lateral,
            poses.half_heading,
            arcs.arc_length,
            arcs.half_turn,
        ]
        .map(|coordinate_lanes| coordinate_lanes.to_array()[0]);
        if self.is_arc {
            // The length and half the turn of the command are known. Inverting the end pose would give them with other last bits.
            [reference_coordinates[5], reference_coordinates[6]] = [self.length[0], self.bearing[0]];
        }
        let [half_heading_sinc, arc_sinc] =
            [poses.sinc, arcs.sinc].map(|sinc_lanes| sinc_lanes.to_array()[0].abs());
        // The scale includes the noise of the length, because the commanded length may be 0.
        let length = libm::hypot(self.length[0], self.length[1]);
        (reference_coordinates, [1.0 / half_heading_sinc, 1.0 / (length * arc_sinc * arc_sinc)])
    }

    /// Returns the standard deviation (rad) of the turn of the arc that ends at the robot's position.
    pub fn arc_turn_std(&self) -> f64 {
        2.0 * self.bearing[1].abs()
    }
}

/// Returns four poses at the given end points, with their logarithms. `turn` has half of each heading, with its sine and cosine.
#[inline(always)]
fn with_logarithms([x, y]: [f64x4; 2], turn: (f64x4, SinCos)) -> FourPoses {
    let (half_heading, SinCos { sinc, sin, cos }) = turn;
    let h_cot_h = cos / sinc;
    let (along_lanes, lateral) = (h_cot_h * x + half_heading * y, h_cot_h * y - half_heading * x);
    FourPoses { x, y, along: along_lanes, lateral, half_heading, half_sin: sin, half_cos: cos, sinc }
}

/// Maximum angle (rad) for the sine and cosine formulas of small angles: π/2 minus a margin for rounding.
pub const MAX_SHORT_FORMULA_ANGLE: f64 = FRAC_PI_2 * (1.0 - 1e-12);

/// Returns the middle and half the width (rad) of the interval of angles that are within π/2 of 0 and of `half_commanded_turn`.
fn short_formula_interval(half_commanded_turn: f64) -> [f64; 2] {
    let (interval_start, interval_end) = (
        (half_commanded_turn - MAX_SHORT_FORMULA_ANGLE).max(-MAX_SHORT_FORMULA_ANGLE),
        (half_commanded_turn + MAX_SHORT_FORMULA_ANGLE).min(MAX_SHORT_FORMULA_ANGLE),
    );
    [0.5 * (interval_start + interval_end), 0.5 * (interval_end - interval_start)]
}
