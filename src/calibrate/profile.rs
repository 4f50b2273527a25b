//! The likeliest α's, and how well they are known.

use super::likelihood::{self, Evidence, Parameters, Robust, Slope, maximize};

/// What the residuals say of the α's.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The likeliest ones; NaN of an α that the log does not determine.
    pub alphas: Vec<f64>,
    /// Of each the 95 % interval: all values that some choice of the others makes likely enough, as Wilks has it. None of an α that the log
    /// does not determine.
    pub intervals: Vec<Option<[f64; 2]>>,
    /// Of the residuals, nats.
    pub log_likelihood: f64,
    /// The share of bad legs; None where none is taken for bad.
    pub outliers: Option<f64>,
}

/// By how much the log-likelihood falls towards the ends of a 95 % interval, twice: the 95 % quantile of χ² with one degree
/// of freedom, 1.96².
const FALL: f64 = 3.841_458_820_694_124;

/// How well an end is found, as a share of the fall: a thousandth of the interval's length.
const NEAR: f64 = 1e-3;

/// Steps to an end; each is a fit of the others. Where the likelihood is about a parabola three do.
const STEPS: usize = 40;

/// An α of 1 is an error as large as what drives it, or of a radian a metre: who cannot say whether it is nothing or that knows
/// nothing of it.
const ANYTHING: f64 = 1.0;

/// From where the parabola has the others two or three are usual.
const OTHERS_STEPS: usize = 30;

/// 1.5⁶ is 11.
const WIDER: usize = 6;

/// Fits the α's of a model to what its legs say.
pub fn fit(evidence: &Evidence, count: usize, robust: Robust) -> Estimate {
    let fitted = Fitted::new(evidence, count, robust, None);
    fitted.estimate((0..count).map(|alpha| fitted.interval(alpha)).collect())
}

/// The maximum of a likelihood.
#[derive(Clone, Debug)]
pub(super) struct Fitted<'a> {
    pub evidence: &'a Evidence,
    pub best: Parameters,
    pub slope: Slope,
    /// The α's of which some residual says anything.
    pub free: Vec<usize>,
}

impl<'a> Fitted<'a> {
    /// The maximum, from where another one was if that is known.
    pub fn new(evidence: &'a Evidence, count: usize, robust: Robust, near: Option<&Parameters>) -> Self {
        let start = evidence.beginning(robust);
        let free: Vec<usize> = (0..count).filter(|k| start.alphas[*k] > 0.0).collect();
        let start = match near {
            Some(near) if evidence.slope(near).log_likelihood.is_finite() => *near,
            _ => start,
        };
        let (best, slope) = maximize(evidence, start, &free, robust, likelihood::STEPS);
        Self { evidence, best, slope, free }
    }

    /// What is told of it, with the intervals of its α's.
    pub fn estimate(&self, intervals: Vec<Option<[f64; 2]>>) -> Estimate {
        let told = |(alpha, interval): (usize, &Option<[f64; 2]>)| {
            interval.map_or(f64::NAN, |_| self.best.alphas[alpha])
        };
        Estimate {
            alphas: intervals.iter().enumerate().map(told).collect(),
            intervals,
            log_likelihood: self.slope.log_likelihood,
            outliers: self.best.bad.map(|bad| bad.share),
        }
    }

    /// The 95 % interval of an α; none where the log does not determine it.
    pub fn interval(&self, alpha: usize) -> Option<[f64; 2]> {
        if !self.free.contains(&alpha) {
            return None;
        }
        let profile = Profile { fitted: self, alpha };
        let interval = [profile.lower(), profile.upper()];
        (interval[0] > 0.0 || interval[1] <= ANYTHING).then_some(interval)
    }
}

/// The likelihood of one α, the others being the likeliest beside it, and as many legs bad as at the maximum.
struct Profile<'a> {
    fitted: &'a Fitted<'a>,
    alpha: usize,
}

impl Profile<'_> {
    /// Twice the fall of the log-likelihood at a value.
    fn fall(&self, value: f64) -> f64 {
        let Fitted { evidence, best, slope, free } = self.fitted;
        let others: Vec<usize> = free.iter().copied().filter(|k| *k != self.alpha).collect();
        // Where the parabola has the others, which have to answer for something where this one answers for less.
        let mut alphas = best.alphas;
        alphas[self.alpha] = value;
        alphas = slope.maximum(&slope.gradient, &best.alphas, alphas, &others);
        for k in &others {
            alphas[*k] = alphas[*k].max(1e-3 * best.alphas[self.alpha]);
        }
        // Where a residual is outside of its triangle, the others have to be larger first; ten times as large is out of the question.
        for _ in 0..WIDER {
            if evidence.slope(&Parameters { alphas, ..*best }).log_likelihood.is_finite() {
                break;
            }
            others.iter().for_each(|k| alphas[*k] *= 1.5);
        }
        let (_, there) =
            maximize(evidence, Parameters { alphas, ..*best }, &others, Robust::No, OTHERS_STEPS);
        2.0 * (slope.log_likelihood - there.log_likelihood)
    }

    fn lower(&self) -> f64 {
        let best = self.fitted.best.alphas[self.alpha];
        let mut far = best - self.reach();
        for _ in 0..STEPS {
            if far.is_nan() || far <= 0.0 {
                break;
            }
            if self.fall(far) > FALL {
                return self.end(far);
            }
            far = best - 2.0 * (best - far);
        }
        if best == 0.0 || self.fall(0.0) <= FALL { 0.0 } else { self.end(0.0) }
    }

    fn upper(&self) -> f64 {
        let best = self.fitted.best.alphas[self.alpha];
        let mut far = best + self.reach();
        // Twice as far, until it falls enough.
        for _ in 0..STEPS {
            if self.fall(far) > FALL {
                return self.end(far);
            }
            far = best + 2.0 * (far - best);
        }
        f64::INFINITY
    }

    /// Where the end would be, were the likelihood a parabola, and a little more.
    fn reach(&self) -> f64 {
        let Fitted { best, slope, free, .. } = self.fitted;
        let deviation = slope.information_of(self.alpha, free).sqrt().recip();
        2.2 * if deviation.is_finite() { deviation } else { best.alphas[self.alpha] }
    }

    /// Where it falls as far as at the end of the interval, between the best value and one that is too far. The root of the
    /// fall is nearly linear, on which a false position finds it soon.
    fn end(&self, far: f64) -> f64 {
        let height = FALL.sqrt();
        let root = |value: f64| self.fall(value).max(0.0).sqrt();
        let (mut inside, mut low) = (self.fitted.best.alphas[self.alpha], 0.0);
        let (mut outside, mut high) = (far, root(far));
        let mut value = far;
        for step in 0..STEPS {
            // Every third step halves, so that no end stays for good.
            let share = if !high.is_finite() || step % 3 == 2 { 0.5 } else { (height - low) / (high - low) };
            value = inside + share * (outside - inside);
            let here = root(value);
            if ((here - height) / height).abs() < NEAR {
                break;
            }
            if here > height {
                (outside, high) = (value, here);
            } else {
                (inside, low) = (value, here);
            }
        }
        value
    }
}
