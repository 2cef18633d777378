//! The gap step by step, from the nominal robot to the model with everything that was found: a bar
//! is the RMS error of the samples that were fitted, a diamond that of samples that no fit has seen.

use super::{Axis, Chart, Entry, Form, Item, Lengths, Mark, Sign, Stands, Ticks, Word, shortened};
use crate::effects::{Effect, find};
use crate::model::GapStep;
use crate::present::drawing::Anchor;

/// Steps that are drawn; a longer history is drawn from its ends.
const MOST: usize = 24;
/// As many rows as this have room, so that few bars are no blocks.
const FEWEST: usize = 5;
/// Room for the number behind the longest bar, as a part of it, and for a second one.
const NUMBERS: [f64; 2] = [0.45, 0.35];
/// Room for the noise floor's name, rows.
const FOOT: f64 = 0.8;

/// The steps as bars, with the noise floor and the tolerance as lines; `None` where no step has a
/// size.
pub fn gap(
    steps: &[GapStep],
    floor_mm: Option<f64>,
    tolerance_mm: Option<f64>,
    lengths: Lengths<'_>,
) -> Option<Chart> {
    let shown = ends(steps);
    let gaps = shown.iter().flat_map(|s| [Some(s.gap_mm), s.held_out_mm]);
    let largest = gaps
        .flatten()
        .filter(|mm| mm.is_finite())
        .fold(0.0, f64::max);
    if largest <= 0.0 {
        return None;
    }
    let value = |mm: f64| mm * lengths.per_mm;
    let says = |mm: f64| format!("{} {}", (lengths.number)(mm), lengths.unit);
    let rows = shown.len().max(FEWEST) as f64;
    let mut items = Vec::new();
    let mut marks = Vec::new();
    for (k, step) in shown.iter().enumerate() {
        let y = -(k as f64);
        let stands = if k == 0 {
            Stands::Before
        } else {
            Stands::After
        };
        let bar = [[0.0, y - 0.32], [value(step.gap_mm), y + 0.32]];
        items.push(Item::Bars(vec![bar], stands, true));
        let mut end = step.gap_mm;
        let mut text = says(step.gap_mm);
        if let Some(mm) = step.held_out_mm.filter(|mm| mm.is_finite()) {
            end = end.max(mm);
            text += &format!(" · {}", (lengths.number)(mm));
            marks.push(Mark {
                at: [value(mm), y],
                form: Form::Diamond,
            });
        }
        items.push(Item::Word(Word {
            at: [value(end), y],
            text: format!("   {text}"),
            anchor: Anchor::Start,
            below: false,
        }));
        if shown
            .get(k + 1)
            .is_some_and(|next| next.gap_mm < step.gap_mm)
        {
            // What the next step takes away.
            let taken = [y - 0.32, y - 1.0 + 0.32].map(|y| [value(step.gap_mm), y]);
            items.push(Item::Line(taken.to_vec(), Stands::Reference, 1.0, true));
        }
    }
    let ends = [0.5, 0.5 - rows];
    let mut legend = Vec::new();
    for (mm, stands) in [(floor_mm, Stands::Noise), (tolerance_mm, Stands::Tolerance)] {
        if let Some(mm) = mm.filter(|mm| *mm <= largest) {
            let line = ends.map(|y| [value(mm), y]).to_vec();
            let dashed = stands == Stands::Noise;
            items.push(Item::Line(line, stands, 1.5, dashed));
            if dashed {
                items.push(Item::Word(Word {
                    at: [value(mm), ends[1] - 0.5 * FOOT],
                    text: format!("noise floor {}", says(mm)),
                    anchor: Anchor::Start,
                    below: false,
                }));
            } else {
                let name = format!("tolerance {}", says(mm));
                let entry = Entry::new("tolerance", Sign::Line, stands, true);
                legend.push(entry.on_paper(name));
            }
        }
    }
    let room = if marks.is_empty() { 0.0 } else { NUMBERS[1] };
    if !marks.is_empty() {
        let sign = Sign::Mark(Form::Diamond);
        let entry = Entry::new("cross-validated", sign, Stands::Curve, false);
        legend.push(entry.on_paper("on samples that no fit has seen"));
        items.push(Item::Marks(marks, Stands::Curve, false));
    }
    let named = |(k, step): (usize, &&GapStep)| (-(k as f64), row(&step.what));
    Some(Chart {
        title: "the gap step by step".to_owned(),
        across: Axis::numbers(format!("RMS error, {}", lengths.unit)),
        upwards: Axis {
            label: String::new(),
            ticks: Ticks::Words(shown.iter().enumerate().map(named).collect()),
        },
        bounds: [
            [0.0, ends[1] - FOOT],
            [value(largest) * (1.0 + NUMBERS[0] + room), ends[0]],
        ],
        items,
        legend,
        note: String::new(),
    })
}

/// All steps, or the first and the last of many.
fn ends(steps: &[GapStep]) -> Vec<&GapStep> {
    if steps.len() <= MOST {
        return steps.iter().collect();
    }
    let (first, last) = (&steps[..MOST / 2], &steps[steps.len() - MOST / 2..]);
    first.iter().chain(last).collect()
}

/// A step as its row is called: the bars need the room more than the words.
fn row(what: &str) -> String {
    let words = in_words(what);
    let words = words.strip_prefix("with ").unwrap_or(&words);
    let first = words.split(':').next().unwrap_or(words);
    shortened(&first.replace("link length", "length"), 24)
}

/// A step of the history with the effect's name in words.
pub fn in_words(what: &str) -> String {
    let effect = what.strip_prefix("with ").and_then(find);
    let name = |effect: &Effect| format!("with {}", in_a_sentence(effect.about().title.english()));
    effect.map_or_else(|| what.to_owned(), name)
}

/// A name as it stands within a sentence.
pub fn in_a_sentence(title: &str) -> String {
    let mut letters = title.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_lowercase().chain(letters).collect()
    })
}
