//! Pieces that reports of sessions and of models share.

use crate::kinematics::{JointKind, Range, Robot};
use crate::sessions::{Instrument, Sigma};
use crate::text::capital;

use super::document::{Block, Section, clean};
use super::{Details, Extras};
use crate::explain::fact;
use crate::language::spoken;
use crate::present::numbers::{plain, short};

/// The robot's facts.
pub(super) fn robot_facts(robot: &Robot, measured: &[Range]) -> Vec<(String, String)> {
    let mut facts = vec![fact(capital(say!("robot")), or_unnamed(&robot.name))];
    for (k, joint) in robot.joints.iter().enumerate() {
        let kind = match joint.kind {
            JointKind::Revolute => say!("turns"),
            JointKind::Prismatic => say!("slides"),
        };
        let mut about = format!("{}, {kind}", or_unnamed(&joint.name));
        let range = |range: &Range| {
            let unit = joint.kind.sign();
            let [from, to] = [range.from, range.to]
                .map(|end| format!("{}{unit}", short(joint.kind.to_display(end))));
            say!("{from} to {to}", from, to)
        };
        if let Some(limits) = &joint.limits {
            let travel = say!("travel {range}", range = range(limits));
            about += &format!(", {travel}");
        }
        if let Some(measured) = measured.get(k).filter(|r| r.from.is_finite()) {
            let measured = say!("measured {range}", range = range(measured));
            about += &format!(", {measured}");
        }
        facts.push((capital(&say!("joint {joint}", joint = k + 1)), about));
    }
    facts
}

pub(super) fn or_unnamed(name: &str) -> String {
    if name.trim().is_empty() {
        say!("not named").to_owned()
    } else {
        clean(name)
    }
}

/// The instrument with its noise.
pub(super) fn instrument(instrument: &Instrument) -> String {
    let sigma = instrument.sigma_mm.map(|sigma| match sigma {
        Sigma::Overall(sigma) => short(sigma),
        Sigma::PerAxis(along_axes) => along_axes.map(short).join(", "),
    });
    let noise = match sigma {
        None => say!("noise not stated").to_owned(),
        Some(sigma) => say!("noise {sigma} mm (one standard deviation)", sigma),
    };
    format!("{}, {noise}", or_unnamed(&instrument.name))
}

/// A gap, or a dash where there is none.
pub(super) fn gap(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), plain)
}

/// The exported tables, if any.
pub(super) fn tables(extras: &Extras, samples_hash: &str, model_hash: &str) -> Option<Section> {
    if extras.tables.is_empty() {
        return None;
    }
    let mut blocks = Vec::new();
    for table in &extras.tables {
        let belongs = if table.model_hash == model_hash {
            say!("made from the model of this report")
        } else if table.samples_hash == samples_hash {
            say!("made from the samples of this report, by a model with other hash")
        } else {
            say!("NOT made from this report's samples")
        };
        blocks.push(Block::Heading(clean(&table.name)));
        blocks.push(Block::Facts(vec![
            fact(say!("Format"), format_in_words(&table.format)),
            fact(capital(say!("joint")), clean(&table.joint)),
            fact(say!("Origin"), belongs),
            fact(say!("SHA-256 of the file"), table.hash.clone()),
            fact(say!("Model"), clean(&table.model_hash)),
        ]));
    }
    Some(Section::new(say!("Tables for the controller"), blocks))
}

/// What a table's format is called among people, where its sidecar names a known one.
fn format_in_words(id: &str) -> String {
    crate::export::find(id).map_or_else(|| clean(id), |format| spoken(format.title))
}

/// What the certificate states besides its measurements, if it states anything; what is empty is
/// filled in by hand.
pub(super) fn details(own: &Details) -> Option<Section> {
    let lines = own.lines();
    if lines.iter().all(|(_, text)| text.trim().is_empty()) {
        return None;
    }
    let facts = lines
        .into_iter()
        .map(|(name, text)| fact(name, clean(&text)));
    Some(Section::new(
        say!("Report details"),
        vec![Block::Facts(facts.collect())],
    ))
}

/// Room for two signatures.
pub(super) fn signatures(extras: &Extras) -> Section {
    let own = &extras.details;
    let line = |name: &str| (name.to_owned(), String::new());
    Section::new(
        say!("Signatures"),
        vec![
            Block::text(say!(
                "The figures above were produced by the program from the samples whose hash is stated; they hold for the measured range and conditions"
            )),
            Block::Sign(vec![
                fact(say!("Calibrated by (name)"), clean(&own.operator)),
                line(say!("Accepted by (name)")),
                fact(say!("Place, date"), clean(&own.date)),
                line(say!("Place, date")),
                line(say!("Signature")),
                line(say!("Signature")),
            ]),
        ],
    )
}

/// What stands at the foot of every page.
pub(super) fn foot(subject: &str, samples_hash: &str) -> String {
    let hash: String = samples_hash.chars().take(12).collect();
    say!(
        "truepose {version} · {subject} · samples {hash}",
        version = env!("CARGO_PKG_VERSION"),
        subject,
        hash
    )
}

pub(super) fn tolerance(tolerance_mm: Option<f64>) -> (String, String) {
    fact(
        capital(say!("tolerance")),
        tolerance_mm.map_or_else(
            || say!("not stated").to_owned(),
            |mm| format!("{} mm", short(mm)),
        ),
    )
}
