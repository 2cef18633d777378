//! A shape in a fit, with its columns.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::model::shapes::Shape;

/// A shape in a fit. Fits that are kept share their columns.
#[derive(Debug, Clone)]
pub(crate) struct Placed {
    pub(crate) shape: Shape,
    pub(crate) white: Arc<DMatrix<f64>>,
    pub(crate) raw: Arc<DMatrix<f64>>,
    pub(crate) coefficients: DVector<f64>,
    /// The correction of the complexity penalty of its columns, as a logarithm: a smooth curve has fewer effective
    /// parameters.
    pub(crate) credit: f64,
}
