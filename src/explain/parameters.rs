//! Parameters with their values and intervals, and sizes that no machine has.

use super::geometry::{geometry, is_in_table, is_of_an_arm};
use super::{Block, Detail, clean};
use crate::fit::Estimate;
use crate::kinematics::Robot;
use crate::language::spoken;
use crate::present::names::{parameter, title_on, usual_size};
use crate::present::numbers::{short, with_interval};
use crate::present::table::{Column, Table};

/// All of them: of an arm the geometry as a table of its joints, then the others, then sizes that no machine has.
pub(crate) fn values(estimates: &[Estimate], robot: &Robot, detail: Detail) -> Vec<Block> {
    let arm = is_of_an_arm(estimates);
    let mut blocks = if arm {
        geometry(estimates, detail)
    } else {
        Vec::new()
    };
    let rest = estimates.iter().filter(|one| !(arm && is_in_table(one)));
    if rest.clone().next().is_some() {
        blocks.push(parameters(rest, robot));
    }
    blocks.extend(implausible(estimates.iter(), robot));
    blocks
}

/// Parameters with their intervals.
fn parameters<'a>(estimates: impl Iterator<Item = &'a Estimate>, robot: &Robot) -> Block {
    let mut table = Table::of([
        Column::words(say!("Effect")),
        Column::words(say!("Parameter")),
        Column::numbers(say!("Value")),
        Column::words(say!("Unit")),
        Column::numbers(say!("95 % interval")),
    ]);
    let mut last = String::new();
    for estimate in estimates {
        let name = title_on(estimate.effect, estimate.joint, robot.joints.len());
        let (mut parameter, unit) = parameter(estimate.name);
        if let Some(setup) = &estimate.setup {
            parameter += &say!(", setup {setup}", setup = clean(setup));
        }
        let (value, interval) = if estimate.is_whole_number() {
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
