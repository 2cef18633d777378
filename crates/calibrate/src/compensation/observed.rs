//! A calibration compared with a session of other measurements than points: distances, directions, touches, sockets.
//! Places that the model knows by name are taken from it; others that are unknown are first located from the robot.
//! The effect of corrected commands is not reported: the place of the target was not measured.

use crate::effects::places::name;
use crate::effects::{JointValues, Place, PlaceKind};
use crate::fit::base_model;
use crate::fit::gap::deviations;
use crate::fit::problem::Problem;
use crate::model::{Calibration, Model};
use crate::observations::figures::outliers_given;
use crate::observations::{Layer, start};
use crate::sessions::{Session, hash_of_samples};
use crate::text::Text;

use super::set_aside;
use super::verification::{Compared, Verification, VerifyError, counted, held_out_of, model_for};

/// Compares a session that has more than points with a calibration of the same robot.
pub(super) fn verify(
    calibration: &Calibration,
    session: &Session,
    mut notes: Vec<Text>,
) -> Result<Verification, VerifyError> {
    let mut problem = Problem::observing(session, JointValues::Commanded);
    let own = hash_of_samples(session) == calibration.samples_hash;
    let apart = held_out_of(&problem, own);
    problem.fit = counted(&problem, &apart);
    let full = model_for(calibration, session, &problem, &mut notes);
    let bare = base_model::nominal(&calibration.model.robot, session, &problem);
    let Some(layer) = problem.observed.as_mut() else {
        return Err(VerifyError::NothingToVerify);
    };
    layer.fit.fill(true);
    layer.used.fill(true);
    let placed = placed(layer, &full, session, Some(&mut notes));
    let nominal = self::placed(layer, &bare, session, None);
    let before = deviations(&problem, &nominal);
    let after = deviations(&problem, &placed);
    let suspected = set_aside::of_its_own(calibration, own, problem.usable.len());
    let suspected = suspected.unwrap_or_else(|| {
        problem.observed.as_ref().map_or_else(Vec::new, |layer| {
            layer.samples_with(&outliers_given(layer, &placed))
        })
    });
    let compared = Compared {
        problem: &problem,
        apart: &apart,
        suspected: &suspected,
        tolerance_mm: session.tolerance_mm.or(calibration.tolerance_mm),
        with_table: None,
    };
    compared.verified(before, after, notes)
}

/// A model with the places of this session: its own by their names, others where they seem to be.
fn placed(layer: &Layer, model: &Model, session: &Session, notes: Option<&mut Vec<Text>>) -> Model {
    let references = &session.instrument.references;
    let mut own = model.without(|term| PlaceKind::of(term).is_some());
    let mut located = Vec::new();
    for mut term in start::unknown_places(layer, &own) {
        let kind = PlaceKind::of(&term);
        let label = term.label.clone();
        let known = model
            .terms()
            .iter()
            .find(|t| PlaceKind::of(t) == kind && t.label == label);
        if let Some(known) = known {
            term.coefficients.clone_from(&known.coefficients);
        } else if let Some(kind) = kind {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "the index of a place"
            )]
            let index = term.setting as usize;
            let about = term.effect.about();
            let name = name(references, Place { kind, index });
            located.push(Text::named(
                format!("{} {name}", about.id),
                text!("{effect} {name}", effect = about.title, name),
            ));
        }
        own = own.with_term(term);
    }
    if let (Some(notes), false) = (notes, located.is_empty()) {
        notes.push(text!(
            "not known to the model, and located beside it: {places}",
            places = Text::listed(located, ", ")
        ));
    }
    own
}
