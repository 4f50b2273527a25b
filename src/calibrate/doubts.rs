//! Whether the model is any good: what the residuals say against it.

use super::bad::Robust;
use super::density::{NORMAL_95, ROOT_TAU};
use super::likelihood::{Alphas, Evidence, LegDensity, Parameters};
use super::model::{Model, Observation};
use super::profile::Search;
use super::systematic::{Square, inverted};
use super::trajectory::sort;
use crate::models::OdometryRule;
use crate::noise::NoiseKind;
use std::f64::consts::FRAC_PI_2;

/// What there is to doubt about a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubts {
    pub kinds: Vec<KindDoubts>,
    pub held_out: HeldOut,
    /// Places of the legs that are furthest from what was expected, the worst first.
    pub worst: Vec<usize>,
    pub verdict: Verdict,
}

/// The residuals of one kind, each by its standard deviation. Legs that are rather bad than not are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct KindDoubts {
    /// As in [`super::Kind`].
    pub name: &'static str,
    pub count: usize,
    /// E\[z⁴\]/E\[z²\]², of each half of the log by itself, in the mean. What changes from half to half is no tail.
    pub kurtosis: f64,
    /// What it is if the model is true: of the normal distribution 3, of the triangular 2.4, and between them where the reference's error or what
    /// is unknown of the systematic ones, which are normal, is part of the residuals.
    pub kurtosis_expected: f64,
    /// Of neighbouring legs; the model says 0. NaN where there are none.
    pub autocorrelation: f64,
    /// Below this it is in 95 of 100 logs of which the model is true.
    pub autocorrelation_limit: f64,
    /// At 0.01, 0.02, … 0.99.
    pub quantiles: Vec<f64>,
}

/// The second half of the log, judged by the α's of the first: as a filter that is tuned by one drive is used on the next.
///
/// Halves in alternate blocks would see the same drive. What their α's are wrong by is that of the α's of the whole, for the mean of r²/v is
/// 1 under those, whatever the model: nothing would be overconfident, and what changes in the course of a drive would not be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldOut {
    /// Residuals.
    pub count: usize,
    /// The share of them inside of their 95 % interval.
    pub coverage: f64,
    /// Where that is in 95 of 100 logs of which the model is true.
    pub coverage_interval: [f64; 2],
    /// The mean of (r/σ)².
    pub squared_error: f64,
    /// Where that is in 95 of 100 logs of which the model is true: χ² over its degrees of freedom, with what is uncertain of the α's of
    /// the first half, as far as the second hangs on them.
    pub squared_error_interval: [f64; 2],
    /// Of a leg, nats.
    pub log_likelihood: f64,
}

/// The first that is true.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Too few legs to say.
    FewLegs,
    /// The reference is not of this drive, or in other units: it goes half as far or twice, or other ways altogether.
    Unrelated,
    /// Legs are much longer than was asked, because one of the logs has few samples: the α's are those of longer legs.
    LongLegs,
    /// The reference errs less than is stated: residuals are smaller than its error alone would make them, and the α's with them.
    Overstated,
    /// Neighbouring legs err alike.
    Correlated,
    /// The reference errs by more than is stated: what it errs by where two legs meet is in both, with opposite signs.
    Understated,
    /// Residuals are far out more often than the noise explains.
    HeavyTails,
    /// Held-out residuals are outside of their intervals more often than they should be.
    Overconfident,
    /// They are inside more often.
    Lazy,
    /// Nothing speaks against the model.
    Fits,
}

/// What α's that are larger or smaller by a factor would make of the held-out half.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inflation {
    /// From a tenth to ten, evenly by their logarithms.
    pub factors: Vec<f64>,
    /// Shares inside of the 95 % interval.
    pub coverage: Vec<f64>,
    /// Of a leg, nats.
    pub log_likelihood: Vec<f64>,
}

/// Fewer legs tell no α to a fifth.
const FEW: usize = 100;

/// The variance of the logarithm of a variance of which nothing is known.
const UNKNOWN: f64 = 100.0;

/// How many of the worst legs are told.
const WORST: usize = 10;

/// Factors between 1 and 10.
const FACTORS: i32 = 12;

/// A correlation that is too small to matter for a filter, however sure it is.
const SLIGHT_CORRELATION: f64 = 0.1;

/// And so many times the limit that 19 of 20 logs are below: three kinds of residuals are asked.
const SURE_CORRELATION: f64 = 1.5;

/// So much kurtosis more than the noise has does no harm, however sure it is.
const SLIGHT_KURTOSIS: f64 = 0.5;

/// So many times as far from the middle as 19 of 20 logs a share has to be for a verdict: beyond that one of seventy is by chance, and with what
/// the other verdicts have one of twenty is anything but `Fits`.
const BEYOND: f64 = 1.25;

/// So many more or fewer of the residuals inside than should be do no harm: 94 of 100 in place of 95.
const SLIGHT_COVERAGE: f64 = 0.01;

/// Of noise with variance 1.
struct Shape {
    /// 95 % are within.
    end: f64,
    /// By how much the share within changes with the logarithm of the variance.
    slope: f64,
}

fn shape(noise: NoiseKind) -> Shape {
    match noise {
        // With c its end: c · φ(c).
        NoiseKind::Normal => {
            Shape { end: NORMAL_95, slope: NORMAL_95 * libm::exp(-0.5 * NORMAL_95 * NORMAL_95) / ROOT_TAU }
        }
        // √6 (1 − √0.05); with u = √0.05, the density there is 2u/√6 on both sides, half of it for the root of the variance.
        NoiseKind::Triangular => {
            let rest = 0.05f64.sqrt();
            Shape { end: 6.0f64.sqrt() * (1.0 - rest), slope: (1.0 - rest) * rest }
        }
    }
}

/// The variance of a sum of α's with these factors, of which so much is known: factorsᵀ · information⁻¹ · factors. Infinite where it
/// hangs on an α of which nothing is known.
fn variance_of(factors: &Alphas, information: &Square) -> f64 {
    let (known, swept) = inverted(information);
    let (mut variance, mut unknown) = (0.0, 0.0f64);
    for alpha in 0..6 {
        let mut weight = 0.0;
        for k in (0..6).filter(|k| known[*k]) {
            weight += swept[alpha][k] * factors[k];
        }
        if known[alpha] {
            variance += factors[alpha] * weight;
        } else {
            // How much it would be, were this one alone.
            let left = factors[alpha] + weight;
            unknown = unknown.max(left * left / information[alpha][alpha]);
        }
    }
    if unknown > variance { f64::INFINITY } else { variance }
}

/// Where the second half of a log begins.
fn half<T>(legs: &[T]) -> usize {
    legs.len() / 2
}

/// Each leg by the α's of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// Standard deviations of the residuals; NaN of one that is not told.
    pub deviations: [f64; 3],
    /// Σ (r/σ)².
    pub squared_error: f64,
    /// The probability that the leg is bad.
    pub bad: f64,
}

impl Judged {
    pub(super) fn all(evidence: &Evidence, at: &Parameters, observations: &[Observation]) -> Vec<Self> {
        let judged = |(leg, observation): (LegDensity, &Observation)| {
            let deviations = leg.variances.map(|variance| variance.map_or(f64::NAN, f64::sqrt));
            let of = Self { deviations, squared_error: 0.0, bad: leg.bad };
            let squared_error =
                of.standardized(observation).iter().filter(|z| z.is_finite()).map(|z| z * z).sum();
            Self { squared_error, ..of }
        };
        evidence.each(at, 0..observations.len()).zip(observations).map(judged).collect()
    }

    /// How much of the variance of a residual is noise of the model.
    fn noise_share(&self, observation: &Observation, kind: usize) -> f64 {
        let added = observation.floors[kind] + observation.unknown[kind];
        (1.0 - added / (self.deviations[kind] * self.deviations[kind])).clamp(0.0, 1.0)
    }

    /// r/σ of each residual; NaN of one that is not told, or of which nothing makes it uncertain.
    pub fn standardized(&self, observation: &Observation) -> [f64; 3] {
        std::array::from_fn(|k| {
            let deviation = self.deviations[k];
            if deviation > 0.0 { observation.residuals[k] / deviation } else { f64::NAN }
        })
    }
}

/// A fit to the first half of the log, and the second.
#[derive(Clone, Debug)]
pub(super) struct Halves {
    model: Model,
    noise: NoiseKind,
    first: Evidence,
    search: Search,
    best: Parameters,
    /// Of the logarithm of the held-out residuals' variances, in the mean, by what is uncertain of the fit.
    of_fit: f64,
    evidence: Evidence,
    observations: Vec<Observation>,
}

impl Halves {
    /// Before the [`Self::fit`].
    pub fn new(
        model: Model,
        robust: Robust,
        all: &Evidence,
        observations: &[Observation],
        near: &Parameters,
    ) -> Self {
        let noise = all.noise;
        let (fitted, held_out) = observations.split_at(half(observations));
        let of = |half: &[Observation]| {
            let mut evidence = Evidence::none(model, noise, all.work.clone());
            half.iter().for_each(|each| evidence.add(each));
            all.work.add(half.len());
            evidence
        };
        let (first, evidence) = (of(fitted), of(held_out));
        let search = Search::new(&first, robust, Some(near));
        let observations = held_out.to_vec();
        Self { model, noise, first, search, best: *near, of_fit: UNKNOWN, evidence, observations }
    }

    /// Goes on by a few passes; whether the first half is fitted.
    pub fn fit(&mut self) -> bool {
        let found = self.search.step(&self.first, self.model.alphas());
        if found {
            self.best = self.search.best().0;
            let [(_, squares), (mean, _)] =
                [&self.first, &self.evidence].map(|half| half.log_variances_by(&self.best));
            self.of_fit = ((self.noise.kurtosis() - 1.0) * variance_of(&mean, &squares)).min(UNKNOWN);
        }
        found
    }

    /// Standardized residuals of the held-out half, its bad legs left out, by these parameters, each with what share of it is noise.
    fn standardized(&self, at: &Parameters) -> Vec<(f64, f64)> {
        let judged = Judged::all(&self.evidence, at, &self.observations);
        let good = judged.iter().zip(&self.observations).filter(|(leg, _)| leg.bad <= 0.5);
        let told = |(leg, observation): (&Judged, &Observation)| {
            let standardized = leg.standardized(observation);
            [0, 1, 2].map(|kind| (standardized[kind], leg.noise_share(observation, kind)))
        };
        good.flat_map(told).filter(|(z, _)| z.is_finite()).collect()
    }

    /// The share of those that are within their 95 %.
    fn coverage(&self, standardized: &[(f64, f64)]) -> f64 {
        let [whole, normal] = [self.noise, NoiseKind::Normal].map(|noise| shape(noise).end);
        // Nearly so where a triangle is blurred by something normal.
        let end = |own: f64| normal + (whole - normal) * own * own;
        let inside = standardized.iter().filter(|(z, own)| z.abs() <= end(*own)).count();
        inside as f64 / standardized.len() as f64
    }

    fn log_likelihood(&self, at: &Parameters) -> f64 {
        self.evidence.slope(at, Robust::No).log_likelihood / self.observations.len() as f64
    }

    fn held_out(&self) -> HeldOut {
        let standardized = self.standardized(&self.best);
        let (count, of_fit) = (standardized.len() as f64, self.of_fit);
        let slope = shape(self.noise).slope;
        let about = |middle: f64, variance: f64, most: f64| {
            let off = NORMAL_95 * variance.sqrt();
            [(middle - off).max(0.0), (middle + off).min(most)]
        };
        let kurtosis = kurtosis_of(self.noise, standardized.iter().map(|(_, own)| *own));
        HeldOut {
            count: standardized.len(),
            coverage: self.coverage(&standardized),
            coverage_interval: about(0.95, 0.95 * 0.05 / count + slope * slope * of_fit, 1.0),
            squared_error: standardized.iter().map(|(z, _)| z * z).sum::<f64>() / count,
            squared_error_interval: about(1.0, (kurtosis - 1.0) / count + of_fit, f64::INFINITY),
            log_likelihood: self.log_likelihood(&self.best),
        }
    }

    /// By one factor more; whether that was the last one.
    pub fn inflate(&self, inflation: &mut Inflation) -> bool {
        let done = inflation.factors.len() as i32;
        let factor = libm::exp10(f64::from(done - FACTORS) / f64::from(FACTORS));
        let at = Parameters { alphas: self.best.alphas.map(|alpha| factor * alpha), ..self.best };
        inflation.factors.push(factor);
        inflation.coverage.push(self.coverage(&self.standardized(&at)));
        inflation.log_likelihood.push(self.log_likelihood(&at));
        done == 2 * FACTORS
    }
}

/// What there is to doubt. `neighbours` says of each leg whether it began where the one before ended.
pub(super) fn doubts(
    model: Model,
    noise: NoiseKind,
    observations: &[Observation],
    judged: &[Judged],
    neighbours: &[bool],
    halves: &Halves,
) -> Doubts {
    let standardized: Vec<[f64; 3]> = judged
        .iter()
        .zip(observations)
        .map(|(leg, observation)| if leg.bad <= 0.5 { leg.standardized(observation) } else { [f64::NAN; 3] })
        .collect();
    let kinds: Vec<KindDoubts> = model
        .kinds()
        .iter()
        .enumerate()
        .map(|(k, kind)| {
            let of_kind: Vec<f64> = standardized.iter().map(|leg| leg[k]).collect();
            let told = judged.iter().zip(observations).zip(&of_kind).filter(|(_, z)| z.is_finite());
            let own = told.map(|((leg, observation), _)| leg.noise_share(observation, k));
            kind_doubts(kind.name, &of_kind, kurtosis_of(noise, own), neighbours)
        })
        .collect();
    let mut worst: Vec<usize> = Vec::with_capacity(WORST + 1);
    for (place, leg) in judged.iter().enumerate() {
        let before = worst.iter().filter(|other| judged[**other].squared_error >= leg.squared_error).count();
        worst.insert(before, place);
        worst.truncate(WORST);
    }
    let held_out = halves.held_out();
    let meetings: Vec<Meeting> = met_in(model)
        .iter()
        .map(|ends| Meeting::of(*ends, observations, judged, &standardized, neighbours))
        .collect();
    let verdict = verdict(observations.len(), &kinds, &meetings, &held_out);
    Doubts { kinds, held_out, worst, verdict }
}

/// Of residuals of which so much is noise of this kind, and the rest normal; of none that of the noise.
fn kurtosis_of(noise: NoiseKind, own: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = own.fold((0.0, 0.0), |(count, sum), own| (count + 1.0, sum + own * own));
    let normal = NoiseKind::Normal.kurtosis();
    normal + (noise.kurtosis() - normal) * if count > 0.0 { sum / count } else { 1.0 }
}

fn kind_doubts(
    name: &'static str,
    standardized: &[f64],
    kurtosis_expected: f64,
    neighbours: &[bool],
) -> KindDoubts {
    let mut told: Vec<f64> = standardized.iter().copied().filter(|z| z.is_finite()).collect();
    sort(&mut told);
    let count = told.len();
    let moments = |half: &[f64]| {
        half.iter().filter(|z| z.is_finite()).fold([0.0; 3], |[count, square, fourth], z| {
            [count + 1.0, square + z * z, fourth + z * z * z * z]
        })
    };
    let (first, second) = standardized.split_at(half(standardized));
    let halves = [first, second].map(moments);
    // The fourth power of less is no double any more: nothing is known of its tails.
    let told_of =
        |square: f64, fourth: f64| if square * square < f64::MIN_POSITIVE { f64::NAN } else { fourth };
    // By their numbers of residuals.
    let kurtosis = halves
        .iter()
        .filter(|[count, ..]| *count > 0.0)
        .map(|[count, square, fourth]| count * count * told_of(*square, *fourth) / (square * square))
        .sum::<f64>()
        / count as f64;
    let square = halves.iter().map(|[_, square, _]| square).sum::<f64>() / count as f64;
    let (neighbouring, products) = pairs(standardized, standardized, neighbours)
        .fold((0.0, 0.0), |(n, sum), [one, next]| (n + 1.0, sum + one * next));
    let at = |share: f64| {
        let place = share * (count as f64 - 1.0);
        let below = place as usize;
        let above = (below + 1).min(count - 1);
        told[below] + (place - below as f64) * (told[above] - told[below])
    };
    KindDoubts {
        name,
        count,
        kurtosis,
        kurtosis_expected,
        autocorrelation: products / neighbouring / square,
        autocorrelation_limit: if neighbouring > 0.0 { NORMAL_95 / neighbouring.sqrt() } else { f64::NAN },
        quantiles: if count > 0 { (1..100).map(|i| at(f64::from(i) / 100.0)).collect() } else { Vec::new() },
    }
}

/// Residuals of legs, each with one of the next leg, where this began where the former ended.
fn pairs<'a>(
    ends: &'a [f64],
    begins: &'a [f64],
    neighbours: &'a [bool],
) -> impl Iterator<Item = [f64; 2]> + 'a {
    let met = ends.iter().zip(begins.iter().zip(neighbours).skip(1));
    met.map(|(end, (begin, next))| ([*end, *begin], *next))
        .filter(|(pair, next)| *next && pair.iter().all(|z| z.is_finite()))
        .map(|(pair, _)| pair)
}

/// The kinds of residuals of a leg and of the next one that hold what the reference errs by between them: each kind itself, and where a leg has two
/// rotations the second and the first, which hold its heading.
fn met_in(model: Model) -> &'static [[usize; 2]] {
    const ALL: [[usize; 2]; 4] = [[0, 0], [1, 1], [2, 2], [2, 0]];
    match model {
        Model::Odometry(OdometryRule::Omni) | Model::Velocity => &ALL[..3],
        Model::Odometry(_) => &ALL,
    }
}

/// A kind of residuals and one of the legs that follow, both of which hold what the reference errs by where two legs meet, with opposite signs.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    correlation: f64,
    /// That of normal residuals whose signs agree so often, in ½ + asin(ρ)/π of pairs: a few that are far out do not decide on it.
    by_signs: f64,
    /// Whether it is of one kind.
    of_one: bool,
    /// What the reference's stated error makes of it.
    stated: f64,
    /// Within this is the correlation in 95 of 100 logs of which the model is true and nothing is stated.
    limit: f64,
}

impl Meeting {
    fn of(
        [ended, begun]: [usize; 2],
        observations: &[Observation],
        judged: &[Judged],
        standardized: &[[f64; 3]],
        neighbours: &[bool],
    ) -> Self {
        let [ends, begins] =
            [ended, begun].map(|k| standardized.iter().map(|leg| leg[k]).collect::<Vec<_>>());
        let square = |of: &[f64]| {
            let (count, sum) =
                of.iter().filter(|z| z.is_finite()).fold((0.0, 0.0), |(n, sum), z| (n + 1.0, sum + z * z));
            sum / count
        };
        let (count, products, signs) =
            pairs(&ends, &begins, neighbours).fold((0.0, 0.0, 0.0), |(n, products, signs), [one, next]| {
                (n + 1.0, products + one * next, signs + one.signum() * next.signum())
            });
        // Of a kind by itself both ends of a leg are in a residual, of two kinds one of each.
        let part = if ended == begun { 0.5 } else { 1.0 };
        let shares = judged.iter().zip(observations).map(|(leg, observation)| {
            let [one, other] =
                [ended, begun].map(|k| observation.floors[k] / (leg.deviations[k] * leg.deviations[k]));
            (one * other).sqrt()
        });
        let (told, shared) = shares
            .filter(|share| share.is_finite())
            .fold((0.0, 0.0), |(n, sum), share| (n + 1.0, sum + share));
        Self {
            correlation: products / count / (square(&ends) * square(&begins)).sqrt(),
            by_signs: libm::sin(FRAC_PI_2 * signs / count),
            of_one: ended == begun,
            stated: -part * shared / f64::max(told, 1.0),
            limit: NORMAL_95 / count.sqrt(),
        }
    }

    /// Whether its residuals err alike, and not a few of them alone.
    fn is_alike(&self) -> bool {
        self.of_one && self.correlation > most(self.limit) && 2.0 * self.by_signs > self.correlation
    }

    /// Whether its residuals are opposite by more than is stated.
    fn is_opposite(&self) -> bool {
        self.correlation < self.stated - most(self.limit)
    }

    /// Whether they are so by their signs too: a reference that jumps now and then makes few of them opposite, however far it jumps.
    fn is_opposite_throughout(&self) -> bool {
        self.correlation < self.stated - self.limit
            && self.by_signs < self.stated - most(FRAC_PI_2 * self.limit)
    }
}

/// A correlation that matters, of which this is beyond in one of twenty logs by chance.
fn most(limit: f64) -> f64 {
    SLIGHT_CORRELATION.max(SURE_CORRELATION * limit)
}

fn verdict(legs: usize, kinds: &[KindDoubts], meetings: &[Meeting], held_out: &HeldOut) -> Verdict {
    // Of three kinds one is beyond two deviations by chance in every seventh log, beyond three in every hundredth.
    let tails = |kind: &KindDoubts| {
        kind.kurtosis - kind.kurtosis_expected > SLIGHT_KURTOSIS.max(3.0 * (24.0 / kind.count as f64).sqrt())
    };
    let HeldOut { count, coverage, coverage_interval: [from, to], .. } = *held_out;
    match () {
        // Legs that tell nothing are none.
        _ if legs < FEW || count < FEW / 2 => Verdict::FewLegs,
        // What is systematic makes tails too, for it is large on some legs and small on others, and so does what a reference errs by, but tails
        // make few neighbours alike, or opposite.
        _ if meetings.iter().any(Meeting::is_alike) => Verdict::Correlated,
        _ if meetings.iter().any(Meeting::is_opposite_throughout) => Verdict::Understated,
        _ if kinds.iter().any(tails) => Verdict::HeavyTails,
        _ if meetings.iter().any(Meeting::is_opposite) => Verdict::Understated,
        _ if coverage < 0.95 - (BEYOND * (0.95 - from)).max(SLIGHT_COVERAGE) => Verdict::Overconfident,
        _ if coverage > 0.95 + (BEYOND * (to - 0.95)).max(SLIGHT_COVERAGE) => Verdict::Lazy,
        _ => Verdict::Fits,
    }
}
