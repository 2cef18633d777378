//! The settings of a candidate refined on the residual of a fit: the place of a shape, and the order of a wave that
//! need not be whole.

use nalgebra::{DMatrix, DVector};

use crate::effects::{Setting, Term, stated_orders};
use crate::linear::{Basis, reject_all};
use crate::model::shapes::{Profile, Shape};
use crate::rounding;

use super::fit::Fit;
use super::regression::Regression;
use crate::diagnosis::candidates::Placed;
use crate::diagnosis::candidates::table::CandidateKind;

/// Orders closer than this are one order and its interval.
pub(crate) const NEIGHBOURS: f64 = 1.5;

impl Regression<'_> {
    /// A candidate with its shape refined on the residual.
    pub(crate) fn refined(&self, fit: &Fit, candidate: usize) -> CandidateKind {
        match &self.table.candidates[candidate].what {
            CandidateKind::Anonymous(shape) => {
                CandidateKind::Anonymous(self.refined_shape(fit, *shape))
            }
            CandidateKind::Named(term) if term.effect.about().setting.takes_fractions() => {
                CandidateKind::Named(self.refined_order(fit, term))
            }
            named @ CandidateKind::Named(_) => named.clone(),
        }
    }

    /// A wave at its likeliest order: the whole number, unless the gain of a fraction exceeds its penalty.
    pub(crate) fn refined_order(&self, fit: &Fit, term: &Term) -> Term {
        let Setting::Order { from, to } = term.effect.about().setting else {
            return term.clone();
        };
        if self.is_stated(term) {
            return term.clone();
        }
        let at = |order: f64| Term {
            setting: order,
            ..term.clone()
        };
        let wave = Wave::of(self, fit, term);
        let gain = |order: f64| {
            let known = wave.as_ref().map(|wave| wave.at(order));
            let columns = known.unwrap_or_else(|| self.columns_of(fit, &at(order)));
            self.gain_of_columns(fit, &columns)
        };
        let whole = gain(term.setting);
        let (mut best, mut most) = (term.setting, whole);
        let mut step = 0.5;
        for _ in 0..8 {
            for order in [best - step, best + step] {
                let inside = order >= f64::from(from) && order <= f64::from(to);
                if inside && (order - term.setting).abs() < NEIGHBOURS {
                    let value = gain(order);
                    if value > most {
                        (best, most) = (order, value);
                    }
                }
            }
            step *= 0.5;
        }
        let nearest = best.round().clamp(f64::from(from), f64::from(to));
        let of_whole = if nearest == term.setting {
            whole
        } else {
            gain(nearest)
        };
        let worth = |gain: f64| {
            let share = (gain / fit.rss.max(1e-300)).min(1.0 - 1e-12);
            -0.5 * self.m() * (-share).ln_1p()
        };
        let (chosen, value) = if worth(most) - worth(of_whole) > self.price_of_a_fraction() {
            (best, worth(most) - self.price_of_a_fraction())
        } else {
            (nearest, worth(of_whole))
        };
        // An order that follows from the gear ratio is no choice among all.
        let stated = stated_orders(&self.base.robot, term.joint).map(|s| s.order);
        let near = stated.filter(|order| (order - term.setting).abs() < NEIGHBOURS);
        let pays = |order: f64| self.price_of_term(&at(order));
        let likelier =
            near.filter(|order| worth(gain(*order)) - pays(*order) >= value - pays(chosen.round()));
        let stated = likelier.max_by(|a, b| gain(*a).total_cmp(&gain(*b)));
        at(stated.unwrap_or(chosen))
    }

    fn refined_shape(&self, fit: &Fit, start: Shape) -> Shape {
        let gain = |shape: &Shape| {
            let placed = self.placed(*shape);
            gain_of(&placed, fit)
        };
        let range = self.table.space.range(start.variable);
        let span = range.1 - range.0;
        let mut best = (start, gain(&start));
        let mut step = match start.profile {
            Profile::Bump { width, .. } => 0.5 * width,
            Profile::Plateau { .. } => 0.04 * span,
            Profile::Kink { .. } => 0.05 * span,
            Profile::Periodic { .. } if span > 0.0 => 0.2 * std::f64::consts::TAU / span,
            _ => return start,
        };
        for _ in 0..6 {
            for (first, second) in [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)] {
                let Some(profile) = moved(best.0.profile, first, second) else {
                    continue;
                };
                let shape = Shape { profile, ..best.0 };
                let value = gain(&shape);
                if value > best.1 {
                    best = (shape, value);
                }
            }
            step *= 0.6;
        }
        best.0
    }
}

/// A wave over a joint's command, `f sin(kq)` and `f cos(kq)`: known for one order `k`, it is known for all.
struct Wave {
    /// The command at each sample.
    q: Vec<f64>,
    /// `f`.
    moves: DVector<f64>,
}

impl Wave {
    /// `None` where the term's columns are no such wave.
    fn of(regression: &Regression, fit: &Fit, term: &Term) -> Option<Self> {
        let columns = regression.columns_of(fit, term);
        let q = regression.rows.inputs.q.get(term.joint)?;
        if columns.ncols() != 2 || q.is_empty() {
            return None;
        }
        let q = q.to_vec();
        let waves: Vec<(f64, f64)> = q.iter().map(|q| (term.setting * q).sin_cos()).collect();
        let moves = |row: usize| {
            let (sin, cos) = waves[row % waves.len()];
            sin * columns[(row, 0)] + cos * columns[(row, 1)]
        };
        let moves = DVector::from_fn(columns.nrows(), |row, _| moves(row));
        let wave = Self { q, moves };
        let apart = (wave.at(term.setting) - &columns).amax();
        (apart <= rounding::COMPUTED * columns.amax()).then_some(wave)
    }

    /// Its columns at another order.
    fn at(&self, order: f64) -> DMatrix<f64> {
        let (height, n) = (self.moves.len(), self.q.len());
        let mut columns = DMatrix::zeros(height, 2);
        let (sines, cosines) = columns.as_mut_slice().split_at_mut(height);
        for (sample, q) in self.q.iter().enumerate() {
            let (sin, cos) = (order * q).sin_cos();
            for row in (sample..height).step_by(n) {
                sines[row] = sin * self.moves[row];
                cosines[row] = cos * self.moves[row];
            }
        }
        columns
    }
}

/// A profile with its two settings moved; `None` where the result is not valid.
fn moved(profile: Profile, first: f64, second: f64) -> Option<Profile> {
    match profile {
        Profile::Bump { centre, width } => {
            let width = width + 0.6 * second;
            (width > 0.0).then_some(Profile::Bump {
                centre: centre + first,
                width,
            })
        }
        Profile::Plateau { from, to } => {
            let (from, to) = (from + first, to + second);
            (from < to).then_some(Profile::Plateau { from, to })
        }
        Profile::Kink { at, below } => (second == 0.0).then_some(Profile::Kink {
            at: at + first,
            below,
        }),
        Profile::Periodic { cycles, harmonics } => (second == 0.0 && cycles + first > 0.0)
            .then_some(Profile::Periodic {
                cycles: cycles + first,
                harmonics,
            }),
        _ => None,
    }
}

/// By how much a shape would lower the sum of squares of a fit.
fn gain_of(placed: &Placed, fit: &Fit) -> f64 {
    let mut own = DMatrix::clone(&placed.white);
    reject_all(&fit.basis.q, &mut own);
    Basis::new(&own).q.tr_mul(&fit.residual).norm_squared()
}
