//! A shape is given its columns: orthogonal to the base where both could run away together.

use std::sync::Arc;

use crate::linear::{Basis, DEPENDENT};
use crate::model::shapes::{Profile, Shape};
use nalgebra::{DMatrix, DVector};

use super::regression::Regression;
use crate::diagnosis::candidates::Placed;
use crate::diagnosis::candidates::columns::pad_rows;

impl Regression<'_> {
    /// A shape ready to be fitted.
    pub(crate) fn placed(&self, shape: Shape) -> Placed {
        let mut raw = self.table.space.columns(&shape);
        let mut white = pad_rows(self.noise.whitened(&self.rows, &raw), self.prior_rows);
        let several = self.base.robot.joints.len() > 1;
        if several && matches!(shape.profile, Profile::Curve { .. }) {
            self.take_out_the_geometry(&mut raw, &mut white);
        }
        Placed {
            coefficients: DVector::zeros(raw.ncols()),
            credit: 0.0,
            shape,
            white: Arc::new(white),
            raw: Arc::new(raw),
        }
    }

    /// Projects columns orthogonal to those of the base. A free curve over one of several joints can do most of what a
    /// displaced axis does; fitted together without this, both run away in opposite directions, by metres.
    fn take_out_the_geometry(&self, raw: &mut DMatrix<f64>, white: &mut DMatrix<f64>) {
        let (residual, own_raw) = self.raw(&self.base);
        let (_, own_white) = self.whitened(&self.base, &residual, own_raw.clone());
        let basis = Basis::new(&own_white);
        for k in 0..white.ncols() {
            let before = white.column(k).norm();
            let same = basis.solve(&white.column(k).into_owned());
            white.column_mut(k).gemv(-1.0, &own_white, &same, 1.0);
            raw.column_mut(k).gemv(-1.0, &own_raw, &same, 1.0);
            if white.column(k).norm() < DEPENDENT * before {
                white.column_mut(k).fill(0.0);
                raw.column_mut(k).fill(0.0);
            }
        }
    }
}
