//! The rules by which localizers compute variances from an odometry reading, compared with cases computed by hand. The exact variances of
//! the end pose are compared with quadrature and samples.

use crate::common::{MAX_STANDARD_ERRORS, NOISE_KINDS, SAMPLE_COUNT, seeded_rng};
use motion::geom::se2::SE2;
use motion::models::{LegVariances, MAX_SPIN_DISTANCE, OdometryRule, RuleAlphas};
use motion::noise::draw_centred_uniform;
use motion::stats::quadrature::noise_nodes;
use motion::{OdomDelta, Variance};
use std::f64::consts::FRAC_PI_2;

use OdometryRule::{Beluga, Nav2, Omni, Table};

/// α's that differ from each other, so that a test fails if two are exchanged.
const ALPHAS: RuleAlphas = [0.1, 0.2, 0.3, 0.4, 0.5];

fn new_odom_delta(rot1: f64, trans: f64, rot2: f64) -> OdomDelta {
    OdomDelta { rot1, trans, rot2 }
}

fn leg_variances(rule: OdometryRule, odometry_reading: OdomDelta) -> [f64; 4] {
    let LegVariances { rot1, trans, rot2, strafe: lateral_variance } =
        rule.variances(&odometry_reading, &ALPHAS);
    [rot1, trans, rot2, lateral_variance].map(|variance| variance.0)
}

/// Expected variances are computed by hand, to eight digits, with (π − 3)² = 0.02004848 and (π − 2.2)² = 0.88659673.
#[test]
fn the_variances_of_each_rule_match_its_source() {
    // The robot turns by 0.5, drives 2 m and turns back by 1. No angle is nearer to π than to 0, and the total turn is −0.5.
    let bend_reading = new_odom_delta(0.5, 2.0, -1.0);
    // Variances by hand: 0.1·0.25 + 0.2·4, 0.3·4 + 0.4·(0.25 + 1), 0.1·1 + 0.2·4.
    let bend_variances = [0.825, 1.7, 0.9, 0.0];
    // Variances by hand: 0.3·4 + 0.4·0.25, 0.1·0.25 + 0.2·4, 0.5·4 + 0.4·0.25.
    let omni_bend_variances = [0.0, 1.3, 0.825, 2.1];
    // The robot backs up by 1 m. Both rotations are π − 3 without their half turns, and the total turn is 0.
    let backward_reading = new_odom_delta(3.0, 1.0, -3.0);
    let table_reverse_variances = [1.1, 7.5, 1.1, 0.0];
    let nav2_reverse_variances = [0.202004848, 0.316038784, 0.202004848, 0.0];
    let spin_reading = new_odom_delta(0.0, 0.0, 2.2);
    // While the robot stands, the odometry pose jitters half a centimetre to the left and half a centimetre back, and turns by 0.01 rad.
    let jitter_reading = new_odom_delta(2.0, 0.005, -1.99);
    let variance_cases = [
        (Table, bend_reading, bend_variances),
        (Nav2, bend_reading, bend_variances),
        (Beluga, bend_reading, bend_variances),
        (Omni, bend_reading, omni_bend_variances),
        (Table, backward_reading, table_reverse_variances),
        (Nav2, backward_reading, nav2_reverse_variances),
        (Beluga, backward_reading, nav2_reverse_variances),
        (Omni, backward_reading, [0.0, 0.3, 0.2, 0.5]),
        (Table, spin_reading, [0.0, 1.936, 0.484, 0.0]),
        (Nav2, spin_reading, [0.0, 0.35463869, 0.088659673, 0.0]),
        (Beluga, spin_reading, [0.0, 0.35463869, 0.088659673, 0.0]),
        (Omni, spin_reading, [0.0, 1.936, 0.484, 1.936]),
        // Variances by hand: 0.1·4 + 0.2·2.5e-5, 0.3·2.5e-5 + 0.4·(4 + 3.9601), 0.1·3.9601 + 0.2·2.5e-5.
        (Table, jitter_reading, [0.400005, 3.1840475, 0.396015, 0.0]),
        // Variances by hand: 0.2·2.5e-5, 0.3·2.5e-5 + 0.4·1e-4, 0.1·1e-4 + 0.2·2.5e-5.
        (Nav2, jitter_reading, [0.000005, 0.0000475, 0.000015, 0.0]),
        (Beluga, jitter_reading, [0.000005, 0.0000475, 0.000015, 0.0]),
        (Omni, jitter_reading, [0.0, 0.0000475, 0.000015, 0.0000525]),
    ];
    for (rule, odometry_reading, expected_variances) in variance_cases {
        for (computed_variance, expected_variance) in
            leg_variances(rule, odometry_reading).into_iter().zip(expected_variances)
        {
            assert!(
                (computed_variance - expected_variance).abs() < 2e-9,
                "{rule:?} of {odometry_reading:?}: {computed_variance}, not {expected_variance}"
            );
        }
    }
}

#[test]
fn nav2_and_beluga_differ_at_exactly_a_centimetre_only() {
    let new_reading = |trans| new_odom_delta(1.0, trans, -0.4);
    for (trans, nav2_rot1_variance, beluga_rot1) in [
        (MAX_SPIN_DISTANCE.next_down(), 0.0, 0.0),
        (MAX_SPIN_DISTANCE, 1.0, 0.0),
        (MAX_SPIN_DISTANCE.next_up(), 1.0, 1.0),
    ] {
        let rot1_by_rule = |rule: OdometryRule| rule.legs(&new_reading(trans)).rot1;
        assert_eq!([rot1_by_rule(Nav2), rot1_by_rule(Beluga)], [nav2_rot1_variance, beluga_rot1], "{trans}");
        for rule in OdometryRule::ALL {
            let OdomDelta { rot1, rot2, .. } = rule.legs(&new_reading(trans));
            assert!((rot1 + rot2 - 0.6).abs() < 1e-15, "{rule:?} loses a turn");
        }
    }
}

/// The closed forms of E[sin² ε] are compared with quadrature where it is accurate, and with their limit for larger noise.
#[test]
fn the_mean_squared_sine_is_that_of_the_noise() {
    for noise_kind in NOISE_KINDS {
        for decade_tenths in -60..=4 {
            let std = 10f64.powf(f64::from(decade_tenths) / 10.0);
            let expected_mean_square: f64 = noise_nodes(noise_kind)
                .iter()
                .map(|quadrature_node| {
                    quadrature_node.node_weight * (std * quadrature_node.node_value).sin().powi(2)
                })
                .sum();
            let computed_mean_square = noise_kind.mean_squared_sine(Variance(std * std));
            assert!(
                (computed_mean_square / expected_mean_square - 1.0).abs() < 1e-10,
                "{noise_kind:?} at {std}: {computed_mean_square}, not {expected_mean_square}"
            );
        }
        assert_eq!(noise_kind.mean_squared_sine(Variance(0.0)), 0.0);
        assert!((noise_kind.mean_squared_sine(Variance(1e12)) - 0.5).abs() < 1e-6);
    }
}

/// The mean square of n outcomes with kurtosis κ has the relative standard error √((κ − 1)/n). κ is estimated from the outcomes.
#[test]
fn exact_variances_match_samples() {
    let tested_readings =
        [new_odom_delta(0.7, 1.5, 0.5), new_odom_delta(3.0, 1.0, -3.0), new_odom_delta(0.2, 0.3, FRAC_PI_2)];
    for (noise_kind, rule) in
        NOISE_KINDS.into_iter().flat_map(|noise_kind| OdometryRule::ALL.map(|rule| (noise_kind, rule)))
    {
        for odometry_reading in tested_readings {
            let (executed_legs, leg_variances) =
                (rule.legs(&odometry_reading), rule.variances(&odometry_reading, &[0.05; 5]));
            let mut rng = seeded_rng(192);
            let mut sample_unit_noise = || noise_kind.quantile(draw_centred_uniform(&mut rng));
            let start_pose = SE2::new(0.4, -0.2, 1.0);
            let drive_direction = start_pose.theta() + executed_legs.rot1;
            let correlation: f64 = -0.6;
            let sampled_error_pairs: Vec<[f64; 2]> = (0..SAMPLE_COUNT)
                .map(|_| {
                    let [a, b, c] = [sample_unit_noise(), sample_unit_noise(), sample_unit_noise()];
                    let executed_motion = leg_variances.executed_motion(
                        &executed_legs,
                        [a, b, correlation * a + (1.0 - correlation * correlation).sqrt() * c],
                    );
                    let [_, _, drive_end, _] = executed_motion.poses(&start_pose);
                    let (dx, dy) = (drive_end.x() - start_pose.x(), drive_end.y() - start_pose.y());
                    let turn_error = executed_motion.legs.rot1 + executed_motion.legs.rot2
                        - executed_legs.rot1
                        - executed_legs.rot2;
                    [dy * drive_direction.cos() - dx * drive_direction.sin(), turn_error]
                })
                .collect();
            let exact_variances = [
                leg_variances.cross_track_variance(executed_legs.trans, noise_kind),
                leg_variances.heading_variance(correlation),
            ];
            for (k, exact_variances) in exact_variances.into_iter().enumerate() {
                let mean_of_powers = |power_exponent| {
                    sampled_error_pairs.iter().map(|outcome| outcome[k].powi(power_exponent)).sum::<f64>()
                        / SAMPLE_COUNT as f64
                };
                let (mean_square, mean_fourth_power) = (mean_of_powers(2), mean_of_powers(4));
                let standard_error =
                    ((mean_fourth_power - mean_square * mean_square) / SAMPLE_COUNT as f64).sqrt();
                assert!(
                    (mean_square - exact_variances).abs() < MAX_STANDARD_ERRORS * standard_error,
                    "{noise_kind:?} {rule:?} {odometry_reading:?} {k}: {mean_square} ± {standard_error}, exactly {exact_variances}"
                );
            }
        }
    }
}
