//! `truepose verify`: a model on another session.

use std::path::PathBuf;

use clap::Args;

use crate::compensation::Verification;
use crate::explain::{Detail, verification};
use crate::pipeline::{load_model, verify};
use crate::present::verification_v1::document;

use super::failure::Failure;
use super::words::headed;
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
        let checked = verify(&calibration, &loaded.session)?;
        if self.json {
            output::json(&document(&checked))
        } else {
            output::text(&in_words(&checked))
        }
    }
}

fn in_words(v: &Verification) -> String {
    let text = headed(&v.session, v.samples);
    text + &blocks::sections(&verification(v, Detail::TERMINAL))
}
