//! Exact moments of a model's poses, by quadrature over the heading noise. The other noises are integrated in closed form.

use super::cross_track::MIN_RELATIVE_STD;
use super::moments::non_negative;
use super::quadrature::{Node, noise_nodes};
use crate::geom::se2::wrap_angle;
use crate::geom::sinc::unit_arc_end;
use crate::models::PolarMotion;
use crate::noise::NoiseKind;
use nalgebra::{Matrix3, Vector3};

/// Mean and covariance of (x, y, θ), and cross-track skew, of a model's poses after a command from the identity pose; in m and rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactMoments {
    /// Mean position, and circular mean heading in (−π, π].
    pub mean: Vector3<f64>,
    /// Covariance, 3 × 3, of the position and of the turn made (not wrapped).
    pub cov: Matrix3<f64>,
    /// Skewness of the position across the mean heading; NaN if no position deviates across it.
    pub cross_track_skew: f64,
}

/// Node of the quadrature: motion of length 1, for one value of the noise that turns the robot. With a length L, the motion ends at
/// L·`unit_end`.
struct UnitMotion {
    node_weight: f64,
    unit_end: [f64; 2],
    excess_turn: f64,
}

/// Weighted sums over the motions of the quadrature: of `unit_end`, called u, and of `excess_turn`. The weights may sum to less than 1.
#[derive(Default)]
pub(super) struct UnitMotionMoments {
    /// End u of the first motion. Sums contain differences from this value, so that few digits are lost if u varies little.
    first_end: Option<[f64; 2]>,
    pub weight_sum: f64,
    weighted_sums: Vector3<f64>,
    product_sums: Matrix3<f64>,
}

impl UnitMotionMoments {
    #[inline(never)]
    pub fn add(&mut self, weight: f64, unit_end: [f64; 2], excess_turn: f64) {
        let [x, y] = *self.first_end.get_or_insert(unit_end);
        let end_offset = Vector3::new(unit_end[0] - x, unit_end[1] - y, excess_turn);
        self.weight_sum += weight;
        self.weighted_sums += end_offset * weight;
        // The weight is multiplied last, so that the matrix is symmetric to the last bit.
        self.product_sums += end_offset * end_offset.transpose() * weight;
    }

    /// Returns the mean and covariance of the end L·u (x, y) and the excess turn of motions. Their length L is independent of u and of the
    /// turn, and has the given mean and standard deviation.
    #[inline(never)]
    pub fn mean_and_cov(&self, [mean_length, length_std]: [f64; 2]) -> (Vector3<f64>, Matrix3<f64>) {
        let mean = self.weighted_sums / self.weight_sum;
        let mut unit_end_cov = self.product_sums / self.weight_sum - mean * mean.transpose();
        for i in 0..3 {
            unit_end_cov[(i, i)] = non_negative(unit_end_cov[(i, i)]);
        }
        let [x, y] = self.first_end.unwrap_or_default();
        let mean_unit_end = [mean.x + x, mean.y + y, 0.0];
        let length_factors = [mean_length, mean_length, 1.0];
        let cov = Matrix3::from_fn(|i, j| {
            // Because L and u are independent, cov(L·u) = E[L]²·cov(u) + var(L)·E[u·uᵀ].
            let second_moment =
                if i < 2 && j < 2 { unit_end_cov[(i, j)] + mean_unit_end[i] * mean_unit_end[j] } else { 0.0 };
            unit_end_cov[(i, j)] * length_factors[i] * length_factors[j]
                + second_moment * length_std * length_std
        });
        (Vector3::new(mean_length * mean_unit_end[0], mean_length * mean_unit_end[1], mean.z), cov)
    }
}

impl ExactMoments {
    /// Returns the moments of a motion. For a given bearing, and thus a given turn φ, the end of an arc of length s is linear in s:
    /// s·(sin φ/φ, (1 − cos φ)/φ).
    #[inline(never)]
    pub fn new(motion: &PolarMotion) -> Self {
        let (turn_per_bearing, [mean_bearing, bearing_std]) = (motion.turn_per_bearing(), motion.bearing);
        let unit_motion_at = |noise_node: &Node| {
            let excess_turn = turn_per_bearing * bearing_std * noise_node.node_value;
            let turn = turn_per_bearing * mean_bearing + excess_turn;
            let unit_end =
                if motion.is_arc { unit_arc_end(turn).into() } else { [libm::cos(turn), libm::sin(turn)] };
            UnitMotion { node_weight: noise_node.node_weight, unit_end, excess_turn }
        };
        let unit_motions: Vec<_> = noise_nodes(motion.noise_kind).iter().map(unit_motion_at).collect();
        let mut unit_sums = UnitMotionMoments::default();
        unit_motions
            .iter()
            .for_each(|motion| unit_sums.add(motion.node_weight, motion.unit_end, motion.excess_turn));
        let PolarMotion { length: [mean_length, _], length_variance, .. } = *motion;
        let (mean, mut cov) = unit_sums.mean_and_cov([mean_length, length_variance.sqrt()]);
        cov[(2, 2)] += motion.last_turn_variance;
        let mean_turn = motion.mean_turn();
        let (sin, cos) = libm::sincos(mean_turn);
        let lateral_components =
            unit_motions.iter().map(|UnitMotion { node_weight: weight, unit_end: end_point, .. }| {
                let lateral_unit_end = end_point[1] * cos - end_point[0] * sin;
                let (mean, variance) =
                    (mean_length * lateral_unit_end, length_variance * lateral_unit_end * lateral_unit_end);
                MixtureComponent { weight: *weight, mean, variance }
            });
        Self {
            mean: Vector3::new(mean.x, mean.y, wrap_angle(mean_turn)),
            cov,
            cross_track_skew: mixture_skew(lateral_components, mean_length * mean_length + length_variance),
        }
    }
}

/// Returns the cross-track skew of exp(ξ) for ξ ~ N(`mean`, `cov`), with ξ in the order along, lateral, heading (m, m, rad). NaN if there
/// is no spread across the track.
///
/// The quadrature is over the heading. Given the heading, the position is linear in along and lateral. `cov` is a positive semidefinite 3 ×
/// 3 matrix.
pub fn predicted_cross_track_skew(mean: &Vector3<f64>, cov: &Matrix3<f64>) -> f64 {
    let heading_variance = cov[(2, 2)];
    let regression_coefficients = if heading_variance > 0.0 {
        cov.fixed_view::<2, 1>(0, 2) / heading_variance
    } else {
        nalgebra::Vector2::zeros()
    };
    let residual_cov = cov.fixed_view::<2, 2>(0, 0)
        - regression_coefficients * regression_coefficients.transpose() * heading_variance;
    let (sin, cos) = libm::sincos(mean.z);
    let lateral_components = noise_nodes(NoiseKind::Normal).iter().map(|noise_node| {
        let excess_turn = heading_variance.max(0.0).sqrt() * noise_node.node_value;
        let (a, b) = unit_arc_end(mean.z + excess_turn);
        // The lateral component of V(ω)·ξ, as a row over (along, lateral).
        let lateral_row = nalgebra::RowVector2::new(b * cos - a * sin, a * cos + b * sin);
        MixtureComponent {
            weight: noise_node.node_weight,
            mean: (lateral_row * (mean.xy() + regression_coefficients * excess_turn)).x,
            variance: (lateral_row * residual_cov * lateral_row.transpose()).x.max(0.0),
        }
    });
    mixture_skew(lateral_components, mean.xy().norm_squared() + cov[(0, 0)] + cov[(1, 1)])
}

struct MixtureComponent {
    weight: f64,
    mean: f64,
    variance: f64,
}

/// Returns the skewness of the mixture; NaN if its variance is only rounding error relative to `squared_extent`.
fn mixture_skew(components: impl Iterator<Item = MixtureComponent> + Clone, squared_extent: f64) -> f64 {
    let mixture_mean: f64 =
        components.clone().map(|mixture_component| mixture_component.weight * mixture_component.mean).sum();
    let (mut m2, mut m3) = (0.0, 0.0);
    for MixtureComponent { weight, mean, variance } in components {
        let mean_offset = mean - mixture_mean;
        m2 += weight * (mean_offset * mean_offset + variance);
        m3 += weight * mean_offset * (mean_offset * mean_offset + 3.0 * variance);
    }
    if m2 > MIN_RELATIVE_STD * MIN_RELATIVE_STD * squared_extent { m3 / (m2 * m2.sqrt()) } else { f64::NAN }
}
