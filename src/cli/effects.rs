//! `truepose effects`: what the program knows.

use clap::Args;
use serde::Serialize;

use truepose::effects::term::parameter_names;
use truepose::effects::{CATALOGUE, Effect};

use super::failure::Failure;
use super::output;

/// List the effects that the program knows, with what causes them and what to check
#[derive(Debug, Args)]
pub(crate) struct Effects {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Listing {
    format: &'static str,
    effects: Vec<Entry>,
}

#[derive(Serialize)]
struct Entry {
    effect: &'static str,
    title: &'static str,
    per_joint: bool,
    parameters: Vec<&'static str>,
    equation: &'static str,
    source: &'static str,
    cause: &'static str,
    needs: Vec<&'static str>,
    usual_size: &'static str,
    confused_with: &'static str,
    check: &'static str,
}

impl Entry {
    fn new(effect: &dyn Effect) -> Self {
        let about = effect.about();
        Self {
            effect: about.id,
            title: about.title,
            per_joint: about.per_joint,
            parameters: parameter_names(effect),
            equation: about.equation,
            source: about.source,
            cause: about.cause,
            needs: about.needs.iter().map(|need| need.what).collect(),
            usual_size: about.usual_size,
            confused_with: about.confused_with,
            check: about.check,
        }
    }
}

impl Entry {
    fn needs_in_words(&self) -> String {
        if self.needs.is_empty() {
            "nothing beside the poses".to_owned()
        } else {
            self.needs.join("; ")
        }
    }
}

impl Effects {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let effects: Vec<Entry> = CATALOGUE.iter().map(|effect| Entry::new(*effect)).collect();
        if self.json {
            let format = "truepose-effects/1";
            return output::json(&Listing { format, effects });
        }
        let mut text = String::new();
        for entry in &effects {
            text += &format!(
                "{} ({})\n  {}\n  parameters     {}\n  cause          {}\n  needs          {}\n  usual size     {}\n  confused with  {}\n  check          {}\n\n",
                entry.effect,
                entry.title,
                entry.equation,
                entry.parameters.join(", "),
                entry.cause,
                entry.needs_in_words(),
                entry.usual_size,
                entry.confused_with,
                entry.check,
            );
        }
        output::text(&text)
    }
}
