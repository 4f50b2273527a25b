//! The two pictures of a cloud, and what is asked of them: where is it dense, which sample is nearest.

use crate::geom::se2::SE2;
use nalgebra::Vector3;
use std::collections::TryReserveError;

/// A picture of the cloud.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Positions (x, y), m.
    Plane,
    /// Exponential coordinates (along, heading), m and rad.
    Twist,
}

impl View {
    /// Where a sample stands in the picture.
    pub fn point(self, pose: &SE2, twist: &Vector3<f64>) -> [f64; 2] {
        match self {
            Self::Plane => [pose.x(), pose.y()],
            Self::Twist => [twist.x, twist.z],
        }
    }
}

/// A rectangle of a view divided into cells of equal size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Least and greatest coordinates, finite, each least below its greatest.
    pub min: [f64; 2],
    pub max: [f64; 2],
    pub columns: usize,
    pub rows: usize,
}

/// How many points lie in each cell, row by row from the top (greatest second coordinate). Points outside count nowhere.
///
/// # Errors
/// Where memory does not suffice for the cells.
pub fn density(points: impl Iterator<Item = [f64; 2]>, grid: &Grid) -> Result<Vec<u32>, TryReserveError> {
    let cells = grid.columns * grid.rows;
    let mut counts = Vec::new();
    counts.try_reserve_exact(cells)?;
    counts.resize(cells, 0);
    let columns_per_unit = grid.columns as f64 / (grid.max[0] - grid.min[0]);
    let rows_per_unit = grid.rows as f64 / (grid.max[1] - grid.min[1]);
    for [x, y] in points {
        let column = (x - grid.min[0]) * columns_per_unit;
        let row = (grid.max[1] - y) * rows_per_unit;
        if column >= 0.0 && row >= 0.0 && column < grid.columns as f64 && row < grid.rows as f64 {
            counts[row as usize * grid.columns + column as usize] += 1;
        }
    }
    Ok(counts)
}

/// The index of the point nearest to `target` among those inside the ellipse of the given radii around it, distances
/// counted in those radii.
pub fn nearest(points: impl Iterator<Item = [f64; 2]>, target: [f64; 2], radii: [f64; 2]) -> Option<usize> {
    points
        .map(|[x, y]| {
            let (dx, dy) = ((x - target[0]) / radii[0], (y - target[1]) / radii[1]);
            dx * dx + dy * dy
        })
        .enumerate()
        .filter(|(_, distance)| *distance <= 1.0)
        .min_by(|(_, a), (_, b)| a.total_cmp(b))
        .map(|(index, _)| index)
}
