//! What a leg says of the α's: how far the robot was from where the reading (or the command) says, and which α's answer for
//! that.

use super::legs::Leg;
use super::likelihood::{Alphas, LegDensity};
use super::systematic::{MOST_LEVERAGE, Systematic};
use crate::geom::arc::invert_arc;
use crate::geom::se2::{SE2, wrap_angle};
use crate::geom::sinc::sinc;
use crate::models::{LegVariances, OdomDelta, OdometryRule, RuleAlphas, SPIN_BELOW};
use nalgebra::{Matrix2, Matrix3, RowVector3, Vector2, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};

/// The model whose α's are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// Of odometry readings, by the bookkeeping of this rule: four α's, under [`OdometryRule::Omni`] five.
    Odometry(OdometryRule),
    /// Of velocity commands: six.
    Velocity,
}

/// One of the three noises of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kind {
    /// Its name in the tables.
    pub name: &'static str,
    /// The α's in its variance, from 0.
    pub alphas: [usize; 2],
}

const fn kind(name: &'static str, first: usize, second: usize) -> Kind {
    Kind { name, alphas: [first, second] }
}

const HINGED: [Kind; 3] = [kind("rot1", 0, 1), kind("trans", 2, 3), kind("rot2", 0, 1)];
const SLIDING: [Kind; 3] = [kind("rot2", 0, 1), kind("trans", 2, 3), kind("strafe", 4, 3)];
const DRIVEN: [Kind; 3] = [kind("v", 0, 1), kind("omega", 2, 3), kind("gamma", 4, 5)];

/// The three residuals of a leg, each executed less expected, and what their variances are made of. A leg that does not tell
/// one of them has NaN there, and nothing in its variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// In a [`Calibration`](super::Calibration) without the systematic errors as all other legs tell them.
    pub residuals: [f64; 3],
    /// The same with directions as they are to first order, across the drive over its length: where the robot hardly went anywhere,
    /// the direction itself is that of the smallest systematic error.
    pub first_order: [f64; 3],
    /// The same by the other way to the same pose, backwards and turned about, where that might be meant.
    pub other_way: Option<[f64; 3]>,
    /// What the two α's of each kind are multiplied by in its variance, 0 or more. In a [`Calibration`](super::Calibration) less what a
    /// clock that is not known for sure takes of a leg's own noise.
    pub coefficients: [[f64; 2]; 3],
    /// The part of each variance that is the reference's own error.
    pub floors: [f64; 3],
    /// Variances that the residuals have besides, because the other legs know the systematic errors that were removed no better. Of
    /// the noise's kinds it is normal.
    pub unknown: [f64; 3],
    /// What the model says of the leg: rot1, trans, rot2 (rad, m, rad); or v, ω, Δt (m/s, rad/s, s).
    pub reading: [f64; 3],
    /// The motion that the model expects.
    pub expected: SE2,
    /// How the residuals change with the base's motion: rows of kinds, columns x, y, θ.
    pub slopes: Matrix3<f64>,
}

/// What would pass for an α of a hundredth by itself hides the noise of a leg.
const HIDING: f64 = 0.01;

impl Observation {
    /// Without its residuals, where one of them is rather that of an error of the base's motion as large as this (x, y, θ) than of any
    /// noise: a robot that hardly moves, between legs in which it does, shows no more than that its clock is not known to a millisecond.
    pub(super) fn hide(&mut self, error: &Vector3<f64>) {
        let sizes = self.slopes * error;
        let hides =
            |kind: usize| sizes[kind] * sizes[kind] > HIDING * self.coefficients[kind].iter().sum::<f64>();
        if (0..3).any(|kind| !self.residuals[kind].is_nan() && hides(kind)) {
            self.residuals = [f64::NAN; 3];
            self.first_order = [f64::NAN; 3];
            self.other_way = None;
            self.coefficients = [[0.0; 2]; 3];
        }
    }

    /// With residuals as they would be had this leg not been among those that told the errors which were removed. A fit draws itself to
    /// what it is fitted to; of the residuals r that it leaves, with weights W and S the covariance that those errors, as all legs know
    /// them, give them (`unknown`), the others alone would leave (1 − S W)⁻¹ r, and know them by (1 − S W)⁻¹ S.
    pub(super) fn by_the_others(&mut self, unknown: &Matrix3<f64>, weights: [f64; 3]) {
        let shares = unknown * Matrix3::from_diagonal(&weights.into());
        let most = (MOST_LEVERAGE / shares.trace()).min(1.0);
        // Its eigenvalues are between 0 and nine tenths, unless the leg is not of this world.
        let Some(back) = (Matrix3::identity() - shares * most).try_inverse() else { return };
        let known = (back * unknown).diagonal();
        if !known.iter().all(|variance| variance.is_finite()) {
            return;
        }
        self.unknown = known.into();
        for residuals in std::iter::once(&mut self.residuals).chain(&mut self.other_way) {
            // What is not told has no part in it.
            let told =
                Vector3::from(residuals.map(|residual| if residual.is_nan() { 0.0 } else { residual }));
            let freed = back * told;
            for (residual, freed) in
                residuals.iter_mut().zip(&freed).filter(|(residual, _)| !residual.is_nan())
            {
                *residual = *freed;
            }
        }
    }
}

/// How well it is known where a leg really ended, seen from its beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Uncertainty {
    /// The covariance of its end, m².
    pub place: Matrix2<f64>,
    /// The same for its direction, with what is left uncertain of clock and lever arm: of a leg that hardly leads anywhere the direction
    /// is theirs. What they are off by along the way was fitted to the same residuals, and makes these smaller, not greater.
    pub bearing: Matrix2<f64>,
    /// The variances of the headings at both ends, rad², independent.
    pub headings: [f64; 2],
    /// The α's as far as they are known, 0 before that: they tell how much of what a leg is too long is the robot's own.
    pub alphas: Alphas,
}

impl Uncertainty {
    /// The variance of a turn, rad².
    fn of_turn(&self) -> f64 {
        self.headings[0] + self.headings[1]
    }

    /// The variance along a direction, m².
    fn along(&self, direction: f64) -> f64 {
        variance_along(&self.place, direction)
    }

    /// What a motion says that leads so far toward a bearing, of a leg that should have led as far as was read and whose way varies by so much
    /// (m²) by the α's. Of a way t whose end is off by σ each way, the distance d has Rice's distribution, σ²/2t longer and of variance
    /// σ²(1 − σ²/2t²) to second order, where it leads; and given that, the bearing has von Mises' of κ = dt/σ², and the variance (1 + 1/2κ)/κ.
    fn polar(&self, bearing: f64, distance: f64, read: f64, variance: f64) -> Polar {
        let place = self.along(bearing);
        let blurred = place > 0.0 && read > LEADS * place.sqrt();
        // And the part that is the robot's own of what it is too long.
        let (longer, own) =
            if blurred { (place / (2.0 * read), 1.0 / (1.0 + place / variance)) } else { (0.0, 1.0) };
        let way = read + own * (distance - read);
        let off = variance_along(&self.bearing, bearing + FRAC_PI_2) / (distance * way);
        Polar {
            distance: distance - longer,
            of_distance: if blurred { place * (1.0 - longer / read) } else { place },
            // At most that of a direction of which nothing is known.
            of_bearing: (off * (1.0 + 0.5 * off)).min(PI * PI / 3.0),
        }
    }
}

/// How far a motion led, m, and the variances of that, m², and of its direction, rad², that are none of the robot's.
struct Polar {
    distance: f64,
    of_distance: f64,
    of_bearing: f64,
}

fn variance_along(covariance: &Matrix2<f64>, direction: f64) -> f64 {
    let (sin, cos) = libm::sincos(direction);
    let toward = Vector2::new(cos, sin);
    // Of nothing rounding may leave less.
    (covariance * toward).dot(&toward).max(0.0)
}

impl Model {
    /// How many α's it has.
    pub fn alphas(self) -> usize {
        match self {
            Self::Odometry(OdometryRule::Omni) => 5,
            Self::Odometry(_) => 4,
            Self::Velocity => 6,
        }
    }

    /// Its noises, in the order of [`Observation::residuals`].
    pub fn kinds(self) -> &'static [Kind; 3] {
        match self {
            Self::Odometry(OdometryRule::Omni) => &SLIDING,
            Self::Odometry(_) => &HINGED,
            Self::Velocity => &DRIVEN,
        }
    }

    /// Whether an α, from 0, is multiplied by a turn (or ω) in its variance; otherwise it is by a way (or v).
    pub fn grows_with_turn(self, alpha: usize) -> bool {
        match self {
            Self::Odometry(_) => [0, 3].contains(&alpha),
            Self::Velocity => alpha % 2 == 1,
        }
    }

    /// What a leg says, once what is systematic about it is removed.
    ///
    /// The variance of each residual is that which the model gives the reading, as its sampler and
    /// [`crate::MotionModel::pose_density`] have it. Of the two combinations of legs that lead to each pose, facing it or facing
    /// away from it, the one with the nearer bearing is taken; under the printed table a robot that backs up is charged with two
    /// half turns, and its noise is so large that the other one may be meant.
    ///
    /// Where a leg has not driven a centimetre, or three deviations of the reference's error, its direction is that of its noise: it tells no first
    /// rotation, and its second is the turn as a whole; of a command that drives so little only the speed is told.
    pub fn observe(self, leg: &Leg, systematic: &Systematic, error: &Uncertainty) -> Observation {
        let expected = systematic.expected(leg);
        let motion = systematic.motion(leg);
        match self {
            Self::Odometry(OdometryRule::Omni) => slid(&expected, &motion, error),
            Self::Odometry(rule) => hinged(rule, &expected, &motion, error),
            Self::Velocity => driven(leg.duration(), &expected, &motion, error),
        }
    }
}

impl Model {
    /// The weights of [`Observation::first_order`]: 1 over their variances, by what the systematic errors do not add; less of a leg that
    /// may be bad.
    pub(super) fn weights(self, observation: &Observation, density: &LegDensity) -> [f64; 3] {
        let variances = std::array::from_fn(|k| {
            let own = |all: f64| (all - observation.unknown[k]).max((1.0 - MOST_LEVERAGE) * all);
            density.variances[k].map_or(0.0, own)
        });
        self.first_order_variances(observation, variances)
            .map(|variance| if variance > 0.0 { (1.0 - density.bad) / variance } else { 0.0 })
    }

    /// The variances of [`Observation::first_order`], where those of its residuals are these: what is across the drive over the length
    /// that was read varies with the length that was driven too, E\[t̂²\] = t² + σ².
    fn first_order_variances(self, observation: &Observation, variances: [f64; 3]) -> [f64; 3] {
        let (length, direction) = match self {
            Self::Odometry(OdometryRule::Omni) => return variances,
            Self::Odometry(_) => (1, 0),
            Self::Velocity => (0, 1),
        };
        if observation.residuals[direction].is_nan() {
            return variances;
        }
        let read = observation.reading[length];
        let added = variances[direction] * variances[length] / (read * read);
        let mut first_order = variances;
        first_order[direction] += added;
        first_order[2] += added;
        first_order
    }
}

/// What each of five α's adds to the variances by itself: they are linear in them.
fn alone(rule: OdometryRule, reading: &OdomDelta) -> [LegVariances; 5] {
    std::array::from_fn(|alpha| {
        let mut alphas: RuleAlphas = [0.0; 5];
        alphas[alpha] = 1.0;
        rule.variances(reading, &alphas)
    })
}

fn hinged(rule: OdometryRule, expected: &SE2, motion: &SE2, error: &Uncertainty) -> Observation {
    let read = OdomDelta::from_poses(&SE2::identity(), expected);
    let OdomDelta { rot1, trans, rot2 } = rule.legs(&read);
    let alone = alone(rule, &read);
    let first = [0, 1].map(|alpha: usize| alone[alpha].rot1.0);
    let along = [2, 3].map(|alpha: usize| alone[alpha].trans.0);
    let second = [0, 1].map(|alpha: usize| alone[alpha].rot2.0);
    let reading = [rot1, trans, rot2];
    let (sin, cos) = libm::sincos(rot1);
    let drive = RowVector3::new(cos, sin, 0.0);
    let place = error.along(rot1);
    let turned = wrap_angle(motion.theta() - rot1 - rot2);
    if read.trans < shortest(place) {
        let residuals = [f64::NAN, cos * motion.x() + sin * motion.y() - trans, turned];
        return Observation {
            residuals,
            first_order: residuals,
            other_way: None,
            unknown: [0.0; 3],
            coefficients: [[0.0; 2], along, [first[0] + second[0], first[1] + second[1]]],
            floors: [0.0, place, error.of_turn()],
            reading,
            expected: *expected,
            slopes: Matrix3::from_rows(&[RowVector3::zeros(), drive, RowVector3::new(0.0, 0.0, 1.0)]),
        };
    }
    let [bearing, distance] = [libm::atan2(motion.y(), motion.x()), libm::hypot(motion.x(), motion.y())];
    let variance = along[0] * error.alphas[2] + along[1] * error.alphas[3];
    let Polar { distance, of_distance, of_bearing } = error.polar(bearing, distance, trans, variance);
    let off = wrap_angle(bearing - rot1);
    let facing = [off, distance - trans, wrap_angle(turned - off)];
    let away = [wrap_angle(off - PI), -distance - trans, wrap_angle(turned - off + PI)];
    let [residuals, other] = if off.abs() > FRAC_PI_2 { [away, facing] } else { [facing, away] };
    // In a leg that leads ahead the other way would be an error of a half turn, twice.
    let other_way = (rule == OdometryRule::Table && rot1.abs() > FRAC_PI_2).then_some(other);
    let across = RowVector3::new(-sin, cos, 0.0) / trans;
    let off = across.x * motion.x() + across.y * motion.y();
    let bearing_error = error.headings[0] + of_bearing;
    Observation {
        residuals,
        first_order: [off, residuals[1], wrap_angle(turned - off)],
        other_way,
        unknown: [0.0; 3],
        coefficients: [first, along, second],
        floors: [bearing_error, of_distance, bearing_error],
        reading,
        expected: *expected,
        slopes: Matrix3::from_rows(&[across, drive, RowVector3::new(0.0, 0.0, 1.0) - across]),
    }
}

/// A leg that drives less has no direction: by the rules, or because that is lost in the variance (m²) of where it ends.
fn shortest(place: f64) -> f64 {
    SPIN_BELOW.max(LEADS * place.sqrt())
}

/// So many deviations of a place away its direction errs as much as its variance says; nearer it is that of the error, and the
/// distance is too long.
const LEADS: f64 = 3.0;

/// A robot that slides has no hinge: its bearing is what was read.
fn slid(expected: &SE2, motion: &SE2, error: &Uncertainty) -> Observation {
    let read = OdomDelta::from_poses(&SE2::identity(), expected);
    let OdomDelta { rot1, trans, rot2 } = read;
    let alone = alone(OdometryRule::Omni, &read);
    let (sin, cos) = libm::sincos(rot1);
    let residuals = [
        wrap_angle(motion.theta() - rot1 - rot2),
        cos * motion.x() + sin * motion.y() - trans,
        cos * motion.y() - sin * motion.x(),
    ];
    Observation {
        residuals,
        first_order: residuals,
        other_way: None,
        unknown: [0.0; 3],
        coefficients: [
            [alone[0].rot2.0, alone[1].rot2.0],
            [alone[2].trans.0, alone[3].trans.0],
            [alone[4].strafe.0, alone[3].strafe.0],
        ],
        floors: [
            error.of_turn(),
            error.along(rot1),
            error.along(rot1 + FRAC_PI_2) + trans * trans * error.headings[0],
        ],
        reading: [rot1, trans, rot2],
        expected: *expected,
        slopes: Matrix3::new(0.0, 0.0, 1.0, cos, sin, 0.0, -sin, cos, 0.0),
    }
}

/// The command, constant all through the leg, that leads where the odometry (or what was commanded in it) says, and the arc that was
/// driven instead. Sideways a command leads nowhere.
fn driven(dt: f64, read: &SE2, motion: &SE2, error: &Uncertainty) -> Observation {
    let twist = read.log();
    let expected = SE2::exp(&Vector3::new(twist.x, 0.0, twist.z));
    let [length, turn] = [twist.x, twist.z];
    let [v, omega] = [length / dt, turn / dt];
    let half = 0.5 * turn;
    // By whichever way the chord leads.
    let distance = length * sinc(half);
    let (sin, cos) = libm::sincos(half);
    let along = RowVector3::new(cos, sin, 0.0) / sinc(half);
    let place = error.along(half);
    let per_time = 1.0 / (dt * dt);
    let [v2, omega2] = [v * v, omega * omega];
    if length.abs() < shortest(place) {
        let v_hat = (cos * motion.x() + sin * motion.y()) / sinc(half) / dt;
        let residuals = [v_hat - v, f64::NAN, f64::NAN];
        return Observation {
            residuals,
            first_order: residuals,
            other_way: None,
            unknown: [0.0; 3],
            coefficients: [[v2, omega2], [0.0; 2], [0.0; 2]],
            floors: [place * per_time, 0.0, 0.0],
            reading: [v, omega, dt],
            expected,
            slopes: Matrix3::from_rows(&[along / dt, RowVector3::zeros(), RowVector3::zeros()]),
        };
    }
    let executed = invert_arc(&SE2::identity(), motion, dt);
    let bearing = RowVector3::new(-sin, cos, 0.0) / distance;
    // v̂Δt = d/sinc β, and d(ln sinc)/dβ = cot β − 1/β.
    let log_slope = if half.abs() < 1e-4 { -half / 3.0 } else { cos / sin - 1.0 / half };
    let variance = (v2 * error.alphas[0] + omega2 * error.alphas[1]) * dt * dt;
    let seen = libm::hypot(motion.x(), motion.y());
    let polar = error.polar(libm::atan2(motion.y(), motion.x()), seen, distance.abs(), variance);
    let off = 2.0 * (bearing.x * motion.x() + bearing.y * motion.y());
    // An arc whose end is off to the side is longer than its chord besides, β/sin β = 1 + β²/6 times.
    let longer = 4.0 / 3.0 * (seen - polar.distance);
    let v_off = executed.v_hat - v - longer.copysign(v) / dt;
    Observation {
        first_order: [v_off, off / dt, wrap_angle(motion.theta() - turn - off) / dt],
        residuals: [v_off, wrap_angle((executed.omega_hat - omega) * dt) / dt, executed.gamma_hat],
        other_way: None,
        unknown: [0.0; 3],
        coefficients: [[v2, omega2]; 3],
        floors: [
            polar.of_distance,
            4.0 * (polar.of_bearing + error.headings[0]),
            4.0 * polar.of_bearing + error.of_turn(),
        ]
        .map(|floor| floor * per_time),
        reading: [v, omega, dt],
        expected,
        slopes: Matrix3::from_rows(&[
            along - bearing * (length * log_slope),
            bearing * 2.0,
            RowVector3::new(0.0, 0.0, 1.0) - bearing * 2.0,
        ]) / dt,
    }
}

/// How the motion that a twist leads to changes with the rate of turning, at constant length.
pub(super) fn turn_slope(twist: &Vector3<f64>, end: &SE2) -> Vector3<f64> {
    let half = 0.5 * twist.z;
    let shrink =
        0.5 * if half.abs() < 1e-4 { -half / 3.0 } else { libm::cos(half) / libm::sin(half) - 1.0 / half };
    Vector3::new(shrink * end.x() - 0.5 * end.y(), shrink * end.y() + 0.5 * end.x(), 1.0)
}
