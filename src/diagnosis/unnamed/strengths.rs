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

use nalgebra::{DMatrix, DVector};

use super::products::Products;

/// Strengths are refined so often from the beginning …
const ROUNDS: usize = 40;
/// … and where they are nearly right.
pub(super) const NEARLY: usize = 6;
/// A family that determines less than this many columns is nothing.
const NOTHING: f64 = 0.05;
/// A family has to make the samples so much likelier, as a logarithm: twenty times.
const WORTH: f64 = 3.0;

/// What is left once the geometry has taken its part.
pub(super) struct Remaining {
    s: DMatrix<f64>,
    g: DVector<f64>,
    yy: f64,
    freedom: f64,
}

/// Coefficients under given strengths.
pub(super) struct Solved {
    pub(super) coefficients: DVector<f64>,
    /// Noise of a row, squared.
    variance: f64,
    /// Columns that the samples determine, by family.
    determined: Vec<f64>,
    squares: Vec<f64>,
    pub(super) ln_evidence: f64,
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
    pub(super) fn solved(&self, family: &[usize], strengths: &[f64]) -> Option<Solved> {
        let n = family.len();
        let root: Vec<f64> = family.iter().map(|f| strengths[*f].sqrt()).collect();
        let m = DMatrix::from_fn(n, n, |a, b| {
            root[a] * self.s[(a, b)] * root[b] + if a == b { 1.0 } else { 0.0 }
        });
        let factor = m.cholesky()?;
        let scaled = DVector::from_fn(n, |k, _| root[k] * self.g[k]);
        let unit = factor.solve(&scaled);
        let left = self.yy - scaled.dot(&unit);
        if left.is_nan() || left <= 0.0 {
            return None;
        }
        let l = factor.l_dirty();
        let ln_determinant: f64 = (0..n).map(|k| 2.0 * l[(k, k)].ln()).sum();
        let inverse = factor.inverse();
        let mut determined = vec![0.0; strengths.len()];
        let mut squares = vec![0.0; strengths.len()];
        for (k, f) in family.iter().enumerate() {
            determined[*f] += 1.0 - inverse[(k, k)];
            squares[*f] += strengths[*f] * unit[k] * unit[k];
        }
        Some(Solved {
            coefficients: DVector::from_fn(n, |k, _| root[k] * unit[k]),
            variance: left / self.freedom,
            determined,
            squares,
            ln_evidence: -0.5 * ln_determinant - 0.5 * self.freedom * left.ln(),
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
            for (f, strength) in strengths.iter_mut().enumerate().filter(|s| *s.1 > 0.0) {
                let determined = solved.determined[f];
                let next = if determined < NOTHING {
                    0.0
                } else {
                    solved.squares[f] / (solved.variance * determined)
                };
                moved = moved.max((next / *strength).max(1e-12).ln().abs());
                *strength = next;
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
        let mut strengths = self.refined(family, first, ROUNDS)?;
        loop {
            let evidence = |strengths: &[f64]| -> Option<f64> {
                let columns: Vec<usize> = (0..family.len())
                    .filter(|k| strengths[family[*k]] > 0.0)
                    .collect();
                if columns.is_empty() {
                    return Some(self.alone());
                }
                let own: Vec<usize> = columns.iter().map(|k| family[*k]).collect();
                Some(self.only(&columns).solved(&own, strengths)?.ln_evidence)
            };
            let here = evidence(&strengths)?;
            let mut least: Option<(usize, f64)> = None;
            for f in (0..count).filter(|f| strengths[*f] > 0.0) {
                let mut without = strengths.clone();
                without[f] = 0.0;
                let worth = here - evidence(&without)?;
                if least.is_none_or(|l| worth < l.1) {
                    least = Some((f, worth));
                }
            }
            match least {
                Some((f, worth)) if worth < WORTH => {
                    strengths[f] = 0.0;
                    strengths = self.refined(family, strengths, NEARLY)?;
                }
                _ => return Some((strengths, here - self.alone())),
            }
        }
    }
}
