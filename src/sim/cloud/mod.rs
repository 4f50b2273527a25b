//! Cloud of robots that start at the origin: draws, end poses, and statistics.

pub(super) mod draws;
pub(super) mod drive;
pub mod picture;
pub mod views;

pub use views::View;

use crate::geom::lanes::{LANES, lanes};
use crate::geom::se2::SE2;
use crate::noise::NoiseKind;
use crate::stats::fused::{CloudFigures, CloudShape, Spread};
use draws::Draws;
use drive::Drive;
use std::collections::TryReserveError;
use std::ops::Range;
use wide::f64x4;

/// Start pose of every robot: the origin, heading along x.
pub const START: SE2 = SE2::identity();

/// Number of groups of four that are summed without compensation: 256 poses. With fewer, compensation would take
/// noticeable time; with more, the rounding error would grow in proportion.
const BLOCK: usize = 64;

/// Cloud as a structure of arrays in groups of four samples. A sample takes 24 bytes of noise and 16 of position. Headings
/// and logarithms are cheap to compute, and not stored.
#[derive(Clone, Debug)]
pub struct Cloud {
    draws: Draws,
    drive: Drive,
    positions: Vec<[f64x4; 2]>,
    shown: usize,
}

impl Cloud {
    pub fn new(seed: u64, noise: NoiseKind, drive: Drive) -> Self {
        Self { draws: Draws::new(seed, noise), drive, positions: Vec::new(), shown: 0 }
    }

    /// Reserves memory for `count` samples.
    pub fn reserve(&mut self, count: usize) -> Result<(), TryReserveError> {
        self.draws.reserve(count)?;
        let fours = count.div_ceil(LANES);
        self.positions.try_reserve_exact(fours.saturating_sub(self.positions.len()))
    }

    /// Drives the first `shown` samples, and returns their statistics. Their memory must be reserved.
    pub fn refresh(&mut self, seed: u64, noise: NoiseKind, drive: Drive, shown: usize) -> CloudFigures {
        self.draws.restart(seed, noise);
        (self.drive, self.shown) = (drive, shown);
        // Sums contain differences from the expected mean of the cloud. They are computed again if the mean is far from it.
        let (reference, scale) = drive.nominal();
        let mut sums = self.spread_all(Spread::new(reference, scale));
        if let Some(better) = sums.better_reference(shown) {
            sums = self.spread_all(Spread::new(better, sums.scale()));
        }
        let regular = drive.regular_sums(self.draws.pair_sums(shown));
        let mut shapes = CloudShape::new(sums.finish(shown, regular), &START);
        for parts in blocks(shown) {
            for (fours, mask) in parts {
                shape(&drive, &self.draws.fours()[fours.clone()], &self.positions[fours], mask, &mut shapes);
            }
            shapes.close_block();
        }
        let robots = self.draws.sample(shown).map(|(noise, weights)| {
            let (poses, arcs) = drive.robots(noise);
            (poses, arcs, weights)
        });
        shapes.finish(shown, robots)
    }

    /// Draws and drives all samples, and adds them to the sums of the first pass.
    fn spread_all(&mut self, mut sums: Spread) -> Spread {
        let Self { draws, drive, positions, shown } = self;
        for parts in blocks(*shown) {
            let end = parts[1].0.end;
            draws.extend_to(end * LANES);
            draws.sum_to((*shown / LANES).min(end));
            if positions.len() < end {
                positions.resize(end, [f64x4::splat(0.0); 2]);
            }
            for (fours, mask) in parts {
                spread(drive, &draws.fours()[fours.clone()], &mut positions[fours], mask, &mut sums);
            }
            sums.close_block();
        }
        sums
    }

    /// Returns the standard deviation of the turn, rad.
    pub fn turn_deviation(&self) -> f64 {
        self.drive.turn_deviation()
    }

    /// Returns the standard deviation (rad) of the turn of the arc that ends at the robot.
    pub fn arc_deviation(&self) -> f64 {
        self.drive.arc_deviation()
    }

    /// Returns the number of samples shown.
    pub fn shown(&self) -> usize {
        self.shown
    }

    /// Returns the unit noise of a sample.
    pub fn unit_noise(&self, index: usize) -> [f64; 3] {
        self.draws.unit_noise_of(index)
    }

    /// Returns the pose of a sample that is shown.
    #[inline(always)]
    pub fn pose(&self, index: usize) -> SE2 {
        let [four, lane] = [index / LANES, index % LANES];
        let [x, y] = self.positions[four].map(|lanes| lanes.to_array()[lane]);
        let half = self.drive.motions(&self.draws.fours()[four]).half;
        SE2::new(x, y, 2.0 * half.to_array()[lane])
    }

    /// Calls `see` with the points of each group of four samples in a view. In the last group, lanes without a sample are
    /// infinitely far away.
    #[inline(always)]
    pub fn each_four(&self, view: View, mut see: impl FnMut([f64x4; 2])) {
        let shown = self.shown();
        let point = |four: usize| match view {
            View::Plane => self.positions[four],
            View::Twist => {
                let motions = self.drive.motions(&self.draws.fours()[four]);
                let poses = self.drive.poses(&motions, &self.positions[four]);
                [poses.along, poses.half * 2.0]
            }
            View::Morph(morph) => {
                let motions = self.drive.motions(&self.draws.fours()[four]);
                self.drive.unbent(&motions, &self.positions[four], morph)
            }
        };
        let (full, rest) = (shown / LANES, shown % LANES);
        (0..full).for_each(|four| see(point(four)));
        if rest > 0 {
            let there = lanes(|lane| if lane < rest { ALL } else { 0.0 });
            see(point(full).map(|points| there.bitselect(points, f64x4::splat(f64::INFINITY))));
        }
    }
}

/// Returns blocks of the groups of four of `count` samples, at least one block. A block has a range of complete groups, and a
/// range of incomplete ones. Each range has the mask of its samples.
fn blocks(count: usize) -> impl Iterator<Item = [(Range<usize>, f64x4); 2]> {
    let fours = count.div_ceil(LANES);
    let there = lanes(|lane| if lane < count % LANES { ALL } else { 0.0 });
    (0..fours.div_ceil(BLOCK).max(1)).map(move |i| {
        let (start, end) = (BLOCK * i, fours.min(BLOCK * (i + 1)));
        let full = start.max(end.min(count / LANES));
        [(start..full, f64x4::splat(ALL)), (full..end, there)]
    })
}

/// Mask of a lane with a robot: all bits set.
const ALL: f64 = f64::from_bits(u64::MAX);

/// Drives the robots, four at a time, and adds them to the sums of the first pass.
#[inline(never)]
fn spread(drive: &Drive, noise: &[[f64x4; 3]], ends: &mut [[f64x4; 2]], mask: f64x4, sums: &mut Spread) {
    let is_whole = mask.all();
    for (noise, ends) in noise.iter().zip(ends) {
        let motions = drive.motions(noise);
        let (arcs, is_regular);
        (*ends, arcs, is_regular) = drive.ends(&motions);
        let poses = drive.poses(&motions, ends);
        sums.add(&poses, mask);
        if is_whole {
            sums.multiply(&poses, &arcs);
        } else {
            sums.multiply_some(&poses, &arcs, mask);
        }
        if !is_regular {
            sums.add_irregular(&arcs, drive.regular(noise), mask);
        }
    }
}

/// Adds the robots that [`spread`] drove to the sums of the second pass.
#[inline(never)]
fn shape(drive: &Drive, noise: &[[f64x4; 3]], ends: &[[f64x4; 2]], mask: f64x4, sums: &mut CloudShape) {
    for (noise, ends) in noise.iter().zip(ends) {
        sums.add(&drive.poses(&drive.motions(noise), ends), mask);
    }
}
