//! What can be done by a key or from a menu: one table for what the keys do, what the menus offer and
//! what the help lists.

use crate::gui::files;
use crate::gui::view::{About, NextAction, Plane, Sheet, Step, What};

use crate::text::{capital, within};
use egui::{Button, Context, Key, KeyboardShortcut, Modifiers, Response, Role, Ui, WidgetInfo};

use crate::gui::core::disk::EXAMPLES;
use crate::gui::core::simulate::Form;
use crate::gui::widgets::{Buttons, Does, Layout, dots};
use crate::gui::workbench::Workbench;

fn looks_at(now: &Workbench, plane: Plane) -> bool {
    now.view.plane == plane && !now.view.in_space
}

/// Something that can be done.
#[derive(Clone, Copy)]
pub(crate) struct Action {
    keys: KeyboardShortcut,

    /// What the menu says.
    label: fn(&Workbench) -> String,
    /// Whether it can be done now.
    enabled: fn(&Workbench) -> bool,
    /// One of several ways to look: whether it is this.
    on: Option<fn(&Workbench) -> bool>,
    does: fn(&mut Workbench, &Context),
}

impl Action {
    const fn new(
        modifiers: Modifiers,
        key: Key,
        label: fn(&Workbench) -> String,
        does: fn(&mut Workbench, &Context),
    ) -> Self {
        Self {
            keys: KeyboardShortcut::new(modifiers, key),
            label,
            enabled: |_| true,
            on: None,
            does,
        }
    }

    const fn when(self, enabled: fn(&Workbench) -> bool) -> Self {
        Self { enabled, ..self }
    }

    const fn on(self, on: fn(&Workbench) -> bool) -> Self {
        Self {
            on: Some(on),
            ..self
        }
    }

    pub(crate) fn label(&self, now: &Workbench) -> String {
        (self.label)(now)
    }

    fn ask_for(&self, ctx: &Context, now: &Workbench) {
        let (does, ctx) = (self.does, ctx.clone());
        now.then(move |bench| does(bench, &ctx));
    }

    /// Itself in a menu.
    pub(crate) fn item(&self, ui: &mut Ui, workbench: &Workbench) -> Response {
        let name = self.label(workbench);
        let button = match self.on {
            Some(on) => Button::selectable(on(workbench), &name),
            None => Button::new(&name),
        };
        let button = button.shortcut_text(self.keys(ui.ctx()));
        let response = item(ui, button, &name, (self.enabled)(workbench));
        if response.clicked() {
            self.ask_for(ui.ctx(), workbench);
            ui.close();
        }
        response
    }

    /// Itself as a button in a panel.
    pub(crate) fn button(&self, ui: &mut Ui, workbench: &Workbench) {
        if ui.secondary(&self.label(workbench)).clicked() {
            self.ask_for(ui.ctx(), workbench);
        }
    }

    /// Itself as a sign.
    pub(crate) fn sign(&self, ui: &mut Ui, workbench: &Workbench, sign: &str) {
        let says = self.label(workbench);
        let enabled = (self.enabled)(workbench);
        let button = ui.add_enabled_ui(enabled, |ui| ui.icon_button(sign, &says));
        let button = button.inner.on_hover_text(&says);
        if button.on_disabled_hover_text(&says).clicked() {
            self.ask_for(ui.ctx(), workbench);
        }
    }

    /// Itself as what comes next.
    pub(crate) fn next(&self, ui: &mut Ui, workbench: &Workbench) {
        let button = |ui: &mut Ui| ui.primary(&self.label(workbench)).clicked();
        if ui.add_enabled_ui((self.enabled)(workbench), button).inner {
            self.ask_for(ui.ctx(), workbench);
        }
    }

    /// Its keys as a menu shows them.
    pub(crate) fn keys(&self, ctx: &Context) -> String {
        in_words(ctx, self.keys)
    }
}

const PLAIN: Modifiers = Modifiers::NONE;
const COMMAND: Modifiers = Modifiers::COMMAND;
const ALT: Modifiers = Modifiers::COMMAND.plus(Modifiers::ALT);
const SHIFTED: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

fn measured(now: &Workbench) -> bool {
    !now.loaded_session().is_empty()
}

fn answered(now: &Workbench) -> bool {
    now.answer().is_some()
}

/// A table of actions, row by row: name, keys, help, label in the menu, command, and what else there
/// is to say of it.
macro_rules! actions {
    ($($name:ident: $modifiers:expr, $key:ident, $label:expr, $command:expr $(, [$more:ident($of:expr)])*;)*) => {
        $(pub(crate) const $name: Action =
            Action::new($modifiers, Key::$key, $label, $command)$(.$more($of))*;)*
        /// All of them; where the keys of one contain another's, the longer stand first.
        pub(crate) const ALL: &[Action] = &[$($name),*];
    };
}

actions! {
    REDO: SHIFTED, Z, |now| now.redoes().map_or_else(|| say!("Redo").into(), |edit| say!("Redo {edit}", edit)), |bench, _| bench.redo(),
        [when(|now| now.redoes().is_some())];
    UNDO: COMMAND, Z, |now| now.undoes().map_or_else(|| say!("Undo").into(), |edit| say!("Undo {edit}", edit)), |bench, _| bench.undo(),
        [when(|now| now.undoes().is_some())];
    OPEN: COMMAND, O, |_| dots(say!("Open")), |bench, _| bench.choose_file(files::choose_to_open);
    IMPORT: SHIFTED, I, |_| dots(say!("Import")),
        |bench, _| bench.choose_file(files::choose_to_import);
    EXAMPLE_1: PLAIN, F2, |_| EXAMPLES[0].name().into(), |bench, _| bench.ask_then(NextAction::Example(0));
    EXAMPLE_2: PLAIN, F3, |_| EXAMPLES[1].name().into(), |bench, _| bench.ask_then(NextAction::Example(1));
    EXAMPLE_3: PLAIN, F4, |_| EXAMPLES[2].name().into(), |bench, _| bench.ask_then(NextAction::Example(2));
    EXAMPLE_4: PLAIN, F5, |_| EXAMPLES[3].name().into(), |bench, _| bench.ask_then(NextAction::Example(3));
    EXAMPLE_5: PLAIN, F7, |_| EXAMPLES[4].name().into(), |bench, _| bench.ask_then(NextAction::Example(4));
    ROBOTS: SHIFTED, N, |_| dots(say!("Robots")), |bench, _| bench.show_sheet(Some(Sheet::Robots));
    NEW: COMMAND, N, |_| say!("Simulate session…").into(),
        |bench, _| bench.show_sheet(Some(Sheet::Simulate(Form::default())));
    SAVE_AS: SHIFTED, S, |_| say!("Save session as…").into(),
        |bench, _| bench.choose_where_to_export(What::Session), [when(measured)];
    SAVE: COMMAND, S, |_| say!("Save session").into(), |bench, _| bench.save(), [when(measured)];
    SAVE_TO_PATH: SHIFTED, P, |_| say!("Save session to path…").into(),
        |bench, _| bench.type_path(What::Session, &bench.proposed_path()), [when(measured)];
    SAVE_MODEL: COMMAND, M, |_| dots(say!("Save model")),
        |bench, _| bench.choose_where_to_export(What::Model), [when(answered)];
    COMPENSATE: SHIFTED, T, |_| say!("Compensate targets…").into(),
        |bench, _| bench.choose_targets(), [when(answered)];
    SAVE_TABLE: COMMAND, T, |_| dots(say!("Save table")),
        |bench, _| bench.choose_where_to_export(What::Table), [when(answered)];
    REPORT: SHIFTED, R, |_| dots(say!("Report")),
        |bench, _| bench.choose_where_to_export(What::Report(About::Session)), [when(measured)];
    REPORT_DETAILS: ALT, R,
        |_| dots(say!("Report details")), |bench, _| bench.show_sheet(Some(Sheet::Details)), [when(measured)];
    RELOAD: COMMAND, R, |_| say!("Read the file again").into(),
        |bench, _| bench.reload(), [when(|now| now.file().is_some())];
    QUIT: COMMAND, Q, |_| say!("Quit").into(), |bench, _| bench.ask_then(NextAction::Leave);
    IDENTIFY: COMMAND, I, |_| say!("Identify").into(),
        |bench, _| bench.identify(None), [when(measured)];
    SEARCH: COMMAND, G, |_| say!("Run diagnosis").into(),
        |bench, _| bench.search(), [when(measured)];
    CANCEL: COMMAND, Period, |_| say!("Cancel what is running").into(), |bench, _| bench.cancel_newest(),
        [when(|now| now.jobs.newest().is_some())];
    EXCLUDE: PLAIN, Delete, exclude_says,
        |bench, _| {
            let (chosen, out) = (bench.view.chosen(), !are_excluded(bench));
            bench.edit(|document| document.exclude(&chosen, out));
        },
        [when(|now| !now.view.chosen().is_empty())];
    PREFERENCES: COMMAND, Comma, |_| dots(say!("Preferences")),
        |bench, _| bench.show_sheet(Some(Sheet::Preferences));
    RESULTS: COMMAND, B, |_| say!("Results").into(),
        |bench, ctx| bench.view.results = Some(!layout(ctx, bench).results());
    LOOK_XY: SHIFTED, Num1, |_| say!("Workspace from above").into(),
        |bench, _| bench.view.look_in(Plane::Xy), [on(|now| looks_at(now, Plane::Xy))];
    LOOK_XZ: SHIFTED, Num2, |_| say!("Workspace from the side").into(),
        |bench, _| bench.view.look_in(Plane::Xz), [on(|now| looks_at(now, Plane::Xz))];
    LOOK_YZ: SHIFTED, Num3, |_| say!("Workspace from the front").into(),
        |bench, _| bench.view.look_in(Plane::Yz), [on(|now| looks_at(now, Plane::Yz))];
    LOOK_AROUND: SHIFTED, Num4,
        |_| say!("Polar view").into(), |bench, _| bench.show_chart("polar"),
        [on(|now| now.shows("polar"))];
    LOOK_IN_SPACE: SHIFTED, Num5, |_| say!("Workspace in 3-D").into(),
        |bench, _| bench.view.look_in_space(), [on(|now| now.view.in_space)];
    FIT: COMMAND, F, |_| say!("Show everything in the plots").into(),
        |bench, _| bench.view.fit();
    FIT_TOO: PLAIN, Home, |_| String::new(), |bench, _| bench.view.fit();
    STEP_1: COMMAND, Num1, |now| step_name(now, 0), |bench, _| bench.go_to(0),
        [on(|now| now.steps().first() == Some(&now.view.step))];
    STEP_2: COMMAND, Num2, |now| step_name(now, 1), |bench, _| bench.go_to(1),
        [on(|now| now.steps().get(1) == Some(&now.view.step))];
    STEP_3: COMMAND, Num3, |now| step_name(now, 2), |bench, _| bench.go_to(2),
        [on(|now| now.steps().get(2) == Some(&now.view.step))];
    STEP_4: COMMAND, Num4, |now| step_name(now, 3), |bench, _| bench.go_to(3),
        [on(|now| now.steps().get(3) == Some(&now.view.step))];
    STEP_5: COMMAND, Num5, |now| step_name(now, 4), |bench, _| bench.go_to(4),
        [on(|now| now.steps().get(4) == Some(&now.view.step))];
    ABOUT: Modifiers::SHIFT, F1, |_| say!("About truepose").into(),
        |bench, _| bench.show_sheet(Some(Sheet::About));
    WORDS: PLAIN, F1, |_| say!("Glossary").into(), |bench, _| bench.show_sheet(Some(Sheet::Words));
}

/// The examples, in their order.
pub(crate) const OPEN_EXAMPLE: [Action; EXAMPLES.len()] =
    [EXAMPLE_1, EXAMPLE_2, EXAMPLE_3, EXAMPLE_4, EXAMPLE_5];

/// The steps, in their order; a robot without regions has no fifth.
pub(crate) const STEPS: [Action; 5] = [STEP_1, STEP_2, STEP_3, STEP_4, STEP_5];

fn step_name(workbench: &Workbench, index: usize) -> String {
    let step = workbench.steps().get(index);
    step.map_or("", |step| step.name()).to_owned()
}

fn are_excluded(workbench: &Workbench) -> bool {
    let samples = &workbench.loaded_session().session.samples;
    let chosen = workbench.view.chosen();
    chosen.iter().all(|sample| samples.is_excluded(*sample))
}

fn exclude_says(now: &Workbench) -> String {
    match now.view.chosen()[..] {
        [] => capital(say!("exclude samples")),
        ref all if are_excluded(now) => {
            say!(one "Include {count} sample again", "Include {count} samples again", count = all.len())
        }
        ref all => say!(one "Exclude {count} sample", "Exclude {count} samples", count = all.len()),
    }
}

/// The main button where the next step is the next thing.
pub(crate) fn go_on(ui: &mut Ui, workbench: &Workbench, step: Step) {
    let says = say!("Continue to {step}", step = within(step.name()));
    let on = ui.primary(&says);
    on.does(workbench, move |bench| bench.view.step = step);
}

/// Something in a menu: it goes by its name alone, without its keys.
pub(crate) fn item(ui: &mut Ui, button: Button<'_>, name: &str, enabled: bool) -> Response {
    let response = ui.add_enabled(enabled, button);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
    response
}

/// Keys as they stand on the keyboard.
pub(crate) fn in_words(ctx: &Context, keys: KeyboardShortcut) -> String {
    let text = ctx.format_shortcut(&keys);
    let signs = [
        ("Comma", ","),
        ("Period", "."),
        ("Plus", "+"),
        ("Minus", "−"),
    ];
    let write = |text: String, (name, sign): (&str, &str)| text.replace(name, sign);
    signs.into_iter().fold(text, write)
}

/// How the window is divided now.
pub(crate) fn layout(ctx: &Context, workbench: &Workbench) -> Layout {
    Layout::of(ctx.content_rect().width(), workbench.view.results)
}

/// Asks for what the keyboard does. Behind a sheet, and while text is typed, the keys belong to the text; behind a
/// dialog of the system no key is read.
pub(crate) fn read(ctx: &Context, workbench: &Workbench) {
    let covered = workbench.view.sheet.is_some() || workbench.asking().is_some();
    if covered || ctx.text_edit_focused() {
        return;
    }
    for action in ALL {
        // A key by itself may mean something to the control with the focus.
        let meant = action.keys.modifiers.any() || (action.enabled)(workbench);
        if meant && ctx.input_mut(|i| i.consume_shortcut(&action.keys)) {
            action.ask_for(ctx, workbench);
        }
    }
}
