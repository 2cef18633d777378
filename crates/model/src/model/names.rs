//! The names of a model's coefficients in messages.

use super::Model;
use crate::effects::term::coefficient_names_on;
use crate::effects::words::parameter;
use crate::effects::{Effect, Setting};
use crate::kinematics::Robot;
use crate::text::Text;

/// An effect's name, with its joint where the robot has several.
pub fn name_on_joint(effect: &Effect, joint: usize, robot: &Robot) -> Text {
    let (id, title) = (effect.about().id, effect.about().title);
    if effect.about().per_joint && robot.joints.len() > 1 {
        Text::named(
            format!("{id} of joint {}", joint + 1),
            text!("{effect}, joint {joint}", effect = title, joint = joint + 1),
        )
    } else {
        Text::named(id, title)
    }
}

/// `effect: parameter` for every coefficient; an amplitude and its phase as their two parts.
pub fn coefficient_names(model: &Model) -> Vec<Text> {
    let names = model.terms().iter().flat_map(|term| {
        let about = term.effect.about();
        let place = match (about.setting, &term.label) {
            (Setting::Setup, Some(name)) => Text::named(
                format!("{} of setup {name}", about.id),
                text!("{effect}, setup {name}", effect = about.title, name),
            ),
            (Setting::Place, Some(name)) => Text::named(
                format!("{} {name}", about.id),
                text!("{effect} {name}", effect = about.title, name),
            ),
            (Setting::Target, Some(name)) => Text::named(
                format!("{} of target {name}", about.id),
                text!("{effect}, target {name}", effect = about.title, name),
            ),
            _ => name_on_joint(term.effect, term.joint, &model.robot),
        };
        coefficient_names_on(term.effect, model.robot.joints[term.joint].kind)
            .into_iter()
            .map(move |name| {
                let words = text!("{whose}: {what}", whose = &place, what = parameter(name).0);
                Text::named(format!("{place}: {name}"), words)
            })
            .collect::<Vec<_>>()
    });
    names.collect()
}

/// Coefficients that belong together.
pub fn together(names: impl IntoIterator<Item = Text>) -> Text {
    let names = names.into_iter();
    let all = names.reduce(|all, next| text!("{first} with {next}", first = all, next));
    all.unwrap_or_default()
}
