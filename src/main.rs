//! The binary: arguments, then a command or the window; an error is printed once.

use std::process::ExitCode;

fn main() -> ExitCode {
    truepose::cli::run()
}
