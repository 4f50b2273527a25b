//! Density images, in which the colour of a pixel shows the number of samples in its cell.

use crate::common::settings_of_preset;
use motion::sim::banana::{BananaMachine, Settings};
use motion::sim::picture::{RAMP_STEP_COUNT, Ramp};
use motion::sim::squeeze::{self, MapSqueeze, OUTCOME_KIND_COUNT};
use motion::sim::views::ViewGrid;

/// Returns grids over the middle of a cloud, so that samples are outside on every side. Painting skips sixteen empty cells at once. One grid
/// is therefore 16 cells wide, one 17, and the others have different widths.
fn new_grids_over(min_corner: [f64; 2], max_corner: [f64; 2]) -> [ViewGrid; 4] {
    [(16, 9), (17, 1), (53, 40), (3, 2)].map(|(column_count, row_count)| ViewGrid {
        min_corner,
        max_corner,
        column_count,
        row_count,
    })
}

/// Returns a colour ramp. Each colour encodes its index in the ramp, and the number of the ramp.
fn new_numbered_ramp(ramp_number: u8) -> Ramp {
    std::array::from_fn(|ramp_step| [ramp_step as u8, ramp_number, 7, 255])
}

fn find_cell_index(view_grid: &ViewGrid, [x, y]: [f64; 2]) -> Option<usize> {
    let ViewGrid { min_corner: lower_corner, max_corner: max, column_count, row_count } = *view_grid;
    let column_number = ((x - lower_corner[0]) / (max[0] - lower_corner[0]) * column_count as f64).floor();
    let row_index = ((max[1] - y) / (max[1] - lower_corner[1]) * row_count as f64).floor();
    let is_inside =
        (0.0..column_count as f64).contains(&column_number) && (0.0..row_count as f64).contains(&row_index);
    is_inside.then(|| row_index as usize * column_count + column_number as usize)
}

/// Returns the index of the colour for a sample count: 255·√(count/max_count), rounded.
fn ramp_step_of(sample_count: u32, max_count: u32) -> u8 {
    ((RAMP_STEP_COUNT - 1) as f64 * (f64::from(sample_count) / f64::from(max_count)).sqrt()).round() as u8
}

#[test]
fn pixels_show_the_density_of_the_cloud() {
    let settings = Settings { samples: 3000, ..settings_of_preset("gentle") };
    let mut simulation = BananaMachine::new(settings).expect("a valid setting");
    let robot_positions: Vec<[f64; 2]> = simulation.poses().map(|pose| [pose.x(), pose.y()]).collect();
    let twist_points: Vec<[f64; 2]> = simulation.twists().map(|twist| [twist.x, twist.z]).collect();
    let create_case =
        |morph_fraction, sample_points| move |view_grid| (morph_fraction, sample_points, view_grid);
    let plane_cases = new_grids_over([0.75, -0.2], [1.2, 0.4]).map(create_case(0.0, &robot_positions));
    let twist_cases = new_grids_over([0.75, 0.1], [1.2, 0.7]).map(create_case(1.0, &twist_points));
    for (morph_fraction, cloud_points, view_grid) in plane_cases.into_iter().chain(twist_cases) {
        let mut cell_counts = vec![0u32; view_grid.column_count * view_grid.row_count];
        cloud_points
            .iter()
            .filter_map(|sample_point| find_cell_index(&view_grid, *sample_point))
            .for_each(|cell_index| cell_counts[cell_index] += 1);
        let max_count = *cell_counts.iter().max().expect("there are cells");
        assert!((1..3000).contains(&cell_counts.iter().sum::<u32>()), "some are outside");
        // The picture is painted twice, because no pixel of the first painting may remain.
        for paint_pass in ["first", "second"] {
            let pixels = simulation.paint_picture(morph_fraction, &view_grid, &new_numbered_ramp(3));
            assert_eq!(pixels.len(), cell_counts.len());
            for (i, (rgba, cell_count)) in pixels.iter().zip(&cell_counts).enumerate() {
                let expected_pixel =
                    if *cell_count == 0 { [0; 4] } else { [ramp_step_of(*cell_count, max_count), 3, 7, 255] };
                assert_eq!(*rgba, expected_pixel, "{paint_pass}, cell {i} of {view_grid:?}");
            }
            assert_eq!(simulation.density(morph_fraction, &view_grid), cell_counts, "{paint_pass}");
        }
    }
}

#[test]
fn cells_have_the_colour_of_their_most_frequent_outcome() {
    // The robot faces a wall. The sampler tests only end poses, and therefore accepts many attempts that end behind the wall.
    let start_at_wall = settings_of_preset::<squeeze::Settings>("wall").start;
    let settings = squeeze::Settings { start: start_at_wall, samples: 3000, ..squeeze::Settings::default() };
    let mut simulation = MapSqueeze::new(settings).expect("a valid setting");
    let mut painted_cell_counts = [0; OUTCOME_KIND_COUNT];
    for view_grid in new_grids_over([2.9, 3.4], [3.7, 4.9]) {
        let mut cell_counts = vec![[0u32; OUTCOME_KIND_COUNT]; view_grid.column_count * view_grid.row_count];
        for attempt in simulation.attempts() {
            if let Some(cell_index) = find_cell_index(&view_grid, [attempt.pose.x(), attempt.pose.y()]) {
                cell_counts[cell_index][attempt.outcome_kind()] += 1;
            }
        }
        let cell_totals: Vec<u32> =
            cell_counts.iter().map(|outcome_counts| outcome_counts.iter().sum()).collect();
        let max_count = *cell_totals.iter().max().expect("there are cells");
        assert!((1..3000).contains(&cell_totals.iter().sum::<u32>()), "some are outside");
        for _ in 0..2 {
            let outcome_ramps = std::array::from_fn(|outcome_index| new_numbered_ramp(outcome_index as u8));
            let pixels = simulation.paint_picture(&view_grid, &outcome_ramps);
            assert_eq!(pixels.len(), cell_totals.len());
            for ((rgba, outcome_counts), cell_total) in pixels.iter().zip(&cell_counts).zip(&cell_totals) {
                if *cell_total == 0 {
                    assert_eq!(*rgba, [0; 4]);
                    continue;
                }
                let [ramp_shade, outcome_index, ..] = *rgba;
                let expected_step = ramp_step_of(*cell_total, max_count);
                assert_eq!(*rgba, [expected_step, outcome_index, 7, 255], "{outcome_counts:?}");
                assert!(
                    outcome_counts
                        .iter()
                        .all(|outcome_count| *outcome_count <= outcome_counts[usize::from(outcome_index)]),
                    "{ramp_shade}: {outcome_counts:?}"
                );
                painted_cell_counts[usize::from(outcome_index)] += 1;
            }
        }
    }
    assert!(
        painted_cell_counts.iter().all(|painted_count| *painted_count > 0),
        "all kinds are seen: {painted_cell_counts:?}"
    );
}
