//! Quadrature rules for expectations over one random number, as accurate as doubles.

use crate::noise::NoiseKind;
use std::f64::consts::{PI, TAU};
use std::sync::OnceLock;

/// Node of a quadrature rule for the distribution of a noise of variance 1. The weights of a rule sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Value of the noise at the node, in standard deviations.
    pub node_value: f64,
    /// Weight of the node.
    pub node_weight: f64,
}

/// Returns a rule with E[f(z)] = Σ weight · f(value) for a noise z of variance 1 and the given kind.
///
/// The rule is correct to rounding if f is a polynomial times trigonometric functions of k·z with k below 16. The third moment of headings
/// with a standard deviation of five radians needs that frequency.
pub fn noise_nodes(noise_kind: NoiseKind) -> &'static [Node] {
    static NORMAL: OnceLock<Vec<Node>> = OnceLock::new();
    static TRIANGULAR: OnceLock<Vec<Node>> = OnceLock::new();
    match noise_kind {
        NoiseKind::Normal => NORMAL.get_or_init(normal_nodes),
        NoiseKind::Triangular => TRIANGULAR.get_or_init(triangular_nodes),
    }
}

/// Returns the trapezoidal rule for a Gaussian weight. Its error at the step h and the frequency k is about exp(−(2π/h − k)²/2).
fn normal_nodes() -> Vec<Node> {
    /// Step of the quadrature rule. The error stays below rounding up to the frequency k ≈ 16; twice this step would suffice only up to k ≈
    /// 4.
    const STEP_SIZE: f64 = 0.25;
    /// Number of steps on each side of 0. They reach nine standard deviations, where the density is 1e-18 of its maximum.
    const STEPS_PER_SIDE: i32 = 36;
    (-STEPS_PER_SIDE..=STEPS_PER_SIDE)
        .map(|i| {
            let node = STEP_SIZE * f64::from(i);
            Node { node_value: node, node_weight: STEP_SIZE * libm::exp(-0.5 * node * node) / TAU.sqrt() }
        })
        .collect()
}

fn triangular_nodes() -> Vec<Node> {
    /// Number of points on each half of the support. The rule is exact for polynomials of degree 63. It is accurate for frequencies up to k
    /// ≈ 25, at which k·x is about 60 at the end x = √6 of the support.
    const NODES_PER_HALF: usize = 32;
    let support_end = 6f64.sqrt();
    legendre_nodes(NODES_PER_HALF)
        .into_iter()
        .flat_map(|Node { node_value: value, node_weight }| {
            let fraction = 0.5 * (1.0 + value);
            let node_weight = 0.5 * node_weight * (1.0 - fraction);
            [
                Node { node_value: -support_end * fraction, node_weight },
                Node { node_value: support_end * fraction, node_weight },
            ]
        })
        .collect()
}

/// Returns a rule from −`limit` to `limit` for a function that is smooth except at the two `break_points`, a negative and a positive
/// number. Gauss–Legendre rules are used between the breaks. Moments of normal noise up to six standard deviations have errors of 1e-10.
#[inline(never)]
pub(super) fn piecewise_nodes(noise_kind: NoiseKind, limit: f64, break_points: [f64; 2]) -> Vec<Node> {
    /// Number of quadrature nodes between two break points. Rules for two noises are combined, so that the time grows with the square of
    /// this number. With fewer nodes, displayed digits would be wrong.
    const NODES_PER_PIECE: usize = 16;
    let unit_nodes = legendre_nodes(NODES_PER_PIECE);
    let (mut piece_nodes, mut piece_start) = (Vec::with_capacity(4 * NODES_PER_PIECE), -limit);
    // The triangular density has a kink at 0, which needs another break point.
    for piece_end in [break_points[0].max(-limit).min(0.0), 0.0, break_points[1].max(0.0).min(limit), limit] {
        if piece_end > piece_start {
            let half_width = 0.5 * (piece_end - piece_start);
            piece_nodes.extend(unit_nodes.iter().map(|unit_node| {
                let value = piece_start + half_width * (1.0 + unit_node.node_value);
                let noise_density = match noise_kind {
                    NoiseKind::Normal => libm::exp(-0.5 * value * value) / TAU.sqrt(),
                    NoiseKind::Triangular => (6f64.sqrt() - value.abs()) / 6.0,
                };
                Node { node_value: value, node_weight: unit_node.node_weight * half_width * noise_density }
            }));
            piece_start = piece_end;
        }
    }
    piece_nodes
}

/// Returns the Gauss–Legendre rule on (−1, 1): the roots of P_n by Newton's method.
fn legendre_nodes(node_count: usize) -> Vec<Node> {
    let n = node_count as f64;
    (0..node_count)
        .map(|i| {
            // Tricomi's initial guess is within 1e-4. Each of the four steps of Newton's method doubles the number of correct digits.
            let mut x = libm::cos(PI * (i as f64 + 0.75) / (n + 0.5));
            let mut polynomial_derivative = 1.0;
            for _ in 0..4 {
                let (mut previous_legendre, mut value) = (1.0, x);
                for k in 2..=node_count {
                    let k = k as f64;
                    (previous_legendre, value) =
                        (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous_legendre) / k);
                }
                polynomial_derivative = n * (x * value - previous_legendre) / (x * x - 1.0);
                x -= value / polynomial_derivative;
            }
            Node {
                node_value: x,
                node_weight: 2.0 / ((1.0 - x * x) * polynomial_derivative * polynomial_derivative),
            }
        })
        .collect()
}
