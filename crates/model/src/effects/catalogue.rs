//! Every effect, in the order in which they act, and how one is found.

use super::about::{Owner, Role};
use super::link_geometry::LINK_GEOMETRY;
use super::measuring_frame::MEASURING_FRAME;
use super::survey::Survey;
use super::term::Effect;
use super::tool_orientation::TOOL_ORIENTATION;
use super::tool_position::TOOL_POSITION;
use super::unexplained::SMOOTH;
use super::unknown_anchor::UNKNOWN_ANCHOR;
use super::unknown_plane::UNKNOWN_PLANE;
use super::unknown_socket::UNKNOWN_SOCKET;
use super::unknown_station::UNKNOWN_STATION;
use super::unnamed::REST;
use crate::text::Text;

/// What people call an effect, or, with its joint counted from 1 behind it, that on a joint (`backlash`,
/// `backlash 2`): English has it as files and commands do.
pub fn called(name: &str) -> Text {
    let (id, joint) = match name.split_once(' ') {
        Some((id, joint)) => (id, Some(joint)),
        None => (name, None),
    };
    let Some(title) = find(id).map(|effect| effect.about().title) else {
        return Text::verbatim(name);
    };
    Text::named(
        name,
        match joint {
            Some(joint) => text!("{effect}, joint {joint}", effect = title, joint),
            None => title.into(),
        },
    )
}

/// Every effect, in the order in which they act.
pub const CATALOGUE: &[&Effect] = &[
    &super::joint_scale::JOINT_SCALE,
    &super::joint_zero_offset::JOINT_ZERO_OFFSET,
    &super::encoder_eccentricity::ENCODER_ECCENTRICITY,
    &super::encoder_two_cycle::ENCODER_TWO_CYCLE,
    &super::gear_transmission_error::GEAR_TRANSMISSION_ERROR,
    &super::screw_pitch::SCREW_PITCH,
    &super::backlash::BACKLASH,
    &super::lost_motion::LOST_MOTION,
    &super::tracking_lag::TRACKING_LAG,
    &super::thermal_zero_drift::THERMAL_ZERO_DRIFT,
    &super::joint_compliance::JOINT_COMPLIANCE,
    &super::wrist_coupling::WRIST_COUPLING,
    &super::link_length::LINK_LENGTH,
    &super::tool_lateral_offset::TOOL_LATERAL_OFFSET,
    &super::thermal_growth::THERMAL_GROWTH,
    &super::bearing_runout::BEARING_RUNOUT,
    &super::axis_wobble::AXIS_WOBBLE,
    &super::link_droop::LINK_DROOP,
    &super::foundation_compliance::FOUNDATION_COMPLIANCE,
    &super::axis_tilt::AXIS_TILT,
    &super::base_offset::BASE_OFFSET,
    &super::instrument_scale::INSTRUMENT_SCALE,
    &super::frame_shift::FRAME_SHIFT,
    &super::frame_drift::FRAME_DRIFT,
];

/// The form of an effect in which a session shows it on a joint.
pub fn form_in(effect: &'static Effect, survey: &Survey, joint: usize) -> &'static Effect {
    if joint >= survey.joints.len() {
        return effect;
    }
    (effect.takes_form)(survey, joint).unwrap_or(effect)
}

/// The form of an effect that has such parameters or so many coefficients.
pub fn form_with(
    effect: &'static Effect,
    is_it: impl Fn(&'static Effect) -> bool,
) -> &'static Effect {
    if is_it(effect) {
        return effect;
    }
    let mut others = effect.other_forms.iter().copied();
    others.find(|e| is_it(e)).unwrap_or(effect)
}

/// Effects of models that are not in the catalogue: the geometry of every calibration of a robot with several joints,
/// which is never a candidate, and what has no name.
pub const BESIDE_THE_CATALOGUE: &[&Effect] = &[
    &MEASURING_FRAME,
    &TOOL_ORIENTATION,
    &TOOL_POSITION,
    &LINK_GEOMETRY,
    &UNKNOWN_ANCHOR,
    &UNKNOWN_STATION,
    &UNKNOWN_PLANE,
    &UNKNOWN_SOCKET,
    &SMOOTH,
    &REST,
];

/// The effect of this name; also one that is not in the catalogue.
pub fn find(id: &str) -> Option<&'static Effect> {
    let all = CATALOGUE.iter().chain(BESIDE_THE_CATALOGUE);
    all.copied().find(|effect| effect.about().id == id)
}

/// The zero offset of a joint.
pub fn joint_zero() -> &'static Effect {
    &super::joint_zero_offset::JOINT_ZERO_OFFSET
}

/// The scale of a joint.
pub fn joint_scale() -> &'static Effect {
    &super::joint_scale::JOINT_SCALE
}

/// The length from a single axis to the tool.
pub fn tool_radius() -> &'static Effect {
    &super::link_length::LINK_LENGTH
}

/// What a first simulation hides, until others are chosen: an error that the identification finds, and one
/// for the diagnosis.
pub const OF_A_FIRST_SIMULATION: [&str; 2] = [
    super::joint_zero_offset::ABOUT.id,
    super::backlash::ABOUT.id,
];

/// The effects that every calibration of a single axis identifies.
pub const OF_A_SINGLE_AXIS: [&str; 2] = [
    super::joint_zero_offset::ABOUT.id,
    super::link_length::ABOUT.id,
];

/// The part of the effect of this name in every calibration; a name that is none has none.
pub fn role(id: &str) -> Role {
    find(id).map_or(Role::Candidate, |effect| effect.about().role)
}

/// The rank of an effect among all: effects act in this order, that of the catalogue. The measuring frame acts before
/// the effects in the instrument's own axes (its scale, a shift, a drift), and the others outside the catalogue act
/// after everything of their stage.
pub fn rank(effect: &Effect) -> usize {
    let id = effect.about().id;
    let place = |id: &str| CATALOGUE.iter().position(|e| e.about().id == id);
    let beside = || {
        let mut all = BESIDE_THE_CATALOGUE.iter();
        all.position(|e| e.about().id == id).unwrap_or(0)
    };
    match place(id) {
        Some(place) => 2 * place + 1,
        None if effect.about().role == Role::FreeFrame => {
            let instruments = |e: &&Effect| e.about().owner == Owner::Instrument;
            2 * CATALOGUE.iter().position(instruments).unwrap_or(0)
        }
        None => 2 * CATALOGUE.len() + beside(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn every_effect_that_has_a_file_is_in_the_catalogue() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/effects");
        let mut unlisted = Vec::new();
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            // A folder holds other forms of the effect whose name it has.
            if path.is_dir() {
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap();
            let stem = path.file_stem().unwrap().to_str().unwrap();
            let declares = |l: &str| l.starts_with("pub") && l.contains(": Effect = Effect");
            let is_effect = text.lines().any(declares);
            if is_effect && find(&stem.replace('_', "-")).is_none() {
                unlisted.push(stem.to_owned());
            }
        }
        assert!(unlisted.is_empty(), "not in CATALOGUE: {unlisted:?}");
    }

    #[test]
    fn names_are_unique_and_every_effect_says_what_it_is() {
        let mut before = 0;
        for effect in CATALOGUE {
            let about = effect.about();
            assert!(rank(effect) > before, "{}", about.id);
            before = rank(effect);
            for text in [
                about.title.english(),
                about.equation,
                about.source,
                about.cause.english(),
                about.check.english(),
            ] {
                assert!(!text.is_empty(), "{}", about.id);
            }
        }
    }
}
