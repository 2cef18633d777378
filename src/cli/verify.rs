//! `truepose verify`: a model on another session.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use truepose::compensation::{Verification, verify};
use truepose::model::format_v1::load_model;

use super::failure::Failure;
use super::output;

/// Check a model on another session
#[derive(Debug, Args)]
pub(crate) struct Verify {
    /// Model to check
    model: PathBuf,
    /// Session to check it on
    session: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Verify {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let calibration = load_model(&self.model)?;
        let loaded = truepose::sessions::load(&self.session)?;
        output::messages(&loaded.findings);
        let verification = verify(&calibration, &loaded.session)
            .map_err(|error| Failure::WrongInput(error.to_string()))?;
        if self.json {
            output::json(&Answer::new(&verification))
        } else {
            output::text(&in_words(&verification))
        }
    }
}

/// `truepose-verification/1`.
#[derive(Serialize)]
struct Answer<'a> {
    format: &'static str,
    session: &'a str,
    samples: usize,
    gap: Gap,
    within_tolerance: Option<Within>,
    compensated: Option<Compensated>,
    outliers: Vec<usize>,
    notes: &'a [String],
}

#[derive(Serialize)]
struct Gap {
    nominal_mm: f64,
    model_mm: f64,
    max_nominal_mm: f64,
    max_model_mm: f64,
}

#[derive(Serialize)]
struct Within {
    before: usize,
    after: usize,
    of: usize,
}

#[derive(Serialize)]
struct Compensated {
    rms_mm: f64,
    max_mm: f64,
    cannot_be_removed_by_joints_mm: f64,
}

impl<'a> Answer<'a> {
    fn new(v: &'a Verification) -> Self {
        Self {
            format: "truepose-verification/1",
            session: &v.session,
            samples: v.samples,
            gap: Gap {
                nominal_mm: v.nominal.rms_mm,
                model_mm: v.model.rms_mm,
                max_nominal_mm: v.nominal.max_mm,
                max_model_mm: v.model.max_mm,
            },
            within_tolerance: v.within_tolerance.map(|w| Within {
                before: w.before,
                after: w.after,
                of: w.of,
            }),
            compensated: v.compensated.map(|c| Compensated {
                rms_mm: c.gap.rms_mm,
                max_mm: c.gap.max_mm,
                cannot_be_removed_by_joints_mm: c.cannot_be_removed_by_joints_mm,
            }),
            // Samples are counted from 1 where people and other programs read them.
            outliers: v.outliers.iter().map(|sample| sample + 1).collect(),
            notes: &v.notes,
        }
    }
}

fn in_words(v: &Verification) -> String {
    let mut text = format!("{}: {} samples\n", v.session, v.samples);
    text += &format!(
        "RMS error, nominal robot  {:.6} mm (largest {:.6})\nRMS error, model          {:.6} mm (largest {:.6})\n",
        v.nominal.rms_mm, v.nominal.max_mm, v.model.rms_mm, v.model.max_mm
    );
    if let Some(within) = &v.within_tolerance {
        text += &format!(
            "within the tolerance      {} of {} before, {} with the model\n",
            within.before, within.of, within.after
        );
    }
    if let Some(compensated) = &v.compensated {
        text += &format!(
            "with corrected commands   {:.6} mm (largest {:.6}); not correctable by joint commands {:.6} mm\n",
            compensated.gap.rms_mm,
            compensated.gap.max_mm,
            compensated.cannot_be_removed_by_joints_mm
        );
    }
    for sample in &v.outliers {
        text += &format!("suspected outlier: sample {}\n", sample + 1);
    }
    for note in &v.notes {
        text += &format!("note: {note}\n");
    }
    text
}
