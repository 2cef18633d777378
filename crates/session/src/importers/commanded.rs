//! Adds to what was measured where the robot was sent.

use nalgebra::Point3;

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::document::number::quoted;
use crate::importers::clock::ClockOffset;
use crate::importers::columns::Columns;
use crate::importers::formats::Importer;
use crate::importers::job::{Job, Matched};
use crate::importers::join::{self, Timing};
use crate::importers::matching::{self, Matching, Pairs, listed, listed_names_up_to};
use crate::importers::role::Role;
use crate::kinematics::JointKind;
use crate::sessions::Target;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::layout::{check_joint, no_column};
use crate::text::{Text, length};

/// Headings that a message lists.
const SHOWN: usize = 12;

impl Job<'_> {
    /// Columns of a table that mean nothing here are kept, and not without a word.
    fn say_what_is_kept(&mut self, columns: &Columns) {
        let is_table = |kind: &Importer| kind.id == "csv";
        if !self.settings.reading.kind.is_some_and(is_table) {
            return;
        }
        let unnamed = Role::Kept.to_string();
        let kept = columns.list.iter();
        let kept = kept.filter(|column| column.role == Role::Kept && column.name != unnamed);
        let kept: Vec<String> = kept.map(|column| quoted(&column.name)).collect();
        if !kept.is_empty() {
            let columns = listed_names_up_to(&kept, SHOWN);
            self.note(text!(
                "columns that are kept and not used: {columns}",
                columns
            ));
        }
    }

    /// What both files have.
    fn say_twice(&mut self, left: &[String]) {
        if !left.is_empty() {
            self.note(text!(
                "both files have {left}: the measured ones are taken",
                left = left.join(", ")
            ));
        }
    }

    /// Adds the commands.
    pub(crate) fn with_commands(
        &mut self,
        columns: Columns,
        recorded: Option<Box<Columns>>,
        targets: &[Target],
    ) -> Result<(Columns, Option<Matched>), Rejected> {
        self.say_what_is_kept(&columns);
        match (&self.settings.commands, recorded) {
            (None, Some(recorded)) => return self.with_recorded(columns, *recorded, targets),
            (Some(_), Some(_)) => {
                self.note(text!(
                    "commands are given: the joint values that the file has recorded are not used"
                ));
            }
            _ => {}
        }
        let joints = self.settings.robot.joint_count();
        let leading = self
            .settings
            .robot
            .leading(&(0..joints).collect::<Vec<usize>>());
        let own: Vec<usize> = (0..joints)
            .filter(|&joint| columns.find(Quantity::Commanded(joint)).is_some())
            .collect();
        let Some(companion) = &self.settings.commands else {
            if let Some(&joint) = leading.iter().find(|joint| !own.contains(joint)) {
                let found = no_column(&format!("q{}", joint + 1));
                let expected = text!(
                    "--commands with a column q{joint}_deg, or such a column in the measured file; --columns says which it is under another heading",
                    joint = joint + 1
                );
                return self.refuse(self.place.clone(), found, expected);
            }
            return Ok((columns, None));
        };
        if let Some(joint) = own.first() {
            let found = text!(
                "commands are given, and the measured file has those of joint {joint} too",
                joint = joint + 1
            );
            return self.refuse(self.place.clone(), found, text!("one of the two"));
        }
        let header: Vec<String> = (1..=joints).map(|joint| format!("q{joint}_deg")).collect();
        let commands = self.commands_in(companion, &header.join(","))?;
        let place = companion.place();
        let lacking = |joint: &&usize| commands.find(Quantity::Commanded(**joint)).is_none();
        if let Some(joint) = leading.iter().find(lacking) {
            return self.refuse(
                place,
                no_column(&format!("q{}", joint + 1)),
                text!("a header such as {header}", header = header.join(",")),
            );
        }
        if let Some(wrong) = self.joints_checked(&commands, &place) {
            return self.refused(wrong);
        }
        let by = self.matching(&columns, &commands);
        let time_heading = commands
            .find(Quantity::Time)
            .map_or_else(String::new, |column| column.name.clone());
        let mut matched = Matched {
            by,
            samples: 0,
            lonely_measurements: Vec::new(),
            lonely_commands: Vec::new(),
            clock: None,
        };
        self.sentences.push(by.in_words());
        let (columns, left) = match by {
            Matching::Order => match matching::by_order(&columns, &commands) {
                Ok(pairs) => matching::join(columns, commands, &pairs),
                Err((found, expected)) => return self.refuse(self.place.clone(), found, expected),
            },
            Matching::Name => match matching::by_name(&columns, &commands) {
                Ok(pairs) => {
                    self.say_lonely(&pairs, &place);
                    let joined = matching::join(columns, commands, &pairs);
                    matched.lonely_measurements = pairs.lonely_measured;
                    matched.lonely_commands = pairs.lonely_commands;
                    joined
                }
                Err((found, expected)) => return self.refuse(self.place.clone(), found, expected),
            },
            Matching::Time => {
                let (columns, mut left, clock) =
                    self.by_time(columns, commands, targets, &place, false)?;
                // Both have a time, of course.
                left.retain(|name| name != &time_heading);
                matched.clock = Some(clock);
                (columns, left)
            }
        };
        self.say_twice(&left);
        matched.samples = columns.rows();
        Ok((columns, Some(matched)))
    }

    /// How they are matched; warns where names say otherwise than the order that was asked for.
    fn matching(&mut self, measured: &Columns, commands: &Columns) -> Matching {
        let suggested = matching::suggested(measured, commands);
        let by = self.settings.matching.unwrap_or(suggested);
        if (by, suggested) == (Matching::Order, Matching::Name) {
            self.warn(
                text!("measurements and commands have the same names in another order"),
                Text::verbatim("--match name"),
            );
        }
        by
    }

    /// Adds where the robot was by the measured file's own recording, matched by time.
    fn with_recorded(
        &mut self,
        columns: Columns,
        recorded: Columns,
        targets: &[Target],
    ) -> Result<(Columns, Option<Matched>), Rejected> {
        let place = self.place.clone();
        if let Some(wrong) = self.joints_checked(&recorded, &place) {
            return self.refused(wrong);
        }
        let joints = self.settings.robot.joint_count();
        let own = &self.settings.robot.joints;
        let lacks = |joint: &usize| {
            own[*joint].follows.is_none() && recorded.find(Quantity::Commanded(*joint)).is_none()
        };
        if let Some(joint) = (0..joints).find(lacks) {
            let found = no_column(&format!("q{}", joint + 1));
            return self.refuse(place, found, text!("as many joints as the robot has"));
        }
        self.sentences.push(text!(
            "commands are the recorded joint values, matched by time"
        ));
        let (columns, _, clock) = self.by_time(columns, recorded, targets, &place, true)?;
        let matched = Matched {
            by: Matching::Time,
            samples: columns.rows(),
            lonely_measurements: Vec::new(),
            lonely_commands: Vec::new(),
            clock: Some(clock),
        };
        Ok((columns, Some(matched)))
    }

    pub(crate) fn say_lonely(&mut self, pairs: &Pairs, commands: &Place) {
        if !pairs.lonely_measured.is_empty() {
            let which = listed(&pairs.lonely_measured);
            let found = text!("measurements without a command: {which}", which);
            self.left_out(self.place.clone(), found);
        }
        if !pairs.lonely_commands.is_empty() {
            let which = listed(&pairs.lonely_commands);
            let found = text!("commands without a measurement: {which}", which);
            self.left_out(commands.clone(), found);
        }
    }

    pub(crate) fn by_time(
        &mut self,
        columns: Columns,
        commands: Columns,
        targets: &[Target],
        place: &Place,
        is_recorded: bool,
    ) -> Result<(Columns, Vec<String>, ClockOffset), Rejected> {
        let positions: Vec<Point3<f64>> = targets.iter().map(|target| target.position_mm).collect();
        let used = columns.texts(Role::Known(Quantity::Target, Some(Unit::Fixed)));
        let index = |name: &str| {
            targets
                .iter()
                .position(|target| target.name == name)
                .unwrap_or(0)
        };
        let used: Vec<usize> = used.unwrap_or_default().into_iter().map(index).collect();
        let timing = Timing {
            offset_s: self.settings.clock_offset_s,
            is_recorded,
        };
        let robot = self.settings.robot;
        let done = join::by_time(
            columns,
            commands,
            robot,
            (&positions, &used),
            timing,
            (&self.place, place),
        );
        let done = match done {
            Ok(done) => done,
            Err(error) => return self.refused(vec![*error]),
        };
        let clock = done.clock;
        let said = match clock.ci95_s() {
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
        };
        self.note(said.clone());
        self.sentences.push(said);
        self.sentences
            .extend(done.findings.iter().map(|finding| finding.found.clone()));
        self.findings.extend(done.findings);
        Ok((done.columns, done.left, clock))
    }

    /// Joints that do not exist, and units that do not suit them.
    pub(crate) fn joints_checked(
        &self,
        columns: &Columns,
        place: &Place,
    ) -> Option<Vec<Diagnostic>> {
        let kinds: Vec<JointKind> = self
            .settings
            .robot
            .joints
            .iter()
            .map(|joint| joint.kind)
            .collect();
        let mut findings = Vec::new();
        for column in &columns.list {
            if let Role::Known(quantity, Some(unit)) = column.role {
                let place = place.clone().in_field(column.name.clone());
                check_joint(quantity, unit, &kinds, place, &mut findings);
            }
        }
        (!findings.is_empty()).then_some(findings)
    }
}
