//! MCAP recordings of ROS 2, or of anything that writes the same messages as JSON.
//!
//! One topic says where the joints were (`JointState`), another one what was measured (`PoseStamped`,
//! `PointStamped`, `TransformStamped`, or one child frame of a `TFMessage`). They come at different
//! times and from different clocks: the joint values become a path over time, to which the measured
//! points are matched as to any controller's log ([`crate::importers::clock`]). The times are those
//! of the headers, or of the recorder where a header has none.

mod cdr;
mod container;
mod messages;
mod recorded;
mod topics;

use crate::document::number::quoted;
use crate::importers::columns::Columns;
use crate::importers::formats::{Importer, KnownBy, Meanings, OwnOption, Questions};
use crate::importers::settings::{About, ColumnGuess, ReadContext, wrong_value};
use crate::tables::foreign;
use crate::text::Text;

use messages::Type;
use topics::{FRAME_CHILD, JOINT_NAMES, NeedsAnswer, Topic, Topics};

const TOPIC_JOINTS: &str = "topic-joints";
const TOPIC_MEASURED: &str = "topic-measured";
pub(crate) static IMPORTER: Importer = Importer {
    id: "mcap",
    title: phrase!("an MCAP recording: joint states and measured poses"),
    asks: Questions {
        table: false,
        columns: Meanings::Fixed,
        ..Questions::TABLE
    },
    options: &[
        OwnOption {
            name: TOPIC_JOINTS,
            title: phrase!("Topic of the joints"),
            value: "TOPIC",
            help: phrase!("the JointState topic of the joints, where there are several"),
            values: &[],
        },
        OwnOption {
            name: TOPIC_MEASURED,
            title: phrase!("Measured topic"),
            value: "TOPIC",
            help: phrase!("the topic that was measured, where there are several"),
            values: &[],
        },
        OwnOption {
            name: FRAME_CHILD,
            title: phrase!("Child frame"),
            value: "FRAME",
            help: phrase!("the child frame of the transforms that were measured"),
            values: &[],
        },
        OwnOption {
            name: JOINT_NAMES,
            title: phrase!("Joints"),
            value: "A,B,…",
            help: phrase!(
                "the recorded joints from base to tool, where their names are not the robot's"
            ),
            values: &[],
        },
    ],
    known_by: KnownBy::Bytes(|bytes| bytes.starts_with(&mcap::MAGIC[..6])),
    read,
};

/// Reads a recording.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    if !context.bytes.starts_with(&mcap::MAGIC[..6])
        && let Some(refused) = foreign::refused(context.bytes, &context.place)
    {
        context.found.findings.push(*refused);
        return None;
    }
    let topics = gathered(context)?;
    context.found.names = topics.names().map(str::to_owned).collect();
    context.note(text!("topics: {topics}", topics = topics.in_words()));
    let joints = chosen(context, &topics, &JOINTS);
    let measured = chosen(context, &topics, &MEASURED);
    let (joints, measured) = (joints.ok()?, measured.ok()?);
    let Some(measured) = measured else {
        context.refuse(
            text!("no topic with measured poses, points or transforms"),
            MEASURED.expected(),
        );
        return None;
    };
    let commands = if let Some(topic) = joints {
        Some(Box::new(recorded::path(context, topic)?))
    } else {
        context.note(text!(
            "no topic with joint states: --commands says where the robot was sent"
        ));
        None
    };
    let start_ns = joints.and_then(Topic::start_ns).or(measured.start_ns())?;
    let points = recorded::points(context, measured, start_ns)?;
    let columns = Columns { commands, ..points };
    context.found.unit = text!("{unit}, as the format has it", unit = "m, rad");
    let all = columns.commands.iter().map(Box::as_ref).chain([&columns]);
    context.found.columns = all.flat_map(ColumnGuess::certain).collect();
    context.found.rows = columns.rows();
    (!context.is_open()).then_some(columns)
}

/// Everything of use in the file, by topic. A recording that is cut off is good up to there.
fn gathered(context: &mut ReadContext<'_>) -> Option<Topics> {
    let mut topics = Topics::default();
    let part = context.part;
    let mut cancelled = false;
    let read = container::Reader::default().read(context.bytes, &mut |channels, message, share| {
        cancelled = part.reached(0.9 * share).is_err();
        topics.add(&channels[message.channel], message);
        !cancelled
    });
    if cancelled {
        return None;
    }
    if let Err(broken) = read {
        let found = text!(
            "byte {byte}: {found}",
            byte = broken.byte,
            found = broken.found
        );
        if broken.is_cut && topics.messages() > 0 {
            let found = text!("{found}; everything before it is read", found);
            context.warn(found, broken.expected);
        } else {
            context.refuse(found, broken.expected);
            return None;
        }
    }
    Some(topics)
}

/// Which topic is looked for, and how.
struct TopicRequest {
    option: &'static str,
    /// Types, the ones that are preferred first.
    types: &'static [&'static [Type]],
}

const JOINTS: TopicRequest = TopicRequest {
    option: TOPIC_JOINTS,
    types: &[&[Type::JointState]],
};

/// Transforms of a whole tree are taken only where nothing else was measured: most of them are what
/// the robot believes of itself.
const MEASURED: TopicRequest = TopicRequest {
    option: TOPIC_MEASURED,
    types: &[
        &[
            Type::PoseStamped,
            Type::PointStamped,
            Type::TransformStamped,
        ],
        &[Type::TfMessage],
    ],
};

impl TopicRequest {
    fn expected(&self) -> Text {
        let types = self.types.iter().flat_map(|types| types.iter());
        let names: Vec<&str> = types.map(|type_| type_.name()).collect();
        text!(
            "a topic of one of the types {types_in_words}",
            types_in_words = names.join(", ")
        )
    }
}

/// The topic that was said, or the only one of the types that are wanted. `None`: there is none.
fn chosen<'t>(
    context: &mut ReadContext<'_>,
    topics: &'t Topics,
    wanted: &TopicRequest,
) -> Result<Option<&'t Topic>, NeedsAnswer> {
    let of = |types: &[Type]| -> Vec<&'t Topic> {
        let all = topics.list.values();
        all.filter(|topic| types.contains(&topic.type_)).collect()
    };
    let suited: Vec<&Topic> = wanted.types.iter().flat_map(|types| of(types)).collect();
    if let Some(said) = context.reading.options.get(wanted.option) {
        let is =
            |topic: &&&Topic| topic.name.trim_start_matches('/') == said.trim_start_matches('/');
        let found = suited.iter().find(is).copied();
        if found.is_none() {
            let names: Vec<String> = suited.iter().map(|topic| quoted(&topic.name)).collect();
            let found = wrong_value(wanted.option, said);
            let expected = match &names[..] {
                [] => wanted.expected(),
                names => text!("one of {names}", names = names.join(", ")),
            };
            context.refuse(found, expected);
            return Err(NeedsAnswer);
        }
        return sound(context, found);
    }
    for types in wanted.types {
        let mut candidates = of(types);
        // What never changes was not measured while the robot moved.
        if candidates.len() > 1 {
            candidates.retain(|topic| !topic.name.ends_with("tf_static"));
        }
        match candidates[..] {
            [] => {}
            [only] => return sound(context, Some(only)),
            _ => {
                let names: Vec<&str> = candidates.iter().map(|topic| topic.name.as_str()).collect();
                let says = text!(
                    "several topics are of a type that suits: {names}",
                    names = names.join(", ")
                );
                context.ask(About::Own(wanted.option), says, &names);
                return Err(NeedsAnswer);
            }
        }
    }
    Ok(None)
}

/// The topic, if its messages can be read.
fn sound<'t>(
    context: &mut ReadContext<'_>,
    topic: Option<&'t Topic>,
) -> Result<Option<&'t Topic>, NeedsAnswer> {
    if let Some(topic) = topic
        && let Some(wrong) = &topic.wrong
    {
        let of = format!("{} {}", quoted(&topic.name), wrong.number);
        let message = text!("{found}: {name}", found = of, name = &wrong.problem);
        let found = text!("byte {byte}: {found}", byte = wrong.byte, found = message);
        context.refuse(
            found,
            text!("a {type} in CDR or JSON", type = topic.type_.name()),
        );
        return Err(NeedsAnswer);
    }
    Ok(topic)
}
