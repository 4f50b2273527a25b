//! Angles on the circle.

use std::f64::consts::{PI, TAU};

/// Returns the representative of `angle` in (−π, π], radians.
///
/// The result is exact for |angle| ≤ π. For larger angles the remainder is taken against the double nearest to 2π, so that the result
/// has an error of about 1.2e-16 · |angle|. NaN and infinities give NaN.
#[inline(always)]
pub fn wrap_angle(angle: f64) -> f64 {
    if -PI < angle && angle <= PI { angle } else { wrap_far_angle(angle) }
}

#[inline(never)]
fn wrap_far_angle(angle: f64) -> f64 {
    // `libm::remainder` returns a value in [−π, π]. The value −π becomes π.
    let wrapped_angle = libm::remainder(angle, TAU);
    if wrapped_angle == -PI { PI } else { wrapped_angle }
}
