//! The report as a customer gets it: the same bytes every time, nothing fetched, nothing that a name
//! holds becomes markup, and the numbers of the answer in both formats.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::{Value, json};

use truepose::diagnosis::{DiagnoseError, Diagnosis, Options};
use truepose::fit::NotIdentifiable;
use truepose::fonts::cannot_be_shown;
use truepose::model::Calibration;
use truepose::model::model_hash;
use truepose::pipeline::{self, diagnose};
use truepose::report::svg::svg_file;
use truepose::report::{Extras, Report, ReportError, html, pdf, plots, stages};
use truepose::sessions::{Session, load, parse};
use truepose::text::Text;

fn bundled(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("sessions")
        .join(name)
}

fn lamp() -> Session {
    load(bundled("lamp-commissioning.json"))
        .expect("a bundled session")
        .session
}

fn report(session: &Session) -> Report {
    let made = pipeline::report(session, &Options::default(), &Extras::default(), &|_| true);
    made.unwrap_or_else(|e| panic!("{}: {e}", session.name))
}

fn session(document: &Value) -> Session {
    let loaded = parse(document.to_string().as_bytes());
    loaded.unwrap_or_else(|e| panic!("{e}")).session
}

fn column(name: &str) -> Value {
    json!({
        "name": name,
        "joints": [{ "name": name, "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0] }],
        "tool": { "position_mm": [250, 0, 300], "quaternion_wxyz": [1, 0, 0, 0] }
    })
}

/// A session of one revolute joint with a small offset and a small deterministic scatter.
fn small(n: usize, planar: bool) -> Session {
    let q: Vec<f64> = (0..n)
        .map(|k| -90.0 + 180.0 * (k as f64 + 0.5) / n as f64)
        .collect();
    let scatter = |k: usize, by: f64| 0.02 * (k as f64 * by).sin();
    let point = |f: fn(f64) -> f64, by: f64| -> Vec<f64> {
        let each = q.iter().enumerate();
        each.map(|(k, q)| 250.0 * f((q + 0.2).to_radians()) + scatter(k, by))
            .collect()
    };
    let mut columns = json!({
        "q1_deg": q, "x_mm": point(f64::cos, 12.9898), "y_mm": point(f64::sin, 78.233)
    });
    if !planar {
        let z: Vec<f64> = (0..n).map(|k| 300.0 + scatter(k, 37.719)).collect();
        columns["z_mm"] = json!(z);
    }
    session(&json!({
        "format": "truepose-session/1", "name": format!("{n} samples"), "robot": column("pan"),
        "samples": { "columns": columns }
    }))
}

/// Follows the references of a PDF: the table of objects and the streams must be whole.
fn check_pdf(bytes: &[u8]) {
    assert!(bytes.starts_with(b"%PDF-1."));
    assert!(bytes.ends_with(b"%%EOF"));
    let text = String::from_utf8_lossy(bytes);
    let after = |text: &str, word: &str| text.rsplit_once(word).unwrap().1.trim_start().to_owned();
    let start: usize = after(&text, "startxref")
        .lines()
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!(bytes[start..].starts_with(b"xref"));
    let table = String::from_utf8_lossy(&bytes[start..]).into_owned();
    let mut lines = table.lines().skip(1);
    let count: usize = lines
        .next()
        .unwrap()
        .split(' ')
        .nth(1)
        .unwrap()
        .parse()
        .unwrap();
    for number in 0..count {
        let line = lines.next().unwrap();
        if line.trim_end().ends_with('n') {
            let offset: usize = line[..10].parse().unwrap();
            let head = format!("{number} 0 obj");
            assert!(
                bytes[offset..].starts_with(head.as_bytes()),
                "object {number}"
            );
        }
    }
    let dated = ["CreationDate", "ModDate"]
        .iter()
        .any(|key| text.contains(key));
    assert!(!dated, "a date would make every report another one");
}

/// What a reader sees, if the tool that says so is there.
fn words_of(pdf: &[u8]) -> Option<String> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.pdf");
    std::fs::write(&file, pdf).unwrap();
    match Command::new("pdftotext")
        .arg("-layout")
        .arg(&file)
        .arg("-")
        .output()
    {
        Ok(output) => {
            assert!(
                output.stderr.is_empty(),
                "{}",
                String::from_utf8_lossy(&output.stderr)
            );
            Some(String::from_utf8(output.stdout).unwrap())
        }
        Err(error) => {
            eprintln!("skipped: the words of the PDF are not read, pdftotext: {error}");
            None
        }
    }
}

/// Nothing in the page asks for anything from elsewhere.
fn check_offline(page: &str) {
    let lower = page.to_lowercase();
    for word in [
        "<script",
        "<link",
        "<img",
        "<iframe",
        "<object",
        "<base",
        "href=",
        "src=",
        "@import",
        "javascript:",
    ] {
        assert!(!lower.contains(word), "{word}");
    }
    for (at, _) in lower.match_indices("url(") {
        assert!(
            lower[at..].starts_with("url(data:font/ttf;base64,"),
            "{}",
            &lower[at..at + 40]
        );
    }
    assert!(page.contains("Content-Security-Policy\" content=\"default-src 'none'"));
}

#[test]
fn the_same_session_gives_the_same_bytes_and_both_formats_hold_the_numbers() {
    let session = lamp();
    let (first, second) = (report(&session), report(&lamp()));
    let page = html(&first);
    let document = pdf(&first).unwrap().bytes;
    assert_eq!(page, html(&second));
    assert_eq!(document, pdf(&second).unwrap().bytes);
    check_offline(&page);
    check_pdf(&document);
    let words = words_of(&document);
    // The hidden values, as README's walk finds them, with the digits that their intervals support.
    for expected in [
        "lamp commissioning",
        "−0.35049",
        "−0.35128 … −0.34969",
        "−1.3964",
        "0.0594",
        "0.0481",
        "0.0200",
        "2.4773",
        "0 of 208",
        "with corrected commands; 0 as measured",
        "rock the output by hand with the drive held",
        "Encoder eccentricity",
        "(chance that noise alone looks like this)",
        "gravity is along the axis",
        "Accepted by (name)",
        &truepose::sessions::hash_of_samples(&session),
    ] {
        let in_page = page.contains(expected) || page.contains(&expected.replacen('n', "N", 1));
        assert!(in_page, "{expected}");
        if let Some(words) = &words {
            let joined: String = words.split_whitespace().collect::<Vec<_>>().join(" ");
            let in_words =
                joined.contains(expected) || joined.contains(&expected.replacen('n', "N", 1));
            assert!(in_words, "{expected} in the PDF");
        }
    }
}

#[test]
fn a_note_keeps_its_lines_and_shows_the_first_digits_of_hashes() {
    let hash = "0123456789abcdef".repeat(4);
    let mut session = small(8, false);
    session.note = format!(
        "imported from a.txt (sha256 {hash}) as tracker.\nreference point 'B4' has a residual of 0.903 mm: excluded \
         from the alignment.\nexcluded 1 measurement without a command: 'try' (line 51)."
    );
    let made = report(&session);
    let page = html(&made);
    assert!(!page.contains(&hash), "twelve digits are enough to compare");
    assert!(page.contains("(sha256 0123456789ab…) as tracker.<br>"));
    assert!(page.contains("excluded from the alignment.<br>\nexcluded 1 measurement"));
    let document = pdf(&made).unwrap().bytes;
    check_pdf(&document);
    if let Some(words) = words_of(&document) {
        let lines: Vec<&str> = words.lines().map(str::trim).collect();
        let own = "excluded 1 measurement without a command: 'try' (line 51).";
        assert!(lines.contains(&own), "a line of its own: {words}");
    }
}

#[test]
fn a_report_is_of_the_model_that_is_in_use_and_says_in_what_it_is_another() {
    let (session, options, extras) = (lamp(), Options::default(), Extras::default());
    let found = diagnose(&session, &options, &|_| true).unwrap();
    let all = found.calibration(&session);
    let of = |model: Option<&Calibration>| {
        // A model that lost an effect is one that says nothing of its errors.
        let model = model.map(|model| pipeline::hand_out(model, &session).unwrap());
        let model = model.as_ref();
        html(&pipeline::report_of_diagnosis(&session, &found, model, &options, &extras).unwrap())
    };
    assert_eq!(of(Some(&all)), of(None), "what was found is in use");
    let model = all
        .model
        .without(|term| term.effect.about().id == "backlash");
    let less = Calibration {
        model,
        covariance: None,
        history: Vec::new(),
        ..all
    };
    let page = of(Some(&less));
    for said in [
        "the model in use is another one: without Backlash",
        "RMS error, model in use (without Backlash)",
        "RMS error, model in use",
        &model_hash(&less),
    ] {
        assert!(page.contains(said), "{said}");
    }
    assert!(!page.contains(&model_hash(&found.calibration(&session))));
}

#[test]
fn names_from_outside_stay_text_in_both_formats() {
    let evil = "<script>alert(1)</script>\" onload='x' & http://example.org \u{202e}Ось 检 e\u{0}";
    let document = json!({
        "format": "truepose-session/1", "name": evil, "note": evil, "robot": column(evil),
        "targets": { evil: [0, 0, 0], "B": [0, 50, 0] },
        "instrument": { "name": evil },
        "samples": { "columns": {
            "q1_deg": [0, 20, 40, 60, 0, 20, 40, 60],
            "x_mm": [250, 235, 191.5, 125, 250, 235, 191.5, 125],
            "y_mm": [0, 85.5, 160.7, 216.5, 0, 85.5, 160.7, 216.5],
            "z_mm": [300, 300, 300, 300, 300, 300, 300, 300],
            "dir1": [1, 1, 1, 1, 1, 1, 1, 1],
            "target": [evil, evil, evil, evil, evil, evil, evil, evil]
        } }
    });
    let made = report(&session(&document));
    let page = html(&made);
    check_offline(&page.replace("http://example.org", ""));
    assert!(
        page.contains("&lt;script&gt;alert(1)&lt;/script&gt;&quot; onload=&#39;x&#39; &amp; http")
    );
    assert!(page.contains("Ось 检") && page.contains("[U+202E]") && !page.contains('\u{202e}'));
    let document = pdf(&made).unwrap().bytes;
    check_pdf(&document);
    if let Some(words) = words_of(&document) {
        assert!(words.contains("<script>alert(1)</script>"), "{words}");
        assert!(words.contains("Ось"), "Cyrillic is in the embedded fonts");
        assert!(
            words.contains('检'),
            "what no font has can still be searched and copied"
        );
    }
}

#[test]
fn every_kind_of_session_has_a_report() {
    for session in [
        small(1, false),
        small(1, true),
        small(3, true),
        small(40, true),
        small(60, false),
    ] {
        let made = report(&session);
        check_offline(&html(&made));
        check_pdf(&pdf(&made).unwrap().bytes);
    }
    let one = html(&report(&small(1, false)));
    assert!(
        one.contains("too few samples") && one.contains("noise not stated"),
        "{one}"
    );
    assert!(!one.contains("NaN") && !one.contains("inf mm"));
}

#[test]
fn a_joint_that_turns_the_other_way_is_reported_as_a_data_problem_and_the_rest_as_mended() {
    let mut reversed = small(60, false);
    for q in &mut reversed.samples.q[0] {
        *q = -*q;
    }
    let made = report(&reversed);
    let page = html(&made);
    assert!(
        page.contains("the data had problems") && page.contains("Data: "),
        "{page}"
    );
    // Against the mended session the model is as good as the scatter of 0.02 mm.
    let left = &made.headline[1];
    assert!(left.value.starts_with("0.0"), "{left:?}");
    check_pdf(&pdf(&made).unwrap().bytes);
}

#[test]
fn an_arm_of_two_joints_has_a_report() {
    let (mut q1, mut q2, mut x, mut y, mut z) = (vec![], vec![], vec![], vec![], vec![]);
    for k in 0..30 {
        let (a, b) = (f64::from(k * 37 % 90) - 45.0, f64::from(k * 53 % 80));
        let radius = 300.0 + b + 0.3;
        let turn = (a + 0.1).to_radians();
        let scatter = 0.02 * (f64::from(k) * 12.9898).sin();
        q1.push(a);
        q2.push(b);
        x.push(radius * turn.cos() + scatter);
        y.push(radius * turn.sin() - scatter);
        z.push(100.0 + scatter);
    }
    let robot = json!({
        "name": "pan and slide",
        "joints": [
            { "name": "pan", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0] },
            { "name": "slide", "kind": "prismatic", "axis": [1, 0, 0], "point_mm": [0, 0, 0] }
        ],
        "tool": { "position_mm": [300, 0, 100], "quaternion_wxyz": [1, 0, 0, 0] }
    });
    let made = report(&session(&json!({
        "format": "truepose-session/1", "name": "arm", "robot": robot, "samples": { "columns": {
            "q1_deg": q1, "q2_mm": q2, "x_mm": x, "y_mm": y, "z_mm": z
        } }
    })));
    let page = html(&made);
    assert!(
        page.contains("Joint 2") && page.contains("slide, slides"),
        "{page}"
    );
    check_offline(&page);
    check_pdf(&pdf(&made).unwrap().bytes);
}

/// Sessions with known truth, where they are at hand.
#[test]
fn ambiguous_unexplained_and_noisy_sessions_say_so() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/practice");
    if !folder.is_dir() {
        eprintln!("skipped: {} is not there", folder.display());
        return;
    }
    for (name, expected) in [
        ("nothing-gauss", "Nothing is missing in the model"),
        ("nothing-outliers", "Excluded outliers: "),
        (
            "alias-one-speed",
            "Effects that the samples cannot tell apart",
        ),
        ("alias-one-speed", "Poses that would decide"),
        ("unknown-local-bump", "Left without a name"),
        (
            "one-way-only",
            "every pose was approached from the same side",
        ),
    ] {
        let session = load(folder.join(format!("{name}.json"))).unwrap().session;
        let made = report(&session);
        let page = html(&made);
        assert!(page.contains(expected), "{name}: {expected}");
        check_offline(&page);
        check_pdf(&pdf(&made).unwrap().bytes);
    }
}

#[test]
fn noise_outliers_and_a_fit_that_did_not_converge_are_reported() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/facts/facts.json");
    let session = load(path).unwrap().session;
    let options = Options::default();
    let mut found = diagnose(&session, &options, &|_| true).unwrap();
    let page = |found: &Diagnosis| {
        let extras = Extras::default();
        let made = pipeline::report_of_diagnosis(&session, found, None, &options, &extras).unwrap();
        let page = html(&made);
        check_offline(&page);
        check_pdf(&pdf(&made).unwrap().bytes);
        page
    };
    let said = page(&found);
    for part in [
        "Measurement noise: σ = ",
        "Slow noise: the measuring frame wanders by ",
        "Excluded outliers: 3 of 160 samples",
        "implausibly large: more than ten times what is usual",
    ] {
        assert!(said.contains(part), "{part}");
    }
    assert!(!said.contains("did not converge"));
    found.identification.quality.converged = false;
    found.identification.not_identifiable = vec![NotIdentifiable {
        combination: Text::verbatim("offset_deg with about_z_mrad"),
        because: Text::verbatim("the samples show only their sum"),
    }];
    let said = page(&found);
    for part in ["the fit did not converge", "offset_deg with about_z_mrad"] {
        assert!(said.contains(part), "{part}");
    }
}

#[test]
fn a_hundred_thousand_samples_make_no_larger_report() {
    let made = report(&small(100_000, false));
    let (page, document) = (html(&made), pdf(&made).unwrap().bytes);
    assert!(page.len() < 700_000, "{}", page.len());
    assert!(document.len() < 300_000, "{}", document.len());
    check_pdf(&document);
}

#[test]
fn the_plots_are_files_of_their_own_too() {
    let session = lamp();
    let found = diagnose(&session, &Options::default(), &|_| true).unwrap();
    let calibration: Calibration = found.calibration(&session);
    let verification = truepose::compensation::verify(&calibration, &session).unwrap();
    let stages = stages(&session, &calibration, &verification, Some(found.floor.mm)).unwrap();
    let names: Vec<&str> = stages.stages.iter().map(|s| &*s.name).collect();
    assert_eq!(
        names,
        ["As measured", "With corrected commands", "Model residuals"]
    );
    let drawings = [
        plots::workspace(&stages).0,
        plots::deviation(&stages),
        plots::gap(&found.history, Some(0.05), Some(0.2)),
    ];
    for drawing in drawings {
        let file = svg_file(&drawing, "a < b");
        assert!(file.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
        assert!(file.contains("<title>a &lt; b</title>") && file.trim_end().ends_with("</svg>"));
        assert!(!file.contains("NaN") && !file.contains("inf"));
    }
}

#[test]
fn whoever_watches_can_stop_it() {
    let stopped = pipeline::report(&lamp(), &Options::default(), &Extras::default(), &|_| false);
    assert_eq!(
        stopped,
        Err(ReportError::Diagnose(DiagnoseError::Cancelled))
    );
}

fn truepose(arguments: &[&str]) -> Output {
    crate::program::truepose()
        .args(arguments)
        .output()
        .expect("the program starts")
}

fn refusal(arguments: &[&str]) -> String {
    let output = truepose(arguments);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty());
    message
}

#[test]
fn the_command_writes_what_its_ending_says_and_replaces_nothing_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let session = path("paper-30.json");
    std::fs::copy(bundled("paper-30.json"), &session).unwrap();
    std::fs::copy(bundled("paper-30.csv"), path("paper-30.csv")).unwrap();
    let (page, model, table) = (path("Prüfung.html"), path("model.json"), path("table.csv"));

    let message = refusal(&["report", &session, "--out", &path("report.docx")]);
    assert!(message.contains("ends in .html or .pdf"), "{message}");
    let message = refusal(&["report", &path("nowhere.json"), "--out", &page]);
    assert!(message.contains("nowhere.json"), "{message}");
    assert!(!Path::new(&page).exists());

    assert_eq!(
        truepose(&["diagnose", &session, "--out", &model])
            .status
            .code(),
        Some(0)
    );
    let exported = truepose(&["export", &model, "--to", "csv", "--out", &table]);
    assert_eq!(exported.status.code(), Some(0));
    let arguments = [
        "report",
        &session,
        "--out",
        &page,
        "--table",
        &table,
        "--date",
        "21 <Nov> 2026",
    ];
    let output = truepose(&arguments);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = std::fs::read_to_string(&page).unwrap();
    assert!(text.contains("21 &lt;Nov&gt; 2026") && text.contains("table.csv"));
    assert!(
        text.contains("made from the model of this report"),
        "{text}"
    );

    let message = refusal(&arguments);
    assert!(message.contains("Prüfung.html"), "{message}");
    let again = truepose(&["report", &session, "--out", &page, "--force"]);
    assert_eq!(again.status.code(), Some(0));

    // An input is replaced by nothing, whatever it is called.
    let disguised = path("inputs.html");
    std::fs::rename(&session, &disguised).unwrap();
    let before = std::fs::read(&disguised).unwrap();
    let message = refusal(&["report", &disguised, "--out", &disguised, "--force"]);
    assert!(message.contains("inputs.html"), "{message}");
    assert_eq!(std::fs::read(&disguised).unwrap(), before);

    let other = truepose(&[
        "report",
        &model,
        "--out",
        &path("model.pdf"),
        "--table",
        &table,
    ]);
    assert_eq!(
        other.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&other.stderr)
    );
    let document = std::fs::read(path("model.pdf")).unwrap();
    check_pdf(&document);
    if let Some(words) = words_of(&document) {
        assert!(words.contains("What only a session can show"), "{words}");
        assert!(words.contains("−3.0"), "{words}");
    }
    std::fs::write(path("table.csv.meta.json"), "{\n \"format\": 1 }").unwrap();
    let message = refusal(&["report", &model, "--out", &path("x.pdf"), "--table", &table]);
    assert!(
        message.contains("table.csv.meta.json") && message.contains("truepose-table/1"),
        "{message}"
    );
}

/// A report of which title, robot and joint have names in Chinese.
fn chinese() -> Report {
    let mut robot = column("关节");
    robot["name"] = json!("六轴机器人");
    let session = session(&json!({
        "format": "truepose-session/1", "name": "深圳 3 号线", "robot": robot,
        "samples": { "columns": {
            "q1_deg": [0, 30, 60, 90], "x_mm": [250.1, 216.5, 125.0, 0.1],
            "y_mm": [0.0, 125.1, 216.5, 250.0], "z_mm": [300.0, 300.0, 300.1, 300.0]
        } }
    }));
    report(&session)
}

/// How wide pdftotext finds this word, points; `None`: it is not installed.
fn width_of(pdf: &[u8], word: &str) -> Option<f64> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.pdf");
    std::fs::write(&file, pdf).unwrap();
    let output = Command::new("pdftotext")
        .arg("-bbox")
        .arg(&file)
        .arg("-")
        .output();
    let text = String::from_utf8(output.ok()?.stdout).unwrap();
    let end = format!(">{word}</word>");
    let line = text
        .lines()
        .find(|l| l.ends_with(&end))
        .expect("the word is there");
    let number = |key: &str| -> f64 {
        let (_, after) = line.split_once(key).unwrap();
        after.split('"').nth(1).unwrap().parse().unwrap()
    };
    Some(number("xMax") - number("xMin"))
}

#[test]
fn a_title_in_chinese_is_written_with_a_bundled_font() {
    let made = chinese();
    let written = pdf(&made).unwrap();
    assert!(written.unshown.is_empty(), "{:?}", written.unshown);
    assert_eq!(written, pdf(&made).unwrap(), "the same bytes");
    check_pdf(&written.bytes);
    let bytes = String::from_utf8_lossy(&written.bytes);
    assert_eq!(bytes.matches("/CIDFontType0C").count(), 1);
    assert!(written.bytes.len() < 200_000, "a part of the font");
    if let Some(words) = words_of(&written.bytes) {
        for word in ["深圳 3 号线", "六轴机器人", "关节"] {
            assert!(words.contains(word), "{word}: {words}");
        }
        assert!(!words.contains("[U+"), "{words}");
    }
    if let Some(width) = width_of(&written.bytes, "深圳") {
        // Two letters as wide as the title's 20 points are high.
        assert!((width - 40.0).abs() < 0.1, "{width}");
    }
}

#[test]
fn letters_that_no_font_has_are_codes_and_are_named() {
    let mut session = load(bundled("paper-30.json")).unwrap().session;
    session.name = "สาย 3".to_owned();
    let written = pdf(&report(&session)).unwrap();
    assert_eq!(written.unshown.len(), 3);
    let says = cannot_be_shown(&written.unshown);
    assert!(says.contains("ย (U+0E22)"), "{says}");
    check_pdf(&written.bytes);
    if let Some(words) = words_of(&written.bytes) {
        // Copied or searched, a code is the letter that it stands for.
        assert!(words.contains("สาย"), "{words}");
    }
}
