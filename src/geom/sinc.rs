//! The two quotients of the arc, without cancellation near 0.

/// Returns sinc(t) = sin(t)/t, with sinc(0) = 1. Correct to about 1.5 units in the last place for every t.
pub fn sinc(t: f64) -> f64 {
    // At the smallest t the quotient is already exactly 1; only 0 itself cannot be divided by.
    if t == 0.0 { 1.0 } else { libm::sin(t) / t }
}

/// (sin φ/φ, (1 − cos φ)/φ): where an arc of unit length that turns by φ ends. Without cancellation.
pub(crate) fn chord_factors(turn: f64) -> (f64, f64) {
    let half = 0.5 * turn;
    (sinc(turn), libm::sin(half) * sinc(half))
}
