//! Words: what stands over, beside and below controls, and numbers with their names.

use egui::{
    Align, CollapsingHeader, Color32, FontId, Label, Layout, Response, RichText, Role, Sense,
    Stroke, TextStyle, Ui, WidgetInfo, vec2,
};

use crate::gui::help::{self, Word};
use crate::gui::style::{Palette, size, space, strong};
use crate::text::{spoken, within};

/// What the window writes beside egui's own labels.
pub(crate) trait Words {
    /// What the next group is about.
    fn section(&mut self, text: &str);
    /// The name of something, or what stands out among other words.
    fn bold(&mut self, text: impl Into<String>) -> Response;
    /// A word beside a control of a bar.
    fn caption(&mut self, text: &str) -> Response;
    /// A sentence that explains.
    fn hint(&mut self, text: impl Into<String>);
    /// What is wrong with the field above.
    fn wrong(&mut self, text: &str);
    /// A name and what it is: on one line, or below each other where that is too narrow.
    fn fact(&mut self, name: &str, value: impl Into<String>);
    /// What folds away below a small title.
    fn folded(&mut self, text: &str, contents: impl FnOnce(&mut Ui));
    /// A question mark that says what a word means.
    fn question(&mut self, word: Word);
}

impl Words for Ui {
    fn section(&mut self, text: &str) {
        self.add_space(space::ROW);
        self.label(RichText::new(text).font(strong(size::SMALL)).weak());
    }

    fn bold(&mut self, text: impl Into<String>) -> Response {
        self.label(RichText::new(text).font(strong(size::BODY)))
    }

    fn caption(&mut self, text: &str) -> Response {
        self.label(RichText::new(text).small().weak())
    }

    fn hint(&mut self, text: impl Into<String>) {
        sentence(self, RichText::new(text).size(size::NOTE).weak());
    }

    fn wrong(&mut self, text: &str) {
        let color = Palette::of(self).outside;
        sentence(self, RichText::new(text).size(size::NOTE).color(color));
    }

    fn fact(&mut self, name: &str, value: impl Into<String>) {
        let value = value.into();
        let font = TextStyle::Body.resolve(self.style());
        let width = |text: &str| width_of(self, text, font.clone());
        let beside = width(name) + 12.0 + width(&value) <= self.available_width();
        let label = |ui: &mut Ui| {
            let label = ui.add(Label::new(RichText::new(name).weak()).wrap());
            if let Some(word) = help::about(name) {
                explained(label, word);
            }
        };
        self.scope(|ui| {
            ui.spacing_mut().interact_size.y = 16.0;
            ui.spacing_mut().item_spacing.y = 4.0;
            if beside {
                ui.horizontal(|ui| {
                    label(ui);
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(value));
                });
            } else {
                ui.spacing_mut().item_spacing.y = 1.0;
                label(ui);
                ui.add(Label::new(value).wrap());
            }
        });
    }

    fn folded(&mut self, text: &str, contents: impl FnOnce(&mut Ui)) {
        let title = RichText::new(text).small().weak();
        let header = CollapsingHeader::new(title).id_salt(text);
        header.show(self, contents);
    }

    fn question(&mut self, word: Word) {
        let palette = Palette::of(self);
        let size = vec2(16.0, self.spacing().interact_size.y);
        let (rect, response) = self.allocate_exact_size(size, Sense::hover());
        let says = say!("what {word} means", word = within(&word.name()));
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, says.clone()));
        let painter = self.painter();
        painter.circle_stroke(rect.center(), 6.5, Stroke::new(1.0, palette.nominal));
        let font = FontId::proportional(size::TINY);
        let centre = egui::Align2::CENTER_CENTER;
        painter.text(rect.center(), centre, "?", font, palette.muted);
        explained(response, word);
    }
}

/// The name of what asks for more before it is done.
pub(crate) fn dots(name: &str) -> String {
    say!("{name}…", name)
}

/// Text whose lines are no longer than can be read.
fn sentence(ui: &mut Ui, text: RichText) {
    ui.scope(|ui| {
        ui.set_max_width(ui.available_width().min(space::LINE));
        ui.add(Label::new(text).wrap());
    });
}

/// How wide a text is in one line, points.
pub(crate) fn width_of(ui: &Ui, text: &str, font: FontId) -> f32 {
    let painter = ui.painter();
    let galley = painter.layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
    galley.size().x
}

/// Names a control for those who do not see it.
pub(crate) fn label(response: &Response, name: impl Into<Box<str>>) {
    let name = name.into();
    let ctx = &response.ctx;
    ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
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
        ui.bold(crate::present::names::title(id));
        ui.label(spoken(about.cause));
        let usual_size = spoken(about.usual_size);
        ui.hint(say!("usually {usual_size}", usual_size));
        ui.hint(about.equation);
    })
}

/// Says what a word means when the pointer rests on it.
pub(crate) fn explained(response: Response, word: Word) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(space::TIP);
        ui.bold(word.name());
        ui.label(word.means());
    })
}

/// Rows of text stand close together; rows of controls need room.
pub(crate) fn dense(ui: &mut Ui) {
    ui.spacing_mut().interact_size.y = 16.0;
    ui.spacing_mut().item_spacing.y = 3.0;
}

/// What is said about what the pointer is on.
pub(crate) fn facts(ui: &mut Ui, (title, lines): &(String, Vec<(String, String)>)) {
    ui.set_width(220.0);
    dense(ui);
    ui.bold(title);
    let small = FontId::proportional(size::SMALL);
    let styles = &mut ui.style_mut().text_styles;
    styles.insert(TextStyle::Body, small);
    for (name, value) in lines {
        ui.fact(name, value);
    }
}
