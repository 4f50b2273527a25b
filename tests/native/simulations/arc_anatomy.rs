//! Arc Anatomy: the inversion of an arc, compared with the printed table, with the driven motion and with differences.

use crate::common::{NOISE_KINDS, seeded_rng, uniform};
use motion::geom::se2::{SE2, wrap_angle};
use motion::sim::arc_anatomy::{ArcAnatomy, FinalPose, PRESETS, Settings, Stats};
use motion::{MotionModel, NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};
use std::f64::consts::PI;

fn simulation(settings: Settings) -> ArcAnatomy {
    ArcAnatomy::new(settings).expect("valid settings")
}

pub fn stats(settings: Settings) -> Stats {
    simulation(settings).stats()
}

pub fn preset(name: &str) -> Settings {
    let preset = PRESETS.iter().find(|preset| preset.name == name).expect("a preset of that name");
    Settings { command: preset.command, next: preset.next, ..Settings::default() }
}

fn poses(settings: &Settings) -> (SE2, SE2) {
    let [x, y, theta] = settings.start;
    let FinalPose { x: next_x, y: next_y, theta: next_theta } = settings.next;
    (SE2::new(x, y, theta), SE2::new(next_x, next_y, next_theta))
}

/// Returns an infinite stream of settings, each with two random poses some metres apart and a random command.
fn random_settings(seed: u64) -> impl Iterator<Item = Settings> {
    let mut rng = seeded_rng(seed);
    std::iter::repeat_with(move || {
        let mut uniform_up_to = |reach: f64| uniform(&mut rng, -reach, reach);
        let start = [uniform_up_to(3.0), uniform_up_to(3.0), uniform_up_to(PI)];
        let next = FinalPose { x: uniform_up_to(3.0), y: uniform_up_to(3.0), theta: uniform_up_to(PI) };
        let command = VelocityCmd {
            v: uniform_up_to(1.5),
            omega: uniform_up_to(2.0),
            dt: 0.1 + uniform_up_to(1.0).abs(),
        };
        Settings { start, next, command, ..Settings::default() }
    })
}

/// Returns lines 1 to 8 of Table 5.1 as printed, except that angles are wrapped.
fn table_as_printed(settings: &Settings) -> [f64; 8] {
    let (x, next) = poses(settings);
    let dt = settings.command.dt;
    let (sin, cos) = x.theta().sin_cos();
    let (dx, dy) = (x.x() - next.x(), x.y() - next.y());
    let mu = 0.5 * (dx * cos + dy * sin) / (dy * cos - dx * sin);
    let centre_x = 0.5 * (x.x() + next.x()) + mu * dy;
    let centre_y = 0.5 * (x.y() + next.y()) - mu * dx;
    let radius = (x.x() - centre_x).hypot(x.y() - centre_y);
    let turn = wrap_angle(
        (next.y() - centre_y).atan2(next.x() - centre_x) - (x.y() - centre_y).atan2(x.x() - centre_x),
    );
    let gamma = wrap_angle(next.theta() - x.theta() - turn) / dt;
    [mu, centre_x, centre_y, radius, turn, turn / dt * radius, turn / dt, gamma]
}

#[test]
fn the_printed_option_computes_the_lines_of_the_table() {
    for settings in random_settings(1).take(20_000) {
        let printed = simulation(Settings { printed: true, ..settings }).table().lines;
        let expected = table_as_printed(&settings);
        // The table loses digits if the radius is much larger than the distance, and for nearly full circles.
        let scale = 1.0 + expected[0].abs() + expected[3].abs();
        for (line, expected) in expected.iter().enumerate() {
            let deviation = (printed[line] - expected).abs();
            assert!(
                deviation <= 1e-12 * scale * scale / settings.command.dt,
                "line {}: {} for {expected}, {settings:?}",
                line + 1,
                printed[line]
            );
        }
    }
}

#[test]
fn robots_end_where_their_arcs_do_and_the_last_turn_gives_the_final_heading() {
    for settings in random_settings(3).take(2000) {
        let (_, next) = poses(&settings);
        let Stats { commanded, driven, last_turn, .. } = stats(settings);
        assert!(wrap_angle(driven.end[2] + last_turn - next.theta()).abs() < 1e-13, "{settings:?}");
        let [commanded_end, driven_end, _] = simulation(settings).poses_at(1.0);
        for (robot, arc) in [(commanded_end, commanded), (driven_end, driven)] {
            assert_eq!([robot.x(), robot.y()], arc.end[..2], "{settings:?}");
        }
    }
}

/// The table as printed is wrong only if the centre is to the right of the heading. Its arc then ends at the point reflection of the
/// final position at the start.
#[test]
fn the_printed_option_mirrors_centres_to_the_right() {
    let mut right_count = 0;
    for settings in random_settings(4).take(2000) {
        let signed_stats = stats(settings);
        let printed = stats(Settings { printed: true, ..settings });
        let [x, y, _] = printed.driven.end;
        let (start, next) = poses(&settings);
        let mirrored_end = [2.0 * start.x() - next.x(), 2.0 * start.y() - next.y()];
        let expected = if signed_stats.inverted.radius < 0.0 { mirrored_end } else { [next.x(), next.y()] };
        right_count += usize::from(signed_stats.inverted.radius < 0.0);
        let allowed = 1e-13 * (10.0 + signed_stats.driven.arc_length.abs());
        assert!((x - expected[0]).hypot(y - expected[1]) < allowed, "{settings:?}");
        assert_eq!(printed.inverted, signed_stats.inverted);
        assert_eq!(printed.factors[1..], signed_stats.factors[1..]);
        assert_eq!(printed.density, signed_stats.density);
        assert_eq!(printed.driven.arc_length.signum(), printed.driven.turn.signum());
    }
    assert!(right_count > 500);
}

#[test]
fn p_is_the_product_of_the_factors_and_that_of_the_model() {
    for (i, settings) in random_settings(5).take(4000).enumerate() {
        let noise = NOISE_KINDS[i % 2];
        let settings = Settings { noise, ..settings };
        let model = VelocityModel { alphas: VelocityAlphas(settings.alphas), noise };
        let (start, next) = poses(&settings);
        let stats = stats(settings);
        assert_eq!(stats.prob, model.prob(&next, &settings.command, &start));
        assert_eq!(stats.density, model.pose_density(&next, &settings.command, &start));
        let noise_free_pose = model.apply_noise(&settings.command, &start, [0.0; 3]);
        let peak: f64 =
            model.variances(&settings.command).iter().map(|variance| noise.prob(0.0, *variance)).product();
        assert!((stats.share * peak - stats.prob).abs() <= 1e-13 * peak, "{settings:?}");
        // The inversion finds the shorter of the two arcs.
        if (settings.command.omega * settings.command.dt).abs() < PI {
            let peak_prob = model.prob(&noise_free_pose, &settings.command, &start);
            assert!((peak_prob / peak - 1.0).abs() < 1e-9, "{settings:?}");
        }
        for factor in stats.factors.iter().filter(|_| noise == NoiseKind::Normal) {
            let expected = (-0.5 * factor.deviations.powi(2)).exp();
            assert!((factor.share - expected).abs() < 1e-13);
        }
    }
}

#[test]
fn without_noise_a_residual_is_zero_or_infinite() {
    let settings = Settings { alphas: [0.0; 6], ..preset("straight") };
    let Stats { factors, prob, share, density, weakest, .. } = stats(settings);
    assert_eq!(factors.map(|factor| factor.deviations), [f64::NEG_INFINITY, 0.0, f64::INFINITY]);
    assert_eq!((prob, share, density, weakest), (0.0, 0.0, None, 0));
    let arc_end = FinalPose { x: 1.0, y: 0.0, theta: 0.0 };
    let Stats { factors, prob, share, .. } = stats(Settings { next: arc_end, ..settings });
    assert_eq!(factors.map(|factor| factor.deviations), [0.0; 3]);
    assert_eq!((prob, share), (1.0, 1.0));
}

/// The expected lateral velocity comes from central differences of the path.
#[test]
fn a_last_turn_gives_the_twist_a_lateral_velocity() {
    for settings in random_settings(6).take(200) {
        let simulation = simulation(settings);
        let [along, lateral, _] = simulation.stats().xi;
        let step = 1e-5;
        for (i, tick) in simulation.paths().ticks.iter().enumerate().take(8) {
            let progress = 0.125 * i as f64 + step;
            let [before, middle, after] =
                [progress - step, progress, progress + step].map(|progress| simulation.poses_at(progress)[2]);
            let velocity = [(after.x() - before.x()) / (2.0 * step), (after.y() - before.y()) / (2.0 * step)];
            let (sin, cos) = middle.theta().sin_cos();
            let sideways = cos * velocity[1] - sin * velocity[0];
            assert!((sideways - lateral).abs() < 1e-8 * (1.0 + along.abs() + lateral.abs()), "{settings:?}");
            let [x, y, to_x, to_y] = *tick;
            assert!(((to_x - x).hypot(to_y - y) - lateral.abs()).abs() < 1e-12 * (1.0 + lateral.abs()));
            assert!((before.x() - x).hypot(before.y() - y) < 1e-12 * (1.0 + along.abs()));
        }
        // Without the last turn the lateral component of the twist is 0.
        let Stats { driven, .. } = simulation.stats();
        let next = FinalPose { theta: driven.end[2], ..settings.next };
        let xi = stats(Settings { next, ..settings }).xi;
        assert!(xi[1].abs() < 1e-12 * (1.0 + xi[0].abs()), "{xi:?}");
    }
}

#[test]
fn straight_motion_has_no_centre_and_no_motion_has_no_arc() {
    let settings = Settings { next: FinalPose { x: 2.0, y: 0.0, theta: 0.0 }, ..Settings::default() };
    let simulation = simulation(settings);
    let Stats { inverted, factors, .. } = simulation.stats();
    assert_eq!((inverted.centre, inverted.radius, inverted.turn), (None, f64::INFINITY, 0.0));
    assert_eq!(factors[0].estimate, 2.0);
    let [mu, x, y, radius, turn, v, ..] = simulation.table().lines;
    assert!([mu, x, y, radius].iter().all(|line| line.is_infinite()) && turn == 0.0 && v == 2.0);
    let nearest_pose = FinalPose { x: f64::from_bits(1), y: 0.0, theta: 0.0 };
    let simulation_with_tiny_motion =
        ArcAnatomy::new(Settings { next: nearest_pose, ..settings }).expect("valid settings");
    assert!(simulation_with_tiny_motion.table().lines[0].is_infinite());
    let backward_stats =
        stats(Settings { next: FinalPose { x: -2.0, y: 0.0, theta: 0.0 }, printed: true, ..settings });
    assert_eq!(backward_stats.factors[0].estimate, -2.0);
    assert!(backward_stats.factors[1].estimate.to_bits() == 0, "a turn of −0");
    let turn_on_spot = Settings { next: FinalPose { x: 0.0, y: 0.0, theta: 0.7 }, ..settings };
    let Stats { factors, density, xi, .. } = stats(turn_on_spot);
    assert_eq!(factors.map(|factor| factor.estimate), [0.0, 0.7, 0.0]);
    assert_eq!((density, xi), (Some(f64::INFINITY), [0.0, 0.0, 0.7]));
    assert!(ArcAnatomy::new(turn_on_spot).expect("valid settings").table().lines[0].is_nan());
}
