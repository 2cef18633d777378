//! A walk while lines come over a real local socket, whose connection ends in the middle: the session
//! that they become stays consistent, and none of them is lost.

use std::io::Write as _;
use std::net::TcpListener;
use std::path::Path;
use std::time::{Duration, Instant};

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::{any, back_and_forth, consistent, frame, kinds, prepared};
use crate::gui::App;
use crate::gui::file_state::recording::RecordingRequest;
use crate::gui::testing::workbench;
use crate::gui::workbench::{Command, Task};

const LINES: usize = 120;
/// What is done meanwhile: nothing that opens another session, ends the recording or asks the system.
const MEANWHILE: [&str; 17] = [
    "Blend",
    "Colour",
    "Component",
    "Drag",
    "Edit",
    "EndDrag",
    "Fit",
    "GoTo",
    "Heat",
    "Hover",
    "Look",
    "Magnify",
    "Mark",
    "Panes",
    "Prefer",
    "Redo",
    "Select",
];

fn lines() -> Vec<String> {
    let line = |k: usize| {
        let degrees = -150.0 + 2.5 * k as f64;
        let (sin, cos) = (degrees + 0.1).to_radians().sin_cos();
        format!("{degrees},{:.4},{:.4},300\n", 250.3 * cos, 250.3 * sin)
    };
    (0..LINES).map(line).collect()
}

/// Sends them to the window when it connects, over two connections.
fn serve(server: &TcpListener) -> std::io::Result<()> {
    for half in lines().chunks(LINES / 2) {
        let (mut stream, _) = server.accept()?;
        for line in half {
            stream.write_all(line.as_bytes())?;
            std::thread::sleep(Duration::from_millis(3));
        }
    }
    Ok(())
}

/// Commands that come meanwhile, at least.
const LEAST: usize = 20;

/// Lines that come meanwhile become samples, and none is lost.
///
/// # Panics
/// One is lost, or the workbench is not consistent.
#[allow(
    clippy::disallowed_methods,
    reason = "a test that waits for a socket needs an end"
)]
pub fn lines_that_come_meanwhile() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = prepared(folder.path());
    let mut bench = workbench();
    let session = concat!(env!("CARGO_MANIFEST_DIR"), "/sessions/paper-30.json");
    bench.execute(Command::OpenFile(session.into()));
    bench.receive();
    let mut app = App::on(bench);
    let ctx = egui::Context::default();
    let server = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = format!("tcp://{}", server.local_addr().expect("it has one"));
    let serving = std::thread::spawn(move || serve(&server));
    let table = folder.path().join("live.csv");
    app.bench()
        .execute(Command::Record(Box::new(RecordingRequest {
            address,
            columns: "q1_deg, x_mm, y_mm, z_mm".to_owned(),
            path: table.clone(),
        })));
    assert!(
        app.bench().recording().is_some(),
        "{:?}",
        app.bench().view().message
    );
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let end = Instant::now() + Duration::from_mins(2);
    let mut done = 0;
    // However soon the lines are there, some commands come meanwhile.
    while app.bench().loaded_session().len() < LINES || !is_live(&mut app, &table) || done <= LEAST
    {
        assert!(
            Instant::now() < end,
            "{} lines",
            app.bench().loaded_session().len()
        );
        let command = any::command(&mut random, app.bench(), &files);
        let kind = kinds::of(&command);
        let edits = matches!(kind, "Edit" | "Drag" | "Redo");
        if MEANWHILE.contains(&kind) && (!edits || is_live(&mut app, &table)) && !opens(&command) {
            app.bench().execute(command);
            done += 1;
        }
        app.bench().execute(Command::LookAtDisk);
        app.bench().receive();
        consistent(app.bench());
        if done % 7 == 0 {
            frame(&ctx, &mut app, &mut random);
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    back_and_forth(app.bench());
    assert!(serving.join().expect("it ended").is_ok());
    app.bench().execute(Command::Stop(Task::Recording));
    app.bench().receive();
    let text = std::fs::read_to_string(&table).expect("the table is there");
    let kept: Vec<&str> = text.lines().skip(1).map(str::trim).collect();
    let sent = lines();
    let sent: Vec<&str> = sent.iter().map(|line| line.trim()).collect();
    assert_eq!(kept, sent);
}

/// Whether the session of the recording is open.
fn is_live(app: &mut App, table: &Path) -> bool {
    let file = app.bench().file().map(Path::to_path_buf);
    file.is_some_and(|file| file == table.with_extension("json"))
}

/// Whether a change brings another session.
fn opens(command: &Command) -> bool {
    match command {
        Command::Edit(edit) | Command::Drag(edit) => {
            ["Open", "OpenModel", "Setup", "Correct"].contains(&kinds::edit(edit))
        }
        _ => false,
    }
}
