//! From the messages of two topics to a path of the joints and to measured points.

use crate::text::Text;
use nalgebra::{Quaternion, Vector3};
use std::collections::{BTreeMap, BTreeSet};

use crate::document::number::quoted;
use crate::importers::columns::{Column, Columns};
use crate::importers::joint_names::shared;
use crate::importers::matching::listed_names;
use crate::importers::role::{Proposal, Role};
use crate::importers::settings::{About, ReadContext, wrong_value};
use crate::sessions::columns::{Quantity, Unit};
use crate::tables::Names;

use super::messages::Measured;
use super::topics::{FRAME_CHILD, JOINT_NAMES, NeedsAnswer, Topic};

/// Joint states that are nearer in time are averaged: encoders' noise over a millisecond looks like
/// motion.
const SPACING_NS: i64 = 20_000_000;
/// Names that a message lists.
const SHOWN: usize = 20;

/// Where the robot's joints were over time, as a table of commands. `None`: something is asked, or wrong.
pub(super) fn path(context: &mut ReadContext<'_>, topic: &Topic) -> Option<Columns> {
    let names = joints_of(context, topic)?;
    // A row for each time at which all of them are known; what comes twice is taken once.
    let mut rows: BTreeMap<i64, Vec<f64>> = BTreeMap::new();
    for (joint, name) in names.iter().enumerate() {
        for (time, value) in topic.joints.get(name).into_iter().flatten() {
            let row = rows
                .entry(*time)
                .or_insert_with(|| vec![f64::NAN; names.len()]);
            if row[joint].is_nan() {
                row[joint] = *value;
            }
        }
    }
    if topic.without_positions > 0 {
        context.note(text!(
            one "{count} joint state of {topic} has no positions: left out", "{count} joint states of {topic} have no positions: left out",
            count = topic.without_positions,
            topic = quoted(&topic.name)
        ));
    }
    if !rows
        .values()
        .any(|values| values.iter().all(|value| value.is_finite()))
        && merge(&mut rows)
    {
        context.note(text!(
            "no message of {topic} has all joints: those of its publishers are put together by their times",
            topic = quoted(&topic.name)
        ));
    }
    let all = rows.len();
    rows.retain(|_, values| values.iter().all(|value| value.is_finite()));
    if rows.is_empty() {
        let says = text!(
            "no message of {topic} has all joints",
            topic = quoted(&topic.name)
        );
        context.refuse(says, listed_names(&names, SHOWN));
        return None;
    }
    if rows.len() < all {
        let found = text!(
            one "{count} of {all} messages of {topic} is excluded: a value is missing", "{count} of {all} messages of {topic} are excluded: a value is missing",
            count = all - rows.len(),
            all,
            topic = quoted(&topic.name)
        );
        context.warn(found, Text::default());
    }
    let (time_s, q) = averaged(&rows, names.len(), topic.start_ns()?);
    let mut list = vec![Column::made(Quantity::Time, Unit::Fixed, time_s)];
    for (joint, values) in q.into_iter().enumerate() {
        let slides = context.reading.joints.get(joint).is_some_and(|own| own.1);
        let unit = if slides {
            Unit::Length(1000.0)
        } else {
            Unit::Angle(1.0)
        };
        list.push(Column::made(Quantity::Commanded(joint), unit, values));
    }
    context.note(text!(
        "joint values are those that {topic} reports, {rows} of them, taken as commanded: {names}",
        topic = quoted(&topic.name),
        rows = rows.len(),
        names = names.join(", ")
    ));
    Some(Columns {
        list,
        ..Columns::default()
    })
}

/// Messages that are farther apart say nothing of the time between them.
const FARTHEST_NS: i64 = 500_000_000;

/// Where several publishers each state some of the joints, these are known between their messages. Whether all are
/// somewhere.
fn merge(rows: &mut BTreeMap<i64, Vec<f64>>) -> bool {
    let joints = rows.values().next().map_or(0, Vec::len);
    for joint in 0..joints {
        let known: Vec<(i64, f64)> = rows
            .iter()
            .filter(|(_, values)| values[joint].is_finite())
            .map(|(time, values)| (*time, values[joint]))
            .collect();
        for pair in known.windows(2) {
            let [(from, before), (to, after)] = [pair[0], pair[1]];
            let length = to.saturating_sub(from);
            if length <= FARTHEST_NS {
                for (time, values) in rows.range_mut(from..to).skip(1) {
                    let share = (time - from) as f64 / length as f64;
                    values[joint] = before + share * (after - before);
                }
            }
        }
    }
    rows.values()
        .any(|values| values.iter().all(|value| value.is_finite()))
}

/// The recorded joints that are the robot's, from base to tool.
fn joints_of(context: &mut ReadContext<'_>, topic: &Topic) -> Option<Vec<String>> {
    let robot: Vec<&str> = context
        .reading
        .joints
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    let recorded = listed_names(&topic.joint_names, SHOWN);
    if let Some(said) = context.reading.options.get(JOINT_NAMES) {
        let names: Vec<String> = said.split(',').map(|name| name.trim().to_owned()).collect();
        let distinct: BTreeSet<&String> = names.iter().collect();
        let are_known = names.iter().all(|name| topic.joints.contains_key(name));
        let are_as_many = robot.is_empty() || robot.len() == names.len();
        if are_known && distinct.len() == names.len() && are_as_many {
            return Some(names);
        }
        context.refuse(
            wrong_value(JOINT_NAMES, said),
            text!(
                "as many names as the robot has joints, of {recorded}",
                recorded
            ),
        );
        return None;
    }
    if robot.is_empty() {
        return Some(topic.joint_names.clone());
    }
    if robot.iter().all(|name| topic.joints.contains_key(*name)) {
        return Some(robot.into_iter().map(str::to_owned).collect());
    }
    if robot.len() == 1 && topic.joint_names.len() == 1 {
        return Some(topic.joint_names.clone());
    }
    let kept = vec![Role::Kept; topic.joint_names.len()];
    if let Proposal::One(found) = shared(&topic.joint_names, &kept, &context.reading.joints) {
        // Those that are read back beside commanded ones come last.
        let found = found.iter().take(robot.len());
        let names = found.map(|(index, _)| topic.joint_names[*index].clone());
        return Some(names.collect());
    }
    let says = text!(
        "the recorded joints ({recorded}) are not called like the robot's ({robot}), and their order in a message is not the order of the robot",
        recorded,
        robot = robot.join(", ")
    );
    let answer = topic.joint_names.join(",");
    let answers: &[&str] = if topic.joint_names.len() == robot.len() {
        &[&answer]
    } else {
        &[]
    };
    context.ask(About::Own(JOINT_NAMES), says, answers);
    None
}

/// Times since the start, s, and the values of each joint, without what is nearer in time than the spacing.
fn averaged(
    rows: &BTreeMap<i64, Vec<f64>>,
    joints: usize,
    start_ns: i64,
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (mut time_s, mut q) = (Vec::new(), vec![Vec::new(); joints]);
    let mut rows = rows.iter().peekable();
    while let Some((&first, values)) = rows.next() {
        let mut sum = values.clone();
        let (mut count, mut later_ns) = (1.0, 0.0);
        while let Some((time, values)) =
            rows.next_if(|(time, _)| time.saturating_sub(first) < SPACING_NS)
        {
            count += 1.0;
            later_ns += (time - first) as f64;
            for (sum, value) in sum.iter_mut().zip(values) {
                *sum += value;
            }
        }
        // Relative to the start: a double cannot hold a nanosecond of these days.
        let since_ns = first.saturating_sub(start_ns) as f64 + later_ns / count;
        time_s.push(1e-9 * since_ns);
        for (column, sum) in q.iter_mut().zip(sum) {
            column.push(sum / count);
        }
    }
    (time_s, q)
}

/// What was measured, in the order of time. `None`: something is asked.
pub(super) fn points(
    context: &mut ReadContext<'_>,
    topic: &Topic,
    start_ns: i64,
) -> Option<Columns> {
    let child = child_of(context, topic).ok()?;
    let mut list: Vec<&Measured> = topic
        .measured
        .iter()
        .filter(|measured| child.as_ref().is_none_or(|child| measured.child == *child))
        .collect();
    list.sort_by_key(|measured| measured.header.time_ns);
    let is_there = |measured: &&&Measured| measured.is_there();
    let lost = list.len() - list.iter().filter(is_there).count();
    if lost > 0 {
        let found = text!(
            one "{count} of {all} messages of {topic} is excluded: a value is missing", "{count} of {all} messages of {topic} are excluded: a value is missing",
            count = lost,
            all = list.len(),
            topic = quoted(&topic.name)
        );
        context.warn(found, Text::default());
        list.retain(|measured| measured.is_there());
    }
    if list.is_empty() {
        context.refuse(
            text!(
                "nothing was measured in {topic}",
                topic = quoted(&topic.name)
            ),
            Text::default(),
        );
        return None;
    }
    let frames: BTreeSet<&str> = list.iter().map(|m| m.header.frame.as_str()).collect();
    let listed = listed_names(frames.iter().map(|frame| quoted(frame)), SHOWN);
    let child = child.map_or_else(String::new, |child| format!(" → {}", quoted(&child)));
    context.note(text!(
        "measured is {topic}, {list} times, in the frame {frames}",
        topic = quoted(&topic.name) + &child,
        list = list.len(),
        frames = listed
    ));
    let mut columns = Columns::default();
    let places = list
        .iter()
        .map(|m| (1000.0 * Vector3::from(m.position_m)).into());
    columns.put_places(&places.collect::<Vec<_>>());
    let turns = list.iter().map(|measured| measured.orientation_xyzw);
    if let Some(turns) = turns.collect::<Option<Vec<_>>>() {
        let turns = turns.into_iter().map(Quaternion::from);
        columns.put_orientations(&turns.collect::<Vec<_>>());
    }
    let times = list
        .iter()
        .map(|m| m.header.time_ns.saturating_sub(start_ns));
    let times = times.map(|since_ns| 1e-9 * since_ns as f64).collect();
    columns.put(Column::made(Quantity::Time, Unit::Fixed, times));
    if frames.len() > 1 {
        let mut names = Names::default();
        for measured in &list {
            names.push(&measured.header.frame);
        }
        columns.list.push(Column::named(Quantity::Setup, names));
    }
    Some(columns)
}

/// The child frame that was measured: `None` where there are no transforms.
fn child_of(context: &mut ReadContext<'_>, topic: &Topic) -> Result<Option<String>, NeedsAnswer> {
    let children: BTreeSet<&str> = topic.measured.iter().map(|m| m.child.as_str()).collect();
    let children: Vec<&str> = children
        .into_iter()
        .filter(|child| !child.is_empty())
        .collect();
    if let Some(said) = context.reading.options.get(FRAME_CHILD) {
        if children.contains(&said.as_str()) {
            return Ok(Some(said.clone()));
        }
        let names = listed_names(children.iter().map(|name| quoted(name)), SHOWN);
        let expected = text!("one of {names}", names);
        context.refuse(wrong_value(FRAME_CHILD, said), expected);
        return Err(NeedsAnswer);
    }
    match children[..] {
        [] => Ok(None),
        [only] => Ok(Some(only.to_owned())),
        _ => {
            let says = text!(
                "{topic} has transforms to several frames: {children}",
                topic = quoted(&topic.name),
                children = children.join(", ")
            );
            context.ask(About::Own(FRAME_CHILD), says, &children);
            Err(NeedsAnswer)
        }
    }
}

impl Measured {
    /// A position and, where there is an orientation, one: an instrument that lost its target may
    /// write zeros.
    fn is_there(&self) -> bool {
        let is_finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let turns = self.orientation_xyzw.is_none_or(|q| {
            let norm: f64 = q.iter().map(|part| part * part).sum();
            is_finite(&q) && norm > 0.25 && norm < 4.0
        });
        turns && is_finite(&self.position_m)
    }
}
