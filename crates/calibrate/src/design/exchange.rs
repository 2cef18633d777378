//! The planner: of candidate poses those that are worth most to a criterion.
//!
//! [`choose`] takes pose after pose, each time the one that is worth most. What poses are worth is a
//! [`Criterion`]: how far they part rival models ([`super::parting`], T-optimality), or how much
//! they add to what is known of parameters ([`Information`], D-optimality):
//!
//! ```text
//! worth = ln det(1 + J C Jᵀ),   C ← C − C Jᵀ (1 + J C Jᵀ)⁻¹ J C
//! ```
//!
//! with J the columns of a pose in units of the noise and C the covariance so far. [`exchange`] then
//! gives one pose after the other back and takes the best in its place until none is better
//! (Fedorov 1972; Cook & Nachtsheim 1980). Both ways C and all J C Jᵀ change by as many ranks as a
//! pose has rows, and nothing is inverted anew.

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, DMatrixView, DVector};

use crate::linear::cross;

/// What poses are worth.
pub(crate) trait Criterion {
    /// What each candidate would be worth as the next pose; 0: nothing.
    fn worths(&self) -> Vec<f64>;

    /// Takes a candidate.
    fn take(&mut self, candidate: usize);

    /// Whether no more is wanted.
    fn satisfied(&mut self) -> bool {
        false
    }
}

/// A pose that is worth less than this is worth nothing.
const NOTHING: f64 = 1e-9;

/// Candidates one after the other until the criterion is satisfied, `most` are taken, or nothing
/// helps; of candidates that are worth the same the first.
pub(crate) fn choose(criterion: &mut impl Criterion, most: usize) -> Vec<usize> {
    let mut order = Vec::new();
    while order.len() < most && !criterion.satisfied() {
        let worths = criterion.worths();
        let Some(best) = best(&worths).filter(|k| worths[*k] > NOTHING) else {
            break;
        };
        criterion.take(best);
        order.push(best);
    }
    order
}

fn best(worths: &[f64]) -> Option<usize> {
    (0..worths.len()).max_by(|a, b| worths[*a].total_cmp(&worths[*b]).then(b.cmp(a)))
}

/// Columns of a model in the rows of all candidates, in units of the noise. They are most of what a planner
/// holds, and all that look at one model share them.
#[derive(Debug)]
pub(crate) struct CandidateRows {
    /// Parameters by rows: each row of the model stands in a column.
    rows: DMatrix<f64>,
    /// First row of each candidate, and the end.
    first: Vec<usize>,
}

impl CandidateRows {
    /// `rows` has the rows in columns; `first` says where each candidate begins, and the end.
    pub(crate) fn new(rows: DMatrix<f64>, first: Vec<usize>) -> Self {
        Self { rows, first }
    }

    /// First row of a candidate and how many it has.
    pub(crate) fn place(&self, candidate: usize) -> (usize, usize) {
        let first = self.first[candidate];
        (first, self.first[candidate + 1] - first)
    }

    /// The rows of a candidate, each in a column.
    pub(crate) fn of(&self, candidate: usize) -> DMatrixView<'_, f64> {
        let (first, size) = self.place(candidate);
        self.rows.columns(first, size)
    }

    /// How many candidates there are.
    pub(crate) fn len(&self) -> usize {
        self.first.len().saturating_sub(1)
    }

    /// Squared length of each of the model's columns over all candidates.
    pub(crate) fn squares(&self) -> Vec<f64> {
        let squares = |k: usize| {
            let of = |candidate| self.of(candidate).row(k).norm_squared();
            (0..self.len()).map(of).sum()
        };
        (0..self.rows.nrows()).map(squares).collect()
    }
}

/// Rows that are multiplied with a covariance at once.
const CARRIED_AT_ONCE: usize = 256;

/// What is known of parameters, and what each candidate would add to it. A candidate is taken once.
#[derive(Clone)]
pub(crate) struct Information {
    candidates: Arc<CandidateRows>,
    pub(crate) covariance: DMatrix<f64>,
    /// J C Jᵀ of every candidate: its rows stand where the candidate's stand.
    spread: DMatrix<f64>,
    taken: Vec<bool>,
}

impl Information {
    /// Candidates with their rows (`first` says where each begins, and the end), beside what is known.
    pub(crate) fn new(rows: &DMatrix<f64>, first: Vec<usize>, covariance: DMatrix<f64>) -> Self {
        Self::over(
            Arc::new(CandidateRows::new(rows.transpose(), first)),
            covariance,
        )
    }

    /// Candidates whose rows others look at too, beside what is known.
    pub(crate) fn over(candidates: Arc<CandidateRows>, covariance: DMatrix<f64>) -> Self {
        let places = (0..candidates.len()).map(|k| candidates.place(k).1);
        let most = places.max().unwrap_or(0);
        let mut new = Self {
            spread: DMatrix::zeros(candidates.rows.ncols(), most),
            taken: vec![false; candidates.len()],
            candidates,
            covariance,
        };
        new.refresh();
        new
    }

    /// Every J C Jᵀ from the covariance as it is now.
    fn refresh(&mut self) {
        let CandidateRows { rows, first } = &*self.candidates;
        // So many rows at a time that what the covariance makes of them needs little room.
        let mut from = 0;
        while from + 1 < first.len() {
            let more = first[from..].partition_point(|f| f - first[from] <= CARRIED_AT_ONCE);
            let to = (from + more - 1).max(from + 1);
            let start = first[from];
            let carried = &self.covariance * rows.columns(start, first[to] - start);
            for pair in first[from..=to].windows(2) {
                let size = pair[1] - pair[0];
                let own = carried
                    .columns(pair[0] - start, size)
                    .tr_mul(&rows.columns(pair[0], size));
                self.spread
                    .view_mut((pair[0], 0), (size, size))
                    .copy_from(&own);
            }
            from = to;
        }
    }

    /// First row of a candidate and how many it has.
    pub(crate) fn place(&self, candidate: usize) -> (usize, usize) {
        self.candidates.place(candidate)
    }

    /// Lower triangular root of 1 ± J C Jᵀ of a candidate.
    pub(crate) fn innovation(&self, candidate: usize, sign: f64) -> Option<DMatrix<f64>> {
        let (first, size) = self.place(candidate);
        let innovation = DMatrix::from_fn(size, size, |i, j| {
            f64::from(u8::from(i == j)) + sign * self.spread[(first + i, j)]
        });
        innovation.cholesky().map(Cholesky::unpack)
    }

    /// What a candidate would add, whether it is taken or not.
    pub(crate) fn gain(&self, candidate: usize) -> f64 {
        let root = self.innovation(candidate, 1.0);
        root.map_or(0.0, |root| {
            2.0 * root.diagonal().iter().map(|d| d.ln()).sum::<f64>()
        })
    }

    /// What each of some directions of the parameters, in rows, shows in the rows of all candidates: a
    /// column a direction. The candidates are read once.
    fn shown_by_each(&self, directions: &DMatrix<f64>) -> DMatrix<f64> {
        let all = &self.candidates.rows;
        cross(all, &directions.transpose())
    }

    /// What one direction of the parameters shows in the rows of all candidates.
    pub(crate) fn shown(&self, direction: &DVector<f64>) -> DVector<f64> {
        self.candidates.rows.tr_mul(direction)
    }

    /// Takes the rows of a candidate in (`sign` 1) or out (−1). With L the root of its innovation: L and
    /// J C Jᵤᵀ L⁻ᵀ, by which what all candidates show moves with what this one does.
    pub(crate) fn update(
        &mut self,
        candidate: usize,
        sign: f64,
    ) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let (_, size) = self.place(candidate);
        let carried = self.candidates.of(candidate).tr_mul(&self.covariance);
        let root = self.innovation(candidate, sign)?;
        let carried = root.solve_lower_triangular(&carried)?;
        self.taken[candidate] = sign > 0.0;
        self.covariance.gemm_tr(-sign, &carried, &carried, 1.0);
        let moved = self.shown_by_each(&carried);
        for pair in self.candidates.first.windows(2) {
            for i in pair[0]..pair[1] {
                for j in pair[0]..pair[1] {
                    let change: f64 = (0..size).map(|k| moved[(i, k)] * moved[(j, k)]).sum();
                    self.spread[(i, j - pair[0])] -= sign * change;
                }
            }
        }
        Some((root, moved))
    }
}

impl Criterion for Information {
    fn worths(&self) -> Vec<f64> {
        let of = |k: usize| if self.taken[k] { 0.0 } else { self.gain(k) };
        (0..self.taken.len()).map(of).collect()
    }

    fn take(&mut self, candidate: usize) {
        self.update(candidate, 1.0);
    }
}

/// An exchange has to raise the logarithm of the determinant by this.
const BETTER: f64 = 1e-4;

/// Exchanges what was taken for what is better, at most so many times over.
pub(crate) fn exchange(information: &mut Information, order: &mut [usize], rounds: usize) {
    for _ in 0..rounds {
        let mut changed = false;
        for place in order.iter_mut() {
            information.update(*place, -1.0);
            let worths = information.worths();
            if let Some(other) = best(&worths).filter(|k| worths[*k] > worths[*place] + BETTER) {
                *place = other;
                changed = true;
            }
            information.update(*place, 1.0);
        }
        information.refresh();
        if !changed {
            break;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows a candidate, nothing regular about them.
    fn rows(candidates: usize, columns: usize) -> (DMatrix<f64>, Vec<usize>) {
        let wild = |i: usize, j: usize| ((i * 7 + 3) as f64 * 1.7 + (j * 5 + 1) as f64 * 2.3).sin();
        let rows = DMatrix::from_fn(2 * candidates, columns, |i, j| {
            wild(i, j) + wild(j + 9, i * i)
        });
        (rows, (0..=candidates).map(|k| 2 * k).collect())
    }

    #[test]
    fn updates_by_rank_are_the_inverse_of_the_whole_and_can_be_taken_back() {
        let (all, first) = rows(12, 4);
        let mut information = Information::new(&all, first, DMatrix::identity(4, 4));
        let before = information.covariance.clone();
        let (gain_3, gain_7) = (information.gain(3), {
            information.take(3);
            information.gain(7)
        });
        information.take(7);
        let mut whole = DMatrix::identity(4, 4);
        for k in [3, 7] {
            whole += all.rows(2 * k, 2).transpose() * all.rows(2 * k, 2);
        }
        assert!((gain_3 + gain_7 - whole.determinant().ln()).abs() < 1e-9);
        let inverse = whole.try_inverse().expect("regular");
        assert!((&information.covariance - inverse).norm() < 1e-9);
        information.update(3, -1.0);
        information.update(7, -1.0);
        assert!((&information.covariance - before).norm() < 1e-9);
    }

    #[test]
    fn an_exchange_never_loses_and_ends_where_no_single_exchange_helps() {
        let (all, first) = rows(40, 5);
        let start = DMatrix::identity(5, 5) * 100.0;
        let mut information = Information::new(&all, first, start);
        let mut order = choose(&mut information, 6);
        let greedy = information.covariance.determinant();
        exchange(&mut information, &mut order, 50);
        // What is known is what the places that are taken tell, each once.
        let mut whole = DMatrix::identity(5, 5) / 100.0;
        for place in &order {
            whole += all.rows(2 * place, 2).transpose() * all.rows(2 * place, 2);
        }
        let inverse = whole.try_inverse().expect("regular");
        assert!((&information.covariance - inverse).norm() < 1e-6);
        assert!(information.covariance.determinant() <= greedy * (1.0 + 1e-9));
        for place in 0..order.len() {
            let mut without = information.clone();
            without.update(order[place], -1.0);
            let own = without.gain(order[place]);
            assert!(without.worths().iter().all(|w| *w <= own + BETTER + 1e-9));
        }
    }
}
