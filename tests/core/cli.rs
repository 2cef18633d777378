//! The terminal, as a person or another program uses it: the binary itself, its exit status, its
//! standard output and its files.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::Value;

fn truepose(arguments: &[&str]) -> Output {
    crate::program::truepose()
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .expect("the program starts")
}

fn bundled(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions");
    path.join(name)
        .to_str()
        .expect("a path in UTF-8")
        .to_owned()
}

/// Copies a bundled session into a folder whose name is not a simple one.
fn copied(folder: &Path, name: &str) -> PathBuf {
    let folder = folder.join("Prüfung 1 µm");
    std::fs::create_dir_all(&folder).unwrap();
    for ending in ["json", "csv"] {
        let file = format!("{name}.{ending}");
        std::fs::copy(bundled(&file), folder.join(file)).unwrap();
    }
    folder.join(format!("{name}.json"))
}

fn json(output: &Output) -> Value {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{errors}");
    serde_json::from_slice(&output.stdout).expect("exactly one JSON document")
}

fn refusal(arguments: &[&str]) -> String {
    let output = truepose(arguments);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    message
}

fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn regional_identification_prints_the_papers_twelve_corrections() {
    let session = bundled("paper-30.json");
    let answer = json(&truepose(&[
        "identify", &session, "--method", "regional", "--json",
    ]));
    assert_eq!(answer["format"], "truepose-identification/1");
    assert_eq!(answer["method"], "regional");
    assert_eq!(answer["samples"], 30);
    let expected = [
        (0.0547690, 1.1001417),
        (0.0496316, -5.8933702),
        (0.0311955, -11.3077583),
        (0.0417224, 8.9381311),
        (0.0182564, 12.9559532),
        (-0.0101014, 13.5022381),
    ];
    let regions = answer["regions"].as_array().unwrap();
    assert_eq!(regions.len(), expected.len());
    for (k, (region, (theta, l1))) in regions.iter().zip(expected).enumerate() {
        assert_eq!(region["name"], (k + 1).to_string());
        assert_eq!(region["samples"], 5);
        let of = |key: &str| region["correction"][key].as_f64().unwrap();
        assert!((of("theta_rad") - theta).abs() < 1e-7);
        assert!((of("l1_mm") - l1).abs() < 1e-7);
    }
    let notes = answer["notes"].to_string();
    assert!(notes.contains("z is not used"), "{notes}");
}

#[test]
fn exact_identification_finds_the_papers_one_error() {
    let answer = json(&truepose(&[
        "identify",
        &bundled("paper-30.json"),
        "--json",
    ]));
    let value = |name: &str| {
        let parameters = answer["parameters"].as_array().unwrap();
        let found = parameters.iter().find(|p| p["name"] == name).unwrap();
        assert_eq!(found["joint"], 1);
        found["value"].as_f64().unwrap()
    };
    assert!((value("offset_deg") + 3.0).abs() < 1e-10);
    assert!((value("delta_mm") + 5.0).abs() < 1e-9);
    assert!(answer["gap"]["after_mm"].as_f64().unwrap() < 1e-9);
    assert!(answer["gap"]["max_after_mm"].as_f64().unwrap() < 1e-9);
}

#[test]
fn the_main_job_runs_from_a_scenario_to_a_table_in_a_folder_with_an_awkward_name() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let scenario = bundled("lamp-commissioning.scenario.json");
    let made = truepose(&[
        "simulate",
        &scenario,
        "--out",
        &at("s ü.json"),
        "--truth",
        &at("truth.json"),
    ]);
    assert_eq!(
        made.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&made.stderr)
    );
    assert_eq!(
        std::fs::read(folder.path().join("s ü.csv")).unwrap(),
        std::fs::read(bundled("lamp-commissioning.csv")).unwrap(),
        "the bundled session is what its scenario makes"
    );
    let session_text = std::fs::read_to_string(folder.path().join("s ü.json")).unwrap();
    assert!(
        !session_text.contains("eccentricity"),
        "the session must not tell"
    );

    let answer = json(&truepose(&[
        "identify",
        &at("s ü.json"),
        "--out",
        &at("m.json"),
        "--json",
        "--effects",
        "joint-zero-offset,link-length,encoder-eccentricity,backlash,link-droop,axis-tilt,base-offset",
    ]));
    let truth: Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("truth.json")).unwrap()).unwrap();
    for effect in truth["effects"].as_array().unwrap() {
        for parameter in answer["parameters"].as_array().unwrap() {
            if parameter["effect"] != effect["effect"] {
                continue;
            }
            let name = parameter["name"].as_str().unwrap();
            let hidden = effect["parameters"][name].as_f64().unwrap();
            let [low, high] = [0, 1].map(|k| parameter["ci95"][k].as_f64().unwrap());
            // Twice the interval: a dozen 95 % intervals seldom hold all at once.
            let half = high - low;
            let value = parameter["value"].as_f64().unwrap();
            assert!(
                (value - hidden).abs() < half,
                "{name}: {value}, hidden {hidden}"
            );
        }
    }
    let verification = json(&truepose(&[
        "verify",
        &at("m.json"),
        &at("s ü.json"),
        "--json",
    ]));
    assert_eq!(verification["format"], "truepose-verification/1");
    let after = answer["gap"]["after_mm"].as_f64().unwrap();
    let verified = verification["gap"]["model_mm"].as_f64().unwrap();
    assert!(
        (after - verified).abs() < 1e-12,
        "a saved model predicts the same: {after} {verified}"
    );

    for (format, file) in [
        ("csv", "table.csv"),
        ("c-header", "table.h"),
        ("linuxcnc", "table.comp"),
        ("twincat-cnc", "achskw1.lis"),
        ("urdf", "robot.urdf"),
    ] {
        let done = truepose(&["export", &at("m.json"), "--to", format, "--out", &at(file)]);
        assert_eq!(
            done.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&done.stderr)
        );
    }
    let table = std::fs::read_to_string(folder.path().join("table.csv")).unwrap();
    assert!(table.starts_with("commanded_deg,correction_forward_deg,correction_reverse_deg\n"));
    assert!(names_in(folder.path()).contains(&"table.csv.meta.json".to_owned()));
}

#[test]
fn an_output_never_replaces_an_input_not_even_by_force() {
    let folder = tempfile::tempdir().unwrap();
    let session = copied(folder.path(), "paper-30");
    let before = std::fs::read(session.with_extension("csv")).unwrap();
    let session = session.to_str().unwrap();
    for out in [session.to_owned(), session.replace(".json", ".csv")] {
        let message = refusal(&["identify", session, "--out", &out, "--force"]);
        assert!(message.contains("would replace the input"), "{message}");
    }
    assert_eq!(
        std::fs::read(session.replace(".json", ".csv")).unwrap(),
        before
    );
}

#[test]
fn an_existing_file_is_replaced_only_by_force() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("m.json");
    std::fs::write(&out, "mine").unwrap();
    let out = out.to_str().unwrap();
    let session = bundled("paper-30.json");
    let message = refusal(&["identify", &session, "--out", out]);
    assert!(message.contains("--force"), "{message}");
    assert_eq!(std::fs::read(out).unwrap(), b"mine");
    assert_eq!(
        truepose(&["identify", &session, "--out", out, "--force"])
            .status
            .code(),
        Some(0)
    );
    assert!(
        std::fs::read_to_string(out)
            .unwrap()
            .contains("truepose-model/1")
    );
    assert_eq!(names_in(folder.path()), ["m.json"], "no droppings");
}

#[test]
fn wrong_arguments_are_refused_with_what_was_expected() {
    let session = bundled("paper-30.json");
    let message = refusal(&["identify", &session, "--effects", "warp-drive"]);
    assert!(
        message.contains("warp-drive") && message.contains("truepose effects"),
        "{message}"
    );
    let message = refusal(&[
        "identify",
        &session,
        "--method",
        "regional",
        "--regions",
        "six",
    ]);
    assert!(message.contains("six"), "{message}");
    let message = refusal(&[
        "identify",
        &session,
        "--method",
        "regional",
        "--regions",
        "0",
    ]);
    assert!(message.contains("expected"), "{message}");
    let message = refusal(&[
        "identify",
        &session,
        "--method",
        "regional",
        "--regions",
        "30,0",
    ]);
    assert!(message.contains("ascending"), "{message}");
    let message = refusal(&["identify", &session, "--json", "--out", "-"]);
    assert!(message.contains("standard output"), "{message}");
    refusal(&["identify"]);
    refusal(&["frobnicate", "a", "b"]);
    let message = refusal(&["identify", "no such file.json"]);
    assert!(message.contains("no such file.json"), "{message}");
}

#[test]
fn regions_can_be_given_as_a_number_or_as_boundaries() {
    let session = bundled("paper-30.json");
    let names = |regions: &str| {
        let answer = json(&truepose(&[
            "identify",
            &session,
            "--method",
            "regional",
            "--regions",
            regions,
            "--json",
        ]));
        let regions = answer["regions"].as_array().unwrap().clone();
        regions
            .iter()
            .map(|r| {
                (
                    r["from_deg"].as_f64().unwrap(),
                    r["to_deg"].as_f64().unwrap(),
                )
            })
            .collect::<Vec<_>>()
    };
    assert_eq!(names("2"), [(-90.0, 0.0), (0.0, 90.0)]);
    assert_eq!(
        names("-90,-30,0,90"),
        [(-90.0, -30.0), (-30.0, 0.0), (0.0, 90.0)]
    );
}

#[test]
fn adaptive_regions_leave_no_more_than_as_many_uniform_ones() {
    let session = bundled("lamp-commissioning.json");
    let gap = |regions: &str| {
        let answer = json(&truepose(&[
            "identify",
            &session,
            "--method",
            "regional",
            "--regions",
            regions,
            "--json",
        ]));
        let number = answer["regions"].as_array().unwrap().len();
        (number, answer["gap"]["after_mm"].as_f64().unwrap())
    };
    let (number, adaptive) = gap("adaptive");
    assert!((7..30).contains(&number), "{number}");
    assert!(adaptive < gap(&number.to_string()).1);
}

#[cfg(all(feature = "gui", target_os = "linux"))]
#[test]
fn without_a_display_the_window_says_which_command_does_the_job() {
    let output = truepose(&[]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("truepose identify"), "{message}");
    assert!(message.contains("there is no display"), "{message}");
    assert!(!message.contains(".rs"), "{message}");
}

#[cfg(target_os = "linux")]
#[test]
fn where_no_session_lies_the_program_says_what_writes_one_and_then_names_it() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("a folder");
    std::fs::create_dir(&folder).unwrap();
    let said = |arguments: &[&str]| {
        let mut program = crate::program::truepose();
        let displays = ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"];
        for display in displays {
            program.env_remove(display);
        }
        let program = program.args(arguments).current_dir(&folder);
        let output = program.env("HOME", &folder).output().unwrap();
        String::from_utf8(output.stderr).unwrap()
    };
    let first = said(&[]);
    assert!(first.contains("truepose identify SESSION"), "{first}");
    assert!(first.contains("truepose integrate"), "{first}");
    said(&["integrate"]);
    let then = said(&[]);
    // A command that a shell takes, with the blank in its path.
    let session = folder.join(".local/share/truepose/sessions/lamp-commissioning.json");
    let command = format!("truepose identify \"{}\" --json", session.display());
    assert!(then.contains(&command), "{then}");
    assert!(session.exists());
}

#[test]
fn the_list_of_effects_is_complete_and_machine_readable() {
    let listing = json(&truepose(&["effects", "--json"]));
    let ids: Vec<&str> = listing["effects"]
        .as_array()
        .unwrap()
        .iter()
        .map(|e| e["effect"].as_str().unwrap())
        .collect();
    assert_eq!(ids.len(), truepose::effects::CATALOGUE.len());
    assert!(ids.contains(&"joint-zero-offset") && ids.contains(&"frame-drift"));
}

#[test]
fn a_model_goes_to_standard_output_alone() {
    let output = truepose(&["identify", &bundled("paper-30.json"), "--out", "-"]);
    assert_eq!(json(&output)["format"], "truepose-model/1");
}

#[test]
fn effects_that_nothing_can_show_leave_nothing_to_fit_and_say_so() {
    let session = bundled("paper-30.json");
    // No side of approach in it, and what is unexplained is no effect to ask for.
    for (id, because) in [
        ("backlash", "not_identifiable"),
        ("unexplained", "finds what repeats"),
    ] {
        let output = truepose(&["identify", &session, "--effects", id, "--json"]);
        let answer = json(&output);
        let combinations = answer["not_identifiable"].as_array().unwrap();
        assert_eq!(combinations.len(), 1, "{id}");
        assert!(answer.to_string().contains(because), "{answer}");
        assert_eq!(answer["parameters"].as_array().unwrap().len(), 0);
    }
}

#[test]
fn a_limit_that_is_none_is_said_in_words_and_has_no_number() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    // On a grid of 45° an eighth harmonic is the same everywhere.
    let scenario = r#"{ "format": "truepose-scenario/1", "name": "eighths",
        "robot": { "name": "column",
            "joints": [ { "name": "column", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0], "limits": [-180, 180] } ],
            "tool": { "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] } },
        "poses": { "sweep": { "joint": 1, "from_deg": -180, "to_deg": 180, "step_deg": 45, "both_ways": true, "repeats": 2 } },
        "noise": { "sigma_mm": 0.03, "kind": "gauss" }, "seed": 3 }"#;
    std::fs::write(path("s.json"), scenario).unwrap();
    let made = truepose(&["simulate", &path("s.json"), "--out", &path("eighths.json")]);
    assert_eq!(made.status.code(), Some(0));
    let text = truepose(&["diagnose", &path("eighths.json")]).stdout;
    let text = String::from_utf8(text).unwrap();
    let limit = |text: &str, name: &str| {
        let mut lines = text.lines().map(str::trim);
        let line = lines.find_map(|line| line.strip_prefix(name).map(str::to_owned));
        line.unwrap_or_else(|| panic!("{name}: {text}"))
    };
    let gear = limit(&text, "Gear transmission error ");
    assert_eq!(gear.trim(), "not observable with these poses");
    let answer = json(&truepose(&["diagnose", &path("eighths.json"), "--json"]));
    for limit in answer["not_found"].as_array().unwrap() {
        let above = limit["would_have_been_seen_above"].as_object().unwrap();
        for (name, size) in above {
            assert!(size.as_f64().unwrap() < 1e6, "{name} of {limit}");
        }
        if limit["effect"] == "gear-transmission-error" {
            assert_eq!(limit["not_shown_at_any_size"][0], "amplitude_deg");
        }
    }
    // Limits of a joint that slides are lengths.
    let slide = json(&truepose(&[
        "diagnose",
        &bundled("slide-lead-error.json"),
        "--json",
    ]));
    let mut limits = slide["not_found"].as_array().unwrap().iter();
    let lost_motion = limits
        .find(|limit| limit["effect"] == "lost-motion")
        .unwrap();
    assert!(
        lost_motion["would_have_been_seen_above"]["width_mm"].is_number(),
        "{lost_motion}"
    );
    // Without noise nothing hides.
    let text = truepose(&["diagnose", &bundled("paper-30.json")]).stdout;
    let text = String::from_utf8(text).unwrap();
    let scale = limit(&text, "Joint scale ");
    assert_eq!(scale.trim(), "any size, there is no noise");
}

/// A session that has everything to be said beside names and values: `tests/reference/facts.py`.
fn facts() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/facts/facts.json");
    path.display().to_string()
}

#[test]
fn noise_outliers_and_sizes_that_no_machine_has_are_said_in_words() {
    let text = truepose(&["diagnose", &facts()]).stdout;
    let text = String::from_utf8(text).unwrap();
    let line = |start: &str| {
        let mut lines = text.lines().map(str::trim);
        let found = lines.find(|line| line.starts_with(start));
        found.unwrap_or_else(|| panic!("{start}: {text}"))
    };
    let noise = line("Measurement noise");
    assert!(noise.contains("σ = "), "{noise}");
    assert!(
        noise.contains("0.0200 mm as stated for the instrument"),
        "{noise}"
    );
    let slow = line("Slow noise");
    assert!(slow.contains("the measuring frame wanders by "), "{slow}");
    assert!(slow.ends_with(" min"), "{slow}");
    line("Excluded outliers: 3 of 160 samples");
    for sample in [17, 71, 122] {
        line(&format!("sample {sample} "));
    }
    let amplitude = line("amplitude: ");
    let says = "implausibly large: more than ten times what is usual";
    assert!(amplitude.contains(says), "{amplitude}");
    // A whole number is no estimate: it has no interval.
    assert!(text.contains("order 3;"), "{text}");

    let identified = truepose(&["identify", &facts()]).stdout;
    let identified = String::from_utf8(identified).unwrap();
    let effects = "joint-zero-offset,link-length,encoder-eccentricity,bearing-runout";
    let with_names = truepose(&["identify", &facts(), "--effects", effects]).stdout;
    let with_names = String::from_utf8(with_names).unwrap();
    let noise = identified
        .lines()
        .find(|line| line.contains("Measurement noise"));
    assert!(
        noise.is_some_and(|line| line.contains("σ = ")),
        "{identified}"
    );
    let slow = with_names.lines().find(|line| line.contains("Slow noise"));
    let goes_on = "a part of the remaining error goes on";
    assert!(
        slow.is_some_and(|line| line.contains(goes_on)),
        "{with_names}"
    );
    assert!(with_names.contains("Excluded outliers: 3 of 160 samples"));
    assert!(with_names.contains("implausibly large"), "{with_names}");
    let order = with_names.lines().find(|line| line.contains(" order "));
    assert!(order.unwrap().ends_with(" 3"), "{with_names}");
}

#[test]
fn the_document_of_a_diagnosis_has_the_noise_and_what_was_excluded() {
    let answer = json(&truepose(&["diagnose", &facts(), "--json"]));
    let slow = &answer["noise"]["slow"];
    assert_eq!(slow["rms_mm"].as_array().unwrap().len(), 3);
    assert!(slow["time_constant_s"].as_f64().unwrap() > 20.0);
    assert!(slow["says"].as_str().unwrap().contains("wanders"));
    let stated = &answer["unexplained"]["noise"];
    assert_eq!(stated["stated_mm"], 0.02);
    assert!((stated["found_mm"].as_f64().unwrap() / 0.05 - 1.0).abs() < 0.2);
    let outliers = answer["outliers"].as_array().unwrap();
    let samples: Vec<u64> = outliers
        .iter()
        .map(|o| o["sample"].as_u64().unwrap())
        .collect();
    assert_eq!(samples.len(), 3);
    assert!([17, 71, 122].iter().all(|sample| samples.contains(sample)));
    let found = answer["found"].as_array().unwrap();
    let runout = found.iter().find(|f| f["effect"] == "bearing-runout");
    let order = &runout.unwrap()["parameters"][0];
    assert_eq!(
        (&order["name"], &order["value"]),
        (&"order".into(), &3.0.into())
    );
    assert!(order["ci95"].is_null());
    // Quiet and white, and stated as it is: nothing to tell.
    let quiet = json(&truepose(&[
        "diagnose",
        &bundled("lamp-commissioning.json"),
        "--json",
    ]));
    assert!(quiet["noise"]["slow"].is_null());
    assert!(quiet["unexplained"]["noise"].is_null());
}

#[test]
fn a_diagnosis_says_what_is_not_identifiable_as_an_identification_does() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("free.json").display().to_string();
    // A measuring frame that is free turns as the zero offset does.
    let text = std::fs::read_to_string(facts()).unwrap();
    let mut session: Value = serde_json::from_str(&text).unwrap();
    session["samples"]["columns"]["setup"] = vec!["A"; 160].into();
    std::fs::write(&path, session.to_string()).unwrap();
    let of = |command: &str| json(&truepose(&[command, &path, "--json"]));
    let combinations = |answer: &Value| {
        let all = answer["not_identifiable"].as_array().unwrap();
        let names: Vec<String> = all
            .iter()
            .map(|one| one["combination"].as_str().unwrap().to_owned())
            .collect();
        names.join("; ")
    };
    let (identified, diagnosed) = (of("identify"), of("diagnose"));
    assert!(combinations(&identified).contains("joint-zero-offset"));
    assert!(
        combinations(&diagnosed).contains("joint-zero-offset"),
        "{}",
        combinations(&diagnosed)
    );
    let text = truepose(&["diagnose", &path]).stdout;
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("Not identifiable\n"), "{text}");
}
