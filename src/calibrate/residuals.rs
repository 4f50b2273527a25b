//! What a leg says of the α's: how far it was from what the wheels said, and which α's answer for that.

use super::legs::Leg;
use super::likelihood::{Component, Residual};
use crate::geom::se2::{SE2, wrap_angle};
use crate::models::{LegVariances, OdomDelta, OdometryRule, RuleAlphas, SPIN_BELOW};
use crate::noise::Variance;
use std::f64::consts::{FRAC_PI_2, PI};

/// A residual of a leg: its name in the tables, the α's in its variance (from 0), and where that is.
struct Kind {
    alphas: [usize; 2],
    variance: fn(&LegVariances) -> Variance,
    residual: fn(&Executed) -> Option<f64>,
}

/// The legs that were driven, less those that were read. None where the leg does not tell it.
struct Executed {
    rot1: Option<f64>,
    trans: f64,
    rot2: f64,
    strafe: f64,
}

const HINGED: [Kind; 3] = [
    Kind { alphas: [0, 1], variance: |noise| noise.rot1, residual: |leg| leg.rot1 },
    Kind { alphas: [2, 3], variance: |noise| noise.trans, residual: |leg| Some(leg.trans) },
    Kind { alphas: [0, 1], variance: |noise| noise.rot2, residual: |leg| Some(leg.rot2) },
];

const SLIDING: [Kind; 3] = [
    Kind { alphas: [0, 1], variance: |noise| noise.rot2, residual: |leg| Some(leg.rot2) },
    Kind { alphas: [2, 3], variance: |noise| noise.trans, residual: |leg| Some(leg.trans) },
    Kind { alphas: [4, 3], variance: |noise| noise.strafe, residual: |leg| Some(leg.strafe) },
];

/// The residuals of all legs under a rule, of each kind apart. The variance of each is that which the rule gives the
/// reading, as its sampler and [`crate::MotionModel::pose_density`] have it.
///
/// Of the two combinations of legs that lead to each pose, facing it or facing away from it, the one with the nearer bearing is
/// taken. Under the printed table a robot that backs up is charged with two half turns, and its noise is so large that the
/// other one may be meant: [`OdometryRule::Nav2`] is for robots that back up.
///
/// Where a leg has not driven a centimetre it tells no first rotation: the direction of so short a way is that of its noise.
pub fn residuals(legs: &[Leg], rule: OdometryRule) -> Vec<Component> {
    let kinds = if rule == OdometryRule::Omni { &SLIDING } else { &HINGED };
    let mut components: Vec<Component> = kinds
        .iter()
        .map(|kind| Component { alphas: kind.alphas, residuals: Vec::with_capacity(legs.len()) })
        .collect();
    for leg in legs {
        let reading = rule.legs(&OdomDelta::from_poses(&leg.odometry[0], &leg.odometry[1]));
        let motion = leg.reference[0].inverse() * leg.reference[1];
        let executed =
            if rule == OdometryRule::Omni { slid(&reading, &motion) } else { hinged(&reading, &motion) };
        // The variances are linear in the α's: what each adds by itself are its coefficients.
        let alone: [LegVariances; 5] = std::array::from_fn(|alpha| {
            let mut alphas: RuleAlphas = [0.0; 5];
            alphas[alpha] = 1.0;
            rule.variances(&reading, &alphas)
        });
        for (kind, component) in kinds.iter().zip(&mut components) {
            let coefficients = kind.alphas.map(|alpha| (kind.variance)(&alone[alpha]).0);
            let residual = (kind.residual)(&executed).filter(|_| coefficients != [0.0; 2]);
            component
                .residuals
                .extend(residual.map(|residual| Residual { square: residual * residual, coefficients }));
        }
    }
    components
}

fn hinged(reading: &OdomDelta, motion: &SE2) -> Executed {
    if reading.trans < SPIN_BELOW {
        let trans = motion.x() - reading.trans;
        return Executed { rot1: None, trans, rot2: turned(reading, motion), strafe: motion.y() };
    }
    let [bearing, distance] = [libm::atan2(motion.y(), motion.x()), libm::hypot(motion.x(), motion.y())];
    let off = wrap_angle(bearing - reading.rot1);
    let [rot1, distance] =
        if off.abs() > FRAC_PI_2 { [wrap_angle(off - PI), -distance] } else { [off, distance] };
    Executed {
        rot1: Some(rot1),
        trans: distance - reading.trans,
        rot2: wrap_angle(turned(reading, motion) - rot1),
        strafe: 0.0,
    }
}

/// A robot that slides has no hinge: its bearing is what was read.
fn slid(reading: &OdomDelta, motion: &SE2) -> Executed {
    let (sin, cos) = libm::sincos(reading.rot1);
    Executed {
        rot1: None,
        trans: cos * motion.x() + sin * motion.y() - reading.trans,
        rot2: turned(reading, motion),
        strafe: cos * motion.y() - sin * motion.x(),
    }
}

/// By how much the turn as a whole was another than was read, rad.
fn turned(reading: &OdomDelta, motion: &SE2) -> f64 {
    wrap_angle(motion.theta() - reading.rot1 - reading.rot2)
}
