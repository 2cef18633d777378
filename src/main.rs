//! The binary: arguments, then a command or the window; an error is printed once.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
