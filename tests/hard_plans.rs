//! Plans that are allowed and meant to be hard: how much they take, and that every verdict is right.

mod common;

use common::{seeded, uniform};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::FloorPlan;
use std::f64::consts::TAU;

const ROOM: [f64; 4] = [0.0, 0.0, 10.0, 10.0];

fn wall(x0: f64, y0: f64, x1: f64, y1: f64) -> Segment {
    let [x0, y0, x1, y1] = [x0, y0, x1, y1].map(|x| x.clamp(0.0, 10.0));
    Segment { from: [x0, y0], to: [x1, y1] }
}

fn plans(count: usize) -> Vec<(&'static str, Vec<Segment>)> {
    let mut rng = seeded(9800);
    let share = |i: usize| i as f64 / count as f64;
    let all = |make: &mut dyn FnMut(usize) -> Segment| (0..count).map(make).collect::<Vec<_>>();
    vec![
        ("equal diagonals", all(&mut |_| wall(0.0, 0.0, 10.0, 10.0))),
        ("nearly equal diagonals", all(&mut |i| wall(1e-9 * share(i), 0.0, 10.0, 10.0 - 1e-9 * share(i)))),
        (
            "diagonals a millimetre apart",
            all(&mut |i| wall(0.001 * share(i), 0.0, 10.0, 10.0 - 0.001 * share(i))),
        ),
        ("diagonals a decimetre apart", all(&mut |i| wall(0.1 * share(i), 0.0, 10.0, 10.0 - 0.1 * share(i)))),
        (
            "equal, either way",
            all(&mut |i| if i % 2 == 0 { wall(1.0, 2.0, 9.0, 7.0) } else { wall(9.0, 7.0, 1.0, 2.0) }),
        ),
        ("nested on one line", all(&mut |i| wall(5.0 - 4.0 * share(i), 5.0, 5.0 + 4.0 * share(i), 5.0))),
        (
            "nested on a slant",
            all(&mut |i| {
                wall(5.0 - 4.0 * share(i), 5.0 - 3.0 * share(i), 5.0 + 4.0 * share(i), 5.0 + 3.0 * share(i))
            }),
        ),
        ("overlapping on one line", all(&mut |i| wall(6.0 * share(i), 3.0, 6.0 * share(i) + 4.0, 3.0))),
        ("dots on one line", all(&mut |i| wall(10.0 * share(i), 5.0, 10.0 * share(i), 5.0))),
        (
            "a star",
            all(&mut |i| {
                let (sin, cos) = (0.5 * TAU * share(i)).sin_cos();
                wall(5.0 - 5.0 * cos, 5.0 - 5.0 * sin, 5.0 + 5.0 * cos, 5.0 + 5.0 * sin)
            }),
        ),
        (
            "tangents to a circle",
            all(&mut |i| {
                let (sin, cos) = (TAU * share(i)).sin_cos();
                let r = 0.5;
                wall(
                    5.0 + r * cos - 3.0 * sin,
                    5.0 + r * sin + 3.0 * cos,
                    5.0 + r * cos + 3.0 * sin,
                    5.0 + r * sin - 3.0 * cos,
                )
            }),
        ),
        (
            "dots on a circle",
            all(&mut |i| {
                let (sin, cos) = (TAU * share(i)).sin_cos();
                wall(5.0 + 0.5 * cos, 5.0 + 0.5 * sin, 5.0 + 0.5 * cos, 5.0 + 0.5 * sin)
            }),
        ),
        (
            "all in one cell",
            all(&mut |i| {
                let (sin, cos) = (TAU * share(i)).sin_cos();
                wall(5.0, 5.0, 5.0 + 1e-3 * cos, 5.0 + 1e-3 * sin)
            }),
        ),
        (
            "long ones at random",
            all(&mut |_| {
                wall(
                    uniform(&mut rng, 0.0, 10.0),
                    uniform(&mut rng, 0.0, 10.0),
                    uniform(&mut rng, 0.0, 10.0),
                    uniform(&mut rng, 0.0, 10.0),
                )
            }),
        ),
        (
            "short ones at random",
            all(&mut |_| {
                let (x, y) = (uniform(&mut rng, 0.0, 10.0), uniform(&mut rng, 0.0, 10.0));
                wall(x, y, x + uniform(&mut rng, -0.05, 0.05), y + uniform(&mut rng, -0.05, 0.05))
            }),
        ),
        ("from one corner", all(&mut |i| wall(0.0, 0.0, 10.0, 10.0 * share(i)))),
        (
            "a mesh",
            all(&mut |i| {
                if i % 2 == 0 {
                    wall(0.0, 10.0 * share(i), 10.0, 10.0 * share(i))
                } else {
                    wall(10.0 * share(i), 0.0, 10.0 * share(i), 10.0)
                }
            }),
        ),
        (
            "a slanted mesh",
            all(&mut |i| {
                if i % 2 == 0 {
                    wall(0.0, 10.0 * share(i), 10.0 - 10.0 * share(i), 10.0)
                } else {
                    wall(10.0 * share(i), 0.0, 10.0, 10.0 - 10.0 * share(i))
                }
            }),
        ),
    ]
}

fn cpu() -> f64 {
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .unwrap()
        .split(' ')
        .next()
        .unwrap()
        .parse::<f64>()
        .unwrap()
        * 1e-9
}

#[test]
fn timing() {
    let count: usize = std::env::var("COUNT").map_or(100_000, |count| count.parse().expect("a number"));
    for (name, walls) in plans(count) {
        let mut plan = FloorPlan::new(walls.clone(), ROOM).expect("allowed");
        let began = cpu();
        let mut work = usize::MAX;
        plan.prepare(&mut work);
        let prepared = (cpu() - began);
        let mut said = String::new();
        for clearance in [0.0, 0.13, 0.5] {
            let mut rng = seeded(1);
            let began = cpu();
            let (mut free, mut tests) = (0, 0);
            for i in 0..600 {
                let at = if i % 2 == 0 {
                    [5.0 + uniform(&mut rng, -0.01, 0.01), 5.0 + uniform(&mut rng, -0.01, 0.01)]
                } else {
                    [uniform(&mut rng, 2.0, 8.0), uniform(&mut rng, 2.0, 8.0)]
                };
                let arc = Arc {
                    start: SE2::new(at[0], at[1], uniform(&mut rng, -3.0, 3.0)),
                    length: [0.001, 0.3, 2.0][i % 3],
                    turn: uniform(&mut rng, -1.0, 1.0),
                };
                let verdict = plan.arc_free(&arc, clearance);
                free += usize::from(verdict.free);
                tests += verdict.wall_tests;
            }
            said += &format!(" | c {clearance}: {:6.1} ms {free} free {tests} tests", 1e3 * (cpu() - began));
        }
        println!("{name:30} {:7.1} ms work {:9} {said}", 1e3 * prepared, usize::MAX - work);
    }
}
