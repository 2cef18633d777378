//! Titles of effects in the language of the window. Where a language has none, it is shown in English.

use crate::effects::find;
use crate::text::spoken;

/// The title of an effect; what is no effect stays as it is.
pub(crate) fn title(id: &str) -> &str {
    find(id).map_or(id, |effect| spoken(effect.about().title))
}

/// The title with the joint, counted from 1, where the robot has several.
pub(crate) fn title_on(id: &str, joint: Option<usize>, joints: usize) -> String {
    match joint.filter(|_| joints > 1) {
        Some(joint) => on_joint(id, &joint.to_string()),
        None => title(id).to_owned(),
    }
}

/// The title of a name that may end with its joint, `id joint`.
pub(crate) fn title_of(name: &str) -> String {
    match name.split_once(' ') {
        Some((id, joint)) => on_joint(id, joint),
        None => title(name).to_owned(),
    }
}

/// The title of an effect on a joint, counted from 1.
pub(super) fn on_joint(id: &str, joint: &str) -> String {
    say!("{effect}, joint {joint}", effect = title(id), joint = joint)
}
