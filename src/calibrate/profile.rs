//! The likeliest α's, and how well they are known.

use super::bad::Robust;
use super::density::NORMAL_95;
use super::likelihood::{Alphas, Evidence, Parameters, Slope};
use super::maximum::{Climb, ENOUGH_WORK, INSIDE, NOTHING, Near, are_nothing};

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

/// The root of twice the fall of the log-likelihood towards the ends of a 95 % interval: that of the 95 % quantile of χ² with one
/// degree of freedom.
const HEIGHT: f64 = NORMAL_95;

/// How well an end is found, as a share of that: a thousandth of the interval's length.
const NEAR: f64 = 1e-3;

/// Values that differ by so small a part of the likeliest one are one: of a perfect log an α may have no more room.
const ROUNDING: f64 = 1e-12;

/// Steps to an end; each is a pass over all legs. Of many legs one does.
const STEPS: usize = 40;

/// Within what is near a point.
const DOUBLINGS: usize = 8;

/// No α is looked for beyond.
const FARTHEST: f64 = 1e12;

/// What the others may still promise at an end, nats: of that the parabola tells a tenth well.
const SLIGHT: f64 = 0.02;

/// From so close, as a share of the root of the fall, the parabola at a point finds the end to [`NEAR`]: its error is of second order.
const CLOSE: f64 = 0.05;

/// An α of 1 is an error as large as what drives it, or of a radian a metre: who cannot say whether it is nothing or that knows
/// nothing of it.
const ANYTHING: f64 = 1.0;

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

/// Of so many α's those of which some residual says anything.
fn free(evidence: &Evidence, count: usize) -> Vec<usize> {
    (0..count).filter(|k| evidence.told[*k]).collect()
}

impl<'a> Fitted<'a> {
    /// The maximum, from where another one was if that is known.
    pub fn new(evidence: &'a Evidence, count: usize, robust: Robust, near: Option<&Parameters>) -> Self {
        let mut search = Search::new(evidence, robust, near);
        while !search.step(evidence, count) {}
        Self::at(evidence, count, search.best())
    }

    /// A maximum that is known.
    pub fn at(evidence: &'a Evidence, count: usize, (best, slope): (Parameters, Slope)) -> Self {
        Self { evidence, best, slope, free: free(evidence, count) }
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
        let mut ends = Ends::new(self, alpha);
        loop {
            if let Some(interval) = ends.step(self) {
                return interval;
            }
        }
    }
}

/// The search for the 95 % interval of an α, one step after the other.
#[derive(Clone, Debug)]
pub(super) struct Ends {
    alpha: usize,
    about: Near,
    lower: Option<f64>,
    end: End,
}

impl Ends {
    pub fn new(fitted: &Fitted, alpha: usize) -> Self {
        let about = Near::new(fitted.evidence, fitted.best, &fitted.slope);
        Self { alpha, about, lower: None, end: End::new(fitted.best.alphas[alpha], -1.0) }
    }

    /// Goes on by a few passes; the interval after the last step, none where the log does not determine it.
    pub fn step(&mut self, fitted: &Fitted) -> Option<Option<[f64; 2]>> {
        let Self { alpha, ref about, lower, ref mut end } = *self;
        // An α that no number is large enough for is driven by next to nothing.
        if !fitted.free.contains(&alpha) || fitted.best.alphas[alpha] > FARTHEST {
            return Some(None);
        }
        // Of a perfect log: there is no maximum to fall from.
        if are_nothing(&fitted.best.alphas, &fitted.free) {
            return Some(Some([0.0, NOTHING]));
        }
        let others = fitted.free.iter().copied().filter(|k| *k != alpha).collect();
        let found = Profile { fitted, alpha, others }.step(about, end)?;
        let Some(lower) = lower else {
            self.lower = Some(found);
            self.end = End::new(fitted.best.alphas[alpha], 1.0);
            return None;
        };
        Some((lower > 0.0 || found <= ANYTHING).then_some([lower, found]))
    }
}

/// The search for a maximum, one step after the other.
#[derive(Clone, Debug)]
pub(super) struct Search {
    robust: Robust,
    climb: Climb,
    /// Whether it began where another maximum is.
    warm: bool,
}

impl Search {
    /// From where another maximum was if that is known.
    pub fn new(evidence: &Evidence, robust: Robust, near: Option<&Parameters>) -> Self {
        let start = near.copied().unwrap_or_else(|| evidence.beginning(robust));
        Self { robust, climb: Climb::new(evidence, start, robust), warm: near.is_some() }
    }

    /// Goes on by a few passes; whether it is over.
    pub fn step(&mut self, evidence: &Evidence, count: usize) -> bool {
        let Self { robust, ref mut climb, warm } = *self;
        let free = free(evidence, count);
        if climb.step(evidence, &free, robust) {
            return false;
        }
        let start = if warm && !climb.here.log_likelihood.is_finite() {
            evidence.beginning(robust)
        } else if climb.at.noise != evidence.noise {
            // Triangular noise begins where it is likeliest as a normal one, and wide enough.
            let alphas = climb.at.alphas;
            let wider = if robust == Robust::No {
                evidence.widening(&alphas, &free, INSIDE * evidence.width())
            } else {
                // What is outside to begin with is bad, and stays outside.
                1.0 + evidence.width()
            };
            Parameters { alphas: alphas.map(|alpha| alpha * wider), noise: evidence.noise, ..climb.at }
        } else {
            return true;
        };
        self.climb = Climb::new(evidence, start, robust);
        self.warm = false;
        false
    }

    /// Where it came to.
    pub fn best(&self) -> (Parameters, Slope) {
        (self.climb.at, self.climb.here)
    }
}

/// The likelihood of one α, the others being the likeliest beside it, and as many legs bad as at the maximum.
struct Profile<'a> {
    fitted: &'a Fitted<'a>,
    alpha: usize,
    others: Vec<usize>,
}

impl Profile<'_> {
    /// By what is near a point: the likeliest others beside a value, and the root of twice the fall there.
    fn beside(&self, near: &Near, value: f64) -> (Alphas, f64) {
        let mut alphas = near.at.alphas;
        alphas[self.alpha] = value;
        for k in &self.others {
            // They have to answer for something where this one answers for less.
            alphas[*k] = alphas[*k].max(1e-3 * self.best());
        }
        let (alphas, there) = near.maximum(alphas, &self.others);
        (alphas, self.root(&there))
    }

    /// The root of twice the fall of the log-likelihood; 0 if there is no fall.
    fn root(&self, there: &Slope) -> f64 {
        (2.0 * (self.fitted.slope.log_likelihood - there.log_likelihood)).max(0.0).sqrt()
    }

    fn best(&self) -> f64 {
        self.fitted.best.alphas[self.alpha]
    }

    /// Goes on by a few passes to an end: where what is near the maximum has it, then what is near that place, until it stays. 0 or infinity
    /// where the likelihood does not fall enough.
    fn step(&self, about: &Near, end: &mut End) -> Option<f64> {
        let evidence = self.fitted.evidence;
        let End { side, last, step, ref mut bracket, ref mut moved, is_close, .. } = *end;
        if self.best() == last {
            return Some(last);
        }
        let ended = |bracket: &Bracket| Some(if bracket.is_closed() { bracket.inside[0] } else { last });
        if step == STEPS && !is_close {
            return ended(bracket);
        }
        let near = moved.as_ref().unwrap_or(about);
        // Every third step halves, so that no end stays for good.
        let halve = bracket.outside[1] == f64::INFINITY || step % 3 == 2 && bracket.is_closed();
        let mut value = if halve && !is_close {
            bracket.between(true)
        } else {
            let crossing = end.crossing.get_or_insert_with(|| {
                let far = (near.at.alphas[self.alpha] - self.best()).abs();
                Crossing { bracket: *bracket, far, doublings: 0, step: 0 }
            });
            let value = self.crossing(near, crossing, side)?;
            end.crossing = None;
            value
        };
        if is_close {
            return Some(value);
        }
        end.step += 1;
        if step > 0 && bracket.is_near(value, self.best()) {
            if bracket.inside[0] != self.best() {
                return Some(value);
            }
            // By what is near a point far away, all falls too far but the maximum itself.
            *moved = None;
            value = bracket.between(step % 3 == 2);
        }
        let near = moved.as_ref().unwrap_or(about);
        let (alphas, _) = self.beside(near, value);
        let to = Parameters { alphas, ..about.at };
        let here = evidence.slope(&to, Robust::No);
        if !here.log_likelihood.is_finite() {
            bracket.outside = [value, f64::INFINITY];
            *moved = None;
            return None;
        }
        let near = if step == 0 { about.moved(to, &here) } else { Near::new(evidence, to, &here) };
        let (_, top) = near.maximum(alphas, &self.others);
        let root = self.root(&top);
        bracket.narrow(value, root);
        let off = (root / HEIGHT - 1.0).abs();
        let settled = top.log_likelihood - here.log_likelihood < SLIGHT;
        if settled && off < NEAR || value == last && root <= HEIGHT || bracket.is_narrow(self.best()) {
            return Some(value);
        }
        end.is_close = settled && off < CLOSE;
        if value > FARTHEST && !end.is_close {
            return ended(bracket);
        }
        *moved = Some(near);
        None
    }

    /// Goes on to where what is near a point falls as far as at the end, or to a place on the way there.
    fn crossing(&self, near: &Near, at: &mut Crossing, side: f64) -> Option<f64> {
        let work = &self.fitted.evidence.work;
        let before = work.total();
        let is_enough = || work.total() - before > ENOUGH_WORK;
        let Crossing { bracket, far, doublings, step } = at;
        // Further and further, until it falls enough.
        let deviation = self.fitted.slope.information_of(self.alpha, &self.fitted.free).sqrt().recip();
        let reach = 2.0 * if deviation.is_finite() { deviation } else { self.best() };
        while !bracket.is_closed() && *doublings < DOUBLINGS {
            if is_enough() {
                return None;
            }
            *far = reach.max(*far);
            let value = (self.best() + side * *far).max(0.0);
            bracket.narrow(value, self.beside(near, value).1);
            if !bracket.is_closed() && value == 0.0 {
                return Some(value);
            }
            *far *= 2.0;
            *doublings += 1;
        }
        // The root of the fall is nearly linear, on which a false position finds it soon.
        while *step < STEPS && bracket.is_closed() && !bracket.is_narrow(self.best()) {
            if is_enough() {
                return None;
            }
            let value = bracket.between(*step % 3 == 2);
            let root = self.beside(near, value).1;
            if (root / HEIGHT - 1.0).abs() < 0.2 * NEAR {
                return Some(value);
            }
            bracket.narrow(value, root);
            *step += 1;
        }
        Some(bracket.inside[0])
    }
}

/// A search by what is near a point, of which a part is done.
#[derive(Clone, Debug)]
struct Crossing {
    bracket: Bracket,
    /// How far from the maximum it looks next, at least, while nothing falls far enough; and how often it has.
    far: f64,
    doublings: usize,
    /// How often it has looked between two values.
    step: usize,
}

/// One end of an interval, being sought: the lower one, on side −1, or the upper one, on side 1.
#[derive(Clone, Debug)]
struct End {
    side: f64,
    /// Where it is if the likelihood does not fall enough.
    last: f64,
    step: usize,
    bracket: Bracket,
    /// About where the latest step came to.
    moved: Option<Near>,
    /// Whether what is near that place has the end.
    is_close: bool,
    crossing: Option<Crossing>,
}

impl End {
    fn new(best: f64, side: f64) -> Self {
        let last = if side < 0.0 { 0.0 } else { f64::INFINITY };
        let bracket = Bracket { inside: [best, 0.0], outside: [last, f64::NAN] };
        Self { side, last, step: 0, bracket, moved: None, is_close: false, crossing: None }
    }
}

/// Two values with the roots of their falls: one that falls too little, and one that falls too far, NaN if there is none yet.
#[derive(Clone, Copy, Debug)]
struct Bracket {
    inside: [f64; 2],
    outside: [f64; 2],
}

impl Bracket {
    fn narrow(&mut self, value: f64, root: f64) {
        if root > HEIGHT {
            self.outside = [value, root];
        } else {
            self.inside = [value, root];
        }
    }

    fn is_closed(&self) -> bool {
        !self.outside[1].is_nan()
    }

    /// Whether nothing more can be between its values: what makes the difference is a residual that leaves its triangle.
    fn is_narrow(&self, best: f64) -> bool {
        self.is_near(self.outside[0], best)
    }

    fn is_near(&self, value: f64, best: f64) -> bool {
        (value - self.inside[0]).abs() < (NEAR * (self.inside[0] - best).abs()).max(ROUNDING * best)
    }

    /// The false position, or the middle.
    fn between(&self, halve: bool) -> f64 {
        let Self { inside: [from, low], outside: [to, high] } = *self;
        let share = if halve || !high.is_finite() { 0.5 } else { (HEIGHT - low) / (high - low) };
        from + share * (to - from)
    }
}
