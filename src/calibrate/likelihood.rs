//! The likelihood of variances that are sums: r ~ N(0, Σ αₖ fₖ), each α 0 or more.

/// A residual and what its variance is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// r².
    pub square: f64,
    /// What each of its two α's is multiplied by in its variance, 0 or more and not both 0.
    pub coefficients: [f64; 2],
}

/// Residuals of one kind, whose variances are of the same two α's.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// Which two, from 0.
    pub alphas: [usize; 2],
    pub residuals: Vec<Residual>,
}

/// What the α's are at a point: of as many as there may be, six.
pub(super) type Alphas = [f64; 6];

/// The logarithm of the likelihood at a point (nats), its derivatives there, and what Fisher expects of the second ones.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slope {
    pub log_likelihood: f64,
    gradient: Alphas,
    information: [Alphas; 6],
}

/// ln √(2π).
const LN_ROOT_TAU: f64 = 0.918_938_533_204_672_7;

/// Σ −½ ln(2πv) − r²/2v with v = Σ αₖ fₖ; −∞ where a variance is 0.
///
/// The derivative by αₖ is ½ Σ fₖ (r² − v)/v², and the expectation of minus the second one ½ Σ fₖ fₗ / v².
pub(super) fn slope(components: &[Component], alphas: &Alphas) -> Slope {
    let mut slope = Slope { log_likelihood: 0.0, gradient: [0.0; 6], information: [[0.0; 6]; 6] };
    for Component { alphas: [first, second], residuals } in components {
        let [a, b] = [alphas[*first], alphas[*second]];
        let (mut logs, mut scaled, mut gradient, mut information) = (0.0, 0.0, [0.0; 2], [0.0; 3]);
        for Residual { square, coefficients: [f, g] } in residuals {
            let precision = 1.0 / (a * f + b * g);
            let share = square * precision;
            logs += libm::log(precision);
            scaled += share;
            let [f, g] = [f * precision, g * precision];
            gradient[0] += f * (share - 1.0);
            gradient[1] += g * (share - 1.0);
            information[0] += f * f;
            information[1] += f * g;
            information[2] += g * g;
        }
        let total = 0.5 * (logs - scaled) - LN_ROOT_TAU * residuals.len() as f64;
        // With a variance of 0 the logarithm is infinite, and so is the share, or none.
        slope.log_likelihood += if total.is_finite() { total } else { f64::NEG_INFINITY };
        for (k, sum) in [(*first, gradient[0]), (*second, gradient[1])] {
            slope.gradient[k] += 0.5 * sum;
        }
        for (k, l, sum) in [
            (*first, *first, information[0]),
            (*first, *second, information[1]),
            (*second, *first, information[1]),
            (*second, *second, information[2]),
        ] {
            slope.information[k][l] += 0.5 * sum;
        }
    }
    slope
}

impl Slope {
    /// What is known of an α when all others are estimated with it: the inverse of its variance, were the likelihood a
    /// parabola.
    pub fn information_of(&self, alpha: usize, free: &[usize]) -> f64 {
        let others: Vec<usize> = free.iter().copied().filter(|other| *other != alpha).collect();
        // The Schur complement, one variable out after the other.
        let mut left = self.information;
        for out in others {
            let pivot = left[out][out];
            if pivot > 0.0 {
                let row = left[out];
                for each in &mut left {
                    let factor = each[out] / pivot;
                    each.iter_mut().zip(row).for_each(|(entry, of_row)| *entry -= factor * of_row);
                }
            }
        }
        left[alpha][alpha]
    }

    /// The maximum of the parabola at `from` over all `free` α's that are 0 or more, the others as they are.
    fn maximum(&self, from: &Alphas, free: &[usize]) -> Alphas {
        let mut at = *from;
        // From coordinate to coordinate: five at most, and what is left over another step of the whole takes care of.
        for _ in 0..SWEEPS {
            for &k in free {
                let curvature = self.information[k][k];
                if curvature > 0.0 {
                    let pull: f64 = (0..6).map(|l| self.information[k][l] * (from[l] - at[l])).sum();
                    at[k] = (at[k] + (self.gradient[k] + pull) / curvature).max(0.0);
                }
            }
        }
        at
    }

    /// How much the parabola promises for a step, nats.
    fn promised(&self, from: &Alphas, to: &Alphas) -> f64 {
        let step: Alphas = std::array::from_fn(|k| to[k] - from[k]);
        (0..6)
            .map(|k| {
                step[k]
                    * (self.gradient[k] - 0.5 * (0..6).map(|l| self.information[k][l] * step[l]).sum::<f64>())
            })
            .sum()
    }
}

/// Of the maximum of a parabola, through all α's in turn: two of them nearly alike settle within a few hundred.
const SWEEPS: usize = 300;

/// Of the whole: each halves the distance at least where the first is bad, and squares it where it is good.
const STEPS: usize = 200;

/// What another step has to promise, nats: intervals are found to a thousandth.
const ENOUGH: f64 = 1e-9;

/// The α's under which the residuals are likeliest, from `start` on; those that are not `free` stay as they are.
pub(super) fn maximize(components: &[Component], start: Alphas, free: &[usize]) -> (Alphas, Slope) {
    let mut at = start;
    let mut here = slope(components, &at);
    for _ in 0..STEPS {
        let aim = here.maximum(&at, free);
        let promised = here.promised(&at, &aim);
        if promised.is_nan() || promised < ENOUGH {
            break;
        }
        // Where the parabola promises too much, less of it.
        let mut share = 1.0;
        let step = loop {
            let to: Alphas = std::array::from_fn(|k| at[k] + share * (aim[k] - at[k]));
            let there = slope(components, &to);
            if there.log_likelihood > here.log_likelihood {
                break Some((to, there));
            }
            share *= 0.5;
            if share < 1e-6 {
                break None;
            }
        };
        let Some((to, there)) = step else { break };
        (at, here) = (to, there);
    }
    (at, here)
}

/// Where to begin: of each kind its two α's answer for half of what is there.
pub(super) fn beginning(components: &[Component]) -> Alphas {
    let mut alphas = [0.0f64; 6];
    for Component { alphas: pair, residuals } in components {
        let squares: f64 = residuals.iter().map(|residual| residual.square).sum();
        for (i, k) in pair.iter().enumerate() {
            let coefficients: f64 = residuals.iter().map(|residual| residual.coefficients[i]).sum();
            if coefficients > 0.0 {
                alphas[*k] = alphas[*k].max(0.5 * squares / coefficients);
            }
        }
    }
    alphas
}
