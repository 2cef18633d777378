//! `truepose plan`: what to measure next, or first.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use nalgebra::Point3;
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::design::geometry::Geometry;
use crate::design::needs::Untestable;
use crate::design::pair_separation::Separation;
use crate::design::plan::{self, PlanError, PlanOptions, Subject};
use crate::diagnosis::NextPose;
use crate::diagnosis::{Options, Sight};
use crate::language::of_core;
use crate::pipeline::{self, measuring_list, measuring_program};
use crate::present::numbers::significant;
use crate::present::plan_v1::document;
use crate::present::table::width;
use crate::programs::language_of;

use super::failure::{self, Failure};
use super::output;
use super::words::{effect, effects, line, padded, parameter, value};

/// How much room names of effects take in a list of limits, at least.
const NAMES: usize = 28;

/// Say what to measure: poses that decide what a session leaves open and unlock what it cannot
/// show, or a first measurement of a robot
#[derive(Debug, Args)]
pub(crate) struct Plan {
    /// Session that was measured, or the robot alone (a session's `robot` object in a file, or a name that
    /// `truepose robots` lists)
    #[arg(value_name = "SESSION|ROBOT")]
    subject: PathBuf,
    /// Number of poses; with --separate and a session at most so many [default: as many as are
    /// needed; 60 for a robot with one joint]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    poses: Option<usize>,
    /// Two effects to tell apart, such as backlash,tracking-lag; ID:JOINT for another joint than 1
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    separate: Vec<String>,
    /// Noise of the instrument on every axis, mm [default: the session's; 0.03 for a robot]
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    sigma: Option<f64>,
    /// Heaviest load that the robot may carry for a test, kg [default: the session's, else 3]
    #[arg(long, value_name = "KG", allow_negative_numbers = true)]
    load: Option<f64>,
    /// The test cube of ISO 9283 instead, with its poses and paths
    #[arg(long, conflicts_with_all = ["poses", "separate", "sigma", "load", "accuracy", "instrument", "cone"])]
    iso9283: bool,
    /// As many poses as bring the expected error of the model of a robot with several joints below this
    /// at 95 % of the places within the joint ranges, mm
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    accuracy: Option<f64>,
    /// Where the instrument stands that is to measure a robot with several joints, in its base frame, mm:
    /// targets in the robot's shadow are left out [default: a session's own place, if it states one]
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    instrument: Option<Vec<f64>>,
    /// A target is seen from within this angle of where it faces, away from the tool's origin [default:
    /// from everywhere]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    cone: Option<f64>,
    /// Seed of everything random
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Write the poses to this file: a table with the column names of a session, or a program of joint
    /// moves that stops at each; - is standard output
    #[arg(long, value_name = "POSES.csv")]
    out: Option<PathBuf>,
    /// What to write [default: by the file's ending, else csv]
    #[arg(long = "as", value_name = "LANGUAGE", value_parser = PossibleValuesParser::new(["csv", "rapid", "krl", "urscript"]))]
    language: Option<String>,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
    /// Print JSON (truepose-plan/1)
    #[arg(long)]
    json: bool,
}

impl From<PlanError> for Failure {
    fn from(error: PlanError) -> Self {
        match error {
            PlanError::Diagnose(error) => error.into(),
            other => Self::refused(&other),
        }
    }
}

impl Plan {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = output::is_standard_output(self.out.as_deref());
        output::one_use_of_standard_output(self.json, to_stdout, "--json", "--out -")?;
        if self.iso9283 {
            let session = is_a_session(&self.subject);
            let out = self.out.as_deref().map(|out| (out, self.force));
            return super::test_cube::run(&self.subject, session, out, self.json);
        }
        let separate = match &self.separate[..] {
            [] => None,
            [a, b] => Some([a.clone(), b.clone()]),
            other => {
                return Err(Failure::WrongInput(text!(
                    "--separate names {effects} effects; expected two, such as backlash,tracking-lag",
                    effects = other.len()
                )));
            }
        };
        let options = PlanOptions {
            poses: self.poses,
            separate,
            sigma_mm: self.sigma,
            load_kg: self.load,
            accuracy_mm: self.accuracy,
            instrument_mm: self.instrument.as_deref().map(place).transpose()?,
            cone_rad: self.cone.map(f64::to_radians),
            diagnosis: Options {
                seed: self.seed,
                ..Options::default()
            },
        };
        let (plan, files) = if is_a_session(&self.subject) {
            let loaded = output::session(&self.subject)?;
            let plan = pipeline::plan_session(&loaded.session, &options, &|_| true)?;
            (plan, loaded.files)
        } else {
            let robot = output::robot(&self.subject)?;
            let plan = pipeline::plan_robot(&robot, &options)?;
            (plan, vec![self.subject.clone()])
        };
        if let Some(out) = &self.out {
            let list = match self.language(out) {
                "csv" => measuring_list(&plan.poses, &plan.robot),
                language => {
                    measuring_program(&plan.poses, &plan.robot, language).map_err(|error| {
                        Failure::WrongAt(out.display().to_string(), failure::in_words(&error))
                    })?
                }
            };
            output::document(out, list.as_bytes(), self.force, &files)?;
        }
        if self.json {
            output::json(&document(&plan))
        } else if to_stdout {
            Ok(())
        } else {
            output::text(&in_words(&plan))
        }
    }
}

impl Plan {
    /// The language of what is written.
    fn language<'s>(&'s self, out: &Path) -> &'s str {
        let by_name = || language_of(out, b"").map(|language| language.id);
        self.language.as_deref().or_else(by_name).unwrap_or("csv")
    }
}

fn place(numbers: &[f64]) -> Result<Point3<f64>, Failure> {
    match *numbers {
        [x, y, z] if numbers.iter().all(|v| v.is_finite()) => Ok(Point3::new(x, y, z)),
        _ => Err(Failure::WrongInput(text!(
            "--instrument has {numbers} numbers; expected X,Y,Z in mm, such as 2500,0,800",
            numbers = numbers.len()
        ))),
    }
}

/// What a session has and a robot's file has not.
#[derive(Deserialize)]
struct Keys {
    format: Option<IgnoredAny>,
    robot: Option<IgnoredAny>,
    samples: Option<IgnoredAny>,
}

/// Whether a document is a session. What cannot be read is left to the reader of sessions, which
/// says what is wrong with it.
fn is_a_session(path: &Path) -> bool {
    if output::is_a_robots_name(path) {
        return false;
    }
    let regular = std::fs::metadata(path).is_ok_and(|m| m.is_file());
    let bytes = if regular {
        std::fs::read(path).unwrap_or_default()
    } else {
        Vec::new()
    };
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    match serde_json::from_slice::<Keys>(text) {
        Ok(keys) => keys.format.is_some() || keys.robot.is_some() || keys.samples.is_some(),
        Err(_) => true,
    }
}

fn in_words(plan: &plan::Plan) -> String {
    let mut text = String::new();
    let head = match plan.subject {
        Subject::Session => say!(
            "{session}: to measure next, {poses} poses",
            session = plan.name,
            poses = plan.poses.len()
        ),
        Subject::Robot => say!(
            "{robot}: a first measurement, {poses} poses",
            robot = plan.name,
            poses = plan.poses.len()
        ),
    };
    line(&mut text, head);
    for [explanation, instead] in &plan.open {
        let open = say!(
            "open: {explanation} or {instead}",
            explanation = effects(explanation, " + "),
            instead = effects(instead, " + ")
        );
        line(&mut text, open);
    }
    if let Some(separation) = &plan.separation {
        line(&mut text, separated(separation));
    }
    if plan.poses.is_empty() && plan.separation.is_none() {
        let nothing = say!(
            "nothing is ambiguous and no pose unlocks anything; --poses N lists poses that sharpen what can be seen"
        );
        line(&mut text, nothing);
    }
    text.push_str(&table(plan));
    for target in &plan.targets {
        let at = target.position_mm;
        let new = plan
            .poses
            .iter()
            .any(|p| p.target_mm.is_some() && p.target.as_ref() == Some(&target.name));
        if new {
            let new = say!(
                "reflector {target}: at ({at}) mm in the tool frame; survey where it really is, and declare it in \
                 the session's targets",
                target = target.name,
                at = format!("{:.0}, {:.0}, {:.0}", at.x, at.y, at.z)
            );
            line(&mut text, new);
        }
    }
    for (names, locked) in grouped(&plan.enables) {
        let enabled = say!(
            "{effect} becomes testable: {needs}",
            effect = names,
            needs = needs(locked)
        );
        line(&mut text, enabled);
    }
    for (names, locked) in grouped(&plan.cannot) {
        let help = if locked.needs.is_empty() {
            say!("no pose helps").to_owned()
        } else {
            needs(locked)
        };
        let stays = say!(
            "{effect} stays untestable, {because}: {help}",
            effect = names,
            because = of_core(&locked.because),
            help = help
        );
        line(&mut text, stays);
    }
    if let Some(geometry) = &plan.geometry {
        of_geometry(geometry, plan, &mut text);
    }
    if !plan.poses.is_empty() && !plan.seen_above().is_empty() {
        limits(plan, &mut text);
    }
    text
}

/// What the poses do for two effects that are to be told apart.
fn separated(separation: &Separation) -> String {
    let [a, b] = separation.between.map(|n| effect(n.id));
    if let Some(because) = &separation.impossible {
        return say!(
            "no pose tells {a} from {b}: {because}",
            a = a,
            b = b,
            because = of_core(because)
        );
    }
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    let [before, back_before] = separation.left_before.map(percent);
    let [after, back_after] = separation.left_after.map(percent);
    let mut text = say!(
        "what {b} cannot imitate of {a}: {before} % now, {after} % with these poses; the other way round \
         {back_before} % and {back_after} %",
        b = b,
        a = a,
        before = before,
        after = after,
        back_before = back_before,
        back_after = back_after
    );
    if separation.poses.is_empty() {
        text += say!("; what is there decides already");
    } else if !separation.decided {
        text += say!("; an effect that is just seen may stay undecided, more poses would help");
    }
    text
}

fn of_geometry(geometry: &Geometry, plan: &plan::Plan, text: &mut String) {
    let so_far = match plan.subject {
        Subject::Session => say!("with the session alone").to_owned(),
        Subject::Robot => say!("with {poses} random poses", poses = plan.poses.len()),
    };
    let four = |mm: f64| format!("{mm:.4}");
    let (before, after) = (&geometry.before, &geometry.after);
    let index = say!(
        "geometry: {parameters} parameters; observability index {before} mm {so_far}, {after} mm with these poses",
        parameters = geometry.parameters,
        before = four(before.observability),
        so_far = so_far,
        after = four(after.observability)
    );
    line(text, index);
    let error = say!(
        "expected error of the model over the joint ranges: RMS {before} mm {so_far}, {after} mm with these poses; 95 \
         % of the places {p95_before} and {p95_after} mm",
        before = four(before.error.rms_mm),
        so_far = so_far,
        after = four(after.error.rms_mm),
        p95_before = four(before.error.p95_mm),
        p95_after = four(after.error.p95_mm)
    );
    line(text, error);
    if let Some((mm, poses)) = geometry.enough {
        let enough = say!(
            "{poses} poses are enough for {mm} mm at 95 % of the places",
            poses = poses,
            mm = mm
        );
        line(text, enough);
    }
    let each = geometry.curve.iter().map(|(poses, error)| {
        say!(
            "{poses} poses {mm} mm",
            poses = poses,
            mm = four(error.p95_mm)
        )
    });
    let each = each.collect::<Vec<_>>().join(", ");
    line(text, say!("95 % of the places with {poses}", poses = each));
    let surroundings = say!(
        "limits are all that is known of the surroundings: look where the way between the poses leads"
    );
    line(text, surroundings);
}

fn limits(plan: &plan::Plan, text: &mut String) {
    let head = say!(
        "with these poses and a noise of {sigma} mm an effect will be seen (95 %) above",
        sigma = format!("{:.4}", plan.sigma_mm)
    );
    line(text, head);
    let limits = plan.seen_above();
    let names: Vec<String> = limits
        .iter()
        .map(|limit| effect(&named(limit.effect, limit.joint)).into_owned())
        .collect();
    let wide = names.iter().map(|name| width(name) + 2).max();
    let wide = wide.unwrap_or(0).max(NAMES);
    for (limit, name) in limits.iter().zip(&names) {
        let sizes: Vec<String> = limit
            .sizes
            .iter()
            .map(|(name, size)| match Sight::of(*size) {
                Sight::Above(size) => value(name, &significant(size, 3)),
                Sight::AtAnySize => value(name, "0"),
                Sight::AtNoSize => say!("{parameter} of no size", parameter = parameter(name)),
            })
            .collect();
        line(
            text,
            format!("  {}{}", padded(name, wide), sizes.join(", ")),
        );
    }
    for pair in &plan.expected.alike {
        let alike = say!(
            "{one} and {other} will look alike (correlation {correlation})",
            one = effect(&named(pair.one.0, pair.one.1.map(|j| j + 1))),
            other = effect(&named(pair.other.0, pair.other.1.map(|j| j + 1))),
            correlation = format!("{:.3}", pair.correlation)
        );
        line(text, alike);
    }
}

fn named(effect: &str, joint: Option<usize>) -> String {
    joint.map_or_else(|| effect.to_owned(), |joint| format!("{effect} {joint}"))
}

/// Joints that lack the same for the same effect stand together.
fn grouped(all: &[Untestable]) -> Vec<(String, &Untestable)> {
    let mut groups: Vec<(String, &Untestable)> = Vec::new();
    for locked in all {
        let number = locked.joint.map(|j| j + 1);
        let same = |g: &&mut (String, &Untestable)| {
            g.1.effect == locked.effect && g.1.because == locked.because
        };
        match (groups.iter_mut().find(same), number) {
            (Some(group), Some(number)) => {
                let _ = write!(group.0, ", {number}");
            }
            _ => {
                let name = named(locked.effect, number);
                groups.push((effect(&name).into_owned(), locked));
            }
        }
    }
    groups
}

fn needs(locked: &Untestable) -> String {
    let says: Vec<_> = locked.needs.iter().map(|n| of_core(n.says())).collect();
    says.join("; ")
}

fn table(plan: &plan::Plan) -> String {
    let mut text = String::new();
    for (k, pose) in plan.poses.iter().enumerate() {
        let _ = writeln!(
            text,
            "{:>4}  {}  {}",
            k + 1,
            pose_in_words(pose, plan),
            of_core(&pose.why)
        );
    }
    text
}

fn pose_in_words(pose: &NextPose, plan: &plan::Plan) -> String {
    let mut words: Vec<String> = Vec::new();
    for (j, joint) in plan.robot.joints.iter().enumerate() {
        let (q, unit) = (joint.kind.outer(pose.q[j]), joint.kind.sign());
        let side = match pose.dir[j] {
            d if d > 0.0 => "↑",
            d if d < 0.0 => "↓",
            _ => " ",
        };
        words.push(format!("{:>9}{side}", format!("{q:.1}{unit}")));
    }
    if let Some(target) = &pose.target {
        words.push(format!("{target:>3}"));
    }
    if let Some(speed) = &pose.speed {
        let moving: Vec<String> = speed
            .iter()
            .zip(&plan.robot.joints)
            .map(|(s, joint)| format!("{:.0}{}/s", joint.kind.outer(*s), joint.kind.sign()))
            .collect();
        words.push(format!("{:>6}", moving.join(" ")));
    }
    if let Some(load) = pose.load_kg {
        words.push(format!("{load:>4} kg"));
    }
    if let Some(temperature) = pose.temperature_c {
        words.push(format!("{temperature:>5.1} °C"));
    }
    words.join(" ")
}
