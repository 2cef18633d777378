//! Commands by the clock: which command the robot was at when a point was measured.
//!
//! Where the robot was told to stand still, its pose is certain and the instrument can average: the
//! points measured during a stop, without its first third and its last tenth (settling, and clocks
//! that are not quite together), become one sample at their mean, without those that stray. Where
//! most points were measured in motion, each stays a sample, with the joint values between the
//! commands before and after and their speed.

use std::ops::RangeInclusive;

use nalgebra::Point3;

use crate::diagnostic::{Place, Rejected};
use crate::importers::averages::{AVERAGED, Group, means, without_strays};
use crate::importers::clock::{self, ClockOffset, Timed};
use crate::importers::columns::{Column, Columns};
use crate::importers::job::Job;
use crate::importers::matching::{Pairs, join, listed_rows};
use crate::importers::path::{Path, Stop, sides};
use crate::importers::role::Role;
use crate::kinematics::Robot;
use crate::sessions::Target;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::layout::no_column;
use crate::text::{Template, length};

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

impl Job<'_> {
    /// Matches by time; also the headings of the commands that were not taken. `is_recorded`: the commands are where
    /// the robot was read to be, with the noise of its encoders.
    pub(crate) fn by_time(
        &mut self,
        measured: Columns,
        commands: Columns,
        targets: &[Target],
        place: &Place,
        is_recorded: bool,
    ) -> Result<(Columns, Vec<String>, ClockOffset), Rejected> {
        let robot = self.settings.robot;
        let Some(time_s) = measured.numbers(Quantity::Time) else {
            return self.refuse(no_column("time_s"), TIMES);
        };
        let path = self.path_of(&commands, place)?;
        let shown = shown(&measured, targets);
        let clock = self.clock(&path, targets, &timed(&measured, &time_s, &shown))?;
        let at: Vec<f64> = time_s.iter().map(|time| time + clock.offset_s).collect();
        let is_inside = |&row: &usize| path.entry(at[row]).is_some();
        let (inside, outside): (Vec<usize>, Vec<usize>) = (0..at.len()).partition(is_inside);
        if inside.is_empty() {
            return self.refuse(
                text!("no measurement falls into the time of the commands"),
                phrase!("recordings of the same time, or another --clock-offset"),
            );
        }
        self.say_clock(&clock);
        if !outside.is_empty() {
            let found = text!(
                "excluded {outside} of {usable} measurements, taken before the first or after the last command: {which}",
                outside = outside.len(),
                usable = at.len(),
                which = listed_rows(&measured, &outside)
            );
            self.left_out(self.place.clone(), found);
        }
        let stops = path.stops();
        let mut in_stop = vec![None; at.len()];
        for &row in &inside {
            in_stop[row] = stop_at(&stops, at[row]);
        }
        let standing = in_stop.iter().flatten().count();
        let joining = Joining {
            robot,
            at: &at,
            targets: &shown,
            resolution: path.resolution(&stops, is_recorded),
            path: &path,
        };
        let (columns, left) = if standing as f64 >= MOSTLY * inside.len() as f64 {
            let groups = joining.groups(&stops, &in_stop, &measured);
            let averaged: usize = groups.iter().map(|group| group.rows.len()).sum();
            self.say(text!(
                "{groups} samples at the stops of the commands, each the mean of {max} measurements on average; {moving} measurements in motion or outside are excluded",
                groups = groups.len(),
                max = format!("{:.1}", averaged as f64 / groups.len().max(1) as f64),
                moving = at.len() - standing
            ));
            joining.at_stops(measured, commands, &groups, is_recorded)
        } else {
            if standing > 0 && inside.len() > standing {
                self.say(text!(
                    "{standing} of {inside} measurements were taken at stops: all are kept, with their speeds",
                    standing,
                    inside = inside.len()
                ));
            }
            joining.in_motion(measured, commands, inside)
        };
        Ok((columns, left, clock))
    }

    /// The path of the commands, or what is wrong with them.
    fn path_of(&self, commands: &Columns, place: &Place) -> Result<Path, Rejected> {
        match Path::new(commands, self.settings.robot) {
            Ok(path) => Ok(path),
            Err(None) => self.refuse_at(place.clone(), no_column("time_s"), TIMES),
            Err(Some(row)) => self.refuse_at(
                place
                    .clone()
                    .at_line(commands.lines.get(row).unwrap_or(row as u64 + 1)),
                text!("a time that is not later than the one before"),
                phrase!("rows in the order of time"),
            ),
        }
    }

    /// How far the clocks are apart, as stated or found.
    fn clock(
        &self,
        path: &Path,
        targets: &[Target],
        points: &[Timed],
    ) -> Result<ClockOffset, Rejected> {
        let robot = self.settings.robot;
        let targets: Vec<Point3<f64>> = targets.iter().map(|target| target.position_mm).collect();
        if let Some(offset_s) = self.settings.clock_offset_s {
            return Ok(clock::offset_from(path, robot, &targets, points, offset_s));
        }
        clock::find(path, robot, &targets, points).or_else(|why| {
            let expected = phrase!("--clock-offset with the seconds to add to a measured time");
            self.refuse(why.0, expected)
        })
    }

    fn say_clock(&mut self, clock: &ClockOffset) {
        self.say(match clock.ci95_s() {
            Some([from, to]) => text!(
                "the clocks are {offset} s apart (command less measurement; 95 % confidence interval [{from}, {to}], {left} left)",
                offset = format!("{:+.6}", clock.offset_s),
                from = format!("{from:+.6}"),
                to = format!("{to:+.6}"),
                left = length(clock.rms_mm, 3)
            ),
            None => text!(
                "the clocks are {offset} s apart, as stated",
                offset = format!("{:+.4}", clock.offset_s)
            ),
        });
    }
}

/// The target that each measurement shows, as its index; none where no column says it.
fn shown(measured: &Columns, targets: &[Target]) -> Vec<usize> {
    let names = measured.texts(Role::Known(Quantity::Target, Some(Unit::Fixed)));
    let index = |name: &str| targets.iter().position(|target| target.name == name);
    let names = names.unwrap_or_default().into_iter();
    names.map(|name| index(name).unwrap_or(0)).collect()
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
    robot: &'a Robot,
    path: &'a Path,
    /// Time of each measurement on the clock of the commands, s.
    at: &'a [f64],
    targets: &'a [usize],
    /// How far each joint has to move before that is a motion, rad or mm.
    resolution: Vec<f64>,
}

impl Joining<'_> {
    fn unit(&self, joint: usize) -> Unit {
        Unit::inner(self.robot.joints[joint].kind)
    }

    /// The side from which a joint came to each entry of the path.
    fn sides(&self, joint: usize) -> Vec<f64> {
        sides(&self.path.q[joint], self.resolution[joint])
    }

    /// Every measurement of these rows with the joint values at its time.
    fn in_motion(
        &self,
        measured: Columns,
        commands: Columns,
        rows: Vec<usize>,
    ) -> (Columns, Vec<String>) {
        let entries: Vec<usize> = rows
            .iter()
            .map(|&row| self.path.entry(self.at[row]).unwrap_or(0))
            .collect();
        let at = |&row: &usize| {
            let mut q = vec![0.0; self.robot.joint_count()];
            self.path.at(self.at[row], &mut q);
            q
        };
        let q: Vec<Vec<f64>> = rows.iter().map(at).collect();
        let pairs = Pairs {
            commands: entries.iter().map(|&entry| self.path.row[entry]).collect(),
            measured: rows,
            ..Pairs::default()
        };
        let (mut joined, left) = join(measured, commands, &pairs);
        for joint in 0..self.robot.joint_count() {
            let unit = self.unit(joint);
            let values = q.iter().map(|q| q[joint]).collect();
            joined.put(Column::made(Quantity::Commanded(joint), unit, values));
            let speeds: Vec<f64> = entries
                .iter()
                .map(|&entry| self.path.speed(joint, entry))
                .collect();
            joined.put_missing(Quantity::Direction(joint), Unit::Fixed, || {
                let sides = self.sides(joint);
                let side = |(&entry, speed): (&usize, &f64)| {
                    if *speed == 0.0 {
                        sides[entry]
                    } else {
                        speed.signum()
                    }
                };
                entries.iter().zip(&speeds).map(side).collect()
            });
            joined.put_missing(Quantity::Speed(joint), unit, || speeds);
        }
        (joined, left)
    }

    /// A mean for each stop and target.
    fn at_stops(
        &self,
        measured: Columns,
        commands: Columns,
        groups: &[Group],
        is_recorded: bool,
    ) -> (Columns, Vec<String>) {
        let means = means(&measured, groups);
        let pairs = Pairs {
            measured: groups.iter().map(|group| group.rows[0]).collect(),
            commands: groups
                .iter()
                .map(|group| self.path.row[group.stop.last])
                .collect(),
            ..Pairs::default()
        };
        let (mut joined, left) = join(measured, commands, &pairs);
        for column in means.list {
            joined.put(column);
        }
        for joint in 0..self.robot.joint_count() {
            if is_recorded {
                let mean = |group: &Group| self.path.mean(joint, &settled(&group.stop));
                let values = groups.iter().map(mean).collect();
                let quantity = Quantity::Commanded(joint);
                joined.put(Column::made(quantity, self.unit(joint), values));
            }
            joined.put_missing(Quantity::Direction(joint), Unit::Fixed, || {
                let sides = self.sides(joint);
                groups.iter().map(|group| sides[group.stop.first]).collect()
            });
        }
        let counts = groups.iter().map(|group| group.rows.len().to_string());
        let counts = Column::kept("averaged", counts.collect());
        joined.list.push(counts);
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
            let stop = stops[stop];
            let used = settled(&stop);
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
