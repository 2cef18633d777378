//! The headings of a whole table, checked against the robot: every quantity once, units that suit its joints, and the
//! columns that a session needs.

use super::columns::{BESIDE_POINTS, Heading, Quantity, Unit};
use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::{ONCE, quoted};
use crate::kinematics::{Joint, JointKind};
use crate::text::Text;

/// The headings of a whole table, checked against the robot's joints.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layout {
    /// One for each column of the table.
    pub(crate) headings: Vec<Heading>,
    /// Number of joints of the robot.
    pub(crate) joints: usize,
}

impl Layout {
    /// Reads the headings. `place` says where the heading with an index stands and `table` where
    /// the table does. Without joints (the robot itself is wrong) every joint is taken as it is.
    pub(crate) fn read(
        names: &[String],
        joints: Option<&[Joint]>,
        table: &Place,
        place: &dyn Fn(usize) -> Place,
        findings: &mut Vec<Diagnostic>,
    ) -> Self {
        let kinds: Option<Vec<JointKind>> =
            joints.map(|joints| joints.iter().map(|joint| joint.kind).collect());
        let headings: Vec<Heading> = names.iter().map(|name| Heading::read(name)).collect();
        let mut seen: Vec<(Quantity, usize)> = Vec::new();
        for (index, heading) in headings.iter().enumerate() {
            match heading {
                Heading::Known(quantity, unit) => {
                    if let Some((_, first)) = seen.iter().find(|(other, _)| other == quantity) {
                        findings.push(Diagnostic::error(
                            place(index),
                            text!(
                                "the same quantity as column {first}, {heading}",
                                first = first + 1,
                                heading = quoted(&names[*first])
                            ),
                            ONCE,
                        ));
                    }
                    seen.push((*quantity, index));
                    if let Some(kinds) = &kinds {
                        check_joint(*quantity, *unit, kinds, place(index), findings);
                    }
                }
                Heading::Unknown { .. } if REMARKS.contains(&names[index].as_str()) => {}
                Heading::Unknown { hint } => {
                    findings.push(unknown_column(place(index), &names[index], hint.as_deref()));
                }
            }
        }
        let has = |quantity| seen.iter().any(|(other, _)| *other == quantity);
        require_columns(joints, &has, table, findings);
        let joints = joints.map_or_else(|| highest_joint(&headings), <[_]>::len);
        Self { headings, joints }
    }
}

/// What an importer calls the names of measured points and of their groups: kept for people, who
/// find a sample again by them. Nothing reads them, and nothing is wrong with them.
pub(crate) const REMARKS: [&str; 2] = ["name", "group"];

fn unknown_column(place: Place, name: &str, hint: Option<&str>) -> Diagnostic {
    let found = text!(
        "column {name} is not known: kept and ignored",
        name = quoted(name)
    );
    match hint {
        Some(hint) => Diagnostic::warning(place, found, Text::verbatim(hint)),
        None => Diagnostic::note(place, found),
    }
}

/// The joint exists and the unit suits its kind.
pub(crate) fn check_joint(
    quantity: Quantity,
    unit: Unit,
    kinds: &[JointKind],
    place: Place,
    findings: &mut Vec<Diagnostic>,
) {
    let Some(joint) = quantity.joint() else {
        return;
    };
    let number = joint + 1;
    let expected = match (kinds.get(joint), unit) {
        (None, _) => {
            findings.push(Diagnostic::error(
                place,
                text!("joint {joint} does not exist", joint = number),
                text!(
                    "a joint of the robot, from 1 to {kinds}",
                    kinds = kinds.len()
                ),
            ));
            return;
        }
        (Some(JointKind::Revolute), Unit::Length(_)) => "_deg, _rad",
        (Some(JointKind::Prismatic), Unit::Angle(_)) => "_mm, _m, _um, _in",
        _ => return,
    };
    let found = text!("a unit that is not one of joint {joint}", joint = number);
    findings.push(Diagnostic::error(place, found, Text::verbatim(expected)));
}

fn require_columns(
    joints: Option<&[Joint]>,
    has: &dyn Fn(Quantity) -> bool,
    table: &Place,
    findings: &mut Vec<Diagnostic>,
) {
    let mut missing = |found: Text, expected: Text| {
        findings.push(Diagnostic::error(table.clone(), found, expected));
    };
    for (joint, own) in joints.unwrap_or_default().iter().enumerate() {
        // A joint that follows another one has its value from there.
        if own.follows.is_none() && !has(Quantity::Commanded(joint)) {
            missing(
                no_column(&format!("q{}_{}", joint + 1, own.kind.unit())),
                Text::default(),
            );
        }
    }
    let direction = [Quantity::Azimuth, Quantity::Elevation].map(has);
    if direction[0] != direction[1] {
        missing(
            text!("one angle of two"),
            text!("both azimuth_deg and elevation_deg or none"),
        );
    }
    // Any kind of measurement will do; a session that has none is told of points.
    // A height gauge needs no empty columns for x and y; of these two, one alone is a slip.
    let only_z = has(Quantity::Z) && !has(Quantity::X) && !has(Quantity::Y);
    let has_other = only_z || BESIDE_POINTS.into_iter().any(has);
    for (quantity, name) in [(Quantity::X, "x_mm"), (Quantity::Y, "y_mm")] {
        if !has(quantity) && !has_other {
            missing(no_column(name), Text::default());
        }
    }
    let orientation = (0..4)
        .filter(|&part| has(Quantity::Orientation(part)))
        .count();
    if orientation != 0 && orientation != 4 {
        missing(
            text!(
                "{count} of the {all} numbers of an orientation",
                count = orientation,
                all = 4
            ),
            Text::verbatim("qw, qx, qy, qz"),
        );
    }
}

/// The complaint about a column that is not there.
pub(crate) fn no_column(name: &str) -> Text {
    text!("no column {name}", name = quoted(name))
}

/// Number of joints that the headings speak of.
fn highest_joint(headings: &[Heading]) -> usize {
    let joint = |heading: &Heading| match heading {
        Heading::Known(quantity, _) => quantity.joint().map(|joint| joint + 1),
        Heading::Unknown { .. } => None,
    };
    headings.iter().filter_map(joint).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point3, Vector3};

    use super::*;
    use crate::kinematics::Axis;

    fn read(names: &[&str], kinds: &[JointKind]) -> Vec<String> {
        let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
        let axis = Axis::through(Vector3::z(), Point3::origin()).unwrap();
        let joints: Vec<Joint> = kinds
            .iter()
            .map(|kind| Joint::new("", *kind, axis))
            .collect();
        let mut findings = Vec::new();
        Layout::read(
            &names,
            Some(&joints),
            &Place::default(),
            &|_| Place::default(),
            &mut findings,
        );
        findings.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn two_units_of_one_quantity_are_refused() {
        let findings = read(&["q1_deg", "x_mm", "y_mm", "x_in"], &[JointKind::Revolute]);
        assert_eq!(findings.len(), 1);
        assert!(
            findings[0].contains("same quantity as column 2, 'x_mm'"),
            "{findings:?}"
        );
    }

    #[test]
    fn a_sliding_joint_takes_no_degrees() {
        let findings = read(&["q1_deg", "x_mm", "y_mm"], &[JointKind::Prismatic]);
        assert_eq!(findings.len(), 1);
        assert!(findings[0].contains("not one of joint 1"), "{findings:?}");
    }

    #[test]
    fn a_unit_that_is_not_understood_is_said_with_what_would_be() {
        let findings = read(
            &["q1_deg", "x_mm", "y_mm", "temperature_f"],
            &[JointKind::Revolute],
        );
        assert_eq!(findings.len(), 1);
        assert!(findings[0].contains("temperature_c"), "{findings:?}");
    }
}
