//! What can be done by a key or from a menu: one table for what the keys do, what the menus offer and
//! what the help lists.

use crate::text::{Template, filled, spoken};
use egui::{Context, Key, KeyboardShortcut, Modifiers};

use crate::gui::core::disk::EXAMPLES;
use crate::gui::core::edit::Edit;
use crate::gui::core::simulate::Form;
use crate::gui::preferences::{Preferences, Theme};
use crate::gui::style::layout::Layout;
use crate::gui::view::{About, Edge, Plane, Sheet, Standard, Step, What};
use crate::gui::workbench::{Asked, Command, Task, ViewChange, Workbench};

/// The window as it stands.
#[derive(Clone, Copy)]
pub(crate) struct WindowState<'a> {
    pub(crate) ctx: &'a Context,
    pub(crate) workbench: &'a Workbench,
}

impl WindowState<'_> {
    fn preferences(self) -> Preferences {
        self.workbench.view().preferences
    }

    fn dark(self) -> bool {
        self.ctx.global_style().visuals.dark_mode
    }

    fn looks_at(self, plane: Plane) -> bool {
        let view = self.workbench.view();
        view.plane == plane && !view.in_space()
    }

    fn sees_from(self, from: Standard) -> bool {
        let view = self.workbench.view();
        view.in_space() && view.camera.standard() == Some(from)
    }
}

/// What an action needs, and what to do where that is not there.
#[derive(Clone, Copy)]
struct Need {
    there: fn(WindowState<'_>) -> bool,
    first: Template,
}

const fn need(there: fn(WindowState<'_>) -> bool, first: Template) -> Need {
    Need { there, first }
}

const NOTHING: Need = need(|_| true, phrase!(""));
const MEASURED: Need = need(measured, phrase!("Open a session first"));
const ROOM: Need = need(
    |now| now.workbench.view().panes.has_room(),
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
    label: fn(WindowState<'_>) -> String,
    needs: Need,
    /// One of several ways to look: whether it is this.
    on: Option<fn(WindowState<'_>) -> bool>,
    command: fn(WindowState<'_>) -> Command,
}

impl Action {
    const fn new(
        modifiers: Modifiers,
        key: Key,
        help: Template,
        label: fn(WindowState<'_>) -> String,
        command: fn(WindowState<'_>) -> Command,
    ) -> Self {
        Self {
            keys: KeyboardShortcut::new(modifiers, key),
            help,
            label,
            needs: NOTHING,
            on: None,
            command,
        }
    }

    const fn when(self, needs: Need) -> Self {
        Self { needs, ..self }
    }

    const fn on(self, on: fn(WindowState<'_>) -> bool) -> Self {
        Self {
            on: Some(on),
            ..self
        }
    }

    pub(crate) fn label(&self, now: WindowState<'_>) -> String {
        (self.label)(now)
    }

    pub(crate) fn enabled(&self, now: WindowState<'_>) -> bool {
        (self.needs.there)(now)
    }

    /// What has to be done first, where it cannot be done now.
    pub(crate) fn first(&self) -> &'static str {
        spoken(self.needs.first)
    }

    /// Whether it is chosen, where it is one of several ways to look.
    pub(crate) fn chosen(&self, now: WindowState<'_>) -> Option<bool> {
        self.on.map(|on| on(now))
    }

    pub(crate) fn command(&self, now: WindowState<'_>) -> Command {
        (self.command)(now)
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

fn measured(now: WindowState<'_>) -> bool {
    !now.workbench.loaded_session().is_empty()
}

fn answered(now: WindowState<'_>) -> bool {
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
    REDO: SHIFTED, Z, phrase!("redo"), |now| with([phrase!("Redo"), phrase!("Redo {edit}"; edit)], now.workbench.redoes()), |_| Command::Redo,
        [when(need(|now| now.workbench.redoes().is_some(), phrase!("Nothing was undone")))];
    UNDO: COMMAND, Z, phrase!("undo"), |now| with([phrase!("Undo"), phrase!("Undo {edit}"; edit)], now.workbench.undoes()), |_| Command::Undo,
        [when(need(|now| now.workbench.undoes().is_some(), phrase!("Nothing was changed yet")))];
    OPEN_LATEST: SHIFTED, O, phrase!("open the last file again"), |_| String::new(), open_latest;
    OPEN: COMMAND, O, phrase!("open a file"), |_| say!("Open…").into(), |_| Command::Ask(Asked::File);
    IMPORT: SHIFTED, I, phrase!("import what an instrument wrote"), |_| say!("Import…").into(),
        |_| Command::Ask(Asked::Import);
    EXAMPLE_1: PLAIN, F2, phrase!("first example"), |_| EXAMPLES[0].name().into(), |_| Command::OpenExample(0);
    EXAMPLE_2: PLAIN, F3, phrase!("second example"), |_| EXAMPLES[1].name().into(), |_| Command::OpenExample(1);
    EXAMPLE_3: PLAIN, F4, phrase!("third example"), |_| EXAMPLES[2].name().into(), |_| Command::OpenExample(2);
    EXAMPLE_4: PLAIN, F5, phrase!("fourth example"), |_| EXAMPLES[3].name().into(), |_| Command::OpenExample(3);
    EXAMPLE_5: PLAIN, F7, phrase!("fifth example"), |_| EXAMPLES[4].name().into(), |_| Command::OpenExample(4);
    ROBOTS: SHIFTED, N, phrase!("robots of the library"), |_| say!("Robots…").into(), |_| Command::sheet(Sheet::ROBOTS);
    NEW: COMMAND, N, phrase!("simulate session"), |_| say!("Simulate session…").into(),
        |_| Command::sheet(Sheet::Simulate(Form::default()));
    SAVE_AS: SHIFTED, S, phrase!("save session as"), |_| say!("Save session as…").into(),
        |_| Command::Ask(Asked::WhereToSave), [when(MEASURED)];
    SAVE: COMMAND, S, phrase!("save session"), |_| say!("Save session").into(), |_| Command::Save, [when(MEASURED)];
    SAVE_TO_PATH: SHIFTED, P, phrase!("save session to a path"), |_| say!("Save session to path…").into(),
        |now| now.workbench.typed_path(), [when(MEASURED)];
    SAVE_MODEL: COMMAND, M, phrase!("save model"), |_| say!("Save model…").into(),
        |_| Command::Ask(Asked::WhereToExport(What::Model)), [when(ANSWERED)];
    COMPENSATE: SHIFTED, T, phrase!("correct targets or a program"), |_| say!("Compensate targets…").into(),
        |_| Command::Ask(Asked::Targets), [when(ANSWERED)];
    SAVE_TABLE: COMMAND, T, phrase!("save table"), |_| say!("Save table…").into(),
        |_| Command::Ask(Asked::WhereToExport(What::Table)), [when(ANSWERED)];
    REPORT: SHIFTED, R, phrase!("save the report"), |_| say!("Report…").into(),
        |_| Command::Ask(Asked::WhereToExport(What::Report(About::Session))), [when(MEASURED)];
    REPORT_DETAILS: ALT, R, phrase!("what the report states of customer and machine"),
        |_| say!("Report details…").into(), |_| Command::sheet(Sheet::DETAILS), [when(MEASURED)];
    HISTORY: SHIFTED, H, phrase!("compare the sessions of this machine"), |_| say!("History of the machine…").into(),
        |now| now.workbench.compare_here();
    RELOAD: COMMAND, R, phrase!("read the file again"), |_| say!("Read the file again").into(),
        |_| Command::Reload, [when(need(|now| now.workbench.file().is_some(), phrase!("The session has not been saved yet")))];
    QUIT: COMMAND, Q, phrase!("quit"), |_| say!("Quit").into(), |_| Command::Leave;
    IDENTIFY: COMMAND, I, phrase!("identify"), |_| say!("Identify").into(),
        |_| Command::Edit(Edit::Identify), [when(MEASURED)];
    SEARCH: COMMAND, G, phrase!("search for what is missing"), |_| say!("Run diagnosis").into(),
        |_| Command::Search, [when(MEASURED)];
    CANCEL: COMMAND, Period, phrase!("cancel"), |_| say!("Cancel what is running").into(), |_| Command::Stop(Task::Newest),
        [when(need(|now| now.workbench.jobs().newest().is_some(), phrase!("Nothing is running")))];
    EXCLUDE: PLAIN, Delete, phrase!("exclude the chosen samples, or include them again"), exclude_says,
        |now| Command::Edit(Edit::Exclude(now.workbench.view().chosen(), !are_excluded(now))),
        [when(need(|now| !now.workbench.view().chosen().is_empty(), phrase!("Choose a sample in a plot or in the table")))];
    PREFERENCES: COMMAND, Comma, phrase!("preferences"), |_| say!("Preferences…").into(),
        |_| Command::sheet(Sheet::Named("preferences"));
    NEXT_ANGLE: SHIFTED, U, phrase!("other unit of angles"), |now| now.preferences().next_angle().1.into(),
        |now| Command::Prefer(Preferences { angle: now.preferences().next_angle().0, ..now.preferences() });
    NEXT_LENGTH: COMMAND, U, phrase!("next unit of lengths"), |now| now.preferences().next_length().1.into(),
        |now| Command::Prefer(Preferences { length: now.preferences().next_length().0, ..now.preferences() });
    OTHER_THEME: COMMAND, D, phrase!("light or dark"), |now| Theme::other(now.dark()).1.into(),
        |now| Command::Prefer(Preferences { theme: Theme::other(now.dark()).0, ..now.preferences() });
    RESULTS: COMMAND, B, phrase!("results, or more room for plots"),
        |now| results_says(layout(now.ctx, now.workbench).results()).into(),
        |now| Command::View(ViewChange::Results(!layout(now.ctx, now.workbench).results()));
    CHART_BELOW: SHIFTED, E, phrase!("another chart below this plot"), |_| say!("Add chart below").into(),
        add_chart::<{ Edge::Bottom as usize }>, [when(ROOM)];
    CHART_BESIDE: COMMAND, E, phrase!("another chart beside this plot"), |_| say!("Add chart beside").into(),
        add_chart::<{ Edge::Right as usize }>, [when(ROOM)];
    USUAL_PLOTS: SHIFTED, W, phrase!("plots as they usually are"), |_| say!("Usual arrangement").into(),
        |_| Command::View(ViewChange::Panes(Box::default())),
        [when(need(|now| !now.workbench.view().panes.are_usual(), phrase!("The plots are as they usually are")))];
    CLOSE_CHART: COMMAND, W, phrase!("close this chart"), |_| say!("Close chart").into(), close_chart,
        [when(need(|now| now.workbench.view().panes.active_chart().is_some(), phrase!("There is no chart")))];
    NEXT_PLOT: PLAIN, F6, phrase!("next plot"), |_| say!("Next plot").into(), |_| Command::View(ViewChange::ActivateNext);
    LOOK_XY: SHIFTED, Num1, phrase!("workspace from above"), |_| say!("Workspace from above").into(),
        |_| Command::View(ViewChange::Look(Plane::Xy)), [on(|now| now.looks_at(Plane::Xy))];
    LOOK_XZ: SHIFTED, Num2, phrase!("workspace from the side"), |_| say!("Workspace from the side").into(),
        |_| Command::View(ViewChange::Look(Plane::Xz)), [on(|now| now.looks_at(Plane::Xz))];
    LOOK_YZ: SHIFTED, Num3, phrase!("workspace from the front"), |_| say!("Workspace from the front").into(),
        |_| Command::View(ViewChange::Look(Plane::Yz)), [on(|now| now.looks_at(Plane::Yz))];
    LOOK_AROUND: SHIFTED, Num4, phrase!("deviation around the angle (polar)"),
        |_| say!("Deviation around the angle").into(), |now| now.workbench.showing("polar"),
        [on(|now| now.workbench.shows("polar"))];
    LOOK_IN_SPACE: SHIFTED, Num5, phrase!("workspace in 3-D"), |_| say!("Workspace in 3-D").into(),
        |_| Command::View(ViewChange::LookFrom(None)), [on(|now| now.workbench.view().in_space())];
    FIT: COMMAND, F, phrase!("fit the plots' view"), |_| say!("Show everything in the plots").into(),
        |_| Command::View(ViewChange::Fit);
    FIT_TOO: PLAIN, Home, phrase!("the same"), |_| String::new(), |_| Command::View(ViewChange::Fit);
    STEP_1: COMMAND, Num1, phrase!("first step"), step_name::<0>, go_to::<0>,
        [on(is_at::<0>)], [when(need(|now| step::<0>(now).is_some(), phrase!("This robot has no such step")))];
    STEP_2: COMMAND, Num2, phrase!("second step"), step_name::<1>, go_to::<1>,
        [on(is_at::<1>)], [when(need(|now| step::<1>(now).is_some(), phrase!("This robot has no such step")))];
    STEP_3: COMMAND, Num3, phrase!("third step"), step_name::<2>, go_to::<2>,
        [on(is_at::<2>)], [when(need(|now| step::<2>(now).is_some(), phrase!("This robot has no such step")))];
    STEP_4: COMMAND, Num4, phrase!("fourth step"), step_name::<3>, go_to::<3>,
        [on(is_at::<3>)], [when(need(|now| step::<3>(now).is_some(), phrase!("This robot has no such step")))];
    STEP_5: COMMAND, Num5, phrase!("fifth step, where there are regions"), step_name::<4>, go_to::<4>,
        [on(is_at::<4>)], [when(need(|now| step::<4>(now).is_some(), phrase!("This robot has no such step")))];
    FROM_ISOMETRIC: PLAIN, Num0, phrase!("3-D view, isometric"), |_| say!("3-D view, isometric").into(),
        |_| Command::View(ViewChange::LookFrom(Some(Standard::Isometric))),
        [on(|now| now.sees_from(Standard::Isometric))];
    FROM_FRONT: PLAIN, Num1, phrase!("3-D view from the front"), |_| say!("3-D view from the front").into(),
        |_| Command::View(ViewChange::LookFrom(Some(Standard::Front))), [on(|now| now.sees_from(Standard::Front))];
    FROM_SIDE: PLAIN, Num3, phrase!("3-D view from the side"), |_| say!("3-D view from the side").into(),
        |_| Command::View(ViewChange::LookFrom(Some(Standard::Side))), [on(|now| now.sees_from(Standard::Side))];
    FROM_TOP: PLAIN, Num7, phrase!("3-D view from above"), |_| say!("3-D view from above").into(),
        |_| Command::View(ViewChange::LookFrom(Some(Standard::Top))), [on(|now| now.sees_from(Standard::Top))];
    ABOUT: Modifiers::SHIFT, F1, phrase!("about truepose"), |_| say!("About truepose").into(),
        |_| Command::sheet(Sheet::Named("about"));
    WORDS: PLAIN, F1, phrase!("glossary"), |_| say!("Glossary").into(), |_| Command::sheet(Sheet::Named("words"));
    KEYS: SHIFTED, K, phrase!("this list"), |_| say!("Keyboard and mouse").into(), |_| Command::sheet(Sheet::Named("keys"));
    PALETTE: COMMAND, K, phrase!("all commands, by a word of their name"), |_| say!("All commands…").into(),
        |_| Command::sheet(Sheet::Named("palette"));
}

/// The examples, in their order.
pub(crate) const OPEN_EXAMPLE: [Action; EXAMPLES.len()] =
    [EXAMPLE_1, EXAMPLE_2, EXAMPLE_3, EXAMPLE_4, EXAMPLE_5];

/// The steps, in their order; a robot without regions has no fifth.
pub(crate) const STEPS: [Action; 5] = [STEP_1, STEP_2, STEP_3, STEP_4, STEP_5];

fn step<const N: usize>(now: WindowState<'_>) -> Option<Step> {
    now.workbench.steps().get(N).copied()
}

fn step_name<const N: usize>(now: WindowState<'_>) -> String {
    step::<N>(now).map_or("", Step::name).to_owned()
}

fn go_to<const N: usize>(now: WindowState<'_>) -> Command {
    Command::View(ViewChange::GoTo(
        step::<N>(now).unwrap_or(now.workbench.view().step),
    ))
}

fn is_at<const N: usize>(now: WindowState<'_>) -> bool {
    step::<N>(now) == Some(now.workbench.view().step)
}

/// At an edge of the active plot.
fn add_chart<const EDGE: usize>(now: WindowState<'_>) -> Command {
    let key = now.workbench.view().panes.active();
    Command::View(ViewChange::Panes(Box::new(
        now.workbench.with_chart(key, Edge::ALL[EDGE]),
    )))
}

/// The one that is active, or was so last.
fn close_chart(now: WindowState<'_>) -> Command {
    let mut panes = now.workbench.view().panes.clone();
    if let Some(key) = panes.active_chart().map(|(key, _)| key) {
        panes.close(key);
    }
    Command::View(ViewChange::Panes(Box::new(panes)))
}

fn open_latest(now: WindowState<'_>) -> Command {
    match now.workbench.recent().find(|(_, there)| *there) {
        Some((path, _)) => Command::OpenFile(path.to_path_buf()),
        None => Command::Ask(Asked::File),
    }
}

fn are_excluded(now: WindowState<'_>) -> bool {
    let samples = &now.workbench.loaded_session().session.samples;
    now.workbench
        .view()
        .chosen()
        .iter()
        .all(|sample| samples.is_excluded(*sample))
}

fn exclude_says(now: WindowState<'_>) -> String {
    match now.workbench.view().chosen()[..] {
        [] => say!("Exclude samples").to_owned(),
        [one] if are_excluded(now) => say!("Include sample {sample} again", sample = one + 1),
        [one] => say!("Exclude sample {sample}", sample = one + 1),
        ref all if are_excluded(now) => say!("Include {count} samples again", count = all.len()),
        ref all => say!("Exclude {count} samples", count = all.len()),
    }
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
    let view = workbench.view();
    let sizes = view.preferences.sizes;
    Layout::of(size.x, size.y, view.results, [sizes.left, sizes.right])
}

/// What the keyboard asks for. Behind a sheet, and while text is typed, the keys belong to the text; behind a
/// dialog of the system no key is read.
pub(crate) fn read(ctx: &Context, workbench: &Workbench) -> Vec<Command> {
    let covered = workbench.view().sheet.is_some() || workbench.asking().is_some();
    if covered || ctx.text_edit_focused() {
        return Vec::new();
    }
    let now = WindowState { ctx, workbench };
    // A key by itself may mean something to the control with the focus.
    let meant = |action: &Action| action.keys.modifiers.any() || action.enabled(now);
    let pressed =
        |action: &&Action| meant(action) && ctx.input_mut(|i| i.consume_shortcut(&action.keys));
    let all = ALL.iter().filter(pressed);
    all.map(|action| action.command(now)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_keys_do_two_things_and_none_hides_another() {
        for (k, action) in ALL.iter().enumerate() {
            for before in &ALL[..k] {
                assert_ne!(
                    action.keys,
                    before.keys,
                    "{} and {}",
                    action.help.english(),
                    before.help.english()
                );
                // Without Shift a shortcut also takes what has it: the longer stands first.
                let hides = before.keys.logical_key == action.keys.logical_key
                    && action.keys.modifiers.contains(before.keys.modifiers);
                assert!(
                    !hides,
                    "{} hides {}",
                    before.help.english(),
                    action.help.english()
                );
            }
        }
    }
}
