//! The laws of SE(2) and the accuracy of its maps.
//!
//! The laws hold to rounding: a pose carries coordinates up to its size, and every law below composes at most four
//! maps, each right to a few units in the last place of that size. `LAW` allows 32 of them.

use crate::common::{Table, pose_distance, seeded, signed_log_uniform, uniform};
use motion::geom::se2::SE2;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

const LAW: f64 = 32.0 * f64::EPSILON;

/// What exp, log and both Jacobians are to keep for |ω| ≤ π, times the size of the twist where that exceeds 1.
const ACCURACY: f64 = 4e-16;

/// Zero, tiny and random twists: |ω| log-uniform over 1e-12 … π because every lost digit hides in a band of it, and
/// translations over six decades. Headings keep clear of the cut at π, which a law cannot cross.
fn twists() -> Vec<Vector3<f64>> {
    let mut rng = seeded(1812);
    let mut twists = vec![
        Vector3::zeros(),
        Vector3::new(1.0, 0.0, 0.0),
        Vector3::new(0.0, -1.0, 0.0),
        Vector3::new(0.0, 0.0, 1.0),
        Vector3::new(1e-300, -1e-300, 1e-300),
        Vector3::new(1e-9, 1e-9, -1e-9),
        Vector3::new(2.0, 0.0, 3.1),
        Vector3::new(-2.0, 1.0, -3.1),
    ];
    for _ in 0..300 {
        let mut component = || signed_log_uniform(&mut rng, 1e-3, 1e3);
        let (a, b) = (component(), component());
        twists.push(Vector3::new(a, b, signed_log_uniform(&mut rng, 1e-12, 3.1)));
    }
    twists
}

/// Every twist with two others of the list, so that tiny meets large.
fn triples() -> impl Iterator<Item = [Vector3<f64>; 3]> {
    let twists = twists();
    let n = twists.len();
    (0..n).map(move |i| [twists[i], twists[(7 * i + 3) % n], twists[(11 * i + 5) % n]])
}

fn size(twists: &[Vector3<f64>]) -> f64 {
    twists.iter().map(|twist| twist.norm()).sum::<f64>().max(1.0)
}

fn assert_same(a: &SE2, b: &SE2, tolerance: f64, law: &str) {
    assert!(pose_distance(a, b) <= tolerance, "{law}: {a:?} and {b:?} differ by more than {tolerance:e}");
}

fn assert_close(a: &Matrix3<f64>, b: &Matrix3<f64>, tolerance: f64, law: &str) {
    assert!((a - b).amax() <= tolerance, "{law}: off by {:e}, allowed {tolerance:e}\n{a}{b}", (a - b).amax());
}

/// The formula that a reader would write down, so that no law above is satisfied by a wrong group.
#[test]
fn composition_places_the_second_pose_in_the_frame_of_the_first() {
    let quarter = SE2::new(2.0, 1.0, PI / 2.0);
    assert_same(&(quarter * SE2::new(3.0, 0.5, 0.25)), &SE2::new(1.5, 4.0, PI / 2.0 + 0.25), LAW, "by hand");
    let mut rng = seeded(3);
    for _ in 0..1000 {
        let mut draw = |limit: f64| uniform(&mut rng, -limit, limit);
        let (a, b) = (SE2::new(draw(9.0), draw(9.0), draw(PI)), SE2::new(draw(9.0), draw(9.0), draw(PI)));
        let (sin, cos) = a.theta().sin_cos();
        let by_hand = SE2::new(
            a.x() + cos * b.x() - sin * b.y(),
            a.y() + sin * b.x() + cos * b.y(),
            a.theta() + b.theta(),
        );
        assert_same(&(a * b), &by_hand, 20.0 * LAW, "rotate, then translate");
    }
}

/// On the branch of a known turn the logarithm undoes exp beyond half a turn; its coordinates grow towards a whole one.
#[test]
fn the_logarithm_near_a_turn_uses_the_branch_of_that_turn() {
    let mut rng = seeded(6);
    for _ in 0..2000 {
        let mut draw = |limit: f64| uniform(&mut rng, -limit, limit);
        let twist = Vector3::new(draw(3.0), draw(3.0), draw(2.0 * PI - 0.3));
        let pose = SE2::exp(&twist);
        let turn = twist.z + draw(3.0);
        let back = pose.log_near(turn);
        // 1/sinc(ω/2) magnifies the rounding of the pose, up to 20 times at 0.3 rad from a whole turn.
        assert!(
            (back - twist).amax() < 20.0 * LAW * size(&[twist]),
            "log_near({turn}) of exp({twist}) = {back}"
        );
        assert_eq!(pose.log_near(pose.theta()), pose.log());
        let elsewhere = pose.log_near(twist.z + TAU);
        assert!((elsewhere.z - twist.z - TAU).abs() < LAW, "{}", elsewhere.z);
    }
}

#[test]
fn the_adjoint_moves_a_twist_from_the_right_to_the_left() {
    for [a, b, c] in triples() {
        let (x, y) = (SE2::exp(&a), SE2::exp(&b));
        let tolerance = LAW * size(&[a, b]) * size(&[a, b]);
        assert_close(&(x * y).adjoint(), &(x.adjoint() * y.adjoint()), tolerance, "Ad is a homomorphism");
        assert_close(
            &x.inverse().adjoint(),
            &x.adjoint().try_inverse().unwrap(),
            tolerance,
            "Ad of the inverse",
        );
        // x · exp(τ) · x⁻¹ = exp(Ad τ) for twists whose heading stays clear of the cut.
        let twist = Vector3::new(c.x / c.norm().max(1.0), c.y / c.norm().max(1.0), c.z);
        let moved = x.adjoint() * twist;
        assert_same(&(x * SE2::exp(&twist)), &(SE2::exp(&moved) * x), LAW * 4.0 * size(&[a, a, moved]), "Ad");
    }
}

#[test]
fn boxplus_and_boxminus_act_in_the_body_frame() {
    for [a, b, _] in triples() {
        let (x, y) = (SE2::exp(&a), SE2::exp(&b));
        let tolerance = 4.0 * LAW * size(&[a, b]);
        assert_same(&x.boxplus(b), &(x * SE2::exp(&b)), tolerance, "x ⊞ τ = x · exp(τ)");
        let step = x.boxplus(b).boxminus(&x);
        assert!((step - b).amax() <= tolerance, "(x ⊞ τ) ⊟ x = {step}, not {b}");
        assert_same(&x.boxplus(y.boxminus(&x)), &y, tolerance, "x ⊞ (y ⊟ x) = y");
        assert_eq!(x.boxplus(Vector3::zeros()), x);
    }
    // Forward is the robot's own forward.
    let north = SE2::new(5.0, 5.0, PI / 2.0);
    assert_same(
        &north.boxplus(Vector3::new(1.0, 0.0, 0.0)),
        &SE2::new(5.0, 6.0, PI / 2.0),
        16.0 * LAW,
        "north",
    );
}

#[test]
fn right_jacobian_is_the_derivative_of_exp() {
    for twist in twists() {
        // Central differences: the truncation error falls with h², the rounding error grows with 1/h; at h = 1e-5
        // both stay below 1e-10 of the size.
        const H: f64 = 1e-5;
        let x = SE2::exp(&twist);
        let mut numeric = Matrix3::zeros();
        for (i, mut column) in numeric.column_iter_mut().enumerate() {
            let step = Vector3::ith(i, H);
            let ahead = SE2::exp(&(twist + step)).boxminus(&x);
            let behind = SE2::exp(&(twist - step)).boxminus(&x);
            column.copy_from(&((ahead - behind) / (2.0 * H)));
        }
        assert_close(&SE2::right_jacobian(&twist), &numeric, 1e-10 * size(&[twist]), "J_r");
        // J_l = Ad(exp ξ) J_r and J_l(ξ) = J_r(−ξ): Solà et al., eq. 75 and 76.
        let left = x.adjoint() * SE2::right_jacobian(&twist);
        assert_close(&left, &SE2::right_jacobian(&-twist), LAW * size(&[twist]), "J_l");
    }
}

/// Sweeps the bands of |ω| in which series and closed forms are known to lose digits.
#[test]
fn exp_and_jacobians_match_the_references() {
    let table = Table::parse(include_str!("../../reference/group.csv"));
    assert_eq!(table.len(), 120);
    for row in table.rows() {
        let twist = Vector3::from(row.all(["a", "b", "w"]));
        let allowed = ACCURACY * twist.norm().max(1.0);
        let check = |column: &str, computed: f64| {
            let error = row.error(column, computed);
            assert!(
                error <= allowed,
                "{column} at {:?}: off by {error:e}, allowed {allowed:e}",
                twist.as_slice()
            );
        };
        let pose = SE2::exp(&twist);
        check("x", pose.x());
        check("y", pose.y());
        assert_eq!(pose.theta(), twist.z);
        for (prefix, matrix) in
            [("j", SE2::right_jacobian(&twist)), ("i", SE2::right_jacobian_inverse(&twist))]
        {
            for (i, j) in [(0, 0), (0, 1), (0, 2), (1, 2)] {
                check(&format!("{prefix}{i}{j}"), matrix[(i, j)]);
            }
            assert_eq!(matrix[(1, 1)], matrix[(0, 0)]);
            assert_eq!(matrix[(1, 0)], -matrix[(0, 1)]);
            assert_eq!(matrix.row(2), Matrix3::identity().row(2));
        }
    }
}

#[test]
fn log_matches_the_references() {
    for row in Table::parse(include_str!("../../reference/log.csv")).rows() {
        let pose = SE2::new(row.get("x"), row.get("y"), row.get("w"));
        let twist = pose.log();
        let allowed = ACCURACY * Vector3::new(row.get("a"), row.get("b"), row.get("w")).norm().max(1.0);
        for (column, computed) in [("a", twist.x), ("b", twist.y)] {
            let error = row.error(column, computed);
            assert!(error <= allowed, "{column} of log {pose:?}: off by {error:e}, allowed {allowed:e}");
        }
        assert_eq!(twist.z, row.get("w"));
    }
}
