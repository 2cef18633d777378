//! Samples that a fit set aside: single ones are accidents, a tenth of them is evidence.

use super::diagnosis::DataProblem;
use super::identification::Identification;
use crate::text::length;

/// More than this share of the samples are no accidents …
const MOST_SHARE: f64 = 0.1;
/// … and neither are so many of few.
const FEWEST: usize = 5;

impl Identification {
    /// The message where more samples were set aside than accidents explain: the figures are those of the others.
    #[doc(hidden)]
    pub fn many_set_aside(&self) -> Option<DataProblem> {
        let aside = self.outliers.len();
        let all = self.samples - self.left_out.len().min(self.samples);
        if aside < FEWEST || aside as f64 <= MOST_SHARE * all as f64 {
            return None;
        }
        // Of a sample without a point no length is known.
        let known = self.outliers.iter().map(|o| o.deviation_mm);
        let known: Vec<f64> = known.filter(|mm| mm.is_finite()).collect();
        let square: f64 = known.iter().map(|mm| mm.powi(2)).sum();
        let left = length(self.gap.after.rms_mm, 3);
        let evidence = if known.is_empty() {
            text!(
                "they were set aside as suspected outliers; the others leave {left}",
                left
            )
        } else {
            text!(
                "they were set aside as suspected outliers, with an RMS error of {error}; the others leave {left}",
                error = length((square / known.len() as f64).sqrt(), 3),
                left
            )
        };
        let mut samples: Vec<usize> = self.outliers.iter().map(|o| o.sample).collect();
        samples.sort_unstable();
        Some(DataProblem {
            what: text!(
                "{suspected} of {all} samples do not follow the model",
                suspected = aside,
                all
            ),
            evidence,
            proposal: text!(
                "check them before the model is used: it is fitted to the other samples, and the errors stated are of those"
            ),
            mend: None,
            samples,
        })
    }
}
