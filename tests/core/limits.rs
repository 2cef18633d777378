//! What a file may cost, and what is done with numbers beyond any robot's range: the table of
//! `SECURITY.md`, each row at a size that the old growth would not get through: with the square of it
//! a run ends at its limits of memory and time.
//!
//! Times are compared by the slow script alone (`TRUEPOSE_COMPARE_TIMES=1`), as a busy machine would fail any
//! change: twice the input costs at most 2.2 times the processor time, with a margin for noise three times and
//! a fifth of a second.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::io::Write;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread::sleep;
use std::time::Duration;

use serde_json::{Value, json};

/// What a run said, and its processor time in s.
pub(crate) struct Ran {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
    pub(crate) cpu_s: f64,
}

/// Runs the program in a folder with 2 GiB of address space and 60 s of processor time.
pub(crate) fn truepose(folder: &Path, arguments: &[&str]) -> Ran {
    let mut command = crate::program::english(Command::new("bash"));
    let script = "ulimit -v 2097152 -t 60; \"$@\"; code=$?; times >times.txt; exit $code";
    command.args(["-c", script, "bash", env!("CARGO_BIN_EXE_truepose")]);
    let Output {
        status,
        stdout,
        stderr,
    } = command
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    let times = fs::read_to_string(folder.join("times.txt")).unwrap();
    let seconds = |text: &str| -> f64 {
        let (minutes, seconds) = text.trim_end_matches('s').split_once('m').unwrap();
        60.0 * minutes.parse::<f64>().unwrap() + seconds.parse::<f64>().unwrap()
    };
    Ran {
        code: status.code(),
        stdout: String::from_utf8_lossy(&stdout).into_owned(),
        stderr: String::from_utf8_lossy(&stderr).into_owned(),
        cpu_s: times.split_whitespace().skip(2).map(seconds).sum(),
    }
}

/// Runs something of a size; where times are compared, of twice that as well.
pub(crate) fn grows_linearly(what: &str, code: i32, run: &dyn Fn(usize) -> Ran, size: usize) {
    let times = std::env::var_os("TRUEPOSE_COMPARE_TIMES").is_some();
    let runs: Vec<Ran> = (1..=1 + usize::from(times))
        .map(|k| run(k * size))
        .collect();
    for ran in &runs {
        assert_eq!(ran.code, Some(code), "{what}: {}", ran.stderr);
        assert!(
            ran.stderr.len() < 100_000,
            "{what}: {} bytes",
            ran.stderr.len()
        );
    }
    let [small, large] = &runs[..] else {
        return;
    };
    let most_s = 3.0 * small.cpu_s + 0.2;
    assert!(
        large.cpu_s < most_s,
        "{what}: {} s, twice the size {} s",
        small.cpu_s,
        large.cpu_s
    );
}

pub(crate) fn session() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/paper-30.json");
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// A folder with a sound session's samples, in which documents are written.
pub(crate) fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/paper-30.csv");
    fs::copy(samples, folder.path().join("paper-30.csv")).unwrap();
    folder
}

/// Identifies a session that a change was made to.
pub(crate) fn identified(folder: &Path, change: &dyn Fn(&mut Value)) -> Ran {
    let mut document = session();
    change(&mut document);
    fs::write(folder.join("s.json"), document.to_string()).unwrap();
    truepose(folder, &["identify", "s.json"])
}

/// Identifies the sound session with the robot of a file.
pub(crate) fn of_description(folder: &Path, kind: &str, text: &str, tip: &str) -> Ran {
    fs::write(folder.join("r.xml"), text).unwrap();
    let robot = json!({ "name": "r", kind: { "file": "r.xml", "base": "l0", "tip": tip } });
    identified(folder, &|document| document["robot"] = robot.clone())
}

#[test]
fn unknown_keys_cost_in_proportion_and_one_message() {
    let folder = folder();
    let run = |count: usize| {
        identified(folder.path(), &|document| {
            for k in 0..count {
                document[format!("key {k}")] = k.into();
            }
        })
    };
    grows_linearly("unknown keys", 0, &run, 60_000);
    assert!(run(1000).stderr.contains("980 more keys are not known"));
}

#[test]
fn names_cost_in_proportion() {
    let folder = folder();
    let rows = |count: usize, heading: &str| {
        let mut text = format!("q1_deg,x_mm,y_mm,z_mm,{heading}\n");
        for k in 0..count {
            text += &format!("{},250,{},300,T{k}\n", k % 90, k % 7);
        }
        fs::write(folder.path().join("n.csv"), text).unwrap();
    };
    let run = |count: usize| {
        rows(count, "target");
        identified(folder.path(), &|document| {
            document["samples"]["file"] = "n.csv".into();
            document["targets"] = json!({});
            for k in 0..count {
                document["targets"][format!("T{k}")] = json!([0, 0, 0]);
            }
        })
    };
    grows_linearly("targets", 0, &run, 20_000);
    // Each setup has a frame of its own, which is fitted.
    let run = |count: usize| {
        rows(count, "setup");
        identified(folder.path(), &|document| {
            document["samples"]["file"] = "n.csv".into();
        })
    };
    grows_linearly("setups", 2, &run, 40_000);
    assert!(
        run(2000)
            .stderr
            .contains("2000; expected at most 300 in one session")
    );
}

#[test]
fn descriptions_cost_in_proportion() {
    let folder = folder();
    let repeated =
        |count: usize, one: &dyn Fn(usize) -> String| (0..count).map(one).collect::<String>();
    let links = |count: usize| {
        let all = repeated(count, &|k| format!("<link name='l{k}'/>\n"));
        of_description(
            folder.path(),
            "urdf",
            &format!("<robot name='r'>{all}</robot>"),
            "l1",
        )
    };
    grows_linearly("links", 2, &links, 50_000);
    let ties = |count: usize| {
        let bodies = repeated(count, &|k| {
            format!("<body name='l{k}'><joint name='j{k}'/></body>")
        });
        let ties = repeated(count, &|k| format!("<joint joint1='j{k}' joint2='j0'/>"));
        let text =
            format!("<mujoco><worldbody>{bodies}</worldbody><equality>{ties}</equality></mujoco>");
        of_description(folder.path(), "mjcf", &text, "l1")
    };
    grows_linearly("ties", 2, &ties, 12_000);
    let attributes = |count: usize| {
        let all = repeated(count, &|k| format!("a{k}='' "));
        of_description(
            folder.path(),
            "urdf",
            &format!("<robot><link {all}/></robot>"),
            "l1",
        )
    };
    grows_linearly("attributes", 2, &attributes, 100_000);
    let entities = |count: usize| {
        let all = repeated(count, &|k| format!("<!ENTITY a{k} 'x'>"));
        let text = format!("<!DOCTYPE r [{all}]><robot name='&a1;'/>");
        of_description(folder.path(), "urdf", &text, "l1")
    };
    grows_linearly("entities", 2, &entities, 50_000);
    let written_out = |count: usize| {
        let text = format!(
            "<!DOCTYPE r [<!ENTITY a '{}'>]><robot>{}</robot>",
            "x".repeat(10 * count),
            "<link name='&a;'/>".repeat(count)
        );
        of_description(folder.path(), "urdf", &text, "l1")
    };
    grows_linearly("an entity written out", 2, &written_out, 50_000);
    let classes = |count: usize| {
        let text = format!(
            "<mujoco>{}{}</mujoco>",
            repeated(count, &|k| format!("<default class='c{k}'>")),
            "</default>".repeat(count)
        );
        of_description(folder.path(), "mjcf", &text, "l1")
    };
    grows_linearly("classes", 2, &classes, 50_000);
}

#[test]
fn a_description_has_so_many_elements_and_no_more() {
    let folder = folder();
    let all = "<link name='l'/>".repeat(100_000);
    let ran = of_description(
        folder.path(),
        "urdf",
        &format!("<robot>{all}</robot>"),
        "l1",
    );
    assert!(
        ran.code == Some(2) && ran.stderr.contains("nodes limit"),
        "{}",
        ran.stderr
    );
    assert!(ran.cpu_s < 2.0, "{} s", ran.cpu_s);
}

#[test]
fn targets_of_a_program_cost_in_proportion() {
    let folder = folder();
    fs::write(folder.path().join("p.json"), session().to_string()).unwrap();
    let made = truepose(folder.path(), &["identify", "p.json", "--out", "m.json"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let run = |count: usize| {
        let mut text = "q1_deg\n".to_owned();
        for k in 0..count {
            text += &format!("{}.{:03}\n", k % 80, k % 1000);
        }
        fs::write(folder.path().join("t.csv"), text).unwrap();
        let arguments = ["compensate", "m.json", "t.csv", "--out", "o.csv", "--force"];
        truepose(folder.path(), &arguments)
    };
    grows_linearly("targets of a program", 0, &run, 50_000);
}

#[test]
fn rows_cost_in_proportion() {
    let folder = folder();
    let run = |count: usize, command: &str| {
        let mut text = "q1_deg,x_mm,y_mm,z_mm\n".to_owned();
        for k in 0..count {
            let q = (80.0 * (2.0 * k as f64 / count as f64 - 1.0)).to_radians();
            // Scatter of a few hundredths of a millimetre, without a pattern that could be found.
            let by = |of: f64| {
                let phase = 12.9898 * k as f64 + 78.233 * of;
                0.1 * ((phase.sin() * 43_758.545_3).rem_euclid(1.0) - 0.5)
            };
            let (x, y) = (250.0 * (q + 0.01).cos(), 250.0 * (q + 0.01).sin());
            let (x, y, z) = (x + by(0.0), y + by(1.0), 300.0 + by(2.0));
            text += &format!("{:.5},{x:.4},{y:.4},{z:.4}\n", q.to_degrees());
        }
        fs::write(folder.path().join("rows.csv"), text).unwrap();
        let mut document = session();
        document["samples"]["file"] = "rows.csv".into();
        fs::write(folder.path().join("rows.json"), document.to_string()).unwrap();
        truepose(folder.path(), &[command, "rows.json", "--json"])
    };
    grows_linearly("rows", 0, &|count| run(count, "identify"), 300_000);
    grows_linearly("rows", 0, &|count| run(count, "diagnose"), 200_000);
}

#[test]
fn a_plan_for_more_joints_than_a_machine_has_is_refused() {
    let folder = folder();
    let of = |joints: usize| {
        let joint = |k: usize| {
            let axis = [[0, 0, 1], [0, 1, 0]][k % 2];
            json!({ "name": format!("j{k}"), "kind": "revolute", "axis": axis,
                "point_mm": [10 * k, 0, 5 * k], "limits": [-90, 90] })
        };
        let robot = json!({ "name": "r", "joints": (0..joints).map(joint).collect::<Vec<_>>(),
            "tool": { "position_mm": [500, 0, 300], "quaternion_wxyz": [1, 0, 0, 0] } });
        fs::write(folder.path().join("r.json"), robot.to_string()).unwrap();
        truepose(folder.path(), &["plan", "r.json", "--poses", "4"])
    };
    assert_eq!(of(3).code, Some(0));
    for joints in [31, 100] {
        let ran = of(joints);
        let says = format!("a robot with {joints} joints; poses are planned for at most 30");
        assert!(
            ran.code == Some(2) && ran.stderr.contains(&says) && ran.cpu_s < 2.0,
            "{}",
            ran.stderr
        );
    }
}

#[test]
fn a_recording_that_announces_a_text_of_gigabytes_takes_no_memory() {
    let folder = folder();
    fs::write(
        folder.path().join("robot.json"),
        session()["robot"].to_string(),
    )
    .unwrap();
    let mut bytes = recording(1);
    // The length of the topic's name: behind the magic, the record's head and two numbers.
    bytes[8 + 9 + 4..8 + 9 + 8].copy_from_slice(&u32::MAX.to_le_bytes());
    fs::write(folder.path().join("r.mcap"), bytes).unwrap();
    let arguments = "import r.mcap --as mcap --robot robot.json --out o.json";
    let ran = truepose(folder.path(), &arguments.split(' ').collect::<Vec<_>>());
    let says = "a record that cannot be read";
    assert!(
        ran.code == Some(2) && ran.stderr.contains(says),
        "{}",
        ran.stderr
    );
}

/// A recording in which so many topics are announced.
fn recording(channels: u32) -> Vec<u8> {
    fn text(text: &str) -> Vec<u8> {
        [
            &u32::try_from(text.len()).unwrap().to_le_bytes()[..],
            text.as_bytes(),
        ]
        .concat()
    }
    let magic = b"\x89MCAP0\r\n";
    let mut bytes = magic.to_vec();
    for k in 0..channels {
        let id = u16::try_from(k % 60_000).unwrap().to_le_bytes();
        let content = [
            &id[..],
            &[0, 0],
            &text(&format!("/t{k}")),
            &text("cdr"),
            &text(""),
        ]
        .concat();
        bytes.push(4);
        bytes.extend((content.len() as u64).to_le_bytes());
        bytes.extend(content);
    }
    bytes.push(2);
    bytes.extend(20_u64.to_le_bytes());
    bytes.extend([0; 20]);
    bytes.extend(magic);
    bytes
}

#[test]
fn topics_of_a_recording_cost_in_proportion() {
    let folder = folder();
    fs::write(
        folder.path().join("robot.json"),
        session()["robot"].to_string(),
    )
    .unwrap();
    let run = |count: usize| {
        let bytes = recording(u32::try_from(count).unwrap());
        fs::write(folder.path().join("r.mcap"), bytes).unwrap();
        let arguments = [
            "import",
            "r.mcap",
            "--as",
            "mcap",
            "--robot",
            "robot.json",
            "--out",
            "o.json",
        ];
        truepose(folder.path(), &arguments)
    };
    grows_linearly("channels", 2, &run, 100_000);
}

#[test]
fn a_robot_has_a_hundred_joints_at_most_whatever_it_is_given_as() {
    let folder = folder();
    let joints = 101;
    let mut urdf = "<robot name='r'><link name='l0'/>".to_owned();
    let mut mjcf = "<mujoco><worldbody><body name='l0'>".to_owned();
    for k in 0..joints {
        let next = k + 1;
        urdf += &format!(
            "<link name='l{next}'/><joint name='j{k}' type='revolute'><parent link='l{k}'/>\
             <child link='l{next}'/><origin xyz='0.1 0 0.1' rpy='1 0 0'/></joint>"
        );
        mjcf += &format!("<body name='l{next}' pos='0.1 0 0.1'><joint name='j{k}'/>");
    }
    urdf += "</robot>";
    mjcf += &"</body>".repeat(joints + 1);
    mjcf += "</worldbody></mujoco>";
    for (kind, text) in [("urdf", &urdf), ("mjcf", &mjcf)] {
        let ran = of_description(folder.path(), kind, text, "l101");
        assert_eq!(ran.code, Some(2), "{kind}: {}", ran.stderr);
        assert!(
            ran.stderr.contains("at most 100 joints"),
            "{kind}: {}",
            ran.stderr
        );
    }
    let row = json!({ "a_mm": 10, "alpha_deg": 90, "d_mm": 10, "theta_deg": 0, "convention": "standard" });
    let ran = identified(folder.path(), &|document| {
        document["robot"] = json!({ "name": "r", "dh": vec![row.clone(); joints] });
    });
    assert!(
        ran.code == Some(2) && ran.stderr.contains("101 joints"),
        "{}",
        ran.stderr
    );
}

/// A place, and what makes the number there too large.
type Change = (&'static str, fn(&mut Value));

#[test]
fn numbers_beyond_any_robots_range_are_refused_with_their_place() {
    let folder = folder();
    let changes: &[Change] = &[
        ("robot.tool.position_mm[0]", |d| {
            d["robot"]["tool"]["position_mm"][0] = json!(1e160);
        }),
        ("robot.joints[0].point_mm[1]", |d| {
            d["robot"]["joints"][0]["point_mm"][1] = json!(-1e160);
        }),
        ("robot.joints[0].limits[1]", |d| {
            d["robot"]["joints"][0]["limits"] = json!([0, 1e9]);
        }),
        ("robot.joints[0].mass_kg", |d| {
            d["robot"]["joints"][0]["mass_kg"] = json!(1e200);
            d["robot"]["joints"][0]["centre_mm"] = json!([0, 0, 0]);
        }),
        ("targets.T[2]", |d| {
            d["targets"] = json!({ "T": [0, 0, 1e8] });
        }),
        ("regions[0].to_deg", |d| {
            d["regions"][0]["to_deg"] = json!(1e7);
        }),
        ("instrument.sigma_mm", |d| {
            d["instrument"] = json!({ "name": "i", "sigma_mm": 1e-200 });
        }),
        ("tolerance_mm", |d| d["tolerance_mm"] = json!(1e100)),
        ("x_mm[1]", |d| {
            d["samples"] =
                json!({ "columns": { "q1_deg": [0, 1], "x_mm": [250, 1e99], "y_mm": [0, 4] } });
        }),
        ("q1_deg[1]", |d| {
            d["samples"] =
                json!({ "columns": { "q1_deg": [0, 1e7], "x_mm": [250, 2], "y_mm": [0, 4] } });
        }),
        ("a_mm", |d| {
            d["robot"] = json!({ "name": "r", "dh": [{ "a_mm": 1e160, "alpha_deg": 0, "d_mm": 0,
                "theta_deg": 0, "convention": "standard" }] });
        }),
    ];
    for (place, change) in changes {
        let ran = identified(folder.path(), change);
        assert_eq!(ran.code, Some(2), "{place}: {}", ran.stderr);
        assert!(
            ran.stderr.contains(place) && ran.stderr.contains("line "),
            "{place}: {}",
            ran.stderr
        );
        assert!(
            ran.cpu_s < 2.0 && ran.stderr.len() < 1000,
            "{place}: {}",
            ran.stderr
        );
    }
    for (kind, text) in [
        (
            "urdf",
            "<robot><link name='l0'/><link name='l1'/>\n<joint name='j' type='revolute'><parent link='l0'/>\
             <child link='l1'/><origin xyz='1e157 0 0'/></joint></robot>",
        ),
        (
            "mjcf",
            "<mujoco><worldbody><body name='l0'>\n<body name='l1' pos='0 1e157 0'><joint/></body></body>\
             </worldbody></mujoco>",
        ),
    ] {
        let ran = of_description(folder.path(), kind, text, "l1");
        assert!(
            ran.code == Some(2) && ran.stderr.contains("line 2"),
            "{kind}: {}",
            ran.stderr
        );
    }
    fs::write(
        folder.path().join("s.csv"),
        "q1_deg,x_mm,y_mm,z_mm\n1,2,3,4\n1,2,1e8,4\n",
    )
    .unwrap();
    let ran = identified(folder.path(), &|document| {
        document["samples"]["file"] = "s.csv".into();
    });
    let says =
        "s.csv, line 3, column 3, y_mm: 100000000; expected a number of at most 10 000 000 mm";
    assert!(
        ran.code == Some(2) && ran.stderr.contains(says),
        "{}",
        ran.stderr
    );
}

#[test]
fn one_damaged_number_of_any_kind_of_measurement_ends() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/observations");
    let folder = tempfile::tempdir().unwrap();
    for (name, column, damaged) in [
        ("six-distance-unknown", "distance_mm", "9876543"),
        ("scara-distance-unknown", "distance_mm", "123456"),
        ("six-bearing-unknown", "azimuth_deg", "987654"),
        ("six-pose", "x_mm", "-9876543"),
    ] {
        let text = fs::read_to_string(data.join(format!("{name}.csv"))).unwrap();
        let mut rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
        let at = rows[0]
            .iter()
            .position(|heading| *heading == column)
            .unwrap();
        let row = (8..rows.len()).find(|k| !rows[*k][at].is_empty()).unwrap();
        rows[row][at] = damaged;
        let text: Vec<String> = rows.iter().map(|row| row.join(",") + "\n").collect();
        fs::write(folder.path().join(format!("{name}.csv")), text.concat()).unwrap();
        let json = format!("{name}.json");
        fs::copy(data.join(&json), folder.path().join(&json)).unwrap();
        for command in ["identify", "diagnose"] {
            let ran = truepose(folder.path(), &[command, &json, "--json"]);
            assert_eq!(ran.code, Some(0), "{name} {command}: {}", ran.stderr);
            assert!(ran.cpu_s < 20.0, "{name} {command}: {} s", ran.cpu_s);
        }
    }
}

#[test]
fn what_a_document_names_is_a_regular_file_in_its_folder() {
    let folder = folder();
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).unwrap();
    let made = truepose(folder.path(), &["identify", "/dev/null"]);
    assert_eq!(made.code, Some(2));
    fs::write(folder.path().join("s.json"), session().to_string()).unwrap();
    let made = truepose(folder.path(), &["identify", "s.json", "--out", "m.json"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 2, 2);
    encoder.set_color(png::ColorType::Rgb);
    encoder
        .write_header()
        .unwrap()
        .write_image_data(&[9; 12])
        .unwrap();
    fs::write(folder.path().join("logo.png"), &png).unwrap();
    fs::write(inner.join("logo.png"), &png).unwrap();
    std::os::unix::fs::symlink("../logo.png", inner.join("out.png")).unwrap();
    assert!(
        Command::new("mkfifo")
            .arg(inner.join("pipe"))
            .status()
            .unwrap()
            .success()
    );
    let absolute = folder.path().join("logo.png").display().to_string();
    let report = |details: &str| {
        let _ = fs::remove_file(folder.path().join("r.html"));
        truepose(
            folder.path(),
            &["report", "m.json", "--details", details, "--out", "r.html"],
        )
    };
    for (logo, code, says) in [
        ("logo.png", 0, ""),
        (&*absolute, 2, "an absolute path"),
        ("../logo.png", 2, "leads upwards"),
        ("out.png", 2, "a link that leaves"),
        ("pipe", 2, "a device or a pipe"),
        (".", 2, "a directory"),
    ] {
        let details = json!({ "format": "truepose-details/1", "logo": logo });
        fs::write(inner.join("d.json"), details.to_string()).unwrap();
        let ran = report("inner/d.json");
        assert_eq!(ran.code, Some(code), "{logo}: {}", ran.stderr);
        assert!(ran.stderr.contains(says), "{logo}: {}", ran.stderr);
    }
    for details in ["/dev/zero", "inner/pipe"] {
        let ran = report(details);
        assert!(
            ran.code == Some(2) && ran.cpu_s < 2.0,
            "{details}: {}",
            ran.stderr
        );
    }
}

/// Two sessions of one robot with other samples.
fn simulated(folder: &Path, offset_deg: f64, out: &str, samples: u32) -> Ran {
    let scenario = json!({
        "format": "truepose-scenario/1", "name": format!("{offset_deg}"), "robot": session()["robot"],
        "poses": { "sweep": { "joint": 1, "from_deg": -80, "to_deg": 80, "step_deg": 160.0 / f64::from(samples) } },
        "effects": [{ "effect": "joint-zero-offset", "joint": 1, "parameters": { "offset_deg": offset_deg } }],
        "noise": { "sigma_mm": 0.01, "kind": "gauss" }, "seed": 1
    });
    let name = format!("{out}.scenario");
    fs::write(folder.join(&name), scenario.to_string()).unwrap();
    truepose(
        folder,
        &["simulate", &name, "--out", out, "--force", "--json"],
    )
}

#[test]
fn a_session_says_when_the_samples_beside_it_are_anothers() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for (offset_deg, out) in [(1.0, "a.json"), (-2.0, "b.json")] {
        let ran = simulated(folder.path(), offset_deg, out, 100);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    }
    let said = |folder: &Path| {
        let ran = truepose(folder, &["identify", "a.json"]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        ran.stderr
            .contains("are not those that this session was saved with")
    };
    assert!(!said(folder.path()));
    let own = fs::read(path("a.csv")).unwrap();
    // Line ends alone make no other samples.
    let text = String::from_utf8(own.clone()).unwrap();
    fs::write(path("a.csv"), text.replace('\n', "\r\n")).unwrap();
    assert!(!said(folder.path()));
    fs::copy(path("b.csv"), path("a.csv")).unwrap();
    assert!(said(folder.path()));
    fs::write(path("a.csv"), own).unwrap();
    assert!(!said(folder.path()));
    let hash = fs::read_to_string(path("a.json")).unwrap();
    fs::write(
        path("a.json"),
        hash.replace("\"sha256\": \"", "\"sha256\": \"x"),
    )
    .unwrap();
    let ran = truepose(folder.path(), &["identify", "a.json"]);
    assert!(
        ran.code == Some(2) && ran.stderr.contains("64 hexadecimal digits"),
        "{}",
        ran.stderr
    );
}

fn unfinished(folder: &Path) -> usize {
    let names = fs::read_dir(folder).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.starts_with(".truepose-")).count()
}

#[test]
fn a_signal_ends_a_command_before_its_work_is_done_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    // Where these tests are started with Ctrl+C ignored (nohup, a script's background), so would the program be: what a
    // process handles is back at its default in a program that it starts. Here it goes on to end the tests.
    let ends = Arc::new(AtomicBool::new(true));
    signal_hook::flag::register_conditional_default(2, ends).unwrap();
    let made = simulated(folder.path(), 1.0, "s.json", 400_000);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    // The last is sent first; what SIGKILL leaves is seen by none of the others.
    let mut signals = vec![("KILL", 9), ("TERM", 15), ("INT", 2)];
    let mut too_late = 0;
    while let Some((signal, number)) = signals.pop() {
        let mut command = crate::program::truepose();
        command.args(["simulate", "s.json.scenario", "--out", "s.json", "--force"]);
        let mut writer = command
            .current_dir(folder.path())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        while unfinished(folder.path()) == 0 && writer.try_wait().unwrap().is_none() {
            sleep(Duration::from_millis(2));
        }
        let pid = writer.id().to_string();
        let mut kill = Command::new("kill");
        let _ = kill.args([&format!("-{signal}"), &pid]).output().unwrap();
        let status = writer.wait().unwrap();
        if status.success() && too_late < 10 {
            // A busy machine sends it after the end: once more.
            too_late += 1;
            signals.push((signal, number));
            continue;
        }
        // One that went on to its end would say so every time.
        assert_eq!(status.signal(), Some(number), "{signal}");
        let left = unfinished(folder.path());
        assert_eq!(left > 0, signal == "KILL", "{signal}: {left} files");
        let ran = truepose(folder.path(), &["identify", "s.json"]);
        assert_eq!(ran.code, Some(0), "{signal}: {}", ran.stderr);
        assert!(
            !ran.stderr.contains("are not those"),
            "{signal}: {}",
            ran.stderr
        );
    }
    assert_eq!(simulated(folder.path(), 1.0, "s.json", 10).code, Some(0));
    assert_eq!(
        unfinished(folder.path()),
        0,
        "the next write removes what SIGKILL left"
    );
}

#[test]
fn a_recording_counts_what_is_on_the_disk() {
    let folder = tempfile::tempdir().unwrap();
    let server = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let source = format!("tcp://{}", server.local_addr().unwrap());
    let sending = std::thread::spawn(move || {
        let (mut stream, _) = server.accept().unwrap();
        let mut text = "x_mm,y_mm\n".to_owned();
        for k in 0..60_000 {
            text += &format!("{k},{k}.5\nrubbish\n");
        }
        let _ = stream.write_all(text.as_bytes());
    });
    // As on a full disk, after 100 blocks of 1024 bytes.
    let script = "trap '' XFSZ; ulimit -f 100; exec \"$@\"";
    let ran = crate::program::english(Command::new("bash"))
        .args(["-c", script, "bash", env!("CARGO_BIN_EXE_truepose")])
        .args(["record", &source, "--out", "r.csv"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    sending.join().unwrap();
    let says = String::from_utf8(ran.stderr).unwrap();
    assert_eq!(ran.status.code(), Some(1), "{says}");
    let held = fs::read_to_string(folder.path().join("r.csv")).unwrap();
    let lines = held.lines().count() - 1;
    assert!(held.ends_with('\n') && lines > 1000, "{lines} lines");
    assert!(
        says.contains(&format!("{lines} lines recorded")),
        "{lines}: {says}"
    );
    assert!(says.len() < 5000, "{} bytes of messages", says.len());
}

#[test]
fn every_command_that_writes_prints_one_document_where_it_is_asked_to() {
    let folder = folder();
    fs::write(folder.path().join("p.json"), session().to_string()).unwrap();
    let made = truepose(
        folder.path(),
        &["identify", "p.json", "--out", "m.json", "--json"],
    );
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let server = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let source = format!("tcp://{}", server.local_addr().unwrap());
    let sending = std::thread::spawn(move || {
        let (mut stream, _) = server.accept().unwrap();
        let _ = stream.write_all(b"x_mm\n1\n2\n");
    });
    let simulated = simulated(folder.path(), 1.0, "s.json", 10);
    let export = [
        "export", "m.json", "--to", "csv", "--out", "t.csv", "--json",
    ];
    let report = ["report", "m.json", "--out", "r.html", "--json"];
    let record = ["record", &source, "--out", "l.csv", "--json"];
    for (ran, format) in [
        (simulated, "truepose-simulated/1"),
        (truepose(folder.path(), &export), "truepose-exported/1"),
        (truepose(folder.path(), &report), "truepose-reported/1"),
        (truepose(folder.path(), &record), "truepose-recorded/1"),
    ] {
        assert_eq!(ran.code, Some(0), "{format}: {}", ran.stderr);
        let answer: Value = serde_json::from_str(&ran.stdout).unwrap();
        assert_eq!(answer["format"], format, "{answer}");
    }
    sending.join().unwrap();
    let both = ["export", "m.json", "--to", "csv", "--out", "-", "--json"];
    assert_eq!(truepose(folder.path(), &both).code, Some(2));
}
