//! The likeliest slow part, and what else it may be: the likelihood over time constants and
//! variances, on a grid and closer around its maximum.

use super::Noise;
use super::restricted::Restricted;

/// Likelihood, time constant and variances of the slow part in units of the white one's.
pub(super) type Trial = (f64, f64, [f64; 3]);

/// Variances of the slow part that are tried first, in units of the white part's.
const RATIOS: [f64; 4] = [0.1, 0.6, 4.0, 60.0];
/// The largest: what is left of the white part is a thousandth.
const MOST_RATIO: f64 = 1e3;
/// Points of the grid that share the probability, at least, if the grid is to be fine enough.
const FEWEST_ON_THE_GRID: f64 = 6.0;
/// Factor from point to point of the finer grid.
const CLOSER: f64 = 2.0;
/// More points of the grid are not kept.
const GRID: usize = 80;
/// So many alternatives stand for all: more cost more than they say.
const MOST_ALTERNATIVES: usize = 12;

impl Noise {
    /// Likelihood, time constant and variance ratios of the likeliest slow part, and of those on an
    /// even grid; `all`: on the whole grid also where white noise is likelier. `all`: on the whole grid also where white noise is likelier.
    pub(super) fn slowest(
        &self,
        restricted: &Restricted,
        white: f64,
        all: bool,
    ) -> (Option<Trial>, Vec<Trial>) {
        let at = |tau: f64, ratio: [f64; 3]| {
            let sums = restricted.sums(tau, ratio);
            restricted.likelihood(&sums, &self.sigma_mm)
        };
        let (shortest, longest) = restricted.times();
        let mut best: Option<Trial> = None;
        let mut tried: Vec<Trial> = Vec::new();
        let mut keep = |tau: f64, ratio: [f64; 3]| {
            let value = at(tau, ratio);
            if tried.len() < GRID {
                tried.push((value, tau, ratio));
            }
            let better = value.is_finite() && best.is_none_or(|b| value > b.0);
            if better {
                best = Some((value, tau, ratio));
            }
            (better, best)
        };
        // A first look decides whether to look closer.
        let steps = ((longest / shortest).ln() / 4.0_f64.ln()).ceil().max(1.0);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small whole number"
        )]
        let steps_whole = steps as usize;
        let times: Vec<f64> = (0..=steps_whole)
            .map(|k| shortest * (longest / shortest).powf(k as f64 / steps))
            .collect();
        for tau in &times {
            keep(*tau, [RATIOS[1]; 3]);
        }
        let (_, first) = keep(times[0], [RATIOS[2]; 3]);
        if !all && first.is_none_or(|b| b.0 < white - 4.0) {
            return (None, Vec::new());
        }
        for tau in &times {
            for ratio in [RATIOS[0], RATIOS[2], RATIOS[3]] {
                keep(*tau, [ratio; 3]);
            }
        }
        let (_, mut now) = keep(times[0], [RATIOS[1]; 3]);
        for factor in [2.0_f64, 1.4, 1.2] {
            let Some((_, tau, ratio)) = now else { break };
            for by in [factor, 1.0 / factor] {
                keep((tau * by).clamp(0.5 * shortest, longest), ratio);
            }
            let Some((_, tau, mut ratio)) = keep(tau, ratio).1 else {
                break;
            };
            for axis in &restricted.axes {
                for by in [factor * factor, 1.0 / (factor * factor), 0.0] {
                    let mut trial = ratio;
                    trial[*axis] = (ratio[*axis] * by).clamp(0.0, MOST_RATIO);
                    if let (true, Some(b)) = keep(tau, trial) {
                        ratio = b.2;
                    }
                }
            }
            now = keep(tau, ratio).1;
        }
        // Everything up to here was the grid and the first look, which lies on it.
        tried.truncate(4 * times.len() + 1);
        if let (true, Some((_, tau, ratio))) = (all, now) {
            self.look_closer(restricted, (tau, ratio), &mut tried);
        }
        (now, tried)
    }

    /// Where the residuals tell the slow part better than the grid is fine, the grid makes room for
    /// a finer one around the likeliest.
    fn look_closer(&self, restricted: &Restricted, at: (f64, [f64; 3]), tried: &mut Vec<Trial>) {
        let largest = tried.iter().map(|t| t.0).fold(f64::NEG_INFINITY, f64::max);
        let shares = || tried.iter().map(|t| (t.0 - largest).exp());
        let spread = shares().sum::<f64>().powi(2) / shares().map(|s| s * s).sum::<f64>();
        if spread > FEWEST_ON_THE_GRID {
            return;
        }
        // A cell of the grid is ln 4 wide in τ and RATIOS apart in r.
        let widths = [4.0_f64.ln(), (RATIOS[3] / RATIOS[0]).ln() / 3.0];
        let cells = tried.len() as f64;
        let (shortest, longest) = restricted.times();
        let finer = CLOSER.ln().powi(2) / (widths[0] * widths[1]);
        let mut closer = Vec::new();
        for along_tau in -2..=2 {
            let tau = at.0 * CLOSER.powi(along_tau);
            if tau < 0.5 * shortest || tau > longest {
                continue;
            }
            for along_ratio in -2..=2 {
                let by = CLOSER.powi(along_ratio);
                let ratio = at.1.map(|r| (r * by).min(MOST_RATIO));
                let sums = restricted.sums(tau, ratio);
                let likelihood = restricted.likelihood(&sums, &self.sigma_mm);
                closer.push((likelihood + finer.ln(), tau, ratio));
            }
        }
        // `alternatives` shares the prior among as many points as there are.
        let shared = (closer.len() as f64 / cells).ln();
        for trial in &mut closer {
            trial.0 += shared;
        }
        *tried = closer;
    }
}

/// Shares of the probability: white noise against the points of the grid together, at even odds. An
/// interval that allows for a slow part that is not there is a little too wide, one that does not is
/// far too narrow (`hidden_effects intervals`).
///
/// Where there are many, equal shares of the probability are taken in the order of the long-run
/// variance τ·r, which is what widens an interval, so that the tail is there in its proportion.
pub(super) fn alternatives(white: f64, tried: &[Trial]) -> Vec<(f64, f64, [f64; 3])> {
    if tried.is_empty() {
        return Vec::new();
    }
    let each = (tried.len() as f64).ln();
    let slow = tried.iter().map(|(l, tau, ratio)| (l - each, *tau, *ratio));
    let mut all: Vec<Trial> = [(white, 1.0, [0.0; 3])].into_iter().chain(slow).collect();
    let largest = all.iter().map(|a| a.0).fold(f64::NEG_INFINITY, f64::max);
    let total: f64 = all.iter().map(|a| (a.0 - largest).exp()).sum();
    for alternative in &mut all {
        alternative.0 = (alternative.0 - largest).exp() / total;
    }
    let long_run = |a: &Trial| a.1 * a.2.iter().sum::<f64>();
    all.sort_by(|a, b| long_run(a).total_cmp(&long_run(b)));
    let each = 1.0 / MOST_ALTERNATIVES as f64;
    let mut taken: Vec<Trial> = Vec::new();
    let (mut passed, mut due) = (0.0, 0.5 * each);
    for (share, tau, ratio) in all {
        passed += share;
        let mut own = 0.0;
        while due < passed {
            own += each;
            due += each;
        }
        if own > 0.0 {
            taken.push((own, tau, ratio));
        }
    }
    taken
}
