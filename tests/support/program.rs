//! The program itself, in English whatever language the machine speaks.

use std::process::Command;

/// A call of the program.
pub(crate) fn truepose() -> Command {
    english(Command::new(env!("CARGO_BIN_EXE_truepose")))
}

/// A command whose answers do not depend on the language of the machine.
pub(crate) fn english(mut command: Command) -> Command {
    command.env("LC_ALL", "C");
    command
}
