//! Poses, commands and odometry readings, as settings.

use super::settings::{DURATION_RANGE, QUANTITY_RANGE, group};
use crate::models::{OdomDelta, VelocityCmd};

// Each setting with a pose completes these phrases in its `each`.
group!([f64; 3] as [x, y, theta] => {
    /// Position x
    x: "m", in QUANTITY_RANGE;
    /// Position y
    y: "m", in QUANTITY_RANGE;
    /// Heading
    theta: "rad", in QUANTITY_RANGE;
});

group!(VelocityCmd as VelocityCmd { v, omega, dt } => {
    /// Commanded speed; negative in reverse.
    v: "m/s", in QUANTITY_RANGE;
    /// Commanded turn rate; positive to the left.
    omega: "rad/s", in QUANTITY_RANGE;
    /// Duration of the command.
    dt: "s", in DURATION_RANGE;
});

group!(OdomDelta as OdomDelta { rot1, trans, rot2 } => {
    /// First turn.
    rot1: "rad", in QUANTITY_RANGE;
    /// Drive.
    trans: "m", in 0.0..=*QUANTITY_RANGE.end();
    /// Second turn.
    rot2: "rad", in QUANTITY_RANGE;
});
