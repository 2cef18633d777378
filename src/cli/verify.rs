//! `truepose verify`: a model on another session.

use std::path::PathBuf;

use clap::Args;

use crate::compensation::Verification;
use crate::pipeline::{load_model, verify};
use crate::present::verification_v1::document;

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
        let loaded = output::session(&self.session)?;
        let verification = verify(&calibration, &loaded.session)
            .map_err(|error| Failure::WrongInput(error.to_string()))?;
        if self.json {
            output::json(&document(&verification))
        } else {
            output::text(&in_words(&verification))
        }
    }
}

fn in_words(v: &Verification) -> String {
    let mut text = format!("{}: {} samples\n", v.session, v.samples);
    text += &format!(
        "RMS error, nominal robot  {:.6} mm (largest {:.6})\nRMS error, model          {:.6} mm (largest {:.6})\n",
        v.nominal.rms_mm, v.nominal.max_mm, v.model.rms_mm, v.model.max_mm
    );
    if let Some(trimmed) = &v.trimmed {
        text += &format!(
            "without suspected ones    {:.6} mm with the model, {} of {} samples set aside\n",
            trimmed.model_mm, trimmed.set_aside, v.samples
        );
    }
    if let Some(unseen) = &v.held_out {
        text += &format!(
            "held-out samples          {:.6} mm nominal, {:.6} mm with the model, of {} samples apart\n",
            unseen.nominal_mm, unseen.model_mm, unseen.samples
        );
    }
    for problem in &v.data_problems {
        text += &format!(
            "data problem: {}\n  evidence: {}\n  proposal: {}\n",
            problem.what, problem.evidence, problem.proposal
        );
    }
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
