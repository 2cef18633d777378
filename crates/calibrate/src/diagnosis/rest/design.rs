//! The columns of the geometry and of the families on the samples, and their products, fold by fold.

use nalgebra::{DMatrix, DVector};

use crate::diagnosis::evidence::Folds;
use crate::diagnosis::evidence::shares::{Gains, dealt};
use crate::effects::rest::MOVES;
use crate::effects::{EACH_DIRECTION, Term};
use crate::fit::base_model;
use crate::fit::noise::Noise;
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::model::Model;
use crate::side_by_side::Threads;
use crate::text::Text;
use crate::{budget, fewest};

use super::families::Families;
use super::groups::Remaining;
use super::held_out::{HeldOut, Whitened};
use super::orders::{self, Residual};
use super::products::Products;

/// Orders that are added at most.
const MOST_ORDERS: usize = 8;

/// Columns of the geometry and of each family, with their products fold by fold.
#[derive(Clone)]
pub(super) struct Design<'a> {
    rows: Rows<'a>,
    noise: Noise,
    model: Model,
    folds: Folds,
    families: Families,
    orders: usize,
    /// Rows of a unit of each of the moves of each joint.
    directions: DMatrix<f64>,
    /// The geometry's columns, the families' and the residual, with the rows of the priors below.
    whitened: Whitened,
    /// By cell, of the samples that are not apart.
    parts: Vec<Products>,
    /// The share of each sample.
    share: Vec<usize>,
    /// The share that is held out of every choice and fit.
    apart: Option<usize>,
    /// Of the priors.
    products: Option<Products>,
    total: Products,
    threads: Threads,
}

/// A column of the whole model: its number there, its term and coefficient.
type Column = (usize, Term, usize);

/// Whether a column is fitted here: names keep their values, as in the model that is handed out.
fn is_fitted(term: &Term, coefficient: usize) -> bool {
    base_model::belongs(term.effect.about().id) && !term.held.contains(coefficient)
}

/// The priors of the columns as rows in units of their standard deviations, and their residuals.
fn known_rows(
    problem: &Problem<'_>,
    model: &Model,
    rows: &Rows,
    own: &[Column],
) -> (DMatrix<f64>, DVector<f64>) {
    let sigma = |(_, term, k): &Column| problem.priors.sigma(model, term, *k);
    let known = own.iter().enumerate();
    let known: Vec<(usize, f64, f64)> = known
        .filter_map(|(c, o)| Some((c, sigma(o)?, o.1.coefficients[o.2])))
        .collect();
    let (prior_residual, columns) = rows.prior_rows(model, &problem.priors);
    let mut all = DMatrix::zeros(known.len() + prior_residual.len(), own.len());
    let mut y = DVector::zeros(all.nrows());
    for (row, (column, sigma, value)) in known.iter().enumerate() {
        all[(row, *column)] = 1.0 / sigma;
        y[row] = -value / sigma;
    }
    let of_model = model.columns().enumerate();
    let of_model = of_model.filter(|(_, (term, k))| is_fitted(term, *k));
    for (column, (place, _)) in of_model.enumerate() {
        for row in 0..prior_residual.len() {
            all[(known.len() + row, column)] = columns[(row, place)];
        }
    }
    y.rows_mut(known.len(), prior_residual.len())
        .copy_from(&prior_residual);
    (all, y)
}

impl<'a> Design<'a> {
    /// Of the samples of a problem that count; `None` where they are too few.
    pub(super) fn new(
        problem: &Problem<'a>,
        noise: &Noise,
        model: &Model,
        threads: Threads,
    ) -> Option<Self> {
        let problem = problem.thinned(budget::SAMPLES);
        let rows = Rows::of(&problem).seen_by(model);
        let joints = model.robot.joints.len();
        let probes = (0..joints).map(|joint| Term::absent(&EACH_DIRECTION, joint, 0.0));
        let probes: Vec<Term> = probes.collect();
        let with = probes
            .iter()
            .fold(model.clone(), |m, probe| m.with_term(probe.clone()));
        let (residual, all) = rows.extract(&with);
        let is_probe = |t: &Term| probes.iter().any(|p| p.same_column(t));
        let mut own = Vec::new();
        let mut unit = Vec::new();
        for (k, (term, coefficient)) in with.columns().enumerate() {
            if is_probe(term) {
                unit.push(k);
            } else if is_fitted(term, coefficient) {
                own.push((k, term.clone(), coefficient));
            }
        }
        let directions = all.select_columns(&unit);
        let places: Vec<usize> = own.iter().map(|o| o.0).collect();
        let geometry = all.select_columns(&places);
        let m = rows.len();
        let (known, of_known) = known_rows(&problem, model, &rows, &own);
        let height = m + known.nrows();
        let mut white = noise
            .whitened(&rows, &geometry)
            .resize_vertically(height, 0.0);
        white.rows_mut(m, known.nrows()).copy_from(&known);
        let mut y = noise
            .whitened_vector(&rows, &residual)
            .resize_vertically(height, 0.0);
        y.rows_mut(m, known.nrows()).copy_from(&of_known);
        let mut raw = (!noise.is_white()).then_some(geometry);
        let kept: Vec<usize> = (0..white.ncols())
            .filter(|k| white.column(*k).norm() > 0.0)
            .collect();
        let mut white = white.select_columns(&kept);
        raw = raw.map(|raw| raw.select_columns(&kept));
        for k in 0..kept.len() {
            let norm = white.column(k).norm();
            white.column_mut(k).unscale_mut(norm);
            if let Some(raw) = &mut raw {
                raw.column_mut(k).unscale_mut(norm);
            }
        }
        if rows.count() < kept.len() + fewest::TO_SCAN {
            return None;
        }
        let base = kept.len();
        let families = Families::of(&model.robot, &rows.inputs);
        let folds = if joints > 1 {
            Folds::over_cells(&rows, model)
        } else {
            Folds::over_values(&rows)
        };
        let share = dealt(&rows);
        let with = |all: DMatrix<f64>, y: &DVector<f64>| {
            let mut all = all.insert_column(base, 0.0);
            all.set_column(base, y);
            all
        };
        let n = folds.samples().max(1);
        // Of independent rows a whitened one is one in units of its axis's noise.
        let unit = |row: usize| {
            if noise.is_white() {
                noise.sigma_mm[rows.axes[row / n]]
            } else {
                1.0
            }
        };
        let whitened = Whitened {
            raw: raw.map(|raw| with(raw, &residual)),
            white: with(white, &y),
            base,
            measured: (0..m)
                .map(|row| (row % n, rows.mm(row) * unit(row)))
                .collect(),
            floor: 0.0,
        };
        let mut design = Self {
            total: whitened.products(&[]),
            parts: Vec::new(),
            apart: None,
            share,
            products: None,
            threads,
            orders: 0,
            noise: noise.clone(),
            model: model.clone(),
            rows,
            folds,
            families,
            directions,
            whitened,
        };
        design.append(0);
        Some(design)
    }

    /// Takes in the columns of the families from number `first` on.
    fn append(&mut self, first: usize) {
        let inputs = &self.rows.inputs;
        let robot = &self.model.robot;
        let mut more = self.families.shown(robot, inputs, &self.directions, first);
        let (last, width) = (self.whitened.white.ncols() - 1, more.ncols());
        let m = self.rows.len();
        let put = |all: &mut DMatrix<f64>, own: &DMatrix<f64>| {
            let wider = std::mem::take(all).insert_columns(last, width, 0.0);
            *all = wider;
            all.view_mut((0, last), (m, width)).copy_from(own);
        };
        if let Some(raw) = &mut self.whitened.raw {
            put(raw, &more);
        }
        self.noise.filter(&self.rows).whiten(more.as_mut_slice());
        put(&mut self.whitened.white, &more);
        drop(more);
        let known: Vec<usize> = (m..self.whitened.white.nrows()).collect();
        let of = |rows: &[usize], before: Option<&Products>| match before {
            Some(products) => products.with(&self.whitened.white, width, rows),
            None => self.whitened.products(rows),
        };
        let parts: Vec<Products> = self.threads.each(self.folds.count(), |fold| {
            of(&self.rows_of(fold), self.parts.get(fold))
        });
        let known = of(&known, self.products.as_ref());
        // What was measured counts: an observation may have fewer rows than others.
        self.total = parts
            .iter()
            .fold(known.clone(), |sum, part| sum.and(part, 1.0));
        self.parts = parts;
        self.products = Some(known);
    }

    /// The same without a share, which is held out of the choice.
    pub(super) fn without(&self, share: usize) -> Self {
        let mut now = self.clone();
        now.apart = Some(share);
        for (cell, part) in now.parts.iter_mut().enumerate() {
            let in_both =
                |sample: usize| self.folds.of(sample) == cell && self.share[sample] == share;
            let own = self.whitened.products(&self.whitened.rows(in_both));
            *part = part.and(&own, -1.0);
            now.total = now.total.and(&own, -1.0);
        }
        now
    }

    /// The strengths of no family at all.
    pub(super) fn none(&self) -> Vec<f64> {
        vec![0.0; self.families.all.len()]
    }

    /// Rows of the samples that are in a cell and not apart.
    fn rows_of(&self, cell: usize) -> Vec<usize> {
        let is_apart = |sample: usize| Some(self.share[sample]) == self.apart;
        self.whitened
            .rows(|sample| self.folds.of(sample) == cell && !is_apart(sample))
    }

    /// The samples of a share.
    #[cfg(test)]
    pub(super) fn samples_of_share(&self, share: usize) -> Vec<usize> {
        let all = 0..self.share.len();
        all.filter(|sample| self.share[*sample] == share).collect()
    }

    /// Rows of the samples that are apart.
    fn rows_apart(&self) -> Vec<usize> {
        let apart = |share| self.whitened.rows(|sample| self.share[sample] == share);
        self.apart.map(apart).unwrap_or_default()
    }

    fn family_of(&self) -> Vec<usize> {
        self.families.columns.iter().map(|c| c.family).collect()
    }

    /// Strengths of the families, and how much likelier the samples are with them; the families that
    /// are nothing are forgotten.
    pub(super) fn strengths(&mut self) -> Option<(Vec<f64>, f64)> {
        let remaining = Remaining::of(&self.total)?;
        let family = self.family_of();
        let count = self.families.all.len();
        let (strengths, likelier) = remaining.strengths(&family, count)?;
        let kept: Vec<bool> = strengths.iter().map(|s| *s > 0.0).collect();
        let columns: Vec<usize> = (0..family.len()).filter(|k| kept[family[*k]]).collect();
        self.families = self.families.only(&kept);
        let all = |first: usize| -> Vec<usize> {
            let own = columns.iter().map(|k| first + k);
            (0..first)
                .chain(own)
                .chain([self.whitened.white.ncols() - 1])
                .collect()
        };
        let places = all(self.whitened.base);
        let whitened = &mut self.whitened;
        whitened.raw = whitened.raw.take().map(|raw| raw.select_columns(&places));
        whitened.white = whitened.white.select_columns(&places);
        for part in self.parts.iter_mut().chain(&mut self.products) {
            *part = part.only(&columns);
        }
        self.total = self.total.only(&columns);
        Some((
            strengths.into_iter().filter(|s| *s > 0.0).collect(),
            likelier,
        ))
    }

    /// Coefficients of the geometry and of the families, in the order of the columns.
    fn solved(&self, strengths: &[f64]) -> Option<DVector<f64>> {
        let remaining = Remaining::of(&self.total)?;
        let solved = remaining.solved(&self.family_of(), strengths)?;
        self.total.with_base(&solved.coefficients())
    }

    /// The joint and the order that exceeds all noise in the residuals, if any.
    pub(super) fn next_order(&self, strengths: &[f64]) -> Option<(usize, f64)> {
        if self.orders >= MOST_ORDERS || !self.noise.is_white() {
            return None;
        }
        let solved = self.solved(strengths)?;
        let white = &self.whitened.white;
        let (m, last) = (self.rows.len(), white.ncols() - 1);
        let residuals = white.column(last) - white.columns(0, last) * solved;
        let mut residuals = residuals.rows(0, m).into_owned();
        for row in self.rows_apart() {
            residuals[row] = 0.0;
        }
        let variance = residuals.norm_squared() / (self.rows.count().max(1) as f64);
        let joints = self.model.robot.joints.len();
        let motions: Vec<usize> = (0..joints).map(|j| j * MOVES).collect();
        let units = self.directions.select_columns(&motions);
        let residual = Residual {
            robot: &self.model.robot,
            q: &self.rows.inputs.q,
            units: &self.noise.whitened(&self.rows, &units),
            values: &residuals,
            variance,
        };
        orders::strongest(&residual)
    }

    pub(super) fn add_order(&mut self, joint: usize, order: f64) {
        let first = self.families.columns.len();
        self.families.add_order(joint, order);
        self.orders += 1;
        self.append(first);
    }

    /// Every fold by the others, for [`gains`](Self::gains).
    pub(super) fn unseen(&self) -> Option<HeldOut<'_>> {
        let seen = |cell: usize| {
            let seen = self.total.and(&self.parts[cell], -1.0);
            (self.rows_of(cell), seen)
        };
        let folds = self.parts.len();
        let samples = self.folds.samples();
        HeldOut::new(&self.whitened, &seen, folds, samples, self.threads)
    }

    /// The gain of the families in cross-validation over cells; the strengths are determined again without them.
    pub(super) fn gains(&self, unseen: &HeldOut, strengths: &[f64]) -> Option<Gains> {
        let family = self.family_of();
        let squares = unseen.squares(|remaining| {
            let refined = remaining.refined(&family, strengths.to_vec(), budget::ROUNDS)?;
            Some(remaining.solved(&family, &refined)?.coefficients())
        })?;
        Some(self.gains_of(&squares))
    }

    /// Squares of the samples that are held out apart with families of these strengths, mm²; zero of the others.
    pub(super) fn squares_apart(&self, strengths: &[f64]) -> Option<Vec<f64>> {
        let coefficients = self.solved(strengths)?;
        let (rows, samples) = (self.rows_apart(), self.folds.samples());
        Some(self.whitened.squares(&rows, &coefficients, samples))
    }

    /// The gains from the squares of every sample without and with families.
    pub(super) fn gains_of(&self, squares: &[[f64; 2]]) -> Gains {
        Gains::of(&self.rows, squares)
    }

    /// The terms of a model with these strengths, and what they follow.
    pub(super) fn terms(&self, strengths: &[f64]) -> Option<(Vec<Term>, Vec<Text>)> {
        let solved = self.solved(strengths)?;
        let joints = self.model.robot.joints.len();
        let own = &solved.as_slice()[self.whitened.base..];
        let all = self.families.all.iter().zip(strengths);
        let over = all.filter(|(_, s)| **s > 0.0).map(|(f, _)| f.in_words());
        let mut over: Vec<Text> = over.collect();
        // The two directions of a guide have one name.
        over.dedup();
        Some((self.families.terms(own, joints), over))
    }
}
