//! Parts of the 2σ ellipse in (x, y) where no robot stops.

use super::{BananaMachine, OUTLINE_SEGMENTS};
use crate::geom::arc::arc_with_turn_near;
use crate::geom::se2::SE2;
use crate::sim::cloud::START_POSE;
use crate::stats::{Ellipse, ExponentialContour};

/// Minimum area ratio for gaps. Below it the outlines nearly coincide.
const MIN_AREA_RATIO: f64 = 1.15;

/// Minimum Mahalanobis distance of a gap from the mean in exponential coordinates. One robot in 900 stops beyond it.
const MIN_GAP_DISTANCE: f64 = 3.7;

/// Fraction of the way from the centre of the ellipse to its boundary: a point there is clearly inside.
const GAP_FRACTION: f64 = 0.95;

impl BananaMachine {
    /// Returns up to two points (x, y) in m that are inside the 2σ ellipse, and where no robot stops. One is nearer than the mean and
    /// the other beyond it. Each is the point of its side with the largest distance in exponential coordinates.
    pub fn gaps(&self) -> Vec<[f64; 2]> {
        let Self { stats, .. } = self;
        if stats.area_ratio.is_nan() || stats.area_ratio < MIN_AREA_RATIO {
            return Vec::new();
        }
        let plane_ellipse = Ellipse::from_moments(&stats.cartesian);
        let contour = ExponentialContour::new(&stats.exponential, &START_POSE);
        let twist_mean = stats.exponential.mean;
        let gap_candidates: Vec<_> = plane_ellipse
            .boundary(OUTLINE_SEGMENTS)
            .into_iter()
            .map(|point| {
                let [x, y] = plane_ellipse.interpolate_from_centre(point, GAP_FRACTION);
                let (length, turn) = arc_with_turn_near(&START_POSE, &SE2::new(x, y, 0.0), twist_mean.z);
                ([x, y], contour.ellipse.mahalanobis_distance([length, turn]), length < twist_mean.x)
            })
            .filter(|(_, distance, _)| *distance > MIN_GAP_DISTANCE)
            .collect();
        let furthest_candidate = |is_near_side: bool| {
            let side_candidates =
                gap_candidates.iter().filter(|(_, _, is_before)| *is_before == is_near_side);
            side_candidates.max_by(|(_, a, _), (_, b, _)| a.total_cmp(b))
        };
        let mut gaps: Vec<_> = [true, false].into_iter().filter_map(furthest_candidate).collect();
        gaps.sort_by(|(_, a, _), (_, b, _)| b.total_cmp(a));
        gaps.into_iter().map(|(point, _, _)| *point).collect()
    }
}
