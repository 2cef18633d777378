//! The shell: takes what the tasks have brought, lays out the panels, executes their commands.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{CentralPanel, Context, Frame, Margin, Panel, Ui, ViewportCommand};

use super::commands::{Command, Workbench};
use super::tasks::{Runner, Tasks, What};
use super::tokens::{self, Palette, space};
use super::view::{Canvas, Sheet};
use super::{files, layers, panels};

/// The window's contents.
pub struct App {
    workbench: Workbench,
    theme: egui::ThemePreference,
    title: String,
}

impl App {
    /// Opens on a file, or on the bundled session.
    pub fn new(ctx: &Context, path: Option<PathBuf>, runner: Runner) -> Self {
        tokens::apply(ctx);
        let wake = ctx.clone();
        let tasks = Tasks::new(runner, Arc::new(move || wake.request_repaint()));
        let mut workbench = Workbench::new(files::first_example(), tasks);
        if let Some(path) = path {
            workbench.execute(Command::OpenFile(path));
        }
        Self {
            workbench,
            theme: egui::ThemePreference::System,
            title: String::new(),
        }
    }

    /// Draws what there is for each sample on the graphics processor, where there is one; without,
    /// egui draws it, thinned where it is much.
    #[must_use]
    pub fn drawn_by(mut self, state: Option<&egui_wgpu::RenderState>) -> Self {
        if let Some(state) = state {
            let canvas = layers::register(state);
            self.workbench.execute(Command::Canvas(canvas));
        }
        self
    }

    /// The same work for the window, of which nobody sees the result: to measure it without
    /// anything that draws.
    #[must_use]
    pub fn drawn_by_nobody(mut self) -> Self {
        let canvas = Canvas::Layers(usize::MAX);
        self.workbench.execute(Command::Canvas(canvas));
        self
    }

    /// Shows everything and does what was asked for.
    pub fn show(&mut self, ui: &mut Ui) {
        self.workbench.receive();
        let mut commands = panels::shortcuts::read(ui.ctx(), &self.workbench);
        self.lay_out(ui, &mut commands);
        let any = !commands.is_empty();
        for command in commands {
            self.workbench.execute(command);
        }
        self.keep_theme_and_title(ui.ctx());
        self.ask_before_leaving(ui.ctx());
        if self.workbench.receive() || any {
            ui.ctx().request_repaint();
        }
    }

    /// Opens the sheet in which the path of an export is typed, with this path in it: what the
    /// window does by itself where the system has no dialog.
    pub fn type_export_path(&mut self, path: &Path) {
        self.type_path(What::Table, path);
    }

    /// The same for the list of poses to measure next.
    pub fn type_list_path(&mut self, path: &Path) {
        self.type_path(What::Poses, path);
    }

    fn type_path(&mut self, what: What, path: &Path) {
        let sheet = Sheet::ExportPath {
            what,
            path: path.display().to_string(),
            replace: false,
        };
        self.workbench.execute(Command::Sheet(Some(sheet)));
    }

    fn lay_out(&self, ui: &mut Ui, commands: &mut Vec<Command>) {
        let workbench = &self.workbench;
        let palette = Palette::of(ui);
        let bar = |fill| {
            Frame::NONE
                .fill(fill)
                .inner_margin(Margin::symmetric(12, 4))
        };
        let side = |fill| {
            Frame::NONE
                .fill(fill)
                .inner_margin(Margin::same(space::PANEL))
        };
        Panel::top("menu")
            .exact_size(42.0)
            .resizable(false)
            .frame(bar(palette.surface))
            .show(ui, |ui| panels::menu::show(ui, workbench, commands));
        Panel::bottom("status")
            .exact_size(32.0)
            .resizable(false)
            .frame(bar(palette.surface))
            .show(ui, |ui| panels::status::show(ui, workbench, commands));
        Panel::left("steps")
            .exact_size(304.0)
            .resizable(false)
            .frame(side(palette.surface))
            .show(ui, |ui| panels::steps::show(ui, workbench, commands));
        Panel::right("results")
            .exact_size(344.0)
            .resizable(false)
            .frame(side(palette.background))
            .show(ui, |ui| panels::results::show(ui, workbench, commands));
        CentralPanel::no_frame()
            .frame(Frame::NONE.fill(palette.background))
            .show(ui, |ui| panels::stage::show(ui, workbench, commands));
        panels::sheets::show(ui, workbench, commands);
        panels::dropped::show(ui, commands);
    }

    fn ask_before_leaving(&mut self, ctx: &Context) {
        if self.workbench.view().leaving {
            ctx.send_viewport_cmd(ViewportCommand::Close);
        } else if ctx.input(|i| i.viewport().close_requested()) && self.workbench.unsaved() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.workbench.execute(Command::Sheet(Some(Sheet::Leave)));
        }
    }

    fn keep_theme_and_title(&mut self, ctx: &Context) {
        let theme = self.workbench.view().theme;
        if self.theme != theme {
            ctx.set_theme(theme);
            self.theme = theme;
        }
        let title = panels::menu::window_title(&self.workbench);
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }
}
