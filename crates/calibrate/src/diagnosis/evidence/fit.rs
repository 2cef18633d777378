//! A model fitted to the rows, with named terms and anonymous shapes.

use crate::linear::Basis;
use crate::model::Model;
use nalgebra::DVector;
use std::sync::Arc;

use crate::diagnosis::candidates::Placed;

/// A model fitted to the rows.
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    pub(crate) model: Model,
    pub(crate) shapes: Vec<Placed>,
    pub(crate) residual: DVector<f64>,
    pub(crate) basis: Arc<Basis>,
    pub(crate) rss: f64,
    pub(crate) ln_evidence: f64,
}
