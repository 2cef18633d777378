//! The terminal: one file per command.
//!
//! Exit status: 0 done; 2 the input or the arguments are wrong; 1 the program failed, there is no display
//! for the window, `compensate` left some targets as they are, or `diagnose` could not diagnose some of
//! many sessions. With `--json` standard output carries exactly one JSON document;
//! messages always go to standard error.

mod asked;
mod blocks;
mod compensate;
mod diagnose;
mod diagnosed;
mod effects;
mod export;
mod failure;
mod history;
mod identify;
mod import;
mod integrate;
mod interrupt;
mod output;
mod own_options;
mod plain;
mod plan;
mod progress_line;
mod record;
mod report;
mod requested;
mod robots;
mod simulate;
mod standards;
mod test_cube;
mod verify;
mod window;
mod words;

use std::path::PathBuf;
use std::process::ExitCode;
use std::thread::{self, Builder, ScopedJoinHandle};

use anyhow::Error;
use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

use crate::text::{Language, choose, current};
use crate::unfinished;

use failure::Failure;

const EXIT_STATUS: &str = "Exit status: 0 done; 2 the input or the arguments are wrong, and nothing was \
written; 1 the program failed, or some of many targets could not be worked on.";

/// Calibrates a robot: finds where measurement and simulation disagree, and writes the table
/// that the controller reads
#[derive(Debug, Parser)]
#[command(name = "truepose", version, about, long_about = None, after_help = EXIT_STATUS)]
#[command(override_usage = "truepose [OPTIONS] [FILE]\n       truepose [OPTIONS] <COMMAND>")]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Session or model to open in the window
    file: Option<PathBuf>,
    /// Language of reports and messages: en, de or zh; otherwise that of the environment (`LC_ALL`, `LC_MESSAGES`, LANG)
    // A command may have a field of this name, for the language of a program.
    #[arg(id = "spoken", long = "language", global = true, value_name = "CODE", value_parser = language)]
    language: Option<Language>,
}

fn language(code: &str) -> Result<Language, String> {
    // Tests look for what no catalogue has.
    if cfg!(debug_assertions) && code == "marked" {
        return Ok(Language::Marked);
    }
    Language::of_code(code).ok_or_else(|| "expected en, de or zh".to_owned())
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Make a session by simulation: from a scenario, or of a robot with hidden effects
    Simulate(Box<simulate::Simulate>),
    /// List the robots of the library, or write one as a robot file
    Robots(robots::Robots),
    /// Make a session of a file that an instrument wrote
    Import(Box<import::Import>),
    /// Identify a session's robot: the full model, or the paper's method by regions
    Identify(identify::Identify),
    /// Find what is missing, name it, and prove it on unseen samples
    Diagnose(diagnose::Diagnose),
    /// Say what to measure next, or first
    Plan(plan::Plan),
    /// Check a model on another session
    Verify(verify::Verify),
    /// Correct the targets of a table or a robot program in place
    Compensate(compensate::Compensate),
    /// State accuracy and repeatability after ISO 230-2 and ISO 9283
    Standards(standards::Standards),
    /// Compare the sessions and models of a folder
    History(history::History),
    /// Record a stream of lines as a CSV file that grows
    Record(record::Record),
    /// Write the table that a controller reads
    Export(export::Export),
    /// Write the calibration report as HTML or PDF
    Report(report::Report),
    /// List the effects that the program knows
    Effects(effects::Effects),
    /// Put truepose into the menus: desktop entry, icons, file type, man pages, shell completions
    Integrate(integrate::Integrate),
    /// Print the completions of a shell
    #[command(hide = true)]
    Completions(integrate::Completions),
    /// Print a man page
    #[command(hide = true)]
    Man(integrate::Man),
}

/// Runs the program with the process's arguments.
pub fn run() -> ExitCode {
    let arguments = match Arguments::try_parse().and_then(one_thing) {
        Ok(arguments) => arguments,
        Err(error) => return complain_about_arguments(&error),
    };
    choose(arguments.language.unwrap_or_else(Language::of_system));
    // Without it an unfinished file stays until the next write into its folder.
    let _ = end_at_signals();
    let done = match arguments.command {
        None => window::open(arguments.file),
        Some(command) if cfg!(windows) => with_large_stack(|| command.run()),
        Some(command) => command.run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// A file for the window or a command. Clap's own rule for this would forbid `--language` before a command too.
fn one_thing(arguments: Arguments) -> Result<Arguments, clap::Error> {
    if arguments.command.is_some() && arguments.file.is_some() {
        let text = "a command cannot be used with a file before it";
        return Err(Arguments::command().error(ErrorKind::ArgumentConflict, text));
    }
    Ok(arguments)
}

/// At SIGINT and SIGTERM unfinished files are removed, and the program ends as it would have without
/// this, at once, whatever it is at; but for the first SIGINT of a command that has an answer so far.
#[cfg(unix)]
fn end_at_signals() -> std::io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    // What a shell has this program ignore (in the background, say) stays ignored.
    let ignored = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = ignored
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    let heard = |signal: &i32| (ignored.unwrap_or(0) >> (signal - 1)) & 1 == 0;
    let mut signals = Signals::new([SIGINT, SIGTERM].into_iter().filter(heard))?;
    let spoken = current();
    Builder::new().name("signals".to_owned()).spawn(move || {
        choose(spoken);
        let ends = |signal: &i32| *signal != SIGINT || !interrupt::is_answered();
        if let Some(signal) = signals.forever().find(ends) {
            unfinished::remove_all();
            let _ = emulate_default_handler(signal);
        }
    })?;
    Ok(())
}

#[cfg(not(unix))]
fn end_at_signals() -> std::io::Result<()> {
    Ok(())
}

/// Does it in a thread with the stack that Linux gives: of a program's first thread Windows makes an eighth of that, and
/// the C library of the GNU toolchain calculates with other rounding there than in threads.
fn with_large_stack(work: impl FnOnce() -> Result<(), Failure> + Send) -> Result<(), Failure> {
    let spoken = current();
    thread::scope(|scope| {
        let thread = Builder::new().stack_size(8 << 20);
        let speaking = move || {
            choose(spoken);
            work()
        };
        let done = thread
            .spawn_scoped(scope, speaking)
            .map(ScopedJoinHandle::join);
        match done {
            Ok(Ok(done)) => done,
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            Err(error) => {
                let error = Error::from(error);
                Err(Failure::Failed(
                    error.context(text!("no thread can be started")),
                ))
            }
        }
    })
}

impl Command {
    fn run(self) -> Result<(), Failure> {
        match self {
            Self::Simulate(command) => command.run(),
            Self::Robots(command) => command.run(),
            Self::Import(command) => command.run(),
            Self::Diagnose(command) => command.run(),
            Self::Plan(command) => command.run(),
            Self::Verify(command) => command.run(),
            Self::Compensate(command) => command.run(),
            Self::Standards(command) => command.run(),
            Self::Export(command) => command.run(),
            Self::History(command) => command.run(),
            Self::Record(command) => command.run(),
            Self::Report(command) => command.run(),
            Self::Identify(command) => command.run(),
            Self::Effects(command) => command.run(),
            Self::Integrate(command) => command.run(Arguments::command()),
            Self::Completions(command) => command.run(Arguments::command()),
            Self::Man(command) => command.run(Arguments::command()),
        }
    }
}

/// Help and version are no errors; anything else is a wrong argument.
fn complain_about_arguments(error: &clap::Error) -> ExitCode {
    // Where standard output or error is closed there is nothing left to write to.
    let _ = error.print();
    if error.use_stderr() {
        ExitCode::from(failure::WRONG_INPUT)
    } else {
        ExitCode::SUCCESS
    }
}
