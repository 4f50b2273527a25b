//! The laws of the group SE(2), and the accuracy of exp and log.
//!
//! The laws hold up to rounding. Every law below composes at most four maps, each accurate to a few units in the last place of the largest
//! coordinate. `LAW_TOLERANCE` allows 32 units.

use crate::common::{ReferenceTable, max_difference, sample_uniform, seeded_rng};
use motion::geom::se2::SE2;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

const LAW_TOLERANCE: f64 = 32.0 * f64::EPSILON;

/// Maximum error of exp, log and both Jacobians for |ω| ≤ π, relative to the size of the twist if the size exceeds 1.
const RELATIVE_ACCURACY: f64 = 4e-16;

fn assert_same_pose(a: &SE2, b: &SE2, tolerance: f64, law: &str) {
    assert!(max_difference(a, b) <= tolerance, "{law}: {a:?} and {b:?} differ by more than {tolerance:e}");
}

/// Composition is compared with its textbook formula, because the other laws hold in any group.
#[test]
fn composition_places_the_second_pose_in_the_frame_of_the_first() {
    let turned_pose = SE2::new(2.0, 1.0, PI / 2.0);
    assert_same_pose(
        &(turned_pose * SE2::new(3.0, 0.5, 0.25)),
        &SE2::new(1.5, 4.0, PI / 2.0 + 0.25),
        LAW_TOLERANCE,
        "composition by hand",
    );
    let facing_north = SE2::new(5.0, 5.0, PI / 2.0);
    let pose_ahead = facing_north.boxplus(Vector3::x());
    assert_same_pose(&pose_ahead, &SE2::new(5.0, 6.0, PI / 2.0), 16.0 * LAW_TOLERANCE, "in its frame");
}

/// The given turn selects the branch, so that the logarithm inverts exp beyond half a turn. Its coordinates grow towards a full turn.
#[test]
fn the_logarithm_near_a_turn_is_on_the_branch_of_that_turn() {
    let mut rng = seeded_rng(6);
    for _ in 0..2000 {
        let mut sample_within = |max_abs: f64| sample_uniform(&mut rng, -max_abs, max_abs);
        let twist = Vector3::new(sample_within(3.0), sample_within(3.0), sample_within(2.0 * PI - 0.3));
        let pose = SE2::exp(&twist);
        let expected_turn = twist.z + sample_within(3.0);
        let twist_to_pose = pose.log_near(expected_turn);
        // The factor 1/sinc(ω/2) amplifies the rounding of the pose, up to 20 times at 0.3 rad from a full turn.
        assert!(
            (twist_to_pose - twist).amax() < 20.0 * LAW_TOLERANCE * twist.norm().max(1.0),
            "log_near({expected_turn}) of exp({twist}) = {twist_to_pose}"
        );
        assert_eq!(pose.log_near(pose.theta()), pose.log());
        let log_a_turn_further = pose.log_near(twist.z + TAU);
        assert!((log_a_turn_further.z - twist.z - TAU).abs() < LAW_TOLERANCE, "{}", log_a_turn_further.z);
    }
}

/// The reference covers the ranges of |ω| in which series or closed forms can lose digits.
#[test]
fn exp_and_jacobians_match_the_references() {
    let reference_table = ReferenceTable::parse(include_str!("../../reference/group.csv"));
    for csv_row in reference_table.rows() {
        let twist = Vector3::from(csv_row.cell_numbers(["a", "b", "w"]));
        let tolerance = RELATIVE_ACCURACY * twist.norm().max(1.0);
        let assert_near = |column_name: &str, computed_value: f64| {
            let absolute_error = csv_row.deviation_of(column_name, computed_value);
            assert!(
                absolute_error <= tolerance,
                "{column_name} at {:?}: off by {absolute_error:e}, allowed {tolerance:e}",
                twist.as_slice()
            );
        };
        let pose = SE2::exp(&twist);
        assert_near("x", pose.x());
        assert_near("y", pose.y());
        assert_eq!(pose.theta(), twist.z);
        for (column_prefix, jacobian) in
            [("j", SE2::right_jacobian(&twist)), ("i", SE2::right_jacobian_inverse(&twist))]
        {
            for (i, j) in [(0, 0), (0, 1), (0, 2), (1, 2)] {
                assert_near(&format!("{column_prefix}{i}{j}"), jacobian[(i, j)]);
            }
            assert_eq!(jacobian[(1, 1)], jacobian[(0, 0)]);
            assert_eq!(jacobian[(1, 0)], -jacobian[(0, 1)]);
            assert_eq!(jacobian.row(2), Matrix3::identity().row(2));
        }
    }
}

#[test]
fn log_matches_the_references() {
    for csv_row in ReferenceTable::parse(include_str!("../../reference/log.csv")).rows() {
        let pose = SE2::new(csv_row.cell_number("x"), csv_row.cell_number("y"), csv_row.cell_number("w"));
        let twist = pose.log();
        let tolerance = RELATIVE_ACCURACY
            * Vector3::new(csv_row.cell_number("a"), csv_row.cell_number("b"), csv_row.cell_number("w"))
                .norm()
                .max(1.0);
        for (column_name, computed_coordinate) in [("a", twist.x), ("b", twist.y)] {
            let error = csv_row.deviation_of(column_name, computed_coordinate);
            assert!(
                error <= tolerance,
                "{column_name} of log {pose:?}: off by {error:e}, allowed {tolerance:e}"
            );
        }
        assert_eq!(twist.z, csv_row.cell_number("w"));
    }
}
