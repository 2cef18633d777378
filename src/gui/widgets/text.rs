//! Words: what stands over, beside and below controls, and numbers with their names.

use crate::text::{Template, spoken, within};
use std::sync::Arc;

use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align, CollapsingHeader, Color32, FontId, Layout, Response, RichText, Role, Sense, Stroke, Ui,
    WidgetInfo, vec2,
};

use crate::gui::help::{self, Word};
use crate::gui::style::{Palette, size, space, strong};

/// A text on one line, ended by … where it is wider than its room.
pub(crate) fn cut(
    ui: &Ui,
    text: &str,
    font: FontId,
    color: Color32,
    width: f32,
) -> Arc<egui::Galley> {
    let mut job = LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = TextWrapping::truncate_at_width(width.max(1.0));
    ui.painter().layout_job(job)
}

/// What a panel is about.
pub(crate) fn heading(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(strong(size::HEADING)));
}

/// How wide a text is in one line, points.
pub(crate) fn width_of(ui: &Ui, text: &str, font: egui::FontId) -> f32 {
    let galley = ui
        .painter()
        .layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
    galley.size().x
}

/// What the next group is about.
pub(crate) fn section(ui: &mut Ui, text: &str) {
    ui.add_space(space::ROW);
    let muted = Palette::of(ui).muted;
    ui.label(RichText::new(text).font(strong(size::SMALL)).color(muted));
}

/// The name of something, or what stands out among other words.
pub(crate) fn bold(ui: &mut Ui, text: impl Into<String>) -> Response {
    ui.label(RichText::new(text).font(strong(size::BODY)))
}

/// What stands in the bar of a plot.
pub(crate) fn title(ui: &mut Ui, text: &str) {
    bold(ui, text);
    ui.add_space(space::ROW);
}

/// A word beside a control of such a bar.
pub(crate) fn caption(ui: &mut Ui, text: &str) -> egui::Response {
    let muted = Palette::of(ui).muted;
    ui.label(RichText::new(text).size(size::SMALL).color(muted))
}

/// The sliders of the bars are finer than those of forms.
pub(crate) fn fine(ui: &mut Ui, width: f32) {
    ui.spacing_mut().slider_width = width;
    ui.spacing_mut().interact_size.y = 18.0;
}

/// A sentence that explains.
pub(crate) fn hint(ui: &mut Ui, text: impl Into<String>) {
    let muted = Palette::of(ui).muted;
    sentence(ui, RichText::new(text).size(size::NOTE).color(muted));
}

/// Height of a window that has room for more than what is done, points.
const ROOMY: f32 = 480.0;

/// The same above a button that is always in sight: in a low window the controls of the step need the room.
pub(crate) fn hint_above_the_button(ui: &mut Ui, text: impl Into<String>) {
    if ui.ctx().content_rect().height() >= ROOMY {
        hint(ui, text);
    }
}

/// Text whose lines are no longer than can be read.
fn sentence(ui: &mut Ui, text: RichText) -> Response {
    ui.scope(|ui| {
        ui.set_max_width(ui.available_width().min(space::LINE));
        ui.add(egui::Label::new(text).wrap())
    })
    .inner
}

/// What is wrong with the field above.
pub(crate) fn wrong(ui: &mut Ui, text: &str) {
    let color = Palette::of(ui).outside;
    sentence(ui, RichText::new(text).size(size::NOTE).color(color));
}

/// As [`fact`], of a name that is spoken here.
pub(crate) fn fact_of(ui: &mut Ui, name: Template, value: impl Into<String>) {
    fact(ui, spoken(name), value);
}

/// Names a control for those who do not see it.
pub(crate) fn label(response: &Response, name: impl Into<Box<str>>) {
    let name = name.into();
    let ctx = &response.ctx;
    ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// What folds away below a small title.
pub(crate) fn folded(ui: &mut Ui, text: &str, size: f32, contents: impl FnOnce(&mut Ui)) {
    let title = RichText::new(text).size(size).color(Palette::of(ui).muted);
    let header = CollapsingHeader::new(title).id_salt(text);
    header.show(ui, contents);
}

/// A name and what it is: on one line, or below each other where that is too narrow.
pub(crate) fn fact(ui: &mut Ui, name: &str, value: impl Into<String>) {
    let palette = Palette::of(ui);
    let value = value.into();
    let font = egui::TextStyle::Body.resolve(ui.style());
    let width = |text: &str| width_of(ui, text, font.clone());
    let beside = width(name) + 12.0 + width(&value) <= ui.available_width();
    let label = |ui: &mut Ui| {
        let text = RichText::new(name).color(palette.muted);
        let label = ui.add(egui::Label::new(text).wrap());
        if let Some(word) = help::about(name) {
            explained(label, word);
        }
    };
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = 16.0;
        ui.spacing_mut().item_spacing.y = 4.0;
        if beside {
            ui.horizontal(|ui| {
                label(ui);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.label(value);
                });
            });
        } else {
            ui.spacing_mut().item_spacing.y = 1.0;
            label(ui);
            ui.add(egui::Label::new(value).wrap());
        }
    });
}

/// A number in a column of a grid: its end is where the others end.
pub(crate) fn cell_right(ui: &mut Ui, text: RichText) -> Response {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(text))
        .inner
}

/// Says what an effect is when the pointer rests on its name.
pub(crate) fn explained_effect(response: Response, id: &str) -> Response {
    let Some(about) = crate::effects::find(id).map(crate::effects::Effect::about) else {
        return response;
    };
    response.on_hover_ui(|ui| {
        ui.set_max_width(space::TIP);
        bold(ui, crate::present::names::title(id));
        ui.label(spoken(about.cause));
        let usual_size = spoken(about.usual_size);
        hint(ui, say!("usually {usual_size}", usual_size));
        hint(ui, about.equation);
    })
}

/// Says what a word means when the pointer rests on it.
pub(crate) fn explained(response: Response, word: Word) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(space::TIP);
        bold(ui, word.name());
        ui.label(word.means());
    })
}

/// A question mark that says what a word means.
pub(crate) fn question(ui: &mut Ui, word: Word) {
    let palette = Palette::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::hover());
    let says = say!("what {word} means", word = within(word.name()));
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, says.clone()));
    let painter = ui.painter();
    painter.circle_stroke(rect.center(), 6.5, Stroke::new(1.0, palette.nominal));
    let font = egui::FontId::proportional(size::TINY);
    let centre = egui::Align2::CENTER_CENTER;
    painter.text(rect.center(), centre, "?", font, palette.muted);
    explained(response, word);
}

/// Rows of text stand close together; rows of controls need room.
pub(crate) fn dense(ui: &mut Ui) {
    ui.spacing_mut().interact_size.y = 16.0;
    ui.spacing_mut().item_spacing.y = 3.0;
}

/// What is said about what the pointer is on.
pub(crate) fn facts(ui: &mut Ui, (title, lines): &(String, Vec<(String, String)>)) {
    let palette = Palette::of(ui);
    ui.set_max_width(220.0);
    dense(ui);
    bold(ui, title);
    egui::Grid::new("facts")
        .num_columns(2)
        .spacing([16.0, 2.0])
        .show(ui, |ui| {
            for (name, value) in lines {
                ui.label(RichText::new(name).size(size::SMALL).color(palette.muted));
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.label(RichText::new(value).size(size::SMALL));
                });
                ui.end_row();
            }
        });
}
