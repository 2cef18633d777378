//! `truepose history`: what became of the robots of a folder.

use std::path::PathBuf;

use clap::Args;

use crate::explain;
use crate::history::RobotHistory;
use crate::language::spoken;
use crate::pipeline::history;
use crate::present::history_v1::document;

use super::failure::Failure;
use super::{blocks, output};

/// Compare the sessions and models of a folder: how parameters and errors change over time
#[derive(Debug, Args)]
pub(crate) struct History {
    /// Folder with sessions and models; folders in it are not looked into
    folder: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl History {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let found = history(&self.folder)?;
        let not_read = found.not_read.iter();
        let lines: Vec<String> = not_read.map(|file| spoken(file.describe())).collect();
        output::messages(&lines);
        if self.json {
            output::json(&document(&found))
        } else {
            output::text(&in_words(&found.robots))
        }
    }
}

fn in_words(robots: &[RobotHistory]) -> String {
    blocks::sections(&robots.iter().map(explain::history).collect::<Vec<_>>())
}
