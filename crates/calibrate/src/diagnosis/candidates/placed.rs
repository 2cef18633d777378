//! A shape's columns beside those of the model.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::model::shapes::Shape;

/// A shape in a fit. Fits that are kept have their columns in common.
#[derive(Debug, Clone)]
pub(crate) struct Placed {
    pub(crate) shape: Shape,
    pub(crate) white: Arc<DMatrix<f64>>,
    pub(crate) raw: Arc<DMatrix<f64>>,
    pub(crate) coefficients: DVector<f64>,
    /// What the shape's columns pay too much, as a logarithm: a smooth curve is worth fewer of them.
    pub(crate) credit: f64,
}
