//! Errors by kind of measurement: `kinds` in JSON, and in words.

use serde::Serialize;

use crate::observations::figures::{Errors, KindFigures};

/// One kind of measurement. Numbers are in `unit`: mm or mrad.
#[derive(Debug, Serialize)]
pub struct KindRow {
    kind: &'static str,
    unit: &'static str,
    #[serde(flatten)]
    fitted: Option<ErrorsRow>,
    outliers: usize,
    stated_sigma: Option<f64>,
    found_sigma: Option<f64>,
    held_out: Option<ErrorsRow>,
    unseen_rms: Option<f64>,
}

#[derive(Debug, Serialize)]
struct ErrorsRow {
    samples: usize,
    before: f64,
    after: f64,
    max_before: f64,
    max_after: f64,
}

impl ErrorsRow {
    fn new(errors: &Errors) -> Self {
        Self {
            samples: errors.count,
            before: errors.before_rms,
            after: errors.after_rms,
            max_before: errors.before_max,
            max_after: errors.after_max,
        }
    }
}

/// One row for each kind.
pub fn rows(kinds: &[KindFigures]) -> Vec<KindRow> {
    let row = |own: &KindFigures| KindRow {
        kind: own.kind,
        unit: own.unit,
        fitted: own.fitted.as_ref().map(ErrorsRow::new),
        outliers: own.outliers,
        stated_sigma: own.stated_sigma,
        found_sigma: own.found_sigma,
        held_out: own.held_out.as_ref().map(ErrorsRow::new),
        unseen_rms: own.unseen_rms,
    };
    kinds.iter().map(row).collect()
}

/// A line for each kind; nothing where plain points are all there is.
pub fn in_words(kinds: &[KindFigures]) -> String {
    let mut text = String::new();
    for own in kinds {
        let unit = own.unit;
        if let Some(e) = &own.fitted {
            text += &format!(
                "{:<12} {:.6} {unit} before, {:.6} {unit} after (largest {:.6} and {:.6}), {} measured",
                own.kind, e.before_rms, e.after_rms, e.before_max, e.after_max, e.count
            );
            if let Some(found) = own.found_sigma {
                text += &match own.stated_sigma {
                    Some(stated) => format!("; σ {found:.4} {unit}, stated {stated:.4}"),
                    None => format!("; σ {found:.4} {unit}, not stated"),
                };
            }
            if let Some(unseen) = own.unseen_rms {
                text += &format!("; {unseen:.6} {unit} where no fit has seen it");
            }
            text.push('\n');
        }
        if let Some(e) = &own.held_out {
            text += &format!(
                "{:<12} {:.6} {unit} before, {:.6} {unit} after, {} held out\n",
                own.kind, e.before_rms, e.after_rms, e.count
            );
        }
    }
    text
}
