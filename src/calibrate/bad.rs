//! Legs that are off by more than any motion explains: how many, and by how much.

/// Whether some legs are bad, as where a reference jumps: off by more than any motion explains.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Robust {
    /// None is.
    #[default]
    No,
    /// This share of them is, 0 < share < 1.
    Stated(f64),
    /// As many as makes the log likeliest.
    Estimated,
}

/// A bad leg is at least three times as uncertain as others usually are, or it could not be told from them.
const LEAST_SPREAD: f64 = 8.0;

/// The legs that are off by more than any motion explains: how many there are, and the variance of each kind that they have
/// besides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bad {
    pub share: f64,
    pub spreads: [f64; 3],
}

impl Bad {
    /// A part of the way to another.
    pub fn toward(&self, to: &Self, share: f64) -> Self {
        let between = |a: f64, b: f64| a + share * (b - a);
        Self {
            share: between(self.share, to.share),
            spreads: std::array::from_fn(|k| between(self.spreads[k], to.spreads[k])),
        }
    }
}

/// Bad legs as they are likeliest under some α's, by a step of expectation and maximization.
pub(super) struct BadAgain {
    bad: Bad,
    /// The first derivative of the log-likelihood by the share, and minus the second one.
    share: [f64; 2],
    spread: [[f64; 2]; 3],
    usual: [[f64; 2]; 3],
}

impl BadAgain {
    pub fn new(bad: Bad) -> Self {
        Self { bad, share: [0.0; 2], spread: [[0.0; 2]; 3], usual: [[0.0; 2]; 3] }
    }

    /// A leg that is bad with this probability.
    #[inline(always)]
    pub fn add(&mut self, told: &[bool; 3], sizes: &[f64; 3], variances: &[f64; 3], part: f64) {
        let by_share = (part - self.bad.share) / (self.bad.share * (1.0 - self.bad.share));
        self.share[0] += by_share;
        self.share[1] += by_share * by_share;
        for k in (0..3).filter(|k| told[*k]) {
            // A step of scoring: of u = v + w by w.
            let precision = 1.0 / (variances[k] + self.bad.spreads[k]);
            let square = sizes[k] * sizes[k];
            self.spread[k][0] += part * precision * (square * precision - 1.0);
            self.spread[k][1] += part * precision * precision;
            self.usual[k][0] += (1.0 - part) * variances[k];
            self.usual[k][1] += 1.0 - part;
        }
    }

    pub fn likeliest(self, robust: Robust) -> Bad {
        let Self { bad, share, spread, usual } = self;
        let share = match robust {
            // Concave: the step is too long only towards none.
            Robust::Estimated if share[1] > 0.0 => {
                (bad.share + share[0] / share[1]).max(0.01 * bad.share).clamp(1e-9, 0.5)
            }
            _ => bad.share,
        };
        let spreads = std::array::from_fn(|k| {
            let step = if spread[k][1] > 0.0 { spread[k][0] / spread[k][1] } else { 0.0 };
            let least = if usual[k][1] > 0.0 { LEAST_SPREAD * usual[k][0] / usual[k][1] } else { 0.0 };
            // Not by more than tenfold at once: far from the maximum the step is too long.
            (bad.spreads[k] + step).max(0.1 * bad.spreads[k]).min(10.0 * bad.spreads[k]).max(least)
        });
        Bad { share, spreads }
    }
}
