//! Robot programs that go to joint values and stop there: what a measurement needs of a controller.
//!
//! Every number is written so that the readers beside this file read it back; comments say what a stop is
//! for. Velocities are slow and the tool is the flange: both are to be set as the cell
//! needs them.

use std::fmt::Write as _;

use crate::kinematics::{JointKind, Robot};
use crate::refusal::Refusal;
use crate::units::LARGEST_NUMBER;

use super::axes::{Axes, MOST_OWN, Slot};

/// Time at a stop before and while an instrument measures, s.
const WAIT_S: f64 = 3.0;

/// One stop.
#[derive(Debug, Clone, PartialEq)]
pub struct Stop {
    /// Joint values from which it is approached, rad or mm.
    pub from: Option<Vec<f64>>,
    /// Joint values, rad or mm.
    pub q: Vec<f64>,
    /// What stands in the comment before it; one line.
    pub comment: String,
}

/// A program that goes from stop to stop. `title` stands in its first comment.
///
/// # Errors
/// A language that is not written, or that the robot's joints do not fit.
pub fn stops(
    language: &str,
    robot: &Robot,
    title: &str,
    stops: &[Stop],
) -> Result<String, Refusal> {
    let axes = Axes::new(robot);
    let joints = axes.joints();
    let is_value = |value: &f64| value.abs() <= LARGEST_NUMBER;
    let goes = |q: &[f64]| q.len() == joints && q.iter().all(is_value);
    let nowhere = |stop: &Stop| !goes(&stop.q) || stop.from.as_deref().is_some_and(|q| !goes(q));
    if let Some(index) = stops.iter().position(nowhere) {
        return Err(Refusal(text!(
            "pose {pose}: expected {joints} joint values within a robot's range, one for each joint",
            pose = index + 1,
            joints
        )));
    }
    let own = |language| match axes.own() {
        axes if axes > MOST_OWN => Err(Refusal(text!(
            "{axes} axes of the robot's own; expected at most 6 for {language}, external ones are called E1 to E6 (eax_a to eax_f) in the robot's file",
            axes,
            language
        ))),
        _ => Ok(()),
    };
    let program = match language {
        "rapid" => {
            own("RAPID")?;
            LanguageWords {
                head: "MODULE Measuring\n",
                comment: "  ! ",
                start: "  PROC measure()\n",
                go: |axes, q| {
                    format!(
                        "    MoveAbsJ {}\\NoEOffs, v100, fine, tool0;\n",
                        jointtarget(axes, q)
                    )
                },
                wait: format!("    WaitTime {WAIT_S};\n"),
                end: "  ENDPROC\nENDMODULE\n",
            }
        }
        "krl" => {
            own("KRL")?;
            LanguageWords {
                head: "&ACCESS RVP\nDEF measuring( )\n",
                comment: "; ",
                start: "BAS(#INITMOV,0)\n",
                go: |axes, q| format!("PTP {}\n", e6axis(axes, q)),
                wait: format!("WAIT SEC {WAIT_S}\n"),
                end: "END\n",
            }
        }
        "urscript" => {
            if robot.joints.iter().any(|j| j.kind == JointKind::Prismatic) {
                return Err(Refusal(text!(
                    "{found}; expected {expected}",
                    found = text!("a model with a sliding joint"),
                    expected = text!("turning joints, which URScript gives in rad")
                )));
            }
            LanguageWords {
                head: "def measuring():\n",
                comment: "  # ",
                start: "",
                go: |_, q| format!("  movej({}, a=0.5, v=0.3)\n", list(q)),
                wait: format!("  sleep({WAIT_S})\n"),
                end: "end\n",
            }
        }
        language => {
            return Err(Refusal(text!(
                "no program of joint moves is written as {language}; expected csv, rapid, krl or urscript",
                language
            )));
        }
    };
    Ok(program.written(&axes, title, stops))
}

/// The words of a language.
struct LanguageWords {
    head: &'static str,
    comment: &'static str,
    start: &'static str,
    go: fn(&Axes, &[f64]) -> String,
    wait: String,
    end: &'static str,
}

impl LanguageWords {
    fn written(&self, axes: &Axes, title: &str, stops: &[Stop]) -> String {
        let mut text = self.head.to_owned();
        // Comments end with their line, and what is not ASCII is not every controller's.
        let comment = |text: &mut String, says: &str| {
            let plain: String = says
                .chars()
                .map(|c| if c.is_ascii_graphic() { c } else { ' ' })
                .collect();
            let _ = writeln!(text, "{}{}", self.comment, plain.trim_end());
        };
        comment(&mut text, title);
        text.push_str(self.start);
        for (k, stop) in stops.iter().enumerate() {
            comment(&mut text, &format!("pose {}: {}", k + 1, stop.comment));
            if let Some(from) = &stop.from {
                text.push_str(&(self.go)(axes, from));
            }
            text.push_str(&(self.go)(axes, &stop.q));
            text.push_str(&self.wait);
        }
        text.push_str(self.end);
        text
    }
}

/// A joint's value in degrees or mm.
fn displayed(axes: &Axes, joint: usize, q: &[f64]) -> String {
    // Not minus zero.
    format!("{:.5}", axes.kind(joint).to_display(q[joint]) + 0.0)
}

fn jointtarget(axes: &Axes, q: &[f64]) -> String {
    let at = |slot: Slot| axes.joint(slot).map(|joint| displayed(axes, joint, q));
    let own = (0..6).map(|k| at(Slot::Own(k)).unwrap_or_else(|| "0".to_owned()));
    let external = (0..6).map(|k| at(Slot::External(k)).unwrap_or_else(|| "9E9".to_owned()));
    let joined = |all: Vec<String>| all.join(",");
    format!(
        "[[{}],[{}]]",
        joined(own.collect()),
        joined(external.collect())
    )
}

fn e6axis(axes: &Axes, q: &[f64]) -> String {
    let named = (0..axes.joints()).map(|joint| {
        let name = match axes.slot(joint) {
            Slot::Own(k) => format!("A{}", k + 1),
            Slot::External(k) => format!("E{}", k + 1),
        };
        format!("{name} {}", displayed(axes, joint, q))
    });
    format!("{{E6AXIS: {}}}", named.collect::<Vec<_>>().join(","))
}

fn list(q: &[f64]) -> String {
    let each = q.iter().map(|v| format!("{:.7}", v + 0.0));
    format!("[{}]", each.collect::<Vec<_>>().join(", "))
}
