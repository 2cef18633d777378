//! The physical effects that make a real robot differ from the robot that its controller
//! believes in: one file each, each an [`Effect`], listed in [`CATALOGUE`].
//!
//! # To add an effect
//! Write one file like its neighbours and add it to the list at [`CATALOGUE`]. Simulation,
//! identification, diagnosis, design, the terminal and the window find it there, with everything
//! that they ask of it ([`About`]); none of them decides by an effect's name.
//!
//! # How effects fit together
//! A [`Block`] of samples flows through the [`Stage`]s: joint effects change the
//! joints' output angles in the order of the catalogue, then the reflector moves from the tool
//! outwards through the joints to the base, and at last from the base to the measuring frame.
//! The equations are those of the contract, exact; the derivatives are exact as well.
//!
//! Signs: a value says what the real robot does. A link that is 5 mm short has −5 mm.

pub(crate) mod about;
pub(crate) mod block;
pub(crate) mod curve;
pub(crate) mod inputs;
pub(crate) mod needs;
pub(crate) mod places;
pub(crate) mod survey;
pub(crate) mod term;
pub(crate) mod units;
pub(crate) mod words;

mod axis_tilt;
mod axis_wobble;
mod backlash;
mod base_offset;
mod bearing_runout;
mod encoder_eccentricity;
mod encoder_two_cycle;
mod foundation_compliance;
mod frame_drift;
mod frame_shift;
mod gear_transmission_error;
mod gravity;
mod instrument_scale;
mod joint_compliance;
mod joint_scale;
mod joint_zero_offset;
mod link_droop;
mod link_geometry;
mod link_length;
mod lost_motion;
pub(crate) mod measuring_frame;
mod screw_pitch;
mod thermal_growth;
mod thermal_zero_drift;
mod tool_lateral_offset;
mod tool_orientation;
mod tool_position;
mod tracking_lag;
mod unexplained;
mod unknown_anchor;
mod unknown_plane;
mod unknown_socket;
mod unknown_station;
pub(crate) mod unnamed;
mod wrist_coupling;

pub use about::{
    About, Condition, Form, Listed, OnSlide, Over, Owner, Prior, Quantity, Role, Setting, Stage,
};
pub use block::{Block, Lane, Turned};
pub use curve::{Curve, CurveError, Knots};
pub(crate) use gear_transmission_error::{stated, stated_orders};
pub use inputs::{Inputs, JointValues};
pub use link_geometry::LINK_GEOMETRY;
pub use measuring_frame::MEASURING_FRAME;
pub use needs::{Need, Offered};
pub use places::{Place, PlaceKind};
pub use survey::{JointSurvey, Survey};
pub use term::{Held, JointFrame, Parameter, Placed, Term, TermError};
pub use tool_orientation::TOOL_ORIENTATION;
pub use tool_position::TOOL_POSITION;
pub use unexplained::{EACH_DIRECTION, SMOOTH, UNEXPLAINED};
pub use units::Unit;
pub use unknown_anchor::UNKNOWN_ANCHOR;
pub use unknown_plane::UNKNOWN_PLANE;
pub use unknown_socket::UNKNOWN_SOCKET;
pub use unknown_station::UNKNOWN_STATION;
pub use unnamed::{Along, REST, Rest, RestError, UNNAMED, Wave};

use crate::kinematics::{JointKind, Robot};
use crate::text::Text;

/// One physical effect: the words about it, and what it does.
pub struct Effect {
    about: About,
    /// Whether there is such an effect on a joint at all, whatever is measured.
    pub exists_on: fn(usize, JointKind) -> bool,
    /// The same effect with other parameters, for sessions that know less of the machine; one whose
    /// parameters another has as well stands before it.
    pub other_forms: &'static [&'static Effect],
    /// Which of [`Effect::other_forms`] a session like this one takes for a joint, if any.
    pub takes_form: fn(&Survey, usize) -> Option<&'static Effect>,
    /// What in the controller's data would remove the effect where commands of the joints cannot;
    /// `None` where only work on the machine does.
    pub remedy: Option<fn(&Robot, &Term) -> Text>,
    /// Figures of the effect in a session that are no parameters of it.
    pub figures: fn(&Placed, &Robot, &Inputs) -> Vec<Figure>,
    /// Changes a block of samples as the effect does, and sets the columns of its coefficients.
    pub act: fn(&Placed, &mut Block),
}

/// The name of a figure with its unit, and the value where the samples show it.
pub type Figure = (&'static str, Option<f64>);

impl Effect {
    /// An effect of one form on every joint, without remedy and figures.
    pub const fn new(about: About, act: fn(&Placed, &mut Block)) -> Self {
        Self {
            about,
            exists_on: |_, _| true,
            other_forms: &[],
            takes_form: |_, _| None,
            remedy: None,
            figures: |_, _, _| Vec::new(),
            act,
        }
    }

    /// Its name, equation, parameters and the words about it.
    pub const fn about(&self) -> &About {
        &self.about
    }

    /// Why this session cannot show the effect on this joint; `None` where it can: the first of
    /// its needs that is not met.
    pub fn obstacle(&self, survey: &Survey, joint: usize) -> Option<Text> {
        if joint >= survey.joints.len() {
            return Some(survey::no_joint(joint));
        }
        let needs = self.about.needs.iter();
        needs
            .map(|need| (need.unmet)(survey, joint))
            .find_map(|reason| reason)
    }
}

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
            Some(joint) => text!("{effect}, joint {joint}", effect = title, joint = joint),
            None => title.into(),
        },
    )
}

/// Every effect, in the order in which they act.
pub const CATALOGUE: &[&Effect] = &[
    &joint_scale::JOINT_SCALE,
    &joint_zero_offset::JOINT_ZERO_OFFSET,
    &encoder_eccentricity::ENCODER_ECCENTRICITY,
    &encoder_two_cycle::ENCODER_TWO_CYCLE,
    &gear_transmission_error::GEAR_TRANSMISSION_ERROR,
    &screw_pitch::SCREW_PITCH,
    &backlash::BACKLASH,
    &lost_motion::LOST_MOTION,
    &tracking_lag::TRACKING_LAG,
    &thermal_zero_drift::THERMAL_ZERO_DRIFT,
    &joint_compliance::JOINT_COMPLIANCE,
    &wrist_coupling::WRIST_COUPLING,
    &link_length::LINK_LENGTH,
    &tool_lateral_offset::TOOL_LATERAL_OFFSET,
    &thermal_growth::THERMAL_GROWTH,
    &bearing_runout::BEARING_RUNOUT,
    &axis_wobble::AXIS_WOBBLE,
    &link_droop::LINK_DROOP,
    &foundation_compliance::FOUNDATION_COMPLIANCE,
    &axis_tilt::AXIS_TILT,
    &base_offset::BASE_OFFSET,
    &instrument_scale::INSTRUMENT_SCALE,
    &frame_shift::FRAME_SHIFT,
    &frame_drift::FRAME_DRIFT,
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

/// What models carry beside the catalogue's effects: the geometry of every calibration of a robot
/// with several joints, which is never a candidate, and what has no name.
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

/// The effect of this name; also what models carry beside the catalogue's effects.
pub fn find(id: &str) -> Option<&'static Effect> {
    let all = CATALOGUE.iter().chain(BESIDE_THE_CATALOGUE);
    all.copied().find(|effect| effect.about().id == id)
}

/// The zero offset of a joint.
pub fn joint_zero() -> &'static Effect {
    &joint_zero_offset::JOINT_ZERO_OFFSET
}

/// The length from a single axis to the tool.
pub fn tool_radius() -> &'static Effect {
    &link_length::LINK_LENGTH
}

/// The effects that every calibration of a single axis identifies.
pub const OF_A_SINGLE_AXIS: [&str; 2] = [joint_zero_offset::ABOUT.id, link_length::ABOUT.id];

/// The part of the effect of this name in every calibration; a name that is none has none.
pub fn role(id: &str) -> Role {
    find(id).map_or(Role::Candidate, |effect| effect.about().role)
}

/// Place of an effect among all: effects act in this order, that of the catalogue. The measuring
/// frame acts before what is told in the instrument's own axes (its scale, a shift, a drift), and
/// what else stands beside the catalogue acts after everything of its stage.
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
