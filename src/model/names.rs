//! What the coefficients of a model are called in messages.

use super::Model;
use crate::effects::term::coefficient_names_on;
use crate::effects::{Effect, Setting};
use crate::kinematics::Robot;

/// An effect's name, with its joint where the robot has several.
pub(crate) fn name_on_joint(effect: &Effect, joint: usize, robot: &Robot) -> String {
    let id = effect.about().id;
    if effect.about().per_joint && robot.joints.len() > 1 {
        format!("{id} of joint {}", joint + 1)
    } else {
        id.to_owned()
    }
}

/// `effect.parameter` for every coefficient; an amplitude and its phase stand as their two parts.
pub(crate) fn coefficient_names(model: &Model) -> Vec<String> {
    let names = model.terms().iter().flat_map(|term| {
        let about = term.effect.about();
        let place = match (about.setting, &term.label) {
            (Setting::Setup, Some(name)) => format!("{} of setup {name}", about.id),
            (Setting::Place, Some(name)) => format!("{} {name}", about.id),
            (Setting::Target, Some(name)) => format!("{} of target {name}", about.id),
            _ => name_on_joint(term.effect, term.joint, &model.robot),
        };
        coefficient_names_on(term.effect, model.robot.joints[term.joint].kind)
            .into_iter()
            .map(move |name| format!("{place}: {name}"))
            .collect::<Vec<_>>()
    });
    names.collect()
}
