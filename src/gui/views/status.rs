//! What the window says by itself: the bar at the bottom (where the work stands, what runs in the background), and
//! notices over the results, above the bar, so that no plot is moved when one appears or is dismissed.

use std::path::PathBuf;

use egui::{
    Align, Align2, Area, Button, CornerRadius, Frame, Id, Label, Layout, Margin, Modal, RichText,
    ScrollArea, Spinner, Ui, vec2,
};

use crate::diagnosis::FloorFrom;
use crate::present::numbers::grouped;

use crate::gui::core::disk::{FileChange, name_of};
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{Message, OnDisk};
use crate::gui::widgets::{self, Does, Forms};
use crate::gui::workbench::Workbench;

/// Where the work stands, in one line.
fn line(workbench: &Workbench) -> String {
    let loaded_session = workbench.loaded_session();
    if loaded_session.is_empty() {
        let open = say!("Open a session that was measured on this robot");
        return format!("{} · {open}", loaded_session.session.robot.name);
    }
    let units = workbench.units();
    let samples =
        say!(one "{count} sample", "{count} samples", count = grouped(loaded_session.len()));
    let unit = units.length_name();
    let mm = |mm: f64| units.length_number(mm);
    let gap = match (workbench.answer(), &loaded_session.gap_before) {
        (Some(answer), _) => {
            let gap = &answer.identification.gap;
            let mut gaps = vec![gap.before.rms_mm];
            // What the identification left, where effects were added to it since.
            let added = workbench.document().in_the_model().next().is_some();
            let searched = workbench.diagnosis().filter(|_| added);
            gaps.extend(searched.map(|d| d.gap.identified_mm));
            gaps.push(gap.after.rms_mm);
            let gaps: Vec<String> = gaps.into_iter().map(mm).collect();
            let gaps = say!("RMS error {gaps} {unit}", gaps = gaps.join(" → "), unit);
            // The model promises more than a table of joint commands keeps.
            let table = workbench
                .left_by_table_mm()
                .map(|left| say!("with the table {left} {unit}", left = mm(left), unit));
            table.map_or(gaps.clone(), |table| format!("{gaps} · {table}"))
        }
        (None, Some(gap)) => say!("RMS error {gaps} {unit}", gaps = mm(gap.rms_mm), unit),
        (None, None) => say!("no sample can be used").to_owned(),
    };
    let floor = match (workbench.diagnosis(), loaded_session.coverage.floor_mm) {
        (Some(d), _) => Some((d.floor.mm, d.floor.from)),
        (None, floor_mm) => floor_mm.map(|mm| (mm, FloorFrom::Instrument)),
    };
    let floor = floor.map_or_else(String::new, |(floor_mm, from)| {
        // Shorter than elsewhere: the line has to fit.
        let from = match from {
            FloorFrom::Repeats => say!("repeats"),
            FloorFrom::Instrument => say!("instrument"),
            FloorFrom::Estimated => say!("estimated"),
        };
        let floor = say!(
            "floor {floor} {unit} ({from})",
            floor = mm(floor_mm),
            unit,
            from
        );
        format!(" · {floor}")
    });
    format!("{samples} · {gap}{floor}")
}

/// What there is to say while nothing runs.
fn idle(ui: &mut Ui, workbench: &Workbench) {
    if workbench.is_declined() {
        ui.small_button(say!("Identify"))
            .does(workbench, move |bench| bench.identify(None));
        let says = RichText::new(say!("the identification was cancelled")).size(size::NOTE);
        ui.colored_label(Palette::of(ui).warning, says);
    }
}

/// Room for what runs in the background, points.
const BUSY: f32 = 420.0;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let palette = Palette::of(ui);
    ui.horizontal_centered(|ui| {
        let status = line(workbench);
        // What runs has its place at the right whatever is said at the left.
        let busy = workbench.jobs.newest().is_some();
        let room = ui.available_width() - if busy { BUSY } else { 0.0 };
        let line = egui::Label::new(RichText::new(&status).size(size::NOTE)).truncate();
        let high = ui.available_height();
        let left = Layout::left_to_right(Align::Center);
        ui.allocate_ui_with_layout(egui::vec2(room, high), left, |ui| ui.add(line));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let Some(task) = workbench.jobs.newest() else {
                return idle(ui, workbench);
            };
            ui.small_button(say!("Cancel"))
                .does(workbench, Workbench::cancel_newest);
            let what = RichText::new(task.describe());
            ui.label(what.size(size::NOTE).color(palette.muted));
            match task.progress() {
                Some(part) => {
                    let bar = egui::ProgressBar::new(part).desired_width(120.0);
                    ui.add(bar.desired_height(8.0).fill(palette.accent));
                    widgets::look_again_soon(ui);
                }
                None => drop(ui.add(Spinner::new().size(14.0).color(palette.accent))),
            }
        });
    });
}

/// So long what was done is said unless the pointer is on it, seconds. What went wrong stays.
const STANDS_S: f64 = 12.0;
/// As wide as lines may be, and at least, points.
const WIDTH: [f32; 2] = [232.0, 400.0];
/// Between a notice and the window's edge, points, and between it and its words.
const EDGE: f32 = 12.0;
const INSIDE: Margin = Margin::symmetric(14, 10);
/// The status bar, points.
const STATUS: f32 = 32.0;
/// It takes this part of the window's height at most; what is longer scrolls.
const MOST: f32 = 0.3;

/// The message that is shown, and when it came up, in the window's seconds.
type Shown = (Message, f64);

/// What lies over the window by itself: notices (a file that changed on the disk, an error, a task that
/// is done) and what becomes of files that are dropped on it. Notices lie over the results, above the
/// status bar, so that no plot is moved when one appears or is dismissed.
pub(crate) fn notices(ui: &Ui, workbench: &Workbench, room: widgets::Layout) {
    let (message, on_disk) = (&workbench.view.message, workbench.on_disk());
    if message.is_none() {
        // The same may be said again: it stands as long as the first time.
        ui.data_mut(|data| data.remove::<Shown>(Id::unique("notice")));
    }
    if message.is_none() && on_disk.is_none() {
        return;
    }
    let ctx = ui.ctx();
    // As wide as the results, so that no axis of a chart is below it.
    let wide = room.right.unwrap_or(WIDTH[1]) - 2.0 * EDGE - INSIDE.sum().x;
    let wide = wide.clamp(WIDTH[0], WIDTH[1]);
    let high = MOST * ctx.content_rect().height();
    let area = Area::new(Id::unique("notices"));
    let area = area.anchor(Align2::RIGHT_BOTTOM, vec2(-EDGE, -STATUS - EDGE));
    let area = area.show(ctx, |ui| {
        ui.spacing_mut().item_spacing.y = space::ROW;
        let card = Frame::popup(ui.style())
            .corner_radius(CornerRadius::same(space::ROUND + 2))
            .inner_margin(INSIDE);
        if let Some(on_disk) = on_disk {
            card.show(ui, |ui| {
                ui.set_width(wide);
                file_that_changed(ui, workbench, on_disk);
            });
        }
        if let Some(message) = message {
            card.show(ui, |ui| {
                ui.set_width(wide);
                ui.spacing_mut().item_spacing.y = space::TIGHT;
                // What is long scrolls; its buttons stay in sight.
                let scroll = ScrollArea::vertical().max_height(high);
                scroll.show(ui, |ui| body(ui, message));
                ui.horizontal_wrapped(|ui| buttons(ui, message, workbench));
            });
        }
    });
    if let Some(done) = message.as_ref().filter(|message| !message.wrong) {
        let pointed = area.response.contains_pointer();
        goes_by_itself(ui, done, pointed, workbench);
    }
}

/// What was done is not said for ever.
fn goes_by_itself(ui: &Ui, message: &Message, pointed: bool, workbench: &Workbench) {
    let (ctx, id) = (ui.ctx(), Id::unique("notice"));
    let now = ctx.input(|i| i.time);
    let before: Option<Shown> = ctx.data(|data| data.get_temp(id));
    let shown = before.filter(|(shown, _)| shown == message && !pointed);
    let since = shown.map_or(now, |(_, since)| since);
    let left = since + STANDS_S - now;
    if left <= 0.0 {
        workbench.then(move |bench| bench.view.message = None);
    } else {
        ctx.request_repaint_after(std::time::Duration::from_secs_f64(left));
    }
    ctx.data_mut(|data| data.insert_temp(id, (message.clone(), since)));
}

fn body(ui: &mut Ui, message: &Message) {
    let palette = Palette::of(ui);
    let (title, lines) = if message.wrong {
        (palette.outside, palette.text)
    } else {
        (palette.text, palette.muted)
    };
    let title = RichText::new(&message.title)
        .font(strong(size::BODY))
        .color(title);
    let title = ui.add(Label::new(title).wrap());
    if let Some(file) = &message.file {
        title.on_hover_text(file.display().to_string());
    }
    for line in &message.details {
        let line = RichText::new(line).size(size::NOTE).color(lines);
        ui.add(Label::new(line).wrap());
    }
}

fn buttons(ui: &mut Ui, message: &Message, workbench: &Workbench) {
    if let Some(file) = &message.file {
        let name = name_of(file);
        let folder = file.parent().unwrap_or(file);
        for (text, path) in [(say!("Open"), &**file), (say!("Show in folder"), folder)] {
            let (button, path) = (Button::new(text), path.to_path_buf());
            ui.named(format!("{text}: {name}"), button)
                .does(workbench, move |bench| bench.open_outside(path));
        }
    }
    ui.button(say!("Dismiss"))
        .does(workbench, move |bench| bench.view.message = None);
}

/// An open file that is not what it was: said until the user decides.
fn file_that_changed(ui: &mut Ui, workbench: &Workbench, on_disk: &OnDisk) {
    let name = name_of(&on_disk.path);
    let (title, says) = match on_disk.change {
        FileChange::Changed => (
            say!("{name} was changed by another program", name),
            say!(
                "Reload reads it again; undo brings back what is here now. If you keep this version, you will be asked before overwriting"
            ),
        ),
        FileChange::Vanished => (
            say!("{name}: file not found", name),
            say!("What was read is here still: saving writes it again, or put the file back"),
        ),
    };
    let title = RichText::new(title).font(strong(size::BODY));
    ui.add(Label::new(title.color(Palette::of(ui).warning)).wrap());
    ui.add(Label::new(RichText::new(says).size(size::NOTE)).wrap());
    ui.horizontal_wrapped(|ui| {
        match on_disk.change {
            FileChange::Changed => ui.button(say!("Reload")).does(workbench, Workbench::reload),
            FileChange::Vanished => ui
                .button(say!("Save it again"))
                .does(workbench, Workbench::save),
        }
        ui.button(say!("Keep this version"))
            .does(workbench, Workbench::keep_mine);
    });
}

/// Opens what was dropped, and says so while it is held over the window.
pub(crate) fn dropped(ui: &Ui, workbench: &Workbench) {
    let (held, paths) = ui.input(|input| {
        let files = input.raw.dropped_files.iter();
        let paths: Vec<PathBuf> = files.map(|file| file.path().to_path_buf()).collect();
        (!input.raw.hovered_files.is_empty(), paths)
    });
    if !paths.is_empty() {
        workbench.then(move |bench| bench.drop_files(paths));
    }
    if held {
        let sheet = Modal::new(Id::unique("dropped")).backdrop_color(Palette::of(ui).veil);
        sheet.show(ui.ctx(), |ui| ui.heading(say!("Drop the file to open it")));
    }
}
