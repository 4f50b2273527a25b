//! Settings that consist of three numbers with names: poses, commands and odometry readings.

use super::{DURATION_RANGE, Declaration, QUANTITY_RANGE};
use std::ops::RangeInclusive;

/// Declaration of one of the three numbers of a [`Setting::Group`](super::Setting::Group).
pub struct GroupMember {
    /// Key, description and unit of the number.
    pub declaration: Declaration,
    /// Allowed range.
    pub allowed: RangeInclusive<f64>,
}

impl GroupMember {
    const fn new(
        number_key: &'static str,
        member_sentence: &'static str,
        number_unit: &'static str,
        allowed: RangeInclusive<f64>,
    ) -> Self {
        Self { declaration: Declaration::new(number_key, "", member_sentence, number_unit, ""), allowed }
    }
}

/// Members of a pose. A setting appends its own text to these descriptions, for example "of the robot after the command".
pub static POSE_MEMBERS: [GroupMember; 3] = [
    GroupMember::new("x", "Position x", "m", QUANTITY_RANGE),
    GroupMember::new("y", "Position y", "m", QUANTITY_RANGE),
    GroupMember::new("theta", "Heading", "rad", QUANTITY_RANGE),
];

pub static COMMAND_MEMBERS: [GroupMember; 3] = [
    GroupMember::new("v", "Commanded speed; negative in reverse.", "m/s", QUANTITY_RANGE),
    GroupMember::new("omega", "Commanded turn rate; positive to the left.", "rad/s", QUANTITY_RANGE),
    GroupMember::new("dt", "Duration of the command.", "s", DURATION_RANGE),
];

pub static READING_MEMBERS: [GroupMember; 3] = [
    GroupMember::new("rot1", "First turn.", "rad", QUANTITY_RANGE),
    GroupMember::new("trans", "Drive.", "m", 0.0..=*QUANTITY_RANGE.end()),
    GroupMember::new("rot2", "Second turn.", "rad", QUANTITY_RANGE),
];
