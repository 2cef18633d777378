//! What was done: it stands over the plots for a while and takes no room from them.

use egui::{Align2, Area, Button, CornerRadius, Frame, Id, Label, Margin, RichText, Role, Ui};
use egui::{WidgetInfo, vec2};

use crate::gui::style::tokens::{Palette, size, space, strong};
use crate::gui::view::Message;
use crate::gui::workbench::{Command, Workbench};

/// So long it stands unless the pointer is on it, seconds.
const STANDS_S: f64 = 12.0;
/// As wide as its lines may be, points.
const WIDTH: f32 = 360.0;

/// When the message that is shown came up, in the window's seconds.
#[derive(Clone, PartialEq)]
struct Shown {
    message: Message,
    since: f64,
}

pub(crate) fn show(ui: &Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(message) = workbench.view().message.as_ref().filter(|m| !m.wrong) else {
        return;
    };
    let ctx = ui.ctx();
    let id = Id::unique("toast");
    let now = ctx.input(|i| i.time);
    let before: Option<Shown> = ctx.data(|data| data.get_temp(id));
    let shown = before.filter(|shown| shown.message == *message);
    let mut shown = shown.unwrap_or_else(|| Shown {
        message: message.clone(),
        since: now,
    });
    let palette = Palette::of(ui);
    // Above the status bar, over the results: axes of charts are not covered by it.
    let area = Area::new(id).anchor(Align2::RIGHT_BOTTOM, vec2(-12.0, -44.0));
    let area = area.show(ctx, |ui| {
        let frame = Frame::popup(ui.style())
            .corner_radius(CornerRadius::same(space::ROUND + 2))
            .inner_margin(Margin::symmetric(14, 10));
        frame.show(ui, |ui| {
            ui.set_max_width(WIDTH);
            ui.spacing_mut().item_spacing.y = space::TIGHT;
            let title = RichText::new(&message.title).font(strong(size::BODY));
            let title = ui.add(Label::new(title).wrap());
            if let Some(file) = &message.file {
                title.on_hover_text(file.display().to_string());
            }
            for line in &message.details {
                let line = RichText::new(line).size(size::NOTE).color(palette.muted);
                ui.add(Label::new(line).wrap());
            }
            ui.horizontal(|ui| buttons(ui, message, commands));
        });
    });
    if area.response.contains_pointer() {
        shown.since = now;
    }
    let left = shown.since + STANDS_S - now;
    if left <= 0.0 {
        commands.push(Command::Dismiss);
    } else {
        ctx.request_repaint_after(std::time::Duration::from_secs_f64(left));
    }
    ctx.data_mut(|data| data.insert_temp(id, shown));
}

fn buttons(ui: &mut Ui, message: &Message, commands: &mut Vec<Command>) {
    if let Some(file) = &message.file {
        let name = file.file_name().unwrap_or(file.as_os_str());
        let name = name.to_string_lossy();
        for (text, in_folder) in [(say!("Open"), false), (say!("Show in folder"), true)] {
            let button = ui.add(Button::new(text));
            let says = format!("{text}: {name}");
            button.widget_info(|| WidgetInfo::labeled(Role::Button, true, &says));
            if button.clicked() {
                let path = file.clone();
                commands.push(Command::OpenOutside { path, in_folder });
            }
        }
    }
    if ui.button(say!("Dismiss")).clicked() {
        commands.push(Command::Dismiss);
    }
}
