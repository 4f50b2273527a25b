//! Angles on the circle.

use std::f64::consts::{PI, TAU};

/// Returns the representative of `angle` in (−π, π], radians.
///
/// Exact for |angle| ≤ π; beyond that the remainder is taken against the double nearest to 2π, so that the result
/// is off by about 1.2e-16 · |angle|. NaN and infinities give NaN.
#[inline(always)]
pub fn wrap_angle(angle: f64) -> f64 {
    // Most angles are in range and need no remainder, which is slow.
    if -PI < angle && angle <= PI { angle } else { wrap_far_angle(angle) }
}

#[inline(never)]
fn wrap_far_angle(angle: f64) -> f64 {
    // The remainder is in [−π, π].
    let remainder = libm::remainder(angle, TAU);
    if remainder == -PI { PI } else { remainder }
}
