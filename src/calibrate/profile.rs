//! The likeliest α's, and how well they are known.

use super::likelihood::{Alphas, Component, Slope, beginning, maximize};

/// What the residuals say of the α's.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The likeliest ones; NaN of an α of which no residual says anything.
    pub alphas: Vec<f64>,
    /// Of each the 95 % interval: all values that some choice of the others makes likely enough, as Wilks has it. None of an α of
    /// which no residual says anything.
    pub intervals: Vec<Option<[f64; 2]>>,
    /// nats.
    pub log_likelihood: f64,
}

/// By how much the log-likelihood falls towards the ends of a 95 % interval, twice: the 95 % quantile of χ² with one degree
/// of freedom, 1.96².
const FALL: f64 = 3.841_458_820_694_124;

/// How well an end is found, as a share of the fall: a thousandth of the interval's length.
const NEAR: f64 = 1e-3;

/// Steps to an end; each is a fit of the others. Where the likelihood is about a parabola three do.
const STEPS: usize = 40;

/// Fits α's (as many as `count`, at most six) to residuals.
pub fn fit(components: &[Component], count: usize) -> Estimate {
    let mut estimate =
        Estimate { alphas: vec![f64::NAN; count], intervals: vec![None; count], log_likelihood: 0.0 };
    for group in groups(components) {
        let mut free: Vec<usize> = group.iter().flat_map(|component| component.alphas).collect();
        free.sort_unstable();
        free.dedup();
        let start = beginning(&group);
        free.retain(|k| start[*k] > 0.0);
        let (best, slope) = maximize(&group, start, &free);
        estimate.log_likelihood += slope.log_likelihood;
        for &k in &free {
            let profile = Profile { components: &group, free: &free, best, slope, alpha: k };
            estimate.alphas[k] = best[k];
            estimate.intervals[k] = Some([profile.lower(), profile.upper()]);
        }
    }
    estimate
}

/// Components in sets that have no α in common: what is far from one does not move the other.
fn groups(components: &[Component]) -> Vec<Vec<Component>> {
    let mut groups: Vec<Vec<Component>> = Vec::new();
    for component in components.iter().filter(|component| !component.residuals.is_empty()) {
        let meets = |group: &Vec<Component>| {
            group.iter().any(|other| other.alphas.iter().any(|alpha| component.alphas.contains(alpha)))
        };
        let mut joined = vec![component.clone()];
        groups.extract_if(.., |group| meets(group)).for_each(|group| joined.extend(group));
        groups.push(joined);
    }
    groups
}

/// The likelihood of one α, the others being the likeliest beside it.
struct Profile<'a> {
    components: &'a [Component],
    free: &'a [usize],
    best: Alphas,
    slope: Slope,
    alpha: usize,
}

impl Profile<'_> {
    /// Twice the fall of the log-likelihood at a value, and the others there.
    fn fall(&self, value: f64, near: &Alphas) -> (f64, Alphas) {
        let mut start = *near;
        start[self.alpha] = value;
        let others: Vec<usize> = self.free.iter().copied().filter(|k| *k != self.alpha).collect();
        // An α that has gone to 0 has to answer for something again where this one answers for less.
        for k in &others {
            start[*k] = start[*k].max(1e-3 * self.best[self.alpha]);
        }
        let (at, slope) = maximize(self.components, start, &others);
        (2.0 * (self.slope.log_likelihood - slope.log_likelihood), at)
    }

    fn lower(&self) -> f64 {
        let best = self.best[self.alpha];
        if best == 0.0 || self.fall(0.0, &self.best).0 <= FALL {
            return 0.0;
        }
        self.end(0.0)
    }

    fn upper(&self) -> f64 {
        let best = self.best[self.alpha];
        let deviation = self.slope.information_of(self.alpha, self.free).sqrt().recip();
        // Twice as far, until it falls enough.
        let mut far = best + 2.0 * if deviation.is_finite() { deviation } else { best };
        for _ in 0..STEPS {
            if self.fall(far, &self.best).0 > FALL {
                return self.end(far);
            }
            far = best + 2.0 * (far - best);
        }
        f64::INFINITY
    }

    /// Where it falls as far as at the end of the interval, between the best value and one that is too far. The root of the
    /// fall is nearly linear, on which a false position finds it soon.
    fn end(&self, far: f64) -> f64 {
        let height = FALL.sqrt();
        let root = |value: f64, near: &Alphas| {
            let (fall, at) = self.fall(value, near);
            (fall.max(0.0).sqrt(), at)
        };
        let (mut inside, mut low) = (self.best[self.alpha], 0.0);
        let (mut outside, (mut high, mut near)) = (far, root(far, &self.best));
        let mut value = far;
        for step in 0..STEPS {
            // Every third step halves, so that no end stays for good.
            let share = if !high.is_finite() || step % 3 == 2 { 0.5 } else { (height - low) / (high - low) };
            value = inside + share * (outside - inside);
            let (here, at) = root(value, &near);
            if ((here - height) / height).abs() < NEAR {
                break;
            }
            if here > height {
                (outside, high) = (value, here);
            } else {
                (inside, low) = (value, here);
            }
            near = at;
        }
        value
    }
}
