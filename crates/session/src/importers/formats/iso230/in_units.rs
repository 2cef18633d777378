//! The units of such a table.

use super::parts::TableColumn;
use crate::importers::headings::words_and_unit;
use crate::importers::settings::{About, ReadContext};
use crate::importers::units::{self, AngleUnit, LengthUnit, Word};
use crate::kinematics::JointKind;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::layout::check_joint;
use crate::tables::Grid;

/// Units of targets and of what was measured.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    pub(super) target: Unit,
    pub(super) measured: Unit,
}

pub(super) fn units_of(
    context: &mut ReadContext<'_>,
    grid: &Grid<'_>,
    headings: &[String],
    parts: &[TableColumn],
) -> Option<Units> {
    let suits: fn(Unit) -> bool = if context.reading.slides {
        |unit| matches!(unit, Unit::Length(_))
    } else {
        |unit| matches!(unit, Unit::Angle(_))
    };
    let in_heading = |index: usize| match words_and_unit(&headings.get(index)?.to_lowercase()).1? {
        Word::Unit(unit) => Some(unit),
        _ => None,
    };
    let mut target = None;
    let mut measured = None;
    let mut strange = None;
    for (index, part) in parts.iter().enumerate() {
        let unit = in_heading(index);
        if let Some(unit) = unit.filter(|unit| !suits(*unit))
            && !matches!(
                part,
                TableColumn::Other | TableColumn::Direction | TableColumn::Run
            )
        {
            strange = Some((index, unit));
        }
        match part {
            TableColumn::Target => target = unit,
            TableColumn::Position | TableColumn::Deviation | TableColumn::Of { .. } => {
                measured = measured.or(unit);
            }
            TableColumn::Direction | TableColumn::Run | TableColumn::Other => {}
        }
    }
    if let Some((index, unit)) = strange {
        let joint = context.reading.joint;
        let kind = if context.reading.slides {
            JointKind::Prismatic
        } else {
            JointKind::Revolute
        };
        let place = context.place.clone().in_field(headings[index].as_str());
        let kinds = vec![kind; joint + 1];
        let commanded = Quantity::Commanded(joint);
        check_joint(commanded, unit, &kinds, place, &mut context.found.findings);
        return None;
    }
    let mut before = grid.preamble.iter();
    let in_preamble = before.find_map(|line| units::named_in_preamble(line, suits));
    let given = if context.reading.slides {
        context.reading.unit.map(LengthUnit::unit)
    } else {
        context.reading.angle_unit.map(AngleUnit::unit)
    };
    // What holds for the targets holds for the positions, but for deviations nothing follows.
    let default = given.or(in_preamble.map(|(_, unit)| unit));
    let target_unit = target.or(default);
    let is_deviation = parts.contains(&TableColumn::Deviation);
    let inherited = if is_deviation { None } else { target };
    let measured_unit = measured.or(default).or(inherited);
    let (Some(target), Some(measured)) = (target_unit, measured_unit) else {
        let (about, answers): (_, &[&str]) = if context.reading.slides {
            (About::Unit, &["mm", "m", "in"])
        } else {
            (About::AngleUnit, &["deg", "rad"])
        };
        let says = text!("the unit of the targets or of the positions is not stated");
        context.ask(about, says, answers);
        return None;
    };
    context.found.unit = match default {
        Some(_) => text!("as stated"),
        None => text!("from the headings"),
    };
    Some(Units { target, measured })
}
