//! The columns of the geometry and of the families on the samples, and their products, fold by fold.

use crate::diagnosis::evidence::Folds;
use crate::effects::curve::DIRECTIONS;
use crate::effects::{EACH_DIRECTION, Term};
use crate::fit::base_model;
use crate::fit::noise::Noise;
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::model::Model;
use crate::sessions::poses::ByPose;
use crate::side_by_side::Threads;
use crate::text::Text;
use nalgebra::{DMatrix, DVector};

use super::families::Families;
use super::orders::{self, Residual};
use super::products::Products;
use super::strengths::{NEARLY, Remaining};

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
    /// The geometry's columns, then the families', then the residual: whitened with the rows of the priors below, and
    /// as they are where that is more than their unit.
    raw: Option<DMatrix<f64>>,
    white: DMatrix<f64>,
    geometry: usize,
    /// By fold.
    parts: Vec<Products>,
    /// Of what is known beforehand.
    products: Option<Products>,
    total: Products,
    threads: Threads,
}

/// Every fold by the others: what does not depend on how strong the families are.
pub(super) struct HeldOutFolds<'d, 'a> {
    design: &'d Design<'a>,
    folds: Vec<Fold>,
}

struct Fold {
    /// Products of the other folds' rows.
    seen: Products,
    remaining: Remaining,
    /// Squares of what the geometry alone leaves of each sample, mm², summed over its rows.
    alone: Vec<f64>,
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
    pub(super) fn new(
        problem: &Problem<'a>,
        noise: &Noise,
        model: &Model,
        threads: Threads,
    ) -> Option<Self> {
        let problem = problem.thinned(MOST_SAMPLES);
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
        let (left, columns) = rows.prior_rows(model, &problem.priors);
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
        if rows.count() < kept.len() + FEWEST_ROWS {
            return None;
        }
        let geometry = kept.len();
        let families = Families::of(&model.robot, &rows.inputs);
        let folds = Folds::over_cells(&rows, model);
        raw = raw.map(|raw| {
            let mut raw = raw.insert_column(geometry, 0.0);
            raw.column_mut(geometry).copy_from(&residual);
            raw
        });
        white = white.insert_column(geometry, 0.0);
        white.column_mut(geometry).copy_from(&y);
        let mut design = Self {
            total: Products::of(&white, geometry, &[]),
            parts: Vec::new(),
            products: None,
            threads,
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
        let mut more = self.families.shown(robot, inputs, &self.directions, first);
        let (last, width) = (self.white.ncols() - 1, more.ncols());
        let m = self.rows.len();
        let put = |all: &mut DMatrix<f64>, own: &DMatrix<f64>| {
            let wider = std::mem::take(all).insert_columns(last, width, 0.0);
            *all = wider;
            all.view_mut((0, last), (m, width)).copy_from(own);
        };
        if let Some(raw) = &mut self.raw {
            put(raw, &more);
        }
        self.noise.filter(&self.rows).whiten(more.as_mut_slice());
        put(&mut self.white, &more);
        drop(more);
        let known: Vec<usize> = (m..self.white.nrows()).collect();
        let geometry = self.geometry;
        let of = |rows: &[usize], before: Option<&Products>| match before {
            Some(products) => products.with(&self.white, width, rows),
            None => Products::of(&self.white, geometry, rows),
        };
        let parts: Vec<Products> = self.threads.each(self.folds.count(), |fold| {
            let rows: Vec<usize> = self.rows_of(fold).collect();
            of(&rows, self.parts.get(fold))
        });
        let known = of(&known, self.products.as_ref());
        // What was measured counts: an observation may have fewer rows than others.
        self.total = parts
            .iter()
            .fold(known.clone(), |sum, part| sum.and(part, 1.0));
        self.parts = parts;
        self.products = Some(known);
    }

    /// Rows of the samples that are in a fold.
    fn rows_of(&self, fold: usize) -> impl Iterator<Item = usize> {
        let n = self.folds.samples().max(1);
        (0..self.rows.len()).filter(move |row| self.folds.of(row % n) == fold)
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
                .chain([self.white.ncols() - 1])
                .collect()
        };
        let places = all(self.geometry);
        self.raw = self.raw.take().map(|raw| raw.select_columns(&places));
        self.white = self.white.select_columns(&places);
        for part in self.parts.iter_mut().chain(&mut self.products) {
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
        self.solved_of(products, &Remaining::of(products)?, strengths)
    }

    /// The same of what remains of the products without the geometry.
    fn solved_of(
        &self,
        products: &Products,
        remaining: &Remaining,
        strengths: &[f64],
    ) -> Option<DVector<f64>> {
        let family = self.family_of();
        let coefficients = if family.is_empty() {
            DVector::zeros(0)
        } else {
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
        if self.orders >= MOST_ORDERS || !self.noise.is_white() {
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

    /// What a model leaves of the rows of a fold, mm², added up for each sample.
    fn squares(&self, fold: usize, coefficients: &[f64]) -> Vec<f64> {
        let n = self.folds.samples().max(1);
        let all = self.raw.as_ref().unwrap_or(&self.white);
        let mut left = all.column(all.ncols() - 1).into_owned();
        let coefficients = DVector::from_column_slice(coefficients);
        left.gemv(
            -1.0,
            &all.columns(0, coefficients.len()),
            &coefficients,
            1.0,
        );
        // Of rows that are independent a whitened one is one in units of its axis's noise.
        let unit = |row: usize| match self.raw {
            Some(_) => 1.0,
            None => self.noise.sigma_mm[self.rows.axes[row / n]],
        };
        let mut squares = vec![0.0; n];
        for row in self.rows_of(fold) {
            squares[row % n] += (self.rows.mm(row) * unit(row) * left[row]).powi(2);
        }
        squares
    }

    /// Every fold by the others, for [`HeldOutFolds::gains`].
    pub(super) fn unseen(&self) -> Option<HeldOutFolds<'_, 'a>> {
        let none = DVector::zeros(self.families.columns.len());
        let of = |fold: usize| {
            let seen = self.total.and(&self.parts[fold], -1.0);
            let alone = seen.geometry(&none)?;
            Some(Fold {
                alone: self.squares(fold, alone.as_slice()),
                remaining: Remaining::of(&seen)?,
                seen,
            })
        };
        Some(HeldOutFolds {
            design: self,
            folds: self.threads.all(self.parts.len(), of)?,
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

impl HeldOutFolds<'_, '_> {
    /// What the families bring on cells that the fit has not seen; the strengths are set again without
    /// them.
    pub(super) fn gains(&self, strengths: &[f64]) -> Option<Gains> {
        let design = self.design;
        let n = design.folds.samples().max(1);
        let family = design.family_of();
        let with = |fold: usize| {
            let Fold {
                seen, remaining, ..
            } = &self.folds[fold];
            let refined = remaining.refined(&family, strengths.to_vec(), NEARLY)?;
            let with = design.solved_of(seen, remaining, &refined)?;
            Some(design.squares(fold, with.as_slice()))
        };
        let mut squares = vec![[0.0; 2]; n];
        let with = design.threads.all(self.folds.len(), with)?;
        for (own, with) in self.folds.iter().zip(with) {
            for (sum, (before, after)) in squares.iter_mut().zip(own.alone.iter().zip(with)) {
                sum[0] += before;
                sum[1] += after;
            }
        }
        let count = design.rows.lengths().max(1) as f64;
        let rms = |k: usize| (squares.iter().map(|s| s[k]).sum::<f64>() / count).sqrt();
        // The rows of a pose share what the robot did not repeat: a pose is one witness.
        let poses = ByPose::of(design.rows.inputs.pose.as_deref(), n).samples();
        let gained = |i: &usize| squares[*i][0] - squares[*i][1];
        let of_pose = |own: &Vec<usize>| own.iter().map(gained).sum();
        let gains: Vec<f64> = poses.iter().map(of_pose).collect();
        let n = gains.len();
        let mean = gains.iter().sum::<f64>() / n as f64;
        let spread = gains.iter().map(|g| (g - mean).powi(2)).sum::<f64>();
        let sigma = (spread / (n * n) as f64).sqrt().max(f64::MIN_POSITIVE);
        Some(Gains {
            before_mm: rms(0),
            after_mm: rms(1),
            sigmas: mean / sigma,
        })
    }
}

/// Below this number of rows beyond what the geometry takes nothing is said.
const FEWEST_ROWS: usize = 60;
