//! What the messages of a recording say, topic by topic.

use std::collections::BTreeMap;

use super::container::{Channel, Message};
use super::messages::{self, Content, Measured, Type};
use crate::text::Text;

pub(super) const FRAME_CHILD: &str = "frame-child";
pub(super) const JOINT_NAMES: &str = "joint-names";

/// Something is asked or wrong, and stands in the inspection.
pub(super) struct NeedsAnswer;

/// Joints that a topic may name.
const MOST_JOINTS: usize = 1024;

/// A topic whose messages are of use.
#[derive(Debug)]
pub(super) struct Topic {
    pub(super) name: String,
    pub(super) type_: Type,
    /// Messages that were read.
    pub(super) messages: usize,
    /// The first message that cannot be read.
    pub(super) wrong: Option<WrongMessage>,
    /// Times in ns and values of each joint.
    pub(super) joints: BTreeMap<String, Vec<(i64, f64)>>,
    /// Names of the joints in the order of the first message that has them.
    pub(super) joint_names: Vec<String>,
    pub(super) measured: Vec<Measured>,
    /// Messages that name joints, or none, and have no positions.
    pub(super) without_positions: usize,
}

/// A message that cannot be read.
#[derive(Debug)]
pub(super) struct WrongMessage {
    pub(super) byte: usize,
    /// Counted from 1.
    pub(super) number: usize,
    pub(super) problem: Text,
}

impl Topic {
    /// The earliest time, ns.
    pub(super) fn start_ns(&self) -> Option<i64> {
        let joints = self.joints.values().flatten().map(|(time, _)| *time);
        let measured = self.measured.iter().map(|measured| measured.header.time_ns);
        joints.chain(measured).min()
    }

    fn take(&mut self, content: Content, log_time_ns: i64) -> Result<(), Text> {
        let time = |header_ns: i64| {
            if header_ns == 0 {
                log_time_ns
            } else {
                header_ns
            }
        };
        match content {
            Content::Joints {
                header,
                names,
                values,
            } => {
                self.without_positions += usize::from(values.is_empty());
                let time_ns = time(header.time_ns);
                for (name, value) in names.into_iter().zip(values) {
                    if !self.joints.contains_key(&name) {
                        if self.joint_names.len() == MOST_JOINTS {
                            return Err(messages::not_whole());
                        }
                        self.joint_names.push(name.clone());
                    }
                    self.joints.entry(name).or_default().push((time_ns, value));
                }
            }
            Content::Measured(list) => {
                self.measured.extend(list.into_iter().map(|mut measured| {
                    measured.header.time_ns = time(measured.header.time_ns);
                    measured
                }));
            }
        }
        Ok(())
    }
}

#[derive(Debug, Default)]
pub(super) struct Topics {
    /// Topics of use, by name.
    pub(super) list: BTreeMap<String, Topic>,
    /// Messages of the other ones, by name and type.
    others: BTreeMap<(String, String), usize>,
}

impl Topics {
    /// Takes a message.
    pub(super) fn add(&mut self, channel: &Channel, message: &Message<'_>) {
        let type_ = Type::of(&channel.type_name);
        // One name with two types: the second one is another topic, and not of use.
        let known = self.list.get(&channel.topic).map(|topic| topic.type_);
        let Some(type_) = type_.filter(|type_| known.is_none_or(|known| known == *type_)) else {
            let key = (channel.topic.clone(), channel.type_name.clone());
            *self.others.entry(key).or_default() += 1;
            return;
        };
        let new = || Topic {
            name: channel.topic.clone(),
            type_,
            messages: 0,
            wrong: None,
            joints: BTreeMap::new(),
            joint_names: Vec::new(),
            measured: Vec::new(),
            without_positions: 0,
        };
        let topic = self.list.entry(channel.topic.clone()).or_insert_with(new);
        topic.messages += 1;
        if topic.wrong.is_some() {
            return;
        }
        let log_time_ns = i64::try_from(message.log_time_ns).unwrap_or(i64::MAX);
        let content = messages::read(type_, &channel.encoding, message.data);
        if let Err(says) = content.and_then(|content| topic.take(content, log_time_ns)) {
            topic.wrong = Some(WrongMessage {
                byte: message.byte,
                number: topic.messages,
                problem: says,
            });
        }
    }

    /// Number of messages in all.
    pub(super) fn messages(&self) -> usize {
        let of_use: usize = self.list.values().map(|topic| topic.messages).sum();
        of_use + self.others.values().sum::<usize>()
    }

    /// Names of the topics of use.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.list.keys().map(String::as_str)
    }

    /// Every topic with its type and number of messages, those of use first.
    pub(super) fn in_words(&self) -> Text {
        const SHOWN: usize = 20;
        let of_use = self.list.values();
        let of_use = of_use.map(|topic| (&topic.name[..], topic.type_.name(), topic.messages));
        let others = self.others.iter();
        let others = others.map(|((name, type_), count)| (&name[..], &type_[..], *count));
        let all = of_use.chain(others);
        let all = all.map(|(name, type_, count)| format!("{name} ({type_}, {count})"));
        crate::importers::matching::listed_names(all, SHOWN)
    }
}
