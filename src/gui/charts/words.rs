//! What the core writes into a chart, in the language of the window.

use crate::effects::{CATALOGUE, Effect};
use crate::language::{known_words, names};
use crate::present::chart::{Chart, Item, Ticks, in_a_sentence};
use crate::text::within;

/// Words of the core that a number may follow.
const BEFORE_NUMBERS: [&str; 3] = ["noise floor", "tolerance", "RMS error,"];

/// The chart with its words in the language of the window.
pub(super) fn translated(mut chart: Chart) -> Chart {
    for entry in &mut chart.legend {
        translate(&mut entry.name);
        translate(&mut entry.on_paper);
    }
    for text in [&mut chart.title, &mut chart.across.label] {
        translate(text);
    }
    for axis in [&mut chart.across, &mut chart.upwards] {
        if let Ticks::Words(words) = &mut axis.ticks {
            for (_, word) in words {
                translate(word);
            }
        }
    }
    for item in &mut chart.items {
        if let Item::Word(word) = item {
            translate(&mut word.text);
        }
    }
    chart
}

/// The effect that a row is of; its name may have been shortened.
fn effect_of(row: &str) -> Option<&'static Effect> {
    let row = row.trim_end_matches('…');
    let is = |effect: &&&Effect| in_a_sentence(effect.about().title.english()).starts_with(row);
    CATALOGUE.iter().find(is).copied().filter(|_| row.len() > 6)
}

/// What the table of texts does not know stays as it is.
fn translate(text: &mut String) {
    let own = BEFORE_NUMBERS.into_iter().find(|own| text.starts_with(own));
    let word = own.unwrap_or(text);
    if let Some(known) = known_words("chart-word", word.trim_end_matches(',')) {
        let end = if word.ends_with(',') { "," } else { "" };
        *text = format!("{known}{end}{}", &text[word.len()..]);
    } else if let Some(effect) = effect_of(text) {
        *text = within(names::title(effect.about().id)).into_owned();
    }
}
