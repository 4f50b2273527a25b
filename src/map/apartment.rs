//! Floor plan of an apartment, the initial map of the Map Squeeze widget.

use crate::geom::segment::Segment;

pub(super) const APARTMENT_BOUNDS: [f64; 4] = [0.0, 0.0, 12.0, 9.0];

/// Walls of the apartment, m. They are constant data, because code that creates them one by one would take twice as many bytes.
pub(super) static WALLS: [Segment; 18] = [
    wall(0.0, 0.0, 12.0, 0.0),
    wall(12.0, 0.0, 12.0, 9.0),
    wall(12.0, 9.0, 0.0, 9.0),
    wall(0.0, 9.0, 0.0, 0.0),
    wall(0.0, 3.8, 1.6, 3.8),
    wall(2.5, 3.8, 5.5, 3.8),
    wall(6.5, 3.8, 9.5, 3.8),
    wall(10.4, 3.8, 12.0, 3.8),
    wall(0.0, 5.0, 2.8, 5.0),
    wall(3.7, 5.0, 7.4, 5.0),
    wall(8.3, 5.0, 12.0, 5.0),
    wall(4.0, 0.0, 4.0, 3.8),
    wall(8.0, 0.0, 8.0, 3.8),
    wall(6.0, 5.0, 6.0, 9.0),
    wall(4.0, 1.4, 6.2, 1.4),
    wall(2.0, 7.6, 2.0, 9.0),
    wall(9.6, 7.4, 9.6, 9.0),
    wall(9.6, 7.4, 10.9, 7.4),
];

const fn wall(x0: f64, y0: f64, x1: f64, y1: f64) -> Segment {
    Segment { from: [x0, y0], to: [x1, y1] }
}
