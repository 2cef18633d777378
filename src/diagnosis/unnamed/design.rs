//! The columns of the geometry and of the families on the samples, and their products, fold by fold.

use crate::text::Text;
use nalgebra::{DMatrix, DVector};

use crate::effects::curve::DIRECTIONS;
use crate::effects::{EACH_DIRECTION, Term};
use crate::fit::base_model;
use crate::fit::noise::Noise;
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::model::Model;

use super::FEWEST_ROWS;
use super::families::Families;
use super::orders::{self, Residual};
use super::products::Products;
use super::strengths::{NEARLY, Remaining};
use crate::diagnosis::held_out::Folds;

/// A longer session is thinned evenly to so many samples.
const MOST_SAMPLES: usize = 1500;
/// Orders that are added at most.
const MOST_ORDERS: usize = 8;

/// Columns of the geometry and of each family, with their products fold by fold.
pub(super) struct Design<'a> {
    rows: Rows<'a>,
    noise: Noise,
    model: Model,
    folds: Folds,
    families: Families,
    orders: usize,
    /// Rows of a unit in each direction of each joint.
    directions: DMatrix<f64>,
    /// The geometry's columns, then the families', then the residual: as they are, and whitened with the
    /// rows of the priors below.
    raw: DMatrix<f64>,
    white: DMatrix<f64>,
    geometry: usize,
    /// By fold, and of what is known beforehand.
    parts: Vec<Products>,
    total: Products,
}

/// What the families bring on unseen cells.
pub(super) struct Gains {
    pub(super) before_mm: f64,
    pub(super) after_mm: f64,
    /// The gain in units of its standard deviation.
    pub(super) sigmas: f64,
}

impl<'a> Design<'a> {
    /// Of the samples of a problem that count; `None` where they are too few.
    pub(super) fn new(problem: &Problem<'a>, noise: &Noise, model: &Model) -> Option<Self> {
        let mut problem = problem.clone();
        problem.thin(MOST_SAMPLES);
        let rows = Rows::of(&problem).seen_by(model);
        let joints = model.robot.joints.len();
        let probes = (0..joints).map(|joint| Term::absent(&EACH_DIRECTION, joint, 0.0));
        let probes: Vec<Term> = probes.collect();
        let with = probes
            .iter()
            .fold(model.clone(), |m, probe| m.with_term(probe.clone()));
        let (residual, all) = rows.extract(&with);
        let is_probe = |t: &Term| probes.iter().any(|p| p.same_column(t));
        // Names keep their values, here as in what is handed out.
        let is_fitted = |term: &Term, coefficient: usize| {
            base_model::belongs(term.effect.about().id) && !term.held.contains(coefficient)
        };
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
        // What is known beforehand, in rows below.
        let sigma = |(_, term, k): &(usize, Term, usize)| problem.priors.sigma(model, term, *k);
        let known: Vec<(usize, f64, f64)> = own
            .iter()
            .enumerate()
            .filter_map(|(c, o)| Some((c, sigma(o)?, o.1.coefficients[o.2])))
            .collect();
        let (left, columns) = rows.known(model, &problem.priors);
        let m = rows.len();
        let height = m + known.len() + left.len();
        let mut white = noise
            .whitened(&rows, &geometry)
            .resize_vertically(height, 0.0);
        let mut y = noise
            .whitened_vector(&rows, &residual)
            .resize_vertically(height, 0.0);
        for (row, (column, sigma, value)) in known.iter().enumerate() {
            white[(m + row, *column)] = 1.0 / sigma;
            y[m + row] = -value / sigma;
        }
        let of_model = model.columns().enumerate();
        let of_model = of_model.filter(|(_, (term, k))| is_fitted(term, *k));
        let of_model: Vec<usize> = of_model.map(|(at, _)| at).collect();
        for row in 0..left.len() {
            y[m + known.len() + row] = left[row];
            for (column, place) in of_model.iter().enumerate() {
                white[(m + known.len() + row, column)] = columns[(row, *place)];
            }
        }
        let mut raw = geometry;
        let kept: Vec<usize> = (0..white.ncols())
            .filter(|k| white.column(*k).norm() > 0.0)
            .collect();
        let mut white = white.select_columns(&kept);
        raw = raw.select_columns(&kept);
        for k in 0..kept.len() {
            let norm = white.column(k).norm();
            white.column_mut(k).unscale_mut(norm);
            raw.column_mut(k).unscale_mut(norm);
        }
        if rows.count() < kept.len() + FEWEST_ROWS {
            return None;
        }
        let geometry = kept.len();
        let families = Families::of(&model.robot, &rows.inputs);
        let folds = Folds::over_cells(&rows, model);
        raw = raw.insert_column(geometry, 0.0);
        raw.column_mut(geometry).copy_from(&residual);
        white = white.insert_column(geometry, 0.0);
        white.column_mut(geometry).copy_from(&y);
        let mut design = Self {
            total: Products::of(&white, geometry, &[]),
            parts: Vec::new(),
            orders: 0,
            noise: noise.clone(),
            model: model.clone(),
            rows,
            folds,
            families,
            directions,
            raw,
            white,
            geometry,
        };
        design.append(0);
        Some(design)
    }

    /// Takes in the columns of the families from number `first` on.
    fn append(&mut self, first: usize) {
        let inputs = &self.rows.inputs;
        let robot = &self.model.robot;
        let more = self.families.shown(robot, inputs, &self.directions, first);
        let white = self.noise.whitened(&self.rows, &more);
        let (last, width) = (self.raw.ncols() - 1, more.ncols());
        let m = self.rows.len();
        for (all, own) in [(&mut self.raw, &more), (&mut self.white, &white)] {
            let wider = std::mem::take(all).insert_columns(last, width, 0.0);
            *all = wider;
            all.view_mut((0, last), (m, width)).copy_from(own);
        }
        let n = self.folds.samples().max(1);
        self.parts = (0..self.folds.count())
            .map(|fold| {
                let rows: Vec<usize> = (0..m)
                    .filter(|row| self.folds.of(row % n) == fold)
                    .collect();
                Products::of(&self.white, self.geometry, &rows)
            })
            .collect();
        let known: Vec<usize> = (m..self.white.nrows()).collect();
        let known = Products::of(&self.white, self.geometry, &known);
        // What was measured counts: an observation may have fewer rows than others.
        self.total = self
            .parts
            .iter()
            .fold(known, |sum, part| sum.and(part, 1.0));
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
                .chain([self.raw.ncols() - 1])
                .collect()
        };
        let places = all(self.geometry);
        self.raw = self.raw.select_columns(&places);
        self.white = self.white.select_columns(&places);
        for part in &mut self.parts {
            *part = part.only(&columns);
        }
        self.total = self.total.only(&columns);
        Some((
            strengths.into_iter().filter(|s| *s > 0.0).collect(),
            likelier,
        ))
    }

    /// Coefficients of the geometry and of the families on some products, in the order of the columns.
    fn solved(&self, products: &Products, strengths: &[f64]) -> Option<DVector<f64>> {
        let family = self.family_of();
        let coefficients = if family.is_empty() {
            DVector::zeros(0)
        } else {
            let remaining = Remaining::of(products)?;
            remaining.coefficients(&family, strengths)?
        };
        let geometry = products.geometry(&coefficients)?;
        let both = geometry.iter().chain(coefficients.iter());
        Some(DVector::from_iterator(
            geometry.len() + coefficients.len(),
            both.copied(),
        ))
    }

    /// The joint and the order that what is left shows beyond all noise, if any.
    pub(super) fn next_order(&self, strengths: &[f64]) -> Option<(usize, f64)> {
        if self.orders >= MOST_ORDERS || self.noise.slow.is_some() {
            return None;
        }
        let solved = self.solved(&self.total, strengths)?;
        let (m, last) = (self.rows.len(), self.white.ncols() - 1);
        let left = self.white.column(last) - self.white.columns(0, last) * solved;
        let left = left.rows(0, m).into_owned();
        let variance = left.norm_squared() / (self.rows.count().max(1) as f64);
        let joints = self.model.robot.joints.len();
        let motions: Vec<usize> = (0..joints).map(|j| j * DIRECTIONS).collect();
        let units = self.directions.select_columns(&motions);
        let residual = Residual {
            robot: &self.model.robot,
            q: &self.rows.inputs.q,
            units: &self.noise.whitened(&self.rows, &units),
            left: &left,
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

    /// What the families bring on cells that the fit has not seen; the strengths are set again without
    /// them.
    pub(super) fn gains(&self, strengths: &[f64]) -> Option<Gains> {
        let n = self.folds.samples().max(1);
        let last = self.raw.ncols() - 1;
        let family = self.family_of();
        let mut squares = vec![[0.0; 2]; n];
        for (fold, part) in self.parts.iter().enumerate() {
            let seen = self.total.and(part, -1.0);
            let own = Remaining::of(&seen)?.refined(&family, strengths.to_vec(), NEARLY)?;
            let with = self.solved(&seen, &own)?;
            let alone = seen.geometry(&DVector::zeros(family.len()))?;
            for row in (0..self.rows.len()).filter(|row| self.folds.of(row % n) == fold) {
                let y = self.raw[(row, last)];
                let line = self.raw.row(row);
                let mm = self.rows.mm(row);
                let before = y - line.columns(0, self.geometry).tr_dot(&alone);
                let after = y - line.columns(0, last).tr_dot(&with);
                squares[row % n][0] += (mm * before).powi(2);
                squares[row % n][1] += (mm * after).powi(2);
            }
        }
        let count = self.rows.lengths().max(1) as f64;
        let rms = |k: usize| (squares.iter().map(|s| s[k]).sum::<f64>() / count).sqrt();
        let gains: Vec<f64> = squares.iter().map(|s| s[0] - s[1]).collect();
        let mean = gains.iter().sum::<f64>() / n as f64;
        let spread = gains.iter().map(|g| (g - mean).powi(2)).sum::<f64>();
        let sigma = (spread / (n * n) as f64).sqrt().max(f64::MIN_POSITIVE);
        Some(Gains {
            before_mm: rms(0),
            after_mm: rms(1),
            sigmas: mean / sigma,
        })
    }

    /// The terms of a model with these strengths, and what they follow.
    pub(super) fn terms(&self, strengths: &[f64]) -> Option<(Vec<Term>, Vec<Text>)> {
        let solved = self.solved(&self.total, strengths)?;
        let joints = self.model.robot.joints.len();
        let own = &solved.as_slice()[self.geometry..];
        let all = self.families.all.iter().zip(strengths);
        let over = all.filter(|(_, s)| **s > 0.0).map(|(f, _)| f.in_words());
        Some((self.families.terms(own, joints), over.collect()))
    }
}
