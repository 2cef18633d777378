//! Steps of equal size, at which one order of a gear is the same samples as another.

use std::f64::consts::TAU;

use crate::answers::diagnosis::DataProblem;
use crate::text::Text;

use crate::diagnosis::candidates::{setting, shown};
use crate::diagnosis::evidence::rival::Rival;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::Term;
use crate::steps::{EQUAL, step_of};

/// The message about equal steps, where settings cannot be distinguished by them.
pub(crate) fn equal_steps(prepared: &PreparedSearch, rivals: &[Rival]) -> Option<DataProblem> {
    let term = rivals.first()?.removed.first()?;
    let joint = term.joint;
    let steps = step_in_words(prepared, joint);
    let settings = rivals.iter().flat_map(Rival::other_settings).map(shown);
    let settings: Vec<String> = settings.collect();
    Some(DataProblem::of_all(
        text!("equal steps"),
        match steps {
            Some(step) => text!(
                "the values of joint {joint} are equal steps of {step}: {setting} looks the same as {others}, and the cross-validated error holds for these values alone",
                joint = joint + 1,
                step,
                setting = setting(term),
                others = settings.join(", ")
            ),
            None => text!(
                "the values of joint {joint} are steps that do not part them: {setting} looks the same as {others}, and the cross-validated error holds for these values alone",
                joint = joint + 1,
                setting = setting(term),
                others = settings.join(", ")
            ),
        },
        text!("measure the proposed poses, which are uneven steps"),
        None,
    ))
}

/// The message about waves that were withdrawn, as equal steps cannot distinguish them from slower ones.
pub(crate) fn of_withdrawn(prepared: &PreparedSearch, withdrawn: &[Term]) -> Option<DataProblem> {
    let joint = withdrawn.first()?.joint;
    let step = step_in_words(prepared, joint)?;
    Some(DataProblem::of_all(
        text!("equal steps"),
        text!(
            "the values of joint {joint} are equal steps of {step}: a slower wave and {settings} are the same samples; the table follows the slower one, and between the steps nothing shows which is right",
            joint = joint + 1,
            step,
            settings = Text::listed(withdrawn.iter().map(setting), ", ")
        ),
        text!("measure at uneven steps"),
        None,
    ))
}

/// The step by which the values of a joint differ, where they are equal steps.
fn step_in_words(prepared: &PreparedSearch, joint: usize) -> Option<String> {
    let kind = prepared.problem.session.robot.joints[joint].kind;
    let step = step_of(&prepared.regression.rows.inputs.q[joint])?;
    Some(format!("{:.3}{}", kind.to_display(step), kind.sign()))
}

/// Orders of a gear that are listed: those around two turns of the steps.
const LISTED: usize = 4;

/// Orders of a gear that are aliases of a wave of this term at the equal steps of its joint, and the step in rad. No
/// likelihood distinguishes them, and none is a rival: a ring off its centre is common, a gear of just this order is
/// not.
pub(crate) fn orders_that_look_alike(
    prepared: &PreparedSearch,
    term: &Term,
) -> Option<(f64, Vec<u32>)> {
    let about = term.effect.about();
    let own = about.cycles_per_turn?;
    let values = &prepared.regression.rows.inputs.q[term.joint];
    let step = step_of(values)?;
    let steps = TAU / step;
    let whole = steps.round();
    if (steps - whole).abs() > EQUAL || whole <= 2.0 * f64::from(own) || whole > f64::from(u16::MAX)
    {
        return None;
    }
    let whole = whole as u32;
    let alike = (1..).flat_map(|k| [k * whole - own, k * whole + own]);
    Some((step, alike.take(LISTED).collect()))
}
