//! Density images, in which the colour of a pixel shows the number of samples in its cell.

use crate::common::settings_of_preset;
use motion::sim::View;
use motion::sim::banana::{BananaMachine, Settings};
use motion::sim::picture::{RAMP_STEP_COUNT, Ramp};
use motion::sim::squeeze::{self, MapSqueeze, OUTCOME_KIND_COUNT};
use motion::sim::views::ViewGrid;

/// Returns grids over the middle of a cloud, so that samples are outside on every side. Painting skips sixteen empty cells at once. One grid
/// is therefore 16 cells wide, one 17, and the others have different widths.
fn grids_over(min_corner: [f64; 2], max_corner: [f64; 2]) -> [ViewGrid; 4] {
    let grid_sizes = [(16, 9), (17, 1), (53, 40), (3, 2)];
    grid_sizes.map(|(columns, rows)| ViewGrid { min_corner, max_corner, columns, rows })
}

/// Returns a colour ramp whose colours contain their step and the number of the ramp.
fn numbered_ramp(ramp_number: u8) -> Ramp {
    std::array::from_fn(|ramp_step| [ramp_step as u8, ramp_number, 7, 255])
}

/// Returns the index of the cell that contains a point, row by row from the top.
fn cell_index(grid: &ViewGrid, [x, y]: [f64; 2]) -> Option<usize> {
    let ViewGrid { min_corner: min, max_corner: max, columns, rows } = *grid;
    let column = ((x - min[0]) / (max[0] - min[0]) * columns as f64).floor();
    let row = ((max[1] - y) / (max[1] - min[1]) * rows as f64).floor();
    let is_inside = (0.0..columns as f64).contains(&column) && (0.0..rows as f64).contains(&row);
    is_inside.then(|| row as usize * columns + column as usize)
}

/// Returns the step of the ramp for a count: 255·√(count/max_count), rounded.
fn ramp_step(sample_count: u32, max_count: u32) -> u8 {
    ((RAMP_STEP_COUNT - 1) as f64 * (f64::from(sample_count) / f64::from(max_count)).sqrt()).round() as u8
}

#[test]
fn pixels_show_the_density_of_the_cloud() {
    let settings = Settings { samples: 3000, ..settings_of_preset("gentle") };
    let mut simulation = BananaMachine::new(settings).expect("a valid setting");
    let positions: Vec<[f64; 2]> = simulation.poses().map(|pose| [pose.x(), pose.y()]).collect();
    let twists: Vec<[f64; 2]> = simulation.twists().map(|twist| [twist.x, twist.z]).collect();
    let new_case = |view, sample_points| move |grid| (view, sample_points, grid);
    let plane_cases = grids_over([0.75, -0.2], [1.2, 0.4]).map(new_case(View::Plane, &positions));
    let twist_cases = grids_over([0.75, 0.1], [1.2, 0.7]).map(new_case(View::Twist, &twists));
    for (view, points, grid) in plane_cases.into_iter().chain(twist_cases) {
        let mut cell_counts = vec![0u32; grid.columns * grid.rows];
        points
            .iter()
            .filter_map(|sample_point| cell_index(&grid, *sample_point))
            .for_each(|cell_index| cell_counts[cell_index] += 1);
        let max_count = *cell_counts.iter().max().expect("there are cells");
        assert!((1..3000).contains(&cell_counts.iter().sum::<u32>()), "some are outside");
        // The picture is painted twice, because no pixel may remain from the first time.
        for paint_pass in ["first", "second"] {
            let pixels = simulation.paint(view, &grid, &numbered_ramp(3));
            assert_eq!(pixels.len(), cell_counts.len());
            for (i, (pixel, cell_count)) in pixels.iter().zip(&cell_counts).enumerate() {
                let expected_pixel =
                    if *cell_count == 0 { [0; 4] } else { [ramp_step(*cell_count, max_count), 3, 7, 255] };
                assert_eq!(*pixel, expected_pixel, "{paint_pass}, cell {i} of {grid:?}");
            }
            assert_eq!(simulation.density(view, &grid), cell_counts, "{paint_pass}");
        }
    }
}

#[test]
fn cells_have_the_colour_of_their_most_frequent_outcome() {
    // The robot faces a wall. The sampler tests only end poses, and therefore accepts many attempts that end behind the wall.
    let start = settings_of_preset::<squeeze::Settings>("wall").start;
    let settings = squeeze::Settings { start, samples: 3000, ..squeeze::Settings::default() };
    let mut simulation = MapSqueeze::new(settings).expect("a valid setting");
    let mut painted_cell_counts = [0; OUTCOME_KIND_COUNT];
    for grid in grids_over([2.9, 3.4], [3.7, 4.9]) {
        let mut cell_counts = vec![[0u32; OUTCOME_KIND_COUNT]; grid.columns * grid.rows];
        for attempt in simulation.attempts() {
            if let Some(cell_index) = cell_index(&grid, [attempt.pose.x(), attempt.pose.y()]) {
                cell_counts[cell_index][attempt.outcome_kind()] += 1;
            }
        }
        let cell_totals: Vec<u32> =
            cell_counts.iter().map(|counts_by_kind| counts_by_kind.iter().sum()).collect();
        let max_count = *cell_totals.iter().max().expect("there are cells");
        assert!((1..3000).contains(&cell_totals.iter().sum::<u32>()), "some are outside");
        for _ in 0..2 {
            let ramps = std::array::from_fn(|outcome| numbered_ramp(outcome as u8));
            let pixels = simulation.paint(&grid, &ramps);
            assert_eq!(pixels.len(), cell_totals.len());
            for ((pixel, counts_by_kind), cell_total) in pixels.iter().zip(&cell_counts).zip(&cell_totals) {
                if *cell_total == 0 {
                    assert_eq!(*pixel, [0; 4]);
                    continue;
                }
                let [ramp_shade, outcome, ..] = *pixel;
                let expected_step = ramp_step(*cell_total, max_count);
                assert_eq!(*pixel, [expected_step, outcome, 7, 255], "{counts_by_kind:?}");
                assert!(
                    counts_by_kind.iter().all(|count| *count <= counts_by_kind[usize::from(outcome)]),
                    "{ramp_shade}: {counts_by_kind:?}"
                );
                painted_cell_counts[usize::from(outcome)] += 1;
            }
        }
    }
    assert!(
        painted_cell_counts.iter().all(|painted_count| *painted_count > 0),
        "all kinds are seen: {painted_cell_counts:?}"
    );
}
