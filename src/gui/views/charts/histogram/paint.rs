//! The histogram in egui.

use egui::{Align2, CursorIcon, Rect, Shape, Stroke, StrokeKind, Ui};
use egui_plot::{PlotPoint, PlotTransform};

use crate::gui::cache::charts::Charted;
use crate::gui::core::loaded_session::Component;
use crate::gui::plots::chart_spec::{Ink, Sketch, Stands};
use crate::gui::plots::figure;
use crate::gui::plots::legend::{self, Entry, Sign};
use crate::gui::style::tokens::Palette;
use crate::gui::units::{plain_number, significant};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};
use crate::sessions::Sigma;

use crate::gui::cache::charts::histogram::{Bins, Counted, Histogram, NoiseCurve, RULE};

/// A noise curve is drawn where a bin is at most so many standard deviations wide.
const SHARP: f64 = 3.0;
/// The noise curve is shown up to so many times the tallest bar.
const MOST_PEAK: f64 = 2.0;
/// Points of the noise curve.
const FINE: usize = 240;

fn histogram(workbench: &Workbench) -> Result<&Histogram, (&'static str, &'static str)> {
    match workbench.charted() {
        Some(Charted::Histogram(Some(histogram))) => Ok(histogram),
        Some(Charted::Histogram(None)) => Err((
            "No sample can be counted",
            "Every sample lacks a joint value or a coordinate",
        )),
        _ => Err(("Computing…", "")),
    }
}

/// How noise alone is spread in the component that is shown, where the noise is known: as the
/// instrument says, else as the residuals show it.
pub(super) fn noise(workbench: &Workbench) -> Option<NoiseCurve> {
    let subject = workbench.subject();
    let planar = subject.session.samples.z_mm.is_none();
    let count = if planar { 2 } else { 3 };
    let mean = |axes: [f64; 3]| {
        let squares = axes[..count].iter().map(|s| s * s).sum::<f64>();
        (squares / count as f64).sqrt()
    };
    let along = |axes: [f64; 3]| match workbench.view().component {
        Component::X => axes[0],
        Component::Y => axes[1],
        Component::Z => axes[2],
        _ => mean(axes),
    };
    let found = || workbench.answer().and_then(|a| a.identification.noise_mm);
    let sigma_mm = match subject.session.instrument.sigma_mm {
        Some(Sigma::Overall(sigma)) => sigma,
        Some(Sigma::PerAxis(axes)) => along(axes),
        None => along(found()?),
    };
    let length = workbench.view().component == Component::Length;
    (sigma_mm.is_finite() && sigma_mm > 0.0).then_some(NoiseCurve {
        sigma_mm,
        axes: if length { count } else { 1 },
    })
}

/// The noise curve, where bins are narrow enough to show it.
fn curve(workbench: &Workbench, bins: &Bins) -> Option<NoiseCurve> {
    noise(workbench).filter(|noise| bins.width_mm <= SHARP * noise.sigma_mm)
}

fn drawn(workbench: &Workbench, histogram: &Histogram) -> Sketch {
    let units = workbench.units();
    let value = |mm: f64| units.length_value(mm);
    let counted = histogram.shown(workbench.only_after());
    let bins = counted.bins;
    let series = [
        (&counted.before, Stands::Before, false),
        (&counted.after, Stands::After, true),
    ];
    let counts = series.iter().filter_map(|s| s.0.as_ref()).flatten();
    let most = counts.copied().max().unwrap_or(0).max(1) as f64;
    let mut inks = Vec::new();
    // What is filled stands behind what is outlined.
    for (counts, stands, filled) in series.into_iter().rev() {
        for (bin, count) in counts.iter().flatten().enumerate().filter(|(_, c)| **c > 0) {
            let [from, to] = bins.ends(bin).map(value);
            let gap = 0.04 * (to - from);
            let corner = [to - gap, *count as f64];
            inks.push(Ink::Bar([from + gap, 0.0], corner, stands, filled));
        }
    }
    let [low, high] = bins.span();
    let component = workbench.view().component;
    let mut tallest = most;
    if let Some(noise) = curve(workbench, &bins) {
        let samples = histogram.sizes_before.within(0.0).1;
        let at = |k: usize| low + (high - low) * k as f64 / FINE as f64;
        let point = |k: usize| [value(at(k)), noise.count(at(k), bins.width_mm, samples)];
        let points: Vec<[f64; 2]> = (0..=FINE).map(point).collect();
        // A curve far above all bars must not flatten them.
        let peak = points.iter().map(|p| p[1]).fold(0.0, f64::max);
        tallest = most.max(peak.min(MOST_PEAK * most));
        inks.push(Ink::Line(points, Stands::Noise, 1.8, true));
    }
    let top = 1.2 * tallest;
    if let Some(tolerance) = workbench.document().tolerance_mm {
        let both = [-tolerance, tolerance];
        let ends = if component == Component::Length {
            &both[1..]
        } else {
            &both[..]
        };
        for end in ends.iter().filter(|end| **end > low && **end < high) {
            let line = vec![[value(*end), 0.0], [value(*end), top]];
            inks.push(Ink::Line(line, Stands::Tolerance, 1.6, false));
            let side = if *end < 0.0 {
                Align2::RIGHT_TOP
            } else {
                Align2::LEFT_TOP
            };
            let word = " tolerance ".to_owned();
            inks.push(Ink::Word([value(*end), 0.995 * top], word, side));
        }
    }
    let margin = 0.02 * (high - low);
    let mut legend = Vec::new();
    if counted.before.is_some() {
        legend.push(("As measured".to_owned(), Stands::Before, false));
    }
    if counted.after.is_some() {
        legend.push(("Against the model".to_owned(), Stands::After, true));
    }
    let name = component.name();
    Sketch {
        title: format!("samples by {name} deviation"),
        across: format!("{name} deviation, {}", units.length_name()),
        upwards: "samples".to_owned(),
        bounds: [[value(low - margin), 0.0], [value(high + margin), top]],
        degrees: false,
        ticks: Vec::new(),
        inks,
        legend,
        note: note(workbench, histogram, counted),
    }
}

fn note(workbench: &Workbench, histogram: &Histogram, counted: &Counted) -> String {
    let units = workbench.units();
    let mut notes = Vec::new();
    if let Some(tolerance) = workbench.document().tolerance_mm {
        let sign = match workbench.view().component {
            Component::Length => "",
            _ => "±",
        };
        let (before, all) = histogram.sizes_before.within(tolerance);
        let mut counts = before.to_string();
        if let Some(sizes) = &histogram.sizes_after {
            counts += &format!(" → {}", sizes.within(tolerance).0);
        }
        let tolerance = units.length(tolerance);
        notes.push(format!("within {sign}{tolerance}: {counts} of {all}"));
    }
    match counted.beyond {
        0 => {}
        1 => notes.push("one lies beyond the ends".to_owned()),
        n => notes.push(format!("{n} lie beyond the ends")),
    }
    let width = significant(units.length_value(counted.bins.width_mm), 2);
    notes.push(format!("{width} {} wide {RULE}", units.length_name()));
    notes.join(" · ")
}

/// What is seen, in words.
fn says(workbench: &Workbench, histogram: &Histogram) -> String {
    let units = workbench.units();
    let counted = histogram.shown(workbench.only_after());
    let tallest = |counts: &Option<Vec<usize>>| {
        let counts = counts.as_ref()?;
        let bin = (0..counts.len()).max_by_key(|bin| counts[*bin])?;
        let [from, to] = counted.bins.ends(bin).map(|mm| units.length(mm));
        Some(format!("most, {}, from {from} to {to}", counts[bin]))
    };
    let mut says = format!(
        "how many samples have which {} deviation",
        workbench.view().component.name()
    );
    for (name, counts) in [("before", &counted.before), ("after", &counted.after)] {
        if let Some(tallest) = tallest(counts) {
            says += &format!("; {name}: {tallest}");
        }
    }
    format!("{says}; {}", note(workbench, histogram, counted))
}

/// The component of a sample that is counted: what is left if anything is, else before.
fn counted_value(workbench: &Workbench, sample: usize, after: bool) -> f64 {
    let subject = workbench.subject();
    let e = match workbench.answer().filter(|_| after) {
        Some(answer) => answer.deviation_after(sample),
        None => subject.deviation_before(sample),
    };
    subject.component(e, sample, workbench.view().component)
}

/// The samples of a bar.
fn samples_in(workbench: &Workbench, bins: &Bins, bin: usize, after: bool) -> Vec<usize> {
    let usable = workbench.subject().overview.usable.iter();
    let here = |sample: &usize| bins.of(counted_value(workbench, *sample, after)) == Some(bin);
    usable.map(|s| *s as usize).filter(here).collect()
}

/// Shows the histogram in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let histogram = match histogram(workbench) {
        Ok(histogram) => histogram,
        Err((title, why)) => return legend::empty(ui, title, why),
    };
    let palette = Palette::of(ui);
    let view = workbench.view();
    let only = workbench.only_after();
    let counted = histogram.shown(only);
    let bins = counted.bins;
    let sketch = drawn(workbench, histogram);
    let mut entries = vec![Entry::before(workbench, Sign::Bar(palette.before, false))];
    if workbench.answer().is_some() {
        entries.push(Entry::new("after", Sign::Bar(palette.after, true)));
    }
    if curve(workbench, &bins).is_some() {
        entries.push(Entry::new("noise alone", Sign::Line(palette.muted, true)));
    }
    legend::show(ui, &sketch.note, &entries, commands);
    let name = view.component.name();
    let plot = sketch.plot(("histogram", name, only), view, &palette);
    let subject = workbench.subject();
    let after = workbench.answer().is_some();
    let emphasised = view.hovered.or(view.selected);
    let emphasised = emphasised.filter(|sample| subject.usable[*sample]);
    let in_bin = emphasised.and_then(|s| bins.of(counted_value(workbench, s, after)));
    let units = workbench.units();
    let column = |transform: &PlotTransform, bin: usize| {
        let [from, to] = bins.ends(bin).map(|mm| units.length_value(mm));
        let at = |x: f64| transform.position_from_point(&PlotPoint::new(x, 0.0)).x;
        Rect::from_x_y_ranges(at(from)..=at(to), transform.frame().y_range())
    };
    let (response, transform) = sketch.show(ui, plot, &palette, |transform, shapes| {
        if let Some(bin) = in_bin {
            let stroke = Stroke::new(2.0, palette.accent);
            let rect = column(transform, bin);
            shapes.push(Shape::rect_stroke(rect, 2.0, stroke, StrokeKind::Inside));
        }
    });
    let title = format!("histogram, {name}");
    figure(&response, &title, says(workbench, histogram));
    let Some(bin) = response.hover_pos().and_then(|pointer| {
        let shown = transform.value_from_position(pointer).x;
        let [low, high] = bins.span();
        let mm = shown / units.length_value(1.0);
        (mm >= low && mm <= high).then(|| bins.of(mm)).flatten()
    }) else {
        return;
    };
    let of = |counts: &Option<Vec<usize>>| counts.as_ref().map(|counts| counts[bin]);
    let (of_before, of_after) = (of(&counted.before), of(&counted.after));
    // What is left, unless only what was before is in this bar.
    let take_after = after && (of_after != Some(0) || of_before.is_none_or(|n| n == 0));
    if response.clicked() {
        let samples = samples_in(workbench, &bins, bin, take_after);
        if !samples.is_empty() {
            commands.push(Command::Mark(samples));
        }
    }
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    response.on_hover_ui_at_pointer(|ui| {
        let [from, to] = bins.ends(bin).map(|mm| units.length_number(mm));
        let title = format!("{from} … {to} {}", units.length_name());
        let line = |name: &str, n: Option<usize>| Some((name.to_owned(), n?.to_string()));
        let lines = [line("before", of_before), line("after", of_after)];
        let mut lines: Vec<_> = lines.into_iter().flatten().collect();
        lines.push(("click".to_owned(), "marks them".to_owned()));
        widgets::facts(ui, &(title, lines));
    });
}

/// The chart to be saved.
pub(crate) fn sketch(workbench: &Workbench) -> Option<Sketch> {
    histogram(workbench)
        .ok()
        .map(|found| drawn(workbench, found))
}

/// Every bar as a table.
pub(crate) fn numbers(workbench: &Workbench) -> String {
    let mut text = "from, mm\tto, mm\tbefore\tafter\tnoise alone\n".to_owned();
    let Ok(histogram) = histogram(workbench) else {
        return text;
    };
    let counted = histogram.shown(workbench.only_after());
    let noise = noise(workbench);
    let samples = histogram.sizes_before.within(0.0).1;
    for bin in 0..counted.bins.count {
        let [from, to] = counted.bins.ends(bin);
        let of = |counts: &Option<Vec<usize>>| {
            counts
                .as_ref()
                .map_or_else(String::new, |c| c[bin].to_string())
        };
        let alone = noise.map(|n| (n.below(to) - n.below(from)) * samples as f64);
        let cells = [
            plain_number(from),
            plain_number(to),
            of(&counted.before),
            of(&counted.after),
            alone.map_or_else(String::new, plain_number),
        ];
        text += &cells.join("\t");
        text.push('\n');
    }
    text
}
