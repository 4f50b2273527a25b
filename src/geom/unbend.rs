//! Morph: gradual transition of a picture from positions (x, y) to exponential coordinates (along, heading).
//!
//! Stage μ of the morph takes the twist ξ to the point F_μ(ξ), with D = diag(1, 1 − μ, 1 − μ):
//!
//! ```text
//! F_μ(ξ) = position of exp(D·ξ) + (0, μ·ξ_heading)
//! ```
//!
//! F₀ is the position of exp ξ, and F₁ is (ξ_along, ξ_heading). In between, each arc keeps its length, and its curvature is
//! multiplied by 1 − μ. On arcs (ξ_lateral = 0) F_μ is one-to-one for lengths above 0 and turns below π/(1 − μ).

use super::arc::arc_with_turn_near;
use super::se2::SE2;
use nalgebra::{Matrix2, Matrix2x3, Vector2, Vector3};
use std::f64::consts::PI;

/// Returns the point F_μ(ξ) of a twist ξ (m, m, rad) at a stage μ of the transition: 0 is the plane of positions, 1 exponential
/// coordinates.
pub fn unbend(twist: &Vector3<f64>, morph_fraction: f64) -> [f64; 2] {
    let unmorphed_fraction = 1.0 - morph_fraction;
    let pose = SE2::exp(&Vector3::new(twist.x, unmorphed_fraction * twist.y, unmorphed_fraction * twist.z));
    [pose.x(), pose.y() + morph_fraction * twist.z]
}

/// Returns the 2 × 3 Jacobian of [`unbend`] with respect to the twist ξ.
pub fn unbend_jacobian(twist: &Vector3<f64>, morph_fraction: f64) -> Matrix2x3<f64> {
    let unmorphed_fraction = 1.0 - morph_fraction;
    let bent_twist = Vector3::new(twist.x, unmorphed_fraction * twist.y, unmorphed_fraction * twist.z);
    // The Jacobian of the position of exp(ξ) with respect to ξ consists of the upper two rows of R(ω)·J_r(ξ).
    let rotation_adjoint = SE2::new(0.0, 0.0, bent_twist.z).adjoint();
    let mut morph_jacobian =
        (rotation_adjoint * SE2::right_jacobian(&bent_twist)).fixed_view::<2, 3>(0, 0).into_owned();
    morph_jacobian.column_mut(1).scale_mut(unmorphed_fraction);
    morph_jacobian.column_mut(2).scale_mut(unmorphed_fraction);
    morph_jacobian[(1, 2)] += morph_fraction;
    morph_jacobian
}

/// Returns the points F_μ of a polyline of positions (x, y), for μ from 0 (positions) to 1 (exponential coordinates). Each position counts
/// as the end of the arc whose turn is nearest to `expected_turn` (rad).
///
/// The result is empty if some of these arcs lead forward and others backward, as for a polyline around the start.
pub fn unbend_line(line_points: &[[f64; 2]], expected_turn: f64, morph_fraction: f64) -> Vec<[f64; 2]> {
    let arc_to_position =
        |[x, y]: &[f64; 2]| arc_with_turn_near(&SE2::identity(), &SE2::new(*x, *y, 0.0), expected_turn);
    let arcs_to_points: Vec<_> = line_points.iter().map(arc_to_position).collect();
    if arcs_to_points.windows(2).any(|adjacent_arcs| (adjacent_arcs[1].1 - adjacent_arcs[0].1).abs() > PI) {
        return Vec::new();
    }
    arcs_to_points
        .into_iter()
        .map(|(arc_length, arc_turn)| unbend(&Vector3::new(arc_length, 0.0, arc_turn), morph_fraction))
        .collect()
}

const MAX_NEWTON_STEPS: usize = 20;

/// Returns the length and turn of the arc whose point F_μ is `target_point`, by Newton's method from an initial guess. Returns None if the
/// method does not converge, as on a fold of F_μ.
pub fn find_arc(target_point: [f64; 2], initial_guess: [f64; 2], morph_fraction: f64) -> Option<[f64; 2]> {
    let mut length_and_turn = Vector2::from(initial_guess);
    for _ in 0..MAX_NEWTON_STEPS {
        let twist = Vector3::new(length_and_turn.x, 0.0, length_and_turn.y);
        let position_error = Vector2::from(target_point) - Vector2::from(unbend(&twist, morph_fraction));
        if position_error.amax() < 1e-12 * (1.0 + length_and_turn.amax()) {
            return Some(length_and_turn.into());
        }
        let jacobian = unbend_jacobian(&twist, morph_fraction);
        length_and_turn +=
            Matrix2::from_columns(&[jacobian.column(0), jacobian.column(2)]).try_inverse()? * position_error;
    }
    None
}
