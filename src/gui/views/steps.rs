//! The left-hand side: the list of steps, the controls of the chosen one, and what to do next; and what
//! both sides of the window are pulled by.

use egui::{
    Color32, CornerRadius, Panel, Response, Role, Sense, Stroke, Ui, UiBuilder, Vec2, WidgetInfo,
    pos2, vec2,
};

use crate::gui::style::Layout;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::Step;
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;

use super::{export, gap, regions, results, session};

type Show = fn(&mut Ui, &Workbench);
type State = fn(&Workbench) -> (String, bool);

/// A step of the work: its controls, the button at the foot; what it has to show for itself, and whether it is done.
fn of(step: Step) -> (Show, Show, State) {
    match step {
        Step::Session => (session::show, session::next, session::state),
        Step::Regions => (regions::show, regions::next, regions::state),
        Step::Identify => (results::controls, results::next, results::state),
        Step::Gap => (gap::show, gap::next, gap::state),
        Step::Export => (export::show, export::next, export::state),
    }
}

/// The button at the foot stands no lower than this below the top of its panel, points.
const HIGHEST: f32 = 960.0;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, room: Layout) {
    // On a high screen the button at the foot would be far from what it belongs to.
    let mut rect = ui.available_rect_before_wrap();
    rect.set_height(rect.height().min(HIGHEST));
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        all(ui, workbench, room);
    });
}

fn all(ui: &mut Ui, workbench: &Workbench, room: Layout) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let now = workbench.view.step;
    let (show, next, _) = of(now);
    for (index, step) in workbench.steps().iter().copied().enumerate() {
        let (_, _, state) = of(step);
        let (caption, done) = state(workbench);
        let selected = now == step;
        let row = StepRow {
            number: index + 1,
            name: step.name(),
            caption: &caption,
            done,
            selected,
            low: room.low,
        };
        let row = row.show(ui);
        row.does(workbench, move |bench| bench.view.step = step);
    }
    ui.spacing_mut().item_spacing.y = space::ROW;
    ui.add_space(space::ROW);
    ui.separator();
    let frame = egui::Frame::NONE.inner_margin(egui::Margin::ZERO);
    Panel::bottom("next")
        .resizable(false)
        .show_separator_line(false)
        .frame(frame)
        .show(ui, |ui| {
            ui.add_space(space::ROW);
            next(ui, workbench);
        });
    widgets::scroll(ui, ("controls", now.name()), |ui| {
        show(ui, workbench);
    });
}

/// A step in the list of steps.
#[derive(Debug, Clone, Copy)]
struct StepRow<'a> {
    number: usize,
    name: &'a str,
    /// What it has to show.
    caption: &'a str,
    /// Whether there is something to show for it.
    done: bool,
    /// Whether it is the one that is worked on.
    selected: bool,
    /// Whether name and caption share one line.
    low: bool,
}

impl StepRow<'_> {
    fn show(self, ui: &mut Ui) -> Response {
        let palette = Palette::of(ui);
        let height = if self.low { 30.0 } else { 44.0 };
        let room = vec2(ui.available_width(), height);
        let (rect, response) = ui.allocate_exact_size(room, Sense::click());
        let enabled = ui.is_enabled();
        let says = format!("{} {}", self.number, self.name);
        response.widget_info(|| WidgetInfo::selected(Role::Tab, enabled, self.selected, &says));
        let painter = ui.painter();
        let round = CornerRadius::same(space::ROUND);
        if self.selected {
            painter.rect_filled(rect, round, palette.accent_soft);
        } else if response.hovered() {
            painter.rect_filled(rect, round, palette.inset);
        }
        self.badge(painter, palette, pos2(rect.left() + 22.0, rect.center().y));
        let name_color = if self.selected {
            palette.accent
        } else {
            palette.text
        };
        let middle = rect.center().y;
        let left = rect.left() + 44.0;
        let cut = |text: &str, font: egui::FontId, color: Color32, width: f32| {
            let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, color);
            job.wrap.max_width = width;
            job.wrap.max_rows = 1;
            job.wrap.break_anywhere = true;
            painter.layout_job(job)
        };
        let width = rect.right() - left - space::ROW;
        let name = cut(self.name, strong(size::BODY), name_color, width);
        let beside = if self.low { name.size().x + 12.0 } else { 0.0 };
        let small = egui::FontId::proportional(size::SMALL);
        let fits = |text: &str| cut(text, small.clone(), palette.muted, width - beside);
        let whole = fits(self.caption);
        let shortened = whole.elided;
        // "full model, 44 parameters" beside a name: what it ends with says more than its beginning.
        let end = self.caption.rsplit([',', '，']).next().map(str::trim);
        let caption = end.filter(|_| shortened).map_or(whole, fits);
        let place = |galley: &egui::Galley, x: f32, y: f32| pos2(x, y - 0.5 * galley.size().y);
        let (name_y, caption_at) = if self.low {
            let x = rect.right() - space::ROW - caption.size().x;
            (middle, place(&caption, x, middle))
        } else {
            (middle - 8.0, place(&caption, left, middle + 9.0))
        };
        let name_at = place(&name, left, name_y);
        painter.galley(name_at, name, name_color);
        painter.galley(caption_at, caption, palette.muted);
        if shortened {
            response.on_hover_text(self.caption)
        } else {
            response
        }
    }

    /// Its number, or a tick.
    fn badge(self, painter: &egui::Painter, palette: Palette, centre: egui::Pos2) {
        let done = self.done;
        let (fill, edge, text) = match (done, self.selected) {
            (true, _) => (palette.accent, palette.accent, palette.on_accent),
            (false, true) => (palette.surface, palette.accent, palette.accent),
            (false, false) => (palette.surface, palette.nominal, palette.muted),
        };
        painter.circle(centre, 11.0, fill, Stroke::new(1.5, edge));
        if done {
            let at = |x: f32, y: f32| centre + Vec2::new(x, y);
            let tick = vec![at(-4.5, 0.2), at(-1.3, 3.6), at(4.8, -3.6)];
            painter.line(tick, Stroke::new(2.0, text));
        } else {
            let middle = egui::Align2::CENTER_CENTER;
            painter.text(centre, middle, self.number, strong(size::SMALL), text);
        }
    }
}
