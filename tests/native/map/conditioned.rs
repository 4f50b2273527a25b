//! Motion conditioned on a map: the fractions that the chapter publishes, and the three samplers.

use crate::common::{MAX_STANDARD_ERRORS, seeded_rng, settings_of_preset};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, MAX_DRAWS, MapConditioned, Sampler};
use motion::noise::draw_centred_uniform;
use motion::sim::settings::SettingRules;
use motion::sim::squeeze::{Settings, alphas_of_noise_level};
use motion::{MotionModel, NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};
use rand_xoshiro::Xoshiro256PlusPlus;

pub const SAMPLERS: [Sampler; 3] = [Sampler::Endpoint, Sampler::WholeArc, Sampler::SubStepped(4)];
pub const STRAIGHT_COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.0, dt: 2.0 };

fn new_velocity_model() -> VelocityModel {
    VelocityModel { alphas: VelocityAlphas(alphas_of_noise_level(0.12)), noise: NoiseKind::Normal }
}

fn condition_on_map(plan: &FloorPlan, map_sampler: Sampler) -> MapConditioned<'_> {
    MapConditioned { model: new_velocity_model(), plan, clearance: 0.13, sampler: map_sampler }
}

fn start_pose_of(preset_name: &str) -> SE2 {
    let [x, y, theta] = settings_of_preset::<Settings>(preset_name).start;
    SE2::new(x, y, theta)
}

fn sample_unit_noise(rng: &mut Xoshiro256PlusPlus) -> [f64; 3] {
    std::array::from_fn(|_| NoiseKind::Normal.quantile(draw_centred_uniform(rng)))
}

/// Asserts that a fraction of 60 000 random draws equals a rounded, published fraction of as many draws.
fn assert_fraction(fraction_name: &str, accepted_count: usize, draw_count: usize, published_fraction: f64) {
    let computed_fraction = accepted_count as f64 / draw_count as f64;
    let standard_error = (2.0 * published_fraction * (1.0 - published_fraction) / draw_count as f64).sqrt();
    assert!(
        (computed_fraction - published_fraction).abs() < MAX_STANDARD_ERRORS * standard_error + 0.0005,
        "{fraction_name}: {computed_fraction} instead of {published_fraction}"
    );
}

#[test]
fn acceptance_and_wall_fractions_equal_the_published_ones() {
    const DRAW_COUNT: usize = 60_000;
    let plan = FloorPlan::apartment();
    let endpoint_model = condition_on_map(&plan, Sampler::Endpoint);
    for (preset_name, omega, published_acceptance, published_through_wall) in [
        ("doorway", 0.0, 0.849, 0.348),
        ("wall", 0.0, 0.832, 0.867),
        ("corridor", 0.0, 0.840, 0.242),
        ("doorway", 0.6, 0.781, 0.398),
    ] {
        let (start_pose, command) = (start_pose_of(preset_name), VelocityCmd { omega, ..STRAIGHT_COMMAND });
        let mut rng = seeded_rng(5);
        let tested_draws: Vec<_> = (0..DRAW_COUNT)
            .map(|_| {
                endpoint_model.collision_tester(&command, &start_pose).test_draw(sample_unit_noise(&mut rng))
            })
            .collect();
        let accepted_count =
            tested_draws.iter().filter(|tested_draw| tested_draw.end_verdict.is_free).count();
        let through_wall_count = tested_draws
            .iter()
            .filter(|tested_draw| tested_draw.end_verdict.is_free && !tested_draw.path_verdict.is_free)
            .count();
        assert_fraction(preset_name, accepted_count, DRAW_COUNT, published_acceptance);
        assert_fraction(preset_name, through_wall_count, accepted_count, published_through_wall);
        assert!(
            tested_draws
                .iter()
                .all(|tested_draw| tested_draw.end_verdict.is_free || !tested_draw.path_verdict.is_free),
            "the end is part of the path"
        );
    }
}

/// The expected poses are drawn as in table 5.7, until the end or the whole path is free. Equal random numbers give equal poses, after
/// the same number of draws.
#[test]
fn samples_are_those_of_table_5_7() {
    let plan = FloorPlan::apartment();
    let command = VelocityCmd { omega: 0.2, ..STRAIGHT_COMMAND };
    for map_sampler in [Sampler::Endpoint, Sampler::WholeArc] {
        for (preset_name, _) in Settings::PRESETS {
            let (start_pose, map_model) = (start_pose_of(preset_name), condition_on_map(&plan, map_sampler));
            let (mut rng, mut expected_rng) = (seeded_rng(9), seeded_rng(9));
            for _ in 0..1000 {
                let accepted_motion = map_model.sample(&command, &start_pose, &mut rng).expect("it fits");
                let mut draw_count = 0;
                let drawn_pose = loop {
                    let mut noise_rng = expected_rng.clone();
                    let drawn_pose = new_velocity_model().sample(&command, &start_pose, &mut expected_rng);
                    let executed_motion =
                        new_velocity_model().executed_motion(&command, sample_unit_noise(&mut noise_rng));
                    let start_arc = Arc {
                        start: start_pose,
                        length: 2.0 * executed_motion.v_hat,
                        turn: 2.0 * executed_motion.omega_hat,
                    };
                    draw_count += 1;
                    let is_end_free = plan.test_point([drawn_pose.x(), drawn_pose.y()], 0.13).is_free;
                    let is_accepted = is_end_free
                        && (map_model.sampler == Sampler::Endpoint
                            || plan.test_arc(&start_arc, 0.13).is_free);
                    if is_accepted {
                        break drawn_pose;
                    }
                };
                assert!(crate::common::max_difference(&drawn_pose, &accepted_motion.pose) < 1e-14);
                assert_eq!(accepted_motion.cost.draws, draw_count);
            }
        }
    }
}

/// Returns a floor plan of 20 cm by 20 cm, in which a robot with a radius of 13 cm fits nowhere.
pub fn new_too_small_room() -> FloorPlan {
    let room_corners = [[2.0, 2.0], [2.2, 2.0], [2.2, 2.2], [2.0, 2.2]];
    let walls = (0..4).map(|i| Segment { from: room_corners[i], to: room_corners[(i + 1) % 4] }).collect();
    FloorPlan::new(walls, [1.9, 1.9, 2.3, 2.3]).expect("a valid plan")
}

#[test]
fn a_robot_that_cannot_move_is_an_error_with_the_number_of_draws() {
    let plan = new_too_small_room();
    let start_pose = SE2::new(2.1, 2.1, 0.0);
    for map_sampler in SAMPLERS {
        let refusal = condition_on_map(&plan, map_sampler)
            .sample(&STRAIGHT_COMMAND, &start_pose, &mut seeded_rng(12))
            .expect_err("no room");
        assert_eq!(refusal.0.draws, MAX_DRAWS);
        assert_eq!(refusal.to_string(), "the robot is wedged: 10000 draws were tried and too few accepted");
    }
    // The first of two sub-steps, 1 m ± 1 mm, is free and needs one random draw. A wall blocks the second. The draws of both are counted.
    let dead_end_plan =
        FloorPlan::new(vec![Segment { from: [1.5, 0.0], to: [1.5, 2.0] }], [0.0, 0.0, 2.0, 2.0])
            .expect("a valid plan");
    let precise_model =
        VelocityModel { alphas: VelocityAlphas([1e-6, 0.0, 0.0, 0.0, 0.0, 0.0]), noise: NoiseKind::Normal };
    let map_sampler =
        MapConditioned { model: precise_model, ..condition_on_map(&dead_end_plan, Sampler::SubStepped(2)) };
    let refusal = map_sampler
        .sample(&STRAIGHT_COMMAND, &SE2::new(0.3, 1.0, 0.0), &mut seeded_rng(13))
        .expect_err("a dead end");
    assert_eq!(refusal.0.draws, MAX_DRAWS + 1);
}
