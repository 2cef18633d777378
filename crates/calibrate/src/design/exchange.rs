//! The loop that chooses candidates by a criterion.
//!
//! [`choose`] takes candidate after candidate, each time the one with the largest gain: in the separation of models
//! ([`super::model_separation`], T-optimality), or in the information on parameters ([`super::information`],
//! D-optimality). [`exchange`] then gives one after the other back and takes the best in its place until none is
//! better (Fedorov 1972; Cook & Nachtsheim 1980).

use super::information::Information;
use crate::rounding;

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

impl Criterion for Information {
    fn worths(&self) -> Vec<f64> {
        let of = |k: usize| if self.taken[k] { 0.0 } else { self.gain(k) };
        (0..self.taken.len()).map(of).collect()
    }

    fn take(&mut self, candidate: usize) {
        self.update(candidate, 1.0);
    }
}

/// Candidates one after the other until the criterion is satisfied, `most` are taken, or nothing
/// helps; of candidates that are worth the same the first.
pub(crate) fn choose(criterion: &mut impl Criterion, most: usize) -> Vec<usize> {
    let mut order = Vec::new();
    while order.len() < most && !criterion.satisfied() {
        let worths = criterion.worths();
        let Some(best) = best(&worths).filter(|k| worths[*k] > rounding::COMPUTED) else {
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

/// Exchanges what was taken for what is better, at most so many times over.
pub(crate) fn exchange(information: &mut Information, order: &mut [usize], rounds: usize) {
    for _ in 0..rounds {
        let mut changed = false;
        for place in order.iter_mut() {
            information.update(*place, -1.0);
            let worths = information.worths();
            if let Some(other) =
                best(&worths).filter(|k| worths[*k] > worths[*place] + rounding::WRITTEN)
            {
                *place = other;
                changed = true;
            }
            information.update(*place, 1.0);
        }
        // What was updated so often is computed afresh, against rounding.
        information.refresh();
        if !changed {
            break;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::rows::Rows;
    use super::*;
    use nalgebra::DMatrix;

    /// Two rows a candidate, nothing regular about them.
    fn rows(candidates: usize, columns: usize) -> (DMatrix<f64>, Rows) {
        let wild = |i: usize, j: usize| ((i * 7 + 3) as f64 * 1.7 + (j * 5 + 1) as f64 * 2.3).sin();
        let rows = DMatrix::from_fn(2 * candidates, columns, |i, j| {
            wild(i, j) + wild(j + 9, i * i)
        });
        let mut all = Rows::zeros(columns, std::iter::repeat_n(2, candidates));
        all.columns = rows.transpose();
        (rows, all)
    }

    #[test]
    fn updates_by_rank_are_the_inverse_of_the_whole_and_can_be_taken_back() {
        let (all, candidates) = rows(12, 4);
        let mut information = Information::new(candidates, DMatrix::identity(4, 4));
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
        let (all, candidates) = rows(40, 5);
        let start = DMatrix::identity(5, 5) * 100.0;
        let mut information = Information::new(candidates, start);
        let mut order = choose(&mut information, 6);
        let greedy = information.covariance.determinant();
        exchange(&mut information, &mut order, 50);
        // The information is that of the places that are taken, each once.
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
            assert!(
                without
                    .worths()
                    .iter()
                    .all(|w| *w <= own + rounding::WRITTEN + 1e-9)
            );
        }
    }
}
