//! Gate that sets outliers aside, as where the reference jumped: they are listed, and the fit goes on without them.

use super::likelihood::Standardized;

/// Quantiles 0.9999 of χ² with 1, 2 and 3 degrees of freedom.
const GATES: [f64; 3] = [15.137, 18.421, 21.108];

/// Returns whether an innovation is outside of the gate, whose squared distance is multiplied by `factor`.
pub(super) fn is_outlier(innovation: &Standardized, factor: f64) -> bool {
    innovation.observed > 0 && innovation.squared > factor * GATES[innovation.observed - 1]
}
