//! The gap step by step, from the nominal robot to the model with everything that was found: a bar
//! is the RMS error of the samples that were fitted, a diamond that of samples that no fit has seen.
//!
//! The axis is logarithmic: the last steps, which decide, are a hundredth of the first. Numbers stand in a column of
//! their own at the right, where nothing is drawn through them.

use super::{
    Axis, Chart, ChartText, ColourRole, Entry, Form, Item, LegendSymbol, Lengths, Mark, Ticks,
    shortened,
};
use crate::effects::find;
use crate::model::ResidualStep;
use crate::present::drawing::Anchor;
use crate::present::names::{title_of, word};
use crate::present::numbers::trimmed;
use crate::text::within;

/// Steps that are drawn; a longer history is drawn from its ends.
const MOST: usize = 24;
/// As many rows as this have room, so that few bars are no blocks.
const FEWEST: usize = 5;
/// Room for the numbers beside the longest bar, as a part of it, and for second ones.
const NUMBERS: [f64; 2] = [0.3, 0.2];
/// From the numbers to the chart's edge, as a part of its width.
const APART: f64 = 0.01;
/// What is less than this part of the largest is no longer told apart.
const LEAST_PART: f64 = 1e-5;
/// The shortest bar begins at no more than this part of its value.
const FIRST: f64 = 0.7;
/// A decade of the axis: places that are named are more than one apart.
const DECADE: f64 = 10.0;
/// So many decades have names at 2 and 5 of each as well.
const FEW_DECADES: f64 = 2.0;
/// Room for the noise floor's name, rows.
const FOOT: f64 = 0.8;

/// The steps as bars, with the noise floor and the tolerance as lines; `None` where no step has a
/// size. The bars of what was found and is not in the model, `proposed`, are outlined.
pub fn gap(
    steps: &[ResidualStep],
    proposed: &[ResidualStep],
    floor_mm: Option<f64>,
    tolerance_mm: Option<f64>,
    lengths: Lengths<'_>,
) -> Option<Chart> {
    let in_model = steps.iter().map(|step| (step, true));
    let all = in_model.chain(proposed.iter().map(|step| (step, false)));
    let shown = ends(all.collect());
    let gaps = shown
        .iter()
        .flat_map(|(s, _)| [Some(s.gap_mm), s.held_out_mm]);
    let gaps: Vec<f64> = gaps.flatten().filter(|mm| mm.is_finite()).collect();
    let largest = gaps.iter().copied().fold(0.0, f64::max);
    if largest <= 0.0 {
        return None;
    }
    let least = gaps.iter().copied().chain(floor_mm).fold(largest, f64::min);
    let least = least.max(LEAST_PART * largest);
    let start = round_below(FIRST * least * lengths.per_mm);
    let place = |shown: f64| DECADE * (shown / start).log10().max(0.0);
    let value = |mm: f64| place(mm * lengths.per_mm);
    let says = |mm: f64| format!("{} {}", (lengths.number)(mm), lengths.unit);
    let rows = shown.len().max(FEWEST) as f64;
    let has_unseen = shown
        .iter()
        .any(|(s, _)| s.held_out_mm.is_some_and(f64::is_finite));
    let room = if has_unseen { NUMBERS[1] } else { 0.0 };
    let width = value(largest) * (1.0 + NUMBERS[0] + room);
    let numbers = (1.0 - APART) * width;
    let mut items = Vec::new();
    let mut marks = Vec::new();
    for (k, (step, in_model)) in shown.iter().enumerate() {
        let y = -(k as f64);
        items.push(bar(value(step.gap_mm), y, *in_model));
        let mut text = says(step.gap_mm);
        if let Some(mm) = step.held_out_mm.filter(|mm| mm.is_finite()) {
            text += &format!(" · {}", (lengths.number)(mm));
            marks.push(Mark {
                at: [value(mm), y],
                form: Form::Diamond,
            });
        }
        items.push(Item::Word(ChartText {
            at: [numbers, y],
            text,
            anchor: Anchor::End,
            below: false,
        }));
        if shown
            .get(k + 1)
            .is_some_and(|(next, _)| next.gap_mm < step.gap_mm)
        {
            // What the next step takes away.
            let taken = [y - 0.32, y - 1.0 + 0.32].map(|y| [value(step.gap_mm), y]);
            items.push(Item::Line(taken.to_vec(), ColourRole::Reference, 1.0, true));
        }
    }
    let ends = [0.5, 0.5 - rows];
    let mut legend = Vec::new();
    for (mm, stands) in [
        (floor_mm, ColourRole::Noise),
        (tolerance_mm, ColourRole::Tolerance),
    ] {
        if let Some(mm) = mm.filter(|mm| *mm <= largest && mm * lengths.per_mm >= start) {
            let line = ends.map(|y| [value(mm), y]).to_vec();
            let dashed = stands == ColourRole::Noise;
            items.push(Item::Line(line, stands, 1.5, dashed));
            if dashed {
                items.push(Item::Word(ChartText {
                    at: [value(mm), ends[1] - 0.5 * FOOT],
                    text: format!("{} {}", say!("noise floor"), says(mm)),
                    anchor: Anchor::Start,
                    below: false,
                }));
            } else {
                let name = say!("tolerance");
                let entry = Entry::new(name, LegendSymbol::Line, stands, true);
                legend.push(entry.on_paper(format!("{name} {}", says(mm))));
            }
        }
    }
    if !marks.is_empty() {
        legend.push(cross_validated());
        items.push(Item::Marks(marks, ColourRole::Curve, false));
    }
    let named = |(k, (step, _)): (usize, &(&ResidualStep, bool))| (-(k as f64), row(&step.what));
    Some(Chart {
        title: say!("the gap step by step").to_owned(),
        across: Axis {
            label: format!("{}, {}", say!("RMS error"), lengths.unit),
            ticks: Ticks::Words(ticks(start, largest * lengths.per_mm, place)),
        },
        upwards: Axis {
            label: String::new(),
            ticks: Ticks::Words(shown.iter().enumerate().map(named).collect()),
        },
        bounds: [[0.0, ends[1] - FOOT], [width, ends[0]]],
        items,
        legend,
        note: String::new(),
    })
}

/// The largest of 1, 2 and 5 of a decade that is no more than this.
fn round_below(value: f64) -> f64 {
    let decade = 10_f64.powf(value.log10().floor());
    let rounds = [5.0, 2.0, 1.0].map(|part| part * decade);
    let below = rounds.into_iter().find(|round| *round <= value);
    below.unwrap_or(decade)
}

/// Places of the axis that are named, and their names.
fn ticks(start: f64, end: f64, place: impl Fn(f64) -> f64) -> Vec<(f64, String)> {
    let few = (end / start).log10() <= FEW_DECADES;
    let parts: &[f64] = if few { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let mut ticks = Vec::new();
    let mut decade = 10_f64.powf(start.log10().floor());
    while decade <= end {
        let all = parts.iter().map(|part| part * decade);
        let within = all.filter(|value| (0.999 * start..=end).contains(value));
        ticks.extend(within.map(|value| (place(value), trimmed(value, 9))));
        decade *= 10.0;
    }
    ticks
}

fn cross_validated() -> Entry {
    let name = say!("cross-validated");
    let entry = Entry::new(
        name,
        LegendSymbol::Mark(Form::Diamond),
        ColourRole::Curve,
        false,
    );
    entry.on_paper(say!("on samples that no fit has seen"))
}

/// The bar of a row: whole where the step is in the model.
fn bar(end: f64, y: f64, in_model: bool) -> Item {
    let stands = if y == 0.0 {
        ColourRole::Before
    } else {
        ColourRole::After
    };
    let bar = [[0.0, y - 0.32], [end, y + 0.32]];
    Item::Bars(vec![bar], stands, in_model)
}

/// All steps, or the first and the last of many.
fn ends<T>(mut steps: Vec<T>) -> Vec<T> {
    if steps.len() > MOST {
        steps.drain(MOST / 2..steps.len() - MOST / 2);
    }
    steps
}

/// A step as its row is called: the bars need the room more than the words.
fn row(what: &str) -> String {
    let name = what.strip_prefix("with ").unwrap_or(what);
    let words = match name.split(':').next().unwrap_or(name) {
        "nominal robot" => say!("nominal robot").to_owned(),
        "full model" => say!("full model").to_owned(),
        "by region" => say!("by region").to_owned(),
        "geometry" => say!("geometry").to_owned(),
        "regional identification" => say!("regional identification").to_owned(),
        first => match first.split_once(' ').filter(|(id, _)| find(id).is_some()) {
            // The number of the joint is not what is cut.
            Some((id, joint)) => {
                let effect = shortened(&step(id), 21);
                return say!("{effect}, joint {joint}", effect, joint);
            }
            None => step(first),
        },
    };
    shortened(&words.replace("link length", "length"), 30)
}

/// A step of the history, in words: what a model was begun with, or what it got.
pub fn in_words(what: &str) -> String {
    match what.strip_prefix("with ") {
        Some(name) => say!("with {effect}", effect = step(name)),
        None => step(what),
    }
}

/// What a model was begun with, or the effect that it got, `id` or `id joint`.
fn step(name: &str) -> String {
    let id = name.split(' ').next().unwrap_or(name);
    match find(id) {
        Some(_) => within(&title_of(name)).into_owned(),
        None => word(name),
    }
}
