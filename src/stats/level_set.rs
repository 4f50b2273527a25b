//! Contour lines (level sets) of a field that is known at the points of a grid, by marching squares.

const NO_EDGE: usize = usize::MAX;

/// Returns the lines on which a field has the value `contour_level`. Between neighbouring points the field is interpolated linearly. The
/// mean of the four corners decides how a saddle is connected.
///
/// `field_values` are finite, at the points of a grid, row by row with `column_count` in each row. The points of the returned lines are
/// (column, row), in steps of the grid from its first point. A line ends where it began, or at the border of the grid.
pub fn trace_level_set(field_values: &[f64], column_count: usize, contour_level: f64) -> Vec<Vec<[f64; 2]>> {
    let row_count = field_values.len() / column_count.max(1);
    // For each edge of the grid that a line crosses: the previous and the next edge that the line crosses. Edge 2i leads from point i to
    // the next point in its row; edge 2i + 1 leads to the point in the next row.
    let mut edge_links = vec![[NO_EDGE; 2]; 2 * field_values.len()];
    let mut link_edges = |edge_a: usize, edge_b: usize| {
        for (cell_edge, linked_edge) in [(edge_a, edge_b), (edge_b, edge_a)] {
            let first_free_slot = usize::from(edge_links[cell_edge][0] != NO_EDGE);
            edge_links[cell_edge][first_free_slot] = linked_edge;
        }
    };
    for grid_row in 1..row_count {
        for grid_column in 1..column_count {
            let i = (grid_row - 1) * column_count + grid_column - 1;
            // Field values at the corners of the cell, and indices of its edges. Corner k lies between the edges k − 1 and k.
            let corner_values = [i, i + 1, i + column_count + 1, i + column_count]
                .map(|point_index| field_values[point_index]);
            let cell_edges = [2 * i, 2 * i + 3, 2 * (i + column_count), 2 * i + 1];
            let is_above = corner_values.map(|corner_value| corner_value > contour_level);
            let is_crossed = |k: &usize| is_above[*k] != is_above[(k + 1) % 4];
            let mut crossed_edges = (0..4).filter(is_crossed).map(|k| cell_edges[k]);
            match (crossed_edges.next(), crossed_edges.next(), crossed_edges.next()) {
                (Some(edge_a), Some(edge_b), None) => link_edges(edge_a, edge_b),
                (Some(_), Some(_), Some(_)) => {
                    let is_centre_above = corner_values.iter().sum::<f64>() > 4.0 * contour_level;
                    let first_corner = if is_centre_above == is_above[0] { 0 } else { 1 };
                    link_edges(cell_edges[first_corner], cell_edges[(first_corner + 1) % 4]);
                    link_edges(cell_edges[first_corner + 2], cell_edges[(first_corner + 3) % 4]);
                }
                _ => {}
            }
        }
    }
    let crossing_point_on = |cell_edge: usize| {
        let (i, is_vertical) = (cell_edge / 2, cell_edge % 2 == 1);
        let (start_value, end_value) =
            (field_values[i], field_values[if is_vertical { i + column_count } else { i + 1 }]);
        let fraction_along_edge = ((contour_level - start_value) / (end_value - start_value)).clamp(0.0, 1.0);
        let (column, row) = ((i % column_count) as f64, (i / column_count) as f64);
        if is_vertical { [column, row + fraction_along_edge] } else { [column + fraction_along_edge, row] }
    };
    let mut contour_lines = Vec::new();
    let border_edges = (0..edge_links.len())
        .filter(|cell_edge| edge_links[*cell_edge][0] != NO_EDGE && edge_links[*cell_edge][1] == NO_EDGE);
    // Contour lines that end at the border are followed first. The remaining contour lines are closed.
    for first_edge in border_edges.chain(0..edge_links.len()).collect::<Vec<_>>() {
        if edge_links[first_edge][0] == NO_EDGE {
            continue;
        }
        let (mut contour_line, mut cell_edge) = (vec![crossing_point_on(first_edge)], first_edge);
        loop {
            let [edge_a, edge_b] = std::mem::replace(&mut edge_links[cell_edge], [NO_EDGE; 2]);
            let next_edge =
                if edge_a != NO_EDGE && edge_links[edge_a][0] != NO_EDGE { edge_a } else { edge_b };
            if next_edge == NO_EDGE || edge_links[next_edge][0] == NO_EDGE {
                if (edge_a == first_edge || edge_b == first_edge) && contour_line.len() > 2 {
                    contour_line.push(contour_line[0]);
                }
                break;
            }
            contour_line.push(crossing_point_on(next_edge));
            cell_edge = next_edge;
        }
        contour_lines.push(contour_line);
    }
    contour_lines
}
