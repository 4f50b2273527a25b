//! Laws of angles and of SE(2).
//!
//! A law may be off by a few units in the last place for each map that it composes. The tolerance is 32 units, as in `group_laws.rs`,
//! relative to the size of the arguments, which may be 10⁻³⁰⁸ or 10³⁰⁰.

use super::doubles::{
    any_pose, any_twist, assert_same_pose, finite_doubles, new_proptest_config, sum_of_coordinates,
};
use motion::geom::se2::{SE2, wrap_angle};
use motion::geom::sinc::sinc;
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

const TOLERANCE_ULPS: f64 = 32.0;

proptest! {
    #![proptest_config(new_proptest_config(400))]

    #[test]
    fn wrapped_angles_are_remainders(angle in finite_doubles()) {
        let wrapped_angle = wrap_angle(angle);
        prop_assert!(-PI < wrapped_angle && wrapped_angle <= PI);
        let angle_remainder = angle % TAU;
        let added_turns = if angle_remainder > PI { -1.0 } else if angle_remainder <= -PI { 1.0 } else { 0.0 };
        let expected_angle = if added_turns == 0.0 { angle_remainder } else { angle_remainder + added_turns * TAU };
        prop_assert_eq!(wrapped_angle.to_bits(), expected_angle.to_bits(), "{} {}", wrapped_angle, expected_angle);
        prop_assert_eq!(wrap_angle(wrapped_angle).to_bits(), wrapped_angle.to_bits());
        let wrapped_opposite = wrap_angle(-angle);
        prop_assert!(wrapped_opposite == -wrapped_angle || (wrapped_opposite == PI && wrapped_angle == PI));
    }

    #[test]
    fn composition_is_associative_and_has_inverses(a in any_pose(), b in any_pose(), c in any_pose()) {
        let total_extent = sum_of_coordinates(&a) + sum_of_coordinates(&b) + sum_of_coordinates(&c);
        assert_same_pose(&((a * b) * c), &(a * (b * c)), TOLERANCE_ULPS, total_extent)?;
        assert_same_pose(&(a * a.inverse()), &SE2::identity(), TOLERANCE_ULPS, sum_of_coordinates(&a))?;
        assert_same_pose(&(a.inverse() * a), &SE2::identity(), TOLERANCE_ULPS, sum_of_coordinates(&a))?;
        assert_same_pose(&(a * b).inverse(), &(b.inverse() * a.inverse()), TOLERANCE_ULPS, total_extent)?;
        prop_assert_eq!(SE2::identity() * a, a);
        prop_assert_eq!(a * SE2::identity(), a);
    }

    /// The law holds for any turn. Beyond half a turn, heading and arc have a rounding error of 10⁻¹⁶ of the turn.
    #[test]
    fn a_twist_and_its_reverse_cancel(twist in any_twist(f64::MAX)) {
        let pose = SE2::exp(&twist);
        prop_assert!(pose.x().is_finite() && pose.y().is_finite());
        assert_same_pose(&SE2::exp(&-twist), &pose.inverse(), TOLERANCE_ULPS, twist.x.abs() + twist.y.abs())?;
    }

    #[test]
    fn exp_inverts_log(pose in any_pose()) {
        let twist = pose.log();
        prop_assert!(twist.z.abs() <= PI && twist.x.is_finite() && twist.y.is_finite());
        assert_same_pose(&SE2::exp(&twist), &pose, TOLERANCE_ULPS, 2.0 * sum_of_coordinates(&pose))?;
    }

    #[test]
    fn log_inverts_exp(twist in any_twist(3.1)) {
        let recovered_twist = SE2::exp(&twist).log();
        let tolerance = TOLERANCE_ULPS * f64::EPSILON * (twist.x.abs() + twist.y.abs()) + f64::MIN_POSITIVE;
        prop_assert_eq!(recovered_twist.z, twist.z);
        prop_assert!((recovered_twist.x - twist.x).abs() <= tolerance && (recovered_twist.y - twist.y).abs() <= tolerance, "{:?}", recovered_twist);
    }

    #[test]
    fn boxplus_inverts_boxminus(a in any_pose(), b in any_pose()) {
        let total_extent = sum_of_coordinates(&a) + sum_of_coordinates(&b);
        assert_same_pose(&a.boxplus(b.boxminus(&a)), &b, TOLERANCE_ULPS, 2.0 * total_extent)?;
        prop_assert_eq!(a.boxplus(Vector3::zeros()), a);
        prop_assert_eq!(a.boxplus(b.log()), a * SE2::exp(&b.log()));
    }

    #[test]
    fn adjoints_compose_as_poses_do(a in any_pose(), b in any_pose()) {
        assert_close(&(a * b).adjoint(), &(a.adjoint() * b.adjoint()), sum_of_coordinates(&a) + sum_of_coordinates(&b))?;
        assert_close(&(a.adjoint() * a.inverse().adjoint()), &Matrix3::identity(), sum_of_coordinates(&a))?;
    }

    #[test]
    fn the_adjoint_moves_a_twist_from_the_right_to_the_left(pose in any_pose(), twist in any_twist(PI)) {
        prop_assume!(sum_of_coordinates(&pose) < 1e290);
        let left_twist = pose.adjoint() * twist;
        let total_extent = sum_of_coordinates(&pose) + twist.x.abs() + twist.y.abs() + left_twist.x.abs() + left_twist.y.abs();
        assert_same_pose(&(pose * SE2::exp(&twist)), &(SE2::exp(&left_twist) * pose), TOLERANCE_ULPS, total_extent)?;
    }

    /// The inverse Jacobian diverges at a full turn. This law is tested up to half a turn.
    #[test]
    fn jacobians_have_inverses(twist in any_twist(PI)) {
        let (jacobian, inverse_jacobian) = (SE2::right_jacobian(&twist), SE2::right_jacobian_inverse(&twist));
        let twist_extent = twist.x.abs() + twist.y.abs();
        assert_close(&(jacobian * inverse_jacobian), &Matrix3::identity(), twist_extent)?;
        assert_close(&(inverse_jacobian * jacobian), &Matrix3::identity(), twist_extent)?;
        let half_sinc = sinc(0.5 * twist.z);
        let jacobian_determinant = jacobian[(0, 0)] * jacobian[(1, 1)] - jacobian[(0, 1)] * jacobian[(1, 0)];
        prop_assert!((jacobian_determinant - half_sinc * half_sinc).abs() <= TOLERANCE_ULPS * f64::EPSILON);
    }

    /// J_l = Ad(exp ξ)·J_r, and J_l(ξ) = J_r(−ξ): Solà et al., eq. 75 and 76. The adjoint has the wrapped heading, which equals the turn
    /// only up to half a turn.
    #[test]
    fn the_left_jacobian_is_the_right_jacobian_of_the_reversed_twist(twist in any_twist(PI)) {
        let left_jacobian = SE2::exp(&twist).adjoint() * SE2::right_jacobian(&twist);
        assert_close(&left_jacobian, &SE2::right_jacobian(&-twist), twist.x.abs() + twist.y.abs())?;
    }
}

fn assert_close(a: &Matrix3<f64>, b: &Matrix3<f64>, position_extent: f64) -> Result<(), TestCaseError> {
    for i in 0..3 {
        for j in 0..3 {
            let tolerance_scale = if j == 2 { 1.0 + position_extent } else { 1.0 };
            let entry_difference = (a[(i, j)] - b[(i, j)]).abs();
            prop_assert!(
                entry_difference <= TOLERANCE_ULPS * f64::EPSILON * tolerance_scale,
                "{} {}: off by {:e}",
                a,
                b,
                entry_difference
            );
        }
    }
    Ok(())
}
