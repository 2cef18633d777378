//! What every description of a corrected robot says of itself, and what is made of one that is
//! written: `FILE.meta.json`.

use nalgebra::Vector3;
use serde::Serialize;
use sha2::{Digest, Sha256};

use super::chain::{Chain, differences_over_range, rms};
use super::euler::Frame;
use super::{Document, Export, ExportError, Job};
use crate::compensation::Compensation;
use crate::document::number::hexadecimal;
use crate::document::text_of;
use crate::effects::Term;
use crate::kinematics::{JointKind, Pose, Robot};
use crate::model::Model;
use crate::model::format_v1::model_hash;
use crate::text::{Template, Text, entered, length};

/// Less than this is nothing, mm.
const WORTH_A_NUMBER_MM: f64 = 5e-5;

named! {
    /// How much of what was identified a file carries.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
    #[serde(rename_all = "kebab-case")]
    pub(super) enum Level {
        /// The zero offsets of the joints, and the frames of base and tool.
        ZerosAndFrames = phrase!("zero offsets, base and tool frame"),
        /// These, and the geometry of the links.
        Links = phrase!("zero offsets, base and tool frame, and the geometry of the links"),
    }
    fn describe -> Template;
}

/// A description as its format wrote it.
pub(super) struct Written {
    /// The name of the format.
    pub(super) format: &'static str,
    /// The file.
    pub(super) text: String,
    /// Files beside it: ending of the name, content.
    pub(super) companions: Vec<(&'static str, String)>,
    /// The chain that it says when it is read back; values as the controller counts them.
    pub(super) robot: Robot,
    pub(super) level: Level,
    pub(super) units: &'static str,
    /// What its numbers are.
    pub(super) sign: Template,
    /// First and last frame by their names in the file, where it names them.
    pub(super) ends: Option<[String; 2]>,
    /// Base and tool as they have to be entered where the file does not hold them.
    pub(super) frames: Option<Frames>,
    pub(super) in_the_controller: Vec<Text>,
    /// Where the zero offsets are, in words, where the file itself is what the controller takes.
    pub(super) zeros: Option<Text>,
    /// What the format cannot say.
    pub(super) cannot_say: Vec<Text>,
    pub(super) notes: Vec<Text>,
}

impl Written {
    /// The links as metres and radians, with nothing beside the file.
    pub(super) fn of(format: &'static str, text: String, robot: Robot) -> Self {
        Self {
            format,
            text,
            companions: Vec::new(),
            robot,
            level: Level::Links,
            units: "metres and radians",
            sign: phrase!(
                "the numbers are the corrected geometry itself: where joints and tool really are; nothing is added to a command"
            ),
            ends: None,
            frames: None,
            in_the_controller: Vec::new(),
            zeros: None,
            cannot_say: Vec::new(),
            notes: Vec::new(),
        }
    }
}

/// Frames that a controller holds beside the chain.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Frames {
    /// The chain's first frame in the base frame.
    pub(super) base: Frame,
    /// The tool in the chain's last frame.
    pub(super) tool: Frame,
    /// What these two are.
    pub(super) are: &'static str,
}

#[derive(Serialize)]
struct DescriptionSidecar<'a> {
    format: &'static str,
    table: &'a str,
    table_format: &'static str,
    table_sha256: String,
    program_version: &'static str,
    session: &'a str,
    samples_hash: &'a str,
    model_hash: String,
    joint_name: &'static str,
    units: &'static str,
    sign: Template,
    level: Level,
    level_in_words: Template,
    zeros: ZerosJson,
    example: DescriptionExample,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_link: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tip_link: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    frames: Option<Frames>,
    in_the_controller: Vec<Text>,
    carried: Vec<String>,
    left_out: Vec<Text>,
    cannot_say: Vec<Text>,
    leaves: Leaves,
    notes: Vec<Text>,
}

#[derive(Serialize)]
struct DescriptionExample {
    says: Text,
}

/// Where the zero offsets are: in the file's geometry or in the controller, never in both.
#[derive(Serialize)]
struct ZerosJson {
    /// Who takes them.
    taken_by: &'static str,
    says: Text,
    joints: Vec<ZeroJson>,
}

#[derive(Serialize)]
struct ZeroJson {
    joint: usize,
    name: String,
    /// How far the joint stands beyond its command.
    #[serde(skip_serializing_if = "Option::is_none")]
    offset_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    offset_mm: Option<f64>,
    /// What of that is in the geometry of the file, the same unit.
    in_the_file: f64,
    /// What of that the controller has to take, the same unit.
    in_the_controller: f64,
}

/// Distance between the model and the file's robot over the measured range, both directions.
#[derive(Serialize)]
struct Leaves {
    rms_mm: f64,
    max_mm: f64,
    nominal_rms_mm: f64,
}

/// The documents of a description, and what there is to say about it.
///
/// # Errors
/// A file that does not read back as it should.
pub(super) fn finish(job: &Job, chain: &Chain, written: Written) -> Result<Export, ExportError> {
    let all = Compensation::new(job.calibration).robot;
    let driven = chain.driven(&written.robot);
    let left = differences_over_range(job, &all, &driven);
    let nominal = &job.calibration.model.robot;
    let leaves = Leaves {
        rms_mm: rms(&left),
        max_mm: left.iter().map(|v| rms(&[*v])).fold(0.0, f64::max),
        nominal_rms_mm: rms(&differences_over_range(job, &all, nominal)),
    };
    if !leaves.rms_mm.is_finite() {
        return Err(ExportError::ReadBack("it leads nowhere".to_owned()));
    }
    let sidecar = sidecar(job, chain, &written, &driven, leaves);
    let mut notes = vec![sidecar.example.says.clone(), sidecar.zeros.says.clone()];
    notes.extend(sidecar.in_the_controller.iter().cloned());
    notes.extend(sidecar.notes.iter().cloned());
    notes.extend(sidecar.cannot_say.iter().cloned());
    notes.extend(sidecar.left_out.iter().cloned());
    let mut meaning = vec![sidecar.sign.into(), sidecar.example.says.clone()];
    meaning.extend(sidecar.in_the_controller.iter().cloned());
    meaning.extend(sidecar.left_out.iter().cloned());
    meaning.extend(sidecar.notes.iter().cloned());
    let json = text_of(&sidecar).into_bytes();
    let mut documents = Document::with_sidecar(job.file_name, written.text.into_bytes(), json);
    documents.extend(
        written
            .companions
            .into_iter()
            .map(|(ending, text)| Document {
                name: format!("{}{ending}", job.file_name),
                bytes: text.into_bytes(),
            }),
    );
    Ok(Export {
        documents,
        reads_as: None,
        robot: Some(driven),
        left: None,
        meaning,
        notes,
        stays: Vec::new(),
    })
}

fn sidecar<'a>(
    job: &Job<'a>,
    chain: &Chain,
    written: &Written,
    driven: &Robot,
    leaves: Leaves,
) -> DescriptionSidecar<'a> {
    let calibration = job.calibration;
    let nominal = &calibration.model.robot;
    let place = |v: Vector3<f64>| entered([v.x, v.y, v.z]);
    let mut notes = vec![text!(
        "this robot carries {level}; it is {rms} from the model over the measured range (largest {largest}), the nominal one {nominal} (root mean square)",
        level = written.level.describe(),
        rms = length(leaves.rms_mm, 4),
        largest = length(leaves.max_mm, 4),
        nominal = length(leaves.nominal_rms_mm, 4)
    )];
    notes.extend(written.notes.iter().cloned());
    let [base_link, tip_link] = match &written.ends {
        Some([base, tip]) => [Some(base.clone()), Some(tip.clone())],
        None => [None, None],
    };
    DescriptionSidecar {
        format: "truepose-table/1",
        table: job.file_name,
        table_format: written.format,
        table_sha256: hexadecimal(&Sha256::digest(&written.text)),
        program_version: env!("CARGO_PKG_VERSION"),
        session: &calibration.session,
        samples_hash: &calibration.samples_hash,
        model_hash: model_hash(calibration),
        joint_name: "all",
        units: written.units,
        sign: written.sign,
        level: written.level,
        level_in_words: written.level.describe(),
        zeros: zeros(nominal, chain, written.zeros.clone()),
        example: DescriptionExample {
            says: text!(
                "at home the nominal tool is at {nominal}, and this robot has it at {driven}",
                nominal = place(nominal.base_from_tool.translation.vector),
                driven = place(driven.base_from_tool.translation.vector)
            ),
        },
        base_link,
        tip_link,
        frames: written.frames.clone(),
        in_the_controller: written.in_the_controller.clone(),
        carried: chain
            .corrected
            .carried
            .iter()
            .map(|term| name(term).to_string())
            .collect(),
        left_out: left_out(job, chain, written.format),
        cannot_say: written.cannot_say.clone(),
        leaves,
        notes,
    }
}

fn name(term: &Term) -> Text {
    let about = term.effect.about();
    if about.per_joint {
        let joint = term.joint + 1;
        Text::named(
            format!("{} of joint {joint}", about.id),
            text!("{effect}, joint {joint}", effect = about.title, joint),
        )
    } else {
        Text::named(about.id, about.title)
    }
}

/// What has no place in a chain of joints, each with what it leaves by itself.
fn left_out(job: &Job, chain: &Chain, format: &str) -> Vec<Text> {
    let nominal = &job.calibration.model.robot;
    let title = match format {
        "urdf" => phrase!("a URDF"),
        "mjcf" => phrase!("an MJCF file"),
        _ => phrase!("a chain of joints"),
    };
    let leaves = |term: &Term| {
        let alone = Model::new(nominal.clone(), vec![term.clone()]);
        let mm = rms(&differences_over_range(job, &alone, nominal));
        if mm < WORTH_A_NUMBER_MM {
            text!(
                "{effect} has no place in {file}: at standstill, without load and at 20 °C it leaves nothing",
                effect = name(term),
                file = title
            )
        } else {
            text!(
                "{effect} has no place in {file}: it leaves {left}",
                effect = name(term),
                file = title,
                left = length(mm, 4)
            )
        }
    };
    chain.corrected.left_out.iter().map(leaves).collect()
}

fn zeros(nominal: &Robot, chain: &Chain, in_words: Option<Text>) -> ZerosJson {
    let joints = nominal.joints.iter().enumerate().map(|(k, joint)| {
        let outer = |inner: f64| joint.kind.to_display(inner) + 0.0;
        let offset = outer(chain.offsets[k]);
        ZeroJson {
            joint: k + 1,
            name: joint.name.clone(),
            offset_deg: (joint.kind == JointKind::Revolute).then_some(offset),
            offset_mm: (joint.kind == JointKind::Prismatic).then_some(offset),
            in_the_file: outer(chain.offsets[k] - chain.taken[k]),
            in_the_controller: outer(chain.taken[k]),
        }
    });
    let taken = nominal.joints.iter().zip(&chain.taken).enumerate();
    let taken = taken.filter(|(_, (_, value))| **value != 0.0);
    let taken: Vec<Text> = taken
        .map(|(k, (joint, value))| {
            let outer = joint.kind.to_display(*value);
            text!(
                "joint {joint} by {offset}",
                joint = k + 1,
                offset = format!("{outer:+.6}{}", joint.kind.sign())
            )
        })
        .collect();
    let says = match chain.zeros {
        super::Zeros::Origins => {
            text!(
                "the zero offsets are in this file: leave the zeros of the controller as they are"
            )
        }
        super::Zeros::Controller if taken.is_empty() => {
            text!("no joint has a zero offset for the controller to take")
        }
        super::Zeros::Controller => text!(
            "the zero offsets are left to the controller and are not in this file: its joints stand beyond what it shows, {joints}; move its zeros so that it shows as much more",
            joints = Text::listed(taken, ", ")
        ),
    };
    ZerosJson {
        taken_by: chain.zeros.name(),
        says: in_words.unwrap_or(says),
        joints: joints.collect(),
    }
}

/// The part of a chain that is not in its rows.
pub(super) fn frames(base: &Pose, tool: &Pose, are: &'static str) -> Frames {
    Frames {
        base: Frame::of(base),
        tool: Frame::of(tool),
        are,
    }
}
