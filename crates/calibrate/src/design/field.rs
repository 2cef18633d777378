//! The samples and the candidates on which models are compared.

use nalgebra::DMatrix;

use super::candidate_poses::CandidatePoses;
use super::rows::Rows;
use crate::diagnosis::evidence::Regression;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::Inputs;
use crate::model::Model;
use crate::observations::Layer;
use crate::sessions::Session;

pub(crate) struct Field<'p> {
    pub(crate) regression: &'p Regression<'p>,
    pub(crate) inputs: Inputs<'static>,
    /// The candidates as samples, where points are not all that is measured.
    taken: Option<Session>,
}

impl<'p> Field<'p> {
    pub(crate) fn new(prepared: &'p PreparedSearch, offer: &CandidatePoses) -> Self {
        Self {
            regression: &prepared.regression,
            inputs: offer.inputs(prepared),
            taken: offer.session(prepared),
        }
    }

    /// What each candidate shows of `truth` where `other` is refitted, in units of the noise that the session
    /// was found to have.
    pub(crate) fn rows(&self, truth: &Model, other: &Model) -> Rows {
        let Regression { rows, noise, .. } = self.regression;
        let Some(taken) = &self.taken else {
            return Rows::of_points([truth, other], &self.inputs, &rows.axes, noise.sigma_mm);
        };
        let mut layer = Layer::at(taken, &self.inputs);
        if let Some(so_far) = rows.observed() {
            layer.sigma.clone_from(&so_far.layer().sigma);
            layer.unit_mm = so_far.layer().unit_mm;
        }
        let of = |model: &Model| Rows::of_layer(&layer, model, noise.sigma_mm).0;
        let mut all = of(other);
        all.difference -= of(truth).difference;
        all
    }

    /// Gram matrix of a model's columns over the samples.
    pub(crate) fn gram(&self, model: &Model) -> DMatrix<f64> {
        let Regression { rows, noise, .. } = self.regression;
        let white = noise.whitened(rows, &rows.extract(model).1);
        white.tr_mul(&white)
    }
}
