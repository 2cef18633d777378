//! What can be done by a key or from a menu: one table for what the keys do, what the menus offer and
//! what the help lists.

use crate::gui::files;
use crate::gui::view::NextAction;
use crate::gui::view::Panes;
use crate::text::{Template, filled, spoken};
use egui::{Button, Context, Key, KeyboardShortcut, Modifiers, Response, Role, Ui, WidgetInfo};

use crate::gui::core::disk::EXAMPLES;
use crate::gui::core::simulate::Form;
use crate::gui::preferences::{Preferences, Theme};
use crate::gui::style::layout::Layout;
use crate::gui::view::{About, Edge, PaletteInput, Plane, Sheet, Standard, What};
use crate::gui::workbench::Workbench;

/// The window as it stands.
pub(crate) struct WindowState<'a> {
    ctx: Context,
    workbench: &'a Workbench,
}

impl<'a> WindowState<'a> {
    pub(crate) fn of(ctx: &Context, workbench: &'a Workbench) -> Self {
        let ctx = ctx.clone();
        Self { ctx, workbench }
    }

    fn preferences(&self) -> Preferences {
        self.workbench.view.preferences
    }

    fn looks_at(&self, plane: Plane) -> bool {
        let view = &self.workbench.view;
        view.plane == plane && !view.in_space()
    }

    fn sees_from(&self, from: Standard) -> bool {
        let view = &self.workbench.view;
        view.in_space() && view.camera.standard() == Some(from)
    }
}

fn dark(ctx: &Context) -> bool {
    ctx.global_style().visuals.dark_mode
}

/// What an action needs, and what to do where that is not there.
#[derive(Clone, Copy)]
struct Need {
    there: fn(&WindowState<'_>) -> bool,
    first: Template,
}

const fn need(there: fn(&WindowState<'_>) -> bool, first: Template) -> Need {
    Need { there, first }
}

const NOTHING: Need = need(|_| true, phrase!(""));
const MEASURED: Need = need(measured, phrase!("Open a session first"));
const ROOM: Need = need(
    |now| now.workbench.view.panes.has_room(),
    phrase!("There are as many charts as can be read"),
);
const ANSWERED: Need = need(answered, phrase!("Identify the robot first"));

/// Something that can be done.
#[derive(Clone, Copy)]
pub(crate) struct Action {
    keys: KeyboardShortcut,
    /// What the list of keys says.
    help: Template,
    /// What the menu says.
    label: fn(&WindowState<'_>) -> String,
    needs: Need,
    /// One of several ways to look: whether it is this.
    on: Option<fn(&WindowState<'_>) -> bool>,
    does: fn(&mut Workbench, &Context),
}

impl Action {
    const fn new(
        modifiers: Modifiers,
        key: Key,
        help: Template,
        label: fn(&WindowState<'_>) -> String,
        does: fn(&mut Workbench, &Context),
    ) -> Self {
        Self {
            keys: KeyboardShortcut::new(modifiers, key),
            help,
            label,
            needs: NOTHING,
            on: None,
            does,
        }
    }

    const fn when(self, needs: Need) -> Self {
        Self { needs, ..self }
    }

    const fn on(self, on: fn(&WindowState<'_>) -> bool) -> Self {
        Self {
            on: Some(on),
            ..self
        }
    }

    pub(crate) fn label(&self, now: &WindowState<'_>) -> String {
        (self.label)(now)
    }

    pub(crate) fn enabled(&self, now: &WindowState<'_>) -> bool {
        (self.needs.there)(now)
    }

    /// What has to be done first, where it cannot be done now.
    pub(crate) fn first(&self) -> &'static str {
        spoken(self.needs.first)
    }

    /// Whether it is chosen, where it is one of several ways to look.
    pub(crate) fn chosen(&self, now: &WindowState<'_>) -> Option<bool> {
        self.on.map(|on| on(now))
    }

    /// Does it once the frame is drawn.
    pub(crate) fn ask_for(&self, now: &WindowState<'_>) {
        let (does, ctx) = (self.does, now.ctx.clone());
        now.workbench.then(move |bench| does(bench, &ctx));
    }

    /// Itself in a menu.
    pub(crate) fn item(&self, ui: &mut Ui, workbench: &Workbench) -> Response {
        let now = WindowState::of(ui.ctx(), workbench);
        let name = self.label(&now);
        let button = match self.chosen(&now) {
            Some(on) => Button::selectable(on, &name),
            None => Button::new(&name),
        };
        let button = button.shortcut_text(self.keys(ui.ctx()));
        let response = item(ui, button, &name, self.enabled(&now));
        if response.clicked() {
            self.ask_for(&now);
            ui.close();
        }
        response
    }

    /// Its keys as a menu shows them.
    pub(crate) fn keys(&self, ctx: &Context) -> String {
        in_words(ctx, self.keys)
    }

    /// Its keys, and what they do.
    pub(crate) fn help(&self, ctx: &Context) -> (String, &'static str) {
        (self.keys(ctx), spoken(self.help))
    }
}

const PLAIN: Modifiers = Modifiers::NONE;
const COMMAND: Modifiers = Modifiers::COMMAND;
const ALT: Modifiers = Modifiers::COMMAND.plus(Modifiers::ALT);
const SHIFTED: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

fn measured(now: &WindowState<'_>) -> bool {
    !now.workbench.loaded_session().is_empty()
}

fn answered(now: &WindowState<'_>) -> bool {
    now.workbench.answer().is_some()
}

/// What is done, and to what.
fn with([alone, of]: [Template; 2], what: Option<&str>) -> String {
    what.map_or_else(
        || spoken(alone).to_owned(),
        |what| filled(of, &[("edit", &what)]),
    )
}

/// A table of actions, row by row: name, keys, help, label in the menu, command, and what else there
/// is to say of it.
macro_rules! actions {
    ($($name:ident: $modifiers:expr, $key:ident, $help:expr, $label:expr, $command:expr $(, [$more:ident($of:expr)])*;)*) => {
        $(pub(crate) const $name: Action =
            Action::new($modifiers, Key::$key, $help, $label, $command)$(.$more($of))*;)*
        /// All of them; where the keys of one contain another's, the longer stand first.
        pub(crate) const ALL: &[Action] = &[$($name),*];
    };
}

actions! {
    REDO: SHIFTED, Z, phrase!("redo"), |now| with([phrase!("Redo"), phrase!("Redo {edit}"; edit)], now.workbench.redoes()), |bench, _| bench.redo(),
        [when(need(|now| now.workbench.redoes().is_some(), phrase!("Nothing was undone")))];
    UNDO: COMMAND, Z, phrase!("undo"), |now| with([phrase!("Undo"), phrase!("Undo {edit}"; edit)], now.workbench.undoes()), |bench, _| bench.undo(),
        [when(need(|now| now.workbench.undoes().is_some(), phrase!("Nothing was changed yet")))];
    OPEN_LATEST: SHIFTED, O, phrase!("open the last file again"), |_| String::new(), open_latest;
    OPEN: COMMAND, O, phrase!("open a file"), |_| say!("Open…").into(), |bench, _| bench.choose_file(files::choose_to_open);
    IMPORT: SHIFTED, I, phrase!("import what an instrument wrote"), |_| say!("Import…").into(),
        |bench, _| bench.choose_file(files::choose_to_import);
    EXAMPLE_1: PLAIN, F2, phrase!("first example"), |_| EXAMPLES[0].name().into(), |bench, _| bench.ask_then(NextAction::Example(0));
    EXAMPLE_2: PLAIN, F3, phrase!("second example"), |_| EXAMPLES[1].name().into(), |bench, _| bench.ask_then(NextAction::Example(1));
    EXAMPLE_3: PLAIN, F4, phrase!("third example"), |_| EXAMPLES[2].name().into(), |bench, _| bench.ask_then(NextAction::Example(2));
    EXAMPLE_4: PLAIN, F5, phrase!("fourth example"), |_| EXAMPLES[3].name().into(), |bench, _| bench.ask_then(NextAction::Example(3));
    EXAMPLE_5: PLAIN, F7, phrase!("fifth example"), |_| EXAMPLES[4].name().into(), |bench, _| bench.ask_then(NextAction::Example(4));
    ROBOTS: SHIFTED, N, phrase!("robots of the library"), |_| say!("Robots…").into(), |bench, _| bench.show_sheet(Some(Sheet::ROBOTS));
    NEW: COMMAND, N, phrase!("simulate session"), |_| say!("Simulate session…").into(),
        |bench, _| bench.show_sheet(Some(Sheet::Simulate(Form::default())));
    SAVE_AS: SHIFTED, S, phrase!("save session as"), |_| say!("Save session as…").into(),
        |bench, _| bench.choose_where_to_export(What::Session), [when(MEASURED)];
    SAVE: COMMAND, S, phrase!("save session"), |_| say!("Save session").into(), |bench, _| bench.save(), [when(MEASURED)];
    SAVE_TO_PATH: SHIFTED, P, phrase!("save session to a path"), |_| say!("Save session to path…").into(),
        |bench, _| bench.type_path(What::Session), [when(MEASURED)];
    SAVE_MODEL: COMMAND, M, phrase!("save model"), |_| say!("Save model…").into(),
        |bench, _| bench.choose_where_to_export(What::Model), [when(ANSWERED)];
    COMPENSATE: SHIFTED, T, phrase!("correct targets or a program"), |_| say!("Compensate targets…").into(),
        |bench, _| bench.choose_targets(), [when(ANSWERED)];
    SAVE_TABLE: COMMAND, T, phrase!("save table"), |_| say!("Save table…").into(),
        |bench, _| bench.choose_where_to_export(What::Table), [when(ANSWERED)];
    REPORT: SHIFTED, R, phrase!("save the report"), |_| say!("Report…").into(),
        |bench, _| bench.choose_where_to_export(What::Report(About::Session)), [when(MEASURED)];
    REPORT_DETAILS: ALT, R, phrase!("what the report states of customer and machine"),
        |_| say!("Report details…").into(), |bench, _| bench.show_sheet(Some(Sheet::DETAILS)), [when(MEASURED)];
    HISTORY: SHIFTED, H, phrase!("compare the sessions of this machine"), |_| say!("History of the machine…").into(),
        |bench, _| bench.compare_here();
    RELOAD: COMMAND, R, phrase!("read the file again"), |_| say!("Read the file again").into(),
        |bench, _| bench.reload(), [when(need(|now| now.workbench.file().is_some(), phrase!("The session has not been saved yet")))];
    QUIT: COMMAND, Q, phrase!("quit"), |_| say!("Quit").into(), |bench, _| bench.ask_then(NextAction::Leave);
    IDENTIFY: COMMAND, I, phrase!("identify"), |_| say!("Identify").into(),
        |bench, _| bench.identify(None), [when(MEASURED)];
    SEARCH: COMMAND, G, phrase!("search for what is missing"), |_| say!("Run diagnosis").into(),
        |bench, _| bench.search(), [when(MEASURED)];
    CANCEL: COMMAND, Period, phrase!("cancel"), |_| say!("Cancel what is running").into(), |bench, _| bench.cancel_newest(),
        [when(need(|now| now.workbench.jobs().newest().is_some(), phrase!("Nothing is running")))];
    EXCLUDE: PLAIN, Delete, phrase!("exclude the chosen samples, or include them again"), exclude_says,
        |bench, _| bench.exclude(&bench.view.chosen(), !are_excluded(bench)),
        [when(need(|now| !now.workbench.view.chosen().is_empty(), phrase!("Choose a sample in a plot or in the table")))];
    PREFERENCES: COMMAND, Comma, phrase!("preferences"), |_| say!("Preferences…").into(),
        |bench, _| bench.show_sheet(Some(Sheet::Named("preferences")));
    NEXT_ANGLE: SHIFTED, U, phrase!("other unit of angles"), |now| now.preferences().next_angle().1.into(),
        |bench, _| bench.prefer(Preferences { angle: bench.view.preferences.next_angle().0, ..bench.view.preferences });
    NEXT_LENGTH: COMMAND, U, phrase!("next unit of lengths"), |now| now.preferences().next_length().1.into(),
        |bench, _| bench.prefer(Preferences { length: bench.view.preferences.next_length().0, ..bench.view.preferences });
    OTHER_THEME: COMMAND, D, phrase!("light or dark"), |now| Theme::other(dark(&now.ctx)).1.into(),
        |bench, ctx| bench.prefer(Preferences { theme: Theme::other(dark(ctx)).0, ..bench.view.preferences });
    RESULTS: COMMAND, B, phrase!("results, or more room for plots"),
        |now| results_says(layout(&now.ctx, now.workbench).results()).into(),
        |bench, ctx| bench.view.results = Some(!layout(ctx, bench).results());
    CHART_BELOW: SHIFTED, E, phrase!("another chart below this plot"), |_| say!("Add chart below").into(),
        |bench, _| bench.add_chart(bench.view.panes.active(), Edge::Bottom), [when(ROOM)];
    CHART_BESIDE: COMMAND, E, phrase!("another chart beside this plot"), |_| say!("Add chart beside").into(),
        |bench, _| bench.add_chart(bench.view.panes.active(), Edge::Right), [when(ROOM)];
    USUAL_PLOTS: SHIFTED, W, phrase!("plots as they usually are"), |_| say!("Usual arrangement").into(),
        |bench, _| bench.rearrange(|panes| *panes = Panes::default()),
        [when(need(|now| !now.workbench.view.panes.are_usual(), phrase!("The plots are as they usually are")))];
    CLOSE_CHART: COMMAND, W, phrase!("close this chart"), |_| say!("Close chart").into(), |bench, _| bench.close_chart(),
        [when(need(|now| now.workbench.view.panes.active_chart().is_some(), phrase!("There is no chart")))];
    NEXT_PLOT: PLAIN, F6, phrase!("next plot"), |_| say!("Next plot").into(), |bench, _| bench.view.panes.activate_next();
    LOOK_XY: SHIFTED, Num1, phrase!("workspace from above"), |_| say!("Workspace from above").into(),
        |bench, _| bench.view.look_in(Plane::Xy), [on(|now| now.looks_at(Plane::Xy))];
    LOOK_XZ: SHIFTED, Num2, phrase!("workspace from the side"), |_| say!("Workspace from the side").into(),
        |bench, _| bench.view.look_in(Plane::Xz), [on(|now| now.looks_at(Plane::Xz))];
    LOOK_YZ: SHIFTED, Num3, phrase!("workspace from the front"), |_| say!("Workspace from the front").into(),
        |bench, _| bench.view.look_in(Plane::Yz), [on(|now| now.looks_at(Plane::Yz))];
    LOOK_AROUND: SHIFTED, Num4, phrase!("deviation around the angle (polar)"),
        |_| say!("Deviation around the angle").into(), |bench, _| bench.show_chart("polar"),
        [on(|now| now.workbench.shows("polar"))];
    LOOK_IN_SPACE: SHIFTED, Num5, phrase!("workspace in 3-D"), |_| say!("Workspace in 3-D").into(),
        |bench, _| bench.view.look_from(None), [on(|now| now.workbench.view.in_space())];
    FIT: COMMAND, F, phrase!("fit the plots' view"), |_| say!("Show everything in the plots").into(),
        |bench, _| bench.view.fit();
    FIT_TOO: PLAIN, Home, phrase!("the same"), |_| String::new(), |bench, _| bench.view.fit();
    STEP_1: COMMAND, Num1, phrase!("first step"), |now| step_name(now.workbench, 0), |bench, _| bench.go_to(0),
        [on(|now| now.workbench.steps().first() == Some(&now.workbench.view.step))],
        [when(need(|now| !now.workbench.steps().is_empty(), phrase!("This robot has no such step")))];
    STEP_2: COMMAND, Num2, phrase!("second step"), |now| step_name(now.workbench, 1), |bench, _| bench.go_to(1),
        [on(|now| now.workbench.steps().get(1) == Some(&now.workbench.view.step))],
        [when(need(|now| now.workbench.steps().len() > 1, phrase!("This robot has no such step")))];
    STEP_3: COMMAND, Num3, phrase!("third step"), |now| step_name(now.workbench, 2), |bench, _| bench.go_to(2),
        [on(|now| now.workbench.steps().get(2) == Some(&now.workbench.view.step))],
        [when(need(|now| now.workbench.steps().len() > 2, phrase!("This robot has no such step")))];
    STEP_4: COMMAND, Num4, phrase!("fourth step"), |now| step_name(now.workbench, 3), |bench, _| bench.go_to(3),
        [on(|now| now.workbench.steps().get(3) == Some(&now.workbench.view.step))],
        [when(need(|now| now.workbench.steps().len() > 3, phrase!("This robot has no such step")))];
    STEP_5: COMMAND, Num5, phrase!("fifth step, where there are regions"), |now| step_name(now.workbench, 4), |bench, _| bench.go_to(4),
        [on(|now| now.workbench.steps().get(4) == Some(&now.workbench.view.step))],
        [when(need(|now| now.workbench.steps().len() > 4, phrase!("This robot has no such step")))];
    FROM_ISOMETRIC: PLAIN, Num0, phrase!("3-D view, isometric"), |_| say!("3-D view, isometric").into(),
        |bench, _| bench.view.look_from(Some(Standard::Isometric)),
        [on(|now| now.sees_from(Standard::Isometric))];
    FROM_FRONT: PLAIN, Num1, phrase!("3-D view from the front"), |_| say!("3-D view from the front").into(),
        |bench, _| bench.view.look_from(Some(Standard::Front)), [on(|now| now.sees_from(Standard::Front))];
    FROM_SIDE: PLAIN, Num3, phrase!("3-D view from the side"), |_| say!("3-D view from the side").into(),
        |bench, _| bench.view.look_from(Some(Standard::Side)), [on(|now| now.sees_from(Standard::Side))];
    FROM_TOP: PLAIN, Num7, phrase!("3-D view from above"), |_| say!("3-D view from above").into(),
        |bench, _| bench.view.look_from(Some(Standard::Top)), [on(|now| now.sees_from(Standard::Top))];
    ABOUT: Modifiers::SHIFT, F1, phrase!("about truepose"), |_| say!("About truepose").into(),
        |bench, _| bench.show_sheet(Some(Sheet::Named("about")));
    WORDS: PLAIN, F1, phrase!("glossary"), |_| say!("Glossary").into(), |bench, _| bench.show_sheet(Some(Sheet::Named("words")));
    KEYS: SHIFTED, K, phrase!("this list"), |_| say!("Keyboard and mouse").into(), |bench, _| bench.show_sheet(Some(Sheet::Named("keys")));
    PALETTE: COMMAND, K, phrase!("all commands, by a word of their name"), |_| say!("All commands…").into(),
        |bench, _| bench.show_sheet(Some(Sheet::Palette(PaletteInput::default())));
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

fn open_latest(bench: &mut Workbench, _: &Context) {
    let latest = bench.recent().find(|(_, there)| *there);
    match latest.map(|(path, _)| path.to_path_buf()) {
        Some(path) => bench.open_file(path),
        None => bench.choose_file(files::choose_to_open),
    }
}

fn are_excluded(workbench: &Workbench) -> bool {
    let samples = &workbench.loaded_session().session.samples;
    let chosen = workbench.view.chosen();
    chosen.iter().all(|sample| samples.is_excluded(*sample))
}

fn exclude_says(now: &WindowState<'_>) -> String {
    match now.workbench.view.chosen()[..] {
        [] => say!("Exclude samples").to_owned(),
        [one] if are_excluded(now.workbench) => {
            say!("Include sample {sample} again", sample = one + 1)
        }
        [one] => say!("Exclude sample {sample}", sample = one + 1),
        ref all if are_excluded(now.workbench) => {
            say!("Include {count} samples again", count = all.len())
        }
        ref all => say!("Exclude {count} samples", count = all.len()),
    }
}

/// Something in a menu: it goes by its name alone, without its keys.
pub(crate) fn item(ui: &mut Ui, button: Button<'_>, name: &str, enabled: bool) -> Response {
    let response = ui.add_enabled(enabled, button);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
    response
}

/// What opens the right-hand side, or shuts it.
pub(crate) fn results_says(open: bool) -> &'static str {
    if open {
        say!("Hide results")
    } else {
        say!("Show results")
    }
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
    let size = ctx.content_rect().size();
    let view = &workbench.view;
    let sizes = view.preferences.sizes;
    Layout::of(size.x, size.y, view.results, [sizes.left, sizes.right])
}

/// Asks for what the keyboard does. Behind a sheet, and while text is typed, the keys belong to the text; behind a
/// dialog of the system no key is read.
pub(crate) fn read(ctx: &Context, workbench: &Workbench) {
    let covered = workbench.view.sheet.is_some() || workbench.asking().is_some();
    if covered || ctx.text_edit_focused() {
        return;
    }
    let now = WindowState::of(ctx, workbench);
    for action in ALL {
        // A key by itself may mean something to the control with the focus.
        let meant = action.keys.modifiers.any() || action.enabled(&now);
        if meant && ctx.input_mut(|i| i.consume_shortcut(&action.keys)) {
            action.ask_for(&now);
        }
    }
}
