//! Tool, base and load of a program beside those of the model: which hold, and where they differ.

use crate::kinematics::{Pose, Robot, RobotSource, robot_from_dh};
use crate::model::Calibration;
use crate::text::Text as Sentence;
use std::collections::{BTreeMap, BTreeSet};

use super::pose::Orientation;
use super::program::Program;
use super::program_frames::{
    Difference, Differences, DifferingNumber, ExternalAxes, ModelTool, Precedence, Reading,
    ToolReading,
};
use super::referred::{BASE, Referred, TOOL, Way};
use super::request::{CompensateError, Request};
use super::stated_load::StatedLoads;
use super::target::Outside;
use super::text::Text;

/// Poses nearer to each other than this (mm, rad) are the same: controllers show hundredths.
const SAME_MM: f64 = 0.05;

const SAME_RAD: f64 = 0.01 * std::f64::consts::PI / 180.0;

/// Loads nearer to each other than this are the same, kg.
const SAME_KG: f64 = 0.01;

/// Where the model's tool is on the flange.
fn model_on_flange(robot: &Robot) -> Pose {
    if let RobotSource::Dh {
        base_from_first,
        rows,
    } = &robot.source
        && let Ok(flange) = robot_from_dh("", rows)
        && flange.joints.len() == robot.joints.len()
    {
        return (base_from_first * flange.base_from_tool).inverse() * robot.base_from_tool;
    }
    Pose::identity()
}

fn same(a: &Pose, b: &Pose) -> bool {
    (a.translation.vector - b.translation.vector).norm() <= SAME_MM
        && a.rotation.angle_to(&b.rotation) <= SAME_RAD
}

/// The frames or tools of a program with numbers, by name: where each is declared, and its pose.
type Numeric<'p> = BTreeMap<&'p str, (usize, Pose)>;

/// Compares a program with the model and says how it is to be read.
///
/// # Errors
/// [`CompensateError::Differs`] for what is not settled, [`CompensateError::Several`] where one tool or
/// frame is given and the program has several, [`CompensateError::Tool`] for a name that it has not.
pub(super) fn settled(
    program: &Program,
    text: &Text,
    request: &Request,
) -> Result<Reading, CompensateError> {
    let turns = request.language.orientation;
    let [poses, joints] = program.used();
    let frames = numeric(program, BASE, &poses);
    let mut tools = numeric(program, TOOL, &poses);
    // Joint values without a tool of their own say nothing about it.
    let of_joints = numeric(program, TOOL, &joints).into_iter();
    tools.extend(of_joints.filter(|(name, _)| !program.declared[TOOL][*name].is_none));
    let model = match &request.tool {
        Some(ModelTool::OnFlange(pose)) => *pose,
        _ => model_on_flange(&request.calibration.model.robot),
    };
    let declared = |lenient| ToolReading::Declared { model, lenient };
    let mut differ = Vec::new();
    let mut differs = |what, known: &Numeric, own: &Pose, model: &Sentence| {
        let others = known.iter().filter(|(_, (_, pose))| !same(pose, own));
        differ.extend(others.map(|(name, (at, pose))| Difference {
            what,
            place: text.place(*at),
            name: (*name).to_owned(),
            program: Sentence::verbatim(in_words(pose, turns)),
            model: model.clone(),
        }));
    };
    let tool = match (&request.tool, request.frames.tool) {
        (_, Precedence::Given(given)) => {
            one_only(true, &tools, &given)?;
            ToolReading::Given(given.inverse() * model)
        }
        (Some(ModelTool::Named(name)), _) => {
            check_name(name, program, &poses)?;
            ToolReading::Named(name.clone())
        }
        (_, Precedence::Program) => declared(true),
        (Some(ModelTool::OnFlange(_)), Precedence::Model) => declared(false),
        (None, Precedence::Model) => ToolReading::OnlyOne,
        (tool, Precedence::Unsettled) => {
            let pose = in_words(&model, turns);
            let own = if tool.is_some() || model != Pose::identity() {
                Sentence::verbatim(pose)
            } else {
                text!("{pose} (its tool frame is taken for the flange)", pose)
            };
            differs(DifferingNumber::Tool, &tools, &model, &own);
            declared(true)
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
            let pose = in_words(&identity, turns);
            let own = text!("the robot's base, {pose}", pose);
            differs(DifferingNumber::Frame, &frames, &identity, &own);
            None
        }
    };
    let mut notes = Vec::new();
    let load_kg = load(program, text, request, &mut differ, &mut notes);
    let moved = external(program, text, request);
    let axes = request.frames.external;
    let carrier = moved.first().filter(|_| axes == ExternalAxes::CarryRobot);
    let carried = carrier.map(|axis| {
        text!(
            "the axis {name} carries the robot, and the model does not have it",
            name = &axis.name
        )
    });
    if axes == ExternalAxes::Asked {
        differ.extend(moved);
    }
    if !differ.is_empty() {
        return Err(CompensateError::Differs(Differences(differ)));
    }
    notes.extend(taken_for_others(
        request,
        &tools,
        &model,
        (&frames, all_frames),
    ));
    Ok(Reading {
        stated,
        all_frames,
        tool,
        load_kg,
        carried,
        notes,
    })
}

/// Which of the program's tools and frames are taken for other ones.
fn taken_for_others(
    request: &Request,
    tools: &Numeric,
    model: &Pose,
    (frames, all_frames): (&Numeric, Option<Pose>),
) -> Vec<Sentence> {
    let turns = request.language.orientation;
    let mut notes = Vec::new();
    for (name, (_, pose)) in tools {
        let own = in_words(pose, turns);
        match request.frames.tool {
            Precedence::Model if !same(pose, model) => notes.push(text!(
                "the program's tool {name} ({pose}) is taken for the model's",
                name,
                pose = own
            )),
            Precedence::Given(given) if !same(pose, &given) => notes.push(text!(
                "the poses are taken of the tool {tool} and not of the program's {name} ({pose})",
                tool = in_words(&given, turns),
                name,
                pose = own
            )),
            _ => {}
        }
    }
    for (name, (_, pose)) in frames {
        if let Some(all) = all_frames.filter(|all| !same(pose, all)) {
            notes.push(text!(
                "the poses are taken in the frame {frame} and not in the program's {name} ({own})",
                frame = in_words(&all, turns),
                name,
                own = in_words(pose, turns)
            ));
        }
    }
    notes
}

/// External axes that the model does not have and that differ between targets: where they do first.
fn external(program: &Program, text: &Text, request: &Request) -> Vec<Difference> {
    let mut first: Outside = [None; 6];
    let mut found = [const { None }; 6];
    for target in program.targets.iter().filter(|t| t.left.is_none()) {
        let Some(number) = (target.outside as usize).checked_sub(1) else {
            continue;
        };
        for (k, value) in program.outside[number].into_iter().enumerate() {
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
                program: text!("{a} and {b}", a = known, b = value),
                model: Sentence::default(),
            });
        }
    }
    found.into_iter().flatten().collect()
}

/// What a file declares in numbers of the frames, or the tools, of these ways.
fn numeric<'p>(program: &'p Program, part: usize, ways: &[&'p Way]) -> Numeric<'p> {
    let found = ways.iter().filter_map(|way| match &way[part] {
        Referred::Named(name) => {
            let declared = program.declared[part].get(&**name)?;
            Some((&**name, (declared.at, *declared.pose.as_ref().ok()?)))
        }
        _ => None,
    });
    found.collect()
}

/// One tool or frame that is given stands for one of the program.
fn one_only(is_tool: bool, known: &Numeric, given: &Pose) -> Result<(), CompensateError> {
    let mut all = known.values().map(|(_, pose)| pose);
    let alike = |to: &Pose| known.values().all(|(_, pose)| same(pose, to));
    if all.next().is_none_or(alike) || alike(given) {
        return Ok(());
    }
    let names: Vec<&str> = known.keys().copied().collect();
    Err(CompensateError::Several {
        is_tool,
        names: names.join(", "),
    })
}

fn check_name(name: &str, program: &Program, poses: &[&Way]) -> Result<(), CompensateError> {
    let known = program.declared[TOOL].contains_key(&name.to_lowercase());
    if known || poses.iter().any(|way| way[TOOL].is(name)) {
        return Ok(());
    }
    let all: BTreeSet<String> = poses.iter().map(|way| way[TOOL].to_string()).collect();
    Err(CompensateError::Tool {
        found: name.to_owned(),
        expected: all.into_iter().collect::<Vec<_>>().join(", "),
    })
}

/// The load to correct for, kg.
fn load(
    program: &Program,
    text: &Text,
    request: &Request,
    differ: &mut Vec<Difference>,
    notes: &mut Vec<Sentence>,
) -> f64 {
    let own = request.calibration.load_kg;
    let inside = |kg: f64| own.is_none_or(|[a, b]| kg >= a - SAME_KG && kg <= b + SAME_KG);
    let range = || match own {
        Some([a, b]) if b - a <= SAME_KG => Sentence::verbatim(format!("{a} kg")),
        Some([a, b]) => text!("{least} to {most} kg", least = a, most = b),
        None => text!("not in the model"),
    };
    let stated = with_tools(program);
    let stated = stated.all();
    let (kg, load) = match (request.frames.load, own, stated.last()) {
        (Precedence::Given(kg), ..) => {
            if !inside(kg) {
                notes.push(text!(
                    "a load of {load} kg is beyond those of the model's session ({range})",
                    load = kg,
                    range = range()
                ));
            }
            return kg;
        }
        (Precedence::Model, Some([least, most]), _)
            if request.load_kg <= 0.0 && most - least <= SAME_KG =>
        {
            return least;
        }
        (Precedence::Model, ..) | (_, _, None) => return request.load_kg,
        (_, _, Some(last)) => *last,
    };
    let matters = depends_on_load(request.calibration, kg);
    let several = stated.len() > 1 && matters;
    let asked = request.frames.load != Precedence::Program;
    let refused =
        |kg: f64| several || asked && (!inside(kg) || own.is_none() && matters && kg > SAME_KG);
    let refused = stated.iter().filter(|(kg, _)| refused(*kg));
    differ.extend(refused.map(|(kg, load)| Difference {
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
    let name = &load.name;
    if matters {
        notes.push(text!(
            "corrected for the load that the program states, {load} kg ({name})",
            load = kg,
            name
        ));
    } else if own.is_none() {
        notes.push(text!(
            "the program states a load of {load} kg ({name}); the model knows nothing of loads",
            load = kg,
            name
        ));
    }
    kg
}

/// The loads that a program states: what is gripped and the mass of the tool.
fn with_tools(program: &Program) -> StatedLoads {
    let mut all = StatedLoads::default();
    for way in program.used().into_iter().flatten() {
        if let Some(tool) = program.declaration(TOOL, &way[TOOL])
            && let Some(own) = tool.mass_kg.filter(|kg| *kg > 0.0)
        {
            let name = way[TOOL].to_string();
            all.state(own, tool.at, &name);
            for (kg, load) in program.loads.all() {
                all.state(own + kg, load.at, &format!("{name} with {}", load.name));
            }
        }
    }
    if all.0.is_empty() {
        all = program.loads.clone();
    }
    all
}

/// Whether loads up to this one make a difference to where the model has the tool.
fn depends_on_load(calibration: &Calibration, most_kg: f64) -> bool {
    let robot = &calibration.model.robot;
    // Any pose away from home shows it.
    let q = (0..robot.joints.len()).map(|joint| vec![0.3 + 0.1 * joint as f64; 2]);
    let home = robot.base_from_tool.translation.vector.into();
    let mut inputs = crate::effects::Inputs::at_poses(q.collect(), vec![home]);
    inputs.load_kg = Some(vec![0.0, most_kg.max(1.0)].into());
    let at = calibration.model.predict(&inputs);
    let [none, loaded] = [0, 1].map(|k: usize| nalgebra::Vector3::from(at.get(k)));
    (none - loaded).norm() > 1e-6
}

/// A pose as a person types it for a language: mm, and its own angles or a quaternion.
fn in_words(pose: &Pose, orientation: Orientation) -> String {
    let at = pose.translation.vector;
    let [x, y, z] = [at.x, at.y, at.z].map(|v| short(v, 3));
    let (names, turn, unit) = orientation.numbers(pose);
    let decimals = if unit == "°" { 4 } else { 6 };
    let turn = names.iter().zip(turn);
    let turn = turn.map(|(name, v)| format!("{name} {}{unit}", short(v, decimals)));
    let turn: Vec<String> = turn.collect();
    format!("X {x}, Y {y}, Z {z} mm, {}", turn.join(", "))
}

/// A number without zeros at its end.
fn short(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value + 0.0);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_owned()
}
