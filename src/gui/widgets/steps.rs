//! The list of steps.

use egui::{
    Color32, CornerRadius, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use crate::gui::style::tokens::{Palette, size, space, strong};

/// How far a step has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Progress {
    /// Nothing to show for it yet.
    Open,
    Done,
}

impl Progress {
    pub(crate) fn of(done: bool) -> Self {
        if done { Self::Done } else { Self::Open }
    }
}

/// A step in the list of steps.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepRow<'a> {
    pub(crate) number: usize,
    pub(crate) name: &'a str,
    /// What it has to show.
    pub(crate) caption: &'a str,
    /// How far it has come.
    pub(crate) progress: Progress,
    /// Whether it is the one that is worked on.
    pub(crate) selected: bool,
    /// Whether name and caption share one line.
    pub(crate) low: bool,
}

impl StepRow<'_> {
    pub(crate) fn show(self, ui: &mut Ui) -> Response {
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
        let done = self.progress == Progress::Done;
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
