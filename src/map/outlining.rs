//! The outlines of cells, row by row.

use super::occupancy::{MANY, OccupancyGrid};
use crate::geom::segment::Segment;

/// Outlines that are being followed: see [`OccupancyGrid::outlines`].
#[derive(Clone, Debug, Default)]
pub struct Outlining {
    /// Those along the rows.
    sides: Vec<Segment>,
    /// Those along the columns: a column, and the rows where one begins and ends.
    upright: Vec<[usize; 3]>,
    /// Of each grid line between columns, where its present outline began.
    began: Vec<Option<usize>>,
    /// The next row to look at: each is compared with the one below it.
    row: usize,
}

/// Cells of a row that are looked at in the time that a distance takes.
const CELLS: usize = 8;

impl Outlining {
    /// Follows them as far as `work` allows (about that many distances computed), by whole rows; whether all is done. The grid
    /// is the same each time.
    ///
    /// # Errors
    /// So many there are at least, where there are more than `most`.
    pub fn advance(&mut self, grid: &OccupancyGrid, most: usize, work: &mut usize) -> Result<bool, usize> {
        let [columns, rows] = grid.size();
        self.began.resize(columns + 1, None);
        while self.row <= rows && *work > 0 {
            self.follow(grid);
            self.row += 1;
            *work = work.saturating_sub(1 + columns / CELLS);
            if self.sides.len() + self.upright.len() > most {
                return Err(most + 1);
            }
        }
        Ok(self.row > rows)
    }

    /// Between cells on either side of a grid line there is an outline where just one is in the way. Row by row, as the cells lie
    /// in memory.
    fn follow(&mut self, grid: &OccupancyGrid) {
        let (row, [columns, _]) = (self.row, grid.size());
        let here = grid.row(row);
        let below = row.checked_sub(1).map_or(&[][..], |below| grid.row(below));
        let at = |cells: &[u8], column: usize| cells.get(column).is_some_and(|code| grid.blocks(*code));
        let (mut column, mut from, mut left) = (0, None, false);
        while column <= columns {
            // Many cells that are as below them begin no outline and end none, nor does the line before them: outside of an
            // outline along the rows, the cell there is as below it too.
            let next = |cells: &[u8]| Some(grid.many_blocked(*cells.get(column..)?.first_chunk()?));
            if from.is_none() && next(here).is_some_and(|codes| next(below) == Some(codes)) {
                column += MANY;
                left = at(here, column - 1);
                continue;
            }
            let [blocked, was] = [here, below].map(|cells| at(cells, column));
            if (was != blocked) != from.is_some() {
                match from.take() {
                    Some(from) => self.sides.push(grid.side([from, row], [column, row])),
                    None => from = Some(column),
                }
            }
            if (left != blocked) != self.began[column].is_some() {
                match self.began[column].take() {
                    Some(began) => self.upright.push([column, began, row]),
                    None => self.began[column] = Some(row),
                }
            }
            left = blocked;
            column += 1;
        }
    }

    /// All of them, once they are there: those along the columns in the order of the grid lines, those of each as they are.
    pub fn finish(self, grid: &OccupancyGrid) -> Vec<Segment> {
        let Self { mut sides, upright, began, .. } = self;
        let mut places = vec![0; began.len() + 1];
        upright.iter().for_each(|[column, ..]| places[column + 1] += 1);
        (1..began.len()).for_each(|line| places[line] += places[line - 1]);
        let first = sides.len();
        sides.resize(first + upright.len(), Segment { from: [0.0; 2], to: [0.0; 2] });
        for [column, from, to] in upright {
            sides[first + places[column]] = grid.side([column, from], [column, to]);
            places[column] += 1;
        }
        sides
    }

    /// How much is done, from 0 to 1.
    pub fn done(&self, grid: &OccupancyGrid) -> f64 {
        self.row as f64 / (grid.size()[1] + 1) as f64
    }
}
