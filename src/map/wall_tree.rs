//! Search tree of the walls of a floor plan, for collision tests.

use crate::geom::segment::Segment;
use std::collections::BTreeSet;
use std::ops::Range;

/// Binary tree of walls by position and direction. Each node has a capsule that contains its walls: all points within a radius of an axis.
/// The capsule of long parallel walls is narrow, so that searches skip most of them.
///
/// The tree is full and has no pointers: the children of node i are 2i and 2i + 1, and the root is 1.
#[derive(Clone, Debug)]
pub(super) struct WallTree {
    /// Distinct walls, ordered so that the walls of each node are contiguous.
    pub walls: Vec<Segment>,
    pub wall_nodes: Vec<WallNode>,
    tree_depth: u32,
    rounding_slack: f64,
}

/// Node of the tree: the capsule of the walls of its subtree.
#[derive(Clone, Copy, Debug)]
pub(super) struct WallNode {
    pub capsule_axis: Segment,
    /// Maximum distance from a point of the node's walls to the axis of the capsule, m.
    pub capsule_radius: f64,
}

/// Maximum number of walls of a leaf, and of a tree that is a single leaf. Smaller leaves would need more nodes, and larger leaves more
/// comparisons of walls.
const MAX_LEAF_WALLS: usize = 16;
const MAX_SINGLE_LEAF_WALLS: usize = 32;

const ZERO_SEGMENT: Segment = Segment { from: [0.0; 2], to: [0.0; 2] };

impl WallTree {
    pub fn new(walls: &[Segment], plan_bounds: [f64; 4]) -> Self {
        // Copies of a wall are left out. They could fill whole leaves, and searches would compute the distance to each of them.
        let mut known_walls = BTreeSet::new();
        let is_new_wall = |wall: &&Segment| {
            known_walls.insert([wall.from, wall.to].map(|wall_end| wall_end.map(f64::to_bits)))
        };
        let walls: Vec<Segment> = walls.iter().filter(is_new_wall).copied().collect();
        let leaf_count = if walls.len() <= MAX_SINGLE_LEAF_WALLS {
            1
        } else {
            walls.len().div_ceil(MAX_LEAF_WALLS).next_power_of_two()
        };
        let mut wall_tree = Self {
            walls,
            // Node 0 is unused. The root has no capsule, because it is always visited.
            wall_nodes: vec![WallNode { capsule_axis: ZERO_SEGMENT, capsule_radius: f64::INFINITY }; 2],
            tree_depth: leaf_count.ilog2(),
            rounding_slack: 1e-9
                * plan_bounds
                    .iter()
                    .fold(0.0, |largest_bound: f64, plan_bound| largest_bound.max(plan_bound.abs())),
        };
        for parent_index in 1..leaf_count {
            wall_tree.sort_walls_into_halves(parent_index);
            let child_nodes =
                [2 * parent_index, 2 * parent_index + 1].map(|child_id| wall_tree.create_node(child_id));
            wall_tree.wall_nodes.extend(child_nodes);
        }
        wall_tree
    }

    /// Sorts the walls of a node into two halves, one for each child. The sort key is the component of [`sort_keys`] with the widest range.
    fn sort_walls_into_halves(&mut self, node_index: usize) {
        let (wall_range, middle_index) = (self.wall_range(node_index), self.wall_range(2 * node_index).end);
        let node_walls = &mut self.walls[wall_range.clone()];
        let mut key_ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 4];
        for wall in &*node_walls {
            for ([min_key, max_key], sort_key) in key_ranges.iter_mut().zip(sort_keys(wall)) {
                (*min_key, *max_key) = (min_key.min(sort_key), max_key.max(sort_key));
            }
        }
        let key_range_widths = key_ranges.map(|[min_key, max_key]| max_key - min_key);
        let widest_key_index = (1..4).fold(0, |max_index, key_index| {
            if key_range_widths[key_index] > key_range_widths[max_index] { key_index } else { max_index }
        });
        select_smallest(node_walls, middle_index - wall_range.start, widest_key_index);
    }

    fn create_node(&self, node_index: usize) -> WallNode {
        let walls = &self.walls[self.wall_range(node_index)];
        // The axis of the capsule has the mean direction of the walls, or is parallel to x or y, whichever makes the capsule narrowest.
        let direction_sum =
            walls.iter().map(sort_keys).fold([0.0; 2], |[x, y], sort_key| [x + sort_key[2], y + sort_key[3]]);
        let direction_sum_length = libm::hypot(direction_sum[0], direction_sum[1]);
        let mean_direction = if direction_sum_length > 0.0 {
            direction_sum.map(|direction_coordinate| direction_coordinate / direction_sum_length)
        } else {
            [1.0, 0.0]
        };
        let candidate_axes = [mean_direction, [1.0, 0.0], [0.0, 1.0]];
        let mut bounds_along_axes = [[f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY]; 3];
        for end in walls.iter().flat_map(|wall| [wall.from, wall.to]) {
            for ([x, y], [min_along, min_across, max_along, max_across]) in
                candidate_axes.iter().zip(&mut bounds_along_axes)
            {
                let (end_along, end_across) = (end[0] * x + end[1] * y, end[1] * x - end[0] * y);
                (*min_along, *min_across) = (min_along.min(end_along), min_across.min(end_across));
                (*max_along, *max_across) = (max_along.max(end_along), max_across.max(end_across));
            }
        }
        let mut narrowest_capsule = (f64::INFINITY, ZERO_SEGMENT);
        for ([x, y], [min_along, min_across, max_along, max_across]) in
            candidate_axes.into_iter().zip(bounds_along_axes)
        {
            let (axis_offset, capsule_width) = (0.5 * (min_across + max_across), max_across - min_across);
            // The ends of a capsule are round, so that the axis of a capsule can be shorter than the walls inside.
            let axis_shortening = (0.25 * capsule_width).min(0.5 * (max_along - min_along));
            let point_at = |along: f64| [along * x - axis_offset * y, along * y + axis_offset * x];
            if capsule_width < narrowest_capsule.0 {
                let candidate_axis = Segment {
                    from: point_at(min_along + axis_shortening),
                    to: point_at(max_along - axis_shortening),
                };
                narrowest_capsule = (capsule_width, candidate_axis);
            }
        }
        let capsule_axis = narrowest_capsule.1;
        // The point of a wall that is furthest from the capsule's axis is an end of the wall.
        let wall_ends = walls.iter().flat_map(|wall| [wall.from, wall.to]);
        let max_distance =
            wall_ends.map(|end| capsule_axis.squared_distance_to_point(end)).fold(0.0, f64::max).sqrt();
        WallNode { capsule_axis, capsule_radius: max_distance + self.rounding_slack }
    }

    pub fn wall_range(&self, node_index: usize) -> Range<usize> {
        let tree_depth = node_index.ilog2();
        let (wall_count, index_in_level) = (self.walls.len() as u64, (node_index - (1 << tree_depth)) as u64);
        let end_index = |index: u64| ((wall_count * index) >> tree_depth) as usize;
        end_index(index_in_level)..end_index(index_in_level + 1)
    }

    pub fn is_leaf(&self, node_index: usize) -> bool {
        node_index >> self.tree_depth > 0
    }

    /// Returns true if `is_wall_clear` holds for all walls. The walls of a node for which `is_node_clear` holds are not tested.
    #[inline(always)]
    pub fn are_all_walls_clear(
        &self,
        mut is_node_clear: impl FnMut(&WallNode) -> bool,
        mut is_wall_clear: impl FnMut(&Segment) -> bool,
    ) -> bool {
        let mut node_index = 1;
        loop {
            if node_index == 1 || !is_node_clear(&self.wall_nodes[node_index]) {
                if !self.is_leaf(node_index) {
                    node_index *= 2;
                    continue;
                }
                if !self.walls[self.wall_range(node_index)].iter().all(&mut is_wall_clear) {
                    return false;
                }
            }
            // Goes to the next node outside this subtree: the right sibling of this node, or of its nearest ancestor with a right sibling.
            // The node after the last node is the root.
            node_index += 1;
            node_index >>= node_index.trailing_zeros();
            if node_index == 1 {
                return true;
            }
        }
    }
}

impl WallNode {
    /// Returns true if the node's capsule is farther than `distance` (m) from a point. All walls of the node are then farther, too.
    #[inline(always)]
    pub fn is_farther_than(&self, point: [f64; 2], distance: f64) -> bool {
        let max_axis_distance = distance + self.capsule_radius;
        self.capsule_axis.squared_distance_to_point(point) > max_axis_distance * max_axis_distance
    }

    #[inline(always)]
    pub fn lower_bound(&self, point: [f64; 2]) -> f64 {
        (self.capsule_axis.squared_distance_to_point(point).sqrt() - self.capsule_radius).max(0.0)
    }
}

/// Moves the `smallest_count` walls with the smallest sort keys to the front, by Hoare's selection. After [`MAX_SELECTION_ROUNDS`] rounds
/// the selection may still be incomplete. The capsules of the search tree are then larger, but searches remain correct.
fn select_smallest(walls: &mut [Segment], smallest_count: usize, key_index: usize) {
    let (mut range_start, mut range_end) = (0, walls.len());
    for _ in 0..MAX_SELECTION_ROUNDS {
        if range_end - range_start < 2 {
            return;
        }
        let key_of = |wall: &Segment| sort_keys(wall)[key_index];
        let pivot_key = key_of(&walls[(range_start + range_end) / 2]);
        let (mut left_index, mut right_index) = (range_start, range_end);
        loop {
            while key_of(&walls[left_index]) < pivot_key {
                left_index += 1;
            }
            while key_of(&walls[right_index - 1]) > pivot_key {
                right_index -= 1;
            }
            if left_index < right_index {
                walls.swap(left_index, right_index - 1);
                (left_index, right_index) = (left_index + 1, right_index - 1);
            }
            if left_index >= right_index {
                break;
            }
        }
        // Walls before `right_index` have sort keys of at most the pivot key, and walls from `left_index` on of at least the pivot key.
        if smallest_count < right_index {
            range_end = right_index;
        } else if smallest_count > left_index {
            range_start = left_index;
        } else {
            return;
        }
    }
}

const MAX_SELECTION_ROUNDS: usize = 64;

/// Returns the keys by which walls are sorted: twice the midpoint, and the vector from the left end to the right end. The keys do not
/// depend on which end is first.
fn sort_keys(wall: &Segment) -> [f64; 4] {
    let Segment { from: [x0, y0], to: [x1, y1] } = *wall;
    let (x, y) = (x1 - x0, y1 - y0);
    let [x, y] = if x < 0.0 || (x == 0.0 && y < 0.0) { [-x, -y] } else { [x, y] };
    [x0 + x1, y0 + y1, x, y]
}
