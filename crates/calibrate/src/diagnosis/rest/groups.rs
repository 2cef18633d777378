//! The evidence of groups of columns without a name in addition to a base, their coefficients, and the variance of
//! each group, by restricted likelihood.
//!
//! ```text
//! y = J β + B c + e,   e ~ N(0, σ²),   c_k ~ N(0, σ² v_f)
//! ln E = −½ ln|I + V^½ S V^½| − (ν/2) ln(yᵀP y − gᵀc),   S = BᵀP B,   g = BᵀP y,   P = 1 − J J⁺,   ν = rows − rank J
//! ```
//!
//! A group may be columns themselves (a family of an arm) or combinations of them (a curve of a kernel through its
//! knots, [`Remaining::through`]). The strengths v are fixed points of `v_f = |c_f|²/(σ² γ_f)`, `γ_f` the number of a
//! group's columns that the samples determine (`MacKay` 1992; Harville 1977). A group whose strength falls to zero is
//! dropped, and so is one without which the samples are nearly as likely. (Restricted likelihood: Wahba 1985, Wood
//! 2011.)

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::products::Products;
use crate::fit::noise::PRICE_OF_A_VARIANCE;
use crate::linear::{cross, gram, inverse_of_lower};
use crate::{budget, rounding};

/// A group that determines less than this many columns counts as zero.
const NOTHING: f64 = 0.05;

/// The normal equations projected orthogonal to the base.
#[derive(Debug, Clone)]
pub(super) struct Remaining {
    s: DMatrix<f64>,
    g: DVector<f64>,
    yy: f64,
    freedom: f64,
    /// `BᵀJ`: what the columns have in common with the base.
    pub(super) common: DMatrix<f64>,
}

/// The solution for groups of given strengths.
pub(super) struct Solved {
    /// `I + V^½ S V^½ = R Rᵀ`.
    factor: Cholesky<f64, Dyn>,
    /// Coefficients in units of their standard deviations, and these.
    unit: DVector<f64>,
    root: Vec<f64>,
    /// Residual sum of squares.
    rss: f64,
    freedom: f64,
}

impl Solved {
    pub(super) fn coefficients(&self) -> DVector<f64> {
        DVector::from_fn(self.root.len(), |k, _| self.root[k] * self.unit[k])
    }

    /// `σ R⁻¹`, whose products are the covariance of the coefficients in units of their standard deviations.
    pub(super) fn deviations(&self) -> DMatrix<f64> {
        inverse_of_lower(self.factor.l_dirty()) * (self.rss / self.freedom).sqrt()
    }

    pub(super) fn ln_evidence(&self) -> f64 {
        -0.5 * ln_determinant(&self.factor) - 0.5 * self.freedom * self.rss.ln()
    }

    /// Evidence without some of the columns, which lie side by side: the others' block of the inverse is that
    /// of the whole less what these take (Schur). `inverse`: R⁻¹.
    fn ln_evidence_without(
        &self,
        inverse: &DMatrix<f64>,
        first: usize,
        count: usize,
    ) -> Option<f64> {
        let own = inverse.columns(first, count).into_owned();
        let factor = gram(&own).cholesky()?;
        let unit = self.unit.rows(first, count);
        let rss = self.rss + unit.dot(&factor.solve(&unit));
        let ln_determinant = ln_determinant(&self.factor) + ln_determinant(&factor);
        Some(-0.5 * ln_determinant - 0.5 * self.freedom * rss.ln())
    }

    /// The strength of the group with these columns that fits its coefficients; zero where the samples determine none
    /// of them.
    fn next_strength(&self, inverse: &DMatrix<f64>, first: usize, count: usize) -> f64 {
        let columns = first..first + count;
        let known = |k: usize| 1.0 - inverse.column(k).norm_squared();
        let determined: f64 = columns.clone().map(known).sum();
        if determined < NOTHING {
            return 0.0;
        }
        let square = |k: usize| (self.root[k] * self.unit[k]).powi(2);
        let squares: f64 = columns.map(square).sum();
        squares / (self.rss / self.freedom * determined)
    }
}

fn ln_determinant(factor: &Cholesky<f64, Dyn>) -> f64 {
    let l = factor.l_dirty();
    (0..l.nrows()).map(|k| 2.0 * l[(k, k)].ln()).sum()
}

/// Of each group that has columns: its number, its first column and how many it has.
fn groups(group: &[usize]) -> Vec<(usize, usize, usize)> {
    let mut all: Vec<(usize, usize, usize)> = Vec::new();
    for (k, f) in group.iter().enumerate() {
        match all.last_mut() {
            Some((last, _, count)) if last == f => *count += 1,
            _ => all.push((*f, k, 1)),
        }
    }
    all
}

impl Remaining {
    pub(super) fn of(products: &Products) -> Option<Self> {
        let (s, g, yy) = products.without_base()?;
        Some(Self {
            s,
            g,
            yy: yy.max(f64::MIN_POSITIVE),
            freedom: (products.rows - products.rank() as f64).max(1.0),
            common: products.common(),
        })
    }

    /// Number of columns.
    pub(super) fn columns(&self) -> usize {
        self.g.len()
    }

    /// Of some columns.
    pub(super) fn only(&self, columns: &[usize]) -> Self {
        Self {
            s: self.s.select_rows(columns).select_columns(columns),
            g: self.g.select_rows(columns),
            common: self.common.select_rows(columns),
            ..*self
        }
    }

    /// Of combinations of the columns.
    pub(super) fn through(&self, combinations: &DMatrix<f64>) -> Self {
        Self {
            s: cross(combinations, &(&self.s * combinations)),
            g: combinations.tr_mul(&self.g),
            common: DMatrix::zeros(combinations.ncols(), 0),
            ..*self
        }
    }

    /// The same after columns with these coefficients were fitted.
    pub(super) fn without(&self, coefficients: &DVector<f64>) -> Self {
        let taken = &self.s * coefficients;
        let rss = self.yy - 2.0 * coefficients.dot(&self.g) + coefficients.dot(&taken);
        Self {
            g: &self.g - taken,
            yy: rss.max(f64::MIN_POSITIVE),
            ..self.clone()
        }
    }

    /// `group` is that of each column.
    pub(super) fn solved(&self, group: &[usize], strengths: &[f64]) -> Option<Solved> {
        let n = group.len();
        let root: Vec<f64> = group.iter().map(|f| strengths[*f].sqrt()).collect();
        let m = DMatrix::from_fn(n, n, |a, b| {
            root[a] * self.s[(a, b)] * root[b] + if a == b { 1.0 } else { 0.0 }
        });
        let scaled = DVector::from_fn(n, |k, _| root[k] * self.g[k]);
        let factor = m.cholesky()?;
        let unit = factor.solve(&scaled);
        let rss = self.yy - scaled.dot(&unit);
        (rss > 0.0).then_some(Solved {
            factor,
            unit,
            root,
            rss,
            freedom: self.freedom,
        })
    }

    /// Evidence of no group at all.
    pub(super) fn alone(&self) -> f64 {
        -0.5 * self.freedom * self.yy.ln()
    }

    /// Strengths at which each group would move the samples by about their noise.
    fn first(&self, group: &[usize], count: usize) -> Vec<f64> {
        let mut sizes = vec![(0.0, 0.0); count];
        for (k, f) in group.iter().enumerate() {
            sizes[*f].0 += self.s[(k, k)];
            sizes[*f].1 += 1.0;
        }
        let rows = self.freedom.max(1.0);
        let strength = |(sum, columns): &(f64, f64)| {
            if *sum > rounding::COMPUTED * rows {
                columns * rows / (10.0 * sum * count as f64)
            } else {
                0.0
            }
        };
        sizes.iter().map(strength).collect()
    }

    /// The groups that have a strength: the group of each of their columns, and what they are.
    fn of_strengths(&self, group: &[usize], strengths: &[f64]) -> Option<(Vec<usize>, Solved)> {
        let has = |k: &usize| strengths[group[*k]] > 0.0;
        let columns: Vec<usize> = (0..group.len()).filter(has).collect();
        let own: Vec<usize> = columns.iter().map(|k| group[*k]).collect();
        let solved = self.only(&columns).solved(&own, strengths)?;
        Some((own, solved))
    }

    /// Better strengths, in so many rounds.
    pub(super) fn refined(
        &self,
        group: &[usize],
        mut strengths: Vec<f64>,
        rounds: usize,
    ) -> Option<Vec<f64>> {
        for _ in 0..rounds {
            let (own, solved) = self.of_strengths(group, &strengths)?;
            let inverse = inverse_of_lower(solved.factor.l_dirty());
            let mut moved = 0.0_f64;
            for (f, first, count) in groups(&own) {
                let next = solved.next_strength(&inverse, first, count);
                moved = moved.max((next / strengths[f]).max(f64::MIN_POSITIVE).ln().abs());
                strengths[f] = next;
            }
            if moved < budget::SETTLED {
                break;
            }
        }
        Some(strengths)
    }

    /// The strengths of the groups whose gain exceeds their penalty; the others have none. Also how much likelier the
    /// samples are with them, as a logarithm.
    pub(super) fn strengths(&self, group: &[usize], count: usize) -> Option<(Vec<f64>, f64)> {
        let first = self.first(group, count);
        let needed = PRICE_OF_A_VARIANCE + (count.max(1) as f64).ln();
        let mut strengths = self.refined(group, first, budget::STEPS)?;
        loop {
            let (own, solved) = self.of_strengths(group, &strengths)?;
            let here = solved.ln_evidence();
            let inverse = inverse_of_lower(solved.factor.l_dirty());
            let mut least: Option<(usize, f64)> = None;
            for (f, first, count) in groups(&own) {
                let worth = here - solved.ln_evidence_without(&inverse, first, count)?;
                if least.is_none_or(|l| worth < l.1) {
                    least = Some((f, worth));
                }
            }
            match least {
                Some((f, worth)) if worth < needed => {
                    strengths[f] = 0.0;
                    strengths = self.refined(group, strengths, budget::ROUNDS)?;
                }
                _ => return Some((strengths, here - self.alone())),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Products of made-up columns of three groups with a residual.
    fn remaining() -> (Remaining, Vec<usize>) {
        let group = vec![0, 0, 1, 2, 2, 2];
        let x = DMatrix::from_fn(40, 6, |i, k| ((i * (k + 2)) as f64 * 0.37 + k as f64).sin());
        let y = DVector::from_fn(40, |i, _| {
            x[(i, 0)] - 0.4 * x[(i, 4)] + (i as f64 * 1.7).sin()
        });
        let all = x.insert_column(6, 0.0);
        let mut all = all;
        all.set_column(6, &y);
        let rows: Vec<usize> = (0..40).collect();
        let remaining = Remaining::of(&Products::of(&all, 0, &rows, 0.0)).unwrap();
        (remaining, group)
    }

    #[test]
    fn the_evidence_without_a_group_is_that_of_the_others_alone() {
        let (remaining, group) = remaining();
        let strengths = [0.3, 0.05, 0.7];
        let all = remaining.solved(&group, &strengths).unwrap();
        let inverse = inverse_of_lower(all.factor.l_dirty());
        for (f, first, count) in groups(&group) {
            let mut without = strengths;
            without[f] = 0.0;
            let alone = remaining.solved(&group, &without).unwrap().ln_evidence();
            let by_update = all.ln_evidence_without(&inverse, first, count).unwrap();
            assert!((alone - by_update).abs() < 1e-9, "{f}: {alone} {by_update}");
        }
    }
}
