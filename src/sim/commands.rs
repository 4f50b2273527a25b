//! Commands and odometry readings of a robot, as settings.

use super::settings::{DURATION, QUANTITY, group};
use crate::models::{OdomDelta, VelocityCmd};

group!(VelocityCmd as VelocityCmd { v, omega, dt } => {
    /// Commanded speed; negative in reverse.
    v: "m/s", in QUANTITY;
    /// Commanded turn rate; positive to the left.
    omega: "rad/s", in QUANTITY;
    /// Duration of the command.
    dt: "s", in DURATION;
});

group!(OdomDelta as OdomDelta { rot1, trans, rot2 } => {
    /// First turn.
    rot1: "rad", in QUANTITY;
    /// Drive.
    trans: "m", in 0.0..=*QUANTITY.end();
    /// Second turn.
    rot2: "rad", in QUANTITY;
});
