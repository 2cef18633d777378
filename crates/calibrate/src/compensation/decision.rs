//! Whether a calibrated robot is within its tolerance.
//!
//! The decision is about the largest deviation of a measured position, because a tolerance limits the error of every
//! position:
//!
//! - of a session that was measured with a table active, as it was measured;
//! - of any other, with corrected commands ([`Verification::compensated`]), which is a prediction.
//!
//! Suspected outliers count in it, because a suspicion is no proof; samples that were excluded by hand do not.
//!
//! Its expanded uncertainty (GUM 6.2.1, coverage factor 2) is
//!
//! ```text
//! U = 2 √(u² + m²)
//! u   noise of a measured point in one direction: the instrument's, or the noise floor if
//!     that is larger
//! m   of the prediction: √((h² − f²)/n), h: cross-validated RMS error, f: RMS error on the fit,
//!     n: measured directions; 0 where nothing is predicted
//! ```
//!
//! Errors of the instrument that are the same in every sample (its scale, its calibration) are not in it.
//!
//! Rules: ISO 14253-1:2017, clause 5 (conformity is proven where d + U ≤ T, non-conformity where
//! d − U > T, between them neither is), and simple acceptance, JCGM 106:2012, 8.2 (d ≤ T).

use super::verification::{Verification, WithinTolerance};
use crate::answers::diagnosis::Diagnosis;
use crate::fit::Identification;
use crate::sessions::{Session, Sigma};
use crate::text::Template;

/// Coverage factor of the expanded uncertainty, for about 95 %.
const COVERAGE: f64 = 2.0;

named! {
    /// The decision rule.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Rule {
        /// The uncertainty counts against the side that has to prove something.
        Iso14253 = "iso-14253-1",
        /// The uncertainty does not count.
        Simple = "simple-acceptance",
    }
    /// Its name in a document.
    pub fn id;
    /// Every rule.
    pub const ALL;
}

/// The outcome of a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Within the tolerance.
    Pass,
    /// Not within it.
    Fail,
    /// Neither is proven.
    Undecided,
}

/// The deviation that is decided, with its uncertainty. See the module.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredDeviation {
    /// Largest deviation of a position, mm.
    pub largest_mm: f64,
    /// Expanded uncertainty, mm.
    pub expanded_mm: f64,
    /// Whether it is predicted for corrected commands (rather than measured with a table active).
    pub predicted: bool,
    /// Numbers of poses within the tolerance, where one is stated.
    pub within: Option<WithinTolerance>,
}

/// RMS errors of a model, mm, from which its prediction error is estimated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FittedErrors {
    /// On the samples that it was fitted to.
    pub fit_mm: f64,
    /// On samples that no fit has seen.
    pub held_out_mm: Option<f64>,
    /// The residual of noise alone, where that is known.
    pub floor_mm: Option<f64>,
}

impl From<&Diagnosis> for FittedErrors {
    fn from(found: &Diagnosis) -> Self {
        Self {
            fit_mm: found.gap.end_mm,
            held_out_mm: found.held_out.gaps.map(|g| g.end_mm),
            floor_mm: Some(found.floor.mm),
        }
    }
}

impl From<&Identification> for FittedErrors {
    fn from(found: &Identification) -> Self {
        Self {
            fit_mm: found.gap.after.rms_mm,
            held_out_mm: found.held_out.as_ref().map(|gap| gap.after.rms_mm),
            floor_mm: None,
        }
    }
}

impl MeasuredDeviation {
    /// Of a verified session.
    ///
    /// # Errors
    /// Why nothing can be decided.
    pub fn of(
        session: &Session,
        verification: &Verification,
        fitted: FittedErrors,
    ) -> Result<Self, Template> {
        let axes = if session.samples.z_mm.is_some() {
            3.0
        } else {
            2.0
        };
        let predicted = session.compensated_by.is_none();
        let largest_mm = if !session.samples.observed.is_empty() {
            return Err(phrase!("no position was measured"));
        } else if predicted {
            let corrected = verification.compensated;
            corrected
                .ok_or(phrase!("no command can be corrected"))?
                .gap
                .max_mm
        } else {
            verification.nominal.max_mm
        };
        let stated = match session.instrument.sigma_mm {
            Some(Sigma::Overall(sigma)) => Some(sigma),
            Some(Sigma::PerAxis(each)) => each.into_iter().reduce(f64::max),
            None => None,
        };
        let shown = fitted.floor_mm.map(|floor| floor / f64::sqrt(axes));
        let noise = match (stated, shown) {
            (Some(stated), Some(shown)) => stated.max(shown),
            (stated, shown) => stated
                .or(shown)
                .ok_or(phrase!("the noise of the instrument is not known"))?,
        };
        let held_out = fitted.held_out_mm.unwrap_or(fitted.fit_mm);
        let more = (held_out.powi(2) - fitted.fit_mm.powi(2)).max(0.0) / axes;
        let model = if predicted { more.sqrt() } else { 0.0 };
        Ok(Self {
            largest_mm,
            expanded_mm: COVERAGE * noise.hypot(model),
            predicted,
            within: verification.within_tolerance,
        })
    }

    /// The outcome of a rule.
    pub fn decided(&self, rule: Rule, tolerance_mm: f64) -> Outcome {
        let counted = match rule {
            Rule::Iso14253 => self.expanded_mm,
            Rule::Simple => 0.0,
        };
        if self.largest_mm + counted <= tolerance_mm {
            Outcome::Pass
        } else if self.largest_mm - counted > tolerance_mm {
            Outcome::Fail
        } else {
            Outcome::Undecided
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_uncertainty_counts_against_the_side_that_has_to_prove() {
        let measured = MeasuredDeviation {
            largest_mm: 0.25,
            expanded_mm: 0.125,
            predicted: true,
            within: None,
        };
        let iso = |tolerance| measured.decided(Rule::Iso14253, tolerance);
        assert_eq!(iso(0.375), Outcome::Pass, "d + U = T is proven");
        assert_eq!(iso(0.374), Outcome::Undecided);
        assert_eq!(iso(0.125), Outcome::Undecided, "d − U = T is not above T");
        assert_eq!(iso(0.124), Outcome::Fail);
        let simple = |tolerance| measured.decided(Rule::Simple, tolerance);
        assert_eq!(simple(0.25), Outcome::Pass);
        assert_eq!(simple(0.249), Outcome::Fail);
        // An error that is not known is within nothing.
        let unknown = MeasuredDeviation {
            largest_mm: f64::NAN,
            ..measured
        };
        assert_eq!(unknown.decided(Rule::Simple, 1.0), Outcome::Undecided);
    }
}
