//! `truepose record` against sockets of this machine, and `truepose history` on a folder, both from
//! outside.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, UdpSocket};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use serde_json::Value;

/// A folder that is there for one test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("truepose {name} ü {}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn truepose() -> Command {
    crate::program::truepose()
}

fn record(source: &str, out: &Path, more: &[&str]) -> Child {
    let mut command = truepose();
    command
        .args(["record", source, "--out"])
        .arg(out)
        .args(more);
    command
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn messages(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The file once it has this text, or what it has after a while.
fn grown(path: &Path, wanted: &str) -> String {
    let mut text = String::new();
    for _ in 0..500 {
        text = std::fs::read_to_string(path).unwrap_or_default();
        if text == wanted {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    text
}

#[test]
fn a_stream_over_tcp_is_recorded_line_by_line_while_it_runs() {
    let folder = Folder::new("tcp");
    let out = folder.file("stream.csv");
    let server = TcpListener::bind("127.0.0.1:0").unwrap();
    let source = format!("tcp://{}", server.local_addr().unwrap());
    let child = record(&source, &out, &[]);
    let (mut stream, _) = server.accept().unwrap();
    stream
        .write_all(b"q1_deg;x_mm;y_mm;z_mm\r\n0;250,5;0;300\r\n10;24")
        .unwrap();
    let first = "q1_deg,x_mm,y_mm,z_mm\n0,250.5,0,300\n";
    assert_eq!(grown(&out, first), first, "half a line waits");
    stream
        .write_all(b"6,2;43,4;300\r\nnothing\r\n20;234,9;85,5;300\r\n30;2")
        .unwrap();
    drop(stream);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
    let all = format!("{first}10,246.2,43.4,300\n20,234.9,85.5,300\n");
    assert_eq!(std::fs::read_to_string(&out).unwrap(), all);
    let said = messages(&output);
    for part in [
        "line 4 of the stream is excluded: 1 cell below 4 headings",
        "line 6 of the stream is excluded: ",
        "3 lines recorded",
    ] {
        assert!(said.contains(part), "{said}");
    }
    // The recording is a session's samples, as the window follows them.
    let robot = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/imports/robot.json"
    ))
    .unwrap();
    let session = format!(
        "{{\"format\":\"truepose-session/1\",\"name\":\"s\",\"robot\":{robot},\"samples\":{{\"file\":\"stream.csv\"}}}}"
    );
    std::fs::write(folder.file("s.json"), session).unwrap();
    assert_eq!(
        truepose::sessions::load(folder.file("s.json"))
            .unwrap()
            .session
            .samples
            .len(),
        3
    );
}

#[test]
fn datagrams_are_recorded_until_there_are_enough() {
    let folder = Folder::new("udp");
    let out = folder.file("stream.csv");
    let mut child = record(
        "udp://:0",
        &out,
        &["--columns", "time_s,x_mm,y_mm", "--lines", "3"],
    );
    // It says on which port it listens.
    let mut stderr = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    stderr.read_line(&mut line).unwrap();
    let port = line
        .trim()
        .rsplit(':')
        .next()
        .unwrap()
        .parse::<u16>()
        .unwrap();
    let sender = UdpSocket::bind("127.0.0.1:0").unwrap();
    for datagram in ["0.1 1 2", "0.2 3 4\n0.3 5 6\n", "0.4 7 8"] {
        sender
            .send_to(datagram.as_bytes(), ("127.0.0.1", port))
            .unwrap();
    }
    let mut said = String::new();
    stderr.read_to_string(&mut said).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0), "{said}");
    let text = std::fs::read_to_string(&out).unwrap();
    assert_eq!(text, "time_s,x_mm,y_mm\n0.1,1,2\n0.2,3,4\n0.3,5,6\n");
}

#[test]
fn what_cannot_be_recorded_is_refused_and_leaves_no_file() {
    let folder = Folder::new("refused");
    let out = folder.file("stream.csv");
    let run = |source: &str, out: &Path| record(source, out, &[]).wait_with_output().unwrap();
    for (source, says) in [
        (
            "serial:///dev/null",
            "expected tcp://HOST:PORT or udp://:PORT",
        ),
        ("localhost", "expected tcp://HOST:PORT or udp://:PORT"),
        ("tcp://localhost:99999", "with PORT from 0 to 65535"),
        ("tcp://localhost", "expected tcp://HOST:PORT"),
    ] {
        let output = run(source, &out);
        assert_eq!(output.status.code(), Some(2), "{source}");
        assert!(messages(&output).contains(says), "{}", messages(&output));
    }
    // Nobody listens on a port that was just given back.
    let port = TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap()
        .port();
    let output = run(&format!("tcp://127.0.0.1:{port}"), &out);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        messages(&output).contains("cannot connect"),
        "{}",
        messages(&output)
    );
    // A stream without headings, and one that brings nothing.
    let server = TcpListener::bind("127.0.0.1:0").unwrap();
    let source = format!("tcp://{}", server.local_addr().unwrap());
    for (bytes, says) in [
        (&b"1,2,3\n"[..], "no headings; expected --columns"),
        (b"", "ended without a measurement"),
    ] {
        let child = record(&source, &out, &[]);
        server.accept().unwrap().0.write_all(bytes).unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(messages(&output).contains(says), "{}", messages(&output));
    }
    assert!(!out.exists());
    std::fs::write(&out, "kept").unwrap();
    let output = run(&source, &out);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(&out).unwrap(), "kept");
}

/// Points of an axis with this zero offset and radius, seen with some noise that repeats.
fn session(folder: &Folder, name: &str, offset_deg: f64, radius_mm: f64, start_s: f64) {
    let mut csv = String::from("q1_deg,x_mm,y_mm,z_mm,time_s\n");
    for k in 0..40_u32 {
        let q = -80.0 + 4.0 * f64::from(k);
        let noise = |n: u32| 0.02 * (f64::from(k * 7 + n * 13 + 1) * 1.618).sin();
        let theta = (q + offset_deg).to_radians();
        let (x, y) = (radius_mm * theta.cos(), radius_mm * theta.sin());
        csv += &format!(
            "{q},{},{},{},{}\n",
            x + noise(1),
            y + noise(2),
            300.0 + noise(3),
            start_s + f64::from(k)
        );
    }
    std::fs::write(folder.file(&format!("{name}.csv")), csv).unwrap();
    let robot = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/imports/robot.json"
    ))
    .unwrap();
    let document = format!(
        "{{\"format\":\"truepose-session/1\",\"name\":\"{name}\",\"robot\":{robot},\"samples\":{{\"file\":\"{name}.csv\"}}}}"
    );
    std::fs::write(folder.file(&format!("{name}.json")), document).unwrap();
}

fn history(folder: &Folder) -> Value {
    let output = truepose()
        .arg("history")
        .arg(&folder.0)
        .arg("--json")
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn a_folder_tells_what_changed_from_session_to_session() {
    let folder = Folder::new("history");
    session(&folder, "run 9", -0.35, 248.6, 0.0);
    session(&folder, "run 10", -0.35, 248.6, 0.0);
    session(&folder, "run 11", -0.29, 248.6, 0.0);
    std::fs::write(
        folder.file("broken.json"),
        "{\"format\":\"truepose-session/1\",\"name\":",
    )
    .unwrap();
    std::fs::write(
        folder.file("bad.json"),
        "{\"format\":\"truepose-session/1\",\"name\":\"b\"}",
    )
    .unwrap();
    std::fs::write(
        folder.file("other.json"),
        "{\"format\":\"truepose-scenario/1\"}",
    )
    .unwrap();
    let model = folder.file("run 9.model.json");
    let made = truepose()
        .arg("identify")
        .arg(folder.file("run 9.json"))
        .arg("--out")
        .arg(&model)
        .output()
        .unwrap();
    assert_eq!(made.status.code(), Some(0), "{}", messages(&made));
    let told = history(&folder);
    assert_eq!(told["format"], "truepose-history/1");
    let not_read = told["not_read"].as_array().unwrap();
    let not_read: Vec<&str> = not_read
        .iter()
        .map(|n| n["file"].as_str().unwrap())
        .collect();
    assert_eq!(not_read, ["bad.json", "broken.json"]);
    let robot = &told["robots"][0];
    assert_eq!(robot["robot"], "lamp column");
    assert!(robot["ordered_by"].as_str().unwrap().contains("file name"));
    let entries = robot["entries"].as_array().unwrap();
    let files: Vec<&str> = entries
        .iter()
        .map(|e| e["file"].as_str().unwrap())
        .collect();
    assert_eq!(
        files,
        [
            "run 9.json",
            "run 9.model.json",
            "run 10.json",
            "run 11.json"
        ]
    );
    assert_eq!(entries[0]["samples_hash"], entries[1]["samples_hash"]);
    let change = |entry: &Value, name: &str| {
        let all = entry["changes"].as_array().unwrap();
        all.iter()
            .find(|change| change["name"] == name)
            .unwrap()
            .clone()
    };
    let still = change(&entries[2], "offset_deg");
    assert_eq!(still["significant"], false, "{still}");
    let moved = change(&entries[3], "offset_deg");
    assert_eq!(
        (&moved["significant"], &moved["since"]),
        (&Value::Bool(true), &Value::from("run 10.json"))
    );
    assert!(
        (moved["difference"].as_f64().unwrap() - 0.06).abs() < 0.005,
        "{moved}"
    );
    assert_eq!(change(&entries[3], "delta_mm")["significant"], false);
    let gap = |entry: &Value, which: &str| entry["gap"][which].as_f64().unwrap();
    assert!(gap(&entries[2], "with_first_mm") < 0.04);
    // 0.06° at 248.6 mm.
    assert!((gap(&entries[3], "with_first_mm") - 0.26).abs() < 0.02);
    assert!(gap(&entries[3], "after_mm") < 0.04);
    let text = truepose().arg("history").arg(&folder.0).output().unwrap();
    let text = String::from_utf8_lossy(&text.stdout).into_owned();
    // The last session is the one that changed, by its offset.
    let line = |start: &str| {
        let found = text.lines().find(|line| line.trim().starts_with(start));
        found
            .unwrap_or_else(|| panic!("{start}: {text}"))
            .to_owned()
    };
    let changed = |start: &str| line(start).contains("Joint zero offset: offset 0.06");
    assert!(changed("run 11") && !changed("run 10"), "{text}");
}

#[test]
fn sessions_with_a_time_are_ordered_by_it_and_an_empty_folder_is_refused() {
    let folder = Folder::new("times");
    session(&folder, "b", -0.3, 248.6, 1.7e9);
    session(&folder, "a", -0.3, 248.6, 1.8e9);
    let told = history(&folder);
    let entries = told["robots"][0]["entries"].as_array().unwrap();
    assert_eq!(
        (&entries[0]["file"], &entries[1]["file"]),
        (&Value::from("b.json"), &Value::from("a.json"))
    );
    let empty = Folder::new("empty");
    for path in [empty.0.clone(), empty.file("nowhere")] {
        let output = truepose().arg("history").arg(path).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(
            messages(&output).contains("a folder"),
            "{}",
            messages(&output)
        );
    }
}
