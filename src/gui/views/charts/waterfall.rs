//! The gap step by step: the nominal robot, the identification, each effect that was added, and
//! the noise floor below which no model can come.

use egui::{Align2, FontId, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use crate::effects::find;
use crate::gui::help;
use crate::gui::plots::legend;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::units::{plain_number, significant};
use crate::gui::view::Chart;
use crate::gui::workbench::Workbench;

use super::view::View;

pub(super) const VIEW: View = View {
    chart: Chart::Gap,
    short: "gap",
    name: "Gap by step",
    word: help::GAP,
    of_component: false,
    of_joint: false,
    show: |ui, workbench, commands| {
        let says = "root mean square over the samples that were fitted";
        legend::show(ui, says, &[], commands);
        show(ui, workbench);
    },
    // It is drawn as the report draws it.
    sketch: |_, _| None,
    numbers,
    has_picture: |_| true,
};

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Bar {
    pub(crate) name: String,
    /// The gap after it, mm.
    pub(crate) gap_mm: f64,
}

/// The steps of the present answer.
pub(crate) fn bars(workbench: &Workbench) -> Vec<Bar> {
    let Some(answer) = workbench.answer() else {
        return Vec::new();
    };
    let steps = answer.calibration.history.iter();
    let bar = |step: &crate::model::GapStep| Bar {
        name: in_words(&step.what),
        gap_mm: step.gap_mm,
    };
    steps.map(bar).collect()
}

/// A step of the history with the effect's name in words.
fn in_words(what: &str) -> String {
    let effect = what.strip_prefix("with ").and_then(find);
    match effect {
        Some(effect) => format!("with {}", lower(effect.about().title)),
        None => what.to_owned(),
    }
}

/// A name as it stands within a sentence.
pub(crate) fn lower(title: &str) -> String {
    let mut letters = title.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_lowercase().chain(letters).collect()
    })
}

/// Every step as a table.
fn numbers(workbench: &Workbench) -> String {
    let mut text = "step\tgap, mm\n".to_owned();
    for bar in bars(workbench) {
        text += &format!("{}\t{}\n", bar.name, plain_number(bar.gap_mm));
    }
    text
}

fn show(ui: &mut Ui, workbench: &Workbench) {
    const NAMES: f32 = 200.0;
    const NUMBERS: f32 = 70.0;
    let palette = Palette::of(ui);
    let units = workbench.units();
    let bars = bars(workbench);
    let floor_mm = workbench.diagnosis().map(|d| d.floor.mm);
    let mm = |mm: f64| significant(units.length_value(mm), 3);
    let unit = units.length_name();
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    response.widget_info(|| {
        let steps = bars.iter().map(|b| format!("{} {}", b.name, mm(b.gap_mm)));
        let steps = steps.collect::<Vec<_>>().join(", ");
        WidgetInfo::labeled(Role::Figure, true, format!("gap by step: {steps}"))
    });
    let largest = bars.iter().map(|b| b.gap_mm).fold(0.0, f64::max);
    if bars.is_empty() || largest <= 0.0 {
        return;
    }
    let painter = ui.painter().with_clip_rect(rect);
    let small = FontId::proportional(size::SMALL);
    let left = rect.left() + NAMES;
    let wide = (rect.width() - NAMES - NUMBERS).max(20.0);
    #[allow(
        clippy::cast_possible_truncation,
        reason = "a share of what the plot shows"
    )]
    let x = |mm: f64| left + wide * (mm / largest) as f32;
    let foot = if floor_mm.is_some() { 22.0 } else { 4.0 };
    let row = ((rect.height() - foot) / bars.len() as f32).min(34.0);
    for (k, bar) in bars.iter().enumerate() {
        let y = rect.top() + row * (k as f32 + 0.5);
        let text = pos2(left - 12.0, y);
        painter.text(
            text,
            Align2::RIGHT_CENTER,
            &bar.name,
            small.clone(),
            palette.text,
        );
        let color = if k == 0 {
            palette.before
        } else {
            palette.after
        };
        let half = 0.32 * row;
        let end = x(bar.gap_mm).max(left + 1.5);
        let filled = egui::Rect::from_min_max(pos2(left, y - half), pos2(end, y + half));
        painter.rect_filled(filled, 2.0, color);
        let says = format!("{} {unit}", mm(bar.gap_mm));
        let at = pos2(end + 8.0, y);
        painter.text(at, Align2::LEFT_CENTER, says, small.clone(), palette.muted);
        if let Some(next) = bars.get(k + 1) {
            // What the next step takes away.
            let taken = [pos2(end, y + half), pos2(end, y + row - half)];
            let taken = if next.gap_mm < bar.gap_mm {
                taken
            } else {
                [taken[0]; 2]
            };
            let stroke = Stroke::new(1.0, palette.nominal);
            painter.extend(egui::Shape::dashed_line(&taken, stroke, 3.0, 3.0));
        }
    }
    if let Some(floor_mm) = floor_mm {
        let at = x(floor_mm);
        let bottom = rect.top() + row * bars.len() as f32 + 2.0;
        let line = [pos2(at, rect.top()), pos2(at, bottom)];
        painter.line_segment(line, Stroke::new(1.5, palette.within));
        let says = format!("noise floor {} {unit}", mm(floor_mm));
        let label = pos2(at, bottom) + vec2(0.0, 2.0);
        painter.text(label, Align2::LEFT_TOP, says, small, palette.within);
    }
}
