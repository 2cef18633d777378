//! Tool, base and load of a program beside those of the model: which hold, and where they differ.

use crate::kinematics::{Pose, Robot, RobotSource, robot_from_dh};
use crate::model::Calibration;
use crate::text::Text as Sentence;
use std::collections::BTreeMap;

use super::pose::Orientation;
use super::program::Program;
use super::program_frames::{
    Difference, Differences, DifferingNumber, ExternalAxes, ModelTool, Precedence, Reading,
    ToolReading,
};
use super::referred::{Declared, Referred};
use super::request::{CompensateError, Request};
use super::stated_load::{StatedLoad, StatedLoads};
use super::text::Text;
use super::used_frames::Used;

/// Poses nearer to each other than this (mm, rad) are the same: controllers show hundredths.
const SAME_MM: f64 = 0.05;

const SAME_RAD: f64 = 0.01 * std::f64::consts::PI / 180.0;

/// Loads nearer to each other than this are the same, kg.
const SAME_KG: f64 = 0.01;

/// Where the model's tool is on the flange.
fn model_on_flange(robot: &Robot) -> Pose {
    let RobotSource::Dh {
        base_from_first,
        rows,
    } = &robot.source
    else {
        return Pose::identity();
    };
    match robot_from_dh("", rows) {
        Ok(flange) if flange.joints.len() == robot.joints.len() => {
            (base_from_first * flange.base_from_tool).inverse() * robot.base_from_tool
        }
        _ => Pose::identity(),
    }
}

pub(super) fn same(a: &Pose, b: &Pose) -> bool {
    (a.translation.vector - b.translation.vector).norm() <= SAME_MM
        && a.rotation.angle_to(&b.rotation) <= SAME_RAD
}

/// A frame or a tool of a program with numbers, under its name.
type Numeric<'p> = BTreeMap<&'p str, (usize, Pose)>;

/// Compares a program with the model and says how it is to be read.
///
/// # Errors
/// [`CompensateError::Differs`] for what is not settled, [`CompensateError::Several`] where one tool or
/// frame is given and the program has several, [`CompensateError::Tool`] for a name that it has not.
#[allow(
    clippy::too_many_lines,
    reason = "tool, frame and load one after the other: what is asked of each reads best in one piece"
)]
pub(super) fn settled(
    program: &Program,
    text: &Text,
    request: &Request,
) -> Result<Reading, CompensateError> {
    let robot = &request.calibration.model.robot;
    let turns = request.language.orientation;
    let used = Used::of(program);
    let model = match &request.tool {
        Some(ModelTool::OnFlange(pose)) => *pose,
        _ => model_on_flange(robot),
    };
    let frames = numeric(used.poses.iter().map(|way| &way.frame), &program.frames);
    let mut tools = numeric(used.poses.iter().map(|way| &way.tool), &program.tools);
    // Joint values without a tool of their own say nothing about it.
    let of_joints = used.joints.iter().map(|way| &way.tool);
    let named = of_joints.filter(|tool| match tool {
        Referred::Named(name) => program.tools.get(&**name).is_some_and(|t| !t.is_none),
        _ => false,
    });
    tools.extend(numeric(named, &program.tools));
    let mut notes = Vec::new();
    let mut differ = Vec::new();
    let says = |what, name: &str, (at, pose): &(usize, Pose), model: Sentence| Difference {
        what,
        place: text.place(*at),
        name: name.to_owned(),
        program: Sentence::verbatim(in_words(pose, turns)),
        model,
    };

    let tool = match (&request.tool, request.frames.tool) {
        (_, Precedence::Given(given)) => {
            one_only(true, &tools, &given)?;
            ToolReading::Given(given.inverse() * model)
        }
        (Some(ModelTool::Named(name)), _) => {
            check_name(name, program, &used)?;
            ToolReading::Named(name.clone())
        }
        (_, Precedence::Program) => ToolReading::Declared {
            model,
            lenient: true,
        },
        (Some(ModelTool::OnFlange(_)), Precedence::Model) => ToolReading::Declared {
            model,
            lenient: false,
        },
        (None, Precedence::Model) => ToolReading::OnlyOne,
        (tool, Precedence::Unsettled) => {
            let others = tools.iter().filter(|(_, (_, pose))| !same(pose, &model));
            differ.extend(others.map(|(name, found)| {
                let words = in_words(&model, turns);
                let own = if tool.is_some() || model != Pose::identity() {
                    Sentence::verbatim(words)
                } else {
                    text!(
                        "{pose} (its tool frame is taken for the flange)",
                        pose = words
                    )
                };
                says(DifferingNumber::Tool, name, found, own)
            }));
            ToolReading::Declared {
                model,
                lenient: true,
            }
        }
    };

    let identity = Pose::identity();
    let mut stated = request.frame;
    let all_frames = match request.frames.frame {
        Precedence::Given(given) => {
            one_only(false, &frames, &given)?;
            stated = Some(given);
            Some(given)
        }
        Precedence::Model => Some(identity),
        Precedence::Program => None,
        Precedence::Unsettled => {
            let others = frames
                .iter()
                .filter(|(_, (_, pose))| !same(pose, &identity));
            differ.extend(others.map(|(name, found)| {
                let own = text!(
                    "the robot's base, {pose}",
                    pose = in_words(&identity, turns)
                );
                says(DifferingNumber::Frame, name, found, own)
            }));
            None
        }
    };
    let load_kg = load(program, text, request, &mut differ, &mut notes);
    let moved = external(program, text, request);
    let mut carried = None;
    match request.frames.external {
        ExternalAxes::Asked => differ.extend(moved),
        ExternalAxes::CarryRobot => {
            carried = moved.first().map(|axis| {
                text!(
                    "the axis {name} carries the robot, and the model does not have it",
                    name = &axis.name
                )
            });
        }
        ExternalAxes::Other => {}
    }
    if !differ.is_empty() {
        return Err(CompensateError::Differs(Differences(differ)));
    }
    notes.extend(taken_for_others(request, &tools, &model));
    if let Some(all) = &all_frames {
        let others = frames.iter().filter(|(_, (_, pose))| !same(pose, all));
        notes.extend(others.map(|(name, (_, pose))| {
            text!(
                "the poses are taken in the frame {frame} and not in the program's {name} ({own})",
                frame = in_words(all, turns),
                name,
                own = in_words(pose, turns)
            )
        }));
    }
    Ok(Reading {
        stated,
        all_frames,
        tool,
        load_kg,
        carried,
        notes,
    })
}

/// External axes that the model does not have and that differ between targets.
fn external(program: &Program, text: &Text, request: &Request) -> Vec<Difference> {
    let mut first: [Option<f64>; 6] = [None; 6];
    let mut found: [Option<Difference>; 6] = [const { None }; 6];
    for target in program
        .targets
        .iter()
        .filter(|target| target.left.is_none())
    {
        let Some(axes) = (target.outside as usize)
            .checked_sub(1)
            .map(|k| program.outside[k])
        else {
            continue;
        };
        for (k, value) in axes.into_iter().enumerate() {
            let Some(value) = value else { continue };
            let known = *first[k].get_or_insert(value);
            if known.to_bits() == value.to_bits() || found[k].is_some() {
                continue;
            }
            found[k] = Some(Difference {
                what: DifferingNumber::External,
                place: text.place(target.at),
                name: match request.language.id {
                    "rapid" => format!("eax_{}", char::from(b"abcdef"[k])),
                    _ => format!("E{}", k + 1),
                },
                program: text!("{one} and {other}", one = known, other = value),
                model: Sentence::default(),
            });
        }
    }
    found.into_iter().flatten().collect()
}

/// Which of the program's tools are taken for another one.
fn taken_for_others(request: &Request, tools: &Numeric<'_>, model: &Pose) -> Vec<Sentence> {
    let turns = request.language.orientation;
    let mut notes = Vec::new();
    for (name, (_, pose)) in tools {
        let shown = in_words(pose, turns);
        match request.frames.tool {
            Precedence::Model if !same(pose, model) => notes.push(text!(
                "the program's tool {name} ({pose}) is taken for the model's",
                name,
                pose = shown
            )),
            Precedence::Given(given) if !same(pose, &given) => notes.push(text!(
                "the poses are taken of the tool {tool} and not of the program's {name} ({pose})",
                tool = in_words(&given, turns),
                name,
                pose = shown
            )),
            _ => {}
        }
    }
    notes
}

/// What a file declares in numbers of the frames, or the tools, that are used.
fn numeric<'p>(
    used: impl Iterator<Item = &'p Referred>,
    declared: &'p BTreeMap<String, Declared>,
) -> Numeric<'p> {
    let found = used.filter_map(|referred| match referred {
        Referred::Named(name) => {
            let declared = declared.get(&**name)?;
            let pose = declared.pose.as_ref().ok()?;
            Some((&**name, (declared.at, *pose)))
        }
        _ => None,
    });
    found.collect()
}

/// One tool or frame that is given stands for one of the program.
fn one_only(is_tool: bool, known: &Numeric, given: &Pose) -> Result<(), CompensateError> {
    let mut distinct: Vec<&Pose> = Vec::new();
    for (_, pose) in known.values() {
        // A program declares a handful of them.
        if distinct.iter().all(|other| !same(pose, other)) {
            distinct.push(pose);
        }
    }
    if distinct.len() < 2 || distinct.iter().all(|pose| same(pose, given)) {
        return Ok(());
    }
    let names: Vec<&str> = known.keys().copied().collect();
    Err(CompensateError::Several {
        is_tool,
        names: names.join(", "),
    })
}

fn check_name(name: &str, program: &Program, used: &Used) -> Result<(), CompensateError> {
    let known = program.tools.contains_key(&name.to_lowercase());
    if known || used.poses.iter().any(|way| way.tool.is(name)) {
        return Ok(());
    }
    let mut all: Vec<String> = used.poses.iter().map(|way| way.tool.to_string()).collect();
    all.sort();
    all.dedup();
    Err(CompensateError::Tool {
        found: name.to_owned(),
        expected: all.join(", "),
    })
}

/// The load to correct for, kg.
pub(super) fn load(
    program: &Program,
    text: &Text,
    request: &Request,
    differ: &mut Vec<Difference>,
    notes: &mut Vec<Sentence>,
) -> f64 {
    let stated = with_tools(program);
    let own = request.calibration.load_kg;
    let modelled = match own {
        Some([least, most]) if request.load_kg <= 0.0 && most - least <= SAME_KG => least,
        _ => request.load_kg,
    };
    let inside = |kg: f64| own.is_none_or(|[a, b]| kg >= a - SAME_KG && kg <= b + SAME_KG);
    let range = || match own {
        Some([a, b]) if b - a <= SAME_KG => Sentence::verbatim(format!("{a} kg")),
        Some([a, b]) => text!("{least} to {most} kg", least = a, most = b),
        None => text!("not in the model"),
    };
    match (request.frames.load, &stated[..]) {
        (Precedence::Given(kg), _) => {
            if !inside(kg) {
                notes.push(text!(
                    "a load of {load} kg is beyond those of the model's session ({range})",
                    load = kg,
                    range = range()
                ));
            }
            return kg;
        }
        (Precedence::Model, _) => return modelled,
        (_, []) => return request.load_kg,
        _ => {}
    }
    let matters = depends_on_load(request.calibration, &stated);
    let several = stated.len() > 1 && matters;
    let refused = if several {
        stated.iter().collect::<Vec<_>>()
    } else if request.frames.load == Precedence::Program {
        Vec::new()
    } else {
        let unknown = own.is_none() && matters;
        let outside = stated
            .iter()
            .filter(|(kg, _)| !inside(*kg) || (unknown && *kg > SAME_KG));
        outside.collect()
    };
    differ.extend(refused.into_iter().map(|(kg, load)| Difference {
        what: DifferingNumber::Load,
        place: text.place(load.at),
        name: load.name.clone(),
        program: Sentence::verbatim(format!("{kg} kg")),
        model: if several {
            text!("{range} (the program states several)", range = range())
        } else {
            range()
        },
    }));
    let (kg, load) = &stated[stated.len() - 1];
    if matters {
        notes.push(text!(
            "corrected for the load that the program states, {load} kg ({name})",
            load = kg,
            name = &load.name
        ));
    } else if own.is_none() {
        notes.push(text!(
            "the program states a load of {load} kg ({name}); the model knows nothing of loads",
            load = kg,
            name = &load.name
        ));
    }
    *kg
}

/// The loads that a program states: what is gripped and the mass of the tool.
fn with_tools(program: &Program) -> Vec<(f64, StatedLoad)> {
    let used = Used::of(program);
    let tools = used.poses.iter().chain(&used.joints).map(|way| &way.tool);
    let mut all = StatedLoads::default();
    let gripped = program.loads.all();
    for tool in tools {
        if let Referred::Named(name) = tool
            && let Some(Declared { at, mass_kg, .. }) = program.tools.get(&**name)
            && let Some(own) = mass_kg.filter(|kg| *kg > 0.0)
        {
            all.state(own, *at, &name.to_string());
            for (kg, load) in &gripped {
                all.state(own + kg, load.at, &format!("{name} with {}", load.name));
            }
        }
    }
    if all.0.is_empty() {
        all = program.loads.clone();
    }
    let all = all.all().into_iter();
    all.map(|(kg, load)| (kg, load.clone())).collect()
}

/// Whether the loads make a difference to where the model has the tool.
fn depends_on_load(calibration: &Calibration, stated: &[(f64, StatedLoad)]) -> bool {
    let robot = &calibration.model.robot;
    let most = stated.iter().map(|(kg, _)| *kg).fold(1.0, f64::max);
    // Any pose away from home shows it.
    let q = (0..robot.joints.len()).map(|joint| vec![0.3 + 0.1 * joint as f64; 2]);
    let home = robot.base_from_tool.translation.vector.into();
    let mut inputs = crate::effects::Inputs::at_poses(q.collect(), vec![home]);
    inputs.load_kg = Some(vec![0.0, most].into());
    let at = calibration.model.predict(&inputs);
    let [none, loaded] = [0, 1].map(|k: usize| nalgebra::Vector3::from(at.get(k)));
    (none - loaded).norm() > 1e-6
}

/// A pose as a person types it for a language: mm, and its own angles or a quaternion.
fn in_words(pose: &Pose, orientation: Orientation) -> String {
    let at = pose.translation.vector;
    let at: Vec<String> = at.iter().map(|v| short(*v, 3)).collect();
    let (names, turn, unit) = orientation.numbers(pose);
    let turn = turn
        .iter()
        .map(|v| short(*v, if unit == "°" { 4 } else { 6 }));
    let turn: Vec<String> = names
        .iter()
        .zip(turn)
        .map(|(name, value)| format!("{name} {value}{unit}"))
        .collect();
    format!(
        "X {}, Y {}, Z {} mm, {}",
        at[0],
        at[1],
        at[2],
        turn.join(", ")
    )
}

/// A number without zeros at its end.
pub(super) fn short(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value + 0.0);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_owned()
}
