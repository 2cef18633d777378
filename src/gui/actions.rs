//! The keyboard: one table for what the keys do, what the menus show and what the help lists.

use egui::{Context, Key, KeyboardShortcut, Modifiers};

use crate::gui::core::edit::Edit;
use crate::gui::core::simulate::Form;
use crate::gui::preferences::{Preferences, Theme};
use crate::gui::style::room::Room;
use crate::gui::units::{AngleUnit, LengthUnit};
use crate::gui::view::What;
use crate::gui::view::{Plane, Sheet, Step};
use crate::gui::workbench::{Command, Workbench};

/// Something that a key does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Action {
    /// Ask for a file to open.
    Open,
    /// Open the file that was open last.
    OpenLatest,
    /// Open a session that comes with the program.
    Example(usize),
    /// A session by simulation.
    New,
    /// Save to the session's own file.
    Save,
    /// Ask for a file to save to.
    SaveAs,
    /// Type a path to save to.
    SaveToPath,
    /// Ask for a file for the model.
    SaveModel,
    /// Ask for a file for the table.
    SaveTable,
    /// Read the file again.
    Reload,
    /// Follow the file as it grows, or stop.
    Follow,
    /// Close the window.
    Quit,
    /// Take back.
    Undo,
    /// Bring back.
    Redo,
    /// Identify.
    Identify,
    /// Search for what is missing.
    Search,
    /// Drop what is running.
    Cancel,
    /// Units, digits, colours.
    Preferences,
    /// The next unit of lengths.
    NextLength,
    /// The other unit of angles.
    NextAngle,
    /// Light instead of dark, or the other way round.
    OtherTheme,
    /// Open the results, or shut them.
    Results,
    /// Show everything again.
    Fit,
    /// The first step, and so on.
    Step(Step),
    /// The workspace from another side.
    Look(Plane),
    /// The deviation around the joint's angle.
    LookAround,
    /// What the words mean.
    Words,
    /// The keyboard.
    Keys,
    /// What this program is.
    About,
}

const fn with(modifiers: Modifiers, key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(modifiers, key)
}

const PLAIN: Modifiers = Modifiers::NONE;
const COMMAND: Modifiers = Modifiers::COMMAND;
const SHIFTED: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// All shortcuts; where one contains another, the longer stands first.
pub(crate) const ALL: [(Action, KeyboardShortcut, &str); 38] = [
    (Action::Redo, with(SHIFTED, Key::Z), "redo"),
    (Action::Undo, with(COMMAND, Key::Z), "undo"),
    (
        Action::OpenLatest,
        with(SHIFTED, Key::O),
        "open the last file again",
    ),
    (Action::Open, with(COMMAND, Key::O), "open a file"),
    (Action::Example(0), with(PLAIN, Key::F2), "first example"),
    (Action::Example(1), with(PLAIN, Key::F3), "second example"),
    (Action::Example(2), with(PLAIN, Key::F4), "third example"),
    (Action::New, with(COMMAND, Key::N), "new by simulation"),
    (Action::SaveAs, with(SHIFTED, Key::S), "save session as"),
    (Action::Save, with(COMMAND, Key::S), "save session"),
    (
        Action::SaveToPath,
        with(SHIFTED, Key::P),
        "save session to a path",
    ),
    (Action::SaveModel, with(COMMAND, Key::M), "save model"),
    (Action::SaveTable, with(COMMAND, Key::T), "save table"),
    (Action::Reload, with(COMMAND, Key::R), "read the file again"),
    (
        Action::Follow,
        with(COMMAND, Key::L),
        "follow the file, or stop",
    ),
    (Action::Quit, with(COMMAND, Key::Q), "quit"),
    (Action::Identify, with(COMMAND, Key::I), "identify"),
    (
        Action::Search,
        with(COMMAND, Key::G),
        "search for what is missing",
    ),
    (Action::Cancel, with(COMMAND, Key::Period), "cancel"),
    (
        Action::Preferences,
        with(COMMAND, Key::Comma),
        "preferences",
    ),
    (
        Action::NextAngle,
        with(SHIFTED, Key::U),
        "other unit of angles",
    ),
    (
        Action::NextLength,
        with(COMMAND, Key::U),
        "next unit of lengths",
    ),
    (Action::OtherTheme, with(COMMAND, Key::D), "light or dark"),
    (
        Action::Results,
        with(COMMAND, Key::B),
        "results, or more room for plots",
    ),
    (
        Action::Look(Plane::Xy),
        with(SHIFTED, Key::Num1),
        "workspace from above",
    ),
    (
        Action::Look(Plane::Xz),
        with(SHIFTED, Key::Num2),
        "workspace from the side",
    ),
    (
        Action::Look(Plane::Yz),
        with(SHIFTED, Key::Num3),
        "workspace from the front",
    ),
    (
        Action::LookAround,
        with(SHIFTED, Key::Num4),
        "deviation around the angle (polar)",
    ),
    (Action::Fit, with(COMMAND, Key::F), "fit the plots' view"),
    (Action::Fit, with(PLAIN, Key::Home), "the same"),
    (
        Action::Step(Step::Session),
        with(COMMAND, Key::Num1),
        "step 1, session",
    ),
    (
        Action::Step(Step::Regions),
        with(COMMAND, Key::Num2),
        "step 2, regions",
    ),
    (
        Action::Step(Step::Identify),
        with(COMMAND, Key::Num3),
        "step 3, identify",
    ),
    (
        Action::Step(Step::Gap),
        with(COMMAND, Key::Num4),
        "step 4, diagnose",
    ),
    (
        Action::Step(Step::Export),
        with(COMMAND, Key::Num5),
        "step 5, export",
    ),
    (
        Action::About,
        with(Modifiers::SHIFT, Key::F1),
        "about truepose",
    ),
    (Action::Words, with(PLAIN, Key::F1), "glossary"),
    (Action::Keys, with(COMMAND, Key::K), "this list"),
];

/// How a menu shows the keys of an action.
pub(crate) fn keys(ctx: &Context, action: Action) -> String {
    let found = ALL.iter().find(|(other, _, _)| *other == action);
    found.map_or_else(String::new, |(_, keys, _)| in_words(ctx, *keys))
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
pub(crate) fn room(ctx: &Context, workbench: &Workbench) -> Room {
    let size = ctx.content_rect().size();
    Room::of(size.x, size.y, workbench.view().results)
}

/// What an action does, as the workbench stands.
pub(crate) fn command_for(ctx: &Context, action: Action, workbench: &Workbench) -> Command {
    let dark = ctx.global_style().visuals.dark_mode;
    let preferences = workbench.view().preferences;
    let sheet = |sheet| Command::Sheet(Some(sheet));
    match action {
        Action::Open => Command::ChooseFile,
        Action::OpenLatest => match workbench.recent().find(|(_, there)| *there) {
            Some((path, _)) => Command::OpenFile(path.to_path_buf()),
            None => Command::ChooseFile,
        },
        Action::Example(index) => Command::OpenExample(index),
        Action::New => sheet(Sheet::Simulate(Form::default())),
        Action::Save => Command::Save,
        Action::SaveAs => Command::ChooseWhereToSave,
        Action::SaveToPath => workbench.typed_path(),
        Action::SaveModel => Command::ChooseWhereToExport(What::Model),
        Action::SaveTable => Command::ChooseWhereToExport(What::Table),
        Action::Reload => Command::Reload,
        Action::Follow => Command::Follow(workbench.following().is_none()),
        Action::Quit => Command::Leave,
        Action::Undo => Command::Undo,
        Action::Redo => Command::Redo,
        Action::Identify => Command::Edit(Edit::Identify),
        Action::Search => Command::Search,
        Action::Cancel => Command::Cancel,
        Action::Preferences => sheet(Sheet::Preferences),
        Action::NextLength => Command::Prefer(Preferences {
            length: match preferences.length {
                LengthUnit::Millimetre => LengthUnit::Micrometre,
                LengthUnit::Micrometre => LengthUnit::Inch,
                LengthUnit::Inch => LengthUnit::Millimetre,
            },
            ..preferences
        }),
        Action::NextAngle => Command::Prefer(Preferences {
            angle: match preferences.angle {
                AngleUnit::Degree => AngleUnit::Radian,
                AngleUnit::Radian => AngleUnit::Degree,
            },
            ..preferences
        }),
        Action::OtherTheme => Command::Prefer(Preferences {
            theme: if dark { Theme::Light } else { Theme::Dark },
            ..preferences
        }),
        Action::Results => Command::Results(!room(ctx, workbench).results()),
        Action::Fit => Command::Fit,
        Action::Step(step) => Command::GoTo(step),
        Action::Look(plane) => Command::Look(plane),
        Action::LookAround => Command::LookAround,
        Action::Words => sheet(Sheet::Words),
        Action::Keys => sheet(Sheet::Shortcuts),
        Action::About => sheet(Sheet::About),
    }
}

/// What the keyboard asks for. Behind a sheet, and while text is typed, the keys belong to the text.
pub(crate) fn read(ctx: &Context, workbench: &Workbench) -> Vec<Command> {
    if workbench.view().sheet.is_some() || ctx.text_edit_focused() {
        return Vec::new();
    }
    let pressed = |shortcut: &KeyboardShortcut| ctx.input_mut(|i| i.consume_shortcut(shortcut));
    ALL.iter()
        .filter(|(_, shortcut, _)| pressed(shortcut))
        .map(|(action, _, _)| command_for(ctx, *action, workbench))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_keys_do_two_things_and_none_hides_another() {
        for (k, (action, keys, _)) in ALL.iter().enumerate() {
            for (other, before, _) in &ALL[..k] {
                assert_ne!(keys, before, "{action:?} and {other:?}");
                // Without Shift a shortcut also takes what has it: the longer stands first.
                let hides = before.logical_key == keys.logical_key
                    && keys.modifiers.contains(before.modifiers);
                assert!(!hides, "{other:?} hides {action:?}");
            }
        }
    }
}
