//! Interpolation (morph) of a cloud between positions on the floor and exponential coordinates.

use crate::common::{is_point_inside, settings_of_preset};
use crate::simulations::banana::new_simulation;
use motion::VelocityCmd;
use motion::geom::se2::SE2;
use motion::geom::unbend::{find_arc, unbend, unbend_line};
use motion::sim::banana::{ModelKind, OUTLINE_SEGMENTS, Settings};
use motion::stats::ExponentialContour;
use nalgebra::Vector3;

const MORPH_FRACTIONS: [f64; 5] = [0.0, 0.2, 0.5, 0.9, 1.0];

fn distance_between(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn integrate_twist([v_along, v_lateral, omega]: [f64; 3]) -> [f64; 2] {
    const STEP_COUNT: usize = 2000;
    let time_step = 1.0 / STEP_COUNT as f64;
    (0..STEP_COUNT).map(|i| omega * time_step * (i as f64 + 0.5)).fold([0.0; 2], |[x, y], heading: f64| {
        let (sin, cos) = heading.sin_cos();
        [x + time_step * (v_along * cos - v_lateral * sin), y + time_step * (v_along * sin + v_lateral * cos)]
    })
}

#[test]
fn nearest_finds_robots_at_their_morphed_positions() {
    for settings in [
        settings_of_preset("banana"),
        settings_of_preset("hard"),
        settings_of_preset("pivot"),
        Settings { model: ModelKind::Odometry, ..settings_of_preset("hard") },
        Settings { command: VelocityCmd { v: 1.0, omega: 2.4, dt: 1.5 }, ..settings_of_preset("banana") },
    ] {
        let simulation = new_simulation(Settings { samples: 103, ..settings });
        for (robot_index, (pose, twist)) in simulation.poses().zip(simulation.twists()).enumerate() {
            for morph in MORPH_FRACTIONS {
                let morphed_position = unbend(&twist, morph);
                assert_eq!(
                    simulation.find_nearest(morph, morphed_position, [1e-10; 2]),
                    Some(robot_index),
                    "{morph}"
                );
                let unbent_fraction = 1.0 - morph;
                let [x, y] = integrate_twist([twist.x, unbent_fraction * twist.y, unbent_fraction * twist.z]);
                assert!(
                    distance_between(morphed_position, [x, y + morph * twist.z]) < 1e-5,
                    "{morph}: {twist}"
                );
            }
            assert!(distance_between(unbend(&twist, 0.0), [pose.x(), pose.y()]) < 1e-12);
            assert_eq!(unbend(&twist, 1.0), [twist.x, twist.z]);
        }
    }
}

#[test]
fn robots_move_smoothly_with_the_morph() {
    const MORPH_STEP: f64 = 1e-3;
    let simulation = new_simulation(Settings { samples: 200, ..settings_of_preset("banana") });
    for twist in simulation.twists() {
        let max_speed = twist.y.abs() + twist.z.abs() * (1.0 + twist.x.abs() + twist.y.abs());
        for morph in (0..1000).map(|i| f64::from(i) * MORPH_STEP) {
            let step_displacement =
                distance_between(unbend(&twist, morph), unbend(&twist, morph + MORPH_STEP));
            assert!(step_displacement <= MORPH_STEP * max_speed * (1.0 + 1e-9), "{twist} at {morph}");
        }
    }
}

/// Without the last turn γ̂ the interpolated map is one-to-one, so that the same robots stay inside an outline. Exceptions are robots
/// between the curve of an outline and the chords with which it is drawn.
#[test]
fn the_same_robots_stay_inside_an_outline() {
    let alphas = [0.002, 0.002, 0.1, 0.1, 0.0, 0.0];
    for omega in [0.0, 0.4] {
        let turn_command = VelocityCmd { v: 1.0, omega, dt: 2.0 };
        let simulation = new_simulation(Settings {
            command: turn_command,
            velocity_alphas: alphas,
            samples: 5000,
            ..settings_of_preset("banana")
        });
        let exponential_contour = ExponentialContour::new(&simulation.stats().exponential, &SE2::identity());
        let are_robots_inside = |morph: f64| {
            let morphed_ellipse = unbend_line(&simulation.contours().ellipse, omega * 2.0, morph);
            let morphed_outline = exponential_contour.morphed_boundary(OUTLINE_SEGMENTS, morph);
            [morphed_ellipse, morphed_outline].map(|morphed_outline| {
                simulation
                    .twists()
                    .map(|twist| is_point_inside(&morphed_outline, unbend(&twist, morph)))
                    .collect::<Vec<_>>()
            })
        };
        let inside_flags_on_floor = are_robots_inside(0.0);
        for morph in MORPH_FRACTIONS {
            for (is_inside, is_inside_on_floor) in are_robots_inside(morph).iter().zip(&inside_flags_on_floor)
            {
                let changed_count = is_inside.iter().zip(is_inside_on_floor).filter(|(a, b)| a != b).count();
                assert!(changed_count <= 10, "{changed_count} robots at {morph}");
            }
        }
    }
}

#[test]
fn the_morphed_outline_equals_that_of_each_view_at_its_end() {
    let simulation = new_simulation(Settings { samples: 5000, ..settings_of_preset("hard") });
    let cloud_stats = simulation.stats();
    let xi_contour = ExponentialContour::new(&cloud_stats.exponential, &SE2::identity());
    assert_eq!(xi_contour.morphed_boundary(OUTLINE_SEGMENTS, 0.0), simulation.contours().exponential);
    for outline_point in xi_contour.morphed_boundary(OUTLINE_SEGMENTS, 1.0) {
        assert!((xi_contour.ellipse.mahalanobis_distance(outline_point) - 2.0).abs() < 1e-9);
    }
}

/// A line that does not surround the start stays connected at all stages of the transition. A line around the start is omitted, because the
/// direction of its points from the start jumps by a full circle.
#[test]
fn a_morphed_line_stays_connected_or_is_omitted() {
    let circle_at = |x: f64| -> Vec<[f64; 2]> {
        let circle_angles = (0..=128).map(|i| std::f64::consts::TAU * f64::from(i) / 128.0);
        circle_angles.map(|circle_angle| [x + 0.5 * circle_angle.cos(), 0.5 * circle_angle.sin()]).collect()
    };
    for morph in MORPH_FRACTIONS {
        assert!(unbend_line(&circle_at(0.1), 0.3, morph).is_empty());
        let morphed_line = unbend_line(&circle_at(0.7), 0.3, morph);
        assert_eq!(morphed_line.len(), 129);
        assert!(morphed_line.windows(2).all(|ends| distance_between(ends[0], ends[1]) < 0.4), "{morph}");
    }
    for (circle_point, morphed_point) in circle_at(0.7).iter().zip(unbend_line(&circle_at(0.7), 0.3, 0.0)) {
        assert!(distance_between(*circle_point, morphed_point) < 1e-12);
    }
}

#[test]
fn find_arc_inverts_the_morph() {
    for morph in MORPH_FRACTIONS {
        for [arc_length, arc_turn] in [[1.0, 0.5], [2.0, -1.0], [1.4, 1.7], [0.3, 0.0]] {
            let arc_end = unbend(&Vector3::new(arc_length, 0.0, arc_turn), morph);
            let found_arc = find_arc(arc_end, [arc_length + 0.1, arc_turn - 0.1], morph).expect("an arc");
            assert!(distance_between(found_arc, [arc_length, arc_turn]) < 1e-9, "{morph}: {found_arc:?}");
        }
    }
}

#[test]
fn gaps_of_a_cloud_are_inside_the_ellipse_only_and_contain_no_robot() {
    let simulation = new_simulation(settings_of_preset("banana"));
    let (empty_regions, contours) = (simulation.gaps(), simulation.contours());
    assert_eq!(empty_regions.len(), 2);
    for gap in empty_regions {
        assert!(is_point_inside(&contours.ellipse, gap) && !is_point_inside(&contours.exponential, gap));
        assert_eq!(simulation.find_nearest(0.0, gap, [0.03; 2]), None, "{gap:?}");
    }
    for preset_name in ["straight", "gentle", "hard", "pivot", "worked"] {
        assert!(self::new_simulation(settings_of_preset(preset_name)).gaps().is_empty(), "{preset_name}");
    }
}
