//! Pieces that reports of sessions and of models share.

use crate::fit::{Estimate, IMPLAUSIBLE};
use crate::kinematics::{JointKind, Range, Robot};
use crate::sessions::{Instrument, Sigma};

use super::document::{Block, Section, Table, clean};
use super::{Details, Extras};
use crate::present::names::{parameter, title_on, usual_size};
use crate::present::numbers::{plain, short, with_interval};

/// The robot's facts.
pub(super) fn robot_facts(robot: &Robot, measured: &[Range]) -> Vec<(String, String)> {
    let mut facts = vec![("Robot".to_owned(), or_unnamed(&robot.name))];
    for (k, joint) in robot.joints.iter().enumerate() {
        let kind = match joint.kind {
            JointKind::Revolute => "turns",
            JointKind::Prismatic => "slides",
        };
        let mut about = format!("{}, {kind}", or_unnamed(&joint.name));
        let range = |range: &Range| {
            let unit = joint.kind.sign();
            format!(
                "{}{unit} to {}{unit}",
                short(joint.kind.outer(range.from)),
                short(joint.kind.outer(range.to))
            )
        };
        if let Some(limits) = &joint.limits {
            about += &format!(", travel {}", range(limits));
        }
        if let Some(measured) = measured.get(k).filter(|r| r.from.is_finite()) {
            about += &format!(", measured {}", range(measured));
        }
        facts.push((format!("Joint {}", k + 1), about));
    }
    facts
}

pub(super) fn or_unnamed(name: &str) -> String {
    if name.trim().is_empty() {
        "not named".to_owned()
    } else {
        clean(name)
    }
}

/// The instrument with its noise.
pub(super) fn instrument(instrument: &Instrument) -> String {
    let noise = match instrument.sigma_mm {
        None => "noise not stated".to_owned(),
        Some(Sigma::Overall(s)) => format!("noise {} mm (one standard deviation)", short(s)),
        Some(Sigma::PerAxis(s)) => {
            let [x, y, z] = s.map(short);
            format!("noise {x}, {y}, {z} mm along x, y, z (one standard deviation)")
        }
    };
    format!("{}, {noise}", or_unnamed(&instrument.name))
}

/// Parameters with their intervals.
pub(super) fn parameters<'a>(
    estimates: impl Iterator<Item = &'a Estimate>,
    robot: &Robot,
) -> Block {
    let mut table = Table::headed("Effect | Parameter | >Value | Unit | >95 % interval");
    let mut last = String::new();
    for estimate in estimates {
        let name = title_on(estimate.effect, estimate.joint, robot.joints.len());
        let (mut parameter, unit) = parameter(estimate.name);
        if let Some(setup) = &estimate.setup {
            parameter += &format!(", setup {}", clean(setup));
        }
        let (value, interval) = if estimate.is_whole_number() {
            (short(estimate.value), String::new())
        } else {
            let [value, _, interval] = with_interval(estimate.value, estimate.ci95);
            (value, interval)
        };
        let shown = if name == last {
            String::new()
        } else {
            name.clone()
        };
        last = name;
        table.row([shown, parameter, value, unit.to_owned(), interval]);
    }
    Block::Table(table)
}

/// Sizes that no machine has, where there are any.
pub(super) fn implausible<'a>(
    estimates: impl Iterator<Item = &'a Estimate>,
    robot: &Robot,
) -> Option<Block> {
    let remark = |one: &Estimate| {
        let usual = usual_size(one);
        let name = title_on(one.effect, one.joint, robot.joints.len());
        let (parameter, _) = parameter(one.name);
        format!("{name}, {parameter}: {IMPLAUSIBLE} ({usual})")
    };
    let remarks: Vec<String> = estimates
        .filter(|one| one.is_implausible())
        .map(remark)
        .collect();
    (!remarks.is_empty()).then_some(Block::List(remarks))
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
            "made from the model of this report"
        } else if table.samples_hash == samples_hash {
            "made from the samples of this report, by a model with other hash"
        } else {
            "NOT made from this report's samples"
        };
        blocks.push(Block::Heading(clean(&table.name)));
        blocks.push(Block::Facts(vec![
            ("Format".to_owned(), format_in_words(&table.format)),
            ("Joint".to_owned(), clean(&table.joint)),
            ("Origin".to_owned(), belongs.to_owned()),
            ("SHA-256 of the file".to_owned(), table.hash.clone()),
            ("Model".to_owned(), clean(&table.model_hash)),
        ]));
    }
    Some(Section::new("Tables for the controller", blocks))
}

/// What a table's format is called among people, where its sidecar names a known one.
fn format_in_words(id: &str) -> String {
    crate::export::find(id).map_or_else(|| clean(id), |format| format.title.to_owned())
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
        "Report details",
        vec![Block::Facts(facts.collect())],
    ))
}

/// Room for two signatures.
pub(super) fn signatures(extras: &Extras) -> Section {
    let own = &extras.details;
    let line = |name: &str| (name.to_owned(), String::new());
    Section {
        title: "Signatures".to_owned(),
        blocks: vec![
            Block::Text("The figures above were produced by the program from the samples whose hash is stated; they hold for the measured range and conditions".to_owned()),
            Block::Sign(vec![
                ("Calibrated by (name)".to_owned(), clean(&own.operator)),
                line("Accepted by (name)"),
                ("Place, date".to_owned(), clean(&own.date)),
                line("Place, date"),
                line("Signature"),
                line("Signature"),
            ]),
        ],
    }
}

/// What stands at the foot of every page.
pub(super) fn foot(subject: &str, samples_hash: &str) -> String {
    let hash: String = samples_hash.chars().take(12).collect();
    format!(
        "truepose {} · {subject} · samples {hash}",
        env!("CARGO_PKG_VERSION")
    )
}

/// A tolerance or a floor beside a name.
pub(super) fn fact(name: &str, value: impl Into<String>) -> (String, String) {
    (name.to_owned(), value.into())
}

pub(super) fn tolerance(tolerance_mm: Option<f64>) -> (String, String) {
    fact(
        "Tolerance",
        tolerance_mm.map_or_else(|| "not stated".to_owned(), |mm| format!("{} mm", short(mm))),
    )
}
