//! What every description of a corrected robot says of itself, and what is made of one that is
//! written: `FILE.meta.json`.

use nalgebra::Vector3;

use super::chain::{Chain, differences_over_range, rms};
use super::euler::Frame;
use super::sidecar::{head, texts};
use super::{Document, Export, ExportError, Job};
use crate::compensation::Compensation;
use crate::document::{Value, object, text_of};
use crate::effects::Term;
use crate::kinematics::{JointKind, Pose, Robot};
use crate::model::Model;
use crate::text::{Template, Text, entered, length};

/// Less than this is nothing, mm.
const WORTH_A_NUMBER_MM: f64 = 5e-5;

named! {
    /// How much of what was identified a file carries.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
    pub(super) frames: Option<Value>,
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

/// The documents of a description, and what there is to say about it.
///
/// # Errors
/// A file that does not read back as it should.
pub(super) fn finish(job: &Job, chain: &Chain, written: Written) -> Result<Export, ExportError> {
    let all = Compensation::new(job.calibration).robot;
    let driven = chain.driven(&written.robot);
    let left = differences_over_range(job, &all, &driven);
    let nominal = &job.calibration.model.robot;
    let rms_mm = rms(&left);
    let max_mm = left.iter().map(|v| rms(&[*v])).fold(0.0, f64::max);
    let nominal_rms_mm = rms(&differences_over_range(job, &all, nominal));
    if !rms_mm.is_finite() {
        return Err(ExportError::ReadBack("it leads nowhere".to_owned()));
    }
    let place = |v: Vector3<f64>| entered([v.x, v.y, v.z]);
    let example = text!(
        "at home the nominal tool is at {nominal}, and this robot has it at {driven}",
        nominal = place(nominal.base_from_tool.translation.vector),
        driven = place(driven.base_from_tool.translation.vector)
    );
    let (zeros_say, zeros) = zeros(nominal, chain, written.zeros.clone());
    let mut said = vec![text!(
        "this robot carries {level}; it is {rms} from the model over the measured range (largest {largest}), the nominal one {nominal} (root mean square)",
        level = written.level.describe(),
        rms = length(rms_mm, 4),
        largest = length(max_mm, 4),
        nominal = length(nominal_rms_mm, 4)
    )];
    said.extend(written.notes.iter().cloned());
    let left_out = left_out(job, chain, written.format);
    let ends = |k: usize| {
        let ends = written.ends.as_ref();
        ends.map_or(Value::Absent, |ends| ends[k].as_str().into())
    };
    let carried = chain.corrected.carried.iter();
    let document = head(job, written.format, written.text.as_bytes()).with(object! {
        "joint_name": "all",
        "units": written.units,
        "sign": written.sign,
        "level": match written.level {
            Level::ZerosAndFrames => "zeros-and-frames",
            Level::Links => "links",
        },
        "level_in_words": written.level.describe(),
        "zeros": zeros,
        "example": object! { "says": &example },
        "base_link": ends(0),
        "tip_link": ends(1),
        "frames": written.frames.unwrap_or(Value::Absent),
        "in_the_controller": texts(&written.in_the_controller),
        "carried": carried.map(|term| name(term).to_string()).collect::<Value>(),
        "left_out": texts(&left_out),
        "cannot_say": texts(&written.cannot_say),
        "leaves": object! { "rms_mm": rms_mm, "max_mm": max_mm, "nominal_rms_mm": nominal_rms_mm },
        "notes": texts(&said),
    });
    let mut meaning = vec![written.sign.into(), example.clone()];
    for all in [&written.in_the_controller, &left_out, &said] {
        meaning.extend(all.iter().cloned());
    }
    let mut notes = vec![example, zeros_say];
    for all in [
        &written.in_the_controller,
        &said,
        &written.cannot_say,
        &left_out,
    ] {
        notes.extend(all.iter().cloned());
    }
    let json = text_of(&document).into_bytes();
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

fn zeros(nominal: &Robot, chain: &Chain, in_words: Option<Text>) -> (Text, Value) {
    let joints = nominal.joints.iter().enumerate().map(|(k, joint)| {
        let outer = |inner: f64| joint.kind.to_display(inner) + 0.0;
        let offset = outer(chain.offsets[k]);
        let of_kind = |kind| {
            if joint.kind == kind {
                Value::from(offset)
            } else {
                Value::Absent
            }
        };
        object! {
            "joint": k + 1,
            "name": &joint.name,
            "offset_deg": of_kind(JointKind::Revolute),
            "offset_mm": of_kind(JointKind::Prismatic),
            "in_the_file": outer(chain.offsets[k] - chain.taken[k]),
            "in_the_controller": outer(chain.taken[k]),
        }
    });
    let taken = nominal.joints.iter().zip(&chain.taken).enumerate();
    let taken = taken.filter(|(_, (_, value))| **value != 0.0);
    let taken: Vec<Text> = taken
        .map(|(k, (joint, value))| {
            let outer = joint.kind.to_display(*value);
            text!(
                "{found}: {name}",
                found = text!("joint {joint}", joint = k + 1),
                name = format!("{outer:+.6}{}", joint.kind.sign())
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
    let says = in_words.unwrap_or(says);
    let document = object! {
        "taken_by": chain.zeros.name(),
        "says": &says,
        "joints": joints.collect::<Value>(),
    };
    (says, document)
}

/// The part of a chain that is not in its rows.
pub(super) fn frames(base: &Pose, tool: &Pose, are: &'static str) -> Value {
    let [base, tool] = [base, tool].map(|pose| Frame::of(pose).document());
    object! { "base": base, "tool": tool, "are": are }
}
