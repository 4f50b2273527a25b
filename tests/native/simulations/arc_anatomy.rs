//! The simulation of Arc Anatomy: inverted arcs are compared with the printed table, the model, and numeric derivatives.

use crate::common::{NOISE_KINDS, sample_uniform, seeded_rng, settings_of_preset};
use motion::geom::se2::{SE2, wrap_angle};
use motion::sim::arc_anatomy::{ArcAnatomy, Settings, Stats};
use motion::{MotionModel, NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};
use std::f64::consts::PI;

fn new_simulation(settings: Settings) -> ArcAnatomy {
    ArcAnatomy::new(settings).expect("valid settings")
}

pub fn stats_of(settings: Settings) -> Stats {
    new_simulation(settings).stats()
}

fn start_and_next_pose_of(settings: &Settings) -> (SE2, SE2) {
    (settings.start.into(), settings.next.into())
}

/// Returns an infinite stream of settings, each with two random poses some metres apart and a random command.
fn sample_settings(seed: u64) -> impl Iterator<Item = Settings> {
    let mut rng = seeded_rng(seed);
    std::iter::repeat_with(move || {
        let mut sample_uniform_up_to = |max_abs: f64| sample_uniform(&mut rng, -max_abs, max_abs);
        let start_pose = [sample_uniform_up_to(3.0), sample_uniform_up_to(3.0), sample_uniform_up_to(PI)];
        let final_pose = [sample_uniform_up_to(3.0), sample_uniform_up_to(3.0), sample_uniform_up_to(PI)];
        let command = VelocityCmd {
            v: sample_uniform_up_to(1.5),
            omega: sample_uniform_up_to(2.0),
            dt: 0.1 + sample_uniform_up_to(1.0).abs(),
        };
        Settings { start: start_pose, next: final_pose, command, ..Settings::default() }
    })
}

/// Returns lines 1 to 8 of Table 5.1 as printed, except that angles are wrapped.
fn compute_printed_table(settings: &Settings) -> [f64; 8] {
    let (x, next_pose) = start_and_next_pose_of(settings);
    let dt = settings.command.dt;
    let (sin, cos) = x.theta().sin_cos();
    let (start_dx, start_dy) = (x.x() - next_pose.x(), x.y() - next_pose.y());
    let centre_mu = 0.5 * (start_dx * cos + start_dy * sin) / (start_dy * cos - start_dx * sin);
    let centre_x = 0.5 * (x.x() + next_pose.x()) + centre_mu * start_dy;
    let centre_y = 0.5 * (x.y() + next_pose.y()) - centre_mu * start_dx;
    let arc_radius = (x.x() - centre_x).hypot(x.y() - centre_y);
    let arc_turn = wrap_angle(
        (next_pose.y() - centre_y).atan2(next_pose.x() - centre_x)
            - (x.y() - centre_y).atan2(x.x() - centre_x),
    );
    let gamma = wrap_angle(next_pose.theta() - x.theta() - arc_turn) / dt;
    [centre_mu, centre_x, centre_y, arc_radius, arc_turn, arc_turn / dt * arc_radius, arc_turn / dt, gamma]
}

#[test]
fn the_printed_option_computes_the_lines_of_the_table() {
    for settings in sample_settings(1).take(20_000) {
        let computed_lines = new_simulation(Settings { printed: true, ..settings }).table().lines;
        let expected_lines = compute_printed_table(&settings);
        // The formulas of the printed table lose digits if the radius is much larger than the distance, and for nearly full circles.
        let error_factor = 1.0 + expected_lines[0].abs() + expected_lines[3].abs();
        for (line_index, expected_value) in expected_lines.iter().enumerate() {
            let line_deviation = (computed_lines[line_index] - expected_value).abs();
            assert!(
                line_deviation <= 1e-12 * error_factor * error_factor / settings.command.dt,
                "line {}: {} for {expected_value}, {settings:?}",
                line_index + 1,
                computed_lines[line_index]
            );
        }
    }
}

#[test]
fn robots_end_where_their_arcs_do_and_the_last_turn_gives_the_final_heading() {
    for settings in sample_settings(3).take(2000) {
        let (_, next_pose) = start_and_next_pose_of(&settings);
        let Stats { commanded: commanded_arc, driven, last_turn, .. } = stats_of(settings);
        assert!(wrap_angle(driven.end[2] + last_turn - next_pose.theta()).abs() < 1e-13, "{settings:?}");
        let [commanded_end, driven_end, _] = new_simulation(settings).poses_at(1.0);
        for (end_pose, driven_arc) in [(commanded_end, commanded_arc), (driven_end, driven)] {
            assert_eq!([end_pose.x(), end_pose.y()], driven_arc.end[..2], "{settings:?}");
        }
    }
}

/// The unsigned radius of Table 5.1 as printed is wrong only if the centre is to the right of the heading. The arc then ends at the final
/// position reflected through the start position.
#[test]
fn the_printed_option_mirrors_centres_to_the_right() {
    let mut right_count = 0;
    for settings in sample_settings(4).take(2000) {
        let signed_stats = stats_of(settings);
        let printed_stats = stats_of(Settings { printed: true, ..settings });
        let [x, y, _] = printed_stats.driven.end;
        let (start_pose, next_pose) = start_and_next_pose_of(&settings);
        let mirrored_end = [2.0 * start_pose.x() - next_pose.x(), 2.0 * start_pose.y() - next_pose.y()];
        let expected_end =
            if signed_stats.inverted.radius < 0.0 { mirrored_end } else { [next_pose.x(), next_pose.y()] };
        right_count += usize::from(signed_stats.inverted.radius < 0.0);
        let tolerance = 1e-13 * (10.0 + signed_stats.driven.arc_length.abs());
        assert!((x - expected_end[0]).hypot(y - expected_end[1]) < tolerance, "{settings:?}");
        assert_eq!(printed_stats.inverted, signed_stats.inverted);
        assert_eq!(printed_stats.factors[1..], signed_stats.factors[1..]);
        assert_eq!(printed_stats.density, signed_stats.density);
        assert_eq!(printed_stats.driven.arc_length.signum(), printed_stats.driven.turn.signum());
    }
    assert!(right_count > 500);
}

#[test]
fn p_is_the_product_of_the_factors_and_that_of_the_model() {
    for (i, settings) in sample_settings(5).take(4000).enumerate() {
        let noise = NOISE_KINDS[i % 2];
        let settings = Settings { noise, ..settings };
        let model = VelocityModel { alphas: VelocityAlphas(settings.alphas), noise };
        let (start_pose, next_pose) = start_and_next_pose_of(&settings);
        let arc_stats = stats_of(settings);
        assert_eq!(arc_stats.prob, model.prob(&next_pose, &settings.command, &start_pose));
        assert_eq!(arc_stats.density, model.pose_density(&next_pose, &settings.command, &start_pose));
        let noise_free_pose = model.apply_noise(&settings.command, &start_pose, [0.0; 3]);
        let noise_peak: f64 =
            model.variances(&settings.command).iter().map(|variance| noise.prob(0.0, *variance)).product();
        assert!((arc_stats.share * noise_peak - arc_stats.prob).abs() <= 1e-13 * noise_peak, "{settings:?}");
        if (settings.command.omega * settings.command.dt).abs() < PI {
            let peak_prob = model.prob(&noise_free_pose, &settings.command, &start_pose);
            assert!((peak_prob / noise_peak - 1.0).abs() < 1e-9, "{settings:?}");
        }
        for factor in arc_stats.factors.iter().filter(|_| noise == NoiseKind::Normal) {
            let expected_share = (-0.5 * factor.deviations.powi(2)).exp();
            assert!((factor.share - expected_share).abs() < 1e-13);
        }
    }
}

#[test]
fn without_noise_a_residual_is_zero_or_infinite() {
    let settings = Settings { alphas: [0.0; 6], ..settings_of_preset("straight") };
    let Stats {
        factors: probability_factors,
        prob: table_score,
        share: share_of_peak,
        density: pose_density,
        weakest: weakest_index,
        ..
    } = stats_of(settings);
    assert_eq!(probability_factors.map(|factor| factor.deviations), [f64::NEG_INFINITY, 0.0, f64::INFINITY]);
    assert_eq!((table_score, share_of_peak, pose_density, weakest_index), (0.0, 0.0, None, 0));
    let arc_end = [1.0, 0.0, 0.0];
    let Stats { factors: probability_factors, prob: table_score, share: share_of_peak, .. } =
        stats_of(Settings { next: arc_end, ..settings });
    assert_eq!(probability_factors.map(|factor| factor.deviations), [0.0; 3]);
    assert_eq!((table_score, share_of_peak), (1.0, 1.0));
}

/// The expected lateral velocity is computed by central differences of the path.
#[test]
fn a_last_turn_gives_the_twist_a_lateral_velocity() {
    for settings in sample_settings(6).take(200) {
        let simulation = new_simulation(settings);
        let [along_velocity, xi_lateral, _] = simulation.stats().xi;
        let time_step = 1e-5;
        for (i, tick_pose) in simulation.paths().ticks.iter().enumerate().take(8) {
            let path_fraction = 0.125 * i as f64 + time_step;
            let [pose_before, middle_pose, pose_after] =
                [path_fraction - time_step, path_fraction, path_fraction + time_step]
                    .map(|time_fraction| simulation.poses_at(time_fraction)[2]);
            let path_velocity = [
                (pose_after.x() - pose_before.x()) / (2.0 * time_step),
                (pose_after.y() - pose_before.y()) / (2.0 * time_step),
            ];
            let (sin, cos) = middle_pose.theta().sin_cos();
            let lateral_velocity = cos * path_velocity[1] - sin * path_velocity[0];
            assert!(
                (lateral_velocity - xi_lateral).abs()
                    < 1e-8 * (1.0 + along_velocity.abs() + xi_lateral.abs()),
                "{settings:?}"
            );
            let [x, y, to_x, to_y] = *tick_pose;
            let lateral_speed = xi_lateral.abs();
            assert!(((to_x - x).hypot(to_y - y) - lateral_speed).abs() < 1e-12 * (1.0 + lateral_speed));
            assert!((pose_before.x() - x).hypot(pose_before.y() - y) < 1e-12 * (1.0 + along_velocity.abs()));
        }
        let Stats { driven, .. } = simulation.stats();
        let next_without_last_turn = [settings.next[0], settings.next[1], driven.end[2]];
        let twist_to_next = stats_of(Settings { next: next_without_last_turn, ..settings }).xi;
        assert!(twist_to_next[1].abs() < 1e-12 * (1.0 + twist_to_next[0].abs()), "{twist_to_next:?}");
    }
}

#[test]
fn straight_motion_has_no_centre_and_no_motion_has_no_arc() {
    let settings = Settings { next: [2.0, 0.0, 0.0], ..Settings::default() };
    let simulation = new_simulation(settings);
    let Stats { inverted: inverted_arc, factors: probability_factors, .. } = simulation.stats();
    assert_eq!((inverted_arc.centre, inverted_arc.radius, inverted_arc.turn), (None, f64::INFINITY, 0.0));
    assert_eq!(probability_factors[0].estimate, 2.0);
    let [centre_mu, x, y, table_radius, arc_turn, v, ..] = simulation.table().lines;
    assert!(
        [centre_mu, x, y, table_radius].iter().all(|line| line.is_infinite()) && arc_turn == 0.0 && v == 2.0
    );
    let tiny_motion = [f64::from_bits(1), 0.0, 0.0];
    let simulation_with_tiny_motion =
        ArcAnatomy::new(Settings { next: tiny_motion, ..settings }).expect("valid settings");
    assert!(simulation_with_tiny_motion.table().lines[0].is_infinite());
    let backward_stats = stats_of(Settings { next: [-2.0, 0.0, 0.0], printed: true, ..settings });
    assert_eq!(backward_stats.factors[0].estimate, -2.0);
    assert!(backward_stats.factors[1].estimate.to_bits() == 0, "a turn of −0");
    let settings_on_the_spot = Settings { next: [0.0, 0.0, 0.7], ..settings };
    let Stats { factors: probability_factors, density: pose_density, xi: twist_to_next, .. } =
        stats_of(settings_on_the_spot);
    assert_eq!(probability_factors.map(|factor| factor.estimate), [0.0, 0.7, 0.0]);
    assert_eq!((pose_density, twist_to_next), (Some(f64::INFINITY), [0.0, 0.0, 0.7]));
    assert!(ArcAnatomy::new(settings_on_the_spot).expect("valid settings").table().lines[0].is_nan());
}
