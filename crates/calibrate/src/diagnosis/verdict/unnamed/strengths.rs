//! How strong each family is: restricted likelihood.
//!
//! ```text
//! y = J β + B c + e,   e ~ N(0, σ²),   c_k ~ N(0, σ² v_f)
//! ln E = −½ ln|I + V^½ S V^½| − (ν/2) ln(yᵀP y − gᵀc),   S = BᵀP B,   g = BᵀP y,   P = 1 − J J⁺
//! ```
//!
//! The strengths v are fixed points of `v_f = |c_f|²/(σ² γ_f)`, `γ_f` the number of a family's columns that
//! the samples determine (`MacKay` 1992; Harville 1977). A family whose strength falls to nothing is left
//! out, and one without which the samples are nearly as likely as well.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::products::Products;
use crate::linear::{gram, inverse_of_lower};

/// Strengths are refined so often from the beginning …
const ROUNDS: usize = 40;
/// … and where they are nearly right.
pub(super) const NEARLY: usize = 6;
/// A family that determines less than this many columns is nothing.
const NOTHING: f64 = 0.05;
/// A family has to make the samples so much likelier, as a logarithm, beyond the number of families that there are: a
/// variance on the boundary of its range (half of χ² with one degree of freedom), so that of a hundred families noise
/// has one in one session of 25.
const WORTH: f64 = 1.0;

/// A factor of `I + V^½ S V^½`, `V^½ g`, and `V^½`.
type Factor = (Cholesky<f64, Dyn>, DVector<f64>, Vec<f64>);

/// What is left once the geometry has taken its part.
pub(super) struct Remaining {
    s: DMatrix<f64>,
    g: DVector<f64>,
    yy: f64,
    freedom: f64,
}

/// What the families are under given strengths.
struct Solved {
    /// `R⁻¹` of `I + V^½ S V^½ = R Rᵀ`.
    inverse: DMatrix<f64>,
    /// Coefficients in units of their standard deviations, and these.
    unit: DVector<f64>,
    root: Vec<f64>,
    /// Sum of squares that is left, and logarithm of the determinant.
    left: f64,
    ln_determinant: f64,
    freedom: f64,
}

impl Solved {
    fn ln_evidence(&self) -> f64 {
        -0.5 * self.ln_determinant - 0.5 * self.freedom * self.left.ln()
    }

    /// Evidence without some of the columns, which lie side by side: the others' block of the inverse is that
    /// of the whole less what these take (Schur).
    fn ln_evidence_without(&self, first: usize, count: usize) -> Option<f64> {
        let own = self.inverse.columns(first, count).into_owned();
        let factor = gram(&own).cholesky()?;
        let unit = self.unit.rows(first, count);
        let left = self.left + unit.dot(&factor.solve(&unit));
        let l = factor.l_dirty();
        let ln: f64 = (0..count).map(|k| 2.0 * l[(k, k)].ln()).sum();
        Some(-0.5 * (self.ln_determinant + ln) - 0.5 * self.freedom * left.ln())
    }

    /// The strength of the family whose columns these are that fits its coefficients; nothing where the samples
    /// determine none of them.
    fn next_strength(&self, first: usize, count: usize) -> f64 {
        let columns = first..first + count;
        let known = |k: usize| 1.0 - self.inverse.column(k).norm_squared();
        let determined: f64 = columns.clone().map(known).sum();
        if determined < NOTHING {
            return 0.0;
        }
        let square = |k: usize| (self.root[k] * self.unit[k]).powi(2);
        let squares: f64 = columns.map(square).sum();
        squares / (self.left / self.freedom * determined)
    }
}

/// Of each family that has columns: its number, its first column and how many it has.
fn families(family: &[usize]) -> Vec<(usize, usize, usize)> {
    let mut all: Vec<(usize, usize, usize)> = Vec::new();
    for (k, f) in family.iter().enumerate() {
        match all.last_mut() {
            Some((last, _, count)) if last == f => *count += 1,
            _ => all.push((*f, k, 1)),
        }
    }
    all
}

impl Remaining {
    pub(super) fn of(products: &Products) -> Option<Self> {
        let (s, g, yy) = products.without_geometry()?;
        Some(Self {
            s,
            g,
            yy,
            freedom: (products.rows - products.rank() as f64).max(1.0),
        })
    }

    /// Of some columns.
    fn only(&self, columns: &[usize]) -> Self {
        Self {
            s: self.s.select_rows(columns).select_columns(columns),
            g: self.g.select_rows(columns),
            yy: self.yy,
            freedom: self.freedom,
        }
    }

    /// `family` is that of each column.
    pub(super) fn coefficients(&self, family: &[usize], strengths: &[f64]) -> Option<DVector<f64>> {
        let (factor, scaled, root) = self.factor(family, strengths)?;
        let unit = factor.solve(&scaled);
        Some(DVector::from_fn(root.len(), |k, _| root[k] * unit[k]))
    }

    fn factor(&self, family: &[usize], strengths: &[f64]) -> Option<Factor> {
        let n = family.len();
        let root: Vec<f64> = family.iter().map(|f| strengths[*f].sqrt()).collect();
        let m = DMatrix::from_fn(n, n, |a, b| {
            root[a] * self.s[(a, b)] * root[b] + if a == b { 1.0 } else { 0.0 }
        });
        let scaled = DVector::from_fn(n, |k, _| root[k] * self.g[k]);
        Some((m.cholesky()?, scaled, root))
    }

    fn solved(&self, family: &[usize], strengths: &[f64]) -> Option<Solved> {
        let (factor, scaled, root) = self.factor(family, strengths)?;
        let unit = factor.solve(&scaled);
        let left = self.yy - scaled.dot(&unit);
        if left.is_nan() || left <= 0.0 {
            return None;
        }
        let l = factor.l_dirty();
        Some(Solved {
            ln_determinant: (0..root.len()).map(|k| 2.0 * l[(k, k)].ln()).sum(),
            inverse: inverse_of_lower(l),
            unit,
            root,
            left,
            freedom: self.freedom,
        })
    }

    /// Evidence of no family at all.
    fn alone(&self) -> f64 {
        -0.5 * self.freedom * self.yy.max(f64::MIN_POSITIVE).ln()
    }

    /// Strengths at which each family would move the samples by about their noise.
    fn first(&self, family: &[usize], count: usize) -> Vec<f64> {
        let mut sizes = vec![(0.0, 0.0); count];
        for (k, f) in family.iter().enumerate() {
            sizes[*f].0 += self.s[(k, k)];
            sizes[*f].1 += 1.0;
        }
        let rows = self.freedom.max(1.0);
        let strength = |(sum, columns): &(f64, f64)| {
            if *sum > 1e-9 * rows {
                columns * rows / (10.0 * sum * count as f64)
            } else {
                0.0
            }
        };
        sizes.iter().map(strength).collect()
    }

    /// Better strengths, in so many rounds.
    pub(super) fn refined(
        &self,
        family: &[usize],
        mut strengths: Vec<f64>,
        rounds: usize,
    ) -> Option<Vec<f64>> {
        for _ in 0..rounds {
            let columns: Vec<usize> = (0..family.len())
                .filter(|k| strengths[family[*k]] > 0.0)
                .collect();
            if columns.is_empty() {
                break;
            }
            let own: Vec<usize> = columns.iter().map(|k| family[*k]).collect();
            let solved = self.only(&columns).solved(&own, &strengths)?;
            let mut moved = 0.0_f64;
            for (f, first, count) in families(&own) {
                let next = solved.next_strength(first, count);
                moved = moved.max((next / strengths[f]).max(1e-12).ln().abs());
                strengths[f] = next;
            }
            if moved < 0.05 {
                break;
            }
        }
        Some(strengths)
    }

    /// The strengths of the families that are worth it; the others have none. Also how much likelier
    /// the samples are with them, as a logarithm.
    pub(super) fn strengths(&self, family: &[usize], count: usize) -> Option<(Vec<f64>, f64)> {
        let first = self.first(family, count);
        let needed = WORTH + (count.max(1) as f64).ln();
        let mut strengths = self.refined(family, first, ROUNDS)?;
        loop {
            let columns: Vec<usize> = (0..family.len())
                .filter(|k| strengths[family[*k]] > 0.0)
                .collect();
            if columns.is_empty() {
                return Some((strengths, 0.0));
            }
            let own: Vec<usize> = columns.iter().map(|k| family[*k]).collect();
            let solved = self.only(&columns).solved(&own, &strengths)?;
            let here = solved.ln_evidence();
            let mut least: Option<(usize, f64)> = None;
            for (f, first, count) in families(&own) {
                let worth = here - solved.ln_evidence_without(first, count)?;
                if least.is_none_or(|l| worth < l.1) {
                    least = Some((f, worth));
                }
            }
            match least {
                Some((f, worth)) if worth < needed => {
                    strengths[f] = 0.0;
                    strengths = self.refined(family, strengths, NEARLY)?;
                }
                _ => return Some((strengths, here - self.alone())),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Products of made-up columns of three families with a residual.
    fn remaining() -> (Remaining, Vec<usize>) {
        let family = vec![0, 0, 1, 2, 2, 2];
        let x = DMatrix::from_fn(40, 6, |i, k| ((i * (k + 2)) as f64 * 0.37 + k as f64).sin());
        let y = DVector::from_fn(40, |i, _| {
            x[(i, 0)] - 0.4 * x[(i, 4)] + (i as f64 * 1.7).sin()
        });
        let remaining = Remaining {
            s: x.tr_mul(&x),
            g: x.tr_mul(&y),
            yy: y.norm_squared(),
            freedom: 40.0,
        };
        (remaining, family)
    }

    #[test]
    fn the_evidence_without_a_family_is_that_of_the_others_alone() {
        let (remaining, family) = remaining();
        let strengths = [0.3, 0.05, 0.7];
        let all = remaining.solved(&family, &strengths).unwrap();
        for (f, first, count) in families(&family) {
            let mut without = strengths;
            without[f] = 0.0;
            let alone = remaining.solved(&family, &without).unwrap().ln_evidence();
            let by_update = all.ln_evidence_without(first, count).unwrap();
            assert!((alone - by_update).abs() < 1e-9, "{f}: {alone} {by_update}");
        }
    }
}
