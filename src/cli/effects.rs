//! `truepose effects`: what the program knows.

use clap::Args;

use crate::effects::term::parameter_names;
use crate::effects::{CATALOGUE, Effect};
use crate::present::effects_v1::document;

use super::failure::Failure;
use super::output;

/// List the effects that the program knows, with what causes them and what to check
#[derive(Debug, Args)]
pub(crate) struct Effects {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Effects {
    pub(crate) fn run(self) -> Result<(), Failure> {
        if self.json {
            return output::json(&document());
        }
        let text: String = CATALOGUE.iter().map(|effect| in_words(effect)).collect();
        output::text(&text)
    }
}

fn in_words(effect: &Effect) -> String {
    let about = effect.about();
    let needs: Vec<&str> = about.needs.iter().map(|need| need.what).collect();
    format!(
        "{} ({})\n  {}\n  parameters     {}\n  cause          {}\n  needs          {}\n  usual size     {}\n  confused with  {}\n  check          {}\n\n",
        about.id,
        about.title.english(),
        about.equation,
        parameter_names(effect).join(", "),
        about.cause.english(),
        if needs.is_empty() {
            "nothing beside the poses".to_owned()
        } else {
            needs.join("; ")
        },
        about.usual_size.english(),
        about.confused_with,
        about.check.english(),
    )
}
