//! Robots whose errors are known, and what is made of them for the tests of the exports.

#![allow(dead_code, reason = "each test uses a part")]
#![allow(unreachable_pub, reason = "included in tests")]

use truepose::compensation::VerifiedCalibration;
use truepose::effects::{Inputs, JointValues, Owner, Term};
use truepose::export::{Export, ExportError, Job, find};
use truepose::fit::identify_exact;
use truepose::kinematics::Range;
use truepose::model::{Calibration, Model};
use truepose::pipeline;
use truepose::sessions::{Session, parse};

/// Formats with a column for each direction, and those with one for both.
pub const TWO_SIDED: [&str; 3] = ["csv", "linuxcnc", "twincat-cnc"];
pub const ONE_SIDED: [&str; 2] = ["twincat-nc", "sinumerik"];

/// Notes, each on a line of its own.
pub fn joined(notes: &[truepose::text::Text]) -> String {
    let notes: Vec<String> = notes.iter().map(ToString::to_string).collect();
    notes.join("\n")
}

pub fn identified(session: &Session, effects: &[&str]) -> Calibration {
    let effects: Vec<String> = effects.iter().map(|e| (*e).to_owned()).collect();
    let found = identify_exact(session, &effects, JointValues::default()).expect("identified");
    found.calibration(session, &Inputs::new(session, JointValues::default()))
}

/// One joint that turns about z with its tool 250 mm away, or slides along x.
pub fn one_joint(kind: &str, limits: [f64; 2]) -> Session {
    let [from, to] = limits;
    let q = if kind == "revolute" {
        "q1_deg"
    } else {
        "q1_mm"
    };
    let axis = if kind == "revolute" {
        "[0,0,1]"
    } else {
        "[1,0,0]"
    };
    let text = format!(
        r#"{{"format":"truepose-session/1","name":"known","robot":{{"name":"one","joints":[{{"name":"pan",
        "kind":"{kind}","axis":{axis},"point_mm":[0,0,0],"limits":[{from},{to}]}}],
        "tool":{{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}}}},"tolerance_mm":0.2,
        "samples":{{"columns":{{"{q}":[{from},{to}],"x_mm":[0,0],"y_mm":[0,0],"z_mm":[0,0]}}}}}}"#
    );
    parse(text.as_bytes()).expect("a good session").session
}

/// A model that says exactly this, measured over the whole travel.
pub fn known(session: &Session, effects: &[(&str, &[(&str, f64)])]) -> Calibration {
    let joints = session.robot.joints.len();
    let term = |(id, parameters): &(&str, &[(&str, f64)])| {
        Term::from_parameters(id, 1, parameters, joints).expect("an effect")
    };
    let model = Model::new(session.robot.clone(), effects.iter().map(term).collect());
    let measured = session.robot.joints.iter();
    let measured = measured.map(|j| {
        j.limits.unwrap_or(Range {
            from: -1.0,
            to: 1.0,
        })
    });
    Calibration {
        session: session.name.clone(),
        model,
        covariance: None,
        regions: Vec::new(),
        targets: Vec::new(),
        measured_targets: None,
        measured: measured.collect(),
        measured_steps: None,
        tolerance_mm: session.tolerance_mm,
        compensated_by: None,
        set_up: truepose::model::SetUp::default(),
        conditions: truepose::model::Conditions::default(),
        set_aside: None,
        history: Vec::new(),
        load_kg: None,
        samples_hash: "0".repeat(64),
        program_version: "0".to_owned(),
    }
}

/// A calibration that was made by hand, as one that may be exported: verified on what a robot that is just so
/// would have shown.
pub fn admitted(calibration: &Calibration) -> VerifiedCalibration {
    let robot = &calibration.model.robot;
    let place = |k: usize, joint: usize| {
        let Range { from, to } = calibration.measured[joint];
        let part = (0.5 + k as f64 * 0.754_877_666 / (1.0 + joint as f64).sqrt()).fract();
        from + part * (to - from)
    };
    let q = (0..robot.joints.len()).map(|joint| (0..40).map(|k| place(k, joint)).collect());
    let q: Vec<Vec<f64>> = q.collect();
    let nobodys = vec![None; q.len()];
    let mut session = Session {
        name: calibration.session.clone(),
        note: String::new(),
        robot: robot.clone(),
        targets: calibration.targets.clone(),
        instrument: truepose::sessions::Instrument::default(),
        tolerance_mm: None,
        regions: Vec::new(),
        compensated_by: None,
        samples: truepose::sessions::Samples {
            x_mm: vec![0.0; 40],
            y_mm: vec![0.0; 40],
            z_mm: Some(vec![0.0; 40]),
            q_read: nobodys.clone(),
            dir: nobodys.clone(),
            speed: nobodys,
            q,
            ..truepose::sessions::Samples::default()
        },
        path: None,
    };
    if session.targets.is_empty() {
        session.targets = one_joint("revolute", [-90.0, 90.0]).targets;
    }
    let inputs = Inputs::new(&session, JointValues::Commanded);
    let seen = calibration
        .model
        .without(|term| term.effect.about().owner == Owner::Session);
    let seen = seen.predict(&inputs);
    session.samples.x_mm = seen.x_mm;
    session.samples.y_mm = seen.y_mm;
    session.samples.z_mm = Some(seen.z_mm);
    pipeline::hand_out(calibration, &session).expect("it does what it says")
}

pub fn try_export(
    calibration: &Calibration,
    format: &str,
    step: Option<f64>,
) -> Result<Export, ExportError> {
    let format = find(format).expect("the format is there");
    let name = format!("pan.{}", format.extension);
    let verified = admitted(calibration);
    let job = Job {
        step,
        ..Job::new(&verified, &name)
    };
    format.exporter.export(&job)
}

pub fn export(calibration: &Calibration, format: &str, step: Option<f64>) -> Export {
    try_export(calibration, format, step).unwrap_or_else(|error| panic!("{format}: {error}"))
}

pub fn text(export: &Export) -> String {
    String::from_utf8(export.documents[0].bytes.clone()).expect("UTF-8")
}

pub fn sidecar(export: &Export) -> serde_json::Value {
    serde_json::from_slice(&export.documents[1].bytes).expect("JSON")
}
