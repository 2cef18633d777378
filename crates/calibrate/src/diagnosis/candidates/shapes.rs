//! The shapes that are tried: bumps, plateaus and waves over each angle, bumps and steps over time,
//! slopes over every condition.

use crate::effects::Survey;
use crate::fewest;

use super::shape_space::ShapeSpace;
use crate::fit::regression::Rows;
use crate::model::shapes::{Direction, Profile, Shape, Variable};

const HIGHEST_ORDER: u32 = 360;

/// Names that are not candidates and whose shapes nothing else would look for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Missing {
    pub(crate) gear: bool,
    pub(crate) shift: bool,
}

pub(crate) fn shapes(
    space: &ShapeSpace,
    survey: &Survey,
    rows: &Rows,
    missing: Missing,
) -> Vec<Shape> {
    let mut all = Vec::new();
    if rows.samples.len() < 2 * fewest::OF_A_PART {
        return all;
    }
    for joint in 0..survey.joints.len() {
        if survey.joints[joint].values >= fewest::TO_JUDGE {
            over_angle(space, joint, missing.gear, &mut all);
        }
    }
    if space.values(Variable::Time).is_some() {
        over_time(space, missing.shift, &mut all);
    }
    over_conditions(space, survey, &mut all);
    all
}

fn over_angle(space: &ShapeSpace, joint: usize, waves: bool, all: &mut Vec<Shape>) {
    let variable = Variable::Joint(joint);
    let (low, high) = space.range(variable);
    let span = high - low;
    let tangential = Direction::Tangential(joint);
    for width in [0.022, 0.045, 0.09] {
        bumps(space, variable, tangential, width * span, 1.0, all);
    }
    plateaus(space, variable, tangential, 20, true, all);
    kinks(space, variable, tangential, 16, all);
    let values = space.values(variable).map_or(0, <[f64]>::len) as f64;
    let turn = std::f64::consts::TAU;
    // Half a cycle over the range is the resolution of the data.
    let step = 0.5 * turn / span;
    let highest = (values / 8.0 * turn / span).min(40.0);
    let fundamentals: Vec<f64> = (2..)
        .map(|k| step * f64::from(k))
        .take_while(|c| *c < highest)
        .take(90)
        .collect();
    for cycles in &fundamentals {
        for harmonics in [1, 3] {
            // A single wave of a gear's order has a name.
            let named = harmonics == 1 && *cycles >= 2.5 && !waves;
            if named {
                continue;
            }
            all.push(Shape {
                variable,
                direction: tangential,
                profile: Profile::Periodic {
                    cycles: *cycles,
                    harmonics,
                },
                tried: fundamentals.len() as f64,
            });
        }
    }
    if waves {
        let from = highest.ceil().max(1.0) as u32;
        all.extend((from..=HIGHEST_ORDER).map(|order| Shape {
            variable,
            direction: tangential,
            profile: Profile::Periodic {
                cycles: f64::from(order),
                harmonics: 1,
            },
            tried: f64::from(HIGHEST_ORDER),
        }));
    }
    let mut smooth = vec![(tangential, Profile::Ramp), (tangential, Profile::Square)];
    let periodic = |direction, cycles: u32| {
        let profile = Profile::Periodic {
            cycles: f64::from(cycles),
            harmonics: 1,
        };
        (direction, profile)
    };
    smooth.extend((1..=6).map(|k| periodic(tangential, k)));
    let own = |direction: &Direction| !matches!(direction, Direction::Guide(of, _) if *of != joint);
    let across = space.across.iter().map(|(direction, _)| *direction);
    for direction in across.filter(own) {
        if matches!(direction, Direction::Guide(..)) {
            // Nothing turns: a guide is bent.
            smooth.push((direction, Profile::Square));
            // Of several joints, which show turns too, in more than one bend: two cycles of the travel, as of a turn.
            if !space.is_of_one_joint() {
                let half_waves = |k: u32| Profile::Periodic {
                    cycles: step * f64::from(k),
                    harmonics: 1,
                };
                smooth.extend((1..=4).map(|k| (direction, half_waves(k))));
            }
        } else {
            smooth.extend((1..=6).map(|k| periodic(direction, k)));
        }
        smooth.push((direction, Profile::Ramp));
        bumps(space, variable, direction, 0.06 * span, 1.0, all);
        plateaus(space, variable, direction, 8, false, all);
    }
    let tried = smooth.len() as f64;
    all.extend(smooth.into_iter().map(|(direction, profile)| Shape {
        variable,
        direction,
        profile,
        tried,
    }));
}

fn over_time(space: &ShapeSpace, shifts: bool, all: &mut Vec<Shape>) {
    let (low, high) = space.range(Variable::Time);
    let span = high - low;
    if span <= 0.0 {
        return;
    }
    for width in [0.04, 0.1] {
        bumps(
            space,
            Variable::Time,
            Direction::Frame,
            width * span,
            1.0,
            all,
        );
    }
    if shifts {
        plateaus(space, Variable::Time, Direction::Frame, 24, false, all);
    }
    for joint in 0..space.tangential.len() {
        let direction = Direction::Tangential(joint);
        bumps(space, Variable::Time, direction, 0.06 * span, 1.0, all);
        plateaus(space, Variable::Time, direction, 16, false, all);
    }
}

fn over_conditions(space: &ShapeSpace, survey: &Survey, all: &mut Vec<Shape>) {
    let mut own = Vec::new();
    let mut push = |variable, direction, profile| {
        own.push(Shape {
            variable,
            direction,
            profile,
            tried: 1.0,
        });
    };
    push(Variable::Joint(0), Direction::Frame, Profile::Constant);
    // What follows a condition across a guide is along the measuring frame as well.
    let across = space.across.iter().map(|(direction, _)| *direction);
    let across: Vec<Direction> = across
        .filter(|direction| matches!(direction, Direction::Radial | Direction::Axial))
        .collect();
    if across.contains(&Direction::Axial) {
        push(Variable::Joint(0), Direction::Body, Profile::Constant);
    }
    for (variable, values) in &space.variables {
        let (low, high) = space.range(*variable);
        if low >= high || matches!(variable, Variable::Joint(_)) {
            continue;
        }
        if matches!(variable, Variable::Target(_)) {
            push(*variable, Direction::Body, Profile::Ramp);
            continue;
        }
        let joints: Vec<usize> = match variable {
            Variable::Side(j) | Variable::Speed(j) => vec![*j],
            _ => (0..survey.joints.len()).collect(),
        };
        let mut distinct: Vec<f64> = values.clone();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup();
        for joint in joints {
            push(*variable, Direction::Tangential(joint), Profile::Ramp);
            push(*variable, Direction::Tangential(joint), Profile::TimesTurn);
            if distinct.len() > 2 {
                push(*variable, Direction::Tangential(joint), Profile::Square);
                push(*variable, Direction::Tangential(joint), Profile::Absolute);
            }
        }
        for direction in &across {
            push(*variable, *direction, Profile::Ramp);
        }
        push(*variable, Direction::Frame, Profile::Ramp);
        // What a recorded condition does to the measuring frame and the body need not be straight, and along
        // one axis it is one number.
        if matches!(variable, Variable::Load | Variable::Warmth) {
            let bent = distinct.len() > 2;
            for direction in across.iter().filter(|_| bent) {
                push(*variable, *direction, Profile::Square);
            }
            for axis in 0..space.frame_axes() {
                push(*variable, Direction::Along(axis), Profile::Ramp);
                if bent {
                    push(*variable, Direction::Along(axis), Profile::Square);
                }
            }
        }
    }
    let tried = own.len() as f64;
    all.extend(own.into_iter().map(|shape| Shape { tried, ..shape }));
}

fn bumps(
    space: &ShapeSpace,
    variable: Variable,
    direction: Direction,
    width: f64,
    spacing: f64,
    all: &mut Vec<Shape>,
) {
    let Some(values) = space.values(variable) else {
        return;
    };
    let (low, high) = space.range(variable);
    let count = ((high - low) / (spacing * width)).round().max(1.0) as usize;
    let centre = |k: usize| low + (high - low) * (k as f64 + 0.5) / count as f64;
    let enough = |centre: f64| {
        let near = values
            .iter()
            .filter(|v| (**v - centre).abs() <= 1.5 * width);
        near.count() >= fewest::OF_A_PART
    };
    all.extend(
        (0..count)
            .map(centre)
            .filter(|c| enough(*c))
            .map(|centre| Shape {
                variable,
                direction,
                profile: Profile::Bump { centre, width },
                tried: 2.0 * count as f64,
            }),
    );
}

/// Slopes from up to `count` edges on, upwards and downwards.
fn kinks(
    space: &ShapeSpace,
    variable: Variable,
    direction: Direction,
    count: usize,
    all: &mut Vec<Shape>,
) {
    let Some(values) = space.values(variable) else {
        return;
    };
    let edges = edges(values, count);
    let tried = 2.0 * edges.len() as f64;
    all.extend(edges.iter().flat_map(|at| {
        [false, true].map(|below| Shape {
            variable,
            direction,
            profile: Profile::Kink { at: *at, below },
            tried,
        })
    }));
}

/// Steps at up to `count` edges between values, and plateaus between pairs of them.
fn plateaus(
    space: &ShapeSpace,
    variable: Variable,
    direction: Direction,
    count: usize,
    pairs: bool,
    all: &mut Vec<Shape>,
) {
    let Some(values) = space.values(variable) else {
        return;
    };
    let edges = edges(values, count);
    let mut profiles: Vec<Profile> = edges
        .iter()
        .map(|from| Profile::Plateau {
            from: *from,
            to: f64::INFINITY,
        })
        .collect();
    if pairs {
        for (i, from) in edges.iter().enumerate() {
            profiles.extend(edges[i + 1..].iter().map(|to| Profile::Plateau {
                from: *from,
                to: *to,
            }));
        }
    }
    let tried = profiles.len() as f64;
    all.extend(profiles.into_iter().map(|profile| Shape {
        variable,
        direction,
        profile,
        tried,
    }));
}

/// Up to `count` values midway between neighbours, with at least [`fewest::OF_A_PART`] samples between them.
pub(crate) fn edges(values: &[f64], count: usize) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    let stride = (n / (count + 1)).max(fewest::OF_A_PART);
    let mut edges: Vec<f64> = (stride..=n.saturating_sub(fewest::OF_A_PART))
        .step_by(stride)
        .filter_map(|i| {
            // The next place where the value changes.
            let next = sorted[i..].iter().find(|v| **v > sorted[i - 1])?;
            Some(0.5 * (sorted[i - 1] + next))
        })
        .collect();
    edges.dedup();
    edges
}
