//! The proof on samples that a fit has not seen: the samples are cut into blocks, and each block
//! is predicted by a fit without it, its settings scanned afresh (cross-fitting, Stone 1974).
//!
//! Blocks are stretches of the joint angles where the joints move at random, and stretches of
//! time besides; several small ones make one fold, so that no fold lies beyond the others.

use std::rc::Rc;

use nalgebra::{DMatrix, DVector};

use crate::effects::{Setting, Term};
use crate::fit::regression::Rows;
use crate::model::Model;

use super::columns::Among;
use super::left_out::{Groups, LeftOut};
use super::regression::{Fit, Regression};
use super::surroundings::Without;
use crate::linear::Basis;
use crate::sessions::cells::{cells, folds_of_groups};

/// Which fold each sample of the rows is in.
#[derive(Debug, Clone)]
pub(crate) struct Folds {
    fold: Vec<usize>,
    count: usize,
    /// In words.
    pub(crate) how: String,
}

/// What a fit leaves of samples that it has not seen.
pub(crate) struct Unseen {
    /// Root mean square length, in the unit of the rows.
    pub(crate) rms: f64,
    /// The same in mm.
    pub(crate) rms_mm: f64,
    pub(crate) rows: DVector<f64>,
}

const FOLDS: usize = 5;
const _: () = assert!(FOLDS == 5, "the answer speaks of fifths");
/// Below this number of samples every sector is left out in turn.
const FEW: usize = 60;
/// Below this number of samples nothing is said about unseen ones.
pub(crate) const FEWEST: usize = 6;

impl Folds {
    /// Folds over the samples of an regression, by the angle of the first joint that moves most.
    pub(crate) fn new(regression: &Regression) -> Self {
        if regression.base.robot.joints.len() > 1 {
            return Self::over_cells(&regression.rows, &regression.base);
        }
        let q = &regression.rows.inputs.q;
        let range = |column: &[f64]| {
            let values = column.iter().copied();
            let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
                (a.min(v), b.max(v))
            });
            high - low
        };
        let widest = (0..q.len()).max_by(|a, b| range(&q[*a]).total_cmp(&range(&q[*b])));
        let column = widest.map_or(&[][..], |j| &*q[j]);
        let n = regression.rows.samples.len();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| {
            let value = |k: usize| column.get(k).copied().unwrap_or(0.0);
            value(*a).total_cmp(&value(*b)).then(a.cmp(b))
        });
        let (count, sectors) = if n < FEW {
            let sectors = (n / 3).clamp(2, 10);
            (sectors, sectors)
        } else {
            (FOLDS, 4 * FOLDS)
        };
        let mut fold = vec![0; n];
        for (rank, sample) in order.iter().enumerate() {
            fold[*sample] = (rank * sectors / n.max(1)) % count;
        }
        let joint = widest.map_or(1, |j| j + 1);
        let how = if n < FEW {
            format!(
                "each of {sectors} parts of the range of joint {joint} predicted by a fit that has not seen it"
            )
        } else {
            format!(
                "each fifth of the positions of joint {joint} (spread over its range) predicted by a fit that has not seen it"
            )
        };
        Self { fold, count, how }
    }

    /// Whole stretches of the only joint, each of which a fit has to predict from beyond; `None` of several
    /// joints, or with few samples.
    pub(crate) fn stretches(regression: &Regression) -> Option<Self> {
        let [q] = regression.rows.inputs.q.as_slice() else {
            return None;
        };
        let n = regression.rows.samples.len();
        if n < FEW {
            return None;
        }
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| q[*a].total_cmp(&q[*b]).then(a.cmp(b)));
        let mut fold = vec![0; n];
        for (rank, sample) in order.into_iter().enumerate() {
            fold[sample] = rank * FOLDS / n;
        }
        Some(Self {
            fold,
            count: FOLDS,
            how: String::new(),
        })
    }

    /// Folds over cells of the workspace, for a robot with several joints.
    pub(super) fn over_cells(rows: &Rows, model: &Model) -> Self {
        let points = rows.points(model);
        let n = points.len();
        if let Some(rows) = rows.observed() {
            return Self {
                fold: folds_of_groups(&points, &rows.layer().references(), FOLDS),
                count: FOLDS,
                how: "each fifth of the measurements, of every reference its own, predicted by a fit \
                      that has not seen it"
                    .to_owned(),
            };
        }
        let few = n < FEW;
        let wanted = if few { (n / 3).clamp(2, 10) } else { 4 * FOLDS };
        let cell = cells(&points, wanted);
        let made = cell.iter().max().map_or(1, |c| c + 1);
        let count = if few { made } else { FOLDS };
        Self {
            fold: cell.into_iter().map(|c| c % count).collect(),
            count,
            how: if few {
                format!(
                    "each of {made} cells of the workspace predicted by a fit that has not seen it"
                )
            } else {
                "each fifth of the cells of the workspace predicted by a fit that has not seen it"
                    .to_owned()
            },
        }
    }

    /// Number of samples.
    pub(super) fn samples(&self) -> usize {
        self.fold.len()
    }

    /// Number of folds.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The fold that a sample is in.
    pub(super) fn of(&self, sample: usize) -> usize {
        self.fold[sample]
    }

    /// Whether there are enough samples to say anything.
    pub(crate) fn say_something(&self) -> bool {
        self.fold.len() >= FEWEST
    }

    /// Root mean square length of the deviations of samples that the fit has not seen, mm; of other
    /// measurements than plain points in units of their noise, each by its own.
    pub(crate) fn rms(&self, regression: &Regression, fit: &Fit) -> f64 {
        self.known(regression, fit)[0]
    }

    /// The same in mm whatever was measured.
    pub(crate) fn rms_mm(&self, regression: &Regression, fit: &Fit) -> f64 {
        self.known(regression, fit)[1]
    }

    fn known(&self, regression: &Regression, fit: &Fit) -> [f64; 2] {
        regression.unseen.of(fit, || {
            let unseen = self.unseen(regression, fit);
            [unseen.rms, unseen.rms_mm]
        })
    }

    /// Of terms that are taken out of a fit, which surely predict samples that no fit has seen: to first order, at
    /// the settings that they have, and so clearly that the rest does not matter.
    pub(crate) fn surely_predict(
        &self,
        regression: &Regression,
        fit: &Fit,
        terms: &[&Term],
        rests: &[Option<Without>],
    ) -> Vec<bool> {
        let none = vec![false; rests.len()];
        let (n, rows) = (self.fold.len(), regression.rows.len());
        if n < FEW {
            return none;
        }
        let mut with_all = 0.0;
        let mut without = vec![0.0; rests.len()];
        for fold in 0..self.count {
            let unseen: Vec<usize> = (0..rows).filter(|row| self.fold[row % n] == fold).collect();
            let Some(left_out) = LeftOut::new(&fit.basis, &unseen) else {
                return none;
            };
            let left = fit.residual.select_rows(&unseen);
            let left = DMatrix::from_column_slice(left.len(), 1, left.as_slice());
            with_all += left_out.unseen(&left).norm_squared();
            for (sum, rest) in without.iter_mut().zip(rests) {
                let Some(rest) = rest else { continue };
                let of = left_out.unseen_without(&left, rest.directions(), rest.explained());
                *sum += of.map_or(0.0, |of| of.norm_squared());
            }
        }
        let settled = |term: &Term, rest: &Without| {
            !is_scanned(term) || near_its_own(regression, fit, term, rest, RIVALS).is_empty()
        };
        let each = without.into_iter().zip(terms.iter().zip(rests));
        each.map(|(sum, (term, rest))| {
            let rest = rest.as_ref();
            sum > SURELY * with_all && rest.is_some_and(|rest| settled(term, rest))
        })
        .collect()
    }

    /// The same of the fit's model alone, whose shapes are fitted beside it and predict nothing.
    pub(crate) fn rms_mm_of_the_model(&self, regression: &Regression, fit: &Fit) -> f64 {
        let columns = fit.model.coefficient_count();
        self.predicted_by(regression, fit, columns).rms_mm
    }

    /// What is left of samples that the fit has not seen.
    pub(crate) fn unseen(&self, regression: &Regression, fit: &Fit) -> Unseen {
        self.predicted_by(regression, fit, usize::MAX)
    }

    /// The same where the first so many columns of the fit predict.
    fn predicted_by(&self, regression: &Regression, fit: &Fit, columns: usize) -> Unseen {
        if !self.say_something() {
            // Too few samples to hold any out: the fit's own residual, so that it never stands
            // in the way.
            return Unseen {
                rms: fit.rss.sqrt(),
                rms_mm: fit.rss.sqrt(),
                rows: DVector::zeros(regression.rows.len()),
            };
        }
        let all = Whitened::of(regression, fit);
        let scanned = scanned_terms(regression, fit);
        let whole = Whole::new(&scanned, &all, |white, without| {
            let rest = without.map(|term: &Term| fit.model.without(|t| t.same_column(term)));
            let model = rest.as_ref().unwrap_or(&fit.model);
            let extended = regression
                .of_base()
                .extended(&regression.base, model, white);
            extended.unwrap_or_else(|| Basis::new(white))
        });
        let (height, width) = all.white.shape();
        let settings: usize = scanned.iter().map(|s| 2 + s.candidates.len()).sum();
        let more = width.saturating_sub(regression.base.coefficient_count()) + 1;
        let bases = (1 + scanned.len()) * 4 * more + 4 * settings;
        regression
            .work
            .did((height * width) as f64 * (300 + bases) as f64);
        let n = self.fold.len();
        let (mut sum, mut sum_mm) = (0.0, 0.0);
        let mut left = DVector::zeros(regression.rows.len());
        let rows = regression.rows.len();
        let width = columns.min(all.raw.ncols());
        for fold in 0..self.count {
            let unseen: Vec<usize> = (0..rows).filter(|row| self.fold[row % n] == fold).collect();
            let anew;
            let (of_fold, step) = if let Some(step) = whole.without(&unseen, &all.residual) {
                (&all, step)
            } else {
                let seen = |row: &usize| *row >= rows || self.fold[row % n] != fold;
                let seen: Vec<usize> = (0..regression.height()).filter(seen).collect();
                let (fitted, step) = all.fitted_anew(regression, &scanned, &seen);
                anew = fitted;
                (&anew, step)
            };
            for row in unseen {
                let own = of_fold.raw.row(row);
                let predicted = own.columns(0, width).tr_dot(&step.rows(0, width));
                let e = of_fold.raw_residual[row] - predicted;
                let mm = regression.rows.mm(row) * e;
                left[row] = e;
                sum += e * e;
                sum_mm += mm * mm;
            }
        }
        let lengths = regression.rows.lengths();
        Unseen {
            rms: (sum / n as f64).sqrt(),
            rms_mm: (sum_mm / lengths as f64).sqrt(),
            rows: left,
        }
    }
}

/// Residuals and columns of a fit, its shapes at the end, whitened and as they are.
struct Whitened {
    residual: DVector<f64>,
    white: DMatrix<f64>,
    raw_residual: DVector<f64>,
    raw: DMatrix<f64>,
}

impl Whitened {
    fn of(regression: &Regression, fit: &Fit) -> Self {
        let (raw_residual, mut raw) = regression.raw(&fit.model);
        let (residual, mut white) = regression.whitened(&fit.model, &raw_residual, &raw);
        for shape in &fit.shapes {
            for (all, own) in [(&mut raw, &shape.raw), (&mut white, &shape.white)] {
                let at = all.ncols();
                let wider = std::mem::take(all).resize_horizontally(at + own.ncols(), 0.0);
                *all = wider;
                all.columns_mut(at, own.ncols()).copy_from(own);
            }
        }
        Self {
            residual,
            white,
            raw_residual,
            raw,
        }
    }

    /// With the whitened rows that are seen alone, every scanned term at the setting that they like best,
    /// and the step of the fit to them.
    fn fitted_anew(
        &self,
        regression: &Regression,
        scanned: &[Scanned],
        seen: &[usize],
    ) -> (Self, DVector<f64>) {
        let mut own = Self {
            residual: self.residual.select_rows(seen),
            white: self.white.select_rows(seen),
            raw_residual: self.raw_residual.clone(),
            raw: self.raw.clone(),
        };
        let mut last = None;
        for term in scanned {
            last = Some(term.rescan(regression, seen, &mut own));
        }
        // The columns beside the term that was scanned last are orthonormal already.
        let basis = last.map_or_else(|| Basis::new(&own.white), |term| term.with_term(&own.white));
        let step = basis.solve(&own.residual);
        (own, step)
    }
}

/// A term whose setting is scanned afresh in every fold.
struct Scanned {
    term: Term,
    first: usize,
    size: usize,
    coefficients: DVector<f64>,
    candidates: Vec<usize>,
    /// Whitened columns of all these.
    white: DMatrix<f64>,
}

/// What a fit without a term leaves of unseen samples is clearly more if it is so many times as much, squared.
const SURELY: f64 = 1.04;
/// Another setting rivals the term's own from this share of what that does on.
const RIVALS: f64 = 0.6;
/// Settings that are scanned afresh, at most …
const MOST_SETTINGS: usize = 16;
/// … of those that would lower the square by this share of what the term does, over all samples: a fifth of them
/// does not make up for the rest.
const NEAR: f64 = 0.3;

/// Settings of a term, other than its own, that would lower the square by more than a share of what the term does.
fn near_its_own(
    regression: &Regression,
    fit: &Fit,
    term: &Term,
    rest: &Without,
    share: f64,
) -> Vec<usize> {
    let own = rest.rss - fit.rss;
    let around = regression.surroundings(fit, Among::Names);
    let gain = |index: usize| around.gain(rest, &regression.table.candidates[index]);
    let setting = |index: &usize| {
        let term = regression.table.candidates[*index].what.term();
        term.map(|t| t.setting)
    };
    let others = settings(regression, term).into_iter();
    let others = others.filter(|c| setting(c) != Some(term.setting));
    let gains = others.map(|index| (gain(index), index));
    let mut gains: Vec<(f64, usize)> = gains.filter(|g| g.0 > share * own).collect();
    gains.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    gains.truncate(MOST_SETTINGS);
    let mut kept: Vec<usize> = gains.iter().map(|g| g.1).collect();
    kept.sort_unstable();
    kept
}

/// Whether a term's setting is scanned afresh in every fold.
fn is_scanned(term: &Term) -> bool {
    // A fade is a coefficient like others: every fold's fit moves it.
    !matches!(
        term.effect.about().setting,
        Setting::None | Setting::Setup | Setting::Target | Setting::Place | Setting::Fade
    )
}

/// Candidates that are a term with any setting.
fn settings(regression: &Regression, term: &Term) -> Vec<usize> {
    let id = term.effect.about().id;
    let same = |index: &usize| {
        let candidate = &regression.table.candidates[*index];
        let other = candidate.what.term();
        other.is_some_and(|t| t.effect.about().id == id && t.joint == term.joint)
    };
    let count = regression.table.candidates.len();
    (0..count).filter(same).collect()
}

fn scanned_terms(regression: &Regression, fit: &Fit) -> Vec<Scanned> {
    let mut first = 0;
    let mut all = Vec::new();
    for term in fit.model.terms() {
        let size = term.coefficients.len();
        if is_scanned(term) {
            let many = regression.rows.samples.len() >= FEW;
            let rest = many.then(|| regression.without(fit, term)).flatten();
            let candidates = match rest {
                Some(rest) => near_its_own(regression, fit, term, &rest, NEAR),
                None => settings(regression, term),
            };
            if candidates.is_empty() {
                first += size;
                continue;
            }
            let of_table = candidates.iter().map(|i| &regression.table.candidates[*i]);
            let white = regression.white_columns(&of_table.collect::<Vec<_>>());
            all.push(Scanned {
                term: term.clone(),
                first,
                size,
                coefficients: DVector::from_column_slice(&term.coefficients),
                candidates,
                white,
            });
        }
        first += size;
    }
    all
}

/// A fit over all rows, from which every fold is taken in turn.
struct Whole {
    basis: Basis,
    terms: Vec<Beside>,
}

/// A scanned term's candidates beside everything else.
struct Beside {
    others: Rc<Basis>,
    /// Where the others' columns stand.
    places: Vec<usize>,
    /// The candidates' columns, and the term's own at the end.
    groups: Groups,
    /// What there is to explain with the term out.
    without_term: DVector<f64>,
}

/// A setting has to be better than the fit's by this share of its gain.
const BETTER: f64 = 1e-9;

impl Beside {
    /// Of these rows; `candidates` are the whitened columns of every setting in them.
    fn new(
        term: &Scanned,
        rows: &Whitened,
        candidates: DMatrix<f64>,
        basis: impl Fn(&DMatrix<f64>) -> Basis,
    ) -> Self {
        let own = rows.white.columns(term.first, term.size);
        let others_at = |k: &usize| !(term.first..term.first + term.size).contains(k);
        let places: Vec<usize> = (0..rows.white.ncols()).filter(others_at).collect();
        let others = Rc::new(basis(&rows.white.select_columns(&places)));
        let without_term = &rows.residual + own * &term.coefficients;
        let width = candidates.ncols();
        let mut columns = candidates.resize_horizontally(width + term.size, 0.0);
        columns.columns_mut(width, term.size).copy_from(&own);
        Self {
            groups: Groups::new(columns, term.size, &others, &without_term),
            without_term,
            others,
            places,
        }
    }

    /// The setting that is better than the fit's in all rows but these; `Err` where the rest does not
    /// tell the other columns.
    fn better(&self, left_out: &[usize]) -> Result<Option<usize>, Untold> {
        let rest = LeftOut::new(&self.others, left_out).ok_or(Untold)?;
        let gains = rest.gains(&self.groups, &self.without_term);
        let (own, candidates) = gains.split_last().ok_or(Untold)?;
        let mut best = (own * (1.0 + BETTER), None);
        for (k, gain) in candidates.iter().enumerate() {
            if *gain > best.0 {
                best = (*gain, Some(k));
            }
        }
        Ok(best.1)
    }

    /// The basis of all columns, once the term's are as they are to be.
    fn with_term(&self, white: &DMatrix<f64>) -> Basis {
        Basis::extending(&self.others, &self.places, white)
    }
}

/// The rows do not tell all columns.
struct Untold;

impl Whole {
    /// `basis` is of all columns, or of those without a term's.
    fn new(
        scanned: &[Scanned],
        rows: &Whitened,
        basis: impl Fn(&DMatrix<f64>, Option<&Term>) -> Basis,
    ) -> Self {
        let beside = |term: &Scanned| {
            let others = |white: &DMatrix<f64>| basis(white, Some(&term.term));
            Beside::new(term, rows, term.white.clone(), others)
        };
        let terms: Vec<Beside> = scanned.iter().map(beside).collect();
        let last = terms.last();
        let basis = last.map_or_else(
            || basis(&rows.white, None),
            |term| term.with_term(&rows.white),
        );
        Self { basis, terms }
    }

    /// The step of a fit without these rows; `None` where one of the settings would be another there, or
    /// the other rows do not tell all columns.
    fn without(&self, rows: &[usize], residual: &DVector<f64>) -> Option<DVector<f64>> {
        let stays = |term: &Beside| matches!(term.better(rows), Ok(None));
        if !self.terms.iter().all(stays) {
            return None;
        }
        Some(LeftOut::new(&self.basis, rows)?.solve(residual))
    }
}

impl Scanned {
    /// Exchanges the term's columns for those of the setting that the seen rows like best.
    fn rescan(&self, regression: &Regression, seen: &[usize], rows: &mut Whitened) -> Beside {
        let beside = Beside::new(self, rows, self.white.select_rows(seen), Basis::new);
        let Ok(Some(at)) = beside.better(&[]) else {
            return beside;
        };
        let candidate = &regression.table.candidates[self.candidates[at]];
        rows.residual.copy_from(&beside.without_term);
        let raw_back = rows.raw.columns(self.first, self.size) * &self.coefficients;
        rows.raw_residual += raw_back;
        let (first, size) = (self.first, self.size);
        let own = self.white.columns(at * size, size).select_rows(seen);
        rows.white.columns_mut(first, size).copy_from(&own);
        let own = regression.table.columns.raw(candidate.first, size);
        rows.raw.columns_mut(first, size).copy_from(&own);
        beside
    }
}
