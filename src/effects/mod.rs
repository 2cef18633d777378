//! The physical effects that make a real robot differ from the robot that its controller
//! believes in: one file each, behind the trait [`Effect`], listed in [`CATALOGUE`].
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
mod wrist_coupling;

pub use about::{
    About, Condition, Form, Listed, OnSlide, Over, Owner, Prior, Quantity, Role, Setting, Stage,
};
pub use block::{Block, Lane, Turned};
pub use curve::{Curve, CurveError, Knots};
pub use inputs::{Inputs, JointValues};
pub use link_geometry::LinkGeometry;
pub use measuring_frame::MeasuringFrame;
pub use needs::{Need, Offered};
pub use places::{Place, PlaceKind};
pub use survey::{JointSurvey, Survey};
pub use term::{Held, JointFrame, Parameter, Placed, Term, TermError};
pub use tool_orientation::ToolOrientation;
pub use tool_position::ToolPosition;
pub use unexplained::{Directions, UNEXPLAINED, Unexplained};
pub use units::Unit;
pub use unknown_anchor::UnknownAnchor;
pub use unknown_plane::UnknownPlane;
pub use unknown_socket::UnknownSocket;
pub use unknown_station::UnknownStation;

use crate::kinematics::{JointKind, Robot};

/// One physical effect.
pub trait Effect: Sync {
    /// Its name, equation, parameters and the words about it.
    fn about(&self) -> &'static About;

    /// Whether there is such an effect on a joint at all, whatever is measured.
    fn exists_on(&self, joint: usize, kind: JointKind) -> bool {
        let _ = (joint, kind);
        true
    }

    /// The same effect with other parameters, for sessions that know less of the machine; one whose
    /// parameters another has as well stands before it.
    fn other_forms(&self) -> &'static [&'static dyn Effect] {
        &[]
    }

    /// Which of [`Effect::other_forms`] a session like this one takes for a joint, if any.
    fn takes_form(&self, survey: &Survey, joint: usize) -> Option<&'static dyn Effect> {
        let _ = (survey, joint);
        None
    }

    /// Why this session cannot show the effect on this joint; `None` where it can: the first of
    /// its needs that is not met.
    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        let needs = self.about().needs.iter();
        needs
            .map(|need| (need.unmet)(survey, joint))
            .find_map(|reason| reason)
    }

    /// What in the controller's data would remove the effect where commands of the joints cannot;
    /// `None` where only work on the machine does.
    fn remedy(&self, robot: &Robot, term: &Term) -> Option<String> {
        let _ = (robot, term);
        None
    }

    /// Figures of the effect in a session that are no parameters of it: name with its unit, and the
    /// value where the samples show it.
    fn figures(
        &self,
        me: &Placed,
        robot: &Robot,
        inputs: &Inputs,
    ) -> Vec<(&'static str, Option<f64>)> {
        let _ = (me, robot, inputs);
        Vec::new()
    }

    /// Changes a block of samples as the effect does, and sets the columns of its coefficients.
    fn act(&self, me: &Placed, block: &mut block::Block);
}

/// Every effect, in the order in which they act.
pub const CATALOGUE: &[&dyn Effect] = &[
    &joint_scale::JointScale,
    &joint_zero_offset::JointZeroOffset,
    &encoder_eccentricity::EncoderEccentricity,
    &encoder_two_cycle::EncoderTwoCycle,
    &gear_transmission_error::GearTransmissionError,
    &screw_pitch::ScrewPitch,
    &backlash::Backlash,
    &lost_motion::LostMotion,
    &tracking_lag::TrackingLag,
    &thermal_zero_drift::ThermalZeroDrift,
    &joint_compliance::JointCompliance,
    &wrist_coupling::WristCoupling,
    &link_length::LinkLength,
    &tool_lateral_offset::ToolLateralOffset,
    &thermal_growth::ThermalGrowth,
    &bearing_runout::BearingRunout,
    &axis_wobble::AxisWobble,
    &link_droop::LinkDroop,
    &foundation_compliance::FoundationCompliance,
    &axis_tilt::AxisTilt,
    &base_offset::BaseOffset,
    &instrument_scale::InstrumentScale,
    &frame_shift::FrameShift,
    &frame_drift::FrameDrift,
];

/// The form of an effect in which a session shows it on a joint.
pub fn form_in(effect: &'static dyn Effect, survey: &Survey, joint: usize) -> &'static dyn Effect {
    effect.takes_form(survey, joint).unwrap_or(effect)
}

/// The form of an effect that has such parameters or so many coefficients.
pub fn form_with(
    effect: &'static dyn Effect,
    is_it: impl Fn(&'static dyn Effect) -> bool,
) -> &'static dyn Effect {
    if is_it(effect) {
        return effect;
    }
    let mut others = effect.other_forms().iter().copied();
    others.find(|e| is_it(*e)).unwrap_or(effect)
}

/// What models carry beside the catalogue's effects: the geometry of every calibration of a robot
/// with several joints, which is never a candidate, and what has no name.
pub const BESIDE_THE_CATALOGUE: &[&dyn Effect] = &[
    &MeasuringFrame,
    &ToolOrientation,
    &ToolPosition,
    &LinkGeometry,
    &UnknownAnchor,
    &UnknownStation,
    &UnknownPlane,
    &UnknownSocket,
    &Unexplained,
];

/// The effect of this name; also what models carry beside the catalogue's effects.
pub fn find(id: &str) -> Option<&'static dyn Effect> {
    let all = CATALOGUE.iter().chain(BESIDE_THE_CATALOGUE);
    all.copied().find(|effect| effect.about().id == id)
}

/// The zero offset of a joint.
pub fn joint_zero() -> &'static dyn Effect {
    &joint_zero_offset::JointZeroOffset
}

/// The length from a single axis to the tool.
pub fn tool_radius() -> &'static dyn Effect {
    &link_length::LinkLength
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
pub fn rank(effect: &dyn Effect) -> usize {
    let id = effect.about().id;
    let place = |id: &str| CATALOGUE.iter().position(|e| e.about().id == id);
    let beside = || {
        let mut all = BESIDE_THE_CATALOGUE.iter();
        all.position(|e| e.about().id == id).unwrap_or(0)
    };
    match place(id) {
        Some(place) => 2 * place + 1,
        None if effect.about().role == Role::FreeFrame => {
            let instruments = |e: &&dyn Effect| e.about().owner == Owner::Instrument;
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
            let is_effect = text.contains("\nimpl Effect for ");
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
            assert!(rank(*effect) > before, "{}", about.id);
            before = rank(*effect);
            for text in [
                about.title,
                about.equation,
                about.source,
                about.cause,
                about.check,
            ] {
                assert!(!text.is_empty(), "{}", about.id);
            }
        }
    }
}
