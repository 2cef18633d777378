//! Which tests pass which changes, and whether one of them fails when a change is on.

use std::collections::BTreeSet;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use crate::Outcome;
use crate::places::Change;

/// One test, what it passes and how long it takes.
pub struct Test {
    binary: PathBuf,
    name: String,
    passes: BTreeSet<u32>,
    took: Duration,
}

/// How a change ended.
pub enum End {
    Noticed,
    NotReached,
    Survived,
}

/// Tests of a change that take longer together than this are not all run: the quick ones speak for them.
const MOST: Duration = Duration::from_secs(30);
/// Tests run in one process at most so long.
const AT_ONCE: Duration = Duration::from_secs(2);

/// Every test alone, or those with one of the wanted parts in their names; as many at once as there are
/// processors.
pub fn trace(copy: &Path, binaries: &[PathBuf], wanted: &[String]) -> Outcome<Vec<Test>> {
    let mut names = Vec::new();
    for binary in binaries {
        let listed = Command::new(binary)
            .args(["--list", "--format", "terse"])
            .current_dir(copy)
            .output()
            .map_err(|e| format!("{}: {e}", binary.display()))?;
        let text = String::from_utf8_lossy(&listed.stdout).into_owned();
        let tests = text.lines().filter_map(|l| l.strip_suffix(": test"));
        names.extend(tests.map(|name| (binary.clone(), name.to_owned())));
    }
    names.retain(|(_, name)| {
        wanted.is_empty() || wanted.iter().any(|part| name.contains(part.as_str()))
    });
    let traces = copy.join("../traces");
    std::fs::create_dir_all(&traces).map_err(|e| format!("{}: {e}", traces.display()))?;
    let waiting = Mutex::new(names.into_iter().enumerate());
    let done = Mutex::new(Vec::new());
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let next = waiting.lock().ok().and_then(|mut w| w.next());
                    let Some((index, (binary, name))) = next else {
                        break;
                    };
                    let file = traces.join(index.to_string());
                    let _ = std::fs::remove_file(&file);
                    let start = Instant::now();
                    let run = command(copy, &binary, &[&name])
                        .env("MUTATION_TRACE", &file)
                        .spawn();
                    let good =
                        run.is_ok_and(|mut child| ended_well(&mut child, Duration::from_mins(10)));
                    let took = start.elapsed();
                    let passed = std::fs::read(&file).unwrap_or_default();
                    let passes = passed
                        .chunks_exact(4)
                        .map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]))
                        .collect();
                    if !good {
                        // A test that fails by itself says nothing.
                        println!("left out, as it fails without a change: {name}");
                    } else if let Ok(mut done) = done.lock() {
                        done.push(Test {
                            binary,
                            name,
                            passes,
                            took,
                        });
                    }
                }
            });
        }
    });
    let mut tests = done.into_inner().map_err(|e| e.to_string())?;
    tests.sort_by(|a, b| a.took.cmp(&b.took).then(a.name.cmp(&b.name)));
    Ok(tests)
}

fn command(copy: &Path, binary: &Path, names: &[&str]) -> Command {
    let mut command = Command::new(binary);
    command
        .arg("--exact")
        .args(names)
        .current_dir(copy)
        .env("CARGO_MANIFEST_DIR", copy)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .process_group(0);
    command
}

fn ended_well(child: &mut Child, within: Duration) -> bool {
    let start = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) if start.elapsed() < within => std::thread::sleep(Duration::from_millis(2)),
            // What does not end is noticed as well; it may have started programs that do not end either.
            _ => {
                let group = format!("-{}", child.id());
                let _ = Command::new("kill").args(["-KILL", "--", &group]).status();
                let _ = child.kill();
                let _ = child.wait();
                return false;
            }
        }
    }
}

/// Runs the tests that pass a change with it on, the quickest first, until one fails.
pub fn try_out(copy: &Path, tests: &[Test], change: &Change) -> End {
    let own: Vec<&Test> = tests
        .iter()
        .filter(|t| t.passes.contains(&change.id))
        .collect();
    if own.is_empty() {
        return End::NotReached;
    }
    let mut spent = Duration::ZERO;
    let mut rest = own.as_slice();
    while let Some(first) = rest.first() {
        if spent > MOST {
            break;
        }
        let mut together = Duration::ZERO;
        let count = rest.iter().take_while(|t| {
            together += t.took;
            t.binary == first.binary && together < AT_ONCE
        });
        let count = count.count().max(1);
        let (now, later) = rest.split_at(count);
        let took: Duration = now.iter().map(|t| t.took).sum();
        let names: Vec<&str> = now.iter().map(|t| t.name.as_str()).collect();
        let mut run = command(copy, &first.binary, &names);
        let run = run.env("MUTATION", change.id.to_string()).spawn();
        let within = Duration::from_secs(10) + 10 * took;
        if !run.is_ok_and(|mut child| ended_well(&mut child, within)) {
            return End::Noticed;
        }
        spent += took;
        rest = later;
    }
    End::Survived
}
