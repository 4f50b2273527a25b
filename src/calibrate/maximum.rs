//! Where a likelihood is largest, by few passes over all legs.

use super::bad::Robust;
use super::likelihood::{Alphas, Evidence, Parameters, Slope};

impl Slope {
    /// What is known of an α when all others are estimated with it: the inverse of its variance, were the likelihood a
    /// parabola.
    pub fn information_of(&self, alpha: usize, free: &[usize]) -> f64 {
        self.efficient(alpha, free).1
    }

    /// The part of an α's gradient that the others cannot answer for (its efficient score): the sum of all with these factors. And its
    /// variance, which is [`Self::information_of`] the α.
    pub fn efficient(&self, alpha: usize, free: &[usize]) -> (Alphas, f64) {
        let mut left = self.information;
        let mut factors: [Alphas; 6] =
            std::array::from_fn(|k| std::array::from_fn(|l| f64::from(u8::from(k == l))));
        // The Schur complement, one variable out after the other.
        for out in free.iter().copied().filter(|other| *other != alpha) {
            let (row, factors_of_row) = (left[out], factors[out]);
            if row[out] > 0.0 {
                for (each, factors) in left.iter_mut().zip(&mut factors) {
                    let factor = each[out] / row[out];
                    each.iter_mut().zip(row).for_each(|(entry, of_row)| *entry -= factor * of_row);
                    factors
                        .iter_mut()
                        .zip(factors_of_row)
                        .for_each(|(entry, of_row)| *entry -= factor * of_row);
                }
            }
        }
        (factors[alpha], left[alpha][alpha])
    }

    /// The maximum of the parabola at `from` with this `gradient` over all `free` α's that are 0 or more, the others as they are in
    /// `at`.
    pub fn maximum(&self, gradient: &Alphas, from: &Alphas, mut at: Alphas, free: &[usize]) -> Alphas {
        // From coordinate to coordinate: what is left over another step of the whole takes care of.
        for _ in 0..SWEEPS {
            let before = at;
            for &k in free {
                let curvature = self.information[k][k];
                if curvature > 0.0 {
                    let pull: f64 = (0..6).map(|l| self.information[k][l] * (from[l] - at[l])).sum();
                    at[k] = (at[k] + (gradient[k] + pull) / curvature).max(0.0);
                }
            }
            if (0..6).all(|k| (at[k] - before[k]).abs() <= 1e-13 * at[k]) {
                break;
            }
        }
        at
    }

    /// The parabola elsewhere.
    fn moved(&self, from: &Alphas, to: &Alphas) -> Self {
        let mut moved = *self;
        for k in 0..6 {
            let pull: f64 = (0..6).map(|l| self.information[k][l] * (to[l] - from[l])).sum();
            moved.gradient[k] -= pull;
            moved.log_likelihood += (to[k] - from[k]) * (self.gradient[k] - 0.5 * pull);
        }
        moved
    }

    /// This and the other, `times` over.
    fn plus(&self, other: &Self, times: f64) -> Self {
        let mut sum = *self;
        sum.log_likelihood += times * other.log_likelihood;
        for k in 0..6 {
            sum.gradient[k] += times * other.gradient[k];
            for l in 0..6 {
                sum.information[k][l] += times * other.information[k][l];
            }
        }
        sum
    }
}

/// Of the maximum of a parabola, through all α's in turn: two of them nearly alike settle within a few hundred.
const SWEEPS: usize = 300;

/// Of the whole: five are usual.
const STEPS: usize = 60;

/// α's below are none: an error of ten nanometres in a metre is rounding, and of a perfect log ever smaller ones are ever likelier.
pub(super) const NOTHING: f64 = 1e-16;

/// Whether all of these are.
pub(super) fn are_nothing(alphas: &Alphas, free: &[usize]) -> bool {
    free.iter().all(|k| alphas[*k] < NOTHING)
}

/// A residual is inside of its triangle to begin with by this share of the width of its edge.
pub(super) const INSIDE: f64 = 0.1;

/// Where other maxima are looked for, in widths of the edge.
const HOPS: [f64; 6] = [1.0, 0.5, 0.25, 0.125, -0.125, -0.25];

/// Legs gone through near a point, after which the rest is for the next step: ten milliseconds' work.
pub(super) const ENOUGH_WORK: usize = 200_000;

/// The shortest part of a step.
const LEAST: f64 = 1e-4;

/// Where so little is promised, nats, other maxima are looked for.
const SETTLED: f64 = 0.01;

/// Of the way to where a residual leaves its triangle.
const LESS: f64 = 0.9;

/// Others that had to be larger by this are out of the question.
const WIDEST: f64 = 10.0;

/// Within what is near a point.
const NEAR_STEPS: usize = 20;

/// What another step has to promise, nats: less is a thousandth of a deviation, and of many legs below the rounding of their sum.
const ENOUGH: f64 = 1e-6;

/// What a step has to have brought for another one, nats: a hundredth of this does not move an interval's end.
const GAINED: f64 = 1e-4;

/// The likelihood near a point: of legs at the edge of their triangle exactly, which are few, of all others the parabola there.
#[derive(Clone, Debug)]
pub(super) struct Near {
    pub at: Parameters,
    rest: Slope,
    edge: Evidence,
    /// That of the edge of all legs.
    width: f64,
}

impl Near {
    /// About a point where the likelihood is that.
    pub fn new(evidence: &Evidence, at: Parameters, here: &Slope) -> Self {
        Self::with_edge(at, here, evidence.edge(&at), evidence.width())
    }

    /// Elsewhere, where the same legs are at the edge.
    pub fn moved(&self, at: Parameters, here: &Slope) -> Self {
        Self::with_edge(at, here, self.edge.clone(), self.width)
    }

    fn with_edge(at: Parameters, here: &Slope, edge: Evidence, width: f64) -> Self {
        let mut near = Self { at, rest: *here, edge, width };
        near.rest = here.plus(&near.of_edge(&at.alphas), -1.0);
        near
    }

    fn of_edge(&self, alphas: &Alphas) -> Slope {
        self.edge.slope(&Parameters { alphas: *alphas, ..self.at }, Robust::No)
    }

    fn slope(&self, alphas: &Alphas) -> Slope {
        self.of_edge(alphas).plus(&self.rest.moved(&self.at.alphas, alphas), 1.0)
    }

    /// The `free` α's that make it largest, from a point on; or likelier ones, where that takes too long at once.
    pub fn maximum(&self, mut at: Alphas, free: &[usize]) -> (Alphas, Slope) {
        // Residuals outside of their triangles have to be inside first.
        let mut here = self.slope(&at);
        if here.log_likelihood == f64::NEG_INFINITY && self.edge.legs() > 0 {
            let wider = self.edge.widening(&at, free, INSIDE * self.width);
            if wider < WIDEST {
                free.iter().for_each(|k| at[*k] *= wider);
                here = self.slope(&at);
            }
        }
        let before = self.edge.work.total();
        for _ in 0..NEAR_STEPS {
            if self.edge.work.total() - before > ENOUGH_WORK {
                break;
            }
            let aim = here.maximum(&here.gradient, &at, at, free);
            let promised = here.moved(&at, &aim).log_likelihood - here.log_likelihood;
            if promised.is_nan() || promised < ENOUGH {
                break;
            }
            let reach = self.edge.reach(&at, &aim);
            let most = if reach < 1.0 { LESS * reach } else { 1.0 };
            let Some((to, there)) = likelier(&here, [most, LEAST], &|share| {
                let to = between(&at, &aim, share);
                (Parameters { alphas: to, ..self.at }, self.slope(&to))
            }) else {
                break;
            };
            let gained = there.log_likelihood - here.log_likelihood;
            (at, here) = (to.alphas, there);
            if gained <= GAINED {
                break;
            }
        }
        (at, here)
    }

    /// With bad legs every one that is in its triangle or out of it makes a maximum of its own. Looks for a likelier one at one of the places
    /// nearby that are to be tried; false after the last of them.
    fn hop(&self, place: usize, at: &mut Alphas, here: &mut Slope, free: &[usize]) -> bool {
        let Some(pair) = self.edge.pairs.get(place / HOPS.len()) else { return false };
        let mut from = *at;
        pair.iter().for_each(|k| from[*k] *= 1.0 + HOPS[place % HOPS.len()] * self.width);
        let (to, there) = self.maximum(from, free);
        if there.log_likelihood > here.log_likelihood + GAINED {
            (*at, *here) = (to, there);
        }
        true
    }
}

fn between(from: &Alphas, to: &Alphas, share: f64) -> Alphas {
    std::array::from_fn(|k| from[k] + share * (to[k] - from[k]))
}

/// By how much a step is to be shorter that has not made the legs likelier: outside of a triangle there is no telling how far.
fn shorter(there: &Slope) -> f64 {
    if there.log_likelihood.is_finite() { 0.5 } else { 0.25 }
}

/// The first of ever shorter parts of a step that makes the legs likelier.
fn likelier(
    here: &Slope,
    [mut share, least]: [f64; 2],
    step: &dyn Fn(f64) -> (Parameters, Slope),
) -> Option<(Parameters, Slope)> {
    while share > least {
        let (to, there) = step(share);
        if there.log_likelihood > here.log_likelihood {
            return Some((to, there));
        }
        share *= shorter(&there);
    }
    None
}

/// The way to the parameters under which the legs are likeliest, one step of a few passes after the other.
#[derive(Clone, Debug)]
pub(super) struct Climb {
    pub at: Parameters,
    pub here: Slope,
    steps: usize,
    /// Of the present step, where that goes on.
    ahead: Option<Ahead>,
}

/// A step of which a part is done.
#[derive(Clone, Debug)]
struct Ahead {
    near: Near,
    /// Where it leads, by what is near.
    aim: Alphas,
    top: Slope,
    /// The place nearby to be tried next.
    place: usize,
    /// Whether what bad legs are stays as it is.
    alone: bool,
    /// The part of the way to be tried next.
    share: f64,
}

impl Climb {
    pub fn new(evidence: &Evidence, start: Parameters, robust: Robust) -> Self {
        Self { at: start, here: evidence.slope(&start, robust), steps: 0, ahead: None }
    }

    /// A step by the `free` α's, or a part of one; whether there is another one.
    pub fn step(&mut self, evidence: &Evidence, free: &[usize], robust: Robust) -> bool {
        let Self { at, here, .. } = *self;
        let before = evidence.work.total();
        let is_enough = || evidence.work.total() - before > ENOUGH_WORK;
        let mut ahead = match self.ahead.take() {
            Some(ahead) => ahead,
            None => {
                self.steps += 1;
                if self.steps > STEPS || are_nothing(&at.alphas, free) {
                    return false;
                }
                let near = Near::new(evidence, at, &here);
                let (aim, top) = near.maximum(at.alphas, free);
                Ahead { near, aim, top, place: 0, alone: false, share: 1.0 }
            }
        };
        let Ahead { near, aim, top, place, alone, share } = &mut ahead;
        let settled = *place > 0 || top.log_likelihood - here.log_likelihood < SETTLED;
        if at.bad.is_some() && near.edge.legs() > 0 && settled {
            while near.hop(*place, aim, top, free) {
                *place += 1;
                if is_enough() {
                    self.ahead = Some(ahead);
                    return true;
                }
            }
        }
        let promised = top.log_likelihood - here.log_likelihood;
        if here.bad.is_none() && (promised.is_nan() || promised < ENOUGH) {
            return false;
        }
        loop {
            let bad = if *alone { at.bad } else { here.bad.or(at.bad) };
            let least = if *alone || bad.is_none() { LEAST } else { 0.3 };
            if *share <= least {
                // Where bad legs cannot be told from others their least spread is in the way of what they are likely to be.
                if *alone || promised.is_nan() || promised < GAINED {
                    return false;
                }
                (*alone, *share) = (true, 1.0);
            } else {
                let bad = at.bad.zip(bad).map(|(from, to)| from.toward(&to, *share));
                let to = Parameters { alphas: between(&at.alphas, aim, *share), bad, ..at };
                let there = evidence.slope(&to, robust);
                if there.log_likelihood > here.log_likelihood {
                    (self.at, self.here) = (to, there);
                    return there.log_likelihood - here.log_likelihood > GAINED;
                }
                *share *= shorter(&there);
            }
            if is_enough() {
                self.ahead = Some(ahead);
                return true;
            }
        }
    }
}
