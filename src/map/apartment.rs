//! The apartment of the Map Squeeze widget.

/// Least x, least y, greatest x, greatest y, m.
pub(super) const BOUNDS: [f64; 4] = [0.0, 0.0, 12.0, 9.0];

/// Walls as x, y, x, y from end to end, m.
pub(super) const WALLS: [[f64; 4]; 18] = [
    // The shell.
    [0.0, 0.0, 12.0, 0.0],
    [12.0, 0.0, 12.0, 9.0],
    [12.0, 9.0, 0.0, 9.0],
    [0.0, 9.0, 0.0, 0.0],
    // The corridor's lower wall, with three doorways.
    [0.0, 3.8, 1.6, 3.8],
    [2.5, 3.8, 5.5, 3.8],
    [6.5, 3.8, 9.5, 3.8],
    [10.4, 3.8, 12.0, 3.8],
    // The corridor's upper wall, with two doorways.
    [0.0, 5.0, 2.8, 5.0],
    [3.7, 5.0, 7.4, 5.0],
    [8.3, 5.0, 12.0, 5.0],
    // Between the rooms below and those above.
    [4.0, 0.0, 4.0, 3.8],
    [8.0, 0.0, 8.0, 3.8],
    [6.0, 5.0, 6.0, 9.0],
    // A counter, a closet's side, a bathroom's corner.
    [4.0, 1.4, 6.2, 1.4],
    [2.0, 7.6, 2.0, 9.0],
    [9.6, 7.4, 9.6, 9.0],
    [9.6, 7.4, 10.9, 7.4],
];
