//! Changes one operator of the program at a time and looks whether a test fails: what no test notices is not
//! tested.
//!
//! ```text
//! cargo run --release --manifest-path mutation/Cargo.toml -- crates/base/src/kinematics crates/calibrate/src/fit
//! cargo run --release --manifest-path mutation/Cargo.toml -- --every 7 crates/model/src/effects
//! cargo run --release --manifest-path mutation/Cargo.toml -- --tests programs --tests export crates/deliver/src/programs
//! ```
//!
//! A tool that compiles the program anew for every change needs days for some thousand changes. Here all of
//! them are compiled at once, each behind a switch (`places`), and an environment variable says which one is
//! on; every test runs once alone to see which switches it passes (`tests`), and a change is tried only on
//! the tests that pass it, the quickest first. The copy lies in `target/mutation`, and what survived in
//! `target/mutation/survivors.txt`.

mod compile;
mod copy;
mod places;
mod tests;

use std::path::Path;
use std::process::ExitCode;

use places::Change;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("mutation: {why}");
            ExitCode::FAILURE
        }
    }
}

/// What goes wrong is said and ends the run.
type Outcome<T> = Result<T, String>;

fn run() -> Outcome<()> {
    let mut every = 1;
    let mut wanted = Vec::new();
    let mut under = Vec::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--every" {
            let count = arguments.next().and_then(|n| n.parse().ok());
            every = count.filter(|n| *n > 0).ok_or("--every wants a number")?;
        } else if argument == "--tests" {
            wanted.push(
                arguments
                    .next()
                    .ok_or("--tests wants a part of their names")?,
            );
        } else {
            under.push(argument);
        }
    }
    if under.is_empty() {
        return Err("which folders or files? for example: crates/base/src/kinematics crates/calibrate/src/fit".to_owned());
    }
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let copy = copy::make(&home)?;
    let mut changes = places::find(&copy, &under, every)?;
    println!("{} operators to change", changes.len());
    let binaries = compile::all(&copy, &mut changes)?;
    println!("{} compile; every test runs once alone", changes.len());
    let tests = tests::trace(&copy, &binaries, &wanted)?;
    let mut survivors = Vec::new();
    let (mut unseen, mut failed) = (0, 0);
    for (index, change) in changes.iter().enumerate() {
        match tests::try_out(&copy, &tests, change) {
            tests::End::Noticed => failed += 1,
            tests::End::NotReached => {
                unseen += 1;
                survivors.push((change, "no test comes here"));
            }
            tests::End::Survived => survivors.push((change, "no test fails")),
        }
        if (index + 1) % 100 == 0 {
            println!("{} tried, {} not noticed", index + 1, survivors.len());
            write(&copy, &survivors)?;
        }
    }
    write(&copy, &survivors)?;
    println!(
        "{} changes: {failed} noticed, {} not, and where {unseen} are no test comes",
        changes.len(),
        survivors.len() - unseen,
    );
    Ok(())
}

fn write(copy: &Path, survivors: &[(&Change, &str)]) -> Outcome<()> {
    let lines = survivors
        .iter()
        .map(|(change, why)| format!("{}: {why}: {}\n", change.place(), change.line.trim()));
    let path = copy.join("../survivors.txt");
    std::fs::write(&path, lines.collect::<String>()).map_err(|e| format!("{}: {e}", path.display()))
}
