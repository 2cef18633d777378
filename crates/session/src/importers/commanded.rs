//! Adds to what was measured where the robot was sent.

use crate::diagnostic::{Place, Rejected};
use crate::document::number::quoted;
use crate::importers::columns::Columns;
use crate::importers::formats::Importer;
use crate::importers::job::{Companion, Job, Matched};
use crate::importers::matching::{self, BEARABLE, Matching, Pairs, listed, listed_names};
use crate::importers::reader::SHOWN_HEADINGS;
use crate::importers::role::Role;
use crate::kinematics::JointKind;
use crate::sessions::Target;
use crate::sessions::columns::Quantity;
use crate::sessions::layout::{check_joint, no_column};
use crate::text::Text;

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
            let columns = listed_names(kept, SHOWN_HEADINGS);
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

    /// Adds the commands: those that are given, else those that the measured file has recorded.
    pub(crate) fn with_commands(
        &mut self,
        columns: Columns,
        recorded: Option<Box<Columns>>,
        targets: &[Target],
    ) -> Result<(Columns, Option<Matched>), Rejected> {
        self.say_what_is_kept(&columns);
        let given = self.settings.commands.as_ref();
        let is_recorded = given.is_none() && recorded.is_some();
        let place = given.map_or_else(|| self.place.clone(), Companion::place);
        let commands = match (given, recorded) {
            (None, None) => return self.with_own_commands(columns),
            (None, Some(recorded)) => *recorded,
            (Some(companion), recorded) => {
                if recorded.is_some() {
                    self.note(text!(
                        "commands are given: the joint values that the file has recorded are not used"
                    ));
                }
                self.given_commands(companion, &columns)?
            }
        };
        self.check_joints(&commands, &place)?;
        let by = if is_recorded {
            self.sentences.push(text!(
                "commands are the recorded joint values, matched by time"
            ));
            Matching::Time
        } else {
            let by = self.matching(&columns, &commands);
            self.sentences
                .push(text!("commands matched: {how}", how = by.id()));
            by
        };
        let time_heading = commands
            .find(Quantity::Time)
            .map_or_else(String::new, |column| column.name.clone());
        let (mut pairs, mut clock) = (Pairs::default(), None);
        let (columns, left) = if by == Matching::Time {
            let (columns, mut left, found) =
                self.by_time(columns, commands, targets, &place, is_recorded)?;
            // Both have a time, of course.
            left.retain(|name| name != &time_heading);
            clock = Some(found);
            (columns, left)
        } else {
            let found = match by {
                Matching::Name => matching::by_name(&columns, &commands),
                _ => matching::by_order(&columns, &commands),
            };
            pairs = match found {
                Ok(pairs) => pairs,
                Err((found, expected)) => return self.refuse(found, expected),
            };
            self.say_lonely(&pairs, &place);
            matching::join(columns, commands, &pairs)
        };
        self.say_twice(&left);
        let matched = Matched {
            by,
            samples: columns.rows(),
            lonely_measurements: pairs.lonely_measured,
            lonely_commands: pairs.lonely_commands,
            clock,
        };
        Ok((columns, Some(matched)))
    }

    /// The first joint of which a table lacks the commands, and which follows no other.
    fn lacking(&self, commands: &Columns) -> Option<usize> {
        let robot = self.settings.robot;
        let all: Vec<usize> = (0..robot.joint_count()).collect();
        let mut leading = robot.leading(&all).into_iter();
        leading.find(|joint| commands.find(Quantity::Commanded(*joint)).is_none())
    }

    /// The measured file has the commands itself.
    fn with_own_commands(&self, columns: Columns) -> Result<(Columns, Option<Matched>), Rejected> {
        let Some(joint) = self.lacking(&columns) else {
            return Ok((columns, None));
        };
        let found = no_column(&format!("q{}", joint + 1));
        let expected = text!(
            "--commands with a column q{joint}_deg, or such a column in the measured file; --columns says which it is under another heading",
            joint = joint + 1
        );
        self.refuse(found, expected)
    }

    /// The commands of a file beside the measured one, which has none itself.
    fn given_commands(
        &mut self,
        companion: &Companion<'_>,
        measured: &Columns,
    ) -> Result<Columns, Rejected> {
        let joints = self.settings.robot.joint_count();
        let is_own = |joint: &usize| measured.find(Quantity::Commanded(*joint)).is_some();
        if let Some(joint) = (0..joints).find(is_own) {
            let found = text!(
                "commands are given, and the measured file has those of joint {joint} too",
                joint = joint + 1
            );
            return self.refuse(found, text!("one of the two"));
        }
        let header: Vec<String> = (1..=joints).map(|joint| format!("q{joint}_deg")).collect();
        let commands = self.companion(companion, Some(&header.join(",")))?;
        if let Some(joint) = self.lacking(&commands) {
            return self.refuse_at(
                companion.place(),
                no_column(&format!("q{}", joint + 1)),
                text!("a header such as {header}", header = header.join(",")),
            );
        }
        Ok(commands)
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

    pub(crate) fn say_lonely(&mut self, pairs: &Pairs, commands: &Place) {
        if !pairs.lonely_measured.is_empty() {
            let which = listed(&pairs.lonely_measured, BEARABLE);
            let found = text!("measurements without a command: {which}", which);
            self.left_out(self.place.clone(), found);
        }
        if !pairs.lonely_commands.is_empty() {
            let which = listed(&pairs.lonely_commands, BEARABLE);
            let found = text!("commands without a measurement: {which}", which);
            self.left_out(commands.clone(), found);
        }
    }

    /// Refuses joints that do not exist, and units that do not suit them.
    pub(crate) fn check_joints(&self, columns: &Columns, place: &Place) -> Result<(), Rejected> {
        let joints = self.settings.robot.joints.iter();
        let kinds: Vec<JointKind> = joints.map(|joint| joint.kind).collect();
        let mut findings = Vec::new();
        for column in &columns.list {
            if let Role::Known(quantity, Some(unit)) = column.role {
                let place = place.clone().in_field(column.name.clone());
                check_joint(quantity, unit, &kinds, place, &mut findings);
            }
        }
        if findings.is_empty() {
            Ok(())
        } else {
            self.refused(findings)
        }
    }
}
