//! Quotients sin t/t and (1 − cos t)/t of arcs, without cancellation near 0.

/// Returns sinc(t) = sin(t)/t, with sinc(0) = 1. The result is correct to about 1.5 units in the last place for every t.
pub fn sinc(t: f64) -> f64 {
    if t == 0.0 { 1.0 } else { libm::sin(t) / t }
}

/// Returns the end point (sin φ/φ, (1 − cos φ)/φ) of an arc of length 1 that turns by φ, without cancellation.
pub(crate) fn unit_arc_end(turn: f64) -> (f64, f64) {
    let half_turn = 0.5 * turn;
    let sin = libm::sin(half_turn);
    (sinc(turn), if half_turn == 0.0 { sin } else { sin * (sin / half_turn) })
}
