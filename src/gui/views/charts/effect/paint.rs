//! An effect's own curve through the residual, in egui.

use egui::{Color32, Stroke, Ui};
use egui_plot::PlotPoint;

use crate::gui::cache::charts::Charted;
use crate::gui::cache::charts::over::Scale;
use crate::gui::core::scale::{FEW, LEAST_SPAN, stride, thinned};
use crate::gui::plots::chart_spec::{Ink, Mark, Sketch, Stands};
use crate::gui::plots::legend::{self, Entry, Sign};
use crate::gui::plots::{figure, marks};
use crate::gui::style::tokens::Palette;
use crate::gui::units::plain_number;
use crate::gui::views::charts::waterfall::lower;
use crate::gui::workbench::{Command, Workbench};
use crate::gui::workspace;

use crate::gui::cache::charts::effect::{EffectCurve, Spot};

/// A sample is under the pointer within this many points.
const REACH: f32 = 14.0;

fn curve(workbench: &Workbench) -> Result<&EffectCurve, (&'static str, &'static str)> {
    match workbench.charted() {
        Some(Charted::Effect(Some(curve))) if !curve.spots.is_empty() => Ok(curve),
        Some(Charted::Effect(_)) => Err((
            "There is no curve to show",
            "Run the diagnosis again: what was found belongs to other samples",
        )),
        _ => Err(("Computing…", "")),
    }
}

/// The effect's name as it stands within a sentence.
fn name(curve: &EffectCurve) -> String {
    let effect = crate::effects::find(curve.effect);
    effect.map_or_else(|| curve.effect.to_owned(), |e| lower(e.about().title))
}

fn scale(workbench: &Workbench, curve: &EffectCurve) -> Scale {
    let ends = curve.spots.first().zip(curve.spots.last());
    let span = ends.map_or(0.0, |(a, b)| b.x - a.x);
    let units = workbench.units();
    curve.over.scale(workbench.subject(), units, span)
}

/// Samples that are drawn.
fn some(curve: &EffectCurve) -> impl Iterator<Item = &Spot> {
    curve.spots.iter().step_by(stride(curve.spots.len(), FEW))
}

fn drawn(workbench: &Workbench, curve: &EffectCurve) -> Sketch {
    let units = workbench.units();
    let scale = scale(workbench, curve);
    let value = |mm: f64| units.length_value(mm);
    let mark = |spot: &Spot, mm: f64| Mark {
        at: [scale.shown(spot.x), value(mm)],
        side: spot.side,
    };
    let [low, high] = curve.extent_mm;
    let by = (0.08 * (high - low)).max(0.5 * LEAST_SPAN);
    let ends = curve.spots.first().zip(curve.spots.last());
    let [from, to] = ends.map_or([0.0, 1.0], |(a, b)| [a.x, b.x]);
    let least = 1e-3 + 1e-9 * from.abs().max(to.abs());
    let beside = (0.03 * (to - from)).max(least);
    let bounds = [
        [scale.shown(from - beside), value(low - by)],
        [scale.shown(to + beside), value(high + by)],
    ];
    let mut inks = Vec::new();
    let zero = vec![[bounds[0][0], 0.0], [bounds[1][0], 0.0]];
    inks.push(Ink::Line(zero, Stands::Reference, 1.0, false));
    let residual = some(curve).map(|s| mark(s, s.residual_mm)).collect();
    inks.push(Ink::Marks(residual, Stands::Before, false));
    for line in &curve.lines {
        let points = line
            .points
            .iter()
            .map(|[x, mm]| [scale.shown(*x), value(*mm)]);
        let dashed = line.side < 0.0;
        inks.push(Ink::Line(points.collect(), Stands::Curve, 2.4, dashed));
    }
    if curve.lines.is_empty() {
        let alone = some(curve).map(|s| mark(s, s.effect_mm)).collect();
        inks.push(Ink::Marks(alone, Stands::Curve, true));
    }
    let what = name(curve);
    let component = workbench.view().component.name();
    Sketch {
        title: format!("{component} residual without {what}, and what it does"),
        across: format!("{}, {}", curve.over.label(workbench.subject()), scale.unit),
        upwards: format!("{component}, {}", units.length_name()),
        bounds,
        degrees: scale.degrees,
        ticks: Vec::new(),
        inks,
        legend: vec![
            (format!("without {what}"), Stands::Before, false),
            (what, Stands::Curve, true),
        ],
        note: note(workbench, curve),
    }
}

fn note(workbench: &Workbench, curve: &EffectCurve) -> String {
    let mut notes = vec![format!(
        "what is left without {}; all else as fitted",
        name(curve)
    )];
    if curve.lines.is_empty() {
        notes.push("it depends on the pose too: its value at each sample".to_owned());
    }
    notes.extend(thinned(stride(curve.spots.len(), FEW), "point"));
    let problems = workbench.diagnosis().map(|d| &d.data_problems);
    if problems.is_some_and(|p| p.iter().any(|p| p.mend.is_some())) {
        notes.push("a set-up error is not corrected yet and shows here too".to_owned());
    }
    notes.join(" · ")
}

/// What is seen, in words.
fn says(workbench: &Workbench, curve: &EffectCurve) -> String {
    let units = workbench.units();
    let ends = curve.effect_mm.map(|mm| units.length(mm));
    let [before, after] = curve.rms_mm.map(|mm| units.length(mm));
    format!(
        "{} over {}: it moves the {} deviation from {} to {}; without it {before} root mean \
         square are left, with it {after}",
        name(curve),
        curve.over.label(workbench.subject()),
        workbench.view().component.name(),
        ends[0],
        ends[1],
    )
}

/// Shows the curve in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let curve = match curve(workbench) {
        Ok(curve) => curve,
        Err((title, why)) => return legend::empty(ui, title, why),
    };
    let palette = Palette::of(ui);
    let view = workbench.view();
    let units = workbench.units();
    let scale = scale(workbench, curve);
    let sketch = drawn(workbench, curve);
    let clear = Color32::TRANSPARENT;
    let mut entries = vec![Entry::new(
        "without it",
        Sign::Dot(0.0, clear, palette.before),
    )];
    match &curve.lines[..] {
        [] => {
            let sign = Sign::Dot(0.0, palette.accent, palette.accent);
            entries.push(Entry::new("what it does", sign));
        }
        [_] => entries.push(Entry::new(
            "what it does",
            Sign::Line(palette.accent, false),
        )),
        _ => {
            let line = |dashed| Sign::Line(palette.accent, dashed);
            entries.push(Entry::new("moving positive", line(false)));
            entries.push(Entry::new("negative", line(true)));
        }
    }
    legend::show(ui, &sketch.note, &entries, commands);
    let component = view.component.name();
    let plot = sketch.plot((curve.effect, component, false), view, &palette);
    let emphasised = view.hovered.or(view.selected);
    let at =
        |spot: &Spot| PlotPoint::new(scale.shown(spot.x), units.length_value(spot.residual_mm));
    let (response, transform) = sketch.show(ui, plot, &palette, |transform, shapes| {
        let marked = workspace::marked(view, workbench.subject().len());
        for spot in marked.chain(emphasised).filter_map(|s| curve.spot(s)) {
            let here = transform.position_from_point(&at(spot));
            shapes.push(marks::ring(here, 8.0, Stroke::new(2.5, palette.accent)));
        }
    });
    let title = format!("curve of {}, {component}", name(curve));
    figure(&response, &title, says(workbench, curve));
    let under = response.hover_pos().and_then(|pointer| {
        let candidates = some(curve).map(|spot| {
            let here = transform.position_from_point(&at(spot));
            (spot.sample, [here.x, here.y])
        });
        workspace::nearest(candidates, [pointer.x, pointer.y], REACH)
    });
    workspace::hover(&response, workbench, under, commands);
}

/// The chart to be saved.
pub(crate) fn sketch(workbench: &Workbench) -> Option<Sketch> {
    curve(workbench).ok().map(|found| drawn(workbench, found))
}

/// Every sample as a table, along the chart.
pub(crate) fn numbers(workbench: &Workbench) -> String {
    let component = workbench.view().component.name();
    let Ok(curve) = curve(workbench) else {
        return String::new();
    };
    let subject = workbench.subject();
    let along = curve.over.heading(subject);
    let what = name(curve);
    let mut text = format!(
        "sample\t{along}\tside\t{component} without {what}, mm\t{component} of {what}, mm\n"
    );
    for spot in &curve.spots {
        let cells = [
            (spot.sample + 1).to_string(),
            plain_number(curve.over.cell(subject, spot.x)),
            plain_number(spot.side),
            plain_number(spot.residual_mm),
            plain_number(spot.effect_mm),
        ];
        text += &cells.join("\t");
        text.push('\n');
    }
    text
}
