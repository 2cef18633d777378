//! The shell: takes what the tasks have brought, lays out the panels, executes their commands.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

use egui::style::NumberFormatter;
use egui::{CentralPanel, ColorImage, Context, Frame, Margin, Panel, Rangef, Ui, ViewportCommand};

use super::view::{NextAction, Preferences, Theme, largest_zoom};
use super::{actions, dialogs, files, layers, widgets, workspace};
use crate::gui::jobs::{Jobs, Runner};
use crate::gui::style::{self, Palette, space};
use crate::gui::views::{chart, menu, status, steps};
use crate::gui::widgets::{LEFT, MIDDLE, RIGHT, WIDEST};
use crate::gui::workbench::Workbench;
use crate::present::numbers::{notation, write_numbers};
use crate::text::Language;

/// The window's contents.
pub struct App {
    workbench: Workbench,
    /// What is opened in the first frame: by then it is known which language the window speaks.
    first: Option<PathBuf>,
    theme: Theme,
    /// The size of text as it was set last: that which is wanted, or what the window has room for.
    zoom: f32,
    /// The language where none is preferred.
    language: Language,
    title: String,
    /// Where a picture of the window arrives that was asked for.
    picture: Option<Receiver<Arc<ColorImage>>>,
}

/// So much memory stays with the program between frames, bytes; the meshes of a full window take a tenth of it.
const KEPT: usize = 8 << 20;

/// A frame takes memory for its meshes and frees it again. glibc gives that back to the system each time, and half of
/// the next frame goes into getting pages anew, until it has once seen a larger block freed
/// (`M_MMAP_THRESHOLD` in mallopt(3)): here is one. Nothing is written to it, so that it costs no memory.
fn keep_memory_between_frames() {
    drop(std::hint::black_box(Vec::<u8>::with_capacity(KEPT)));
}

impl App {
    /// Opens on a file, or on the bundled session.
    pub fn new(ctx: &Context, path: Option<PathBuf>, runner: Runner) -> Self {
        keep_memory_between_frames();
        style::apply(ctx);
        // A foot or a bar of another height moves a plot, and that its axes.
        ctx.options_mut(|options| options.max_passes = NonZeroUsize::MIN.saturating_add(2));
        write_fields(ctx);
        let wake = ctx.clone();
        let jobs = Jobs::new(runner, Arc::new(move || wake.request_repaint()));
        let workbench = Workbench::new(files::first_example(), jobs);
        Self {
            first: path,
            ..Self::on(workbench)
        }
    }

    /// On a workbench that is there already.
    pub(crate) fn on(workbench: Workbench) -> Self {
        Self {
            workbench,
            first: None,
            theme: Theme::default(),
            zoom: 1.0,
            language: Language::English,
            title: String::new(),
            picture: None,
        }
    }

    /// Draws samples on the graphics processor. Without one they are laid out, and nothing of them is seen: so the window
    /// is tested and measured.
    #[must_use]
    pub fn drawn_by(self, state: Option<&egui_wgpu::RenderState>) -> Self {
        if let Some(state) = state {
            layers::gpu::Drawer::register(state);
        }
        self
    }

    /// Takes this for the answer of every dialog of the system; `None` is one that was cancelled.
    #[must_use]
    pub fn choosing(mut self, chooser: Arc<dyn Fn() -> Option<PathBuf> + Send + Sync>) -> Self {
        self.workbench.chooser = Some(chooser);
        self
    }

    /// Keeps preferences, recent files and what is not saved in this folder, and offers what it
    /// holds from before. Without a folder nothing outlives the window.
    #[must_use]
    pub fn at_home(mut self, folder: Option<PathBuf>) -> Self {
        if let Some(folder) = folder {
            self.workbench.at_home(folder);
        }
        self
    }

    /// Proposes this date for reports; none unless it is said.
    #[must_use]
    pub fn on_day(mut self, date: Option<String>) -> Self {
        self.workbench.file_state.today = date;
        self
    }

    /// Speaks this language where none is preferred; English unless it is said.
    #[must_use]
    pub fn speaking(mut self, language: Language) -> Self {
        self.language = language;
        self
    }

    /// Shows everything and does what was asked for.
    pub fn show(&mut self, ui: &mut Ui) {
        self.speak();
        let units = self.workbench.units();
        let _units = crate::text::InUnits::begin((units.length, units.angle));
        if let Some(path) = self.first.take() {
            self.workbench.execute(|bench| bench.open_file(path));
        }
        self.workbench.receive();
        self.keep_preferences(ui.ctx());
        self.workbench.keep_drawing();
        self.workbench.keep_recovery();
        // Coming back to the window from another program.
        if ui.input(|i| i.events.contains(&egui::Event::WindowFocused(true))) {
            self.workbench.execute(Workbench::look_at_disk);
        }
        widgets::read_next(ui.ctx());
        actions::read(ui.ctx(), &self.workbench);
        // Asked for in the frame before, whose sheet is closed by now.
        self.keep_picture(ui.ctx());
        self.lay_out(ui);
        widgets::lay_out_again(ui.ctx());
        self.workbench.drag(ui.ctx().dragged_id().is_some());
        let any = self.workbench.make_changes();
        self.keep_title(ui.ctx());
        self.ask_before_leaving(ui.ctx());
        if self.workbench.receive() || any {
            ui.ctx().request_repaint();
        }
    }

    /// Chooses the language for this frame.
    fn speak(&self) {
        let preferred = self.workbench.view.preferences.language;
        crate::text::choose(preferred.unwrap_or(self.language));
        crate::text::name_by_titles(true);
    }

    /// Corrects the targets of a file, as if it had been chosen.
    pub fn compensate(&mut self, path: &Path) {
        let path = path.to_path_buf();
        self.workbench.execute(|bench| bench.compensate_file(path));
    }

    /// Opens the sheet in which the path of an export is typed, with this path in it: what the
    /// window does by itself where the system has no dialog. The export is `table`, `model`, `poses`,
    /// `report`, `report of the model` or `targets`; for a picture the name of a plot, such as
    /// `workspace`; `data of` a chart for its numbers. Another name does nothing.
    pub fn type_path(&mut self, export: &str, path: &Path) {
        if let Some(what) = Workbench::export_named(export) {
            self.workbench.execute(|bench| bench.type_path(what, path));
        }
    }

    fn lay_out(&mut self, ui: &mut Ui) {
        let workbench = &self.workbench;
        let palette = Palette::of(ui);
        let frame = |fill, margin| Frame::NONE.fill(fill).inner_margin(margin);
        let bar = |fill| frame(fill, Margin::symmetric(12, 4));
        let side = |fill| frame(fill, Margin::same(space::PANEL));
        let fixed = |panel: Panel, size: f32, frame: Frame| {
            panel.exact_size(size).resizable(false).frame(frame)
        };
        fixed(Panel::top("menu"), 42.0, bar(palette.surface))
            .show(ui, |ui| menu::show(ui, workbench));
        fixed(Panel::bottom("status"), 32.0, bar(palette.surface))
            .show(ui, |ui| status::show(ui, workbench));
        let room = actions::layout(ui.ctx(), workbench);
        // Either can be pulled as long as the plots keep their room.
        let window = ui.ctx().content_rect().width();
        let pulled = |panel: Panel, [least, size]: [f32; 2], others: f32, fill| {
            let most = (window - MIDDLE - others).clamp(size, WIDEST.max(size));
            let range = Rangef::new(least.min(size), most);
            panel.default_size(size).size_range(range).frame(side(fill))
        };
        let right = room.right.map_or(0.0, |_| RIGHT);
        let left = pulled(
            Panel::left(format!("steps {}", room.left)),
            [LEFT, room.left],
            right,
            palette.surface,
        );
        let left = left.show(ui, |ui| steps::show(ui, workbench));
        let results = |ui: &mut Ui| steps::results(ui, workbench);
        if let Some(width) = room.right {
            let left = left.response.rect.width();
            pulled(
                Panel::right(format!("results {width}")),
                [RIGHT, width],
                left,
                palette.background,
            )
            .show(ui, |ui| results(ui));
        }
        CentralPanel::no_frame()
            .frame(Frame::NONE.fill(palette.background))
            .show(ui, |ui| {
                if room.instead {
                    side(palette.background).show(ui, |ui| results(ui));
                } else {
                    chart::middle(ui, workbench);
                }
            });
        status::notices(ui, workbench, room);
        dialogs::show(ui, &mut self.workbench);
        let workbench = &self.workbench;
        dialogs::asking(ui, workbench);
        status::dropped(ui, workbench);
        widgets::focus_ring(ui.ctx());
    }

    /// Takes a picture of the window where the workspace is to be saved.
    fn keep_picture(&mut self, ctx: &Context) {
        let taken = self.picture.as_ref().and_then(|seen| seen.try_recv().ok());
        if let Some(window) = taken {
            self.picture = None;
            let image = workspace::in_picture(ctx, &window);
            self.workbench.take_picture(image);
            ctx.request_repaint();
        } else if self.workbench.wants_picture() {
            let ((sender, receiver), wake) = (channel(), ctx.clone());
            self.picture = Some(receiver);
            ctx.request_screenshot(move |image| {
                // The window may be gone already.
                let _ = sender.send(image);
                wake.request_repaint();
            });
            ctx.request_repaint();
        }
    }

    fn ask_before_leaving(&mut self, ctx: &Context) {
        if self.workbench.view.leaving {
            self.workbench.tidy();
            ctx.send_viewport_cmd(ViewportCommand::Close);
        } else if ctx.input(|i| i.viewport().close_requested()) {
            if self.workbench.asking().is_some() {
                ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            } else if self.workbench.at_risk().any() || self.workbench.writing().is_some() {
                ctx.send_viewport_cmd(ViewportCommand::CancelClose);
                self.workbench
                    .execute(|bench| bench.ask_then(NextAction::Leave));
            } else {
                self.workbench.tidy();
            }
        }
    }

    /// Shows numbers, colours and text as the user wants them, and notices where egui's own keys
    /// have changed the size of text.
    fn keep_preferences(&mut self, ctx: &Context) {
        let wanted = self.workbench.view.preferences;
        write_numbers(wanted.notation());
        let (zoom, largest) = (ctx.zoom_factor(), largest_zoom(ctx));
        if (zoom - self.zoom).abs() > 1e-3 {
            let zoom = zoom.min(largest);
            let preferences = Preferences { zoom, ..wanted };
            self.workbench.execute(|bench| bench.prefer(preferences));
        }
        self.zoom = self.workbench.view.preferences.zoom.min(largest);
        ctx.set_zoom_factor(self.zoom);
        if wanted.theme != self.theme {
            self.theme = wanted.theme;
            ctx.set_theme(wanted.theme.preference());
            // What has begun to be drawn has the colours of before.
            ctx.request_discard("another theme");
        }
    }

    fn keep_title(&mut self, ctx: &Context) {
        let title = menu::window_title(&self.workbench);
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }
}

/// Numbers in fields have a real minus sign, and the decimal sign that the user wants.
fn write_fields(ctx: &Context) {
    ctx.all_styles_mut(|style| {
        style.number_formatter = NumberFormatter::new(|value, decimals| {
            let text = egui::emath::format_with_decimals_in_range(value, decimals);
            let is_zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
            let text = text.replace('-', if is_zero { "" } else { "−" });
            if notation().comma {
                text.replace('.', ",")
            } else {
                text
            }
        });
    });
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }

    /// Where plots were moved to, how far lists were scrolled: that belongs to one session at one
    /// time. What outlives the window is kept in `keeping`.
    fn persist_egui_memory(&self) -> bool {
        false
    }
}

#[cfg(any(test, debug_assertions))]
impl App {
    pub(crate) fn bench(&mut self) -> &mut Workbench {
        &mut self.workbench
    }
}
