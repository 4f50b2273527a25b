//! A cloud of robots from the origin: their draws, where they end, and what they say, refreshed in slices.

pub(super) mod draws;
pub(super) mod drive;
pub mod picture;
pub mod views;

pub use views::View;

use crate::geom::lanes::{LANES, lanes};
use crate::geom::se2::SE2;
use crate::noise::NoiseKind;
use crate::stats::fused::{CloudFigures, Shape, Spread};
use draws::Draws;
use drive::Drive;
use std::collections::TryReserveError;
use wide::f64x4;

/// Every robot of a cloud starts at the origin, heading along x.
pub const START: SE2 = SE2::identity();

/// Fours that are summed naively and worked on between looks at the clock: 256 poses. Fewer would make the compensation of
/// the sums felt, more would add to their rounding, which is proportional.
const BLOCK: usize = 64;

/// Structure of arrays, four samples an entry: 24 bytes of noise and 16 of position a sample. Headings are affine in the
/// noise and logarithms cheap, so that neither is kept.
#[derive(Clone, Debug)]
pub struct Cloud {
    draws: Draws,
    drive: Drive,
    positions: Vec<[f64x4; 2]>,
    /// Samples to show when the refresh is complete.
    goal: usize,
    pass: Pass,
    /// The next four of the pass.
    next: usize,
}

/// How far a refresh has come.
#[derive(Clone, Debug)]
enum Pass {
    /// Whether the sums are counted from where the model expects the cloud, else from its own means.
    Spread {
        sums: Spread,
        first: bool,
    },
    Shape(Shape),
    Done,
}

impl Cloud {
    pub fn new(seed: u64, noise: NoiseKind, drive: Drive) -> Self {
        let draws = Draws::new(seed, noise);
        Self { draws, drive, positions: Vec::new(), goal: 0, pass: Pass::Done, next: 0 }
    }

    /// Makes room for `count` samples.
    pub fn reserve(&mut self, count: usize) -> Result<(), TryReserveError> {
        self.draws.reserve(count)?;
        let fours = count.div_ceil(LANES);
        self.positions.try_reserve_exact(fours.saturating_sub(self.positions.len()))
    }

    /// Begins a refresh that is to show `shown` samples of these draws under this motion; there must be room for them.
    pub fn begin(&mut self, seed: u64, noise: NoiseKind, drive: Drive, shown: usize) {
        self.draws.restart(seed, noise);
        self.drive = drive;
        self.goal = shown;
        let (reference, scale) = drive.nominal();
        self.pass = Pass::Spread { sums: Spread::new(reference, scale), first: true };
        self.next = 0;
    }

    /// Goes on with what [`Cloud::begin`] began, for about as many poses; their figures when they are complete. All of it
    /// takes two passes.
    pub fn advance(&mut self, poses: usize) -> Option<CloudFigures> {
        for _ in 0..poses.div_ceil(BLOCK * LANES).max(1) {
            let Self { draws, drive, positions, goal, pass, next } = self;
            let fours = goal.div_ceil(LANES);
            let block = *next..fours.min(*next + BLOCK);
            let ended = block.end == fours;
            *next = if ended { 0 } else { block.end };
            // The last four may be fewer.
            let rest = if ended { block.start.max(*goal / LANES)..block.end } else { block.end..block.end };
            let full = block.start..rest.start;
            let rest_mask = lanes(|lane| if lane < *goal % LANES { ALL } else { 0.0 });
            match pass {
                Pass::Spread { sums, first } => {
                    draws.extend_to(block.end * LANES);
                    draws.sum_to((*goal / LANES).min(block.end));
                    if positions.len() < block.end {
                        positions.resize(block.end, [f64x4::splat(0.0); 2]);
                    }
                    for (part, mask) in [(full, f64x4::splat(ALL)), (rest, rest_mask)] {
                        spread(drive, &draws.fours()[part.clone()], &mut positions[part], mask, sums);
                    }
                    sums.close_block();
                    if ended {
                        let better = sums.better_reference(*goal).filter(|_| *first);
                        *pass = match better {
                            Some(reference) => {
                                Pass::Spread { sums: Spread::new(reference, sums.scale()), first: false }
                            }
                            None => {
                                let regular = drive.regular_sums(draws.pair_sums(*goal));
                                Pass::Shape(Shape::new(sums.finish(*goal, regular), &START))
                            }
                        };
                    }
                }
                Pass::Shape(sums) => {
                    for (part, mask) in [(full, f64x4::splat(ALL)), (rest, rest_mask)] {
                        shape(drive, &draws.fours()[part.clone()], &positions[part], mask, sums);
                    }
                    sums.close_block();
                    if ended {
                        let robots = draws.sample(*goal).map(|(noise, weights)| {
                            let (poses, arcs) = drive.robots(noise);
                            (poses, arcs, weights)
                        });
                        let figures = sums.finish(*goal, robots);
                        *pass = Pass::Done;
                        return Some(figures);
                    }
                }
                Pass::Done => return None,
            }
        }
        None
    }

    /// Whether nothing is left of what was begun.
    pub fn is_fresh(&self) -> bool {
        matches!(self.pass, Pass::Done)
    }

    /// Standard deviation of the turn, rad.
    pub fn turn_deviation(&self) -> f64 {
        self.drive.turn_deviation()
    }

    /// That of the turn of the arc that ends where the robot does, rad.
    pub fn arc_deviation(&self) -> f64 {
        self.drive.arc_deviation()
    }

    /// The number of samples there are to show: during a refresh perhaps not all yet.
    pub fn shown(&self) -> usize {
        self.goal.min(LANES * self.positions.len().min(self.draws.fours().len()))
    }

    /// The number of samples to show when the refresh is complete.
    pub fn goal(&self) -> usize {
        self.goal
    }

    /// The unit noise of a sample.
    pub fn unit_noise(&self, index: usize) -> [f64; 3] {
        self.draws.of(index)
    }

    /// A sample that is shown.
    #[inline(always)]
    pub fn pose(&self, index: usize) -> SE2 {
        let [four, lane] = [index / LANES, index % LANES];
        let [x, y] = self.positions[four].map(|lanes| lanes.to_array()[lane]);
        let half = self.drive.motions(&self.draws.fours()[four]).half;
        SE2::new(x, y, 2.0 * half.to_array()[lane])
    }

    /// Shows each four of a view to `see`; of the last, those that are not there are infinitely far away.
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

/// A lane that is counted: all bits set.
const ALL: f64 = f64::from_bits(u64::MAX);

/// Drives four robots after the other and adds them to the sums of the first pass.
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
fn shape(drive: &Drive, noise: &[[f64x4; 3]], ends: &[[f64x4; 2]], mask: f64x4, sums: &mut Shape) {
    for (noise, ends) in noise.iter().zip(ends) {
        sums.add(&drive.poses(&drive.motions(noise), ends), mask);
    }
}
