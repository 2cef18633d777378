//! What a certificate states besides its measurements, and whether the robot is within its tolerance.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use truepose::diagnosis::{Diagnosis, Options};
use truepose::diagnostic::Place;
use truepose::pipeline;
use truepose::present::decision::title;
use truepose::report::{Details, Extras, Report, html, pdf};
use truepose::sessions::{Session, load};

fn lamp() -> Session {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/lamp-commissioning.json");
    load(path).unwrap().session
}

fn details(text: &str) -> Details {
    let details = Details::parse(Place::default(), text);
    details.unwrap_or_else(|e| panic!("{e}"))
}

fn report(session: &Session, found: &Diagnosis, details: Details) -> Report {
    let extras = Extras {
        details,
        ..Extras::default()
    };
    pipeline::report_of_diagnosis(session, found, None, &Options::default(), &extras).unwrap()
}

fn decision(session: &Session, found: &Diagnosis, tolerance: f64, rule: &str) -> String {
    let own = details(&format!(
        r#"{{"format": "truepose-details/1", "tolerance_mm": {tolerance}, "decision_rule": "{rule}"}}"#
    ));
    let (outcome, says) = report(session, found, own).decision.unwrap();
    format!("{}: {says}", title(outcome).english())
}

/// The largest deviation with corrected commands is 1.972 mm, its uncertainty 0.06 mm.
#[test]
fn the_decision_follows_its_rule_and_states_what_it_rests_on() {
    let mut session = lamp();
    let found = pipeline::diagnose(&session, &Options::default(), &|_| true).unwrap();
    let of = |session: &Session, tolerance, rule| decision(session, &found, tolerance, rule);
    for (tolerance, iso, simple) in [
        (2.1, "Pass:", "Pass:"),
        (1.98, "Neither", "Pass:"),
        (1.96, "Neither", "Fail:"),
        (1.8, "Fail:", "Fail:"),
    ] {
        let says = of(&session, tolerance, "iso-14253-1");
        assert!(says.starts_with(iso), "{tolerance}: {says}");
        let says = of(&session, tolerance, "simple-acceptance");
        assert!(says.starts_with(simple), "{tolerance}: {says}");
    }
    let says = of(&session, 2.1, "iso-14253-1");
    for part in [
        "largest deviation 1.97",
        "predicted with corrected commands",
        "U = 0.0",
        "tolerance 2.1 mm",
        "ISO 14253-1",
    ] {
        assert!(says.contains(part), "{part}: {says}");
    }
    // What was measured with a table active is decided as it was measured: the nominal robot's.
    session.compensated_by = Some("0".repeat(64));
    let says = of(&session, 2.1, "iso-14253-1");
    assert!(says.starts_with("Fail: largest deviation 3.28"), "{says}");
    assert!(
        says.contains("as measured with the correction table active"),
        "{says}"
    );
    // Without a rule nothing is decided, and without a tolerance nothing can be.
    assert!(
        report(&session, &found, Details::default())
            .decision
            .is_none()
    );
    session.tolerance_mm = None;
    let rule = details(r#"{"format": "truepose-details/1", "decision_rule": "iso-14253-1"}"#);
    let (_, says) = report(&session, &found, rule).decision.unwrap();
    assert_eq!(says, "No decision: no tolerance is stated");
}

#[test]
fn details_and_logo_stand_in_both_formats_and_the_bytes_stay_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 3, 2);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[200; 18]).unwrap();
    writer.finish().unwrap();
    std::fs::write(folder.path().join("logo.png"), file).unwrap();
    let path = folder.path().join("details.json");
    let text = r#"{"format": "truepose-details/1", "customer": "<b>Lamps & Co", "machine_serial": "L-17",
        "operator": "A. Meier", "date": "22 Nov 2026", "logo": "logo.png", "tolerance_mm": 2.1,
        "decision_rule": "iso-14253-1"}"#;
    std::fs::write(&path, text).unwrap();
    let own = Details::load(&path).unwrap();
    let again = Details::parse(Place::default(), &own.document());
    assert_eq!(again.unwrap(), own, "what is written reads the same");

    let session = lamp();
    let found = pipeline::diagnose(&session, &Options::default(), &|_| true).unwrap();
    let made = report(&session, &found, own.clone());
    let page = html(&made);
    assert_eq!(page, html(&report(&session, &found, own.clone())));
    for part in [
        "&lt;b&gt;Lamps &amp; Co",
        "L-17",
        "<b>Pass</b>",
        "img-src data:",
        "src=\"data:image/png;base64,",
        "<dt>Serial number of the instrument</dt><dd></dd>",
        "<dd>A. Meier</dd>",
        "<dd>22 Nov 2026</dd>",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let document = pdf(&made).unwrap().bytes;
    assert_eq!(document, pdf(&report(&session, &found, own)).unwrap().bytes);
    let has = |bytes: &[u8]| document.windows(bytes.len()).any(|part| part == bytes);
    assert!(has(b"/Subtype /Image") && has(b"/Width 3") && has(b"/XObject"));
    let plain = report(&session, &found, Details::default());
    assert!(!html(&plain).contains("img-src"), "only where there is one");
    assert!(plain.sections.iter().all(|s| s.title != "Report details"));
}

#[test]
fn wrong_details_are_refused_with_their_places() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("details.json");
    std::fs::write(folder.path().join("logo.png"), "GIF89a").unwrap();
    let text = "{\n \"format\": \"truepose-details/1\",\n \"custmer\": \"x\",\n \
                \"operator\": 7,\n \"logo\": \"logo.png\",\n \"tolerance_mm\": -1,\n \
                \"decision_rule\": \"hope\"\n}";
    std::fs::write(&path, text).unwrap();
    let output = crate::program::truepose()
        .args(["report", "sessions/paper-30.json", "--details"])
        .arg(&path)
        .arg("--out")
        .arg(folder.path().join("x.html"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let says = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{says}");
    for part in [
        "details.json, line 3, column 2",
        "one of report_number",
        "line 4, column 14",
        "logo.png",
        "expected a PNG file",
        "a number above 0",
        "one of 'iso-14253-1', 'simple-acceptance'",
    ] {
        assert!(says.contains(part), "{part}: {says}");
    }
    assert!(!folder.path().join("x.html").exists());
}
