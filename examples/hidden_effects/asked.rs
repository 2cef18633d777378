//! What the program is asked about a session of the rig, and how its answers are read.

use truepose::diagnosis::{Diagnosis, Options, Verdict};
use truepose::effects::{JointValues, Term};
use truepose::fit::{Identification, identify_watched};
use truepose::pipeline::diagnose;
use truepose::present::diagnosis_v1;
use truepose::sessions::Session;

use crate::rig::Rig;
use crate::{names, reaches};

pub fn session(rig: &Rig) -> Session {
    let json = rig.json("hidden");
    let loaded = truepose::sessions::parse(json.as_bytes()).expect("a good session");
    loaded.session
}

pub fn diagnosed_with(rig: &Rig, options: &Options) -> Diagnosis {
    diagnose(&session(rig), options, &|_| true).expect("a diagnosis")
}

/// `identify --effects` with zero offset, link length and these.
pub fn identified(rig: &Rig, beside: &[&str]) -> Identification {
    identified_with(rig, beside, &[])
}

/// The same with terms whose orders are given.
pub fn identified_with(rig: &Rig, beside: &[&str], known: &[Term]) -> Identification {
    let base = ["joint-zero-offset", "link-length"];
    let effects = base.iter().chain(beside).map(|id| (*id).to_owned());
    let effects: Vec<String> = effects.collect();
    let session = session(rig);
    identify_watched(
        &session,
        &effects,
        known,
        true,
        JointValues::Commanded,
        &|| true,
    )
    .expect("an identification")
}

/// The answer as `diagnose --json` prints it: what the contract names, whatever the types inside.
pub fn as_json(rig: &Rig, answer: &Diagnosis) -> serde_json::Value {
    let document = diagnosis_v1::document(answer, &session(rig), None);
    serde_json::to_value(document).expect("a document of plain values")
}

/// Zero offset and link length as they are.
pub fn base_of(rig: &Rig) -> [(&'static str, f64); 2] {
    [
        ("offset_deg", rig.offset.to_degrees()),
        ("delta_mm", rig.length),
    ]
}

/// Whether the truth is what was found or one of the sets that cannot be ruled out.
pub fn in_the_set(answer: &Diagnosis, truth: &[&str]) -> bool {
    let mut rivals = answer.equivalent.iter();
    names(answer) == truth || rivals.any(|rival| reaches(answer, rival, truth))
}

/// Whether the verdict says that nothing more than noise is left.
pub fn says_nothing_is_left(answer: &Diagnosis) -> bool {
    matches!(answer.verdict, Verdict::Noise | Verdict::Explained)
}

/// Session and answer in two lines.
pub fn in_short(rig: &Rig, answer: &Diagnosis) -> String {
    let design = &rig.design;
    let rivals: Vec<_> = answer
        .equivalent
        .iter()
        .map(|e| (&e.explanation, &e.instead))
        .collect();
    // A form has dozens of waves.
    let hidden: Vec<_> = rig.hidden.iter().filter(|h| h.id() != "form").collect();
    format!(
        "{} samples, span {} shuffled {}, {hidden:?}\n    found {:?} {:?} '{}' p {:.4} {:?} set {rivals:?} slow {:?}{}",
        rig.shots.len(),
        design.span_deg,
        design.shuffled,
        names(answer),
        answer.verdict,
        answer.unexplained.description,
        answer.unexplained.p,
        answer.unexplained.resembles,
        answer.noise.slow,
        written(rig),
    )
}

/// Writes the session into the folder that `SESSIONS` in the environment names, if it does.
pub fn written(rig: &Rig) -> String {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let Some(folder) = std::env::var_os("SESSIONS") else {
        return String::new();
    };
    let json = rig.json("hidden");
    let mut hasher = DefaultHasher::new();
    json.hash(&mut hasher);
    let path = std::path::Path::new(&folder).join(format!("{:016x}.json", hasher.finish()));
    match std::fs::write(&path, json) {
        Ok(()) => format!(" in {}", path.display()),
        Err(error) => format!(" not written: {error}"),
    }
}
