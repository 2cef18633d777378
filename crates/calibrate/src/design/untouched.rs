//! Parameters that no candidate shows, as the frames of setups that are over: what is known of them is of use for the
//! others only, and they are eliminated before the candidates are looked at.

use nalgebra::{DMatrix, DVector};

use crate::linear::gram;

use super::inverse::LEAST_INFORMATION;

/// Fewer are carried along as fast.
const FEWEST: usize = 48;

/// Products of a model's columns over what was measured, with each other and with a difference, for the parameters that
/// candidates show.
pub(super) struct ReducedInformation {
    pub(super) gram: DMatrix<f64>,
    pub(super) pull: DVector<f64>,
    /// The part of the difference's square that the eliminated ones explain.
    pub(super) explained: f64,
}

impl ReducedInformation {
    /// Eliminates what the columns of the candidates do not touch; these keep the others.
    pub(super) fn without_untouched(
        gram: DMatrix<f64>,
        pull: DVector<f64>,
        columns: Vec<&mut DMatrix<f64>>,
    ) -> Self {
        let touched = |k: usize| {
            let mut all = columns.iter();
            all.any(|own| own.column(k).iter().any(|v| *v != 0.0))
        };
        let (kept, gone): (Vec<usize>, Vec<usize>) = (0..pull.len()).partition(|k| touched(*k));
        let eliminated = (gone.len() >= FEWEST)
            .then(|| eliminated(&gram, &pull, &kept, &gone))
            .flatten();
        let Some(known) = eliminated else {
            return Self {
                gram,
                pull,
                explained: 0.0,
            };
        };
        for own in columns {
            *own = own.select_columns(&kept);
        }
        known
    }
}

fn eliminated(
    products: &DMatrix<f64>,
    pull: &DVector<f64>,
    kept: &[usize],
    gone: &[usize],
) -> Option<ReducedInformation> {
    let mut own = products.select_columns(gone).select_rows(gone);
    for k in 0..own.nrows() {
        own[(k, k)] += LEAST_INFORMATION * own[(k, k)].max(1e-300);
    }
    let l = own.cholesky()?.unpack();
    let rest = products.select_columns(kept);
    let along = l.solve_lower_triangular(&rest.select_rows(gone))?;
    let of_pull = l.solve_lower_triangular(&pull.select_rows(gone))?;
    Some(ReducedInformation {
        gram: rest.select_rows(kept) - gram(&along),
        pull: pull.select_rows(kept) - along.tr_mul(&of_pull),
        explained: of_pull.norm_squared(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_known_of_the_others_is_the_same() {
        let (shown, all) = (5, 5 + FEWEST);
        let wild = |i: usize, j: usize| (((i + 3) * (2 * j + 5)) as f64 * 0.37).sin();
        let columns = DMatrix::from_fn(3 * all, all, wild);
        let difference = DVector::from_fn(3 * all, |i, _| wild(i, 99));
        let (products, pull) = (columns.tr_mul(&columns), columns.tr_mul(&difference));
        let of = |k: usize| {
            DMatrix::from_fn(2, all, |i, j| if j < shown { wild(i + k, j) } else { 0.0 })
        };
        let (mut one, mut two) = (of(1), of(2));
        let whole = products.clone().try_inverse().unwrap();
        let explained = pull.dot(&(&whole * &pull));
        let known = ReducedInformation::without_untouched(products, pull, vec![&mut one, &mut two]);
        assert_eq!((one.ncols(), two.ncols()), (shown, shown));
        let covariance = known.gram.try_inverse().unwrap();
        let own = whole.view((0, 0), (shown, shown));
        assert!((&covariance - own).norm() < 1e-6 * covariance.norm());
        let left = known.pull.dot(&(&covariance * &known.pull));
        assert!((left + known.explained - explained).abs() < 1e-6 * explained);
    }
}
