//! Parameters with their values and intervals, and sizes that no machine has.

use super::geometry::{geometry, is_in_table, is_of_an_arm};
use super::{Block, Detail, clean};
use crate::fit::Estimate;
use crate::kinematics::Robot;
use crate::language::spoken;
use crate::present::names::{parameter, title_on, usual_size};
use crate::present::numbers::{short, with_interval, with_minus_signs};
use crate::present::table::Table;
use crate::present::units::Units;

/// All of them: of an arm the geometry as a table of its joints, then the others, then sizes that no machine has.
#[doc(hidden)]
pub fn values(estimates: &[Estimate], robot: &Robot, detail: Detail) -> Vec<Block> {
    let arm = is_of_an_arm(estimates);
    let mut blocks = if arm {
        geometry(estimates, detail)
    } else {
        Vec::new()
    };
    let rest = estimates.iter().filter(|one| !(arm && is_in_table(one)));
    if rest.clone().next().is_some() {
        match detail.units {
            Some(units) => blocks.extend(by_effect(rest, robot, units)),
            None => blocks.push(parameters(rest, robot)),
        }
    }
    blocks.extend(implausible(estimates.iter(), robot));
    blocks
}

/// Parameters with their intervals.
fn parameters<'a>(estimates: impl Iterator<Item = &'a Estimate>, robot: &Robot) -> Block {
    let mut table = Table::headed(say!("Effect | Parameter | >Value | Unit | >95 % interval"));
    let mut last = String::new();
    for estimate in estimates {
        let (name, parameter, unit) = named(estimate, robot);
        let (value, interval) = if estimate.is_chosen() {
            (short(estimate.value), String::new())
        } else {
            let [value, _, interval] = with_interval(estimate.value, estimate.ci95);
            (value, interval)
        };
        let shown = if name == last {
            String::new()
        } else {
            name.clone()
        };
        last = name;
        table.row([shown, parameter, value, unit.to_owned(), interval]);
    }
    Block::Table(table)
}

/// The same for a narrow panel and in its units: each effect with its parameters below it.
fn by_effect<'a>(
    estimates: impl Iterator<Item = &'a Estimate>,
    robot: &Robot,
    units: Units,
) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut last = String::new();
    for estimate in estimates {
        let (mut name, words, unit) = named(estimate, robot);
        // Where there are several targets or places, each has its own.
        let of = [&estimate.target, &estimate.place].into_iter().flatten();
        for of in of.filter(|of| !of.is_empty()) {
            name += &format!(", {}", clean(of));
        }
        if name != last {
            blocks.push(Block::Heading(name.clone()));
            last = name;
        }
        let (value, half, unit) = units.estimate(estimate, unit);
        let gap = if ["", "°"].contains(&unit) { "" } else { " " };
        let says = match half.as_str() {
            "" => format!("{value}{gap}{unit}"),
            half => format!("{value} {half}{gap}{unit}"),
        };
        blocks.push(Block::Facts(vec![(words, with_minus_signs(&says))]));
    }
    blocks
}

/// The effect that a parameter belongs to, its own name, and its unit.
fn named(estimate: &Estimate, robot: &Robot) -> (String, String, &'static str) {
    let effect = title_on(estimate.effect, estimate.joint, robot.joints.len());
    let (mut words, unit) = parameter(estimate.name);
    if let Some(setup) = &estimate.setup {
        let setup = say!("setup {setup}", setup = clean(setup));
        words += &format!(", {setup}");
    }
    (effect, words, unit)
}

/// Sizes that no machine has, where there are any.
fn implausible<'a>(estimates: impl Iterator<Item = &'a Estimate>, robot: &Robot) -> Option<Block> {
    let remark = |one: &Estimate| {
        let says = spoken(&one.implausible()?);
        let usual = usual_size(one);
        let name = title_on(one.effect, one.joint, robot.joints.len());
        let (parameter, _) = parameter(one.name);
        Some(format!("{name}, {parameter}: {says} ({usual})"))
    };
    let remarks: Vec<String> = estimates.filter_map(remark).collect();
    (!remarks.is_empty()).then_some(Block::List(remarks))
}
