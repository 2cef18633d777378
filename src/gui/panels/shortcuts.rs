//! The keyboard: one table for what the keys do, what the menus show and what the help lists.

use egui::{Context, Key, KeyboardShortcut, Modifiers};

use crate::gui::commands::{Command, Workbench};
use crate::gui::edit::Edit;
use crate::gui::view::Step;

/// Something that a key does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Action {
    /// Ask for a file to open.
    Open,
    /// Ask for a file to save to.
    Save,
    /// Take back.
    Undo,
    /// Bring back.
    Redo,
    /// Identify.
    Identify,
    /// Show everything again.
    Fit,
    /// The first step, and so on.
    Step(Step),
}

const fn with(modifiers: Modifiers, key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(modifiers, key)
}

const SHIFTED: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// All shortcuts; where one contains another, the longer stands first.
pub(crate) const ALL: [(Action, KeyboardShortcut, &str); 11] = [
    (Action::Redo, with(SHIFTED, Key::Z), "redo"),
    (Action::Undo, with(Modifiers::COMMAND, Key::Z), "undo"),
    (
        Action::Open,
        with(Modifiers::COMMAND, Key::O),
        "open a session",
    ),
    (
        Action::Save,
        with(Modifiers::COMMAND, Key::S),
        "save the session",
    ),
    (
        Action::Identify,
        with(Modifiers::COMMAND, Key::I),
        "identify",
    ),
    (
        Action::Fit,
        with(Modifiers::COMMAND, Key::F),
        "show everything in the plots",
    ),
    (
        Action::Step(Step::Session),
        with(Modifiers::COMMAND, Key::Num1),
        "step 1, session",
    ),
    (
        Action::Step(Step::Regions),
        with(Modifiers::COMMAND, Key::Num2),
        "step 2, regions",
    ),
    (
        Action::Step(Step::Identify),
        with(Modifiers::COMMAND, Key::Num3),
        "step 3, identify",
    ),
    (
        Action::Step(Step::Gap),
        with(Modifiers::COMMAND, Key::Num4),
        "step 4, find the gap",
    ),
    (
        Action::Step(Step::Export),
        with(Modifiers::COMMAND, Key::Num5),
        "step 5, export",
    ),
];

/// How a menu shows the keys of an action.
pub(crate) fn keys(ctx: &Context, action: Action) -> String {
    let found = ALL.iter().find(|(other, _, _)| *other == action);
    found.map_or_else(String::new, |(_, shortcut, _)| {
        ctx.format_shortcut(shortcut)
    })
}

/// What an action does.
pub(crate) fn command(action: Action) -> Command {
    match action {
        Action::Open => Command::ChooseFile,
        Action::Save => Command::ChooseWhereToSave,
        Action::Undo => Command::Undo,
        Action::Redo => Command::Redo,
        Action::Identify => Command::Edit(Edit::Identify),
        Action::Fit => Command::Fit,
        Action::Step(step) => Command::GoTo(step),
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
        .map(|(action, _, _)| command(*action))
        .collect()
}
