//! `truepose verify`: a model on another session.

use std::path::PathBuf;

use clap::Args;

use crate::compensation::{Verification, VerifyError};
use crate::explain;
use crate::language::spoken;
use crate::pipeline::{load_model, verify};
use crate::present::verification_v1::document;

use super::failure::Failure;
use super::words::{Labelled, labelled, line, wide_of};
use super::{blocks, output};

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
        let verification = verify(&calibration, &loaded.session)?;
        if self.json {
            output::json(&document(&verification))
        } else {
            output::text(&in_words(&verification))
        }
    }
}

fn in_words(v: &Verification) -> String {
    let mut text = String::new();
    let samples = say!(
        "{session}: {samples} samples",
        session = v.session,
        samples = v.samples
    );
    line(&mut text, samples);
    let (errors, tolerance) = (errors(v), tolerance(v));
    let wide = wide_of(errors.iter().chain(&tolerance));
    text += &labelled(&errors, wide);
    text += &blocks::sections(&explain::data_problems(&v.data_problems));
    text += &labelled(&tolerance, wide);
    for sample in &v.outliers {
        line(
            &mut text,
            say!("suspected outlier: sample {sample}", sample = sample + 1),
        );
    }
    for note in &v.notes {
        line(&mut text, say!("note: {note}", note = spoken(note)));
    }
    text
}

fn errors(v: &Verification) -> Vec<Labelled> {
    let error = |rms: f64, largest: f64| {
        say!(
            "{rms} mm (largest {largest})",
            rms = format!("{rms:.6}"),
            largest = format!("{largest:.6}")
        )
    };
    let mut lines = vec![
        (
            say!("RMS error, nominal robot"),
            error(v.nominal.rms_mm, v.nominal.max_mm),
        ),
        (
            say!("RMS error, model"),
            error(v.model.rms_mm, v.model.max_mm),
        ),
    ];
    if let Some(trimmed) = &v.trimmed {
        let said = say!(
            "{model} mm with the model, {excluded} of {all} samples set aside",
            model = format!("{:.6}", trimmed.model_mm),
            excluded = trimmed.set_aside,
            all = v.samples
        );
        lines.push((say!("without suspected ones"), said));
    }
    if let Some(unseen) = &v.held_out {
        let said = say!(
            "{nominal} mm nominal, {model} mm with the model, of {samples} samples apart",
            nominal = format!("{:.6}", unseen.nominal_mm),
            model = format!("{:.6}", unseen.model_mm),
            samples = unseen.samples
        );
        lines.push((say!("held-out samples"), said));
    }
    lines
}

fn tolerance(v: &Verification) -> Vec<Labelled> {
    let mut lines = Vec::new();
    if let Some(within) = &v.within_tolerance {
        let said = say!(
            "{before} of {all} before, {after} with the model",
            before = within.before,
            all = within.of,
            after = within.after
        );
        lines.push((say!("within the tolerance"), said));
    }
    if let Some(compensated) = &v.compensated {
        let said = say!(
            "{rms} mm (largest {largest}); not correctable by joint commands {left} mm",
            rms = format!("{:.6}", compensated.gap.rms_mm),
            largest = format!("{:.6}", compensated.gap.max_mm),
            left = format!("{:.6}", compensated.cannot_be_removed_by_joints_mm)
        );
        lines.push((say!("with corrected commands"), said));
    }
    lines
}

impl From<VerifyError> for Failure {
    fn from(error: VerifyError) -> Self {
        match error {
            VerifyError::Rejected(rejected) => rejected.into(),
            other => Self::refused(other.says()),
        }
    }
}
