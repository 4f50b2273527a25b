//! What is wrong with every leg in the same way: found first, for the α's take everything else for noise.

use super::legs::Leg;
use super::model::{Observation, turn_slope};
use crate::geom::se2::SE2;
use nalgebra::{Matrix2, Matrix3, SMatrix, Vector3};

/// What the reference says of the odometry, apart from noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Systematic {
    /// s: a time by the reference's clock is that by the odometry's and this.
    pub clock_offset: f64,
    /// rad: the heading of the reference is that of the robot's base and this.
    pub mount_yaw: f64,
    /// m: the point that the reference follows, ahead of the base and to its left.
    pub lever_arm: [f64; 2],
    /// The true distance is that of the odometry times this.
    pub distance_scale: f64,
    /// The true turn is that of the odometry times this.
    pub turn_scale: f64,
}

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error {
    ClockOffset,
    MountYaw,
    LeverArmAhead,
    LeverArmLeft,
    DistanceScale,
    TurnScale,
}

/// How many there are.
pub const ERRORS: usize = 6;

impl Error {
    pub const ALL: [Self; ERRORS] = [
        Self::ClockOffset,
        Self::MountYaw,
        Self::LeverArmAhead,
        Self::LeverArmLeft,
        Self::DistanceScale,
        Self::TurnScale,
    ];

    /// What a log has to tell it to, as a standard deviation: otherwise it is not determined. An error as large would be seen without a
    /// log, and none smaller is hidden by leaving it alone.
    pub(super) fn largest_deviation(self) -> f64 {
        match self {
            Self::ClockOffset => 0.25,
            Self::MountYaw => 0.1,
            Self::LeverArmAhead | Self::LeverArmLeft => 0.25,
            Self::DistanceScale | Self::TurnScale => 0.05,
        }
    }
}

impl Systematic {
    /// Nothing is.
    pub const NONE: Self =
        Self { clock_offset: 0.0, mount_yaw: 0.0, lever_arm: [0.0; 2], distance_scale: 1.0, turn_scale: 1.0 };

    pub fn get(&self, error: Error) -> f64 {
        match error {
            Error::ClockOffset => self.clock_offset,
            Error::MountYaw => self.mount_yaw,
            Error::LeverArmAhead => self.lever_arm[0],
            Error::LeverArmLeft => self.lever_arm[1],
            Error::DistanceScale => self.distance_scale,
            Error::TurnScale => self.turn_scale,
        }
    }

    pub fn set(&mut self, error: Error, value: f64) {
        match error {
            Error::ClockOffset => self.clock_offset = value,
            Error::MountYaw => self.mount_yaw = value,
            Error::LeverArmAhead => self.lever_arm[0] = value,
            Error::LeverArmLeft => self.lever_arm[1] = value,
            Error::DistanceScale => self.distance_scale = value,
            Error::TurnScale => self.turn_scale = value,
        }
    }

    /// Where to begin: the yaw of a mount that is turned so far that no small steps lead there, by the ways of the legs as the odometry
    /// and the reference see them, longer ones counting for more. 0 of an ordinary one, and of logs that agree on no direction.
    pub(super) fn far_mount_yaw(legs: &[Leg]) -> f64 {
        let way = |[from, to]: &[SE2; 2]| {
            let motion = from.inverse() * *to;
            [motion.x(), motion.y()]
        };
        let (mut along, mut across, mut all) = (0.0, 0.0, 0.0);
        for leg in legs {
            let ([x, y], [seen_x, seen_y]) = (way(&leg.odometry), way(&leg.reference));
            along += x * seen_x + y * seen_y;
            across += y * seen_x - x * seen_y;
            all += libm::hypot(x, y) * libm::hypot(seen_x, seen_y);
        }
        let yaw = libm::atan2(across, along);
        if yaw.abs() > FAR_YAW && libm::hypot(along, across) > ONE_WAY * all { yaw } else { 0.0 }
    }

    /// The reference's frame in the base's.
    fn mount(&self) -> SE2 {
        SE2::new(self.lever_arm[0], self.lever_arm[1], self.mount_yaw)
    }

    /// Where the base is when the reference is at `pose`, in the frame of that.
    pub fn base(&self, pose: &SE2) -> SE2 {
        *pose * self.mount().inverse()
    }

    /// The motion of the base that the reference saw, in the frame of its beginning. The clock's offset is in the leg already.
    pub(super) fn motion(&self, leg: &Leg) -> SE2 {
        self.base(&leg.reference[0]).inverse() * self.base(&leg.reference[1])
    }

    /// The motion that the odometry read, with distances and turns as they really are.
    pub(super) fn expected(&self, leg: &Leg) -> SE2 {
        let read = leg.odometry[0].inverse() * leg.odometry[1];
        if self.distance_scale == 1.0 && self.turn_scale == 1.0 {
            return read;
        }
        let twist = read.log();
        SE2::exp(&Vector3::new(
            self.distance_scale * twist.x,
            self.distance_scale * twist.y,
            self.turn_scale * twist.z,
        ))
    }

    /// The covariance (m²) that where a leg ends has because clock and lever arm are not known better than by these
    /// `deviations`: a direction in which the robot hardly drove would otherwise be told by their errors.
    pub(super) fn uncertainty(&self, leg: &Leg, deviations: &[Option<f64>; ERRORS]) -> Matrix2<f64> {
        let slopes = self.motion_slopes(leg, &self.expected(leg));
        [Error::ClockOffset, Error::LeverArmAhead, Error::LeverArmLeft]
            .into_iter()
            .filter_map(|error| {
                let off = slopes.fixed_view::<2, 1>(0, error as usize) * deviations[error as usize]?;
                Some(off * off.transpose())
            })
            .sum()
    }

    /// By how much more a leg's motion is off, for each second of the clock's offset: a clock that is early takes the velocity before an end
    /// for that at it, and one that is late the one after it. Where a robot starts, stops or turns off that is no slope but a kink, by
    /// which no leg tells the sign of the offset: it is an error of the leg.
    pub(super) fn kink(&self, leg: &Leg) -> Vector3<f64> {
        later(leg.kinks, &self.expected(leg))
    }

    /// How much of the variance of its noise a leg has because the clock is not known better than by its deviation: noise comes on the way,
    /// and a clock that is off by a share s of the leg's time takes that share of a neighbour's for as much of its own, (1 − s)² + s² in all.
    pub(super) fn own_share(&self, leg: &Leg, deviations: &[Option<f64>; ERRORS]) -> f64 {
        let deviation = deviations[Error::ClockOffset as usize].unwrap_or(0.0) / leg.duration();
        // The mean over a normal s; of a clock of which no more is known than a leg's time, none.
        (1.0 - 2.0 * MEAN_SIZE * deviation + 2.0 * deviation * deviation).min(1.0)
    }

    /// How the residuals of a leg change with each of [`Error::ALL`], of a leg that went as was read.
    ///
    /// It is taken at what was read, not at what the reference saw: it then has nothing of the leg's noise, and what is found is
    /// not drawn to where the noise happens to be smaller.
    fn slopes(&self, leg: &Leg, observation: &Observation) -> SMatrix<f64, 3, ERRORS> {
        observation.slopes * self.motion_slopes(leg, &observation.expected)
    }

    /// The covariance that the residuals of a leg have because the errors that were `removed` are known no better, J(Σ JᵀWJ)⁻¹Jᵀ.
    pub(super) fn unknown(
        &self,
        leg: &Leg,
        observation: &Observation,
        known: &Square,
        removed: &Which,
    ) -> Matrix3<f64> {
        let mut slopes = self.slopes(leg, observation);
        for (mut column, _) in slopes.column_iter_mut().zip(removed).filter(|(_, removed)| !**removed) {
            column.fill(0.0);
        }
        slopes * SMatrix::from(*known) * slopes.transpose()
    }

    /// How the motion that the reference saw, less the one that was read, changes.
    fn motion_slopes(&self, leg: &Leg, read: &SE2) -> SMatrix<f64, 3, ERRORS> {
        let (sin, cos) = libm::sincos(read.theta());
        let (x, y) = (read.x(), read.y());
        let twist = read.log();
        SMatrix::from_columns(&[
            later(leg.velocities, read),
            Vector3::new(-y, x, 0.0),
            Vector3::new(1.0 - cos, -sin, 0.0),
            Vector3::new(sin, 1.0 - cos, 0.0),
            -Vector3::new(x, y, 0.0) / self.distance_scale,
            -turn_slope(&twist, read) * (twist.z / self.turn_scale),
        ])
    }
}

/// How a motion changes where both its ends are a little later, with these velocities at them.
fn later([start, end]: [Vector3<f64>; 2], read: &SE2) -> Vector3<f64> {
    let (sin, cos) = libm::sincos(read.theta());
    Vector3::new(
        cos * end.x - sin * end.y - start.x + start.z * read.y(),
        sin * end.x + cos * end.y - start.y - start.z * read.x(),
        end.z - start.z,
    )
}

/// Which of [`Error::ALL`].
pub type Which = [bool; ERRORS];

/// Six by six.
pub(super) type Square = [[f64; ERRORS]; ERRORS];

/// What a step of least squares says of the systematic errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// By how much each is to be changed; 0 of those that are not determined.
    pub change: [f64; ERRORS],
    /// The standard deviation of each; None of those that the log does not determine.
    pub deviations: [Option<f64>; ERRORS],
    /// (Σ JᵀWJ)⁻¹, 0 for those that are not determined.
    pub inverse: Square,
}

/// The sums of a step over all legs, with the weights of the residuals, 1 over their variances: Σ JᵀWJ, and of g = −JᵀWr the sum
/// and the squares.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeastSquares {
    /// (Σ JᵀWJ)⁻¹ of the step before.
    known: Square,
    information: Square,
    pull: [f64; ERRORS],
    scatter: Square,
}

/// What a leg adds to what is known is at most nine tenths of that.
pub(super) const MOST_LEVERAGE: f64 = 0.9;

/// √(2/π), the mean size of a normal number by its deviation.
const MEAN_SIZE: f64 = 0.797_884_560_802_865_4;

/// From so many rad steps may not lead back to the yaw of a mount: directions go round.
const FAR_YAW: f64 = 0.5;

/// How much longer the sum of all ways is than it would be by chance, as a share: logs of a few hundred legs of other drives have a twentieth.
const ONE_WAY: f64 = 0.5;

impl LeastSquares {
    /// Nothing, after a step whose `inverse` was this.
    pub fn after(known: Square) -> Self {
        let none = [[0.0; ERRORS]; ERRORS];
        Self { known, information: none, pull: [0.0; ERRORS], scatter: none }
    }

    /// With one more leg. A leg that by itself says much of an error draws that to itself, and its residual is too small: for the
    /// scatter it is what it would be without it, over 1 − h, h being its leverage (MacKinnon and White's HC3).
    pub fn add(&mut self, systematic: &Systematic, leg: &Leg, observation: &Observation, weights: [f64; 3]) {
        let slopes = systematic.slopes(leg, observation);
        let (mut pull, mut leverage) = ([0.0; ERRORS], 0.0);
        for (kind, (residual, weight)) in observation.first_order.iter().zip(weights).enumerate() {
            if residual.is_nan() || weight == 0.0 {
                continue;
            }
            let row: [f64; ERRORS] = std::array::from_fn(|i| slopes[(kind, i)]);
            for i in 0..ERRORS {
                let mut known = 0.0;
                for j in 0..ERRORS {
                    self.information[i][j] += weight * row[i] * row[j];
                    known += self.known[i][j] * row[j];
                }
                leverage += weight * row[i] * known;
                pull[i] -= weight * residual * row[i];
            }
        }
        let alone = 1.0 / (1.0 - leverage.min(MOST_LEVERAGE));
        for i in 0..ERRORS {
            self.pull[i] += pull[i];
            for j in 0..ERRORS {
                self.scatter[i][j] += alone * alone * pull[i] * pull[j];
            }
        }
    }

    /// The step, in which what the log does not determine stays as it is.
    ///
    /// The information is inverted error by error, the best determined first, by Gauss and Jordan's sweeps: when the best of those that
    /// are left, the others being unknown too, has a larger deviation than [`Error::largest_deviation`], they are not
    /// determined.
    pub fn step(&self) -> Step {
        let mut swept = self.information;
        let mut chosen = [false; ERRORS];
        loop {
            let next = (0..ERRORS)
                .filter(|i| !chosen[*i])
                .map(|i| {
                    (i, swept[i][i] * Error::ALL[i].largest_deviation() * Error::ALL[i].largest_deviation())
                })
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((pivot, _)) = next.filter(|(_, known)| *known > 1.0) else { break };
            chosen[pivot] = true;
            sweep(&mut swept, pivot);
        }
        // Of weights that are worlds apart rounding may leave a variance of less than nothing: that determines nothing.
        let known: Which = std::array::from_fn(|i| chosen[i] && swept[i][i] > 0.0);
        let inverse: Square = std::array::from_fn(|i| {
            std::array::from_fn(|j| if known[i] && known[j] { swept[i][j] } else { 0.0 })
        });
        let times = |vector: [f64; ERRORS], row: [f64; ERRORS]| -> f64 {
            (0..ERRORS).map(|i| row[i] * vector[i]).sum()
        };
        let covariance = |i: usize| {
            let scattered: [f64; ERRORS] = std::array::from_fn(|j| times(inverse[i], self.scatter[j]));
            times(inverse[i], scattered)
        };
        Step {
            change: std::array::from_fn(|i| times(self.pull, inverse[i])),
            // By the scatter of the legs, whatever their noise is, but not below what their noise says.
            deviations: std::array::from_fn(|i| known[i].then(|| covariance(i).max(inverse[i][i]).sqrt())),
            inverse,
        }
    }
}

/// Inverts a symmetric matrix in one of its variables. In one place: it is long code.
#[inline(never)]
pub(super) fn sweep(matrix: &mut Square, pivot: usize) {
    let size = matrix[pivot][pivot];
    let row = matrix[pivot].map(|entry| entry / size);
    for (i, each) in matrix.iter_mut().enumerate() {
        let factor = each[pivot];
        if i == pivot {
            *each = row;
        } else {
            each.iter_mut().zip(row).for_each(|(entry, of_row)| *entry -= factor * of_row);
        }
        each[pivot] = if i == pivot { 1.0 / size } else { -factor / size };
    }
}

/// Inverts a symmetric matrix in those of its variables that are known for themselves; which these are.
pub(super) fn inverted(information: &Square) -> ([bool; 6], Square) {
    let (mut swept, mut known) = (*information, [false; 6]);
    for i in 0..6 {
        // Less than that is what rounding leaves of nothing.
        known[i] = swept[i][i] > 1e-9 * information[i][i];
        if known[i] {
            sweep(&mut swept, i);
        }
    }
    (known, swept)
}
