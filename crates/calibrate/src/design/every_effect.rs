//! Every effect of the catalogue that a robot can show, absent, as the model whose columns poses are to show.

use crate::effects::{CATALOGUE, Effect, Inputs, JointValues, Setting, Survey, Term};
use crate::kinematics::{Range, Robot};
use crate::model::Model;

use super::imagined::unmeasured;
use super::needs::all_met;
use super::reflectors::reflectors;

/// Representative orders of gears.
const ORDERS: [f64; 5] = [3.0, 4.0, 5.0, 7.0, 12.0];

/// A model with every effect that this robot can show, absent, at representative settings.
pub(crate) fn every_effect(robot: &Robot, ranges: &[Range], middle_s: f64) -> Model {
    let survey = ideal_survey(robot, ranges);
    let mut terms = Vec::new();
    for effect in CATALOGUE {
        let about = effect.about();
        let joints = if about.per_joint { ranges.len() } else { 1 };
        for (joint, range) in ranges.iter().enumerate().take(joints) {
            if effect.obstacle(&survey, joint).is_some() {
                continue;
            }
            let several = ranges.len() > 1;
            let fades = [0.02, 0.08].map(|share| share * (range.to - range.from));
            if about.setting.takes_fractions() && !several {
                terms.extend(ORDERS.map(|order| Term::absent(effect, joint, order)));
            } else {
                let orders = if several { 1 } else { u16::MAX };
                let own = at_representative_settings(effect, joint, orders, &fades, middle_s);
                terms.extend(own);
            }
        }
    }
    Model::new(robot.clone(), terms)
}

/// An effect, absent, at representative settings: orders up to one (its lowest at least), fades, a time.
pub(crate) fn at_representative_settings(
    effect: &'static Effect,
    joint: usize,
    orders: u16,
    fades: &[f64],
    time_s: f64,
) -> Vec<Term> {
    let settings: Vec<f64> = match effect.about().setting {
        Setting::None | Setting::Setup | Setting::Target | Setting::Place => vec![0.0],
        Setting::Order { from, to } => (from..=to.min(orders.max(from))).map(f64::from).collect(),
        Setting::Fade => fades.to_vec(),
        Setting::Time => vec![time_s],
        Setting::Listed(listed) => vec![listed.stands_for_all(joint)],
    };
    let absent = |setting| Term::absent(effect, joint, setting);
    settings.into_iter().map(absent).collect()
}

/// The survey of a robot under all conditions that poses can meet.
fn ideal_survey(robot: &Robot, ranges: &[Range]) -> Survey {
    let session = unmeasured(robot, &reflectors(robot), None);
    let inputs = Inputs::new(&session, JointValues::Commanded);
    let mut survey = all_met(&Survey::new(&session, &inputs));
    for (joint, range) in survey.joints.iter_mut().zip(ranges) {
        joint.span = range.to - range.from;
    }
    survey.spatial = true;
    survey
}
