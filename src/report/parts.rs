//! Pieces that reports of sessions and of models share.

use crate::fit::Estimate;
use crate::kinematics::{JointKind, Range, Robot};
use crate::sessions::{Instrument, Sigma};

use super::document::{Block, Column, Section, Table, clean};
use super::{Details, Extras};
use crate::language::names::{parameter, title_on, usual_size};
use crate::language::{of_core, spoken};
use crate::present::numbers::{plain, short, with_interval};

/// The robot's facts.
pub(super) fn robot_facts(robot: &Robot, measured: &[Range]) -> Vec<(String, String)> {
    let mut facts = vec![fact(say!("Robot"), or_unnamed(&robot.name))];
    for (k, joint) in robot.joints.iter().enumerate() {
        let kind = match joint.kind {
            JointKind::Revolute => say!("turns"),
            JointKind::Prismatic => say!("slides"),
        };
        let mut about = format!("{}, {kind}", or_unnamed(&joint.name));
        let range = |range: &Range| {
            let unit = joint.kind.sign();
            let [from, to] =
                [range.from, range.to].map(|end| format!("{}{unit}", short(joint.kind.outer(end))));
            say!("{from} to {to}", from = from, to = to)
        };
        if let Some(limits) = &joint.limits {
            about += &say!(", travel {range}", range = range(limits));
        }
        if let Some(measured) = measured.get(k).filter(|r| r.from.is_finite()) {
            about += &say!(", measured {range}", range = range(measured));
        }
        facts.push((say!("Joint {joint}", joint = k + 1), about));
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
    let noise = match instrument.sigma_mm {
        None => say!("noise not stated").to_owned(),
        Some(Sigma::Overall(s)) => say!(
            "noise {sigma} mm (one standard deviation)",
            sigma = short(s)
        ),
        Some(Sigma::PerAxis(s)) => {
            let [x, y, z] = s.map(short);
            say!(
                "noise {x}, {y}, {z} mm along x, y, z (one standard deviation)",
                x = x,
                y = y,
                z = z
            )
        }
    };
    format!("{}, {noise}", or_unnamed(&instrument.name))
}

/// Parameters with their intervals.
pub(super) fn parameters<'a>(
    estimates: impl Iterator<Item = &'a Estimate>,
    robot: &Robot,
) -> Block {
    let mut table = Table::of([
        Column::words(say!("Effect")),
        Column::words(say!("Parameter")),
        Column::numbers(say!("Value")),
        Column::words(say!("Unit")),
        Column::numbers(say!("95 % interval")),
    ]);
    let mut last = String::new();
    for estimate in estimates {
        let name = title_on(estimate.effect, estimate.joint, robot.joints.len());
        let (mut parameter, unit) = parameter(estimate.name);
        if let Some(setup) = &estimate.setup {
            parameter += &say!(", setup {setup}", setup = clean(setup));
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
        let says = spoken(&one.implausible()?);
        let usual = usual_size(one);
        let name = title_on(one.effect, one.joint, robot.joints.len());
        let (parameter, _) = parameter(one.name);
        Some(format!("{name}, {parameter}: {says} ({usual})"))
    };
    let remarks: Vec<String> = estimates.filter_map(remark).collect();
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
            say!("made from the model of this report")
        } else if table.samples_hash == samples_hash {
            say!("made from the samples of this report, by a model with other hash")
        } else {
            say!("NOT made from this report's samples")
        };
        blocks.push(Block::Heading(clean(&table.name)));
        blocks.push(Block::Facts(vec![
            fact(say!("Format"), format_in_words(&table.format)),
            fact(say!("Joint"), clean(&table.joint)),
            fact(say!("Origin"), belongs),
            fact(say!("SHA-256 of the file"), table.hash.clone()),
            fact(say!("Model"), clean(&table.model_hash)),
        ]));
    }
    Some(Section::new(say!("Tables for the controller"), blocks))
}

/// What a table's format is called among people, where its sidecar names a known one.
fn format_in_words(id: &str) -> String {
    crate::export::find(id).map_or_else(|| clean(id), |format| of_core(format.title).into_owned())
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
    Section {
        title: say!("Signatures").to_owned(),
        blocks: vec![
            Block::Text(
                say!(
                    "The figures above were produced by the program from the samples whose hash is stated; they hold for the measured range and conditions"
                )
                .to_owned(),
            ),
            Block::Sign(vec![
                fact(say!("Calibrated by (name)"), clean(&own.operator)),
                line(say!("Accepted by (name)")),
                fact(say!("Place, date"), clean(&own.date)),
                line(say!("Place, date")),
                line(say!("Signature")),
                line(say!("Signature")),
            ]),
        ],
    }
}

/// What stands at the foot of every page.
pub(super) fn foot(subject: &str, samples_hash: &str) -> String {
    let hash: String = samples_hash.chars().take(12).collect();
    say!(
        "truepose {version} · {subject} · samples {hash}",
        version = env!("CARGO_PKG_VERSION"),
        subject = subject,
        hash = hash
    )
}

/// What the core says, line by line, in the language of this thread.
pub(super) fn all_of_core(lines: &[String]) -> Vec<String> {
    lines
        .iter()
        .map(|line| of_core(line).into_owned())
        .collect()
}

/// What the core says with a user's names in it, in the language of this thread.
pub(super) fn told(english: &str) -> String {
    of_core(&clean(english)).into_owned()
}

/// A tolerance or a floor beside a name.
pub(super) fn fact(name: &str, value: impl Into<String>) -> (String, String) {
    (name.to_owned(), value.into())
}

pub(super) fn tolerance(tolerance_mm: Option<f64>) -> (String, String) {
    fact(
        say!("Tolerance"),
        tolerance_mm.map_or_else(
            || say!("not stated").to_owned(),
            |mm| format!("{} mm", short(mm)),
        ),
    )
}
