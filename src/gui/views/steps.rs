//! The sides of the window. At the left the list of steps, the controls of the chosen one, and what to do next; at the
//! right what it has found.

use egui::{Button, Panel, Response, RichText, Role, Ui, WidgetInfo, vec2};

use crate::gui::core::document::Method;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{Side, Step};
use crate::gui::widgets::{self, Does, Forms};
use crate::gui::workbench::Workbench;
use crate::text::capital;

use super::{export, gap, regions, results, samples, session};

type Show = fn(&mut Ui, &Workbench);

/// A step of the work: its controls, and the button at the foot.
fn of(step: Step) -> (Show, Show) {
    match step {
        Step::Session => (session::show, session::next),
        Step::Regions => (regions::show, regions::next),
        Step::Identify => (results::controls, results::next),
        Step::Gap => (gap::show, gap::next),
        Step::Export => (export::show, export::next),
    }
}

/// Whether there is something to show for a step.
fn is_done(step: Step, workbench: &Workbench) -> bool {
    let document = workbench.document();
    match step {
        Step::Session => true,
        Step::Regions => document.identified && document.method == Method::Regional,
        Step::Identify => workbench.answer().is_some(),
        Step::Gap if workbench.searching().is_some() => false,
        Step::Gap => workbench.diagnosis().is_some() || document.in_the_model().next().is_some(),
        Step::Export => workbench.exported().next().is_some(),
    }
}

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let now = workbench.view.step;
    let (show, next) = of(now);
    for (index, step) in workbench.steps().iter().copied().enumerate() {
        let done = is_done(step, workbench);
        let row = step_row(ui, (index + 1, step.name()), done, now == step);
        row.does(workbench, move |bench| bench.view.step = step);
    }
    ui.spacing_mut().item_spacing.y = space::ROW;
    ui.add_space(space::ROW);
    ui.separator();
    let frame = egui::Frame::NONE.inner_margin(egui::Margin::ZERO);
    let foot = Panel::bottom("next")
        .resizable(false)
        .show_separator_line(false)
        .frame(frame)
        .show(ui, |ui| {
            ui.add_space(space::ROW);
            next(ui, workbench);
        });
    widgets::settle(ui, foot.response.id, foot.response.rect);
    widgets::scroll(ui, ("controls", now.name()), |ui| {
        show(ui, workbench);
    });
}

/// A step in the list of steps: its number, its name, and a tick where there is something to show for it.
fn step_row(ui: &mut Ui, (number, name): (usize, &str), done: bool, selected: bool) -> Response {
    let palette = Palette::of(ui);
    let color = if selected {
        palette.accent
    } else {
        palette.text
    };
    let text = RichText::new(format!("{number}   {name}"));
    let tick = RichText::new(if done { "✓" } else { "" }).color(palette.accent);
    let button = Button::selectable(selected, text.font(strong(size::BODY)).color(color));
    let button = button.right_text(tick.font(strong(size::BODY)));
    let response = ui.add(button.min_size(vec2(ui.available_width(), 34.0)));
    let (enabled, says) = (ui.is_enabled(), format!("{number} {name}"));
    response.widget_info(|| WidgetInfo::selected(Role::Tab, enabled, selected, &says));
    response
}

/// The right-hand side: what the step has found, or the samples.
pub(crate) fn results(ui: &mut Ui, workbench: &Workbench) {
    let side = workbench.view.side;
    if workbench.view.step == Step::Export {
        ui.heading(say!("Export"));
        ui.add_space(space::TIGHT);
        widgets::scroll(ui, "export", |ui| export::preview(ui, workbench));
        return;
    }
    if workbench.view.step == Step::Gap && side == Side::Results {
        return gap::findings(ui, workbench);
    }
    let sides = [
        (Side::Results, say!("Summary")),
        (Side::Samples, &capital(say!("samples"))),
    ];
    let mut chosen = side;
    ui.choice(&sides, &mut chosen);
    if chosen != side {
        workbench.then(move |bench| bench.view.side = chosen);
    }
    ui.add_space(space::TIGHT);
    match side {
        Side::Samples => samples::show(ui, workbench),
        Side::Results => {
            widgets::scroll(ui, "results", |ui| results::summary(ui, workbench));
        }
    }
}
