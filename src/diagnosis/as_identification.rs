//! A diagnosis as an identification: the same values, intervals and gaps, so that whoever adds what
//! was found to the model, exports it and reports it has one model and not two.
//!
//! A plain fit of the same names differs from a diagnosis by a small part of the intervals: it
//! weighs every sample alone, where the diagnosis allows for noise that goes on from one sample to
//! the next (`values`).

use crate::effects::JointValues;
use crate::fit::gap::{Spread, deviations};
use crate::fit::problem::Problem;
use crate::fit::{Estimate, Gap, Identification};
use crate::model::{Calibration, Model};
use crate::sessions::Session;

use super::Diagnosis;

impl Diagnosis {
    /// The answer without the smooth correction of what no name explains.
    #[must_use]
    pub fn uncorrected(mut self) -> Self {
        self.unexplained.correction = None;
        self
    }

    /// This answer as an identification. `fitted` is a plain fit of the same names to the same
    /// session; how well they are determined, and how the solver fared, is taken from it.
    /// `calibration` is this answer's own.
    pub fn identification(
        &self,
        session: &Session,
        calibration: &Calibration,
        fitted: Identification,
    ) -> Identification {
        let gap = self.gaps_of(session, &calibration.model, &fitted);
        let parameters = fitted.parameters.into_iter().map(|one| self.own(one));
        Identification {
            parameters: parameters.collect(),
            covariance: calibration.covariance.clone(),
            outliers: self.outliers.clone(),
            model: calibration.model.clone(),
            gap,
            ..fitted
        }
    }

    /// What the diagnosis says of this parameter; of several orders of one effect, of the nearest.
    fn own(&self, fitted: Estimate) -> Estimate {
        let found = self.found.iter().flat_map(|found| &found.parameters);
        let same = self.identified.iter().chain(found).filter(|one| {
            (one.effect, one.joint, one.name) == (fitted.effect, fitted.joint, fitted.name)
                && (&one.setup, &one.target) == (&fitted.setup, &fitted.target)
        });
        let off = |one: &Estimate| (one.value - fitted.value).abs();
        let nearest = same.min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.cloned().unwrap_or(fitted)
    }

    fn gaps_of(&self, session: &Session, model: &Model, fitted: &Identification) -> Gap {
        let problem = Problem::new(session, JointValues::Commanded);
        let lengths_mm = deviations(&problem, model).length_mm;
        let mut suspected = vec![false; lengths_mm.len()];
        for outlier in &self.outliers {
            suspected[outlier.sample] = true;
        }
        let after = Spread::of(&lengths_mm, |i| problem.fit[i], |i| suspected[i]);
        Gap {
            after: after.unwrap_or(fitted.gap.after),
            ..fitted.gap
        }
    }
}
