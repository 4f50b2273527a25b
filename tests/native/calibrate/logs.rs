//! Trajectories, and the legs that they are cut into.

use motion::calibrate::{Leg, LegLength, Trajectory, cut};
use motion::geom::se2::SE2;

fn straight(count: usize, step: f64) -> Trajectory {
    let samples = (0..count).map(|i| (0.1 * i as f64, SE2::new(step * i as f64, 0.0, 0.0)));
    Trajectory::new(samples).expect("times rise")
}

#[test]
fn legs_end_as_amcl_ends_them() {
    let odometry = straight(41, 0.0625);
    let length = LegLength::Moved { distance: 0.25, angle: 0.2 };
    let legs = cut(&odometry, &odometry, length, 0.0);
    // At exactly a quarter of a metre not yet: five steps each.
    assert_eq!(legs.len(), 8);
    for (i, leg) in legs.iter().enumerate() {
        assert_eq!(leg.odometry[1].x() - leg.odometry[0].x(), 0.3125);
        assert_eq!(leg.times[0], odometry.samples().nth(5 * i).expect("there").0);
    }
    // Each axis by itself: 0.24 m along both is no leg, though it is 0.34 m away.
    let diagonal = [(0.0, 0.0), (0.1, 0.24), (0.2, 0.26)].map(|(t, x)| (t, SE2::new(x, x, 0.0)));
    let diagonal = Trajectory::new(diagonal).expect("times rise");
    assert_eq!(cut(&diagonal, &diagonal, length, 0.0)[0].times, [0.0, 0.2]);
    // Across the half turn the angle is small.
    let turning = [(0.0, 3.1), (0.1, -3.1), (0.2, -2.9)].map(|(t, theta)| (t, SE2::new(0.0, 0.0, theta)));
    let turning = Trajectory::new(turning).expect("times rise");
    assert_eq!(cut(&turning, &turning, length, 0.0)[0].times, [0.0, 0.2]);
    let timed = cut(&odometry, &odometry, LegLength::Lasted { duration: 0.5 }, 0.0);
    assert_eq!(timed.len(), 8);
}

#[test]
fn no_leg_spans_a_gap() {
    let whole = straight(101, 0.1);
    let length = LegLength::Moved { distance: 0.25, angle: 0.2 };
    // A second is missing, ten steps.
    let missing = |t: f64| (4.0 < t) && (t < 5.0);
    let holed = Trajectory::new(whole.samples().filter(|(t, _)| !missing(*t))).expect("times rise");
    for (odometry, reference) in [(&holed, &whole), (&whole, &holed), (&holed, &holed)] {
        let legs = cut(odometry, reference, length, 0.0);
        assert!(legs.len() > 25);
        assert!(legs.iter().all(|leg| leg.times[1] <= 4.0 + 1e-9 || leg.times[0] >= 5.0 - 1e-9));
    }
    // Nor beyond the ends of the reference.
    let shorter = Trajectory::new(whole.samples().skip(20).take(30)).expect("times rise");
    assert!(
        cut(&whole, &shorter, length, 0.0)
            .iter()
            .all(|leg| leg.times[0] >= 2.0 - 1e-9 && leg.times[1] <= 4.9 + 1e-9)
    );
}

#[test]
fn no_leg_spans_a_break() {
    let whole = straight(101, 0.1);
    let length = LegLength::Moved { distance: 0.25, angle: 0.2 };
    let all = cut(&whole, &whole, length, 0.0);
    let times: Vec<f64> = whole.samples().map(|(t, _)| t).collect();
    let breaks = [17, 33, 34, 70];
    let broken = whole.clone().broken_before(breaks);
    assert_eq!([whole.gaps(), broken.gaps()], [0, 4]);
    let spans = |leg: &Leg| {
        let across = |at: usize| leg.times[0] < times[at] - 1e-9 && times[at] - 1e-9 < leg.times[1];
        breaks.into_iter().any(across)
    };
    assert!(all.iter().any(spans));
    // Of the reference: the others are as they are.
    let legs = cut(&whole, &broken, length, 0.0);
    assert_eq!(legs, all.iter().filter(|leg| !spans(leg)).copied().collect::<Vec<_>>());
    // Of the odometry: the first after a break begins there.
    let legs = cut(&broken, &whole, length, 0.0);
    assert!(legs.len() > 25 && !legs.iter().any(spans));
    assert!([17, 34, 70].iter().all(|at| legs.iter().any(|leg| leg.times[0] == times[*at])));
    // Between is nothing, on either side all.
    assert!(broken.has_gap(times[16] + 0.01, times[17] - 0.01) && broken.pose_at(times[16] + 0.01).is_none());
    assert!(!broken.has_gap(times[15], times[16]) && !broken.has_gap(times[17], times[18]));
    assert!([16, 17].iter().all(|at| broken.pose_at(times[*at]).is_some()));
    // Before the first sample there is nothing in any case, and there is none after the last.
    assert_eq!(whole.clone().broken_before([0, 101]).gaps(), 0);
}

#[test]
fn a_declared_jump_is_in_no_velocity() {
    let jumps = |at: usize| if (40..43).contains(&at) { 5.0 } else { 0.0 };
    let whole = straight(101, 0.1);
    let samples = whole.samples().map(|(t, pose)| (t, pose.x())).enumerate();
    let jumping = samples.map(|(at, (t, x))| (t, SE2::new(x, jumps(at), 0.0))).collect::<Vec<_>>();
    let jumping = Trajectory::new(jumping).expect("times rise").broken_before([40, 43]);
    // Its own legs too, of which some are the three samples between the jumps.
    let legs = cut(&jumping, &jumping, LegLength::Moved { distance: 0.15, angle: 0.2 }, 0.0);
    assert!(legs.len() > 45);
    assert!(legs.iter().any(|leg| leg.odometry[0].y() == 5.0));
    for leg in legs {
        assert!(leg.velocities.iter().all(|velocity| (velocity - nalgebra::Vector3::x()).norm() < 1e-9));
    }
}

#[test]
fn poses_between_samples_lie_on_an_arc() {
    let twist = motion_twist();
    let ends = [(1.0, SE2::new(2.0, 1.0, 3.0)), (2.0, SE2::new(2.0, 1.0, 3.0).boxplus(twist))];
    let trajectory = Trajectory::new(ends).expect("times rise");
    let there = trajectory.pose_at(1.25).expect("inside");
    let expected = ends[0].1.boxplus(twist * 0.25);
    assert!(there.boxminus(&expected).norm() < 1e-12);
    assert_eq!([0.99, 2.01].map(|time| trajectory.pose_at(time)), [None; 2]);
}

fn motion_twist() -> nalgebra::Vector3<f64> {
    nalgebra::Vector3::new(0.5, 0.1, 0.8)
}

#[test]
fn times_must_rise_and_numbers_must_be_finite() {
    let of = |samples: &[(f64, f64)]| {
        Trajectory::new(samples.iter().map(|(t, x)| (*t, SE2::new(*x, 0.0, 0.0))))
            .map_err(|error| error.to_string())
    };
    assert!(of(&[]).is_ok() && of(&[(1.0, 2.0)]).is_ok());
    assert_eq!(
        of(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0)]),
        Err("sample 2 is not later than the one before, at 1 s; allowed are times that rise".to_owned())
    );
    let not_finite = "sample 1 has a time or a coordinate that is not finite; allowed are finite numbers";
    assert_eq!(of(&[(0.0, 0.0), (f64::NAN, 0.0)]), Err(not_finite.to_owned()));
    assert_eq!(of(&[(0.0, 0.0), (1.0, f64::INFINITY)]), Err(not_finite.to_owned()));
}

#[test]
fn both_ends_of_a_leg_are_at_one_moment_of_both_clocks() {
    let odometry = straight(101, 0.1);
    let ahead = Trajectory::new(odometry.samples().map(|(t, pose)| (t + 3.0, pose))).expect("times rise");
    let legs = cut(&odometry, &ahead, LegLength::AMCL, 3.0);
    assert!(legs.len() > 25);
    for leg in legs {
        for (read, seen) in leg.odometry.iter().zip(leg.reference) {
            assert!(read.boxminus(&seen).norm() < 1e-9);
        }
        assert!(leg.velocities.iter().all(|velocity| (velocity - nalgebra::Vector3::x()).norm() < 1e-9));
    }
}

#[test]
fn commands_are_integrated_along_arcs() {
    let commands = [(0.0, 1.0, 0.0), (1.0, 0.5, 1.0), (3.0, 0.0, -2.0), (4.0, 9.0, 9.0)];
    let driven = Trajectory::from_commands(commands).expect("times rise");
    let poses: Vec<SE2> = driven.samples().map(|(_, pose)| pose).collect();
    // A metre ahead; an arc of a metre that turns by 2 rad, of the radius ½; a turn on the spot, back to the first heading.
    let arc = SE2::new(1.0 + 0.5 * libm::sin(2.0), 0.5 * (1.0 - libm::cos(2.0)), 2.0);
    let expected = [SE2::identity(), SE2::new(1.0, 0.0, 0.0), arc, SE2::new(arc.x(), arc.y(), 0.0)];
    for (pose, expected) in poses.iter().zip(expected) {
        assert!(pose.boxminus(&expected).norm() < 1e-12, "{pose:?} is not {expected:?}");
    }
    assert!(Trajectory::from_commands([(0.0, 1.0, 0.0), (1.0, f64::NAN, 0.0)]).is_err());
}
