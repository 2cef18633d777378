//! What the core writes into a chart, in the language of the window.

use crate::gui::language::known_words;
use crate::present::chart::{Chart, Item, Ticks};

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

/// What the table of texts does not know stays as it is.
fn translate(text: &mut String) {
    let own = BEFORE_NUMBERS.into_iter().find(|own| text.starts_with(own));
    let word = own.unwrap_or(text);
    if let Some(known) = known_words("chart-word", word) {
        let end = if word.ends_with(',') { "," } else { "" };
        *text = format!("{known}{end}{}", &text[word.len()..]);
    }
}
