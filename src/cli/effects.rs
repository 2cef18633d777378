//! `truepose effects`: what the program knows.

use clap::Args;

use crate::effects::term::parameter_names;
use crate::effects::{CATALOGUE, Effect};
use crate::present::effects_v1::document;
use crate::text::spoken;

use super::failure::Failure;
use super::output;
use super::words::{line, padded, parameter, wide_of};

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
    let needs: Vec<_> = about.needs.iter().map(|need| spoken(need.what)).collect();
    let needs = if needs.is_empty() {
        say!("nothing beside the poses").to_owned()
    } else {
        needs.join("; ")
    };
    let parameters = parameter_names(effect);
    let parameters: Vec<_> = parameters.iter().map(|name| parameter(name)).collect();
    let title = spoken(about.title);
    let lines = [
        (say!("parameters"), parameters.join(", ")),
        (say!("cause"), spoken(about.cause).to_owned()),
        (say!("needs"), needs),
        (say!("usual size"), spoken(about.usual_size).to_owned()),
        (
            say!("confused with"),
            spoken(about.confused_with).to_owned(),
        ),
        (say!("check"), spoken(about.check).to_owned()),
    ];
    let mut text = format!("{} ({title})\n  {}\n", about.id, about.equation);
    for (label, said) in &lines {
        line(
            &mut text,
            format!("  {}{said}", padded(label, wide_of(&lines))),
        );
    }
    text.push('\n');
    text
}
