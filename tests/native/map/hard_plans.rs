//! Floor plans with many walls in one place. A collision check must be fast there, and measure the distance to only a few walls.

use crate::common::{sample_uniform, seeded_rng};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::FloorPlan;
use rand::Rng;
use std::f64::consts::{PI, TAU};

const ROOM_BOUNDS: [f64; 4] = [0.0, 0.0, 10.0, 10.0];

fn new_wall(start_x: f64, start_y: f64, end_x: f64, end_y: f64) -> Segment {
    let [start_x, start_y, end_x, end_y] = [start_x, start_y, end_x, end_y].map(|x| x.clamp(0.0, 10.0));
    Segment { from: [start_x, start_y], to: [end_x, end_y] }
}

/// Returns names and walls of floor plans. Their many walls are in one place, on one line, through one point, around one point, or nearly
/// equal.
fn create_hard_plans(wall_count: usize) -> Vec<(&'static str, Vec<Segment>)> {
    let mut rng = seeded_rng(9800);
    let make_walls = |make_wall: &mut dyn FnMut(f64) -> Segment| {
        (0..wall_count).map(|i| make_wall(i as f64 / wall_count as f64)).collect()
    };
    let diagonal_of =
        |line_offset: f64| move |s: f64| new_wall(line_offset * s, 0.0, 10.0, 10.0 - line_offset * s);
    let wall_along_ray = |s: f64, ray_length: f64| {
        let (sin, cos) = (TAU * s).sin_cos();
        new_wall(5.0, 5.0, 5.0 + ray_length * cos, 5.0 + ray_length * sin)
    };
    let mut sample_coordinate = move || sample_uniform(&mut rng, 0.0, 10.0);
    vec![
        ("equal diagonals", make_walls(&mut diagonal_of(0.0))),
        ("nearly equal diagonals", make_walls(&mut diagonal_of(1e-9))),
        ("diagonals close together", make_walls(&mut diagonal_of(0.1))),
        ("equal but for their direction", {
            let mut is_forward = false;
            make_walls(&mut |_| {
                is_forward = !is_forward;
                if is_forward { new_wall(1.0, 2.0, 9.0, 7.0) } else { new_wall(9.0, 7.0, 1.0, 2.0) }
            })
        }),
        (
            "covered by a longer one",
            make_walls(&mut |s| new_wall(5.0 - 4.0 * s, 5.0 - 3.0 * s, 5.0 + 4.0 * s, 5.0 + 3.0 * s)),
        ),
        ("overlapping", make_walls(&mut |s| new_wall(6.0 * s, 3.0, 6.0 * s + 4.0, 3.0))),
        ("dots on a line", make_walls(&mut |s| new_wall(10.0 * s, 5.0, 10.0 * s, 5.0))),
        ("a star", make_walls(&mut |s| wall_along_ray(s, 5.0))),
        ("all in one cell", make_walls(&mut |s| wall_along_ray(s, 1e-3))),
        (
            "tangents to a circle",
            make_walls(&mut |s| {
                let (sin, cos) = (TAU * s).sin_cos();
                let point_on_line = |t: f64| [5.0 + 0.5 * cos - t * sin, 5.0 + 0.5 * sin + t * cos];
                let ([start_x, start_y], [end_x, end_y]) = (point_on_line(-3.0), point_on_line(3.0));
                new_wall(start_x, start_y, end_x, end_y)
            }),
        ),
        (
            "long ones anywhere",
            make_walls(&mut |_| {
                let [start_x, start_y, end_x, end_y] = std::array::from_fn(|_| sample_coordinate());
                new_wall(start_x, start_y, end_x, end_y)
            }),
        ),
        ("a mesh", {
            let mut is_horizontal = false;
            make_walls(&mut |s| {
                is_horizontal = !is_horizontal;
                if is_horizontal {
                    new_wall(0.0, 10.0 * s, 10.0, 10.0 * s)
                } else {
                    new_wall(10.0 * s, 0.0, 10.0 * s, 10.0)
                }
            })
        }),
    ]
}

fn sample_arc(rng: &mut impl Rng) -> Arc {
    let is_near_centre = rng.next_u32().is_multiple_of(2);
    let [x, y] = std::array::from_fn(|_| {
        if is_near_centre { sample_uniform(rng, 4.9, 5.1) } else { sample_uniform(rng, 2.0, 8.0) }
    });
    let arc_length = [0.001, 0.3, 2.0][(rng.next_u32() % 3) as usize];
    Arc {
        start: SE2::new(x, y, sample_uniform(rng, -PI, PI)),
        length: arc_length,
        turn: sample_uniform(rng, -1.0, 1.0),
    }
}

const MAX_MEAN_WALL_TESTS: usize = FloorPlan::MAX_WALLS / 200;

#[test]
fn a_collision_check_in_a_hard_plan_measures_few_walls() {
    for (plan_name, walls) in create_hard_plans(FloorPlan::MAX_WALLS) {
        let floor_plan = FloorPlan::new(walls, ROOM_BOUNDS).expect("allowed");
        assert_eq!(floor_plan.walls().len(), FloorPlan::MAX_WALLS);
        let mut rng = seeded_rng(9802);
        let wall_tests: usize =
            (0..300).map(|_| floor_plan.test_arc(&sample_arc(&mut rng), 0.13).wall_tests).sum();
        assert!(wall_tests < 300 * MAX_MEAN_WALL_TESTS, "{plan_name}: {wall_tests}");
    }
}
