//! Commands by the clock: which command the robot was at when a point was measured.
//!
//! Where the robot was told to stand still, its pose is certain and the instrument can average: the
//! points measured during a stop, without its first third and its last tenth (settling, and clocks
//! that are not quite together), become one sample at their mean, without those that stray. Where
//! most points were measured in motion, each stays a sample, with the joint values between the
//! commands before and after and their speed.

use crate::text::{Template, Text};
use std::ops::RangeInclusive;

use nalgebra::Point3;

use crate::diagnostic::{Diagnostic, Place};
use crate::importers::averages::{AVERAGED, Group, Means, without_strays};
use crate::importers::clock::{self, ClockOffset, Timed};
use crate::importers::columns::{Column, Columns};
use crate::importers::matching::{Pairs, join, listed_rows};
use crate::importers::path::{Path, Stop};
use crate::importers::role::Role;
use crate::kinematics::{JointKind, Robot};
use crate::sessions::columns::{Quantity, Unit};
use crate::tables::Cells;

/// What the person says about time.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Timing {
    pub(crate) offset_s: Option<f64>,
    /// The commands are where the robot was read to be, with the noise of its encoders.
    pub(crate) is_recorded: bool,
}

/// What came of it.
pub(crate) struct JoinedByTime {
    pub(crate) columns: Columns,
    pub(crate) clock: ClockOffset,
    pub(crate) findings: Vec<Diagnostic>,
    /// Headings of the commands that were not taken.
    pub(crate) left: Vec<String>,
}

/// At least this share of the points has to lie in stops for stops to be preferred.
const MOSTLY: f64 = 0.4;
const TIMES: Template = phrase!("time_s, or --match order or name");
/// Parts of a stop that are not used, at its start and at its end.
const SETTLING: f64 = 1.0 / 3.0;
const LEAVING: f64 = 0.1;

/// The time of a stop that is used, s.
fn settled(stop: &Stop) -> RangeInclusive<f64> {
    let length = stop.to_s - stop.from_s;
    stop.from_s + SETTLING * length..=stop.to_s - LEAVING * length
}

/// Matches by time.
pub(crate) fn by_time(
    measured: Columns,
    commands: Columns,
    robot: &Robot,
    targets: (&[Point3<f64>], &[usize]),
    timing: Timing,
    places: (&Place, &Place),
) -> Result<JoinedByTime, Box<Diagnostic>> {
    let (measured_place, commands_place) = places;
    let refused = |place: &Place, found: Text, expected: Template| {
        Err(Box::new(Diagnostic::error(place.clone(), found, expected)))
    };
    let Some(time_s) = measured.numbers(Quantity::Time) else {
        let found = text!("no column of times");
        return refused(measured_place, found, TIMES);
    };
    let path = path_of(&commands, robot, commands_place)?;
    let points = timed(&measured, &time_s, targets.1);
    let clock = match timing.offset_s {
        Some(offset_s) => clock::offset_from(&path, robot, targets.0, &points, offset_s),
        None => match clock::find(&path, robot, targets.0, &points) {
            Ok(clock) => clock,
            Err(why) => {
                let expected = phrase!("--clock-offset with the seconds to add to a measured time");
                return refused(measured_place, why.0, expected);
            }
        },
    };
    let at: Vec<f64> = time_s.iter().map(|time| time + clock.offset_s).collect();
    let usable: Vec<bool> = at.iter().map(|time| path.entry(*time).is_some()).collect();
    let stops = path.stops();
    let in_stop: Vec<Option<usize>> = at
        .iter()
        .zip(&usable)
        .map(|(time, usable)| stop_at(&stops, *time).filter(|_| *usable))
        .collect();
    let inside = usable.iter().filter(|usable| **usable).count();
    let standing = in_stop.iter().flatten().count();
    if inside == 0 {
        let found = text!("no measurement falls into the time of the commands");
        return refused(
            measured_place,
            found,
            phrase!("recordings of the same time, or another --clock-offset"),
        );
    }
    let mut findings = Vec::new();
    findings.extend(left_outside(&measured, &usable, measured_place));
    let robot_kinds: Vec<JointKind> = robot.joints.iter().map(|joint| joint.kind).collect();
    let job = Joining {
        path: &path,
        kinds: &robot_kinds,
        at: &at,
        targets: targets.1,
        resolution: path.resolution(&stops, timing.is_recorded),
        is_recorded: timing.is_recorded,
    };
    let (columns, left) = if standing as f64 >= MOSTLY * inside as f64 {
        job.at_stops(
            measured,
            commands,
            &stops,
            &in_stop,
            measured_place,
            &mut findings,
        )
    } else {
        if standing > 0 && inside > standing {
            let found = text!(
                "{standing} of {inside} measurements were taken at stops: all are kept, with their speeds",
                standing,
                inside
            );
            findings.push(Diagnostic::note(measured_place.clone(), found));
        }
        job.in_motion(measured, commands, &usable)
    };
    Ok(JoinedByTime {
        columns,
        clock,
        findings,
        left,
    })
}

/// The path of the commands, or what is wrong with them.
fn path_of(commands: &Columns, robot: &Robot, place: &Place) -> Result<Path, Box<Diagnostic>> {
    Path::new(commands, robot).map_err(|wrong| {
        let (place, found, expected) = match wrong {
            None => (place.clone(), text!("no column of times"), TIMES),
            Some(row) => (
                place
                    .clone()
                    .at_line(commands.lines.get(row).unwrap_or(row as u64 + 1)),
                text!("a time that is not later than the one before"),
                phrase!("rows in the order of time"),
            ),
        };
        Box::new(Diagnostic::error(place, found, expected))
    })
}

/// Measurements outside the time of the commands.
fn left_outside(measured: &Columns, usable: &[bool], place: &Place) -> Option<Diagnostic> {
    let outside: Vec<usize> = (0..usable.len()).filter(|&row| !usable[row]).collect();
    if outside.is_empty() {
        return None;
    }
    let found = text!(
        "excluded {outside} of {usable} measurements, taken before the first or after the last command: {which}",
        outside = outside.len(),
        usable = usable.len(),
        which = listed_rows(measured, &outside)
    );
    Some(Diagnostic::warning(place.clone(), found, Text::default()))
}

fn timed(measured: &Columns, time_s: &[f64], targets: &[usize]) -> Vec<Timed> {
    let of = |quantity| measured.numbers(quantity);
    let (Some(x), Some(y)) = (of(Quantity::X), of(Quantity::Y)) else {
        return Vec::new();
    };
    let z = of(Quantity::Z).unwrap_or_else(|| vec![0.0; x.len()]);
    (0..x.len())
        .filter(|&row| {
            [x[row], y[row], z[row], time_s[row]]
                .iter()
                .all(|v| v.abs() < clock::FARTHEST_MM)
        })
        .map(|row| Timed {
            time_s: time_s[row],
            position: nalgebra::Vector3::new(x[row], y[row], z[row]),
            target: targets.get(row).copied().unwrap_or(0),
        })
        .collect()
}

fn stop_at(stops: &[Stop], time_s: f64) -> Option<usize> {
    let after = stops.partition_point(|stop| stop.from_s <= time_s);
    let index = after.checked_sub(1)?;
    (time_s <= stops[index].to_s).then_some(index)
}

struct Joining<'a> {
    path: &'a Path,
    kinds: &'a [JointKind],
    /// Time of each measurement on the clock of the commands, s.
    at: &'a [f64],
    targets: &'a [usize],
    /// How far each joint has to move before that is a motion, rad or mm.
    resolution: Vec<f64>,
    is_recorded: bool,
}

impl Joining<'_> {
    fn unit(&self, joint: usize) -> Unit {
        match self.kinds[joint] {
            JointKind::Revolute => Unit::Angle(1.0),
            JointKind::Prismatic => Unit::Length(1.0),
        }
    }

    /// Every measurement with the joint values at its time.
    fn in_motion(
        &self,
        measured: Columns,
        commands: Columns,
        usable: &[bool],
    ) -> (Columns, Vec<String>) {
        let rows: Vec<usize> = (0..usable.len()).filter(|&row| usable[row]).collect();
        let entries: Vec<usize> = rows
            .iter()
            .map(|&row| self.path.entry(self.at[row]).unwrap_or(0))
            .collect();
        let has = |quantity| commands.find(quantity).is_some() || measured.find(quantity).is_some();
        let with_speed: Vec<bool> = (0..self.kinds.len())
            .map(|joint| !has(Quantity::Speed(joint)))
            .collect();
        let with_dir: Vec<bool> = (0..self.kinds.len())
            .map(|joint| !has(Quantity::Direction(joint)))
            .collect();
        let pairs = Pairs {
            commands: entries.iter().map(|&entry| self.path.row[entry]).collect(),
            measured: rows.clone(),
            ..Pairs::default()
        };
        let (mut joined, left) = join(measured, commands, &pairs);
        let mut q = vec![vec![0.0; rows.len()]; self.kinds.len()];
        let mut here = vec![0.0; self.kinds.len()];
        for (index, &row) in rows.iter().enumerate() {
            self.path.at(self.at[row], &mut here);
            for (column, value) in q.iter_mut().zip(&here) {
                column[index] = *value;
            }
        }
        for (joint, values) in q.into_iter().enumerate() {
            let unit = self.unit(joint);
            joined.put(Column::made(Quantity::Commanded(joint), unit, values));
            let speeds: Vec<f64> = entries
                .iter()
                .map(|&entry| self.path.speed(joint, entry))
                .collect();
            if with_dir[joint] {
                let sides = self.path.came_from(joint, self.resolution[joint]);
                let dir = entries.iter().zip(&speeds).map(|(&entry, speed)| {
                    if *speed == 0.0 {
                        sides[entry]
                    } else {
                        speed.signum()
                    }
                });
                let dir = dir.collect();
                joined.put(Column::made(Quantity::Direction(joint), Unit::Fixed, dir));
            }
            if with_speed[joint] {
                joined.put(Column::made(Quantity::Speed(joint), unit, speeds));
            }
        }
        (joined, left)
    }

    /// A mean for each stop and target.
    fn at_stops(
        &self,
        measured: Columns,
        commands: Columns,
        stops: &[Stop],
        in_stop: &[Option<usize>],
        place: &Place,
        findings: &mut Vec<Diagnostic>,
    ) -> (Columns, Vec<String>) {
        let groups = self.groups(stops, in_stop, &measured);
        let averaged: usize = groups.iter().map(|group| group.rows.len()).sum();
        let moving = in_stop.iter().filter(|stop| stop.is_none()).count();
        let found = text!(
            "{groups} samples at the stops of the commands, each the mean of {max} measurements on average; {moving} measurements in motion or outside are excluded",
            groups = groups.len(),
            max = format!("{:.1}", averaged as f64 / groups.len().max(1) as f64),
            moving
        );
        findings.push(Diagnostic::note(place.clone(), found));
        let means = Means::of(&measured, &groups);
        let has = |quantity| commands.find(quantity).is_some() || measured.find(quantity).is_some();
        let with_dir: Vec<bool> = (0..self.kinds.len())
            .map(|joint| !has(Quantity::Direction(joint)))
            .collect();
        let pairs = Pairs {
            measured: groups.iter().map(|group| group.rows[0]).collect(),
            commands: groups
                .iter()
                .map(|group| self.path.row[stops[group.stop].last])
                .collect(),
            ..Pairs::default()
        };
        let (mut joined, left) = join(measured, commands, &pairs);
        means.put_into(&mut joined);
        if self.is_recorded {
            for joint in 0..self.kinds.len() {
                let mean = |group: &Group| self.path.mean(joint, &settled(&stops[group.stop]));
                let values = groups.iter().map(mean).collect();
                let unit = self.unit(joint);
                joined.put(Column::made(Quantity::Commanded(joint), unit, values));
            }
        }
        for joint in (0..self.kinds.len()).filter(|&joint| with_dir[joint]) {
            let sides = self.path.came_from(joint, self.resolution[joint]);
            let dir = groups.iter().map(|group| sides[stops[group.stop].first]);
            let dir = dir.collect();
            joined.put(Column::made(Quantity::Direction(joint), Unit::Fixed, dir));
        }
        let counts = groups
            .iter()
            .map(|group| group.rows.len().to_string())
            .collect();
        joined.list.push(Column {
            name: "averaged".to_owned(),
            number: 0,
            role: Role::Kept,
            cells: Cells::Text(counts),
        });
        (joined, left)
    }

    /// The rows of each stop and target that are averaged.
    fn groups(&self, stops: &[Stop], in_stop: &[Option<usize>], measured: &Columns) -> Vec<Group> {
        let values = AVERAGED.map(|quantity| measured.numbers(quantity));
        let coordinates: Vec<&Vec<f64>> = values.iter().flatten().collect();
        let is_there = |row: usize| coordinates.iter().all(|values| values[row].is_finite());
        let target = |row: usize| self.targets.get(row).copied().unwrap_or(0);
        let mut order: Vec<usize> = (0..in_stop.len())
            .filter(|&row| in_stop[row].is_some() && is_there(row))
            .collect();
        order.sort_by_key(|&row| (in_stop[row], target(row), row));
        let mut groups: Vec<Group> = Vec::new();
        for chunk in order.chunk_by(|&a, &b| (in_stop[a], target(a)) == (in_stop[b], target(b))) {
            let Some(stop) = in_stop[chunk[0]] else {
                continue;
            };
            let used = settled(&stops[stop]);
            let is_used = |&&row: &&usize| used.contains(&self.at[row]);
            let mut rows: Vec<usize> = chunk.iter().filter(is_used).copied().collect();
            if rows.is_empty() {
                rows = chunk.to_vec();
            }
            groups.push(Group {
                stop,
                rows: without_strays(rows, &coordinates),
            });
        }
        groups
    }
}
