//! The sessions that come with the program are what their scenarios make, byte for byte, and every
//! one of them loads without a complaint.
//!
//! After a wanted change: `TRUEPOSE_WRITE_SESSIONS=1 cargo test --test core bundled_sessions::`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};

use truepose::diagnostic::{Diagnostic, Severity};
use truepose::effects::JointValues;
use truepose::fit::{identify_exact, identify_regional};
use truepose::sessions::RegionChoice;
use truepose::sessions::{Replacing, Session, load, samples_path, save};
use truepose::simulation::{load_scenario, simulate, unwatched};

const NAMES: [&str; 4] = ["paper-30", "paper-run", "lamp-commissioning", "arm/arm"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions")
}

fn simulated(name: &str) -> Session {
    let loaded = load_scenario(folder().join(format!("{name}.scenario.json"))).unwrap();
    assert_eq!(loaded.findings, vec![], "{name}");
    let seed = loaded.scenario.seed;
    simulate(&loaded.scenario, seed, unwatched).unwrap().0
}

fn bundled(name: &str) -> Session {
    let loaded = load(folder().join(format!("{name}.json"))).unwrap();
    let serious = |d: &&Diagnostic| d.severity > Severity::Note;
    assert_eq!(loaded.findings.iter().find(serious), None, "{name}");
    loaded.session
}

#[test]
fn each_session_is_what_its_scenario_makes() {
    let write = std::env::var_os("TRUEPOSE_WRITE_SESSIONS").is_some();
    let scratch = tempfile::tempdir().unwrap();
    for name in NAMES {
        let session = simulated(name);
        let target = if write {
            folder()
        } else {
            scratch.path().to_path_buf()
        };
        let made = target.join(format!("{name}.json"));
        std::fs::create_dir_all(made.parent().unwrap()).unwrap();
        let force = Replacing {
            force: true,
            inputs: &[],
        };
        save(&session, &made, force).unwrap();
        let kept = folder().join(format!("{name}.json"));
        for (made, kept) in [(samples_path(&made), samples_path(&kept)), (made, kept)] {
            let bytes = |path: &Path| std::fs::read(path).unwrap();
            assert!(
                bytes(&made) == bytes(&kept),
                "{} is not what its scenario makes",
                kept.display()
            );
        }
    }
}

#[test]
fn a_session_that_was_saved_is_the_one_that_was_simulated() {
    for name in NAMES {
        let (kept, made) = (bundled(name), simulated(name));
        assert_eq!(kept.samples.x_mm, made.samples.x_mm, "{name}");
        assert_eq!(kept.samples.q, made.samples.q, "{name}");
        assert_eq!(kept.robot, made.robot, "{name}");
        assert_eq!(kept.regions, made.regions, "{name}");
    }
}

#[test]
fn the_papers_sessions_give_the_papers_error() {
    for name in ["paper-30", "paper-run"] {
        let session = bundled(name);
        let effects = ["joint-zero-offset", "link-length"].map(str::to_owned);
        let found = identify_exact(&session, &effects, JointValues::default()).unwrap();
        assert!((found.parameters[0].value + 3.0).abs() < 1e-12, "{name}");
        assert!((found.parameters[1].value + 5.0).abs() < 1e-11, "{name}");
        assert!(found.gap.after.rms_mm < 1e-9, "{name}");
    }
}

#[test]
fn the_thirty_samples_give_the_papers_table() {
    let found = identify_regional(
        &bundled("paper-30"),
        &RegionChoice::FromSession,
        JointValues::default(),
    );
    let regions = found.unwrap().regions;
    // Recomputed from the equations of the paper; see tests/core/paper.rs.
    let table = [
        (0.0547690, 1.1001417),
        (0.0496316, -5.8933702),
        (0.0311955, -11.3077583),
        (0.0417224, 8.9381311),
        (0.0182564, 12.9559532),
        (-0.0101014, 13.5022381),
    ];
    for (region, (theta, l1)) in regions.iter().zip(table) {
        assert!((region.correction.theta_rad - theta).abs() < 1e-7);
        assert!((region.correction.l1_mm - l1).abs() < 1e-7);
    }
}

#[test]
fn the_commissioning_run_holds_more_than_offset_and_length_explain() {
    let session = bundled("lamp-commissioning");
    assert_eq!(session.samples.len(), 208);
    let identify = |effects: &[&str]| {
        let effects: Vec<String> = effects.iter().map(|e| (*e).to_owned()).collect();
        identify_exact(&session, &effects, JointValues::default()).unwrap()
    };
    let plain = identify(&["joint-zero-offset", "link-length"]);
    assert!(plain.gap.before.rms_mm > 1.5, "{:?}", plain.gap);
    assert!(plain.gap.after.rms_mm > 0.2, "{:?}", plain.gap);
    let all = identify(&[
        "joint-zero-offset",
        "link-length",
        "encoder-eccentricity",
        "backlash",
        "base-offset",
        "axis-tilt",
        "link-droop",
    ]);
    // Noise of 0.03 mm on each of three axes.
    assert!(
        (all.gap.after.rms_mm - 0.03 * 3.0_f64.sqrt()).abs() < 0.004,
        "{:?}",
        all.gap
    );
}

#[test]
fn the_slide_is_what_its_script_makes() {
    let scratch = tempfile::tempdir().unwrap();
    let script = folder().join("../tests/reference/lead_error_slide.py");
    let ran = std::process::Command::new("python3")
        .arg(script)
        .arg(scratch.path())
        .status();
    assert!(ran.unwrap().success());
    for file in ["slide-lead-error.json", "slide-lead-error.csv"] {
        let text = |path: PathBuf| std::fs::read_to_string(path).unwrap();
        assert!(
            text(scratch.path().join(file)) == text(folder().join(file)),
            "{file}"
        );
    }
    assert_eq!(bundled("slide-lead-error").samples.len(), 250);
}
