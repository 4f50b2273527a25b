//! Occupancy grids in the format of the ROS `map_server`.

use crate::geom::arc::PreparedPose;
use crate::geom::se2::SE2;
use crate::geom::segment::Segment;
use std::ops::RangeInclusive;

/// Classifier of pixels as free, occupied or unknown cells, with the fields of the YAML file of `map_server`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelClassifier {
    /// Meaning of the pixel values.
    pub mode: MapMode,
    /// True if dark pixels are free instead of occupied.
    pub negate: bool,
    /// Occupancy, from 0 (white) to 1 (black), above which a cell is occupied.
    pub occupied_thresh: f64,
    /// Occupancy below which a cell is free in mode trinary. Between the thresholds a cell is unknown.
    pub free_thresh: f64,
}

/// Defaults of keys that are missing in the YAML file. Unknown cells are saved as the grey 205 of 255, whose occupancy of 0.1961 is just
/// above `free_thresh`.
impl Default for PixelClassifier {
    fn default() -> Self {
        Self { mode: MapMode::Trinary, negate: false, occupied_thresh: 0.65, free_thresh: 0.196 }
    }
}

/// Meaning of the pixels of a map, as in the YAML file of `map_server`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapMode {
    /// Dark pixels are occupied, light pixels are free, and pixels between the thresholds are unknown.
    Trinary,
    /// Transparent pixels are unknown, dark pixels are occupied, and all other pixels are free. In `map_server`, pixels between the
    /// thresholds have intermediate values.
    Scale,
    /// Pixel values are occupancies from 0 to 100. A value of 100 is occupied, and larger values are unknown.
    Raw,
}

/// State of a cell in a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Cell {
    /// Space without an obstacle.
    Free,
    /// Space with an obstacle.
    Occupied,
    /// Space that the mapping robot has not observed.
    Unknown,
}

/// Treatment of unknown cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UnknownCells {
    /// Unknown cells are free, as in particle filters.
    #[default]
    Free,
    /// Unknown cells are obstacles like occupied cells.
    Blocked,
}

/// Grey image with values from 0 (black) to 1 (white), row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image<P = Pixel> {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Pixels. Their number is width · height.
    pub pixels: Vec<P>,
}

/// One pixel of a map image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Mean of red, green and blue, from 0 (black) to 1 (white).
    pub brightness: f32,
    /// Opacity from 0 (transparent) to 1.
    pub opacity: f32,
}

impl From<f32> for Pixel {
    fn from(brightness: f32) -> Self {
        Self { brightness, opacity: 1.0 }
    }
}

impl From<[u8; 4]> for Pixel {
    fn from(rgba_bytes: [u8; 4]) -> Self {
        let [red, green, blue, opacity] = rgba_bytes.map(f32::from);
        Self { brightness: (red + green + blue) / 765.0, opacity: opacity / 255.0 }
    }
}

impl PixelClassifier {
    /// Returns the state of the cell that a pixel shows.
    pub fn classify_pixel(&self, pixel: Pixel) -> Cell {
        let Pixel { brightness, opacity } = pixel;
        let occupancy_degree = if self.negate { brightness } else { 1.0 - brightness };
        // Thresholds are rounded to f32, as the brightness is, so that a pixel exactly at a threshold does not exceed the threshold.
        let (occupied_threshold, free_threshold) = (self.occupied_thresh as f32, self.free_thresh as f32);
        // The grey value is computed only if needed, because rounding is slow on processors without an instruction for it.
        let grey_value_of = || (brightness * 255.0).round();
        match self.mode {
            MapMode::Scale if opacity < 1.0 => Cell::Unknown,
            MapMode::Trinary | MapMode::Scale if occupancy_degree > occupied_threshold => Cell::Occupied,
            // Pixels at the threshold are unknown. Their occupancy may be slightly less than the threshold because of rounding.
            MapMode::Trinary if occupancy_degree > free_threshold - f32::EPSILON => Cell::Unknown,
            MapMode::Raw if grey_value_of() == 100.0 => Cell::Occupied,
            MapMode::Raw if grey_value_of() > 100.0 => Cell::Unknown,
            _ => Cell::Free,
        }
    }
}

/// Range of the side of a cell, m.
pub const RESOLUTION_RANGE: RangeInclusive<f64> = 1e-3..=100.0;

/// Grid of square cells. Occupied cells are obstacles. Unknown cells are obstacles or free, see [`UnknownCells`].
#[derive(Clone, Debug, PartialEq)]
pub struct OccupancyGrid {
    width: usize,
    height: usize,
    /// Side of a cell, m.
    resolution: f64,
    /// Frame of the grid: at the lower left corner of the lower left cell, with its axes along rows and columns.
    origin: SE2,
    plane_to_grid: PreparedPose,
    /// Cells row by row from the bottom.
    cells: Vec<Cell>,
    unknown_treatment: UnknownCells,
}

impl OccupancyGrid {
    /// Creates the grid of an image whose lower left corner is at `origin`, with cells of `resolution` (m, positive).
    /// Unknown cells are free, see [`OccupancyGrid::with_unknown`].
    ///
    /// As in `map_server`, opacity counts as a fourth colour in mode trinary if the image has transparency.
    pub fn new<P: Copy + Into<Pixel>>(
        map_image: &Image<P>,
        pixel_classifier: &PixelClassifier,
        resolution: f64,
        origin: SE2,
    ) -> Self {
        let Image { width, height, ref pixels } = *map_image;
        let has_transparency = pixels.iter().any(|pixel| (*pixel).into().opacity < 1.0);
        let opacity_is_colour = has_transparency && pixel_classifier.mode == MapMode::Trinary;
        let to_cell = |pixel: &P| {
            let mut pixel: Pixel = (*pixel).into();
            if opacity_is_colour {
                pixel.brightness = (3.0 * pixel.brightness + pixel.opacity) / 4.0;
            }
            pixel_classifier.classify_pixel(pixel)
        };
        // The first row of an image is the top row, but the first row of a grid is the bottom row.
        let cells = pixels.chunks(width.max(1)).rev().flatten().map(to_cell).collect();
        let (plane_to_grid, unknown_cells) = (PreparedPose::new(origin.inverse()), UnknownCells::default());
        Self { width, height, resolution, origin, plane_to_grid, cells, unknown_treatment: unknown_cells }
    }

    /// Returns the grid with another treatment of unknown cells.
    #[must_use]
    pub fn with_unknown(self, unknown_treatment: UnknownCells) -> Self {
        Self { unknown_treatment, ..self }
    }

    /// Returns the numbers of columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Returns the side of a cell, m.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// Returns the frame of the grid: at the lower left corner of the lower left cell, with its axes along rows and columns.
    pub fn origin(&self) -> SE2 {
        self.origin
    }

    /// Returns the state of each cell, row by row from the bottom.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = Cell> + '_ {
        self.cells.iter().copied()
    }

    /// Returns true if a point of the plane lies in a cell that is an obstacle.
    pub fn is_blocked_at(&self, point: [f64; 2]) -> bool {
        let [column, row] = self.cell_coordinates(point).map(f64::floor);
        column >= 0.0 && row >= 0.0 && self.is_blocked(self.row_cells(row as usize), column as usize)
    }

    pub(super) fn is_known_free(&self, column: usize, row: usize) -> bool {
        self.row_cells(row).get(column) == Some(&Cell::Free)
    }

    /// Returns true if a point of the plane lies on the grid, its edge included.
    pub fn contains(&self, point: [f64; 2]) -> bool {
        let [column, row] = self.cell_coordinates(point);
        (0.0..=self.width as f64).contains(&column) && (0.0..=self.height as f64).contains(&row)
    }

    /// Returns the corners of the grid, counter-clockwise from the origin.
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let (width, height) = (self.width, self.height);
        [(0, 0), (width, 0), (width, height), (0, height)].map(|(column, row)| self.corner_point(column, row))
    }

    fn corner_point(&self, column: usize, row: usize) -> [f64; 2] {
        self.world_point([column as f64, row as f64])
    }

    /// Returns the point of the plane at grid coordinates, in cells from the origin.
    pub(super) fn world_point(&self, [column, row]: [f64; 2]) -> [f64; 2] {
        (self.origin * SE2::new(column * self.resolution, row * self.resolution, 0.0)).position()
    }

    /// Returns the coordinates of a point of the plane, in cells from the origin.
    pub(super) fn cell_coordinates(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        self.plane_to_grid.transform_point([x, y]).map(|plane_coordinate| plane_coordinate / self.resolution)
    }

    fn is_blocked(&self, row: &[Cell], column: usize) -> bool {
        match row.get(column) {
            Some(Cell::Occupied) => true,
            Some(Cell::Unknown) => self.unknown_treatment == UnknownCells::Blocked,
            _ => false,
        }
    }

    fn row_cells(&self, cell_row: usize) -> &[Cell] {
        let first_cell_index = cell_row.saturating_mul(self.width).min(self.cells.len());
        &self.cells[first_cell_index..(first_cell_index + self.width).min(self.cells.len())]
    }

    /// Returns the outlines of the blocked cells, with neighbouring sides joined. From outside the cells, the distance to the outlines is
    /// the distance to the cells. Lines along rows come first, then lines along columns. Fails with a lower bound of the number of
    /// outlines, if there are more than `max_outlines`.
    pub fn outlines(&self, max_outlines: usize) -> Result<Vec<Segment>, usize> {
        let [column_count, row_count] = self.size();
        let (mut walls, mut vertical_walls) = (Vec::new(), Vec::new());
        // An outline separates blocked cells from all others. `outline_starts` has, for each grid line between columns, the
        // row at which the current outline began.
        let mut outline_starts = vec![None; column_count + 1];
        for row in 0..=row_count {
            let cells = self.row_cells(row);
            let cells_below = row.checked_sub(1).map_or(&[][..], |row_below| self.row_cells(row_below));
            if cells == cells_below {
                continue;
            }
            let (mut outline_start_column, mut is_left_blocked) = (None, false);
            for (column, outline_start) in outline_starts.iter_mut().enumerate() {
                let [is_cell_blocked, is_below_blocked] =
                    [cells, cells_below].map(|row| self.is_blocked(row, column));
                if let Some(from) =
                    update_outline(&mut outline_start_column, is_below_blocked != is_cell_blocked, column)
                {
                    walls.push(self.wall_between([from, row], [column, row]));
                }
                if let Some(first_row) =
                    update_outline(outline_start, is_left_blocked != is_cell_blocked, row)
                {
                    vertical_walls.push([column, first_row, row]);
                }
                is_left_blocked = is_cell_blocked;
            }
            if walls.len() + vertical_walls.len() > max_outlines {
                return Err(max_outlines + 1);
            }
        }
        vertical_walls.sort_unstable();
        walls.extend(
            vertical_walls
                .into_iter()
                .map(|[column, from, line_end]| self.wall_between([column, from], [column, line_end])),
        );
        Ok(walls)
    }

    fn wall_between(&self, from: [usize; 2], to: [usize; 2]) -> Segment {
        Segment { from: self.corner_point(from[0], from[1]), to: self.corner_point(to[0], to[1]) }
    }
}

/// Moves along a grid line to the corner `corner_index`. `is_outline` is true if the line separates blocked from other cells after the
/// corner. `outline_start` is the corner at which the current outline began, if any. It is returned if the outline ends at the corner.
fn update_outline(outline_start: &mut Option<usize>, is_outline: bool, corner_index: usize) -> Option<usize> {
    match *outline_start {
        None if is_outline => *outline_start = Some(corner_index),
        Some(_) if !is_outline => return outline_start.take(),
        _ => (),
    }
    None
}
